//! Quantities, tables of numbers, and values from the command line.

use dashpot::{
    network::parameters::Dimension,
    scene::{
        ReadOptions, read,
        units::{format_quantity, parse_dimension, parse_quantity},
    },
};
use proptest::prelude::*;

use super::{
    config,
    mutations::{damage, damaged},
};

/// Pieces of quantities.
const TOKENS: &[&str] = &[
    "1", "-", "+", ".", ",", "e", "E", "9", "0", "e308", "e-320", "_", " ", "\t", "\u{a0}", "/",
    "*", "·", "^", "²", "³", "⁻", "^-1", "^99999", "(", ")", "k", "M", "µ", "u", "n", "p", "T",
    "d", "c", "N", "m", "s", "g", "kg", "t", "lb", "lbf", "in", "ft", "min", "h", "Pa", "Hz", "J",
    "W", "K", "degC", "°C", "mol", "g0", "%", "rad", "deg", "°", "nan", "inf", "km/h", "rad/s",
    "🦀", "\u{0}", "−", "∞", "½",
];

/// A file of numbers as the points of a load.
const TABLE: &str = "[nodes]\na = { mass = 1 }\n[elements]\nk = { between = [\"a\", \"ground\"], \
                     spring = 1 }\n[loads.f]\non = \"a\"\nforce = { table = \"t.csv\" }\n[run]\n\
                     duration = 1\n";

/// A scene whose numbers may be set from outside.
const SET: &str = "[values]\nK = \"20 kN/m\"\nt = \"1 s\"\n[nodes]\na = { mass = 1 }\n[elements]\n\
                   k = { between = [\"a\", \"ground\"], spring = \"K\" }\n[run]\nduration = \"t\"\n";

/// What is wrong with how a quantity is read.
pub(super) fn check_quantity(text: &str) -> Result<(), String> {
    let _ = parse_dimension(text);
    match parse_quantity(text) {
        Ok(quantity) if !quantity.value.is_finite() => {
            Err(format!("`{text}` is {}", quantity.value))
        }
        Ok(quantity) => {
            let dimension = quantity.dimension.unwrap_or(Dimension::NUMBER);
            let shown = format_quantity(quantity.value, dimension, 17);
            let again = parse_quantity(&shown).map_err(|error| format!("`{shown}`: {error}"))?;
            let off = (again.value - quantity.value).abs();
            let is_same = off <= 4.0 * f64::EPSILON * quantity.value.abs();
            if !is_same || again.dimension.unwrap_or(Dimension::NUMBER) != dimension {
                return Err(format!("`{text}` is shown as `{shown}`"));
            }
            Ok(())
        }
        Err(error) if error.to_string().is_empty() => Err(format!("`{text}`: no reason")),
        Err(_) => Ok(()),
    }
}

/// What is wrong with how a table is read.
pub(super) fn check_table(text: &str) -> Result<(), String> {
    let load = |_: &str| Ok(text.into());
    let options =
        ReadOptions { file: Some("scene.toml"), loader: Some(&load), ..ReadOptions::default() };
    match read(TABLE, &options) {
        Ok(checked) => {
            let force = &checked.value.network.loads()[0].force;
            let bound = force.bound(1.0);
            if bound.is_finite() { Ok(()) } else { Err(format!("a force of {bound}")) }
        }
        Err(errors) => within(&errors),
    }
}

fn within(errors: &dashpot::scene::Diagnostics) -> Result<(), String> {
    if errors.is_empty() || errors.render(false).is_empty() {
        return Err("refused without a reason".to_owned());
    }
    errors.list.iter().try_for_each(|own| match (&own.span, &own.source) {
        (Some(span), Some(source)) if source.text.get(span.clone()).is_none() => {
            Err(format!("{span:?} is no part of the text: {}", own.message()))
        }
        _ => Ok(()),
    })
}

fn tokens(most: usize) -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(TOKENS), 0..most).prop_map(|own| own.concat())
}

fn rows() -> impl Strategy<Value = String> {
    let cell = prop_oneof![
        6 => (-1e3..1e3f64).prop_map(|value| format!("{value}")),
        1 => tokens(4),
        1 => prop::sample::select(vec!["", "\"", "\"a\"", "#", "time [ms]", "force (kN)", "1e999"])
            .prop_map(str::to_owned),
    ];
    let separator = prop::sample::select(vec![",", ";", "\t", " , ", ",,"]);
    let end = prop::sample::select(vec!["\n", "\r\n", "\r", "\n\n"]);
    (prop::collection::vec(prop::collection::vec(cell, 0..4), 0..12), separator, end, any::<bool>())
        .prop_map(|(rows, separator, end, is_sorted)| {
            let line = |(at, cells): (usize, &Vec<String>)| {
                let mut cells = cells.clone();
                if is_sorted && let Some(first) = cells.first_mut() {
                    *first = format!("{at}");
                }
                cells.join(separator)
            };
            rows.iter().enumerate().map(line).collect::<Vec<_>>().join(end)
        })
}

fn fail(what: String) -> TestCaseError {
    TestCaseError::fail(what)
}

proptest! {
    #![proptest_config(config(4000))]

    #[test]
    fn quantities_are_read_or_refused(text in tokens(10)) {
        check_quantity(&text).map_err(fail)?;
    }

    #[test]
    fn numbers_with_units_are_read_or_refused(
        number in prop_oneof![any::<f64>(), -1e6..1e6f64],
        unit in tokens(5),
    ) {
        check_quantity(&format!("{number:e} {unit}")).map_err(fail)?;
    }

    #[test]
    fn any_text_is_no_quantity_that_panics(text in any::<String>()) {
        check_quantity(&text).map_err(fail)?;
    }
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn tables_are_read_or_refused(text in rows(), damage in damage()) {
        let bytes = damaged(text.as_bytes(), &damage);
        let text = String::from_utf8_lossy(&bytes);
        check_table(&text).map_err(|what| fail(format!("{what}\n{text:?}")))?;
    }

    #[test]
    fn values_from_outside_are_taken_or_refused(
        name in prop_oneof![Just("K".to_owned()), Just("t".to_owned()), tokens(3)],
        value in tokens(8),
    ) {
        let set = [(name, value)];
        let options = ReadOptions { file: Some("scene.toml"), set: &set, ..ReadOptions::default() };
        if let Err(errors) = read(SET, &options) {
            within(&errors).map_err(|what| fail(format!("{what}: {set:?}")))?;
        }
    }
}
