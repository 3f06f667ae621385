use super::*;

fn value(text: &str) -> f64 {
    parse_quantity(text).unwrap().value
}

fn error(text: &str) -> String {
    parse_quantity(text).unwrap_err().to_string()
}

#[test]
fn quantities_are_read_to_the_last_bit() {
    let table: &[(&str, f64, Dimension)] = &[
        ("20 MN/m", 2e7, Dimension::STIFFNESS),
        ("20MN/m", 2e7, Dimension::STIFFNESS),
        ("6 kN s/m", 6e3, Dimension::DAMPING),
        ("6 kN*s/m", 6e3, Dimension::DAMPING),
        ("6 kN·s/m", 6e3, Dimension::DAMPING),
        ("6 kN/(m/s)", 6e3, Dimension::DAMPING),
        ("6 kN s m^-1", 6e3, Dimension::DAMPING),
        ("6 kN s m⁻¹", 6e3, Dimension::DAMPING),
        ("6 kg/s", 6.0, Dimension::DAMPING),
        ("10 ms", 0.01, Dimension::TIME),
        ("9.3 ms", 9.3e-3, Dimension::TIME),
        ("0.1 mN", 1e-4, Dimension::FORCE),
        ("2 cm", 0.02, Dimension::LENGTH),
        ("3 µm", 3e-6, Dimension::LENGTH),
        ("3 um", 3e-6, Dimension::LENGTH),
        ("3 μm", 3e-6, Dimension::LENGTH),
        ("9.81 m/s^2", 9.81, Dimension::ACCELERATION),
        ("9.81 m/s²", 9.81, Dimension::ACCELERATION),
        ("9.81 m/s2", 9.81, Dimension::ACCELERATION),
        ("1 g0", 9.806_65, Dimension::ACCELERATION),
        ("50 Hz", 50.0, Dimension::FREQUENCY),
        ("50 1/s", 50.0, Dimension::FREQUENCY),
        ("0.1 %", 1e-3, Dimension::NUMBER),
        ("180 deg", std::f64::consts::PI, Dimension::NUMBER),
        ("36 km/h", 10.0, Dimension::VELOCITY),
        ("1 in", 0.0254, Dimension::LENGTH),
        ("1 lb", 0.453_592_37, Dimension::MASS),
        ("500 J", 500.0, Dimension::ENERGY),
        ("-2.5e-3 kN", -2.5, Dimension::FORCE),
        (".5 t", 500.0, Dimension::MASS),
        ("1e3 g", 1.0, Dimension::MASS),
        ("3 N s", 3.0, Dimension::IMPULSE),
        ("2 MPa", 2e6, Dimension::PRESSURE),
        ("5 kPa s", 5e3, Dimension::VISCOSITY),
        ("0.05 mm/kN", 5e-8, Dimension::COMPLIANCE),
        ("300 K", 300.0, Dimension::TEMPERATURE),
        ("20 degC", 293.15, Dimension::TEMPERATURE),
        ("20°C", 293.15, Dimension::TEMPERATURE),
        ("-40 °C", 233.15, Dimension::TEMPERATURE),
        ("80 kJ/mol", 80e3 / 6.022_140_76e23, Dimension::ENERGY),
        ("1 mmol", 6.022_140_76e20, Dimension::NUMBER),
    ];
    for &(text, expected, dimension) in table {
        let quantity = parse_quantity(text).unwrap();
        let close = (quantity.value - expected).abs() <= 2.0 * f64::EPSILON * expected.abs();
        assert!(close, "{text}: {} != {expected}", quantity.value);
        assert_eq!(quantity.dimension, Some(dimension), "{text}");
    }
    for (text, bits) in [("9.3 ms", 9.3e-3_f64), ("0.1 mN", 1e-4), ("7.3 kN/m", 7300.0)] {
        assert_eq!(value(text).to_bits(), bits.to_bits(), "{text}");
    }
}

#[test]
fn what_is_no_quantity_is_refused_in_plain_words() {
    assert_eq!(error("nan"), "`nan` is not finite: every quantity is a finite number");
    assert!(matches!(parse_quantity("-inf N"), Err(UnitError::NotFinite { .. })));
    assert!(matches!(parse_quantity("1e400"), Err(UnitError::TooLarge { .. })));
    assert!(matches!(parse_quantity("1e305 GN/m"), Err(UnitError::TooLarge { .. })));
    assert!(matches!(parse_quantity("1e-320 nm"), Err(UnitError::TooSmall { .. })));
    assert!(parse_quantity("1e-310 m").is_ok() && parse_quantity("0e-999 nm").is_ok());
    assert!(matches!(parse_quantity("0,5 kN"), Err(UnitError::DecimalComma { .. })));
    for text in ["", " ", "N", "-", "kN 5", ".", "e5", "+-1"] {
        assert!(matches!(parse_quantity(text), Err(UnitError::NoNumber { .. })), "{text:?}");
    }
    let bad = ["5 N/", "5 /N", "5 N//m", "5 (N", "5 N)", "5 m^", "5 m^x", "5 ()", "5 N**m", "5 ²"];
    for text in bad {
        assert!(parse_quantity(text).is_err(), "{text:?}");
    }
    assert!(parse_quantity(&format!("5 {}", "m ".repeat(90))).is_ok());
    assert!(parse_quantity(&format!("5 {}", "m^9 ".repeat(40))).is_err());
    assert!(parse_quantity(&"9".repeat(1000)).is_err());
}

#[test]
fn an_exponent_needs_digits() {
    assert!(matches!(parse_quantity("5 e"), Err(UnitError::UnknownUnit { .. })));
    assert!(matches!(parse_quantity("5e"), Err(UnitError::UnknownUnit { .. })));
    assert!(matches!(parse_quantity("1e99999999999"), Err(UnitError::TooLarge { .. })));
    assert!(matches!(parse_quantity("1e-99999999999"), Err(UnitError::TooSmall { .. })));
}

#[test]
fn angular_frequency_is_told_from_frequency() {
    assert_eq!(parse_quantity("5 rad/s").unwrap().angle, 1);
    assert_eq!(parse_quantity("5 Hz").unwrap().angle, 0);
}

#[test]
fn degrees_celsius_stand_alone_and_are_no_difference() {
    assert!(parse_quantity("20 degC").unwrap().is_celsius);
    assert!(!parse_quantity("293.15 K").unwrap().is_celsius);
    assert_eq!(parse_quantity("-273.15 degC").unwrap().value.to_bits(), 0);
    for text in ["5 degC/min", "5 W/(m °C)", "5 N degC", "5 degC^2", "5 degC degC"] {
        let found = parse_quantity(text);
        assert!(matches!(found, Err(UnitError::CelsiusInProduct { .. })), "{text}: {found:?}");
    }
    assert!(matches!(parse_quantity("1e400 degC"), Err(UnitError::TooLarge { .. })));
    assert!(matches!(parse_quantity("20 mdegC"), Err(UnitError::UnknownUnit { .. })));
    assert_eq!(parse_dimension("degC"), Ok(Dimension::TEMPERATURE));
}

#[test]
fn energies_of_molecules_are_written_for_a_mole() {
    let exact = |text: &str| exact_quantity(value(text), Dimension::ENERGY);
    for text in ["80 kJ/mol", "52.9 kJ/mol", "7.5 kJ/mol", "0.001 kJ/mol"] {
        assert_eq!(exact(text), text);
    }
    assert_eq!(exact("500 J"), "500 J");
    assert_eq!(exact("0 J"), "0 J");
}

#[test]
fn values_are_written_in_handy_units() {
    let table: &[(f64, Dimension, usize, &str)] = &[
        (38_359.41, Dimension::FORCE, 4, "38.36 kN"),
        (0.007_425_568, Dimension::TIME, 3, "7.43 ms"),
        (0.017_538, Dimension::LENGTH, 4, "17.54 mm"),
        (3835.94, Dimension::ACCELERATION, 4, "3836 m/s^2"),
        (999.96, Dimension::FORCE, 4, "1.000 kN"),
        (-0.0123, Dimension::VELOCITY, 2, "-12 mm/s"),
        (500.0, Dimension::ENERGY, 3, "500 J"),
        (0.0, Dimension::FORCE, 4, "0 N"),
        (2e7, Dimension::STIFFNESS, 3, "20.0 MN/m"),
        (1e-13, Dimension::LENGTH, 2, "0.00010 nm"),
        (1e-20, Dimension::LENGTH, 2, "1.0e-11 nm"),
        (1e12, Dimension::ENERGY, 2, "1.0e6 MJ"),
        (0.1234, Dimension::NUMBER, 2, "0.12"),
        (2.5e6, Dimension::PRESSURE, 2, "2.5 MPa"),
        (5e3, Dimension::VISCOSITY, 1, "5 kPa s"),
        (5e-8, Dimension::COMPLIANCE, 2, "50 nm/N"),
        (293.15, Dimension::TEMPERATURE, 5, "293.15 K"),
        (
            5.0,
            Dimension { temperature: Exponent::whole(-1), ..Dimension::new(1, -1, 0) },
            1,
            "5 kg m^-1 K^-1",
        ),
        (3e8, Dimension::new(1, -2, -2), 1, "3e8 N/m^3"),
        (4.0, Dimension::new(1, 3, -1), 1, "4 N s m^2"),
        (383.0, Dimension::FORCE, 2, "380 N"),
        (f64::INFINITY, Dimension::FORCE, 4, "inf N"),
        (f64::NAN, Dimension::NUMBER, 4, "NaN"),
        (5e-324, Dimension::FORCE, 0, "5e-318 µN"),
    ];
    for &(value, dimension, digits, expected) in table {
        assert_eq!(format_quantity(value, dimension, digits), expected);
    }
    assert_eq!(format_short(2e7, Dimension::STIFFNESS, 4), "20 MN/m");
    assert_eq!(format_short(100.0, Dimension::MASS, 1), "100 kg");
    assert_eq!(format_short(0.25, Dimension::NUMBER, 4), "0.25");
}

#[test]
fn digits_that_come_from_rounding_are_not_written() {
    let written = |value, dimension| exact_quantity(value, dimension);
    assert_eq!(written(1.999_999_999_999_999_8, Dimension::VELOCITY), "2 m/s");
    assert_eq!(written(3.000_000_000_000_000_3e-4, Dimension::TIME), "300 µs");
    assert_eq!(written(480.000_000_000_000_06, Dimension::DAMPING), "480 N s/m");
    assert_eq!(written(0.1 + 0.2, Dimension::LENGTH), "300 mm");
    // More than rounding, or more digits than people write.
    for value in [2.000_000_000_000_01, 1.0 / 3.0, 0.123_456_789_012_345_67] {
        let back = parse_quantity(&written(value, Dimension::LENGTH)).unwrap().value;
        assert_eq!(back.to_bits(), value.to_bits());
    }
}

#[test]
fn exact_text_comes_back_to_the_same_bits() {
    let named = Dimension::all_named().collect::<Vec<_>>();
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    for at in 0..20_000_usize {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let value = f64::from_bits(bits ^ (bits >> 29));
        if !value.is_finite() {
            continue;
        }
        let dimension = named[at % named.len()];
        let text = exact_quantity(value, dimension);
        let back = parse_quantity(&text).unwrap().value;
        assert_eq!(back.to_bits(), tidy(value).to_bits(), "{text}");
        assert!(((back - value) / value).abs() < 4.5e-16, "{text}");
    }
}

#[test]
fn powers_that_are_no_whole_numbers_are_read_and_written() {
    let half = |length: f64| Dimension {
        length: Exponent::of(length).unwrap(),
        ..Dimension::new(1, 0, -2)
    };
    let close = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-15, "{found}");
    let hertz = parse_quantity("2.75e9 N/m^1.5").unwrap();
    assert_eq!(hertz.dimension, Some(half(-0.5)));
    close(hertz.value, 2.75e9);
    // 1 kN/mm^1.5 is 10³ N over 10^−4.5 m^1.5; a Tsuji damping has m^1.25.
    close(value("3 kN/mm^1.5"), 3.0 * 10_f64.powf(7.5));
    close(value("3 kN/mm^(3/2)"), 3.0 * 10_f64.powf(7.5));
    close(value("2 m^(-1/3)"), 2.0);
    assert_eq!(
        parse_dimension("N s/m^1.25"),
        Ok(Dimension { time: Exponent::whole(-1), ..half(-0.25) })
    );
    for text in ["N/m^1.5", "N m^0.5", "N/m^0.25", "kg m^(1/3)", "N/m^2.35"] {
        let dimension = parse_dimension(text).unwrap();
        assert_eq!(si_unit(dimension), text);
        assert_eq!(parse_dimension(&si_unit(dimension)), Ok(dimension));
    }
    for text in ["1 N/m^1.2345", "1 m^", "1 m^(1/0)", "1 m^(1", "1 m^1.2.3", "1 deg^0.5"] {
        assert!(parse_quantity(text).is_err(), "{text}");
    }
}
