//! A design in words.

use dashpot_design::optimum::{Design, Kept, Requirement, Side};
use dashpot_plot::Table;
use dashpot_units::percent;

use super::{
    Answer, Found,
    asked::{Asked, Choice, Least},
    limit_lines,
};
use crate::{
    numbers::{constant, counted, percent_signed, quantity, significant},
    output::list,
    verbs::run::{Line, measure_text},
};

/// Digits of a number that was found, and of what is read beside it.
const DIGITS: usize = 5;
const FEW: usize = 3;
/// Prices are told for this part of a bound.
const PART: f64 = 0.01;

/// `least T, in 2 tests`.
pub(super) fn asked(asked: &Asked) -> String {
    let tests = match asked.tests.len() {
        1 => String::new(),
        count => format!(", the worst of {count} tests"),
    };
    format!("least {}{tests}", asked.least.name(asked))
}

pub(super) fn lines(answer: &Answer, choice: &Choice, best: &Design) -> Vec<Line> {
    let asked = &answer.asked;
    let mut lines = vec![verdict(answer, best)];
    let mut add = |label, text: String| lines.push(Line { label, text });
    for (own, at) in asked.numbers.iter().zip(0..) {
        let (value, [low, high]) = (best.values[at], own.bounds);
        let at_bound = match best.at_bound[at] {
            Some(Side::Low) => ", AT ITS LOWER BOUND",
            Some(Side::High) => ", AT ITS UPPER BOUND",
            None => "",
        };
        let value = quantity(value, &own.si, DIGITS);
        let (low, high) = (constant(low, &own.si), constant(high, &own.si));
        add("design", format!("{} = {value}, between {low} and {high}{at_bound}", own.name));
    }
    for (name, _, text) in asked.chosen(choice) {
        add("design", format!("{name} = {}", text.unwrap_or_default()));
    }
    if let Least::Measure(key) = &asked.least {
        add("least", format!("{key} {}", aim_text(answer, best, best.aim, DIGITS)));
    }
    let several = asked.tests.len() > 1;
    for (test, run) in asked.tests.iter().zip(&best.runs) {
        let named = if several { format!("{}: ", test.name) } else { String::new() };
        for line in limit_lines(run) {
            lines.push(Line { text: named.clone() + &line.text, ..line });
        }
    }
    let active = best.kept.iter().filter(|own| own.is_active && best.is_feasible);
    lines.extend(active.map(|own| Line { label: "active", text: held(answer, best, own) }));
    for ((test, run), floor) in asked.tests.iter().zip(&best.runs).zip(&answer.floors) {
        let named = if several { format!("{}: ", test.name) } else { String::new() };
        let floors = floor.lines(run).into_iter();
        lines.extend(floors.map(|line| Line { text: named.clone() + &line.text, ..line }));
    }
    lines.push(Line { label: "search", text: searched(best) });
    lines
}

fn verdict(answer: &Answer, best: &Design) -> Line {
    if best.is_feasible {
        let name = answer.asked.least.name(&answer.asked);
        let least = aim_text(answer, best, best.aim, DIGITS);
        return Line {
            label: "BEST",
            text: format!("{name} {least} is the least that keeps everything"),
        };
    }
    let exceeded = best.kept.iter().filter(|own| own.margin < 0.0 || own.is_active);
    let exceeded =
        exceeded.map(|own| format!("{} by {}", what(answer, own), percent_signed(-own.margin)));
    let text = format!(
        "no design between the bounds keeps everything; the one that exceeds the least exceeds {}",
        list(exceeded).join(" and ")
    );
    Line { label: "NONE", text }
}

fn aim_text(answer: &Answer, best: &Design, value: f64, digits: usize) -> String {
    match &answer.asked.least {
        Least::Number(at) => quantity(value, &answer.asked.numbers[*at].si, digits),
        Least::Step(at) => {
            let own = &answer.asked.among[*at].variation;
            let si = own.dimension.map_or(String::new(), dashpot_scene::units::si_unit);
            quantity(value, &si, digits)
        }
        Least::Measure(key) => {
            let unit =
                best.runs.iter().find_map(|run| run.measure(key)).map_or("1", |own| own.unit);
            measure_text(key, value, unit, digits)
        }
    }
}

/// What is required: `head.peak-acceleration`, `what is known of pad`, with its test where there are several.
fn what(answer: &Answer, own: &Kept) -> String {
    let what = match &own.required.what {
        Requirement::Limit(limit) => limit.key.clone(),
        Requirement::Known(name) => format!("what is known of {name}"),
    };
    match &answer.asked.tests[..] {
        [_] => what,
        tests => format!("{}: {what}", tests[own.required.test].name),
    }
}

/// What holds the design, and what 1 % more of it would change.
fn held(answer: &Answer, best: &Design, own: &Kept) -> String {
    let held = match &own.required.what {
        Requirement::Limit(_) => format!("{} is at its limit", what(answer, own)),
        Requirement::Known(name) => {
            format!("{name} is pressed to {} of what is known of it", percent(own.value, DIGITS))
        }
    };
    let level = match &own.required.what {
        Requirement::Limit(limit) => limit.bound.level().abs(),
        Requirement::Known(_) => 1.0,
    };
    let change = own.price.map(|price| PART * level * price).filter(|own| own.is_finite());
    let change = change.map_or(String::new(), |change| {
        let text = aim_text(answer, best, change.abs(), FEW);
        let way = if change < 0.0 { "off" } else { "onto" };
        let name = answer.asked.least.name(&answer.asked);
        format!("; 1 % more of it takes {text} {way} {name}")
    });
    held + &change
}

fn searched(best: &Design) -> String {
    let own = best.search;
    let spread = if own.is_grid {
        format!("all {} of a grid", counted(own.designs, "design"))
    } else {
        format!("{} of a Latin hypercube", counted(own.designs, "design"))
    };
    let feasible = format!("{} of them keep everything", own.feasible);
    let agree = format!("{} of {} searches from the best end here", own.agree, own.starts);
    let better = if own.is_grid && best.is_feasible { ", none of them better" } else { "" };
    format!("{spread}, {feasible}{better}; {agree}; {} solved", counted(own.solved, "design"))
}

/// By how many percent aim and limits change where a number rises by one.
pub(super) fn sensitivities(asked: &Asked, best: &Design) -> Table {
    let mut header = vec!["1 % more of".to_owned()];
    let is_measure = matches!(asked.least, Least::Measure(_));
    if is_measure {
        header.push(asked.least.name(asked).to_owned());
    }
    let name = |own: &Kept| match &own.required.what {
        Requirement::Limit(limit) => limit.key.clone(),
        Requirement::Known(name) => format!("depth in {name}"),
    };
    let shown: Vec<usize> = (0..best.kept.len())
        .filter(|at| {
            let own = &best.kept[*at];
            own.required.test == 0 && !(is_measure && name(own) == asked.least.name(asked))
        })
        .collect();
    header.extend(shown.iter().map(|at| name(&best.kept[*at])));
    let cell = |slope: f64, value: f64, of: f64| {
        let part = slope * value / of;
        if part.is_finite() { format!("{} %", signed(part)) } else { "–".to_owned() }
    };
    let rows =
        asked.numbers.iter().zip(&best.values).zip(&best.slopes).map(|((own, value), slope)| {
            let aim = is_measure.then(|| cell(slope.aim, *value, best.aim));
            let others =
                shown.iter().map(|at| cell(slope.values[*at], *value, best.kept[*at].value));
            list([own.name.clone()].into_iter().chain(aim).chain(others))
        });
    Table { caption: String::new(), header, rows: list(rows) }
}

fn signed(part: f64) -> String {
    let text = significant(part.abs(), FEW);
    if part < 0.0 { format!("−{text}") } else { format!("+{text}") }
}

/// What each choice of words and steps comes to, the best first.
pub(super) fn choices(answer: &Answer) -> Table {
    let asked = &answer.asked;
    let names = asked.among.iter().map(|own| own.variation.name.clone());
    let numbers = asked.numbers.iter().map(|own| own.name.clone());
    let least = match &asked.least {
        Least::Measure(key) => Some(key.clone()),
        Least::Number(_) | Least::Step(_) => None,
    };
    let header = names.chain(numbers).chain(least.clone()).chain(["verdict".to_owned()]);
    let row = |own: &Found| {
        let chosen = asked.chosen(&own.choice).into_iter().map(|own| own.2.unwrap_or_default());
        let (numbers, aim, verdict) = match &own.design {
            Ok(design) => {
                let numbers = asked.numbers.iter().zip(&design.values);
                let numbers = list(numbers.map(|(own, value)| quantity(*value, &own.si, DIGITS)));
                let aim = aim_text(answer, design, design.aim, DIGITS);
                let verdict = if design.is_feasible {
                    "keeps everything".to_owned()
                } else {
                    format!("exceeds by {}", percent_signed(-design.least_margin()))
                };
                (numbers, aim, verdict)
            }
            Err(why) => (vec!["–".to_owned(); asked.numbers.len()], "–".to_owned(), why.clone()),
        };
        list(chosen.chain(numbers).chain(least.as_ref().map(|_| aim)).chain([verdict]))
    };
    Table {
        caption: "Choices".to_owned(),
        header: list(header),
        rows: list(answer.found.iter().map(row)),
    }
}
