use std::f64::consts::PI;

use dashpot_dae::{Piece, Run, Silent, Waveform, methods};
use dashpot_rheology::Tree;

use super::{
    resolve::{Cut, cut, resolve},
    slice::slice,
};
use crate::{
    Model, Network, NetworkError, Node,
    elements::{Dashpot, Foam, Spring},
    layers::{Layer, Layers, MOST_SEGMENTS, Resolution},
    linear_model,
    model::stiffness::Stiffness,
    parameters::Kind as _,
    part,
};

const EPSILON: f64 = 8.0 * f64::EPSILON;

fn close(got: f64, expected: f64, tolerance: f64) {
    assert!((got - expected).abs() <= tolerance * expected.abs(), "{got} is not {expected}");
}

/// 10 mm of 100 cm² with a modulus of 10⁶ Pa and 100 kg/m³: K = 1 MN/m, m = 10 g, c = 100 m/s.
fn elastic() -> Layer {
    let (name, model) = ("foam".to_owned(), part(Spring { stiffness: 1e6 }));
    Layer { name, thickness: 0.01, area: 0.01, density: 100.0, model }
}

fn pad(all: Vec<Layer>, resolution: Resolution) -> Layers {
    Layers { all, resolution }
}

fn counts(all: Vec<Layer>, resolution: Resolution, struck: Option<f64>) -> Vec<usize> {
    pad(all, resolution).segments(struck).unwrap()
}

#[test]
fn an_elastic_layer_carries_waves_at_the_speed_of_sound() {
    for omega in [1.0, 1e5] {
        let wave = elastic().wave(omega).unwrap();
        close(wave.speed, 100.0, EPSILON);
        close(wave.transit, 1e-4, EPSILON);
        close(wave.impedance, 100.0 * 100.0 * 0.01, EPSILON);
        assert!(wave.decay.abs() < f64::MIN_POSITIVE);
    }
}

#[test]
fn a_viscous_layer_carries_diffusion_waves() {
    // K* = iωc: the wave number is √(ω m / c)·(1 − i)/√2 for each thickness.
    let (omega, damping) = (3e3, 50.0);
    let layer = Layer { model: part(Dashpot { damping }), ..elastic() };
    let wave = layer.wave(omega).unwrap();
    let number = (omega * layer.mass() / damping / 2.0).sqrt();
    close(wave.decay, number, EPSILON);
    close(wave.speed, omega * layer.thickness / number, EPSILON);
}

#[test]
fn there_are_no_waves_without_mass_or_stiffness_or_in_what_is_rigid() {
    assert_eq!(Layer { density: 0.0, ..elastic() }.wave(1e3), None);
    let soft = part(Spring { stiffness: 0.0 });
    assert_eq!(Layer { model: soft, ..elastic() }.wave(1e3), None);
    assert_eq!(Layer { model: part(crate::elements::Rigid), ..elastic() }.wave(1e3), None);
}

#[test]
fn stiffness_in_vibration_is_that_of_the_linear_model() {
    let zener = Tree::parallel([
        part(Spring { stiffness: 3e5 }),
        Tree::series([part(Spring { stiffness: 2e6 }), part(Dashpot { damping: 700.0 })]),
    ]);
    for omega in [1e-3, 10.0, 2e3, 1e7] {
        let (model, stiffness) = (linear_model(&zener), Stiffness::of(&zener, omega));
        close(stiffness.size() * stiffness.angle().cos(), model.storage(omega), 1e-14);
        close(stiffness.angle().tan(), model.loss_factor(omega), 1e-14);
    }
}

#[test]
fn slices_in_series_have_the_law_of_the_layer() {
    let zener = Tree::parallel([
        part(Spring { stiffness: 3e5 }),
        Tree::series([part(Spring { stiffness: 2e6 }), part(Dashpot { damping: 700.0 })]),
    ]);
    let slices: Model = Tree::series(vec![slice(&zener, 7.0); 7]);
    let (whole, sliced) = (linear_model(&zener), linear_model(&slices));
    for time in [0.0, 1e-4, 1e-3, 1.0] {
        close(sliced.relaxation(time), whole.relaxation(time), 1e-14);
    }
}

#[test]
fn the_chain_has_the_dispersion_that_the_accuracy_is_chosen_by() {
    // Standing waves of a chain whose faces are held, ω_j = (2/Δt) sin(jπ/2n), have the shape
    // sin(jπ(i − ½)/n) at the centres of the segments.
    let count = 9;
    let Cut { masses, models, .. } = cut(&pad(vec![elastic()], Resolution::Segments(9)), &[count]);
    let stiffness: Vec<f64> = models.iter().map(|model| Stiffness::of(model, 1.0).size()).collect();
    assert_eq!((masses.len(), stiffness.len()), (count, count + 1));
    close(masses.iter().sum(), elastic().mass(), EPSILON);
    close(1.0 / stiffness.iter().map(|own| 1.0 / own).sum::<f64>(), 1e6, EPSILON);
    let segment = 1e-4 / count as f64;
    for mode in 1..=count {
        let angle = PI * mode as f64 / count as f64;
        let omega = 2.0 / segment * (0.5 * angle).sin();
        let shape = |at: usize| match at {
            0 => 0.0,
            at if at > count => 0.0,
            at => (angle * (at as f64 - 0.5)).sin(),
        };
        for at in 1..=count {
            let pull = stiffness[at - 1] * (shape(at - 1) - shape(at))
                + stiffness[at] * (shape(at + 1) - shape(at));
            let inertia = -masses[at - 1] * omega * omega * shape(at);
            assert!((pull - inertia).abs() < 1e-13 * 4.0 * stiffness[1], "mode {mode}, mass {at}");
        }
    }
}

#[test]
fn the_accuracy_bounds_the_error_of_the_first_standing_wave() {
    for accuracy in [0.1, 0.01, 1e-3, 1e-6] {
        let count = counts(vec![elastic()], Resolution::Accuracy(accuracy), None)[0] as f64;
        let error = |count: f64| {
            let x = PI / (2.0 * count);
            1.0 - x.sin() / x
        };
        assert!(error(count) <= accuracy, "{accuracy}: {}", error(count));
        assert!(error(count - 1.0) > 0.9 * accuracy, "{accuracy}: too many");
    }
    assert_eq!(counts(vec![elastic()], Resolution::Accuracy(0.01), None), [7]);
}

#[test]
fn a_light_body_asks_for_more_segments_and_a_heavy_one_for_none() {
    let count = |mass| counts(vec![elastic()], Resolution::Accuracy(0.01), Some(mass))[0];
    assert_eq!(count(10.0), 7);
    // ω = √(K/mass) = 10⁵ rad/s, and a segment takes √0.24/ω.
    let exact = 1e-4 * 1e5 / 0.24_f64.sqrt();
    assert!((count(1e-4) as f64 - exact - 0.5).abs() <= 0.5, "{exact}");
}

#[test]
fn the_frequency_holds_for_stiffness_that_depends_on_it() {
    let model = Tree::parallel([part(Spring { stiffness: 1e6 }), part(Dashpot { damping: 100.0 })]);
    let pad = pad(vec![Layer { model, ..elastic() }], Resolution::Accuracy(0.01));
    let omega = pad.frequency(Some(10.0)).unwrap();
    let stiffness = 1e6_f64.hypot(100.0 * omega);
    close(omega, PI * (stiffness / pad.mass()).sqrt(), 1e-14);
}

#[test]
fn segments_are_shared_out_by_times_of_passage() {
    let slow = Layer { density: 900.0, ..elastic() };
    let massless = Layer { density: 0.0, ..elastic() };
    let all = || vec![elastic(), massless.clone(), slow.clone()];
    assert_eq!(counts(all(), Resolution::Segments(8), None), [2, 0, 6]);
    assert_eq!(counts(all(), Resolution::Segments(2), None), [1, 0, 1]);
    let error = pad(all(), Resolution::Segments(1)).segments(None).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("`segments` must be from 2, one for each layer, to {MOST_SEGMENTS}, but it is 1")
    );
    let error = pad(all(), Resolution::Accuracy(1e-12)).segments(None).unwrap_err();
    assert_eq!(error.parameter, "accuracy");
}

fn network(layers: Layers) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
    network.connect_layers("pad", head, network.ground(), layers);
    network
}

#[test]
fn masses_stand_between_the_branches_of_a_series() {
    let massless = Layer { density: 0.0, ..elastic() };
    let all = vec![elastic(), massless, elastic()];
    let mut network = network(pad(all, Resolution::Segments(5)));
    assert_eq!(network.connections()[0].thickness, Some(0.03));
    resolve(&mut network).unwrap();
    let pad = &network.connections()[0];
    let names: Vec<&str> = pad.model.branches().iter().map(|branch| &*branch.name).collect();
    assert_eq!(names, ["front", "1-2", "2-3", "3-4", "4-5", "back"]);
    let nodes: Vec<&Node> = pad.through.iter().map(|id| network.node(*id)).collect();
    let names: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["pad.1", "pad.2", "pad.3", "pad.4", "pad.5"]);
    close(nodes.iter().map(|node| node.mass).sum(), 0.02, EPSILON);
    // Half a segment of either layer, and the one without mass between them.
    let stiffness = 1.0 / (1.0 / 4e6 + 1.0 / 1e6 + 1.0 / 6e6);
    let halves = [Stiffness::of(&pad.model.branches()[2].tree, 1.0).size(), {
        Stiffness::of(&pad.model.branches()[3].tree, 1.0).size()
    }];
    assert!(halves.iter().any(|half| (half - stiffness).abs() < EPSILON * stiffness), "{halves:?}");
}

#[test]
fn a_pad_reports_the_force_on_its_face() {
    let network = network(pad(vec![elastic()], Resolution::Segments(4)));
    let assembly = network.compile(0.02).unwrap();
    let names: Vec<&str> =
        assembly.connections.iter().map(|connection| connection.name.as_str()).collect();
    assert_eq!(names, ["pad"]);
    assert_eq!(assembly.connections[0].primitives, 0..5);
    assert_eq!(assembly.system.states(), 10);
    let row = |name: &str| {
        let output = assembly.system.outputs.at(assembly.output(name).unwrap());
        (output.unknowns, output.scale)
    };
    assert_eq!(row("pad.force"), row("pad.front.force"));
    assert_ne!(row("pad.force"), row("pad.back.force"));
}

/// `∫₀ᶻ J₀ = (1/π) ∫₀^π sin(z sin θ)/sin θ dθ`; the midpoint rule converges exponentially for what
/// is periodic.
fn integral_of_bessel(z: f64) -> f64 {
    const POINTS: usize = 400;
    let term = |at: usize| {
        let sine = (PI * (at as f64 + 0.5) / POINTS as f64).sin();
        (z * sine).sin() / sine
    };
    (0..POINTS).map(term).sum::<f64>() / POINTS as f64
}

#[test]
fn a_face_that_is_pushed_at_a_constant_speed_feels_the_impedance() {
    // The force on the half spring at the end of a chain is v √(k m) ∫₀ᶻ J₀ with z = 2 t √(k/m),
    // until the wave comes back from the other end: a face that moves by v t is the centre of a
    // chain without end whose halves meet with 2 v, and there x₁′ = v (1 − J₀(z)).
    let (segments, speed) = (60, 2.0);
    let layers = pad(vec![elastic()], Resolution::Segments(segments));
    let impedance = elastic().wave(1.0).unwrap().impedance;
    let rate = segments as f64 / 1e-4;
    let duration = 0.5e-4;
    let line = Piece { slope: speed, ..Piece::default() };
    let mut network = Network::new();
    let head = Node::prescribed("head", Waveform::new(vec![line]).unwrap());
    let head = network.add_node(head);
    network.connect_layers("pad", head, network.ground(), layers);
    let assembly = network.compile(duration).unwrap();
    let exact = methods::by_name("exact").unwrap();
    let trajectory = exact.integrate(&assembly.system, &Run::to(duration), &mut Silent).unwrap();
    let force = trajectory.signal(&assembly.system, assembly.output("pad.force").unwrap());
    let plateau = speed * impedance;
    for at in 1..=50 {
        let time = duration * f64::from(at) / 50.0;
        let expected = plateau * integral_of_bessel(2.0 * rate * time);
        let error = (force.value(time) - expected).abs();
        assert!(error <= force.error.unwrap() + 1e-12 * plateau, "{error:e} at {time} s");
        let ripple = (2.0 / (PI * 2.0 * rate * time)).sqrt();
        assert!((expected / plateau - 1.0).abs() <= ripple, "{ripple} at {time} s");
    }
}

#[test]
fn a_pad_without_mass_stays_what_it_is() {
    let massless = Layer { density: 0.0, ..elastic() };
    let mut network = network(pad(vec![massless; 2], Resolution::Accuracy(0.01)));
    let before = network.clone();
    resolve(&mut network).unwrap();
    assert_eq!(network.nodes().count(), before.nodes().count());
    assert!(network.connections()[0].through.is_empty());
    close(linear_model(&network.connections()[0].model).equilibrium_stiffness(), 5e5, EPSILON);
}

#[test]
fn layers_out_of_range_are_refused_by_the_name_of_the_pad() {
    let refusal = |layer: Layer, resolution| {
        let error = resolve(&mut network(pad(vec![layer], resolution))).unwrap_err();
        let NetworkError::Invalid { invalid, .. } = error else { panic!("{error}") };
        invalid.parameter
    };
    let fine = Resolution::Accuracy(0.01);
    assert_eq!(refusal(Layer { thickness: 0.0, ..elastic() }, fine), "thickness");
    assert_eq!(refusal(Layer { area: f64::NAN, ..elastic() }, fine), "area");
    assert_eq!(refusal(Layer { density: -1.0, ..elastic() }, fine), "density");
    assert_eq!(refusal(elastic(), Resolution::Accuracy(0.0)), "accuracy");
}

#[test]
fn a_layer_that_is_not_linear_wants_its_number_of_segments() {
    let foam = Layer { model: part(Foam::sample()), ..elastic() };
    let asked = |layer: &Layer, resolution| pad(vec![elastic(), layer.clone()], resolution);
    let error = asked(&foam, Resolution::Accuracy(0.01)).segments(None).unwrap_err();
    assert_eq!(error.parameter, "segments");
    assert!(error.to_string().contains("the layer foam is not linear"), "{error}");
    assert_eq!(
        asked(&foam, Resolution::Segments(6)).segments(None).unwrap().iter().sum::<usize>(),
        6
    );
    // Without mass there are no waves.
    let light = Layer { density: 0.0, ..foam.clone() };
    assert!(asked(&light, Resolution::Accuracy(0.01)).segments(None).is_ok());
    // A speed is told of the one that has one.
    let network = network(asked(&foam, Resolution::Segments(6)));
    let all = super::resolved(&network, &network.connections()[0]).unwrap();
    assert!(all[0].wave.is_some() && all[1].wave.is_none());
    let warnings = super::warnings(&struck(&foam), 0.01);
    assert!(warnings[0].to_string().contains("which is not linear"), "{warnings:?}");
}

/// A network in which a body of 5 kg strikes this layer.
fn struck(layer: &Layer) -> Network {
    network(pad(vec![layer.clone()], Resolution::Segments(3)))
}
