//! Swept sines: a chirp on a free mass, and on and under a mass on a pad, past its resonance.

use super::{
    reference::Case,
    trial::{STEPPING, Side, Trial, judge, run},
};

const CHIRP: &str =
    "chirp = { amplitude = <P>, from = <f0>, to = <f1>, duration = <length>, start = <start> }";

/// A mass on a pad over the floor, driven by a chirp.
fn scene(pad: &str, floor: &str, loads: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = <m> }}\nfloor = {{ {floor} }}\n\
         [elements]\npad = {{ between = [\"head\", \"floor\"], {pad} }}\n{loads}\n\
         [run]\nduration = <after.time>\n"
    )
}

/// During the sweep, at its end, and when the frequency stays.
fn instants(case: &Case) -> [(&'static str, f64); 3] {
    let end = case.param("start") + case.param("length");
    [("sweep", case.param("sweep.time")), ("end", end), ("after", case.param("after.time"))]
}

/// Place and speed at these instants.
fn moves_as_told(trial: &Trial<'_>) {
    let case = trial.case;
    for (name, time) in instants(case) {
        for of in ["position", "velocity"] {
            let quantity = format!("{name}.{of}");
            trial.value(&format!("head.{of}"), time, Side::Before, &quantity);
        }
    }
}

#[test]
fn a_chirp_moves_a_free_mass_as_fresnels_integrals_say() {
    let case = Case::of("chirp-free");
    let load = format!("[loads]\npush = {{ on = \"head\", force = {{ {CHIRP} }} }}");
    let text = case.fill(&scene("spring = 0", "fixed = true", &load));
    // Nothing brings the mass back, so its errors are those of a speed and a way that the force would
    // give it if it did not turn around.
    let time = case.param("after.time");
    let speed = case.param("P") / case.param("m") * time;
    for method in STEPPING {
        let report = run(&text, method);
        let rtol = report.solver.rtol.unwrap() * if *method == "tr-bdf2" { 1e4 } else { 1e3 };
        let solution = report.solution();
        for (name, time) in instants(case) {
            for (of, size) in [("velocity", speed), ("position", speed * time)] {
                let output = report.assembly.output(&format!("head.{of}")).unwrap();
                let off = solution.signal(output).value(time) - case.get(&format!("{name}.{of}"));
                assert!(off.abs() <= rtol * size, "{of} at {name} by {method}: {off:e}");
                assert!(rtol < 1e-4, "{rtol} says nothing");
            }
        }
    }
}

#[test]
fn a_chirp_takes_a_mass_on_a_pad_through_its_resonance() {
    let pad = "parallel = [{ spring = <K> }, { dashpot = <C> }]";
    let load = format!("[loads]\npush = {{ on = \"head\", force = {{ {CHIRP} }} }}");
    let text = scene(pad, "fixed = true", &load);
    judge(Case::of("chirp-force"), STEPPING, &text, moves_as_told);
    let text = scene(pad, &format!("motion = {{ {CHIRP} }}"), "");
    judge(Case::of("chirp-motion"), STEPPING, &text, moves_as_told);
}
