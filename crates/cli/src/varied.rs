//! Numbers of a scene that are sought, by fits and designs: what they are in its text, and the scene with others.

use dashpot_analysis::sweep::ScenePoint;
use dashpot_network::parameters::Dimension;
use dashpot_scene::{
    Diagnostic, Diagnostics, Posed, Tunables,
    units::{parse_quantity, si_unit},
};

use crate::input::AsCommanded as _;
use crate::{input::Input, output::list};
use dashpot_report::numbers::significant;

/// Digits of a number that is written into a scene for people.
const WRITTEN: usize = 9;

/// A number that is sought.
#[derive(Debug, Clone)]
pub(crate) struct Varied {
    pub(crate) name: String,
    /// Its unit in the scene, or that of the command line; empty where it has none.
    pub(crate) unit: String,
    /// What one of that is in SI units.
    pub(crate) one: f64,
    pub(crate) si: String,
    /// Between which values, in SI units.
    pub(crate) bounds: [f64; 2],
    /// Where the search begins.
    pub(crate) start: f64,
    /// Its place in the text; a constant of a form has none.
    pub(crate) at: Option<usize>,
}

impl Varied {
    /// A number of a scene's text; the unit and the dimension are those of the command line where the text has none.
    pub(crate) fn of(
        tunables: &Tunables,
        (name, at): (&str, usize),
        bounds: [f64; 2],
        (unit, dimension): (&str, Option<Dimension>),
    ) -> Self {
        let number = &tunables.all()[at];
        let dimension = number.dimension.or(dimension);
        let si = dimension.map_or(String::new(), si_unit);
        // Degrees Celsius have a zero of their own.
        let unit = match (dimension, &*number.unit) {
            (Some(Dimension::TEMPERATURE), _) => "K",
            (_, "") => unit,
            (_, own) => own,
        };
        let one = parse_quantity(&format!("1 {unit}"));
        let one = one.map_or(1.0, |one| dimension.map_or(one, |to| one.meant(to)).value);
        let (name, unit, start) = (name.to_owned(), unit.to_owned(), number.value);
        Self { name, unit, one, si, bounds, start, at: Some(at) }
    }

    /// A value in SI units as people read it: in the unit of the scene.
    pub(crate) fn text(&self, value: f64, digits: usize) -> String {
        self.with_unit(&significant(value / self.one, digits))
    }

    /// The same without zeros at its end.
    pub(crate) fn short(&self, value: f64, digits: usize) -> String {
        let rounded: f64 = format!("{:.*e}", digits - 1, value / self.one).parse().unwrap_or(value);
        self.with_unit(&rounded.to_string())
    }

    /// The same for a scene that is kept.
    pub(crate) fn written(&self, value: f64) -> String {
        self.short(value, WRITTEN)
    }

    /// A value in SI units to the bit.
    pub(crate) fn exact(&self, value: f64) -> String {
        format!("{value:e} {}", self.si).trim_end().to_owned()
    }

    fn with_unit(&self, number: &str) -> String {
        format!("{number} {}", self.unit).trim_end().to_owned()
    }
}

/// What is set but for numbers that are sought: it would stand above what is written into the text.
pub(crate) fn unvaried(
    set: &[(String, String)],
    numbers: &[Varied],
    tunables: &Tunables,
) -> Vec<(String, String)> {
    let is_varied = |name: &str| {
        tunables.find(name).is_ok_and(|at| numbers.iter().any(|own| own.at == Some(at)))
    };
    list(set.iter().filter(|own| !is_varied(&own.0)).cloned())
}

/// A scene with these values in its text.
pub(crate) fn posed(
    (tunables, values): (&Tunables, &[(usize, String)]),
    input: &Input,
    set: &[(String, String)],
) -> Result<Posed, String> {
    tunables.posed(values, &input.options(set)).map_err(|own| messages(&own))
}

pub(crate) fn messages(faults: &Diagnostics) -> String {
    list(faults.list.iter().map(Diagnostic::message)).join("; ")
}

/// The method that is wanted, or else the only one of the scene.
pub(crate) fn method<'m>(posed: &'m Posed, wanted: Option<&'m str>) -> &'m str {
    match (wanted, &posed.run.methods[..]) {
        (Some(wanted), _) => wanted,
        (None, [only]) => only,
        _ => "auto",
    }
}

/// A scene with what is asked of its run, by its [`method`].
pub(crate) fn point(posed: Posed, wanted: Option<&str>) -> Result<ScenePoint, String> {
    let settings = posed.settings(method(&posed, wanted)).map_err(|error| error.to_string())?;
    Ok(ScenePoint { network: posed.network, settings })
}
