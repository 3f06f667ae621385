use std::f64::consts::PI;

use dashpot_analysis::measures::STANDARD_GRAVITY;

use super::*;

/// How a header is written.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is one way to write")]
struct Style {
    unit: &'static str,
    /// One of the unit in SI units.
    factor: f64,
    /// Columns of a name before the colon.
    width: usize,
    end: &'static str,
    is_lower: bool,
    has_comma: bool,
    has_mark: bool,
    /// Whether what is not known is written.
    has_no_value: bool,
}

const PLAIN: Style = Style {
    unit: "m/(s*s)",
    factor: 1.0,
    width: 28,
    end: "\n",
    is_lower: false,
    has_comma: false,
    has_mark: false,
    has_no_value: true,
};

const CODE: &str = "11HEAD0000H3ACXA";
const COUNT: usize = 200;

/// The value of a sample in SI units.
fn sample(at: usize) -> f64 {
    1500.0 * (PI * at as f64 / 100.0).sin()
}

fn line(style: Style, name: &str, value: &str) -> String {
    let name = if style.is_lower { name.to_lowercase() } else { name.to_owned() };
    format!("{name:width$}:{value}{}", style.end, width = style.width)
}

fn number(style: Style, value: f64) -> String {
    let text = format!("{value:.9}");
    if style.has_comma { text.replace('.', ",") } else { text }
}

/// A channel with these entries besides those that all have.
fn text(style: Style, entries: &[(&str, &str)], values: &[f64]) -> String {
    let mut text = if style.has_mark { "\u{feff}".to_owned() } else { String::new() };
    let mut all = vec![
        ("Test object number", "1"),
        ("Name of the channel", "Head acceleration X"),
        ("Channel code", CODE),
        ("Unit", style.unit),
    ];
    if style.has_no_value {
        all.extend([("Reference system", "NOVALUE"), ("Pre-filter type", "NOVALUE")]);
    }
    for (name, value) in all.into_iter().chain(entries.iter().copied()) {
        text += &line(style, name, value);
    }
    for value in values {
        text += &(number(style, *value) + style.end);
    }
    text
}

fn even() -> [(&'static str, &'static str); 4] {
    [
        ("Reference channel", "implicit"),
        ("Sampling interval", "0.0001"),
        ("Time of first sample", "-0.005"),
        ("Number of samples", "200"),
    ]
}

fn values(style: Style) -> Vec<f64> {
    (0..COUNT).map(|at| sample(at) / style.factor).collect()
}

#[test]
fn every_way_to_write_a_header_says_the_same() {
    let g = STANDARD_GRAVITY;
    let styles = [
        PLAIN,
        Style { unit: "g", factor: g, ..PLAIN },
        Style { unit: "G", factor: g, width: 0, ..PLAIN },
        Style { unit: "m/s**2", end: "\r\n", ..PLAIN },
        Style { unit: "m/s^2", is_lower: true, ..PLAIN },
        Style { unit: "m/sec2", has_comma: true, has_mark: true, ..PLAIN },
        Style { unit: "m/s2", has_no_value: false, width: 1, ..PLAIN },
        Style { unit: "mm/s^2", factor: 1e-3, width: 40, ..PLAIN },
    ];
    for style in styles {
        let text = text(style, &even(), &values(style));
        let found = read(&[&text]).unwrap().swap_remove(0);
        let code = found.code.unwrap();
        assert_eq!((code.text(), code.location()), (CODE, Some("HEAD")));
        assert_eq!(code.filter_class(), Some(1000.0));
        assert_eq!(found.prefilter, None);
        let channel = found.channel;
        assert_eq!(channel.name(), "Head acceleration X");
        assert_eq!(channel.dimension(), Dimension::ACCELERATION);
        assert!((channel.times()[0] + 0.005).abs() < 1e-15);
        assert!((channel.steps().rate - 10e3).abs() < 1e-6);
        for (at, value) in channel.values().iter().enumerate() {
            assert!((value - sample(at)).abs() < 1e-7, "{}: {value}", style.unit);
        }
    }
}

#[test]
fn times_may_be_a_channel_of_their_own() {
    let explicit = [("Reference channel", "explicit"), ("Reference channel name", "TIMES")];
    let times: Vec<f64> =
        (0..COUNT).map(|at| 1e-4 * at as f64 * (1.0 + 1e-3 * at as f64)).collect();
    let own = text(PLAIN, &explicit, &values(PLAIN));
    let reference = text(Style { unit: "s", ..PLAIN }, &[], &times)
        .replace("Head acceleration X", "TIMES")
        .replace(CODE, "11HEAD0000H3TI0A");
    let found = read(&[&own, &reference]).unwrap();
    assert_eq!(found.len(), 1);
    assert!((found[0].channel.times()[150] - times[150]).abs() < 1e-9);
    let (at, fault) = read(&[&own]).unwrap_err();
    let name = "TIMES".to_owned();
    assert_eq!((at, fault.line, fault.fault), (0, 8, MmeFault::NoReference { name }));
}

#[test]
fn broken_texts_are_refused_by_line() {
    let whole = text(PLAIN, &even(), &values(PLAIN));
    let first = 11;
    assert!(whole.lines().nth(first - 1).is_some_and(|own| own.parse::<f64>().is_ok()));
    for (from, to, line, words) in [
        ("Unit", "Unet", 11, "there is no entry `Unit`"),
        (":m/(s*s)", ":furlong", 4, "`furlong` is not a known unit"),
        (":m/(s*s)", ":NOVALUE", 11, "there is no entry `Unit`"),
        (":0.0001", ":0", 8, "`Sampling interval` is `0`"),
        (":0.0001", ":fast", 8, "`Sampling interval` is `fast`"),
        ("Sampling interval", "Sampling", 11, "there is no entry `Sampling interval`"),
        (":-0.005", ":soon", 9, "`Time of first sample` is `soon`"),
        (":200", ":201", 10, "there are 200 samples, and `Number of samples` is 201"),
        (":200", ":many", 10, "`Number of samples` is `many`"),
        ("47.116138617", "x", 12, "`x` is not a number"),
        ("47.116138617", "NaN", 12, "`NaN` is not finite"),
        ("47.116138617", "1 2", 12, "`1 2` is not a number"),
    ] {
        assert!(whole.contains(from), "{from}");
        let (at, error) = read(&[&whole.replacen(from, to, 1)]).unwrap_err();
        let message = error.to_string();
        assert_eq!((at, error.line), (0, line), "{from} → {to}: {message}");
        assert!(message.contains(words), "{message}");
    }
    let stray = whole.replacen("Unit", "no colon here\nUnit", 1);
    assert!(matches!(read(&[&stray]).unwrap_err().1.fault, MmeFault::NoEntry { .. }));
    let empty = text(PLAIN, &even()[..3], &[]);
    let fault = read(&[&empty]).unwrap_err().1.fault;
    assert_eq!(fault, MmeFault::Samples(ChannelFault::TooFew { count: 0 }));
    assert!(read(&[""]).is_err());
}

#[test]
fn a_code_of_another_length_says_nothing() {
    let code = ChannelCode::new("11HEAD");
    assert_eq!((code.location(), code.filter_class()), (None, None));
}
