//! Tables of what the thesis prints no numbers for.

use std::f64::consts::E;

use dashpot_report::Table;

use crate::{Checks, Fit, Impact, Parameter, Pulse, Study, best_pulse, misfit, words::significant};

/// What chapter III has no numbers for: its constants and results for the padding of chapter IV.
pub fn chapter_3_table() -> Table {
    let pulse = Pulse::PRINTED;
    let mut rows: Vec<(&str, &str, f64)> = Vec::new();
    if let Some(own) = pulse.constants() {
        rows.extend([
            ("3.18", "R1", own.r1),
            ("3.19", "R2", own.r2),
            ("3.27", "L1", own.l1),
            ("3.26", "L2", own.l2),
            ("3.32", "L3", own.l3),
            ("3.33", "L4 = ψ", own.psi),
            ("3.39", "θ", own.theta),
        ]);
    }
    let (time, deepest) = pulse.deepest();
    let checks = pulse.checks();
    rows.extend([
        ("3.34", "τ* of the largest deformation", time),
        ("3.54", "largest deformation", deepest),
        ("3.54", "what is left out at ν τ* = 20 and τ* = 2", pulse.left_out(2.0)),
        ("3.55", "b with which the deformation ends at 1", {
            pulse.limit(Parameter::B).unwrap_or(f64::NAN)
        }),
        ("3.59", "energy in the end; the impactor brings 0.5", checks.energy),
        ("3.1", "peak P/(m e)", pulse.slope / (pulse.decay * E)),
        ("3.1", "impulse P/m²; 1 stops the impactor", checks.impulse),
        ("2.26", "start slope P over e", checks.start_slope),
    ]);
    let row = |(place, what, value): (&str, &str, f64)| {
        vec![place.to_owned(), what.to_owned(), significant(value, 6)]
    };
    Table::new(
        "Chapter III with P = 9.9, m = 3.1 and the groups of chapter IV",
        &["equation", "what", "value"],
        rows.into_iter().map(row),
    )
}

/// What the equations 2.20 to 2.26 give exactly.
pub fn exact_table(study: &Study) -> Table {
    let cases = [
        ("printed groups, α = 0.2", &study.printed),
        ("printed groups, α = 200", &study.printed_stiff),
        ("constants, C₃ = 10 kN s/m", &study.system),
        ("constants, C₃ = 10 MN s/m", &study.system_stiff),
    ];
    let row = |(name, impact): (&str, &Impact)| {
        let (peak, deepest) = (impact.peak(), impact.deepest());
        let digits = |value: f64| format!("{value:.9}");
        let release = impact.release().map_or_else(|| "–".to_owned(), digits);
        let values = [peak.value, peak.time, deepest.value, deepest.time].map(digits);
        let energies = [5.0, 10.0].map(|time| digits(impact.energy(time)));
        [name.to_owned()].into_iter().chain(values).chain([release]).chain(energies).collect()
    };
    let header = ["impact", "φ max", "at τ*", "ξ max", "at τ*", "release τ*", "ω(5)", "ω(10)"];
    Table::new("The impact of chapter IV, exactly", &header, cases.into_iter().map(row))
}

/// The best-fitting pulse beside the one that is printed.
pub fn fit_table(study: &Study) -> Table {
    let own = &study.printed;
    let of_fit = |Fit { pulse, misfit }: Fit| {
        let (Pulse { slope, decay, .. }, checks) = (pulse, pulse.checks());
        let (peak, deepest) = (slope / (decay * E), pulse.deepest().1);
        let Checks { impulse, start_slope: start, energy, .. } = checks;
        [slope, decay, peak, 1.0 / decay, misfit, impulse, start, energy, deepest]
    };
    let printed = Fit { pulse: Pulse::PRINTED, misfit: misfit(own, &Pulse::PRINTED) };
    let (peak, end, slope) = (own.peak(), own.end(), own.groups.c);
    let (impulse, energy) = (1.0 - own.impactor_speed(end), own.energy(end));
    let deepest = own.deepest().value;
    let exact = [slope, f64::NAN, peak.value, peak.time, 0.0, impulse, 1.0, energy, deepest];
    let best = best_pulse(own).map(|best| ("best fit", of_fit(best)));
    let rows = [Some(("thesis", of_fit(printed))), best, Some(("exact impact", exact))];
    let rows = rows.into_iter().flatten().map(|(name, values)| {
        [name.to_owned()].into_iter().chain(values.map(|own| significant(own, 4))).collect()
    });
    let of_force = ["pulse", "P", "m", "peak φ", "at τ*", "misfit"];
    let header = of_force.into_iter().chain(["impulse", "start slope / e", "energy", "ξ max"]);
    Table::new("The pulse P τ e^(−mτ) that stands for the force", header, rows)
}
