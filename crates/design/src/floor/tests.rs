use std::f64::consts::PI;

use dashpot_analysis::{
    Bound, Limit, MeasureWish, Solve, SolveSettings,
    measures::{Hic15, PeakAcceleration, PeakForce, SeverityIndex},
};
use dashpot_network::{
    Network, Node, dashpot,
    effects::{Gravity, GravityStart, Separation, Stop},
    parameters::WindowWish,
    spring,
};

use super::*;

const G0: f64 = STANDARD_GRAVITY;

fn value(stroke: &Stroke, judged: Judged) -> Floor {
    stroke.floor(judged).unwrap()
}

fn near(own: f64, right: f64, part: f64) {
    assert!((own / right - 1.0).abs() <= part, "{own} for {right}");
}

#[test]
fn on_a_fixed_support_the_floors_are_their_closed_forms() {
    for (mass, speed, travel) in [(10.0, 10.0, 0.02), (5.0, 5.42, 0.03), (1.0, 0.3, 1e-3)] {
        let own = Stroke::on_fixed(mass, speed, 0.0, travel).unwrap();
        let time = 8.0 * travel / (3.0 * speed);
        let peak = value(&own, Judged::PeakAcceleration);
        near(peak.value, speed * speed / (2.0 * travel), 1e-12);
        near(peak.time, 2.0 * travel / speed, 1e-6);
        near(value(&own, Judged::PeakForce).value, mass * peak.value, 1e-12);
        let index = value(&own, Judged::SeverityIndex { exponent: 2.5 });
        near(
            index.value,
            0.625_f64.powf(2.5) * speed.powi(4) / (G0.powf(2.5) * travel.powf(1.5)),
            1e-12,
        );
        near(index.time, time, 1e-6);
        let hic = value(&own, Judged::Hic { cap: 1.0 });
        near(hic.value, (speed / G0).powf(2.5) * (3.0 * speed / (8.0 * travel)).powf(1.5), 1e-11);
        near(hic.time, time, 1e-6);
        assert!([peak, index, hic].iter().all(|own| own.is_reached));
        // Of the square pulse's.
        let square = (2.0 * travel / speed) * (peak.value / G0).powf(2.5);
        near(hic.value / square, 0.649_519, 1e-6);
        near(index.value / square, 0.873_464, 1e-6);
    }
}

#[test]
fn gravity_adds_itself_to_the_least_acceleration() {
    let [still, falling] = [0.0, G0].map(|own| Stroke::on_fixed(4.0, 2.0, own, 0.05).unwrap());
    let least = value(&still, Judged::PeakAcceleration).value;
    near(value(&falling, Judged::PeakAcceleration).value, least + G0, 1e-12);
    let hic = Judged::Hic { cap: 1.0 };
    assert!(value(&falling, hic).value > value(&still, hic).value);
    assert!(!value(&falling, hic).is_reached);
}

#[test]
fn what_is_dropped_is_stopped_from_its_speed_at_touch() {
    let (height, travel) = (0.76, 0.06);
    let stroke = |is_falling: bool, is_dropped: bool| {
        let mut network = Network::new();
        let start = Node::mass("parcel", 8.0);
        let speed = (2.0 * G0 * height).sqrt();
        let start = if is_dropped { start.dropped(height) } else { start.moving(speed) };
        let parcel = network.add_node(start);
        network.connect("pad", parcel, network.ground(), spring(1e5)).thickness = Some(travel);
        network.add_effect(Gravity { acceleration: G0, start: GravityStart::Equilibrium });
        if is_falling {
            let at = Some("parcel".to_owned());
            network.add_effect(Separation { element: "pad".to_owned(), at, restitution: 0.0 });
        }
        floors(&network, 1.0, &[]).unwrap().stroke
    };
    for (is_falling, is_dropped) in [(false, false), (false, true), (true, false), (true, true)] {
        let least = value(&stroke(is_falling, is_dropped), Judged::PeakAcceleration).value;
        near(least / G0, 1.0 + height / travel, 1e-12);
    }
}

#[test]
fn a_short_window_takes_something_off_the_least_hic() {
    let own = Stroke::on_fixed(5.0, 4.0, 0.0, 0.06).unwrap();
    let all = [1.0, 0.036, 0.015].map(|cap| value(&own, Judged::Hic { cap }));
    assert!(all[0].time > 0.036 && all.iter().all(|own| own.is_reached));
    assert!(all[0].value > all[1].value && all[1].value > all[2].value, "{all:?}");
}

/// The force of a full window over and over, where there are some hundred of them, takes up the travel: the sum of what it
/// moves window by window.
#[test]
fn very_short_windows_are_counted_one_by_one() {
    let (mass, speed, travel) = (5.0, 4.0, 0.06);
    let stroke = Stroke::on_fixed(mass, speed, 0.0, travel).unwrap();
    for cap in [1e-4, 2.7e-5] {
        let floor = value(&stroke, Judged::Hic { cap });
        let size = floor.value.powf(1.0 / HIC_EXPONENT) * G0;
        let (mut lost, mut moved, mut from) = (0.0, 0.0, 0.0);
        while from < floor.time {
            let length = cap.min(floor.time - from);
            moved += lost * length + length.powf(1.6) / 1.6;
            lost += length.powf(0.6);
            from += cap;
        }
        assert!(from > 250.0 * cap);
        near(speed * floor.time - size * moved, travel, 1e-11);
    }
}

/// The force of a full window over and over, scaled to the floor, stops the body within the travel, and no window of it
/// has more than the floor.
#[test]
fn a_force_reaches_the_least_hic_of_short_windows() {
    let (mass, speed, travel, cap) = (5.0, 4.0, 0.06, 0.015);
    let stroke = Stroke::on_fixed(mass, speed, 0.0, travel).unwrap();
    let floor = value(&stroke, Judged::Hic { cap });
    let size = floor.value.powf(1.0 / HIC_EXPONENT) * G0;
    // The speed that is lost up to a time, and its integral, by hand.
    let (windows, rest) = ((floor.time / cap).floor(), floor.time % cap);
    let lost = |since: f64| {
        let since = since.min(floor.time);
        let before = (since / cap).floor();
        size * (before * cap.powf(0.6) + (since - before * cap).powf(0.6))
    };
    let moved = windows * cap.powf(1.6) / 1.6
        + cap.powf(1.6) * windows * (windows - 1.0) / 2.0
        + windows * cap.powf(0.6) * rest
        + rest.powf(1.6) / 1.6;
    near(lost(floor.time), speed, 1e-6);
    near(speed * floor.time - size * moved, travel, 1e-9);
    let (mut largest, steps) = (0.0_f64, 400);
    let length = floor.time / f64::from(steps);
    for (from, to) in (0..steps).flat_map(|from| (from + 1..=steps).map(move |to| (from, to))) {
        let [from, to] = [from, to].map(|at| f64::from(at) * length);
        if to - from <= cap {
            let mean = (lost(to) - lost(from)) / (to - from) / G0;
            largest = largest.max((to - from) * mean.powf(HIC_EXPONENT));
        }
    }
    near(largest, floor.value, 1e-9);
}

/// A head on a pad over a panel that hangs on a mount.
fn on_panel(panel: f64, mount: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let below = network.add_node(Node::mass("panel", panel));
    network.connect("pad", head, below, spring(2e7) | dashpot(4e3)).thickness = Some(0.02);
    if mount > 0.0 {
        network.connect("mount", below, network.ground(), spring(mount) | dashpot(1e-4 * mount));
    }
    network
}

#[test]
fn on_a_free_mass_the_reduced_mass_is_stopped() {
    let floors = floors(&on_panel(90.0, 0.0), 0.05, &[]).unwrap();
    let of = |judged| floors.stroke.floor(judged).unwrap().value;
    // Stopped within D relative to the panel: u = 9 kg v0²/(2 D) on 10 kg.
    near(of(Judged::PeakForce), 9.0 * 100.0 / 0.04, 1e-9);
    near(of(Judged::PeakAcceleration), 0.9 * 100.0 / 0.04, 1e-9);
    let fixed = Stroke::on_fixed(9.0, 10.0, 0.0, 0.02).unwrap();
    let hic = Judged::Hic { cap: 0.015 };
    near(of(hic), 0.9_f64.powf(2.5) * value(&fixed, hic).value, 1e-9);
    let index = Judged::SeverityIndex { exponent: 2.5 };
    near(of(index), 0.9_f64.powf(2.5) * value(&fixed, index).value, 1e-9);
}

#[test]
fn a_stiff_mount_is_a_fixed_support_and_a_soft_one_a_free_mass() {
    let peak = |mount| {
        let floors = floors(&on_panel(90.0, mount), 0.05, &[]).unwrap();
        floors.stroke.floor(Judged::PeakAcceleration).unwrap().value
    };
    near(peak(1e12), 2500.0, 1e-3);
    near(peak(10.0), 2250.0, 1e-3);
    assert!(peak(5e7) < 2500.0 && peak(5e7) > 2250.0);
}

#[test]
fn the_travel_is_the_least_of_thickness_stop_and_limit() {
    let mut network = on_panel(90.0, 0.0);
    let least = |network: &Network, limits: &[Limit]| floors(network, 0.05, limits).unwrap().travel;
    assert_eq!(least(&network, &[]).of, TravelOf::Thickness);
    let limit = Limit::new("pad.peak-deformation", Bound::Max(0.012));
    assert_eq!(
        least(&network, std::slice::from_ref(&limit)),
        Travel { length: 0.012, of: TravelOf::Limit }
    );
    network.add_effect(Stop {
        element: "pad".to_owned(),
        at: Some(0.011),
        restitution: 0.0,
        stiffness: Some(1e8),
        damping: 0.0,
    });
    assert_eq!(least(&network, &[limit]), Travel { length: 0.011, of: TravelOf::Stop });
}

#[test]
fn what_has_no_floor_says_why() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    network.connect("pad", head, network.ground(), spring(2e7));
    let why = |network: &Network| floors(network, 0.05, &[]).unwrap_err();
    assert!(matches!(why(&network), NoFloor::NoTravel { .. }));
    network.connect("neck", head, network.ground(), spring(1e3)).thickness = Some(1.0);
    assert!(matches!(why(&network), NoFloor::NotOne { bodies: 1, elements: 2 }));
    let mut network = on_panel(90.0, 1e7);
    network.add_effect(Separation {
        element: "mount".to_owned(),
        at: Some("panel".to_owned()),
        restitution: 0.0,
    });
    assert!(matches!(why(&network), NoFloor::Rest { .. }), "{:?}", why(&network));
}

#[test]
fn no_linear_pad_is_below_the_floor_of_the_travel_it_took() {
    let (mut closest, mut told) = (f64::INFINITY, 0);
    for at in 0..60 {
        let part = f64::from(at) / 59.0;
        let (stiffness, damping) = (10_f64.powf(5.0 + 2.0 * part), 1.0 + 2e3 * (PI * part).sin());
        for is_mounted in [false, true] {
            let mut network = on_fixed(stiffness, damping);
            if is_mounted {
                network = on_panel(30.0, 3e6);
                network.set_model(0, spring(stiffness) | dashpot(damping));
                network.add_effect(Gravity { acceleration: G0, start: GravityStart::Equilibrium });
            }
            let window = WindowWish::Run;
            let mut settings = SolveSettings::lasting(0.1);
            settings.measures = vec![
                MeasureWish::new("pad", PeakForce { window }),
                MeasureWish::new("head", PeakAcceleration { window }),
                MeasureWish::new("head", SeverityIndex { exponent: 2.5, window }),
                MeasureWish::new("head", Hic15 { window }),
            ];
            let run = network.solve_with(&settings).unwrap();
            let floors = floors(&network, 0.1, &[]).unwrap();
            let deepest = floors.deepest(&run).unwrap();
            let of_run = run.measures.iter().filter(|own| own.window_wish == Some(window));
            let parts = of_run.filter_map(|own| {
                let floor = floors.of(own, Some(deepest))?;
                // A run that ends before the body can be stopped says nothing.
                (floor.time < run.trajectory.t_end).then(|| own.value.unwrap() / floor.value)
            });
            let parts: Vec<f64> = parts.collect();
            assert!(parts.iter().all(|own| *own > 1.0 - 1e-9), "{parts:?}");
            told += parts.len();
            closest = parts.iter().copied().fold(closest, f64::min);
        }
    }
    // On a fixed support a pad of ζ = 0.404 is 4.1 % above.
    assert!(closest < 1.06 && told > 400, "{closest} {told}");
}

fn on_fixed(stiffness: f64, damping: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let pad = spring(stiffness) | dashpot(damping);
    network.connect("pad", head, network.ground(), pad).thickness = Some(0.02);
    network
}
