//! Numbers of a scene that scatter.

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, parse_quantity};

use super::{
    together::{self, Cause, causes},
    tunable::{Tunable, Tunables},
    variation::number_text,
};
use crate::{diagnostics::Diagnostics, quantities::scatter::Scatter};

/// A number of a scene that is normally distributed, or, where it scatters together with others, its logarithm is.
#[derive(Debug, Clone, PartialEq)]
pub struct ScatteredNumber {
    /// Its path in full.
    pub path: String,
    /// The shortest end of the path that tells it from all others.
    pub name: String,
    /// The mean in SI units, with which the scene is read.
    pub mean: f64,
    /// The standard deviation in SI units, positive.
    pub deviation: f64,
    /// What it measures, where a unit is given.
    pub dimension: Option<Dimension>,
    /// As it is written, mean and standard deviation in one unit: `20 ± 2 MN/m`.
    pub text: String,
    /// Whether it scatters together with others, as `[scatter]` says.
    pub is_together: bool,
}

impl ScatteredNumber {
    /// The numbers with scatter of a scene's text, in its order; those of no deviation are not among them.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_scene::ScatteredNumber;
    ///
    /// let own = ScatteredNumber::all("[values]\nK = \"20 ± 2 MN/m\"\nC = \"6 kN s/m\"\n", None)?;
    /// assert_eq!((own.len(), &*own[0].path, own[0].mean), (1, "values.K", 2e7));
    /// # Ok::<(), dashpot_scene::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// What is wrong with the text as TOML.
    pub fn all(text: &str, file: Option<&str>) -> Result<Vec<Self>, Diagnostics> {
        if !is_possible(text) {
            return Ok(Vec::new());
        }
        let tunables = Tunables::of(text, file)?;
        let alone = scattered(&tunables).map(|(_, own, scatter)| Self::of(own, scatter));
        let causes = causes(text, &tunables);
        let together = in_causes(&causes).into_iter();
        let together = together.map(|at| Self::of_causes(&tunables, at, &causes));
        Ok(alone.chain(together).collect())
    }

    /// A number that scatters together with others; its standard deviation in parts of it is the root of the sum of the
    /// squares of its shares.
    pub(super) fn of_causes(tunables: &Tunables, at: usize, causes: &[Cause]) -> Self {
        let own = &tunables.all()[at];
        let squares: f64 = shares(causes, at).map(|own| own * own).sum();
        let part = squares.sqrt();
        let rounded: f64 = format!("{:.2e}", 100.0 * part).parse().unwrap_or(100.0 * part);
        Self {
            path: own.path.clone(),
            name: own.name.clone(),
            mean: own.value,
            deviation: own.value.abs() * part,
            dimension: own.dimension,
            text: format!("{} ± {rounded} %", tunables.shown(at)),
            is_together: true,
        }
    }

    pub(super) fn of(own: &Tunable, scatter: &Scatter) -> Self {
        let meant = |quantity: Quantity| match own.dimension {
            Some(dimension) => quantity.meant(dimension),
            None => quantity,
        };
        let parsed = |number: f64| {
            parse_quantity(&number_text(number, &scatter.unit))
                .map_or(f64::NAN, |own| meant(own).value)
        };
        // What a unit of its own zero, such as that of degrees Celsius, makes of nothing.
        let deviation = parsed(scatter.deviation) - parsed(0.0);
        let numbers =
            format!("{} ± {}", number_text(scatter.mean, ""), number_text(scatter.deviation, ""));
        let text = match &*scatter.unit {
            "%" => format!("({numbers}) %"),
            unit => format!("{numbers} {unit}").trim_end().to_owned(),
        };
        Self {
            path: own.path.clone(),
            name: own.name.clone(),
            mean: own.value,
            deviation,
            dimension: own.dimension,
            text,
            is_together: false,
        }
    }
}

/// Whether a text may have numbers with scatter; most have none.
pub(super) fn is_possible(text: &str) -> bool {
    Scatter::is_possible(text) || together::is_possible(text)
}

/// The numbers that scatter together, rising.
pub(super) fn in_causes(causes: &[Cause]) -> Vec<usize> {
    let mut all: Vec<usize> = causes.iter().flat_map(|own| &own.shares).map(|own| own.0).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// What each cause adds to the logarithm of a number.
pub(super) fn shares(causes: &[Cause], at: usize) -> impl Iterator<Item = f64> + '_ {
    let of = move |own: &Cause| own.shares.iter().find(|own| own.0 == at).map_or(0.0, |own| own.1);
    causes.iter().map(of)
}

pub(super) fn scattered(tunables: &Tunables) -> impl Iterator<Item = (usize, &Tunable, &Scatter)> {
    let all = tunables.all().iter().enumerate();
    let known = all.filter_map(|(at, own)| Some((at, own, own.scatter.as_ref()?)));
    known.filter(|own| own.2.deviation > 0.0)
}
