//! A measured curve beside that of a model: how far they are apart.

use dashpot_dae::Signal;

/// How far a measured curve and that of a model are apart, in the units of the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Rows of the measured curve that lie where the model has values.
    pub rows: usize,
    /// From where to where both have values: times \[s\], or of loops deformations \[m\] or strains \[1\].
    pub span: (f64, f64),
    /// Place and value of the largest magnitude that was measured.
    pub measured_peak: (f64, f64),
    /// The same of the model.
    pub model_peak: (f64, f64),
    /// Root of the mean square of the difference over the span, in parts of the measured peak.
    pub rms: f64,
    /// Areas within the measured loop and that of the model, `∮ F dy`; `None` of curves over time.
    pub areas: Option<[f64; 2]>,
}

impl Deviation {
    /// The peak of the model less the measured one, in magnitude.
    pub fn peak(&self) -> f64 {
        self.model_peak.1.abs() - self.measured_peak.1.abs()
    }

    /// The same in parts of the measured peak.
    pub fn relative_peak(&self) -> f64 {
        self.peak() / self.measured_peak.1.abs()
    }

    /// Whether the two peaks have different signs, so that one of both may count the other way.
    pub fn is_opposed(&self) -> bool {
        self.model_peak.1 * self.measured_peak.1 < 0.0
    }

    /// How much later the model has its peak, or of loops how much deeper.
    pub fn place(&self) -> f64 {
        self.model_peak.0 - self.measured_peak.0
    }

    /// Of curves over time within a part of a run \[s\]: `measured` in order of time, which counts from `zero` \[s\]
    /// of the run, and an output of it. Both peaks are those of the span that the two have in common. `None` where
    /// that holds fewer than two rows, or nothing but zeros was measured in it.
    pub fn over_time(
        measured: &[(f64, f64)],
        (model, window): (&Signal, (f64, f64)),
        zero: f64,
    ) -> Option<Self> {
        let is_inside = |row: &&(f64, f64)| (window.0..=window.1).contains(&(row.0 + zero));
        let rows: Vec<(f64, f64)> = measured.iter().filter(is_inside).copied().collect();
        let (first, last) = (rows.first()?.0, rows.last()?.0);
        let peak = model.absolute_maximum((first + zero, last + zero));
        // Values may jump there.
        let sides = [model.left_value(peak.time), model.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        let peak = (peak.time - zero, peak.value.copysign(signed));
        let mut square = Square::default();
        square.add(&rows, |time| Some(model.value(time + zero)));
        Self::of(rows.len(), (first, last), (self::peak(&rows)?, peak), square, None)
    }

    /// Of loops, as they follow in time. Each is split where its deformation is largest, and the ways out and back
    /// are compared at the deformations that were measured; between its points the model is a straight line.
    /// `None` as for [`over_time`](Self::over_time).
    pub fn of_loops(measured: &[(f64, f64)], model: &[(f64, f64)]) -> Option<Self> {
        let ([out, back], [model_out, model_back]) = (branches(measured), branches(model));
        let mut square = Square::default();
        square.add(out, |place| at(model_out, place));
        square.add(back, |place| at(model_back, place));
        let places =
            || measured.iter().map(|row| row.0).filter(|&own| at(model_out, own).is_some());
        let span = (places().reduce(f64::min)?, places().reduce(f64::max)?);
        let areas = Some([area(measured), area(model)]);
        Self::of(places().count(), span, (peak(measured)?, peak(model)?), square, areas)
    }

    fn of(
        rows: usize,
        span: (f64, f64),
        (measured_peak, model_peak): ((f64, f64), (f64, f64)),
        square: Square,
        areas: Option<[f64; 2]>,
    ) -> Option<Self> {
        let is_known = rows > 1 && square.length > 0.0 && measured_peak.1 != 0.0;
        let rms = (square.sum / square.length).sqrt() / measured_peak.1.abs();
        is_known.then_some(Self { rows, span, measured_peak, model_peak, rms, areas })
    }
}

/// The integral of a squared difference, and the length that it is over.
#[derive(Debug, Clone, Copy, Default)]
struct Square {
    sum: f64,
    length: f64,
}

impl Square {
    /// Adds the rows between which the model has values; the difference is straight between two rows.
    fn add(&mut self, rows: &[(f64, f64)], model: impl Fn(f64) -> Option<f64>) {
        for pair in rows.windows(2) {
            let [Some(one), Some(other)] = [model(pair[0].0), model(pair[1].0)] else { continue };
            let length = (pair[1].0 - pair[0].0).abs();
            let (one, other) = (pair[0].1 - one, pair[1].1 - other);
            self.sum += length * (one * one + one * other + other * other) / 3.0;
            self.length += length;
        }
    }
}

/// The ways out and back of a loop, which share the place where the deformation is largest.
fn branches(rows: &[(f64, f64)]) -> [&[(f64, f64)]; 2] {
    let largest = (0..rows.len()).max_by(|&one, &other| {
        rows[one].0.abs().total_cmp(&rows[other].0.abs()).then(other.cmp(&one))
    });
    largest.map_or([&[], &[]], |turn| [&rows[..=turn], &rows[turn..]])
}

/// The value of a branch at a place, between its points along a straight line; `None` beyond them.
fn at(branch: &[(f64, f64)], place: f64) -> Option<f64> {
    let pairs = branch.windows(2);
    let mut hits = pairs.filter(|pair| {
        let (low, high) = (pair[0].0.min(pair[1].0), pair[0].0.max(pair[1].0));
        (low..=high).contains(&place) && low < high
    });
    let pair = hits.next()?;
    let part = (place - pair[0].0) / (pair[1].0 - pair[0].0);
    Some(pair[0].1 + part * (pair[1].1 - pair[0].1))
}

/// Place and value of the largest magnitude.
fn peak(rows: &[(f64, f64)]) -> Option<(f64, f64)> {
    rows.iter().copied().reduce(|best, row| if row.1.abs() > best.1.abs() { row } else { best })
}

fn area(rows: &[(f64, f64)]) -> f64 {
    rows.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum()
}

#[cfg(test)]
mod tests {
    use dashpot_dae::Panel;

    use super::*;

    fn sampled(value: impl Fn(f64) -> f64, times: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
        times.map(|time| (time, value(time))).collect()
    }

    /// 400 t (1 − t) from 0 to 1: the peak is 100 at 0.5.
    fn parabola() -> Signal {
        let coefficients = [50.0, 0.0, -50.0].into();
        Signal::new(vec![Panel { coefficients, ..Panel::constant(0.0, 1.0, 0.0) }], None, 0.0)
    }

    #[test]
    fn an_offset_is_the_deviation_on_the_clock_of_the_file() {
        // Uneven times, the last ones beyond the model, which begins at −0.25 on this clock.
        let times = (0..60).map(|at| f64::from(at * at) / 2048.0 - 0.25);
        let model = |time: f64| 400.0 * (time + 0.25) * (0.75 - time);
        let measured = sampled(|time| model(time) + 5.0, times);
        let own = Deviation::over_time(&measured, (&parabola(), (0.0, 1.0)), 0.25).unwrap();
        // The sample at 32² / 2048.
        assert_eq!(own.measured_peak, (0.25, 105.0));
        assert!((own.rms - 5.0 / 105.0).abs() < 1e-14, "{own:?}");
        assert!((own.peak() + 5.0).abs() < 1e-12 && own.place().abs() < 1e-9, "{own:?}");
        assert_eq!((own.rows, own.span), (46, (-0.25, 45.0 * 45.0 / 2048.0 - 0.25)));
        assert!(own.areas.is_none() && !own.is_opposed());
    }

    #[test]
    fn peaks_are_those_of_what_both_have_in_common() {
        let measured = [(0.0, 0.0), (0.125, -10.0), (0.25, -20.0)];
        let own = Deviation::over_time(&measured, (&parabola(), (0.0, 1.0)), 0.0).unwrap();
        assert_eq!((own.measured_peak, own.model_peak.0), ((0.25, -20.0), 0.25));
        assert!((own.model_peak.1 - 75.0).abs() < 1e-12 && own.is_opposed(), "{own:?}");
    }

    #[test]
    fn a_factor_of_a_loop_is_the_deviation_of_its_energy() {
        // Out along F = 1e5 y, back along 5e4 y.
        let around = |factor: f64, steps: i32| {
            let out = (0..=steps).map(|at| f64::from(at) / f64::from(steps) * 0.01);
            let back = (0..steps).rev().map(|at| f64::from(at) / f64::from(steps) * 0.01);
            let mut rows = sampled(|y| factor * 1e5 * y, out);
            let turn = (0.01, factor * 5e2);
            rows.push(turn);
            rows.extend(sampled(|y| factor * 5e4 * y, back));
            rows
        };
        let own = Deviation::of_loops(&around(1.1, 7), &around(1.0, 10)).unwrap();
        assert!((own.relative_peak() - (1.0 / 1.1 - 1.0)).abs() < 1e-14, "{own:?}");
        let [measured, model] = own.areas.unwrap();
        assert!((model - 2.5).abs() < 1e-14 && (measured - 2.75).abs() < 1e-14, "{own:?}");
        // The differences are 1e4 y out and 5e3 y back: their mean square is (1 + 1/4)/2·100²/3.
        let rms = (0.625 * 1e4 / 3.0_f64).sqrt() / 1100.0;
        assert!((own.rms - rms).abs() < 1e-12, "{} {rms}", own.rms);
    }

    #[test]
    fn nothing_in_common_has_no_deviation() {
        let measured = [(2.0, 1.0), (3.0, 2.0)];
        assert_eq!(Deviation::over_time(&measured, (&parabola(), (0.0, 1.0)), 0.0), None);
        assert_eq!(
            Deviation::over_time(&[(0.0, 0.0), (1.0, 0.0)], (&parabola(), (0.0, 1.0)), 0.0),
            None
        );
        assert_eq!(Deviation::of_loops(&[(0.0, 0.0), (1.0, 0.0)], &measured), None);
    }
}
