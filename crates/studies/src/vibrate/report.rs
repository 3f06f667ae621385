//! What shaking has shown, as tables, figures and in words.

use std::f64::consts::PI;

use dashpot_analysis::vibration::{
    Drive, DriveKind, Mode, QUANTITIES, Quantity, Resonance, Steady, SteadyElement, SteadyNode,
    SteadySupport, Sweep, Swing, Transmission, VibrationWarning,
};
use dashpot_plot::{VibrationCurve, VibrationSeries};
use dashpot_report::{
    Block, Columns, Place, Report, Table,
    layout::{WIDTH, capital, width},
    numbers::{Unit, bound, quantity},
};
use dashpot_units::STANDARD_GRAVITY as GRAVITY;

use super::Vibrated;
use crate::{Answer as _, Cell, DataTable, list};

/// Ratios and phases at all frequencies.
const TABLE: &str = "response.csv";
const PHASE: &str = "phase.svg";
/// Digits in the text of a peak.
const PEAK_DIGITS: usize = 3;

/// Digits of what is computed.
const DIGITS: usize = 4;
/// More rows of a table are left out; of frequencies at regular distances.
const MOST_ROWS: usize = 25;
/// What does not exist.
const NONE: &str = "–";

/// Everything that is said of it.
pub(super) fn report(vibrated: &Vibrated) -> Report {
    let Vibrated { sweep, steady, page, .. } = vibrated;
    let mut report = Report::titled(&page.title);
    report.warnings = vibrated.warnings();
    report.asked.push(drive(sweep));
    if let Some(state) = steady {
        report.tables(self::steady(state));
        report.tables(vibrated.is_chosen.then(|| ratios(sweep, state.frequency)));
        report.notes(steady_notes(state));
    }
    report.tables([modes(sweep), resonances(sweep)]);
    report.notes(range_notes(sweep));
    report.notes(sweep.notes.iter().map(VibrationWarning::to_string));
    if steady.is_none() {
        let (content, left_out) = response(sweep, WIDTH - 2);
        report.block(Place::Terminals, Block::Table(content));
        let notes = left_out.map(|left_out| format!("{left_out}; `--out` writes all of them"));
        report.block(Place::Terminals, Block::Notes(list(notes)));
    }
    for series in series(sweep) {
        report.plot(figure(&series.quantity), series.ratio_chart());
    }
    let phases = of(sweep, String::new(), "", |shown| shown.has_phase);
    if !phases.curves.is_empty() {
        report.figure(PHASE, phases.phase_chart());
    }
    report.details = vec![response(sweep, usize::MAX).0, page.settings.clone()];
    report.network.clone_from(&page.network);
    report.scene_text.clone_from(&page.scene_text);
    report
}

/// The names of all files, with a figure for each of these quantities.
pub(super) fn files(quantities: &[&Quantity], drive: DriveKind) -> Vec<String> {
    let figures = quantities.iter().map(|quantity| figure(&title(quantity, drive)));
    figures.chain([PHASE, TABLE].map(str::to_owned)).collect()
}

fn figure(title: &str) -> String {
    format!("{}.svg", title.replace(' ', "-"))
}

/// Ratios and phases at all frequencies.
pub(super) fn table(sweep: &Sweep) -> DataTable<'_> {
    let all = &sweep.transmissions;
    let header = all.iter().flat_map(|Transmission { name, unit, .. }| {
        [("ratio", *unit), ("phase", "deg"), ("error", *unit)]
            .map(|(what, unit)| format!("{what} of {name} [{unit}]"))
    });
    let header = ["frequency [Hz]".to_owned()].into_iter().chain(header);
    let row = |(at, frequency): (usize, &f64)| {
        let values = all.iter().flat_map(|transmission| {
            let swing = transmission.swings[at];
            let phase = swing.filter(|_| transmission.has_phase);
            let phase = phase.map(|swing| degrees(swing.phase));
            [swing.map(|swing| swing.amplitude), phase, swing.map(|swing| swing.error)]
        });
        [Some(*frequency)].into_iter().chain(values).map(Cell::Number).collect()
    };
    let rows = sweep.frequencies.iter().enumerate().map(row);
    DataTable { file: TABLE.to_owned(), header: list(header), rows: Box::new(rows) }
}

fn degrees(phase: f64) -> f64 {
    phase * (180.0 / PI)
}

/// What is driven, and what the ratios are.
fn drive(sweep: &Sweep) -> String {
    let Drive { name, node, kind } = &sweep.drive;
    let (driven, amplitude) = match kind {
        DriveKind::Motion => (format!("motion of `{name}`"), "displacement"),
        DriveKind::Load => (format!("load `{name}` on `{node}`"), "force"),
    };
    let amplitude = format!("the {amplitude} of `{name}`");
    let of_quantity = quantities(sweep).into_iter().map(|own| {
        let about = own.about.replace("{}", &amplitude);
        format!("{}: {about}.", capital(&title(own, *kind)))
    });
    let text = format!("The {driven} is a sine, all else that drives is silent.");
    [text].into_iter().chain(of_quantity).collect::<Vec<_>>().join(" ")
}

/// The quantities of all responses, each once.
fn quantities(sweep: &Sweep) -> Vec<&'static Quantity> {
    let is_shown =
        |own: &&Quantity| sweep.transmissions.iter().any(|shown| shown.quantity == own.word);
    QUANTITIES.iter().filter(is_shown).collect()
}

/// The name of a quantity in words.
fn title(quantity: &Quantity, drive: DriveKind) -> String {
    if quantity.word == drive.usual().word {
        return "transmissibility".to_owned();
    }
    quantity.word.replace('-', " ")
}

fn ratio(value: f64) -> String {
    Unit::plain("1").number(value, DIGITS)
}

fn amplitude(swing: Option<Swing>, unit: &str) -> String {
    swing.map_or(NONE.to_owned(), |swing| quantity(swing.amplitude, unit, DIGITS))
}

fn phase(swing: Option<Swing>) -> String {
    swing.map_or(NONE.to_owned(), |swing| Unit::plain("1").decimal(degrees(swing.phase), 1))
}

fn hertz(value: f64) -> String {
    quantity(value, "Hz", DIGITS)
}

/// The modes, each with what its masses do.
fn modes(sweep: &Sweep) -> Table {
    let shape = sweep.modes.iter().find_map(|mode| mode.shape.as_ref());
    let columns = Columns::new()
        .column("mode", |(at, _): &(usize, &Mode)| (at + 1).to_string())
        .column("frequency", |(_, mode)| hertz(mode.frequency))
        .column("damping ζ", |(_, mode)| Unit::plain("1").number(mode.damping_ratio, 3));
    let of_masses = shape.into_iter().flatten().enumerate();
    let columns = of_masses.fold(columns, |columns, (place, mass)| {
        columns.column(&mass.node, move |(_, mode)| {
            let part = mode.shape.as_ref().and_then(|shape| shape.get(place));
            part.map_or_else(|| NONE.to_owned(), |part| part_of_mode(part.swing))
        })
    });
    let rows = sweep.modes.iter().enumerate().take(MOST_ROWS);
    columns.table("Modes, with the displacement of each mass", rows)
}

/// A displacement relative to the largest one: with its sign where it is in phase or opposed, else with its phase.
fn part_of_mode(swing: Swing) -> String {
    let text = Unit::plain("1").number(swing.amplitude, 3);
    let rounded = degrees(swing.phase).round();
    if swing.amplitude <= swing.error || rounded == 0.0 {
        text
    } else if rounded.abs() >= 180.0 {
        format!("−{text}")
    } else {
        format!("{text} ∠{}°", Unit::plain("1").decimal(degrees(swing.phase), 0))
    }
}

/// The resonances of every response, up to a number of them.
fn resonances(sweep: &Sweep) -> Table {
    let rows =
        sweep.transmissions.iter().flat_map(|of| of.resonances.iter().map(move |at| (of, at)));
    Columns::new()
        .column("", |(of, _): &(&Transmission, &Resonance)| of.name.clone())
        .column("frequency", |(_, at)| hertz(at.frequency))
        .column("ratio", |(of, at)| amplitude(at.swing, of.unit))
        .column("phase °", |(of, at)| phase(at.swing.filter(|_| of.has_phase)))
        .column("Q", |(_, at)| at.quality().map_or(NONE.to_owned(), ratio))
        .column("half power", |(_, at)| {
            at.band
                .map_or(NONE.to_owned(), |[low, high]| format!("{} to {}", hertz(low), hertz(high)))
        })
        .table("Resonances", rows.take(MOST_ROWS))
}

/// What is to be known beside the tables, in whole sentences.
fn range_notes(sweep: &Sweep) -> Vec<String> {
    let all = || sweep.transmissions.iter();
    let mut range_notes = Vec::new();
    let still: Vec<&str> =
        all().filter(|own| own.resonances.is_empty()).map(|own| own.name.as_str()).collect();
    if !still.is_empty() {
        range_notes.push(format!("no resonance of {} in this range", still.join(", ")));
    }
    let count = all().map(|own| own.resonances.len()).sum::<usize>();
    if count > MOST_ROWS {
        range_notes
            .push(format!("{MOST_ROWS} of {count} resonances; `--of` chooses, `--json` has all"));
    }
    if all().flat_map(|own| &own.resonances).any(|own| own.swing.is_none()) {
        range_notes.push("a resonance without a ratio is not damped: it has no limit".to_owned());
    }
    range_notes.push(format!("limit at slow oscillation: {}", limits(&sweep.transmissions)));
    let worst = all().map(Transmission::worst_error).fold(0.0, f64::max);
    range_notes.push(format!("every ratio within {}, by rounding", bound(worst)));
    range_notes
}

/// The limits of slow oscillation; one that all have in common is said once.
fn limits(all: &[Transmission]) -> String {
    let text = |transmission: &Transmission| {
        let at_rest = transmission.at_rest;
        at_rest.map_or("none".to_owned(), |own| quantity(own.amplitude, transmission.unit, DIGITS))
    };
    match all {
        [first, _, ..] if all.iter().all(|own| text(own) == text(first)) => {
            format!("{} of all", text(first))
        }
        _ => {
            let each: Vec<String> =
                all.iter().map(|own| format!("{} of {}", text(own), own.name)).collect();
            each.join(", ")
        }
    }
}

/// Ratios and phases over frequency, as many responses as fit into so many columns, and a word on what is left out.
fn response(sweep: &Sweep, columns: usize) -> (Table, Option<String>) {
    let total = sweep.frequencies.len();
    let count = total.min(MOST_ROWS);
    let places: Vec<usize> =
        (0..count).map(|at| (at * (total - 1) + (count - 1) / 2) / (count - 1).max(1)).collect();
    let caption = match quantities(sweep)[..] {
        [only] => capital(&title(only, sweep.drive.kind)),
        _ => "Responses".to_owned(),
    };
    let whole = |shown: &[Transmission]| {
        let columns =
            Columns::new().column("frequency", |at: &usize| hertz(sweep.frequencies[*at]));
        let columns = shown.iter().fold(columns, |columns, of| {
            let columns = columns.column(&of.name, |at| amplitude(of.swings[*at], of.unit));
            if of.has_phase {
                columns.column("phase °", |at| phase(of.swings[*at]))
            } else {
                columns
            }
        });
        columns.table(&caption, places.iter().copied())
    };
    let all = &sweep.transmissions;
    let fitting = (1..=all.len()).rev().find(|&own| width(&whole(&all[..own])) <= columns);
    let shown = fitting.unwrap_or(1);
    let mut left_out = Vec::new();
    if count < total {
        left_out.push(format!("{count} of {total} frequencies"));
    }
    if shown < all.len() {
        left_out.push(format!("{shown} of {} responses; `--of` chooses others", all.len()));
    }
    let note = (!left_out.is_empty()).then(|| left_out.join(", "));
    (whole(&all[..shown]), note)
}

/// The peaks of the steady state.
fn steady(steady: &Steady) -> Vec<Table> {
    let drive = &steady.drive;
    let size = quantity(steady.amplitude, drive.kind.unit(), DIGITS);
    let caption = format!("Peaks at {} with {size} of {}", hertz(steady.frequency), drive.name);
    let nodes = Columns::new()
        .column("node", |node: &&SteadyNode| node.name.clone())
        .column("displacement", |node| amplitude(Some(node.displacement), "m"))
        .column("acceleration", |node| amplitude(Some(node.acceleration), "m/s^2"))
        .column("", |node| format!("{} g", ratio(node.acceleration.amplitude / GRAVITY)))
        .column("phase °", |node| phase(Some(node.displacement)));
    let elements = Columns::new()
        .column("element", |element: &&SteadyElement| element.name.clone())
        .column("force", |element| amplitude(element.force, "N"))
        .column("phase °", |element| phase(element.force))
        .column("deformation", |element| amplitude(Some(element.deformation), "m"))
        .column("phase °", |element| phase(Some(element.deformation)))
        .column("dissipates", |element| quantity(element.power, "W", DIGITS));
    let supports = Columns::new()
        .column("support", |support: &&SteadySupport| support.name.clone())
        .column("force", |support| amplitude(Some(support.force), "N"))
        .column("phase °", |support| phase(Some(support.force)));
    vec![
        nodes.table(caption, &steady.nodes),
        elements.table("", &steady.elements),
        supports.table("", &steady.supports),
    ]
}

/// The ratios of what is looked at, at the frequency of the steady state.
fn ratios(sweep: &Sweep, frequency: f64) -> Table {
    Columns::new()
        .column("", |of: &&Transmission| of.name.clone())
        .column("ratio", |of| amplitude(of.at, of.unit))
        .column("phase °", |of| phase(of.at.filter(|_| of.has_phase)))
        .table(format!("Responses at {}", hertz(frequency)), &sweep.transmissions)
}

/// What is to be known beside them.
fn steady_notes(steady: &Steady) -> Vec<String> {
    let power = steady.power.map(|power| {
        // A power that only rounding makes is none.
        format!("the drive puts in {} on average", quantity(power.max(0.0), "W", DIGITS))
    });
    let note = "weights and other constant forces come on top; elements pull as they push";
    power.into_iter().chain([note.to_owned()]).collect()
}

/// The responses as the plain numbers that figures are drawn from, with their peaks between the frequencies of the list:
/// quantity by quantity.
fn series(sweep: &Sweep) -> Vec<VibrationSeries> {
    let kind = sweep.drive.kind;
    let series = |own: &Quantity| {
        of(sweep, title(own, kind), own.unit(kind), |shown| shown.quantity == own.word)
    };
    quantities(sweep).into_iter().map(series).collect()
}

fn of(
    sweep: &Sweep,
    quantity: String,
    unit: &str,
    is_shown: impl Fn(&Transmission) -> bool,
) -> VibrationSeries {
    let shown = sweep.transmissions.iter().filter(|own| is_shown(own));
    VibrationSeries {
        title: format!("Response to {}", sweep.drive.name),
        quantity,
        unit: Unit::plain(unit).symbol,
        curves: list(shown.map(|own| curve(sweep, own))),
    }
}

fn curve(sweep: &Sweep, transmission: &Transmission) -> VibrationCurve {
    let swings = sweep.frequencies.iter().copied().zip(transmission.swings.iter().copied());
    let resonances = transmission.resonances.iter().map(|own| (own.frequency, own.swing));
    let mut points: Vec<(f64, Option<Swing>)> = swings.chain(resonances).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let peaks = transmission.resonances.iter().filter_map(|resonance| {
        let height = resonance.swing?.amplitude;
        let height_text = quantity(height, transmission.unit, PEAK_DIGITS);
        let label =
            format!("{height_text} at {}", quantity(resonance.frequency, "Hz", PEAK_DIGITS));
        Some((resonance.frequency, height, label))
    });
    let value = |of: fn(Swing) -> f64| {
        points.iter().map(|point| point.1.map_or(f64::NAN, of)).collect::<Vec<f64>>()
    };
    VibrationCurve {
        name: transmission.name.clone(),
        frequency: points.iter().map(|point| point.0).collect(),
        ratio: value(|own| own.amplitude),
        phase: value(|own| degrees(own.phase)),
        peaks: peaks.collect(),
    }
}
