//! What scatter of the scene's numbers makes of a run: a sample of designs, and its words.

use std::{num::NonZero, thread::available_parallelism};

use clap::Args;
use dashpot_analysis::{
    Band, Judged, Odds, RunError, RunReport, ScatterReport, ScatterSource, SolveSettings,
    Unevaluated,
    sweep::{Estimates, Grid, ScenePoint, SweepError, SweepOptions, Watch, columns, sweep},
};
use dashpot_report::Table;
use dashpot_scene::{Change, Drawn, Posed, ReadOptions, Sample, Scene, Tunables, units::si_unit};
use dashpot_units::percent;

use super::{
    measures::{Side, is_zero, largest, unit_of_kind},
    verdict::Line,
};
use crate::{
    counts::SCATTERED,
    error::{CliError, StudyError},
    input,
    output::each_once,
    unevaluated,
    varied::messages,
};
use dashpot_report::numbers::{self, MOST_DIGITS, Unit, rounded};

/// What is smaller than this part of the largest value of its unit is what rounding leaves of zero.
const ROUNDING: f64 = 1e-12;
/// Digits of a standard deviation.
const FEW: usize = 2;
/// Digits of what is beside one.
const DIGITS: usize = 4;
/// So many designs are drawn, and with this seed, unless others are asked for.
const DESIGNS: usize = 500;
const SEED: u64 = 1;

/// How scatter is sampled.
#[derive(Debug, Clone, Copy, Args)]
pub struct ScatterArguments {
    /// So many designs are drawn where numbers of the scene have scatter, such as "20 ± 2 MN/m": a Latin hypercube.
    #[arg(long, value_name = "NUMBER", value_parser = SCATTERED.read(), default_value_t = DESIGNS)]
    sample: usize,
    /// Which designs are drawn; the same number gives the same ones.
    #[arg(long, value_name = "NUMBER", default_value_t = SEED)]
    seed: u64,
}

impl Default for ScatterArguments {
    fn default() -> Self {
        Self { sample: DESIGNS, seed: SEED }
    }
}

impl ScatterArguments {
    /// So many designs, drawn with this seed.
    pub fn new(sample: usize, seed: u64) -> Self {
        Self { sample, seed }
    }

    /// How many designs are drawn.
    pub(crate) fn count(self) -> usize {
        self.sample
    }

    /// What the designs are drawn with.
    pub(crate) fn seed(self) -> u64 {
        self.seed
    }
}

/// The designs that are drawn from the scatter of a scene, `None` where it has none. Numbers that the sample of another
/// scene has as well are drawn as there.
pub(crate) fn drawn(
    scene: &Scene,
    arguments: ScatterArguments,
    plain: &[(String, String)],
    beside: Option<&Sample>,
) -> Result<Option<Sample>, CliError> {
    if scene.scatter.is_empty() {
        return Ok(None);
    }
    let own = Posed::from(scene.clone());
    let options = options(scene, plain);
    let change =
        |tunables: &Tunables, value: (usize, String)| match tunables.posed(&[value], &options) {
            Ok(other) if other.is_solved_as(&own) => Change::Nothing,
            Ok(_) => Change::Some,
            Err(_) => Change::Refused,
        };
    let ScatterArguments { sample, seed } = arguments;
    Sample::of(&scene.text, sample, seed, &change, beside)
        .map_err(|faults| StudyError::Scene(faults).into())
}

/// How the text of a scene with scatter is read once more: what is set by a path, and all that has scatter, stands
/// in it.
fn options<'o>(scene: &'o Scene, set: &'o [(String, String)]) -> ReadOptions<'o> {
    input::options(scene.file.as_deref(), set)
}

/// What is set from outside and has no scatter: names under `[values]`.
pub(crate) fn plainly_set(scene: &Scene, set: &[(String, String)]) -> Vec<(String, String)> {
    let is_named = |name: &String| scene.values.iter().any(|known| known.name == *name);
    let has_scatter =
        |name: &String| scene.scatter.iter().any(|own| own.path == format!("values.{name}"));
    set.iter().filter(|own| is_named(&own.0) && !has_scatter(&own.0)).cloned().collect()
}

/// What the designs of a sample give, solved with the settings of a run but without estimates of their errors.
pub(crate) fn solved(
    scene: &Scene,
    (sample, seed): (&Sample, u64),
    (settings, plain): (&SolveSettings, &[(String, String)]),
    watch: &mut Watch<'_>,
) -> Result<Option<ScatterReport>, RunError> {
    let columns = match columns(&point(scene.clone().into(), settings), &[]) {
        Ok((columns, _)) => columns.into_iter().filter(|own| !own.is_share).collect::<Vec<_>>(),
        Err(SweepError::Run(error)) => return Err(error),
        Err(_) => return Ok(None),
    };
    let pose = |places: &[usize]| design(scene, sample, places[0], (settings, plain));
    let Some(grid) = Grid::new(vec![sample.len()]) else { return Ok(None) };
    let threads = available_parallelism().map_or(1, NonZero::get);
    let options = SweepOptions { threads, estimates: Estimates::Off };
    let sources = || sample.drawn().iter().map(source).collect();
    match sweep(&grid, &pose, &columns, options, watch) {
        Ok(report) => Ok(Some(ScatterReport::of(sources(), seed, &report))),
        Err(SweepError::Run(error)) => Err(error),
        Err(_) => Ok(None),
    }
}

/// A design of a sample, with the settings of a run.
pub(crate) fn design(
    scene: &Scene,
    sample: &Sample,
    at: usize,
    (settings, plain): (&SolveSettings, &[(String, String)]),
) -> Result<ScenePoint, String> {
    let posed = sample.posed(at, &options(scene, plain)).map_err(|own| messages(&own))?;
    Ok(point(posed, settings))
}

fn point(posed: Posed, settings: &SolveSettings) -> ScenePoint {
    let settings = SolveSettings { duration: posed.run.duration, ..settings.clone() };
    ScenePoint { network: posed.network, settings }
}

/// A number that was drawn, in SI units.
pub(crate) fn source(drawn: &Drawn) -> ScatterSource {
    let number = &drawn.number;
    ScatterSource {
        name: number.name.clone(),
        text: number.text.clone(),
        unit: number.dimension.map_or_else(|| "1".to_owned(), si_unit),
        mean: number.mean,
        deviation: number.deviation,
        cut_below: drawn.cut[0],
        cut_above: drawn.cut[1],
        beyond: drawn.beyond,
        is_together: number.is_together,
    }
}

/// What was drawn, and how it was solved.
pub(crate) fn lines(run: &RunReport) -> Vec<Line> {
    let Some(own) = &run.scatter else { return Vec::new() };
    let how = if own.instantiated == own.designs {
        "instantiated of one compiled form".to_owned()
    } else if own.instantiated == 0 {
        "each solved by itself".to_owned()
    } else {
        format!("{} of them instantiated of one compiled form", own.instantiated)
    };
    let all = own.all_limits.as_ref().map_or_else(String::new, |own| {
        format!("; probability to keep all limits {}", probability(own))
    });
    let first = format!(
        "{}; {}, {how}, without error bars of their own{all}",
        sources(&own.sources),
        designs(own.designs, own.seed)
    );
    let texts = [first].into_iter().chain(own.sources.iter().filter_map(cut_text));
    texts.map(|text| Line { label: "scatter", text }).collect()
}

/// Which designs of the sample have no solution; measures that single ones lack are told by their bands.
pub(super) fn missing(run: &RunReport) -> Vec<String> {
    let Some(own) = &run.scatter else { return Vec::new() };
    let causes = own.unsolved().cloned().collect();
    let all = Unevaluated { causes, ..own.unevaluated.clone() };
    unevaluated::sentences(&all, "design", |_| String::new())
}

/// The numbers that were drawn, those by themselves and those together.
pub(crate) fn sources(all: &[ScatterSource]) -> String {
    let named = |is_together: bool| {
        let all = all.iter().filter(|own| own.is_together == is_together);
        all.map(|of| format!("{} = {}", of.name, of.text)).collect::<Vec<_>>().join(", ")
    };
    let told = [
        (named(false), "each normal with the standard deviation behind ±"),
        (
            named(true),
            "together as `[scatter]` says, each lognormal with the standard deviation behind ±",
        ),
    ];
    let told = told.into_iter().filter(|own| !own.0.is_empty());
    told.map(|(names, how)| format!("{names}, {how}")).collect::<Vec<_>>().join("; ")
}

/// `500 designs (Latin hypercube, seed 1)`.
pub(crate) fn designs(count: usize, seed: u64) -> String {
    format!("{count} designs (Latin hypercube, seed {seed})")
}

/// Where the distribution of a number is cut off.
pub(crate) fn cut_text(own: &ScatterSource) -> Option<String> {
    let bound = |word: &str, at: Option<f64>| {
        at.map(|at| format!("{word} {}", rounded(at, &own.unit, MOST_DIGITS)))
    };
    let bounds = [bound("below", own.cut_below), bound("above", own.cut_above)];
    let bounds: Vec<String> = bounds.into_iter().flatten().collect();
    (!bounds.is_empty()).then(|| {
        format!(
            "{} is cut off {}, which the scene does not allow: {} of its distribution",
            own.name,
            bounds.join(" and "),
            percent(own.beyond, FEW)
        )
    })
}

/// The probability to keep a limit: `; probability to pass 97.6 % (95.8 to 98.6 %)`.
pub(super) fn chance(judged: &Judged<'_>) -> Option<String> {
    let own = judged.chance?;
    let word = if judged.limit.of_mean {
        "probability of a single design to pass"
    } else {
        "probability to pass"
    };
    Some(format!("{word} {}", probability(&own.odds)))
}

/// A probability with its range: `97.6 % (95.8 to 98.6 %)`.
pub(crate) fn probability(own: &Odds) -> String {
    let (low, high) = own.range();
    let unknown = own.not_known();
    let unknown = match unknown {
        0 => String::new(),
        count => format!(", {count} of {} designs not known", own.designs),
    };
    let [share, low, high] = [own.share(), low, high].map(in_percent);
    // What is not known of a design does not count as kept.
    let at_least = if unknown.is_empty() { "" } else { "at least " };
    format!("{at_least}{share} % ({low} to {high} %{unknown})")
}

/// A probability in percent to one decimal.
fn in_percent(share: f64) -> String {
    let text = format!("{:.1}", 100.0 * share);
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// The bands of all measures; nothing where there is no scatter.
pub(crate) fn table(run: &RunReport) -> Option<Table> {
    let own = run.scatter.as_ref()?;
    let header = ["measure", "mean", "standard\ndeviation", "2.5 %", "97.5 %", "unit"];
    let bands = own.bands.iter().filter(|own| run.told().any(|told| told.key == own.key));
    let bands: Vec<&Band> = bands.collect();
    // A band is that of the designs that have a value.
    let is_whole = bands.iter().all(|own| own.without == 0);
    let header = header.into_iter().chain((!is_whole).then_some("of the\ndesigns"));
    let rows = bands.iter().map(|band| {
        let share = (!is_whole).then(|| covered(band));
        row(run, band).into_iter().chain(share).collect()
    });
    Some(Table::new("Scatter", header, rows))
}

/// Between which values of each measure 95 % of the designs drawn lie, of several scenes side by side; nothing where
/// none has scatter.
pub(super) fn ranges(side: &Side<'_>) -> Option<Table> {
    let bands = |run: &RunReport| run.scatter.as_ref().map_or(&[][..], |own| &own.bands).to_vec();
    let all: Vec<Vec<Band>> = side.columns.iter().map(|own| bands(own.run)).collect();
    let is_told =
        |own: &&Band| side.columns.iter().any(|of| of.run.told().any(|told| told.key == own.key));
    let keys = each_once(all.iter().flatten().filter(is_told).map(|own| (&own.key, own.unit)));
    let row = |&(key, unit): &(&String, &'static str)| {
        let of = |own: &Vec<Band>| own.iter().find(|band| &band.key == key).cloned();
        let found: Vec<Option<Band>> = all.iter().map(of).collect();
        let kind = side.columns.iter().find_map(|own| own.run.measure(key));
        let rounding = ROUNDING * largest(side.columns.iter().map(|own| own.run), unit);
        let unit = unit_of(kind.map_or("", |own| own.kind), found.iter().flatten(), rounding);
        let cell = |own: &Option<Band>| {
            let [_, _, low, high] = own
                .as_ref()
                .map_or(["–"; 4].map(str::to_owned), |own| cells(own, &unit, rounding));
            let part = own.as_ref().filter(|own| (1..own.designs).contains(&own.without));
            let part = part.map_or(String::new(), |own| format!(" of {}", covered(own)));
            format!("{low} to {high}{part}")
        };
        let cells = found.iter().map(cell);
        [key.clone()].into_iter().chain(cells).chain([unit.symbol.clone()]).collect()
    };
    let names = side.columns.iter().map(|own| own.name.to_owned());
    let first = side.heading("95 % of its sample");
    let header = [first].into_iter().chain(names).chain(["unit".to_owned()]);
    let rows: Vec<Vec<String>> = keys.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new("Scatter", header, rows))
}

fn row(run: &RunReport, band: &Band) -> Vec<String> {
    let measure = run.measure(&band.key);
    let kind = measure.map_or("", |own| own.kind);
    // What the run cannot tell from zero, its designs cannot either.
    let zero = measure.filter(|own| is_zero(own)).and_then(|own| own.error);
    let largest = largest(std::iter::once(run), band.unit);
    let rounding = zero.unwrap_or(0.0).max(ROUNDING * largest);
    let unit = unit_of(kind, [band].into_iter(), rounding);
    let [mean, deviation, low, high] = cells(band, &unit, rounding);
    vec![band.key.clone(), mean, deviation, low, high, unit.symbol.clone()]
}

/// Which part of the designs a band covers.
fn covered(band: &Band) -> String {
    percent(band.share(), FEW + 1)
}

/// Mean, deviation and both ends of a band, without what rounding leaves of zero.
fn tidied(band: &Band, rounding: f64) -> [Option<f64>; 4] {
    let tidy = |own: f64| if own.abs() <= rounding { 0.0 } else { own };
    [band.mean, band.deviation, band.low, band.high].map(|own| own.map(tidy))
}

/// The unit in which bands of one measure are shown.
fn unit_of<'b>(kind: &str, bands: impl Iterator<Item = &'b Band> + Clone, rounding: f64) -> Unit {
    let si = bands.clone().next().map_or("1", |own| own.unit);
    let all = bands.flat_map(|own| tidied(own, rounding)).flatten();
    let largest = all.fold(0.0, |most: f64, own| most.max(own.abs()));
    unit_of_kind(kind, si).unwrap_or_else(|| Unit::suiting(largest, si))
}

/// Mean, deviation and both ends of a band as text; digits beyond the scatter tell nothing.
fn cells(band: &Band, unit: &Unit, rounding: f64) -> [String; 4] {
    let [mean, deviation, low, high] = tidied(band, rounding);
    let digits = |value: f64| numbers::digits(value, deviation.map(|own| 0.01 * own), MOST_DIGITS);
    let cell = |value: Option<f64>| {
        value.map_or_else(|| "–".to_owned(), |own| unit.number(own, digits(own).max(DIGITS)))
    };
    let deviation = deviation.map_or_else(|| "–".to_owned(), |own| unit.number(own, FEW));
    [cell(mean), deviation, cell(low), cell(high)]
}
