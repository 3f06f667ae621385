//! Numbers of a scene, fitted to curves that were measured on it.

use dashpot_analysis::Solve as _;
use dashpot_fit::network::{
    Band, Known, NetworkFault, NetworkFit, NetworkSettings, Number, Search, Test, fit_watched,
};
use dashpot_scene::{
    Posed, ScatteredNumber, Scene, Tunables, Variation, read,
    units::{parse_quantity, si_unit},
};

use super::{
    FitArguments,
    asked::{Asked, FLAG},
    shown::{Shown, shown},
    solver::{Poser, Solver},
    watched::Progress,
};
use crate::{
    args::Switch,
    error::CliError,
    input::{Input, setting},
    operand::print_notes,
    output::list,
    terminal::{Terminal, note},
    verbs::run::beside::MeasuredCurve,
};

/// Digits of fitted numbers in a scene.
const DIGITS: usize = 5;
/// What was measured of a number of a test is not left by more standard deviations, nor by this factor.
const FARTHEST: f64 = 8.0;
const FACTOR: f64 = 4.0;

/// A number that was fitted.
pub(super) struct Varied {
    pub(super) name: String,
    /// Its unit in the scene, or that of the command line; empty where it has none.
    pub(super) unit: String,
    /// What one of that is in SI units.
    pub(super) one: f64,
    /// Its SI unit.
    pub(super) si: String,
    pub(super) bounds: [f64; 2],
    pub(super) at: usize,
}

/// A measure of the fitted scene: its key, its SI unit, and what the uncertainty of the numbers makes of it.
pub(super) struct Measured {
    pub(super) key: String,
    pub(super) unit: &'static str,
    pub(super) band: Band,
}

/// A scene that was fitted.
pub(super) struct FittedScene {
    pub(super) scene: Scene,
    pub(super) numbers: Vec<Varied>,
    pub(super) curves: Vec<(Asked, MeasuredCurve)>,
    /// For each test its numbers that were measured besides.
    pub(super) known: Vec<Vec<Varied>>,
    pub(super) tests: Vec<Test>,
    pub(super) shown: Vec<Shown>,
    pub(super) measures: Vec<Measured>,
    pub(super) fit: NetworkFit,
    /// The network with what was found, where it can be solved.
    pub(super) fitted: Option<Posed>,
    /// What the command line asks for, in words.
    pub(super) asked: Vec<(&'static str, String)>,
    tunables: Tunables,
}

/// Fits numbers of a scene.
pub(super) fn fitted(
    arguments: &FitArguments,
    input: &Input,
    terminal: Terminal,
) -> Result<FittedScene, CliError> {
    let set = &arguments.values.set;
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    print_notes(&scene.notes);
    let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(CliError::Scene)?;
    let numbers = numbers(arguments, &tunables)?;
    let read = |own: &Asked| MeasuredCurve::read((FLAG, &own.measured_as()), 0.0, &scene.assembly);
    let curves = arguments.to.iter().map(|own| Ok((own.clone(), read(own)?)));
    let curves = curves.collect::<Result<Vec<_>, CliError>>()?;
    curves.iter().filter_map(|own| own.1.note.as_deref()).for_each(note);
    let own = curves.iter().map(|own| own_numbers(&own.0, &tunables));
    let own = own.collect::<Result<Vec<_>, _>>()?;
    let tests = curves.iter().zip(&own);
    let tests = tests.map(|((asked, curve), own)| test(arguments, asked, curve, own));
    let tests = tests.collect::<Result<Vec<Test>, _>>()?;
    let known: Vec<Vec<Varied>> =
        list(own.into_iter().map(|own| list(own.numbers.into_iter().map(|own| own.0))));
    let posers = curves.iter().zip(&known).map(|((asked, _), known)| Poser {
        input,
        tunables: &tunables,
        numbers: list(numbers.iter().chain(known)),
        set: [unvaried(set, &numbers, &tunables), asked.plain(known)].concat(),
    });
    let posers: Vec<Poser<'_>> = list(posers);
    let begin = |own: &Varied| {
        let [low, high] = own.bounds;
        let start = tunables.all()[own.at].value;
        let is_between = (low..=high).contains(&start);
        Number { low, high, start: if is_between { start } else { (low * high).sqrt() } }
    };
    let begun: Vec<Number> = list(numbers.iter().map(begin));
    let settings = NetworkSettings {
        starts: arguments.starts,
        seed: arguments.seed,
        is_robust: arguments.robust == Switch::On,
        is_profiled: arguments.profile,
    };
    let progress = Progress::new(tests.len(), terminal);
    let fit = searched((&begun, &tests), settings, (&posers, &curves), &progress);
    let mut fit = fit.map_err(|fault| wrong(&fault, &curves))?;
    let fault = |reason| CliError::Fit { text: "scene".to_owned(), reason };
    let means: Vec<f64> = list(tests[0].known.iter().map(|own| own.mean));
    let network = |values: &[f64]| {
        posers[0].posed(&[values, &means].concat()).map(|own| own.network).map_err(fault)
    };
    let shown = shown(&fit, &numbers, &network)?;
    // What no test tells apart has no intervals, whatever rounding makes of them.
    let is_shown = |own: &Varied| shown.iter().any(|other| other.numbers.contains(&own.name));
    let each = numbers.iter().zip(&mut fit.numbers).filter(|own| is_shown(own.0));
    each.for_each(|own| own.1.ends = [None; 2]);
    let whole = Poser { input, tunables: &tunables, numbers: list(&numbers), set: set.clone() };
    let measures = if fit.is_stopped { Vec::new() } else { measures(&whole, &fit) };
    let found: Vec<f64> = list(fit.numbers.iter().map(|own| own.value));
    let fitted = whole.posed(&found).ok();
    let asked = arguments.in_words();
    drop(posers);
    Ok(FittedScene {
        scene,
        numbers,
        curves,
        known,
        tests,
        shown,
        measures,
        fit,
        fitted,
        asked,
        tunables,
    })
}

/// What is set but for numbers that are fitted: it would stand above what is written into the text.
fn unvaried(
    set: &[(String, String)],
    numbers: &[Varied],
    tunables: &Tunables,
) -> Vec<(String, String)> {
    let is_varied =
        |name: &str| tunables.find(name).is_ok_and(|at| numbers.iter().any(|own| own.at == at));
    list(set.iter().filter(|own| !is_varied(&own.0)).cloned())
}

/// Searches the numbers: with one compiled form of each test where full runs agree with it at what was found.
fn searched(
    (begun, tests): (&[Number], &[Test]),
    settings: NetworkSettings,
    (posers, curves): (&[Poser<'_>], &[(Asked, MeasuredCurve)]),
    progress: &Progress,
) -> Result<NetworkFit, NetworkFault> {
    let point = |own: &'_ Poser<'_>, values: &[f64]| own.point(values);
    let points = posers.iter().map(|own| move |values: &[f64]| point(own, values));
    let points: Vec<_> = list(points);
    let each = posers.iter().zip(&points).zip(curves).zip(tests);
    let solvers = each.map(|(((poser, point), (_, curve)), test)| {
        let starts = begun.iter().map(|own| own.start).chain(test.known.iter().map(|own| own.mean));
        let bounds = begun.iter().map(|own| [own.low, own.high]);
        let bounds = bounds.chain(test.known.iter().map(around));
        let (starts, bounds): (Vec<f64>, Vec<[f64; 2]>) = (list(starts), list(bounds));
        Solver::new(poser, point, &curve.output, &starts, &bounds)
    });
    let solvers: Vec<Solver<'_>> = list(solvers);
    let model = |test: usize, values: &[f64]| solvers[test].curve(values);
    let watch = |own: Search| progress.show(own);
    let found = fit_watched(begun, tests, settings, &model, &watch)?;
    if found.is_stopped {
        return Ok(found);
    }
    let is_alike = |(at, own): (usize, &Solver<'_>)| {
        let values = found.numbers.iter().map(|own| own.value);
        let values: Vec<f64> = list(values.chain(found.tests[at].known.iter().copied()));
        own.agrees(&values)
    };
    // All are asked: each that does not agree goes on with full runs.
    let unlike = solvers.iter().enumerate().filter(|own| !is_alike(*own)).count();
    if unlike == 0 { Ok(found) } else { fit_watched(begun, tests, settings, &model, &watch) }
}

/// Within which values a number that was measured besides is looked for.
fn around(own: &Known) -> [f64; 2] {
    let [low, high] = [-1.0, 1.0].map(|sign| own.mean + sign * FARTHEST * own.deviation);
    [low.max(own.mean / FACTOR), high]
}

/// The measures of the fitted scene with their bands; none where it cannot be solved.
fn measures(poser: &Poser<'_>, fit: &NetworkFit) -> Vec<Measured> {
    let run = |values: &[f64]| {
        let point = poser.point(values).ok()?;
        point.network.solve_with(&point.settings).ok()
    };
    let values: Vec<f64> = list(fit.numbers.iter().map(|own| own.value));
    let Some(first) = run(&values) else { return Vec::new() };
    let read = |values: &[f64]| {
        let run = run(values)?;
        let value = |key: &str| run.measure(key).and_then(|own| own.value);
        Some(list(first.measures.iter().map(|own| value(&own.key))))
    };
    let bands = fit.bands(&read).unwrap_or_default();
    let each = first.measures.iter().zip(bands);
    let each = each.filter_map(|(own, band)| {
        Some(Measured { key: own.key.clone(), unit: own.unit, band: band? })
    });
    each.collect()
}

/// Numbers of a test that were measured besides.
struct OwnNumbers {
    numbers: Vec<(Varied, Known)>,
}

/// What is set for a test alone with a standard deviation.
fn own_numbers(asked: &Asked, tunables: &Tunables) -> Result<OwnNumbers, CliError> {
    let wrong = |reason: String| CliError::Fit { text: asked.text.clone(), reason };
    let mut numbers = Vec::new();
    for (name, value) in asked.scattered() {
        let at = tunables.find(name);
        let at = at.map_err(|fault| CliError::Tunable { flag: FLAG, fault })?;
        let text = tunables.text_with(&[(at, value.clone())]);
        let all = ScatteredNumber::all(&text, None).map_err(CliError::Scene)?;
        let own = all.into_iter().find(|own| own.path == tunables.all()[at].path);
        let own = own.ok_or_else(|| wrong(format!("`{value}` has no standard deviation")))?;
        if own.mean <= 0.0 || own.dimension != tunables.all()[at].dimension {
            let reason = format!(
                "`{name}` with a standard deviation wants a value above zero, as in the scene"
            );
            return Err(wrong(reason));
        }
        let si = own.dimension.map_or(String::new(), si_unit);
        let unit = tunables.all()[at].unit.clone();
        let one = parse_quantity(&format!("1 {unit}"));
        let one = one.map_or(1.0, |one| own.dimension.map_or(one, |to| one.meant(to)).value);
        let known = Known { mean: own.mean, deviation: own.deviation };
        let bounds = around(&known);
        numbers.push((Varied { name: name.clone(), unit, one, si, bounds, at }, known));
    }
    Ok(OwnNumbers { numbers })
}

/// A test: its rows, and what the command line tells of how they were recorded.
fn test(
    arguments: &FitArguments,
    asked: &Asked,
    curve: &MeasuredCurve,
    own: &OwnNumbers,
) -> Result<Test, CliError> {
    let noise = asked.noise.as_ref().or(arguments.noise.as_ref());
    let noise = noise.map(|text| setting("--noise", text, curve.output.dimension())).transpose()?;
    if noise.is_some_and(|own| own.is_nan() || own <= 0.0) {
        let reason = "noise is a standard deviation above zero".to_owned();
        return Err(CliError::Fit { text: asked.text.clone(), reason });
    }
    let cfc = asked.cfc.or(arguments.cfc);
    Ok(Test {
        rows: curve.rows.clone(),
        is_shifted: arguments.shift == Switch::On,
        is_offset: arguments.offset == Switch::On,
        gain: asked.gain.or(arguments.gain),
        filter: cfc.map(|own| (own, arguments.padding())),
        noise,
        known: list(own.numbers.iter().map(|own| own.1)),
    })
}

fn wrong(fault: &NetworkFault, curves: &[(Asked, MeasuredCurve)]) -> CliError {
    let (text, reason) = match fault {
        NetworkFault::Nothing { test } => {
            (&curves[*test].0.text, "its values are zero throughout".to_owned())
        }
        NetworkFault::Filter { test, fault } => (&curves[*test].0.text, fault.to_string()),
        _ => (&curves[0].0.text, fault.to_string()),
    };
    CliError::Fit { text: text.clone(), reason }
}

/// The numbers that the command line names, with their bounds.
fn numbers(arguments: &FitArguments, tunables: &Tunables) -> Result<Vec<Varied>, CliError> {
    let parsed = arguments.vary.iter().map(|own| Variation::parse(own));
    let mut variations = parsed.collect::<Result<Vec<_>, _>>()?;
    let flag = "--vary";
    let matched = tunables.matched(&mut variations);
    let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
    let varied = variations.iter().zip(matched).map(|(own, at)| {
        let bounds = [own.values[0], own.values[own.len() - 1]];
        let is_range = bounds[0] > 0.0 && bounds[0] < bounds[1];
        if own.is_of_words() || !is_range {
            let reason =
                format!("`{0}` wants bounds above zero, such as \"{0}=10..1000 kN/m\"", own.name);
            return Err(CliError::WrongSetting { name: "--vary".to_owned(), reason });
        }
        let number = &tunables.all()[at];
        let unit = if number.unit.is_empty() { &own.unit } else { &number.unit };
        let one = parse_quantity(&format!("1 {unit}"));
        let one = one.map_or(1.0, |own| number.dimension.map_or(own, |to| own.meant(to)).value);
        let dimension = number.dimension.or(own.dimension);
        let si = dimension.map_or(String::new(), si_unit);
        Ok(Varied { name: own.name.clone(), unit: unit.clone(), one, si, bounds, at })
    });
    varied.collect()
}

impl FittedScene {
    /// The text of the scene with the numbers that were found, below lines on where they are from.
    pub(super) fn scene_text(&self, comments: &[String]) -> String {
        let texts = self.numbers.iter().zip(&self.fit.numbers).map(|(own, found)| {
            let number: f64 =
                format!("{:.*e}", DIGITS - 1, found.value / own.one).parse().unwrap_or(f64::NAN);
            (own.at, format!("{number} {}", own.unit).trim_end().to_owned())
        });
        let text = self.tunables.text_with(&list(texts));
        let lines: Vec<String> = list(comments.iter().map(|own| format!("# {own}\n")));
        lines.concat() + &text
    }
}
