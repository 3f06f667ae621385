//! Pads of materials and shifted times, against the same scene in plain numbers.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    network::linear_model,
    rheology::equivalence::compare,
    scene::Scene,
};

use super::scene;

/// A scene whose `padding` has this law, with more tables.
fn with_padding(tables: &str, law: &str) -> Scene {
    scene(&format!(
        "{tables}\n[nodes]\nhead = {{ mass = \"10 kg\", velocity = \"10 m/s\" }}\n\
         panel = {{ mass = \"100 kg\" }}\n[elements]\n\
         padding = {{ between = [\"head\", \"panel\"], {law} }}\n\
         mount = {{ between = [\"panel\", \"ground\"], kelvin = {{ spring = \"50 MN/m\", \
         dashpot = \"10 kN s/m\" }} }}\n[run]\nduration = \"20 ms\"\n"
    ))
}

fn run(scene: &Scene) -> RunReport {
    let settings = SolveSettings::lasting(scene.run.duration).by_name("exact").unwrap();
    scene.network.solve_with(&settings).unwrap()
}

/// Constants of both paddings agree within `epsilons` roundings, so measures, which follow them
/// with factors of about one, agree within 1e-14 and what `exact` says of its own rounding.
#[track_caller]
fn assert_alike(one: &Scene, other: &Scene, epsilons: f64) {
    let [first, second] = [one, other].map(|own| own.network.connections()[0].model.parts());
    assert_eq!(first.len(), second.len());
    for ((path, a), (_, b)) in first.iter().zip(&second) {
        let [a, b] = [a, b].map(|own| {
            let tangent = own.tangent(0.0, 0.0);
            tangent.stiffness + tangent.damping
        });
        assert!((a / b - 1.0).abs() <= epsilons * f64::EPSILON, "{path}: {a:e} for {b:e}");
    }
    let [one, other] = [one, other].map(run);
    assert!(one.measures.len() >= 8);
    for (a, b) in one.measures.iter().zip(&other.measures) {
        let gap = (a.value.unwrap() - b.value.unwrap()).abs();
        assert!(gap <= 1e-14 * a.size + a.error.unwrap(), "{}: {gap:e} of {:e}", a.key, a.size);
    }
}

const MATERIALS: &str = r#"
[materials.foam]
zener = { spring = "0.8 MPa", maxwell = { spring = "3 MPa", dashpot = "9 kPa s" } }
[materials.gel]
series = [{ spring = "40 MPa" }, { dashpot = "50 kPa s" }, { kelvin-chain = [["1 ms", "2e-7 1/Pa"], ["0.1 s", "3e-8 1/Pa"]] }]
"#;

#[test]
fn layers_of_materials_are_pads_with_their_stiffnesses_over_length_and_area() {
    let layers = with_padding(
        MATERIALS,
        "series = [{ material = \"foam\", thickness = \"1 cm\", area = \"800 cm^2\" }, \
         { material = \"gel\", thickness = \"3 mm\", area = \"250 cm^2\" }]",
    );
    // A/h, as pad after pad.
    let [foam, gel] = [0.08 / 0.01, 0.025 / 0.003];
    let kelvin = |time: f64, compliance: f64| {
        let stiffness = gel / compliance;
        format!("{{ kelvin = {{ spring = {stiffness:e}, dashpot = {:e} }} }}", time * stiffness)
    };
    let explicit = with_padding(
        "",
        &format!(
            "series = [{{ zener = {{ spring = {:e}, maxwell = {{ spring = {:e}, dashpot = {:e} }} }} \
             }}, {{ series = [{{ spring = {:e} }}, {{ dashpot = {:e} }}, {}, {}] }}]",
            0.8e6 * foam,
            3e6 * foam,
            9e3 * foam,
            40e6 * gel,
            50e3 * gel,
            kelvin(1e-3, 2e-7),
            kelvin(0.1, 3e-8),
        ),
    );
    // Numbers with units, A/h, the product with a modulus, 1/J and λ/J are rounded on each side.
    assert_alike(&layers, &explicit, 4.0);
}

#[test]
fn the_size_of_a_pad_of_one_material_may_stand_with_the_element() {
    let element =
        with_padding(MATERIALS, "material = \"foam\", thickness = \"2 cm\", area = \"0.5 m^2\"");
    assert_eq!(element.network.connections()[0].thickness, Some(0.02));
    let model = with_padding(
        &(MATERIALS.to_owned()
            + "[models.pad]\nmaterial = \"foam\"\nthickness = \"20 mm\"\narea = \"5000 cm^2\"\n"),
        "model = \"pad\"",
    );
    assert_alike(&element, &model, 2.0);
    // Half the area at half the thickness is the same pad, and so is twice the pad in a row with
    // twice the pad.
    let in_halves = with_padding(
        MATERIALS,
        "series = [{ material = \"foam\", thickness = \"1 cm\", area = \"0.5 m^2\" }, \
         { material = \"foam\", thickness = \"1 cm\", area = \"0.5 m^2\" }]",
    );
    let [whole, halves] =
        [&element, &in_halves].map(|own| linear_model(&own.network.connections()[0].model));
    assert!(compare(&whole, &halves).is_same);
}

const BURGERS: &str = "burgers = { maxwell = { spring = \"20 MN/m\", dashpot = \"6 kN s/m\" }, \
    kelvin = { spring = \"20 MN/m\", dashpot = \"4 kN s/m\" } }";

fn burgers_with_times(factor: f64) -> Scene {
    let [c2, c1] = [6e3, 4e3].map(|damping| damping * factor);
    with_padding(
        "",
        &format!(
            "burgers = {{ maxwell = {{ spring = 2e7, dashpot = {c2:e} }}, \
             kelvin = {{ spring = 2e7, dashpot = {c1:e} }} }}"
        ),
    )
}

#[test]
fn a_shift_by_williams_landel_and_ferry_multiplies_all_dashpots() {
    let shifted = with_padding(
        "",
        &format!(
            "{BURGERS}, shift = {{ wlf = {{ temperature = \"14 degC\", reference = \"20 degC\", \
             c1 = 8.86, c2 = \"101.6 K\" }} }}"
        ),
    );
    let factor = 10f64.powf(-8.86 * (14.0 - 20.0) / (101.6 + 14.0 - 20.0));
    assert!(factor > 3.0);
    // The difference of temperatures around 290 K is known within 290/6 roundings of itself, and
    // the factor within ln(3.6) times as many.
    assert_alike(&shifted, &burgers_with_times(factor), 290.0 / 6.0 * factor.ln() + 4.0);
}

#[test]
fn a_shift_by_arrhenius_multiplies_all_dashpots() {
    let shifted = with_padding(
        "",
        &format!(
            "{BURGERS}, shift = {{ arrhenius = {{ temperature = \"280 K\", reference = \"300 K\", \
             energy = \"40 kJ/mol\" }} }}"
        ),
    );
    // R = N_A k_B, both exact since 2019.
    let gas: f64 = 6.022_140_76e23 * 1.380_649e-23;
    let factor = (40e3 / gas * (300.0 - 280.0) / (300.0 * 280.0)).exp();
    assert!(factor > 3.0);
    // 1/T − 1/T_ref loses a factor 15 of a rounding, and the exponent is 1.15.
    assert_alike(&shifted, &burgers_with_times(factor), 30.0);
    // A colder pad is another model.
    let [warm, cold] = [with_padding("", BURGERS), shifted]
        .map(|own| linear_model(&own.network.connections()[0].model));
    assert!(!compare(&warm, &cold).is_same);
}

#[test]
fn a_shift_of_a_material_acts_before_its_size() {
    let tables = MATERIALS.to_owned()
        + "[materials.cold]\nmaterial = \"foam\"\nshift = { arrhenius = { temperature = \"280 K\", \
           reference = \"300 K\", energy = \"40 kJ/mol\" } }\n";
    let size = "thickness = \"2 cm\", area = \"0.5 m^2\"";
    let of_material = with_padding(&tables, &format!("material = \"cold\", {size}"));
    let of_element = with_padding(
        &tables,
        &format!(
            "material = \"foam\", {size}, shift = {{ arrhenius = {{ temperature = \"280 K\", \
             reference = \"300 K\", energy = \"40 kJ/mol\" }} }}"
        ),
    );
    assert_alike(&of_material, &of_element, 2.0);
}
