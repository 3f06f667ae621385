//! The closed forms against the general conversion, against each other, and at the ends of the range.

use proptest::prelude::*;

use super::*;
use crate::{
    LinearModel,
    Primitive::{Dashpot, Spring},
};

/// A sum of some roundings in each constant of either way.
const FEW_ROUNDINGS: f64 = 16.0 * f64::EPSILON;

fn both([spring, dashpot]: [f64; 2]) -> SpringDashpot {
    SpringDashpot { spring, dashpot }
}

fn parts(own: SpringDashpot) -> [LinearModel; 2] {
    [Spring(own.spring).into(), Dashpot(own.dashpot).into()]
}

fn series(spring_dashpot: SpringDashpot) -> LinearModel {
    LinearModel::series(&parts(spring_dashpot))
}

fn of_burgers(burgers: Burgers) -> LinearModel {
    LinearModel::series(&[series(burgers.maxwell), LinearModel::parallel(&parts(burgers.kelvin))])
}

fn of_two(two_maxwell: TwoMaxwell) -> LinearModel {
    LinearModel::parallel(&[series(two_maxwell.slow), series(two_maxwell.fast)])
}

fn near(found: SpringDashpot, expected: SpringDashpot, tolerance: f64) -> bool {
    (found.spring / expected.spring - 1.0).abs() <= tolerance
        && (found.dashpot / expected.dashpot - 1.0).abs() <= tolerance
}

fn burgers_of(two_maxwell: TwoMaxwell) -> Burgers {
    match two_maxwell.to_burgers().unwrap() {
        Equivalent::Burgers(burgers) => burgers,
        Equivalent::Maxwell(one) => panic!("{two_maxwell:?} is one element, {one:?}"),
    }
}

/// Constants over 12 decades.
fn constants() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4((-6.0..6.0_f64).prop_map(|power| 10_f64.powf(power)))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn two_maxwell_elements_are_those_of_the_general_conversion([k2, c2, k1, c1] in constants()) {
        let burgers = Burgers { maxwell: both([k2, c2]), kelvin: both([k1, c1]) };
        let two = burgers.to_two_maxwell().unwrap();
        let model = of_burgers(burgers);
        let elements = model.maxwell().unwrap().elements();
        let [fast, slow] = [&elements[0], &elements[1]].map(|own| both([own.stiffness, own.damping]));
        prop_assert!(near(two.slow, slow, FEW_ROUNDINGS), "{:?}, generally {slow:?}", two.slow);
        prop_assert!(near(two.fast, fast, FEW_ROUNDINGS), "{:?}, generally {fast:?}", two.fast);
    }

    #[test]
    fn the_burgers_element_is_that_of_the_general_conversion([k3, c3, k4, c4] in constants()) {
        let two = TwoMaxwell { slow: both([k3, c3]), fast: both([k4, c4]) };
        let burgers = burgers_of(two);
        let model = of_two(two);
        let form = model.kelvin().unwrap();
        let maxwell = both([form.spring_compliance(), form.fluidity()].map(f64::recip));
        let element = form.elements()[0];
        let kelvin = both([element.stiffness, element.damping]);
        prop_assert!(near(burgers.maxwell, maxwell, FEW_ROUNDINGS));
        prop_assert!(near(burgers.kelvin, kelvin, FEW_ROUNDINGS), "{:?}, generally {kelvin:?}", burgers.kelvin);
    }

    #[test]
    fn the_order_of_two_maxwell_elements_does_not_matter([k3, c3, k4, c4] in constants()) {
        let two = TwoMaxwell { slow: both([k3, c3]), fast: both([k4, c4]) };
        let turned = TwoMaxwell { slow: two.fast, fast: two.slow };
        let (one, other) = (burgers_of(two), burgers_of(turned));
        prop_assert!(near(one.kelvin, other.kelvin, FEW_ROUNDINGS));
        prop_assert_eq!(one.maxwell, other.maxwell);
    }

    #[test]
    fn units_of_any_size_scale_the_result([k2, c2, k1, c1] in constants(), force in -450..450, time in -450..450) {
        let scaled = |force: i32, time: i32| Burgers {
            maxwell: both([k2 * 2_f64.powi(force), c2 * 2_f64.powi(force) * 2_f64.powi(time)]),
            kelvin: both([k1 * 2_f64.powi(force), c1 * 2_f64.powi(force) * 2_f64.powi(time)]),
        };
        let (plain, two) = (scaled(0, 0).to_two_maxwell().unwrap(), scaled(force, time).to_two_maxwell().unwrap());
        for (plain, own) in [(plain.slow, two.slow), (plain.fast, two.fast)] {
            // Powers of two change no digit.
            prop_assert_eq!(own.spring.to_bits(), (plain.spring * 2_f64.powi(force)).to_bits());
            let dashpot = plain.dashpot * 2_f64.powi(force) * 2_f64.powi(time);
            prop_assert_eq!(own.dashpot.to_bits(), dashpot.to_bits());
        }
        let back = burgers_of(two);
        prop_assert!(back.kelvin.spring > 0.0 && back.kelvin.dashpot > 0.0);
    }
}

#[test]
fn constants_at_both_ends_of_the_range_give_numbers_or_an_error() {
    let ends = [1e-150, 1.0, 1e150];
    let mut answered = 0;
    for at in 0..81_usize {
        let [k2, c2, k1, c1] = [1, 3, 9, 27].map(|digit| ends[at / digit % 3]);
        let burgers = Burgers { maxwell: both([k2, c2]), kelvin: both([k1, c1]) };
        match burgers.to_two_maxwell() {
            Ok(TwoMaxwell { slow, fast }) => {
                answered += 1;
                assert!(((slow.spring + fast.spring) / k2 - 1.0).abs() < FEW_ROUNDINGS);
                assert!(((slow.dashpot + fast.dashpot) / c2 - 1.0).abs() < FEW_ROUNDINGS);
            }
            Err(error) => assert!(matches!(error, AppendixAError::OutOfRange { .. }), "{error}"),
        }
    }
    assert!(answered > 50, "{answered}");
}

#[test]
fn times_that_are_equal_but_for_rounding_are_one_element_only_where_they_are_equal() {
    let two = |c4: f64| TwoMaxwell { slow: both([3.0, 0.3]), fast: both([1.0, c4]) };
    // 0.3 is not three times 0.1 in binary, so these times differ.
    assert!(matches!(two(0.1).to_burgers(), Ok(Equivalent::Burgers(_))));
    let equal = TwoMaxwell { slow: both([3.0, 0.75]), fast: both([1.0, 0.25]) };
    assert_eq!(equal.to_burgers(), Ok(Equivalent::Maxwell(both([4.0, 1.0]))));
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let burgers = Burgers { maxwell: both([1.0, 1.0]), kelvin: both([1.0, value]) };
        let error = burgers.to_two_maxwell().unwrap_err().to_string();
        let expected = format!("`kelvin.dashpot` must be positive and finite, but it is {value}");
        assert_eq!(error, expected);
        let two = TwoMaxwell { slow: both([value, 1.0]), fast: both([1.0, 1.0]) };
        assert!(two.to_burgers().unwrap_err().to_string().starts_with("`slow.spring` must"));
    }
    let burgers = Burgers { maxwell: both([1e-150, 1.0]), kelvin: both([1e-150, 1e150]) };
    let found = burgers.to_two_maxwell().unwrap_err();
    assert_eq!(found, AppendixAError::OutOfRange { constant: "slow.spring" });
}
