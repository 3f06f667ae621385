//! The thesis' groups, by the names that this crate gives them.

pub use dashpot_analysis::similarity::{
    FourParameterGroups as Groups, FourParameterPadding as Padding,
    FourParameterSupport as Support, ImpactScales as Scales,
};
use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::{
    Branch, Tree,
    appendix_a::{AppendixAError, Burgers, SpringDashpot, TwoMaxwell},
};

/// The two Maxwell elements of appendix A that stand for a four-parameter padding.
pub(crate) fn two_maxwell(pad: Padding) -> Result<TwoMaxwell, AppendixAError> {
    let Padding { k1, c1, k2, c2 } = pad;
    let [maxwell, kelvin] = [(k2, c2), (k1, c1)];
    let pair = |(spring, dashpot)| SpringDashpot { spring, dashpot };
    Burgers { maxwell: pair(maxwell), kelvin: pair(kelvin) }.to_two_maxwell()
}

/// The model of these elements.
pub(crate) fn in_parallel(two: TwoMaxwell) -> Model {
    let branch = |name: &'static str, SpringDashpot { spring, dashpot }: SpringDashpot| {
        let parts = [part(Spring { stiffness: spring }), part(Dashpot { damping: dashpot })];
        Branch::new(name, Tree::series(parts))
    };
    Tree::Parallel(vec![branch("slow", two.slow), branch("fast", two.fast)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-13 * expected.abs(), "{found} is not {expected}");
    }

    fn chapter_4() -> Groups {
        Groups::of(&Scales::CHAPTER_4, &Padding::CHAPTER_4, &Support::CHAPTER_4)
    }

    #[test]
    fn the_groups_of_chapter_4_are_those_of_2_29_to_2_40() {
        let own = chapter_4();
        let (p1, p2, p3, p4) = (4.0 / 6.0, 1.0, 20e6 * 0.02 / 6e4, 100.0 / 120.0);
        near(own.a, (1.0 + p1 + p2) * p3 / p1);
        near(own.b, p2 * p3 * p3 / p1);
        near(own.c, p3 / p4);
        near(own.d, own.b / p4);
        near(own.a, 80.0 / 3.0);
        near(own.b, 200.0 / 3.0);
        near(own.alpha, 0.2);
        near(own.beta, 2.0);
        near(own.gamma, 0.1);
    }

    #[test]
    fn padding_and_support_come_back_from_their_groups() {
        let scales = Scales { mass: 3.0, speed: 7.0, thickness: 0.05 };
        let pad = Padding { k1: 3e5, c1: 200.0, k2: 7e5, c2: 900.0 };
        let support = Support { mass: 40.0, stiffness: 2e6, damping: 500.0 };
        let own = Groups::of(&scales, &pad, &support);
        let back = own.padding(&scales).unwrap();
        // q is a difference of terms up to ten times as large.
        for (found, expected) in
            [(back.k1, pad.k1), (back.c1, pad.c1), (back.k2, pad.k2), (back.c2, pad.c2)]
        {
            assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
        }
        let stands = own.support(&scales);
        near(stands.mass, 40.0);
        near(stands.stiffness, 2e6);
        near(stands.damping, 500.0);
    }

    #[test]
    fn the_printed_groups_stand_for_another_padding() {
        let pad = Groups::PRINTED.padding(&Scales::CHAPTER_4).unwrap();
        assert!((pad.k1 / 1e6 - 20.13).abs() < 0.005 && (pad.c1 - 4027.0).abs() < 0.5, "{pad:?}");
    }

    #[test]
    fn a_padding_exists_between_two_values_of_c() {
        let (low, high) = Groups::PRINTED.ranges().0[2].unwrap();
        assert!((low - 3.361).abs() < 5e-4 && (high - 28.562).abs() < 5e-4, "{low} {high}");
        let with = |c: f64| Groups { c, ..Groups::PRINTED }.padding(&Scales::UNIT);
        assert!(with(low * 0.999).is_err() && with(low * 1.001).is_ok());
        assert!(with(high * 1.001).is_err() && with(high * 0.999).is_ok());
        // K2 from 8.4 to 71.4 MN/m.
        let stiffness = |c: f64| c * 10.0 / 4e-6 / 1e6;
        assert!((stiffness(low) - 8.4).abs() < 0.05 && (stiffness(high) - 71.4).abs() < 0.05);
        assert!(Groups { a: 10.0, ..Groups::PRINTED }.ranges().0[2].is_none());
    }
}
