//! Chains of Kelvin–Voigt elements, whose times lie up to thirteen decades apart, and nests of them.

use dashpot_dae::{Piece, Run, Signal, Silent, Waveform, methods};
use dashpot_numerics::DoubleDouble;
use dashpot_rheology::LinearModel;
use nalgebra_sparse::SparseEntry;

use super::{dashpot, spring};
use crate::{Assembly, Model, Network, Node, linear_model};

const FRONTS: [&[Front]; 4] =
    [&[], &[Front::Spring], &[Front::Dashpot], &[Front::Spring, Front::Dashpot]];
const SIZES: [u32; 3] = [4, 8, 12];
const DECADES: [u32; 4] = [6, 10, 12, 13];
/// A mass \[kg\] that swings for seconds on such a chain.
const MASS: f64 = 1e6;

/// What stands before the elements.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Front {
    Spring,
    Dashpot,
}

/// Stiffness and damping of the parts of a chain, in order.
fn parts(front: &[Front], count: u32, decades: u32, even: bool) -> Vec<(f64, f64)> {
    let power = |exponent: i32| -> f64 { format!("1e{exponent}").parse().unwrap() };
    let mut parts: Vec<(f64, f64)> = front
        .iter()
        .map(|part| match part {
            Front::Spring => (3e6, 0.0),
            Front::Dashpot => (0.0, 7e6),
        })
        .collect();
    for i in 0..count {
        let share =
            if even { f64::from(1 + (7 * i) % 5) } else { power((5 * i % 4).cast_signed()) };
        let exponent = (decades * i / (count - 1)).cast_signed() - (decades / 2).cast_signed();
        let stiffness = 1e6 * share;
        parts.push((stiffness, stiffness * power(exponent) * f64::from(1 + i % 3)));
    }
    parts
}

fn model(parts: &[(f64, f64)]) -> Model {
    Model::series(parts.iter().map(|&part| match part {
        (stiffness, 0.0) => spring(stiffness),
        (0.0, damping) => dashpot(damping),
        (stiffness, damping) => Model::parallel([spring(stiffness), dashpot(damping)]),
    }))
}

/// All fronts, sizes, widths and both ways to choose the stiffnesses.
fn all(mut visit: impl FnMut(&[Front], u32, u32, bool)) {
    for front in FRONTS {
        for count in SIZES {
            for decades in DECADES {
                visit(front, count, decades, true);
                visit(front, count, decades, false);
            }
        }
    }
}

/// Times \[s\] from before the fastest to after the slowest element.
fn instants(decades: u32) -> impl Iterator<Item = f64> {
    let half = (decades / 2).cast_signed();
    (-half..=half).map(|exponent| 10_f64.powi(exponent))
}

fn end(decades: u32) -> f64 {
    3.0 * 10_f64.powi((decades / 2).cast_signed())
}

enum Head {
    Loaded,
    Held,
    Drawn,
    Striking,
}

/// The chain between a head and the ground.
fn compiled(head: &Head, model: Model, duration: f64) -> Assembly {
    let mut network = Network::new();
    let node = match head {
        Head::Loaded => Node::massless("head"),
        Head::Held => Node::prescribed("head", Waveform::constant(1.0)),
        Head::Drawn => {
            let line = Piece { slope: 1.0, ..Piece::default() };
            Node::prescribed("head", Waveform::new(vec![line]).unwrap())
        }
        Head::Striking => Node::mass("head", MASS).moving(1.0),
    };
    let node = network.add_node(node);
    if let Head::Loaded = head {
        network.add_load("load", node, Waveform::constant(1.0));
    }
    network.connect("pad", node, network.ground(), model);
    network.compile(duration).unwrap()
}

fn exact(assembly: &Assembly, output: &str, duration: f64) -> Signal {
    let exact = methods::by_name("exact").unwrap();
    let trajectory = exact.integrate(&assembly.system, &Run::to(duration), &mut Silent).unwrap();
    trajectory.signal(&assembly.system, assembly.output(output).unwrap())
}

/// Checks that the signal is right within the error that it states, and the rounding of `expected`.
fn follows(signal: &Signal, expected: &[(f64, f64)], what: &str) {
    let largest = expected.iter().map(|pair| pair.1.abs()).fold(0.0, f64::max);
    let stated = signal.error.unwrap() + 1e-14 * largest;
    for &(time, expected) in expected {
        let error = (signal.value(time) - expected).abs();
        assert!(error <= stated, "{what} at {time} s: {error:e}, stated {stated:e}");
    }
}

/// Rows over the unknowns in SI.
type Dense = Vec<DoubleDouble>;

fn added(rows: impl Iterator<Item = (DoubleDouble, Dense)>, size: usize) -> Dense {
    rows.fold(vec![DoubleDouble::ZERO; size], |sum, (factor, row)| {
        sum.iter().zip(&row).map(|(&sum, &own)| sum + factor * own).collect()
    })
}

/// The equations of a mass on a chain from the deformations of its parts: with the force `F` of the
/// chain each part is compressed at the rate `(F − K y)/C`, and all rates add up to the velocity.
fn equations(parts: &[(f64, f64)], deformation: &[Dense], velocity: &Dense) -> (Dense, Vec<Dense>) {
    let size = velocity.len();
    let one = DoubleDouble::ONE;
    let damped = || parts.iter().zip(deformation).filter(|(part, _)| part.1 > 0.0);
    let force = if let Some(at) = parts.iter().position(|part| part.1 == 0.0) {
        added([(DoubleDouble::from(parts[at].0), deformation[at].clone())].into_iter(), size)
    } else {
        let fluidity: DoubleDouble =
            damped().map(|(part, _)| DoubleDouble::from(part.1).recip()).sum();
        let flowing =
            damped().map(|(part, row)| (DoubleDouble::quotient(part.0, part.1), row.clone()));
        let total = added(flowing.chain([(one, velocity.clone())]), size);
        added([(fluidity.recip(), total)].into_iter(), size)
    };
    let mut rates: Vec<Dense> = Vec::new();
    for (part, row) in parts.iter().zip(deformation) {
        let terms = [(one, force.clone()), (-DoubleDouble::from(part.0), row.clone())];
        let net = added(terms.into_iter(), size);
        let fluidity =
            if part.1 > 0.0 { DoubleDouble::from(part.1).recip() } else { DoubleDouble::ZERO };
        rates.push(added([(fluidity, net)].into_iter(), size));
    }
    if let Some(at) = parts.iter().position(|part| part.1 == 0.0) {
        let others = rates.iter().map(|rate| (-one, rate.clone())).chain([(one, velocity.clone())]);
        rates[at] = added(others.collect::<Vec<_>>().into_iter(), size);
    }
    (force, rates)
}

#[test]
fn every_coefficient_of_a_mass_on_a_chain_is_right_to_its_last_digits() {
    all(|front, count, decades, even| {
        let parts = parts(front, count, decades, even);
        let assembly = compiled(&Head::Striking, model(&parts), end(decades));
        let system = &assembly.system;
        let size = system.len();
        let scale = |at: usize| system.unknowns[at].scale;
        let find =
            |name: &str| system.unknowns.iter().position(|unknown| unknown.name == name).unwrap();
        let (place, speed) = (find("position of head"), find("velocity of head"));
        let single = |at: usize| {
            let mut row = vec![DoubleDouble::ZERO; size];
            row[at] = DoubleDouble::ONE;
            row
        };
        let mut primitives = assembly.primitives.iter();
        let deformation: Vec<Dense> = parts
            .iter()
            .map(|part| {
                let output = system.outputs.at(primitives.next().unwrap().deformation);
                if part.0 > 0.0 && part.1 > 0.0 {
                    primitives.next();
                }
                let entry = |at: usize| output.scale * output.unknowns.coefficient(at) / scale(at);
                (0..size).map(|at| DoubleDouble::from(entry(at))).collect()
            })
            .collect();
        let (force, rates) = equations(&parts, &deformation, &single(speed));
        let mut expected: Vec<Option<Dense>> = vec![None; size];
        expected[place] = Some(single(speed));
        expected[speed] = Some(force.iter().map(|&own| -(own / MASS)).collect());
        for (row, rate) in deformation.iter().zip(&rates) {
            let own: Vec<usize> = (0..size).filter(|&at| row[at].high() != 0.0).collect();
            if let [at] = own[..] {
                expected[at] = Some(rate.iter().map(|&rate| rate * row[at]).collect());
            }
        }
        for (i, expected) in expected.iter().enumerate() {
            let expected = expected.as_ref().unwrap();
            let largest = expected.iter().map(|own| own.high().abs()).fold(0.0, f64::max);
            for (j, &expected) in expected.iter().enumerate() {
                let entry = system.jacobian.get_entry(i, j).map_or(0.0, SparseEntry::into_value);
                let found = entry * scale(i) / (scale(j) * system.time_scale);
                let error = (expected - found).high().abs();
                let rounding = 2.0 * f64::EPSILON * expected.high().abs() + 1e-28 * largest;
                let names = (&system.unknowns[i].name, &system.unknowns[j].name);
                assert!(error <= rounding, "{parts:?} {names:?}: {found:e}, {expected:?}");
            }
        }
    });
}

#[test]
fn the_exact_method_knows_its_error_where_a_chain_creeps() {
    all(|front, count, decades, even| {
        let parts = parts(front, count, decades, even);
        let creep = |time: f64| -> f64 {
            let of = |&(stiffness, damping): &(f64, f64)| match (stiffness, damping) {
                (0.0, damping) => time / damping,
                (stiffness, 0.0) => 1.0 / stiffness,
                _ => -(-time * stiffness / damping).exp_m1() / stiffness,
            };
            parts.iter().map(of).sum()
        };
        let expected: Vec<(f64, f64)> = instants(decades).map(|time| (time, creep(time))).collect();
        let assembly = compiled(&Head::Loaded, model(&parts), end(decades));
        let signal = exact(&assembly, "head.position", end(decades));
        let what = format!("{front:?}, {count} over {decades}");
        follows(&signal, &expected, &what);
        let largest = expected[expected.len() - 1].1;
        if !front.contains(&Front::Dashpot) {
            assert!(signal.error.unwrap() <= 1e-12 * largest, "{what}: {:?}", signal.error);
        }
    });
}

/// The force under a deformation of 1 m, or one that rises by 1 m/s.
fn resistance(model: &LinearModel, head: &Head, time: f64) -> f64 {
    let Head::Drawn = head else { return model.relaxation(time) };
    let form = model.maxwell().unwrap();
    let delayed = form.elements().into_iter().map(|element| {
        let rate = element.rate.high();
        element.stiffness * -(-rate * time).exp_m1() / rate
    });
    form.dashpot() + form.spring() * time + delayed.sum::<f64>()
}

#[test]
fn the_exact_method_knows_its_error_where_a_chain_relaxes() {
    all(|front, count, decades, even| {
        // Wider ones take the exact method seconds each, for a bound that says little.
        if decades > 10 && count > 4 {
            return;
        }
        let head = if front.contains(&Front::Spring) { Head::Held } else { Head::Drawn };
        let model = model(&parts(front, count, decades, even));
        let known = linear_model(&model);
        let expected: Vec<(f64, f64)> =
            instants(decades).map(|time| (time, resistance(&known, &head, time))).collect();
        let assembly = compiled(&head, model, end(decades));
        let signal = exact(&assembly, "pad.force", end(decades));
        follows(&signal, &expected, &format!("{front:?}, {count} over {decades}"));
    });
}

#[test]
fn the_exact_method_knows_its_error_where_chains_are_nested() {
    for decades in DECADES {
        let chain = |count, even| model(&parts(&[Front::Spring], count, decades, even));
        let maxwell = Model::series([spring(2e6), dashpot(5e4)]);
        let branches = Model::parallel([chain(5, true), maxwell, chain(3, false)]);
        let model = Model::series([branches, spring(4e6), chain(2, true)]);
        let known = linear_model(&model);
        for (head, output) in [(Head::Loaded, "head.position"), (Head::Held, "pad.force")] {
            let value = |time| match head {
                Head::Loaded => known.creep(time),
                _ => known.relaxation(time),
            };
            let expected: Vec<(f64, f64)> =
                instants(decades).map(|time| (time, value(time))).collect();
            let assembly = compiled(&head, model.clone(), end(decades));
            follows(&exact(&assembly, output, end(decades)), &expected, output);
        }
    }
}

/// Front, size, decades, whether even, and displacements \[m\].
type Impact = (&'static [Front], u32, u32, bool, [f64; 5]);

/// Displacement \[m\] of the mass at 1 ms, 1 s, 10 s, 100 s and 10⁴ s by `chains.py`.
const IMPACTS: [Impact; 9] = [
    (
        &[],
        4,
        6,
        true,
        [
            0.000_999_999_334_792_884_7,
            0.867_014_042_036_988_5,
            0.643_576_732_107_385_3,
            -0.123_631_046_144_221_64,
            2.269_980_418_482_682_6e-08,
        ],
    ),
    (
        &[],
        8,
        12,
        false,
        [
            0.000_999_999_847_399_453_5,
            0.869_845_073_583_953_8,
            0.307_239_395_370_279_2,
            0.000_239_939_134_208_735_5,
            3.683_769_311_571_2e-07,
        ],
    ),
    (
        &[],
        12,
        13,
        true,
        [
            0.000_999_999_890_377_202_4,
            0.940_978_230_042_761,
            -1.050_501_588_275_686,
            -0.262_826_435_402_523_54,
            1.990_989_997_330_848_8e-05,
        ],
    ),
    (
        &[Front::Spring],
        4,
        6,
        true,
        [
            0.000_999_999_700_121_946_4,
            0.894_847_889_258_527_4,
            1.122_106_534_191_721_8,
            0.258_332_391_256_917_87,
            2.269_978_905_166_247e-08,
        ],
    ),
    (
        &[Front::Spring],
        8,
        12,
        false,
        [
            0.000_999_999_883_082_224,
            0.896_636_227_555_997_6,
            0.408_636_487_806_730_73,
            0.000_217_476_750_094_136_09,
            3.683_769_287_045_905e-07,
        ],
    ),
    (
        &[Front::Spring],
        12,
        13,
        true,
        [
            0.000_999_999_910_045_265_6,
            0.947_182_767_672_744_7,
            -1.395_129_440_511_644_6,
            0.284_415_180_716_343_14,
            1.990_989_947_149_686_3e-05,
        ],
    ),
    (
        &[Front::Spring, Front::Dashpot],
        4,
        6,
        true,
        [
            0.000_999_999_700_144_079_5,
            0.897_295_389_482_478_1,
            0.858_568_558_386_686_7,
            0.147_758_681_046_909_17,
            0.142_857_165_563_418_93,
        ],
    ),
    (
        &[Front::Spring, Front::Dashpot],
        8,
        12,
        false,
        [
            0.000_999_999_883_085_165_2,
            0.898_996_399_367_791_2,
            0.352_847_399_114_033_46,
            0.143_097_299_350_743_95,
            0.142_857_511_244_582_7,
        ],
    ),
    (
        &[Front::Spring, Front::Dashpot],
        12,
        13,
        true,
        [
            0.000_999_999_910_047_073_8,
            0.947_809_008_287_353_8,
            -1.059_421_255_808_279_8,
            0.190_562_147_306_970_1,
            0.142_877_053_592_479_13,
        ],
    ),
];

#[test]
fn the_exact_method_knows_its_error_where_a_mass_strikes_a_chain() {
    for (front, count, decades, even, values) in IMPACTS {
        let duration = 1e4_f64.max(end(decades));
        let assembly =
            compiled(&Head::Striking, model(&parts(front, count, decades, even)), duration);
        let signal = exact(&assembly, "head.position", duration);
        let expected: Vec<(f64, f64)> =
            [1e-3, 1.0, 10.0, 100.0, 1e4].into_iter().zip(values).collect();
        let what = format!("{front:?}, {count} over {decades}");
        follows(&signal, &expected, &what);
        assert!(signal.error.unwrap() <= 1e-12, "{what}: {:?}", signal.error);
    }
}

#[test]
fn the_fastest_element_of_a_chain_is_the_one_beside_the_tree() {
    let parts = parts(&[], 8, 12, true);
    let assembly = compiled(&Head::Striking, model(&parts), 1.0);
    for (at, pair) in assembly.primitives.chunks(2).enumerate() {
        let output = assembly.system.outputs.at(pair[0].deformation);
        assert_eq!(output.unknowns.terms().len(), if at == 0 { 8 } else { 1 }, "element {at}");
    }
}
