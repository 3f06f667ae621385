//! Figures of fits: what was measured, the fitted model with the band of its uncertainty over it, and under both what
//! is left of the rows.

use super::unit::{self, Unit};
use crate::{Chart, Direction, Pattern, ReferenceLine, Scale, Series};

/// Every figure of fits. **A new one is registered here.**
pub const FIT_FIGURES: &[FitFigure] = &[HISTORY, RELAXATION, CREEP, OSCILLATION];

/// What answered over time, to an impact or to a history of its own.
pub const HISTORY: FitFigure = FitFigure { name: "history", x: ("time", "s"), is_slow: false };

/// A modulus after a step over the logarithm of time, with the lines of the branches.
pub const RELAXATION: FitFigure = FitFigure { name: "relaxation", x: ("time", "s"), is_slow: true };

/// A compliance after a step over the logarithm of time, with the lines of the branches.
pub const CREEP: FitFigure = FitFigure { name: "creep", x: ("time", "s"), is_slow: true };

/// Storage and loss over the logarithm of the frequency, with the lines of the branches.
pub const OSCILLATION: FitFigure =
    FitFigure { name: "oscillation", x: ("frequency", "Hz"), is_slow: true };

/// Rows beyond these are drawn as a line, as discs would hide each other.
const MOST_DISCS: usize = 150;
/// A history is shown where the model is this part of its largest change off its beginning,
const LEVEL: f64 = 0.03;
/// and this part of that span before and behind.
const AROUND: f64 = 0.35;
/// Colours of the channels, of the nearest network and of branches.
const CHANNELS: [usize; 2] = [0, 2];
const FLOOR: usize = 3;
const BRANCHES: usize = 1;

/// A figure drawn from one record and what was fitted to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FitFigure {
    /// Name in files, as in `oscillation`.
    pub name: &'static str,
    /// Quantity and unit along the horizontal axis.
    x: (&'static str, &'static str),
    /// Whether it goes over decades: both axes are logarithmic, and what is left stands in parts of the rows.
    is_slow: bool,
}

/// What a record measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitQuantity {
    /// \[N\].
    Force,
    /// \[m\].
    Deformation,
    /// \[m/s²\].
    Acceleration,
    /// \[m/s\].
    Velocity,
    /// \[Pa\].
    Stress,
    /// \[1\].
    Strain,
    /// \[Pa\].
    Modulus,
    /// \[N/m\].
    Stiffness,
    /// \[1/Pa\].
    Compliance,
    /// \[m/N\].
    PadCompliance,
}

impl FitQuantity {
    fn word(self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::Deformation => "deformation",
            Self::Acceleration => "acceleration",
            Self::Velocity => "velocity",
            Self::Stress => "stress",
            Self::Strain => "strain",
            Self::Modulus => "modulus",
            Self::Stiffness => "stiffness",
            Self::Compliance | Self::PadCompliance => "compliance",
        }
    }

    /// Its SI unit, for logarithmic axes.
    fn si(self) -> &'static str {
        match self {
            Self::Modulus => "Pa",
            Self::Stiffness => "N/m",
            Self::Compliance => "1/Pa",
            Self::PadCompliance => "m/N",
            _ => "",
        }
    }

    /// The unit in which such values are shown on a linear axis.
    fn unit(self, values: impl Iterator<Item = f64>) -> Unit {
        let units: &[Unit] = match self {
            Self::Force => &unit::FORCE,
            Self::Deformation => &unit::LENGTH,
            Self::Acceleration => &unit::ACCELERATION,
            Self::Velocity => &unit::VELOCITY,
            Self::Strain => &unit::STRAIN,
            _ => &unit::STRESS,
        };
        Unit::of(units, values)
    }
}

/// A row of a record, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FitRow {
    /// Time \[s\] or frequency \[Hz\].
    pub x: f64,
    /// What was measured.
    pub measured: f64,
    /// What the fitted model says.
    pub model: f64,
    /// Half of the band that the uncertainty of the fit gives to it.
    pub half: Option<f64>,
    /// What the nearest of all passive networks says.
    pub floor: Option<f64>,
}

/// Rows of one kind.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FitChannel {
    /// What tells it from others of the record, as in `storage`; empty where it is alone.
    pub name: &'static str,
    /// The rows, rising in time or frequency.
    pub rows: Vec<FitRow>,
}

/// A record and what was fitted to it.
#[derive(Debug, Clone, PartialEq)]
pub struct FitSeries {
    /// Heading, as in `head.acceleration, low.csv`.
    pub title: String,
    /// A remark below; empty for none.
    pub note: String,
    /// What it measures.
    pub quantity: FitQuantity,
    /// Its channels.
    pub channels: Vec<FitChannel>,
    /// Where the branches of the fitted spectrum are along the horizontal axis, and their strengths.
    pub branches: Vec<(f64, f64)>,
}

impl FitFigure {
    /// The chart: the record with the model over it, and what is left below.
    pub fn chart(&self, own: &FitSeries) -> Chart {
        let shown = if self.is_slow { own.channels.clone() } else { around_the_event(own) };
        let is_cut = shown.iter().zip(&own.channels).any(|(a, b)| a.rows.len() < b.rows.len());
        let rows = || shown.iter().flat_map(|own| &own.rows);
        let [x, y] = self.units(own.quantity, rows);
        let mut series = Vec::new();
        let mut left = Vec::new();
        for (at, channel) in shown.iter().enumerate() {
            let colour = CHANNELS[at % CHANNELS.len()];
            series.extend(overlay(channel, colour, (x.0, y.0), at == 0));
            left.extend(self.left(channel, colour, (x.0, y.0)));
        }
        if self.is_slow && !own.branches.is_empty() {
            let stroke = (BRANCHES, Pattern::Stems);
            series.push(Series::drawn("branches", stroke, own.branches.clone()));
        }
        let scale = |unit| if self.is_slow { Scale::logarithmic(unit) } else { Scale::Linear };
        let whole = is_cut.then(|| "the event; the record is longer".to_owned());
        let notes = [Some(own.note.clone()), whole].into_iter().flatten();
        let notes: Vec<String> = notes.filter(|own| !own.is_empty()).collect();
        let below = Chart {
            y_label: if self.is_slow { "left (%)".to_owned() } else { format!("left ({})", y.2) },
            x_scale: scale(self.x.1),
            lines: vec![ReferenceLine::new(Direction::Horizontal, 0.0, "")],
            series: left,
            ..Chart::default()
        };
        Chart {
            title: own.title.clone(),
            note: notes.join("; "),
            x_label: x.1,
            y_label: y.1,
            x_scale: scale(self.x.1),
            y_scale: scale(own.quantity.si()),
            series,
            below: Some(Box::new(below)),
            ..Chart::default()
        }
    }

    /// What one unit of each axis is in SI units, its label, and the symbol of its unit.
    fn units<'r, R: Iterator<Item = &'r FitRow>>(
        &self,
        quantity: FitQuantity,
        rows: impl Fn() -> R,
    ) -> [(f64, String, &'static str); 2] {
        if self.is_slow {
            let plain = |word: &str| (1.0, word.to_owned(), "");
            return [plain(self.x.0), plain(quantity.word())];
        }
        let x = Unit::of(&unit::TIME, rows().map(|own| own.x));
        let y = quantity.unit(rows().flat_map(|own| [own.measured, own.model]));
        let of = |own: Unit, word: &str| (own.factor, own.label(word), own.symbol());
        [of(x, self.x.0), of(y, quantity.word())]
    }

    /// What is left of the rows: the model less them, and the same of the nearest network.
    fn left(&self, channel: &FitChannel, colour: usize, (x, y): (f64, f64)) -> Vec<Series> {
        let part = |own: &FitRow, value: f64| {
            let left = value - own.measured;
            if self.is_slow { 100.0 * left / own.measured } else { left / y }
        };
        let line = |of: &dyn Fn(&FitRow) -> f64, colour, pattern| {
            let points = channel.rows.iter().map(|own| (own.x / x, of(own)));
            Series::drawn("", (colour, pattern), points)
        };
        let half = |own: &FitRow| own.half.unwrap_or(f64::NAN);
        let band = channel.rows.iter().map(|own| {
            let [low, high] = [-1.0, 1.0].map(|sign| part(own, own.measured + sign * half(own)));
            (own.x / x, low, high)
        });
        let has_band = channel.rows.iter().any(|own| own.half.is_some());
        let has_floor = channel.rows.iter().any(|own| own.floor.is_some());
        let band = has_band.then(|| Series::band("", colour, band));
        let floor = |own: &FitRow| part(own, own.floor.unwrap_or(f64::NAN));
        let floor = has_floor.then(|| line(&floor, FLOOR, Pattern::Dotted));
        let model = line(&|own| part(own, own.model), colour, Pattern::Solid);
        band.into_iter().chain([model]).chain(floor).collect()
    }
}

/// The curves of a channel, in these units; what looks alike in all channels has its name in the first one.
fn overlay(channel: &FitChannel, colour: usize, (x, y): (f64, f64), is_first: bool) -> Vec<Series> {
    let rows = &channel.rows;
    let named = |text: &str| {
        if channel.name.is_empty() { text.to_owned() } else { format!("{}, {text}", channel.name) }
    };
    let once = |text: &str| if is_first { text.to_owned() } else { String::new() };
    let line = |name: String, of: &dyn Fn(&FitRow) -> f64, colour, pattern| {
        Series::drawn(name, (colour, pattern), rows.iter().map(|own| (own.x / x, of(own) / y)))
    };
    let band = rows.iter().map(|own| {
        let half = own.half.unwrap_or(f64::NAN);
        (own.x / x, (own.model - half) / y, (own.model + half) / y)
    });
    let has_band = rows.iter().any(|own| own.half.is_some());
    let is_few = rows.len() <= MOST_DISCS;
    let measured = if is_few { Pattern::Points } else { Pattern::Measured };
    let floor = rows.iter().any(|own| own.floor.is_some()).then(|| {
        let of = |own: &FitRow| own.floor.unwrap_or(f64::NAN);
        line(once("nearest network"), &of, FLOOR, Pattern::Dotted)
    });
    let model = line(named("fitted"), &|own| own.model, colour, Pattern::Solid);
    let measured = line(once("measured"), &|own| own.measured, colour, measured);
    let band = has_band.then(|| Series::band(named("95 % band"), colour, band));
    // Discs stay visible under a line; a dotted line does so over it.
    let both = if is_few { [measured, model] } else { [model, measured] };
    band.into_iter().chain(both).chain(floor).collect()
}

/// The rows at which something happens, and some before and behind.
fn around_the_event(own: &FitSeries) -> Vec<FitChannel> {
    let span = |channel: &FitChannel| {
        let first = channel.rows.first()?.model;
        let off = |row: &FitRow| (row.model - first).abs();
        let largest = channel.rows.iter().map(off).fold(0.0, f64::max);
        let is_there = |row: &&FitRow| off(row) > LEVEL * largest;
        let from = channel.rows.iter().find(is_there)?.x;
        let to = channel.rows.iter().rev().find(is_there)?.x;
        let around = AROUND * (to - from);
        Some((from - around, to + around))
    };
    let each = own.channels.iter().map(|channel| {
        let Some((from, to)) = span(channel) else { return channel.clone() };
        let rows = channel.rows.iter().filter(|row| (from..=to).contains(&row.x));
        FitChannel { rows: rows.copied().collect(), ..*channel }
    });
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::well_formed::assert_well_formed;

    fn drop() -> FitSeries {
        let row = |at: i32| {
            let x = f64::from(at) * 1e-4;
            let model = if (0.02..0.04).contains(&x) { 1e3 * ((x - 0.02) / 0.02) } else { 0.0 };
            FitRow { x, measured: model + 5.0, model, half: Some(20.0), floor: None }
        };
        let rows = (0..1000).map(row).collect();
        FitSeries {
            title: "pad.force, low.csv".into(),
            note: String::new(),
            quantity: FitQuantity::Force,
            channels: vec![FitChannel { name: "", rows }],
            branches: Vec::new(),
        }
    }

    #[test]
    fn a_drop_is_shown_around_its_event_with_its_band_and_what_is_left() {
        let chart = HISTORY.chart(&drop());
        let names: Vec<&str> = chart.series.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["95 % band", "fitted", "measured"]);
        assert_eq!((chart.x_label.as_str(), chart.y_label.as_str()), ("time (ms)", "force (kN)"));
        let fitted = &chart.series[1].points;
        let (first, last) = (fitted[0].0, fitted[fitted.len() - 1].0);
        assert!(first > 10.0 && first < 20.0 && last > 40.0 && last < 50.0, "{first} {last}");
        assert!(chart.note.contains("the record is longer"));
        let below = chart.below.as_ref().unwrap();
        assert_eq!(below.y_label, "left (kN)");
        let left = &below.series[1].points;
        assert!(left.iter().all(|own| (own.1 + 5e-3).abs() < 1e-12));
        assert_well_formed(&chart.svg().unwrap());
    }

    #[test]
    fn an_oscillation_has_both_channels_its_branches_and_what_is_left_in_parts() {
        let channel = |name, factor: f64| {
            let row = |at: i32| {
                let x = 10_f64.powi(at);
                let measured = factor * x;
                let (model, floor) = (1.01 * measured, Some(1.002 * measured));
                FitRow { x, measured, model, half: None, floor }
            };
            FitChannel { name, rows: (-3..4).map(row).collect() }
        };
        let own = FitSeries {
            title: "gel".into(),
            note: "no network comes nearer than 0.2 % rms".into(),
            quantity: FitQuantity::Modulus,
            channels: vec![channel("storage", 1e6), channel("loss", 1e5)],
            branches: vec![(1.0, 1e5), (10.0, 1e6)],
        };
        let chart = OSCILLATION.chart(&own);
        let names: Vec<&str> = chart.series.iter().map(|own| own.name.as_str()).collect();
        let expected = ["measured", "storage, fitted", "nearest network", "", "loss, fitted", ""];
        assert_eq!(names[..6], expected);
        assert_eq!(names[6..], ["branches"]);
        assert_eq!(chart.series[6].stroke.map(|own| own.pattern), Some(Pattern::Stems));
        let below = chart.below.as_ref().unwrap();
        assert!(below.series[0].points.iter().all(|own| (own.1 - 1.0).abs() < 1e-9));
        assert!(below.series[1].points.iter().all(|own| (own.1 - 0.2).abs() < 1e-9));
        assert_well_formed(&chart.svg().unwrap());
    }

    #[test]
    fn names_are_unique_and_every_figure_draws_from_nothing() {
        for (at, figure) in FIT_FIGURES.iter().enumerate() {
            assert!(FIT_FIGURES[..at].iter().all(|other| other.name != figure.name));
            let own = FitSeries { channels: Vec::new(), ..drop() };
            assert_well_formed(&figure.chart(&own).svg().unwrap());
        }
    }
}
