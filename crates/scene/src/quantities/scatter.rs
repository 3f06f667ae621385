//! Numbers with scatter: `20 ± 2 MN/m`.

use dashpot_formula::is_arithmetic;
use dashpot_units::{UnitError, parse_quantity};
use thiserror::Error;

use crate::vary::variation::{Written, handy};

/// The sign between a mean and its standard deviation, and what may be typed in its place.
const SIGNS: [&str; 2] = ["±", "+-"];

/// A mean and a standard deviation as they are written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scatter {
    /// The mean as a quantity.
    pub(crate) text: String,
    /// The mean in its unit.
    pub(crate) mean: f64,
    /// The standard deviation in the same unit, not negative.
    pub(crate) deviation: f64,
    /// The unit, empty where there is none.
    pub(crate) unit: String,
}

/// Why a number has no scatter.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ScatterFault {
    /// The mean is computed.
    #[error("`{text}` is computed, and has no scatter of its own")]
    Computed { text: String },
    /// The mean cannot be read.
    #[error("{error}")]
    Mean { error: UnitError },
    /// The standard deviation cannot be read.
    #[error("the standard deviation behind `±`: {error}")]
    Deviation { error: UnitError },
    /// The mean has a unit, the standard deviation has none.
    #[error("the standard deviation `{deviation}` has no unit, and its mean is in {unit}")]
    NoUnit { mean: String, deviation: String, unit: String },
    /// Percent behind a number alone, or behind percent: points, or a part of the mean.
    #[error("`{mean} ± {deviation}` may be a part of the mean, or both in percent")]
    PartOrPoints { mean: String, deviation: String, of: f64, points: f64, is_percent: bool },
    /// They measure different things.
    #[error("`{mean}` and its standard deviation `{deviation}` do not measure the same")]
    Mixed { mean: String, deviation: String },
    /// A negative one.
    #[error("the standard deviation `{deviation}` is negative")]
    Negative { deviation: String },
    /// It stands where nothing can have scatter.
    #[error("a number under [{section}] has no scatter")]
    Elsewhere { section: String },
    /// It stands in another file than the scene.
    #[error("a number of another file than the scene has no scatter")]
    OtherFile,
}

impl ScatterFault {
    pub(crate) fn help(&self) -> String {
        match self {
            Self::Computed { .. } => {
                "give the scatter to a number under [values], and compute with its name".to_owned()
            }
            Self::NoUnit { mean, deviation, unit } => {
                format!("write \"{mean} ± {deviation} {unit}\", or a share such as \"{mean} ± 10 %\"")
            }
            Self::PartOrPoints { of, points, is_percent, .. } => {
                let part = handy(0.01 * points * of.abs());
                let part = if *is_percent {
                    format!("({of} ± {part}) %")
                } else {
                    format!("{of} ± {part}")
                };
                format!(
                    "write \"{part}\" where {points} % of {of} are meant, or \"({of} ± {points}) %\" where both \
                     are in percent"
                )
            }
            Self::Elsewhere { .. } => "it may stand under [values], [models], [materials], [nodes], [elements], \
                 [effects] and [loads]"
                .to_owned(),
            Self::OtherFile => {
                "leave it out there, and write the model into the scene to give it scatter".to_owned()
            }
            _ => "write \"20 ± 2 MN/m\", mean and standard deviation in one unit, or \"20 MN/m ± 10 %\""
                .to_owned(),
        }
    }
}

impl Scatter {
    /// Whether a text may hold a number with scatter; most hold none.
    pub(crate) fn is_possible(text: &str) -> bool {
        SIGNS.iter().any(|sign| text.contains(sign))
    }

    /// The mean and the standard deviation in `text`; `None` where it is no number with scatter: it does not
    /// begin with a number, or `+-` stands in arithmetic.
    pub(crate) fn parse(text: &str) -> Option<Result<Self, ScatterFault>> {
        let joined = in_brackets(text);
        let is_joined = joined.is_some();
        let text = joined.as_deref().unwrap_or(text).trim();
        let begins_as_number = |own: &str| {
            own.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
        };
        let sign = SIGNS.into_iter().find(|sign| text.contains(sign))?;
        let (mean, deviation) = text.split_once(sign)?;
        let (mean, deviation) = (mean.trim(), deviation.trim());
        let is_arithmetic = sign != SIGNS[0]
            && (parse_quantity(mean).is_err() || parse_quantity(deviation).is_err());
        if !begins_as_number(mean) || is_arithmetic {
            return None;
        }
        Some(Self::of(mean, deviation, is_joined))
    }

    /// `is_joined` where the unit stands behind both.
    fn of(mean: &str, deviation: &str, is_joined: bool) -> Result<Self, ScatterFault> {
        if parse_quantity(mean).is_err() && is_arithmetic(mean, &|_| false) {
            return Err(ScatterFault::Computed { text: mean.to_owned() });
        }
        let own = quantity(deviation).map_err(|error| ScatterFault::Deviation { error })?;
        let of = quantity(mean).map_err(|error| ScatterFault::Mean { error })?;
        let both = || (mean.to_owned(), deviation.to_owned());
        if own.number < 0.0 {
            return Err(ScatterFault::Negative { deviation: deviation.to_owned() });
        }
        if !of.unit.is_empty() && own.unit.is_empty() {
            let (mean, deviation) = (of.number.to_string(), deviation.to_owned());
            return Err(ScatterFault::NoUnit { mean, deviation, unit: of.unit.to_owned() });
        }
        if own.unit == "%" && ["", "%"].contains(&of.unit) && !is_joined {
            let (mean, deviation) = both();
            let (of, points, is_percent) = (of.number, own.number, !of.unit.is_empty());
            return Err(ScatterFault::PartOrPoints { mean, deviation, of, points, is_percent });
        }
        let mixed = |_| {
            let (mean, deviation) = both();
            ScatterFault::Mixed { mean, deviation }
        };
        let unit = if of.unit.is_empty() { own.unit } else { of.unit };
        let size = if own.unit == "%" && unit != "%" {
            handy(0.01 * own.number * of.number.abs())
        } else {
            own.in_unit(unit).map_err(mixed)?
        };
        let text = format!("{} {unit}", of.digits).trim_end().to_owned();
        if let Err(error) = parse_quantity(&text) {
            return Err(ScatterFault::Mean { error });
        }
        Ok(Self { text, mean: of.number, deviation: size, unit: unit.to_owned() })
    }
}

fn quantity(text: &str) -> Result<Written<'_>, UnitError> {
    parse_quantity(text)?;
    Ok(Written::split(text))
}

/// `(20 ± 2) MN/m` without its brackets.
fn in_brackets(text: &str) -> Option<String> {
    let (inner, unit) = text.trim().strip_prefix('(')?.split_once(')')?;
    Some(format!("{inner} {unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Scatter {
        Scatter::parse(text).unwrap().unwrap()
    }

    fn fault(text: &str) -> ScatterFault {
        Scatter::parse(text).unwrap().unwrap_err()
    }

    #[test]
    fn mean_and_deviation_share_a_unit_or_the_deviation_is_a_share() {
        for (text, mean, deviation, unit) in [
            ("20 ± 2 MN/m", "20 MN/m", 2.0, "MN/m"),
            ("20 +- 2 MN/m", "20 MN/m", 2.0, "MN/m"),
            ("(20 ± 2) MN/m", "20 MN/m", 2.0, "MN/m"),
            ("20 MN/m ± 10 %", "20 MN/m", 2.0, "MN/m"),
            ("0.7 MPa ± 10 %", "0.7 MPa", 0.07, "MPa"),
            ("20 MN/m ± 500 kN/m", "20 MN/m", 0.5, "MN/m"),
            ("-2e1±1 mm", "-2e1 mm", 1.0, "mm"),
            ("-20 mm ± 10 %", "-20 mm", 2.0, "mm"),
            ("(30 ± 5) %", "30 %", 5.0, "%"),
            ("0.3 ± 0.05", "0.3", 0.05, ""),
        ] {
            let own = read(text);
            assert_eq!((&*own.text, &*own.unit), (mean, unit), "{text}");
            assert_eq!(own.deviation.to_string(), deviation.to_string(), "{text}");
        }
    }

    #[test]
    fn a_part_and_points_of_percent_are_told_apart() {
        let help = "write \"1 ± 0.1\" where 10 % of 1 are meant, or \"(1 ± 10) %\" where both are in percent";
        assert_eq!(fault("1 ± 10 %").help(), help);
        let help = "write \"(30 ± 1.5) %\" where 5 % of 30 are meant, or \"(30 ± 5) %\" where both are in percent";
        assert_eq!(fault("30 % ± 5 %").help(), help);
        assert!((read("(30 ± 1.5) %").deviation - 1.5).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_number_with_scatter_is_left_alone() {
        for text in ["20 MN/m", "K ± 2 N/m", "2 * 3 +- 4", "5 +- K", "foam ± skin", "20"] {
            assert!(Scatter::parse(text).is_none(), "{text}");
        }
    }

    #[test]
    fn faults_tell_what_is_missing() {
        for (text, told) in [
            ("2 * 3 ± 4", "`2 * 3` is computed"),
            ("20 MN/m ± 2", "the standard deviation `2` has no unit, and its mean is in MN/m"),
            ("20 MN/m ± 2 kg", "do not measure the same"),
            ("20 ± -2 MN/m", "`-2 MN/m` is negative"),
            ("20 ± x", "behind `±`: `x` does not begin with a number"),
            ("1 ± 10 %", "`1 ± 10 %` may be a part of the mean, or both in percent"),
            ("30 % ± 5 %", "`30 % ± 5 %` may be a part of the mean, or both in percent"),
            ("20 ± 2 mx", "`mx` is not a known unit"),
        ] {
            let fault = fault(text);
            assert!(fault.to_string().contains(told), "{text}: {fault}");
            assert!(fault.help().starts_with("write") || fault.help().starts_with("give"));
        }
    }
}
