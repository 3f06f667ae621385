//! Shifts by closed forms.

use dashpot_rheology::{Branch, MOST_LEVELS, Tree};

use super::*;
use crate::{
    Model,
    elements::{Dashpot, Law, Rigid, Spring},
    part,
};

fn wlf(temperature: f64, reference: f64, c1: f64, c2: f64) -> f64 {
    Wlf { temperature, reference, c1, c2 }.factor().unwrap()
}

fn arrhenius(temperature: f64, reference: f64, energy: f64) -> f64 {
    Arrhenius { temperature, reference, energy }.factor().unwrap()
}

/// Molecules in a mole, by the definition of the mole.
const MOLE: f64 = 6.022_140_76e23;

/// Whether two factors agree to the rounding of their exponents.
fn is_same(found: f64, expected: f64) -> bool {
    (found / expected - 1.0).abs() <= 8.0 * f64::EPSILON * (1.0 + expected.ln().abs())
}

#[test]
fn nothing_is_shifted_at_the_reference() {
    assert_eq!(wlf(293.15, 293.15, 17.44, 51.6).to_bits(), 1.0_f64.to_bits());
    assert_eq!(arrhenius(293.15, 293.15, 1.3e-19).to_bits(), 1.0_f64.to_bits());
}

#[test]
fn warmth_makes_times_shorter() {
    assert!(wlf(303.15, 293.15, 17.44, 51.6) < 1.0 && wlf(283.15, 293.15, 17.44, 51.6) > 1.0);
    assert!(arrhenius(303.15, 293.15, 1.3e-19) < 1.0 && arrhenius(283.15, 293.15, 1.3e-19) > 1.0);
}

/// `T − T_ref = c2` halves the fraction: `a_T = 10^(−c1/2)`.
#[test]
fn wlf_has_its_closed_form() {
    assert!(is_same(wlf(300.0, 250.0, 4.0, 50.0), 1e-2));
    assert!(is_same(wlf(225.0, 250.0, 4.0, 50.0), 1e4));
    assert!(is_same(wlf(500.0, 250.0, 6.0, 50.0), 1e-5));
}

/// With another reference the same law has the constants `c2' = c2 + T' − T_ref`,
/// `c1' = c1 c2/c2'`.
#[test]
fn wlf_shifts_compose() {
    let (reference, c1, c2) = (240.0, 17.44, 51.6);
    for other in [230.0, 260.0, 300.0] {
        let moved = c2 + other - reference;
        for temperature in [215.0, 240.0, 255.5, 310.0, 400.0] {
            let direct = wlf(temperature, reference, c1, c2);
            let of_other = wlf(other, reference, c1, c2);
            let by_other = wlf(temperature, other, c1 * c2 / moved, moved) * of_other;
            // The denominators c2 + T − T_ref are rounded like their largest term, below 200 K.
            let smallest = moved.min(c2 + temperature - reference);
            let exponents = [direct, of_other, by_other / of_other].map(|own| own.ln().abs());
            let rounding = 8.0 * f64::EPSILON * (1.0 + 200.0 / smallest);
            let change = (by_other / direct).ln().abs();
            let bound = rounding * (1.0 + exponents.iter().sum::<f64>());
            assert!(change <= bound, "{temperature} {other}: {change:e}");
        }
    }
}

/// Williams, Landel and Ferry give their law twice (J. Am. Chem. Soc. 77 (1955) 3701, abstract and
/// eq. 1): with 8.86 and 101.6 K from a temperature `T_s`, and with 17.44 and 51.6 K from the glass
/// transition, about 50 K below it. Their 8.86 is rounded to three digits.
#[test]
fn both_forms_of_the_first_paper_are_one() {
    let (transition, separate) = (250.0, 300.0);
    let at_separate = wlf(separate, transition, 17.44, 51.6);
    for temperature in [260.0, 280.0, 320.0, 350.0] {
        let from_transition = (wlf(temperature, transition, 17.44, 51.6) / at_separate).log10();
        let from_separate = wlf(temperature, separate, 8.86, 101.6).log10();
        assert!((from_separate / from_transition - 1.0).abs() <= 0.005 / 8.86, "{temperature}");
    }
}

#[test]
fn wlf_says_below_which_temperature_it_ends() {
    let sample = Wlf { temperature: 240.0, reference: 293.15, c1: 17.44, c2: 51.6 };
    let error = sample.factor().unwrap_err().to_string();
    assert!(error.contains("above 241.55 K") && error.contains("is 240 K"), "{error}");
    let at_limit = Wlf { temperature: 250.0, reference: 300.0, c1: 17.44, c2: 50.0 };
    assert!(at_limit.factor().unwrap_err().to_string().contains("above 250 K"));
    let near = Wlf { temperature: 250.5, ..at_limit };
    assert!(near.factor().unwrap_err().to_string().contains("fits into double precision"));
    assert!(Wlf { c1: 0.0, ..sample }.factor().is_err());
    assert!(Wlf { c2: -51.6, ..sample }.factor().is_err());
    assert!(Wlf { c2: f64::NAN, ..sample }.factor().is_err());
}

#[test]
fn arrhenius_shifts_are_inverse_and_compose() {
    let energy = 80e3 / MOLE;
    for (one, other) in [(293.15, 308.15), (250.0, 400.0), (300.0, 300.001)] {
        assert!(is_same(arrhenius(one, other, energy) * arrhenius(other, one, energy), 1.0));
        let by_third = arrhenius(one, 333.0, energy) * arrhenius(333.0, other, energy);
        let direct = arrhenius(one, other, energy);
        // The ways over 333 K have exponents up to 30.
        assert!((by_third / direct - 1.0).abs() <= 30.0 * 8.0 * f64::EPSILON);
    }
}

/// The molar gas constant 8.314 462 618 J/(mol K) is that of CODATA 2018, with ten digits.
#[test]
fn arrhenius_is_the_law_of_the_gas_constant() {
    for (temperature, reference) in [(308.15_f64, 293.15_f64), (250.0, 400.0)] {
        let molar = 80e3 / 8.314_462_618 * (temperature.recip() - reference.recip());
        let factor = arrhenius(temperature, reference, 80e3 / MOLE);
        assert!((factor.ln() / molar - 1.0).abs() <= 1e-10, "{factor}");
    }
}

/// The rule of thumb of kinetics: an activation energy of 53 kJ/mol doubles a rate from 25 °C to
/// 35 °C.
#[test]
fn ten_degrees_halve_the_times_at_fifty_three_kilojoules() {
    assert!((arrhenius(308.15, 298.15, 53e3 / MOLE) - 0.5).abs() < 0.002);
}

#[test]
fn temperatures_at_absolute_zero_and_below_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (temperature, reference) in [(bad, 300.0), (300.0, bad)] {
            let energy = 1e-19;
            let found = Arrhenius { temperature, reference, energy }.factor().unwrap_err();
            assert!(found.to_string().contains("above absolute zero"), "{found}");
            let found = Wlf { temperature, reference, c1: 17.44, c2: 51.6 }.factor().unwrap_err();
            assert!(found.to_string().contains("above absolute zero"), "{found}");
        }
    }
}

#[test]
fn an_energy_of_a_mole_is_told_from_that_of_a_molecule() {
    let shift = Arrhenius { energy: 80e3, ..Arrhenius::sample() };
    let error = shift.factor().unwrap_err().to_string();
    assert!(error.starts_with("`energy` must be") && error.contains("80 kJ/mol"), "{error}");
    assert!(Arrhenius { energy: -1e-19, ..shift }.factor().is_err());
}

fn laws(model: &Model) -> Vec<(String, Law)> {
    let mut laws = Vec::new();
    let mut pending = vec![(String::new(), model)];
    while let Some((name, tree)) = pending.pop() {
        match tree {
            Tree::Part(element) => laws.push((name, element.law())),
            tree => pending.extend(
                tree.branches().iter().rev().map(|branch| (branch.name.to_string(), &branch.tree)),
            ),
        }
    }
    laws
}

#[test]
fn only_dashpots_are_shifted() {
    let kelvin = Tree::Parallel(vec![
        Branch::new("k", part(Spring { stiffness: 3.0 })),
        Branch::new("c", part(Dashpot { damping: 5.0 })),
    ]);
    let model = Tree::Series(vec![
        Branch::new("link", part(Rigid)),
        Branch::new("kelvin", kelvin),
        Branch::new("free", part(Dashpot { damping: 0.0 })),
    ]);
    let shifted = shifted(&model, 4.0).unwrap();
    assert!(matches!(&shifted, Tree::Series(_)));
    assert!(matches!(&shifted.branches()[1].tree, Tree::Parallel(_)));
    let expected = [
        ("link", Law::Rigid),
        ("k", Law::Spring(3.0)),
        ("c", Law::Dashpot(20.0)),
        ("free", Law::Dashpot(0.0)),
    ];
    assert_eq!(laws(&shifted), expected.map(|(name, law)| (name.to_owned(), law)));
    assert_eq!(laws(&super::shifted(&shifted, 0.25).unwrap()), laws(&model));
}

#[test]
fn a_dashpot_beyond_double_precision_is_refused() {
    let model = part(Dashpot { damping: 1e300 });
    assert!(shifted(&model, 1e9).unwrap_err().to_string().contains("1e300 N s/m"));
    assert!(shifted(&part(Dashpot { damping: 1e-300 }), 1e-9).is_err());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(shifted(&model, bad).is_err(), "{bad}");
    }
}

#[test]
fn models_are_shifted_as_deep_as_they_may_be() {
    let mut model = part(Dashpot { damping: 2.0 });
    for _ in 0..MOST_LEVELS / 2 {
        model = Tree::series([Tree::parallel([model, part(Dashpot { damping: 1.0 })])]);
    }
    let laws = laws(&shifted(&model, 3.0).unwrap());
    assert_eq!(laws.len(), MOST_LEVELS / 2 + 1);
    assert_eq!(laws[0].1, Law::Dashpot(6.0));
}

#[test]
fn every_kind_comes_back_from_its_values() {
    for kind in SHIFTS {
        let values = (kind.sample)();
        assert_eq!(values.len(), kind.parameters.len(), "{}", kind.word);
        assert_eq!((kind.again)(&values).unwrap(), values, "{}", kind.word);
        assert!(kind.example().is_ok() && (kind.make)(&[]).is_err(), "{}", kind.word);
    }
}
