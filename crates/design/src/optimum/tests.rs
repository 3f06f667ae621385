use std::f64::consts::SQRT_2;

use dashpot_analysis::{
    Bound, Limit, Odds, SolveSettings,
    sweep::{PoseAt, ScenePoint},
};
use dashpot_network::{Model, Network, Node, dashpot, spring};

use super::*;

const SPEED: f64 = 5.0;
const TRAVEL: f64 = 0.03;
/// `v0²/D` \[m/s²\].
const UNIT: f64 = SPEED * SPEED / TRAVEL;

/// 1 kg on a pad that may come in by so much.
fn scene(model: Model, key: &str) -> ScenePoint {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(SPEED));
    network.connect("pad", head, network.ground(), model);
    let mut settings = SolveSettings::lasting(0.2);
    settings.limits = vec![Limit::new("pad.peak-deformation", Bound::Max(TRAVEL))];
    if key != "head.peak-acceleration" {
        settings.limits.push(Limit::new(key, Bound::Max(1e9)));
    }
    ScenePoint { network, settings }
}

/// A frequency \[1/s\] and a damping ratio.
fn variables(start: [f64; 2]) -> [Variable; 2] {
    let [frequency, damping] = start;
    [
        Variable { low: 20.0, high: 2000.0, start: frequency },
        Variable { low: 0.02, high: 3.0, start: damping },
    ]
}

fn best(model: &(dyn Fn(&[f64]) -> Model + Sync), key: &str) -> Design {
    let pose = |values: &[f64]| Ok(scene(model(values), key));
    let aim = Aim::Measure(key.to_owned());
    let pose: &PoseAt<'_> = &pose;
    found(&variables([200.0, 0.5]), &aim, &[pose])
}

fn found(variables: &[Variable], aim: &Aim, tests: &[&PoseAt<'_>]) -> Design {
    design(&Problem { variables, totals: &[], aim, tests }, Effort::default()).unwrap()
}

fn kelvin(values: &[f64]) -> Model {
    let &[omega, ratio] = values else { unreachable!() };
    spring(omega * omega) | dashpot(2.0 * ratio * omega)
}

#[test]
fn the_best_kelvin_pad_is_4_percent_above_the_floor() {
    let own = best(&kelvin, "head.peak-acceleration");
    assert!(own.is_feasible && own.search.agree == own.search.starts, "{:?}", own.search);
    assert!((own.aim / UNIT - 0.5206).abs() < 5e-5, "{}", own.aim / UNIT);
    assert!((own.values[1] - 0.404).abs() < 5e-4, "{:?}", own.values);
    // Only the travel holds it, and 1 % more of that takes 1 % off.
    let travel = &own.kept[0];
    assert!(travel.is_active);
    let price = travel.price.unwrap() * TRAVEL / own.aim;
    assert!((price + 1.0).abs() < 1e-3, "{price}");
}

#[test]
fn the_best_maxwell_pad_is_two_thirds_off() {
    // c/√(k m) = 0.714.
    let maxwell = |values: &[f64]| -> Model {
        let &[omega, ratio] = values else { unreachable!() };
        spring(omega * omega) + dashpot(ratio * omega)
    };
    let own = best(&maxwell, "head.peak-acceleration");
    assert!((own.aim / UNIT - 0.688).abs() < 5e-4, "{}", own.aim / UNIT);
    assert!((own.values[1] - 0.714).abs() < 2e-3, "{:?}", own.values);
}

#[test]
fn what_contradicts_is_told_with_the_least_excess() {
    // On a spring peak · D ≥ v0² whatever its stiffness, so both are exceeded by √2.
    let pose = |values: &[f64]| {
        let mut point = scene(spring(values[0]), "head.peak-acceleration");
        let most = Bound::Max(0.5 * UNIT);
        point.settings.limits.push(Limit::new("head.peak-acceleration", most));
        Ok(point)
    };
    let variable = Variable { low: 1e2, high: 1e7, start: 1e3 };
    let own = found(&[variable], &Aim::Number(0), &[&pose]);
    assert!(!own.is_feasible && own.search.feasible == 0);
    for kept in &own.kept {
        assert!((kept.margin + SQRT_2 - 1.0).abs() < 1e-4, "{:?}", own.kept);
    }
}

#[test]
fn the_worst_of_several_tests_counts() {
    // √2 times the speed on the same travel: twice the stiffness.
    let at = |speed: f64| {
        move |values: &[f64]| {
            let mut point = scene(spring(values[0]), "head.peak-acceleration");
            let head = point.network.node_named("head").unwrap();
            point.network.node_mut(head).start = dashpot_network::Start::Velocity(speed);
            Ok(point)
        }
    };
    let (slow, fast) = (at(SPEED), at(SPEED * SQRT_2));
    let variable = Variable { low: 1e2, high: 1e7, start: 1e3 };
    let tests: [&PoseAt<'_>; 2] = [&slow, &fast];
    for aim in [Aim::Number(0), Aim::Measure("head.peak-acceleration".to_owned())] {
        let own = found(&[variable], &aim, &tests);
        let right = 2.0 * SPEED * SPEED / (TRAVEL * TRAVEL);
        assert!(own.is_feasible && (own.values[0] / right - 1.0).abs() < 1e-4, "{own:?}");
        assert_eq!(own.kept.iter().map(|own| own.is_active).collect::<Vec<_>>(), [false, true]);
    }
}

/// Two layers in series, each by its thickness, on 60 cm².
fn stack(values: &[f64]) -> Model {
    const AREA: f64 = 60e-4;
    let layer = |modulus: f64, viscosity: f64, thickness: f64| -> Model {
        spring(modulus * AREA / thickness) | dashpot(viscosity * AREA / thickness)
    };
    layer(0.1e6, 2.0, values[0]) + layer(0.5e6, 4e3, values[1])
}

#[test]
fn layers_under_a_total_are_best_where_an_exhaustive_grid_is() {
    const WHOLE: f64 = 0.06;
    let key = "head.peak-acceleration";
    let pose = |values: &[f64]| -> Result<ScenePoint, String> { Ok(scene(stack(values), key)) };
    let variables = [0.02, 0.04].map(|start| Variable { low: 0.002, high: 0.058, start });
    let totals = [Total { of: vec![0, 1], sum: WHOLE }];
    let (aim, tests): (_, [&PoseAt<'_>; 1]) = (Aim::Measure(key.to_owned()), [&pose]);
    let problem = Problem { variables: &variables, totals: &totals, aim: &aim, tests: &tests };
    let own = design(&problem, Effort { designs: 30, ..Effort::default() }).unwrap();
    assert!((own.values[0] + own.values[1] - WHOLE).abs() < 1e-15);
    let at = |first: f64| {
        let point = pose(&[first, WHOLE - first]).unwrap();
        let run = dashpot_analysis::Solve::solve_with(&point.network, &point.settings).unwrap();
        [key, "pad.peak-deformation"].map(|own| run.value(own).unwrap())
    };
    // Those that come in by no more than they may.
    let grid = (0..=560).map(|at_grid| 0.002 + 1e-4 * f64::from(at_grid));
    let kept = grid.map(|first| (at(first), first)).filter(|own| own.0[1] <= TRAVEL);
    let ([best, _], first) = kept.min_by(|one, other| one.0[0].total_cmp(&other.0[0])).unwrap();
    assert!(first > 0.003 && first < 0.057, "{first}");
    assert!((own.values[0] - first).abs() < 1.01e-4, "{:?} {first}", own.values);
    // A step of the grid changes the peak by less than a part in a hundred.
    assert!(own.aim <= best * (1.0 + 1e-9) && own.aim > best * 0.99, "{} {best}", own.aim);
}

#[test]
fn numbers_with_a_sum_have_it_anywhere_and_stay_within_their_bounds() {
    use super::spread::Space;
    let within = |low: f64, high: f64| Variable { low, high, start: low };
    let variables = [within(1.0, 9.0), within(2.0, 4.0), within(3.0, 30.0), within(1.0, 100.0)];
    let space = Space::of(&variables, &[Total { of: vec![0, 1, 2], sum: 20.0 }]);
    let mut stream = dashpot_numerics::Stream::new(5);
    for _ in 0..1000 {
        let unknowns = [0; 3].map(|_| stream.share());
        let values = space.values(&unknowns);
        assert!((values[0] + values[1] + values[2] - 20.0).abs() < 1e-12, "{values:?}");
        for (own, value) in variables.iter().zip(&values) {
            assert!((own.low - 1e-12..=own.high + 1e-12).contains(value), "{values:?}");
        }
        let back = space.values(&space.unknowns(&values));
        assert!(values.iter().zip(&back).all(|(one, other)| (one - other).abs() < 1e-9));
    }
}

#[test]
fn a_front_is_that_of_the_closed_form_and_no_design_of_the_grid_is_better() {
    // On a spring peak · depth = v0² whatever its stiffness.
    let of_kelvin = variables([200.0, 0.5]);
    let [peak, depth] =
        ["head.peak-acceleration", "pad.peak-deformation"].map(|own| Aim::Measure(own.to_owned()));
    let pose = |values: &[f64]| -> Result<ScenePoint, String> {
        let mut point = scene(spring(values[0]), "head.peak-acceleration");
        point.settings.limits.clear();
        Ok(point)
    };
    let variables = [Variable { low: 1e3, high: 1e5, start: 1e4 }];
    let tests: [&PoseAt<'_>; 1] = [&pose];
    let problem = Problem { variables: &variables, totals: &[], aim: &depth, tests: &tests };
    let own = front(&problem, &peak, Effort::default(), 7).unwrap();
    assert_eq!(own.points.len(), 7);
    for point in &own.points {
        let product = point.design.aim * point.other / (SPEED * SPEED);
        assert!((product - 1.0).abs() < 1e-5, "{product}");
        // By the multiplier: d depth/d peak = −depth/peak.
        let held = point.design.kept.iter().find(|own| own.is_active);
        if let Some(price) = held.and_then(|own| own.price).filter(|own| own.is_finite()) {
            let right = -point.design.aim / point.other;
            assert!((price / right - 1.0).abs() < 1e-3, "{price} {right}");
        }
    }
    let ends = [own.points[0].other, own.points[6].other].map(|own| own / SPEED);
    assert!((ends[0] / 1e5_f64.sqrt() - 1.0).abs() < 1e-5, "{ends:?}");
    assert!((ends[1] / 1e3_f64.sqrt() - 1.0).abs() < 1e-5, "{ends:?}");

    // With damping as well there is no closed form, but no design of the grid may have less of both.
    let pose = |values: &[f64]| -> Result<ScenePoint, String> {
        let mut point = scene(kelvin(values), "head.peak-acceleration");
        point.settings.limits.clear();
        Ok(point)
    };
    let tests: [&PoseAt<'_>; 1] = [&pose];
    let problem = Problem { variables: &of_kelvin, totals: &[], aim: &depth, tests: &tests };
    let own = front(&problem, &peak, Effort::default(), 6).unwrap();
    assert!(own.points.len() >= 5, "{}", own.points.len());
    for looked in &own.points[0].design.spread {
        let run = {
            let point = pose(&looked.values).unwrap();
            dashpot_analysis::Solve::solve_with(&point.network, &point.settings).unwrap()
        };
        let other = run.value("head.peak-acceleration").unwrap();
        for point in &own.points {
            let room = |own: f64| own * (1.0 - 1e-5);
            let is_less = looked.aim < room(point.design.aim) && other < room(point.other);
            assert!(!is_less, "{:?} {other} {}", looked, point.other);
        }
    }
    // A Kelvin pad at its best: peak · depth = 0.5206 v0².
    let least = own.points.iter().map(|own| own.design.aim * own.other / (SPEED * SPEED));
    let least = least.fold(f64::INFINITY, f64::min);
    assert!((least - 0.5206).abs() < 5e-4, "{least}");
}

#[test]
fn a_robust_design_keeps_its_share_of_a_normal_stiffness() {
    // v √(K m) is at most F with 95 % where K is its 95 % value there.
    const MEAN: f64 = 4e4;
    const DEVIATION: f64 = 4e3;
    const FORCE: f64 = 2500.0;
    let at = |mass: f64, stiffness: f64| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", mass).moving(SPEED));
        network.connect("pad", head, network.ground(), spring(stiffness));
        let mut settings = SolveSettings::lasting(0.2);
        settings.limits = vec![Limit::new("pad.peak-force", Bound::Max(FORCE))];
        ScenePoint { network, settings }
    };
    let pose = |values: &[f64]| Ok(at(values[0], MEAN));
    let scattered = |_: usize, values: &[f64]| {
        let place = |own: i32| (f64::from(own) + 0.5) / 400.0;
        let stiffness =
            |own: i32| MEAN + DEVIATION * dashpot_numerics::normal::quantile(place(own));
        Ok((0..400).map(|own| at(values[0], stiffness(own))).collect())
    };
    let variables = [Variable { low: 1.0, high: 20.0, start: 4.0 }];
    let aim = Aim::Measure("head.peak-acceleration".to_owned());
    let tests: [&PoseAt<'_>; 1] = [&pose];
    let problem = Problem { variables: &variables, totals: &[], aim: &aim, tests: &tests };
    for probability in [0.95, 0.8] {
        let scattered = Scattered { probability, pose: &scattered };
        let own = robust(&problem, scattered, Effort::default()).unwrap();
        // The sample shows no more than its own part, the whole range of which is that probability or more.
        let kept = Odds::least_kept(probability, 400).unwrap() as f64 / 400.0;
        let deviations = dashpot_numerics::normal::quantile(kept);
        let right = (FORCE / SPEED).powi(2) / (MEAN + deviations * DEVIATION);
        let borne = own.borne.unwrap();
        assert!(borne.is_enough() && own.is_feasible, "{borne:?}");
        // The sample tells its quantile to a 400th: 0.03 standard deviations here.
        assert!((own.values[0] / right - 1.0).abs() < 5e-3, "{} {right} {borne:?}", own.values[0]);
    }
}
