//! What a model answers to a history that was measured.

use dashpot_dae::Signal;
use dashpot_network::Model;

use super::{
    Obstacle,
    history::History,
    simulation::{Control, Rig},
    solved::solve,
};
use crate::Choice;

/// What was done to a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// A force \[N\]; its deformation answers.
    Force,
    /// A deformation \[m\]; its force answers.
    Deformation,
}

/// The answer of a model over time: deformation \[m\] or force \[N\].
///
/// # Examples
///
/// A Kelvin–Voigt element that is compressed by 2 mm within 10 ms:
///
/// ```
/// use dashpot_analysis::rheometer::{Answer, Drive};
/// use dashpot_network::{Model, elements::{Dashpot, Spring}, part};
///
/// let pad = Model::parallel([part(Spring { stiffness: 1e4 }), part(Dashpot { damping: 50.0 })]);
/// let answer = Answer::to(&pad, Drive::Deformation, &[(0.0, 0.0), (0.01, 2e-3)], 1e-9)?;
/// assert!((answer.value(5e-3) - (1e4 * 1e-3 + 50.0 * 0.2)).abs() < 1e-6);
/// # Ok::<(), dashpot_analysis::rheometer::Obstacle>(())
/// ```
#[derive(Debug, Clone)]
pub struct Answer {
    signal: Signal,
    start: f64,
    length: f64,
}

impl Answer {
    /// That to what was done, `(time, value)` with rising times \[s\]: zero before the first row, straight from row to
    /// row. The tolerance is that of methods which have one.
    ///
    /// # Errors
    ///
    /// Why it cannot be solved, such as a jump of the deformation of a dashpot.
    pub fn to(
        model: &Model,
        drive: Drive,
        rows: &[(f64, f64)],
        tolerance: f64,
    ) -> Result<Self, Obstacle> {
        let start = rows.first().map_or(0.0, |own| own.0);
        let history = History::through(rows.iter().map(|own| (own.0 - start, own.1)));
        let control = match drive {
            Drive::Force => Control::Force,
            Drive::Deformation => Control::Deformation,
        };
        let rig = Rig::new(model, control, &history);
        let length = history.end();
        let solved = solve(&rig, &Choice::Auto, (length, tolerance), Vec::new())?;
        let number = rig.outputs.first().and_then(|own| solved.assembly.output(own));
        let number = number.ok_or(Obstacle::Undetermined)?;
        Ok(Self { signal: solved.solution().signal(number).clone(), start, length })
    }

    /// The answer at a time \[s\] of the history: zero before its first row, the last one behind its last.
    pub fn value(&self, time: f64) -> f64 {
        let time = time - self.start;
        if time < 0.0 { 0.0 } else { self.signal.value(time.min(self.length)) }
    }

    /// Time \[s\] and value, with its sign, where its magnitude is largest.
    pub fn peak(&self) -> (f64, f64) {
        let peak = self.signal.absolute_maximum((0.0, self.length));
        let sides = [self.signal.left_value(peak.time), self.signal.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time + self.start, peak.value.copysign(signed))
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::{
        elements::{Dashpot, Spring},
        part,
    };

    use super::*;

    /// Loaded over 10 ms, held, and let go of: a Maxwell element and a spring beside it, by the sum of ramps.
    #[test]
    fn a_ramp_and_a_hold_are_answered_as_the_closed_form_says() {
        let (spring, branch, time) = (2e4, 3e4, 0.02);
        let maxwell = Model::series([
            part(Spring { stiffness: branch }),
            part(Dashpot { damping: branch * time }),
        ]);
        let model = Model::parallel([part(Spring { stiffness: spring }), maxwell]);
        let rows = [(0.1, 0.0), (0.11, 2e-3), (0.2, 2e-3), (0.22, 5e-4)];
        let own = Answer::to(&model, Drive::Deformation, &rows, 1e-9).unwrap();
        let grown = |t: f64| if t > 0.0 { -(-t / time).exp_m1() } else { 0.0 };
        let bends = [(0.1, 0.2), (0.11, -0.2), (0.2, -0.075)];
        for at in 0..60 {
            let t = 0.1 + 2e-3 * f64::from(at);
            let way: f64 = bends.iter().map(|own| own.1 * (t - own.0).max(0.0)).sum();
            let late: f64 = bends.iter().map(|own| own.1 * branch * time * grown(t - own.0)).sum();
            let right = spring * way + late;
            assert!((own.value(t) - right).abs() < 1e-7 * 100.0, "{t}: {} {right}", own.value(t));
        }
        assert!(own.value(0.05).abs() < f64::EPSILON);
        assert!((own.peak().0 - 0.11).abs() < 1e-9);
    }

    #[test]
    fn a_force_that_was_measured_is_answered_by_a_deformation() {
        let (stiffness, damping) = (1e4, 200.0);
        let model = Model::parallel([part(Spring { stiffness }), part(Dashpot { damping })]);
        let own = Answer::to(&model, Drive::Force, &[(0.0, 100.0), (0.5, 100.0)], 1e-9).unwrap();
        for at in 1..20 {
            let t = 5e-3 * f64::from(at);
            let right = -0.01 * (-t * stiffness / damping).exp_m1();
            assert!((own.value(t) - right).abs() < 1e-8, "{t}: {} {right}", own.value(t));
        }
    }
}
