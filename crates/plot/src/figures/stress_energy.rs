//! The stress–energy method: dynamic stress over dynamic energy of many drops, and what they are taken for.

use crate::{Chart, Pattern, Scale, Series};

/// Drops as the stress–energy method sees them, in the units of the axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressEnergySeries {
    /// A remark below; empty for none.
    pub note: String,
    /// Dynamic energy \[kJ/m³\] and dynamic stress \[kPa\] of each drop.
    pub points: Vec<(f64, f64)>,
    /// The smooth curve about which they scatter, rising in the energy.
    pub smooth: Vec<(f64, f64)>,
    /// The exponential of the method.
    pub exponential: Vec<(f64, f64)>,
}

impl StressEnergySeries {
    /// The chart: the stress on a logarithmic axis, on which the exponential is a straight line.
    pub fn chart(&self) -> Chart {
        let series = vec![
            Series::drawn("drops", (0, Pattern::Points), self.points.clone()),
            Series::drawn("one smooth curve", (0, Pattern::Solid), self.smooth.clone()),
            Series::drawn("a e^(b x)", (1, Pattern::Dashed), self.exponential.clone()),
        ];
        Chart {
            title: "Stress–energy method".into(),
            note: self.note.clone(),
            x_label: "dynamic energy σ h/t (kJ/m³)".into(),
            y_label: "dynamic stress G σ (kPa)".into(),
            y_scale: Scale::logarithmic(""),
            series,
            ..Chart::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drops_are_discs_beside_both_curves() {
        let law = |x: f64| (x, 20.0 * (0.1 * x).exp());
        let points: Vec<(f64, f64)> = [1.0, 5.0, 20.0].map(law).to_vec();
        let own = StressEnergySeries {
            note: "scatters by 3 %".into(),
            points: points.clone(),
            smooth: points.clone(),
            exponential: points,
        };
        let svg = own.chart().svg().unwrap();
        for text in ["dynamic energy", "dynamic stress", "one smooth curve", "scatters by 3 %"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(svg.matches("<circle").count() >= 3, "{svg}");
    }
}
