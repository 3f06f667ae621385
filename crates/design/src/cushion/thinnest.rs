//! The thinnest cushion that keeps a limit over a range of static stresses, and the lightest.

use super::curves::{Curve, Tests};

/// Halvings between two thicknesses of which one keeps the limit.
const HALVINGS: usize = 24;
/// Stresses of the range at which it has to be kept, at equal ratios.
const STRESSES: u16 = 13;

/// Why no cushion that was looked at will do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unmet {
    /// The thickest one has this peak \[m/s²\] at this stress \[Pa\].
    Peak(f64, f64),
    /// What is known of the thickest one ends below this stress \[Pa\].
    Known(f64),
}

/// What keeps a limit over a range of static stresses, from one height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinnest {
    /// Height of the drop \[m\].
    pub height: f64,
    /// The least thickness \[m\] that keeps the limit over the whole range, the largest peak there \[m/s²\], and its
    /// stress \[Pa\]; or why none of those that were looked at does.
    pub over_all: Result<[f64; 3], Unmet>,
    /// Whether the thinnest thickness that was asked for already keeps it: a thinner one may as well.
    pub is_first: bool,
    /// The least volume for a weight, `t/σ` \[m³/N\], with its thickness \[m\] and stress \[Pa\] within the range, where
    /// any keeps the limit.
    pub lightest: Option<[f64; 3]>,
}

/// What is asked for.
pub(super) struct Question<'q> {
    pub(super) tests: &'q Tests<'q>,
    pub(super) limit: f64,
    pub(super) over: [f64; 2],
}

impl Question<'_> {
    /// The answer for one height. Thicker cushions than one that will do are taken to do as well if those that were
    /// looked at do.
    pub(super) fn answer(&self, height: f64, curves: &[Curve]) -> Thinnest {
        let thicknesses = &self.tests.asked.thicknesses;
        debug_assert!(curves.len().is_multiple_of(thicknesses.len()));
        let over_all = self.least(thicknesses, |thickness| self.over_range(height, thickness));
        let lightest = self.stresses().filter_map(|stress| {
            let one = |thickness: f64| self.at(height, thickness, stress);
            let [thickness, ..] = self.least(thicknesses, one).ok()?.0;
            Some([thickness / stress, thickness, stress])
        });
        let lightest = lightest.min_by(|one, other| one[0].total_cmp(&other[0]));
        let is_first = over_all.as_ref().is_ok_and(|own| own.1);
        Thinnest { height, over_all: over_all.map(|own| own.0), is_first, lightest }
    }

    /// The least thickness for which something is kept, and whether that is the first one.
    fn least(
        &self,
        thicknesses: &[f64],
        kept: impl Fn(f64) -> Result<[f64; 2], Unmet>,
    ) -> Result<([f64; 3], bool), Unmet> {
        let mut last = None;
        for (at, &thickness) in thicknesses.iter().enumerate().rev() {
            match (kept(thickness), last) {
                (Ok(own), _) => last = Some((at, thickness, own)),
                (Err(why), None) => return Err(why),
                (Err(_), Some((_, with, mut own))) => {
                    let (mut with, mut without) = (with, thickness);
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (with + without);
                        match kept(middle) {
                            Ok(found) => (with, own) = (middle, found),
                            Err(_) => without = middle,
                        }
                    }
                    return Ok(([with, own[0], own[1]], false));
                }
            }
        }
        last.map(|own| ([own.1, own.2[0], own.2[1]], true)).ok_or(Unmet::Known(self.over[0]))
    }

    fn stresses(&self) -> impl Iterator<Item = f64> {
        let [low, high] = self.over;
        let last = f64::from(STRESSES - 1);
        (0..STRESSES).map(move |at| low * (high / low).powf(f64::from(at) / last))
    }

    /// The largest peak over the range and its stress, if the limit is kept.
    fn over_range(&self, height: f64, thickness: f64) -> Result<[f64; 2], Unmet> {
        let mut worst = [f64::NEG_INFINITY, f64::NAN];
        for stress in self.stresses() {
            let own = self.at(height, thickness, stress)?;
            if own[0] > worst[0] {
                worst = own;
            }
        }
        Ok(worst)
    }

    fn at(&self, height: f64, thickness: f64, stress: f64) -> Result<[f64; 2], Unmet> {
        let own = self.tests.rough(height, thickness, stress);
        if own.keeps(self.limit) {
            Ok([own.peak, stress])
        } else if own.is_usable() {
            Err(Unmet::Peak(own.peak, stress))
        } else {
            Err(Unmet::Known(stress))
        }
    }
}
