//! Changes of a text that leave most scenes such as the reader takes.

use std::ops::Range;

use crate::random_networks::Dice;

/// Numbers that stand for any other.
const EXTREMES: [&str; 12] = [
    "0", "-1", "1", "1e-310", "5e-324", "1e300", "1.7e308", "1e-30", "1e20", "1e9", "-1e-9", "0.5",
];
/// Powers of ten by which a number is scaled.
const POWERS: [i32; 16] = [-30, -12, -9, -6, -4, -3, -2, -1, 1, 2, 3, 4, 6, 9, 12, 30];
/// Laws that stand in place of others, or beside them.
const LAWS: [&str; 14] = [
    "friction = 50",
    "friction = \"3 kN\"",
    "contact = { gap = \"1 mm\", restitution = 0.5 }",
    "contact = { restitution = 1 }",
    "series = [{ contact = {} }, { spring = 1e5 }]",
    "series = [{ friction = 200 }, { maxwell = { spring = 1e5, dashpot = 300 } }]",
    "cubic-spring = { stiffness = 2e4, cubic = 2e8 }",
    "power-spring = { force = 2e3, at = 1e-2, exponent = 1.5 }",
    "power-dashpot = { force = 200, at = 1, exponent = 0.5 }",
    "power-dashpot = { force = 200, at = 1, exponent = 3 }",
    "hunt-crossley = { force = 1e3, at = 1e-3, dissipation = 0.3 }",
    "stiffening-spring = { stiffness = 2e4, limit = 2e-2 }",
    "hysteretic-table = { loading = [[0, 0], [4e-3, 500], [2e-2, 3e3]], unloading = [[3e-3, 0], [2e-2, 3e3]] }",
    "burgers = { maxwell = { spring = 2e5, dashpot = 6e2 }, kelvin = { spring = 2e5, dashpot = 4e2 } }",
];

/// The text with one to three changes.
pub(super) fn mutated(dice: &mut Dice, text: &str) -> String {
    let mut text = text.to_owned();
    for _ in 0..=dice.below(3) {
        text = match dice.below(12) {
            0..=4 => scaled(dice, &text),
            5 | 6 => replaced(dice, &text),
            7 => without_line(dice, &text),
            8 => doubled(dice, &text),
            9 => with_element(dice, &text),
            _ => with_effect(dice, &text),
        };
    }
    text
}

/// Where the numbers of a text are.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let is_inside = |own: u8| own.is_ascii_alphanumeric() || b"._-+".contains(&own);
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let begins = bytes[at].is_ascii_digit() && (at == 0 || !is_inside(bytes[at - 1]));
        let end = (at..bytes.len()).find(|&to| !is_inside(bytes[to])).unwrap_or(bytes.len());
        if begins && text[at..end].parse::<f64>().is_ok() {
            found.push(at..end);
        }
        at = end.max(at + 1);
    }
    found
}

fn at_number(dice: &mut Dice, text: &str, new: impl FnOnce(&mut Dice, f64) -> String) -> String {
    let all = numbers(text);
    if all.is_empty() {
        return text.to_owned();
    }
    let place = all[dice.below(all.len())].clone();
    let new = new(dice, text[place.clone()].parse().unwrap());
    format!("{}{new}{}", &text[..place.start], &text[place.end..])
}

fn scaled(dice: &mut Dice, text: &str) -> String {
    at_number(dice, text, |dice, old| {
        let new = old * 10f64.powi(POWERS[dice.below(POWERS.len())]);
        format!("{:e}", if new.is_finite() { new } else { 1e308 })
    })
}

fn replaced(dice: &mut Dice, text: &str) -> String {
    at_number(dice, text, |dice, _| EXTREMES[dice.below(EXTREMES.len())].to_owned())
}

fn without_line(dice: &mut Dice, text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let out = dice.below(lines.len());
    let kept = lines.iter().enumerate().filter(|(at, _)| *at != out);
    kept.flat_map(|(_, line)| [line, "\n"]).collect()
}

/// The line of an inline table once more, under another name.
fn doubled(dice: &mut Dice, text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let tables: Vec<usize> = (0..lines.len()).filter(|&at| lines[at].contains(" = {")).collect();
    if tables.is_empty() {
        return text.to_owned();
    }
    let twice = tables[dice.below(tables.len())];
    let mut all = String::new();
    for (at, line) in lines.iter().enumerate() {
        all.extend([line, "\n"]);
        if at == twice {
            all.extend([&line.replacen(" = {", "-again = {", 1), "\n"]);
        }
    }
    all
}

/// Names that a text gives to the lines or tables of one kind.
fn names(text: &str, table: &str) -> Vec<String> {
    let (mut is_inside, mut found) = (false, Vec::new());
    for line in text.lines().map(str::trim) {
        if let Some(head) = line.strip_prefix('[') {
            let head = head.split(']').next().unwrap_or_default();
            is_inside = head == table;
            let own = head.strip_prefix(table).and_then(|rest| rest.strip_prefix('.'));
            found.extend(own.map(|own| own.split('.').next().unwrap_or_default().to_owned()));
        } else if let (true, Some((name, _))) = (is_inside, line.split_once('=')) {
            found.push(name.split('.').next().unwrap_or_default().trim().to_owned());
        }
    }
    found.dedup();
    found
}

/// The text with a line in one of its tables, which is made if need be.
fn with_line(text: &str, table: &str, line: &str) -> String {
    let head = format!("[{table}]\n");
    match text.find(&head) {
        Some(at) => {
            let (before, after) = text.split_at(at + head.len());
            format!("{before}{line}\n{after}")
        }
        None => format!("{text}\n[{table}]\n{line}\n"),
    }
}

fn with_effect(dice: &mut Dice, text: &str) -> String {
    let elements = names(text, "elements");
    if elements.is_empty() {
        return text.to_owned();
    }
    let on = &elements[dice.below(elements.len())];
    let line = match dice.below(8) {
        0 => "gravity = true".to_owned(),
        1 => "gravity = { start = \"unloaded\" }".to_owned(),
        2 | 3 => format!("separation.{on} = {{}}"),
        4 => format!("separation.{on} = {{ restitution = 0.7 }}\nface.{on} = {{ mass = 0.2 }}"),
        5 => format!("face.{on} = {{ mass = 1e-3 }}"),
        6 => format!("stop.{on} = {{ at = 2e-3, restitution = 0.9 }}"),
        _ => format!("stop.{on} = {{ at = 1e-3, stiffness = 1e7, damping = 1e3 }}"),
    };
    with_line(text, "effects", &line)
}

fn with_element(dice: &mut Dice, text: &str) -> String {
    let mut nodes = names(text, "nodes");
    nodes.push("ground".to_owned());
    let [a, b] = [0; 2].map(|_| nodes[dice.below(nodes.len())].clone());
    let law = LAWS[dice.below(LAWS.len())];
    with_line(text, "elements", &format!("added = {{ between = [\"{a}\", \"{b}\"], {law} }}"))
}
