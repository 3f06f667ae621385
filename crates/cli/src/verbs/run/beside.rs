//! Measured curves beside those of runs: what the command line asks for, and which output is meant.

use std::path::Path;

use clap::Args;
use dashpot_analysis::{Family, RunReport, excerpt, measured::Deviation, reported};
use dashpot_dae::Signal;
use dashpot_network::{Assembly, parameters::Dimension};
use dashpot_plot::{MeasuredSeries, Of};
use dashpot_scene::Scene;
use dashpot_signal::{Cfc, Channel, Padding, Recorder, iso_mme::ChannelCode};

use super::{columns::Columns, compared::Numbers, recorded::Recorded};
use crate::{
    args,
    error::{CliError, StudyError},
    operand::Files,
    output::list,
};
use dashpot_report::numbers::constant;
use dashpot_studies::{measured::MeasuredFile, origin, signal::mme};

/// Which measured curves stand beside the runs.
#[derive(Debug, Args)]
pub(super) struct MeasuredArguments {
    /// A measured curve beside the runs: a file with a column of time and one of force, deformation,
    /// acceleration or velocity, with their units, or a test in ISO-MME. "drop.csv:pad.force" says which output it
    /// measured, "drop.csv:Kraft=pad.force" in which column; repeatable.
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
    /// The channel frequency class that the measured curves went through: what the model says at their times goes
    /// through it as well [default: that of the code of an ISO-MME channel, else none].
    #[arg(long, value_name = "CLASS", requires = "measured", value_parser = args::single::<Cfc>)]
    cfc: Option<Cfc>,
}

impl MeasuredArguments {
    /// The curves, each beside an output of the scene.
    pub(super) fn read(&self, scene: &Scene) -> Result<Vec<MeasuredCurve>, CliError> {
        let (shift, assembly) = (self.shift.unwrap_or(0.0), &scene.assembly);
        let read = |own: &String| {
            let curve = MeasuredCurve::read((FLAG, own), shift, assembly)?;
            Ok(MeasuredCurve { cfc: self.cfc.or(curve.cfc), ..curve })
        };
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
    pub(in crate::verbs) of: Of,
}

/// The dimension of a signal.
pub(super) fn dimension(of: Of) -> Dimension {
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

    pub(in crate::verbs) fn dimension(&self) -> Dimension {
        dimension(self.of)
    }

    pub(in crate::verbs) fn unit(&self) -> &'static str {
        dimension(self.of).named().map_or("1", |own| own.1)
    }

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
    pub(super) fn foremost(assembly: &Assembly, of: Of) -> Option<Self> {
        let named = |name: &String| Self { name: name.clone(), of };
        let is_own = |at: &usize| {
            let is_part = |own: Option<usize>| own == Some(*at);
            !assembly.pads.iter().any(|pad| is_part(pad.contact) || is_part(pad.stop))
        };
        let found: Vec<Self> = match of {
            Of::Acceleration | Of::Velocity => {
                let all = reported(assembly, Family::Node).into_iter();
                all.map(|at| named(&assembly.nodes[at].name)).collect()
            }
            _ => {
                let all = reported(assembly, Family::Element).into_iter().filter(is_own);
                all.map(|at| named(&assembly.connections[at].name)).collect()
            }
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

#[derive(Debug, Clone)]
pub(in crate::verbs) struct MeasuredCurve {
    /// The file, as it is named.
    pub(in crate::verbs) file: String,
    pub(super) sha256: String,
    pub(super) column: String,
    pub(in crate::verbs) output: Output,
    /// (Time \[s\], value in SI units), moved.
    pub(in crate::verbs) rows: Vec<(f64, f64)>,
    /// How much later than in the file the rows are \[s\].
    pub(super) shift: f64,
    /// The filter that it went through.
    pub(super) cfc: Option<Cfc>,
    /// What is told of the file.
    pub(in crate::verbs) note: Option<String>,
}

/// A measured curve beside one run.
#[derive(Debug, Clone)]
pub(super) struct Beside {
    /// When in the run the time of the curve is 0 \[s\]: the first touch, or else the start.
    pub(super) zero: f64,
    pub(super) deviation: Deviation,
    /// What is read off both; `None` where two rows have the same time.
    pub(super) numbers: Option<Numbers>,
    /// The model as it was compared, where it went through a filter.
    pub(super) filtered: Option<Vec<(f64, f64)>>,
}

impl MeasuredCurve {
    pub(in crate::verbs) fn read(
        (flag, argument): (&'static str, &str),
        shift: f64,
        assembly: &Assembly,
    ) -> Result<Self, CliError> {
        let (name, column, output) = parts(argument);
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
        let chosen = |all: &Columns<'_>| match wanted {
            Some(Ok(output)) => Ok((all.measuring(column, &output)?, output)),
            Some(Err(fault)) => Err(fault),
            None => all.only_one(assembly, &known),
        };
        let sha256 = origin::of_file(name, &crate::input::load).unwrap_or_default();
        let file = name.to_owned();
        if mme::is_one(name, &Files) {
            let channels = mme::read(name, &Files)?;
            let (at, output) = chosen(&Columns::of_test((flag, name), &channels))?;
            let own = &channels[at];
            let samples = own.channel.times().iter().zip(own.channel.values());
            let rows = list(samples.map(|(time, value)| (time + shift, *value)));
            let class = own.code.as_ref().and_then(ChannelCode::filter_class);
            let cfc = class.and_then(|class| Cfc::new(class).ok());
            let column = own.channel.name().to_owned();
            return Ok(Self { file, sha256, column, output, rows, shift, cfc, note: None });
        }
        let read = MeasuredFile::read(flag, name, &crate::input::load)?;
        let table = read.table()?;
        let all = Columns::of_table((flag, name), &table);
        let (at, output) = chosen(&all)?;
        let time = read.only(&table, Dimension::TIME)?.ok_or_else(|| {
            read.unclear(format!(
                "no column is a time by its unit; write that into the header, as in `time [ms]`; it has {}",
                all.all()
            ))
        })?;
        let mut rows =
            read.points(&table, [(time, Dimension::TIME), (at, dimension(output.of))])?;
        if let Some(next) = (1..rows.len()).find(|&next| rows[next].0 < rows[next - 1].0) {
            let [before, after] = [rows[next - 1].0, rows[next].0].map(|own| constant(own, "s"));
            let line = table.lines()[next];
            return Err(read
                .unclear(format!(
                    "line {line}: the time {after} stands after {before}; sort the rows by time"
                ))
                .into());
        }
        if rows.len() < 2 {
            let found = if rows.is_empty() { "no row" } else { "one row" };
            return Err(read.unclear(format!(
                "there is {found} of numbers in it, and a curve has two at least: look whether it was exported whole"
            )).into());
        }
        rows.iter_mut().for_each(|row| row.0 += shift);
        let (column, note) = (all.title(at), read.notes(&table));
        Ok(Self { file, sha256, column, output, rows, shift, cfc: None, note })
    }

    fn unlike(&self, reason: String) -> CliError {
        StudyError::MeasuredColumn { flag: FLAG, file: self.file.clone(), reason }.into()
    }

    /// How far a run is from it.
    pub(super) fn beside(&self, run: &RunReport, scene: &Scene) -> Result<Beside, CliError> {
        let Some(recorded) = Recorded::of(run, &self.output) else {
            let reason = "is not kept in a network of this size; ask for a measure of it";
            return Err(self.unlike(format!("`{}` {reason}", self.output.key())));
        };
        let zero = recorded.zero;
        let window = excerpt(&run.solution());
        let filtered = self.cfc.map(|cfc| self.filtered(&recorded, cfc)).transpose()?;
        let signal = match &filtered {
            Some(own) => own,
            None => &recorded.signal,
        };
        let found = Deviation::over_time(&self.rows, (signal, window), zero);
        let deviation = found.ok_or_else(|| {
            let time = |own: Option<&(f64, f64)>| constant(own.map_or(0.0, |own| own.0), "s");
            let (from, to) = (time(self.rows.first()), time(self.rows.last()));
            let [start, end] = [window.0 - zero, window.1 - zero].map(|own| constant(own, "s"));
            let origin = if zero > 0.0 { "the first touch" } else { "the start of the run" };
            self.unlike(format!(
                "its rows, from {from} to {to}, and what figures show of the run, {start} to {end} from {origin}, \
                 have fewer than two rows other than zero in common; `--shift` moves them"
            ))
        })?;
        let is_inside = |own: &&(f64, f64)| (window.0..=window.1).contains(&(own.0 + zero));
        let rows: Vec<(f64, f64)> = list(self.rows.iter().filter(is_inside).copied());
        let numbers = Numbers::of((self, &rows), (signal, zero), run, scene);
        let drawn = |own: &Signal| list(rows.iter().map(|row| (row.0, own.value(row.0 + zero))));
        Ok(Beside { zero, deviation, numbers, filtered: filtered.as_ref().map(drawn) })
    }

    /// What a recorder with its times and this filter makes of a signal, as lines between samples, on the clock of the
    /// run.
    fn filtered(&self, recorded: &Recorded, cfc: Cfc) -> Result<Signal, CliError> {
        let unlike = |reason: String| {
            self.unlike(format!("the model cannot go through CFC {}: {reason}", cfc.class()))
        };
        let times = self.rows.iter().map(|own| own.0);
        let times: Vec<f64> = list(times.take_while(|own| own + recorded.zero <= recorded.end));
        let recorder = Recorder::new(times, Some((cfc, Padding::default())));
        let recorder = recorder.map_err(|own| unlike(own.to_string()))?;
        let values = recorder.record(|time| recorded.value(time));
        let times = list(recorder.times().iter().map(|own| own + recorded.zero));
        let channel = Channel::new(self.output.key(), dimension(self.output.of), times, values);
        Ok(channel.map_err(|own| unlike(own.to_string()))?.signal(1.0))
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
    let is_there = |end: &usize| Path::new(&argument[..*end]).exists();
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
