//! Curves of drops: all their points in one sweep, and single drops between them.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_analysis::{
    Band, Cause, MeasureReport, Misses, RunReport, Solve, Warning,
    measures::{PeakAcceleration, PeakDeformation},
    sweep::{
        Column, Gap, Grid, Pose, ScenePoint, SweepOptions, SweepReport, Watch, columns, sweep,
    },
};
use dashpot_network::{Detail, Network, effects::Stop, parameters::Kind as _};

use super::{
    Asked, Best, Creep, CushionPoint, Known, NoCushion, Passing, Platen, PoseOfThickness, Repeated,
    Row, Work, point::known, repeated::repeated,
};
use crate::floor::{Judged, TravelOf, floors};

/// A run lasts so many times what the platen takes for the thickness at its first speed.
const PASSAGES: f64 = 10.0;
/// Tolerance of drops whose errors are not estimated.
const RTOL: f64 = 1e-8;

/// The curve of one height and thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Height of the drop \[m\].
    pub height: f64,
    /// Thickness \[m\].
    pub thickness: f64,
    /// What no cushion of this thickness can beat \[m/s²\], for a platen on a fixed support at every stress.
    pub floor: Option<f64>,
    /// Drops of rising static stress.
    pub points: Vec<CushionPoint>,
    /// The stress of the least peak; `None` where no point can be used.
    pub best: Option<Best>,
    /// The stresses that keep the limit; `None` where none does, or there is no limit.
    pub passing: Option<Passing>,
    /// The drops in a row at each point, where they are asked for.
    pub repeated: Vec<Repeated>,
    /// What scatter makes of the peak \[m/s²\] at each point, where there is some; drops that press the cushion beyond
    /// what is known of it have no value.
    pub bands: Vec<Band>,
    /// The same at the best stress.
    pub best_band: Option<Band>,
}

/// Drops of a platen on a cushion.
pub(super) struct Tests<'t> {
    pub(super) platen: &'t Platen,
    pub(super) asked: &'t Asked,
    pose: &'t PoseOfThickness<'t>,
    /// The scenes at the thicknesses that are asked for.
    posed: Vec<ScenePoint>,
    duration: f64,
    columns: Vec<Column>,
    probes: AtomicUsize,
    /// Drops that could not be evaluated: height, thickness and static stress, and why.
    pub(super) missing: Misses,
}

impl<'t> Tests<'t> {
    pub(super) fn new(
        platen: &'t Platen,
        asked: &'t Asked,
        pose: &'t PoseOfThickness<'t>,
    ) -> Result<Self, NoCushion> {
        let posed = asked.thicknesses.iter().map(|own| pose(*own)).collect::<Result<Vec<_>, _>>();
        let posed = posed.map_err(NoCushion::NotPosed)?;
        let thickest = asked.thicknesses.iter().copied().fold(0.0, f64::max);
        let lowest = asked.heights.iter().copied().fold(f64::INFINITY, f64::min);
        let duration = PASSAGES * thickest / platen.speed(lowest);
        let mut own = Self {
            platen,
            asked,
            pose,
            posed,
            duration,
            columns: Vec::new(),
            probes: AtomicUsize::new(0),
            missing: Misses::default(),
        };
        let first = own.scene(asked.heights[0], asked.thicknesses[0], platen.stress());
        let first = first.map_err(NoCushion::NotPosed)?;
        let (all, wishes) = columns(&first, &[own.peak_key(), own.depth_key()])?;
        own.columns = all;
        own.posed.iter_mut().for_each(|scene| scene.settings.measures.clone_from(&wishes));
        Ok(own)
    }

    /// How many single drops were solved.
    pub(super) fn probes(&self) -> usize {
        self.probes.load(Ordering::Relaxed)
    }

    pub(super) fn peak_key(&self) -> String {
        format!("{}.{}", self.platen.body, PeakAcceleration::KIND)
    }

    fn depth_key(&self) -> String {
        format!("{}.{}", self.platen.pad, PeakDeformation::KIND)
    }

    /// The scene of a drop.
    fn scene(&self, height: f64, thickness: f64, stress: f64) -> Result<ScenePoint, String> {
        let is_it = |own: &f64| own.to_bits() == thickness.to_bits();
        let scene = match self.asked.thicknesses.iter().position(is_it) {
            Some(at) => self.posed[at].clone(),
            None => (self.pose)(thickness)?,
        };
        self.dropped(scene, height, stress)
    }

    /// A drop onto the cushion of a scene.
    pub(super) fn dropped(
        &self,
        mut scene: ScenePoint,
        height: f64,
        stress: f64,
    ) -> Result<ScenePoint, String> {
        self.platen.drop_in(&mut scene.network, height, stress)?;
        let settings = &mut scene.settings;
        settings.duration = self.duration;
        settings.is_duration_found = false;
        settings.stops.clear();
        settings.limits.clear();
        settings.accuracy.neglect_below = None;
        if let Some(first) = self.posed.first() {
            settings.measures.clone_from(&first.settings.measures);
        }
        Ok(scene)
    }

    /// All curves over the same static stresses.
    pub(super) fn curves(
        &self,
        stresses: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<(Vec<Curve>, Work), NoCushion> {
        let Asked { heights, thicknesses, threads, .. } = self.asked;
        let grid = Grid::new(vec![heights.len(), thicknesses.len(), stresses.len()]);
        let grid = grid.ok_or(dashpot_analysis::sweep::SweepError::NoPoints)?;
        let pose = |places: &[usize]| match places {
            [height, thickness, stress] => {
                self.scene(heights[*height], thicknesses[*thickness], stresses[*stress])
            }
            _ => Err("three axes".to_owned()),
        };
        let options = SweepOptions { threads: *threads, ..SweepOptions::default() };
        let report = self.swept(&grid, &pose, options, watch)?;
        for gap in report.gaps.iter().filter(|own| !own.is_infinite) {
            let [height, thickness, stress] = grid.places(gap.point)[..] else { continue };
            let place = [heights[height], thicknesses[thickness], stresses[stress]];
            self.missing.note(place.to_vec(), gap.cause.clone());
        }
        let work = Work {
            points: grid.len(),
            instantiated: report.instantiated,
            estimated: report.estimated,
            ..Work::default()
        };
        let mut curves = Vec::with_capacity(heights.len() * thicknesses.len());
        for (at_height, &height) in heights.iter().enumerate() {
            for (at, &thickness) in thicknesses.iter().enumerate() {
                let own =
                    (height, thickness, (at_height * thicknesses.len() + at) * stresses.len());
                curves.push(self.curve(own, stresses, &report));
            }
        }
        Ok((curves, work))
    }

    /// Drops at all points of a grid.
    pub(super) fn swept(
        &self,
        grid: &Grid,
        pose: &Pose<'_>,
        options: SweepOptions,
        watch: &mut Watch<'_>,
    ) -> Result<SweepReport, NoCushion> {
        Ok(sweep(grid, pose, &self.columns, options, watch)?)
    }

    /// The values of the column of a measure.
    pub(super) fn column(report: &SweepReport, key: &str) -> impl Fn(&[f64], usize) -> f64 + use<> {
        let width = report.columns.len();
        let at = report.columns.iter().position(|own| !own.is_share && own.key == key);
        move |all: &[f64], place: usize| at.map_or(f64::NAN, |at| all[place * width + at])
    }

    fn curve(
        &self,
        (height, thickness, first): (f64, f64, usize),
        stresses: &[f64],
        report: &SweepReport,
    ) -> Curve {
        let middle = stresses[stresses.len() / 2];
        let floor = self
            .scene(height, thickness, middle)
            .ok()
            .and_then(|scene| floors(&scene.network, self.duration, &[]).ok());
        let stop = floor.as_ref().filter(|own| own.travel.of == TravelOf::Stop);
        let stop = stop.map(|own| own.travel.length / thickness);
        let column = |key: String| Self::column(report, &key);
        let (peak_of, depth_of) = (column(self.peak_key()), column(self.depth_key()));
        let peak_key = self.peak_key();
        let is_infinite = |place: usize| {
            let of = |gap: &&Gap| gap.point == place && gap.is_infinite;
            let key = |gap: &Gap| gap.column.map(|at| &report.columns[at].key);
            report.gaps.iter().filter(of).any(|gap| key(gap) == Some(&peak_key))
        };
        let point = |(at, &stress): (usize, &f64)| {
            let place = first + at;
            let strain = depth_of(&report.values, place) / thickness;
            let peak = peak_of(&report.values, place);
            let is_beyond = is_beyond(report, place);
            CushionPoint {
                stress,
                peak,
                error: peak_of(&report.errors, place),
                strain,
                known: known((peak, is_infinite(place)), strain, stop, is_beyond),
            }
        };
        Curve {
            height,
            thickness,
            floor: floor.and_then(|own| Some(own.stroke.floor(Judged::PeakAcceleration)?.value)),
            points: stresses.iter().enumerate().map(point).collect(),
            best: None,
            passing: None,
            repeated: Vec::new(),
            bands: Vec::new(),
            best_band: None,
        }
    }

    /// The drops in a row at all points of curves.
    pub(super) fn in_a_row(
        &self,
        row: Row,
        curves: &mut [Curve],
        watch: &mut Watch<'_>,
    ) -> Result<(), NoCushion> {
        let posed =
            |height: f64, thickness: f64, stress: f64| self.scene(height, thickness, stress);
        let of = (self.duration, self.asked.threads);
        repeated(row, self.platen, curves, &posed, of, watch)
    }

    /// The compression under the stresses that matter.
    pub(super) fn creep(&self, curves: &[Curve]) -> Result<Vec<Creep>, NoCushion> {
        if self.asked.creep.is_empty() {
            return Ok(Vec::new());
        }
        let mut best: Vec<f64> =
            curves.iter().filter_map(|own| own.best).map(|own| own.point.stress).collect();
        best.sort_by(f64::total_cmp);
        let mut stresses = match self.asked.over {
            Some(over) => over.to_vec(),
            None => best.first().into_iter().chain(best.last()).copied().collect(),
        };
        stresses.dedup();
        let network = &(self.pose)(self.platen.thickness).map_err(NoCushion::NotPosed)?.network;
        let one = |stress: &f64| Creep::of(network, self.platen, *stress, &self.asked.creep);
        stresses.iter().map(one).collect()
    }

    /// A single drop with its error.
    pub(super) fn drop(&self, height: f64, thickness: f64, stress: f64) -> CushionPoint {
        self.solved((height, thickness, stress), None)
    }

    /// The same without an error, as it is wanted many times in a search.
    pub(super) fn rough(&self, height: f64, thickness: f64, stress: f64) -> CushionPoint {
        self.solved((height, thickness, stress), Some(RTOL))
    }

    fn solved(
        &self,
        (height, thickness, stress): (f64, f64, f64),
        rtol: Option<f64>,
    ) -> CushionPoint {
        self.probes.fetch_add(1, Ordering::Relaxed);
        let unsolved = CushionPoint {
            stress,
            peak: f64::NAN,
            error: f64::NAN,
            strain: f64::NAN,
            known: Known::Unsolved,
        };
        let missed = |cause: Cause| {
            self.missing.note(vec![height, thickness, stress], cause);
            unsolved
        };
        let mut scene = match self.scene(height, thickness, stress) {
            Ok(scene) => scene,
            Err(message) => return missed(Cause::scene(message)),
        };
        if rtol.is_some() {
            (scene.settings.rtol, scene.settings.estimate) = (rtol, false);
        }
        let stops = scene.network.effects().iter().enumerate();
        let stops = stops.filter_map(|(at, own)| Some((at, own.of_kind::<Stop>()?)));
        let stops = stops.filter(|own| own.1.element == self.platen.pad);
        let stops: Vec<(usize, Option<f64>)> = stops.map(|own| (own.0, own.1.at)).collect();
        let gap = stops.iter().map(|own| own.1.unwrap_or(thickness)).reduce(f64::min);
        let read = |network: &Network| -> Result<_, Cause> {
            let run = network.solve_with(&scene.settings)?;
            let is_infinite = run.measure(&self.peak_key()).is_some_and(MeasureReport::is_infinite);
            let (peak, error) =
                if is_infinite { (f64::NAN, f64::NAN) } else { value(&run, &self.peak_key())? };
            let depth = value(&run, &self.depth_key())?;
            let is_beyond = run.warnings.iter().any(Warning::is_beyond_known);
            let strain = depth.0 / thickness;
            let stop = gap.map(|own| own / thickness);
            let known = known((peak, is_infinite), strain, stop, is_beyond);
            let reach = depth.0 + if depth.1.is_finite() { depth.1 } else { 0.0 };
            Ok((CushionPoint { stress, peak, error, strain, known }, reach))
        };
        // A stop that is not met takes no force, and without it the drop is solved in fewer steps.
        let free = gap.and_then(|gap| {
            let details: Vec<Detail> = stops.iter().map(|own| Detail::Effect(own.0)).collect();
            read(&scene.network.without(&details)).ok().filter(|own| own.1 < gap)
        });
        free.map_or_else(|| read(&scene.network), Ok).map_or_else(missed, |own| own.0)
    }
}

/// The value of a measure with its error, which is not a number where it is not known.
fn value(run: &RunReport, key: &str) -> Result<(f64, f64), Cause> {
    let own = run.measure(key);
    let known = own.and_then(|own| Some((own.value?, own.error.unwrap_or(f64::NAN))));
    known.ok_or_else(|| Cause::no_value(key, Some(run)))
}

/// Whether something is pressed further than is known of it at a point.
pub(super) fn is_beyond(report: &SweepReport, place: usize) -> bool {
    let mut all = report.warnings.iter();
    all.any(|own| own.warning.is_beyond_known() && own.points.binary_search(&place).is_ok())
}
