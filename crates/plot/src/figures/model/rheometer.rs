//! What a model answers to a protocol of a rheometer, over time.

use crate::figures::unit::{self, Unit};
use crate::{Chart, Direction, Pattern, ReferenceLine, Series, Stroke};

/// The answer to one protocol: from the model's formulas and from a simulation of its network, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct RheometerSeries {
    /// Heading, as in `Load, hold, unload`.
    pub title: String,
    /// What is measured.
    pub measured: Measured,
    /// Answer of the model: (time \[s\], value), ascending in time.
    pub model: Vec<(f64, f64)>,
    /// Answer of the simulated network: (time \[s\], value), ascending in time; empty if there is none.
    pub simulated: Vec<(f64, f64)>,
    /// Values worth a line, such as the strain that remains.
    pub levels: Vec<RheometerLine>,
    /// Times \[s\] worth a line, such as that of unloading.
    pub instants: Vec<RheometerLine>,
}

/// The quantity that answers a protocol.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Measured {
    /// Force of a pad \[N\].
    Force,
    /// Deformation of a pad \[m\].
    Deformation,
    /// Stress of a material \[Pa\].
    Stress,
    /// Strain of a material \[1\].
    Strain,
}

/// A value or a time with a text.
#[derive(Debug, Clone, PartialEq)]
pub struct RheometerLine {
    /// The value or time, in SI units.
    pub at: f64,
    /// Text at the line, as in `ε3, remains: 0.6 mm`.
    pub label: String,
}

impl RheometerSeries {
    /// The chart: the model broad and pale, the simulation dashed on top of it.
    pub fn chart(&self) -> Chart {
        let points = || self.model.iter().chain(&self.simulated);
        let x = Unit::of(&unit::TIME, points().map(|p| p.0));
        let values = || points().map(|p| p.1);
        let (quantity, y) = match self.measured {
            Measured::Force => ("force", Unit::of(&unit::FORCE, values())),
            Measured::Deformation => ("deformation", Unit::of(&unit::LENGTH, values())),
            Measured::Stress => ("stress", Unit::of(&unit::STRESS, values())),
            Measured::Strain => ("strain", Unit::of(&unit::STRAIN, values())),
        };
        let alone = self.simulated.is_empty();
        let first = if alone { Pattern::Solid } else { Pattern::Broad };
        let curves = [
            ("model", &self.model, first),
            ("simulated network", &self.simulated, Pattern::Dashed),
        ];
        let series = curves.into_iter().enumerate().filter(|(_, curve)| !curve.1.is_empty());
        let series = series.map(|(colour, (name, points, pattern))| Series {
            name: name.into(),
            points: points.iter().map(|p| (p.0 / x.factor, p.1 / y.factor)).collect(),
            stroke: Some(Stroke { colour, pattern }),
        });
        let line = |direction, factor: f64| {
            move |line: &RheometerLine| ReferenceLine {
                direction,
                at: line.at / factor,
                label: line.label.clone(),
                colour: None,
            }
        };
        let levels = self.levels.iter().map(line(Direction::Horizontal, y.factor));
        let instants = self.instants.iter().map(line(Direction::Vertical, x.factor));
        Chart {
            title: self.title.clone(),
            x_label: x.label("time"),
            y_label: y.label(quantity),
            series: series.collect(),
            lines: levels.chain(instants).collect(),
            ..Chart::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_lines_are_in_the_units_of_the_axes() {
        let line = |at, label: &str| vec![RheometerLine { at, label: label.into() }];
        let chart = RheometerSeries {
            title: "Load, hold, unload".into(),
            measured: Measured::Strain,
            model: vec![(0.0, 0.0), (100.0, 0.05)],
            simulated: Vec::new(),
            levels: line(0.02, "ε3"),
            instants: line(50.0, "unloaded"),
        }
        .chart();
        assert_eq!((chart.x_label.as_str(), chart.y_label.as_str()), ("time (s)", "strain (%)"));
        assert_eq!(chart.series.len(), 1);
        assert_eq!(chart.series[0].points, [(0.0, 0.0), (100.0, 5.0)]);
        assert_eq!((chart.lines[0].at, chart.lines[0].direction), (2.0, Direction::Horizontal));
        assert_eq!((chart.lines[1].at, chart.lines[1].direction), (50.0, Direction::Vertical));
    }
}
