//! `dashpot design`.

mod among;
mod answer;
mod asked;
mod figures;
mod files;
mod front;
mod posing;
mod scenes;
mod tables;
mod total;
mod words;

use std::{
    num::NonZero,
    sync::{Mutex, atomic::AtomicUsize},
    thread::available_parallelism,
};

use clap::Args;
use dashpot_analysis::{
    Judgement, Odds, RunReport,
    sweep::{PoseAt, columns},
};
use dashpot_design::optimum::{
    Design, DesignError, Effort, Problem, Scattered, design as search, robust,
};
use dashpot_scene::{Tunables, with_limits};

use self::{
    among::Choice,
    answer::{Answer, Found},
    asked::{Asked, Least},
    posing::Posing,
    scenes::{Test, TestArgument, TestScene},
};
use super::run::{
    FloorTold,
    scatter::{self, ScatterArguments},
};
use crate::{
    args::{LimitArguments, NO_SCATTER, SceneArguments, method_names, probability, refuse},
    counts::{DESIGNS, FRONT_POINTS, SCATTERED_SCENES},
    error::{CliError, Status, StudyError},
    host,
    operand::read_scene_of,
    out::OutArguments,
    output::{emit, list},
    progress::Bar,
    section::Verb,
    terminal::{Terminal, note},
};

/// `[design]` of a scene.
pub(super) const SECTION: Verb = Verb { name: "design", files: &[("test", scenes::file_at)] };

/// `design`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot design helmet.toml --vary \"liner.thickness=10..50 mm\" \
    --least liner.thickness --limit \"head.peak-acceleration<=250 g\"\n  \
    dashpot design pad.toml --vary \"K=5..500 kN/m\" --vary \"C=0.1..10 kN s/m\" \
    --least head.hic15\n  \
    dashpot design helmet.toml --vary \"T=10..50 mm\" --vary liner.material=eps,epp \
    --least T --test \"flat: drop=1.5 m\" --test \"kerb: drop=1.1 m, head.mass=6 kg\"\n  \
    dashpot design pad.toml --vary \"pad.thickness=10..60 mm\" --least pad.thickness \
    --test hot.toml --test \"cold: cold.toml, head.mass=6 kg\"\n  \
    dashpot design helmet.toml --vary \"T=10..50 mm\" --least T --and head.peak-acceleration --out front\n  \
    dashpot design stack.toml --vary \"front.thickness=2..28 mm\" --vary \"back.thickness=2..28 mm\" \
    --total \"front.thickness+back.thickness=30 mm\" --vary \"front.material,back.material=soft,hard\" \
    --least head.peak-acceleration\n  \
    dashpot design helmet.toml --solve-for liner.thickness --robust 95%\n\n\
    A range is searched between its ends; a list, a range with a count, and words such as those \
    of materials are tried one by one. Limits are those of the scene and of `--limit`; they have \
    to be kept in every test, and no pad is pressed by more than its thickness. The section `[design]` \
    of a scene sets options by their names; those of the command stand above them.")]
pub(crate) struct DesignArguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// A number of the scene and its bounds, or a number or word and what it may be; several words with what each of them
    /// takes another of, in all orders, "front.material,back.material=soft,hard"; repeatable.
    #[arg(long, value_name = "NAME=VALUES")]
    vary: Vec<String>,
    /// Numbers that vary and have a given sum, such as layers under one thickness,
    /// "front.thickness+back.thickness=30 mm"; repeatable.
    #[arg(long, value_name = "NAME+NAME=SUM", conflicts_with = "solve_for")]
    total: Vec<String>,
    /// What is made least: one of the numbers that vary, or a measure such as head.peak-acceleration, the largest of
    /// all tests [default: what `--solve-for` names].
    #[arg(long, value_name = "NAME")]
    least: Option<String>,
    /// What is made least besides: the front of both, along which less of one takes more of the other.
    #[arg(long, value_name = "NAME", requires = "least")]
    and: Option<String>,
    /// Points of that front.
    #[arg(long, value_name = "NUMBER", value_parser = FRONT_POINTS.read(), default_value_t = 9)]
    points: usize,
    /// The least value of this number that keeps the limits, between a tenth and ten times what the scene has; stands
    /// for `--vary` and `--least`.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["vary", "least"])]
    solve_for: Option<String>,
    /// A test in which all limits have to be kept: values of the scene as `--set` takes them, with a name of its own
    /// "kerb: drop=1.1 m", or another scene with its own limits and whatever is sought by the same names,
    /// "cold: drop-cold.toml"; repeatable [default: the scene as it is].
    #[arg(long, value_name = "[NAME:] KEY=VALUE,… or SCENE", value_parser = scenes::test)]
    test: Vec<TestArgument>,
    /// Everything is kept with this probability, where numbers of the scene have scatter, such as "20 ± 2 MN/m".
    #[arg(long, value_name = "PROBABILITY", value_parser = probability, conflicts_with = "and")]
    robust: Option<f64>,
    /// So many scattered designs are drawn around what was found.
    #[arg(long, value_name = "NUMBER", value_parser = SCATTERED_SCENES.read(), default_value_t = 500)]
    scatter: usize,
    /// Which of them are drawn; the same number gives the same ones.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// Exits with 4 unless everything is kept, however the errors lie.
    #[arg(long)]
    enforce: bool,
    /// Method for all runs [default: the scene's, if it names one, else auto].
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    method: Option<String>,
    /// Designs that are spread over the bounds before the search: a grid for one or two numbers, a Latin hypercube for
    /// more.
    #[arg(long, value_name = "NUMBER", value_parser = DESIGNS.read(), default_value_t = 400)]
    sample: usize,
    #[command(flatten)]
    out: OutArguments,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

impl DesignArguments {
    /// Whether it is said what varies, and what is made least.
    fn check(&self) -> Result<(), CliError> {
        let (name, reason) = match self {
            Self { solve_for: Some(_), .. } => return Ok(()),
            _ if self.vary.is_empty() => {
                ("--vary", "say what may vary, as in \"liner.thickness=10..60 mm\"")
            }
            Self { least: None, .. } => {
                ("--least", "say what is made least: one of what varies, or a measure")
            }
            _ => return Ok(()),
        };
        Err(CliError::setting(name, reason))
    }

    fn effort(&self) -> Effort {
        let threads = available_parallelism().map_or(1, NonZero::get);
        Effort { designs: self.sample.max(2), threads, ..Effort::default() }
    }
}

pub(crate) fn design(arguments: &DesignArguments, terminal: Terminal) -> Result<Status, CliError> {
    let input = crate::input::of(arguments.scene.scene.as_deref())?;
    let merged = SECTION.merged(&input)?;
    let arguments = merged.as_ref().unwrap_or(arguments);
    arguments.check()?;
    let set = &arguments.scene.values.set;
    let mut scene = read_scene_of(&input, set, terminal)?;
    let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(StudyError::Scene)?;
    let (tests, files) = scenes::tests(&arguments.test, &input)?;
    let asked = Asked::of(arguments, tunables, tests)?;
    let further = arguments.limits.beside(&scene.limits)?;
    scene.add_limits(further.clone());
    let mut scenes = vec![TestScene::own(input, scene.clone(), &asked)];
    for path in &files {
        let own = TestScene::other(path, &asked, set, terminal)?;
        arguments.limits.beside(&own.scene.limits)?;
        scenes.push(own);
    }
    for own in &asked.tests {
        scenes[own.scene].check_set(&[&set[..], &own.set].concat())?;
    }
    let posing = Posing {
        scenes: &scenes,
        set,
        asked: &asked,
        limits: &further,
        method: arguments.method.as_deref(),
        sample: ScatterArguments::new(arguments.scatter, arguments.seed),
        half: arguments.sample.max(2) * asked.tests.len() * asked.choices().len(),
        posed: AtomicUsize::new(0),
        bar: Mutex::new(Some(Bar::new("design", 0.0, terminal.error.attended))),
        watch: host::watch(),
    };
    check_posed(arguments, &posing)?;
    check_measures(&posing)?;
    let (folder, file) = arguments.out.split(files::all_names(&asked, scenes.len()))?;
    let mut found = list(asked.choices().into_iter().map(|choice| {
        let design = searched(arguments, &posing, &choice).map_err(|error| error.to_string());
        Found { choice, design }
    }));
    found.sort_by(|one, other| {
        one.rank().partial_cmp(&other.rank()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let front = front::found(arguments, &posing, &found)?;
    posing.end();
    let Some(Found { choice, design: Ok(best) }) = found.first_mut() else {
        let reason = found.into_iter().find_map(|own| own.design.err()).unwrap_or_default();
        return Err(CliError::NoDesign { reason });
    };
    for (test, run) in asked.tests.iter().zip(&mut best.runs) {
        let wanted = arguments.robust;
        scatter_of(&posing, (choice, test), (&best.values, wanted), (run, terminal))?;
    }
    let told = |test| -> Option<FloorTold> {
        let point = posing.pose(choice, test)(&best.values).ok()?;
        Some(FloorTold::of(&point.network, point.settings.duration, &point.settings.limits))
    };
    let floors = asked.tests.iter().filter_map(told).collect();
    let text = |own: &TestScene| {
        let text = posing.written(own, choice, &best.values);
        (own.input.file.clone(), with_limits(&text, &further))
    };
    let texts = list(scenes.iter().map(text));
    let slices = match &folder {
        Some(_) => figures::slices(arguments, &posing, choice, best),
        None => Vec::new(),
    };
    let is_kept = is_kept(best);
    let settings = arguments.in_words();
    scenes::print_all_notes(&scenes);
    let (asked, set) = (asked.clone(), set.clone());
    let answer = Answer { scene, asked, found, front, floors, texts, set, slices, settings };
    let is_kept = is_kept && answer.is_claimed();
    emit(&answer, arguments.json, folder, terminal)?;
    if let Some(file) = file {
        file.write(&answer.written(0))?;
        note(&format!("wrote {}", file.path.display()));
    }
    Ok(if arguments.enforce && !is_kept { Status::LimitNotKept } else { Status::Done })
}

/// Whether there is something to keep, and scatter where it is asked for.
fn check_posed(arguments: &DesignArguments, posing: &Posing<'_>) -> Result<(), CliError> {
    let asked = posing.asked;
    let mut of_tests = asked.tests.iter().map(|own| &posing.scenes[own.scene].scene.limits);
    let has_none = posing.limits.is_empty() && of_tests.all(Vec::is_empty);
    if has_none && matches!(asked.least, Least::Number(_)) && asked.and.is_none() {
        return Err(CliError::NothingToKeep { name: asked.least.name(asked).to_owned() });
    }
    if !posing.has_scatter() {
        refuse(&["--robust", "--scatter", "--seed"], NO_SCATTER)?;
    }
    if asked.and.is_none() {
        refuse(&["--points"], "it is of a front of two aims, `--least` and `--and`")?;
    }
    if has_none && arguments.enforce {
        return Err(StudyError::NoLimits.into());
    }
    match arguments.robust.map(Odds::least_designs) {
        Some(least) if least > arguments.scatter as f64 => Err(CliError::TooFewScattered { least }),
        _ => Ok(()),
    }
}

/// Whether the scene of each test has the measures that are made least.
fn check_measures(posing: &Posing<'_>) -> Result<(), CliError> {
    let asked = posing.asked;
    let aims = [Some(&asked.least), asked.and.as_ref()].into_iter().flatten();
    let keys = aims.filter_map(|own| match own {
        Least::Measure(key) => Some(key.clone()),
        Least::Number(_) | Least::Step(_) => None,
    });
    let keys: Vec<String> = list(keys);
    let begin = asked.variables().into_iter().map(|own| own.start.clamp(own.low, own.high));
    let begin: Vec<f64> = list(begin);
    let first = vec![0; asked.among.len()];
    for test in asked.tests.iter().filter(|_| !keys.is_empty()) {
        // What cannot be posed is told where it is searched.
        if let Ok(point) = posing.pose(&first, test)(&begin) {
            columns(&point, &keys)?;
        }
    }
    Ok(())
}

/// The best design with a choice of words and steps.
fn searched(
    arguments: &DesignArguments,
    posing: &Posing<'_>,
    choice: &Choice,
) -> Result<Design, DesignError> {
    let asked = posing.asked;
    with_problem(posing, choice, |problem| match arguments.robust {
        Some(probability) => {
            let pose =
                |test: usize, values: &[f64]| posing.scattered(choice, &asked.tests[test], values);
            robust(problem, Scattered { probability, pose: &pose }, arguments.effort())
        }
        None => search(problem, arguments.effort()),
    })
}

/// Does something with what is to be searched with a choice.
fn with_problem<T>(
    posing: &Posing<'_>,
    choice: &Choice,
    work: impl FnOnce(&Problem<'_>) -> T,
) -> T {
    let asked = posing.asked;
    let poses = list(asked.tests.iter().map(|test| posing.pose(choice, test)));
    let tests: Vec<&PoseAt<'_>> = list(poses.iter().map(Box::as_ref));
    let (variables, aim) = (asked.variables(), asked.least.aim(asked, choice));
    work(&Problem { variables: &variables, totals: &asked.totals, aim: &aim, tests: &tests })
}

/// Adds to the run of a test what scatter makes of it, where the scene has some.
fn scatter_of(
    posing: &Posing<'_>,
    (choice, test): (&Choice, &Test),
    (values, wanted): (&[f64], Option<f64>),
    (run, terminal): (&mut RunReport, Terminal),
) -> Result<(), CliError> {
    if posing.scene(test).scene.scatter.is_empty() {
        return Ok(());
    }
    let Some(drawn) = posing.drawn(choice, test, values)? else { return Ok(()) };
    let Ok(point) = posing.pose(choice, test)(values) else { return Ok(()) };
    let sample = (&drawn.sample, posing.sample.seed());
    let mut bar = Bar::new("scatter", 0.0, terminal.error.attended);
    let mut watch = |done, of| bar.count(done, of);
    let asked = (&point.settings, &*drawn.plain);
    let report = scatter::solved(&drawn.scene, sample, asked, &mut watch);
    run.scatter = report.map_err(StudyError::Run)?.map(Box::new);
    if let (Some(own), Some(wanted)) = (&mut run.scatter, wanted) {
        own.wanted = wanted;
    }
    Ok(())
}

/// Whether a design keeps everything, and in enough of the scatter that it has to bear.
fn is_feasible(design: &Design) -> bool {
    design.is_feasible && design.borne.is_none_or(|own| own.is_enough())
}

/// Whether a design keeps everything, however the errors lie, and in enough of the scatter that it has to bear.
fn is_kept(design: &Design) -> bool {
    let passes = |run: &RunReport| run.judged().iter().all(|own| own.judgement == Judgement::Pass);
    is_feasible(design) && design.runs.iter().all(passes)
}
