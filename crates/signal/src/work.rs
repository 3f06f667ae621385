//! Work of a force over a displacement.

use thiserror::Error;

use crate::{
    Analysis, Channel, Contact, Measure, Polarity, Reading, motion::blow, sampling::Sampling,
};

/// What a blow does to a pad: the loop of force over displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// Force in compression \[N\] and displacement since the blow began \[m\], at the samples of the blow.
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
    /// The work of a force over a displacement, both along the blow: the force counts as positive where it points as its
    /// peak does, the displacement where it is largest. Between samples both are lines, so that the product is exact on
    /// them; the error is what every second sample would change, and what the forces of half a resolution do.
    ///
    /// # Errors
    ///
    /// [`WorkFault`].
    pub fn of(
        force: &Channel,
        displacement: &Channel,
        contact: Contact,
        floors: [f64; 2],
    ) -> Result<Self, WorkFault> {
        if force.times() != displacement.times() {
            return Err(WorkFault::OtherTimes);
        }
        let (first, last) = blow(force, contact, floors[0]);
        let start = displacement.values()[first];
        let sign = if force.polarity() == Polarity::Positive { 1.0 } else { -1.0 };
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
        let of = |part: &[(f64, f64)], sign: f64| {
            let whole = area(part.iter());
            let halved = area(part.iter().step_by(2).chain(part.last()));
            (sign * whole, (whole - halved).abs() + floors[0] * deepest + 2.0 * floors[1] * peak)
        };
        let (taken, returned) = (of(&points[..=turn], 1.0), of(&points[turn..], -1.0));
        Ok(Self { points, taken, returned, deepest })
    }

    /// What it says of the blow.
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
        let floors = [self.floor, displacement.floor];
        let work = Work::of(&self.channel, &displacement.channel, self.contact, floors)?;
        let mut all = work.readings();
        all[0].error = 2.0 * displacement.floor + Sampling::of(&displacement.channel).overshoot();
        self.readings.extend(all);
        self.work = Some(work);
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
