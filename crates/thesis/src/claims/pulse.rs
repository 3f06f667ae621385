//! What chapter III makes of the pulse that it prescribes.

use super::{Claim, row};
use crate::{
    Fit, GraphCase, Parameter, Pulse, Study, ThesisError, Varied, best_pulse, graph_cases,
    intersections, misfit,
    numbers::fit_table,
    words::{listed, significant},
};

/// A misfit below which a pulse is called a representation of the force.
const REPRESENTS: f64 = 0.1;
/// Quantities that are nearer to each other are called the same.
const NEAR: f64 = 0.01;

pub(super) fn claims(study: &Study) -> Result<Vec<Claim>, ThesisError> {
    Ok(vec![shape(study), energy(study), left_out_term(), limit(study)?, turning_time(), graph()])
}

fn shape(study: &Study) -> Claim {
    let own = misfit(&study.printed, &Pulse::PRINTED);
    let best = best_pulse(&study.printed);
    let least = best.map_or(f64::NAN, |fit| fit.misfit);
    let cases = [
        ("A = 9.9, m = 3.1".to_owned(), own < REPRESENTS),
        ("the best fit".to_owned(), least < REPRESENTS),
    ];
    let found = best.map_or_else(String::new, |Fit { pulse, misfit }| {
        let [slope, decay] = [pulse.slope, pulse.decay].map(|own| significant(own, 4));
        let misfit = significant(100.0 * misfit, 3);
        format!(" The best fit, P = {slope} and m = {decay}, is off by {misfit} %.")
    });
    Claim::over("III", "the force can be represented by A τ* e^(−m τ*)", &cases)
        .finding(format!(
            "With A = 9.9 and m = 3.1 it is off by {} % of the force, as the root of the mean \
             square.{found} Below {} % counts as represented.",
            significant(100.0 * own, 3),
            significant(100.0 * REPRESENTS, 2)
        ))
        .shown(fit_table(study))
}

fn energy(study: &Study) -> Claim {
    let values = [0.5, 1.0, 2.0, 5.0].map(|time| {
        let closed = Pulse::PRINTED.closed_energy(time).unwrap_or(f64::NAN);
        (time.to_string(), closed, study.printed.energy(time))
    });
    let is_near = |closed: f64, exact: f64| (closed / exact - 1.0).abs() < 10.0 * NEAR;
    let cases = values
        .each_ref()
        .map(|(time, closed, exact)| (format!("τ* = {time}"), is_near(*closed, *exact)));
    let rows = values
        .map(|(time, closed, exact)| vec![time, significant(closed, 5), significant(exact, 5)]);
    let checks = Pulse::PRINTED.checks();
    let (energy, impulse) = (significant(checks.energy, 6), significant(checks.impulse, 4));
    Claim::over("III", "3.59 is another way to compute the energy", &cases)
        .finding(format!(
            "In the end it gives {energy}, more than the 0.5 that the impactor brings: a force that is \
             prescribed need not keep the energy. Its impulse is {impulse} of the impactor's. Within \
             10 % of the exact energy counts as another way."
        ))
        .shown_by("Energy ω", &["τ*", "by 3.59", "exact"], rows)
}

fn left_out_term() -> Claim {
    let pulse = Pulse::PRINTED;
    let (time, deepest) = pulse.deepest();
    let end = pulse.final_deformation();
    let (printed, own) = (pulse.left_out(2.0), deepest - end);
    let rows = [("ν τ* = 20, τ* = 2", printed), ("its own time", own)]
        .map(|(at, term)| vec![at.to_owned(), significant(term, 3)]);
    let says = "the second term of 3.54 can be neglected: the largest deformation is L1";
    Claim::single("III", says, (own / deepest).abs() < 0.1 * NEAR)
        .finding(format!(
            "Of the prescribed pulse the largest deformation is {}, and L1 is {}. At its own time, \
             τ* = {}, the term is {} times as large as at ν τ* = 20 and τ* = 2, as L3 τ* + L4 nearly \
             vanishes there; still it does not matter.",
            significant(deepest, 7),
            significant(end, 7),
            significant(time, 4),
            significant((own / printed).abs(), 2)
        ))
        .shown_by("The term that is left out", &["at", "term"], rows)
}

fn limit(study: &Study) -> Result<Claim, ThesisError> {
    let pulse = Pulse::PRINTED;
    let given = [(Varied::B, Parameter::B), (Varied::D, Parameter::D)];
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (varied, parameter) in given {
        let values = varied.values();
        let exact = varied.limit(values[0], values[4])?.unwrap_or(f64::NAN);
        let simple = pulse.limit(parameter).unwrap_or(f64::NAN);
        let symbol = varied.symbol().to_owned();
        cases.push((symbol.clone(), (simple / exact - 1.0).abs() < NEAR));
        let values = [simple, exact];
        let words_of = values.map(|value| significant(value, 5));
        words.push(format!("{symbol} = {}", words_of.join(" where the exact impact has ")));
        rows.push(row([symbol].into_iter().chain(values.map(|value| significant(value, 7)))));
    }
    let same = study.printed.deepest().value / pulse.final_deformation() - 1.0;
    Ok(Claim::over(
        "III",
        "3.55 gives the value of a parameter with which the largest deformation is 1",
        &cases,
    )
    .finding(format!(
        "It gives {}. The group a has no part in it. At base the exact deformation is {} % larger \
             than L1.",
        listed(&words),
        significant(100.0 * same, 2)
    ))
    .shown_by(
        "Value with which the largest deformation is the thickness",
        &["group", "by 3.55", "exact"],
        rows,
    ))
}

fn turning_time() -> Claim {
    let pulse = Pulse::PRINTED;
    let first = |times: Vec<f64>| times.first().copied();
    let exact = first(pulse.turning_times());
    let lambert = pulse.turning_times_by_lambert().and_then(first);
    let simple = pulse.approximate_turning_time();
    let part = pulse.constants().zip(exact).map(|(own, exact)| own.l3 / own.l4 * exact);
    let pair = simple.zip(exact);
    let is_near = pair.is_some_and(|(simple, exact)| (simple / exact - 1.0).abs() < 10.0 * NEAR);
    let cell = |own: Option<f64>, digits| {
        own.map_or_else(|| "none".to_owned(), |at| significant(at, digits))
    };
    let rows = [
        ("root of ξ′", exact),
        ("Lambert's W", lambert),
        ("3.49", simple),
        ("L3 τ*/L4 there", part),
    ]
    .map(|(name, value)| vec![name.to_owned(), cell(value, 6)]);
    Claim::single("III", "3.49 gives the time of the largest deformation", is_near)
        .finding(format!(
            "For the thesis' own numbers it gives {}, where the deformation is largest at {}: it \
             needs |L3 τ*| small beside L4, and L3 τ*/L4 is {}. Lambert's W gives the time in closed \
             form.",
            cell(simple, 6),
            cell(exact, 5),
            cell(part, 5)
        ))
        .shown_by("Time of the largest deformation", &["by", "τ*"], rows)
}

fn graph() -> Claim {
    let pulse = Pulse::PRINTED;
    let (mut rows, mut cases, mut before) = (Vec::new(), Vec::new(), Vec::new());
    for GraphCase { line, what, pulse } in graph_cases() {
        let Some(constants) = pulse.constants() else { continue };
        let times = pulse.turning_times();
        let count = intersections(constants.theta, constants.psi).len();
        let name = format!("line {line}");
        if count > 0 {
            cases.push((name.clone(), times.len() == count));
        }
        if constants.theta < 0.0 && times.is_empty() {
            before.push(name.clone());
        }
        let shown: Vec<String> = times.iter().map(|at| significant(*at, 4)).collect();
        let shown = if shown.is_empty() { "none".to_owned() } else { shown.join(", ") };
        let numbers = [pulse.slope, pulse.decay, constants.theta, constants.psi];
        let numbers = numbers.map(|number| significant(number, 3));
        let cells = [name, what.to_owned()].into_iter().chain(numbers);
        rows.push(row(cells.chain([count.to_string(), shown])));
    }
    let nu = pulse.constants().map_or(f64::NAN, |own| own.nu);
    let says = "every real root of 3.39 is a time at which the deformation is largest";
    let header = ["line", "what", "P", "m", "θ", "ψ", "roots", "times τ* > 0"];
    Claim::over("III, figure 4", says, &cases)
        .finding(format!(
            "With the thesis' m = {} and ν = {}, times after the first contact are negative values \
             of z = (m − ν) τ*, so a root with z > 0 lies before it. A falling line has one root, but \
             no time by {}.",
            significant(pulse.decay, 3),
            significant(nu, 3),
            listed(&before)
        ))
        .shown_by("Roots of e^z = θ z + ψ, and the times among them", &header, rows)
}
