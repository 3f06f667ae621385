//! What a test is compared with: an output of the scene, or one of its models alone.

use dashpot_fit::network::Kind;
use dashpot_network::{Assembly, parameters::Dimension};

use super::{
    alone::Alone,
    asked::{Asked, FLAG},
    solver::Poser,
};
use crate::{
    error::CliError,
    output::list,
    verbs::run::{
        beside::{MeasuredCurve, Output},
        measure_text,
    },
};
use dashpot_report::numbers::share;

/// What rows are compared with.
pub(super) enum Compared {
    /// An output of a run.
    Output(Output),
    /// A model alone.
    Alone(Alone),
}

/// The rows of a test, and what they are compared with.
pub(super) struct Target {
    pub(super) rows: Vec<(f64, f64)>,
    pub(super) note: Option<String>,
    pub(super) output: Compared,
}

impl Compared {
    /// What it is called: `pad.force`.
    pub(super) fn key(&self) -> String {
        match self {
            Self::Output(own) => own.key(),
            Self::Alone(own) => format!("{}.{}", own.name(), own.word()),
        }
    }

    /// Whether its rows are over a frequency.
    pub(super) fn is_oscillation(&self) -> bool {
        matches!(self, Self::Alone(own) if own.is_oscillation())
    }

    /// The dimension of what is left of it.
    pub(super) fn dimension(&self) -> Dimension {
        match self {
            Self::Output(own) => own.dimension(),
            Self::Alone(own) => own.dimension(),
        }
    }

    pub(super) fn unit(&self) -> &'static str {
        self.dimension().named().map_or("1", |own| own.1)
    }

    pub(super) fn kind(&self) -> Kind {
        match self {
            Self::Output(_) => Kind::Blow,
            Self::Alone(own) => own.kind(),
        }
    }

    /// What is left of it, or noise, in words.
    pub(super) fn told(&self, value: f64, digits: usize) -> String {
        match self.kind() {
            Kind::Modulus => share(value),
            _ => measure_text("", value, self.unit(), digits),
        }
    }
}

/// Reads what a `--to` names: one test, or storage and loss.
pub(super) fn targets(
    asked: &Asked,
    until: Option<f64>,
    assembly: &Assembly,
) -> Result<Vec<Target>, CliError> {
    if is_output(&asked.target) {
        if let Some(other) = asked.of_model() {
            let reason = format!(
                "it has no times; a force over a deformation is fitted to the model alone, at the rate at which it was \
                 pressed: \"{other}\""
            );
            return Err(asked.wrong(reason));
        }
        let curve = MeasuredCurve::read((FLAG, &asked.measured_as()), 0.0, assembly)?;
        let kept = curve.rows.into_iter().filter(|own| until.is_none_or(|until| own.0 <= until));
        let kept = kept.map(|own| (own.0, asked.scale * own.1));
        let (rows, output) = (list(kept), Compared::Output(curve.output));
        return Ok(vec![Target { rows, note: curve.note, output }]);
    }
    let measured = asked.measured(until)?;
    let tests = Alone::of(asked, &measured)?.into_iter().enumerate();
    let target = |(at, (own, rows))| {
        let note = measured.note.clone().filter(|_| at == 0);
        Target { rows, note, output: Compared::Alone(own) }
    };
    Ok(list(tests.map(target)))
}

/// Sections of models, which stand before the names of those that share one.
const SECTIONS: [&str; 3] = ["models", "materials", "elements"];

/// Whether a name is that of an output: `pad.force`, where `pad`, `models.pad` and `materials.felt` are models.
pub(super) fn is_output(name: &str) -> bool {
    name.split_once('.').is_some_and(|own| !SECTIONS.contains(&own.0))
}

/// Whether the models that are tested alone are there, and are what was measured.
pub(super) fn check_alone(
    asked: &Asked,
    output: &Compared,
    poser: &Poser<'_>,
    values: &[f64],
) -> Result<(), CliError> {
    let Compared::Alone(own) = output else { return Ok(()) };
    let wrong = |reason: String| asked.wrong(reason);
    let (_, is_material) = poser.model(own.name(), values).map_err(wrong)?;
    if is_material == own.is_material() {
        return Ok(());
    }
    Err(wrong(if is_material {
        format!(
            "`{}` is a material: stress, strain and moduli in Pa are wanted, where these are force, deformation or \
             stiffness",
            own.name()
        )
    } else {
        format!(
            "`{}` is no material: force, deformation and stiffness are wanted, where these are stress, strain or \
             moduli in Pa",
            own.name()
        )
    }))
}
