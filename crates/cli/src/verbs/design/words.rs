//! A design in words.

use dashpot_analysis::Missing;
use dashpot_design::optimum::{Borne, DepthOf, Design, Kept, Lost, Requirement, Side};
use dashpot_units::percent;

use super::{
    among::Choice,
    answer::Answer,
    asked::{Asked, Least},
};
use crate::{
    output::list,
    unevaluated,
    verbs::run::{Line, limit_lines, measure_text, scatter},
};
use dashpot_report::numbers::{counted, percent_signed, quantity, significant};

/// Digits of a number that was found, of its bounds, and of what is read beside it.
pub(super) const DIGITS: usize = 5;
/// What the last of them is worth beside the first.
const LAST_DIGIT: f64 = 1e-4;
const MOST: usize = 7;
const FEW: usize = 3;
/// Prices are told for this part of a bound.
const PART: f64 = 0.01;

/// `least T, in 2 tests`.
pub(super) fn asked(asked: &Asked) -> String {
    let tests = match asked.tests.len() {
        1 => String::new(),
        count => format!(", the worst of {count} tests"),
    };
    let and = asked.and.as_ref().map_or(String::new(), |own| format!(" and {}", own.name(asked)));
    format!("least {}{and}{tests}", asked.least.name(asked))
}

pub(super) fn lines(answer: &Answer, choice: &Choice, best: &Design) -> Vec<Line> {
    let asked = &answer.asked;
    let mut lines = vec![verdict(answer, best)];
    let mut add = |label, text: String| lines.push(Line { label, text });
    for (own, at) in asked.numbers.iter().zip(0..) {
        let at_bound = match best.at_bound[at] {
            Some(Side::Low) => ", AT ITS LOWER BOUND",
            Some(Side::High) => ", AT ITS UPPER BOUND",
            None => "",
        };
        let value = number_text(asked, best, at);
        let [low, high] = own.bounds.map(|bound| own.short(bound, MOST));
        add("design", format!("{} = {value}, between {low} and {high}{at_bound}", own.name));
    }
    for (name, own) in asked.chosen(choice) {
        add("design", format!("{name} = {}", own.shown));
    }
    if let Least::Measure(key) = &asked.least {
        let text = aim_text(asked, &asked.least, (best, best.aim), DIGITS);
        let of_test = answer.test_of_aim(best).map_or(String::new(), |own| format!(", in {own}"));
        add("least", format!("{key} {text}{of_test}"));
    }
    if let Some(borne) = &best.borne {
        add("robust", borne_text(borne));
    }
    let named =
        |test: usize| answer.test_name(test).map_or(String::new(), |name| format!("{name}: "));
    let in_test = |test: usize, all: Vec<Line>| {
        let named = named(test);
        all.into_iter().map(move |line| Line { text: named.clone() + &line.text, ..line })
    };
    for (at, run) in best.runs.iter().enumerate() {
        lines.extend(in_test(at, limit_lines(run)));
    }
    let decided = decided_by(answer, best);
    lines.extend((!decided.is_empty()).then_some(Line { label: "decided by", text: decided }));
    let held_by = best.kept.iter().filter(|own| own.is_active && best.is_feasible);
    lines.extend(held_by.map(|own| Line { label: "active", text: held(answer, best, own) }));
    for (at, run) in best.runs.iter().enumerate() {
        lines.extend(in_test(at, scatter::lines(run)));
    }
    for (at, (run, floor)) in best.runs.iter().zip(&answer.floors).enumerate() {
        lines.extend(in_test(at, floor.lines(run)));
    }
    if !answer.front.is_empty() {
        lines.push(Line { label: "front", text: front(answer) });
    }
    for at in answer.unmoving(best) {
        let text = format!(
            "{} moves nothing that is limited or made least beside this design",
            asked.numbers[at].name
        );
        lines.push(Line { label: "no effect", text });
    }
    lines.push(Line { label: "search", text: searched(answer, best) });
    lines
}

/// What could not be evaluated, with the choice of words and steps where there are several.
pub(super) fn missing(answer: &Answer, best: &Design) -> Vec<String> {
    let asked = &answer.asked;
    let place = |own: &Missing| {
        let numbers = asked.numbers.iter().zip(&own.values);
        list(numbers.map(|(own, value)| format!("{} = {}", own.name, own.short(*value, DIGITS))))
            .join(", ")
    };
    let of_best = unevaluated::sentences(&best.lost.unevaluated, "design", place);
    let others = answer.found.iter().skip(1).filter_map(|own| own.design.as_ref().ok());
    let others = others.filter(|own| !own.lost.unevaluated.is_empty()).count();
    let others = (others > 0).then(|| {
        format!("designs of {} besides, see the object of `--json`", counted(others, "choice"))
    });
    let Lost { cut, .. } = best.lost;
    let cut = (cut > 0).then(|| {
        let starts = best.search.starts;
        format!("given up: searches that took too many designs, {cut} times, from {starts} starts")
    });
    of_best.into_iter().chain(others).chain(cut).collect()
}

pub(super) fn verdict(answer: &Answer, best: &Design) -> Line {
    let asked = &answer.asked;
    let name = asked.least.name(asked);
    let open = answer.open();
    let [may, evaluated] = match open {
        0 => [String::new(), String::new()],
        1 => [
            "; 1 design that could not be evaluated may".to_owned(),
            " that was evaluated".to_owned(),
        ],
        open => [
            format!("; {open} designs that could not be evaluated may"),
            " that was evaluated".to_owned(),
        ],
    };
    if !best.is_feasible {
        let exceeded = best.kept.iter().filter(|own| own.margin < 0.0 || own.is_active);
        let exceeded = exceeded.map(|own| match -own.margin {
            f64::INFINITY => format!("{}, which is infinite", what(asked, own)),
            over => format!("{} by {}", what(asked, own), percent_signed(over.max(0.0))),
        });
        let exceeded = list(exceeded);
        let exceeded = if exceeded.is_empty() {
            format!("{name} is infinite in all of them")
        } else {
            format!("the one that exceeds the least exceeds {}", exceeded.join(" and "))
        };
        let text = format!(
            "no design between the bounds{evaluated} keeps everything; {exceeded}{}",
            if open == 0 { String::new() } else { may + " keep it" }
        );
        return Line { label: if open == 0 { "NONE" } else { "UNDECIDED" }, text };
    }
    let least = aim_text(asked, &asked.least, (best, best.aim), DIGITS);
    match &best.borne {
        Some(own) if !own.is_enough() => Line {
            label: if open == 0 { "NONE" } else { "UNDECIDED" },
            text: format!(
                "no design was found that keeps everything with {}; the nearest has {name} {least}{}",
                percent(own.wanted, FEW),
                if open == 0 { "" } else { "; scattered designs that could not be evaluated may" }
            ),
        },
        _ if open > 0 => Line {
            label: "UNDECIDED",
            text: format!(
                "{name} {least} keeps everything, the least of what was evaluated{may} have less"
            ),
        },
        _ if !answer.is_claimed() => Line {
            label: "UNDECIDED",
            text: format!(
                "{name} {least} is the least found; whether it keeps {} is not known",
                answer.undecided().join(" and ")
            ),
        },
        own => {
            // Limits are drawn in by one number for all of them.
            let how = match own {
                Some(own) => format!(
                    " found that keeps everything with a probability of {} or more",
                    percent(own.wanted, FEW)
                ),
                None if best.runs.iter().any(|own| own.scatter.is_some()) => {
                    " that keeps everything at the means of what has scatter: `--robust 95%` asks for more".to_owned()
                }
                None => " that keeps everything".to_owned(),
            };
            let text = format!("{name} {least} is the least{how}");
            Line { label: "BEST", text }
        }
    }
}

fn borne_text(own: &Borne) -> String {
    let share = percent(own.kept as f64 / own.designs as f64, FEW);
    let drawn_in = if own.deviations > 0.0 {
        format!(
            "limits are drawn in by {} standard deviations of what they are on",
            significant(own.deviations, FEW)
        )
    } else {
        "without any limit drawn in".to_owned()
    };
    format!(
        "{} of {} scattered designs keep everything in all tests ({share}); {} of them show {}, and a larger `--scatter` \
         fewer parts of them; {drawn_in}",
        own.kept,
        own.designs,
        own.least().unwrap_or(own.designs),
        percent(own.wanted, FEW)
    )
}

/// A number of a design as people read it, and as they may write it again: rounded so that what holds it is kept, and that
/// numbers with a given sum have it.
fn number_text(asked: &Asked, design: &Design, at: usize) -> String {
    let own = &asked.numbers[at];
    match asked.totals.iter().find(|total| total.of.last() == Some(&at)) {
        None => own.text(rounded(asked, design, at), DIGITS),
        Some(total) => {
            let others = total.of.iter().filter(|other| **other != at);
            let others: f64 = others.map(|other| rounded(asked, design, *other)).sum();
            own.short(total.sum - others, DIGITS + 2)
        }
    }
}

/// A number of a design in SI units, of [`DIGITS`] digits in the unit of the scene.
fn rounded(asked: &Asked, design: &Design, at: usize) -> f64 {
    let own = &asked.numbers[at];
    let written = design.values[at] / own.one;
    let text = format!("{written:.*e}", DIGITS - 1);
    let rounded: f64 = text.parse().unwrap_or(written);
    let step = text.split_once('e').map_or("0", |own| own.1);
    let step: f64 = format!("1e{step}").parse().unwrap_or(0.0) * LAST_DIGIT;
    let towards = match design.safe_side(at) {
        Some(Side::Low) if rounded > written => rounded - step,
        Some(Side::High) if rounded < written => rounded + step,
        _ => rounded,
    };
    towards * own.one
}

/// A value of what is made least, as people read it.
pub(super) fn aim_text(
    asked: &Asked,
    least: &Least,
    (design, value): (&Design, f64),
    digits: usize,
) -> String {
    match least {
        Least::Number(at) if digits == DIGITS => number_text(asked, design, *at),
        Least::Number(at) => asked.numbers[*at].text(value, digits),
        Least::Step(at) => {
            let si = asked.among[*at].options.iter().flatten().next().map_or("", |own| &own.si);
            let options = asked.among[*at].options.iter().flatten();
            let is_it = |own: &f64| own.to_bits() == value.to_bits();
            let mut taken = options.filter(|own| own.value.as_ref().is_some_and(is_it));
            taken.next().map_or_else(|| quantity(value, si, digits), |own| own.shown.clone())
        }
        Least::Measure(key) => {
            let unit = design.runs.iter().find_map(|run| run.measure(key));
            measure_text(key, value, unit.map_or("1", |own| own.unit), digits)
        }
    }
}

/// Which test leaves the least to each requirement: `cold: head.peak-acceleration; hot: thickness of pad`.
fn decided_by(answer: &Answer, best: &Design) -> String {
    if answer.asked.tests.len() < 2 {
        return String::new();
    }
    let is_of_front = |own: &Kept| matches!(own.required.what, Requirement::Ceiling(..));
    let each = best.kept.iter().filter(|own| !is_of_front(own) && best.decides(own));
    list(each.map(|own| what(&answer.asked, own))).join("; ")
}

/// What is required: `head.peak-acceleration`, `thickness of pad`, with its test where there are several.
pub(super) fn what(asked: &Asked, own: &Kept) -> String {
    let what = match &own.required.what {
        Requirement::Limit(limit) => limit.key.clone(),
        Requirement::Depth(name, DepthOf::Thickness) => format!("thickness of {name}"),
        Requirement::Depth(name, DepthOf::Law) => format!("range of the law of {name}"),
        Requirement::Depth(name, DepthOf::Radius) => format!("radius of the body on {name}"),
        Requirement::Ceiling(..) => asked.and.as_ref().map_or("", |own| own.name(asked)).to_owned(),
    };
    of_test(asked, own, what)
}

/// Something of a requirement, with its test where there are several.
pub(super) fn of_test(asked: &Asked, own: &Kept, what: String) -> String {
    match &asked.tests[..] {
        [_] => what,
        tests => format!("{}: {what}", tests[own.required.test].name),
    }
}

/// What holds a design, but for what is made least besides; bounds of numbers as well.
pub(super) fn active(asked: &Asked, design: &Design) -> Vec<String> {
    let is_of_front = |own: &&Kept| matches!(own.required.what, Requirement::Ceiling(..));
    let held = design.kept.iter().filter(|own| own.is_active && !is_of_front(own));
    let at_bound = asked.numbers.iter().zip(&design.at_bound);
    let at_bound = at_bound.filter(|own| own.1.is_some());
    list(held.map(|own| what(asked, own)).chain(at_bound.map(|own| own.0.name.clone())))
}

/// What holds the design, and what 1 % more of it would change.
fn held(answer: &Answer, best: &Design, own: &Kept) -> String {
    let asked = &answer.asked;
    let (held, level) = match &own.required.what {
        Requirement::Limit(limit) => {
            let drawn_in = if best.borne.is_some_and(|own| own.deviations > 0.0) {
                " as it is drawn in"
            } else {
                ""
            };
            (format!("{} is at its limit{drawn_in}", what(asked, own)), limit.bound.level().abs())
        }
        Requirement::Depth(name, of) => {
            let part = percent(own.value, DIGITS);
            let whole = match of {
                DepthOf::Thickness => "its thickness",
                DepthOf::Law => "the range of its law",
                DepthOf::Radius => "the radius of the body on it",
            };
            (format!("{name} is pressed to {part} of {whole}"), 1.0)
        }
        Requirement::Ceiling(_, most) => (what(asked, own), most.abs()),
    };
    let change = own.price.map(|price| PART * level * price).filter(|own| own.is_finite());
    let change = change.map_or(String::new(), |change| {
        let text = aim_text(asked, &asked.least, (best, change.abs()), FEW);
        let way = if change < 0.0 { "off" } else { "onto" };
        format!("; 1 % more of it takes {text} {way} {}", asked.least.name(asked))
    });
    held + &change
}

/// How far the front reaches, and how far its values may be off.
fn front(answer: &Answer) -> String {
    let asked = &answer.asked;
    let errors = answer.front.iter().flat_map(|own| own.aims(asked));
    let errors = errors.filter_map(|(value, error)| Some(error? / value.abs()));
    let most = errors.filter(|own| own.is_finite()).fold(0.0, f64::max);
    let within = match most {
        0.0 => String::new(),
        most => format!("; every measure within {}", dashpot_report::numbers::bound(most)),
    };
    let how = match answer.front.len() {
        1 => "one design has the least of both".to_owned(),
        count => format!(
            "{count} designs, each with the least {} for its {}",
            asked.least.name(asked),
            asked.and.as_ref().map_or("", |own| own.name(asked))
        ),
    };
    let open = answer.front.iter().map(|own| own.own.design.lost.open(None)).max();
    let open = match open {
        None | Some(0) => String::new(),
        Some(_) => "; designs that could not be evaluated may lie before it".to_owned(),
    };
    how + &within + &open
}

fn searched(answer: &Answer, best: &Design) -> String {
    if answer.asked.numbers.is_empty() {
        return format!("all {} are solved", counted(answer.found.len(), "choice"));
    }
    let own = best.search;
    let spread = if own.is_grid {
        format!("all {} of a grid and the scene's own", counted(own.designs, "design"))
    } else {
        format!("{} of a Latin hypercube and the scene's own", counted(own.designs, "design"))
    };
    let missing = match best.spread.iter().filter(|own| own.aim.is_nan()).count() {
        0 => String::new(),
        count => format!("{count} of them could not be evaluated, "),
    };
    let feasible = format!("{missing}{} of them keep everything", own.feasible);
    let agree = format!("{} of {} searches from the best end here", own.agree, own.starts);
    let is_told = own.is_grid && best.is_feasible && answer.is_claimed();
    let better = if is_told { ", none of them better" } else { "" };
    format!("{spread}, {feasible}{better}; {agree}; {} solved", counted(own.solved, "design"))
}
