//! Points that are instantiated, one after the other.

use dashpot_network::Instance;

use super::{
    Estimates, Row,
    instantiated::Plan,
    plain::{
        aftermath::is_left,
        bars::{self, TOLERANCES, with_bars},
        stepped::{Course, Stepped},
    },
    report::Notice,
    scene_point::{Figure, ScenePoint},
    table::Besides,
    thinned::Thinned,
};
use crate::report::compression::is_as_thick;

/// A value of a linear scene that is less certain than this part of itself is left to the full solution.
const LOOSEST: f64 = 1e-6;
/// The largest of the ratios at three points that holds for those between, in parts of it.
const BETWEEN: f64 = 3.0;

/// Solves points, one after the other.
pub(super) trait Stamper {
    /// Writes the columns of a point and their errors, and returns what is to be said of it. `None` where
    /// the point has to be solved in full: it is of another form, or its impact is not of the plain kind,
    /// or not certain enough. Nothing is allocated where it is linear.
    fn write(&mut self, point: usize, values: &mut [f64], errors: &mut [f64]) -> Option<Notice>;

    /// Writes the points of a group, each with its notice where it need not be solved in full. At how many of
    /// them errors took further solutions.
    fn group(&mut self, rows: &mut [Row<'_>]) -> usize;
}

/// Solves points of a form that has no more than `N` unknowns and slots.
pub(super) struct Sized<'p, const N: usize> {
    plan: &'p Plan<'p>,
    instance: Instance<N>,
    places: Vec<usize>,
    numbers: Vec<f64>,
}

/// The number of a tolerance among [`TOLERANCES`], and the largest relative error of a solution at the one before, in
/// parts of what it [estimates by itself](Course::relative_error).
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    level: usize,
    ratio: f64,
    /// Whether the one before would do for a point between others.
    coarser_does: bool,
}

/// What the error that steps tell is multiplied by between points where it was so many times that.
fn safe(ratio: f64) -> f64 {
    f64::max(1.0, BETWEEN * ratio)
}

impl<const N: usize> Stamper for Sized<'_, N> {
    fn write(&mut self, point: usize, values: &mut [f64], errors: &mut [f64]) -> Option<Notice> {
        self.pose(point)?;
        if self.plan.parametric.is_linear() {
            return self.carry(values, errors);
        }
        match self.plan.estimates {
            Estimates::Off => self.once((0, f64::NAN), values, errors),
            Estimates::All | Estimates::Some => Some(self.estimated(values, errors)?.0),
        }
    }

    fn group(&mut self, rows: &mut [Row<'_>]) -> usize {
        if self.plan.parametric.is_linear() || self.plan.estimates == Estimates::Off {
            for row in rows {
                row.notice = self.write(row.point, row.values, row.errors);
            }
            return 0;
        }
        self.thin(rows, self.plan.estimates).len()
    }
}

impl<const N: usize> Thinned for Sized<'_, N> {
    type Solved = Known;
    type Known = Known;

    fn solved(&mut self, row: &mut Row<'_>) -> Option<Known> {
        self.pose(row.point)?;
        let (notice, known) = self.estimated(row.values, row.errors)?;
        row.notice = Some(notice);
        Some(known)
    }

    fn agreed(&mut self, solved: [&Known; 3], _: [&Row<'_>; 3]) -> Option<Known> {
        let level = solved.iter().map(|own| own.level).max()?;
        let ratio = solved.iter().map(|own| own.ratio).fold(0.0, f64::max);
        Some(Known { level, ratio, coarser_does: solved.iter().any(|own| own.coarser_does) })
    }

    /// Solves a scene that is not linear once at the last but one tolerance of points about it, where that would do at one of
    /// them, or else at the last, with the error that its own steps tell, or more where it was more at those points.
    fn spared(&mut self, known: &Known, row: &mut Row<'_>) -> Option<()> {
        self.pose(row.point)?;
        let factor = safe(known.ratio);
        let mut levels = known.level.saturating_sub(usize::from(known.coarser_does))..=known.level;
        row.notice = levels.find_map(|level| self.once((level, factor), row.values, row.errors));
        row.notice.map(|_| ())
    }
}

impl<'p, const N: usize> Sized<'p, N> {
    /// Room for the points of a plan.
    pub(super) fn of(plan: &'p Plan<'p>) -> Option<Self> {
        Some(Self {
            plan,
            instance: plan.parametric.instance()?,
            places: vec![0; plan.grid.counts().len()],
            numbers: vec![0.0; plan.table.len()],
        })
    }

    /// Writes the system of a point; `None` where it is of another form.
    fn pose(&mut self, point: usize) -> Option<()> {
        let plan = self.plan;
        plan.grid.locate(point, &mut self.places);
        let is_known = plan.table.write(&self.places, &mut self.numbers)
            && !self.has_thinner_part()
            && plan.parametric.fill(&self.numbers, &mut self.instance);
        is_known.then_some(())
    }
}

impl<const N: usize> Sized<'_, N> {
    /// Solves a linear scene by powers of its exponential.
    fn carry(&self, values: &mut [f64], errors: &mut [f64]) -> Option<Notice> {
        let (plan, instance) = (self.plan, &self.instance);
        let time = plan.parametric.time_scale();
        let scene_point = ScenePoint {
            matrix: &instance.matrix,
            start: &instance.start,
            force: &instance.force,
            deformation: &instance.deformation,
            end: plan.end(&self.numbers),
            opens: plan.parametric.opens(),
        };
        let impact = scene_point.solve(plan.wanted)?;
        let places = plan.shown.iter().zip(&plan.wishes).zip(values).zip(errors);
        for (((shown, wish), value), error) in places {
            let own = plan.figure(*shown, &impact, &self.numbers);
            if own.error.is_nan() || own.error > wish.min(LOOSEST) * shown.size(own.value) {
                return None;
            }
            (*value, *error) = (own.value, own.error);
        }
        if Besides::of(&self.numbers).are_stopped(impact.depth) {
            return None;
        }
        let deepest = (impact.depth, impact.deepest_at * time);
        Some(plan.notice(deepest, impact.release.value * time, &self.numbers))
    }

    /// Solves a scene that is not linear once at a tolerance, with errors so many times what its steps tell.
    fn once(
        &self,
        (level, factor): (usize, f64),
        values: &mut [f64],
        errors: &mut [f64],
    ) -> Option<Notice> {
        let course = self.stepped().follow(self.tolerance(level))?;
        let seen = self.plan.seen(&course, &self.numbers);
        let relative = factor * course.relative_error();
        for ((value, error), [own, unit]) in values.iter_mut().zip(&mut *errors).zip(seen) {
            (*value, *error) = (own, relative * unit);
        }
        let is_known = factor.is_nan() || self.suffice(values, errors);
        let is_finite = values.iter().all(|value| value.is_finite());
        let is_good = is_known && is_finite && self.is_plain(&course, self.tolerance(level));
        is_good.then(|| self.noticed(&course))
    }

    /// Solves a scene that is not linear as often as its errors ask for; what is to be said, and what is known of it.
    fn estimated(&self, values: &mut [f64], errors: &mut [f64]) -> Option<(Notice, Known)> {
        let stepped = self.stepped();
        let tolerances: [f64; TOLERANCES.len()] =
            std::array::from_fn(|level| self.tolerance(level));
        let read = |course: &Course<N>| self.plan.seen(course, &self.numbers);
        let suffice = |values: &[f64], errors: &[f64]| self.suffice(values, errors);
        let found = with_bars(&stepped, &tolerances, &read, &suffice)?;
        if !self.is_plain(&found.course, self.tolerance(found.others)) {
            return None;
        }
        values.copy_from_slice(&found.values);
        errors.copy_from_slice(&found.errors);
        let (before, estimate) = found.before;
        let factor = safe(found.ratio) * estimate;
        let (before, doubts): (Vec<f64>, Vec<f64>) =
            before.iter().map(|[value, unit]| (*value, factor * unit)).unzip();
        let coarser_does = self.suffice(&before, &doubts);
        let known = Known { level: found.others, ratio: found.ratio, coarser_does };
        Some((self.noticed(&found.course), known))
    }

    /// Whether no stop is met, and nothing meets again what has left it, as far as that has to be looked at.
    fn is_plain(&self, course: &Course<N>, rtol: f64) -> bool {
        let Self { plan, instance, numbers, .. } = self;
        let left = plan.end(numbers) - course.release;
        let parts = !plan.is_parting
            || is_left((&plan.parametric, instance), numbers, course, (left, rtol));
        parts && !Besides::of(numbers).are_stopped(self.depth(course))
    }

    fn stepped(&self) -> Stepped<'_, N> {
        Stepped {
            instance: &self.instance,
            unknowns: self.plan.parametric.unknowns(),
            end: self.plan.end(&self.numbers),
        }
    }

    fn tolerance(&self, level: usize) -> f64 {
        bars::tolerance(level, self.plan.strictest())
    }

    fn noticed(&self, course: &Course<N>) -> Notice {
        let time = self.plan.parametric.time_scale();
        let deepest = course.deepest.time * time;
        self.plan.notice((self.depth(course), deepest), course.release * time, &self.numbers)
    }

    fn depth(&self, course: &Course<N>) -> Figure {
        let value = course.deepest.value;
        Figure { value, error: self.plan.strictest() * value }
    }

    fn suffice(&self, values: &[f64], errors: &[f64]) -> bool {
        let plan = self.plan;
        let all = values.iter().zip(errors).zip(plan.shown.iter().zip(&plan.wishes));
        all.map(|((value, error), (shown, wish))| (error, wish * shown.size(*value)))
            .all(|(error, most)| !error.is_nan() && *error <= most)
    }

    /// Whether a part of the pad would have to be watched by itself.
    fn has_thinner_part(&self) -> bool {
        let Besides { thickness, thinnest, .. } = Besides::of(&self.numbers);
        !thinnest.is_nan() && !is_as_thick(thinnest, thickness)
    }
}
