//! What a shaken network passes on, over frequency.

use crate::{Chart, Direction, Marker, ReferenceLine, Scale, Series};

/// Curves beyond these in one figure cannot be told apart.
const MOST_CURVES: usize = 6;
/// An angle and the next one are further apart than this where the curve leaves at one edge and comes in at the other.
const TURN: f64 = 180.0;

/// Responses to a harmonic drive over frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct VibrationSeries {
    /// Heading, as in `Transmissibility from floor`.
    pub title: String,
    /// What is shown, as `transmissibility`.
    pub quantity: String,
    /// Unit of the ratios without prefix; empty for none.
    pub unit: String,
    /// One curve for each node, support or element.
    pub curves: Vec<VibrationCurve>,
}

/// The response of one node, support or element.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct VibrationCurve {
    /// Name.
    pub name: String,
    /// Frequencies \[Hz\], ascending.
    pub frequency: Vec<f64>,
    /// Ratio to the drive at each frequency; what is not finite is a gap.
    pub ratio: Vec<f64>,
    /// Phase \[°\] at each frequency, from −180 to 180.
    pub phase: Vec<f64>,
    /// Peaks: frequency \[Hz\], ratio, and text.
    pub peaks: Vec<(f64, f64, String)>,
}

impl VibrationSeries {
    /// The ratio over frequency, both logarithmic; where it has no unit with a line at 1: above it the drive is amplified.
    pub fn ratio_chart(&self) -> Chart {
        let marker =
            |(x, y, label): &(f64, f64, String)| Marker { x: *x, y: *y, label: label.clone() };
        let line = self
            .unit
            .is_empty()
            .then(|| ReferenceLine::new(Direction::Horizontal, 1.0, "as driven"));
        Chart {
            y_label: self.quantity.clone(),
            y_scale: Scale::logarithmic(&self.unit),
            series: self.series(|own| own.ratio.clone()),
            markers: self.shown().flat_map(|own| &own.peaks).map(marker).collect(),
            lines: line.into_iter().collect(),
            ..self.frame()
        }
    }

    /// The phase over the logarithm of the frequency.
    pub fn phase_chart(&self) -> Chart {
        Chart {
            y_label: "phase (°)".into(),
            series: self.series(|own| unbroken(&own.phase)),
            ..self.frame()
        }
    }

    fn frame(&self) -> Chart {
        let more = self.curves.len() > MOST_CURVES;
        let note = format!("the first {MOST_CURVES} of {} curves", self.curves.len());
        Chart {
            title: self.title.clone(),
            note: if more { note } else { String::new() },
            x_label: "frequency".into(),
            x_scale: Scale::logarithmic("Hz"),
            ..Chart::default()
        }
    }

    fn shown(&self) -> impl Iterator<Item = &VibrationCurve> {
        self.curves.iter().take(MOST_CURVES)
    }

    fn series(&self, values: impl Fn(&VibrationCurve) -> Vec<f64>) -> Vec<Series> {
        let one = |vibration_curve: &VibrationCurve| {
            let points =
                vibration_curve.frequency.iter().copied().zip(values(vibration_curve)).collect();
            Series::new(vibration_curve.name.clone(), points)
        };
        self.shown().map(one).collect()
    }
}

/// The phase without leaps of a whole turn, as a curve that is drawn through.
fn unbroken(phase: &[f64]) -> Vec<f64> {
    let (mut turns, mut last) = (0.0, f64::NAN);
    let mut follow = |own: f64| {
        if own - last > TURN {
            turns -= 2.0 * TURN;
        } else if last - own > TURN {
            turns += 2.0 * TURN;
        }
        if own.is_finite() {
            last = own;
        }
        own + turns
    };
    phase.iter().map(|own| follow(*own)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series() -> VibrationSeries {
        let curve = VibrationCurve {
            name: "device".into(),
            frequency: vec![1.0, 10.0, 100.0],
            ratio: vec![1.0, 5.0, 0.01],
            phase: vec![0.0, -90.0, 179.0],
            peaks: vec![(10.0, 5.0, "5 at 10 Hz".into())],
        };
        VibrationSeries {
            title: "Transmissibility from floor".into(),
            quantity: "transmissibility".into(),
            unit: String::new(),
            curves: vec![curve],
        }
    }

    #[test]
    fn both_axes_of_the_ratio_are_logarithmic_and_peaks_have_their_text() {
        let chart = series().ratio_chart();
        assert_eq!(chart.x_scale, Scale::logarithmic("Hz"));
        assert_eq!(chart.series[0].points, [(1.0, 1.0), (10.0, 5.0), (100.0, 0.01)]);
        let svg = chart.svg().unwrap();
        assert!(svg.contains("5 at 10 Hz") && svg.contains("transmissibility"));
    }

    #[test]
    fn ratio_with_a_unit_has_no_line_at_one() {
        let of = |unit: &str| VibrationSeries { unit: unit.into(), ..series() }.ratio_chart();
        assert_eq!((of("").lines.len(), of("kg").lines.len()), (1, 0));
        assert!(of("kg").svg().unwrap().contains("transmissibility (kg)"));
    }

    #[test]
    fn the_phase_runs_on_over_half_a_turn() {
        let chart = series().phase_chart();
        let phase: Vec<f64> = chart.series[0].points.iter().map(|point| point.1).collect();
        assert_eq!(phase, [0.0, -90.0, -181.0]);
        assert_eq!(unbroken(&[170.0, f64::NAN, -170.0])[2..], [190.0]);
    }

    #[test]
    fn more_curves_than_can_be_told_apart_are_left_out_with_a_remark() {
        let mut many = series();
        many.curves = vec![many.curves[0].clone(); 9];
        let chart = many.ratio_chart();
        assert_eq!((chart.series.len(), chart.note.as_str()), (6, "the first 6 of 9 curves"));
    }
}
