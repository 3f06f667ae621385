//! What scatter of a scene's numbers makes of cushion curves: bands, and how sure the thinnest cushion is.
//!
//! Each design of a sample is dropped from all heights at all stresses. These are those of a platen and an area without
//! scatter: where the mass, the height of the drop or the area of the scene scatters, a design has another one in the
//! same proportion at every point of the curves.

use dashpot_analysis::{
    Band, Odds,
    sweep::{Estimates, Grid, ScenePoint, SweepError, SweepOptions, Watch},
};
use serde::Serialize;

use super::{
    Asked, Cushion, NoCushion, PoseOfThickness, Work,
    curves::{Tests, is_beyond},
    edge::edge,
    thinnest::{ROUGHLY, within},
};
use crate::{optimum::Scattered, shared::exceeded};

/// How sure it is that the thinnest cushion keeps its limit over the range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sure {
    /// Designs of that thickness that keep it, and that exceed it.
    pub odds: Odds,
    /// The part of the designs that is wanted.
    pub share: f64,
    /// The least thickness \[m\] of which so many keep it; `None` where none does that was looked at.
    pub thickness: Option<f64>,
}

/// Adds to curves what a sample of scattered designs makes of them: the test of [`Scattered::pose`] is 0, its one number
/// is the thickness \[m\].
///
/// # Errors
///
/// [`NoCushion`] where a design cannot be posed, or nothing could be solved.
pub fn with_scatter(
    cushion: &mut Cushion,
    asked: &Asked,
    pose: &PoseOfThickness<'_>,
    scattered: Scattered<'_>,
    watch: &mut Watch<'_>,
) -> Result<(), NoCushion> {
    let platen = cushion.platen.clone();
    let tests = Tests::new(&platen, asked, pose)?;
    let mut sampling = Sampling { tests: &tests, scattered, watch, work: &mut cushion.work };
    for &thickness in &asked.thicknesses {
        let is_it = |own: f64| own.to_bits() == thickness.to_bits();
        let mut curves: Vec<_> =
            cushion.curves.iter_mut().filter(|own| is_it(own.thickness)).collect();
        let points = curves.first().map_or(&[][..], |own| &own.points);
        let bests = curves.iter().filter_map(|own| Some(own.best?.point.stress));
        let stresses: Vec<f64> = points.iter().map(|own| own.stress).chain(bests).collect();
        let heights: Vec<f64> = curves.iter().map(|own| own.height).collect();
        let drops = sampling.drops(thickness, &heights, &stresses)?;
        for (height, curve) in curves.iter_mut().enumerate() {
            let band = |stress: f64| {
                let at = stresses.iter().position(|own| own.to_bits() == stress.to_bits())?;
                Some(Band::of(&tests.peak_key(), "m/s^2", drops.peaks(height, at)))
            };
            curve.bands = curve.points.iter().filter_map(|own| band(own.stress)).collect();
            curve.best_band = curve.best.and_then(|own| band(own.point.stress));
        }
    }
    let Some((limit, over)) = asked.limit.zip(asked.over) else { return Ok(()) };
    for thinnest in &mut cushion.thinnest {
        let Ok((thickness, _)) = thinnest.over_all else { continue };
        thinnest.sure = Some(sampling.sure((thinnest.height, thickness), (limit, over))?);
    }
    Ok(())
}

/// Drops of scattered designs.
struct Sampling<'s, 't, 'w> {
    tests: &'s Tests<'t>,
    scattered: Scattered<'s>,
    watch: &'s mut Watch<'w>,
    work: &'s mut Work,
}

/// The peaks of a sample \[m/s²\], design by design, the heights of each, the stresses of each; not a number where a drop
/// goes beyond what is known of the cushion, or could not be solved.
struct Peaks {
    all: Vec<f64>,
    heights: usize,
    stresses: usize,
}

impl Peaks {
    /// Those of all designs from one of the heights at one of the stresses.
    fn peaks(&self, height: usize, stress: usize) -> impl Iterator<Item = f64> {
        let designs = self.all.chunks(self.heights * self.stresses);
        designs.map(move |own| own[height * self.stresses + stress])
    }

    /// By how much each design exceeds a limit at most \[m/s²\]; infinite where that is not known.
    fn excesses(&self, limit: f64) -> Vec<f64> {
        let excess = |peak: &f64| if peak.is_nan() { f64::INFINITY } else { peak - limit };
        let designs = self.all.chunks(self.heights * self.stresses);
        designs.map(|own| own.iter().map(excess).fold(f64::NEG_INFINITY, f64::max)).collect()
    }

    /// How many designs keep a limit, and exceed it at a stress where they are known.
    fn odds(&self, limit: f64) -> Odds {
        let designs = self.all.chunks(self.heights * self.stresses);
        let exceeds = |own: &&[f64]| own.iter().any(|peak| *peak > limit);
        let keeps = |own: &&[f64]| own.iter().all(|peak| *peak <= limit);
        Odds {
            kept: designs.clone().filter(keeps).count(),
            exceeded: designs.clone().filter(exceeds).count(),
            designs: designs.len(),
        }
    }
}

impl Sampling<'_, '_, '_> {
    /// All designs of a thickness, dropped from these heights at these stresses.
    fn drops(
        &mut self,
        thickness: f64,
        heights: &[f64],
        stresses: &[f64],
    ) -> Result<Peaks, NoCushion> {
        let tests = self.tests;
        let designs = (self.scattered.pose)(0, &[thickness]).map_err(NoCushion::NotPosed)?;
        let grid = Grid::new(vec![designs.len(), heights.len(), stresses.len()]);
        let grid = grid.ok_or(SweepError::NoPoints)?;
        let gone = || format!("there is no `{}` in every design", tests.platen.body);
        let pose = |places: &[usize]| -> Result<ScenePoint, String> {
            let [design, height, stress] = *places else { return Err("three axes".to_owned()) };
            let scene = designs[design].clone();
            let [mass, fall] = tests.platen.factors(&scene.network).ok_or_else(gone)?;
            tests.dropped(scene, fall * heights[height], mass * stresses[stress])
        };
        let options = SweepOptions { threads: tests.asked.threads, estimates: Estimates::Off };
        let report = tests.swept(&grid, &pose, options, self.watch)?;
        self.work.scattered += grid.len();
        self.work.scattered_instantiated += report.instantiated;
        let peak = Tests::column(&report, &tests.peak_key());
        let known = |at: usize| {
            if is_beyond(&report, at) { f64::NAN } else { peak(&report.values, at) }
        };
        let all = (0..grid.len()).map(known).collect();
        Ok(Peaks { all, heights: heights.len(), stresses: stresses.len() })
    }

    /// How sure the thinnest cushion for a height is, and which one is sure enough.
    fn sure(
        &mut self,
        (height, thinnest): (f64, f64),
        (limit, over): (f64, [f64; 2]),
    ) -> Result<Sure, NoCushion> {
        let (tests, share) = (self.tests, self.scattered.probability);
        let stresses: Vec<f64> = within(over).collect();
        let first = self.drops(thinnest, &[height], &stresses)?;
        let odds = first.odds(limit);
        let mut before = (thinnest, exceeded(first.excesses(limit), share));
        let mut own = Sure { odds, share, thickness: None };
        if before.1 <= 0.0 {
            own.thickness = Some(thinnest);
            return Ok(own);
        }
        let mut fault = None;
        let mut excess = |thickness: f64| match self.drops(thickness, &[height], &stresses) {
            Ok(drops) => exceeded(drops.excesses(limit), share),
            Err(reason) => {
                fault = Some(reason);
                f64::INFINITY
            }
        };
        let thicker = &tests.asked.thicknesses;
        let nearest = ROUGHLY * thicker.iter().copied().fold(thinnest, f64::max);
        for &thickness in thicker.iter().filter(|own| **own > thinnest) {
            let here = (thickness, excess(thickness));
            if here.1 <= 0.0 {
                own.thickness = Some(edge(here, before, nearest, &mut excess)[0].0);
                break;
            }
            before = here;
        }
        fault.map_or(Ok(own), Err)
    }
}
