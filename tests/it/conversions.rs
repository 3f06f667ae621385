//! Conversions between equivalent models against 50 digits (`conversions_reference.py`).

mod identities;

use dashpot::rheology::{
    LinearModel, Primitive, Tree,
    appendix_a::{Burgers, Equivalent, SpringDashpot, TwoMaxwell},
    linear::MERGED_BELOW,
};

use Primitive::{Dashpot, Spring};

const TABLE: &str = include_str!("conversions_reference.csv");

/// A line of the table, with the numbers as the nearest doubles.
struct Judged {
    case: &'static str,
    inputs: &'static str,
    results: &'static str,
}

impl Judged {
    /// All lines of a kind.
    fn all(kind: &str) -> Vec<Self> {
        let lines = TABLE.lines().filter_map(|line| {
            let mut fields = line.splitn(4, ',');
            let mut next = || fields.next().unwrap();
            (next() == kind).then(|| Self { case: next(), inputs: next(), results: next() })
        });
        lines.collect()
    }
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

/// Compares constants, in units in the last place of 1.
#[track_caller]
fn assert_near(case: &str, found: &[f64], expected: &[f64], epsilons: f64) {
    assert_eq!(found.len(), expected.len(), "{case}: {found:?} for {expected:?}");
    for (at, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        let error = if expected == 0.0 { found } else { found / expected - 1.0 };
        assert!(
            error.abs() <= epsilons * f64::EPSILON,
            "{case}, constant {at}: {found:e} for {expected:e}, off by {error:.1e}"
        );
    }
}

fn pair(constants: &[f64]) -> SpringDashpot {
    SpringDashpot { spring: constants[0], dashpot: constants[1] }
}

fn flat(first: SpringDashpot, second: SpringDashpot) -> [f64; 4] {
    [first.spring, first.dashpot, second.spring, second.dashpot]
}

fn parts(constants: &[f64]) -> [Tree<Primitive>; 2] {
    [Spring(constants[0]).into(), Dashpot(constants[1]).into()]
}

fn model(tree: &Tree<Primitive>) -> LinearModel {
    LinearModel::of(tree, |&part| part)
}

/// A spring and Maxwell elements side by side, given as pairs of constants.
fn prony(spring: f64, pairs: &[f64]) -> LinearModel {
    let elements = pairs.chunks(2).map(|own| Tree::series(parts(own)));
    model(&Tree::parallel(elements.chain([Spring(spring).into()])))
}

/// `K_e C`, then `K_j C_j`, fastest first.
fn maxwell(model: &LinearModel) -> Vec<f64> {
    let form = model.maxwell().unwrap();
    let elements = form.elements();
    let pairs = elements.iter().flat_map(|element| [element.stiffness, element.damping]);
    [form.spring(), form.dashpot()].into_iter().chain(pairs).collect()
}

/// `J_g φ₀`, then `K_i C_i`, fastest first.
fn kelvin(model: &LinearModel) -> Vec<f64> {
    let form = model.kelvin().unwrap();
    let elements = form.elements();
    let pairs = elements.iter().flat_map(|element| [element.stiffness, element.damping]);
    [form.spring_compliance(), form.fluidity()].into_iter().chain(pairs).collect()
}

#[test]
fn appendix_a_holds_to_a_few_roundings_both_ways() {
    let mut singular = 0;
    for Judged { case, inputs, results } in Judged::all("two-maxwell") {
        let (given, expected) = (numbers(inputs), numbers(results));
        let burgers = Burgers { maxwell: pair(&given), kelvin: pair(&given[2..]) };
        let two = burgers.to_two_maxwell().unwrap();
        assert_near(case, &flat(two.slow, two.fast), &expected, 8.0);
    }
    for Judged { case, inputs, results } in Judged::all("burgers") {
        let (given, expected) = (numbers(inputs), numbers(results));
        let two = TwoMaxwell { slow: pair(&given), fast: pair(&given[2..]) };
        match two.to_burgers().unwrap() {
            Equivalent::Burgers(own) => {
                assert_near(case, &flat(own.maxwell, own.kelvin), &expected, 8.0);
            }
            Equivalent::Maxwell(one) => {
                singular += 1;
                assert_near(case, &[one.spring, one.dashpot], &expected, 1.0);
            }
        }
    }
    assert!(singular > 0);
}

#[test]
fn the_general_conversion_rounds_once_where_the_closed_forms_round_often() {
    for Judged { case, inputs, results } in Judged::all("two-maxwell") {
        let (given, expected) = (numbers(inputs), numbers(results));
        let kelvin = Tree::parallel(parts(&given[2..]));
        let own = model(&Tree::series(parts(&given).into_iter().chain([kelvin])));
        let turned = [&[0.0, 0.0], &expected[2..], &expected[..2]].concat();
        assert_near(case, &maxwell(&own), &turned, 2.0);
    }
    for Judged { case, inputs, results } in Judged::all("burgers") {
        let (given, expected) = (numbers(inputs), numbers(results));
        let own = prony(0.0, &given);
        if own.merged().is_empty() {
            let [k2, c2, rest @ ..] = &expected[..] else { panic!("{case}") };
            assert_near(case, &kelvin(&own), &[&[1.0 / k2, 1.0 / c2], rest].concat(), 2.0);
        }
    }
}

#[test]
fn elements_of_nearly_one_time_become_one_below_the_stated_distance() {
    let mut merged = 0;
    for Judged { case, inputs, results } in Judged::all("burgers") {
        let (given, expected) = (numbers(inputs), numbers(results));
        let &[k3, c3, k4, c4] = &given[..] else { panic!("{case}") };
        let (product, other) = (c3 * k4, c4 * k3);
        let difference = c3.mul_add(k4, -product) - c4.mul_add(k3, -other) + (product - other);
        let gap = (difference / product.max(other)).abs();
        let own = prony(0.0, &given);
        let [note] = own.merged() else {
            assert!(own.merged().is_empty() && gap > MERGED_BELOW, "{case}: {gap:e}");
            continue;
        };
        merged += 1;
        assert!(gap <= MERGED_BELOW && note.count == 2, "{case}: {gap:e}");
        assert!((note.gap - gap).abs() <= 1e-6 * gap, "{case}: {note:?} for {gap:e}");
        assert_near(case, &maxwell(&own)[2..], &expected[..2], 2.0);
        // The compliance that is lost, from the exact constants.
        if let [k2, _, k1, _] = &expected[..] {
            assert!(k2 / k1 < MERGED_BELOW.powi(2), "{case}");
        }
        for power in -12..=5 {
            let t = 2_f64.powi(power) * c3 / k3;
            let exact = k3 * (-t * k3 / c3).exp() + k4 * (-t * k4 / c4).exp();
            // The exponents of the right side are rounded three times, up to t r = 32.
            assert_near(case, &[own.relaxation(t)], &[exact], 100.0);
            let (k2, c2) = (expected[0], expected[1]);
            assert_near(case, &[own.creep(t)], &[1.0 / k2 + t / c2], 4.0);
        }
    }
    assert!(merged >= 5, "{merged}");
}

#[test]
fn a_series_of_many_modes_keeps_every_constant() {
    for Judged { case, inputs, results } in Judged::all("prony") {
        let given = numbers(inputs);
        let own = prony(given[0], &given[1..]);
        assert!(own.merged().is_empty());
        assert_near(case, &kelvin(&own), &numbers(results), 2.0);
    }
}

#[test]
fn nested_trees_have_the_poles_and_strengths_of_their_polynomials() {
    for Judged { case, inputs, results } in Judged::all("tree") {
        let own = model(&read(&mut inputs.replace(')', " )").split_whitespace()).unwrap());
        let (left, right) = results.trim_start_matches("maxwell ").split_once("kelvin").unwrap();
        assert_near(case, &maxwell(&own), &numbers(left), 2.0);
        assert_near(case, &kelvin(&own), &numbers(right), 2.0);
    }
}

/// The next tree; `None` at a closing bracket.
fn read<'w>(words: &mut impl Iterator<Item = &'w str>) -> Option<Tree<Primitive>> {
    let word = words.next()?;
    let (first, rest) = word.split_at(1);
    match first {
        "k" => Some(Spring(rest.parse().unwrap()).into()),
        "c" => Some(Dashpot(rest.parse().unwrap()).into()),
        "(" => {
            let mut branches = Vec::new();
            while let Some(branch) = read(words) {
                branches.push(branch);
            }
            Some(if rest == "s" { Tree::series(branches) } else { Tree::parallel(branches) })
        }
        _ => None,
    }
}
