//! Loops of loading and unloading: force over deformation, or stress over strain.

use super::ModelSubject;
use crate::{
    Chart, Pattern, Series,
    figures::unit::{self, Unit},
    theme::COLOURS,
};

/// Loops of one model that was loaded and unloaded, at several rates for instance.
#[derive(Debug, Clone, PartialEq)]
pub struct LoopSeries {
    /// Heading, as in `Force over deformation`.
    pub title: String,
    /// What the model stands for.
    pub subject: ModelSubject,
    /// The loops, in the order of the legend.
    pub loops: Vec<Loop>,
    /// A measured loop, dotted over all others.
    pub measured: Option<Loop>,
}

/// One loop.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// Name in the legend, as in `rate 10 mm/s`.
    pub name: String,
    /// (Deformation \[m\], force \[N\]) or (strain \[1\], stress \[Pa\]), as they follow in time.
    pub points: Vec<(f64, f64)>,
}

/// Patterns of loops, in turn once their colours are used up.
const PATTERNS: [Pattern; 3] = [Pattern::Solid, Pattern::Dashed, Pattern::Dotted];

impl LoopSeries {
    /// The chart: each loop as it is run through.
    pub fn chart(&self) -> Chart {
        let points = || self.loops.iter().chain(&self.measured).flat_map(|own| &own.points);
        let (xs, ys) = (|| points().map(|p| p.0), || points().map(|p| p.1));
        let (x, y, words) = match self.subject {
            ModelSubject::Pad => (
                Unit::of(&unit::LENGTH, xs()),
                Unit::of(&unit::FORCE, ys()),
                ("deformation", "force"),
            ),
            ModelSubject::Material => {
                (Unit::of(&unit::STRAIN, xs()), Unit::of(&unit::STRESS, ys()), ("strain", "stress"))
            }
        };
        let one = |own: &Loop, colour: usize, pattern: Pattern| {
            let points = own.points.iter().map(|p| (p.0 / x.factor, p.1 / y.factor));
            Series::drawn(&own.name, (colour, pattern), points)
        };
        let pattern = |at: usize| PATTERNS[at / COLOURS % PATTERNS.len()];
        let loops = self.loops.iter().enumerate();
        let mut series: Vec<Series> = loops.map(|(at, own)| one(own, at, pattern(at))).collect();
        series
            .extend(self.measured.iter().map(|own| one(own, self.loops.len(), Pattern::Measured)));
        Chart {
            title: self.title.clone(),
            x_label: x.label(words.0),
            y_label: y.label(words.1),
            family: if self.loops.len() > 1 { self.loops.len() } else { 0 },
            series,
            has_arrows: true,
            ..Chart::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_in_the_units_of_the_axes_and_in_their_order() {
        let own = |name: &str, peak| Loop {
            name: name.into(),
            points: vec![(0.0, 0.0), (0.01, peak), (0.002, 0.0)],
        };
        let loops = LoopSeries {
            title: "Force over deformation".into(),
            subject: ModelSubject::Pad,
            loops: vec![own("slow", 1e3), own("fast", 2e3)],
            measured: Some(own("measured", 1.5e3)),
        };
        let chart = loops.chart();
        assert_eq!(
            (chart.x_label.as_str(), chart.y_label.as_str()),
            ("deformation (mm)", "force (kN)")
        );
        assert_eq!(chart.series[1].points, [(0.0, 0.0), (10.0, 2.0), (2.0, 0.0)]);
        assert_ne!(chart.series[0].stroke, chart.series[1].stroke);
        assert_eq!(chart.series[2].stroke.map(|own| own.pattern), Some(Pattern::Measured));
    }
}
