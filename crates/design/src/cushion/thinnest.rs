//! The thinnest cushion that keeps a limit over a range of static stresses, and the lightest.

use dashpot_numerics::extrema::maximum;

use super::{
    CushionPoint, Known, Sure,
    best::ratios,
    curves::Tests,
    edge::{edge, surely},
};

/// A thickness is found to this part of the thickest one …
const NEAREST: f64 = 1e-6;
/// … and to this one where many are compared.
pub(super) const ROUGHLY: f64 = 2e-4;
/// Stresses of the range at which it has to be kept, at equal ratios.
const STRESSES: u16 = 13;
/// Steps of the search for the lightest one between these: to a thousandth of their distance.
const STEPS: usize = 14;

/// Why no cushion that was looked at will do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unmet {
    /// The thickest one has this peak \[m/s²\] at this stress \[Pa\].
    Peak(f64, f64),
    /// The peak of the thickest one at this stress \[Pa\] cannot be used, for this reason.
    Known(f64, Known),
}

impl Unmet {
    /// Whether it is certain that nothing will do: where a drop could not be evaluated, or leaves the range of a measured
    /// law, that is not known.
    pub fn is_certain(self) -> bool {
        !matches!(self, Self::Known(_, Known::Unsolved | Known::BeyondLaw))
    }
}

/// What keeps a limit over a range of static stresses, from one height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinnest {
    /// Height of the drop \[m\].
    pub height: f64,
    /// The least thickness \[m\] that keeps the limit over the whole range, and the drop of the largest peak there, the
    /// error of which is within the limit as well; or why none of those that were looked at does.
    pub over_all: Result<(f64, CushionPoint), Unmet>,
    /// Whether the thinnest thickness that was asked for already keeps it: a thinner one may as well.
    pub is_first: bool,
    /// Whether a drop onto a thinner one could not be evaluated, so that it may keep it as well.
    pub is_open: bool,
    /// The least volume for a weight, `t/σ` \[m³/N\], with its thickness \[m\] and stress \[Pa\] within the range, to a
    /// thousandth, where any keeps the limit.
    pub lightest: Option<[f64; 3]>,
    /// How sure it is, where there is scatter and a thickness keeps the limit.
    pub sure: Option<Sure>,
}

/// What is asked for.
pub(super) struct Question<'q> {
    pub(super) tests: &'q Tests<'q>,
    pub(super) limit: f64,
    pub(super) over: [f64; 2],
}

/// A thickness that keeps the limit, and whether it is the first one that was looked at.
#[derive(Debug, Clone, Copy)]
struct Kept {
    thickness: f64,
    is_first: bool,
    is_open: bool,
}

impl Question<'_> {
    /// The answer for one height. Thicker cushions than one that will do are taken to do as well if those that were
    /// looked at do.
    pub(super) fn answer(&self, height: f64) -> Thinnest {
        let of = Drops { question: self, height };
        let found = of.over_range();
        let (first, last) = of.ends();
        let thickest = found.as_ref().map_or(last, |own| own.0.thickness);
        let volume = |stress: f64, nearest: f64| {
            let own = of.least(&[first, thickest], &[stress], nearest).ok()?;
            Some([own.thickness / stress, own.thickness, stress])
        };
        let stresses: Vec<f64> = self.stresses().collect();
        let least = least_within(&stresses, |stress| {
            volume(stress, ROUGHLY).map_or(f64::INFINITY, |own| own[0])
        });
        let own = least.filter_map(|stress| volume(stress, NEAREST));
        let lightest = own.min_by(|one, other| one[0].total_cmp(&other[0]));
        let is_first = found.as_ref().is_ok_and(|own| own.0.is_first);
        let is_open = found.as_ref().is_ok_and(|own| own.0.is_open);
        let over_all = found.map(|own| (own.0.thickness, own.1));
        Thinnest { height, over_all, is_first, is_open, lightest, sure: None }
    }

    fn stresses(&self) -> impl Iterator<Item = f64> {
        within(self.over)
    }
}

/// Where a value is least: at the least one of several stresses, and between those beside it.
fn least_within(stresses: &[f64], value: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
    let values: Vec<f64> = stresses.iter().map(|own| value(*own)).collect();
    let all = values.iter().enumerate();
    let at = all.min_by(|one, other| one.1.total_cmp(other.1)).map_or(0, |own| own.0);
    let beside =
        at.checked_sub(1).and_then(|before| stresses.get(before)).zip(stresses.get(at + 1));
    let between = beside
        .map(|(low, high)| maximum(low.ln(), high.ln(), STEPS, |own| -value(own.exp())).0.exp());
    [Some(stresses[at]), between].into_iter().flatten()
}

/// The stresses of a range at which a limit has to be kept.
pub(super) fn within(over: [f64; 2]) -> impl Iterator<Item = f64> {
    ratios(over, STRESSES)
}

/// The drops from one height.
struct Drops<'q> {
    question: &'q Question<'q>,
    height: f64,
}

impl Drops<'_> {
    fn ends(&self) -> (f64, f64) {
        let all = &self.question.tests.asked.thicknesses;
        (all[0], all[all.len() - 1])
    }

    fn rough(&self, thickness: f64, stress: f64) -> CushionPoint {
        self.question.tests.rough(self.height, thickness, stress)
    }

    fn excess(&self, own: &CushionPoint) -> f64 {
        own.excess(self.question.limit)
    }

    /// The drop that exceeds the limit the most, or the least far below.
    fn worst(&self, drops: impl Iterator<Item = CushionPoint>) -> Option<CushionPoint> {
        drops.max_by(|one, other| self.excess(one).total_cmp(&self.excess(other)))
    }

    /// The least thickness for the whole range, and the worst drop there: that of its ends, and of all stresses within
    /// that turn out to be worse.
    fn over_range(&self) -> Result<(Kept, CushionPoint), Unmet> {
        let mut stresses = self.question.over.to_vec();
        stresses.dedup();
        loop {
            let kept = self.least(&self.question.tests.asked.thicknesses, &stresses, NEAREST)?;
            let all = || self.question.stresses().map(|own| self.rough(kept.thickness, own));
            let worst = self.worst(all()).filter(|own| self.excess(own) > 0.0);
            match worst {
                Some(own) if !stresses.contains(&own.stress) => stresses.push(own.stress),
                _ => {
                    let drop =
                        |own: &f64| self.question.tests.drop(self.height, kept.thickness, *own);
                    let worst = self.worst(stresses.iter().map(drop));
                    let none = Unmet::Known(stresses[0], Known::Unsolved);
                    return worst.map(|own| (kept, own)).ok_or(none);
                }
            }
        }
    }

    /// The least thickness that keeps the limit at these stresses, where errors are counted.
    fn least(&self, thicknesses: &[f64], stresses: &[f64], nearest: f64) -> Result<Kept, Unmet> {
        let at =
            |thickness: f64| self.worst(stresses.iter().map(|own| self.rough(thickness, *own)));
        let excess = |thickness: f64| at(thickness).map_or(f64::INFINITY, |own| self.excess(&own));
        let mut last: Option<(f64, f64)> = None;
        for &thickness in thicknesses.iter().rev() {
            let own = (thickness, excess(thickness));
            let Some(with) = last.filter(|_| own.1 > 0.0) else {
                if own.1 > 0.0 {
                    return Err(unmet(at(thickness), stresses[0]));
                }
                last = Some(own);
                continue;
            };
            let nearest = nearest * thicknesses[thicknesses.len() - 1];
            let [kept, beyond] = edge(with, own, nearest, excess);
            let is_unsolved = |own: &f64| self.rough(beyond.0, *own).known == Known::Unsolved;
            let is_open = stresses.iter().any(is_unsolved);
            let held = |thickness: f64| {
                let drop = |own: &f64| self.question.tests.drop(self.height, thickness, *own);
                stresses.iter().map(drop).all(|own| self.excess(&own) <= 0.0)
            };
            let thickness = surely(kept.0, with.0, nearest, held);
            return Ok(Kept { thickness, is_first: false, is_open });
        }
        let first = last.map(|own| Kept { thickness: own.0, is_first: true, is_open: false });
        first.ok_or_else(|| unmet(None, stresses[0]))
    }
}

/// Why a worst drop will not do.
fn unmet(worst: Option<CushionPoint>, stress: f64) -> Unmet {
    match worst {
        Some(own) if own.is_usable() => Unmet::Peak(own.peak, own.stress),
        Some(own) => Unmet::Known(own.stress, own.known),
        None => Unmet::Known(stress, Known::Unsolved),
    }
}
