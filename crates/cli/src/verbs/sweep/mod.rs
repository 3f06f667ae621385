//! `dashpot sweep`.

mod best;
mod figures;
mod files;
mod gradient;
mod page;
mod points;
mod titles;
mod words;

use std::{
    num::NonZero,
    path::{Path, PathBuf},
    thread::available_parallelism,
};

use clap::{Args, ValueEnum};
use dashpot_analysis::{
    Limit, RunError,
    sweep::{
        Column, Estimates, Grid, Pose, ScenePoint, SweepOptions, SweepReport, columns,
        sweep as solve,
    },
};
use dashpot_scene::{
    DataTable, Diagnostics, LeftOut, Posed, Scene, Tunables, Variation, pose, read,
};
use serde::Serialize;

use self::words::{notes, summary};
use crate::{
    args::{
        LimitArguments, MOST_POINTS as MOST, SceneArguments, When, budget, method_names, samples,
        share,
    },
    error::{CliError, Status},
    folder::{Folder, Staged},
    input::{Input, title},
    numbers::counted,
    operand::print_notes,
    origin::{self, Source},
    output::{Pairs, Study, Text, VERSION, emit, list, object},
    progress::Bar,
    said,
    terminal::{Terminal, note},
};

/// `sweep`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m,26,log\"\n  \
    dashpot sweep --vary \"head.velocity=2..12 m/s\" --measure padding.peak-force\n  \
    dashpot sweep pad.toml --points designs.csv\n  \
    dashpot sweep --vary \"padding.maxwell.spring=5..80 MN/m,41,log\" \\\n    \
    --vary \"padding.kelvin.dashpot=1..16 kN s/m,41,log\" --out map\n  \
    dashpot sweep helmet.toml --vary liner.material=eps,epp,vn --vary \"drop=0.5..2 m\"\n  \
    dashpot sweep pad.toml --gradient K,head.mass\n  \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m\" --vary \"C=2..9 kN s/m\" --sample 200\n\n\
    A number of the scene goes by its path, such as head.velocity, mount.dashpot, \
    padding.maxwell.spring or padding.thickness, or by its name under [values]. Its values are a \
    range, with their count and `lin` or `log`, or a list: \"K=5,10,20 MN/m\". A word of it, such as \
    that of a material, takes a list of words. In a pipe or file \
    the table is CSV, in SI units.")]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// A number of the scene and the values that it takes; repeatable, for all combinations.
    #[arg(long, value_name = "NAME=VALUES", required_unless_present_any = ["points", "gradient"])]
    vary: Vec<String>,
    /// Designs from a table in place of all combinations: a CSV file whose first line names numbers of
    /// the scene with their units, such as `head.velocity [m/s],liner.thickness [mm]`; each row is one.
    #[arg(long, value_name = "FILE", conflicts_with = "vary")]
    points: Option<PathBuf>,
    /// So many designs in place of all combinations: a Latin hypercube of the ranges; of a list, and of a range
    /// with a count, each value is taken equally often.
    #[arg(long, value_name = "NUMBER", requires = "vary", value_parser = samples)]
    sample: Option<usize>,
    /// Which designs `--sample` takes; the same number gives the same ones.
    #[arg(long, value_name = "NUMBER", requires = "sample", default_value_t = 1)]
    seed: u64,
    /// Derivatives of the measures with respect to these numbers, at every point or, without `--vary`, of the scene
    /// itself: by how many percent a measure changes where a number rises by one.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', conflicts_with_all = ["estimate", "neglect"])]
    gradient: Vec<String>,
    /// Measures, such as padding.peak-force [default: all that the scene reports].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    measure: Vec<String>,
    /// Method for all points [default: the scene's, if it names one, else auto]; points are instantiated by
    /// auto and exact only.
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    method: Option<String>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified at
    /// points spread over the sweep [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    neglect: Option<f64>,
    /// Where errors are estimated by further solutions; some: at three of 64 points, whose errors stand for
    /// those near them [default: some; of a table, whose rows need not be near each other, all].
    #[arg(long, value_enum, value_name = "WHERE")]
    estimate: Option<EstimatedPoints>,
    /// Most work of each point, in units of a step of one unknown, some 30 ns [default: 1e9, some 30 s].
    #[arg(long, value_name = "UNITS", value_parser = budget)]
    budget: Option<u64>,
    /// How many threads share the points; the results are the same [default: one per core].
    #[arg(long, value_name = "NUMBER")]
    threads: Option<NonZero<usize>>,
    /// Folder for CSV, JSON, SVG and HTML: lines over one parameter, maps over two, and report.html with
    /// everything on one page.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of the table.
    #[arg(long)]
    json: bool,
    /// A table in handy units for people, in place of CSV in SI units; `auto` prints it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    table: When,
}

/// The points of a sweep at which errors are estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum EstimatedPoints {
    /// Every point.
    All,
    /// Some points.
    Some,
    /// None.
    Off,
}

impl From<EstimatedPoints> for Estimates {
    fn from(points: EstimatedPoints) -> Self {
        match points {
            EstimatedPoints::All => Self::All,
            EstimatedPoints::Some => Self::Some,
            EstimatedPoints::Off => Self::Off,
        }
    }
}

/// What varies, and how.
struct Varied {
    tunables: Tunables,
    variations: Vec<Variation>,
    /// The number of the scene that each variation is of.
    matched: Vec<usize>,
    /// What the command line gives of each, where a sample was taken of it: `5..30 MN/m`.
    ranges: Vec<String>,
    form: Form,
}

/// Which values go together.
enum Form {
    /// All combinations.
    Combined,
    /// All combinations of these; with words among them no number says how near points are to each other.
    Mixed(Grid),
    /// Those of one row of a table.
    Listed,
    /// Those of one design of a sample.
    Sampled,
}

/// The designs in a file; lines of it that are left out are told.
fn listed(file: &Path) -> Result<Vec<Variation>, CliError> {
    let input = Input::read(file)?;
    let text = input.text()?;
    let fault = |fault| CliError::Listed { file: file.to_owned(), fault: Box::new(fault) };
    let designs = Variation::listed(text).map_err(fault)?;
    if let Some(lines) = DataTable::read(text).ok().as_ref().and_then(LeftOut::of) {
        note(&format!("file `{}`: {lines}", file.display()));
    }
    Ok(designs)
}

impl Varied {
    /// What the command line names of the scene with this text.
    fn of(arguments: &SweepArguments, text: &str, file: &str) -> Result<Self, CliError> {
        let tunables = Tunables::of(text, Some(file)).map_err(CliError::Scene)?;
        let mut variations: Vec<Variation> = match &arguments.points {
            Some(file) => listed(file)?,
            None => {
                arguments.vary.iter().map(|own| Variation::parse(own)).collect::<Result<_, _>>()?
            }
        };
        let flag = if arguments.points.is_some() { "--points" } else { "--vary" };
        let matched = tunables.matched(&mut variations);
        let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
        let mut form = if arguments.points.is_some() { Form::Listed } else { Form::Combined };
        if let Some(count) = arguments.sample {
            variations = Variation::sampled(&variations, count, arguments.seed);
            // They are numbers of the scene once more.
            let matched = tunables.matched(&mut variations);
            matched.map_err(|fault| CliError::Tunable { flag, fault })?;
            form = Form::Sampled;
        } else if variations.iter().any(Variation::is_of_words) && variations.len() > 1 {
            form = Grid::new(counts(&variations)).map_or(form, Form::Mixed);
        }
        let range = |own: &String| own.split_once('=').map_or("", |own| own.1).trim().to_owned();
        let ranges = arguments.vary.iter().map(range).collect();
        Ok(Self { tunables, variations, matched, ranges, form })
    }

    /// Whether the values of a row go together, in place of all combinations.
    fn is_of_rows(&self) -> bool {
        matches!(self.form, Form::Listed | Form::Sampled)
    }

    /// Whether nothing says how near its points are to each other.
    fn is_apart(&self) -> bool {
        self.is_of_rows() || self.variations.iter().any(Variation::is_of_words)
    }

    /// All points; `None` where there are too many.
    fn grid(&self) -> Option<Grid> {
        let grid = match &self.form {
            Form::Combined if self.variations.is_empty() => Grid::new(vec![1]),
            Form::Combined => Grid::new(counts(&self.variations)),
            Form::Mixed(all) => Grid::new(vec![all.len()]),
            Form::Listed | Form::Sampled => Grid::new(vec![self.variations[0].len()]),
        };
        grid.filter(|grid| grid.len() <= MOST)
    }

    /// Which of its values each parameter takes at a point of the grid.
    fn places(&self, of_grid: &[usize]) -> Vec<usize> {
        match &self.form {
            Form::Combined => of_grid.to_vec(),
            Form::Mixed(all) => all.places(of_grid[0]),
            Form::Listed | Form::Sampled => vec![of_grid[0]; self.variations.len()],
        }
    }

    /// The points at which something wrong with the values shows, rising: the corners of the grid, and every
    /// word.
    fn telling(&self, grid: &Grid) -> Vec<usize> {
        let mut points: Vec<usize> = grid.corners().into_iter().take(MOST_CORNERS).collect();
        for (axis, own) in self.variations.iter().enumerate().filter(|own| own.1.is_of_words()) {
            let mut known: Vec<&str> = Vec::new();
            for (place, word) in own.words.iter().enumerate() {
                if known.contains(&word.as_str()) || known.len() >= MOST_CORNERS {
                    continue;
                }
                known.push(word);
                points.push(match &self.form {
                    Form::Mixed(all) => all.on_axis(axis, place),
                    _ => place,
                });
            }
        }
        points.sort_unstable();
        points.dedup();
        points
    }

    /// The text of the scene at a point of the grid.
    fn text_at(&self, of_grid: &[usize]) -> String {
        let all = self.matched.iter().zip(&self.variations).zip(self.places(of_grid));
        let values: Vec<(usize, String)> =
            all.map(|((at, own), place)| (*at, own.text(place))).collect();
        self.tunables.text_with(&values)
    }

    /// Whether what is set by this name is among what varies.
    fn has(&self, name: &str) -> bool {
        self.tunables.anything(name).is_ok_and(|at| self.matched.contains(&at))
    }
}

/// What was varied, in what, and what was found.
struct Swept {
    scene: Scene,
    varied: Varied,
    grid: Grid,
    /// Where errors were to be estimated.
    estimates: Estimates,
    /// What the command line asked for, in words.
    asked: Vec<(&'static str, String)>,
    report: SweepReport,
    /// When its table is for people.
    table: When,
}

/// Solves a scene for many values of its parameters.
pub(crate) fn sweep(arguments: &SweepArguments, terminal: Terminal) -> Result<Status, CliError> {
    let input = Input::of(arguments.scene.scene.as_deref())?;
    let set = &arguments.scene.values.set;
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    print_notes(&scene.notes);
    let varied = Varied::of(arguments, &scene.text, &input.file)?;
    if let Some((name, _)) = set.iter().find(|own| varied.has(&own.0)) {
        return Err(CliError::SetAndVaried { name: name.clone() });
    }
    // What is set by a path stands in that text.
    let is_named = |own: &&(String, String)| scene.values.iter().any(|known| known.name == own.0);
    let set: Vec<(String, String)> = set.iter().filter(is_named).cloned().collect();
    let grid = varied.grid().ok_or(CliError::TooManyPoints { most: MOST })?;
    let scene_point = |posed: Posed| {
        let method = match (&arguments.method, &posed.run.methods[..]) {
            (Some(wanted), _) => wanted,
            (None, [only]) => only,
            _ => "auto",
        };
        let mut settings = posed.settings(method)?;
        settings.budget = arguments.budget.unwrap_or(settings.budget);
        Limit::add(&mut settings.limits, arguments.limits.all());
        settings.accuracy.neglect_below = arguments.neglect.or(settings.accuracy.neglect_below);
        Ok::<_, RunError>(ScenePoint { network: posed.network, settings })
    };
    let keys: Vec<String> = arguments.measure.iter().map(|own| own.trim().to_owned()).collect();
    let (columns, wishes) = columns(&scene_point(scene.clone().into())?, &keys)?;
    let names = if arguments.gradient.is_empty() {
        files::names(&varied, &columns)
    } else {
        vec![gradient::TABLE.to_owned()]
    };
    let folder = Folder::wanted(arguments.out.as_deref(), names)?;
    let of_text = |text: &str| {
        let posed = pose(text, &input.options(&set)).map_err(|faults| {
            let messages = faults.list.iter().map(dashpot_scene::Diagnostic::message);
            messages.collect::<Vec<_>>().join("; ")
        })?;
        scene_point(posed).map_err(|error| error.to_string())
    };
    let at = |places: &[usize]| {
        let mut scene_point = of_text(&varied.text_at(places))?;
        scene_point.settings.measures.clone_from(&wishes);
        Ok(scene_point)
    };
    let mut shown = checked.warnings.list;
    let before = shown.len();
    // A fault at the ends of a range is shown in the scene's text, with the value under a caret.
    for point in varied.telling(&grid) {
        let text = varied.text_at(&grid.places(point));
        let found = read(&text, &input.options(&set)).map_err(CliError::Scene)?.warnings;
        let known: Vec<String> = shown.iter().map(dashpot_scene::Diagnostic::message).collect();
        shown.extend(found.list.into_iter().filter(|own| !known.contains(&own.message())));
    }
    terminal.diagnose(&Diagnostics { list: shown.split_off(before), omitted: 0 });
    if !arguments.gradient.is_empty() {
        return gradient::gradient(
            arguments,
            (scene, varied, grid),
            &keys,
            &of_text,
            folder,
            terminal,
        );
    }
    let usual = if varied.is_apart() { EstimatedPoints::All } else { EstimatedPoints::Some };
    let estimates: Estimates = arguments.estimate.unwrap_or(usual).into();
    let report = solved((arguments, estimates), &grid, &at, &columns, terminal)?;
    let asked = arguments.in_words(estimates);
    let swept = Swept { scene, varied, grid, estimates, asked, report, table: arguments.table };
    let has_folder = folder.is_some();
    emit(&swept, arguments.json, folder, terminal)?;
    figures::undrawn(&swept.varied).filter(|_| has_folder).into_iter().for_each(note);
    let failed = swept.report.gaps.iter().filter(|gap| gap.column.is_none()).count();
    Ok(if failed == swept.report.points() { Status::RunFailed } else { Status::Done })
}

fn counts(variations: &[Variation]) -> Vec<usize> {
    variations.iter().map(Variation::len).collect()
}

/// So many corners of the grid are read before anything is solved.
const MOST_CORNERS: usize = 64;

fn solved(
    (arguments, estimates): (&SweepArguments, Estimates),
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    terminal: Terminal,
) -> Result<SweepReport, CliError> {
    let all = || available_parallelism().map_or(1, NonZero::get);
    let threads = arguments.threads.map_or_else(all, NonZero::get);
    let mut bar = Bar::new("sweep", 0.0, terminal.error.attended);
    let mut show =
        |done: usize, of: usize| bar.show(done as f64 / of as f64, || format!("{done} of {of}"));
    Ok(solve(grid, pose, columns, SweepOptions { threads, estimates }, &mut show)?)
}

/// What a parameter takes.
#[derive(Serialize)]
#[serde(untagged)]
enum Values<'v> {
    Numbers(&'v [f64]),
    Words(&'v [String]),
}

impl Study for Swept {
    fn text(&self, text: &mut Text) {
        text.title(title(&self.scene));
        self.in_words().iter().for_each(|in_word| text.faint(in_word));
        text.blank();
        text.items(page::verdict(self, &best::best(self)));
        let (table, more) = points::table(self);
        if !table.rows.is_empty() {
            text.blank();
            text.rows_led(&table, self.varied.variations.len());
        }
        if more > 0 && !table.rows.is_empty() {
            text.faint(&format!(
                "and {}: all are in the CSV, in a pipe or by `--out`",
                counted(more, "more design")
            ));
        }
        let is_sample = matches!(self.varied.form, Form::Sampled);
        if more > 0 || is_sample {
            text.table(&summary(&self.report, is_sample));
        }
        text.blank();
        text.items(notes(self).into_iter().skip(self.report.limits.len()));
    }

    fn data(&self, terminal: Terminal) -> Option<String> {
        if self.table.is_now(terminal.output.attended) {
            return None;
        }
        let mut bytes = Vec::new();
        files::table(self, &mut bytes).ok()?;
        String::from_utf8(bytes).ok()
    }

    fn notes(&self) -> Vec<String> {
        notes(self)
    }

    /// Values stand in the order of the points: the last parameter varies fastest.
    fn object(&self) -> impl Serialize {
        #[derive(Serialize)]
        struct Object<'s, P, W, N> {
            dashpot: &'static str,
            title: &'s Option<String>,
            file: &'s Option<String>,
            sha256: String,
            files: Vec<Source>,
            /// Whether their values at a point are those of one place, in place of all combinations.
            listed: bool,
            parameters: P,
            /// What the command line asks for, in words.
            asked: Pairs<&'s str, &'s str>,
            scene_warnings: W,
            scene_notes: N,
            #[serde(flatten)]
            report: &'s SweepReport,
        }
        let Self { scene, report, .. } = self;
        let parameters = self.varied.variations.iter().zip(&self.varied.matched).enumerate();
        let parameters = list(parameters.map(|(at, (own, &tunable))| {
            object! {
                name: &own.name,
                path: &self.varied.tunables.all()[tunable].path,
                unit: self.unit(at),
                values: if own.is_of_words() { Values::Words(&own.words) } else { Values::Numbers(&own.values) },
            }
        }));
        let listed = self.varied.is_of_rows();
        let (title, file) = (&scene.title, &scene.file);
        let (sha256, files) = (origin::of_text(scene), origin::of_files(scene));
        let asked = self.asked.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let (scene_warnings, scene_notes) =
            (said::warning_objects(scene), said::note_objects(scene));
        Object {
            dashpot: VERSION,
            title,
            file,
            sha256,
            files,
            listed,
            parameters,
            asked,
            scene_warnings,
            scene_notes,
            report,
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}
