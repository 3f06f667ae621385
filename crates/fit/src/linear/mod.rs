//! Linear spectra: moduli and compliances of one material or pad from its records.

mod branches;
mod certainty;
mod contradiction;
mod curves;
mod floor;
mod kernel;
mod nearest;
mod problem;
mod record;
mod shift;
mod spectrum;

use thiserror::Error;

pub use self::{
    branches::Against,
    certainty::{Band, Range},
    contradiction::Contradiction,
    curves::{FittedCurve, FittedRow, Kind},
    floor::Misfit,
    record::{Form, Record, RecordFault},
    spectrum::Spectrum,
};
use self::{branches::fewest, certainty::End, nearest::Nearest, problem::Problem};

/// What is asked of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearSettings {
    /// The largest error that fewer branches may make, in parts of each row, or of the largest row of a record with a
    /// history.
    pub error: f64,
    /// Whether the clocks of what was done and of what answered may differ.
    pub is_shifted: bool,
}

/// Why records cannot be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LinearFault {
    /// There is none.
    #[error("there is nothing to fit to")]
    NoRecords,
    /// One of them is faulty.
    #[error("{fault}")]
    Record {
        /// Its number.
        record: usize,
        /// What is wrong.
        fault: RecordFault,
    },
    /// Moduli and compliances.
    #[error(
        "creep and relaxation are linear in different constants, and cannot share one spectrum"
    )]
    MixedForms {
        /// The first record that is of another form than the one before.
        record: usize,
    },
    /// All strengths are zero.
    #[error(
        "no passive network answers with this sign: is compression, or tension, positive in both columns?"
    )]
    NoAnswer,
}

/// What was found of one record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordFit {
    /// How much later the answer was written down than what was done \[s\]; 0 where that is not looked for.
    pub shift: f64,
    /// How far the nearest network is from it.
    pub floor: Misfit,
    /// How far the fewest branches are from it.
    pub misfit: Misfit,
    /// What these are parts of: the largest value of a record with a history; `None` where it is each row.
    pub largest: Option<f64>,
    /// Storage and loss that contradict each other.
    pub contradiction: Option<Contradiction>,
}

/// A spectrum that was fitted.
#[derive(Debug, Clone)]
pub struct LinearFit {
    /// The canonical form of its terms.
    pub form: Form,
    /// The fewest branches.
    pub spectrum: Spectrum,
    /// What its error is against.
    pub against: Against,
    /// Whether the stated error is kept.
    pub is_kept: bool,
    /// How far the nearest passive network is from all rows.
    pub floor: Misfit,
    /// How far the fewest branches are.
    pub misfit: Misfit,
    /// The same where the clocks are taken as they are; `None` where no clock was shifted.
    pub floor_unshifted: Option<Misfit>,
    /// Each record.
    pub records: Vec<RecordFit>,
    /// All rows beside what was fitted to them.
    pub curves: Vec<FittedCurve>,
    /// Equilibrium modulus, or instantaneous compliance, where no branch is slower than
    /// `slowest`.
    pub spring: Range,
    /// Instantaneous modulus, or compliance when all has crept, likewise.
    pub sum: Range,
    /// Band on the curve; `None` where branches cannot be told apart.
    pub band: Option<Band>,
    /// The slowest branch of which the records show most \[s\].
    pub slowest: f64,
}

/// Fits the spectrum of one material to its records.
///
/// # Examples
///
/// A Zener solid, relaxing:
///
/// ```
/// use dashpot_fit::linear::{LinearSettings, Record, fit};
///
/// let modulus = |t: f64| 2e6 + 3e6 * (-t / 0.1).exp();
/// let rows = (1..60).map(|at| 0.01 * f64::from(at)).map(|t| (t, modulus(t))).collect();
/// let own = fit(&[Record::Relaxation(rows)], LinearSettings { error: 0.01, is_shifted: true })?;
/// let [(time, strength)] = own.spectrum.branches[..] else { panic!("{own:?}") };
/// assert!((time - 0.1).abs() < 1e-4 && (strength / 3e6 - 1.0).abs() < 1e-4);
/// assert!((own.spectrum.spring / 2e6 - 1.0).abs() < 1e-4);
/// # Ok::<(), dashpot_fit::linear::LinearFault>(())
/// ```
///
/// # Errors
///
/// Records that are faulty, or do not go together.
pub fn fit(records: &[Record], settings: LinearSettings) -> Result<LinearFit, LinearFault> {
    checked(records)?;
    let unshifted = vec![0.0; records.len()];
    let mut shifts = if settings.is_shifted { shift::nearest(records) } else { unshifted.clone() };
    let mut problem = Problem::of(records, &shifts);
    let mut found = Nearest::of(&problem).ok_or(LinearFault::NoAnswer)?;
    let mut floor_unshifted = None;
    if shifts.iter().any(|own| *own != 0.0) {
        let plain = Problem::of(records, &unshifted);
        let own = Nearest::of(&plain).ok_or(LinearFault::NoAnswer)?;
        let before = Misfit::of_vector(&own.left);
        if shift::is_nearer(Misfit::of_vector(&found.left), before) {
            floor_unshifted = Some(before);
        } else {
            (shifts, problem, found) = (unshifted, plain, own);
        }
    }
    let Nearest { spectrum: nearest, start, left } = found;
    let few = fewest(&problem, start, &left, settings.error);
    let floor = Misfit::of_vector(&left);
    let band = Band::of(&problem, &few.spectrum, (&nearest, &left));
    let clocks = (&shifts[..], settings.is_shifted);
    let [spring, sum] = shift::ranges(records, clocks, &problem, [End::Spring, End::Sum]);
    let branches: f64 = few.spectrum.branches.iter().map(|own| own.1).sum();
    Ok(LinearFit {
        form: problem.form,
        against: few.against,
        is_kept: few.is_kept,
        floor,
        misfit: Misfit::of_vector(&few.residual),
        floor_unshifted,
        curves: curves::curves(records, &problem, [&left, &few.residual], band.as_ref()),
        records: each(records, &shifts, &problem, [&left, &few.residual]),
        spring: spring.around(few.spectrum.spring),
        sum: sum.around(few.spectrum.spring + branches),
        band,
        spectrum: few.spectrum,
        slowest: shift::slowest(&problem),
    })
}

fn checked(records: &[Record]) -> Result<(), LinearFault> {
    let first = records.first().ok_or(LinearFault::NoRecords)?.form();
    for (record, own) in records.iter().enumerate() {
        own.check().map_err(|fault| LinearFault::Record { record, fault })?;
        if own.form() != first {
            return Err(LinearFault::MixedForms { record });
        }
    }
    Ok(())
}

fn each(
    records: &[Record],
    shifts: &[f64],
    problem: &Problem,
    [floor, few]: [&nalgebra::DVector<f64>; 2],
) -> Vec<RecordFit> {
    let of = |record: usize, residual: &nalgebra::DVector<f64>| {
        let parts = problem.parts().filter(|own| own.0 == record);
        Misfit::of(&parts.flat_map(|own| &residual.as_slice()[own.1]).copied().collect::<Vec<_>>())
    };
    let all = records.iter().zip(shifts).enumerate();
    all.map(|(at, (record, shift))| {
        let floor = of(at, floor);
        RecordFit {
            shift: *shift,
            floor,
            misfit: of(at, few),
            largest: record.largest(),
            contradiction: contradiction::contradiction(record, floor.rms),
        }
    })
    .collect()
}

#[cfg(test)]
mod tests;
