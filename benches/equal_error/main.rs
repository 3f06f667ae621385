//! Every method against hand-written code at equal true error, side by side in one run.
//!
//! `cargo bench -p dashpot-benches --bench equal_error` prints a table for each problem, and with `UPDATE_DOCS=1` writes
//! them into `docs/benchmarks.md`. Words after `--` pick the problems whose titles have them.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a benchmark prints its tables, and on the way how far it is"
)]

mod by_hand;
mod chain;
mod cpu;
mod cvode;
mod explicit;
mod impact;
mod ours;
mod problems;
mod race;

use std::{fmt::Write as _, time::Duration};

use dashpot::dae::methods;
use dashpot_cvode::Cvode;

use self::{
    problems::{Problem, SAMPLES},
    race::{Contender, Ladder, Reached, climb, error, race},
};

/// Where the tables stand in the document.
const PLACE: (&str, &str) = ("<!-- measured: equal error -->", "<!-- end -->");
const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/benchmarks.md");

/// The name of CVODE's row.
const CVODE: &str = "CVODE, banded";

/// How long the truth may take \[s\].
const PATIENCE: f64 = 3600.0;

/// States beyond which explicit methods and one-step methods are left out.
const LARGE: usize = 5000;

fn main() -> Result<(), String> {
    let (flags, words): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|word| word.starts_with("--"));
    // Under `cargo test` nothing is to be measured.
    if !flags.iter().any(|flag| flag == "--bench") {
        return Ok(());
    }
    let cvode = cvode::installed()?;
    let (mut text, mut faults) = (String::new(), Vec::new());
    for problem in problems::all()? {
        if words.iter().all(|word| problem.title.contains(word.as_str())) {
            match table(&problem, cvode) {
                Ok(table) => {
                    println!("{table}");
                    let _ = write!(text, "\n{table}");
                }
                Err(why) => faults.push(format!("{}: {why}", problem.title)),
            }
        }
    }
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    if std::env::var_os("UPDATE_DOCS").is_some() && words.is_empty() {
        update(&text)?;
    }
    Ok(())
}

/// What all contenders need for one problem. The first of them who is measured is the one whom the others are
/// compared with.
fn table(problem: &Problem, cvode: Option<Cvode>) -> Result<String, String> {
    let times = problem.times();
    let own: Vec<f64> = times.iter().map(|t| t / problem.end * problem.by_hand.end()).collect();
    let patience = Duration::from_secs_f64(problem.patience);
    let (truth, threshold) = truth(problem, &times)?;
    let mut text = format!("**{}.**", problem.title);
    if threshold > 0.0 {
        let _ = write!(text, " The reference is itself known to {threshold:.0e}.");
    }
    text += "\n\n| |";
    for wanted in problem.wanted {
        let _ = write!(text, " error {wanted:.0e} |");
    }
    text += "\n|---|---|---|---|\n";

    let mut base: Option<(Contender<'_>, Ladder)> = None;
    for mut contender in contenders(problem, (&times, &own), cvode)? {
        eprintln!("{}: {}", problem.title, contender.name);
        let ladder = climb(&mut contender, &truth, problem.wanted, patience);
        let cells = cells(&ladder, |at, reached| {
            let other = base.as_mut().and_then(|(base, ladder)| Some((base, ladder.reached[at]?)));
            match other {
                Some((base, other)) => {
                    race([(&mut contender.job, reached.rtol), (&mut base.job, other.rtol)])
                }
                None => [race([(&mut contender.job, reached.rtol)])[0], 0.0],
            }
        });
        row(&mut text, &contender.name, &cells);
        base.get_or_insert((contender, ladder));
    }
    if problem.band.is_some() && cvode.is_none() {
        row(&mut text, CVODE, &[cvode::missing(), String::new(), String::new()]);
    }
    Ok(text)
}

/// The true values, and how far they may be off: those of the exact method where it applies, else of
/// fine steps, of which a tenth of the tolerance is left out for comparison.
fn truth(problem: &Problem, times: &[f64]) -> Result<(Vec<f64>, f64), String> {
    let solve = |name: &str, rtol| {
        let method = methods::by_name(name).ok_or("no such method")?;
        ours::job(method, problem, times, PATIENCE)(rtol)
    };
    if let Ok(truth) = solve("exact", 1e-6) {
        return Ok((truth, 0.0));
    }
    let least = problem.wanted.iter().copied().fold(f64::INFINITY, f64::min);
    let finest = if problem.assembly.system.len() > LARGE { 0.02 * least } else { 1e-11 };
    let (truth, other) = (solve("bdf", finest)?, solve("bdf", 10.0 * finest)?);
    let threshold = error(&other, &truth);
    Ok((truth, threshold))
}

/// Everyone, code by hand first; `times` are those in seconds and in units by hand.
fn contenders<'a>(
    problem: &'a Problem,
    (times, own): (&'a [f64], &'a [f64]),
    cvode: Option<Cvode>,
) -> Result<Vec<Contender<'a>>, String> {
    let (by_hand, choice) = (&*problem.by_hand, ours::choice(problem));
    let is_large = problem.assembly.system.len() > LARGE;
    let of = |name: &str, job| Contender { name: name.to_owned(), job, is_exact: false };
    let mut all = Vec::new();
    if let Some(job) = cvode.and_then(|cvode| cvode::job(cvode, problem, own)) {
        all.push(of(CVODE, job));
    }
    if !is_large {
        all.push(of("diffsol's BDF by hand", by_hand::bdf(by_hand, own)?));
    }
    for method in methods::all() {
        let name = method.name();
        let is_slow = is_large && !["auto", "bdf"].contains(&name);
        if name == choice || is_slow {
            continue;
        }
        let is_exact = name == "exact" || name == "auto" && choice == "exact";
        let name = if name == "auto" { format!("`auto`: `{choice}`") } else { format!("`{name}`") };
        let job = ours::job(method, problem, times, problem.patience);
        all.push(Contender { name, job, is_exact });
    }
    if !is_large {
        all.push(of("ode_solvers, Dopri5", explicit::dopri5(by_hand, SAMPLES)));
        all.push(of("ode_solvers, Dop853", explicit::dop853(by_hand, SAMPLES)));
    }
    Ok(all)
}

/// What a table says of a contender, whose time and that of the one it is compared with `timed` tells.
fn cells(ladder: &Ladder, mut timed: impl FnMut(usize, Reached) -> [f64; 2]) -> [String; 3] {
    if ladder.reached.iter().all(Option::is_none) {
        return [ladder.end.clone(), String::new(), String::new()];
    }
    let mut at = 0;
    ladder.reached.map(|reached| {
        at += 1;
        let Some(reached) = reached else { return ladder.end.clone() };
        let [own, other] = timed(at - 1, reached);
        let ratio = if other > 0.0 { format!(" (× {:.2})", own / other) } else { String::new() };
        let (time, error, rtol) = (milliseconds(own), reached.error, reached.rtol);
        // What the others are compared with has no error, and its tolerance no meaning.
        if error == 0.0 {
            return format!("**{time}**{ratio}");
        }
        format!("**{time}**{ratio}: {error:.0e} at {rtol:.0e}")
    })
}

fn row(text: &mut String, name: &str, cells: &[String; 3]) {
    let _ = writeln!(text, "| {name} | {} |", cells.join(" | "));
}

/// A time with three digits.
fn milliseconds(seconds: f64) -> String {
    match seconds {
        ..1e-3 => format!("{:.3} ms", 1e3 * seconds),
        ..1e-2 => format!("{:.2} ms", 1e3 * seconds),
        ..0.1 => format!("{:.1} ms", 1e3 * seconds),
        _ => format!("{:.0} ms", 1e3 * seconds),
    }
}

/// Writes the tables into the document.
fn update(tables: &str) -> Result<(), String> {
    let fault = |error: std::io::Error| format!("{DOCUMENT}: {error}");
    let text = std::fs::read_to_string(DOCUMENT).map_err(fault)?;
    let (head, rest) = text.split_once(PLACE.0).ok_or("the document has no place for tables")?;
    let (_, tail) = rest.split_once(PLACE.1).ok_or("the place for tables has no end")?;
    let (begin, end) = PLACE;
    std::fs::write(DOCUMENT, format!("{head}{begin}\n\n{tables}\n{end}{tail}")).map_err(fault)
}
