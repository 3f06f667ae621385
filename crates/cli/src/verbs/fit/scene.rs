//! Numbers of a scene, fitted to curves that were measured on it.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_analysis::{Cause, Misses, Solve as _, Unevaluated};
use dashpot_fit::network::{
    Band, Kind, Known, NetworkFault, NetworkFit, NetworkSettings, Number, Profile, Search, Test,
    fit_watched,
};
use dashpot_scene::{Posed, ScatteredNumber, Scene, Tunables, Variation};

use super::{
    FitArguments,
    among::{Among, Replaced, chosen},
    asked::{Asked, FLAG},
    check_tests, is_on,
    shown::{Shown, shown},
    solver::{Poser, Solver},
    target::{Target, check_alone, targets},
    watched::Progress,
};
use crate::{
    error::{CliError, StudyError},
    input::{Input, bare_numbers, setting},
    operand::{print_notes, read_scene_of},
    out::SceneText,
    output::list,
    terminal::{Terminal, note},
    varied::{Varied, unvaried},
};

/// Digits of fitted numbers in a scene.
const DIGITS: usize = 5;
/// What was measured of a number of a test is not left by more standard deviations, nor by this factor.
const FARTHEST: f64 = 8.0;
const FACTOR: f64 = 4.0;

/// A measure of the fitted scene: its key, its SI unit, and what the uncertainty of the numbers makes of it.
pub(super) struct Measured {
    pub(super) key: String,
    pub(super) unit: &'static str,
    pub(super) band: Band,
}

/// A scene that was fitted.
pub(super) struct FittedScene<'p> {
    pub(super) plan: Plan<'p>,
    /// The numbers, with the constants of a form.
    pub(super) numbers: Vec<Varied>,
    pub(super) shown: Vec<Shown>,
    pub(super) measures: Vec<Measured>,
    pub(super) fit: NetworkFit,
    /// What could not be evaluated on the way: the numbers there, those of the test behind them, and why.
    pub(super) missing: Vec<(Vec<f64>, Cause)>,
    pub(super) unevaluated: Unevaluated,
    /// Among which forms of a model this one was chosen.
    pub(super) among: Option<Among>,
    replaced: Option<Replaced>,
    /// The network with what was found, where it can be solved.
    pub(super) fitted: Option<Posed>,
    /// What the command line sets.
    set: Vec<(String, String)>,
}

/// What is fitted to what.
pub(super) struct Plan<'p> {
    pub(super) arguments: &'p FitArguments,
    pub(super) input: &'p Input,
    terminal: Terminal,
    pub(super) scene: Scene,
    pub(super) tunables: Tunables,
    numbers: Vec<Varied>,
    pub(super) curves: Vec<(Asked, Target)>,
    /// For each test its numbers that were measured besides.
    pub(super) known: Vec<Vec<Varied>>,
    pub(super) tests: Vec<Test>,
    evaluated: Evaluated,
}

/// What a search evaluates.
#[derive(Default)]
struct Evaluated {
    count: AtomicUsize,
    misses: Misses,
}

/// Fits numbers of a scene, or the constants of the form of a model that the tests speak for.
pub(super) fn fitted<'p>(
    arguments: &'p FitArguments,
    input: &'p Input,
    terminal: Terminal,
) -> Result<FittedScene<'p>, CliError> {
    let plan = Plan::read(arguments, input, terminal)?;
    if let Some(asked) = &arguments.among {
        return chosen(plan, asked);
    }
    let fit = plan.fit(None, plan.profile())?;
    plan.finished(None, fit, None)
}

impl<'p> Plan<'p> {
    fn read(
        arguments: &'p FitArguments,
        input: &'p Input,
        terminal: Terminal,
    ) -> Result<Self, CliError> {
        let set = &arguments.values.set;
        let scene = read_scene_of(input, set, terminal)?;
        if arguments.scatter && scene.scatter.iter().any(|own| own.is_together) {
            let reason = "the scene has a section `[scatter]` already: leave that out".to_owned();
            return Err(StudyError::WrongSetting { name: "--scatter".to_owned(), reason }.into());
        }
        let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(StudyError::Scene)?;
        let numbers = numbers(arguments, &tunables)?;
        let mut curves: Vec<(Asked, Target)> = Vec::new();
        for asked in &arguments.to {
            asked.check(&tunables)?;
            let all = targets(asked, arguments.until, &scene.assembly)?.into_iter();
            curves.extend(all.map(|own| (asked.clone(), own)));
        }
        curves.iter().filter_map(|own| own.1.note.as_deref()).for_each(note);
        let own = curves.iter().map(|own| own_numbers(&own.0, &tunables));
        let own = own.collect::<Result<Vec<_>, _>>()?;
        let tests = curves.iter().zip(&own);
        let tests = tests.map(|((asked, curve), own)| test(arguments, asked, curve, own));
        let mut tests = tests.collect::<Result<Vec<Test>, _>>()?;
        let any = |is_one: fn(&Test) -> bool| tests.iter().any(is_one);
        let is_timed =
            |own: &(Asked, Target)| own.0.rate.is_none() && !own.1.output.is_oscillation();
        check_tests([
            ("--until", arguments.until.is_some(), curves.iter().any(is_timed)),
            ("--shift", arguments.shift.is_some(), any(|own| own.kind != Kind::Modulus)),
            ("--offset", arguments.offset.is_some(), any(|own| own.kind != Kind::Modulus)),
            ("--cfc", arguments.cfc.is_some(), any(|own| own.filter.is_some())),
        ])?;
        // The same test as far as anybody has said.
        let said = |own: &(Asked, Target)| (own.0.what().to_owned(), own.1.output.key());
        for (at, test) in tests.iter_mut().enumerate() {
            let first = curves.iter().position(|own| said(own) == said(&curves[at]));
            let is_more = curves.iter().filter(|own| said(own) == said(&curves[at])).count() > 1;
            test.repeated = first.filter(|_| is_more);
        }
        let known = own.into_iter().map(|own| list(own.into_iter().map(|own| own.0)));
        let known = list(known);
        print_notes(&scene.notes);
        if scene.accuracy.neglect_below.is_some() {
            note(
                "fits leave nothing out: `neglect-below` of the scene does not apply to their runs",
            );
        }
        let evaluated = Evaluated::default();
        Ok(Self {
            arguments,
            input,
            terminal,
            scene,
            tunables,
            numbers,
            curves,
            known,
            tests,
            evaluated,
        })
    }

    /// What poses the scene of each test, with a form in the place of a model of it.
    fn posers<'s>(&'s self, replaced: Option<&'s Replaced>) -> Vec<Poser<'s>> {
        let set = &self.arguments.values.set;
        let constants = || replaced.into_iter().flat_map(|own| &own.constants);
        let each = self.curves.iter().zip(&self.known).map(|((asked, _), known)| Poser {
            input: self.input,
            tunables: &self.tunables,
            numbers: list(self.numbers.iter().chain(constants()).chain(known)),
            replaced,
            set: [unvaried(set, &self.numbers, &self.tunables), asked.plain(known)].concat(),
        });
        list(each)
    }

    /// Which intervals are asked for.
    pub(super) fn profile(&self) -> Profile {
        if self.arguments.profile { Profile::Always } else { Profile::WhereNeeded }
    }

    /// Fits the numbers, and the constants of a form.
    pub(super) fn fit(
        &self,
        replaced: Option<&Replaced>,
        profile: Profile,
    ) -> Result<NetworkFit, CliError> {
        let posers = self.posers(replaced);
        let begin = |own: &Varied| {
            let [low, high] = own.bounds;
            let is_between = (low..=high).contains(&own.start);
            Number { low, high, start: if is_between { own.start } else { (low * high).sqrt() } }
        };
        let constants = replaced.into_iter().flat_map(|own| &own.constants);
        let begun: Vec<Number> = list(self.numbers.iter().chain(constants).map(begin));
        for (at, (asked, target)) in self.curves.iter().enumerate() {
            let own = begun.iter().map(|own| own.start);
            let own: Vec<f64> = list(own.chain(self.known[at].iter().map(|own| own.start)));
            check_alone(asked, &target.output, &posers[at], &own)?;
            posers[at].posed(&own).map_err(|reason| asked.wrong(reason))?;
        }
        let settings = NetworkSettings {
            starts: self.arguments.starts(),
            seed: self.arguments.seed(),
            is_robust: is_on(self.arguments.robust),
            profile,
        };
        let progress = Progress::new(self.tests.len(), self.terminal);
        let of = (&posers[..], &self.curves[..]);
        let fit = searched((&begun, &self.tests), settings, of, (&progress, &self.evaluated));
        fit.map_err(|fault| wrong(&fault, &self.curves))
    }

    /// What there is to say of a fit.
    pub(super) fn finished(
        self,
        replaced: Option<Replaced>,
        mut fit: NetworkFit,
        among: Option<Among>,
    ) -> Result<FittedScene<'p>, CliError> {
        let constants = replaced.iter().flat_map(|own| &own.constants);
        let numbers: Vec<Varied> = list(self.numbers.iter().chain(constants).cloned());
        let posers = self.posers(replaced.as_ref());
        let fault = |reason| CliError::Fit { text: "scene".to_owned(), reason };
        let means: Vec<f64> = list(self.tests[0].known.iter().map(|own| own.mean));
        let network = |values: &[f64]| {
            posers[0].posed(&[values, &means].concat()).map(|own| own.network).map_err(fault)
        };
        let shown = shown(&fit, &numbers, &network)?;
        // What no test tells apart has no intervals, whatever rounding makes of them.
        let is_shown = |own: &Varied| shown.iter().any(|other| other.numbers.contains(&own.name));
        let each = numbers.iter().zip(&mut fit.numbers).filter(|own| is_shown(own.0));
        each.for_each(|own| own.1.ends = [None; 2]);
        let whole = Poser {
            input: self.input,
            tunables: &self.tunables,
            numbers: list(&numbers),
            replaced: replaced.as_ref(),
            set: self.arguments.values.set.clone(),
        };
        let measures = if fit.is_converged() { measures(&whole, &fit) } else { Vec::new() };
        let found: Vec<f64> = list(fit.numbers.iter().map(|own| own.value));
        let fitted = whole.posed(&found).ok();
        let set = unvaried(&self.arguments.values.set, &self.numbers, &self.tunables);
        let Evaluated { count, misses } = &self.evaluated;
        let (missing, unevaluated) = (misses.all(), misses.told(count.load(Ordering::Relaxed)));
        drop(posers);
        Ok(FittedScene {
            plan: self,
            numbers,
            shown,
            measures,
            fit,
            missing,
            unevaluated,
            among,
            replaced,
            fitted,
            set,
        })
    }
}

/// Searches the numbers, in the quickest way to the curve of each test that gives what a run does which is judged, at what
/// was found as well.
fn searched(
    (begun, tests): (&[Number], &[Test]),
    settings: NetworkSettings,
    (posers, curves): (&[Poser<'_>], &[(Asked, Target)]),
    (progress, evaluated): (&Progress, &Evaluated),
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
    let model = |test: usize, values: &[f64]| {
        evaluated.count.fetch_add(1, Ordering::Relaxed);
        let missed =
            |why: &String| evaluated.misses.note(values.to_vec(), Cause::scene(why.clone()));
        solvers[test].curve(values).inspect_err(missed)
    };
    loop {
        // A further search counts its own runs.
        let before = evaluated.count.load(Ordering::Relaxed);
        let watch =
            |own: Search| progress.show(own, evaluated.count.load(Ordering::Relaxed) - before);
        let found = fit_watched(begun, tests, settings, &model, &watch)?;
        let is_alike = |(at, own): (usize, &Solver<'_>)| {
            let values = found.numbers.iter().map(|own| own.value);
            let values: Vec<f64> = list(values.chain(found.tests[at].known.iter().copied()));
            own.agrees(&values)
        };
        // All are asked: each that does not agree goes on in a slower way.
        let each = solvers.iter().enumerate().filter(|_| !found.is_stopped);
        if each.filter(|own| !is_alike(*own)).count() == 0 {
            return Ok(found);
        }
    }
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

/// What is set for a test alone with a standard deviation.
fn own_numbers(asked: &Asked, tunables: &Tunables) -> Result<Vec<(Varied, Known)>, CliError> {
    let wrong = |reason: String| asked.wrong(reason);
    let mut numbers = Vec::new();
    for (name, value) in asked.scattered() {
        let at = tunables.find(name);
        let at = at.map_err(|fault| CliError::Tunable { flag: FLAG, fault })?;
        let text = tunables.text_with(&[(at, value.clone())]);
        let all = ScatteredNumber::all(&text, None).map_err(StudyError::Scene)?;
        let own = all.into_iter().find(|own| own.path == tunables.all()[at].path);
        let own = own.ok_or_else(|| wrong(format!("`{value}` has no standard deviation")))?;
        if own.mean <= 0.0 || own.dimension != tunables.all()[at].dimension {
            let reason = format!(
                "`{name}` with a standard deviation wants a value above zero, as in the scene"
            );
            return Err(wrong(reason));
        }
        let known = Known { mean: own.mean, deviation: own.deviation };
        let number = Varied::of(tunables, (name, at), around(&known), ("", own.dimension));
        numbers.push((Varied { start: known.mean, ..number }, known));
    }
    Ok(numbers)
}

/// A test: its rows, and what the command line tells of how they were recorded.
fn test(
    arguments: &FitArguments,
    asked: &Asked,
    curve: &Target,
    own: &[(Varied, Known)],
) -> Result<Test, CliError> {
    let noise = asked.noise.as_ref().or(arguments.noise.as_ref());
    let noise = noise.map(|text| setting("--noise", text, curve.output.dimension())).transpose()?;
    if noise.is_some_and(|own| own.is_nan() || own <= 0.0) {
        return Err(asked.wrong("noise is a standard deviation above zero"));
    }
    let kind = curve.output.kind();
    if asked.cfc.is_some() && kind != Kind::Blow {
        return Err(asked.wrong("a class is that of a record of a run, not of a model alone"));
    }
    let cfc = asked.cfc.or(arguments.cfc).filter(|_| kind == Kind::Blow);
    // A motion at a stated rate has no clock.
    let is_shifted = is_on(arguments.shift) && kind != Kind::Modulus && asked.rate.is_none();
    Ok(Test {
        rows: curve.rows.clone(),
        kind,
        is_shifted,
        is_offset: is_on(arguments.offset) && kind != Kind::Modulus,
        gain: asked.gain.or(arguments.gain),
        filter: cfc.map(|own| (own, arguments.padding())),
        noise,
        repeated: None,
        known: list(own.iter().map(|own| own.1)),
    })
}

fn wrong(fault: &NetworkFault, curves: &[(Asked, Target)]) -> CliError {
    match fault {
        NetworkFault::Nothing { test } => curves[*test].0.wrong("its values are zero throughout"),
        NetworkFault::Filter { test, fault } => curves[*test].0.wrong(fault.to_string()),
        _ => curves[0].0.wrong(fault.to_string()),
    }
}

/// The numbers that the command line names, with their bounds.
fn numbers(arguments: &FitArguments, tunables: &Tunables) -> Result<Vec<Varied>, CliError> {
    let wanted = |name: &str| {
        let unit = tunables.find(name).map_or("kN/m", |at| &*tunables.all()[at].unit);
        let reason =
            format!("`{name}` wants bounds above zero, such as \"{name}=10..1000 {unit}\"");
        StudyError::WrongSetting { name: "--vary".to_owned(), reason }
    };
    let is_range = |own: &&String| {
        own.split_once('=').is_some_and(|own| own.1.contains("..") && !own.1.contains(','))
    };
    if let Some(own) = arguments.vary.iter().find(|own| !is_range(own)) {
        return Err(wanted(own.split('=').next().unwrap_or(own).trim()).into());
    }
    let parsed = arguments.vary.iter().map(|own| Variation::parse(own));
    let mut variations = parsed.collect::<Result<Vec<_>, _>>()?;
    let flag = "--vary";
    let matched = tunables.matched(&mut variations, bare_numbers());
    let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
    let varied = variations.iter().zip(matched).map(|(own, at)| {
        let bounds = [own.values[0], own.values[own.len() - 1]];
        let is_range = bounds[0] > 0.0 && bounds[0] < bounds[1];
        if own.is_of_words() || !is_range {
            return Err(wanted(&own.name).into());
        }
        Ok(Varied::of(tunables, (&own.name, at), bounds, (&own.unit, own.dimension)))
    });
    varied.collect()
}

impl FittedScene<'_> {
    /// A text of the scene as it is written.
    pub(super) fn written<'t>(&'t self, text: &'t str) -> SceneText<'t> {
        SceneText {
            text,
            file: self.plan.scene.file.as_deref().unwrap_or_default(),
            set: &self.set,
        }
    }

    /// The text of the scene with the numbers that were found, below lines on where they are from.
    pub(super) fn scene_text(&self, comments: &[String]) -> String {
        let rounded = |own: f64| format!("{:.*e}", DIGITS - 1, own).parse().unwrap_or(f64::NAN);
        let each = || self.numbers.iter().zip(&self.fit.numbers);
        let texts = each().filter_map(|(own, found)| {
            let number: f64 = rounded(found.value / own.one);
            Some((own.at?, format!("{number} {}", own.unit).trim_end().to_owned()))
        });
        let text = self.plan.tunables.text_with(&list(texts));
        let constants = each().filter(|own| own.0.at.is_none());
        let constants: Vec<f64> = list(constants.map(|own| rounded(own.1.value)));
        let comment = "in place of what was fitted worse or with more numbers";
        let replaced = self.replaced.as_ref().map(|own| own.text(&text, &constants, comment));
        let text = replaced.and_then(Result::ok).unwrap_or(text);
        let lines: Vec<String> = list(comments.iter().map(|own| format!("# {own}\n")));
        let scatter = self.plan.arguments.scatter.then(|| self.scatter().ok()).flatten();
        lines.concat() + &text + &scatter.unwrap_or_default()
    }
}
