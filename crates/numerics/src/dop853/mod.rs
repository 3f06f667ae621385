//! DOP853, an explicit Runge–Kutta method of order 8 with dense output, and its steps for a few unknowns.
//!
//! Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer 1993, section II.10.

mod tableau;

#[cfg(test)]
mod tests;

pub use tableau::{DENSE, END, FIFTH, FURTHER, LAST, Row, STAGES, Stage, THIRD};

/// Degree of the dense output.
pub const DEGREE: usize = 7;

/// One step of `ż = f(z)`, on the stack.
///
/// ```
/// use dashpot_numerics::dop853::Step;
///
/// let mut turn = |z: &[f64; 2]| [z[1], -z[0]];
/// let mut step = Step::from([1.0, 0.0], &mut turn);
/// step.attempt(0.1, &mut turn);
/// // Local errors go with the ninth power of the step, those of the polynomial with the eighth.
/// assert!((step.end()[0] - 0.1_f64.cos()).abs() < 1e-9);
/// step.fit(&mut turn);
/// assert!((step.at(0.5)[0] - 0.05_f64.cos()).abs() < 1e-8);
/// ```
#[derive(Debug, Clone)]
pub struct Step<const N: usize> {
    length: f64,
    start: [f64; N],
    end: [f64; N],
    /// The slopes of all stages; the last three for the dense output alone.
    slopes: [[f64; N]; LAST + 1 + FURTHER.len()],
    dense: [[f64; N]; DEGREE + 1],
}

impl<const N: usize> Step<N> {
    /// A step from `start`, of no length yet.
    pub fn from(start: [f64; N], f: &mut impl FnMut(&[f64; N]) -> [f64; N]) -> Self {
        let mut slopes = [[0.0; N]; LAST + 1 + FURTHER.len()];
        slopes[0] = f(&start);
        Self { length: 0.0, start, end: start, slopes, dense: [[0.0; N]; DEGREE + 1] }
    }

    /// Where it begins.
    pub fn start(&self) -> &[f64; N] {
        &self.start
    }

    /// Where it ends.
    pub fn end(&self) -> &[f64; N] {
        &self.end
    }

    /// The slopes at its start.
    pub fn first_slopes(&self) -> &[f64; N] {
        &self.slopes[0]
    }

    /// Takes it over this length.
    pub fn attempt(&mut self, length: f64, f: &mut impl FnMut(&[f64; N]) -> [f64; N]) {
        self.length = length;
        for (at, stage) in STAGES.iter().enumerate() {
            self.slopes[at + 1] = f(&self.reached(stage.slopes));
        }
        self.end = self.reached(END);
    }

    /// The estimate of its error, where each unknown is counted in the unit that `unit` gives of its number and
    /// its larger magnitude at both ends; those without a unit do not count.
    pub fn error(&self, unit: impl Fn(usize, f64) -> f64) -> f64 {
        let (mut fifth, mut third, mut count) = (0.0, 0.0, 0.0);
        let (of_fifth, by_end, of_third) = (self.sum(FIFTH), self.sum(END), self.sum(THIRD));
        for at in 0..N {
            let unit = unit(at, self.start[at].abs().max(self.end[at].abs()));
            if unit > 0.0 {
                fifth += (of_fifth[at] / unit).powi(2);
                third += ((by_end[at] - of_third[at]) / unit).powi(2);
                count += 1.0;
            }
        }
        let both = fifth + 0.01 * third;
        if both > 0.0 { self.length.abs() * fifth / (both * count).sqrt() } else { both }
    }

    /// Makes its dense output.
    pub fn fit(&mut self, f: &mut impl FnMut(&[f64; N]) -> [f64; N]) {
        self.slopes[LAST] = f(&self.end);
        for (at, stage) in FURTHER.iter().enumerate() {
            self.slopes[LAST + 1 + at] = f(&self.reached(stage.slopes));
        }
        let rows = DENSE.map(|row| self.sum(row));
        for at in 0..N {
            let change = self.end[at] - self.start[at];
            let bend = self.length * self.slopes[0][at] - change;
            let other = change - self.length * self.slopes[LAST][at] - bend;
            let known = [self.start[at], change, bend, other];
            let further = rows.iter().map(|row| self.length * row[at]);
            self.dense
                .iter_mut()
                .zip(known.into_iter().chain(further))
                .for_each(|(own, value)| own[at] = value);
        }
    }

    /// The unknowns at the part `x` of it, by its dense output.
    pub fn at(&self, x: f64) -> [f64; N] {
        let mut values = [0.0; N];
        for (order, own) in self.dense.iter().enumerate().rev() {
            let factor = if order % 2 == 0 { x } else { 1.0 - x };
            values.iter_mut().zip(own).for_each(|(value, own)| *value = own + factor * *value);
        }
        values
    }

    /// Begins the next one at its end; its dense output must have been made.
    pub fn go_on(&mut self) {
        self.start = self.end;
        self.slopes[0] = self.slopes[LAST];
    }

    fn reached(&self, row: Row) -> [f64; N] {
        let mut stage = self.start;
        stage.iter_mut().zip(self.sum(row)).for_each(|(own, sum)| *own += self.length * sum);
        stage
    }

    fn sum(&self, row: Row) -> [f64; N] {
        let mut sum = [0.0; N];
        for &(stage, factor) in row {
            sum.iter_mut().zip(&self.slopes[stage]).for_each(|(own, slope)| *own += factor * slope);
        }
        sum
    }
}
