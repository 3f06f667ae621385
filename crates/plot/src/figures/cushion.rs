//! Cushion curves: peak acceleration over static stress, one curve for each thickness.

use crate::{Chart, Direction, Marker, Pattern, ReferenceLine, Scale, Series};

/// A figure shows peaks up to so many times the largest of the best ones, the limit and the floors.
const ROOM: f64 = 2.5;

/// The curves of one height, in the units of their axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CushionSeries {
    /// Heading, as in `Drops from 760 mm`.
    pub title: String,
    /// A remark below; empty for none.
    pub note: String,
    /// The curves, from the thinnest cushion to the thickest one.
    pub curves: Vec<CushionCurve>,
    /// The most that a peak may be \[g\].
    pub limit: Option<f64>,
    /// A static stress \[kPa\] of its own, and what has it; not drawn beyond the curves.
    pub own: Option<(f64, String)>,
}

/// The curve of one thickness.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CushionCurve {
    /// Name, as in `60 mm`.
    pub name: String,
    /// Static stress \[kPa\], rising, peak \[g\], and how well it is known; what is not finite is a gap.
    pub points: Vec<(f64, f64, CushionMark)>,
    /// What no cushion of this thickness can beat \[g\].
    pub floor: Option<f64>,
    /// The stress \[kPa\] of the least peak \[g\].
    pub best: Option<(f64, f64)>,
    /// Static stress \[kPa\] and mean peak \[g\] of the drops that follow the first one in a row; empty for none.
    pub later: Vec<(f64, f64)>,
    /// Static stress \[kPa\] and the peaks \[g\] between which 95 % of scattered designs lie; what is not finite is a
    /// gap, empty for none.
    pub band: Vec<(f64, f64, f64)>,
}

/// How well a point of a cushion curve is known, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum CushionMark {
    /// Wholly.
    #[default]
    Known,
    /// The cushion meets its stop there.
    OnStop,
}

impl CushionMark {
    fn pattern(self) -> Pattern {
        match self {
            Self::Known => Pattern::Solid,
            Self::OnStop => Pattern::Dashed,
        }
    }
}

impl CushionSeries {
    /// The chart: the stress on a logarithmic axis, the limit across, the floor of each thickness as a thin line, and
    /// the best point of each curve marked.
    pub fn chart(&self) -> Chart {
        let top = self.top();
        let curves = || self.curves.iter().enumerate();
        let bands = curves().filter_map(|(colour, own)| own.band(colour, top));
        let parts = curves().flat_map(|(colour, own)| own.parts(colour, top));
        let later = curves().filter_map(|(colour, own)| own.later(colour, top));
        let mut series: Vec<Series> = bands.chain(parts).chain(later).collect();
        let floors = curves().filter_map(|(colour, own)| {
            let ends = [own.points.first()?.0, own.points.last()?.0];
            let floor = own.floor.filter(|own| *own <= top)?;
            let points = ends.map(|x| (x, floor));
            Some(Series::drawn("", (colour, Pattern::DashDotted), points))
        });
        let floors: Vec<Series> = floors.collect();
        let mut notes = vec![self.note.clone()];
        notes.extend(self.has(CushionMark::OnStop).then(|| "dashed: on the stop".to_owned()));
        notes.extend(
            (!floors.is_empty()).then(|| "dash-dotted: no cushion can do better".to_owned()),
        );
        let has_rows = self.curves.iter().any(|own| !own.later.is_empty());
        let has_bands = self.curves.iter().any(|own| !own.band.is_empty());
        notes.extend(has_bands.then(|| "areas: 95 % of the scattered designs".to_owned()));
        notes.extend(has_rows.then(|| "pale: mean of the drops that follow in a row".to_owned()));
        notes.retain(|own| !own.is_empty());
        let markers = self.curves.iter().filter_map(|own| own.best).filter(|own| own.1 <= top);
        let markers = markers.map(|(x, y)| Marker { x, y, label: format!("{} g", rounded(y)) });
        let limit = self.limit.map(|at| {
            ReferenceLine::new(Direction::Horizontal, at, format!("limit {} g", rounded(at)))
        });
        let own = self.own.as_ref().filter(|own| self.reaches(own.0)).map(|(at, name)| {
            let label = format!("{name} {} kPa", rounded(*at));
            ReferenceLine::new(Direction::Vertical, *at, label)
        });
        series.extend(floors);
        Chart {
            title: self.title.clone(),
            note: notes.join("; "),
            x_label: "static stress (kPa)".into(),
            y_label: "peak acceleration (g)".into(),
            x_scale: Scale::logarithmic(""),
            family: series.len(),
            series,
            markers: markers.collect(),
            lines: limit.into_iter().chain(own).collect(),
            ..Chart::default()
        }
    }

    /// Whether a curve has stresses on both sides of this one.
    fn reaches(&self, stress: f64) -> bool {
        let is_within = |own: &CushionCurve| {
            let ends = own.points.first().zip(own.points.last());
            ends.is_some_and(|(low, high)| (low.0..=high.0).contains(&stress))
        };
        self.curves.iter().any(is_within)
    }

    fn has(&self, mark: CushionMark) -> bool {
        self.curves
            .iter()
            .any(|own| own.points.iter().any(|own| own.2 == mark && own.1.is_finite()))
    }

    /// The largest peak that is shown.
    fn top(&self) -> f64 {
        let bests = self.curves.iter().filter_map(|own| own.best).map(|own| own.1);
        let floors = self.curves.iter().filter_map(|own| own.floor);
        let largest = bests.chain(floors).chain(self.limit).fold(0.0, f64::max);
        if largest > 0.0 { ROOM * largest } else { f64::INFINITY }
    }
}

impl CushionCurve {
    /// The band of scattered designs, up to the top.
    fn band(&self, colour: usize, top: f64) -> Option<Series> {
        let cut = |&(x, low, high): &(f64, f64, f64)| {
            let high = if high.is_finite() { high.min(top) } else { high };
            if low <= top { (x, low, high) } else { (x, f64::NAN, f64::NAN) }
        };
        // It ends in a point where all designs leave the figure.
        let ends = self.band.windows(2).filter_map(|pair| {
            let lows = [(pair[0].0, pair[0].1), (pair[1].0, pair[1].1)];
            let [a, b] = cut_at(lows, top)?;
            let end = if lows[0].1 > top { a } else { b };
            (lows[0].1.max(lows[1].1) > top).then_some((end.0, top, top))
        });
        let mut rows: Vec<(f64, f64, f64)> = self.band.iter().map(cut).chain(ends).collect();
        rows.sort_by(|one, other| one.0.total_cmp(&other.0));
        let has_any = rows.iter().any(|own| own.1.is_finite() && own.2.is_finite());
        has_any.then(|| Series::band("", colour, rows))
    }

    /// The drops that follow the first one.
    fn later(&self, colour: usize, top: f64) -> Option<Series> {
        let gap = |own: (f64, f64)| if own.1 <= top { own } else { (own.0, f64::NAN) };
        let points: Vec<(f64, f64)> = self.later.iter().copied().map(gap).collect();
        let has_any = points.iter().any(|own| own.1.is_finite());
        has_any.then(|| Series::drawn("", (colour, Pattern::Broad), points))
    }

    /// The parts of the curve that are known equally well; the last one that is drawn has the name.
    fn parts(&self, colour: usize, top: f64) -> Vec<Series> {
        let mut parts = Vec::new();
        let all = self.with_best();
        for mark in [CushionMark::Known, CushionMark::OnStop] {
            let mut points = Vec::new();
            for pair in all.windows(2) {
                // A part reaches to the last point that is known better.
                let worst = pair[0].2.max(pair[1].2);
                let ends = cut_at([(pair[0].0, pair[0].1), (pair[1].0, pair[1].1)], top);
                match ends.filter(|_| worst == mark) {
                    Some(ends) if points.last() == Some(&ends[0]) => points.push(ends[1]),
                    Some(ends) if points.is_empty() => points.extend(ends),
                    Some(ends) => points.extend([(ends[0].0, f64::NAN), ends[0], ends[1]]),
                    None => {}
                }
            }
            if !points.is_empty() {
                parts.push(Series::drawn("", (colour, mark.pattern()), points));
            }
        }
        if let Some(first) = parts.first_mut() {
            first.name.clone_from(&self.name);
        }
        parts
    }

    /// The points and the best one among them, through which the curve goes as well.
    fn with_best(&self) -> Vec<(f64, f64, CushionMark)> {
        let mut all = self.points.clone();
        let Some((x, y)) = self.best else { return all };
        let at = all.partition_point(|own| own.0 < x);
        if let (Some(before), Some(after)) = (at.checked_sub(1).map(|own| all[own]), all.get(at)) {
            let mark = before.2.min(after.2);
            if after.0 > x {
                all.insert(at, (x, y, mark));
            }
        }
        all
    }
}

/// What of a piece of a curve lies below the top; the horizontal axis is logarithmic.
fn cut_at([a, b]: [(f64, f64); 2], top: f64) -> Option<[(f64, f64); 2]> {
    if !(a.1.is_finite() && b.1.is_finite()) || (a.1 > top && b.1 > top) {
        return None;
    }
    let crossing = || {
        let part = (top - a.1) / (b.1 - a.1);
        (a.0 * (b.0 / a.0).powf(part), top)
    };
    Some([if a.1 > top { crossing() } else { a }, if b.1 > top { crossing() } else { b }])
}

/// To three digits.
fn rounded(value: f64) -> f64 {
    let power = 10.0_f64.powf(2.0 - value.abs().log10().floor());
    if power.is_finite() && power > 0.0 { (value * power).round() / power } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series() -> CushionSeries {
        let marks =
            [CushionMark::Known, CushionMark::Known, CushionMark::OnStop, CushionMark::Known];
        let points = [(1.0, 400.0), (2.0, 40.0), (4.0, 60.0), (8.0, f64::NAN)];
        let points = points.into_iter().zip(marks).map(|((x, y), mark)| (x, y, mark)).collect();
        let name = "60 mm".to_owned();
        let curve = CushionCurve {
            name,
            points,
            floor: Some(20.0),
            best: Some((2.0, 40.0)),
            later: Vec::new(),
            band: vec![(1.0, 300.0, 500.0), (2.0, 36.0, 44.0), (4.0, 50.0, 140.0)],
        };
        CushionSeries {
            title: "Drops".into(),
            curves: vec![curve],
            limit: Some(50.0),
            own: Some((3.0, "parcel".into())),
            ..CushionSeries::default()
        }
    }

    #[test]
    fn a_curve_is_drawn_by_how_well_it_is_known_and_up_to_the_top() {
        let chart = series().chart();
        let patterns: Vec<Pattern> =
            chart.series.iter().map(|own| own.stroke.unwrap().pattern).collect();
        assert_eq!(patterns, [Pattern::Band, Pattern::Solid, Pattern::Dashed, Pattern::DashDotted]);
        // The band ends at the top, and begins where it is below it.
        let band = &chart.series[0].points;
        let inner: Vec<_> = band.iter().filter(|own| own.1.is_finite()).collect();
        assert!(inner.contains(&&(4.0, 125.0)) && inner.contains(&&(2.0, 36.0)), "{band:?}");
        assert!(inner.iter().all(|own| own.1 <= 125.0), "{band:?}");
        // The top is 125 g: 2^(275/360) kPa.
        let first = chart.series[1].points[0];
        assert!((first.0 - 2.0_f64.powf(275.0 / 360.0)).abs() < 1e-12, "{first:?}");
        assert_eq!(first.1.to_bits(), 125.0_f64.to_bits());
        assert_eq!(chart.series[2].points, [(2.0, 40.0), (4.0, 60.0)]);
        assert!(chart.series.iter().all(|own| own.stroke.unwrap().colour == 0));
        let svg = chart.svg().unwrap();
        for text in [
            "static stress (kPa)",
            "limit 50 g",
            "parcel 3 kPa",
            "40 g",
            "dashed: on the stop",
            "areas: 95 %",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        // A stress beyond the curves would stretch the axis.
        let beyond = CushionSeries { own: Some((9.0, "parcel".into())), ..series() };
        assert_eq!(beyond.chart().lines.len(), 1);
    }

    #[test]
    fn a_curve_goes_through_its_best_point_and_a_band_ends_at_the_top() {
        let mut own = series();
        own.curves[0].best = Some((3.0, 38.0));
        let solid = &own.chart().series[1].points;
        assert_eq!(solid[1..], [(2.0, 40.0), (3.0, 38.0)]);
        // From 50 g at 4 kPa to 200 g at 8 kPa the best designs leave the figure halfway on a logarithmic axis.
        own.curves[0].best = Some((2.0, 40.0));
        own.curves[0].band.extend([(8.0, 200.0, 300.0), (16.0, 250.0, 400.0)]);
        let band = own.chart().series.swap_remove(0).points;
        let last = band.iter().filter(|own| own.1.is_finite()).map(|own| own.0).fold(0.0, f64::max);
        assert!((last - 4.0 * 2.0_f64.sqrt()).abs() < 1e-12, "{band:?}");
    }
}
