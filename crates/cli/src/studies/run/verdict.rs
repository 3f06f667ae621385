//! The answer in a few lines.

use dashpot_analysis::{
    Contact, ContactReport, MeasureKind, MeasureReport, RunReport, is_impactor, ledger,
    measures::{
        ContactTime, EndVelocity, Energy, Hic, Hic15, Hic36, PeakAcceleration, PeakDeformation,
        PeakForce, STANDARD_GRAVITY, SeverityIndex, TransmittedForce,
    },
};
use dashpot_network::parameters::WindowWish;

use super::{
    Answer,
    partial::{left_out, put_back},
    zero::Zeros,
};
use crate::numbers::{self, Unit, bound, constant, quantity, rounded, share};

/// Digits of a number that is read in passing.
const DIGITS: usize = 4;
/// Accuracies beyond this are not to be had with double precision.
const FINEST: f64 = 1e-10;
/// Digits of a time.
const TIME_DIGITS: usize = 3;
/// Work from outside is spoken of beyond this part of the impact's energy.
const LITTLE: f64 = 5e-4;
/// A smaller share is none.
const ZERO: f64 = 1e-9;
/// A force elsewhere is larger if it is so by this part.
const MARGIN: f64 = 1e-3;
/// What follows the release.
const GLUED: &str = ", then it pulls as if glued (separation is off)";

/// A peak within this part of the run from its end is where the run ends.
const LAST: f64 = 1e-9;
/// Of a peak where the run ends.
const SO_FAR: &str = " so far, still rising at the end of the run";
/// What the errors of a run that ends in contact do not say.
const CUT: &str = "; the run ends in contact, so that figures are those so far";

/// One line of the verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Line {
    /// What it is about.
    pub(super) label: &'static str,
    /// What it says.
    pub(super) text: String,
}

/// What a person wants to know first, from the most accurate run.
pub(super) fn verdict(answer: &Answer) -> Vec<Line> {
    let Some(run) = answer.best() else { return Vec::new() };
    let lines = [
        ("stopped", stopped(run)),
        ("peak force", peak_force(answer, run)),
        ("of it", of_it(answer, run)),
        ("elsewhere", elsewhere(run)),
        ("peak g", peak_g(answer, run)),
        ("deepest point", deepest(answer, run)),
        ("energy", energy(answer, run)),
        ("contact", contact(answer, run)),
        ("injury", injury(run)),
        ("left out", left_out(run)),
        ("put back", put_back(run)),
        ("how wrong", how_wrong(answer, run)),
        ("next digit", next_digit(answer, run)),
    ];
    lines.into_iter().filter_map(|(label, text)| Some(Line { label, text: text? })).collect()
}

/// The measure of this kind with the largest value.
fn largest<'r>(run: &'r RunReport, kind: &str) -> Option<(&'r MeasureReport, f64)> {
    let of_kind = run.measures.iter().filter(|measure| measure.kind == kind);
    let valued = of_kind.filter_map(|measure| measure.value.map(|value| (measure, value)));
    valued.max_by(|one, other| one.1.total_cmp(&other.1))
}

/// The first measure of this kind that is infinite: it has a time, and no value there.
fn infinite<'r>(run: &'r RunReport, kind: &str) -> Option<(&'r MeasureReport, String)> {
    let of_kind = run.measures.iter().filter(|measure| measure.kind == kind);
    of_kind
        .filter(|measure| measure.value.is_none())
        .find_map(|measure| Some((measure, quantity(measure.time?, "s", TIME_DIGITS))))
}

fn shown(answer: &Answer, measure: &MeasureReport, value: f64) -> String {
    let zeros = Zeros::of(&answer.runs);
    if zeros.has(measure) {
        return format!("0 {}", zeros.unit(measure).symbol);
    }
    quantity(value, measure.unit, numbers::digits(value, measure.error, DIGITS))
}

/// Where and when, and what else is to be said.
fn whereabouts(answer: &Answer, measure: &MeasureReport) -> String {
    // A zero is there at any time.
    let time = measure.time.filter(|_| !Zeros::of(&answer.runs).has(measure));
    let time = time.map(|time| format!(" at {}", quantity(time, "s", TIME_DIGITS)));
    // Which way it points, as in `in tension`; other notes stand below the table.
    let note = measure.note.as_ref().filter(|note| note.starts_with("in "));
    let note = note.map(|note| format!(" ({note})"));
    let (time, note) = (time.unwrap_or_default(), note.unwrap_or_default());
    let so_far = if is_so_far(answer, measure) { SO_FAR } else { "" };
    format!(" in {}{time}{so_far}{note}", measure.target)
}

/// Whether a peak is one of a run that ends before the peak.
fn is_so_far(answer: &Answer, measure: &MeasureReport) -> bool {
    let is_last = |run: &RunReport| {
        let end = run.trajectory.t_end;
        is_cut(run) && measure.time.is_some_and(|time| time >= (1.0 - LAST) * end)
    };
    answer.best().is_some_and(is_last)
}

/// Whether the run ends while something is still pressed.
fn is_cut(run: &RunReport) -> bool {
    run.contacts.iter().any(|own| own.impact.contact == Contact::Lasting)
}

/// The force of a padding and its stop together, where it is more than that of each: at the contact of
/// the padding, or where it has none on what lies behind; in the window of the headline.
fn whole_contact(run: &RunReport) -> Option<String> {
    let (headline, most) = largest(run, PeakForce::KIND)?;
    let (place, peak, time) = at_contact(run, headline).or_else(|| behind(run, headline))?;
    (peak.is_finite() && peak > most * (1.0 + MARGIN)).then(|| {
        let (force, time) = (quantity(peak, "N", TIME_DIGITS), quantity(time, "s", TIME_DIGITS));
        format!("{force} {place} at {time}")
    })
}

/// The name of the padding that the headline is about, or whose stop.
fn padding_of(headline: &MeasureReport) -> &str {
    headline.target.strip_suffix(".stop").unwrap_or(&headline.target)
}

fn at_contact(run: &RunReport, headline: &MeasureReport) -> Option<(String, f64, f64)> {
    let element = format!("{}.contact", padding_of(headline));
    let at = run.assembly.connections.iter().position(|own| own.name == element)?;
    let (from, to) = headline.window?;
    let in_window = PeakForce { window: WindowWish::Times(from, to) };
    let reading = MeasureKind::read(&in_window, &run.solution(), at);
    // Where masses meet in it, it has a time and no value.
    let peak = reading.value.unwrap_or(f64::INFINITY);
    Some((format!("in {element}"), peak, reading.time?))
}

fn behind(run: &RunReport, headline: &MeasureReport) -> Option<(String, f64, f64)> {
    let pad = padding_of(headline);
    let connections = &run.assembly.connections;
    let at = connections.iter().position(|own| own.name == pad)?;
    run.assembly.connection(&format!("{pad}.stop"))?;
    let (from, to) = headline.window?;
    let in_window = TransmittedForce { window: WindowWish::Times(from, to) };
    let reading = MeasureKind::read(&in_window, &run.solution(), at);
    Some((format!("behind {pad} with its stop"), reading.value?, reading.time?))
}

/// The largest force of one element, where the headline is that of a whole contact.
fn of_it(answer: &Answer, run: &RunReport) -> Option<String> {
    whole_contact(run)?;
    let (measure, value) = largest(run, PeakForce::KIND)?;
    Some(format!("{}{}", shown(answer, measure, value), whereabouts(answer, measure)))
}

fn peak_force(answer: &Answer, run: &RunReport) -> Option<String> {
    if let Some(whole) = whole_contact(run) {
        return Some(whole);
    }
    if let Some((measure, time)) = infinite(run, PeakForce::KIND) {
        return Some(format!("infinite in {} at {time}, where the speed jumps", measure.target));
    }
    let (measure, value) = largest(run, PeakForce::KIND)?;
    Some(format!("{}{}", shown(answer, measure, value), whereabouts(answer, measure)))
}

fn peak_g(answer: &Answer, run: &RunReport) -> Option<String> {
    if let Some((measure, time)) = infinite(run, PeakAcceleration::KIND) {
        return Some(format!("infinite on {} at {time}, where the speed jumps", measure.target));
    }
    let (measure, value) = largest(run, PeakAcceleration::KIND)?;
    let digits = numbers::digits(value, measure.error, DIGITS);
    let in_g = Unit::new("g", STANDARD_GRAVITY).text(value, digits);
    let place = whereabouts(answer, measure).replacen(" in ", " on ", 1);
    Some(format!("{in_g} ({}){place}", shown(answer, measure, value)))
}

/// The pad with the least left of its thickness, or else the deepest point.
fn deepest(answer: &Answer, run: &RunReport) -> Option<String> {
    let of_kind = run.measures.iter().filter(|measure| measure.kind == PeakDeformation::KIND);
    let pads = of_kind.filter_map(|measure| {
        let connection = run.assembly.connection(&measure.target)?;
        let thickness = connection.thickness?;
        let (from, to) = measure.window?;
        let compressed = run.solution().signal(connection.deformation).maximum((from, to)).value;
        Some((measure, compressed, thickness))
    });
    let share_left = |pad: &(&MeasureReport, f64, f64)| (pad.2 - pad.1) / pad.2;
    let tightest = pads.min_by(|one, other| share_left(one).total_cmp(&share_left(other)));
    let Some((measure, compressed, thickness)) = tightest else {
        let (measure, value) = largest(run, PeakDeformation::KIND)?;
        return Some(format!("{}{}", shown(answer, measure, value), whereabouts(answer, measure)));
    };
    let (left, limit) = (thickness - compressed, constant(thickness, "m"));
    let digits = numbers::digits(left, measure.error, TIME_DIGITS);
    let rest = quantity(left.abs(), "m", digits);
    let margin = if left >= 0.0 {
        format!("{rest} of {limit} left")
    } else {
        format!("{rest} MORE than its {limit}")
    };
    Some(format!(
        "{}{}, {margin}",
        shown(answer, measure, measure.value?),
        whereabouts(answer, measure)
    ))
}

fn energy(answer: &Answer, run: &RunReport) -> Option<String> {
    let (measure, value) = largest(run, Energy::KIND)?;
    let impact = run.impact_energy();
    let amount = shown(answer, measure, value);
    let name = &measure.target;
    let has_impactor = run.assembly.nodes.iter().any(is_impactor);
    if !has_impactor {
        return Some(format!("{name} takes up {amount}"));
    }
    let until = measure.window.map_or(run.energy.time, |(_, end)| end);
    let Some(work) = work_in(run, until) else {
        return Some(format!("{name} takes up {amount}"));
    };
    if impact <= LITTLE * work {
        // What falls begins without energy, or with what little its layers hold at rest.
        let whole = rounded(work, "J", TIME_DIGITS);
        let part =
            if value <= work { format!(" ({})", share(value / work)) } else { String::new() };
        return Some(format!("{name} takes up {amount} of {whole} put in{part}"));
    }
    let whole = rounded(impact, "J", DIGITS);
    let added = if work > LITTLE * impact {
        format!(" and {} put in", rounded(work, "J", TIME_DIGITS))
    } else {
        String::new()
    };
    let part = value / (impact + work.max(0.0));
    // What rests on springs at the start may be given to the pad as well.
    let is_told = part <= 1.0 + LITTLE && part.abs() > ZERO;
    let part = if is_told && !Zeros::of(&answer.runs).has(measure) {
        format!(" ({})", share(part))
    } else {
        String::new()
    };
    Some(format!("{name} takes up {amount} of {whole}{added}{part}"))
}

/// The work done from outside \[J\] from the start until a time \[s\]; unknown within the run of a large
/// network.
fn work_in(run: &RunReport, until: f64) -> Option<f64> {
    if run.energy.work_in.is_empty() {
        return Some(0.0);
    }
    let ledgers = run.energy_after_impact.iter().chain([&run.energy]);
    let known = ledgers.into_iter().find(|own| (own.time - until).abs() <= 1e-9 * own.time);
    let work = known.map_or_else(
        || ledger::ledger(&run.solution(), until).total_work_in(),
        dashpot_analysis::Ledger::total_work_in,
    );
    (!work.is_nan()).then_some(work)
}

/// The element with the largest force, where that is none of those that are reported.
fn elsewhere(run: &RunReport) -> Option<String> {
    if whole_contact(run).is_some() {
        return None;
    }
    if infinite(run, PeakForce::KIND).is_some() {
        return None;
    }
    let (headline, most) = largest(run, PeakForce::KIND)?;
    let (element, peak) = run.largest_force()?;
    if peak.value.is_infinite() {
        let time = quantity(peak.time, "s", TIME_DIGITS);
        return Some(format!("infinite in {element} at {time}, where the speed jumps"));
    }
    let margin = headline.error.filter(|error| error.is_finite()).unwrap_or(0.0);
    let is_larger = peak.value > most + margin.max(MARGIN * most);
    (element != headline.target && is_larger).then(|| {
        let (force, time) =
            (quantity(peak.value, "N", TIME_DIGITS), quantity(peak.time, "s", TIME_DIGITS));
        let when = match headline.window {
            Some((from, _)) if peak.time < from => ", before the impact",
            Some((_, to)) if peak.time > to => ", after the impact",
            _ => "",
        };
        format!("{force} in {element} at {time}{when}")
    })
}

fn stopped(run: &RunReport) -> Option<String> {
    let event = run.stopped_by()?;
    Some(format!("at {}: {}", quantity(event.time, "s", TIME_DIGITS), event.what))
}

fn contact(answer: &Answer, run: &RunReport) -> Option<String> {
    if !run.assembly.nodes.iter().any(is_impactor) {
        let opened = opened(run).map_or(String::new(), |text| format!("; {text}"));
        return Some(format!("no impactor: the measures are those of the whole run{opened}"));
    }
    let of = |contact: Contact| run.contacts.iter().find(|own| own.impact.contact == contact);
    if let Some(contact) = of(Contact::Lasting) {
        let end = quantity(contact.impact.end, "s", TIME_DIGITS);
        let time = run.measure(&format!("{}.{}", contact.element, ContactTime::KIND));
        let is_open = time.and_then(|own| own.error).is_some_and(f64::is_infinite);
        let [whether, or_not] = if is_open { ["whether ", " is open"] } else { [""; 2] };
        let element = &contact.element;
        return Some(format!(
            "{whether}{element} still pushes at the end of the run ({end}){or_not}"
        ));
    }
    if !run.contacts.iter().any(|own| own.impact.has_ended()) {
        let pulling =
            |own: &ContactReport| format!("{}: it pulls from the start", never(&own.element));
        let unloaded =
            |own: &ContactReport| format!("{}: it never has a force", never(&own.element));
        let found = of(Contact::Pulling).map(pulling);
        return found.or_else(|| of(Contact::Unloaded).map(unloaded));
    }
    let (measure, value) = largest(run, ContactTime::KIND)?;
    let contact = run.contacts.iter().find(|own| own.element == measure.target);
    let pulls = contact.is_some_and(|own| {
        own.is_glued
            && own.impact.contact == Contact::Released
            && own.impact.end < run.trajectory.t_end
    });
    let pulls = if pulls { GLUED } else { "" };
    let leaving = leaving(run).map_or(String::new(), |text| format!("; {text}"));
    let again = contact.map_or(String::new(), again);
    Some(format!("{} in {}{pulls}{leaving}{again}", shown(answer, measure, value), measure.target))
}

/// How often contacts let go in a run without impactors.
fn opened(run: &RunReport) -> Option<String> {
    let of_contact = |own: &&dashpot_dae::Switch| own.what == "open";
    let mut opened = run.trajectory.switches.iter().filter(of_contact);
    let first = opened.next()?;
    let name = first.name.trim_end_matches(".contact");
    let more = opened.filter(|own| own.name == first.name).count();
    let time = quantity(first.time, "s", TIME_DIGITS);
    Some(match more {
        0 => format!("{name} lets go at {time}"),
        count => format!("{name} lets go {} times, first at {time}", count + 1),
    })
}

/// How often they meet again.
fn again(contact: &ContactReport) -> String {
    match contact.again {
        0 => String::new(),
        1 => "; they meet once more".to_owned(),
        count => format!("; they meet {count} times more"),
    }
}

fn never(element: &str) -> String {
    format!("the {element} is never pressed")
}

/// The speed of the fastest impactor when it is let go.
fn leaving(run: &RunReport) -> Option<String> {
    let solution = run.solution();
    let nodes = run.assembly.nodes.iter().enumerate().filter(|(_, node)| is_impactor(node));
    let speeds = nodes.filter_map(|(at, node)| {
        let reading = MeasureKind::read(&EndVelocity::default(), &solution, at);
        Some((node, reading.value?))
    });
    let (node, speed) = speeds.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))?;
    let digits = numbers::digits(1.0, run.worst_relative_error(), TIME_DIGITS);
    let text = quantity(speed.abs(), "m/s", digits);
    let start = node.start_velocity.unwrap_or(0.0);
    Some(if speed * start < 0.0 {
        format!("{} leaves at {text}", node.name)
    } else {
        format!("{} then goes on at {text}", node.name)
    })
}

/// Whether a measure of this kind is an index that has seconds as its unit but is no time.
pub(super) fn is_index(kind: &str) -> bool {
    kind == SeverityIndex::KIND || is_hic(kind)
}

fn is_hic(kind: &str) -> bool {
    [Hic::KIND, Hic15::KIND, Hic36::KIND].contains(&kind)
}

/// The name of an index; of a head injury criterion with the longest interval that it may have, which
/// is not to be guessed: `HIC15`.
fn index_name(run: &RunReport, measure: &MeasureReport) -> String {
    if measure.kind != Hic::KIND {
        let name = measure.kind.replace('-', " ");
        return if is_hic(measure.kind) { name.to_uppercase() } else { name };
    }
    let cap = measure.parameters.iter().find_map(|(_, value)| value.number());
    match cap.filter(|cap| *cap < run.trajectory.t_end) {
        Some(cap) => format!("HIC up to {}", constant(cap, "s")),
        None => "HIC without a cap".to_owned(),
    }
}

fn injury(run: &RunReport) -> Option<String> {
    let indices = run.measures.iter().filter(|measure| is_index(measure.kind));
    let texts = indices.filter_map(|measure| {
        let name = format!("{} of {}", index_name(run, measure), measure.target);
        let Some(value) = measure.value else {
            return measure.time.map(|_| format!("{name} is infinite"));
        };
        let digits = numbers::digits(value, measure.error, DIGITS);
        let number = Unit::plain(measure.unit).text(value, digits);
        let found = measure.window.filter(|_| is_hic(measure.kind)).map_or(String::new(), |own| {
            let [from, to] = [own.0, own.1].map(|time| quantity(time, "s", TIME_DIGITS));
            format!(" (from {from} to {to})")
        });
        Some(format!("{name} {number}{found}"))
    });
    let texts: Vec<String> = texts.take(3).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

/// That errors include what the segments of layers make of the figures.
fn and_segments(run: &RunReport) -> String {
    run.segmentation.as_ref().map_or(String::new(), |own| {
        format!(" and {} segments of layers beside {}", own.segments, own.others)
    })
}

fn how_wrong(answer: &Answer, run: &RunReport) -> Option<String> {
    let method = run.solver.method;
    let mut valued = run.measures.iter().filter(|own| own.value.is_some_and(|own| own != 0.0));
    let is_unknown = valued.clone().next().is_some() && valued.all(|own| own.error.is_none());
    let own = match run.worst_relative_error() {
        None if run.measures.is_empty() => return None,
        None if answer.asked.iter().any(|asked| asked.estimate) && is_unknown => {
            "it is not known: no further solutions came about to tell errors".to_owned()
        }
        None if answer.asked.iter().any(|asked| asked.estimate) => {
            "no figure has a size to be wrong by".to_owned()
        }
        None => "errors were not estimated".to_owned(),
        Some(worst) if !worst.is_finite() => {
            "some figures come and go with the tolerance; see the table".to_owned()
        }
        Some(worst) if run.solver.rtol.is_none() => {
            let method = format!("a bound of `{method}`");
            let of = and_segments(run);
            format!("every figure is good to {}: {method}{of}{}", bound(worst), and_left_out(run))
        }
        Some(worst) => {
            let solves = run.solver.solves_for_error + 1;
            let solves = format!("by {solves} solutions of `{method}`");
            let of = and_segments(run);
            format!("every figure is good to {}, {solves}{of}{}", bound(worst), and_left_out(run))
        }
    };
    let apart = answer.differences().iter().map(|entry| entry.relative).reduce(f64::max);
    let apart = apart.map(|apart| match answer.runs.as_slice() {
        [one, other] => {
            let names = format!("`{}` and `{}`", one.solver.method, other.solver.method);
            format!("; {names} are {} apart", bound(apart))
        }
        _ => format!("; all methods are within {}", bound(apart)),
    });
    let cut = if is_cut(run) { CUT } else { "" };
    Some(own + cut + &apart.unwrap_or_default())
}

/// That errors include what was left out, where anything was.
fn and_left_out(run: &RunReport) -> &'static str {
    let is_less = run.partial.as_ref().is_some_and(|own| !own.left_out.is_empty());
    if is_less { " and what was left out" } else { "" }
}

/// What to ask for to get a digit more, where that is not to be had for nothing.
fn next_digit(answer: &Answer, run: &RunReport) -> Option<String> {
    let worst = run.worst_relative_error().filter(|worst| worst.is_finite() && *worst > 0.0)?;
    // The exact method has no tolerance, and no digit to gain.
    run.solver.rtol?;
    // No tolerance brings back what was left out.
    if run.partial.as_ref().is_some_and(|own| !own.left_out.is_empty()) {
        return None;
    }
    let wished = answer.asked.first().map_or(worst, |asked| asked.accuracy.default);
    let next = 0.1 * wished.min(worst);
    let text = bound(next).replace(' ', "");
    (next > FINEST).then(|| format!("`--accuracy {text}`, one or two further solutions"))
}
