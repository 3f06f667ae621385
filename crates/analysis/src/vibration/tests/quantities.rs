//! Quantities of elements and of driving points: closed forms, balances, limits.

use super::*;

const ZETA: f64 = 0.3;

/// A mass on a Kelvin–Voigt element on a seat of a mass of its own, which is moved; a ram pushes the mass.
fn seated(seat_mass: f64) -> Network {
    let mut network = Network::new();
    let mut seat = Node::prescribed("seat", Waveform::constant(0.0));
    seat.mass = seat_mass;
    let seat = network.add_node(seat);
    let body = network.add_node(Node::mass("body", MASS));
    network.connect("mount", body, seat, kelvin_voigt(ZETA));
    network.add_load("ram", body, Waveform::constant(0.0));
    network
}

fn looked_at(network: &Network, drive: &str, of: &[&str], [from, to]: [f64; 2]) -> Sweep {
    let vibration = Vibration::new(network, 1.0, Some(drive)).unwrap();
    let of = of.iter().map(|own| (*own).to_owned()).collect();
    vibration.sweep(&SweepSettings { of, ..range(from, to, 40) }).unwrap()
}

/// Complex stiffness of the mount.
fn stiffness(s: C) -> C {
    s * (2.0 * ZETA * (STIFFNESS * MASS).sqrt()) + STIFFNESS
}

/// Holds a response to its closed form: to `relative`, and within its stated error but for roundings of the form.
#[track_caller]
fn follows(sweep: &Sweep, at: usize, form: impl Fn(C) -> C, relative: f64) {
    let own = &sweep.transmissions[at];
    for (frequency, swing) in sweep.frequencies.iter().zip(&own.swings) {
        let swing = swing.unwrap();
        let exact = form(C::new(0.0, TAU * frequency));
        let off = (C::from_polar(swing.amplitude, swing.phase) - exact).norm();
        let allowed = (relative * exact.norm()).min(swing.error + 1e-14 * exact.norm());
        assert!(off <= allowed, "{} at {frequency} Hz: {off:e} of {exact}", own.name);
    }
}

fn rest(sweep: &Sweep, at: usize) -> f64 {
    sweep.transmissions[at].at_rest.unwrap().amplitude
}

#[test]
fn driving_point_of_a_moved_seat_is_the_closed_form_and_its_mass_at_rest() {
    for seat_mass in [0.0, 0.7] {
        let of = ["seat.apparent-mass", "seat.impedance", "seat.dynamic-stiffness", "seat.force"];
        let sweep = looked_at(&seated(seat_mass), "seat", &of, [0.03, 3e3]);
        let apparent = |s: C| {
            let link = stiffness(s);
            link / (link + s * s * MASS) * MASS + seat_mass
        };
        // Above its resonance less than the mass of the seat is the difference of inertia and force.
        follows(&sweep, 0, apparent, 1e-12);
        follows(&sweep, 1, |s| apparent(s) * s, 1e-12);
        follows(&sweep, 2, |s| apparent(s) * s * s, 1e-12);
        follows(&sweep, 3, |s| (apparent(s) - seat_mass) * s * s * -1.0, 1e-11);
        assert!((rest(&sweep, 0) / (MASS + seat_mass) - 1.0).abs() < 1e-12);
        assert!([1, 2].iter().all(|&at| rest(&sweep, at) == 0.0));
        let units: Vec<&str> = sweep.transmissions.iter().map(|own| own.unit).collect();
        assert_eq!(units, ["kg", "N s/m", "N/m", "N/m"]);
    }
}

#[test]
fn driving_point_of_a_load_is_the_closed_form_with_its_limits() {
    let of =
        ["body.dynamic-stiffness", "body.impedance", "body.apparent-mass", "body.displacement"];
    let sweep = looked_at(&seated(0.0), "ram", &of, [0.03, 3e4]);
    let dynamic = |s: C| stiffness(s) + s * s * MASS;
    follows(&sweep, 0, dynamic, 1e-12);
    follows(&sweep, 1, |s| dynamic(s) / s, 1e-12);
    follows(&sweep, 2, |s| dynamic(s) / (s * s), 1e-12);
    follows(&sweep, 3, |s| dynamic(s).inv(), 1e-12);
    // At rest the static stiffness; far above the resonance the mass.
    assert!((rest(&sweep, 0) / STIFFNESS - 1.0).abs() < 1e-14);
    assert_eq!(sweep.transmissions[2].at_rest, None);
    let high = sweep.transmissions[2].swings.last().unwrap().unwrap();
    assert!((high.amplitude / MASS - 1.0).abs() < 1e-3);
}

#[test]
fn free_body_has_its_whole_mass_at_rest() {
    let mut network = Network::new();
    let [one, two] =
        [("one", 1.25), ("two", MASS)].map(|(name, mass)| network.add_node(Node::mass(name, mass)));
    network.connect("link", one, two, kelvin_voigt(ZETA));
    network.add_load("ram", one, Waveform::constant(0.0));
    let sweep = looked_at(&network, "ram", &["one.apparent-mass"], [0.1, 1e3]);
    let apparent = |s: C| {
        let link = stiffness(s);
        link / (link + s * s * MASS) * MASS + 1.25
    };
    follows(&sweep, 0, apparent, 1e-9);
    assert!((rest(&sweep, 0) / (MASS + 1.25) - 1.0).abs() < 1e-6);
}

#[test]
fn quarter_car_has_the_travel_and_the_force_of_its_two_equations() {
    let (network, _) = two_masses();
    let of = ["pad.deformation", "mount.force", "pad.power", "mount.power"];
    let sweep = looked_at(&network, "ground", &of, [0.5, 200.0]);
    let solved = |s: C| {
        let (pad, base) = (s * 30.0 + 2e4, s * 80.0 + 9e4);
        let square = s * s;
        let below = (square * 5.0 + pad + base) * (square * MASS + pad) - pad * pad;
        // Written so that nothing cancels in slow oscillation.
        let travel = -base * square * MASS / below;
        (travel, -square * (square * 5.0 * MASS + pad * (5.0 + MASS)) / below, base)
    };
    let (travel, between) = (|s: C| solved(s).0, |s: C| solved(s).1);
    follows(&sweep, 0, travel, 1e-9);
    follows(&sweep, 1, |s| between(s) * solved(s).2, 1e-9);
    follows(&sweep, 2, |s| (0.5 * 30.0 * (s * travel(s)).norm_sqr()).into(), 1e-9);
    follows(&sweep, 3, |s| (0.5 * 80.0 * (s * between(s)).norm_sqr()).into(), 1e-9);
    assert_eq!(sweep.transmissions.iter().filter(|own| own.has_phase).count(), 2);
    assert!([0, 2].iter().all(|&at| rest(&sweep, at) == 0.0));
}

#[test]
fn half_of_the_power_of_a_mount_is_the_damping_over_the_mass() {
    // P = ½ c ω²/|k − m ω² + i c ω|²: 1/(2 c) at its top, and half of that over a band of c/m.
    for zeta in [1e-5, 1e-3, 0.1, 0.7, 3.0] {
        let mut network = mount(kelvin_voigt(zeta));
        let device = network.node_named("device").unwrap();
        network.add_load("ram", device, Waveform::constant(0.0));
        let sweep = looked_at(&network, "ram", &["mount.power"], [0.01, 1e5]);
        let [top] = sweep.transmissions[0].resonances[..] else { panic!("{zeta}") };
        let damping = 2.0 * zeta * (STIFFNESS * MASS).sqrt();
        let off = (top.frequency - natural() / TAU).abs();
        assert!(off <= top.frequency_error + 4.0 * f64::EPSILON * top.frequency, "{zeta}: {off:e}");
        assert!((top.swing.unwrap().amplitude * 2.0 * damping - 1.0).abs() < 1e-10, "{zeta}");
        let [low, high] = top.band.unwrap();
        let width = (high - low) * TAU * MASS / damping;
        assert!((width - 1.0).abs() < 1e-11_f64.max(1e-12 / zeta), "{zeta}: {width}");
    }
}

#[test]
fn powers_of_all_elements_are_what_the_drive_puts_in() {
    let (mut network, device) = two_masses();
    let inner = Model::series([spring(3e4), Model::parallel([dashpot(9.0), spring(1e4)])]);
    network.connect("tie", device, network.ground(), inner);
    network.add_load("ram", device, Waveform::constant(0.0));
    for drive in ["ram", "ground"] {
        let vibration = Vibration::new(&network, 1.0, Some(drive)).unwrap();
        let of: Vec<String> = ["pad.power", "mount.power", "tie.power"].map(str::to_owned).to_vec();
        let sweep = vibration.sweep(&SweepSettings { of, ..range(0.3, 300.0, 20) }).unwrap();
        for (at, frequency) in sweep.frequencies.iter().enumerate() {
            let amplitude = 0.02;
            let steady = vibration.steady(*frequency, amplitude).unwrap();
            let sum = steady.elements.iter().map(|own| own.power).sum::<f64>();
            let swept = sweep.transmissions.iter().map(|own| own.swings[at].unwrap());
            let swept = swept.map(|own| own.amplitude * amplitude * amplitude).sum::<f64>();
            assert!((swept / sum - 1.0).abs() < 1e-12, "{drive} {frequency}");
            // What the drive puts in is a small part of what goes to and fro far from the resonances.
            let power = steady.power.unwrap();
            assert!((power / sum - 1.0).abs() < 1e-9, "{drive} {frequency}: {power} {sum}");
        }
    }
}

#[test]
fn what_drives_and_what_is_read_change_places() {
    let (mut network, device) = two_masses();
    let panel = network.node_named("panel").unwrap();
    let wall = network.add_node(Node::fixed("wall"));
    network.connect("tie", device, wall, kelvin_voigt(0.05));
    network.add_load("ram", device, Waveform::constant(0.0));
    network.add_load("fist", panel, Waveform::constant(0.0));
    let pairs = [
        [("ram", "panel.displacement"), ("fist", "device.displacement")],
        // Dynamic transfer stiffness of ISO 10846: the blocking force over the motion of the other end.
        [("ground", "wall.force"), ("wall", "ground.force")],
    ];
    for pair in pairs {
        let [one, other] =
            pair.map(|(drive, of)| looked_at(&network, drive, &[of], [0.1, 3e3]).transmissions);
        for (one, other) in one[0].swings.iter().zip(&other[0].swings) {
            let [one, other] = [one.unwrap(), other.unwrap()];
            let off = (C::from_polar(one.amplitude, one.phase)
                - C::from_polar(other.amplitude, other.phase))
            .norm();
            assert!(off <= one.error + other.error + 1e-14 * one.amplitude, "{pair:?}: {off:e}");
            assert!(one.error < 1e-6 * one.amplitude, "{pair:?}: {one:?}");
        }
    }
}

#[test]
fn antiresonance_without_damping_is_a_stiffness_without_limit() {
    let mut network = mount(spring(STIFFNESS));
    let device = network.node_named("device").unwrap();
    let absorber = network.add_node(Node::mass("absorber", 0.1 * MASS));
    network.connect("root", absorber, device, spring(0.05 * STIFFNESS));
    network.add_load("ram", device, Waveform::constant(0.0));
    let sweep = looked_at(&network, "ram", &["device.dynamic-stiffness"], [1.0, 200.0]);
    let [top] = sweep.transmissions[0].resonances[..] else { panic!() };
    assert_eq!((top.swing, top.band), (None, None));
    let exact = natural() * 0.5_f64.sqrt() / TAU;
    assert!((top.frequency - exact).abs() <= top.frequency_error + 1e-14 * exact, "{top:?}");
}

#[test]
fn responses_at_one_frequency_follow_their_closed_forms_within_and_beyond_the_range() {
    let network = seated(0.0);
    let vibration = Vibration::new(&network, 1.0, Some("seat")).unwrap();
    for at in [0.01, 16.0, 3e4] {
        let of = ["body", "mount.force", "mount.power"].map(str::to_owned).to_vec();
        let settings = SweepSettings { of, at: Some(at), ..range(1.0, 200.0, 4) };
        let sweep = vibration.sweep(&settings).unwrap();
        let s = C::new(0.0, TAU * at);
        let moved = stiffness(s) / (stiffness(s) + s * s * MASS);
        let power = 0.5 * (stiffness(s) - STIFFNESS).im * s.im * (moved - 1.0).norm_sqr();
        let exact = [moved, moved * s * s * MASS, power.into()];
        for (own, exact) in sweep.transmissions.iter().zip(exact) {
            let own = own.at.unwrap();
            let off = (own.amplitude - exact.norm()).abs();
            assert!(off <= own.error + 1e-13 * exact.norm(), "{at} Hz: {own:?} of {exact}");
        }
    }
}

#[test]
fn quantity_that_is_not_there_is_refused_with_those_that_are() {
    let network = seated(0.0);
    let refused = |drive, name: &str| {
        let vibration = Vibration::new(&network, 1.0, Some(drive)).unwrap();
        vibration.quantities(&[name.to_owned()]).unwrap_err().to_string()
    };
    assert_eq!(
        refused("seat", "pad.force"),
        "`pad` is no support or element; there are seat, mount"
    );
    assert_eq!(
        refused("ram", "seat.impedance"),
        "`seat` is no node that the drive moves; there is only `body`"
    );
    // Which quantities there are of what is named.
    let there_are = "there are mount.force, mount.deformation, mount.power";
    assert_eq!(refused("seat", "mount"), format!("`mount` is no node that can move; {there_are}"));
    assert_eq!(
        refused("seat", "mount.froce"),
        format!("`mount.froce` is no quantity; did you mean `mount.force`? {there_are}")
    );
    assert_eq!(
        refused("seat", "mont.force"),
        "`mont` is no support or element; did you mean `mount`? there are seat, mount"
    );
    let vibration = Vibration::new(&mount(spring(1.0)), 1.0, Some("ground")).unwrap();
    let text = vibration.quantities(&["mount.power".to_owned()]).unwrap_err().to_string();
    assert_eq!(text, "`mount` is no element with a dashpot; there is none");
}
