//! `sweep --gradient`: what measures change with.

use std::io;

use dashpot_analysis::{
    gradients::{
        Derivative, GradientReport, MeasureGradient, NoDerivative, Number, gradients, unit_of,
    },
    sweep::{Grid, ScenePoint, SweepError},
};
use dashpot_report::Table;
use dashpot_scene::{Scene, TunableFault, Tunables};
use dashpot_units::{Dimension, si_unit, significant};
use serde::Serialize;

use super::{SweepArguments, Varied};
use crate::{
    args::When,
    error::{CliError, Status, StudyError},
    folder::{Folder, Staged},
    input::title,
    operand::print_notes,
    output::{Study, Text, alike, csv, emit, list, object},
    progress::Bar,
    terminal::Terminal,
};
use dashpot_report::numbers::{Unit, digits, percent_signed, quantity};
use dashpot_studies::origin;

pub(super) const TABLE: &str = "gradients.csv";
/// The unit of a number that is written without one.
const BARE: &str = "SI unit";
/// Digits of a derivative, whatever its error.
const MOST_DIGITS: usize = 5;

/// Poses the scene of a text.
type PoseValues<'p> =
    dyn Fn(&Tunables, &[(usize, String)]) -> Result<ScenePoint, String> + Sync + 'p;

/// What was varied, and what was found at each point.
struct Gradients {
    scene: Scene,
    varied: Varied,
    grid: Grid,
    reports: Vec<GradientReport>,
    /// When the tables are for people.
    table: When,
}

/// Finds the derivatives at all points, and says them.
pub(super) fn gradient(
    arguments: &SweepArguments,
    (scene, varied, grid): (Scene, Varied, Grid),
    keys: &[String],
    pose: &PoseValues<'_>,
    folder: Option<Folder>,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let threads = arguments.threads();
    let names = &arguments.gradient;
    let mut places = Vec::with_capacity(names.len());
    for name in names {
        let place = varied.tunables.find(name.trim()).map_err(CliError::Gradient)?;
        if let Some(before) = places.iter().position(|other| *other == place) {
            let (first, second) = (names[before].clone(), name.clone());
            return Err(CliError::Gradient(TunableFault::Twice { first, second }));
        }
        places.push(place);
    }
    let is_set = |(name, _): &&(String, String)| {
        varied.tunables.find(name).is_ok_and(|at| places.contains(&at))
    };
    if let Some((name, _)) = arguments.scene.values.set.iter().find(is_set) {
        return Err(CliError::SetAndVaried { name: name.clone() });
    }
    let mut bar = Bar::new("gradients", 0.0, terminal.error.attended);
    let count = grid.len();
    let mut reports = Vec::with_capacity(count);
    for point in 0..count {
        let text = varied.text_at(&grid.places(point));
        reports.push(at_point(&text, (&scene, &places), keys, threads, pose)?);
        let done = point + 1;
        if bar.count(done, count).is_break() {
            return Err(SweepError::BrokenOff.into());
        }
    }
    let found = Gradients { scene, varied, grid, reports, table: arguments.output.table };
    print_notes(&found.scene.notes);
    emit(&found, arguments.output.json, folder, terminal)?;
    Ok(Status::Done)
}

/// The derivatives of the scene of a text with respect to the numbers at these places.
fn at_point(
    text: &str,
    (scene, places): (&Scene, &[usize]),
    keys: &[String],
    threads: usize,
    pose: &PoseValues<'_>,
) -> Result<GradientReport, CliError> {
    let tunables = Tunables::of(text, scene.file.as_deref()).map_err(StudyError::Scene)?;
    let numbers = list(places.iter().map(|&at| {
        let own = &tunables.all()[at];
        let unit = match own.dimension {
            None => BARE.to_owned(),
            Some(Dimension::NUMBER) => "1".to_owned(),
            Some(dimension) => si_unit(dimension),
        };
        Number::new(own.name.clone(), unit, own.value)
    }));
    let written = |(number, value): (&Number, &f64)| match number.unit.as_str() {
        "1" | BARE => value.to_string(),
        unit => format!("{value} {unit}"),
    };
    let report = gradients(&numbers, keys, threads, &|values| {
        let written = numbers.iter().zip(values).map(written);
        pose(&tunables, &list(places.iter().copied().zip(written)))
    })?;
    Ok(report)
}

impl Study for Gradients {
    fn text(&self, text: &mut Text) {
        text.title(title(&self.scene));
        for (point, report) in self.reports.iter().enumerate() {
            if let Some(values) = self.at(point) {
                text.heading(&values);
            }
            let numbers = report.numbers.iter().map(|own| match own.unit.as_str() {
                BARE => format!("{} = {}", own.name, own.value),
                unit => format!("{} = {}", own.name, quantity(own.value, unit, MOST_DIGITS)),
            });
            text.faint(&format!(
                "{}; {} solutions by {}",
                list(numbers).join(", "),
                report.solutions,
                report.method
            ));
            text.table(&elasticities(report));
            text.table(&derivatives(report));
            let refused = refusals(report);
            if !refused.is_empty() {
                text.blank();
                text.items(refused);
            }
        }
    }

    fn data(&self, terminal: Terminal, out: &mut Vec<u8>) -> Option<()> {
        if self.table.is_now(terminal.output.attended) { None } else { self.table(out).ok() }
    }

    fn notes(&self) -> Vec<String> {
        list(self.reports.iter().flat_map(refusals))
    }

    fn object(&self) -> impl Serialize {
        let points = self.reports.iter().enumerate();
        object! {
            #[serde(flatten)]
            head: origin::head(&self.scene, &crate::input::load),
            varied: list(self.varied.variations.iter().map(|own| &own.name)),
            points: list(points.map(|(at, report)| object! {
                at: self.values(at), #[serde(flatten)] report,
            })),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files.add_with(TABLE, |out| self.table(out))
    }
}

impl Gradients {
    /// The values of what varies at a point, as they are written.
    fn values(&self, point: usize) -> Vec<String> {
        let places = self.varied.places(&self.grid.places(point));
        list(self.varied.variations.iter().zip(places).map(|(own, place)| own.text(place)))
    }

    /// The same with their names; `None` where nothing varies.
    fn at(&self, point: usize) -> Option<String> {
        let names = self.varied.variations.iter();
        let all =
            list(names.zip(self.values(point)).map(|(own, text)| format!("{} = {text}", own.name)));
        (!all.is_empty()).then(|| all.join(", "))
    }

    /// One line for each measure and number of each point, as CSV in SI units; what is missing is blank.
    fn table(&self, out: &mut dyn io::Write) -> io::Result<()> {
        let names = self.varied.variations.iter().map(|own| own.name.clone());
        let own =
            ["measure", "value", "unit", "number", "derivative", "error", "unit of derivative"];
        let more = ["percent per percent", "refused"];
        let header = names.chain(own.into_iter().chain(more).map(str::to_owned));
        let rows = self.reports.iter().enumerate().flat_map(|(point, report)| {
            rows(report).map(move |(measure, number, own)| {
                let shown = |value: Option<f64>| value.map_or(String::new(), |own| own.to_string());
                let found = own.as_ref().ok();
                let cells = [
                    measure.key.clone(),
                    shown(measure.value),
                    measure.unit.to_owned(),
                    number.name.clone(),
                    shown(found.map(|own| own.value)),
                    shown(found.map(|own| own.error)),
                    unit_of(measure.unit, &number.unit),
                    shown(found.and_then(|own| own.elasticity)),
                    own.as_ref().err().map_or(String::new(), ToString::to_string),
                ];
                list(self.values(point).into_iter().chain(cells))
            })
        });
        csv(out, header, rows)
    }
}

type Cell<'r> = (&'r MeasureGradient, &'r Number, &'r Result<Derivative, NoDerivative>);

/// Every measure and event with every number.
fn rows(report: &GradientReport) -> impl Iterator<Item = Cell<'_>> {
    let all = report.measures.iter().chain(&report.events);
    all.flat_map(|own| {
        report.numbers.iter().zip(&own.derivatives).map(move |(number, found)| (own, number, found))
    })
}

/// What has no derivative, and why; each reason once, with all that it holds for.
fn refusals(report: &GradientReport) -> Vec<String> {
    let refused = rows(report).filter_map(|(own, number, found)| {
        Some(((&number.name, found.as_ref().err()?), own.key.as_str()))
    });
    let count = report.measures.len() + report.events.len();
    list(alike(refused, |one, other| one.0 == other.0).iter().map(|group| {
        let ((number, why), keys) = (group[0].0, list(group.iter().map(|own| own.1)));
        let keys = if keys.len() == count { "all".to_owned() } else { keys.join(", ") };
        format!("{keys} by {number}: {why}")
    }))
}

/// A table with a line for each measure and event, and a column for each number.
fn by_number(
    report: &GradientReport,
    caption: &str,
    first: &str,
    cell: impl Fn(Cell<'_>) -> String,
) -> Table {
    let names = report.numbers.iter().map(|own| own.name.as_str());
    let header = [first].into_iter().chain(names);
    let rows = report.measures.iter().chain(&report.events).map(|own| {
        let cells = report.numbers.iter().zip(&own.derivatives);
        let cells = cells.map(|(number, found)| cell((own, number, found)));
        list([own.key.clone()].into_iter().chain(cells))
    });
    Table::new(caption, header, rows)
}

/// What stands where there is no derivative.
const NONE: &str = "–";

/// By how many percent a measure changes.
fn elasticities(report: &GradientReport) -> Table {
    by_number(report, "", "1 % more of", |(_, _, found)| match found {
        Ok(Derivative { value, error, .. }) if value.abs() <= *error => "0 %".to_owned(),
        Ok(Derivative { elasticity: Some(own), .. }) => {
            percent_signed(own / 100.0).replace('−', "-")
        }
        Ok(_) | Err(_) => NONE.to_owned(),
    })
}

/// The derivatives themselves, in SI units.
fn derivatives(report: &GradientReport) -> Table {
    by_number(report, "Derivatives, in SI units", "measure", |(own, number, found)| match found {
        Ok(Derivative { value, error, .. }) if value.abs() <= *error => "0".to_owned(),
        Ok(Derivative { value, error, .. }) => {
            let number_text = significant(*value, digits(*value, Some(*error), MOST_DIGITS));
            let unit = Unit::plain(&unit_of(own.unit, &number.unit));
            format!("{number_text} {}", unit.symbol).trim_end().to_owned()
        }
        Err(_) => NONE.to_owned(),
    })
}
