//! Impulses where masses meet: speeds jump there, and forces are infinite for no time.

use std::collections::HashMap;

use dashpot_dae::Trajectory;
use dashpot_network::Assembly;

use super::contacts;

/// An instant at which masses meet, so that velocities jump by an impulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityJump {
    /// When \[s\].
    pub time: f64,
    /// Of an element the impulse that pushes its ends apart, on a body that towards the support \[N s\].
    pub impulse: f64,
    /// Kinetic energy lost \[J\].
    pub lost: f64,
}

impl VelocityJump {
    /// Those of some, in order of time, within a window \[s\], both ends included.
    pub fn within(all: &[Self], window: (f64, f64)) -> &[Self] {
        let from = all.partition_point(|own| own.time < window.0);
        let to = all.partition_point(|own| own.time <= window.1);
        all.get(from..to).unwrap_or(&[])
    }
}

/// Part of the impulses on a body below which their sum is none: what is passed on.
const PASSED_ON: f64 = 1e-9;

/// The jumps of each connection, in order of time; nothing where there are none in all of the run.
pub(crate) fn by_connection(
    assembly: &Assembly,
    trajectory: &Trajectory,
) -> Vec<Vec<VelocityJump>> {
    let mut impacts = trajectory.switches.iter().filter(|switch| switch.impulse > 0.0).peekable();
    if impacts.peek().is_none() {
        return Vec::new();
    }
    let mut found = vec![Vec::new(); assembly.connections.len()];
    let mut owner: HashMap<&str, usize> = HashMap::new();
    for (at, connection) in assembly.connections.iter().enumerate() {
        for primitive in assembly.primitives.get(connection.primitives.clone()).unwrap_or(&[]) {
            owner.insert(&primitive.name, at);
        }
    }
    for impact in impacts {
        if let Some(&at) = owner.get(impact.name.as_str()) {
            found[at].push(VelocityJump {
                time: impact.time,
                impulse: impact.impulse,
                lost: impact.lost,
            });
        }
    }
    found
}

/// The jumps on a body that change its speed, in order of time, those of one instant added up.
pub(crate) fn on_body(
    assembly: &Assembly,
    all: &[Vec<VelocityJump>],
    body: usize,
) -> Vec<VelocityJump> {
    let mut signed = Vec::new();
    for (connection, jumps) in assembly.connections.iter().zip(all) {
        if jumps.is_empty() || connection.is_rigid {
            continue;
        }
        let [a, b] = contacts::between(assembly, connection);
        let sign = match (a == body, b == body) {
            (true, false) => -1.0,
            (false, true) => 1.0,
            _ => continue,
        };
        signed.extend(
            jumps.iter().map(|jump| VelocityJump { impulse: sign * jump.impulse, ..*jump }),
        );
    }
    signed.sort_by(|one, other| one.time.total_cmp(&other.time));
    let same = |one: &VelocityJump, other: &VelocityJump| one.time.total_cmp(&other.time).is_eq();
    let sums = signed.chunk_by(same).filter_map(|jumps| {
        let first = jumps.first()?;
        let impulse: f64 = jumps.iter().map(|jump| jump.impulse).sum();
        let size: f64 = jumps.iter().map(|jump| jump.impulse.abs()).sum();
        let lost = jumps.iter().map(|jump| jump.lost).sum();
        (impulse.abs() > PASSED_ON * size).then_some(VelocityJump {
            time: first.time,
            impulse,
            lost,
        })
    });
    sums.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_include_both_ends() {
        let jump = |time: f64| VelocityJump { time, impulse: 1.0, lost: 0.0 };
        let jumps = [jump(0.0), jump(1.0), jump(2.0)];
        assert_eq!(VelocityJump::within(&jumps, (0.0, 1.0)).len(), 2);
        assert_eq!(VelocityJump::within(&jumps, (1.0, 1.0)).len(), 1);
        assert_eq!(VelocityJump::within(&jumps, (1.5, 1.0)).len(), 0);
        assert_eq!(VelocityJump::within(&jumps, (3.0, 4.0)).len(), 0);
    }
}
