//! Outputs at regular times.

use dashpot_dae::Trajectory;
use dashpot_network::Assembly;

/// One output at all times of a [`Table`].
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name of the output, for instance `padding.force`.
    pub name: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its values.
    pub values: Vec<f64>,
}

/// The outputs of all nodes and elements at regular times.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The times \[s\].
    pub times: Vec<f64>,
    /// The outputs: position, velocity and acceleration of each node, then deformation, rate and
    /// force of each element. Accelerations are those of accelerometers as measured curves have them: positive away
    /// from the support, against the velocity of what falls on it.
    pub columns: Vec<Column>,
}

/// `count` regular times from the start to the end of a run of `end` \[s\]; one time alone is the start.
pub fn regular_times(end: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1);
    let share = |at: usize| at as f64 / last as f64;
    (0..count).map(|at| if at == last { end } else { end * share(at) }).collect()
}

/// The outputs of all nodes and elements at `count` regular times, from the right where they jump.
pub fn table(assembly: &Assembly, trajectory: &Trajectory, count: usize) -> Table {
    table_at(assembly, trajectory, regular_times(trajectory.t_end, count))
}

/// The outputs of all nodes and elements at these times \[s\], which rise and lie within the run,
/// from the right where they jump; of a large network those that were [kept](Trajectory::keeps).
pub fn table_at(assembly: &Assembly, trajectory: &Trajectory, times: Vec<f64>) -> Table {
    let mut own = outputs_at(assembly, trajectory, times);
    let accelerations = assembly.nodes.iter().filter_map(|node| node.acceleration);
    let outputs = &assembly.system.outputs;
    let names = accelerations.filter_map(|at| outputs.get(at)).map(|output| output.name);
    let names: Vec<_> = names.collect();
    for column in own.columns.iter_mut().filter(|own| names.iter().any(|name| *name == *own.name)) {
        // A zero has no sign.
        column.values.iter_mut().for_each(|value| *value = 0.0 - *value);
    }
    own
}

/// The same, each as the motion counts it.
fn outputs_at(assembly: &Assembly, trajectory: &Trajectory, times: Vec<f64>) -> Table {
    let system = &assembly.system;
    let nodes = assembly.nodes.iter();
    let nodes = nodes.flat_map(|node| [Some(node.position), node.velocity, node.acceleration]);
    let elements = assembly
        .connections
        .iter()
        .flat_map(|connection| [Some(connection.deformation), connection.rate, connection.force]);
    let all = nodes.chain(elements).flatten();
    let numbers: Vec<usize> = all.filter(|&at| trajectory.keeps(system, at)).collect();
    if assembly.switching.is_some() || trajectory.digest().is_some() {
        let column = |&at: &usize| Column {
            name: system.outputs.at(at).name.to_string(),
            unit: system.outputs.at(at).unit,
            values: trajectory.signal(system, at).sample(&times),
        };
        let columns = numbers.iter().map(column).collect();
        return Table { times, columns };
    }
    let outputs: Vec<_> = numbers.iter().filter_map(|&at| system.outputs.get(at)).collect();
    let scaled: Vec<f64> = times.iter().map(|time| time / system.time_scale).collect();
    let states = trajectory.dense.sample(system, &scaled);
    let mut inputs = vec![0.0; system.inputs.len()];
    let mut values = vec![Vec::with_capacity(times.len()); outputs.len()];
    for (row, &time) in scaled.iter().enumerate() {
        let state = &states[row * system.len()..(row + 1) * system.len()];
        system.inputs_at(time, time, &mut inputs);
        for (values, output) in values.iter_mut().zip(&outputs) {
            let value = output.unknowns.at(state) + output.inputs.at(&inputs);
            values.push(output.scale * value);
        }
    }
    let columns = outputs.iter().zip(values).map(|(output, values)| Column {
        name: output.name.to_string(),
        unit: output.unit,
        values,
    });
    Table { times, columns: columns.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_times_include_both_ends() {
        assert_eq!(regular_times(2.0, 3), [0.0, 1.0, 2.0]);
        assert_eq!(regular_times(2.0, 1), [0.0]);
        assert!(regular_times(2.0, 0).is_empty());
        assert_eq!(regular_times(0.0, 2), [0.0, 0.0]);
    }
}
