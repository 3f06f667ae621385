//! Work of a force over a displacement.

use thiserror::Error;

use super::{Analysis, defects::gain};
use crate::{Impact, Measure, Reading, Truth, Uncertainty, sampling::Sampling};

/// What an impact does to a pad: the loop of force over displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// Force in compression \[N\] and displacement since the impact began \[m\], at the samples of the impact.
    pub points: Vec<(f64, f64)>,
    /// Work done until the deepest point \[J\], with how far it may be off.
    pub taken: (f64, f64),
    /// What comes back behind it.
    pub returned: (f64, f64),
    /// The largest displacement \[m\].
    pub deepest: f64,
}

/// Why a force and a displacement have no work.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum WorkFault {
    /// They have not the same times.
    #[error("force and displacement are not sampled at the same times")]
    OtherTimes,
    /// Nothing moves while the force acts.
    #[error("the displacement does not change while the force acts")]
    NoMotion,
}

impl Work {
    /// The work of a force over a displacement, both along the impact: the force counts as positive where it points as its
    /// peak does, the displacement where it is largest. Between samples both are lines, so that the product is exact on
    /// them; the error is what every second sample would change, what the forces of half a resolution do, and noise.
    ///
    /// # Errors
    ///
    /// [`WorkFault`].
    pub fn of(force: &Analysis, displacement: &Analysis) -> Result<Self, WorkFault> {
        let uncertainties = [force.uncertainty, displacement.uncertainty];
        let impact = Impact::of(&force.channel, force.contact, &force.uncertainty, None);
        let (force, displacement) = (&force.channel, &displacement.channel);
        if force.times() != displacement.times() {
            return Err(WorkFault::OtherTimes);
        }
        let (first, last) = (impact.begin, impact.end);
        let start = displacement.values()[first];
        let sign = force.sign();
        let moved = |at: usize| displacement.values()[at] - start;
        let far = |best: f64, own: f64| if own.abs() > best.abs() { own } else { best };
        let most = (first..=last).map(moved).fold(0.0, far);
        if most == 0.0 {
            return Err(WorkFault::NoMotion);
        }
        let point = |at: usize| (sign * force.values()[at], most.signum() * moved(at));
        let points: Vec<(f64, f64)> = (first..=last).map(point).collect();
        let deepest = most.abs();
        let turn = points.iter().position(|own| own.1 >= deepest).unwrap_or(0);
        let peak = points.iter().map(|own| own.0.abs()).fold(0.0, f64::max);
        let [floor, still] = [
            uncertainties[0].floor,
            uncertainties[1].floor + uncertainties[1].noise.extreme(points.len()),
        ];
        let step = force.steps().rate.recip();
        let of = |part: &[(f64, f64)], sign: f64| {
            let whole = area(part.iter());
            let halved = area(part.iter().step_by(2).chain(part.last()));
            // What a sample weighs in the sum is half of the change of the other quantity from the one before to the next.
            let squares = part.windows(3).fold((0.0, 0.0), |sum, own| {
                let weight =
                    |of: fn(&(f64, f64)) -> f64| (0.5 * (of(&own[2]) - of(&own[0]))).powi(2);
                (sum.0 + weight(|own| own.1), sum.1 + weight(|own| own.0))
            });
            let variance = uncertainties[0].noise.intensity * squares.0
                + uncertainties[1].noise.intensity * squares.1;
            let noise = 2.0 * (variance / step).sqrt();
            let error = (whole - halved).abs() + floor * deepest + 2.0 * still * peak + noise;
            (sign * whole, error)
        };
        let (taken, returned) = (of(&points[..=turn], 1.0), of(&points[turn..], -1.0));
        Ok(Self { points, taken, returned, deepest })
    }

    /// What it says of the impact.
    fn readings(&self) -> [Reading; 4] {
        let of = |measure, (value, error)| Reading::new(measure, value, error);
        [
            of(Measure::Displacement, (self.deepest, 0.0)),
            of(Measure::EnergyTaken, self.taken),
            of(Measure::EnergyReturned, self.returned),
            of(Measure::EnergyAbsorbed, self.absorbed()),
        ]
    }

    /// What does not come back \[J\], with how far it may be off.
    pub fn absorbed(&self) -> (f64, f64) {
        (self.taken.0 - self.returned.0, self.taken.1 + self.returned.1)
    }
}

impl Analysis {
    /// Adds what the force does over a displacement that was read in the same way.
    ///
    /// # Errors
    ///
    /// [`WorkFault`].
    pub fn add_work(&mut self, displacement: &Self) -> Result<(), WorkFault> {
        let work = Work::of(self, displacement)?;
        let mut all = work.readings();
        let Uncertainty { floor, noise, .. } = displacement.uncertainty;
        let noise =
            noise.extreme_near(displacement.channel.values(), displacement.channel.largest().1);
        all[0].error = 2.0 * (floor + noise) + Sampling::of(&displacement.channel).overshoot();
        // What a force is beyond its range is more work on either way, and what a displacement is the same.
        if !(self.clipped.is_empty() && displacement.clipped.is_empty()) {
            let taken = |own: Reading| own.bounded(Truth::AtLeast);
            let [_, one, other, absorbed] = all;
            (all[1], all[2], all[3]) = (taken(one), taken(other), absorbed.open());
        }
        if !displacement.clipped.is_empty() {
            all[0] = all[0].bounded(Truth::AtLeast);
        }
        // What was measured goes before what is told by the force alone.
        self.readings.retain(|own| all.iter().all(|other| other.measure != own.measure));
        self.readings.extend(all);
        self.work = Some(work);
        let gain = gain(self).filter(|own| !self.defects.contains(own));
        self.defects.extend(gain);
        Ok(())
    }
}

/// `∫ F dx` along lines.
fn area<'p>(points: impl Iterator<Item = &'p (f64, f64)>) -> f64 {
    let (mut sum, mut before): (f64, Option<&(f64, f64)>) = (0.0, None);
    for own in points {
        if let Some(before) = before {
            sum += 0.5 * (before.0 + own.0) * (own.1 - before.1);
        }
        before = Some(own);
    }
    sum
}
