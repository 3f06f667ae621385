//! What a model answers to a history that was measured.

use dashpot_dae::Signal;
use dashpot_network::Model;

use super::{Drive, Obstacle, history::History, lines::Lines, rig::Rig, solved::solve};
use crate::Choice;

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
/// let answer = Answer::to(&pad, Drive::Deformation, &[(0.0, 0.0), (0.01, 2e-3)], (1e-9, true))?;
/// assert!((answer.value(5e-3) - (1e4 * 1e-3 + 50.0 * 0.2)).abs() < 1e-6);
/// # Ok::<(), dashpot_analysis::rheometer::Obstacle>(())
/// ```
#[derive(Debug, Clone)]
pub struct Answer {
    course: Course,
    start: f64,
    length: f64,
}

/// How it is known.
#[derive(Debug, Clone)]
enum Course {
    /// In closed form, from corner to corner of what was done.
    Closed(Lines),
    /// As a solution of the network.
    Solved(Signal),
}

impl Answer {
    /// That to what was done, `(time, value)` with rising times \[s\]: zero before the first row, straight from row to
    /// row. That of a linear model is in closed form, and that of one beside laws of the deformation alone to a deformation;
    /// the tolerance is that of the methods which others are solved by, and judged by their energy or not.
    ///
    /// # Errors
    ///
    /// Why it cannot be solved, such as a jump of the deformation of a dashpot.
    pub fn to(
        model: &Model,
        drive: Drive,
        rows: &[(f64, f64)],
        (tolerance, is_judged): (f64, bool),
    ) -> Result<Self, Obstacle> {
        let start = rows.first().map_or(0.0, |own| own.0);
        let history = History::through(rows.iter().map(|own| (own.0 - start, own.1)));
        let length = history.end();
        if let Some(own) = Lines::of(model, drive, &history) {
            return Ok(Self { course: Course::Closed(own), start, length });
        }
        let rig = Rig::new(model, drive, &history);
        let solved = solve(&rig, &Choice::Auto, (length, tolerance), Vec::new(), is_judged)?;
        let number = rig.outputs.first().and_then(|own| solved.assembly.output(own));
        let number = number.ok_or(Obstacle::Undetermined)?;
        let course = Course::Solved(solved.solution().signal(number).clone());
        Ok(Self { course, start, length })
    }

    /// The answer at a time \[s\] of the history: zero before its first row, the last one behind its last.
    pub fn value(&self, time: f64) -> f64 {
        let time = time - self.start;
        let within = time.min(self.length);
        match &self.course {
            _ if time < 0.0 => 0.0,
            Course::Closed(own) => own.value(within),
            Course::Solved(own) => own.value(within),
        }
    }

    /// Time \[s\] and value, with its sign, where its magnitude is largest.
    pub fn peak(&self) -> (f64, f64) {
        let signal = match &self.course {
            Course::Closed(own) => {
                let (time, value) = own.peak();
                return (time + self.start, value);
            }
            Course::Solved(own) => own,
        };
        let peak = signal.absolute_maximum((0.0, self.length));
        let sides = [signal.left_value(peak.time), signal.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time + self.start, peak.value.copysign(signed))
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::{
        elements::{CubicSpring, Dashpot, Spring},
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
        let own = Answer::to(&model, Drive::Deformation, &rows, (1e-9, true)).unwrap();
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
    fn the_closed_form_is_what_the_network_answers() {
        let branch = |stiffness: f64, time: f64| {
            Model::series([part(Spring { stiffness }), part(Dashpot { damping: stiffness * time })])
        };
        let model =
            Model::parallel([part(Spring { stiffness: 2e4 }), branch(3e4, 0.02), branch(1e4, 0.7)]);
        let rows = [(0.0, 1e-3), (0.011, 2e-3), (0.2, 2e-3), (0.22, 5e-4), (0.5, 9e-4)];
        for (drive, unit) in [(Drive::Deformation, 1.0), (Drive::Force, 1e5)] {
            let rows = rows.map(|own| (own.0, unit * own.1));
            let own = Answer::to(&model, drive, &rows, (1e-9, true)).unwrap();
            assert!(matches!(own.course, Course::Closed(_)));
            let history = History::through(rows.into_iter());
            let rig = Rig::new(&model, drive, &history);
            let solved = solve(&rig, &Choice::Auto, (0.5, 1e-9), Vec::new(), true).unwrap();
            let number = solved.assembly.output(&rig.outputs[0]).unwrap();
            let signal = solved.solution().signal(number).clone();
            let peak = signal.absolute_maximum((0.0, 0.5)).value;
            assert!((own.peak().1.abs() / peak - 1.0).abs() < 1e-9, "{:?}", own.peak());
            for at in 0..200 {
                let time = 2.5e-3 * f64::from(at) + 1e-4;
                let (one, other) = (own.value(time), signal.value(time));
                assert!((one - other).abs() < 1e-9 * peak, "{time}: {one} and {other}");
            }
        }
    }

    #[test]
    fn laws_of_the_deformation_are_followed_beside_branches_as_the_network_is_solved() {
        let cubic = part(CubicSpring { stiffness: 2e4, cubic: 3e8 });
        let maxwell =
            Model::series([part(Spring { stiffness: 8e4 }), part(Dashpot { damping: 8e2 })]);
        let elastic = Model::parallel([part(Spring { stiffness: 1e4 }), cubic]);
        let viscous = Model::parallel([elastic.clone(), maxwell]);
        let rows = [(0.1, 0.0), (0.11, 4e-3), (0.2, 5e-3), (0.3, -1e-3)];
        for model in [elastic, viscous] {
            let own = Answer::to(&model, Drive::Deformation, &rows, (1e-9, true)).unwrap();
            assert!(matches!(own.course, Course::Closed(..)));
            let history = History::through(rows.iter().map(|own| (own.0 - 0.1, own.1)));
            let rig = Rig::new(&model, Drive::Deformation, &history);
            let solved = solve(&rig, &Choice::Auto, (0.2, 1e-9), Vec::new(), true).unwrap();
            let number = solved.assembly.output(&rig.outputs[0]).unwrap();
            let signal = solved.solution().signal(number).clone();
            let peak = signal.absolute_maximum((0.0, 0.2));
            assert!((own.peak().1 - peak.value).abs() < 1e-7 * peak.value, "{:?}", own.peak());
            assert!((own.peak().0 - 0.1 - peak.time).abs() < 1e-6, "{:?}", own.peak());
            for at in 0..200 {
                let time = 1e-3 * f64::from(at) + 1e-5;
                let (one, other) = (own.value(time + 0.1), signal.value(time));
                assert!((one - other).abs() < 1e-7 * peak.value, "{time}: {one} and {other}");
            }
        }
    }

    #[test]
    fn a_force_that_was_measured_is_answered_by_a_deformation() {
        let (stiffness, damping) = (1e4, 200.0);
        let model = Model::parallel([part(Spring { stiffness }), part(Dashpot { damping })]);
        let own =
            Answer::to(&model, Drive::Force, &[(0.0, 100.0), (0.5, 100.0)], (1e-9, true)).unwrap();
        for at in 1..20 {
            let t = 5e-3 * f64::from(at);
            let right = -0.01 * (-t * stiffness / damping).exp_m1();
            assert!((own.value(t) - right).abs() < 1e-8, "{t}: {} {right}", own.value(t));
        }
    }
}
