//! Figures of what accuracy costs: error against time, and against work.

use crate::{Chart, Pattern, Scale, Series};

/// What several methods reach at falling tolerances.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PrecisionSeries {
    /// Heading, as in `Largest error of any measure`.
    pub title: String,
    /// A remark below it.
    pub note: String,
    /// One curve per method.
    pub curves: Vec<PrecisionCurve>,
}

/// What one method reaches, by its tolerances.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PrecisionCurve {
    /// The method.
    pub name: String,
    /// Time that each solution takes \[s\].
    pub time: Vec<f64>,
    /// Its evaluations of the right-hand side; 0 for a method that makes none, which has no place in
    /// the figure of work.
    pub work: Vec<f64>,
    /// Its relative error \[1\]; what is not finite or is zero is a gap.
    pub error: Vec<f64>,
}

impl PrecisionSeries {
    /// Error over time, both logarithmic, with a disc for each solution.
    pub fn time_chart(&self) -> Chart {
        let x_scale = Scale::logarithmic("s");
        Chart { x_label: "time".into(), x_scale, ..self.chart(|own| &own.time) }
    }

    /// Error over evaluations of the right-hand side, both logarithmic, with a disc for each solution.
    pub fn work_chart(&self) -> Chart {
        let x_label = "evaluations of the right-hand side".into();
        Chart { x_label, x_scale: Scale::logarithmic(""), ..self.chart(|own| &own.work) }
    }

    fn chart(&self, along: impl Fn(&PrecisionCurve) -> &Vec<f64>) -> Chart {
        let mut series = Vec::new();
        for (colour, own) in self.curves.iter().enumerate() {
            let points = along(own).iter().copied().zip(own.error.iter().copied());
            let stroke = (colour, Pattern::Solid);
            // A point between gaps is a disc; without a name it has no entry in the legend.
            let gap = (f64::NAN, f64::NAN);
            let discs = Series::drawn("", stroke, points.clone().flat_map(|point| [point, gap]));
            series.extend([Series::drawn(&own.name, stroke, points), discs]);
        }
        Chart {
            title: self.title.clone(),
            note: self.note.clone(),
            y_label: "relative error".into(),
            y_scale: Scale::logarithmic(""),
            series,
            ..Chart::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::well_formed::assert_well_formed;

    fn series() -> PrecisionSeries {
        let curve = |name: &str, work: Vec<f64>| PrecisionCurve {
            name: name.into(),
            time: vec![1e-4, 3e-4, 2e-3],
            work,
            error: vec![1e-2, 1e-4, 1e-7],
        };
        let curves = vec![curve("bdf", vec![100.0, 300.0, 900.0]), curve("exact", vec![0.0; 3])];
        PrecisionSeries { title: "Peak force <&>".into(), note: String::new(), curves }
    }

    #[test]
    fn each_solution_is_a_disc_on_the_line_of_its_method() {
        let svg = series().time_chart().svg().unwrap();
        assert_well_formed(&svg);
        assert_eq!(svg.matches("<circle").count(), 6);
        assert!(svg.contains("bdf") && svg.contains("exact") && svg.contains("relative error"));
        assert!(!svg.contains("exact = bdf"), "discs and lines are not the same curve");
    }

    #[test]
    fn what_makes_no_evaluations_has_no_place_in_the_figure_of_work() {
        let svg = series().work_chart().svg().unwrap();
        assert_well_formed(&svg);
        assert_eq!(svg.matches("<circle").count(), 3);
    }

    #[test]
    fn nothing_at_all_is_drawn_too() {
        assert_well_formed(&PrecisionSeries::default().time_chart().svg().unwrap());
    }
}
