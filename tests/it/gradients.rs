//! Derivatives of generated scenes against differences of the sixth order, and as users of the command meet them.

use dashpot::{
    analysis::{
        Accuracy, Choice, Solve, SolveSettings, ask,
        gradients::{GradientReport, NoDerivative, Number, gradients},
        sweep::ScenePoint,
    },
    dae::methods,
    network::{
        Network, Node, dashpot,
        effects::{Gravity, GravityStart, Separation, Stop},
        elements::CubicSpring,
        part, spring,
    },
    numerics::Stream,
};

use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

const KEYS: [&str; 4] = ["pad.peak-force", "pad.contact-time", "head.severity-index", "head.hic15"];

/// A body that is dropped on a pad with a stop, parts from it, and falls again.
#[derive(Debug, Clone)]
struct Case {
    numbers: Vec<Number>,
    /// Whether the pad stiffens.
    is_cubic: bool,
    duration: f64,
}

impl Case {
    fn drawn(random: &mut Stream, is_cubic: bool) -> Self {
        let [mass, drop] = [random.between(1.0, 10.0), random.between(0.02, 1.0)];
        let gravity = random.between(5.0, 15.0);
        let speed = (2.0 * gravity * drop).sqrt();
        // A pad that is pressed by a few millimetres, and a stop in its way or out of it.
        let depth = random.between(2e-3, 2e-2);
        let stiffness = mass * (speed / depth).powi(2);
        let damping = random.between(0.02, 0.5) * 2.0 * (stiffness * mass).sqrt();
        let stop = random.between(0.3, 1.5) * depth;
        let ratio = random.between(2.0, 30.0);
        let own = [
            ("mass", "kg", mass),
            ("drop", "m", drop),
            ("gravity", "m/s^2", gravity),
            ("stiffness", "N/m", stiffness),
            ("damping", "N s/m", damping),
            ("stop", "m", stop),
            ("stop-stiffness", "N/m", ratio * stiffness),
            ("cubic", "N/m^3", stiffness / depth / depth),
        ];
        let count = if is_cubic { 8 } else { 7 };
        let numbers = own.into_iter().take(count);
        let numbers = numbers.map(|(name, unit, value)| Number::new(name, unit, value)).collect();
        Self { numbers, is_cubic, duration: 3.0 * speed / gravity }
    }

    fn posed(&self, own: &[f64], settings: &SolveSettings) -> ScenePoint {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", own[0]).dropped(own[1]));
        let law = if self.is_cubic {
            part(CubicSpring { stiffness: own[3], cubic: own[7] })
        } else {
            spring(own[3])
        };
        network.connect("pad", head, network.ground(), law | dashpot(own[4]));
        network.add_effect(Gravity { acceleration: own[2], start: GravityStart::Unloaded });
        network.add_effect(Separation {
            element: "pad".to_owned(),
            at: Some("head".to_owned()),
            restitution: 0.0,
        });
        network.add_effect(Stop {
            element: "pad".to_owned(),
            at: Some(own[5]),
            restitution: 0.0,
            stiffness: Some(own[6]),
            damping: 0.0,
        });
        ScenePoint { network, settings: settings.clone() }
    }

    fn settings(&self, method: &str, accuracy: f64) -> SolveSettings {
        let mut settings = SolveSettings::lasting(self.duration);
        settings.method = match method {
            "auto" => Choice::Auto,
            name => Choice::Method(methods::by_name(name).unwrap().into()),
        };
        settings.accuracy = Accuracy::of_all(accuracy);
        settings
    }

    fn gradients(&self, settings: &SolveSettings) -> GradientReport {
        let keys = KEYS.map(str::to_owned);
        gradients(&self.numbers, &keys, 2, &|own| Ok(self.posed(own, settings))).unwrap()
    }

    /// All values with one number times `factor`: the measures, then the times of events.
    fn values(
        &self,
        number: usize,
        factor: f64,
        (settings, keys): (&SolveSettings, &[String]),
    ) -> Option<Vec<f64>> {
        let mut own: Vec<f64> = self.numbers.iter().map(|own| own.value).collect();
        own[number] *= factor;
        let mut point = self.posed(&own, settings);
        let assembly = point.network.compile(self.duration).unwrap();
        ask(&assembly, &mut point.settings, keys).unwrap();
        let report = point.network.solve_with(&point.settings).ok()?;
        let measures = keys.iter().map(|key| report.value(key).ok());
        let events = report.events.iter().map(|own| Some(own.time));
        measures.chain(events).collect()
    }
}

/// Derivatives of all values with respect to a number, times the number, by differences of the sixth order, and how far
/// those of the fourth are from them; `None` where neighbours have other events.
fn judged(case: &Case, number: usize, asked: (&SolveSettings, &[String])) -> Option<Vec<[f64; 2]>> {
    let step = 1e-3;
    let at = |count: f64| case.values(number, 1.0 + count * step, asked);
    let all: Vec<Vec<f64>> =
        [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0].into_iter().map(at).collect::<Option<_>>()?;
    let count = all[0].len();
    all.iter().all(|own| own.len() == count).then(|| {
        let of = |at: usize| {
            let of = |pair: usize| all[3 + pair][at] - all[2 - pair][at];
            let sixth = (45.0 * of(0) - 9.0 * of(1) + of(2)) / (60.0 * step);
            let fourth = (8.0 * of(0) - of(1)) / (12.0 * step);
            [sixth, (sixth - fourth).abs()]
        };
        (0..count).map(of).collect()
    })
}

/// What a campaign found.
#[derive(Debug, Default)]
struct Tally {
    compared: usize,
    events: usize,
    refused: usize,
    /// Where the judge's own differences do not settle.
    unjudged: usize,
    outside: usize,
    /// The largest deviation relative to the larger of a value and its change.
    worst: f64,
}

/// Compares the derivatives of `count` scenes; those of the judge come from runs with settings of their own.
#[expect(clippy::print_stdout, reason = "what is run by hand is looked at")]
fn campaign(count: usize, is_cubic: bool, method: &str, judge: (&str, f64), seed: u64) -> Tally {
    let mut random = Stream::new(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let case = Case::drawn(&mut random, is_cubic);
        let report = case.gradients(&case.settings(method, 1e-3));
        tally.events += report.events.len();
        let settings = case.settings(judge.0, judge.1);
        let keys: Vec<String> = report.measures.iter().map(|own| own.key.clone()).collect();
        for (at, number) in case.numbers.iter().enumerate() {
            let judged = judged(&case, at, (&settings, &keys));
            let rows = report.measures.iter().chain(&report.events).enumerate();
            for (row, own) in rows {
                let (found, value) = (&own.derivatives[at], own.value.unwrap_or(0.0));
                let Ok(found) = found else {
                    tally.refused += 1;
                    assert!(!matches!(found, Err(NoDerivative::NumberIsZero)));
                    continue;
                };
                let right = judged.as_ref().and_then(|own| own.get(row));
                let change = found.value * number.value;
                let scale = value.abs().max(change.abs());
                let floor = if judge.0 == "auto" && !is_cubic { 1e-9 } else { 1e-6 };
                let Some([right, _]) = right.filter(|own| own[1] < 10.0 * floor * scale) else {
                    tally.unjudged += 1;
                    continue;
                };
                tally.compared += 1;
                let off = (change - right).abs();
                tally.worst = tally.worst.max(off / scale);
                if off > found.error * number.value + floor * scale {
                    tally.outside += 1;
                    println!(
                        "{case:?}\n{} by {}: {found:?}, {right}, {off:e}",
                        own.key, number.name
                    );
                }
            }
        }
    }
    println!("{method}: {tally:?}");
    tally
}

/// 1e-8 through release, contact and stop.
#[test]
fn exact_derivatives_of_generated_scenes() {
    let tally = campaign(6, false, "exact", ("auto", 1e-3), 7);
    assert!(tally.events >= 3 * 6 && tally.compared >= 100, "{tally:?}");
    assert!(tally.worst < 1e-8 && tally.outside == 0, "{tally:?}");
    assert!(10 * (tally.unjudged + tally.refused) < tally.compared, "{tally:?}");
}

/// Ten times the accuracy of 0.1 % that is asked for, against the exact method.
#[test]
fn derivatives_of_generated_scenes_by_steps() {
    for method in ["bdf", "dop853"] {
        let tally = campaign(3, false, method, ("auto", 1e-3), 11);
        assert!(tally.compared >= 40 && tally.outside == 0, "{method} {tally:?}");
        assert!(tally.worst < 1e-2, "{method} {tally:?}");
    }
}

/// By hand: `cargo test --test it gradients::full -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn full() {
    let exact = campaign(500, false, "exact", ("auto", 1e-3), 1);
    // Beside a graze that is all that two solutions may be off by before two more are asked for.
    assert!(exact.worst < 2e-8 && exact.outside == 0, "{exact:?}");
    for (method, count) in [("bdf", 60), ("dop853", 250), ("tsit45", 60)] {
        let tally = campaign(count, false, method, ("auto", 1e-3), 2);
        assert!(tally.worst < 1e-2, "{tally:?}");
    }
    let cubic = campaign(130, true, "auto", ("dop853", 1e-9), 3);
    assert!(cubic.worst < 1e-2, "{cubic:?}");
}

const SCENE: &str = r#"
[values]
K = "50 kN/m"

[nodes]
head = { mass = "4 kg", velocity = "3 m/s" }

[elements]
pad = { between = ["head", "ground"], spring = "K" }

[run]
duration = "50 ms"
"#;

fn scene() -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = text(&file(&folder, "pad.toml", SCENE)).to_owned();
    (folder, path)
}

/// The peak force is `v √(K m)`: derivatives and percents of JSON are those of it, at each point.
#[test]
fn the_command_tells_derivatives_in_json() {
    let (_folder, path) = scene();
    let own = ["sweep", &path, "--gradient", "K,head.velocity", "--vary", "head.mass=1,4 kg"];
    let object = json(&[&own[..], &["--measure", "pad.peak-force", "--json"]].concat());
    for (at, mass) in [1.0, 4.0].into_iter().enumerate() {
        let measure = &object["points"][at]["measures"][0];
        let (k, v) = (5e4_f64, 3.0);
        let peak = v * (k * mass).sqrt();
        for (number, (right, unit)) in
            [(0.5 * peak / k, "N/(N/m)"), (peak / v, "N/(m/s)")].into_iter().enumerate()
        {
            let own = &measure["derivatives"][number];
            let value = own["value"].as_f64().unwrap();
            assert!((value - right).abs() <= own["error"].as_f64().unwrap(), "{own} {right}");
            assert!((value / right - 1.0).abs() < 1e-8, "{own} {right}");
            assert_eq!(own["unit"], unit);
            let percent = own["elasticity"].as_f64().unwrap();
            assert!((percent - [0.5, 1.0][number]).abs() < 1e-8, "{own}");
        }
    }
}

#[test]
fn what_cannot_be_derived_by_is_said() {
    let (_folder, path) = scene();
    let of = |more: &[&str]| run(&[&["sweep", path.as_str()], more].concat());
    let unknown = of(&["--gradient", "stifness"]);
    assert_eq!(code(&unknown), 2);
    assert!(err(&unknown).contains("`--gradient`: the scene has no number `stifness`"));
    let set = of(&["--gradient", "K", "--set", "K=60 kN/m"]);
    assert_eq!(code(&set), 2);
    assert!(err(&set).contains("`K` is set and varied"), "{}", err(&set));
    let table = of(&["--gradient", "K", "--measure", "pad.peak-force", "--table", "always"]);
    assert!(out(&table).contains("0.50 %"), "{}", out(&table));
    assert!(out(&table).lines().all(|line| line.chars().count() <= 80), "{}", out(&table));
}
