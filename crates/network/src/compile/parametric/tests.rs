use dashpot_numerics::LinearForm;
use dashpot_rheology::Tree;

use super::{
    ParametricSystem,
    traced::{Recorder, Traced},
};
use crate::{
    Model, Network, Node, dashpot,
    effects::{Gravity, GravityStart},
    spring,
};

const DURATION: f64 = 0.02;
const STATES: usize = 12;

/// A pad of numbers that are varied by what it is given.
type Pad<'p> = dyn Fn(&mut dyn FnMut(f64) -> f64) -> Model + 'p;

/// A mass on `pad` on another one, whose numbers all differ by other parts of `by`.
fn padded(pad: &Pad<'_>, by: f64) -> Network {
    let mut power = 0.0;
    let mut number = |value: f64| {
        power += 1.0;
        value * by.powf(1.0 / power)
    };
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", number(10.0)).moving(number(10.0)));
    let panel = network.add_node(Node::mass("panel", number(100.0)));
    let pad = pad(&mut number);
    network.connect("padding", head, panel, pad);
    let mount = spring(number(5e7)) | dashpot(number(1e4));
    network.connect("mount", panel, network.ground(), mount);
    network
}

/// Rates and the force of the padding over unknowns in SI units, as they are assembled anew and as a form with other numbers gives
/// them, agree to rounding.
fn agrees(network: &dyn Fn(f64) -> Network) {
    let form = ParametricSystem::of(&network(1.0), DURATION).unwrap();
    let mut instance = form.instance::<STATES>().unwrap();
    for by in [1.0, 1.3, 0.7, 2.0] {
        let network = network(by);
        let numbers = form.numbers(&network).unwrap();
        assert!(form.fill(&numbers, &mut instance));
        let assembly = network.compile(DURATION).unwrap();
        let system = &assembly.system;
        assert_eq!((system.states(), system.algebraic()), (form.unknowns(), 0));
        let scales: Vec<f64> = system.unknowns.iter().map(|own| own.scale).collect();
        let mut w = vec![0.0; system.inputs.len()];
        system.inputs_at(0.0, 0.0, &mut w);
        let close = |own: f64, anew: f64, size: f64| {
            assert!((own - anew).abs() <= 64.0 * f64::EPSILON * size, "{own:e}, {anew:e} by {by}");
        };
        for (row, scale) in scales.iter().enumerate() {
            let mut anew = vec![0.0; form.states()];
            let jacobian = system.jacobian.row(row);
            for (&column, value) in jacobian.col_indices().iter().zip(jacobian.values()) {
                anew[column] = value * scale / (system.time_scale * scales[column]);
            }
            let given = system.input_matrix.row(row);
            for (&column, value) in given.col_indices().iter().zip(given.values()) {
                anew[scales.len()] += value * w[column] * scale / system.time_scale;
            }
            let size = anew.iter().map(|own| own.abs()).fold(0.0, f64::max);
            for (column, anew) in anew.into_iter().enumerate() {
                let unit = form.scales[row] / (form.scales[column] * form.time_scale());
                close(instance.matrix[column][row] * unit, anew, size);
            }
        }
        let force = system.outputs.at(assembly.output("padding.force").unwrap());
        let anew = |at: usize| force.scale * force.unknowns.coefficient(at) / scales[at];
        let size = (0..scales.len()).map(|at| anew(at).abs()).fold(0.0, f64::max);
        for at in 0..scales.len() {
            close(instance.force[at] / form.scales[at], anew(at), size);
        }
    }
}

#[test]
fn other_numbers_make_the_rows_that_are_assembled_of_them() {
    let burgers = |number: &mut dyn FnMut(f64) -> f64| {
        let kelvin = spring(number(2e7)) | dashpot(number(4e3));
        Tree::series([spring(number(2e7)), dashpot(number(6e3)), kelvin])
    };
    agrees(&|by| padded(&burgers, by));
    let ladder = |number: &mut dyn FnMut(f64) -> f64| {
        let maxwell = |k: f64, c: f64| spring(k) + dashpot(c);
        let first = maxwell(number(3e5), number(500.0)) | dashpot(number(200.0));
        let second = maxwell(number(1e6), number(90.0)) | spring(number(4e4));
        Tree::parallel([first + second, maxwell(number(2e4), number(7e3)), spring(number(1e4))])
    };
    agrees(&|by| padded(&ladder, by));
}

#[test]
fn places_that_springs_alone_hold_follow_from_their_balance() {
    let row = |number: &mut dyn FnMut(f64) -> f64| {
        let series = Tree::series([spring(number(1e5)), spring(number(3e5)), spring(number(2e5))]);
        Tree::parallel([series, dashpot(number(300.0))])
    };
    agrees(&|by| padded(&row, by));
}

#[test]
fn a_constant_force_acts_in_a_slot_of_its_own() {
    agrees(&|by| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 10.0 * by).moving(3.0));
        let pad = (spring(1e5 * by.sqrt()) + dashpot(400.0)) | spring(2e4);
        network.connect("padding", head, network.ground(), pad);
        let start = GravityStart::Equilibrium;
        network.add_effect(Gravity { acceleration: 9.81 * by, start });
        network
    });
}

#[test]
fn what_is_zero_for_all_numbers_disappears_and_nothing_else() {
    let recorder = Recorder::default();
    let [a, b, c, d] = [0, 1, 2, 3].map(|at| recorder.number(at));
    let is_zero =
        |terms: &[Traced<'_>]| LinearForm::sum(terms.iter().map(|own| (0, *own))).is_zero();
    assert!(is_zero(&[a / (a + b), b / (a + b), Traced::from(-1.0)]));
    assert!(is_zero(&[a / b, a / b, a / b * -2.0]));
    assert!(!is_zero(&[a, b * -1.0]));
    // Of numbers at equal distances these would cancel.
    assert!(!is_zero(&[a, b * -1.0, c * -1.0, d]));
}
