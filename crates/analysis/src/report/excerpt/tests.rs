use dashpot_network::{
    Network, Node,
    effects::{Gravity, GravityStart, Separation},
    elements::{Contact, Dashpot, Spring},
    part,
};
use dashpot_rheology::Tree;

use super::*;
use crate::{RunReport, Solve, SolveSettings, regular_times};

const G: f64 = 9.81;
const MASS: f64 = 5.0;
const STIFFNESS: f64 = 2e5;

fn run(network: &Network, duration: f64) -> RunReport {
    network.solve_with(&SolveSettings::lasting(duration).by_name("exact").unwrap()).unwrap()
}

/// 5 kg dropped from `height` \[m\] on a spring that it may leave; on a table that moves if `on_table`.
fn drop(height: f64, on_table: bool) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", MASS).dropped(height));
    let ground = network.ground();
    let foot = if on_table {
        let table = network.add_node(Node::mass("table", 20.0));
        let legs =
            Tree::parallel([part(Spring { stiffness: 1e6 }), part(Dashpot { damping: 50.0 })]);
        network.connect("legs", table, ground, legs);
        table
    } else {
        ground
    };
    network.connect("pad", head, foot, part(Spring { stiffness: STIFFNESS }));
    network.add_effect(Separation { element: "pad".into(), at: None, restitution: 0.0 });
    network.add_effect(Gravity { acceleration: G, start: GravityStart::Equilibrium });
    network
}

/// When the mass meets the spring, and for how long: ω t = 2π − 2 arctan(v ω/g).
fn contact(height: f64) -> (f64, f64) {
    let omega = (STIFFNESS / MASS).sqrt();
    let fall = (2.0 * height / G).sqrt();
    let length = 2.0 * (std::f64::consts::PI - (fall * omega).atan()) / omega;
    (fall, fall + length)
}

#[test]
fn contact_lasts_as_long_as_the_closed_form_says() {
    let report = run(&drop(1.0, false), 0.6);
    let (met, left) = contact(1.0);
    let spans = touching(&report.solution());
    assert_eq!(spans.len(), 1, "{spans:?}");
    assert!((spans[0].0 - met).abs() < 1e-9 && (spans[0].1 - left).abs() < 1e-9, "{spans:?}");
}

#[test]
fn excerpt_of_a_drop_is_its_impact_with_a_tenth_around() {
    let report = run(&drop(1.0, false), 0.6);
    let (met, left) = contact(1.0);
    let (from, to) = excerpt(&report.solution());
    let room = 0.1 * (left - met);
    assert!((from - (met - room)).abs() < 1e-9 && (to - (left + room)).abs() < 1e-9, "{from} {to}");
}

#[test]
fn what_goes_on_after_the_contact_stays_in_sight() {
    // The table rings on with a damping ratio of 0.6 %.
    let report = run(&drop(1.0, true), 0.6);
    let solution = report.solution();
    let (met, _) = contact(1.0);
    let (from, to) = excerpt(&solution);
    assert!(from < met && from > 0.9 * met, "{from}");
    assert!((to - 0.6).abs() < 0.02, "{to}");
}

#[test]
fn foam_is_left_where_its_contact_opens_and_alone_where_it_goes_slack() {
    use dashpot_network::elements::HystereticFoam;
    use dashpot_network::parameters::Kind as _;
    for beside in [0.0, 10.0] {
        // Foam never pulls, alone or with a dashpot beside it that its separation holds back.
        let mut network = drop(0.5, false);
        let foam = part(HystereticFoam::sample());
        let model = Tree::parallel([foam.clone(), part(Dashpot { damping: beside })]);
        network.set_model(0, if beside > 0.0 { model } else { foam });
        let settings = SolveSettings::lasting(0.5).by_name("esdirk34").unwrap();
        let report = network.solve_with(&settings).unwrap();
        let spans = touching(&report.solution());
        let (met, _) = contact(0.5);
        // As good as the measures are to be.
        assert!((spans[0].0 - met).abs() <= settings.accuracy.default * met, "{spans:?}");
        assert!((0.01..0.03).contains(&(spans[0].1 - met)), "{spans:?}");
    }
}

#[test]
fn run_without_a_flight_is_shown_whole() {
    let mut glued = Network::new();
    let head = glued.add_node(Node::mass("head", MASS).moving(3.0));
    glued.connect("pad", head, glued.ground(), part(Spring { stiffness: STIFFNESS }));
    let report = run(&glued, 0.05);
    assert!(touching(&report.solution()).is_empty());
    assert_eq!(excerpt(&report.solution()), (0.0, 0.05));
}

#[test]
fn rigid_bounce_takes_no_time_and_the_rest_of_bouncing_is_one_contact() {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 0.1).dropped(0.3));
    network.connect("floor", ball, network.ground(), part(Contact { gap: 0.0, restitution: 0.5 }));
    network.add_effect(Gravity { acceleration: G, start: GravityStart::Equilibrium });
    let report = run(&network, 1.5);
    let spans = touching(&report.solution());
    let fall = (0.6 / G).sqrt();
    assert!((spans[0].0 - fall).abs() < 1e-9 && spans[0].1 <= spans[0].0, "{:?}", spans[0]);
    // The flights take 2 e^n √(2 h/g), together 2 for e = 1/2.
    let rest = spans.last().unwrap();
    assert!((rest.0 - 3.0 * fall).abs() < 1e-6 && rest.1 >= 1.5, "{rest:?}");
}

#[test]
fn times_without_short_contacts_are_regular() {
    for spans in [&[][..], &[(0.0, 2.0)], &[(1.0, 1.0)], &[(5.0, 6.0)]] {
        let times = resolving_times((0.0, 2.0), spans, 101);
        for (one, other) in times.iter().zip(regular_times(2.0, 101)) {
            assert!((one - other).abs() < 1e-15, "{spans:?}: {one} {other}");
        }
    }
}

#[test]
fn half_of_the_samples_lie_in_short_contacts() {
    let spans = [(0.4, 0.41), (0.9, 0.92)];
    let times = resolving_times((0.0, 1.0), &spans, 501);
    assert_eq!((times.len(), times[0], times[500]), (501, 0.0, 1.0));
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    let inside =
        |span: &(f64, f64)| times.iter().filter(|t| (span.0..=span.1).contains(*t)).count();
    // 250 over 36 ms with the room around, beside those that are everywhere.
    assert!(inside(&spans[0]) >= 69 && inside(&spans[1]) >= 138, "{:?}", spans.map(|s| inside(&s)));
    let widest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(widest <= 1.0 / 250.0 + 1e-12, "{widest}");
}

#[test]
fn any_count_and_any_spans_give_rising_times_within_the_window() {
    let many: Vec<(f64, f64)> =
        (0..5000).map(|i| f64::from(i) * 2e-4).map(|t| (t, t + 5e-5)).collect();
    for count in [0, 1, 2, 3, 20, 501] {
        for window in [(0.0, 1.0), (0.3, 0.7), (0.5, 0.5), (0.0, 0.0)] {
            for spans in [&many[..], &[(0.2, 0.21)], &[(0.0, 0.01), (0.99, 1.0)]] {
                let times = resolving_times(window, spans, count);
                assert_eq!(times.len(), count);
                assert!(times.is_sorted(), "{count} {window:?}");
                assert!(
                    times.iter().all(|t| (window.0..=window.1).contains(t)),
                    "{count} {window:?}"
                );
            }
        }
    }
}
