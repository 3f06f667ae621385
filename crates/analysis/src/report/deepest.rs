//! How far something is pressed in over a whole run.

use super::RunReport;

impl RunReport {
    /// The largest value \[m\] of a deformation, by its number among the outputs; not a number where it is not kept.
    pub fn deepest(&self, deformation: usize) -> f64 {
        let solution = self.solution();
        if !solution.keeps(deformation) {
            return f64::NAN;
        }
        solution.signal(deformation).maximum((0.0, solution.end())).value
    }
}
