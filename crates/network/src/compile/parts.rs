//! What has been found out of a network, for those that report it.

use super::{
    bodies::Bodies,
    drives::Drive,
    expand::Expansion,
    incidence::Incidence,
    motion::Motion,
    row::{Row, RowSum, Rows},
    structure::Structure,
    unknowns::Places,
};

/// Everything that has been found out, for those that report it.
pub(super) struct Parts<'a> {
    pub(super) expansion: &'a Expansion,
    pub(super) bodies: &'a Bodies,
    pub(super) structure: &'a Structure,
    pub(super) motion: &'a Motion,
    pub(super) places: &'a Places,
    pub(super) drives: &'a [Drive],
    pub(super) incidence: &'a Incidence,
    /// How far each joint is from the place of its body.
    pub(super) offsets: &'a Rows,
    /// Own mass of each joint \[kg\].
    pub(super) masses: &'a [f64],
}

impl Parts<'_> {
    /// Sum of the forces of springs and dashpots on a body, with the loads that an accelerometer feels.
    pub(super) fn contact_force(&self, body: usize) -> Row {
        let mut sum = RowSum::default();
        self.add_forces(&self.bodies.all[body].joints, 1.0, &mut sum);
        let drives = self.incidence.drives(self.drives, body);
        for drive in drives.filter(|drive| !drive.is_body_force) {
            if let Some(force) = &drive.force {
                sum.add(1.0, force);
            }
        }
        sum.total()
    }

    /// Adds `sign` times the forces of springs and dashpots on these joints.
    pub(super) fn add_forces(&self, joints: &[usize], sign: f64, sum: &mut RowSum) {
        for (primitive, own) in joints.iter().flat_map(|&joint| self.incidence.at_joint(joint)) {
            if let Some(force) = self.motion.force.get(primitive) {
                sum.add(sign * own, &force);
            }
        }
    }
}
