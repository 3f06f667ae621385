//! What a run says about its limits.

use super::{MeasureReport, RunReport};
use crate::{
    Band, Chance, Contact, ScatterReport, Warning,
    limits::{Bound, Judgement, Limit, Reason},
};

/// Times within this part of the run from its end are its end.
const LAST: f64 = 1e-9;

/// A limit, and what a run says about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged<'r> {
    /// The limit.
    pub limit: &'r Limit,
    /// The measure, with its value, unit and error; `None` where it is not reported.
    pub measure: Option<&'r MeasureReport>,
    /// What is known.
    pub judgement: Judgement,
    /// How often it is kept, where a sample of the scene's scatter was drawn.
    pub chance: Option<&'r Chance>,
    /// The measure over that sample, where the limit is one on the mean of several tests: the mean of the sample
    /// is what is judged then, and one run stands for it no more.
    pub sampled: Option<&'r Band>,
}

impl Judged<'_> {
    /// What is left in parts of the bound, negative where it is exceeded; `None` where that is not a number.
    pub fn margin(&self) -> Option<f64> {
        self.limit.bound.margin(self.value()?)
    }

    /// The value that is judged: that of the run, or the mean of the sample.
    pub fn value(&self) -> Option<f64> {
        match self.sampled {
            Some(band) => band.mean,
            None => self.measure?.value,
        }
    }

    /// What the mean of the sample says; some designs may end before their values are whole.
    fn of_sample(&self) -> Judgement {
        let known = |own: &Chance| own.odds.kept + own.beyond + own.outside + own.odds.exceeded;
        let is_open = self.chance.is_none_or(|own| known(own) < own.odds.designs);
        match self.value().zip(self.error()) {
            Some((value, error)) => self.limit.bound.judge(value, Some(error), is_open),
            None => Judgement::Undecided(Reason::NoValue),
        }
    }

    /// Its absolute error, where that is known; of the mean of a sample the standard error besides.
    pub fn error(&self) -> Option<f64> {
        let error = self.measure?.error;
        match self.sampled {
            Some(band) => Some(band.error_of_mean()? + error.unwrap_or(0.0)),
            None => error,
        }
    }
}

impl RunReport {
    /// The warnings that something is pressed further than is known of it.
    pub fn beyond_known(&self) -> impl Iterator<Item = &Warning> {
        self.warnings.iter().filter(|own| own.is_beyond_known())
    }

    /// Whether the run ends while something is still pressed.
    pub fn is_cut(&self) -> bool {
        self.contacts.iter().any(|contact| contact.impact.contact == Contact::Lasting)
    }

    /// Whether a measure is one of what the end of the run cuts off: it may still grow.
    pub fn is_so_far(&self, measure: &MeasureReport) -> bool {
        let last = measure.time.or(measure.window.map(|(_, end)| end));
        self.is_cut() && last.is_some_and(|time| time >= (1.0 - LAST) * self.energy.time)
    }

    /// What is known of each limit, in their order.
    pub fn judged(&self) -> Vec<Judged<'_>> {
        self.limits.iter().map(|limit| self.judge(limit)).collect()
    }

    /// The error of a measure, without end where errors were estimated and this one is not known.
    fn error_of(&self, measure: &MeasureReport) -> Option<f64> {
        let is_failed = |own: &Warning| matches!(own, Warning::ErrorsUnknown { .. });
        let are_estimated = self.measures.iter().any(|own| own.error.is_some())
            || self.warnings.iter().any(is_failed);
        measure.error.or(are_estimated.then_some(f64::INFINITY))
    }

    fn judge<'r>(&'r self, limit: &'r Limit) -> Judged<'r> {
        let measure = self.measure(&limit.key);
        let is_so_far = measure.is_some_and(|own| self.is_so_far(own));
        let infinite = |own: &MeasureReport| own.is_infinite().then_some(f64::INFINITY);
        let value = measure.and_then(|own| own.value.or(infinite(own)));
        let is_determined = measure.is_some_and(|own| !own.is_undetermined);
        let judgement = match (value.filter(|_| is_determined), limit.bound) {
            (None, _) => Judgement::Undecided(Reason::NoValue),
            (Some(f64::INFINITY), Bound::Max(_)) => Judgement::Fail,
            (Some(f64::INFINITY), Bound::Min(_)) => Judgement::Pass,
            (Some(value), bound) => {
                bound.judge(value, measure.and_then(|own| self.error_of(own)), is_so_far)
            }
        };
        let chance = self.scatter.as_ref().and_then(|own| own.chance(limit));
        let band = || self.scatter.as_ref().and_then(|own| own.band(&limit.key));
        let sampled = if limit.of_mean { band() } else { None };
        let judged = Judged { limit, measure, judgement, chance, sampled };
        let judgement = match sampled {
            None => {
                let doubts = self.warnings.iter().filter_map(|own| own.doubt(limit, false));
                let doubt = Reason::first(doubts);
                let is_too_few = |own: &ScatterReport| {
                    chance.is_some_and(|of| of.odds.range().0 * own.within() < own.wanted)
                };
                let is_rare = self.scatter.as_deref().is_some_and(is_too_few);
                judgement.doubted(doubt.or(is_rare.then_some(Reason::Scatter)))
            }
            Some(_) => judged.of_sample().doubted(chance.and_then(Chance::doubt)),
        };
        Judged { judgement, ..judged }
    }
}
