//! DOP853, an explicit Runge–Kutta method of order 8 with dense output: its step, and how long the next one may be.
//!
//! Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer 1993, section II.10.

mod tableau;

#[cfg(test)]
mod tests;

use tableau::{DENSE, END, FIFTH, FURTHER, LAST, Row, STAGES, Stage, THIRD};

/// Degree of the dense output.
pub const DEGREE: usize = 7;
/// Part of the step that the estimate of its error allows which is taken.
const SAFETY: f64 = 0.9;
/// What a step may be longer and shorter by than the one before.
pub const GROWTH: (f64, f64) = (1.0 / 3.0, 6.0);
/// Part of a step whose error is not known that is tried next.
const RETREAT: f64 = 0.25;
/// Roundings by which unknowns must differ to tell of a rate.
const TOLD: f64 = 1e4;

/// What writes the slopes at a place of a step, in parts of it, where the unknowns are these.
pub trait Slopes<V, E>: FnMut(f64, &V, &mut V) -> Result<(), E> {}

impl<V, E, F: FnMut(f64, &V, &mut V) -> Result<(), E>> Slopes<V, E> for F {}

/// One step of `ż = f(z)`, of unknowns on the stack, `[f64; N]`, or on the heap. Where slopes cannot be told, it has to be attempted
/// anew. Only [`Step::new`] allocates.
///
/// ```
/// use std::convert::Infallible;
///
/// use dashpot_numerics::dop853::Step;
///
/// let mut turn = |_: f64, z: &[f64; 2], slopes: &mut [f64; 2]| {
///     *slopes = [z[1], -z[0]];
///     Ok::<(), Infallible>(())
/// };
/// let mut step = Step::new([1.0, 0.0]);
/// step.begin(&mut turn)?;
/// step.attempt(0.1, &mut turn)?;
/// // Local errors go with the ninth power of the step, those of the polynomial with the eighth.
/// assert!((step.end()[0] - 0.1_f64.cos()).abs() < 1e-9);
/// step.close(&mut turn)?;
/// step.fit(&mut turn)?;
/// let mut half = [0.0; 2];
/// step.look(0.5, &mut half);
/// assert!((half[0] - 0.05_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Infallible>(())
/// ```
#[derive(Debug, Clone)]
pub struct Step<V> {
    length: f64,
    start: V,
    /// The unknowns at the last stage whose slopes were asked for.
    stage: V,
    end: V,
    /// The slopes of all stages; the last three for the dense output alone.
    slopes: [V; LAST + 1 + FURTHER.len()],
    dense: [V; DEGREE + 1],
}

#[expect(clippy::missing_errors_doc, reason = "the errors are those of the slopes")]
impl<V: AsRef<[f64]> + AsMut<[f64]> + Clone> Step<V> {
    /// A step from `start`, of no length and without slopes yet.
    pub fn new(start: V) -> Self {
        let mut none = start.clone();
        none.as_mut().fill(0.0);
        let none = || none.clone();
        Self {
            length: 0.0,
            stage: none(),
            end: start.clone(),
            slopes: std::array::from_fn(|_| none()),
            dense: std::array::from_fn(|_| none()),
            start,
        }
    }

    /// Where it ends.
    pub fn end(&self) -> &V {
        &self.end
    }

    /// The slopes at its start, at its stages and, once it is [closed](Self::close), at its end.
    pub fn slopes(&self) -> &[V] {
        &self.slopes[..=LAST]
    }

    /// Finds the slopes at its start.
    pub fn begin<E>(&mut self, f: &mut impl Slopes<V, E>) -> Result<(), E> {
        f(0.0, &self.start, &mut self.slopes[0])
    }

    /// Takes it over this length.
    pub fn attempt<E>(&mut self, length: f64, f: &mut impl Slopes<V, E>) -> Result<(), E> {
        self.length = length;
        self.stages(1, &STAGES, f)?;
        reach(&self.start, length, (&self.slopes, END), &mut self.end);
        Ok(())
    }

    /// The estimate of its error, counted `times` times, where each unknown is counted in the unit that `unit` gives of its number
    /// and its larger magnitude at both ends; those without a unit do not count.
    pub fn error(&mut self, times: f64, unit: impl Fn(usize, f64) -> f64) -> f64 {
        let (mut fifth, mut third, mut count) = (0.0, 0.0, 0.0);
        // Of the dense output there is none yet.
        for (own, row) in self.dense.iter_mut().zip([FIFTH, END, THIRD]) {
            sum((&self.slopes, row), own);
        }
        for at in 0..self.start.as_ref().len() {
            let unit = unit(at, self.start.as_ref()[at].abs().max(self.end.as_ref()[at].abs()));
            if unit > 0.0 {
                let [of_fifth, by_end, of_third, ..] =
                    &self.dense.each_ref().map(|own| own.as_ref()[at]);
                fifth += (of_fifth / unit).powi(2);
                third += ((by_end - of_third) / unit).powi(2);
                count += 1.0;
            }
        }
        let both = fifth + 0.01 * third;
        if both > 0.0 { times * self.length.abs() * fifth / (both * count).sqrt() } else { both }
    }

    /// Finds the slopes at its end.
    pub fn close<E>(&mut self, f: &mut impl Slopes<V, E>) -> Result<(), E> {
        f(1.0, &self.end, &mut self.slopes[LAST])
    }

    /// The fastest rate that it shows: by how much the slopes of the two stages at its end differ beside the unknowns there; none
    /// where these differ by no more than some roundings. Its end must be [closed](Self::close), and no dense output made yet.
    pub fn rate(&self) -> f64 {
        let (mut slopes, mut unknowns, mut sizes) = (0.0, 0.0, 0.0);
        for at in 0..self.end.as_ref().len() {
            let [end, stage] = [&self.end, &self.stage].map(|own| own.as_ref()[at]);
            let [last, before] = [LAST, LAST - 1].map(|stage| self.slopes[stage].as_ref()[at]);
            slopes += (last - before).powi(2);
            unknowns += (end - stage).powi(2);
            sizes += end.powi(2);
        }
        let rounding = TOLD * f64::EPSILON;
        if unknowns > rounding * rounding * sizes { (slopes / unknowns).sqrt() } else { 0.0 }
    }

    /// Makes its dense output; its end must be [closed](Self::close).
    pub fn fit<E>(&mut self, f: &mut impl Slopes<V, E>) -> Result<(), E> {
        self.stages(LAST + 1, &FURTHER, f)?;
        for at in 0..self.start.as_ref().len() {
            let [start, end] = [&self.start, &self.end].map(|own| own.as_ref()[at]);
            let [first, last] = [0, LAST].map(|stage| self.slopes[stage].as_ref()[at]);
            let change = end - start;
            let bend = self.length * first - change;
            let known = [start, change, bend, change - self.length * last - bend];
            self.dense.iter_mut().zip(known).for_each(|(own, known)| own.as_mut()[at] = known);
        }
        for (own, row) in self.dense[DEGREE + 1 - DENSE.len()..].iter_mut().zip(DENSE) {
            sum((&self.slopes, row), own);
            own.as_mut().iter_mut().for_each(|own| *own *= self.length);
        }
        Ok(())
    }

    /// The unknowns at the part `x` of it, by its dense output.
    pub fn look(&self, x: f64, values: &mut V) {
        let values = values.as_mut();
        values.fill(0.0);
        for (order, own) in self.dense.iter().enumerate().rev() {
            let factor = if order % 2 == 0 { x } else { 1.0 - x };
            let both = values.iter_mut().zip(own.as_ref());
            both.for_each(|(value, own)| *value = own + factor * *value);
        }
    }

    /// Begins the next one at its end, which must be [closed](Self::close).
    pub fn go_on(&mut self) {
        std::mem::swap(&mut self.start, &mut self.end);
        self.slopes.swap(0, LAST);
    }

    /// The slopes of some stages, of which the first one has this number.
    fn stages<E>(
        &mut self,
        first: usize,
        stages: &[Stage],
        f: &mut impl Slopes<V, E>,
    ) -> Result<(), E> {
        for (at, stage) in stages.iter().enumerate() {
            reach(&self.start, self.length, (&self.slopes, stage.slopes), &mut self.stage);
            f(stage.time, &self.stage, &mut self.slopes[first + at])?;
        }
        Ok(())
    }
}

/// The unknowns where a sum of slopes leads over this length.
fn reach<V: AsRef<[f64]> + AsMut<[f64]>>(start: &V, length: f64, row: (&[V], Row), stage: &mut V) {
    sum(row, stage);
    let values = stage.as_mut().iter_mut().zip(start.as_ref());
    values.for_each(|(own, start)| *own = start + length * *own);
}

fn sum<V: AsRef<[f64]> + AsMut<[f64]>>((slopes, row): (&[V], Row), sum: &mut V) {
    let sum = sum.as_mut();
    sum.fill(0.0);
    for &(stage, factor) in row {
        sum.iter_mut().zip(slopes[stage].as_ref()).for_each(|(own, slope)| *own += factor * slope);
    }
}

/// How long steps are, from one to the next.
#[derive(Debug, Default)]
pub struct Controller {
    is_after_rejection: bool,
}

impl Controller {
    /// By what the next step is longer than one of this error, in parts of what it may be, which is rejected where that is more
    /// than 1 or not known. None is longer than one that was just rejected.
    pub fn factor(&mut self, error: f64) -> f64 {
        let (least, most) = GROWTH;
        let own = if error.is_finite() { allowed(1.0, error).clamp(least, most) } else { RETREAT };
        let is_rejected = error.is_nan() || error > 1.0;
        let most = if is_rejected {
            SAFETY
        } else if self.is_after_rejection {
            1.0
        } else {
            most
        };
        self.is_after_rejection = is_rejected;
        own.min(most)
    }
}

/// How long a step of this length and error might be, as far as errors go with the power of the order.
pub fn allowed(length: f64, error: f64) -> f64 {
    SAFETY * length * error.powf(-0.125)
}
