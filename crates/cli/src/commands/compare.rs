//! `dashpot compare`.

use std::fmt::Write as _;

use dashpot_analysis::{RunReport, SolveSettings, differences, solve};
use dashpot_dae::Silent;
use dashpot_network::{
    Model,
    driving_point::{Agreement, Hidden, Receptance, Response},
    primitive,
};
use dashpot_rheology::{equivalence, identifiability::Entangled, sensitivity::sensitivity};

use crate::{
    answer::comparison::{About, Cancelled, Comparison, Impact, Map, Measured, Together, Worst},
    args::CompareArguments,
    entanglement::{combinations, groups, sentence},
    error::{CliError, Status},
    input::read_scene,
    numbers::{apart, bound, quantity, share},
    operand::{Operand, Subject, canonical_model, parted},
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data},
    text::{columns, side_by_side, table, wrapped},
};

/// Maps of more parameters than this are in the JSON only.
const MOST_SHOWN: usize = 8;
/// Models of more parts than this have no map: it would take longer than all else.
const MOST_MAPPED: usize = 120;

/// Says whether two models are the same.
pub(crate) fn compare(
    arguments: &CompareArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let set = &arguments.values.set;
    let operands =
        [&arguments.first, &arguments.second].map(|word| Operand::read(word, set, terminal));
    let [first, second] = operands;
    let operands = [first?, second?];
    if operands[0].is_material() != operands[1].is_material() {
        return Err(CliError::MaterialAndPad);
    }
    let mut found = compared(&operands)?;
    found.models = operands.iter().map(about).collect::<Result<_, _>>()?;
    if let (true, [Some(first), Some(second)]) =
        (found.same, [&operands[0], &operands[1]].map(Operand::model))
    {
        found.map = map(first, second);
    }
    if let Some(impact) = &arguments.impact {
        found.impact = Some(same_impact(impact, &operands, set, terminal)?);
    }
    let status = if found.same { Status::Done } else { Status::NotSame };
    if arguments.json {
        print_data(&(serde_json::to_string_pretty(&found)? + "\n"))?;
    } else {
        print(&text(&found, terminal))?;
    }
    Ok(status)
}

fn compared(operands: &[Operand; 2]) -> Result<Comparison, CliError> {
    let words = [&operands[0], &operands[1]].map(|own| own.word.clone());
    let is_material = operands[0].is_material();
    if let [Some(first), Some(second)] = [&operands[0].linear()?, &operands[1].linear()?] {
        let found = equivalence::compare(first, second);
        let error = operands.iter().map(Operand::error).fold(0.0, f64::max);
        if !found.is_same && error > equivalence::SAME_WITHIN {
            return Err(CliError::Undecided { error });
        }
        return Ok(Comparison::of(words, is_material, &found));
    }
    let receptance = |own: &Operand| match &own.subject {
        Subject::Response(Response::Massive(receptance)) => Some(receptance.clone()),
        _ => None,
    };
    let none =
        equivalence::Equivalence { is_same: false, maxwell: None, kelvin: None, worst: None };
    let mut comparison = Comparison::of(words, is_material, &none);
    let [Some(first), Some(second)] = [&operands[0], &operands[1]].map(receptance) else {
        return Ok(comparison);
    };
    match first.agreement(&second) {
        Agreement::Same { difference } => {
            comparison.same = true;
            comparison.largest_difference = Some(difference);
        }
        Agreement::Different { omega, size, time, after_impulse, is_growing, until } => {
            comparison.worst = Some(Worst {
                frequency: Some(omega / std::f64::consts::TAU),
                response: size,
                time: Some(time),
                creep: None,
                after_impulse: Some(after_impulse),
                is_growing: Some(is_growing),
                until: Some(until),
                instant_left_out: [&first, &second]
                    .iter()
                    .any(|own| own.instantaneous_compliance() > 0.0),
            });
        }
        Agreement::Undecided { error } => return Err(CliError::Undecided { error }),
    }
    Ok(comparison)
}

/// What is known of one operand by itself.
fn about(operand: &Operand) -> Result<About, CliError> {
    let linear = operand.linear()?;
    let hidden = |own: &Hidden| Cancelled { pole: own.rate, count: own.count };
    let mut cancelled: Vec<Cancelled> = match &operand.subject {
        Subject::Model(_) => Vec::new(),
        Subject::Response(Response::Massless(own)) => own.hidden.iter().map(hidden).collect(),
        Subject::Response(Response::Massive(own)) => {
            Receptance::hidden(own).iter().map(hidden).collect()
        }
    };
    let merged = linear.iter().flat_map(|own| own.merged().to_vec());
    cancelled.extend(
        merged.map(|own| Cancelled { pole: [-own.time.recip(), 0.0], count: own.count - 1 }),
    );
    let tree = operand.model();
    let poles = match &operand.subject {
        Subject::Response(Response::Massive(own)) => {
            Some(own.poles().iter().map(|pole| pole.order).sum())
        }
        _ => None,
    };
    Ok(About {
        poles,
        elements: tree.map(|tree| tree.leaves().count()),
        least_elements: linear.as_ref().map(dashpot_rheology::LinearModel::least_elements),
        maxwell_form: linear.as_ref().is_some_and(|own| own.maxwell().is_some()),
        kelvin_form: linear.as_ref().is_some_and(|own| own.kelvin().is_some()),
        cancelled,
        entangled: tree.map(together).unwrap_or_default(),
    })
}

fn together(model: &Model) -> Vec<Together> {
    let of = |group: &Entangled| Together {
        parameters: group.parameters.clone(),
        combinations: combinations(group),
    };
    groups(model).iter().map(of).collect()
}

fn map(first: &Model, second: &Model) -> Option<Map> {
    let is_small = |own: &&Model| own.leaves().nth(MOST_MAPPED).is_none();
    let of = |own: &Model| sensitivity(own, |element| primitive(element.as_ref()));
    let [first, second] = [first, second].map(|own| Some(own).filter(is_small).and_then(of));
    Some(Map::of(&first?.map_to(&second?)?))
}

/// Solves the impact with each model in the place of the element's own.
fn same_impact(
    word: &str,
    operands: &[Operand; 2],
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Impact, CliError> {
    let (path, element) = parted(word);
    let checked = read_scene(Some(std::path::Path::new(path)), set)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    let names = || scene.network.connections().iter().map(|own| own.name.clone());
    let element =
        if element.is_empty() { names().next().unwrap_or_default() } else { element.to_owned() };
    let at = names().position(|name| name == element).ok_or_else(|| CliError::UnknownElement {
        name: element.clone(),
        known: names().collect(),
    })?;
    let settings = SolveSettings { measures: Vec::new(), ..scene.settings("auto") };
    let run = |operand: &Operand| -> Result<RunReport, CliError> {
        if operand.is_material() {
            return Err(CliError::MaterialInImpact { word: operand.word.clone() });
        }
        let mut network = scene.network.clone();
        network.set_model(at, canonical_model(operand)?);
        Ok(solve(&network, &settings, &mut Silent)?)
    };
    let [first, second] = [run(&operands[0])?, run(&operands[1])?];
    let apart = differences(&first, &second);
    let measures = first.measures.iter().filter_map(|own| {
        let other = second.measures.iter().find(|other| other.key == own.key)?;
        Some(Measured {
            measure: own.key.clone(),
            unit: own.unit,
            value: [own.value, other.value],
            error: [own.error, other.error],
            difference: apart.iter().find(|known| known.key == own.key).map(|own| own.relative),
        })
    });
    Ok(Impact {
        scene: path.to_owned(),
        element,
        method: [first.solver.method, second.solver.method],
        measures: measures.collect(),
    })
}

fn text(found: &Comparison, terminal: Terminal) -> String {
    let [first, second] = &found.compared;
    let mut text = String::new();
    let verdict = if found.same { "The same" } else { "Not the same" };
    let tone = if found.same { Tone::Heading } else { Tone::Warning };
    let _ = writeln!(text, "{}: {first} and {second}", terminal.toned(tone, verdict));
    for line in sentences(found).iter().flat_map(|own| wrapped(own, WIDTH - 2)) {
        let _ = writeln!(text, "  {line}");
    }
    let small = found.map.as_ref().filter(|map| map.is_at_most(MOST_SHOWN)).map(Map::table);
    let impact = found.impact.as_ref().map(Impact::table);
    let forms = found.forms.iter().map(super::super::answer::comparison::Form::table);
    for own in forms.chain(small).chain(impact) {
        if own.rows.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, &own.caption));
        for part in side_by_side(&own, WIDTH - 2) {
            let (header, rows) = table(&part);
            for line in [header].iter().chain(&rows).filter(|line| columns(line) > 0) {
                let _ = writeln!(text, "  {line}");
            }
        }
    }
    text
}

/// The verdict in words.
fn sentences(found: &Comparison) -> Vec<String> {
    let mut all = Vec::new();
    if let Some(largest) = found.largest_difference {
        let limit = bound(found.within);
        let text = if found.same {
            "All poles and strengths agree within"
        } else {
            "A pole or strength differs by"
        };
        all.push(format!("{text} {} (the limit is {limit}).", apart(largest)));
    }
    if found.forms.is_empty() && found.worst.is_none() && !found.same {
        all.push("One of them has masses that move, the other has none.".to_owned());
    }
    all.extend(found.worst.as_ref().map(|worst| disagreement(worst, found.same)));
    for (word, about) in ["first", "second"].into_iter().zip(&found.models) {
        all.extend(described(word, about));
    }
    if let Some(map) = &found.map {
        let condition = map.condition;
        let condition =
            if condition < 1e4 { format!("{condition:.3}") } else { format!("{condition:.1e}") };
        all.push(format!(
            "Condition number {condition}: 1 % in the parameters of the first is up to that many \
             percent in one of the second.",
        ));
    }
    all
}

/// How far the responses are apart; where, only if they are.
fn disagreement(worst: &Worst, is_same: bool) -> String {
    if is_same {
        let largest = worst.creep.map_or(worst.response, |creep| creep.max(worst.response));
        return format!(
            "No response to a force or deformation differs by more than {}.",
            bound(largest)
        );
    }
    let at = |place: Option<f64>, unit: &str, limits: [&str; 2]| match place {
        Some(0.0) => limits[0].to_owned(),
        Some(own) if own.is_finite() => format!("at {}", quantity(own, unit, 3)),
        _ => limits[1].to_owned(),
    };
    let frequency =
        at(worst.frequency, "Hz", ["at ever lower frequencies", "at ever higher frequencies"]);
    let mut line = format!("The responses differ most {frequency}, by {}", share(worst.response));
    if let Some(creep) = worst.creep {
        let time = at(worst.time, "s", ["at once", "after ever longer times"]);
        let _ = write!(line, "; in creep most {time}, by {}", share(creep));
    }
    match worst.after_impulse {
        Some(0.0) => line += "; after an impulse only at the very instant",
        Some(size) => {
            let time = at(worst.time, "s", ["at once", "after ever longer times"]);
            let aside = if worst.instant_left_out { ", its own instant aside," } else { "" };
            let _ = write!(line, "; after an impulse{aside} most {time}, by {}", share(size));
            if worst.is_growing == Some(true) {
                line += " and growing";
            } else if let Some(until) = worst.until.filter(|own| own.is_finite()) {
                let _ = write!(line, " (looked at up to {})", quantity(until, "s", 3));
            }
        }
        None => {}
    }
    line + "."
}

fn described(word: &str, about: &About) -> Vec<String> {
    let mut all = Vec::new();
    if let Some(poles) = about.poles {
        all.push(format!(
            "The {word} has masses that move, and {poles} poles: no springs and dashpots alone \
             respond like it."
        ));
    }
    if let Some(least) = about.least_elements {
        let has = match about.elements {
            None => String::new(),
            Some(1) => " has 1 element and".to_owned(),
            Some(count) => format!(" has {count} elements and"),
        };
        let forms = match (about.maxwell_form, about.kelvin_form) {
            (true, true) => "in both forms, which are passive",
            (true, false) => "it bears no force, so it has no Kelvin form",
            _ => "it is rigid, so it has no Maxwell form",
        };
        all.push(format!("The {word}{has} needs {least}, {forms}."));
    }
    for own in &about.cancelled {
        let [real, imaginary] = own.pole;
        if imaginary < 0.0 {
            // Its conjugate stands for both.
            continue;
        }
        let place = if real == 0.0 && imaginary == 0.0 {
            "of free motion".to_owned()
        } else if imaginary == 0.0 {
            format!("at a time of {}", quantity(real.abs().recip(), "s", 4))
        } else {
            let real = if real.abs() < 1e-12 * imaginary { 0.0 } else { real };
            format!("at {real:.4e} ± {imaginary:.4e}i 1/s")
        };
        all.push(match own.count {
            1 => format!("In the {word}, a zero cancels a pole {place}."),
            count => format!("In the {word}, zeros cancel {count} poles {place}."),
        });
    }
    all.extend(
        about
            .entangled
            .iter()
            .map(|own| format!("In the {word}, {}.", sentence(&own.parameters, &own.combinations))),
    );
    all
}
