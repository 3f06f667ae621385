//! `dashpot design`.

mod asked;
mod words;

use std::{num::NonZero, path::PathBuf, thread::available_parallelism};

use clap::Args;
use dashpot_analysis::sweep::PoseAt;
use dashpot_design::optimum::{Design, Effort, Kept, Required, Requirement, design as search};
use dashpot_scene::{Scene, read};
use serde::Serialize;

use self::asked::{Asked, Choice, Least, Numbers};
use super::run::{FloorTold, limit_lines};
use crate::{
    args::{LimitArguments, SceneArguments, Variant, method_names, variant},
    error::{CliError, Status},
    input::{Input, title},
    operand::print_notes,
    output::{Pairs, Study, Text, VERSION, emit, list, object},
    part::write_text,
    terminal::{Terminal, note},
};

/// Columns of labels.
const LABELS: usize = 15;

/// `design`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot design helmet.toml --vary \"liner.thickness=10..50 mm\" \\\n    \
    --least liner.thickness --limit \"head.peak-acceleration<=250 g\"\n  \
    dashpot design pad.toml --vary \"K=5..500 kN/m\" --vary \"C=0.1..10 kN s/m\" \\\n    \
    --least head.hic15\n  \
    dashpot design helmet.toml --vary \"T=10..50 mm\" --vary liner.material=eps,epp \\\n    \
    --least T --test \"flat: drop=1.5 m\" --test \"kerb: drop=1.1 m, head.mass=6 kg\"\n  \
    dashpot design helmet.toml --solve-for liner.thickness\n\n\
    A range is searched between its ends; a list, a range with a count, and words such as those\n\
    of materials are tried one by one. Limits are those of the scene and of `--limit`; they have\n\
    to be kept in every test, and no pad is pressed by more than its thickness.")]
pub(crate) struct DesignArguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// A number of the scene and its bounds, or a number or word and what it may be; repeatable.
    #[arg(long, value_name = "NAME=VALUES", required_unless_present = "solve_for")]
    vary: Vec<String>,
    /// What is made least: one of the numbers that vary, or a measure such as head.peak-acceleration, the largest of
    /// all tests [default: what `--solve-for` names].
    #[arg(long, value_name = "NAME", required_unless_present = "solve_for")]
    least: Option<String>,
    /// The least value of this number that keeps the limits, between a tenth and ten times what the scene has; stands
    /// for `--vary` and `--least`.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["vary", "least"])]
    solve_for: Option<String>,
    /// A test in which all limits have to be kept: values of the scene as `--set` takes them, with a name of its own
    /// "kerb: drop=1.1 m"; repeatable [default: the scene as it is].
    #[arg(long, value_name = "[NAME:] KEY=VALUE,…", value_parser = variant)]
    test: Vec<Variant>,
    /// Exits with 4 unless everything is kept, however the errors lie.
    #[arg(long)]
    enforce: bool,
    /// Method for all runs [default: the scene's, if it names one, else auto].
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    method: Option<String>,
    /// Designs that are spread over the bounds before the search: a grid for one or two numbers, a Latin hypercube for
    /// more.
    #[arg(long, value_name = "NUMBER", default_value_t = 400)]
    sample: usize,
    /// File for the scene with the numbers that were found.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites that file.
    #[arg(long, requires = "out")]
    force: bool,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

/// What was found with one choice of words and steps.
struct Found {
    choice: Choice,
    design: Result<Design, String>,
}

/// The best design.
struct Answer {
    scene: Scene,
    asked: Asked,
    /// One for each choice, the best first.
    found: Vec<Found>,
    /// Of the best, test by test.
    floors: Vec<FloorTold>,
}

/// Searches the best design.
pub(crate) fn design(arguments: &DesignArguments, terminal: Terminal) -> Result<Status, CliError> {
    let input = Input::of(arguments.scene.scene.as_deref())?;
    let set = &arguments.scene.values.set;
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    let mut scene = checked.value;
    print_notes(&scene.notes);
    let asked = Asked::of(arguments, &scene, &input)?;
    let further = arguments.limits.beside(&scene.limits)?;
    scene.add_limits(further.clone());
    if scene.limits.is_empty() && matches!(asked.least, Least::Number(_)) {
        let name = asked.least.name(&asked).to_owned();
        return Err(CliError::NothingToKeep { name });
    }
    let numbers = Numbers {
        input: &input,
        set,
        asked: &asked,
        limits: &further,
        method: arguments.method.as_deref(),
    };
    let threads = available_parallelism().map_or(1, NonZero::get);
    let effort = Effort { designs: arguments.sample.max(2), threads, ..Effort::default() };
    let mut found = Vec::new();
    for choice in asked.choices() {
        let design = {
            let poses = list(asked.tests.iter().map(|test| numbers.pose(&choice, test)));
            let tests: Vec<&PoseAt<'_>> = list(poses.iter().map(Box::as_ref));
            search(&asked.variables(), &asked.aim(&choice), &tests, effort)
        };
        found.push(Found { design: design.map_err(|error| error.to_string()), choice });
    }
    found.sort_by(|one, other| {
        one.rank().partial_cmp(&other.rank()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let Some(Found { choice, design: Ok(best) }) = found.first() else {
        let reason = found.into_iter().find_map(|own| own.design.err()).unwrap_or_default();
        return Err(CliError::NoDesign { reason });
    };
    let is_kept = best.is_feasible
        && best.runs.iter().all(|run| {
            run.judged().iter().all(|own| own.judgement == dashpot_analysis::Judgement::Pass)
        });
    let told = |test| -> Option<FloorTold> {
        let point = numbers.pose(choice, test)(&best.values).ok()?;
        Some(FloorTold::of(&point.network, point.settings.duration, &point.settings.limits))
    };
    let floors = asked.tests.iter().filter_map(told).collect();
    let text = numbers.text(choice, &best.values);
    let answer = Answer { scene, asked: asked.clone(), found, floors };
    emit(&answer, arguments.json, None, terminal)?;
    if let Some(path) = &arguments.out {
        write_text(path, &text, arguments.force)?;
        note(&format!("wrote {}", path.display()));
    }
    Ok(if arguments.enforce && !is_kept { Status::LimitNotKept } else { Status::Done })
}

impl Found {
    /// The better, the less: what keeps everything by its aim, what does not by how much it exceeds.
    fn rank(&self) -> (u8, f64) {
        match &self.design {
            Ok(own) if own.is_feasible => (0, own.aim),
            Ok(own) => (1, -own.least_margin()),
            Err(_) => (2, 0.0),
        }
    }
}

impl Answer {
    /// The best design, with the choice of its words and steps.
    fn best(&self) -> Option<(&Choice, &Design)> {
        let Found { choice, design } = self.found.first()?;
        Some((choice, design.as_ref().ok()?))
    }
}

impl Study for Answer {
    fn text(&self, text: &mut Text) {
        let Some((choice, best)) = self.best() else { return };
        text.warnings(&self.warnings());
        text.title(title(&self.scene));
        text.faint(&words::asked(&self.asked));
        text.blank();
        for line in words::lines(self, choice, best) {
            text.labelled(line.label, LABELS, &line.text);
        }
        text.rows_below(&words::sensitivities(&self.asked, best));
        if self.found.len() > 1 {
            text.rows_below(&words::choices(self));
        }
    }

    fn warnings(&self) -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        let runs = self.best().into_iter().flat_map(|own| &own.1.runs);
        for warning in runs.flat_map(|run| &run.warnings).map(ToString::to_string) {
            if !all.contains(&warning) {
                all.push(warning);
            }
        }
        all
    }

    fn object(&self) -> impl Serialize {
        let best = self.best();
        let parameters = best.into_iter().flat_map(|(choice, design)| {
            let numbers = self.asked.numbers.iter().zip(&design.values);
            let numbers = numbers.map(|(own, value)| {
                (
                    own.name.clone(),
                    object! {
                        value: Some(*value), word: None::<String>, unit: own.si.clone(),
                    },
                )
            });
            let chosen = self.asked.chosen(choice);
            let chosen = chosen.into_iter().map(|(own, value, word)| {
                (
                    own,
                    object! {
                        value, word, unit: String::new(),
                    },
                )
            });
            list(
                numbers
                    .map(|own| (own.0, serde_json::json!(own.1)))
                    .chain(chosen.map(|own| (own.0, serde_json::json!(own.1)))),
            )
        });
        let kept = best.into_iter().flat_map(|own| &own.1.kept);
        let limits = kept.clone().map(|own| {
            let Kept { required: Required { test, what }, value, margin, is_active, price } = own;
            let (key, bound) = match what {
                Requirement::Limit(limit) => (&limit.key, Some(limit.bound.level())),
                Requirement::Known(name) => (name, None),
            };
            object! {
                test: &self.asked.tests[*test].name, key, bound, is_depth: bound.is_none(), value, margin,
                active: is_active, price: price.filter(|own| own.is_finite()),
            }
        });
        let measures = best.into_iter().flat_map(|own| own.1.runs.iter().zip(&self.asked.tests));
        let measures = measures.map(|(run, test)| {
            let told = run.told().map(|own| {
                (own.key.clone(), object! { value: own.value, error: own.error, unit: own.unit })
            });
            (test.name.clone(), told.collect::<Pairs<_, _>>())
        });
        let floors = best
            .into_iter()
            .flat_map(|own| self.floors.iter().zip(&own.1.runs))
            .zip(&self.asked.tests);
        let floors = floors.map(|((floor, run), test)| (test.name.clone(), floor.object(run)));
        let search = best.map(|own| own.1.search);
        object! {
            dashpot: VERSION,
            parameters: parameters.collect::<Pairs<_, _>>(),
            least: self.asked.least.name(&self.asked),
            aim: best.map(|own| own.1.aim),
            feasible: best.is_some_and(|own| own.1.is_feasible),
            limits: list(limits),
            measures: measures.collect::<Pairs<_, _>>(),
            floor: floors.collect::<Pairs<_, _>>(),
            search: search.map(|own| object! {
                designs: own.designs, is_grid: own.is_grid, starts: own.starts, agree: own.agree,
                feasible: own.feasible, solved: own.solved,
            }),
        }
    }
}
