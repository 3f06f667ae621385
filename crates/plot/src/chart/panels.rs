//! Two charts over the same horizontal axis in one drawing, such as records with a model and what is left of them.

use super::{
    Chart, Heading,
    canvas::{Fault, opening, pixels},
};
use crate::theme::Sheet;

/// Height of the lower frame in parts of that of a sheet, and of its ticks.
const LOWER: f64 = 0.36;
/// Distance between both frames \[px\].
const APART: f64 = 18.0;

impl Chart {
    /// This chart over the one below: their frames begin and end together.
    pub(super) fn over(&self, below: &Self, sheet: Sheet) -> Result<String, Fault> {
        let (x, y) = self.axes(sheet.x_ticks, sheet.y_ticks);
        let low =
            Sheet { height: LOWER * sheet.height, y_ticks: (sheet.y_ticks / 2).max(2), ..sheet };
        let y_below = below.axes(low.x_ticks, low.y_ticks).1;
        let left = Self::left(&y).max(Self::left(&y_below));
        let mut upper = self.laid_out(sheet, (x.clone(), y), left);
        let plain = Self { title: String::new(), note: String::new(), ..below.clone() };
        let plain = Self { x_label: self.x_label.clone(), ..plain };
        let mut lower = plain.laid_out(low, (x, y_below), left);
        // The lower one has no names at its ends beside which the upper frame would be wider.
        lower.frame.right = upper.frame.right;
        lower.ends = None;
        let rise = Heading::new("", "", lower.size.0).bottom;
        upper.is_labelled = false;
        let from = upper.frame.bottom + APART - rise;
        let size = (upper.size.0, from + lower.size.1);
        upper.size = size;
        Ok(format!(
            "{}{}<g class=\"below\" transform=\"translate(0 {})\">\n{}</g>\n</svg>\n",
            opening(size, &self.title),
            self.drawn(&upper)?,
            pixels(from.max(0.0)),
            plain.drawn(&lower)?,
        ))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Chart, Pattern, Series, Stroke, well_formed::assert_well_formed};

    fn chart() -> Chart {
        let rows = (0..40).map(f64::from);
        let left: Vec<(f64, f64)> = rows.clone().map(|x| (x, 1e-3 * x.sin())).collect();
        let below = Chart {
            title: "left".into(),
            y_label: "left (N)".into(),
            series: vec![Series::new("", left)],
            ..Chart::default()
        };
        let measured: Vec<(f64, f64)> = rows.clone().map(|x| (x, 1e4 * x)).collect();
        let stroke = Some(Stroke { colour: 0, pattern: Pattern::Points });
        Chart {
            title: "fit".into(),
            x_label: "time (ms)".into(),
            y_label: "force (N)".into(),
            series: vec![
                Series::band("band", 0, rows.map(|x| (x, 9e3 * x, 11e3 * x))),
                Series { name: "measured".into(), points: measured, stroke },
            ],
            below: Some(Box::new(below)),
            ..Chart::default()
        }
    }

    #[test]
    fn both_frames_begin_and_end_together_and_the_time_stands_once() {
        for svg in [chart().svg().unwrap(), chart().narrow_svg().unwrap()] {
            assert_well_formed(&svg);
            assert_eq!(svg.matches("time (ms)").count(), 1);
            assert!(svg.contains("left (N)") && svg.contains("force (N)"));
            assert!(!svg.contains(">\nleft\n"), "the title of the lower chart");
            let border = |own: &str| {
                let points = own.rsplit("<polyline").find(|own| own.contains("#1F2933"));
                let list = points.unwrap().split("points=\"").nth(1).unwrap();
                let each = list.split('"').next().unwrap().split_whitespace();
                let x = |point: &str| point.split(',').next().unwrap().to_owned();
                (x(each.clone().next().unwrap()), x(each.clone().next_back().unwrap()))
            };
            let borders: Vec<_> = svg.split("class=\"axes\"").skip(1).map(border).collect();
            assert_eq!(borders.len(), 2);
            assert_eq!(borders[0], borders[1]);
        }
    }

    #[test]
    fn a_band_is_one_area_for_each_stretch_and_points_are_discs() {
        let rows = [(0.0, 1.0, 2.0), (1.0, 1.0, 2.0), (2.0, f64::NAN, 3.0), (3.0, 2.0, 4.0)];
        let rows = rows.into_iter().chain([(4.0, 2.0, 4.0)]);
        let chart = Chart { series: vec![Series::band("", 0, rows)], ..Chart::default() };
        assert_eq!(chart.svg().unwrap().matches("<polygon").count(), 2);
        let svg = self::chart().svg().unwrap();
        // 40 rows, of which none hides another, and three in the legend.
        assert_eq!(svg.matches("<circle").count(), 43);
    }
}
