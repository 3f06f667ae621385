//! How far something is pressed in over a whole run.

use super::RunReport;

impl RunReport {
    /// The largest value \[m\] of a deformation, by its number among the outputs; not a number where it is not kept.
    ///
    /// Of a plain impact it is the peak of what is struck, and no curve is made for it.
    pub fn deepest(&self, deformation: usize) -> f64 {
        if let Some(known) = self.deepest_struck(deformation) {
            return known;
        }
        let solution = self.solution();
        if !solution.keeps(deformation) {
            return f64::NAN;
        }
        solution.signal(deformation).maximum((0.0, solution.end())).value
    }

    /// The same where it is known without curves: they are yet to be made, and it is the deformation of the one element
    /// that is struck.
    fn deepest_struck(&self, deformation: usize) -> Option<f64> {
        let own = self.trajectory.to_come()?;
        let struck = self.assembly.connections[own.element].deformation;
        let [one, other] = [struck, deformation].map(|own| self.assembly.system.outputs.at(own));
        let is_it = one.scale.to_bits() == other.scale.to_bits()
            && one.unknowns == other.unknowns
            && one.inputs == other.inputs;
        is_it.then_some(own.deepest.value)
    }
}
