//! Tests and a model as a problem of least squares.
//!
//! Unknowns are the logarithms of the numbers, then for each test its shift in parts of its length and its offset in
//! parts of its peak. Residuals are parts of the peak that was measured, so that tests of all sizes count alike.

use nalgebra::DMatrix;

use super::{Curve, Model, Number, Test, TestFit};
use crate::optimum::Residuals;

/// Step of differences in logarithms of numbers.
const STEP: f64 = 1e-3;
/// Step of differences in time, in parts of the length of a test.
const TIME_STEP: f64 = 1e-5;

/// What is fitted to what.
pub(super) struct Task<'t> {
    numbers: &'t [Number],
    tests: &'t [Test],
    model: &'t Model<'t>,
    scales: Vec<Scale>,
}

/// Length and mean step of a test \[s\], and its largest magnitude, with the time of that.
#[derive(Debug, Clone, Copy)]
struct Scale {
    length: f64,
    step: f64,
    peak: f64,
    peak_time: f64,
}

/// A start, and the lower and upper bounds around it.
type Begun = (Vec<f64>, [Vec<f64>; 2]);

impl<'t> Task<'t> {
    pub(super) fn new(numbers: &'t [Number], tests: &'t [Test], model: &'t Model<'t>) -> Self {
        let scale = |own: &Test| {
            let (mut first, mut last, mut peak) = (f64::INFINITY, f64::NEG_INFINITY, (0.0, 0.0));
            for &(time, value) in &own.rows {
                (first, last) = (first.min(time), last.max(time));
                if value.abs() > f64::abs(peak.1) {
                    peak = (time, value);
                }
            }
            let length = (last - first).max(f64::MIN_POSITIVE);
            let step = length / own.rows.len() as f64;
            Scale { length, step, peak: f64::abs(peak.1), peak_time: peak.0 }
        };
        Self { numbers, tests, model, scales: tests.iter().map(scale).collect() }
    }

    pub(super) fn rows(&self) -> usize {
        self.tests.iter().map(|own| own.rows.len()).sum()
    }

    pub(super) fn numbers(&self) -> &[Number] {
        self.numbers
    }

    /// The numbers, in SI units.
    pub(super) fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let each = unknowns.iter().zip(self.numbers);
        each.map(|(own, number)| own.exp().clamp(number.low, number.high)).collect()
    }

    /// Position of the shift of a test among the unknowns, and of its offset.
    fn places(&self, test: usize) -> [Option<usize>; 2] {
        let mut next = self.numbers.len();
        let mut place = |is_there: bool| {
            next += usize::from(is_there);
            is_there.then(|| next - 1)
        };
        let mut own = [None, None];
        for at in &self.tests[..=test] {
            own = [place(at.is_shifted), place(at.is_offset)];
        }
        own
    }

    /// Shift \[s\] and offset of a test.
    fn own(&self, test: usize, unknowns: &[f64]) -> [f64; 2] {
        let Scale { length, peak, .. } = self.scales[test];
        let [shift, offset] = self.places(test);
        [
            shift.map_or(0.0, |at| unknowns[at] * length),
            offset.map_or(0.0, |at| unknowns[at] * peak),
        ]
    }

    /// The unknowns where the numbers have these values and the peaks stand together.
    ///
    /// # Errors
    ///
    /// Why the model cannot be solved there.
    pub(super) fn begin(&self, values: &[f64]) -> Result<Begun, String> {
        let mut start: Vec<f64> = values.iter().map(|own| own.ln()).collect();
        let mut lower: Vec<f64> = self.numbers.iter().map(|own| own.low.ln()).collect();
        let mut upper: Vec<f64> = self.numbers.iter().map(|own| own.high.ln()).collect();
        for (at, test) in self.tests.iter().enumerate() {
            let scale = self.scales[at];
            let curve = (self.model)(at, values)?;
            if test.is_shifted {
                start.push(((scale.peak_time - curve.peak().0) / scale.length).clamp(-1.0, 1.0));
                lower.push(-2.0);
                upper.push(2.0);
            }
            if test.is_offset {
                start.push(0.0);
                lower.push(-1.0);
                upper.push(1.0);
            }
        }
        Ok((start, [lower, upper]))
    }

    /// What is left of all rows, in parts of the peak of their test.
    pub(super) fn left(&self, unknowns: &[f64]) -> Vec<f64> {
        let values = self.values(unknowns);
        let mut all = Vec::with_capacity(self.rows());
        for at in 0..self.tests.len() {
            let Ok(curve) = (self.model)(at, &values) else { return vec![f64::NAN; self.rows()] };
            all.extend(self.left_of(at, curve.as_ref(), self.own(at, unknowns)));
        }
        all
    }

    /// The rows of each test.
    pub(super) fn parts(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let mut from = 0;
        self.tests.iter().map(move |own| {
            let rows = from..from + own.rows.len();
            from = rows.end;
            rows
        })
    }

    fn left_of(&self, test: usize, curve: &dyn Curve, [shift, offset]: [f64; 2]) -> Vec<f64> {
        let Scale { peak, step, .. } = self.scales[test];
        let (rest, start) = (curve.value(-step), curve.value(0.0));
        // What jumps at the start rises within one step of the recorder: else no clock could be moved over a row.
        let value = |time: f64| {
            if time > -step && time < 0.0 {
                start + (rest - start) * -time / step
            } else {
                curve.value(time)
            }
        };
        let rows = self.tests[test].rows.iter();
        rows.map(|(time, own)| (value(time - shift) + offset - own) / peak).collect()
    }

    /// The standard deviation that the median of what is left stands for.
    pub(super) fn scale(&self, unknowns: &[f64]) -> Option<f64> {
        let mut left: Vec<f64> = self.left(unknowns).iter().map(|own| own.abs()).collect();
        left.sort_by(f64::total_cmp);
        left.get(left.len() / 2).map(|own| super::OF_MEDIAN * own)
    }

    /// What there is to say about each test.
    pub(super) fn told(&self, unknowns: &[f64]) -> Vec<TestFit> {
        let values = self.values(unknowns);
        let told = |at: usize| {
            let [shift, offset] = self.own(at, unknowns);
            let curve = (self.model)(at, &values).ok()?;
            let peak = self.scales[at].peak;
            let left = self.left_of(at, curve.as_ref(), [shift, offset]);
            let residual: Vec<f64> = left.iter().map(|own| own * peak).collect();
            let square: f64 = residual.iter().map(|own| own * own).sum();
            let rows = self.tests[at].rows.iter().map(|own| own.1 - offset);
            let measured = |most: f64, own: f64| if own.abs() > most.abs() { own } else { most };
            Some(TestFit {
                shift,
                offset,
                rms: (square / residual.len() as f64).sqrt(),
                measured_peak: rows.fold(0.0, measured),
                model_peak: curve.peak().1,
                residual,
                held_out: None,
            })
        };
        (0..self.tests.len()).filter_map(told).collect()
    }
}

impl Residuals for Task<'_> {
    fn residual(&self, unknowns: &[f64]) -> Vec<f64> {
        self.left(unknowns)
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.rows(), unknowns.len());
        for at in 0..self.numbers.len() {
            let beside = |step: f64| {
                let mut own = unknowns.to_vec();
                own[at] += step;
                own[at] = own[at].clamp(self.numbers[at].low.ln(), self.numbers[at].high.ln());
                (own[at], self.left(&own))
            };
            let ((low, before), (high, after)) = (beside(-STEP), beside(STEP));
            let each = before.iter().zip(&after).map(|(one, other)| (other - one) / (high - low));
            jacobian.column_mut(at).iter_mut().zip(each).for_each(|(own, new)| *own = new);
        }
        let values = self.values(unknowns);
        for (test, rows) in self.parts().enumerate() {
            let [shift, offset] = self.places(test);
            if let Some(at) = offset {
                jacobian.view_mut((rows.start, at), (rows.len(), 1)).fill(1.0);
            }
            let Some(at) = shift else { continue };
            let Ok(curve) = (self.model)(test, &values) else {
                jacobian.fill(f64::NAN);
                continue;
            };
            let [own, offset] = self.own(test, unknowns);
            let step = TIME_STEP * self.scales[test].length;
            let [before, after] = [own - step, own + step]
                .map(|shift| self.left_of(test, curve.as_ref(), [shift, offset]));
            for (row, (one, other)) in rows.zip(before.iter().zip(&after)) {
                jacobian[(row, at)] = (other - one) / (2.0 * TIME_STEP);
            }
        }
        jacobian
    }
}
