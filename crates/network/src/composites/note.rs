//! What is to be said of a model made from a description, as data.

use std::fmt;

use dashpot_units::format_short;

use crate::parameters::Dimension;

dashpot_units::words! {
    /// What is to be said of a model made from a description.
    #[derive(Debug, Clone, PartialEq)]
    pub enum CompositeNote, pub fn code(&self) {
        /// So many Kelvin elements stand for a fibre.
        CreepKept {
            /// How many.
            elements: usize,
            /// Within which part of itself they keep the creep.
            error: f64,
            /// From when to when \[s\].
            range: [f64; 2],
            /// Within which part of itself one element less could keep it at best; `None` where that is not proved.
            one_less: Option<f64>,
        } = "creep-kept",
        /// The terms of a list are taken in rising order of time.
        Reordered {
            /// The branch that is the fastest.
            fastest: &'static str,
        } = "reordered",
    }
}

impl fmt::Display for CompositeNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CreepKept { elements: count, error, range: [from, to], one_less } => {
                let keep = if *count == 1 { "element keeps" } else { "elements keep" };
                let (error, from, to) = (percent(*error, f64::ceil), time(*from), time(*to));
                write!(f, "{count} Kelvin {keep} the creep within {error} from {from} to {to}")?;
                match (count, one_less) {
                    (1, _) => Ok(()),
                    (_, Some(less)) => {
                        let less = percent(*less, f64::floor);
                        write!(f, " ({} cannot do better than {less})", count - 1)
                    }
                    (_, None) => write!(f, " (whether fewer could is not proved)"),
                }
            }
            Self::Reordered { fastest } => {
                write!(f, "the terms are taken in rising order of time: `{fastest}` is the fastest")
            }
        }
    }
}

/// A positive number in percent with two significant digits, rounded as told.
pub(super) fn percent(number: f64, round: fn(f64) -> f64) -> String {
    let percents = number * 100.0;
    let power = percents.log10().floor() - 1.0;
    // Numbers of two digits, like 0.1 %, must not move by rounding errors.
    let digits = percents * 10.0_f64.powf(-power);
    let nearest = digits.round();
    let digits = if (digits - nearest).abs() < 1e-9 { nearest } else { round(digits) };
    let rounded = format!("{:.1e}", digits * 10.0_f64.powf(power)).parse().unwrap_or(percents);
    if power < -6.0 { format!("{rounded:e} %") } else { format!("{rounded} %") }
}

/// A time in a handy unit, with up to four significant digits.
pub(super) fn time(seconds: f64) -> String {
    format_short(seconds, Dimension::TIME, 4)
}
