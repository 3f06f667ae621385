mod driven;
mod many;

use dashpot_dae::{Run, Silent, Switch, Trajectory, Waveform, methods, switching};
use dashpot_rheology::Tree;

use crate::{
    Assembly, Model, Network, Node, dashpot,
    effects::{Gravity, GravityStart},
    elements::{Contact, Friction},
    part, spring,
};

fn contact(gap: f64, restitution: f64) -> Model {
    part(Contact { gap, restitution })
}

fn kelvin_voigt(stiffness: f64, damping: f64) -> Model {
    Tree::parallel([spring(stiffness), dashpot(damping)])
}

fn gravity(acceleration: f64) -> Gravity {
    Gravity { acceleration, start: GravityStart::Unloaded }
}

/// A head of 1 kg at `speed` on `pad`, which it can leave.
fn impact(speed: f64, pad: Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(speed));
    let face = network.add_node(Node::massless("face"));
    network.connect("contact", head, face, contact(0.0, 0.0));
    network.connect("pad", face, network.ground(), pad);
    network
}

struct Solved {
    assembly: Assembly,
    trajectory: Trajectory,
}

fn solve_by(method: &str, network: &Network, duration: f64) -> Solved {
    solve_with(method, 1e-9, network, duration)
}

fn solve_with(method: &str, rtol: f64, network: &Network, duration: f64) -> Solved {
    let assembly = network.compile(duration).unwrap();
    let method = methods::by_name(method).unwrap();
    let run = Run::to(duration).with_rtol(rtol);
    let switching = assembly.switching.clone().expect("something that switches");
    let trajectory =
        switching::integrate(method.as_ref(), switching.as_ref(), &run, &mut Silent).unwrap();
    Solved { assembly, trajectory }
}

fn solve(network: &Network, duration: f64) -> Solved {
    solve_by("exact", network, duration)
}

impl Solved {
    fn at(&self, output: &str, time: f64) -> f64 {
        let output = self.assembly.output(output).unwrap();
        self.trajectory.signal(&self.assembly.system, output).left_value(time)
    }

    fn what(&self) -> Vec<&str> {
        self.trajectory.switches.iter().map(|switch| switch.what).collect()
    }

    fn switches(&self) -> &[Switch] {
        &self.trajectory.switches
    }
}

#[test]
fn kelvin_voigt_face_parts_although_gap_and_its_rate_are_zero() {
    // ω = 100/s, ζ = 0.3: the release is at 2 acos ζ/(ω √(1 − ζ²)).
    let zeta = 0.3_f64;
    let network = impact(10.0, kelvin_voigt(1e4, 200.0 * zeta));
    let release = 2.0 * zeta.acos() / (100.0 * (1.0 - zeta * zeta).sqrt());
    for (method, tolerance) in [("exact", 1e-13), ("bdf", 1e-7), ("esdirk34", 1e-7)] {
        let solved = solve_by(method, &network, 0.1);
        assert_eq!(solved.what(), ["open"], "{method}");
        let time = solved.switches()[0].time;
        assert!((time / release - 1.0).abs() < tolerance, "{method}: {time} {release}");
        // The face lags behind: the gap grows as its second derivative, F′/C.
        let gap = -solved.at("contact.deformation", 0.1);
        assert!(gap > 0.1, "{method}: {gap}");
    }
}

#[test]
fn face_of_a_spring_parts_with_a_jump_of_its_speed() {
    let solved = solve(&impact(10.0, spring(1e4)), 0.1);
    assert_eq!(solved.what(), ["open"]);
    // From then on the face is at rest where it was unloaded.
    assert!(solved.at("face.position", 0.1).abs() < 1e-15);
    assert!((solved.at("head.velocity", 0.1) + 10.0).abs() < 1e-12);
}

#[test]
fn force_that_decays_to_zero_never_lets_go() {
    // A dashpot alone, and a Maxwell pad that is damped critically: F > 0 for all times.
    for pad in [dashpot(50.0), Tree::series([spring(1e4), dashpot(50.0)])] {
        for method in ["exact", "bdf"] {
            let solved = solve_by(method, &impact(10.0, pad.clone()), 0.5);
            assert!(solved.switches().is_empty(), "{method}: {:?}", solved.switches());
        }
    }
}

#[test]
fn what_rests_on_the_ground_stays_there_with_gravity_and_without() {
    for (acceleration, force) in [(9.81, 9.81), (0.0, 0.0)] {
        let mut network = Network::new();
        let ball = network.add_node(Node::mass("ball", 1.0));
        network.connect("floor", ball, network.ground(), contact(0.0, 0.5));
        network.add_effect(gravity(acceleration));
        for method in ["exact", "bdf"] {
            let solved = solve_by(method, &network, 1.0);
            assert!(solved.switches().is_empty(), "{:?}", solved.switches());
            assert!(solved.at("ball.position", 1.0).abs() < 1e-300);
            assert!((solved.at("floor.force", 1.0) - force).abs() < 1e-14);
        }
    }
}

#[test]
fn what_hangs_on_the_ground_falls_off_at_once() {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 1.0));
    network.connect("floor", ball, network.ground(), contact(0.0, 0.0));
    network.add_effect(gravity(-2.0));
    let solved = solve(&network, 3.0);
    assert_eq!(solved.trajectory.first_phases[0].0, 0, "open");
    assert!(solved.switches().is_empty());
    assert!((solved.at("ball.position", 3.0) + 9.0).abs() < 1e-13);
}

/// A ball of 1 kg at 1 m/s and a wall that is held at a place.
fn towards_a_wall(place: f64) -> Network {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 1.0).moving(1.0));
    let wall = network.add_node(Node::prescribed("wall", Waveform::constant(place)));
    network.connect("touch", ball, wall, contact(0.0, 0.5));
    network
}

#[test]
fn what_begins_within_a_wall_is_refused_by_name_and_before_it_is_thrown_back() {
    // No speed or force of finite size parts what overlaps by 1 cm.
    let refusal = towards_a_wall(-0.01).compile(1.0).unwrap_err().to_string();
    assert!(refusal.contains("`wall`"), "{refusal}");
    let solved = solve(&towards_a_wall(0.05), 0.1);
    let [impact] = solved.switches() else { panic!("{:?}", solved.switches()) };
    assert!((impact.time - 0.05).abs() < 1e-15 && (impact.lost - 0.375).abs() < 1e-15);
    assert!((solved.at("ball.position", 0.1) - 0.025).abs() < 1e-15);
}

#[test]
fn two_contacts_that_close_at_one_instant_are_one_switching() {
    let mut network = Network::new();
    for name in ["left", "right"] {
        let ball = network.add_node(Node::mass(name, 2.0).moving(3.0));
        network.connect(format!("{name} floor"), ball, network.ground(), contact(0.3, 0.5));
    }
    for method in ["exact", "bdf"] {
        let solved = solve_by(method, &network, 0.2);
        let switches = solved.switches();
        assert_eq!(switches.len(), 2, "{method}: {switches:?}");
        assert_eq!(switches[0].time.to_bits(), switches[1].time.to_bits());
        for switch in switches {
            assert!((switch.time - 0.1).abs() < 1e-9);
            assert!((switch.impulse - 9.0).abs() < 1e-8);
            assert!((switch.lost - 9.0 * 0.75).abs() < 1e-7);
        }
    }
}

#[test]
fn a_row_of_balls_passes_the_blow_on_at_one_instant() {
    // Newton's law for all contacts at once, plastic: all go on together.
    let mut network = Network::new();
    let first = network.add_node(Node::mass("a", 1.0).moving(3.0));
    let second = network.add_node(Node::mass("b", 1.0));
    let third = network.add_node(Node::mass("c", 1.0));
    network.connect("ab", first, second, contact(0.3, 0.0));
    network.connect("bc", second, third, contact(0.0, 0.0));
    let solved = solve(&network, 0.2);
    for ball in ["a", "b", "c"] {
        let speed = solved.at(&format!("{ball}.velocity"), 0.2);
        assert!((speed - 1.0).abs() < 1e-13, "{ball}: {speed}");
    }
    let lost: f64 = solved.switches().iter().map(|switch| switch.lost).sum();
    assert!((lost - 3.0).abs() < 1e-13, "{lost}");
}

/// A body on a spring that swings by 1 m towards a wall at a distance.
fn swinging(wall: f64) -> Network {
    let mut network = Network::new();
    let body = network.add_node(Node::mass("body", 1.0).moving(1.0));
    network.connect("spring", body, network.ground(), spring(1.0));
    network.connect("wall", body, network.ground(), contact(wall, 1.0));
    network
}

#[test]
fn a_wall_just_out_of_reach_is_not_touched_and_one_just_in_reach_reflects() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let missed = solve(&swinging(1.0 + 1e-12), 3.0);
    assert!(missed.switches().is_empty(), "{:?}", missed.switches());
    let touched = solve(&swinging(1.0 - 1e-12), 3.0);
    let impacts: Vec<_> = touched.switches().iter().filter(|switch| switch.impulse > 0.0).collect();
    assert_eq!(impacts.len(), 1, "{:?}", touched.switches());
    // cos of the phase before the top is 1 − 1e-12, whose own rounding moves it by 1e-10.
    let early = quarter - impacts[0].time;
    assert!((early - 2e-12_f64.sqrt()).abs() < 2e-10, "{early:e}");
    for solved in [missed, touched] {
        assert!((solved.at("body.position", 3.0) - 3_f64.sin()).abs() < 3e-6);
    }
}

#[test]
fn a_massless_pad_that_can_part_on_both_sides_is_refused_by_name() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
    let (above, below) = (Node::massless("above"), Node::massless("below"));
    let (above, below) = (network.add_node(above), network.add_node(below));
    network.connect("upper", head, above, contact(0.0, 0.0));
    network.connect("pad", above, below, kelvin_voigt(1e4, 10.0));
    network.connect("lower", below, network.ground(), contact(0.0, 0.0));
    let refusal = network.compile(1.0).unwrap_err().to_string();
    assert!(refusal.contains("above") && refusal.contains("below"), "{refusal}");
}

#[test]
fn a_slider_behind_a_pad_that_can_part_is_no_loose_end() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
    let face = network.add_node(Node::massless("face"));
    network.connect("contact", head, face, contact(0.0, 0.0));
    let pad = Tree::series([spring(1e4), part(Friction { force: 20.0, ratio: 1.0 })]);
    network.connect("pad", face, network.ground(), pad);
    let solved = solve(&network, 0.2);
    // Elastic to 20 N, plastic to the turn, elastic back: it leaves with F_c/√(k m).
    assert_eq!(solved.what(), ["sliding forward", "stuck", "open"]);
    assert!((solved.at("head.velocity", 0.2) + 0.2).abs() < 1e-13);
}

#[test]
fn a_pull_of_rounding_is_none() {
    for pull in [0.0, -1e-17, 1e-17] {
        let mut network = Network::new();
        let ball = network.add_node(Node::mass("ball", 1.0).moving(0.0));
        network.connect("floor", ball, network.ground(), contact(0.0, 0.5));
        network.connect("spring", ball, network.ground(), spring(100.0));
        network.add_load("push", ball, Waveform::constant(pull));
        let solved = solve(&network, 1.0);
        assert!(solved.switches().len() <= 1, "{:?}", solved.switches());
        assert!(solved.at("ball.position", 1.0).abs() < 1e-17);
    }
}

#[test]
fn the_same_run_twice_is_the_same_to_the_last_bit() {
    let mut network = impact(2.0, kelvin_voigt(1e4, 20.0));
    network.add_effect(gravity(9.81));
    for method in ["exact", "bdf"] {
        let [one, two] = [0, 1].map(|_| solve_by(method, &network, 2.0));
        assert!(one.switches().len() > 4);
        assert_eq!(one.switches(), two.switches());
        for output in ["head.position", "head.velocity", "pad.force"] {
            let [one, two] = [&one, &two].map(|own| own.at(output, 1.7).to_bits());
            assert_eq!(one, two, "{output} by {method}");
        }
    }
}

/// However loose the tolerance is, a part that leaves its stop is told from one that reaches it.
#[test]
fn a_hard_stop_switches_as_often_with_any_tolerance_as_with_the_exact_method() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("mass", 10.0).moving(10.0));
    network.connect("spring", mass, network.ground(), kelvin_voigt(1e6, 300.0));
    let stop = Tree::series([contact(5e-3, 0.0), spring(2e7)]);
    network.connect("stop", mass, network.ground(), stop);
    let expected = solve(&network, 0.05);
    assert_eq!(expected.switches().len(), 8);
    for method in ["bdf", "tr-bdf2", "esdirk34"] {
        for rung in 4..=16 {
            let rtol = 10_f64.powf(-f64::from(rung) / 4.0);
            let solved = solve_with(method, rtol, &network, 0.05);
            assert_eq!(solved.what(), expected.what(), "{method} at {rtol:e}");
        }
    }
}
