//! The answer in a few lines.

use dashpot_analysis::{
    Compression, Contact, ContactReport, MeasureReport, Note, RunReport,
    measures::{Hic, STANDARD_GRAVITY},
    verdict::{Depth, Ending, Layer, Opened, Peak, Reached, TakenUp, Verdict, WholeForce},
};
use dashpot_network::parameters::Kind as _;
use dashpot_units::percent;

use super::{
    Answer,
    left_out::{left_out, put_back},
    limits,
    measures::{is_hic, is_index, is_zero, largest, unit_of_zero},
    scatter,
};
use dashpot_report::numbers::{self, Unit, bound, constant, quantity, rounded, share, significant};

/// How far something is pressed.
const DEFLECTION: &str = "max. deflection";
/// Digits of a number that is read in passing.
const DIGITS: usize = 4;
/// Accuracies beyond this are not to be had with double precision.
const FINEST: f64 = 1e-10;
pub(super) const TIME_DIGITS: usize = 3;
/// Work from outside is spoken of beyond this part of the impact's energy.
const LITTLE: f64 = 5e-4;
/// A smaller share is none.
const ZERO: f64 = 1e-9;
/// So many figures are named in one line.
const NAMED: usize = 3;
/// A figure is named whose error is so many times that of all others …
const FAR_OFF: f64 = 10.0;
/// … and more than this, relative.
const ROUGH: f64 = 1e-3;
/// What follows the release.
const GLUED: &str = ", then it goes into tension (separation is not modelled)";
/// Of a peak where the run ends.
const SO_FAR: &str = " so far, still rising at the end of the run";
/// What the errors of a run that ends in contact do not say.
const CUT: &str = "; the run ends in contact, so that figures are those so far";

/// One line of the verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Line {
    pub(crate) label: &'static str,
    pub(crate) text: String,
}

/// What a person wants to know first, from the most accurate run.
pub(super) fn verdict(answer: &Answer) -> Vec<Line> {
    let Some(run) = answer.best() else { return Vec::new() };
    let words = Words { answer, run };
    let found = Verdict::of(run);
    let peak_force = || found.peak_force.map(|peak| words.peak(peak, " in "));
    let [force, in_one] = match found.whole_force {
        Some(whole) => [Some(whole_force(whole)), peak_force()],
        None => [peak_force(), None],
    };
    let elsewhere = found.elsewhere.map(|elsewhere| {
        let (element, time) = (elsewhere.element, quantity(elsewhere.peak.time, "s", TIME_DIGITS));
        if elsewhere.peak.value.is_infinite() {
            return format!("infinite in {element} at {time}, where the speed jumps");
        }
        let when = match elsewhere.window {
            Some((from, _)) if elsewhere.peak.time < from => ", before the impact",
            Some((_, to)) if elsewhere.peak.time > to => ", after the impact",
            _ => "",
        };
        format!("{} in {element} at {time}{when}", quantity(elsewhere.peak.value, "N", TIME_DIGITS))
    });
    let lines = [
        ("stopped", stopped(run)),
        ("peak force", force),
        ("in one part", in_one),
        ("elsewhere", elsewhere),
        ("peak g", found.peak_acceleration.map(|peak| words.peak_g(peak))),
        (DEFLECTION, found.depth.map(|depth| words.depth(depth))),
        ("energy", found.energy.as_ref().map(|energy| words.energy(energy))),
        ("contact", found.ending.as_ref().map(|ending| words.ending(ending))),
        ("indices", indices(run)),
        ("left out", left_out(run)),
        ("put back", put_back(run)),
        ("num. error", words.error(&found)),
        ("next digit", next_digit(answer, run)),
    ];
    let lines = lines.into_iter().filter_map(|(label, text)| Some(Line { label, text: text? }));
    let mut lines: Vec<Line> = lines.collect();
    let behind = lines.iter().position(|own| own.label == DEFLECTION).map_or(0, |own| own + 1);
    let layers = found.layers.iter().map(|own| Line { label: DEFLECTION, text: layer(own) });
    lines.splice(behind..behind, layers);
    let floor = answer.floor.as_ref().map_or_else(Vec::new, |own| own.lines(run));
    let first = limits::lines(run).into_iter().chain(scatter::lines(run));
    first.chain(lines).chain(floor).collect()
}

/// What words are found for.
struct Words<'a> {
    answer: &'a Answer,
    run: &'a RunReport,
}

impl Words<'_> {
    fn shown(&self, measure: &MeasureReport, value: f64) -> String {
        if is_zero(measure) {
            let largest = largest(self.answer.runs.iter(), measure.unit);
            return format!("0 {}", unit_of_zero(measure, largest).symbol);
        }
        quantity(value, measure.unit, numbers::digits(value, measure.error, DIGITS))
    }

    /// Where, behind this word, and when, and what else is to be said.
    fn whereabouts(word: &str, measure: &MeasureReport, is_so_far: bool) -> String {
        // A zero is there at any time.
        let time = measure.time.filter(|_| !is_zero(measure));
        let time = time.map(|time| format!(" at {}", quantity(time, "s", TIME_DIGITS)));
        // Which way it points, as in `in tension`; other notes stand below the table.
        let notes: Vec<Note> =
            measure.notes.iter().filter(|note| note.is_place()).cloned().collect();
        let note =
            if notes.is_empty() { String::new() } else { format!(" ({})", Note::joined(&notes)) };
        let time = time.unwrap_or_default();
        let so_far = if is_so_far { SO_FAR } else { "" };
        format!("{word}{}{time}{so_far}{note}", measure.target)
    }

    fn peak(&self, peak: Peak<'_>, word: &str) -> String {
        match peak {
            Peak::Infinite { measure, time } => infinite(word, measure, time),
            Peak::Finite { measure, value, is_so_far } => {
                self.shown(measure, value) + &Self::whereabouts(word, measure, is_so_far)
            }
        }
    }

    fn peak_g(&self, peak: Peak<'_>) -> String {
        match peak {
            Peak::Infinite { measure, time } => infinite(" on ", measure, time),
            Peak::Finite { measure, value, .. } => {
                let digits = numbers::digits(value, measure.error, DIGITS);
                let in_g = Unit::new("g", STANDARD_GRAVITY).text(value, digits);
                let place = self.peak(peak, " on ");
                let shown = self.shown(measure, value);
                format!("{in_g} ({shown}){}", place.strip_prefix(&shown).unwrap_or(&place))
            }
        }
    }

    fn depth(&self, depth: Depth<'_>) -> String {
        let text = self.peak(depth.peak, " in ");
        let (Some(own), Peak::Finite { measure, .. }) = (depth.compression, depth.peak) else {
            return text;
        };
        text + &beside_thickness(&own, measure.error, depth.is_on_stop)
    }

    fn energy(&self, taken_up: &TakenUp<'_>) -> String {
        let (value, name) = (taken_up.value, &taken_up.measure.target);
        let amount = self.shown(taken_up.measure, value);
        let alone = format!("{name} takes up {amount}");
        let Some(supply) = &taken_up.supply else { return alone };
        let (kinetic, work) = (supply.kinetic, supply.work);
        let is_zero = is_zero(taken_up.measure);
        // What rests on springs at the start, or moves elsewhere, may be given to the pad as well.
        if !is_zero && value > (1.0 + LITTLE) * (kinetic + work.max(0.0)) {
            return alone;
        }
        let is_told = |part: f64| part.abs() > ZERO;
        let told = |part: f64| {
            if is_told(part) && !is_zero { format!(" ({})", share(part)) } else { String::new() }
        };
        if kinetic <= LITTLE * work {
            // What falls begins without energy, or with what little its layers hold at rest.
            let whole = rounded(work, "J", TIME_DIGITS);
            let part = told(value / work);
            return format!("{name} takes up {amount} of {whole} put in{part}");
        }
        let whole = rounded(kinetic, "J", DIGITS);
        let whole = if supply.impactors.is_empty() {
            whole
        } else {
            format!("the {whole} of {}", supply.impactors.join(", "))
        };
        let added = if work > LITTLE * kinetic {
            format!(" and {} put in", rounded(work, "J", TIME_DIGITS))
        } else {
            String::new()
        };
        let part = told(value / (kinetic + work.max(0.0)));
        format!("{name} takes up {amount} of {whole}{added}{part}")
    }

    fn ending(&self, ending: &Ending<'_>) -> String {
        match ending {
            Ending::NoImpactor(opened) => {
                let opened =
                    opened.map_or(String::new(), |opened| format!("; {}", lets_go(opened)));
                format!("no impactor: the measures are those of the whole run{opened}")
            }
            Ending::Lasting { contact, is_open } => {
                let end = quantity(contact.impact.end, "s", TIME_DIGITS);
                let [whether, or_not] = if *is_open { ["whether ", " is open"] } else { [""; 2] };
                let element = &contact.element;
                format!("{whether}{element} still pushes at the end of the run ({end}){or_not}")
            }
            Ending::Never(contact) => {
                let why = if contact.impact.contact == Contact::Pulling {
                    "it pulls from the start"
                } else {
                    "it never has a force"
                };
                format!("the {} is never pressed: {why}", contact.element)
            }
            Ending::Ended { measure, value, contact, pulls, leaving } => {
                let pulls = if *pulls { GLUED } else { "" };
                let leaving = leaving.map_or(String::new(), |leaving| {
                    let error = self.run.worst_relative_error();
                    let digits = numbers::digits(1.0, error, TIME_DIGITS);
                    let text = quantity(leaving.speed, "m/s", digits);
                    let how = if leaving.returns { "rebounds" } else { "goes on" };
                    let restitution =
                        leaving.restitution.map_or(String::new(), |(value, error)| {
                            let digits = numbers::digits(value, error, TIME_DIGITS);
                            let value = significant(value, digits);
                            // That of the element's ends may stand in the table besides.
                            let of = match leaving.parting {
                                Some(element) => format!(" between the ends of {element}"),
                                None if leaving.of_element => String::new(),
                                None => " of its speed".to_owned(),
                            };
                            format!(", coefficient of restitution {value}{of}")
                        });
                    format!("; {} {how} at {text}{restitution}", leaving.impactor)
                });
                let again = contact.map_or(String::new(), again);
                let time = self.shown(measure, *value);
                format!("{time} in {}{pulls}{leaving}{again}", measure.target)
            }
        }
    }

    fn error(&self, found: &Verdict<'_>) -> Option<String> {
        let (answer, run, reached) = (self.answer, self.run, &found.reached);
        let method = run.solver.method;
        let is_estimated = answer.asked.iter().any(|asked| asked.estimate);
        let but = Self::exceptions(reached);
        let other = if but.is_empty() { "" } else { " other" };
        let own = match reached.worst {
            None if run.measures.is_empty() => return None,
            None if is_estimated && reached.is_unknown => {
                "it is not known: no further solutions came about to tell errors".to_owned()
            }
            None if is_estimated => format!("{but}no{other} figure has a size to be relative to"),
            None => "errors were not estimated".to_owned(),
            Some(worst) if !worst.is_finite() => {
                "some figures come and go with the tolerance; see the table".to_owned()
            }
            Some(worst) => {
                let of = and_segments(run) + and_left_out(run);
                let how = if run.solver.rtol.is_none() {
                    format!(" (a bound of `{method}`{of})")
                } else {
                    let solutions = run.solver.solves_for_error + 1;
                    format!(" (by {solutions} solutions of `{method}`{of})")
                };
                match self.far_off(reached) {
                    Some((key, others)) => format!(
                        "{but}`{key}` within {}, every other figure within {}{how}",
                        bound(worst),
                        bound(others)
                    ),
                    None => format!("{but}every{other} figure within {}{how}", bound(worst)),
                }
            }
        };
        let apart = answer.differences().iter().map(|entry| entry.relative).reduce(f64::max);
        let apart = apart.map(|apart| match answer.runs.as_slice() {
            [one, other] => {
                let names = format!("`{}` and `{}`", one.solver.method, other.solver.method);
                format!("; {names} differ by {}", bound(apart))
            }
            _ => format!("; all methods differ by {} at most", bound(apart)),
        });
        let cut = if found.is_cut { CUT } else { "" };
        Some(own + cut + &apart.unwrap_or_default())
    }

    /// The figure whose relative error is many times that of any other, and the largest of those.
    fn far_off(&self, reached: &Reached<'_>) -> Option<(&str, f64)> {
        let known = self.run.measures.iter().filter_map(|own| Some((own, own.relative_error()?)));
        let is_small = |own: &MeasureReport| reached.small.iter().any(|small| small.key == own.key);
        let mut known: Vec<(&MeasureReport, f64)> = known.filter(|own| !is_small(own.0)).collect();
        known.sort_by(|one, other| other.1.total_cmp(&one.1));
        let [first, second, ..] = known[..] else { return None };
        let is_far = first.1 >= FAR_OFF * second.1 && second.1 > 0.0 && first.1 > ROUGH;
        (is_far && reached.worst == Some(first.1)).then_some((first.0.key.as_str(), second.1))
    }

    /// The figures that are not as good as the others.
    fn exceptions(reached: &Reached<'_>) -> String {
        let small = |measure_report: &MeasureReport| {
            let error = quantity(measure_report.error.unwrap_or(0.0), measure_report.unit, 2);
            if is_zero(measure_report) {
                format!("`{}` is zero within {error}", measure_report.key)
            } else {
                format!("`{}` is known to ±{error} only", measure_report.key)
            }
        };
        let unknown = |measure_report: &MeasureReport| {
            format!("the error of `{}` is not known", measure_report.key)
        };
        named(&reached.small, &small) + &named(&reached.unknown, &unknown)
    }
}

/// `: 71 % of 30 mm, 8.7 mm left`.
fn beside_thickness(own: &Compression, error: Option<f64>, is_on_stop: bool) -> String {
    let (left, strain) = (own.left(), own.strain());
    let limit = constant(own.thickness, "m");
    let rest = quantity(left.abs(), "m", numbers::digits(left, error, TIME_DIGITS));
    let strain = percent(strain, if strain < 1.0 { 2 } else { 3 });
    let rest = if own.is_through() { rest + " MORE than there is" } else { rest + " left" };
    let stop = if is_on_stop { ", ON ITS STOP" } else { "" };
    format!(": {strain} of {limit}, {rest}{stop}")
}

/// How far another element with a thickness is pressed.
fn layer(own: &Layer<'_>) -> String {
    let Compression { deepest, time, .. } = own.compression;
    let [deepest, time] =
        [(deepest, "m"), (time, "s")].map(|own| quantity(own.0, own.1, TIME_DIGITS));
    let rest = beside_thickness(&own.compression, None, own.is_on_stop);
    format!("{deepest} in {} at {time}{rest}", own.element)
}

/// The first of these figures in words, with a semicolon behind them.
fn named(measures: &[&MeasureReport], text: &dyn Fn(&MeasureReport) -> String) -> String {
    if measures.is_empty() {
        return String::new();
    }
    let all: Vec<String> = measures.iter().take(NAMED).map(|measure| text(measure)).collect();
    let more = measures.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(", and so it is with {more} more") } else { String::new() };
    format!("{}{more}; ", all.join(", "))
}

fn infinite(word: &str, measure: &MeasureReport, time: f64) -> String {
    let time = quantity(time, "s", TIME_DIGITS);
    format!("infinite{word}{} at {time}, where the speed jumps", measure.target)
}

fn whole_force(whole_force: WholeForce<'_>) -> String {
    let (force, time) = (
        quantity(whole_force.peak.value, "N", TIME_DIGITS),
        quantity(whole_force.peak.time, "s", TIME_DIGITS),
    );
    let place = if whole_force.is_behind {
        format!("behind {} with its stop", whole_force.element)
    } else {
        format!("in {}", whole_force.element)
    };
    format!("{force} {place} at {time}")
}

fn stopped(run: &RunReport) -> Option<String> {
    let event = run.stopped_by()?;
    Some(format!("at {}: {}", quantity(event.time, "s", TIME_DIGITS), event.what))
}

/// How often contacts let go in a run without impactors.
fn lets_go(opened: Opened<'_>) -> String {
    let (name, time) = (opened.name, quantity(opened.time, "s", TIME_DIGITS));
    match opened.times {
        1 => format!("{name} lets go at {time}"),
        times => format!("{name} lets go {times} times, first at {time}"),
    }
}

/// How often they meet again.
fn again(contact: &ContactReport) -> String {
    match contact.again {
        0 => String::new(),
        1 => "; they meet once more".to_owned(),
        count => format!("; they meet {count} times more"),
    }
}

/// The field's name of an index: `GSI`, Gadd's severity index, or `HIC15`, the head injury criterion with the
/// longest interval that it may have, which is not to be guessed.
fn index_name(run: &RunReport, measure: &MeasureReport) -> String {
    if measure.kind != Hic::KIND {
        return if is_hic(measure.kind) { measure.kind.to_uppercase() } else { "GSI".to_owned() };
    }
    let cap = measure.parameters.iter().find_map(|(_, value)| value.number());
    match cap.filter(|cap| *cap < run.energy.time) {
        Some(cap) => format!("HIC up to {}", constant(cap, "s")),
        None => "HIC without a cap".to_owned(),
    }
}

fn indices(run: &RunReport) -> Option<String> {
    let found = run.measures.iter().filter(|measure| is_index(measure.kind));
    let texts = found.filter_map(|measure| {
        let name = format!("{} of {}", index_name(run, measure), measure.target);
        let Some(value) = measure.value else {
            return measure.time.map(|_| format!("{name} is infinite"));
        };
        let digits = numbers::digits(value, measure.error, DIGITS);
        let number = Unit::plain("1").text(value, digits);
        let found =
            measure.window.filter(|_| is_hic(measure.kind)).map_or(String::new(), |window| {
                let [from, to] = [window.0, window.1].map(|time| quantity(time, "s", TIME_DIGITS));
                format!(" (from {from} to {to})")
            });
        Some(format!("{name} {number}{found}"))
    });
    let texts: Vec<String> = texts.take(3).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

/// That errors include what the segments of layers make of the figures.
fn and_segments(run: &RunReport) -> String {
    run.segmentation.as_ref().map_or(String::new(), |segmentation| {
        format!(" and {} segments of layers beside {}", segmentation.segments, segmentation.others)
    })
}

/// That errors include what was left out, where anything was.
fn and_left_out(run: &RunReport) -> &'static str {
    let is_less = run.partial.as_ref().is_some_and(|partial| !partial.left_out.is_empty());
    if is_less { " and what was left out" } else { "" }
}

/// What to ask for to get a digit more, where that is not to be had for nothing.
fn next_digit(answer: &Answer, run: &RunReport) -> Option<String> {
    let worst = run.worst_relative_error().filter(|worst| worst.is_finite() && *worst > 0.0)?;
    // The exact method has no tolerance, and no digit to gain.
    run.solver.rtol?;
    // No tolerance brings back what was left out.
    if run.partial.as_ref().is_some_and(|partial| !partial.left_out.is_empty()) {
        return None;
    }
    let wished = answer.asked.first().map_or(worst, |asked| asked.accuracy.default);
    let next = 0.1 * wished.min(worst);
    let text = bound(next).replace(' ', "");
    (next > FINEST).then(|| format!("`--accuracy {text}`, one or two further solutions"))
}
