//! Designs side by side: several scenes, and a scene with other values.

use std::path::{Path, PathBuf};

use dashpot_analysis::{Judged, Judgement, Limit, RunReport};
use dashpot_plot::{RunSeries, figures::FORCE_TIME};
use dashpot_report::{Page, Table};
use dashpot_scene::Scene;
use serde::Serialize;

use super::{
    Answer, LABELS, PLOT_HEIGHT, PLOT_POINTS, RunArguments, compared,
    deviations::{self, Compared, by_curve},
    files,
    files::Written,
    limits,
    measures::{Column, Side, measures_table, measures_tables},
    object::settings,
    order::{self, Valued},
    resolved_scene, scatter,
    series::{curves, curves_and_energies},
    solving::settings_table,
    verdict::Line,
};
use crate::{
    error::{CliError, is_unit},
    folder::Staged,
    input::title,
    operand::read_scene,
    output::{Study, Text, VERSION, alike, each_once, list, object},
    said,
    terminal::{Terminal, WIDTH, note},
};
use dashpot_report::{
    layout::indented,
    numbers::{bound, duration},
};
use dashpot_studies::origin;

/// What stands where nothing is judged.
const NO_VERDICT: &str = "–";
/// Points of a curve in a figure.
const POINTS: usize = 4001;

/// A scene that is to be solved, and what sets it apart.
pub(super) struct Named {
    /// What it is called beside others.
    pub(super) name: String,
    pub(super) scene: Scene,
    /// What the variants set, each with its value in this design.
    pub(super) values: Vec<Valued>,
    /// The values that the command line sets.
    pub(super) set: Vec<(String, String)>,
}

/// All scenes that the command line names, each as it is and with the values of each variant.
pub(super) fn scenes(arguments: &RunArguments, terminal: Terminal) -> Result<Vec<Named>, CliError> {
    let paths: Vec<Option<&Path>> = match &arguments.scenes[..] {
        [] => vec![None],
        given => given.iter().map(|path| Some(path.as_path())).collect(),
    };
    // What a blank before a unit has divided is told first.
    let is_divided = |path: &&Path| is_unit(&path.to_string_lossy()) && !path.exists();
    if let Some(unit) = paths.iter().flatten().copied().find(is_divided) {
        read_scene(Some(unit), &[], terminal)?;
    }
    all_are_there(&arguments.scenes, terminal)?;
    let names = named(&paths);
    let varied = each_once(arguments.variant.iter().flat_map(|own| &own.set).map(|own| &own.0));
    let mut all = Vec::new();
    for (path, name) in paths.iter().zip(names) {
        let read = |name: String, set: Vec<(String, String)>| -> Result<Named, CliError> {
            let mut scene = read_scene(*path, &set, terminal)?;
            scene.add_limits(arguments.limits.beside(&scene.limits)?);
            let values = list(varied.iter().map(|own| Valued::of(&scene, &set, own)));
            Ok(Named { name, scene, values, set })
        };
        let base = read(name.clone(), arguments.values.set.clone())?;
        // Beside others of one scene it is told by its value.
        let own = base.values.first().filter(|_| paths.len() == 1 && varied.len() == 1);
        let own = own.and_then(Valued::text);
        all.push(Named { name: own.unwrap_or_else(|| base.name.clone()), ..base });
        for variant in &arguments.variant {
            let name = match paths.len() {
                1 => variant.name.clone(),
                _ => format!("{name}, {}", variant.name),
            };
            all.push(read(name, [&arguments.values.set[..], &variant.set].concat())?);
        }
    }
    Ok(all)
}

/// Says what there is to say about the models of all scenes, each remark once, and of which designs where not of all.
pub(super) fn print_remarks(scenes: &[Named]) {
    let all = scenes.iter().flat_map(|own| own.scene.notes.iter().map(|note| (note, &*own.name)));
    for group in alike(all, |one, other| one.0 == other.0) {
        let (remark, names) = (group[0].0, list(group.iter().map(|own| own.1)));
        let of = if names.len() == scenes.len() { String::new() } else { names.join("; ") + ": " };
        note(&format!("{of}{}: {}", remark.subject, remark.what));
    }
}

/// Tells of every file that cannot be read, before any is solved.
fn all_are_there(paths: &[PathBuf], terminal: Terminal) -> Result<(), CliError> {
    let files = paths.iter().filter(|path| path.as_os_str() != "-");
    let mut unreadable: Vec<CliError> =
        files.filter_map(|path| Some(crate::input::read_input(path).err()?.into())).collect();
    let Some(last) = unreadable.pop() else { return Ok(()) };
    unreadable.iter().for_each(|error| terminal.fail("", error));
    Err(last)
}

/// The file with the curves of the design at this place, counted from 0: its number and its name, without what is no
/// part of the name of a file everywhere.
fn curves_file(at: usize, name: &str) -> String {
    let is_kept = |own: char| own.is_alphanumeric() || "-_.=+".contains(own);
    let words = name.split(|own: char| !is_kept(own)).filter(|own| !own.is_empty());
    format!("{}-{}.csv", at + 1, list(words).join("-"))
}

/// The names of files without their ending, or whole where these are not told apart by that.
fn named(paths: &[Option<&Path>]) -> Vec<String> {
    let stem = |path: Option<&Path>| {
        let stem = path.and_then(Path::file_stem).map(|own| own.to_string_lossy().into_owned());
        stem.unwrap_or_else(|| "reference".to_owned())
    };
    let stems: Vec<String> = paths.iter().copied().map(stem).collect();
    let is_one = |at: usize| stems.iter().filter(|own| **own == stems[at]).count() == 1;
    let whole = |at: usize| paths[at].map_or_else(String::new, |own| own.display().to_string());
    (0..paths.len()).map(|at| if is_one(at) { stems[at].clone() } else { whole(at) }).collect()
}

/// A design and what became of it.
pub(super) struct Design {
    pub(super) name: String,
    /// What the variants set, each with its value in this design.
    pub(super) values: Vec<Valued>,
    /// Its name above a column: the value alone where nothing else varies, and of several values one a line.
    heading: String,
    pub(super) answer: Answer,
}

impl Design {
    pub(super) fn new(name: String, values: Vec<Valued>, answer: Answer) -> Self {
        let alone = match &values[..] {
            [own] if own.text().as_ref() == Some(&name) => own.value.clone(),
            _ => None,
        };
        let heading = alone.unwrap_or_else(|| name.replace(", ", ",\n"));
        Self { name, values, heading, answer }
    }

    /// What alone sets it apart from the others, where its heading is but a value of it.
    fn by(&self) -> Option<&str> {
        match &self.values[..] {
            [own] if own.value.as_ref() == Some(&self.heading) => Some(&own.name),
            _ => None,
        }
    }
}

/// Designs side by side, each by its best run.
pub(super) struct Designs {
    pub(super) designs: Vec<Design>,
    pub(super) plot: bool,
}

impl Designs {
    /// Whether any has a run that went well.
    pub(super) fn is_solved(&self) -> bool {
        self.best().next().is_some()
    }

    fn best(&self) -> impl Iterator<Item = (&Design, &RunReport)> + Clone {
        self.designs.iter().filter_map(|own| Some((own, own.answer.best()?)))
    }

    fn side(&self) -> Side<'_> {
        let columns = self.best().map(|(own, run)| Column { name: &own.heading, run }).collect();
        let by: Option<Vec<&str>> = self.best().map(|(own, _)| own.by()).collect();
        Side { columns, differences: None, by: by.and_then(|own| own.first().copied()) }
    }

    fn as_designs(&self, series: Vec<RunSeries>) -> Vec<RunSeries> {
        let designs: Vec<&Design> = self.best().map(|own| own.0).collect();
        let ranks = order::ranks(&designs);
        let named = series.into_iter().zip(designs).enumerate().map(|(at, (own, design))| {
            let (name, rank) = (design.name.clone(), ranks.as_ref().map(|own| own[at]));
            design.answer.with_measured(RunSeries { name, is_design: true, rank, ..own })
        });
        named.collect()
    }

    /// Each measured curve beside all designs.
    fn by_curve(&self) -> Vec<Vec<Compared<'_>>> {
        by_curve(self.best().map(|(own, run)| list(own.answer.compared(run, &own.name))))
    }

    /// Of each design whether it keeps its limits; none where no design has a limit.
    fn verdicts(&self) -> Vec<Line> {
        let line = |(own, run): (&Design, &RunReport)| {
            let judged = run.judged();
            let worst = judged.iter().filter(|own| own.judgement != Judgement::Pass);
            let worst = worst.min_by(|one, other| {
                let margin = |own: &Judged<'_>| own.margin().unwrap_or(f64::NEG_INFINITY);
                margin(one).total_cmp(&margin(other))
            });
            let fail = judged.iter().filter(|own| own.judgement == Judgement::Fail).count();
            let open = judged.iter().filter(|own| own.judgement.reason().is_some()).count();
            let of = judged.len();
            let kept = match of - fail - open {
                kept if kept == of => "keeps all its limits".to_owned(),
                kept => format!("keeps {kept} of {of} limits"),
            };
            let open = match open {
                0 => String::new(),
                open => format!(", {open} undecided"),
            };
            let worst =
                worst.map_or(String::new(), |own| format!("; the worst is {}", own.limit.key));
            let label = match (fail, open.is_empty()) {
                (0, true) => "PASS",
                (0, false) => "UNDECIDED",
                _ => "FAIL",
            };
            if of == 0 {
                let text =
                    format!("{} has no limits; `--limit` sets them for all scenes", own.name);
                return Line { label: NO_VERDICT, text };
            }
            Line { label, text: format!("{} {kept}{open}{worst}", own.name) }
        };
        let has_limits = self.best().any(|(_, run)| !run.limits.is_empty());
        self.best().filter(|_| has_limits).map(line).collect()
    }

    /// What is said of each limit of any design.
    fn limits(&self) -> Table {
        let all = alike(self.best().flat_map(|own| &own.1.limits), |one, other| one.is_same(other));
        let row = |same: &Vec<&Limit>| {
            let limit = same[0];
            let cell = |(_, run): (&Design, &RunReport)| {
                let judged = run.judged().into_iter().find(|own| own.limit.is_same(limit));
                judged.map_or_else(
                    || format!("{NO_VERDICT} not a limit of this scene"),
                    |own| limits::short(run, &own),
                )
            };
            let kind = self.best().find_map(|(_, run)| run.measure(&limit.key));
            let name = format!("{} {}", limit.key, limits::stated(limit, kind));
            [name].into_iter().chain(self.best().map(cell)).collect()
        };
        let names = self.best().map(|(own, _)| own.heading.clone());
        let header = [self.side().heading("limit")].into_iter().chain(names);
        Table::new("Limits", header, all.iter().map(row))
    }

    /// What the scenes are: once what all are, else one by one.
    fn titles(&self) -> Vec<String> {
        let all = list(self.designs.iter().map(|own| title(&own.answer.scene)));
        match all.split_first() {
            Some((first, others)) if others.iter().all(|own| own == first) => {
                vec![(*first).to_owned()]
            }
            _ => {
                let named = self.designs.iter().zip(all).filter(|(own, title)| own.name != *title);
                list(named.map(|(own, title)| format!("{}: {title}", own.name)))
            }
        }
    }

    /// What was drawn for each design, and what no pad can beat there.
    fn scatter_and_floors(&self) -> Vec<Line> {
        let of = |(own, run): (&Design, &RunReport)| {
            let named = |line: Line| Line { text: format!("{}: {}", own.name, line.text), ..line };
            let floor = own.answer.floor.iter().flat_map(|floor| floor.lines(run));
            list(scatter::lines(run).into_iter().chain(floor).map(named))
        };
        list(self.best().flat_map(of))
    }

    /// The settings of each, with the hashes of its scene and files.
    fn settings(&self) -> Vec<Table> {
        let of = |own: &Design| {
            let table = settings_table(&own.answer);
            Table { caption: format!("{} of {}", table.caption, own.name), ..table }
        };
        list(self.designs.iter().map(of))
    }

    /// The text of each scene as it was run.
    fn scene_texts(&self) -> String {
        let of = |own: &Design| {
            let text = resolved_scene::text(&own.answer.scene, &own.answer.changes);
            format!("# {}\n{text}", own.name)
        };
        list(self.designs.iter().map(of)).join("\n")
    }

    fn solved(&self) -> Table {
        let row = |(own, run): (&Design, &RunReport)| {
            let worst = run.worst_relative_error().filter(|worst| worst.is_finite());
            vec![
                own.name.clone(),
                run.solver.method.to_owned(),
                worst.map_or("not known".to_owned(), |worst| format!("±{}", bound(worst))),
                duration(run.solver.wall_in_all),
            ]
        };
        let header = ["design", "method", "largest error", "time"];
        Table::new("Solved", &header, self.best().map(row))
    }

    /// The warnings of all, and which methods failed.
    fn warned_and_failed(&self) -> Vec<String> {
        self.warned(|own| {
            let failed = own.answer.failed.iter();
            list(failed.map(|(method, error)| format!("{method} failed: {error}")))
        })
    }

    /// The warnings of each design behind what else is said of it.
    fn warned(&self, more: impl Fn(&Design) -> Vec<String>) -> Vec<String> {
        self.of_each(|own| list(more(own).into_iter().chain(own.answer.new_warnings())))
    }

    /// What is said of each design, behind its name, or of all of them.
    fn of_each(&self, said: impl Fn(&Design) -> Vec<String>) -> Vec<String> {
        let all = list(self.designs.iter().map(|own| (own.name.as_str(), said(own))));
        let is_of_all = |text: &String| all.iter().all(|own| own.1.contains(text));
        each_once(all.iter().flat_map(|(name, texts)| {
            let all = texts.iter();
            all.map(move |own| if is_of_all(own) { own.clone() } else { format!("{name}: {own}") })
        }))
    }
}

impl Study for Designs {
    fn text(&self, text: &mut Text) {
        text.warnings(&self.warned_and_failed());
        text.title(&format!("{} designs side by side", self.designs.len()));
        self.titles().iter().for_each(|own| text.faint(own));
        text.blank();
        for line in self.verdicts().into_iter().chain(self.scatter_and_floors()) {
            text.labelled(line.label, LABELS, &line.text);
        }
        let limits = self.limits();
        for row in &limits.rows {
            text.labelled("limit", LABELS, &row[0]);
            for ((own, _), cell) in self.best().zip(&row[1..]) {
                text.labelled("", LABELS, &format!("{}: {cell}", own.name));
            }
        }
        if self.plot {
            let series = self.best().map(|(_, run)| curves(run, PLOT_POINTS)).collect();
            let figure = self.designs.first().map_or(&FORCE_TIME, |own| own.answer.plotted());
            let chart = figure.chart(&self.as_designs(series));
            text.blank();
            text.lines(&indented(&chart.text(WIDTH - 4, PLOT_HEIGHT)));
        }
        for table in measures_tables(&self.side(), WIDTH - 2) {
            text.figures(&table);
        }
        scatter::ranges(&self.side()).iter().for_each(|table| text.rows_below(table));
        deviations::show(&self.by_curve(), text);
        text.figures(&self.solved());
    }

    fn warnings(&self) -> Vec<String> {
        self.warned(|_| Vec::new())
    }

    /// One entry for each design and method, each with its scene.
    fn object(&self) -> impl Serialize {
        let run = |own: &Design, run: &RunReport| {
            serde_json::to_value(own.answer.object_of(run)).map(|mut value| {
                if let Some(object) = value.as_object_mut() {
                    let scene = &own.answer.scene;
                    let named = serde_json::json!({
                        "name": own.name, "title": scene.title, "file": scene.file,
                        "sha256": origin::of_text(scene), "files": origin::of_files(scene, &crate::input::load),
                        "values": own.answer.changes.set,
                        "warnings": said::warning_objects(scene), "notes": said::note_objects(scene),
                    });
                    object.insert("scene".to_owned(), named);
                }
                value
            })
        };
        let runs =
            self.designs.iter().flat_map(|own| own.answer.runs.iter().map(move |of| (own, of)));
        object! {
            dashpot: VERSION,
            settings: self.designs.first().and_then(|own| {
                own.answer.asked.first().map(|asked| settings(&own.answer, asked))
            }),
            runs: list(runs.filter_map(|(own, of)| run(own, of).ok())),
            failed: list(self.designs.iter().flat_map(|own| own.answer.failed.iter().map(|failed| object! {
                scene: &own.name, method: failed.0, error: failed.1.to_string(),
            }))),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        let series = self.as_designs(curves_and_energies(self.best().map(|own| own.1), POINTS));
        let wished = self.designs.first().map_or(&[][..], |own| &own.answer.wishes.written);
        let has = |kind: Written| kind.is_in(wished);
        let figures = if has(Written::Figures) || has(Written::Page) {
            files::add_figures(files, &series, wished)?
        } else {
            Vec::new()
        };
        let page = Page {
            title: format!("{} designs side by side", self.designs.len()),
            warnings: self
                .of_each(|own| said::warnings(&own.answer.scene, &own.answer.warnings()))
                .into_iter()
                .chain(self.warned_and_failed())
                .collect(),
            verdict: {
                let lines = self.verdicts().into_iter().chain(self.scatter_and_floors());
                let lines = lines.map(|line| format!("{}: {}", line.label, line.text));
                list(self.titles().into_iter().chain(lines))
            },
            tables: {
                let by_curve = self.by_curve();
                let found =
                    by_curve.iter().flat_map(|own| [deviations::table(own), compared::table(own)]);
                let found = found.flatten();
                let remarks = by_curve.iter().flat_map(|own| deviations::remarks(own));
                let notes = self.of_each(|own| said::notes(&own.answer.scene)).into_iter();
                let remarks = list(notes.chain(remarks));
                let side = self.side();
                let tables = [self.limits(), measures_table(&side)].into_iter();
                let tables = tables.chain(scatter::ranges(&side)).chain(found);
                let tables = tables.chain([Table::list("Remarks", remarks)]);
                list(tables.filter(|table| !table.rows.is_empty()))
            },
            figures,
            details: [self.solved()].into_iter().chain(self.settings()).collect(),
            scene_text: self.scene_texts(),
            ..Page::default()
        };
        if has(Written::Page) {
            files.add(files::PAGE, page.html())?;
        }
        if has(Written::Events) {
            let runs = self.best().map(|(own, run)| (own.name.as_str(), run));
            files.add_with(files::EVENTS, |out| files::write_events("design", runs, out))?;
        }
        for (at, (own, run)) in self.best().enumerate().filter(|_| has(Written::Curves)) {
            let times = files::sample_times(run, &own.answer.scene.run);
            let name = curves_file(at, &own.name);
            files.add_with(name, |out| files::write_table(run, &times, out))?;
        }
        Ok(())
    }
}
