use super::*;

fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// Whether `value` rounds to the digits of a decimal.
fn has_digits(value: f64, printed: &str) -> bool {
    let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{value:.decimals$}") == printed
}

/// ξ and ξ′ from `c ξ″ + d ξ′ = φ″ + a φ′ + b φ` by Runge and Kutta's method of order 4.
fn integrated(pulse: &Pulse, end: f64) -> (f64, f64) {
    const STEPS: u32 = 4000;
    let Groups { a, b, c, d, .. } = pulse.padding;
    let (p, m) = (pulse.slope, pulse.decay);
    let curvature = |t: f64, rate: f64| {
        let decay = p * (-m * t).exp();
        let (force, slope, bend) = (decay * t, decay * (1.0 - m * t), decay * m * (m * t - 2.0));
        (bend + a * slope + b * force - d * rate) / c
    };
    let h = end / f64::from(STEPS);
    let (mut x, mut v) = (0.0, 1.0);
    for step in 0..STEPS {
        let t = h * f64::from(step);
        let k1 = curvature(t, v);
        let k2 = curvature(t + 0.5 * h, v + 0.5 * h * k1);
        let k3 = curvature(t + 0.5 * h, v + 0.5 * h * k2);
        let k4 = curvature(t + h, v + h * k3);
        x += h * (v + h * (k1 + k2 + k3) / 6.0);
        v += h * (k1 + 2.0 * (k2 + k3) + k4) / 6.0;
    }
    (x, v)
}

/// Pulses with m on both sides of ν = 10, and on it.
fn pulses() -> Vec<Pulse> {
    [1.0, 3.1, 9.0, 10.0 - 1e-7, 10.0, 10.0 + 1e-4, 12.0, 30.0]
        .into_iter()
        .flat_map(|decay| [2.0, 9.9].map(|slope| Pulse { slope, decay, ..Pulse::PRINTED }))
        .collect()
}

#[test]
fn the_constants_are_those_of_the_checked_page() {
    let own = Pulse::PRINTED.constants().unwrap();
    for (value, printed) in [
        (own.nu, "10"),
        (own.r1, "0.358117"),
        (own.r2, "-1.116604"),
        (own.l1, "0.834645"),
        (own.l2, "0.281959"),
    ] {
        assert!(has_digits(value, printed), "{value} is not {printed}");
    }
}

#[test]
fn the_largest_deformation_and_its_time_are_those_of_the_checked_page() {
    let (time, deepest) = Pulse::PRINTED.deepest();
    assert!(has_digits(deepest, "0.8346476"), "{deepest}");
    assert!(has_digits(time, "3.4406"), "{time}");
    assert!(has_digits(Pulse::PRINTED.checks().energy, "0.728823"));
    assert!(has_digits(Pulse::PRINTED.limit(Parameter::B).unwrap(), "79.501"));
}

#[test]
fn the_deformation_solves_its_equation_for_every_decay() {
    for pulse in pulses() {
        for end in [0.1, 1.0, 4.0] {
            let (deformation, rate) = integrated(&pulse, end);
            // h⁴ of the fastest rate, 30: (0.03)⁴/120.
            near(pulse.deformation(end), deformation, 1e-7);
            assert!((pulse.rate(end) - rate).abs() < 1e-7, "{pulse:?} {end}");
        }
    }
}

#[test]
fn the_constants_give_the_same_deformation_away_from_the_limit() {
    for pulse in pulses() {
        let Some(own) = pulse.constants() else {
            assert!((pulse.decay - 10.0).abs() < 1e-6, "{pulse:?}");
            continue;
        };
        if (pulse.decay - own.nu).abs() < 0.5 {
            continue;
        }
        for time in [0.05, 0.7, 3.0] {
            let closed = own.l1
                + own.l2 * (-own.nu * time).exp()
                + (own.r1 * time + own.r2) * (-pulse.decay * time).exp();
            near(pulse.deformation(time), closed, 1e-12);
            near(pulse.energy(time), pulse.closed_energy(time).unwrap(), 1e-11);
        }
        near(pulse.final_deformation(), own.l1, 1e-12);
    }
}

#[test]
fn nothing_jumps_where_m_passes_nu() {
    let at = |decay: f64| Pulse { decay, ..Pulse::PRINTED };
    for time in [0.1, 1.0, 3.0] {
        let [below, on, above] = [10.0 - 1e-6, 10.0, 10.0 + 1e-6].map(|m| at(m).deformation(time));
        // The second difference over 1e-6 is of the order 1e-12.
        assert!((below + above - 2.0 * on).abs() < 1e-11, "{below} {on} {above}");
    }
    assert!(at(10.0).constants().is_none() && at(10.0).closed_energy(1.0).is_none());
}

#[test]
fn lambert_s_w_gives_the_turning_times() {
    let mut count = 0;
    for step in 0..60 {
        let decay = 0.5 + 0.45 * f64::from(step);
        for slope in [0.3, 2.0, 9.9, 30.0] {
            let pulse = Pulse { slope, decay, ..Pulse::PRINTED };
            if (decay - 10.0).abs() < 0.2 {
                continue;
            }
            let lambert = pulse.turning_times_by_lambert().unwrap();
            let times = pulse.turning_times();
            let last = LAST / pulse.nu().min(pulse.decay);
            let within = lambert.iter().filter(|own| **own < last).count();
            assert_eq!(times.len(), within, "{pulse:?}: {times:?} {lambert:?}");
            for (one, other) in times.iter().zip(&lambert) {
                // The constants lose digits as m comes near ν.
                near(*one, *other, 1e-9);
                count += 1;
            }
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn the_limit_makes_the_final_deformation_one() {
    let base = Pulse::PRINTED;
    let with = |padding| Pulse { padding, ..base };
    let of = |parameter| base.limit(parameter).unwrap();
    let all = [
        with(Groups { b: of(Parameter::B), ..base.padding }),
        with(Groups { c: of(Parameter::C), ..base.padding }),
        with(Groups { d: of(Parameter::D), ..base.padding }),
        Pulse { slope: of(Parameter::Slope), ..base },
        Pulse { decay: of(Parameter::Decay), ..base },
    ];
    for pulse in all {
        near(pulse.final_deformation(), 1.0, 1e-13);
    }
    let steep = Pulse { slope: 1e3, ..base };
    assert!(steep.limit(Parameter::C).is_none(), "{:?}", steep.limit(Parameter::C));
}

#[test]
fn the_approximation_is_good_where_its_argument_is_small() {
    // Of the pulses with L4 > 0, it comes nearer the smaller |L3 τ|/L4 is.
    let error = |pulse: &Pulse| {
        let own = pulse.constants().unwrap();
        let time = pulse.turning_times()[0];
        let found = pulse.approximate_turning_time().unwrap();
        ((own.l3 * time / own.l4).abs(), (found / time - 1.0).abs())
    };
    let [(small, good), (large, bad)] = [(9.9, 5.0), (9.9, 3.1)]
        .map(|(slope, decay)| error(&Pulse { slope, decay, ..Pulse::PRINTED }));
    assert!(small < large && good < bad, "{small} {good} {large} {bad}");
}

#[test]
fn a_pulse_that_is_prescribed_need_not_keep_the_energy() {
    let checks = Pulse::PRINTED.checks();
    assert!(!checks.is_affordable);
    near(checks.impulse, 9.9 / 9.61, 1e-15);
    near(checks.start_slope, 9.9 / 8.0, 1e-15);
    let weak = Pulse { slope: 1.0, ..Pulse::PRINTED };
    assert!(weak.checks().is_affordable);
}
