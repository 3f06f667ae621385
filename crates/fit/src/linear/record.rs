//! What was measured on a linear material, and what each term of a spectrum adds to it.

use thiserror::Error;

/// A test of a linear material or pad.
///
/// Times are in s, moduli and stresses in Pa (of pads stiffnesses in N/m and forces in N), strains are parts (of pads
/// deformations in m).
#[derive(Debug, Clone, PartialEq)]
pub enum Record {
    /// Relaxation after a sudden strain: modulus over the time since then.
    Relaxation(Vec<(f64, f64)>),
    /// Creep under a sudden stress: compliance over the time since then.
    Creep(Vec<(f64, f64)>),
    /// A strain that was measured, and the stress that answers: `(time, strain, stress)`.
    Strained(Vec<[f64; 3]>),
    /// A stress that was measured, and the strain that answers: `(time, stress, strain)`.
    Stressed(Vec<[f64; 3]>),
    /// Oscillation: `(angular frequency in rad/s, storage modulus, loss modulus)`.
    Oscillation(Vec<[f64; 3]>),
    /// Storage modulus alone over the angular frequency.
    Storage(Vec<(f64, f64)>),
    /// Loss modulus alone over the angular frequency.
    Loss(Vec<(f64, f64)>),
}

/// Which canonical form a record is linear in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A modulus is a spring, a dashpot and Maxwell elements in parallel.
    Maxwell,
    /// A compliance is a spring, a dashpot and Kelvin–Voigt elements in series.
    Kelvin,
}

/// Why a record cannot be fitted; rows count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordFault {
    /// Too little of it.
    #[error("{rows} rows are too few: a spectrum takes 4 at least")]
    TooFew {
        /// How many there are.
        rows: usize,
    },
    /// What has to be above zero is not.
    #[error("the {what} is {value}: only numbers above zero can be fitted")]
    NotPositive {
        /// The row.
        row: usize,
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A time that does not come after the one before.
    #[error("the time runs back, from {before} s to {time} s")]
    TimeRunsBack {
        /// The row.
        row: usize,
        /// The time before \[s\].
        before: f64,
        /// The time \[s\].
        time: f64,
    },
    /// Nothing was done, or nothing answered.
    #[error("the {what} is zero throughout")]
    Nothing {
        /// Strain or stress.
        what: &'static str,
    },
}

impl RecordFault {
    /// The row that is meant, from 0.
    pub fn row(&self) -> Option<usize> {
        match self {
            Self::NotPositive { row, .. } | Self::TimeRunsBack { row, .. } => Some(*row),
            Self::TooFew { .. } | Self::Nothing { .. } => None,
        }
    }
}

/// The fewest rows that say something.
const FEWEST: usize = 4;

impl Record {
    /// The form in which it is linear; of oscillation, moduli.
    pub fn form(&self) -> Form {
        match self {
            Self::Creep(_) | Self::Stressed(_) => Form::Kelvin,
            _ => Form::Maxwell,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        match self {
            Self::Relaxation(rows) | Self::Creep(rows) | Self::Storage(rows) | Self::Loss(rows) => {
                rows.len()
            }
            Self::Strained(rows) | Self::Stressed(rows) | Self::Oscillation(rows) => rows.len(),
        }
    }

    /// Whether it has a loading history of its own, which may be shifted against the answer.
    pub fn has_history(&self) -> bool {
        matches!(self, Self::Strained(_) | Self::Stressed(_))
    }

    /// Whether its rows are over time, not over frequency.
    pub fn has_times(&self) -> bool {
        !matches!(self, Self::Oscillation(_) | Self::Storage(_) | Self::Loss(_))
    }

    /// The largest answer of a record with a history, which its deviations are parts of.
    pub fn largest(&self) -> Option<f64> {
        let (Self::Strained(rows) | Self::Stressed(rows)) = self else { return None };
        rows.iter().map(|own| own[2].abs()).reduce(f64::max)
    }

    /// The record without some of its rows; one with a history as it is.
    #[must_use]
    pub(super) fn without(&self, left_out: &[usize]) -> Self {
        let mut own = self.clone();
        let mut at = 0..;
        let mut is_kept = || at.next().is_none_or(|at| !left_out.contains(&at));
        match &mut own {
            Self::Relaxation(rows) | Self::Creep(rows) | Self::Storage(rows) | Self::Loss(rows) => {
                rows.retain(|_| is_kept());
            }
            Self::Oscillation(rows) => rows.retain(|_| is_kept()),
            Self::Strained(_) | Self::Stressed(_) => {}
        }
        own
    }

    /// Looks at all rows.
    ///
    /// # Errors
    ///
    /// The first fault.
    pub fn check(&self) -> Result<(), RecordFault> {
        if self.rows() < FEWEST {
            return Err(RecordFault::TooFew { rows: self.rows() });
        }
        let positive = |row: usize, what, value: f64| {
            let is_one = value > 0.0 && value.is_finite();
            if is_one { Ok(()) } else { Err(RecordFault::NotPositive { row, what, value }) }
        };
        let pairs = |rows: &[(f64, f64)], [first, second]: [&'static str; 2]| {
            rows.iter().enumerate().try_for_each(|(row, own)| {
                positive(row, first, own.0)?;
                positive(row, second, own.1)
            })
        };
        match self {
            Self::Relaxation(rows) => pairs(rows, ["time", "modulus"]),
            Self::Creep(rows) => pairs(rows, ["time", "compliance"]),
            Self::Storage(rows) => pairs(rows, ["frequency", "storage modulus"]),
            Self::Loss(rows) => pairs(rows, ["frequency", "loss modulus"]),
            Self::Oscillation(rows) => rows.iter().enumerate().try_for_each(|(row, own)| {
                positive(row, "frequency", own[0])?;
                positive(row, "storage modulus", own[1])?;
                positive(row, "loss modulus", own[2])
            }),
            Self::Strained(rows) => history(rows, ["strain", "stress"]),
            Self::Stressed(rows) => history(rows, ["stress", "strain"]),
        }
    }

    /// From the shortest to the longest time that it tells of \[s\].
    pub fn range(&self) -> (f64, f64) {
        let times: Vec<f64> = match self {
            Self::Relaxation(rows) | Self::Creep(rows) => rows.iter().map(|own| own.0).collect(),
            Self::Storage(rows) | Self::Loss(rows) => {
                rows.iter().map(|own| own.0.recip()).collect()
            }
            Self::Oscillation(rows) => rows.iter().map(|own| own[0].recip()).collect(),
            Self::Strained(rows) | Self::Stressed(rows) => {
                let steps = rows.windows(2).map(|pair| pair[1][0] - pair[0][0]);
                let whole = rows[rows.len() - 1][0] - rows[0][0];
                steps.chain([whole]).collect()
            }
        };
        times
            .into_iter()
            .fold((f64::INFINITY, 0.0), |(low, high), own| (low.min(own), high.max(own)))
    }
}

fn history(rows: &[[f64; 3]], names: [&'static str; 2]) -> Result<(), RecordFault> {
    for (row, pair) in rows.windows(2).enumerate() {
        let [before, time] = [pair[0][0], pair[1][0]];
        if time <= before {
            return Err(RecordFault::TimeRunsBack { row: row + 1, before, time });
        }
    }
    for (column, what) in [1, 2].into_iter().zip(names) {
        if rows.iter().all(|own| own[column] == 0.0) {
            return Err(RecordFault::Nothing { what });
        }
    }
    Ok(())
}
