//! What is read off a measured curve and off the model at the same times, and the rating of the model.

use dashpot_analysis::RunReport;
use dashpot_dae::Signal;
use dashpot_network::parameters::Dimension;
use dashpot_plot::Of;
use dashpot_report::Table;
use dashpot_scene::Scene;
use dashpot_signal::{
    Analysis, Approach, Channel, Defect, Rating, Reading, Settings, Truth, Unrated,
};
use serde::Serialize;

use super::{
    beside::{Beside, MeasuredCurve, dimension},
    deviations::Compared,
};
use crate::output::{Pairs, list, object};
use dashpot_report::numbers::{percent_signed, quantity};
use dashpot_studies::signal::{number, shown, unit_of, warning};

const DIGITS: usize = 3;

/// What is read off both curves over the time that they have in common, with straight lines between the same samples.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    measured: Analysis,
    model: Analysis,
    rating: Result<Rating, Unrated>,
}

impl Numbers {
    /// Those of rows, and of a signal of a run whose times are later by `zero` \[s\].
    pub(super) fn of(
        (curve, rows): (&MeasuredCurve, &[(f64, f64)]),
        (signal, zero): (&Signal, f64),
        run: &RunReport,
        scene: &Scene,
    ) -> Option<Self> {
        let times: Vec<f64> = list(rows.iter().map(|own| own.0));
        let model: Vec<f64> = list(times.iter().map(|time| signal.value(time + zero)));
        let channel = |values: Vec<f64>| {
            Channel::new(&*curve.column, dimension(curve.output.of), times.clone(), values).ok()
        };
        let (measured, model) = (channel(list(rows.iter().map(|own| own.1)))?, channel(model)?);
        let rating = Rating::of(&measured, &model, measured.span());
        // What the record reads at rest before the run tells its zero and its noise.
        let first = *times.first()?;
        let before = curve.rows.iter().take_while(|own| own.0 < first);
        let (times, values) = before.chain(rows).copied().unzip();
        let measured =
            Channel::new(&*curve.column, dimension(curve.output.of), times, values).ok()?;
        let relative = run.worst_relative_error().unwrap_or(0.0);
        let error = signal.error.unwrap_or(relative * model.largest().1);
        let approach = approach(curve, (first, zero), run, scene);
        let settings = Settings { approach, ..Settings::default() };
        Some(Self {
            measured: settings.analyse(measured).ok()?,
            model: Settings { error, ..settings }.analyse(model).ok()?,
            rating,
        })
    }

    /// What is read of both: measured, and of the model.
    fn readings(&self) -> impl Iterator<Item = (&Reading, &Reading)> {
        let all = self.measured.readings.iter();
        all.filter_map(|own| Some((own, self.model.reading(own.measure)?)))
    }
}

/// How the impactor moves whose acceleration was measured, at the touch, which is at `zero` \[s\]; or at the first row where
/// that is later.
fn approach(
    curve: &MeasuredCurve,
    (first, zero): (f64, f64),
    run: &RunReport,
    scene: &Scene,
) -> Option<Approach> {
    let mut nodes = run.assembly.nodes.iter();
    let at = nodes.position(|own| own.is_impactor() && own.name == curve.output.name())?;
    let velocity =
        run.assembly.nodes[at].velocity.filter(|_| curve.output.of == Of::Acceleration)?;
    let solution = run.solution();
    let velocity = solution.signal(velocity).value(first.max(0.0) + zero);
    let gravity = scene.network.effects().iter().find_map(|own| own.gravity()).unwrap_or(0.0);
    let touch = (first >= 0.0).then_some(first);
    let mass = Some(solution.body_mass(at));
    (velocity > 0.0).then_some(Approach { velocity, mass, gravity, touch })
}

/// Adds the work of forces whose element's deformation was measured as well, at the same times.
pub(super) fn add_work(curves: &[MeasuredCurve], found: &mut [Beside]) {
    for (force, curve) in curves.iter().enumerate().filter(|own| own.1.output.of == Of::Force) {
        let is_meant = |own: &MeasuredCurve| {
            own.output.of == Of::Deformation && own.output.name() == curve.output.name()
        };
        let Some(at) = curves.iter().position(is_meant) else { continue };
        let Some(of_way) = found.get(at).and_then(|own| own.numbers.clone()) else { continue };
        if let Some(Beside { numbers: Some(own), .. }) = found.get_mut(force) {
            let (measured, model) = (own.measured.clone(), own.model.clone());
            let is_both = own.measured.add_work(&of_way.measured).is_ok()
                && own.model.add_work(&of_way.model).is_ok();
            if !is_both {
                (own.measured, own.model) = (measured, model);
            }
        }
    }
}

/// The scores of ISO/TS 18571, as rows of a table with a column for each run.
pub(super) fn scores(all: &[Compared<'_>]) -> Vec<Vec<String>> {
    let ratings = all.iter().filter_map(|own| own.beside.numbers.as_ref()?.rating.ok());
    let ratings: Vec<Rating> = list(ratings);
    if ratings.is_empty() || ratings.len() < all.len() {
        return Vec::new();
    }
    let row = |name: &str, cell: &dyn Fn(&Rating) -> String| {
        list([name.to_owned()].into_iter().chain(ratings.iter().map(cell)))
    };
    let score = |own: f64| format!("{own:.DIGITS$}");
    let late = |own: &Rating| match own.later {
        0.0 => score(own.phase),
        later => {
            let way = if later < 0.0 { "earlier" } else { "later" };
            format!("{}, {} {way}", score(own.phase), quantity(later.abs(), "s", DIGITS))
        }
    };
    vec![
        row("rating (ISO/TS 18571)", &|own| format!("{}, {}", score(own.overall()), own.grade())),
        row("  corridor", &|own| score(own.corridor)),
        row("  phase", &late),
        row("  magnitude", &|own| score(own.magnitude)),
        row("  slope", &|own| score(own.slope)),
    ]
}

/// Why there is no rating, or nothing is read.
pub(super) fn remark(all: &[Compared<'_>]) -> Option<String> {
    match &all.first()?.beside.numbers {
        None => Some(
            "two rows have the same time, so that nothing but the deviations is read: a recorded signal has one value \
             at a time"
                .to_owned(),
        ),
        Some(Numbers { rating: Err(why), .. }) => {
            Some(format!("no rating by ISO/TS 18571: {why}"))
        }
        Some(_) => None,
    }
}

/// What is impossible of what is read of a measured curve.
fn impossible(own: &Numbers) -> impl Iterator<Item = &Defect> {
    let is_meant =
        |own: &&Defect| matches!(own, Defect::GainsEnergy { .. } | Defect::DoesNotStop { .. });
    own.measured.defects.iter().filter(is_meant)
}

/// The same in words.
pub(super) fn impossible_words(all: &[Compared<'_>]) -> Option<String> {
    let first = all.first()?;
    let defects = list(impossible(first.beside.numbers.as_ref()?).map(ToString::to_string));
    let all = Some(defects.join("; ")).filter(|own| !own.is_empty())?;
    Some(format!("{}: what was measured {all}", first.curve.file))
}

/// Whether a value is zero within its error.
fn is_zero(value: f64, reading: &Reading) -> bool {
    value.abs() <= reading.error
}

/// What is read off a measured curve, and off some runs at the same times.
pub(super) fn table(all: &[Compared<'_>]) -> Option<Table> {
    let first = all.first()?;
    let numbers = list(all.iter().filter_map(|own| own.beside.numbers.as_ref()));
    let own = *numbers.first().filter(|_| numbers.len() == all.len())?;
    let channel = own.measured.channel.dimension();
    let is_single = all.len() == 1;
    let row = |(measured, model): (&Reading, &Reading)| {
        let value = measured.value.ok()?;
        let unit = unit_of(measured.measure, value, channel);
        let cells = |reading: &Reading| match reading.value {
            Err(_) => ("–".to_owned(), String::new()),
            Ok(value) if is_zero(value, reading) => {
                let error =
                    (reading.error != 0.0).then(|| format!("±{}", unit.number(reading.error, 1)));
                ("0".to_owned(), error.unwrap_or_default())
            }
            Ok(value) => {
                let (number, error) = shown(reading, value, &unit);
                let is_exact = reading.error == 0.0 && reading.truth == Truth::Within;
                (number, if is_exact { String::new() } else { error })
            }
        };
        let number = |reading: &Reading| cells(reading).0;
        let error = |reading: &Reading| cells(reading).1;
        let word = measured.measure.word();
        let name = match &*unit.symbol {
            "" => word.to_owned(),
            symbol => format!("{word} ({symbol})"),
        };
        let mut cells = vec![name, number(measured), error(measured)];
        if is_single {
            let is_told = !is_zero(value, measured) && measured.truth == Truth::Within;
            let apart = model.value.ok().filter(|_| is_told);
            let apart = apart.map(|model| percent_signed((model - value) / value.abs()));
            cells.extend([number(model), error(model), apart.unwrap_or_default()]);
        } else {
            let of = |own: &&Numbers| own.model.reading(measured.measure).map(number);
            cells.extend(numbers.iter().map(|own| of(own).unwrap_or_default()));
        }
        Some(cells)
    };
    let names = if is_single {
        vec!["model", "error", "apart"]
    } else {
        list(all.iter().map(|own| own.name))
    };
    let header = ["", "measured", "error"].into_iter().chain(names);
    let caption = format!("{}: what both say at the same times", first.curve.output.key());
    Some(Table::new(caption, header, own.readings().filter_map(row)))
}

/// The same for programs, in SI units.
pub(super) fn object(numbers: Option<&Numbers>) -> impl Serialize {
    let rating = numbers.map(|own| own.rating);
    let dimension = numbers.map_or(Dimension::NUMBER, |own| own.measured.channel.dimension());
    let one = |(measured, model): (&Reading, &Reading)| {
        let is_told = measured.truth == Truth::Within;
        let both = measured.value.ok().zip(model.value.ok());
        let both = both.filter(|own| own.0 != 0.0 && is_told);
        let told = object! {
            measured: number(dimension, measured),
            model: number(dimension, model),
            relative: both.map(|own| (own.1 - own.0) / own.0.abs()),
        };
        (measured.measure.word(), told)
    };
    let rated = |scores: Rating| {
        object! { overall: scores.overall(), grade: scores.grade(), #[serde(flatten)] scores }
    };
    object! {
        measures: numbers.iter().flat_map(|own| own.readings()).map(one).collect::<Pairs<_, _>>(),
        warnings: list(numbers.into_iter().flat_map(impossible).map(warning)),
        rating: rating.and_then(Result::ok).map(rated),
        unrated: rating.and_then(Result::err).map(Unrated::code),
    }
}
