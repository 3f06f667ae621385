//! Measured curves beside those of runs: what the command line asks for, and which output is meant.

use std::path::Path;

use clap::Args;
use dashpot_analysis::{Family, RunReport, excerpt, measured::Deviation, reported};
use dashpot_network::{Assembly, parameters::Dimension};
use dashpot_plot::{MeasuredSeries, Of};
use dashpot_scene::{DataTable, Scene};

use super::series::first_touch;
use crate::{args, error::CliError, measured::MeasuredFile, numbers::constant, origin};

/// Which measured curves stand beside the runs.
#[derive(Debug, Args)]
pub(super) struct MeasuredArguments {
    /// A measured curve beside the runs: a file with a column of time and one of force, deformation,
    /// acceleration or velocity, with their units. "drop.csv:pad.force" says which output it measured,
    /// "drop.csv:Kraft=pad.force" in which column; repeatable.
    #[arg(long, value_name = "FILE[:[COLUMN=]OUTPUT]")]
    measured: Vec<String>,
    /// Moves the measured curves later by this time, or earlier, as in "-2.4 ms": their time 0 is that of the figures,
    /// the first touch.
    #[arg(
        long,
        value_name = "TIME",
        allow_hyphen_values = true,
        requires = "measured",
        value_parser = args::shift
    )]
    shift: Option<f64>,
}

impl MeasuredArguments {
    /// The curves, each beside an output of the scene.
    pub(super) fn read(&self, scene: &Scene) -> Result<Vec<MeasuredCurve>, CliError> {
        let (shift, assembly) = (self.shift.unwrap_or(0.0), &scene.assembly);
        let read = |own: &String| MeasuredCurve::read((FLAG, own), shift, assembly);
        self.measured.iter().map(read).collect()
    }
}

/// The option, for messages.
const FLAG: &str = "--measured";

/// An output of a scene that can be measured.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::verbs) struct Output {
    /// Name of the element or mass.
    name: String,
    /// Which signal.
    pub(in crate::verbs) of: Of,
}

/// What can be measured over time.
const MEASURABLE: [Of; 4] = [Of::Force, Of::Acceleration, Of::Velocity, Of::Deformation];

/// The dimension of a signal.
fn dimension(of: Of) -> Dimension {
    match of {
        Of::Time => Dimension::TIME,
        Of::Force => Dimension::FORCE,
        Of::Deformation => Dimension::LENGTH,
        Of::Acceleration => Dimension::ACCELERATION,
        Of::Velocity => Dimension::VELOCITY,
        Of::Energy => Dimension::ENERGY,
    }
}

impl Output {
    /// Name of its element or mass.
    pub(in crate::verbs) fn name(&self) -> &str {
        &self.name
    }

    /// What it is called: `pad.force`.
    pub(in crate::verbs) fn key(&self) -> String {
        format!("{}.{}", self.name, self.of.word())
    }

    /// What it measures.
    pub(in crate::verbs) fn dimension(&self) -> Dimension {
        dimension(self.of)
    }

    /// Its SI unit.
    pub(in crate::verbs) fn unit(&self) -> &'static str {
        dimension(self.of).named().map_or("1", |own| own.1)
    }

    /// All of a network.
    fn all(assembly: &Assembly) -> Vec<Self> {
        let elements = assembly.connections.iter().flat_map(|own| {
            let force = own.force.map(|_| Of::Force);
            force.into_iter().chain([Of::Deformation]).map(|of| (&own.name, of))
        });
        let masses = assembly.nodes.iter().filter(|own| own.free && own.mass > 0.0);
        let masses = masses.flat_map(|own| {
            let acceleration = own.acceleration.map(|_| Of::Acceleration);
            let velocity = own.velocity.map(|_| Of::Velocity);
            [acceleration, velocity].into_iter().flatten().map(|of| (&own.name, of))
        });
        let all = elements.chain(masses);
        all.map(|(name, of)| Self { name: name.clone(), of }).collect()
    }

    /// That of a signal which a run would tell of without being asked, where there is one only: of the pad that is
    /// struck, or of the impactor. A contact or stop that belongs to a pad is none of its own.
    fn foremost(assembly: &Assembly, of: Of) -> Option<Self> {
        let named = |name: &String| Self { name: name.clone(), of };
        let found: Vec<Self> = match of {
            Of::Acceleration | Of::Velocity => reported(assembly, Family::Node)
                .into_iter()
                .map(|at| named(&assembly.nodes[at].name))
                .collect(),
            _ => reported(assembly, Family::Element)
                .into_iter()
                .filter(|at| {
                    let is_part = |own: Option<usize>| own == Some(*at);
                    !assembly.pads.iter().any(|pad| is_part(pad.contact) || is_part(pad.stop))
                })
                .map(|at| named(&assembly.connections[at].name))
                .collect(),
        };
        let [one] = <[Self; 1]>::try_from(found).ok()?;
        Some(one)
    }

    /// Its number in the system of a network, and the sign that makes it what is measured: accelerometers count away
    /// from the support.
    pub(in crate::verbs) fn place(&self, assembly: &Assembly) -> Option<(usize, f64)> {
        let node = || assembly.nodes.iter().find(|own| own.name == self.name);
        Some(match self.of {
            Of::Force => (assembly.connection(&self.name)?.force?, 1.0),
            Of::Deformation => (assembly.connection(&self.name)?.deformation, 1.0),
            Of::Acceleration => (node()?.acceleration?, -1.0),
            Of::Velocity => (node()?.velocity?, 1.0),
            Of::Time | Of::Energy => return None,
        })
    }
}

/// A measured curve.
#[derive(Debug, Clone)]
pub(in crate::verbs) struct MeasuredCurve {
    /// The file, as it is named.
    pub(in crate::verbs) file: String,
    pub(super) sha256: String,
    /// Name of the column.
    pub(super) column: String,
    /// What it measured.
    pub(in crate::verbs) output: Output,
    /// (Time \[s\], value in SI units), moved.
    pub(in crate::verbs) rows: Vec<(f64, f64)>,
    /// How much later than in the file the rows are \[s\].
    pub(super) shift: f64,
    /// What is told of the file.
    pub(in crate::verbs) note: Option<String>,
}

/// A measured curve beside one run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside {
    /// When in the run the time of the curve is 0 \[s\]: the first touch, or else the start.
    pub(super) zero: f64,
    pub(super) deviation: Deviation,
}

impl MeasuredCurve {
    pub(in crate::verbs) fn read(
        (flag, argument): (&'static str, &str),
        shift: f64,
        assembly: &Assembly,
    ) -> Result<Self, CliError> {
        let (name, column, output) = parts(argument);
        let file = MeasuredFile::read(flag, name)?;
        let known = Output::all(assembly);
        let wanted = output.map(|wanted| {
            let found = known.iter().find(|own| own.key() == wanted).cloned();
            found.ok_or_else(|| CliError::NotMeasurable {
                flag,
                file: name.to_owned(),
                name: wanted.to_owned(),
                known: known.iter().map(Output::key).collect(),
            })
        });
        let table = file.table()?;
        let (at, output) = match wanted.transpose()? {
            Some(output) => (column_of(&file, &table, column, &output)?, output),
            None => only_one(&file, &table, assembly, &known)?,
        };
        let time = file.only(&table, Dimension::TIME)?.ok_or_else(|| {
            let has = columns(&table);
            file.unclear(format!(
                "no column is a time by its unit; write that into the header, as in `time [ms]`; it has {has}"
            ))
        })?;
        let mut rows =
            file.points(&table, [(time, Dimension::TIME), (at, dimension(output.of))])?;
        if let Some(next) = (1..rows.len()).find(|&next| rows[next].0 < rows[next - 1].0) {
            let [before, after] = [rows[next - 1].0, rows[next].0].map(|own| constant(own, "s"));
            let line = table.lines()[next];
            return Err(file.unclear(format!(
                "line {line}: the time {after} stands after {before}; sort the rows by time"
            )));
        }
        rows.iter_mut().for_each(|row| row.0 += shift);
        let (column, note) = (title(&table, at), file.notes(&table));
        let sha256 = origin::of_file(name).unwrap_or_default();
        Ok(Self { file: name.to_owned(), sha256, column, output, rows, shift, note })
    }

    /// How far a run is from it.
    pub(super) fn beside(&self, run: &RunReport) -> Result<Beside, CliError> {
        let unlike = |reason: String| CliError::MeasuredColumn {
            flag: FLAG,
            file: self.file.clone(),
            reason,
        };
        let place = self.output.place(&run.assembly);
        let kept = place.filter(|own| run.trajectory.keeps(&run.assembly.system, own.0));
        let Some((output, sign)) = kept else {
            let reason = "is not kept in a network of this size; ask for a measure of it";
            return Err(unlike(format!("`{}` {reason}", self.output.key())));
        };
        let signal = run.solution().signal(output).scaled(sign);
        let zero = first_touch(run).unwrap_or(0.0);
        let window = excerpt(&run.solution());
        let found = Deviation::over_time(&self.rows, (&signal, window), zero);
        let deviation = found.ok_or_else(|| {
            let time = |own: Option<&(f64, f64)>| constant(own.map_or(0.0, |own| own.0), "s");
            let (from, to) = (time(self.rows.first()), time(self.rows.last()));
            let [start, end] = [window.0 - zero, window.1 - zero].map(|own| constant(own, "s"));
            let origin = if zero > 0.0 { "the first touch" } else { "the start of the run" };
            unlike(format!(
                "its rows, from {from} to {to}, and what figures show of the run, {start} to {end} from {origin}, \
                 have fewer than two rows other than zero in common; `--shift` moves them"
            ))
        })?;
        Ok(Beside { zero, deviation })
    }

    /// It as a figure draws it.
    pub(super) fn series(&self) -> MeasuredSeries {
        let file = Path::new(&self.file).file_name();
        let file = file.map_or_else(|| self.file.clone(), |own| own.to_string_lossy().into_owned());
        let name = format!("measured, {file}: {}", self.column);
        MeasuredSeries { name, of: self.output.of, points: self.rows.clone() }
    }
}

/// File, column and output of an argument. A file may have a colon in its name.
fn parts(argument: &str) -> (&str, Option<&str>, Option<&str>) {
    let colons = argument.match_indices(':').map(|own| own.0);
    let mut ends = [argument.len()].into_iter().chain(colons.rev());
    let is_there = |end: &usize| Path::new(&argument[..*end]).is_file();
    let end = ends.clone().find(is_there).or_else(|| ends.nth(1));
    let end = end.unwrap_or(argument.len());
    let Some(rest) = argument[end..].strip_prefix(':') else {
        return (&argument[..end], None, None);
    };
    match rest.rsplit_once('=') {
        Some((column, output)) => (&argument[..end], Some(column.trim()), Some(output.trim())),
        None => (&argument[..end], None, Some(rest.trim())),
    }
}

/// The column that measured an output: the one that is named, or has its name, or the only one of its dimension.
fn column_of(
    file: &MeasuredFile,
    table: &DataTable<'_>,
    named: Option<&str>,
    output: &Output,
) -> Result<usize, CliError> {
    let key = output.key();
    if let Some(name) = named {
        let is_known = (0..table.columns()).any(|at| table.heading(at).name == name);
        if !is_known {
            let has = columns(table);
            return Err(file.unclear(format!("there is no column `{name}`; it has {has}")));
        }
        let at = table.position(name).map_err(|own| file.fault(own))?;
        if table.heading(at).unit.is_none() {
            return Err(file.unclear(format!(
                "the column `{name}` has no unit; write it into the header, as in `{name} [{}]`",
                output.unit()
            )));
        }
        if !table.measuring(dimension(output.of)).contains(&at) {
            let (word, has) = (a_word(output.of), columns(table));
            return Err(file.unclear(format!(
                "the column `{name}` is not {word} by its unit, as `{key}` is; it has {has}"
            )));
        }
        return Ok(at);
    }
    if let Ok(at) = table.position(&key) {
        return Ok(at);
    }
    let found = file.only(table, dimension(output.of))?;
    found.ok_or_else(|| {
        file.unclear(format!(
            "no column is {} by its unit, as `{key}` is; it has {}",
            a_word(output.of),
            columns(table)
        ))
    })
}

/// The only column that measured what can be measured, and the output that it tells of.
fn only_one(
    file: &MeasuredFile,
    table: &DataTable<'_>,
    assembly: &Assembly,
    known: &[Output],
) -> Result<(usize, Output), CliError> {
    let found: Vec<(usize, Of)> = MEASURABLE
        .into_iter()
        .flat_map(|of| table.measuring(dimension(of)).into_iter().map(move |at| (at, of)))
        .collect();
    let [(at, of)] = found[..] else {
        let which = match found.len() {
            0 => "no column is a force, deformation, acceleration or velocity by its unit",
            _ => "several columns may be meant: say which, as in `drop.csv:Kraft=pad.force`",
        };
        return Err(file.unclear(format!("{which}; it has {}", columns(table))));
    };
    let title = title(table, at);
    if let Some(own) = known.iter().find(|own| own.key() == title) {
        return Ok((at, own.clone()));
    }
    let of_kind: Vec<&Output> = known.iter().filter(|own| own.of == of).collect();
    let only = match of_kind[..] {
        [one] => Some(one.clone()),
        _ => Output::foremost(assembly, of),
    };
    let names = || of_kind.iter().map(|own| own.key()).collect::<Vec<_>>().join(", ");
    let output = only.ok_or_else(|| {
        file.unclear(match of_kind.len() {
            0 => format!("`{title}` is {}, which the scene has none of", a_word(of)),
            _ => format!(
                "`{title}` may be any of {}; say which, as in `drop.csv:{}`",
                names(),
                of_kind[0].key()
            ),
        })
    })?;
    Ok((at, output))
}

fn a_word(of: Of) -> String {
    let word = of.word();
    format!("{} {word}", if word.starts_with('a') { "an" } else { "a" })
}

/// The name of a column, or else its number.
fn title(table: &DataTable<'_>, at: usize) -> String {
    match table.heading(at).name {
        "" => format!("column {}", at + 1),
        name => name.to_owned(),
    }
}

/// All columns with their units.
fn columns(table: &DataTable<'_>) -> String {
    let one = |at: usize| {
        let unit = table.heading(at).unit.map_or(String::new(), |unit| format!(" [{unit}]"));
        format!("`{}{unit}`", title(table, at))
    };
    (0..table.columns()).map(one).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn an_argument_is_a_file_and_perhaps_a_column_and_an_output() {
        assert_eq!(parts("drop.csv"), ("drop.csv", None, None));
        assert_eq!(parts("drop.csv:pad.force"), ("drop.csv", None, Some("pad.force")));
        let all = ("drop.csv", Some("F = 2"), Some("pad.force"));
        assert_eq!(parts("drop.csv:F = 2=pad.force"), all);
        // A file that is there is meant as it stands.
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a:b.csv");
        std::fs::write(&path, "").unwrap();
        let path = path.to_str().unwrap();
        assert_eq!(parts(path), (path, None, None));
        assert_eq!(parts(&format!("{path}:pad.force")), (path, None, Some("pad.force")));
    }
}
