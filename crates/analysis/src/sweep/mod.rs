//! Families of scenes: measures over a grid of parameters.
//!
//! A sweep is given its scenes by a closure, which poses the scene at any point of a [`Grid`]. Scenes
//! of springs, dashpots and masses that one impactor strikes are *stamped*: the form is compiled once,
//! their numbers are read along the axes of the grid only, and every point is solved from them by the
//! powers of one small matrix exponential, without allocating anything. What is reported that way is
//! compared with full runs at points spread over the grid. All other scenes, and points whose impact
//! is not of the plain kind or not certain to six digits, are solved in full.
//!
//! Points are shared among threads; the result is the same to the bit whatever their number.

mod bracket;
mod crew;
mod error;
mod full;
mod grid;
mod march;
mod stamped;
mod sums;
mod table;

#[cfg(test)]
mod tests;

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot_network::{Detail, Network};

pub use self::{crew::Watch, error::SweepError, grid::Grid};
use self::{crew::share, full::Full, stamped::Plan};
use crate::{
    MeasureWish, RunError, SolveSettings,
    measures::{Family, Measure, MeasureKind, MeasureVisitor, PeakDeformation, visit_measures},
    partial::{Cost, Neglected, PutBack, decide, spread},
    selection::{Selected, select},
};

/// At most so many points are solved both ways.
const MOST_CHECKED: usize = 4;
/// The corners of a grid are looked at up to so many parameters.
const MOST_CORNERED: usize = 6;
/// Stamped values may differ from full ones by this part of themselves, besides the errors of both.
const AGREEMENT: f64 = 1e-9;

/// A scene at a point.
#[derive(Debug, Clone)]
pub struct Posed {
    /// Nodes, elements, loads and effects.
    pub network: Network,
    /// What is asked of its run.
    pub settings: SolveSettings,
}

/// Poses the scene where each parameter takes the value at this position, or says why there is none.
pub type Pose<'p> = dyn Fn(&[usize]) -> Result<Posed, String> + Sync + 'p;

/// What a sweep reports of each point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Key of the measure, for instance `padding.peak-force`.
    pub key: String,
    /// SI unit of the values.
    pub unit: &'static str,
    /// Whether the values are parts of the thickness of the element: of a peak deformation that is the
    /// `ξmax` of the thesis, which is 1 where the padding is pressed to nothing.
    pub is_share: bool,
}

/// A value that does not exist, or a point that could not be solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Gap {
    /// The point.
    pub point: usize,
    /// The column; `None` where the whole point could not be solved.
    pub column: Option<usize>,
    /// Why.
    pub reason: String,
}

/// What a sweep yields.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepReport {
    /// What is reported of each point.
    pub columns: Vec<Column>,
    /// One value for each column of each point, in the order of the grid; NaN where there is none.
    pub values: Vec<f64>,
    /// The errors of those; NaN where there is no value, or its error is not known.
    pub errors: Vec<f64>,
    /// Why values are missing, in the order of the points.
    pub gaps: Vec<Gap>,
    /// How many points were stamped; all others were solved in full.
    pub stamped: usize,
    /// The stamped points that were solved in full as well.
    pub checked: Vec<usize>,
    /// The largest difference there, in parts of the value.
    pub largest_difference: f64,
    /// What was left out, where the scene allows that.
    pub partial: Option<PartialOfSweep>,
    /// Wall-clock time.
    pub wall: Duration,
}

/// What was left out of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct PartialOfSweep {
    /// The bound: the part of its size by which a measure may move.
    pub bound: f64,
    /// What was left out of all points, the largest influence at the first point first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// The points that were solved with and without it, rising.
    pub checked: Vec<usize>,
    /// The measure that moves the most at any of those.
    pub worst: Option<Cost>,
    /// Solutions that finding this out took.
    pub solves: usize,
    /// Wall-clock time of the whole sweep in full, from the mean of the points that were solved in
    /// full, by one thread.
    pub wall_in_full: Duration,
}

impl SweepReport {
    /// The values of a column, in the order of the grid.
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().skip(column).step_by(self.columns.len().max(1)).copied()
    }
}

/// The measure of this word with its parameters as they are by default.
pub fn measure_named(word: &str) -> Option<Arc<dyn Measure>> {
    struct Find<'w>(&'w str, Option<Arc<dyn Measure>>);
    impl MeasureVisitor for Find<'_> {
        fn visit<M: MeasureKind>(&mut self) {
            if M::KIND == self.0 {
                self.1 = Some(Arc::new(M::default()));
            }
        }
    }
    let mut find = Find(word, None);
    visit_measures(&mut find);
    find.1
}

/// The columns of these measures in a scene, and what the scene is to be asked for: all that it reports
/// where none is named. Behind them stands, for each element with a thickness that they are about, or
/// that is at a node that they are about, its peak deformation as a share of that.
///
/// # Errors
///
/// A measure that the scene does not have, and faults of the scene.
pub fn columns(
    scene: &Posed,
    keys: &[String],
) -> Result<(Vec<Column>, Vec<MeasureWish>), SweepError> {
    let assembly = scene.network.compile(scene.settings.duration).map_err(RunError::from)?;
    let mut wishes = scene.settings.measures.clone();
    let reported = select(&assembly, &wishes)?;
    for key in keys.iter().filter(|key| !reported.iter().any(|own| own.key == **key)) {
        let Some(wish) = wish(key) else {
            return Err(SweepError::NoMeasure {
                key: key.clone(),
                known: reported.iter().map(|own| own.key.clone()).collect(),
            });
        };
        wishes.push(wish);
    }
    let selected = select(&assembly, &wishes)?;
    let is_wanted = |own: &&Selected| keys.is_empty() || keys.contains(&own.key);
    let mut columns: Vec<Column> = selected
        .iter()
        .filter(is_wanted)
        .map(|own| Column { key: own.key.clone(), unit: own.measure.unit(), is_share: false })
        .collect();
    if columns.is_empty() {
        return Err(SweepError::NoneReported);
    }
    let is_about = |at: usize| {
        let between = assembly.connections[at].between;
        selected.iter().filter(is_wanted).any(|own| match own.measure.applies_to() {
            Family::Element => own.target == at,
            Family::Node => between.iter().any(|end| end.index() == own.target),
        })
    };
    let elements = (0..assembly.connections.len()).filter(|at| is_about(*at));
    for connection in elements.map(|at| &assembly.connections[at]) {
        let key = format!("{}.{}", connection.name, PeakDeformation::KIND);
        let is_known = columns.iter().any(|own| own.is_share && own.key == key);
        if connection.thickness.is_none() || is_known {
            continue;
        }
        if !selected.iter().any(|own| own.key == key) {
            wishes.push(MeasureWish::new(connection.name.clone(), PeakDeformation::default()));
        }
        columns.push(Column { key, unit: "1", is_share: true });
    }
    Ok((columns, wishes))
}

/// The measure that a key is of, where its word is known.
fn wish(key: &str) -> Option<MeasureWish> {
    let (target, word) = key.rsplit_once('.')?;
    Some(MeasureWish { target: target.to_owned(), measure: measure_named(word)? })
}

/// One point and its place in the result.
struct Row<'r> {
    point: usize,
    values: &'r mut [f64],
    errors: &'r mut [f64],
    gaps: Vec<Gap>,
    is_stamped: bool,
}

/// Solves the scenes of a grid by so many threads.
///
/// Where their accuracy has a bound for what may be left out, that is decided at the corners of the
/// grid and at points spread over it, as in [`partial::sweep`](crate::partial::sweep()), and what
/// remains is solved everywhere. The errors then include the largest move that was found.
///
/// # Errors
///
/// A fault of the scene at the first point, and a sweep that was broken off. Points that fail are
/// [gaps](SweepReport::gaps).
pub fn sweep(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    threads: usize,
    watch: &mut Watch<'_>,
) -> Result<SweepReport, SweepError> {
    let started = Instant::now();
    let first = pose(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let partial = decided(grid, pose, &first)?;
    let details: &[Detail] = partial.as_ref().map_or(&[], |own| &own.1);
    let reduced = |places: &[usize]| {
        let mut posed = pose(places)?;
        if !details.is_empty() {
            posed.network = posed.network.without(details);
        }
        posed.settings.accuracy.neglect_below = None;
        Ok(posed)
    };
    let first = reduced(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let full = Full { grid, pose: &reduced, columns };
    let mut plan = Plan::of(grid, &reduced, &first, columns);
    let (mut checked, mut largest_difference) = (Vec::new(), 0.0);
    if let Some(own) = &plan {
        let found = check(own, &full, threads);
        match found {
            Some((points, difference)) => (checked, largest_difference) = (points, difference),
            None => plan = None,
        }
    }

    let count = grid.len();
    let mut values = vec![f64::NAN; count * columns.len()];
    let mut errors = vec![f64::NAN; count * columns.len()];
    let width = columns.len().max(1);
    let places = values.chunks_mut(width).zip(errors.chunks_mut(width)).enumerate();
    let mut rows: Vec<Row<'_>> = places
        .map(|(point, (values, errors))| Row {
            point,
            values,
            errors,
            gaps: Vec::new(),
            is_stamped: false,
        })
        .collect();
    let tool = || plan.as_ref().and_then(Plan::stamper);
    let is_whole = share(
        &mut rows,
        threads,
        &tool,
        &|stamper, row| {
            let stamper = stamper.as_mut();
            row.is_stamped =
                stamper.is_some_and(|own| own.write(row.point, row.values, row.errors));
            if !row.is_stamped {
                full.write(row.point, row.values, row.errors, &mut row.gaps);
            }
        },
        watch,
    );
    if !is_whole {
        return Err(SweepError::BrokenOff);
    }
    let stamped = rows.iter().filter(|row| row.is_stamped).count();
    let gaps = rows.iter_mut().flat_map(|row| std::mem::take(&mut row.gaps)).collect();
    drop(rows);
    let partial = partial.map(|own| own.0);
    if let Some(worst) = partial.as_ref().and_then(|own| own.worst.as_ref()) {
        let moved = worst.most();
        for (error, value) in errors.iter_mut().zip(&values) {
            *error += moved * value.abs();
        }
    }
    if stamped == 0 {
        (checked, largest_difference) = (Vec::new(), 0.0);
    }
    Ok(SweepReport {
        columns: columns.to_vec(),
        values,
        errors,
        gaps,
        stamped,
        checked,
        largest_difference,
        partial,
        wall: started.elapsed(),
    })
}

/// What may be left out of all points, where the scene at the first one allows that.
fn decided(
    grid: &Grid,
    pose: &Pose<'_>,
    first: &Posed,
) -> Result<Option<(PartialOfSweep, Vec<Detail>)>, SweepError> {
    let Some(bound) = first.settings.accuracy.neglect_below else { return Ok(None) };
    let mut points = spread(grid.len());
    if grid.counts().len() <= MOST_CORNERED {
        points.extend(grid.corners());
    }
    points.sort_unstable();
    points.dedup();
    let posed: Vec<(usize, Network)> = points
        .into_iter()
        .filter_map(|point| Some((point, pose(&grid.places(point)).ok()?.network)))
        .collect();
    let networks: Vec<Network> = posed.iter().map(|own| own.1.clone()).collect();
    let all: Vec<usize> = (0..networks.len()).collect();
    let found = decide(&networks, &all, &first.settings, &mut dashpot_dae::Silent)?;
    let worst = found.worst();
    let report = PartialOfSweep {
        bound,
        checked: found.checked().map(|at| posed[at].0).collect(),
        worst,
        solves: found.solves(),
        wall_in_full: found.wall_in_full(grid.len()),
        left_out: found.left_out(),
        put_back: found.put_back.clone(),
    };
    Ok(Some((report, found.details())))
}

/// Solves points spread over the grid both ways: those that were stamped, and the largest difference
/// in parts of a value. `None` where they do not agree.
fn check(plan: &Plan<'_>, full: &Full<'_>, threads: usize) -> Option<(Vec<usize>, f64)> {
    struct Both {
        point: usize,
        /// Whether it was stamped, and the largest difference; `None` where both do not agree.
        found: Option<(bool, f64)>,
    }
    let all = spread(full.grid.len());
    let wanted = all.len().min(MOST_CHECKED);
    let picked = (0..wanted).map(|at| all[at * (all.len() - 1) / wanted.saturating_sub(1).max(1)]);
    let mut rows: Vec<Both> = picked.map(|point| Both { point, found: None }).collect();
    let both = |stamper: &mut Option<Box<dyn stamped::Stamper + '_>>, row: &mut Both| {
        let count = full.columns.len();
        let (mut values, mut errors) = (vec![0.0; count], vec![0.0; count]);
        let Some(stamper) = stamper else { return };
        let Ok(scene) = (full.pose)(&full.grid.places(row.point)) else {
            row.found = Some((false, 0.0));
            return;
        };
        if !plan.agrees(row.point, &scene) {
            return;
        }
        if !stamper.write(row.point, &mut values, &mut errors) {
            row.found = Some((false, 0.0));
            return;
        }
        let (mut right, mut bars) = (vec![f64::NAN; count], vec![f64::NAN; count]);
        full.write(row.point, &mut right, &mut bars, &mut Vec::new());
        let mut largest = 0.0_f64;
        for at in 0..count {
            let (difference, size) = ((values[at] - right[at]).abs(), right[at].abs());
            let bar = if bars[at].is_finite() { bars[at] } else { 0.0 };
            let room = errors[at] + bar + AGREEMENT * size;
            if difference.is_nan() || difference > room {
                return;
            }
            if difference > 0.0 {
                largest = largest.max(difference / size);
            }
        }
        row.found = Some((true, largest));
    };
    share(&mut rows, threads, &|| plan.stamper(), &both, &mut |_, _| {
        std::ops::ControlFlow::Continue(())
    });
    let mut largest = 0.0_f64;
    let mut checked = Vec::new();
    for row in rows {
        let (is_stamped, difference) = row.found?;
        largest = largest.max(difference);
        if is_stamped {
            checked.push(row.point);
        }
    }
    Some((checked, largest))
}
