//! What a test found, and how far the model object and an independent computation are apart.

use super::{Note, Obstacle, track::Track};
use crate::{Column, report::zeros::settled};

/// What a test of a model found: the same quantities from the model object in closed form, where it is
/// linear, and from independent computations with the network of the model.
///
/// Values that are infinite (the loss factor of a dashpot) are infinite here as well.
#[derive(Debug, Clone, PartialEq)]
pub struct RheometerReport {
    /// Word of the protocol.
    pub protocol: &'static str,
    /// The parameters that were used.
    pub settings: Vec<Setting>,
    /// Time \[s\] or frequency \[Hz\]. Times rise from 0; where the drive may jump or bend, and
    /// at 0, the same time stands twice, first for just before, then for just after.
    pub abscissa: Column,
    /// What was done to the model, where that is a function of time.
    pub drive: Option<Column>,
    /// What was found, each over the abscissa.
    pub series: Vec<Series>,
    /// Single numbers: those of the model, then those of the test.
    pub figures: Vec<Figure>,
    /// One for each independent computation, in the order in which they were asked for.
    pub computations: Vec<Computation>,
    /// What is special about this model under this test.
    pub notes: Vec<Note>,
}

impl RheometerReport {
    /// The series of the given name.
    pub fn series(&self, name: &str) -> Option<&Series> {
        self.series.iter().find(|series| series.name == name)
    }

    /// The figure of the given name.
    pub fn figure(&self, name: &str) -> Option<&Figure> {
        self.figures.iter().find(|figure| figure.name == name)
    }

    /// The largest relative difference between the model object and any computation, over all
    /// series; `None` where nothing could be compared.
    pub fn largest_difference(&self) -> Option<f64> {
        let all = self.series.iter().flat_map(|series| &series.computed);
        all.filter_map(|computed| computed.difference).map(|own| own.relative).reduce(f64::max)
    }
}

/// A parameter that a test used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Its name in the protocol's parameters.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Whether it follows from the model because it was left out.
    pub is_chosen: bool,
}

/// A quantity over the abscissa.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What it is, for instance `deformation`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// From the model object, in closed form; empty where the model is not linear.
    pub model: Vec<f64>,
    /// From the independent computations, in the order of [`RheometerReport::computations`].
    pub computed: Vec<Computed>,
}

/// A series as an independent computation found it.
#[derive(Debug, Clone, PartialEq)]
pub struct Computed {
    /// The values; `None` where the computation does not reach.
    pub values: Vec<Option<f64>>,
    /// How far they are from those of the model object; `None` where nothing can be compared.
    pub difference: Option<Disagreement>,
    /// About how large the error of the values may be, in the unit of the series, as far as it is known;
    /// see [`Disagreement::stated`].
    pub error: Option<f64>,
}

/// How far an independent computation is from the model object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disagreement {
    /// The largest difference, in the unit of the series (rad for a loss factor, where the loss angles are compared).
    pub largest: f64,
    /// Where that is: time \[s\] or frequency \[Hz\].
    pub at: f64,
    /// The largest difference relative to the largest value of the series, or in a frequency sweep
    /// to the magnitude of the stiffness at the same frequency.
    pub relative: f64,
    /// About how large the error of the computation may be, relative like `relative`: for `exact` its
    /// bound and what rounding of the equations' coefficients changes, for the network at `s = iω`
    /// the latter alone, for other methods an estimate from three tolerances.
    pub stated: Option<f64>,
}

/// An independent computation.
#[derive(Debug, Clone, PartialEq)]
pub struct Computation {
    /// Name of the method.
    pub method: &'static str,
    /// The last time \[s\] or frequency \[Hz\] that it reaches; `None` where there is nothing.
    pub reach: Option<f64>,
    /// Why it does not reach further.
    pub obstacle: Option<Obstacle>,
}

/// A number that characterises a model or a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// What it is, for instance `instantaneous stiffness`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// From the model object; `None` where it is infinite or does not exist.
    pub model: Option<f64>,
    /// From the first independent computation, where that gives it.
    pub computed: Option<f64>,
    /// How far that may be off, in the unit of the figure, as far as it is known: a bound for `exact` with
    /// what rounding changes, for other methods an estimate from three tolerances.
    pub error: Option<f64>,
    /// Why there is no value.
    pub note: Option<Note>,
}

impl Figure {
    /// A figure of the model object; what is not finite is no value.
    pub(super) fn of(name: &'static str, unit: &'static str, model: f64) -> Self {
        let model = Some(model).filter(|value| value.is_finite());
        Self { name, unit, model, computed: None, error: None, note: None }
    }

    /// The same figure, with the reason why there is no value, should there be none.
    pub(super) fn noting(self, note: Note) -> Self {
        Self { note: self.model.is_none().then_some(note), ..self }
    }

    /// The same figure with the error of its computed value.
    pub(super) fn within(self, error: Option<f64>) -> Self {
        Self { error: error.filter(|error| error.is_finite()), ..self }
    }

    /// The same figures, zero where rounding, or an error that is small, hides what they are: of the size of the largest of
    /// their unit, of pure numbers at least of 1.
    pub(super) fn settled(mut all: Vec<Self>) -> Vec<Self> {
        let size = |own: &Self| {
            let alike = all.iter().filter(|other| other.unit == own.unit);
            let values = alike.flat_map(|other| [other.model, other.computed]).flatten();
            values
                .fold(if own.unit == "1" { 1.0 } else { 0.0 }, |most: f64, own| most.max(own.abs()))
        };
        let sizes: Vec<f64> = all.iter().map(size).collect();
        for (own, size) in all.iter_mut().zip(sizes) {
            own.model = own.model.map(|value| settled(value, None, size, 0.0).0);
            let computed = own.computed.map(|value| settled(value, own.error, size, 0.0));
            (own.computed, own.error) =
                computed.map_or((None, own.error), |own| (Some(own.0), own.1));
        }
        all
    }

    /// The same figure with the value of the first computation.
    pub(super) fn computed(self, computed: Option<f64>) -> Self {
        Self { computed: computed.filter(|value| value.is_finite()), ..self }
    }
}

/// The series of a quantity over `times` \[s\], with its differences relative to its largest value.
pub(super) fn series<'a>(
    name: &'static str,
    unit: &'static str,
    times: &[f64],
    model: Vec<f64>,
    tracks: impl IntoIterator<Item = &'a Track>,
) -> Series {
    let compared = |track: &Track| Computed {
        difference: difference(times, &model, track),
        error: track.error,
        values: track.values.clone(),
    };
    let computed = tracks.into_iter().map(compared).collect();
    Series { name, unit, model, computed }
}

fn difference(times: &[f64], model: &[f64], track: &Track) -> Option<Disagreement> {
    let pairs = || {
        let both = model.iter().zip(&track.values);
        both.zip(times).filter_map(|((&own, &other), &at)| Some((own, other?, at)))
    };
    let of_model = pairs().map(|(own, ..)| own.abs()).reduce(f64::max)?;
    let scale = if of_model > 0.0 {
        of_model
    } else {
        pairs().map(|(_, other, _)| other.abs()).fold(0.0, f64::max)
    };
    let (largest, at) = pairs()
        .map(|(own, other, at)| ((own - other).abs(), at))
        .max_by(|one, other| one.0.total_cmp(&other.0))?;
    let relative = |size: f64| if size == 0.0 { 0.0 } else { size / scale };
    Some(Disagreement {
        largest,
        at,
        relative: relative(largest),
        stated: track.error.map(relative),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_computation_does_not_reach_does_not_count() {
        let values = vec![Some(1.0), Some(1.5), None];
        let track = Track { values, error: Some(0.1) };
        let series = series("deformation", "m", &[1.0, 2.0, 3.0], vec![1.0, 2.0, 9.0], [&track]);
        let found = series.computed[0].difference.unwrap();
        assert_eq!((found.largest, found.at, found.relative), (0.5, 2.0, 0.25));
        assert_eq!(found.stated, Some(0.05));
    }

    #[test]
    fn nothing_differs_from_nothing_by_nothing() {
        let track = Track { values: vec![Some(0.0)], error: None };
        let series = series("force", "N", &[1.0], vec![0.0], [&track]);
        assert_eq!(series.computed[0].difference.map(|difference| difference.relative), Some(0.0));
    }
}
