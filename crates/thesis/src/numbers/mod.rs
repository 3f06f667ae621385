//! Every number that the thesis prints, beside its recomputed value.

mod tables;

use dashpot_analysis::similarity::{self, SimilarityError};
use dashpot_report::Table;

use crate::{
    Fit, Groups, Padding, Parameter, Pulse, Scales, Study, Support, ThesisError, best_pulse,
    words::{change, extremes, listed, short, significant},
};

pub use tables::{chapter_3_table, exact_table, fit_table};

pub use dashpot_units::STANDARD_GRAVITY;

/// A printed number.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// Equation or chapter.
    pub place: &'static str,
    /// What it is.
    pub what: &'static str,
    /// As it is printed.
    pub printed: &'static str,
    /// What comes out, as text.
    pub recomputed: String,
    /// What comes out, in the unit that is printed; not a number for what is given.
    pub value: f64,
    /// How the two compare.
    pub verdict: NumberVerdict,
}

/// How a printed number compares with what comes out.
#[derive(Debug, Clone, PartialEq)]
pub enum NumberVerdict {
    /// It is an input.
    Given,
    /// It is exactly what comes out.
    Right,
    /// It is what comes out, rounded to its digits.
    Rounded,
    /// It is what comes out, cut off after its digits.
    Truncated,
    /// It is another number, by this relative difference.
    Off(f64),
    /// It cannot be meant; what it should be.
    Misprinted(String),
    /// It is right for some cases only; which ones.
    Partly(String),
}

impl NumberVerdict {
    /// How a printed decimal, in plain digits such as `8.76e-10`, compares with a value.
    pub fn of(printed: &str, value: f64) -> Self {
        let (mantissa, power) = printed.split_once('e').unwrap_or((printed, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let scale = 10.0_f64.powi(power.parse().unwrap_or(0));
        let (number, scaled) = (mantissa.parse().unwrap_or(f64::NAN), value / scale);
        let unit = 0.1_f64.powi(i32::try_from(decimals).unwrap_or(0));
        if (scaled - number).abs() <= 1e-12 * scaled.abs() {
            Self::Right
        } else if format!("{scaled:.decimals$}") == mantissa {
            Self::Rounded
        } else if ((scaled / unit).trunc() * unit - number).abs() < 1e-9 * unit {
            Self::Truncated
        } else {
            Self::Off(number / scaled - 1.0)
        }
    }

    /// In words.
    pub fn text(&self) -> String {
        match self {
            Self::Given => "given".to_owned(),
            Self::Right => "right".to_owned(),
            Self::Rounded => "right to its rounding".to_owned(),
            Self::Truncated => "truncated".to_owned(),
            Self::Off(relative) => format!("off by {}", change(*relative)),
            Self::Misprinted(correct) => format!("misprinted: {correct}"),
            Self::Partly(cases) => cases.clone(),
        }
    }
}

/// All numbers of the thesis in the order of the text.
///
/// # Errors
///
/// As [`Impact::of_groups`](crate::Impact::of_groups); the thesis' own numbers give none.
pub fn numbers(study: &Study) -> Result<Vec<Number>, ThesisError> {
    let mut all = chapters_1_and_2()?;
    all.extend(chapter_3(study));
    all.extend(chapter_4());
    all.extend(chapter_5(study));
    Ok(all)
}

/// A number that is judged by its digits; `plain` are the printed ones.
fn judged(
    place: &'static str,
    what: &'static str,
    (printed, plain): (&'static str, &str),
    value: f64,
) -> Number {
    let verdict = NumberVerdict::of(plain, value);
    Number { place, what, printed, recomputed: short(value, 7), value, verdict }
}

fn given(place: &'static str, what: &'static str, printed: &'static str) -> Number {
    let verdict = NumberVerdict::Given;
    Number { place, what, printed, recomputed: String::new(), value: f64::NAN, verdict }
}

fn chapters_1_and_2() -> Result<Vec<Number>, ThesisError> {
    // The impact of chapter II, with gravity and a mass m₂.
    let whole = Groups { gravity: 1e-3, share: 0.5, ..Groups::PRINTED };
    let all = similarity::Groups::of(&whole.network(&Scales::CHAPTER_4)?)
        .map_err(SimilarityError::from)?;
    let counts = [all.references.len(), all.rank(), all.groups.len()];
    let [references, rank, groups] = counts.map(|count| count as f64);
    Ok(vec![
        given("1.1", "exponent n of the severity index", "2.5"),
        judged("2.27–2.36", "groups, of which c and e are the same", ("ten", "10"), groups + 1.0),
        judged("II", "parameters of the impact", ("twelve", "12"), references + groups),
        judged("II", "fundamental dimensions", ("three", "3"), rank),
        judged("II", "independent groups", ("nine", "9"), groups),
    ])
}

fn chapter_3(study: &Study) -> Vec<Number> {
    let pulse = Pulse::PRINTED;
    let deepest = study.printed.deepest().time;
    let groups = Groups::PRINTED;
    let mut all = vec![
        judged("3.7", "ν = d/c", ("10", "10"), groups.d / groups.c),
        judged("3.36", "τ* of the largest deformation, by the exact impact", ("> 2", "2"), deepest),
        judged(
            "3.54",
            "what is left out at ν τ* = 20, in size",
            (".876×10⁻⁹", "0.876e-9"),
            pulse.left_out(2.0).abs(),
        ),
        judged(
            "3.55",
            "b with which the deformation ends at 1",
            ("80", "80"),
            pulse.limit(Parameter::B).unwrap_or(f64::NAN),
        ),
    ];
    if deepest > 2.0 {
        all[1].verdict = NumberVerdict::Right;
    }
    if let Some(Fit { pulse: best, .. }) = best_pulse(&study.printed) {
        all.push(judged("III", "m, against the best fit", ("3.1", "3.1"), best.decay));
        all.push(judged("III", "A (here P), against the best fit", ("9.9", "9.9"), best.slope));
    }
    all
}

fn chapter_4() -> Vec<Number> {
    let (scales, pad) = (Scales::CHAPTER_4, Padding::CHAPTER_4);
    let own = Groups::of(&scales, &pad, &Support::CHAPTER_4);
    let stiff = Groups::of(&scales, &pad, &Support::CHAPTER_4_STIFF);
    let energy = 0.5 * scales.mass * scales.speed * scales.speed;
    let gravity = STANDARD_GRAVITY * scales.thickness / (scales.speed * scales.speed);
    let damping = Groups::PRINTED.support(&scales).damping;
    let misprinted = |mut own: Number, correct: String| {
        own.verdict = NumberVerdict::Misprinted(correct);
        own
    };
    vec![
        given("IV", "m₁", "10 kg"),
        given("IV", "V₀", "10 m/s"),
        given("IV", "δ", "2 cm"),
        given("IV", "m₃, printed m", "100 kg"),
        given("IV", "K₃", "50×10⁶ N/m"),
        misprinted(
            judged("IV", "C₃, from α = 0.2", ("10×10⁶ N s/m", "10e6"), damping),
            format!("α = 0.2 needs {} N s/m", short(damping, 3)),
        ),
        given("IV", "K₁", "20×10⁶ N/m"),
        given("IV", "K₂", "20×10⁶ N/m"),
        given("IV", "C₁", "4000 N s/m"),
        given("IV", "C₂", "6000 N s/m"),
        judged("IV", "δ/V₀", ("2×10⁻³ s", "2e-3"), scales.time()),
        judged("IV", "m₁ V₀²/2", ("500 N m", "500"), energy),
        judged("2.27", "A, with g = 9.80665 m/s²", ("0", "0"), gravity),
        judged("2.28", "B", ("1", "1"), own.share),
        judged("2.29", "a", ("26.6", "26.6"), own.a),
        judged("2.30", "b", ("66.66", "66.66"), own.b),
        judged("2.31", "c", ("8", "8"), own.c),
        judged("2.32", "d", ("80", "80"), own.d),
        judged("2.33", "e", ("8", "8"), own.c),
        misprinted(
            judged("2.34", "α, from the printed C₃", ("0.2", "0.2"), stiff.alpha),
            format!("C₃ = 10×10⁶ N s/m gives {}", short(stiff.alpha, 3)),
        ),
        judged("2.35", "β", ("2", "2"), own.beta),
        judged("2.36", "γ, as m₁/m₃", ("0.1", "0.1"), own.gamma),
    ]
}

fn chapter_5(study: &Study) -> Vec<Number> {
    let changes = study.energy_changes(0.01);
    let changes = changes.map(|(group, by)| (group, 100.0 * by));
    let [least, most] = extremes(changes.map(|own| own.1));
    let within = changes.into_iter().filter(|own| (3.0..=7.0).contains(&own.1));
    let within: Vec<String> = within.map(|own| own.0.to_owned()).collect();
    vec![
        Number {
            place: "V",
            what: "change of the energy in 10 ms by a, b, c and d over their families",
            printed: "3 to 7 %",
            recomputed: format!("{} to {} %", significant(least, 2), significant(most, 2)),
            value: most,
            verdict: NumberVerdict::Partly(format!("in this range for {}", listed(&within))),
        },
        given("V", "springs for which it is valid", "5×10⁶ to 30×10⁶ N/m"),
        Number {
            place: "V",
            what: "dashpots for which it is valid; the thesis' own C₁ is 4000",
            printed: "5150 to 7600 N s/m",
            recomputed: short(Padding::CHAPTER_4.c1, 4),
            value: Padding::CHAPTER_4.c1,
            verdict: NumberVerdict::Partly("leaves C₁ of the base out".to_owned()),
        },
    ]
}

/// The numbers as a table.
pub fn number_table(all: &[Number]) -> Table {
    let row = |number: &Number| {
        let printed = number.printed.to_owned();
        let words = [number.place.to_owned(), number.what.to_owned(), printed];
        words.into_iter().chain([number.recomputed.clone(), number.verdict.text()]).collect()
    };
    Table::new(
        "Numbers of the text",
        &["place", "what", "printed", "recomputed", "verdict"],
        all.iter().map(row),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_decimals_are_judged_by_their_digits() {
        let cases = [
            ("8", 8.0, NumberVerdict::Right),
            ("26.6", 26.666_666, NumberVerdict::Truncated),
            ("26.7", 26.666_666, NumberVerdict::Rounded),
            ("80", 79.501, NumberVerdict::Rounded),
            ("0", 0.001_96, NumberVerdict::Rounded),
            ("0.876e-9", 8.76e-10, NumberVerdict::Right),
            ("2e-3", 0.002, NumberVerdict::Right),
        ];
        for (printed, value, verdict) in cases {
            assert_eq!(NumberVerdict::of(printed, value), verdict, "{printed}");
        }
        let NumberVerdict::Off(off) = NumberVerdict::of("3.1", 3.0) else { panic!() };
        assert!((off - 1.0 / 30.0).abs() < 1e-12);
    }

    #[test]
    fn twelve_parameters_have_nine_groups() {
        let numbers = chapters_1_and_2().unwrap();
        assert_eq!(
            numbers[1..].iter().map(|own| own.value).collect::<Vec<_>>(),
            [10.0, 12.0, 3.0, 9.0]
        );
    }
}
