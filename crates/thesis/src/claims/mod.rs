//! What the thesis claims, beside what the exact impact says.
//!
//! Each verdict is computed from the numbers that are shown with it.

mod curves;
mod limits;
mod order;
mod padding;
mod pulse;
mod trends;

use dashpot_report::Table;

use crate::{Family, Impact, Scales, Study, ThesisError, words::listed};

/// A claim with its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Chapter or appendix.
    pub place: &'static str,
    /// What is claimed.
    pub says: &'static str,
    /// Whether it holds.
    pub verdict: Verdict,
    /// What the numbers are, in a sentence.
    pub finding: String,
    /// The numbers.
    pub evidence: Vec<Table>,
}

impl Claim {
    /// What is claimed, over cases with whether it holds in each.
    fn over(place: &'static str, says: &'static str, cases: &[(String, bool)]) -> Self {
        let (verdict, finding, evidence) = (Verdict::of(cases), String::new(), Vec::new());
        Self { place, says, verdict, finding, evidence }
    }

    /// What is claimed, and whether it holds.
    fn single(place: &'static str, says: &'static str, holds: bool) -> Self {
        Self::over(place, says, &[(String::new(), holds)])
    }

    fn finding(self, finding: impl Into<String>) -> Self {
        Self { finding: finding.into(), ..self }
    }

    fn shown(self, evidence: Table) -> Self {
        Self { evidence: vec![evidence], ..self }
    }

    fn shown_by<R: IntoIterator<Item = Vec<String>>>(
        self,
        caption: &str,
        header: &[&str],
        rows: R,
    ) -> Self {
        self.shown(Table::new(caption, header, rows))
    }
}

/// Whether a claim holds in the cases that it speaks of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// In all of them.
    Holds,
    /// In none of them.
    DoesNotHold,
    /// In these only.
    HoldsOnlyFor(Vec<String>),
}

impl Verdict {
    /// The verdict over cases, each with whether it holds.
    pub fn of(cases: &[(String, bool)]) -> Self {
        let good: Vec<String> =
            cases.iter().filter(|case| case.1).map(|case| case.0.clone()).collect();
        match good.len() {
            0 => Self::DoesNotHold,
            count if count == cases.len() => Self::Holds,
            _ => Self::HoldsOnlyFor(good),
        }
    }

    /// In words.
    pub fn text(&self) -> String {
        match self {
            Self::Holds => "holds".to_owned(),
            Self::DoesNotHold => "does not hold".to_owned(),
            Self::HoldsOnlyFor(cases) => format!("holds only for {}", listed(cases)),
        }
    }
}

/// All claims of chapters III, V and VI and of the appendices that numbers can decide.
///
/// # Errors
///
/// As [`Impact::of_groups`].
pub fn claims(study: &Study) -> Result<Vec<Claim>, ThesisError> {
    let mut all = trends::claims(study);
    all.extend(order::claims(study));
    all.extend(curves::claims(study)?);
    all.extend(limits::claims(study)?);
    all.extend(padding::claims(study)?);
    all.extend(pulse::claims(study)?);
    Ok(all)
}

/// A time at which energies are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mark {
    /// In milliseconds after the first contact.
    Milliseconds(f64),
    /// Where the force turns to tension.
    Release,
}

impl Mark {
    const ALL: [Self; 5] = [
        Self::Milliseconds(1.0),
        Self::Milliseconds(2.0),
        Self::Milliseconds(4.0),
        Self::Release,
        Self::Milliseconds(10.0),
    ];

    fn text(self) -> String {
        match self {
            Self::Milliseconds(time) => format!("{time} ms"),
            Self::Release => "release".to_owned(),
        }
    }

    /// Energy ω that has gone into the padding until then.
    fn energy(self, impact: &Impact) -> f64 {
        match self {
            Self::Milliseconds(time) => impact.energy(1e-3 * time / Scales::CHAPTER_4.time()),
            Self::Release => impact.energy(impact.end()),
        }
    }
}

/// Which way a row of values goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Trend {
    Rises,
    Falls,
    TurnsAround,
}

impl Trend {
    fn of(values: &[f64]) -> Self {
        let mut pairs = values.windows(2);
        if pairs.clone().all(|pair| pair[1] > pair[0]) {
            Self::Rises
        } else if pairs.all(|pair| pair[1] < pair[0]) {
            Self::Falls
        } else {
            Self::TurnsAround
        }
    }
}

/// Column headings of a table that has a row for each family.
const OVER_VALUES: [&str; 6] = ["parameter", "1st value", "2nd", "3rd", "4th", "5th"];

/// Of each family whether a claim holds there, and its row in a table: its parameter, and cells.
fn over<'f, C: IntoIterator<Item = String>>(
    families: impl Iterator<Item = &'f Family>,
    of: impl Fn(&Family) -> (bool, C),
) -> (Vec<(String, bool)>, Vec<Vec<String>>) {
    let one = |family: &Family| {
        let symbol = family.varied.symbol().to_owned();
        let (holds, cells) = of(family);
        ((symbol.clone(), holds), row([symbol].into_iter().chain(cells)))
    };
    families.map(one).unzip()
}

fn row(cells: impl IntoIterator<Item = String>) -> Vec<String> {
    cells.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_from_the_cases() {
        let case = |name: &str, holds| (name.to_owned(), holds);
        assert_eq!(Verdict::of(&[case("a", true), case("b", true)]), Verdict::Holds);
        assert_eq!(Verdict::of(&[case("a", false)]), Verdict::DoesNotHold);
        let some = Verdict::of(&[case("a", true), case("b", false), case("c", true)]);
        assert_eq!(some.text(), "holds only for a and c");
    }

    #[test]
    fn trends_are_strict() {
        assert_eq!(Trend::of(&[1.0, 2.0, 3.0]), Trend::Rises);
        assert_eq!(Trend::of(&[3.0, 2.0, 1.0]), Trend::Falls);
        assert_eq!(Trend::of(&[1.0, 1.0]), Trend::TurnsAround);
        assert_eq!(Trend::of(&[1.0, 3.0, 2.0]), Trend::TurnsAround);
    }
}
