//! `dashpot run`.

pub(super) mod beside;
mod columns;
mod compared;
mod curves;
mod designs;
mod deviations;
mod energy;
mod files;
mod floor;
mod left_out;
mod limits;
mod measures;
mod object;
mod one;
mod options;
mod order;
pub(super) mod recorded;
mod resolved_scene;
pub(crate) mod scatter;
pub(super) mod series;
mod solving;
mod verdict;

use std::{collections::HashMap, path::PathBuf};

use clap::Args;
use dashpot_analysis::{
    Difference, RunError, RunReport, SolveSettings, Warning, differences, solve_partial,
};
use dashpot_dae::SolveError;
use dashpot_plot::{
    RunSeries,
    figures::{FORCE_TIME, Figure},
};
use dashpot_scene::Scene;
use serde::Serialize;

use self::{
    beside::{Beside, MeasuredArguments, MeasuredCurve},
    designs::{Design, Designs, Named},
    deviations::Compared,
    energy::energy_table,
    files::Written,
    measures::{Column, Side, measures_tables, notes},
    one::Scattered,
    resolved_scene::Changes,
    series::curves,
    solving::{reasons, solving_table},
    verdict::verdict,
};
pub(crate) use self::{
    floor::Told as FloorTold,
    limits::{level, lines as limit_lines},
    measures::{measure_text, unit_of_kind},
    verdict::Line,
};
pub use self::{one::SceneRun, options::RunOptions, scatter::ScatterArguments};
use crate::{
    args::{
        LimitArguments, MethodNames, NO_SCATTER, Switch, ValueArguments, Variant, When,
        method_names, refuse, share, single, time, variant,
    },
    error::{CliError, Status, StudyError},
    folder::{Folder, Staged},
    input::title,
    output::{Study, Text, emit, list},
    progress::Bar,
    terminal::{Terminal, WIDTH},
    verbs::check::undefined,
};
use dashpot_report::layout::indented;
use dashpot_studies::Budget;

const PLOT_HEIGHT: usize = 14;
/// Points of a curve in the plot: many more than dots, so that quick oscillations fill their band.
const PLOT_POINTS: usize = 8001;
/// Columns of the verdict's labels.
const LABELS: usize = 15;

/// `run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot run                                      the built-in reference impact\n  \
    dashpot run pad.toml --set \"K=25 MN/m\"           with another stiffness\n  \
    dashpot run eps.toml epp.toml foam.toml          designs side by side\n  \
    dashpot run pad.toml --variant \"K=80 kN/m\"       the same with another value\n  \
    dashpot run pad.toml --method exact,bdf          two methods side by side\n  \
    dashpot run pad.toml --accuracy 0.01%            more digits\n  \
    dashpot run pad.toml --neglect 0.5%              without what matters less\n  \
    dashpot run pad.toml --limit \"head.hic15<=700\"   pass, fail, or undecided\n  \
    dashpot run pad.toml --floor                     what no pad can beat\n  \
    dashpot run pad.toml --sample 2000               designs of what scatters\n  \
    dashpot run pad.toml --measured drop.csv         beside a measured curve\n  \
    dashpot run pad.toml --out results               CSV, JSON, SVG and HTML\n  \
    dashpot run pad.toml --out results --write page  the page alone\n  \
    dashpot run pad.toml --at \"5 ms, 20 ms\"          every output at these times\n  \
    dashpot run pad.toml --json | jq .runs[0].measures\n\n\
    Units: --accuracy and --neglect are relative (0.1%, 1e-3), --rtol a number; all values of --json are SI.")]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
pub(crate) struct RunArguments {
    /// Files of scenes, `-` for standard input, or built-in scenes (reference,
    /// reference-stiff, reference-gravity); several stand side by side as designs [default: reference].
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    values: ValueArguments,
    /// A design besides each scene as it is: the same with these values, as `--set` takes them, such as
    /// "K=80 kN/m, C=2 kN s/m", or with a name of its own "stiff: K=80 kN/m"; repeatable.
    #[arg(long, value_name = "[NAME:] KEY=VALUE,…", value_parser = variant)]
    variant: Vec<Variant>,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    scatter: ScatterArguments,
    #[command(flatten)]
    measured: MeasuredArguments,
    /// Tells of these measures alone in tables and JSON, such as head.hic15; the verdict stays whole [default: all that
    /// the scene reports].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    measure: Vec<String>,
    /// Exits with 4 unless every limit is kept, however the errors lie.
    #[arg(long)]
    enforce: bool,
    /// Tells what no pad can beat where the body is stopped within the thickness, the stop, or a limit on the
    /// deflection: the least peak, HIC and severity index, and how far the scene is from them.
    #[arg(long)]
    floor: bool,
    /// Methods in place of the scene's, side by side; `dashpot list methods` tells of each.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = MethodNames(method_names()))]
    method: Vec<String>,
    /// Accuracy of every measure, relative, such as 0.1% [default: the scene's, else 0.1 %].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    accuracy: Option<f64>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified by a
    /// solution with it [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    neglect: Option<f64>,
    /// The method's own relative tolerance, 1e-13 to 1e-3, in place of the search for one.
    #[arg(long, value_name = "NUMBER", conflicts_with = "accuracy")]
    rtol: Option<f64>,
    /// Whether errors are estimated by further solutions; `off` is for bulk work.
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    estimate: Switch,
    /// Most work of each run, in units of a step of one unknown, 20 to 60 ns [default: 1e9, 20 to 60 s].
    #[arg(long, value_name = "UNITS", value_parser = single::<Budget>)]
    budget: Option<Budget>,
    /// Folder for CSV, JSON, SVG and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// What the folder holds besides result.json [default: all].
    #[arg(long, value_enum, value_name = "KIND,…", value_delimiter = ',', requires = "out")]
    write: Vec<Written>,
    /// The values of all outputs at these times, such as "5 ms, 20 ms", in the text and the JSON object.
    #[arg(long, value_name = "TIME,…", value_delimiter = ',', value_parser = time)]
    at: Vec<f64>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
    /// All outputs over time in the JSON object as well, at the times of the CSV.
    #[arg(long)]
    curves: bool,
    /// A plot of the forces, or of what was measured, in the text; `auto` draws it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto", conflicts_with = "json")]
    plot: When,
}

/// A scene and its runs.
struct Answer {
    pub(super) scene: Scene,
    /// What the command line said in place of the scene.
    pub(super) changes: Changes,
    /// The accuracy and the other settings with which each method was asked, in their order.
    pub(super) asked: Vec<SolveSettings>,
    /// The runs that went well, in the order of the methods; at least one.
    pub(super) runs: Vec<RunReport>,
    /// The methods that failed, and why.
    pub(super) failed: Vec<(&'static str, CliError)>,
    /// The curves that were measured.
    pub(super) measured: Vec<MeasuredCurve>,
    /// Of each run how far it is from each of them.
    pub(super) beside: Vec<Vec<Beside>>,
    /// What no pad can beat, where that is asked for.
    pub(super) floor: Option<floor::Told>,
    plot: bool,
    /// What is shown and written besides.
    pub(super) wishes: Wishes,
}

/// What the command line asks for besides the measures.
#[derive(Debug, Clone, Default)]
struct Wishes {
    /// All outputs over time in the object.
    curves: bool,
    /// Times \[s\] at which all outputs are shown, rising.
    at: Vec<f64>,
    written: Vec<Written>,
}

impl Wishes {
    fn of(arguments: &RunArguments) -> Self {
        let mut at = arguments.at.clone();
        at.sort_by(f64::total_cmp);
        Self { curves: arguments.curves, at, written: arguments.write.clone() }
    }
}

impl Answer {
    /// The most accurate run; of equals the first. `None` if no run went well.
    pub(super) fn best(&self) -> Option<&RunReport> {
        let error = |run: &RunReport| run.worst_relative_error().unwrap_or(f64::INFINITY);
        self.runs.iter().min_by(|one, other| error(one).total_cmp(&error(other)))
    }

    /// The figure that is plotted in the text: that of what was measured, or else of forces.
    pub(super) fn plotted(&self) -> &'static Figure {
        let measured = self.measured.first().and_then(|own| Figure::over_time(own.output.of));
        measured.unwrap_or(&FORCE_TIME)
    }

    /// Curves of a run with those that were measured.
    pub(super) fn with_measured(&self, series: RunSeries) -> RunSeries {
        let run = self.runs.iter().find(|own| own.solver.method == series.name).or(self.best());
        let compared = run.map_or_else(Vec::new, |run| list(self.compared(run, &series.name)));
        let filtered = compared.iter().filter_map(Compared::filtered);
        let measured = self.measured.iter().map(MeasuredCurve::series).chain(filtered);
        RunSeries { measured: measured.collect(), ..series }
    }

    /// Its runs side by side.
    fn side(&self) -> Side<'_> {
        let columns = self.runs.iter().map(|run| Column { name: run.solver.method, run });
        Side { columns: columns.collect(), differences: Some(self.differences()), by: None }
    }

    /// All warnings, the most important first; those that not every run gives name their methods.
    pub(super) fn warnings(&self) -> Vec<String> {
        self.warnings_of(|_| true)
    }

    fn warnings_of(&self, is_meant: impl Fn(&Warning) -> bool) -> Vec<String> {
        let mut grouped: Vec<(String, Vec<&str>)> = Vec::new();
        let mut places: HashMap<String, usize> = HashMap::new();
        for run in &self.runs {
            for warning in
                run.warnings.iter().filter(|warning| is_meant(warning)).map(Warning::to_string)
            {
                let place = *places.entry(warning).or_insert_with_key(|warning| {
                    grouped.push((warning.clone(), Vec::new()));
                    grouped.len() - 1
                });
                grouped[place].1.push(run.solver.method);
            }
        }
        let text = |(warning, methods): (String, Vec<&str>)| {
            let is_of_all = methods.len() == self.runs.len();
            if is_of_all { warning } else { format!("{}: {warning}", methods.join(", ")) }
        };
        let missing = self.runs.iter().flat_map(scatter::missing);
        missing.chain(grouped.into_iter().map(text)).collect()
    }

    /// How far the runs are apart in each measure: the largest difference from the first one.
    pub(super) fn differences(&self) -> Vec<Difference> {
        let Some((first, others)) = self.runs.split_first() else { return Vec::new() };
        let mut largest: Vec<Difference> = Vec::new();
        for difference in others.iter().flat_map(|other| differences(first, other)) {
            match largest.iter_mut().find(|known| known.key == difference.key) {
                Some(known) => known.relative = known.relative.max(difference.relative),
                None => largest.push(difference),
            }
        }
        largest
    }

    /// The warnings but those that the scene's own text has brought already.
    fn new_warnings(&self) -> Vec<String> {
        let known = &self.scene.assembly.warnings;
        self.warnings_of(|warning| !matches!(warning, Warning::Network(own) if known.contains(own)))
    }
}

/// Solves a scene by its methods, and reports.
pub(crate) fn run(arguments: &RunArguments, terminal: Terminal) -> Result<Status, CliError> {
    let scenes = designs::scenes(arguments, terminal)?;
    if arguments.enforce && scenes.iter().all(|own| own.scene.limits.is_empty()) {
        return Err(StudyError::NoLimits.into());
    }
    check_options(arguments, &scenes)?;
    for own in scenes.iter().filter(|_| arguments.curves) {
        let methods = arguments.method.len().max(own.scene.run.methods.len());
        curves::check_size(&own.scene, methods)?;
    }
    let folder = Folder::wanted(arguments.out.as_deref(), files::names())?;
    let mut answers = Vec::new();
    let mut warned = Vec::new();
    designs::print_remarks(&scenes);
    for Named { name, scene, values, set } in scenes {
        for text in undefined(&scene).unwrap_or_default() {
            if !warned.contains(&text) {
                terminal.warn(&text);
                warned.push(text);
            }
        }
        curves::reached(&arguments.at, scene.run.duration)?;
        let answer = solve_all(scene, (arguments, &set), terminal)?;
        print_failures(&answer, terminal);
        answers.push(Design::new(name, values, answer));
    }
    let failed = answers.iter().flat_map(|own| &own.answer.failed);
    let status = failed.map(|(_, error)| error.status()).max();
    let is_kept = answers.iter().all(|own| limits::all_pass(&own.answer.runs));
    let own = if arguments.enforce && !is_kept { Status::LimitNotKept } else { Status::Done };
    if answers.len() > 1 {
        let designs =
            Designs { designs: answers, plot: arguments.plot.is_now(terminal.output.attended) };
        if arguments.json || designs.is_solved() {
            let folder = folder.filter(|_| designs.is_solved());
            emit(&designs, arguments.json, folder, terminal)?;
        }
        return Ok(status.unwrap_or(own));
    }
    let Some(Design { answer, .. }) = answers.pop() else { return Ok(own) };
    if arguments.json || !answer.runs.is_empty() {
        let folder = folder.filter(|_| !answer.runs.is_empty());
        emit(&answer, arguments.json, folder, terminal)?;
    }
    Ok(status.unwrap_or(own))
}

/// Refuses what does nothing for these scenes.
fn check_options(arguments: &RunArguments, scenes: &[Named]) -> Result<(), CliError> {
    if scenes.iter().all(|own| own.scene.scatter.is_empty()) {
        refuse(&["--sample", "--seed"], NO_SCATTER)?;
    }
    let has_object = arguments.json || arguments.out.is_some();
    if !has_object {
        refuse(&["--curves"], "curves stand in the JSON object; add `--json` or `--out DIR`")?;
    }
    if scenes.len() > 1 && !has_object {
        let why = "of several designs the values at times stand in the JSON object; add `--json`";
        refuse(&["--at"], why)?;
    }
    let is_exact = |own: &String| own == "exact";
    if !arguments.method.is_empty() && arguments.method.iter().all(is_exact) {
        refuse(&["--rtol"], "`exact` takes no steps and has no tolerance")?;
    }
    Ok(())
}

/// Tells of each error once, with the methods that it is about unless that is all of them.
fn print_failures(answer: &Answer, terminal: Terminal) {
    let mut printed: Vec<String> = Vec::new();
    for (_, error) in &answer.failed {
        let text = error.to_string();
        if printed.contains(&text) {
            continue;
        }
        let same = answer.failed.iter().filter(|(_, other)| other.to_string() == text);
        let methods: Vec<&str> = same.map(|same| same.0).collect();
        let is_all = methods.len() == answer.asked.len();
        let prefix = if is_all { String::new() } else { format!("{}: ", methods.join(", ")) };
        terminal.fail(&prefix, error);
        printed.push(text);
    }
}

fn solve_all(
    scene: Scene,
    (arguments, set): (&RunArguments, &[(String, String)]),
    terminal: Terminal,
) -> Result<Answer, CliError> {
    let mut asked: Vec<SolveSettings> = Vec::new();
    let options = RunOptions::of(arguments);
    let methods = if arguments.method.is_empty() { &scene.run.methods } else { &arguments.method };
    for method in methods {
        if asked.iter().all(|own| own.method.name() != method) {
            asked.push(options.settings(&scene, method)?);
        }
    }
    let scattered = Scattered::of(&scene, set, &options)?;
    let measured = arguments.measured.read(&scene)?;
    let (mut runs, mut failed, mut beside) = (Vec::<RunReport>::new(), Vec::new(), Vec::new());
    // What is much for one method is seldom little for the next.
    let mut long = 0;
    for own in &asked {
        let budget = (own.budget >> long.min(9)).max(1);
        let mut bar = Bar::new(own.method.name(), own.duration, terminal.error.attended);
        let granted = SolveSettings { budget, ..own.clone() };
        let solved = solve_partial(&scene.network, &scene.assembly, &granted, &mut bar);
        long += u32::from(match &solved {
            Ok(report) => report.solver.work > budget / 2,
            Err(error) => matches!(error, RunError::Solve(SolveError::BudgetSpent { .. })),
        });
        match solved {
            // `auto` may choose what is asked for by name as well.
            Ok(mut report) if is_new(&runs, &report) => {
                if let Some(scattered) = &scattered {
                    let mut bar = Bar::new("scatter", 0.0, terminal.error.attended);
                    let mut watch = |done, of| bar.count(done, of);
                    scattered.add_to(&mut report, &scene, own, &mut watch)?;
                }
                let found = measured.iter().map(|own| own.beside(&report, &scene));
                let mut found = found.collect::<Result<Vec<_>, _>>()?;
                compared::add_work(&measured, &mut found);
                beside.push(found);
                report.only.clone_from(&arguments.measure);
                runs.push(report);
            }
            Ok(_) => {}
            Err(error) => failed.push((own.method.name(), error.into())),
        }
    }
    let (changes, plot) =
        (Changes::of(arguments, set), arguments.plot.is_now(terminal.output.attended));
    let wishes = Wishes::of(arguments);
    let floor =
        options.floor.then(|| floor::Told::of(&scene.network, scene.run.duration, &scene.limits));
    Ok(Answer { scene, changes, asked, runs, failed, measured, beside, floor, plot, wishes })
}

fn is_new(runs: &[RunReport], report: &RunReport) -> bool {
    runs.iter().all(|run| run.solver.method != report.solver.method)
}

impl Study for Answer {
    fn text(&self, text: &mut Text) {
        text.warnings(&self.new_warnings());
        text.title(title(&self.scene));
        self.changes.description().iter().for_each(|changes| text.words(changes));
        text.blank();
        for line in verdict(self) {
            text.labelled(line.label, LABELS, &line.text);
        }
        if let Some(best) = self.best().filter(|_| self.plot) {
            let chart = self.plotted().chart(&[self.with_measured(curves(best, PLOT_POINTS))]);
            text.blank();
            text.lines(&indented(&chart.text(WIDTH - 4, PLOT_HEIGHT)));
        }
        for table in measures_tables(&self.side(), WIDTH - 2) {
            text.figures(&table);
        }
        self.best().and_then(scatter::table).iter().for_each(|table| text.rows_below(table));
        deviations::show(&self.by_curve(), text);
        notes(self).iter().for_each(|note| text.labelled("", 0, note));
        self.values_at().iter().for_each(|table| text.rows_below(table));
        self.best().iter().for_each(|best| text.figures(&energy_table(best)));
        text.figures(&solving_table(self));
        for (method, why) in reasons(self) {
            text.labelled(&method, 8, &why);
        }
    }

    fn warnings(&self) -> Vec<String> {
        self.new_warnings()
    }

    fn object(&self) -> impl Serialize {
        object::object(self)
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}
