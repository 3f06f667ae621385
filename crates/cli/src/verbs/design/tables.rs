//! Tables of a design: sensitivities, the front of two aims, and choices.

use dashpot_design::optimum::{Design, Kept, Requirement};
use dashpot_report::Table;

use super::{
    answer::{Answer, Found},
    asked::{Asked, Least},
    words::{DIGITS, active, aim_text, of_test},
};
use crate::output::list;
use dashpot_report::numbers::{percent_signed, significant};

const FEW: usize = 3;

/// All that have rows.
pub(super) fn all(answer: &Answer, best: &Design) -> Vec<Table> {
    let has_choice = answer.found.len() > 1;
    let choices = has_choice.then(|| choices(answer));
    let all = [sensitivities(&answer.asked, best), front(answer)].into_iter().chain(choices);
    list(all.filter(|own| !own.rows.is_empty()))
}

/// By how many percent aim and limits change where a number rises by one.
fn sensitivities(asked: &Asked, best: &Design) -> Table {
    let mut header = vec!["1 % more of".to_owned()];
    let is_measure = matches!(asked.least, Least::Measure(_));
    if is_measure {
        header.push(asked.least.name(asked).to_owned());
    }
    let name = |own: &Kept| match &own.required.what {
        Requirement::Limit(limit) => limit.key.clone(),
        Requirement::Depth(name, _) => format!("depth in {name}"),
        Requirement::Ceiling(..) => String::new(),
    };
    let shown: Vec<usize> = (0..best.kept.len())
        .filter(|at| {
            let own = &best.kept[*at];
            best.decides(own) && !(is_measure && name(own) == asked.least.name(asked))
        })
        .collect();
    header.extend(shown.iter().map(|at| {
        let own = &best.kept[*at];
        of_test(asked, own, name(own))
    }));
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
    Table::new("Sensitivities", header, rows)
}

fn signed(part: f64) -> String {
    let text = significant(part.abs(), FEW);
    if part < 0.0 { format!("−{text}") } else { format!("+{text}") }
}

/// The front of two aims, from the least of the first one.
fn front(answer: &Answer) -> Table {
    let asked = &answer.asked;
    let Some(and) = &asked.and else { return Table::plain("Front", []) };
    let both = [&asked.least, and];
    let names = both.iter().map(|own| own.name(asked).to_owned());
    let is_other = |name: &str| both.iter().all(|own| own.name(asked) != name);
    let numbers: Vec<usize> =
        list((0..asked.numbers.len()).filter(|at| is_other(&asked.numbers[*at].name)));
    let chosen = asked.among.iter().flat_map(|own| &own.names).filter(|own| is_other(own));
    let further = numbers.iter().map(|at| asked.numbers[*at].name.clone());
    let header = names.chain(further).chain(chosen.cloned()).chain(["held by".to_owned()]);
    let rows = answer.front.iter().map(|point| {
        let design = &point.own.design;
        let values = [design.aim, point.own.other];
        let aims = both.iter().zip(values);
        let aims = aims.map(|(own, value)| aim_text(asked, own, (design, value), DIGITS));
        let further = numbers.iter().map(|at| asked.numbers[*at].text(design.values[*at], DIGITS));
        let chosen = asked.chosen(&point.choice).filter(|own| is_other(own.0));
        let chosen = chosen.map(|own| own.1.shown.clone());
        let held = active(asked, design).join(", ");
        list(aims.chain(further).chain(chosen).chain([held]))
    });
    Table::new("Front", header, rows)
}

/// What each choice of words and steps comes to, the best first.
fn choices(answer: &Answer) -> Table {
    let asked = &answer.asked;
    let names = asked.among.iter().flat_map(|own| own.names.clone());
    let numbers = asked.numbers.iter().map(|own| own.name.clone());
    let least = match &asked.least {
        Least::Measure(key) => Some(key.clone()),
        Least::Number(_) | Least::Step(_) => None,
    };
    let header = names.chain(numbers).chain(least.clone()).chain(["verdict".to_owned()]);
    let row = |own: &Found| {
        let chosen = asked.chosen(&own.choice).map(|own| own.1.shown.clone());
        let (numbers, aim, verdict) = match &own.design {
            Ok(design) => {
                let numbers = asked.numbers.iter().zip(&design.values);
                let numbers = list(numbers.map(|(own, value)| own.text(*value, DIGITS)));
                let aim = aim_text(asked, &asked.least, (design, design.aim), DIGITS);
                (numbers, aim, verdict(design))
            }
            Err(why) => (vec!["–".to_owned(); asked.numbers.len()], "–".to_owned(), why.clone()),
        };
        list(chosen.chain(numbers).chain(least.as_ref().map(|_| aim)).chain([verdict]))
    };
    Table::new("Choices", header, answer.found.iter().map(row))
}

fn verdict(design: &Design) -> String {
    match design.borne {
        _ if !design.is_feasible => {
            format!("exceeds by {}", percent_signed(-design.least_margin()))
        }
        Some(own) if !own.is_enough() => {
            format!("kept by {} of {} scattered designs", own.kept, own.designs)
        }
        _ => "keeps everything".to_owned(),
    }
}
