//! Every method against hand-written code at equal true error, side by side in one run.
//!
//! `cargo bench --bench equal_error` prints a table for each problem, and with `UPDATE_DOCS=1` writes
//! them into `docs/benchmarks.md`. Words after `--` pick the problems whose titles have them.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a benchmark prints its tables, and on the way how far it is"
)]

mod by_hand;
mod chain;
mod explicit;
mod impact;
mod ours;
mod problems;
mod race;

use std::{fmt::Write as _, time::Duration};

use dashpot::dae::methods;

use self::{
    impact::Impact,
    problems::{Problem, SAMPLES},
    race::{Contender, Ladder, Reached, climb, error, race},
};

/// Where the tables stand in the document.
const PLACE: (&str, &str) = ("<!-- measured: equal error -->", "<!-- end -->");
const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/benchmarks.md");

/// What hand-written diffsol needed for the reference impact at a tolerance of 10⁻⁶ on the machine on
/// which CVODE was measured \[s\].
const THERE: f64 = 79e-6;

/// States beyond which explicit methods and one-step methods are left out.
const LARGE: usize = 5000;

fn main() -> Result<(), String> {
    let (flags, words): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|word| word.starts_with("--"));
    // Under `cargo test` nothing is to be measured.
    if !flags.iter().any(|flag| flag == "--bench") {
        return Ok(());
    }
    let here = here()?;
    let mut text = format!(
        "Hand-written diffsol needs {:.1} µs for the reference impact at a tolerance of 10⁻⁶ here.\n",
        1e6 * here
    );
    println!("{text}");
    for problem in problems::all()? {
        if words.iter().all(|word| problem.title.contains(word.as_str())) {
            let table = table(&problem, here / THERE)?;
            println!("{table}");
            let _ = write!(text, "\n{table}");
        }
    }
    if std::env::var_os("UPDATE_DOCS").is_some() && words.is_empty() {
        update(&text)?;
    }
    Ok(())
}

/// The time of hand-written diffsol for the reference impact at a tolerance of 10⁻⁶ \[s\].
fn here() -> Result<f64, String> {
    let reference = Impact::with_mount(0.2);
    let times: Vec<f64> = (0..=SAMPLES).map(|at| f64::from(at) / 50.0).collect();
    let mut job = by_hand::bdf(&reference, &times)?;
    Ok(race([(&mut job, 1e-6)])[0].as_secs_f64())
}

/// What all contenders need for one problem.
fn table(problem: &Problem, machine: f64) -> Result<String, String> {
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

    let is_large = problem.assembly.system.len() > LARGE;
    let mut hand = if is_large {
        None
    } else {
        let job = by_hand::bdf(&*problem.by_hand, &own)?;
        Some(Contender { name: "diffsol's BDF by hand".to_owned(), job, is_exact: false })
    };
    let ladder = hand.as_mut().map(|hand| climb(hand, &truth, problem.wanted, patience));
    if let (Some(hand), Some(ladder)) = (&mut hand, &ladder) {
        let cells =
            cells(ladder, |_, reached| [race([(&mut hand.job, reached.rtol)])[0], Duration::ZERO]);
        row(&mut text, &hand.name, &cells);
    }
    for mut contender in contenders(problem, &times, is_large) {
        eprintln!("{}: {}", problem.title, contender.name);
        let own = climb(&mut contender, &truth, problem.wanted, patience);
        let cells = cells(&own, |at, reached| {
            let base = ladder.as_ref().and_then(|ladder| ladder.reached[at]);
            match (&mut hand, base) {
                (Some(hand), Some(base)) => {
                    race([(&mut contender.job, reached.rtol), (&mut hand.job, base.rtol)])
                }
                _ => [race([(&mut contender.job, reached.rtol)])[0], Duration::ZERO],
            }
        });
        row(&mut text, &contender.name, &cells);
    }
    if problem.cvode.iter().any(Option::is_some) {
        let cell = |time: Option<f64>| {
            time.map_or_else(String::new, |time| milliseconds(time * machine * 1e-3))
        };
        row(&mut text, "CVODE, banded, in proportion", &problem.cvode.map(cell));
    }
    Ok(text)
}

/// The true values, and how far they may be off: those of the exact method where it applies, else of
/// fine steps, of which a tenth of the tolerance is left out for comparison.
fn truth(problem: &Problem, times: &[f64]) -> Result<(Vec<f64>, f64), String> {
    let solve = |name: &str, rtol| {
        let method = methods::by_name(name).ok_or("no such method")?;
        ours::job(method, problem, times, 60.0)(rtol)
    };
    if let Ok(truth) = solve("exact", 1e-6) {
        return Ok((truth, 0.0));
    }
    let finest = if problem.assembly.system.len() > LARGE { 1e-9 } else { 1e-11 };
    let (truth, other) = (solve("bdf", finest)?, solve("bdf", 10.0 * finest)?);
    let threshold = error(&other, &truth);
    Ok((truth, threshold))
}

/// Everyone but the hand-written code of the first row.
fn contenders<'a>(problem: &'a Problem, times: &'a [f64], is_large: bool) -> Vec<Contender<'a>> {
    let choice = ours::choice(problem);
    let mut all = Vec::new();
    for method in methods::all() {
        let name = method.name();
        let is_slow = is_large && !["auto", "bdf"].contains(&name);
        if name == choice || is_slow {
            continue;
        }
        let is_exact = name == "exact" || name == "auto" && choice == "exact";
        let name = if name == "auto" { format!("`auto`: `{choice}`") } else { format!("`{name}`") };
        all.push(Contender {
            name,
            job: ours::job(method, problem, times, problem.patience),
            is_exact,
        });
    }
    if !is_large {
        let by_hand = &*problem.by_hand;
        for (name, job) in [
            ("ode_solvers, Dopri5", explicit::dopri5(by_hand, SAMPLES)),
            ("ode_solvers, Dop853", explicit::dop853(by_hand, SAMPLES)),
        ] {
            all.push(Contender { name: name.to_owned(), job, is_exact: false });
        }
    }
    all
}

/// What a table says of a contender, whose time and that of the hand-written code `timed` tells.
fn cells(ladder: &Ladder, mut timed: impl FnMut(usize, Reached) -> [Duration; 2]) -> [String; 3] {
    if ladder.reached.iter().all(Option::is_none) {
        return [ladder.end.clone(), String::new(), String::new()];
    }
    let mut at = 0;
    ladder.reached.map(|reached| {
        at += 1;
        let Some(reached) = reached else { return ladder.end.clone() };
        let [own, hand] = timed(at - 1, reached).map(|time| time.as_secs_f64());
        let ratio = if hand > 0.0 { format!(" (× {:.2})", own / hand) } else { String::new() };
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
