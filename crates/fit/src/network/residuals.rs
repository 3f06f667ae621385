//! Tests and a model as a problem of least squares.
//!
//! Unknowns are the logarithms of the numbers, then for each test its shift in parts of its length, its offset in
//! parts of its peak, the logarithm of its gain, and how far its own numbers are from what was measured of them, the
//! last two in standard deviations. What is left of a test is made independent where its filter has correlated it, and
//! counted in a unit of the test; behind it stands how far what is known is off, and behind that how far clocks are from
//! the middle of the step in which their curves jump.

use std::{cell::RefCell, iter::repeat_n, ops::Range, rc::Rc};

use dashpot_signal::SettingsFault;
use nalgebra::DMatrix;

use super::{
    Curve, Kind, Model, Number, Test,
    jump::{Jump, ramped},
    record::Record,
    watch::{Phase, Watched},
};
use crate::optimum::Residuals;

/// Step of differences in logarithms of numbers, and in standard deviations: short, as a row at which a curve has a kink
/// is passed by within it.
const STEP: f64 = 2e-4;
/// Step of differences in time, in parts of the length of a test.
const TIME_STEP: f64 = 1e-5;
/// Part of a step of the recorder over which a curve goes on straight before its start.
const NEXT: f64 = 0.125;
/// A clock is not later by more lengths of its test, nor than that of its history by more steps, and a zero not off by
/// more peaks.
const LATEST: f64 = 2.0;
const STEPS: f64 = 2.0;
const HIGHEST: f64 = 1.0;
/// A clock that is put into the step in which its curve jumps may leave that by so many steps, as any estimate.
const BEYOND: f64 = 3.0;
/// What is known of a gain or a number is not left by more standard deviations.
const FARTHEST: f64 = 8.0;
/// Curves of each test that are kept: slopes are asked for where residuals have been.
const KEPT: usize = 2;

/// Curves of a test, each with its numbers.
type Kept = Vec<(Vec<f64>, Rc<dyn Curve>)>;

/// What is fitted to what.
pub(super) struct Task<'t> {
    numbers: &'t [Number],
    tests: &'t [Test],
    model: &'t Model<'t>,
    records: Vec<Record>,
    /// The last curves of each test.
    kept: RefCell<Vec<Kept>>,
    /// Whether a minimum is looked for that is refined later: differences to one side lead there, too.
    pub(super) is_sought: bool,
    watched: Option<&'t Watched<'t>>,
}

/// What a test has to itself: shift \[s\], offset, gain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Own {
    pub(super) shift: f64,
    pub(super) offset: f64,
    pub(super) gain: f64,
}

/// Where these stand among the unknowns, and where the numbers of the test begin.
pub(super) struct Places {
    pub(super) shift: Option<usize>,
    offset: Option<usize>,
    gain: Option<usize>,
    known: usize,
}

impl<'t> Task<'t> {
    /// # Errors
    ///
    /// A test that cannot have gone through its filter.
    pub(super) fn new(
        numbers: &'t [Number],
        tests: &'t [Test],
        model: &'t Model<'t>,
    ) -> Result<Self, (usize, SettingsFault)> {
        let records = tests.iter().enumerate();
        let records = records.map(|(at, own)| Record::of(own).map_err(|fault| (at, fault)));
        Ok(Self {
            numbers,
            tests,
            model,
            records: records.collect::<Result<_, _>>()?,
            kept: RefCell::new(tests.iter().map(|_| Kept::new()).collect()),
            is_sought: false,
            watched: None,
        })
    }

    /// The same, watched.
    pub(super) fn watched(self, watched: &'t Watched<'t>) -> Self {
        Self { watched: Some(watched), ..self }
    }

    /// Whether who watches it has ended the search.
    pub(super) fn is_ended(&self) -> bool {
        self.watched.is_some_and(Watched::is_stopped)
    }

    /// Something else begins; returns whether it still may.
    pub(super) fn begin_phase(&self, phase: Phase) -> bool {
        self.watched.is_none_or(|own| own.begin(phase))
    }

    /// Rows of all tests, and of what is known of their own unknowns.
    pub(super) fn rows(&self) -> usize {
        self.measured() + self.tests.iter().map(Test::priors).sum::<usize>() + self.jumps().count()
    }

    /// Rows of all tests.
    fn measured(&self) -> usize {
        self.records.iter().map(Record::rows).sum()
    }

    pub(super) fn numbers(&self) -> &[Number] {
        self.numbers
    }

    pub(super) fn tests(&self) -> &[Test] {
        self.tests
    }

    /// How many unknowns there are.
    pub(super) fn unknowns(&self) -> usize {
        self.numbers.len() + self.tests.iter().map(Test::unknowns).sum::<usize>()
    }

    /// Counts the rows of each test in a unit of its own.
    pub(super) fn count_in(&mut self, units: &[f64]) {
        self.records.iter_mut().zip(units).for_each(|(own, unit)| own.unit = *unit);
    }

    /// What the rows of a test are counted in, in SI units.
    pub(super) fn unit(&self, test: usize) -> f64 {
        self.records[test].unit
    }

    pub(super) fn record(&self, test: usize) -> &Record {
        &self.records[test]
    }

    /// Says where the curve of a test jumps among its samples.
    pub(super) fn set_jump(&mut self, test: usize, jump: Option<Jump>) {
        self.records[test].jump = jump;
    }

    /// Says which rows of a test stand beside other jumps of its curve.
    pub(super) fn set_skipped(&mut self, test: usize, skipped: Vec<usize>) {
        self.records[test].skipped = skipped;
    }

    /// Takes averages over one of so many parts of a pulse for the rows, or the samples. Whether those of any test are
    /// averages.
    pub(super) fn average(&mut self, parts: Option<usize>) -> bool {
        let each = self.records.iter_mut().zip(self.tests);
        each.map(|(own, test)| own.average(test, parts)).fold(false, |one, other| one | other)
    }

    /// The tests whose curves jump, each with the place of its shift.
    pub(super) fn jumps(&self) -> impl Iterator<Item = (usize, usize, Jump)> + '_ {
        let own = |test: usize| Some((test, self.places(test).shift?, self.records[test].jump?));
        (0..self.tests.len()).filter_map(own)
    }

    /// The shared numbers, in SI units.
    pub(super) fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let each = unknowns.iter().zip(self.numbers);
        each.map(|(own, number)| own.exp().clamp(number.low, number.high)).collect()
    }

    /// The numbers of a test: those that it shares, and its own.
    pub(super) fn values_of(&self, test: usize, unknowns: &[f64]) -> Vec<f64> {
        let from = self.places(test).known;
        let known = self.tests[test].known.iter().zip(&unknowns[from..]);
        let known = known.map(|(known, own)| known.mean + own * known.deviation);
        self.values(unknowns).into_iter().chain(known).collect()
    }

    pub(super) fn places(&self, test: usize) -> Places {
        let before = self.tests[..test].iter().map(Test::unknowns).sum::<usize>();
        let mut next = self.numbers.len() + before;
        let mut place = |is_there: bool| {
            next += usize::from(is_there);
            is_there.then(|| next - 1)
        };
        let own = &self.tests[test];
        let [shift, offset, gain] =
            [own.is_shifted, own.is_offset, own.gain.is_some()].map(&mut place);
        Places { shift, offset, gain, known: next }
    }

    /// What a test has to itself.
    pub(super) fn own(&self, test: usize, unknowns: &[f64]) -> Own {
        let Record { length, peak, .. } = self.records[test];
        let Places { shift, offset, gain, .. } = self.places(test);
        let deviation = self.tests[test].gain.unwrap_or(0.0);
        Own {
            shift: shift.map_or(0.0, |at| unknowns[at] * length),
            offset: offset.map_or(0.0, |at| unknowns[at] * peak),
            gain: gain.map_or(1.0, |at| (unknowns[at] * deviation).exp()),
        }
    }

    /// The unknowns where the numbers have these values and the peaks, or the jumps, stand together.
    ///
    /// # Errors
    ///
    /// Why the model cannot be solved there.
    pub(super) fn begin(&self, values: &[f64]) -> Result<Vec<f64>, String> {
        let mut start: Vec<f64> = values.iter().map(|own| own.ln()).collect();
        for (at, test) in self.tests.iter().enumerate() {
            let record = &self.records[at];
            let known = test.known.iter().map(|own| own.mean);
            let own: Vec<f64> = values.iter().copied().chain(known).collect();
            let curve = self.solved(at, &own)?;
            if test.is_shifted {
                let late = self.start_of_clock(at, curve.as_ref()) / record.length;
                start.push(late.clamp(-1.0, 1.0));
            }
            start.resize(start.len() + usize::from(test.is_offset) + test.priors(), 0.0);
        }
        Ok(start)
    }

    /// Between which values the unknowns are searched.
    pub(super) fn bounds(&self) -> [Vec<f64>; 2] {
        let own = self.tests.iter().zip(&self.records).flat_map(|(test, record)| {
            let latest = match test.kind {
                Kind::Answer => STEPS * record.step / record.length,
                _ => LATEST,
            };
            let shift = test.is_shifted.then_some(latest);
            let offset = test.is_offset.then_some(HIGHEST);
            shift.into_iter().chain(offset).chain(repeat_n(FARTHEST, test.priors()))
        });
        let own: Vec<f64> = own.collect();
        let with = |sign: f64, of: fn(&Number) -> f64| -> Vec<f64> {
            let numbers = self.numbers.iter().map(|own| of(own).ln());
            numbers.chain(own.iter().map(|bound| sign * bound)).collect()
        };
        let mut both = [with(-1.0, |own| own.low), with(1.0, |own| own.high)];
        for (test, at, jump) in self.jumps() {
            let [first, last] = jump.ends;
            // The samples have chosen sides, so that nothing happens to the sum at these ends.
            let ends = [first - BEYOND * (last - first), last + BEYOND * (last - first)];
            let ends = ends.map(|end| end / self.records[test].length);
            both.iter_mut().zip(ends).for_each(|(side, end)| side[at] = end);
        }
        both
    }

    /// What is left of all rows, each in the unit of its test, and how far what is known is off.
    pub(super) fn left(&self, unknowns: &[f64]) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.rows());
        for at in 0..self.tests.len() {
            let Ok(curve) = self.curve(at, unknowns) else {
                return vec![f64::NAN; self.rows()];
            };
            all.extend(self.left_of(at, curve.as_ref(), self.own(at, unknowns)));
        }
        for at in 0..self.tests.len() {
            all.extend(self.priors(at).map(|place| unknowns[place]));
        }
        let off = |(test, at, jump): (usize, usize, Jump)| {
            jump.off(unknowns[at] * self.records[test].length)
        };
        all.extend(self.jumps().map(off));
        all
    }

    /// The unknowns of a test that are known from elsewhere.
    fn priors(&self, test: usize) -> Range<usize> {
        let from = self.places(test).known - usize::from(self.tests[test].gain.is_some());
        from..from + self.tests[test].priors()
    }

    /// The rows of each test.
    pub(super) fn parts(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut from = 0;
        self.records.iter().map(move |own| {
            let rows = from..from + own.rows();
            from = rows.end;
            rows
        })
    }

    /// How many rows of a test are of samples before a time \[s\].
    pub(super) fn rows_before(&self, test: usize, time: f64) -> usize {
        let record = &self.records[test];
        let samples = record.recorder.times().partition_point(|own| *own < time);
        record.whitener.as_ref().map_or(samples, |own| own.before(samples))
    }

    /// The samples of a curve behind the filter, by a clock that is so late.
    pub(super) fn recorded(&self, test: usize, curve: &dyn Curve, shift: f64) -> Vec<f64> {
        let Record { recorder, step, jump, .. } = &self.records[test];
        if !self.tests[test].is_shifted {
            return recorder.record(|time| curve.value(time - shift));
        }
        let (rest, start) = (curve.value(-step), curve.value(0.0));
        let Some(jump) = jump else {
            // What jumps rises within one step of the recorder: else no clock could be moved over a row.
            let value = |time: f64| {
                if time > -step && time < 0.0 {
                    start + (rest - start) * -time / step
                } else {
                    curve.value(time)
                }
            };
            let mut values: Vec<f64> =
                recorder.times().iter().map(|time| value(time - shift)).collect();
            ramped(&mut values, recorder.times(), &|time| value(time - shift));
            return recorder.passed(values);
        };
        let slope = (curve.value(NEXT * step) - start) / (NEXT * step);
        let value = |(at, time): (usize, &f64)| match time - shift {
            _ if at < jump.first => rest,
            time if time < 0.0 => start + slope * time,
            time => curve.value(time),
        };
        recorder.passed(recorder.times().iter().enumerate().map(value).collect())
    }

    /// What is left of each sample, in SI units; of moduli the logarithms of model over row.
    pub(super) fn differences(&self, test: usize, curve: &dyn Curve, own: Own) -> Vec<f64> {
        let constant = &self.records[test].constant;
        let recorded = self.recorded(test, curve, own.shift).into_iter().zip(constant);
        let model = recorded.map(|(value, one)| own.gain * value + own.offset * one);
        let is_modulus = self.tests[test].kind == Kind::Modulus;
        let left = |(model, row): (f64, &(f64, f64))| {
            if is_modulus { (model / row.1).ln() } else { model - row.1 }
        };
        model.zip(&self.tests[test].rows).map(left).collect()
    }

    pub(super) fn left_of(&self, test: usize, curve: &dyn Curve, own: Own) -> Vec<f64> {
        let differences = self.differences(test, curve, own);
        self.counted(test, differences, 1.0)
    }

    /// Independent rows of values of all samples, times a factor, in the unit of the test.
    fn counted(&self, test: usize, values: Vec<f64>, factor: f64) -> Vec<f64> {
        let record = &self.records[test];
        let mut all = record.independent(values);
        all.iter_mut().for_each(|own| *own *= factor / record.unit);
        all
    }

    /// The curve of a test.
    pub(super) fn curve(&self, test: usize, unknowns: &[f64]) -> Result<Rc<dyn Curve>, String> {
        self.solved(test, &self.values_of(test, unknowns))
    }

    /// The curve of a test where its numbers have these values.
    pub(super) fn solved(&self, test: usize, values: &[f64]) -> Result<Rc<dyn Curve>, String> {
        let is_it = |own: &&(Vec<f64>, Rc<dyn Curve>)| {
            own.0.iter().zip(values).all(|(one, other)| one.to_bits() == other.to_bits())
        };
        if let Some(own) = self.kept.borrow()[test].iter().find(is_it) {
            return Ok(Rc::clone(&own.1));
        }
        let curve: Rc<dyn Curve> = (self.model)(test, values)?.into();
        let kept = &mut self.kept.borrow_mut()[test];
        kept.truncate(KEPT - 1);
        kept.insert(0, (values.to_vec(), Rc::clone(&curve)));
        Ok(curve)
    }

    /// Derivatives by a number, by differences within its bounds: to both sides, or from where it is into the larger room.
    fn by_number(&self, at: usize, unknowns: &[f64], is_one_sided: bool) -> Vec<f64> {
        let [low, high] = [self.numbers[at].low.ln(), self.numbers[at].high.ln()];
        let beside = |step: f64| {
            let mut own = unknowns.to_vec();
            own[at] = (own[at] + step).clamp(low, high);
            (own[at], self.left(&own))
        };
        let is_low = unknowns[at] - low < high - unknowns[at];
        let steps = match (is_one_sided, is_low) {
            (false, _) => [-STEP, STEP],
            (true, true) => [0.0, STEP],
            (true, false) => [-STEP, 0.0],
        };
        let [(low, before), (high, after)] = steps.map(beside);
        before.iter().zip(&after).map(|(one, other)| (other - one) / (high - low)).collect()
    }

    /// Derivatives of a test by its own unknowns: the place of each, and the column.
    fn by_own(&self, test: usize, unknowns: &[f64]) -> Option<Vec<(usize, Vec<f64>)>> {
        let (record, places) = (&self.records[test], self.places(test));
        let curve = self.curve(test, unknowns).ok()?;
        let own = self.own(test, unknowns);
        let mut columns = Vec::new();
        if let Some(at) = places.shift {
            let step = TIME_STEP * record.length;
            let [before, after] = [own.shift - step, own.shift + step]
                .map(|shift| self.recorded(test, curve.as_ref(), shift));
            let slopes = before.iter().zip(&after).map(|(one, other)| other - one).collect();
            columns.push((at, self.counted(test, slopes, own.gain / (2.0 * TIME_STEP))));
        }
        if let Some(at) = places.offset {
            columns.push((at, self.counted(test, record.constant.clone(), record.peak)));
        }
        if let Some(at) = places.gain {
            let deviation = self.tests[test].gain.unwrap_or(0.0);
            let (values, factor) = match self.tests[test].kind {
                Kind::Modulus => (vec![1.0; record.rows()], 1.0),
                _ => (self.recorded(test, curve.as_ref(), own.shift), own.gain),
            };
            columns.push((at, self.counted(test, values, factor * deviation)));
        }
        for at in (places.known..).take(self.tests[test].known.len()) {
            let beside = |step: f64| {
                let mut moved = unknowns.to_vec();
                moved[at] += step;
                let curve = self.curve(test, &moved).ok()?;
                Some(self.left_of(test, curve.as_ref(), own))
            };
            let (before, after) = (beside(-STEP)?, beside(STEP)?);
            let slopes = before.iter().zip(&after).map(|(one, other)| (other - one) / (2.0 * STEP));
            columns.push((at, slopes.collect()));
        }
        Some(columns)
    }
}

impl Residuals for Task<'_> {
    fn is_stopped(&self, steps: usize, cost: f64) -> bool {
        self.watched.is_some_and(|own| own.step(steps, cost))
    }

    fn residual(&self, unknowns: &[f64]) -> Vec<f64> {
        self.left(unknowns)
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        self.slopes(unknowns, None)
    }
}

impl Task<'_> {
    /// The derivatives of what is left, one column for each unknown. Where a number is held its column is zero. Of a
    /// refit the sum alone is asked for: like a search it takes differences to one side, for half of the solutions.
    pub(super) fn slopes(&self, unknowns: &[f64], held: Option<usize>) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.rows(), unknowns.len());
        let mut prior = self.measured();
        for (test, rows) in self.parts().enumerate() {
            let Some(columns) = self.by_own(test, unknowns) else {
                jacobian.fill(f64::NAN);
                return jacobian;
            };
            for (at, column) in columns {
                jacobian.view_mut((rows.start, at), (rows.len(), 1)).copy_from_slice(&column);
            }
            for at in self.priors(test) {
                jacobian[(prior, at)] = 1.0;
                prior += 1;
            }
        }
        for (test, at, jump) in self.jumps() {
            jacobian[(prior, at)] = self.records[test].length / jump.deviation;
            prior += 1;
        }
        for at in (0..self.numbers.len()).filter(|at| held != Some(*at)) {
            let column = self.by_number(at, unknowns, self.is_sought || held.is_some());
            jacobian.column_mut(at).copy_from_slice(&column);
        }
        jacobian
    }
}
