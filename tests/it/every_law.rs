//! Every law, alone and under every shape of a body that presses it, with every effect, is run once: it is solved with a
//! ledger that closes, or refused before it is solved, by name.

use std::sync::Arc;

use dashpot::{
    analysis::{Judgement, RunError, Solve, SolveSettings},
    network::{
        Element,
        elements::{ELEMENTS, Foundation, Indenter, Shape},
        parameters::Dimension,
    },
    scene::{ReadOptions, read, write_kind},
};

/// Lines of a scene by effect.
const EFFECTS: [(&str, &str); 7] = [
    ("none", ""),
    ("gravity", "gravity = { value = \"1 g0\" }"),
    ("gravity in balance", "gravity = { value = \"1 g0\", start = \"equilibrium\" }"),
    ("separation", "separation.pad = {}"),
    ("face", "face.pad = { mass = \"20 g\" }"),
    ("rigid stop", "stop.pad = { at = \"9 mm\", restitution = 0.5 }"),
    (
        "elastic stop",
        "stop.pad = { at = \"9 mm\", stiffness = \"2 MN/m\", damping = \"100 N s/m\" }",
    ),
];

/// Shapes of 80 mm.
fn indenters() -> [(&'static str, Indenter); 4] {
    use Shape::{Cylinder, Dome, Flat, Sphere};
    let of = |shape: Shape| {
        let has = |shapes: &[Shape], value: f64| shapes.contains(&shape).then_some(value);
        Indenter {
            shape,
            radius: has(&[Sphere, Dome, Cylinder], 0.06),
            diameter: has(&[Dome, Flat], 0.08),
            length: has(&[Cylinder], 0.08),
            pad_radius: None,
        }
    };
    [Sphere, Dome, Cylinder, Flat].map(|shape| (shape.word(), of(shape)))
}

/// Every element of the register as text, and every one that a body may press under every shape.
fn pads() -> Vec<(String, String)> {
    let mut pads = Vec::new();
    let text = |element: &Arc<dyn Element>| {
        write_kind(element.kind(), element.parameters(), &element.values(), Dimension::FORCE)
    };
    for kind in ELEMENTS {
        let element = kind.example().unwrap();
        pads.push((kind.word.to_owned(), text(&element)));
        for (shape, indenter) in indenters() {
            let Ok(pressed) = Foundation::new(Arc::clone(&element), indenter) else { continue };
            let pressed: Arc<dyn Element> = Arc::new(pressed);
            pads.push((format!("{} under a {shape}", kind.word), text(&pressed)));
        }
    }
    pads
}

#[test]
fn every_law_under_every_shape_with_every_effect_is_run_or_refused_by_name() {
    let (mut solved, mut refused, mut faults) = (0, 0, Vec::new());
    for (name, pad) in pads() {
        for (effect, line) in EFFECTS {
            let scene = format!(
                "[nodes]\nhead = {{ mass = 5, velocity = 1 }}\n[elements.pad]\nbetween = [\"head\", \"ground\"]\n{pad}\n\
                 [effects]\n{line}\n[run]\nduration = 0.03\n"
            );
            let Ok(read) = read(&scene, &ReadOptions::default()) else {
                refused += 1;
                continue;
            };
            let settings =
                SolveSettings { estimate: false, ..read.value.settings("auto").unwrap() };
            match read.value.network.solve_with(&settings) {
                Ok(report) => {
                    solved += 1;
                    let closure = report.energy.closure().abs();
                    if closure.is_nan() || closure > 1e-3 {
                        faults.push(format!("{name}, {effect}: the ledger is off by {closure}"));
                    }
                }
                Err(RunError::Network(_)) => refused += 1,
                Err(error) => faults.push(format!("{name}, {effect}: {error}")),
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{} of {solved} and {refused}:\n{}",
        faults.len(),
        faults.join("\n")
    );
    assert!(solved > 250, "{solved} solved, {refused} refused");
}

/// Work of a run of some hundred steps.
const FEW_STEPS: u64 = 2_000_000;
/// Stiff pads that push and never pull.
const STIFF: [&str; 5] = [
    "foam = { modulus = \"12 MPa\", plateau = \"0.5 MPa\", densification = \"0.15 MPa\", exponent = 2, \
     thickness = \"15 mm\", area = \"60 cm^2\" }",
    "hysteretic-foam = { modulus = \"12 MPa\", plateau = \"0.5 MPa\", densification = \"0.15 MPa\", exponent = 2, \
     set = 0.5, unloading-exponent = 2, thickness = \"15 mm\", area = \"60 cm^2\" }",
    "hysteretic-table = { loading = [[\"0 m\", \"0 N\"], [\"1 mm\", \"5 kN\"], [\"5 mm\", \"6 kN\"]], \
     unloading = [[\"0 m\", \"0 N\"], [\"1 mm\", \"1 kN\"], [\"5 mm\", \"6 kN\"]] }",
    "hunt-crossley = { force = \"2 kN\", at = \"1 mm\", dissipation = \"0.2 s/m\", exponent = 1 }",
    "bumper = { force = \"2 kN\", at = \"1 mm\", restitution = 0.5, speed = \"5 m/s\", exponent = 1 }",
];

/// At 1e-8 m, far below what the tolerance of a place is, and where it remembers by the last digits of its speed.
#[test]
fn what_rests_on_a_pad_takes_few_steps_however_small_its_deformation_is() {
    let mut faults = Vec::new();
    for pad in STIFF {
        for mass in ["20 g", "1 kg", "20 kg"] {
            for method in ["bdf", "tr-bdf2", "esdirk34", "dop853"] {
                let scene = format!(
                    "[nodes]\nhead = {{ mass = \"{mass}\" }}\n\
                     [elements.pad]\nbetween = [\"head\", \"ground\"]\n\
                     parallel = [{{ {pad} }}, {{ dashpot = \"400 N s/m\" }}]\n\
                     [effects]\ngravity = {{}}\n[run]\nduration = \"20 ms\"\n"
                );
                let scene = read(&scene, &ReadOptions::default()).unwrap().value;
                let settings = scene.settings(method).unwrap();
                let settings = SolveSettings { budget: FEW_STEPS, ..settings };
                if let Err(error) = scene.network.solve_with(&settings) {
                    faults.push(format!("{mass} on {pad} by {method}: {error}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// The first peak of a mass of 5 kg at 1 m/s on an element in series with a spring, by energy.
fn peak_in_series(element: &dyn Element, stiffness: f64) -> f64 {
    let (mut work, mut at, mut force) = (0.0, 0.0, element.force(0.0, 0.0));
    let step = 1e-6;
    loop {
        let [middle, end] = [0.5, 1.0].map(|part| element.force(at + part * step, 0.0));
        let more = step / 6.0 * (force + 4.0 * middle + end);
        let missing = 2.5 - work - 0.5 * force * force / stiffness;
        let gained = more + 0.5 * (end * end - force * force) / stiffness;
        if gained >= missing {
            return force + missing / gained * (end - force);
        }
        (work, at, force) = (work + more, at + step, end);
    }
}

/// Between the two there is neither a mass nor a dashpot: the rate of the place follows from the balance alone.
#[test]
fn every_law_of_deformation_is_solved_in_series_with_a_spring() {
    let mut count = 0;
    for kind in ELEMENTS {
        let element = kind.example().unwrap();
        let bears = |at: f64| {
            let force = element.force(at, 0.0);
            force > 0.0 && (element.force(at, 1.0) - force).abs() == 0.0
        };
        let jumps = element.force(1e-12, 0.0) > 1.0;
        if jumps || ![1e-3, 5e-3].into_iter().all(bears) {
            continue;
        }
        let pad =
            write_kind(element.kind(), element.parameters(), &element.values(), Dimension::FORCE);
        let scene = format!(
            "[nodes]\nhead = {{ mass = 5, velocity = 1 }}\n[elements.pad]\nbetween = [\"head\", \"ground\"]\n\
             series = [{{ {} }}, {{ spring = \"500 kN/m\" }}]\n[run]\nduration = 0.6\n",
            pad.trim().replace('\n', ", ")
        );
        let read = read(&scene, &ReadOptions::default()).unwrap().value;
        let report = read
            .network
            .solve_with(&read.settings("auto").unwrap())
            .unwrap_or_else(|error| panic!("{scene}: {error}"));
        let peak = report.measures.iter().find(|own| own.key == "pad.peak-force").unwrap();
        let (value, error) = (peak.value.unwrap(), peak.error.unwrap());
        let wanted = peak_in_series(&*element, 5e5);
        assert!(
            (value - wanted).abs() <= error + 1e-6 * wanted,
            "{scene}: {value} ± {error}, {wanted}"
        );
        count += 1;
    }
    assert!(count > 8, "{count}");
}

/// A plate without mass on a pad of 100 kN/m that loads first, beside a spring of 1 kN/m: where it is follows from the load.
#[test]
fn a_pad_that_remembers_never_pulls_on_what_has_no_mass() {
    let loads = [
        ("[[\"0 s\", \"-20 N\"], [\"10 ms\", \"10 N\"]]", 10.0),
        ("[[\"0 s\", \"0 N\"], [\"3 ms\", \"-20 N\"], [\"10 ms\", \"10 N\"]]", 10.0),
        (
            "[[\"0 s\", \"5 N\"], [\"4 ms\", \"5 N\"], [\"4 ms\", \"-20 N\"], [\"10 ms\", \"10 N\"]]",
            10.0,
        ),
        (
            "[[\"0 s\", \"0 N\"], [\"2 ms\", \"5 N\"], [\"5 ms\", \"5 N\"], [\"5 ms\", \"-20 N\"], [\"10 ms\", \"-9 N\"]]",
            5.0,
        ),
    ];
    for (points, most) in loads {
        for method in ["bdf", "tr-bdf2", "esdirk34", "dop853"] {
            let scene = format!(
                "[nodes]\nplate = {{}}\nhead = {{ mass = 1 }}\n[elements]\n\
                 pad = {{ between = [\"plate\", \"ground\"], hysteretic-table = {{ loading = [[0, 0], [0.01, 1e3]], \
                 unloading = [[0.005, 0], [0.01, 1e3]] }} }}\n\
                 weak = {{ between = [\"plate\", \"ground\"], spring = 1e3 }}\n\
                 link = {{ between = [\"head\", \"ground\"], spring = 1e3 }}\n\
                 [measures]\npad = [{{ kind = \"peak-force\", window = \"run\" }}]\n\
                 weak = [{{ kind = \"peak-force\", window = \"run\" }}]\n\
                 [loads.push]\non = \"plate\"\nforce = {{ table = {{ points = {points}, outside = \"hold\" }} }}\n\
                 [run]\nduration = \"10 ms\"\n"
            );
            let read = read(&scene, &ReadOptions::default()).unwrap().value;
            let report = read
                .network
                .solve_with(&read.settings(method).unwrap())
                .unwrap_or_else(|error| panic!("{method} {scene}: {error}"));
            for (key, wanted) in [("pad.peak-force", most / 1.01), ("weak.peak-force", 20.0)] {
                let peak = report.measures.iter().find(|own| own.key == key).unwrap();
                let (value, error) = (peak.value.unwrap(), peak.error.unwrap());
                assert!(
                    (value - wanted).abs() <= error + 1e-9,
                    "{method} {scene}: {key} {value} ± {error}"
                );
            }
        }
    }
}

/// What has no mass goes where its load sends it, whether that jumps or takes a microsecond.
#[test]
fn a_jump_of_a_load_is_the_limit_of_a_ramp_where_there_is_no_mass() {
    // Between its jumps the load stands still, or goes on: where it reaches a jump is what it would be by that rate.
    let levels = [[9.0, 4.0, 7.0, -6.0, 5.0], [30.0, 12.0, 18.0, -25.0, 28.0]];
    let slopes = [0.0, -3.0, 2.0];
    let mut count = 0;
    for pad in [STIFF[1], STIFF[2], "friction = \"8 N\""] {
        for (level, slope) in levels.iter().flat_map(|own| slopes.map(|slope| (*own, slope))) {
            let end = |rise: f64, method: &str| {
                let mut points = vec![String::from("[0, 0]"), String::from("[1e-3, 2]")];
                let mut before = 2.0;
                for (at, level) in (2..).zip(level) {
                    let time = 1e-3 * f64::from(at);
                    points.extend([
                        format!("[{time:e}, {before:e}]"),
                        format!("[{:e}, {level:e}]", time + rise),
                    ]);
                    before = level + slope;
                }
                let scene = format!(
                    "[nodes]\nplate = {{}}\nhead = {{ mass = 1 }}\n[elements]\n\
                     pad = {{ between = [\"plate\", \"ground\"], {pad} }}\n\
                     weak = {{ between = [\"plate\", \"ground\"], spring = 1e4 }}\n\
                     link = {{ between = [\"head\", \"ground\"], spring = 1e3 }}\n\
                     [measures]\nweak = [{{ kind = \"end-deformation\", window = \"run\" }}, \
                     {{ kind = \"peak-force\", window = \"run\" }}]\n\
                     [loads.push]\non = \"plate\"\nforce = {{ table = {{ points = [{}], outside = \"hold\" }} }}\n\
                     [run]\nduration = \"8 ms\"\n",
                    points.join(", ")
                );
                let read = read(&scene, &ReadOptions::default()).unwrap().value;
                let report = read.network.solve_with(&read.settings(method).unwrap());
                let report = report.unwrap_or_else(|error| panic!("{method} {scene}: {error}"));
                ["weak.end-deformation", "weak.peak-force"].map(|key| {
                    let own = report.measures.iter().find(|own| own.key == key).unwrap();
                    (own.value.unwrap(), own.error.unwrap())
                })
            };
            let ramp = end(1e-6, "bdf");
            for method in ["bdf", "esdirk34", "dop853"] {
                for ((jump, error), (slow, other)) in end(0.0, method).into_iter().zip(ramp) {
                    let apart = (jump - slow).abs();
                    assert!(
                        apart <= error + other + 1e-9 * slow.abs(),
                        "{pad}, {level:?} by {method}: {jump} for {slow}"
                    );
                    count += 1;
                }
            }
        }
    }
    assert_eq!(count, 108);
}

#[test]
fn energies_that_leave_out_the_work_within_a_jump_have_no_error_and_pass_no_limit() {
    let run = |rise: f64, estimate: bool| {
        let scene = format!(
            "[nodes]\nplate = {{}}\nhead = {{ mass = 1 }}\n[elements]\n\
             pad = {{ between = [\"plate\", \"ground\"], friction = \"8 N\" }}\n\
             weak = {{ between = [\"plate\", \"ground\"], spring = 1e4 }}\n\
             link = {{ between = [\"head\", \"ground\"], spring = 1e3 }}\n\
             [measures]\npad = [\"energy-at-end\", \"peak-force\"]\n\
             [loads.push]\non = \"plate\"\nforce = {{ table = {{ points = [[0, 0], [1e-3, 0], [{:e}, 30], [4e-3, 30]], \
             outside = \"hold\" }} }}\n\
             [limits]\n\"pad.energy-at-end\" = {{ max = 10 }}\n\
             [run]\nduration = \"4 ms\"\n",
            1e-3 + rise
        );
        let read = read(&scene, &ReadOptions::default()).unwrap().value;
        let settings = SolveSettings { estimate, ..read.settings("auto").unwrap() };
        let report = read.network.solve_with(&settings).unwrap();
        let own = |key: &str| {
            let measure = report.measures.iter().find(|own| own.key == key).unwrap();
            (measure.value.unwrap(), measure.error)
        };
        let judgement = report.judged()[0].judgement;
        (own("pad.energy-at-end"), own("pad.peak-force"), judgement)
    };
    // Friction of 8 N over the 22 N/(1e4 N/m) that the spring yields.
    let (energy, force, judgement) = run(1e-4, true);
    let error = energy.1.unwrap();
    assert!((energy.0 - 8.0 * 2.2e-3).abs() <= error && error < 1e-6, "{energy:?}");
    assert!(force.1.is_some() && judgement == Judgement::Pass);
    let (energy, force, judgement) = run(0.0, true);
    assert!(energy.1.is_none(), "{energy:?}");
    assert!(force.1.is_some() && matches!(judgement, Judgement::Undecided(_)), "{judgement:?}");
    let judgement = run(0.0, false).2;
    assert!(matches!(judgement, Judgement::Undecided(_)), "without estimates: {judgement:?}");
}
