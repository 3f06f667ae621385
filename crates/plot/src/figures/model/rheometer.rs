//! What a model answers to a protocol of a rheometer, over time.

use crate::figures::unit::{self, Unit};
use crate::{Chart, Direction, Pattern, ReferenceLine, Scale, Series};

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
    /// The chart: the model broad and pale, the simulation dashed on top of it. Times that stand at equal ratios over
    /// decades are laid out so, and with them values that span decades.
    pub fn chart(&self) -> Chart {
        let points = || self.model.iter().chain(&self.simulated);
        let values = || points().map(|p| p.1);
        let is_logarithmic = are_of_decades(&self.model) || are_of_decades(&self.simulated);
        let positive = values().filter(|own| *own != 0.0);
        let y_scale = if is_logarithmic { Scale::suiting(positive) } else { Scale::Linear };
        let x = Axis::of("time", "s", &unit::TIME, points().map(|p| p.0), is_logarithmic);
        let is_logarithmic = y_scale != Scale::Linear;
        let of = |word, si, units| Axis::of(word, si, units, values(), is_logarithmic);
        let y = match self.measured {
            Measured::Force => of("force", "N", &unit::FORCE),
            Measured::Deformation => of("deformation", "m", &unit::LENGTH),
            Measured::Stress => of("stress", "Pa", &unit::STRESS),
            Measured::Strain => of("strain", "", &unit::STRAIN),
        };
        let alone = self.simulated.is_empty();
        let first = if alone { Pattern::Solid } else { Pattern::Broad };
        let curves = [
            ("model", &self.model, first),
            ("simulated network", &self.simulated, Pattern::Dashed),
        ];
        let series = curves.into_iter().enumerate().filter(|(_, curve)| !curve.1.is_empty());
        let series = series.map(|(colour, (name, points, pattern))| {
            let points = points.iter().map(|p| (p.0 / x.factor, p.1 / y.factor));
            Series::drawn(name, (colour, pattern), points)
        });
        let line = |direction, factor: f64| {
            move |own: &RheometerLine| ReferenceLine::new(direction, own.at / factor, &own.label)
        };
        let levels = self.levels.iter().map(line(Direction::Horizontal, y.factor));
        let instants = self.instants.iter().map(line(Direction::Vertical, x.factor));
        Chart {
            title: self.title.clone(),
            x_label: x.label,
            y_label: y.label,
            x_scale: x.scale,
            y_scale: y.scale,
            series: series.collect(),
            lines: levels.chain(instants).collect(),
            ..Chart::default()
        }
    }
}

/// How one axis is laid out.
struct Axis {
    label: String,
    scale: Scale,
    /// SI units in one of the axis.
    factor: f64,
}

impl Axis {
    /// An axis in one of `units`, or a logarithmic one in the SI unit.
    fn of(
        word: &str,
        si: &str,
        units: &'static [Unit],
        values: impl Iterator<Item = f64>,
        is_logarithmic: bool,
    ) -> Self {
        if is_logarithmic {
            return Self { label: word.into(), scale: Scale::logarithmic(si), factor: 1.0 };
        }
        let unit = Unit::of(units, values);
        Self { label: unit.label(word), scale: Scale::Linear, factor: unit.factor }
    }
}

/// Whether times after zero span two decades, most of them in the first tenth.
fn are_of_decades(points: &[(f64, f64)]) -> bool {
    let times: Vec<f64> = points.iter().map(|own| own.0).filter(|own| *own > 0.0).collect();
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return false };
    let early = times.iter().filter(|own| **own < 0.1 * last).count();
    *last >= 100.0 * first && 2 * early > times.len()
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

    #[test]
    fn times_over_decades_are_laid_out_by_their_ratios_and_even_ones_by_differences() {
        let chart = |time: &dyn Fn(i32) -> f64, decay: f64| {
            let series = RheometerSeries {
                title: "Relaxation".into(),
                measured: Measured::Force,
                model: (0..=60).map(|at| (time(at), 1e3 * (-decay * time(at)).exp())).collect(),
                simulated: Vec::new(),
                levels: Vec::new(),
                instants: Vec::new(),
            };
            series.chart()
        };
        let ratios = |at: i32| 1e-4 * 10_f64.powf(f64::from(at) / 12.0);
        let slow = chart(&ratios, 0.1);
        assert_eq!((slow.x_scale, slow.y_scale), (Scale::logarithmic("s"), Scale::Linear));
        assert_eq!((slow.x_label.as_str(), slow.y_label.as_str()), ("time", "force (kN)"));
        assert!((slow.series[0].points[0].0 / 1e-4 - 1.0).abs() < 1e-12);
        let quick = chart(&ratios, 1.0);
        assert_eq!(quick.y_scale, Scale::logarithmic("N"));
        let last = quick.series[0].points[60].1;
        assert!((last / (1e3 * (-10.0_f64).exp()) - 1.0).abs() < 1e-9, "{last}");
        let even = chart(&|at| f64::from(at), 1.0);
        assert_eq!((even.x_scale, even.y_scale), (Scale::Linear, Scale::Linear));
    }
}
