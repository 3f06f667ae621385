//! Velocity and displacement of what an accelerometer is on.

use crate::{Channel, Contact, Measure, Polarity, Reading, sampling::Sampling};

/// How a body moves before the blow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Its speed at the beginning of the record \[m/s\], along the blow.
    pub velocity: f64,
    /// Its mass \[kg\], where energies are wanted.
    pub mass: Option<f64>,
    /// What it would gain in free fall, along the blow \[m/s²\]; 0 where nothing pulls it.
    pub gravity: f64,
}

/// The motion of a body along the blow: `v = V + g t − ∫ a dt`, where its peak acceleration slows it down. What the
/// line between samples hides and the offset leaves adds up in the errors: an offset `b` moves the velocity by `b t`
/// and the displacement by `b t²/2`.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Velocities at the samples \[m/s\].
    pub velocity: Vec<f64>,
    /// How far they may be off.
    pub velocity_error: Vec<f64>,
    /// Displacements since the beginning of the record \[m\].
    pub displacement: Vec<f64>,
    /// How far they may be off.
    pub displacement_error: Vec<f64>,
    /// The sample at which the blow begins, and the one at which it is over: where the acceleration first comes back to
    /// zero behind the contact.
    pub blow: (usize, usize),
    /// What it moves freely between the first sample of the blow and the touch \[m\], as the line through the next two
    /// samples tells, and the way within that step.
    free: (f64, f64),
}

impl Motion {
    pub(crate) fn of(
        channel: &Channel,
        sampling: &Sampling<'_>,
        approach: Approach,
        contact: Contact,
        floor: f64,
    ) -> Self {
        let (times, values) = (channel.times(), channel.values());
        let sign = if channel.polarity() == Polarity::Positive { -1.0 } else { 1.0 };
        let weight = approach.gravity;
        let mut own = Self {
            velocity: vec![approach.velocity],
            velocity_error: vec![0.0],
            displacement: vec![0.0],
            displacement_error: vec![0.0],
            blow: blow(channel, contact, floor),
            free: (0.0, 0.0),
        };
        let (mut v, mut v_error, mut x, mut x_error) = (approach.velocity, 0.0, 0.0, 0.0);
        for at in 0..times.len() - 1 {
            let step = times[at + 1] - times[at];
            let [one, other] = [values[at], values[at + 1]].map(|own| sign * own + weight);
            // The acceleration is a line, the velocity a parabola, the displacement a cubic.
            x += step * v + step * step * (2.0 * one + other) / 6.0;
            v += 0.5 * step * (one + other);
            let before = v_error;
            v_error += sampling.hidden(at).area + floor * step;
            x_error += step * before.max(v_error);
            own.velocity.push(v);
            own.velocity_error.push(v_error);
            own.displacement.push(x);
            own.displacement_error.push(x_error);
        }
        own.free = own.free_way(channel);
        own
    }

    fn free_way(&self, channel: &Channel) -> (f64, f64) {
        let start = self.blow.0;
        let speed = self.velocity[start].abs();
        let (Some(times), Some(values)) =
            (channel.times().get(start..start + 3), channel.values().get(start..start + 3))
        else {
            return (0.0, 0.0);
        };
        let step = times[1] - times[0];
        let slope = (values[2] - values[1]) / (times[2] - times[1]);
        let back = values[1] / slope;
        let way = if back.is_finite() { step - back.clamp(0.0, step) } else { 0.0 };
        (speed * way, speed * step)
    }

    /// The deepest point of the blow: where the velocity passes zero, or else the last one.
    fn turn(&self, times: &[f64]) -> Turn {
        let (from, to) = self.blow;
        let start = self.displacement[from] + self.free.0;
        let start_error = self.free.1 - self.displacement_error[from];
        let Some(at) =
            (from..to).find(|&at| self.velocity[at] > 0.0 && self.velocity[at + 1] <= 0.0)
        else {
            return Turn {
                time: times[to],
                depth: self.displacement[to] - start,
                error: self.displacement_error[to] + start_error,
                velocity: self.velocity[to],
                velocity_error: self.velocity_error[to],
            };
        };
        // Between samples the velocity is nearly a line.
        let before = self.velocity[at];
        let step = times[at + 1] - times[at];
        let share = before / (before - self.velocity[at + 1]);
        let further = 0.5 * share * step * before;
        Turn {
            time: times[at] + share * step,
            depth: self.displacement[at] + further - start,
            error: self.displacement_error[at + 1] + start_error,
            velocity: 0.0,
            velocity_error: 0.0,
        }
    }

    /// The speed at which it comes back \[m/s\], and how far that may be off.
    pub fn rebound(&self) -> (f64, f64) {
        (-self.velocity[self.blow.1], self.velocity_error[self.blow.1])
    }

    /// What it says of the blow.
    pub(crate) fn readings(&self, channel: &Channel, approach: Approach) -> Vec<Reading> {
        let times = channel.times();
        let (start, end) = self.blow;
        let turn = self.turn(times);
        let (back, back_error) = self.rebound();
        let of = |measure: Measure, (value, error): (f64, f64), time: f64| Reading {
            time: Some(time),
            ..Reading::new(measure, value, error)
        };
        let mut all = vec![
            of(Measure::Displacement, (turn.depth, turn.error), turn.time),
            of(Measure::ReboundVelocity, (back, back_error), times[end]),
        ];
        let before = self.velocity[start];
        if before > 0.0 {
            // What is off at the beginning is off at the end as well.
            let error =
                back_error / before + back.abs() * self.velocity_error[start] / (before * before);
            all.push(of(Measure::Restitution, (back / before, error), times[end]));
        }
        let Some(mass) = approach.mass else { return all };
        // What the weight does on the way is not the pad's.
        let weight = mass * approach.gravity;
        let kinetic =
            |v: f64, error: f64| (0.5 * mass * v * v, mass * (v.abs() + 0.5 * error) * error);
        let fallen = self.displacement[end] - self.displacement[start] - self.free.0;
        let (of_start, start_error) = kinetic(before, self.velocity_error[start]);
        let (of_turn, turn_error) = kinetic(turn.velocity, turn.velocity_error);
        let (of_end, end_error) = kinetic(self.velocity[end], self.velocity_error[end]);
        let of_depth = weight * turn.error;
        let taken = of_start - of_turn + weight * turn.depth;
        let returned = of_end - of_turn + weight * (turn.depth - fallen);
        let taken_error = start_error + turn_error + of_depth;
        let returned_error = end_error + turn_error + of_depth;
        all.push(of(Measure::EnergyTaken, (taken, taken_error), turn.time));
        all.push(of(Measure::EnergyReturned, (returned, returned_error), times[end]));
        let absorbed = (taken - returned, taken_error + returned_error);
        all.push(of(Measure::EnergyAbsorbed, absorbed, times[end]));
        all
    }
}

/// Where a body turns.
struct Turn {
    time: f64,
    depth: f64,
    error: f64,
    velocity: f64,
    velocity_error: f64,
}

/// The samples between which the blow is: from the last one before the contact at which the channel is not beyond zero
/// to the first one behind.
pub(crate) fn blow(channel: &Channel, contact: Contact, floor: f64) -> (usize, usize) {
    let (times, values) = (channel.times(), channel.values());
    let sign = if channel.polarity() == Polarity::Positive { 1.0 } else { -1.0 };
    let last = values.len() - 1;
    // What the offset and rounding leave is zero.
    let zero = floor.max(1e-12 * channel.largest().1);
    let is_over = |at: &usize| sign * values[*at] <= zero;
    let first = times.partition_point(|time| *time < contact.window.0).min(last);
    let end = times.partition_point(|time| *time < contact.window.1).min(last);
    let begin = (0..first).rev().find(is_over).unwrap_or(0);
    (begin, (end..=last).find(is_over).unwrap_or(last))
}
