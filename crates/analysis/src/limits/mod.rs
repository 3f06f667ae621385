//! Limits on measures, and what a value says about one.

pub mod standards;

use dashpot_network::parameters::registered;
use dashpot_units::Unit;

use crate::measures::{MEASURES, MeasureEntry};

/// A limit on a measure. The unit in which it was written makes no difference between two of them.
#[derive(Debug, Clone)]
pub struct Limit {
    /// Key of the measure, for instance `head.peak-acceleration`.
    pub key: String,
    /// What the measure may be.
    pub bound: Bound,
    /// Where the bound is from, for instance `EN 1078:2012`.
    pub from: Option<String>,
    /// Whether it is one on the mean of several tests, for which one run stands.
    pub of_mean: bool,
    /// The unit in which the bound was written.
    pub unit: Option<Unit>,
}

dashpot_units::words! {
    /// What a measure may be, in its SI unit; the bound itself is within.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub enum Bound, pub fn word(self) {
        /// At most this much.
        Max(f64) = "max",
        /// At least this much.
        Min(f64) = "min",
    }
}

dashpot_units::words! {
    /// What is known of a limit.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Judgement, pub fn word(self) {
        /// It is kept, however the error lies.
        Pass = "pass",
        /// It is exceeded, however the error lies.
        Fail = "fail",
        /// The value does not tell.
        Undecided(Reason) = "undecided",
    }
}

dashpot_units::words! {
    /// Why the value of a measure does not tell whether a limit is kept.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reason, pub fn word(self) {
        /// Its error reaches across the bound, or is not known.
        Error = "error",
        /// There is none.
        NoValue = "no-value",
        /// The run ends before it is whole.
        Cut = "cut",
        /// It keeps the limit, but stands on something that is pressed further than is known of it: beyond the points
        /// of its law, or beyond its thickness.
        Beyond = "beyond-known",
        /// It stands on something that is pressed to where its law does not hold, neither from above nor from below.
        NoLaw = "no-law",
        /// It keeps the limit in the impact, which it exceeds over the run.
        Outside = "harder-outside",
        /// It keeps the limit along the axes that were measured, and the limit is one on the resultant of all.
        OtherAxes = "other-axes",
        /// It keeps the limit, but the record is clipped: the measure was larger.
        Clipped = "clipped",
        /// The unit of the record is in doubt.
        Unit = "unit",
        /// It keeps the limit at the means of numbers with scatter, but too few of the designs do.
        Scatter = "scatter",
    }
}

impl Reason {
    /// The one that counts of several: that no law holds, else the first.
    pub(crate) fn first(mut all: impl Iterator<Item = Self> + Clone) -> Option<Self> {
        all.clone().find(|own| *own == Self::NoLaw).or_else(|| all.next())
    }
}

impl Judgement {
    /// Why it is not known whether the limit is kept, where it is not.
    pub fn reason(self) -> Option<Reason> {
        match self {
            Self::Undecided(reason) => Some(reason),
            Self::Pass | Self::Fail => None,
        }
    }

    /// The same of a run about which there is a `doubt`: nothing is kept there for certain. What is exceeded stays
    /// so where a law holds, and of a run that is cut short the doubt comes first: a longer one would not take it away.
    #[must_use]
    pub fn doubted(self, doubt: Option<Reason>) -> Self {
        match (self, doubt) {
            (Self::Pass | Self::Undecided(Reason::Cut), Some(doubt))
            | (Self::Fail, Some(doubt @ Reason::NoLaw)) => Self::Undecided(doubt),
            (own, _) => own,
        }
    }
}

impl Bound {
    /// The number itself.
    pub fn level(self) -> f64 {
        match self {
            Self::Max(level) | Self::Min(level) => level,
        }
    }

    /// Its sign: `<=` or `>=`.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Max(_) => "<=",
            Self::Min(_) => ">=",
        }
    }

    /// How far a value may still move, negative where it is beyond.
    fn room(self, value: f64) -> f64 {
        match self {
            Self::Max(level) => level - value,
            Self::Min(level) => value - level,
        }
    }

    /// What is left in parts of the bound, negative where it is exceeded: `(bound − value)/|bound|` for
    /// [`Max`](Self::Max), the reverse for [`Min`](Self::Min). `None` for a bound of zero.
    pub fn margin(self, value: f64) -> Option<f64> {
        (self.level() != 0.0).then(|| self.room(value) / self.level().abs())
    }

    /// What a value with this absolute error says; where errors are not estimated, the value alone. `grows`
    /// tells that it may still grow.
    pub fn judge(self, value: f64, error: Option<f64>, grows: bool) -> Judgement {
        let (room, error) = (self.room(value), error.unwrap_or(0.0));
        let is_told = error.is_finite() && !value.is_nan();
        match self {
            Self::Max(_) if is_told && room < -error => Judgement::Fail,
            Self::Min(_) if is_told && room >= error => Judgement::Pass,
            _ if value.is_nan() => Judgement::Undecided(Reason::NoValue),
            _ if grows => Judgement::Undecided(Reason::Cut),
            _ if !is_told => Judgement::Undecided(Reason::Error),
            _ if room >= error => Judgement::Pass,
            _ if room < -error => Judgement::Fail,
            _ => Judgement::Undecided(Reason::Error),
        }
    }
}

impl PartialEq for Limit {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other) && self.from == other.from
    }
}

impl Limit {
    /// A limit on the measure with this key, of no source.
    pub fn new(key: impl Into<String>, bound: Bound) -> Self {
        Self { key: key.into(), bound, from: None, of_mean: false, unit: None }
    }

    /// Adds further ones to some, but for those that are among them.
    pub fn add(all: &mut Vec<Self>, further: impl IntoIterator<Item = Self>) {
        for own in further {
            if !all.iter().any(|known| known.is_same(&own)) {
                all.push(own);
            }
        }
    }

    /// Whether it allows the same, wherever it is from and in whichever unit it was written.
    pub fn is_same(&self, other: &Self) -> bool {
        (&self.key, self.bound, self.of_mean) == (&other.key, other.bound, other.of_mean)
    }

    /// Two of some of which no value keeps both: the most that is allowed is less than the least.
    pub fn contradiction(all: &[Self]) -> Option<[&Self; 2]> {
        let excludes = |most: &Self, least: &Self| match (most.bound, least.bound) {
            (Bound::Max(most_level), Bound::Min(least_level)) => {
                most.key == least.key && most_level < least_level
            }
            _ => false,
        };
        let least = |most| all.iter().find(|least| excludes(most, least));
        all.iter().find_map(|most| Some([most, least(most)?]))
    }

    /// The same on a measure that is `factor` times as large, positive.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let bound = match self.bound {
            Bound::Max(level) => Bound::Max(factor * level),
            Bound::Min(level) => Bound::Min(factor * level),
        };
        Self { bound, ..self.clone() }
    }

    /// The kind of the measure, where its word is known.
    pub fn measure(&self) -> Option<&'static MeasureEntry> {
        registered(MEASURES, self.key.rsplit_once('.')?.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_reaches_across_the_bound_decides_nothing() {
        use Judgement::{Fail, Pass};
        let open = Judgement::Undecided(Reason::Error);
        let of = |value, error| {
            [Bound::Max(250.0), Bound::Min(250.0)].map(|own| own.judge(value, Some(error), false))
        };
        assert_eq!(of(240.0, 9.0), [Pass, Fail]);
        assert_eq!(of(240.0, 11.0), [open, open]);
        assert_eq!(of(260.0, 9.0), [Fail, Pass]);
        assert_eq!(of(260.0, 11.0), [open, open]);
        // The bound itself is within.
        assert_eq!(of(250.0, 0.0), [Pass, Pass]);
        assert_eq!(of(1.0, f64::INFINITY), [open, open]);
        assert_eq!(of(f64::NAN, 0.0), [Judgement::Undecided(Reason::NoValue); 2]);
    }

    #[test]
    fn what_may_still_grow_can_only_have_exceeded() {
        use Judgement::{Fail, Pass};
        let open = Judgement::Undecided(Reason::Cut);
        let of = |value| {
            [Bound::Max(250.0), Bound::Min(250.0)].map(|own| own.judge(value, Some(1.0), true))
        };
        assert_eq!(of(240.0), [open, open]);
        assert_eq!(of(260.0), [Fail, Pass]);
    }

    #[test]
    fn what_is_kept_beyond_what_is_known_is_kept_by_nothing() {
        use Judgement::{Fail, Pass, Undecided};
        for own in [Pass, Fail, Undecided(Reason::Cut)] {
            assert_eq!(own.doubted(None), own);
        }
        for doubt in [Reason::Beyond, Reason::Outside] {
            assert_eq!(Pass.doubted(Some(doubt)), Undecided(doubt));
            assert_eq!(Fail.doubted(Some(doubt)), Fail);
            assert_eq!(Undecided(Reason::Error).doubted(Some(doubt)), Undecided(Reason::Error));
            assert_eq!(Undecided(Reason::Cut).doubted(Some(doubt)), Undecided(doubt));
        }
        // Where no law holds, nothing is exceeded either.
        assert_eq!(Fail.doubted(Some(Reason::NoLaw)), Undecided(Reason::NoLaw));
    }

    #[test]
    fn a_range_that_is_empty_is_a_contradiction() {
        let of = |key: &str, bound| Limit::new(key, bound);
        let (most, least) = (of("a.b", Bound::Max(2.0)), of("a.b", Bound::Min(3.0)));
        let all = [least.clone(), of("a.c", Bound::Max(1.0)), most.clone()];
        assert_eq!(Limit::contradiction(&all), Some([&most, &least]));
        // The bounds themselves are within.
        assert_eq!(Limit::contradiction(&[of("a.b", Bound::Max(3.0)), least]), None);
        assert_eq!(Limit::contradiction(&[most, of("a.c", Bound::Min(3.0))]), None);
    }

    #[test]
    fn margins_are_parts_of_the_bound() {
        let close =
            |one: Option<f64>, other: f64| one.is_some_and(|own| (own - other).abs() < 1e-15);
        assert!(close(Bound::Max(200.0).margin(150.0), 0.25));
        assert!(close(Bound::Max(200.0).margin(250.0), -0.25));
        assert!(close(Bound::Min(200.0).margin(250.0), 0.25));
        assert!(close(Bound::Max(-200.0).margin(-250.0), 0.25));
        assert_eq!(Bound::Max(0.0).margin(1.0), None);
    }
}
