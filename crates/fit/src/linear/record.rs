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

/// What a column of a record tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The modulus after a step, over time \[s\].
    Relaxation,
    /// The compliance after a step, over time \[s\].
    Creep,
    /// The storage modulus over the angular frequency \[rad/s\].
    Storage,
    /// The loss modulus over the angular frequency \[rad/s\].
    Loss,
    /// The stress that answers a strain, over time \[s\].
    Stress,
    /// The strain that answers a stress, over time \[s\].
    Strain,
}

impl Kind {
    /// Whether something was done that was measured beside it.
    pub fn has_history(self) -> bool {
        matches!(self, Self::Stress | Self::Strain)
    }

    /// Whether it is over a frequency.
    pub fn is_oscillation(self) -> bool {
        matches!(self, Self::Storage | Self::Loss)
    }

    /// What it is over, or what was done, and what it is.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::Relaxation => ["time", "modulus"],
            Self::Creep => ["time", "compliance"],
            Self::Storage => ["frequency", "storage modulus"],
            Self::Loss => ["frequency", "loss modulus"],
            Self::Stress => ["strain", "stress"],
            Self::Strain => ["stress", "strain"],
        }
    }
}

/// A column of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What it tells.
    pub kind: Kind,
    /// Times \[s\], or angular frequencies \[rad/s\].
    pub places: Vec<f64>,
    /// What was done at these times; empty where it has no history.
    pub done: Vec<f64>,
    /// What was measured.
    pub values: Vec<f64>,
}

impl Record {
    /// The form in which it is linear; of oscillation, moduli.
    pub fn form(&self) -> Form {
        match self {
            Self::Creep(_) | Self::Stressed(_) => Form::Kelvin,
            _ => Form::Maxwell,
        }
    }

    /// What it has in its columns: one, or storage and loss.
    pub fn columns(&self) -> Vec<Column> {
        let pairs = |kind, rows: &[(f64, f64)]| {
            let (places, values) = rows.iter().copied().unzip();
            vec![Column { kind, places, done: Vec::new(), values }]
        };
        let at = |rows: &[[f64; 3]], at: usize| rows.iter().map(|own| own[at]).collect();
        let column = |kind: Kind, rows: &[[f64; 3]], values| {
            let done = if kind.has_history() { at(rows, 1) } else { Vec::new() };
            Column { kind, places: at(rows, 0), done, values: at(rows, values) }
        };
        match self {
            Self::Relaxation(rows) => pairs(Kind::Relaxation, rows),
            Self::Creep(rows) => pairs(Kind::Creep, rows),
            Self::Storage(rows) => pairs(Kind::Storage, rows),
            Self::Loss(rows) => pairs(Kind::Loss, rows),
            Self::Oscillation(rows) => {
                vec![column(Kind::Storage, rows, 1), column(Kind::Loss, rows, 2)]
            }
            Self::Strained(rows) => vec![column(Kind::Stress, rows, 2)],
            Self::Stressed(rows) => vec![column(Kind::Strain, rows, 2)],
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

    /// The record without some of its rows, by their numbers from 0.
    #[must_use]
    pub fn without(&self, is_left_out: impl Fn(usize) -> bool) -> Self {
        let mut own = self.clone();
        let mut at = 0..;
        let mut is_kept = || at.next().is_none_or(|at| !is_left_out(at));
        match &mut own {
            Self::Relaxation(rows) | Self::Creep(rows) | Self::Storage(rows) | Self::Loss(rows) => {
                rows.retain(|_| is_kept());
            }
            Self::Oscillation(rows) | Self::Strained(rows) | Self::Stressed(rows) => {
                rows.retain(|_| is_kept());
            }
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
        self.columns().iter().try_for_each(Column::check)
    }

    /// From the shortest to the longest time that it tells of \[s\].
    pub fn range(&self) -> (f64, f64) {
        let wide = (f64::INFINITY, 0.0);
        let Some(Column { kind, places, .. }) = self.columns().into_iter().next() else {
            return wide;
        };
        let times: Vec<f64> = if kind.has_history() {
            let whole = places.first().zip(places.last()).map(|(first, last)| last - first);
            places.windows(2).map(|pair| pair[1] - pair[0]).chain(whole).collect()
        } else if kind.is_oscillation() {
            places.iter().map(|own| own.recip()).collect()
        } else {
            places
        };
        times.into_iter().fold(wide, |(low, high), own| (low.min(own), high.max(own)))
    }
}

impl Column {
    fn check(&self) -> Result<(), RecordFault> {
        let names = self.kind.names();
        if !self.kind.has_history() {
            let rows = self.places.iter().zip(&self.values).enumerate();
            let mut each = rows.flat_map(|(row, (place, value))| {
                [(row, names[0], *place), (row, names[1], *value)]
            });
            let fault = each.find(|own| !(own.2 > 0.0 && own.2.is_finite()));
            return fault.map_or(Ok(()), |(row, what, value)| {
                Err(RecordFault::NotPositive { row, what, value })
            });
        }
        if let Some(row) = (1..self.places.len()).find(|at| self.places[*at] <= self.places[at - 1])
        {
            let [before, time] = [self.places[row - 1], self.places[row]];
            return Err(RecordFault::TimeRunsBack { row, before, time });
        }
        let mut both = [&self.done, &self.values].into_iter().zip(names);
        let nothing = both.find(|own| own.0.iter().all(|own| *own == 0.0));
        nothing.map_or(Ok(()), |(_, what)| Err(RecordFault::Nothing { what }))
    }
}
