//! Files that results are written to.

use std::{
    fs::{self, File, OpenOptions},
    io::{BufWriter, ErrorKind, Read, Write},
    path::{Path, PathBuf},
};

use dashpot_analysis::{RunReport, regular_times, resolving_times, table_at, touching};
use dashpot_plot::{ReportFigure, figures::FIGURES};
use dashpot_scene::RunSettings;

use crate::{
    answer::{Answer, document, page},
    as_run,
    error::CliError,
    series::curves_and_energies,
    sketch::{MOST_DRAWN, sketch},
    terminal::{WIDTH, note, print},
    text::wrapped,
};

/// The file that also marks a folder as one of results.
pub(crate) const RESULT: &str = "result.json";
/// The beginning of that file.
const MARK: &str = "{\n  \"dashpot\"";
/// The scene with what the command line changed.
const SCENE: &str = "scene-as-run.toml";
/// The drawing of the network.
const DRAWING: &str = "network.svg";
/// Everything on one page.
const PAGE: &str = "report.html";
/// The names of the files of the last results, so that the next ones leave none of them behind.
const LIST: &str = ".dashpot-files";
/// A file that is made and removed at once.
const PROBE: &str = ".dashpot-probe";
/// Figures show at least so many points, and at most so many.
const POINTS: (usize, usize) = (4001, 20_001);
/// Rows of a table that are in memory at once.
const CHUNK: usize = 4096;

/// Makes the folder `path` if need be, and finds out whether files can be written there, so that
/// no run is done in vain. Returns whether it was made.
pub(crate) fn prepare(path: &Path) -> Result<bool, CliError> {
    let figures = FIGURES.iter().map(|figure| format!("{}.svg", figure.name()));
    prepare_for(path, figures.chain([SCENE, DRAWING, PAGE].map(str::to_owned)))
}

/// The same for files of these names, and that of the result.
pub(crate) fn prepare_for(
    path: &Path,
    names: impl IntoIterator<Item = String>,
) -> Result<bool, CliError> {
    if path.is_file() {
        return Err(CliError::NotAFolder { path: path.to_owned() });
    }
    let is_there = path.is_dir();
    fs::create_dir_all(path).map_err(unwritable(path))?;
    refuse_foreign(path, names.into_iter())?;
    let probe = path.join(PROBE);
    File::create(&probe).and_then(|_| fs::remove_file(&probe)).map_err(unwritable(path))?;
    Ok(!is_there)
}

/// Refuses to write over files of these names that no run has written.
fn refuse_foreign(path: &Path, names: impl Iterator<Item = String>) -> Result<(), CliError> {
    if is_folder_of_results(path) {
        return Ok(());
    }
    let mut files = names.chain([RESULT.to_owned()]).map(|name| path.join(name));
    match files.find(|file| file.exists()) {
        Some(path) => Err(CliError::Foreign {
            path,
            help: "`--out` overwrites its own results only: choose another folder, or move the file \
                   away",
        }),
        None => Ok(()),
    }
}

/// Writes everything that an answer holds into the folder `path`, and returns the names of the
/// files.
pub(crate) fn write(answer: &Answer, path: &Path) -> Result<Vec<String>, CliError> {
    let mut texts = vec![(SCENE.to_owned(), as_run::text(&answer.scene, &answer.changes))];
    let network = &answer.scene.network;
    let is_drawn = network.connections().len() <= MOST_DRAWN;
    let drawing = is_drawn.then(|| sketch(network, answer.scene.run.duration).svg());
    let (low, high) = POINTS;
    let count = answer.scene.run.samples.clamp(low, high);
    let series = curves_and_energies(&answer.runs, count);
    let mut figures = Vec::new();
    if let Some(svg) = drawing {
        figures.push(ReportFigure { caption: "The network".to_owned(), svg: svg.clone() });
        texts.push((DRAWING.to_owned(), svg));
    }
    for figure in FIGURES {
        let chart = figure.chart(&series);
        // Of a rigid contact alone there is no force over a deformation.
        if chart.series.is_empty() {
            continue;
        }
        let svg = chart.svg()?;
        figures.push(ReportFigure { caption: String::new(), svg: svg.clone() });
        texts.push((format!("{}.svg", figure.name()), svg));
    }
    texts.push((PAGE.to_owned(), page(answer, figures).html()));
    let tables: Vec<(String, &RunReport)> =
        answer.runs.iter().map(|run| (format!("{}.csv", run.solver.method), run)).collect();
    let names = texts.iter().map(|(name, _)| name).chain(tables.iter().map(|(name, _)| name));
    refuse_foreign(path, names.cloned())?;
    // The mark comes first, so that a second attempt may complete what a first one began.
    let json = serde_json::to_string_pretty(&document(answer))? + "\n";
    texts.insert(0, (RESULT.to_owned(), json));
    let mut written = Vec::new();
    for (name, text) in texts {
        let file = path.join(&name);
        fs::write(&file, text).map_err(unwritable(&file))?;
        written.push(name);
    }
    for (name, run) in tables {
        let file = path.join(&name);
        let times = sample_times(run, &answer.scene.run);
        write_table(run, &times, &file).map_err(unwritable(&file))?;
        written.push(name);
    }
    Ok(written)
}

/// Removes what earlier results have left in the folder `path` beside the `written` files, and tells
/// what was done: where results are printed, or on standard error beside a document.
pub(crate) fn settle(path: &Path, written: &[String], beside: bool) -> Result<(), CliError> {
    let list = path.join(LIST);
    let known = fs::read_to_string(&list).unwrap_or_default();
    // Names alone: nothing outside of the folder is touched.
    let is_name = |name: &&str| Path::new(name).file_name().is_some_and(|own| own == *name);
    let is_left = |name: &&str| written.iter().all(|own| own != name) && path.join(name).is_file();
    let left: Vec<&str> = known.lines().filter(is_name).filter(is_left).collect();
    for name in &left {
        let file = path.join(name);
        fs::remove_file(&file).map_err(unwritable(&file))?;
    }
    fs::write(&list, written.join("\n") + "\n").map_err(unwritable(&list))?;
    let folder = path.display();
    let mut lines = wrapped(&format!("wrote {} to {folder}", written.join(", ")), WIDTH);
    if !left.is_empty() {
        let removed = format!("removed {} of earlier results from {folder}", left.join(", "));
        lines.extend(wrapped(&removed, WIDTH));
    }
    let text = lines.join("\n");
    if beside {
        note(&text);
        return Ok(());
    }
    print(&format!("\n{text}\n"))
}

/// Writes `text` to a file that is not there yet, or in place of one with `force`.
pub(crate) fn write_new(path: &Path, text: &str, force: bool) -> Result<(), CliError> {
    let mut options = OpenOptions::new();
    if force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    match options.write(true).open(path).and_then(|mut file| file.write_all(text.as_bytes())) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            Err(CliError::Foreign { path: path.to_owned(), help: "`--force` overwrites it" })
        }
        Err(error) => Err(unwritable(path)(error)),
    }
}

/// An error of the system at this path.
pub(crate) fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> CliError + use<> {
    let path = PathBuf::from(path);
    move |source| CliError::Unwritable { path: path.clone(), source }
}

fn is_folder_of_results(path: &Path) -> bool {
    let mut start = [0; MARK.len()];
    let read = File::open(path.join(RESULT)).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == *MARK.as_bytes()
}

/// Regular times where the scene says how many, else times closer to each other in short contacts.
fn sample_times(run: &RunReport, settings: &RunSettings) -> Vec<f64> {
    let (end, count) = (run.trajectory.t_end, settings.samples);
    if settings.samples_given {
        return regular_times(end, count);
    }
    resolving_times((0.0, end), &touching(&run.solution()), count)
}

/// Writes all outputs at these times \[s\] as CSV.
fn write_table(run: &RunReport, times: &[f64], file: &Path) -> std::io::Result<()> {
    let mut writer = csv::Writer::from_writer(BufWriter::new(File::create(file)?));
    let mut header = Some("time [s]".to_owned());
    for chunk in times.chunks(CHUNK) {
        let table = table_at(&run.assembly, &run.trajectory, chunk.to_vec());
        if let Some(time) = header.take() {
            let names = table.columns.iter().map(|own| format!("{} [{}]", own.name, own.unit));
            writer.write_record([time].into_iter().chain(names))?;
        }
        for (row, time) in table.times.iter().enumerate() {
            let values = table.columns.iter().map(|column| column.values[row]);
            // A zero has no sign.
            let record: Vec<f64> = [*time].into_iter().chain(values).map(|own| own + 0.0).collect();
            writer.serialize(record)?;
        }
    }
    let mut inner = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
    inner.flush()
}

#[cfg(test)]
mod tests {
    use dashpot_analysis::solve;
    use dashpot_dae::Silent;
    use dashpot_scene::{ReadOptions, read};

    use super::*;

    #[test]
    fn samples_resolve_a_short_contact_unless_the_scene_says_how_many() {
        let text = "[nodes]\nhead = { mass = \"4 kg\", drop = \"1 m\" }\n[elements]\n\
            pad = { between = [\"head\", \"ground\"], spring = \"1 MN/m\" }\n[effects]\n\
            separation.pad = {}\ngravity = { value = \"9.81 m/s^2\" }\n[run]\n";
        let times = |run: &str| {
            let scene = read(&format!("{text}{run}"), &ReadOptions::default()).unwrap().value;
            let report = solve(&scene.network, &scene.settings("exact"), &mut Silent).unwrap();
            sample_times(&report, &scene.run)
        };
        let met = (2.0_f64 / 9.81).sqrt();
        let left = met + std::f64::consts::PI * (4.0_f64 / 1e6).sqrt();
        let within = |times: &[f64]| times.iter().filter(|t| (met..left).contains(*t)).count();
        let free = times("duration = \"600 ms\"\n");
        assert_eq!((free.len(), free[0], free[500]), (501, 0.0, 0.6));
        assert!(within(&free) > 200, "{}", within(&free));
        let given = times("duration = \"600 ms\"\nsamples = 501\n");
        assert_eq!(given, regular_times(0.6, 501));
    }
}
