//! Linear spectra: moduli and compliances of one material or pad from its records.

mod bound;
mod branches;
mod certainty;
mod contradiction;
mod curves;
mod floor;
mod kernel;
mod outliers;
mod problem;
mod record;
mod shift;
mod spectrum;

use thiserror::Error;

use self::{
    bound::lower_bound,
    branches::fewest,
    certainty::{End, bands},
    floor::Nearest,
    outliers::{may_be_left_out, outliers},
    problem::Problem,
};
pub use self::{
    branches::Against,
    certainty::Range,
    contradiction::Contradiction,
    curves::{FittedCurve, FittedRow},
    floor::Misfit,
    outliers::Outlier,
    record::{Column, Form, Kind, Record, RecordFault},
    spectrum::Spectrum,
};

/// What is asked of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearSettings {
    /// The largest error that fewer branches may make, in parts of each row, or of the largest row of a record with a
    /// history.
    pub error: f64,
    /// Whether the clocks of what was done and of what answered may differ.
    pub is_shifted: bool,
    /// Whether rows that stand apart from all others are left out.
    pub is_robust: bool,
    /// Whether the material is known to come to rest: what relaxes slower than the records determine is a spring, and
    /// nothing flows.
    pub is_solid: bool,
}

impl Default for LinearSettings {
    /// 1 %, with clocks that may be off and without rows that stand apart.
    fn default() -> Self {
        Self { error: 0.01, is_shifted: true, is_robust: true, is_solid: false }
    }
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
        "no passive network answers with this sign: is compression, or tension, positive in both columns? `scale=-1` behind the \
         comma turns what answered"
    )]
    NoAnswer,
    /// A solid without a spring.
    #[error(
        "nothing is left of it at the end: the nearest network has no spring, which is no solid"
    )]
    NoSolid,
}

/// What was found of one record.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordFit {
    /// How much later the answer was written down than what was done \[s\]; 0 where that is not looked for.
    pub shift: f64,
    /// A lower bound on the root of the mean square that any passive network leaves of it alone, at this shift.
    pub floor: f64,
    /// How far the fewest branches are from it.
    pub misfit: Misfit,
    /// What these are parts of: the largest value of a record with a history; `None` where it is each row.
    pub largest: Option<f64>,
    /// Storage and loss that contradict each other.
    pub contradiction: Option<Contradiction>,
    /// The rows that were left out; no misfit and no floor counts them.
    pub outliers: Vec<Outlier>,
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
    /// A lower bound on the root of the mean square that any passive network leaves of all rows, whatever its times.
    pub floor: f64,
    /// How far the fewest branches are.
    pub misfit: Misfit,
    /// The floor where the clocks are taken as they are; `None` where no clock was shifted.
    pub floor_unshifted: Option<f64>,
    /// Each record.
    pub records: Vec<RecordFit>,
    /// All rows beside what was fitted to them.
    pub curves: Vec<FittedCurve>,
    /// Equilibrium modulus, or instantaneous compliance, where no branch is slower than
    /// `slowest`.
    pub spring: Range,
    /// Instantaneous modulus, or compliance when all has crept, likewise.
    pub sum: Range,
    /// The slowest branch that these ranges allow for \[s\]: ten times the longest time of the records.
    pub slowest: f64,
    /// Between which times the branches are \[s\]: rows determine none that are faster or slower.
    pub limits: (f64, f64),
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
/// let own = fit(&[Record::Relaxation(rows)], LinearSettings::default())?;
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
    let mut left_out: Vec<Vec<usize>> = vec![Vec::new(); records.len()];
    let mut counted = Counted::of(records.to_vec(), settings)?;
    for _ in 0..if settings.is_robust { ROUNDS } else { 0 } {
        let mut more = left_out.clone();
        for (record, row) in outliers(&counted.problem, &counted.nearest.left, settings.error) {
            let own = &mut more[record];
            let mut rows = (0..records[record].rows()).filter(|at| !left_out[record].contains(at));
            let row = rows.nth(row).filter(|at| !own.contains(at));
            let record = &records[record];
            let may_be = may_be_left_out(own.len() + 1, record.rows()) && !record.has_history();
            own.extend(row.filter(|_| may_be));
        }
        if more == left_out {
            break;
        }
        left_out = more;
        let kept =
            records.iter().zip(&left_out).map(|(own, rows)| own.without(|at| rows.contains(&at)));
        counted = Counted::of(kept.collect(), settings)?;
    }
    counted.fitted((records, &left_out), settings)
}

/// Rounds in which rows are left out.
const ROUNDS: usize = 6;

/// Records with the rows that count, and the network that is nearest to them.
struct Counted {
    records: Vec<Record>,
    shifts: Vec<f64>,
    problem: Problem,
    nearest: Nearest,
    /// The problem at the clocks as they are, where they were shifted.
    unshifted: Option<Problem>,
}

impl Counted {
    fn of(records: Vec<Record>, settings: LinearSettings) -> Result<Self, LinearFault> {
        let posed = |shifts: &[f64]| {
            let own = Problem::of(&records, shifts);
            let own = if settings.is_solid { own.of_solid() } else { own };
            let nearest = Nearest::of(&own).ok_or(LinearFault::NoAnswer)?;
            Ok((own, nearest))
        };
        let plain = vec![0.0; records.len()];
        let mut shifts = plain.clone();
        let (mut problem, mut nearest) = posed(&plain)?;
        let mut unshifted = None;
        if settings.is_shifted && records.iter().any(Record::has_history) {
            shifts = shift::nearest(&records);
            let (other, own) = posed(&shifts)?;
            let [before, after] = [&nearest, &own].map(|own| Misfit::of_vector(&own.left));
            if shift::is_nearer(after, before) {
                (unshifted, problem, nearest) = (Some(problem), other, own);
            } else {
                shifts = plain;
            }
        }
        Ok(Self { records, shifts, problem, nearest, unshifted })
    }

    fn fitted(
        self,
        (all, left_out): (&[Record], &[Vec<usize>]),
        settings: LinearSettings,
    ) -> Result<LinearFit, LinearFault> {
        let Self { records, shifts, problem, nearest, unshifted } = self;
        let Nearest { start, left } = nearest;
        let few = fewest(&problem, start, &left, settings.error);
        if settings.is_solid && problem.form == Form::Maxwell && few.spectrum.spring <= 0.0 {
            return Err(LinearFault::NoSolid);
        }
        let floor = lower_bound(&problem);
        let halves = bands(&problem, &few.spectrum, [&left, &few.residual]);
        let clocks = (&shifts[..], settings.is_shifted);
        let [spring, sum] = shift::ranges(&records, clocks, &problem, [End::Spring, End::Sum]);
        let end = few.spectrum.spring + few.spectrum.branches.iter().map(|own| own.1).sum::<f64>();
        let mut each = each((&records, &shifts), &problem, &few.residual, floor);
        let whole = Problem::of(all, &shifts);
        let off = few.spectrum.residual(&whole);
        for (record, rows) in whole.parts() {
            for row in &left_out[record] {
                each[record].apart(*row, -off[rows.start + row]);
            }
        }
        Ok(LinearFit {
            form: problem.form,
            against: few.against,
            is_kept: few.is_kept,
            floor,
            misfit: Misfit::of_vector(&few.residual),
            floor_unshifted: unshifted.map(|own| lower_bound(&own)),
            curves: curves::curves(&records, &problem, [&left, &few.residual], halves.as_ref()),
            records: each,
            spring: spring.around(few.spectrum.spring),
            sum: sum.around(end),
            spectrum: few.spectrum,
            slowest: shift::slowest(&problem),
            limits: problem.limits,
        })
    }
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
    (records, shifts): (&[Record], &[f64]),
    problem: &Problem,
    few: &nalgebra::DVector<f64>,
    floor: f64,
) -> Vec<RecordFit> {
    let misfit = |record: usize| {
        let parts = problem.parts().filter(|own| own.0 == record);
        Misfit::of(&parts.flat_map(|own| &few.as_slice()[own.1]).copied().collect::<Vec<_>>())
    };
    let all = records.iter().zip(shifts).enumerate();
    all.map(|(at, (record, shift))| {
        let alone = || Problem::of(std::slice::from_ref(record), &[*shift]);
        let floor = if records.len() == 1 { floor } else { lower_bound(&alone()) };
        RecordFit {
            shift: *shift,
            floor,
            misfit: misfit(at),
            largest: record.largest(),
            contradiction: contradiction::contradiction(record, floor),
            outliers: Vec::new(),
        }
    })
    .collect()
}

impl RecordFit {
    /// Adds a row that was left out; of storage and loss in one row that which is farther off.
    fn apart(&mut self, row: usize, off: f64) {
        match self.outliers.iter_mut().find(|own| own.row == row) {
            Some(own) if own.off.abs() >= off.abs() => {}
            Some(own) => own.off = off,
            None => self.outliers.push(Outlier { row, off }),
        }
    }
}

#[cfg(test)]
mod tests;
