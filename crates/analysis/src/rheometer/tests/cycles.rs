//! Loading and unloading against closed forms and quadrature.

use std::{f64::consts::PI, sync::Arc};

use dashpot_network::{
    elements::{
        Foam, Formula, Foundation, HuntCrossley, HystereticFoam, HystereticTable, Indenter,
        PowerSpring, PreloadedSpring, RateSpring, Shape, Spring,
    },
    parameters,
};
use dashpot_numerics::quadrature::integral;

use super::*;

/// How far, how fast out, and how fast back.
const Y: f64 = 0.01;
const OUT: f64 = 0.5;
const BACK: f64 = 0.2;
/// The error that is granted to a work, in parts of what is absorbed.
const WORK: f64 = 1e-8;

/// What a loop must be: peak force, work absorbed and returned, residual deformation.
struct Expected {
    peak: f64,
    absorbed: f64,
    returned: f64,
    residual: f64,
}

fn cycle(model: &Model) -> RheometerReport {
    let specimen = Specimen::new(model).unwrap();
    let given = [("deformation", Y), ("rate", OUT), ("return-rate", BACK)];
    protocol("load-unload", &given).unwrap().run(&specimen, &methods_for(&specimen)).unwrap()
}

fn judge(model: &Model, expected: &Expected) -> RheometerReport {
    let report = cycle(model);
    for computation in &report.computations {
        assert_eq!(computation.obstacle, None, "{}", computation.method);
    }
    let lost = expected.absorbed - expected.returned;
    let all = [
        ("peak force", expected.peak, expected.peak),
        ("energy absorbed", expected.absorbed, expected.absorbed),
        ("energy returned", expected.returned, expected.absorbed),
        ("energy lost", lost, expected.absorbed),
        ("hysteresis ratio", lost / expected.absorbed, 1.0),
        ("residual deformation", expected.residual, Y),
    ];
    let is_linear = !report.series[0].model.is_empty();
    for (name, value, scale) in all {
        let figure = report.figure(name).unwrap();
        let (found, error) = (figure.computed.unwrap(), figure.error.unwrap());
        let off = (found - value).abs();
        assert!(off <= error + 1e-14 * scale, "{name}: {found:e} for {value:e}, {error:e} stated");
        // A force that comes to zero without a slope tells little of where.
        let most = if name == "residual deformation" { 1e-3 } else { WORK };
        assert!(error <= most * scale, "{name}: {error:e} of {scale:e}");
        if is_linear {
            let off = (figure.model.unwrap() - value).abs();
            assert!(off <= 1e-13 * scale, "{name} in closed form: {off:e} of {scale:e}");
        } else {
            assert_eq!(figure.model, None);
        }
    }
    let of = |name: &str| report.figure(name).unwrap();
    let books = ["dissipated until then, by the ledger", "still stored then, by the ledger"];
    let books: f64 = books.iter().map(|name| of(name).computed.unwrap()).sum();
    let lost = of("energy lost").computed.unwrap();
    let off = (books - lost).abs() / expected.absorbed;
    assert!(off <= WORK, "the ledger has {books:e} of {lost:e}: {off:e}");
    report
}

#[test]
fn a_spring_loses_nothing() {
    let absorbed = 0.5 * 2e5 * Y * Y;
    let expected = Expected { peak: 2e5 * Y, absorbed, returned: absorbed, residual: 0.0 };
    let report = judge(&spring(2e5), &expected);
    // Rounding is no result.
    for name in ["energy lost", "hysteresis ratio", "residual deformation"] {
        let own = report.figure(name).unwrap();
        let values = [own.model, own.computed].map(|own| own.map(f64::to_bits));
        assert_eq!(values, [Some(0); 2], "{own:?}");
    }
}

#[test]
fn a_kelvin_element_loses_what_its_dashpot_takes_at_each_rate() {
    let (k, c) = (2e5, 1e3);
    let residual = c * BACK / k;
    let returned = 0.5 * k * (Y * Y - residual * residual) - c * BACK * (Y - residual);
    let absorbed = 0.5 * k * Y * Y + c * OUT * Y;
    let peak = k * Y + c * OUT;
    judge(&kelvin_voigt(k, c), &Expected { peak, absorbed, returned, residual });
}

#[test]
fn a_slow_kelvin_element_is_left_behind_as_the_motion_turns() {
    let (k, c) = (2e4, 2e3);
    let absorbed = 0.5 * k * Y * Y + c * OUT * Y;
    let peak = k * Y + c * OUT;
    let report =
        judge(&kelvin_voigt(k, c), &Expected { peak, absorbed, returned: 0.0, residual: Y });
    assert_eq!(report.notes, [Note::NothingBack]);
}

/// Force, work absorbed and returned of a Maxwell element beside a spring, with the zero where it is told.
fn relaxing(equilibrium: f64, stiffness: f64, damping: f64) -> Expected {
    let (tau, turn) = (damping / stiffness, Y / OUT);
    let grown = damping * OUT * -(-turn / tau).exp_m1();
    let back = |s: f64| {
        equilibrium * (Y - BACK * s) + (grown + damping * BACK) * (-s / tau).exp() - damping * BACK
    };
    let (mut low, mut high) = (0.0, Y / BACK);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if back(middle) > 0.0 { low = middle } else { high = middle }
    }
    let s = low;
    let way = Y - BACK * s;
    let decayed = (grown + damping * BACK) * tau * -(-s / tau).exp_m1();
    Expected {
        peak: equilibrium * Y + grown,
        absorbed: 0.5 * equilibrium * Y * Y
            + OUT * damping * OUT * (turn + tau * (-turn / tau).exp_m1()),
        returned: 0.5 * equilibrium * (Y * Y - way * way) + BACK * (decayed - damping * BACK * s),
        residual: way,
    }
}

#[test]
fn maxwell_and_zener_follow_their_exponentials() {
    judge(&maxwell(2e5, 4e3), &relaxing(0.0, 2e5, 4e3));
    let zener = Model::parallel([spring(1e5), maxwell(2e5, 4e3)]);
    judge(&zener, &relaxing(1e5, 2e5, 4e3));
}

#[test]
fn elastic_laws_return_all_that_they_absorb() {
    let elastic =
        |peak: f64, absorbed: f64| Expected { peak, absorbed, returned: absorbed, residual: 0.0 };
    let power = PowerSpring { force: 2e3, at: 8e-3, exponent: 1.5 };
    let ratio: f64 = Y / power.at;
    let absorbed = power.force * power.at * ratio.powf(2.5) / 2.5;
    judge(&part(power), &elastic(power.force * ratio.powf(1.5), absorbed));

    let text = parameters::Formula::parse("2 kN * tanh(y / 5 mm)", &|name| name == "y").unwrap();
    let formula = Formula::new(text, None, None).unwrap();
    judge(&part(formula), &elastic(2e3 * 2_f64.tanh(), 10.0 * 2_f64.cosh().ln()));

    let (radius, k) = (0.05, 1e6);
    let ball = Indenter {
        shape: Shape::Sphere,
        radius: Some(radius),
        diameter: None,
        length: None,
        pad_radius: None,
    };
    let columns = PI * k / ball.area().unwrap();
    let sphere = Foundation::new(Arc::new(Spring { stiffness: k }), ball).unwrap();
    let peak = columns * (radius * Y * Y - Y.powi(3) / 3.0);
    let absorbed = columns * (radius * Y.powi(3) / 3.0 - Y.powi(4) / 12.0);
    judge(&part(sphere), &elastic(peak, absorbed));
}

#[test]
fn a_table_loses_the_area_between_its_branches() {
    let loading = vec![(0.0, 0.0), (Y, 400.0)];
    let table = HystereticTable::new(loading, vec![(0.2 * Y, 0.0), (Y, 400.0)]).unwrap();
    // Back along 400 N (x − 0.2)/0.8 with x = y/Y.
    let returned = 0.5 * 400.0 * 0.8 * Y;
    let expected = Expected { peak: 400.0, absorbed: 200.0 * Y, returned, residual: 0.2 * Y };
    judge(&part(table), &expected);
}

#[test]
fn a_foam_loses_the_area_between_its_curves() {
    let foam = Foam {
        modulus: 2e6,
        plateau: 1e5,
        densification: 2e4,
        exponent: 3.0,
        thickness: 0.02,
        area: 0.01,
    };
    let crushed = HystereticFoam { foam, set: 0.2, unloading_exponent: 2.0 };
    let force = |y: f64| dashpot_network::Element::force(&foam, y, 0.0);
    let back = |y: f64| force(y) * ((y - 0.2 * Y) / (0.8 * Y)).powi(2);
    let expected = Expected {
        peak: force(Y),
        absorbed: integral(force, 0.0, Y),
        returned: integral(back, 0.2 * Y, Y),
        residual: 0.2 * Y,
    };
    judge(&part(crushed), &expected);
}

#[test]
fn laws_of_the_rate_lose_by_the_rates_of_both_ways() {
    let rate = RateSpring { force: 1e3, at: 0.01, exponent: 1.0, gain: 0.1, reference_rate: 0.01 };
    let (work, factor) = (0.5 * 1e3 * Y * Y / 0.01, 1.0 + 0.1 * (1.0 + OUT / 0.01_f64).ln());
    let expected =
        Expected { peak: 1e3 * factor, absorbed: work * factor, returned: work, residual: 0.0 };
    judge(&part(rate), &expected);

    let contact = HuntCrossley { force: 1e3, at: 0.01, dissipation: 0.4, exponent: 1.5, gap: 0.0 };
    let work = 1e3 * Y / 2.5;
    let expected = Expected {
        peak: 1e3 * (1.0 + 0.4 * OUT),
        absorbed: work * (1.0 + 0.4 * OUT),
        returned: work * (1.0 - 0.4 * BACK),
        residual: 0.0,
    };
    judge(&part(contact), &expected);
}

#[test]
fn a_force_that_stays_has_no_residual_deformation() {
    let report = cycle(&part(PreloadedSpring { stiffness: 2e4, preload: 200.0 }));
    let figure = report.figure("residual deformation").unwrap();
    assert_eq!((figure.computed, figure.note), (None, Some(Note::ForceLeft)));
    let absorbed = report.figure("energy absorbed").unwrap().computed.unwrap();
    assert!((absorbed - (200.0 * Y + 1e4 * Y * Y)).abs() < 1e-13);
}

#[test]
fn the_motion_turns_at_the_force_that_is_asked_for() {
    for model in [zener(), part(PowerSpring { force: 2e3, at: 8e-3, exponent: 1.5 })] {
        let specimen = Specimen::new(&model).unwrap();
        let test = protocol("load-unload", &[("force", 1234.0), ("rate", 0.1)]).unwrap();
        let report = test.run(&specimen, &methods_for(&specimen)).unwrap();
        let peak = report.figure("peak force").unwrap().computed.unwrap();
        assert!((peak - 1234.0).abs() < 1e-6 * 1234.0, "{peak}");
    }
    // A liquid bears no more than its damping times the rate.
    let error = refused(&maxwell(2e5, 4e3), "load-unload", &[("force", 500.0), ("rate", 0.1)]);
    assert!(matches!(error, RheometerError::ForceNotReached { .. }), "{error}");
}

#[test]
fn tension_mirrors_compression() {
    let run = |deformation: f64| {
        let given = [("deformation", deformation), ("rate", OUT)];
        run(&zener(), "load-unload", &given, &["exact"])
    };
    let (out, mirrored) = (run(Y), run(-Y));
    for (one, other) in out.figures.iter().zip(&mirrored.figures) {
        let (one, other) = (one.computed.unwrap_or(0.0), other.computed.unwrap_or(0.0));
        assert!((one.abs() - other.abs()).abs() <= 1e-9 * one.abs(), "{one} {other}");
    }
}

#[test]
fn other_tests_simulate_what_is_not_linear() {
    let power = part(PowerSpring { force: 2e3, at: 8e-3, exponent: 1.5 });
    let model = Model::parallel([power, dashpot(1e3)]);
    let specimen = Specimen::new(&model).unwrap();
    let given = [("rate", 0.1), ("end", 0.05)];
    let test = protocol("constant-rate", &given).unwrap();
    let report = test.run(&specimen, &methods_for(&specimen)).unwrap();
    let (times, found) = (&report.abscissa.values, &report.series[0].computed[0]);
    let error = found.error.unwrap();
    for (time, value) in times.iter().zip(&found.values).skip(1) {
        let expected = 2e3 * (0.1 * time / 8e-3).powf(1.5) + 100.0;
        let off = (value.unwrap() - expected).abs();
        assert!(off <= error + 1e-11, "{time}: {off:e}, {error:e} stated");
    }
    let error = refused(&model, "sweep", &[]);
    assert!(matches!(error, RheometerError::NeedsLinear { kind: "power-spring", .. }), "{error}");
}
