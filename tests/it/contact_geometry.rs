//! Pads under bodies of a given shape: the area that is loaded grows with the deformation.
//!
//! The judges are a script of 20 digits that integrates over the radius, closed forms, and balances of
//! energy.

use std::{f64::consts::PI, sync::Arc};

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings, Warning},
    network::{
        Element,
        elements::{Foam, Foundation, Indenter, Shape, Spring, TableSpring},
        phases::{Phase, PhaseLaw},
    },
    rheology::Tree,
    scene::{ReadOptions, Scene, read, write_model},
};

const TABLE: &str = include_str!("contact_geometry_reference.csv");

/// Thickness of the pads of the table \[m\], and the modulus of the linear one \[Pa\].
const THICKNESS: f64 = 0.02;
const MODULUS: f64 = 1e6;

/// A body by its shape, radius, diameter, length and the radius of the pad \[mm\]; zero where there is none.
fn body(shape: Shape, [radius, diameter, length, pad]: [f64; 4]) -> Indenter {
    let given = |own: f64| (own != 0.0).then_some(own / 1000.0);
    Indenter {
        shape,
        radius: given(radius),
        diameter: given(diameter),
        length: given(length),
        pad_radius: given(pad),
    }
}

fn of_table(name: &str) -> Indenter {
    use Shape::{Cylinder, Dome, Flat, Sphere};
    let (shape, size) = match name {
        "sphere" => (Sphere, [50.0, 0.0, 0.0, 0.0]),
        "dome" => (Dome, [50.0, 40.0, 0.0, 0.0]),
        "cylinder" => (Cylinder, [30.0, 0.0, 100.0, 0.0]),
        "flat" => (Flat, [0.0, 60.0, 0.0, 0.0]),
        "sphere-on-bulge" => (Sphere, [50.0, 0.0, 0.0, 100.0]),
        "sphere-in-hollow" => (Sphere, [80.0, 0.0, 0.0, -90.0]),
        "dome-in-hollow" => (Dome, [50.0, 40.0, 0.0, -70.0]),
        "flat-on-bulge" => (Flat, [0.0, 40.0, 0.0, 60.0]),
        "cylinder-on-bulge" => (Cylinder, [30.0, 0.0, 100.0, 40.0]),
        "cylinder-in-hollow" => (Cylinder, [30.0, 0.0, 100.0, -50.0]),
        other => panic!("{other}"),
    };
    body(shape, size)
}

/// The pad of a law of the table with this area.
fn pad(law: &str, area: f64) -> Arc<dyn Element> {
    let foam = |exponent| Foam {
        modulus: 2e6,
        plateau: 1e5,
        densification: 2e4,
        exponent,
        thickness: THICKNESS,
        area,
    };
    match law {
        "linear" => Arc::new(Spring { stiffness: MODULUS * area / THICKNESS }),
        "foam" => Arc::new(foam(3.0)),
        "foam-odd" => Arc::new(foam(2.5)),
        "table" => {
            let points = [(0.0, 0.0), (0.2, 3e4), (0.5, 6e4), (0.7, 4e5)];
            let points = points.map(|(strain, stress)| (strain * THICKNESS, stress * area));
            Arc::new(TableSpring::new(points.to_vec()).unwrap())
        }
        other => panic!("{other}"),
    }
}

fn foundation(law: &str, body: Indenter) -> Foundation {
    Foundation::new(pad(law, body.area().unwrap()), body).unwrap()
}

fn close(found: f64, exact: f64, allowed: f64, what: &str) {
    assert!((found - exact).abs() <= allowed * exact.abs(), "{what}: {found:e}, not {exact:e}");
}

#[test]
fn forces_slopes_and_energies_are_those_of_the_quadrature_over_the_radius() {
    let mut count = 0;
    for line in TABLE.lines().skip_while(|line| line.starts_with('#')).skip(1) {
        let [shape, law, deformation, force, stiffness, stored] =
            *line.split(',').collect::<Vec<_>>()
        else {
            panic!("{line}")
        };
        let value = |text: &str| text.parse::<f64>().unwrap();
        let (own, y) = (foundation(law, of_table(shape)), value(deformation));
        close(own.force(y, 0.0), value(force), 1e-12, line);
        close(own.tangent(y, 0.0).stiffness, value(stiffness), 1e-12, line);
        close(own.stored(y), value(stored), 1e-12, line);
        count += 1;
    }
    assert_eq!(count, 192);
}

#[test]
fn linear_pads_have_the_closed_forms_of_the_elastic_foundation() {
    let per_area = MODULUS / THICKNESS;
    let (radius, length, half) = (0.05, 0.1, 0.02);
    let ball = foundation("linear", body(Shape::Sphere, [50.0, 0.0, 0.0, 0.0]));
    let dome = foundation("linear", body(Shape::Dome, [50.0, 40.0, 0.0, 0.0]));
    let roll = foundation("linear", body(Shape::Cylinder, [50.0, 0.0, 100.0, 0.0]));
    let edge = radius - f64::sqrt(radius * radius - half * half);
    for y in [1e-7, 1e-5, 1e-3, 0.004, 0.01, 0.018, 0.03] {
        let force = PI * per_area * (radius * y * y - y.powi(3) / 3.0);
        let energy = PI * per_area * (radius * y.powi(3) / 3.0 - y.powi(4) / 12.0);
        close(ball.force(y, 0.0), force, 2e-15, "the force of a ball");
        close(ball.stored(y), energy, 2e-15, "the energy of a ball");
        close(
            ball.tangent(y, 0.0).stiffness,
            PI * per_area * (2.0 * radius - y) * y,
            2e-15,
            "slope",
        );
        // A dome has the force of its ball up to its edge, and beyond one that rises with all of its area.
        let beyond = (y - edge).max(0.0);
        let at_edge = PI * per_area * (radius * edge * edge - edge.powi(3) / 3.0);
        let force = if y < edge { force } else { at_edge + per_area * PI * half * half * beyond };
        close(dome.force(y, 0.0), force, 1e-14, "the force of a dome");
        let width = (y * (2.0 * radius - y)).sqrt();
        // R² asin(w/R) − w (R − y) loses digits where y is small.
        if y >= 1e-3 {
            let segment = radius * radius * (width / radius).asin() - width * (radius - y);
            close(roll.force(y, 0.0), per_area * length * segment, 1e-12, "the force of a roll");
        } else {
            let parabola = per_area * length * 4.0 / 3.0 * width * y;
            close(roll.force(y, 0.0), parabola, y / radius, "the first force of a roll");
        }
    }
    // As Hertz's, it rises with a power of the depth, but with the second one: E*/h stands for E*/a.
    close(ball.force(1e-9, 0.0), PI * per_area * radius * 1e-18, 1e-8, "the first force of a ball");
}

#[test]
fn to_the_first_order_a_curved_pad_is_a_flat_one_under_a_body_of_both_curvatures() {
    for (pad, effective) in [(100.0, 100.0 / 3.0), (-70.0, 175.0)] {
        let curved = foundation("linear", body(Shape::Dome, [50.0, 10.0, 0.0, pad]));
        let flat = foundation("linear", body(Shape::Dome, [effective, 10.0, 0.0, 0.0]));
        for y in [1e-6, 1e-5] {
            let [one, other] = [&curved, &flat].map(|own| own.force(y, 0.0));
            close(one, other, 2.0 * y / 0.03, "force");
        }
    }
}

fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}")).value
}

/// A ball of 1 kg at 2 m/s on a pad of 20 mm; `own` is what the pad is.
fn ball_on(own: &str) -> String {
    format!(
        r#"
        [materials]
        rubber = {{ spring = "1 MPa" }}
        foam = {{ foam = {{ modulus = "2 MPa", plateau = "0.1 MPa", densification = "20 kPa", exponent = 3 }} }}
        felt = {{ table-spring = [[0, 0], ["20 %", "30 kPa"], ["50 %", "60 kPa"], ["70 %", "400 kPa"]] }}
        gel = {{ kelvin-voigt = {{ spring = "1 MPa", dashpot = "1 kPa s" }} }}
        crushed = {{ hysteretic-table = {{ loading = [[0, 0], ["70 %", "0.7 MPa"]], unloading = [["14 %", 0], ["70 %", "0.7 MPa"]] }} }}
        bent = {{ piecewise-spring = [[0, 0], ["20 %", "30 kPa"], ["70 %", "400 kPa"]] }}
        pushed = {{ piecewise-spring = [[0, "1 kPa"], ["20 %", "30 kPa"]] }}
        row = {{ series = [{{ spring = "1 MPa" }}, {{ spring = "2 MPa" }}] }}
        both = {{ parallel = [{{ material = "felt" }}, {{ spring = "0.2 MPa" }}] }}
        [nodes]
        ball = {{ mass = "1 kg", velocity = "2 m/s" }}
        [elements]
        pad = {{ between = ["ball", "ground"], {own} }}
        [run]
        duration = "30 ms"
        "#
    )
}

fn run(own: &str, method: &str) -> RunReport {
    let scene = scene(&ball_on(own));
    let settings = SolveSettings { rtol: Some(1e-8), ..scene.settings(method).unwrap() };
    scene.network.solve_with(&settings).unwrap()
}

/// The element that a scene makes of a pad.
fn made(own: &str) -> Arc<dyn Element> {
    let scene = scene(&ball_on(own));
    let Tree::Part(element) = &scene.network.connections()[0].model else { panic!("{own}") };
    Arc::clone(element)
}

const BALL: &str = r#"thickness = "20 mm", pressed-by = { shape = "sphere", radius = "50 mm" }"#;

#[test]
fn a_ball_goes_as_deep_as_its_energy_says_and_comes_back_with_its_speed() {
    // ½ m v² = (π E/h) (R y³/3 − y⁴/12).
    let energy = |y: f64| PI * MODULUS / THICKNESS * (0.05 * y.powi(3) / 3.0 - y.powi(4) / 12.0);
    let (mut low, mut high) = (0.0, 0.02);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if energy(middle) < 2.0 { low = middle } else { high = middle }
    }
    let force = PI * MODULUS / THICKNESS * (0.05 * low * low - low.powi(3) / 3.0);
    for method in ["bdf", "esdirk34", "dop853"] {
        let report = run(&format!("material = \"rubber\", {BALL}"), method);
        for (key, exact) in
            [("pad.peak-deformation", low), ("pad.peak-force", force), ("pad.impulse", 4.0)]
        {
            let found = report.measure(key).unwrap();
            let bar = found.error.unwrap();
            let value = found.value.unwrap();
            assert!(
                (value - exact).abs() <= bar.max(1e-9 * exact),
                "{method} {key}: {value} {exact}"
            );
            assert!(bar < 1e-4 * exact, "{method} {key}: ±{bar}");
        }
        assert!(report.energy.closure().abs() < 1e-6, "{method}");
    }
}

#[test]
fn a_scene_makes_the_columns_of_its_material() {
    for (material, law) in [("rubber", "linear"), ("foam", "foam"), ("felt", "table")] {
        let own = made(&format!("material = \"{material}\", {BALL}"));
        let by_hand = foundation(law, of_table("sphere"));
        for y in [-0.001, 1e-4, 0.003, 0.012, 0.02] {
            assert!(
                (own.force(y, 0.0) - by_hand.force(y, 0.0)).abs() <= 1e-13 * by_hand.force(y, 0.0)
            );
        }
    }
    // A foam may have its own keys; parts side by side are so in every column.
    let law = "{ modulus = 2e6, plateau = 1e5, densification = 2e4, exponent = 3 }";
    let (foam, own) =
        (made(&format!("material = \"foam\", {BALL}")), made(&format!("foam = {law}, {BALL}")));
    assert_eq!(own.values(), foam.values());
    let scene = scene(&ball_on(&format!("material = \"both\", {BALL}")));
    let model = &scene.network.connections()[0].model;
    let force: f64 = model.leaves().map(|leaf| leaf.force(0.01, 0.0)).sum();
    let felt = foundation("table", of_table("sphere")).force(0.01, 0.0);
    let soft = 0.2 * foundation("linear", of_table("sphere")).force(0.01, 0.0);
    close(force, felt + soft, 1e-13, "side by side");
    // It is written as what it is, and read back.
    let written = write_model(&model.branches()[0].tree);
    let back = made(written.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')).unwrap());
    close(back.force(0.01, 0.0), felt, 1e-15, "as it was written");
}

#[test]
fn a_flat_body_loads_its_area_at_once_and_nothing_else_changes() {
    let area = PI * 0.03 * 0.03;
    let flat = r#"thickness = "20 mm", pressed-by = { shape = "flat", diameter = "60 mm" }"#;
    for material in ["rubber", "foam"] {
        let constant =
            run(&format!("material = \"{material}\", thickness = 0.02, area = {area:?}"), "bdf");
        let pressed = run(&format!("material = \"{material}\", {flat}"), "bdf");
        for key in ["pad.peak-force", "pad.peak-deformation", "pad.contact-time"] {
            let [one, other] = [&constant, &pressed].map(|own| own.measure(key).unwrap());
            let apart = (one.value.unwrap() - other.value.unwrap()).abs();
            assert!(
                apart <= one.error.unwrap() + other.error.unwrap(),
                "{material} {key}: {apart}"
            );
        }
    }
}

#[test]
fn columns_whose_sides_are_held_are_stiffer_by_the_confined_modulus() {
    let of = |loaded: &str| {
        let text = ball_on(&format!("material = \"bound\", {BALL}{loaded}"))
            + &format!("[materials.bound]\nspring = {MODULUS}\npoisson = 0.3\n");
        read(&text, &ReadOptions::default())
    };
    let force = |loaded: &str, y: f64| {
        let scene = of(loaded).unwrap().value;
        scene.network.connections()[0].model.leaves().map(|own| own.force(y, 0.0)).sum::<f64>()
    };
    for y in [1e-4_f64, 0.003, 0.012] {
        // The ball on columns: (π E/h)(R y² − y³/3), and (1 − ν)/((1 + ν)(1 − 2ν)) times that.
        let free = PI * MODULUS / THICKNESS * (0.05 * y * y - y.powi(3) / 3.0);
        close(force("", y), free, 1e-13, "free sides");
        close(force(", loaded = \"compression\"", y), free, 1e-13, "free sides");
        close(force(", loaded = \"confined\"", y), 0.7 / (1.3 * 0.4) * free, 1e-13, "sides held");
    }
    let shown = of(", loaded = \"shear\"").unwrap_err().to_string();
    assert!(shown.contains("across its thickness, not in shear"), "{shown}");
}

#[test]
fn without_a_shape_nothing_is_added() {
    let own = scene(&ball_on("material = \"gel\", thickness = 0.02, area = 0.003"));
    let system = own.network.compile(0.03).unwrap();
    assert!(system.switching.is_none() && system.system.terms.is_empty());
    assert_eq!(system.system.states(), 2);
    assert!(system.primitives.iter().all(|part| part.element.kind() != "foundation"));
}

#[test]
fn columns_of_straight_lines_add_up_to_the_closed_form_of_each() {
    let own = made(&format!("material = \"bent\", {BALL}"));
    // Slopes in Pa per metre of shortening; beyond the corner, at 20 % of 20 mm, the second one adds to the first.
    let [first, second] = [30e3 / 0.2, 370e3 / 0.5].map(|slope| slope / THICKNESS);
    let cap = |depth: f64| PI * (0.05 * depth * depth - depth.powi(3) / 3.0);
    for y in [1e-4, 0.003, 0.004, 0.0041, 0.009, 0.013] {
        let force = first * cap(y) + (second - first) * cap((y - 0.004).max(0.0));
        close(own.force(y, 0.0), force, 1e-13, "two lines");
    }
    let kept = run(&format!("material = \"bent\", {BALL}"), "bdf");
    let measure = kept.measure("pad.energy").unwrap();
    // Of the 2 J that it takes up, to the accuracy that is asked for.
    assert!(measure.value.unwrap().abs() <= measure.error.unwrap().max(2e-3), "{measure:?}");
}

#[test]
fn columns_that_unload_on_another_curve_lose_their_share_each() {
    // A column of the set r gives the part 1 − r of its energy back along a straight line, whatever its depth: so does
    // the pad.
    let back: f64 = 1.0 - 0.2;
    let found = run(&format!("material = \"crushed\", {BALL}"), "bdf");
    for (key, exact) in
        [("pad.energy", 2.0 * (1.0 - back)), ("pad.coefficient-of-restitution", back.sqrt())]
    {
        let measure = found.measure(key).unwrap();
        let (value, error) = (measure.value.unwrap(), measure.error.unwrap());
        assert!((value - exact).abs() <= error, "{key}: {value} ± {error}, not {exact}");
        assert!(error <= 5e-3 * exact, "{key}: {error}");
    }
    let closure = found.energy.closure();
    assert!(closure.abs() < 1e-3, "{closure}");
}

#[test]
fn unloaded_columns_have_the_force_of_the_quadrature_over_the_gap() {
    let own = made(&format!("material = \"crushed\", {BALL}"));
    let deepest = 0.012;
    let phases = own.phases().unwrap();
    assert_eq!(phases.names(), ["slack", "loading", "unloading"]);
    let PhaseLaw::Element(back) = phases.law(Phase { index: 2, memory: deepest }) else { panic!() };
    for y in [0.003, 0.004, 0.008, 0.0115] {
        // Midpoints: the corner at the set makes their error that of the second order.
        let count = 400_000_u32;
        let step = y / f64::from(count);
        let column = |at: u32| {
            let gap = step * (f64::from(at) + 0.5);
            let part = (y - gap) / (deepest - gap);
            let stress = MODULUS / THICKNESS * (deepest - gap) * ((part - 0.2) / 0.8).max(0.0);
            stress * 2.0 * PI * (0.05 - gap) * step
        };
        let force: f64 = (0..count).map(column).sum();
        close(back.force(y, 0.0), force, 1e-9, "unloading");
        let step = 1e-7;
        let slope = (back.force(y + step, 0.0) - back.force(y - step, 0.0)) / (2.0 * step);
        close(back.tangent(y, 0.0).stiffness, slope, 1e-6, "slope of unloading");
        let work = (back.stored(y + step) - back.stored(y - step)) / (2.0 * step);
        close(force, work, 1e-6, "what it gives back");
    }
    close(back.force(deepest, 0.0), own.force(deepest, 0.0), 1e-12, "where it turns");
    assert!(back.force(0.2 * deepest, 0.0).abs() <= 1e-13 * own.force(deepest, 0.0));
}

/// The faults of a pad.
fn refused(own: &str) -> String {
    read(&ball_on(own), &ReadOptions::default()).unwrap_err().to_string()
}

#[test]
fn what_has_no_answer_is_refused_with_its_key() {
    let on = |body: &str| format!("material = \"rubber\", thickness = 0.02, pressed-by = {body}");
    for (own, words) in [
        (format!("material = \"gel\", {BALL}"), "has `dashpot`"),
        (format!("material = \"row\", {BALL}"), "parts in series"),
        (format!("material = \"pushed\", {BALL}"), "no force until it is pressed"),
        (format!("material = \"rubber\", area = 1e-3, {BALL}"), "two sizes of one pad"),
        (format!("spring = 1e4, {BALL}"), "`pressed-by` goes with a material or foam"),
        (on("{ shape = \"sphere\" }"), "`radius` must be given for `shape = \"sphere\"`"),
        (on("{ shape = \"ball\", radius = 1 }"), "`ball`"),
        (
            on("{ shape = \"sphere\", radius = 0.05, diameter = 0.04 }"),
            "`diameter` must be left out",
        ),
        (
            on("{ shape = \"dome\", radius = 0.05, diameter = 0.12 }"),
            "`diameter` must be 0.1 m at most",
        ),
        (on("{ shape = \"flat\", diameter = 0.1, pad-radius = -0.5 }"), "where the pad is hollow"),
        (
            on("{ shape = \"sphere\", radius = 0.05, pad-radius = -0.05 }"),
            "where the pad is hollow",
        ),
        (on("{ shape = \"sphere\", radius = \"5 kg\" }"), "a length"),
        (
            "foundation = { law = { dashpot = 1 }, shape = \"sphere\", radius = 1 }".to_owned(),
            "`dashpot`",
        ),
        ("foundation = { shape = \"sphere\", radius = 1 }".to_owned(), "`law`"),
    ] {
        let found = refused(&own);
        assert!(found.contains(words), "{own}: {found}");
    }
}

#[test]
fn a_model_within_its_own_law_is_refused() {
    let text = ball_on("model = \"m\"")
        + "[models]\nm = { foundation = { law = { model = \"m\" }, shape = \"sphere\", radius = 1 } }\n";
    let found = read(&text, &ReadOptions::default()).unwrap_err().to_string();
    assert!(found.contains("`m`"), "{found}");
}

#[test]
fn a_ball_that_is_in_beyond_its_equator_is_warned_of() {
    let small = r#"material = "rubber", thickness = "20 mm", pressed-by = { shape = "sphere", radius = "5 mm" }"#;
    let report = run(small, "bdf");
    let told =
        report.warnings.iter().any(|own| matches!(own, Warning::BeyondLaw(own) if own.at_equator));
    assert!(told, "{:?}", report.warnings);
}

/// The table of `docs/contact-geometry.md`: a head on a liner of polystyrene, 30 mm thick \[kN\].
#[test]
fn a_constant_area_is_wrong_by_factors() {
    let liner = |area: f64| Foam {
        modulus: 20e6,
        plateau: 0.7e6,
        densification: 0.2e6,
        exponent: 2.0,
        thickness: 0.03,
        area,
    };
    let head = |pad: f64| {
        let head = body(Shape::Sphere, [85.0, 0.0, 0.0, pad]);
        Foundation::new(Arc::new(liner(head.area().unwrap())), head).unwrap()
    };
    let text = std::fs::read_to_string("docs/contact-geometry.md").unwrap();
    let all: [Arc<dyn Element>; 4] =
        [Arc::new(liner(4e-3)), Arc::new(head(0.0)), Arc::new(head(-110.0)), Arc::new(head(-95.0))];
    for depth in [2.0, 5.0, 10.0, 20.0] {
        let forces = all.each_ref().map(|own| format!("{:.2}", own.force(1e-3 * depth, 0.0) / 1e3));
        let row = format!("| {depth} mm | {} |", forces.join(" | "));
        assert!(text.contains(&row), "the table has no row {row}");
    }
}
