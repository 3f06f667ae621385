use dashpot_units::{Dimension, Quantity, parse_quantity};

use super::*;

fn named(name: &str) -> Option<Quantity> {
    let text = match name {
        "A" => "50 cm^2",
        "m" => "80 kg",
        "h" => "25 mm",
        "n" => "3",
        "K-pad" => "20 MN/m",
        "K" => "7 MN/m",
        _ => return None,
    };
    parse_quantity(text).ok()
}

fn is_name(name: &str) -> bool {
    named(name).is_some() || ["y", "v", "t"].contains(&name)
}

fn value(text: &str) -> Result<Quantity, FormulaError> {
    Formula::parse(text, &is_name)?.quantity(&named)
}

#[test]
fn arithmetic_follows_the_rules_of_algebra_and_units_bind_to_their_numbers() {
    let cases = [
        ("2 * A * 100 kPa", 1000.0, Dimension::FORCE),
        ("m * g0 / A", 80.0 * 9.80665 / 5e-3, Dimension::PRESSURE),
        ("100 kPa * A / h", 1e5 * 5e-3 / 0.025, Dimension::STIFFNESS),
        ("sqrt(2 * g0 * 0.76 m)", (2.0 * 9.80665 * 0.76_f64).sqrt(), Dimension::VELOCITY),
        ("1/2 * m * (5 m/s)^2", 1000.0, Dimension::ENERGY),
        ("2 * 5 mm^2", 1e-5, Dimension::new(0, 2, 0)),
        ("-5 mm + 2 * 10 mm", 0.015, Dimension::LENGTH),
        ("2 * 6 kN s/m", 12e3, Dimension::DAMPING),
        ("2 * 6 kN/(m/s)", 12e3, Dimension::DAMPING),
        ("6 kN/m * h", 150.0, Dimension::FORCE),
        ("6 kN * h", 150.0, Dimension::ENERGY),
        ("2 * K-pad", 4e7, Dimension::STIFFNESS),
        ("2 * (K - 2 MN/m)", 1e7, Dimension::STIFFNESS),
        ("max(0, h - 30 mm) + h", 0.025, Dimension::LENGTH),
        ("K * (1 - 50 %)", 3.5e6, Dimension::STIFFNESS),
        ("5 N * (h / 1 mm)^2", 3125.0, Dimension::FORCE),
        ("2 * 3 kN/(m/s)", 6e3, Dimension::DAMPING),
        ("2^-n * 8 mm", 1e-3, Dimension::LENGTH),
        ("-2^2 * 1 mm", -4e-3, Dimension::LENGTH),
        ("2^3^2 * 1 mm", 0.512, Dimension::LENGTH),
        ("20 kN / 5 mm", 4e6, Dimension::STIFFNESS),
        ("A^0.5", 5e-3_f64.sqrt(), Dimension::LENGTH),
        ("pi * (5 cm)^2", std::f64::consts::PI * 25e-4, Dimension::new(0, 2, 0)),
    ];
    for (text, expected, dimension) in cases {
        let found = value(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert!((found.value / expected - 1.0).abs() < 1e-14, "{text}: {found:?}");
        assert_eq!(found.dimension, Some(dimension), "{text}");
        assert!(is_arithmetic(text, &is_name), "{text}");
    }
    assert_eq!(value("n / 2 + 1").map(|own| (own.value, own.dimension)), Ok((2.5, None)));
}

#[test]
fn what_is_no_arithmetic_is_left_to_the_reader_of_quantities() {
    for text in [
        "20 MN/m",
        "20 MM/m",
        "K",
        "12 000 N",
        "5,5 mm",
        "0.5 1/MPa",
        "steel",
        "",
        "6 kN*s/m",
        "-3 mm",
    ] {
        assert!(!is_arithmetic(text, &is_name), "{text}");
    }
    for text in [
        "20 MM/m * 2",
        "Q * 2",
        "12-15 mm",
        "2 * K",
        "sqrt(2)",
        "g0",
        "1/3",
        "20 kN / m",
        "6 kN/m * h",
    ] {
        assert!(is_arithmetic(text, &is_name), "{text}");
    }
}

#[test]
fn faults_say_what_is_wrong_and_where() {
    let cases = [
        ("2 * B * 100 kPa", "there is no value named `B`", 4..5),
        ("h + 3 kN", "`h` is a length (m) and `3 kN` is a force (N): they cannot be added", 0..8),
        ("h + 3", "`h` is a length (m) and `3` is a pure number: they cannot be added", 0..5),
        ("2 * (h + 1 mm", "a closing parenthesis is expected here, where the text ends", 13..13),
        ("2 * * h", "a number or a name is expected here, not `*`", 4..5),
        ("2 * 100 kPx", "`kPx` is not a known unit", 4..11),
        ("K h", "an operation, + - * / or ^, is expected here, not `h`", 2..3),
        ("sinh(h)", "`h` is a length (m), where a pure number has to stand", 5..6),
        (
            "h^1.2345",
            "`h^1.2345` has no dimension: a length (m) cannot be raised to such a power",
            0..8,
        ),
        ("1 / (n - 3)", "`1 / (n - 3)` has no finite value", 0..11),
        ("sqr(2)", "`sqr` is not a function", 0..3),
        ("max(h)", "`max` takes 2 numbers, but here are 1", 0..6),
        ("2 * 20 kN / m", "`m` is both a unit and a name here", 12..13),
        ("1,5 * h", "`1,5 * h` has a comma: decimals are written with a point", 1..2),
        ("2 * 20 degC", "`20 degC` has degrees Celsius in it", 4..11),
    ];
    for (text, message, span) in cases {
        let error = value(text).expect_err(text);
        assert!(error.to_string().starts_with(message), "{text}: {error}");
        assert_eq!(error.span, span, "{text}: {error}");
    }
    let deep = "(".repeat(200) + "1" + &")".repeat(200);
    assert!(value(&deep).is_err_and(|error| error.fault == FormulaFault::TooLong));
    assert!(value(&"-".repeat(900)).is_err_and(|error| error.fault == FormulaFault::TooLong));
}

const VARIABLES: [Variable; 2] = [("y", Dimension::LENGTH), ("v", Dimension::VELOCITY)];

fn law(text: &str) -> Expression {
    let formula = Formula::parse(text, &is_name).unwrap_or_else(|error| panic!("{text}: {error}"));
    let formula = formula.with(&named);
    formula.law(&VARIABLES, Dimension::FORCE).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn at(expression: &Expression, y: f64, v: f64) -> f64 {
    Program::of([expression]).value(&[y, v])
}

const LAWS: [&str; 12] = [
    "K * y * (1 + (y / 5 mm)^2)",
    "2 kN * tanh(y / 3 mm) + 50 N s/m * v",
    "2 kN * sinh(y / 3 mm) * (1 + 0.1 * tanh(v / 1 m/s))",
    "1 MN/m * max(0, y - 4 mm)",
    "2 kN * (max(0, y) / 5 mm)^1.5",
    "2 kN * (exp(y / 5 mm) - 1)",
    "3 kN * abs(y) / 5 mm * y / h",
    "2 kN * y / (20 mm - y)",
    "4 kN * tan(y / 20 mm) - 20 N s/m * -v",
    "1 kN * ln(1 + abs(v) / 1 m/s) * y / 1 mm",
    "2 kN * (1.5 + y / 50 mm)^(y / 5 mm) + 1 kN * atan(y / 1 mm) + 1 kN * asin(y / 50 mm)",
    "min(200 N, K * y) + 2 kN * sqrt(4 + y / 20 mm) - 1 kN * acos(y / 50 mm) + 1 kN * log10(2 + y / 9 mm)",
];

#[test]
fn derivatives_are_the_limits_of_differences_and_integrals_lead_back() {
    for text in LAWS {
        let own = law(text);
        for (y, v) in [(6.3e-3, 0.7), (2.1e-3, -1.3), (-3.7e-3, 0.4)] {
            for (variable, step) in [(0, 1e-7), (1, 1e-4)] {
                let slope = at(&own.derivative(variable), y, v);
                let moved = |sign: f64| {
                    let (dy, dv) = if variable == 0 { (step, 0.0) } else { (0.0, step) };
                    at(&own, y + sign * dy, v + sign * dv)
                };
                let difference = (moved(1.0) - moved(-1.0)) / (2.0 * step);
                // Truncation h² F‴/6 and rounding ε F/h.
                let size = difference.abs().max(at(&own, y, v).abs() / step * 1e-7);
                assert!((slope - difference).abs() <= 2e-6 * size, "{text}: {slope} {difference}");
            }
            if let Some(whole) = own.integral(0) {
                let (back, force) = (at(&whole.derivative(0), y, v), at(&own, y, v));
                assert!(
                    (back - force).abs() <= 1e-12 * force.abs().max(1.0),
                    "{text}: {back} {force}"
                );
            }
        }
    }
    let closed = LAWS.iter().filter(|text| law(text).integral(0).is_some()).count();
    assert_eq!(closed, 7);
}

#[test]
fn structure_is_seen() {
    let linear = law("2 * K * y - K * y / 4");
    assert_eq!(linear.polynomial(0), Some(vec![0.0, 7e6 * 1.75]));
    assert!(!linear.depends_on(1));
    assert!(linear.derivative(1).is_zero());
    assert!(!law("0 * v * 1 N s/m + K * y").depends_on(1));
    assert_eq!(law("K * y + 6 N s/m * v").polynomial(0), None);
}

#[test]
fn what_is_written_is_read_back_as_the_same() {
    for text in LAWS.iter().copied().chain([
        "-(y - v * 1 s) * K",
        "2 kN / (3 / (y / 1 mm))",
        "(2 kN)^2 / 1 N",
    ]) {
        let own = Formula::parse(text, &is_name).map(|own| own.with(&named));
        let written = own.as_ref().map(ToString::to_string).unwrap_or_default();
        let again = Formula::parse(&written, &is_name);
        assert_eq!(own, again, "{text} became {written}");
    }
    let stress = Formula::parse("100 kPa * tanh(y / 20 %)", &is_name);
    let quantity = |text| parse_quantity(text).expect("a quantity");
    let force = stress.map(|own| own.scaled(quantity("50 cm^2"), &["y"], quantity("25 mm")));
    let force = force.and_then(|own| own.law(&VARIABLES, Dimension::FORCE)).expect("a force");
    assert!((at(&force, 5e-3, 0.0) - 500.0 * 1_f64.tanh()).abs() < 1e-9);
}

#[test]
fn nothing_is_computed_twice() {
    let own = law("2 kN * tanh(y / 3 mm)");
    let program = Program::of([&own, &own.derivative(0)]);
    let mut values = [0.0; 2];
    program.evaluate(&[3e-3, 0.0], &mut values);
    assert!((values[0] - 2e3 * 1_f64.tanh()).abs() < 1e-9);
    let slope = 2e3 / 3e-3 * (1.0 - 1_f64.tanh().powi(2));
    assert!((values[1] / slope - 1.0).abs() < 1e-12);
}
