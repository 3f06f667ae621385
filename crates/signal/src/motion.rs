//! Velocity and displacement of what an accelerometer is on, or of a free striker that a force acts on.

use crate::{
    Channel, Contact, Impact, Measure, Reading, Reason, Truth, Uncertainty, sampling::Sampling,
};

/// A body that moves in with less than this part of its speed of approach when the pulse is over has stopped.
const STOPPED: f64 = 1e-3;

/// How a body moves before the impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Its speed when the impact begins \[m/s\], along the impact.
    pub velocity: f64,
    /// Its mass \[kg\], where energies are wanted; a force on it needs one.
    pub mass: Option<f64>,
    /// What it would gain in free fall, along the impact \[m/s²\]; 0 where nothing pulls it.
    pub gravity: f64,
    /// When the impact begins \[s\], where the record is not to tell it.
    pub touch: Option<f64>,
}

/// The motion of a body along the impact: `v = V + g t − ∫ a dt` from the touch on, where its peak acceleration slows it
/// down; before it flies freely. What lines between samples hide and what the offset leaves adds up in the errors, an
/// offset `b` to `b t` in the velocity and `b t²/2` in the displacement; of noise two standard deviations, `2 √(q t)` and
/// `2 √(q t³/3)` with its intensity `q`.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Velocities at the samples \[m/s\].
    pub velocity: Vec<f64>,
    /// How far they may be off.
    pub velocity_error: Vec<f64>,
    /// Displacements since the touch \[m\], negative before.
    pub displacement: Vec<f64>,
    /// How far they may be off.
    pub displacement_error: Vec<f64>,
    /// From when to when the impact is.
    pub impact: Impact,
}

impl Motion {
    pub(crate) fn of(
        channel: &Channel,
        sampling: &Sampling<'_>,
        approach: Approach,
        contact: Contact,
        uncertainty: &Uncertainty,
    ) -> Self {
        let (times, values) = (channel.times(), channel.values());
        let (sign, weight) = (-channel.sign(), approach.gravity);
        let impact = Impact::of(channel, contact, uncertainty, approach.touch);
        let count = times.len();
        let mut own = Self {
            velocity: Vec::with_capacity(count),
            velocity_error: Vec::with_capacity(count),
            displacement: Vec::with_capacity(count),
            displacement_error: Vec::with_capacity(count),
            impact,
        };
        let of_touch = approach.velocity * impact.error;
        for time in &times[..=impact.begin] {
            let ahead = impact.touch - time;
            let v = approach.velocity - weight * ahead;
            own.push((v, 0.0), (-0.5 * ahead * (approach.velocity + v), of_touch));
        }
        let (mut v, mut v_error, mut x, mut x_error) = (approach.velocity, 0.0, 0.0, of_touch);
        let start =
            if approach.touch.is_some() { channel.value(impact.touch) } else { uncertainty.rest };
        let (mut before, mut one) = (impact.touch, sign * start + weight);
        for at in impact.begin + 1..count {
            let (step, other) = (times[at] - before, sign * values[at] + weight);
            // The acceleration is a line, the velocity a parabola, the displacement a cubic.
            x += step * v + step * step * (2.0 * one + other) / 6.0;
            v += 0.5 * step * (one + other);
            v_error += sampling.hidden(at - 1).area + uncertainty.floor * step;
            x_error += step * v_error;
            let since = times[at] - impact.touch;
            let noise = uncertainty.noise.area(since);
            own.push((v, v_error + noise), (x, x_error + since * noise / 3.0_f64.sqrt()));
            (before, one) = (times[at], other);
        }
        own
    }

    fn push(&mut self, velocity: (f64, f64), displacement: (f64, f64)) {
        self.velocity.push(velocity.0);
        self.velocity_error.push(velocity.1);
        self.displacement.push(displacement.0);
        self.displacement_error.push(displacement.1);
    }

    /// The deepest point of the impact: where the velocity passes zero, or else the last one.
    fn turn(&self, times: &[f64]) -> Turn {
        let Impact { begin, end, .. } = self.impact;
        let Some(at) =
            (begin..end).find(|&at| self.velocity[at] > 0.0 && self.velocity[at + 1] <= 0.0)
        else {
            return Turn {
                time: times[end],
                depth: self.displacement[end],
                error: self.displacement_error[end],
                velocity: self.velocity[end],
                velocity_error: self.velocity_error[end],
            };
        };
        // Between samples the velocity is nearly a line.
        let before = self.velocity[at];
        let from = times[at].max(self.impact.touch);
        let step = times[at + 1] - from;
        let share = before / (before - self.velocity[at + 1]);
        let further = 0.5 * share * step * before;
        Turn {
            time: from + share * step,
            depth: self.displacement[at].max(0.0) + further,
            error: self.displacement_error[at + 1],
            velocity: 0.0,
            velocity_error: 0.0,
        }
    }

    /// Whether it comes to rest within the impact.
    pub(crate) fn turns(&self) -> bool {
        self.velocity[self.impact.begin..=self.impact.end].iter().any(|own| *own <= 0.0)
    }

    /// With what velocity it still moves in for certain when the pulse is over \[m/s\], where it does.
    pub(crate) fn onward(&self) -> Option<f64> {
        let (back, error) = self.rebound();
        let is_certain = -back > error + STOPPED * self.velocity[self.impact.begin];
        (is_certain && !self.turns()).then_some(-back)
    }

    /// What is left of a reading of a body that does not stop: it goes deeper than where the pulse is over, and nothing of it
    /// comes back.
    pub(crate) fn left(&self, reading: Reading) -> Reading {
        match (self.onward(), reading.measure) {
            (None, _) => reading,
            (_, Measure::Displacement | Measure::EnergyTaken) => reading.bounded(Truth::AtLeast),
            _ => Reading {
                value: Err(Reason::DoesNotStop),
                ..Reading::new(reading.measure, 0.0, 0.0)
            },
        }
    }

    /// The speed at which it comes back \[m/s\], and how far that may be off.
    pub fn rebound(&self) -> (f64, f64) {
        (-self.velocity[self.impact.end], self.velocity_error[self.impact.end])
    }

    /// What it says of the impact.
    pub(crate) fn readings(&self, channel: &Channel, approach: Approach) -> Vec<Reading> {
        let times = channel.times();
        let end = self.impact.end;
        let turn = self.turn(times);
        let (back, back_error) = self.rebound();
        let of = |measure: Measure, (value, error): (f64, f64), time: f64| Reading {
            time: Some(time),
            ..Reading::new(measure, value, error)
        };
        let speed = approach.velocity;
        let mut all = vec![
            of(Measure::Displacement, (turn.depth, turn.error), turn.time),
            of(Measure::ReboundVelocity, (back, back_error), times[end]),
            of(Measure::Restitution, (back / speed, back_error / speed), times[end]),
        ];
        let Some(mass) = approach.mass else { return all };
        // What the weight does on the way is not the pad's.
        let weight = mass * approach.gravity;
        let kinetic =
            |v: f64, error: f64| (0.5 * mass * v * v, mass * (v.abs() + 0.5 * error) * error);
        let of_start = kinetic(speed, 0.0).0;
        let (of_turn, turn_error) = kinetic(turn.velocity, turn.velocity_error);
        let (of_end, end_error) = kinetic(self.velocity[end], self.velocity_error[end]);
        let of_depth = weight * turn.error;
        let taken = of_start - of_turn + weight * turn.depth;
        let returned = of_end - of_turn + weight * (turn.depth - self.displacement[end]);
        let taken_error = turn_error + of_depth;
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
