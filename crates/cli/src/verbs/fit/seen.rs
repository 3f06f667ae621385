//! What there is to say of a test to which a scene was fitted.

use dashpot_fit::network::{Kind, Test, TestFit};

use super::{
    asked::Asked,
    target::{Compared, Target},
};
use crate::output::list;
use dashpot_report::numbers::{percent_signed, quantity, significant};

/// Digits of times and residuals.
const FEW: usize = 3;
/// A peak that is missed by more than this part is told first.
const MISSED: f64 = 0.05;
/// A record that ends behind the run by more than this part of it is told.
const BEYOND: f64 = 0.01;
/// A test with what was found of it.
#[derive(Clone, Copy)]
pub(super) struct Seen<'s> {
    pub(super) asked: &'s Asked,
    pub(super) curve: &'s Target,
    pub(super) test: &'s Test,
    pub(super) own: &'s TestFit,
}

impl Seen<'_> {
    /// What is left of it, or noise, in words.
    pub(super) fn of(&self, value: f64) -> String {
        self.curve.output.told(value, FEW)
    }

    /// What comes first, of a run that is so long \[s\].
    pub(super) fn said_first(&self, duration: f64) -> Vec<String> {
        let Self { asked, curve, test, own } = self;
        let file = &asked.file;
        let held_out = own.held_out.map(|own| own.peak).filter(|off| off.abs() > MISSED);
        let held_out = held_out.map(|own| {
            format!(
                "fitted to the other tests alone, the peak of {file} is off by {}: the scene does not carry from one \
                 test to the other",
                percent_signed(own)
            )
        });
        let is_run = matches!(curve.output, Compared::Output(_));
        let last = curve.rows.last().filter(|_| is_run).map(|row| row.0 - own.shift);
        let beyond = last.filter(|last| *last > duration * (1.0 + BEYOND)).map(|last| {
            format!(
                "{file} goes on for {} behind the end of the run, where the last value stands: give the scene a \
                 longer `duration`",
                quantity(last - duration, "s", FEW)
            )
        });
        let zero = own.other_zero.map(|other| {
            format!(
                "{file}: the {} rows before the impact read {} where nothing happens, and the fitted zero is {}: they \
                 contradict each other, so that the model, its bounds or the clock is not right (`--offset off` takes \
                 the zero as it is)",
                other.rows,
                self.of(other.median),
                self.of(own.offset)
            )
        });
        let clipped = (own.clipped > 0).then(|| {
            format!(
                "{file}: {} rows stand at the end of its range: the record is clipped, and no number is identified; \
                 `until=` after its comma keeps what stands before",
                own.clipped
            )
        });
        let scatter = own.scatter.map(|own| own.deviation);
        let noise = test.noise.or(scatter).or(own.noise_at_rest);
        let noise = noise
            .map_or("its rows follow each other as noise does not".to_owned(), |own| {
                format!("noise is {}", self.of(own))
            });
        let left = own.is_structured.then(|| {
            format!(
                "{file}: what is left is {} where {noise}: the scene, or what is said of the record, is not quite what \
                 was tested, and intervals tell nothing of that{}",
                self.of(own.noise),
                if own.is_missed { "; it is so much of the peak that no number is identified" } else { "" }
            )
        });
        list([held_out, beyond, zero, clipped, self.missed_peak(), left].into_iter().flatten())
    }

    fn missed_peak(&self) -> Option<String> {
        let Self { asked, curve, test, own } = self;
        let file = &asked.file;
        let is_blow = test.kind == Kind::Blow;
        if own.is_opposed {
            let key = curve.output.key();
            let [one, other] = if own.model_peak < 0.0 {
                ["positive", "negative"]
            } else {
                ["negative", "positive"]
            };
            return Some(format!(
                "the largest value of {file} is {one}, and `{key}` is {other}: turn the sign of its column, \
                 \"{},scale=-1\"",
                asked.text
            ));
        }
        let off =
            Some(own.model_peak / own.measured_peak - 1.0).filter(|own| own.abs() > MISSED)?;
        let is_filter = test.filter.is_none() && is_blow;
        let filter =
            if is_filter { "a filter that the record went through (`--cfc`), " } else { "" };
        Some(format!(
            "the peak of {file} is missed by {}: noise, {filter}or a model that does not describe it",
            percent_signed(off)
        ))
    }

    /// What is to be known of it, by its number from 0.
    pub(super) fn remarks(&self, at: usize) -> Vec<String> {
        let Self { asked, curve, test, own } = self;
        let (file, key) = (&asked.file, curve.output.key());
        let jump = own.jump.map(|jump| {
            format!(
                "{file}: `{key}` jumps by {} as the impact begins, so that only samples beside it tell of the clock: it \
                 may be anywhere between them, which the intervals hold",
                self.of(jump)
            )
        });
        let later = own.later_jump.map(|later| {
            format!(
                "{file}: `{key}` jumps again, by {} at {} of the record, where it is touched once more; which sample is \
                 the first behind that is not looked for: the rows beside it are left out",
                self.of(later.height),
                quantity(later.time, "s", FEW)
            )
        });
        let repeats = own.scatter.filter(|_| test.repeated == Some(at)).map(|scatter| {
            format!(
                "{} records of `{}`, {file} the first: a row of them differs by {} (standard deviation), and {} rows \
                 stand for one that is independent; that is their noise, and leaving out one of them tells nothing",
                scatter.records,
                asked.what(),
                self.of(scatter.deviation),
                significant(scatter.correlation, 2)
            )
        });
        list([jump, later, repeats].into_iter().flatten())
    }
}
