//! A group of cases by all methods, as a table.

use std::{fmt::Write as _, sync::Arc};

use dashpot::dae::methods;

use super::{attempt::attempt, case::Case, page};

/// Solves the cases by every method, holds the outcomes against those of the page, and fails where
/// one is none that a case with an answer may have.
#[expect(clippy::print_stdout, reason = "one case alone is shown where it is asked for")]
pub(super) fn judge(section: &str, cases: Vec<Case>) {
    let wanted = std::env::var("HARD_CASE").ok();
    let is_wanted = |case: &Case| wanted.as_ref().is_none_or(|text| case.name.contains(text));
    let methods = methods();
    let mut table = format!(
        "| case | judge | {} |\n|{}",
        methods.join(" | "),
        "---|".repeat(methods.len() + 2)
    );
    table.push('\n');
    let mut notes: Vec<(String, Vec<String>)> = Vec::new();
    let mut defects = Vec::new();
    for case in cases.into_iter().filter(is_wanted).map(Arc::new) {
        write!(table, "| {} | {} |", case.name, case.judge).unwrap();
        for &method in &methods {
            let attempt = attempt(&case, method);
            let outcome = attempt.outcome;
            let by = if method == "auto" { format!("`{}` ", attempt.by) } else { String::new() };
            let by = if outcome.is_right() { by } else { String::new() };
            write!(table, " {by}{} |", outcome.cell()).unwrap();
            if let Some(words) = outcome.words() {
                let note = format!("`{method}` {}: {words}", outcome.cell());
                match notes.iter_mut().find(|own| page::shape(&own.0) == page::shape(&note)) {
                    Some((_, names)) => names.push(case.name.clone()),
                    None => notes.push((note, vec![case.name.clone()])),
                }
            }
            let defect = outcome.defect().or_else(|| {
                (method == "auto" && !outcome.is_right())
                    .then(|| format!("is {} by `{}`", outcome.cell(), attempt.by))
            });
            defects.extend(defect.map(|defect| format!("{} by {method}: {defect}", case.name)));
        }
        table.push('\n');
    }
    for (at, (note, names)) in notes.iter().enumerate() {
        let before = if at == 0 { "\n" } else { "" };
        writeln!(table, "{before}- {note} ({})", names.join("; ")).unwrap();
    }
    let differences = if wanted.is_some() { Vec::new() } else { page::hold(section, &table) };
    if wanted.is_some() {
        println!("{table}");
    }
    assert!(
        defects.is_empty() && differences.is_empty(),
        "{}\n{}",
        defects.join("\n"),
        differences.join("\n")
    );
}

/// The methods in the order of the columns, `auto` last.
fn methods() -> Vec<&'static str> {
    let mut names: Vec<&str> = methods::all().iter().map(|method| method.name()).collect();
    let at = |name: &str| match name {
        "exact" => 0,
        "auto" => 2,
        _ => 1,
    };
    names.sort_by_key(|name| at(name));
    names
}
