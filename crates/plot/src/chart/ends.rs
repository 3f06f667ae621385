//! Names of curves at their right ends, in place of a legend where they fit.

use super::{
    Chart, Pattern,
    canvas::{Area, Drawn, Pen, canvas, path, text_style},
};
use crate::{
    axis::Frame,
    text_metrics::{one_line, text_width},
    theme,
};
use plotters::{
    element::Text,
    style::text_anchor::{HPos, Pos, VPos},
};

/// Distance of two names below each other \[px\].
const ROW: f64 = 1.3 * theme::TICK_SIZE;
/// Curves whose ends are nearer than this are not told apart there \[px\].
const APART: f64 = 2.6;
/// No name is further from the height of its end than this \[px\].
const FAR: f64 = 44.0;
/// No name is wider than this part of the drawing.
const WIDEST: f64 = 0.27;
/// Way from the end of a curve to its name: aslant up to the first place, then level \[px\].
const WAY: [f64; 3] = [2.0, 15.0, 22.0];
/// Where the name begins \[px\].
const NAME: f64 = 26.0;
/// A curve ends at the right where it comes as near to it as this part of the frame.
const AT_END: f64 = 0.015;

/// A curve's name beside its end.
#[derive(Debug, Clone, PartialEq)]
struct EndName {
    name: String,
    pen: Pen,
    /// Height of the end and of the name, from the upper edge of the frame \[px\].
    end: f64,
    at: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct EndNames(Vec<EndName>);

impl Chart {
    /// The names at the ends of the curves, in a drawing of this width \[px\]; `None` where they do not fit or curves do
    /// not end apart from each other at the right.
    pub(super) fn end_names(&self, frame: &Frame, width: f64) -> Option<EndNames> {
        let mut all = Vec::new();
        for (index, series) in self.series.iter().enumerate().filter(|own| !own.1.name.is_empty()) {
            let pen = self.pen(index);
            let runs_on = series.points.is_sorted_by(|one, next| one.0 <= next.0);
            let (x, y) = *series.points.last()?;
            let is_at_end = self.takes(x, y) && (1.0 - frame.x.fraction(x)).abs() <= AT_END;
            let is_line = !matches!(
                pen.pattern,
                Pattern::Broad | Pattern::Stems | Pattern::Points | Pattern::Band
            );
            if !(runs_on && is_at_end && is_line && frame.y.holds(y)) {
                return None;
            }
            let name = one_line(&series.name);
            if text_width(&name, theme::TICK_SIZE) > WIDEST * width {
                return None;
            }
            let end = (1.0 - frame.y.fraction(y)) * (frame.bottom - frame.top);
            all.push(EndName { name, pen, end, at: end });
        }
        if all.len() < 2 {
            return None;
        }
        all.sort_by(|one, other| one.end.total_cmp(&other.end));
        let ends: Vec<f64> = all.iter().map(|own| own.end).collect();
        if ends.windows(2).any(|pair| pair[1] - pair[0] < APART) {
            return None;
        }
        let places = spread(&ends, ROW, frame.bottom - frame.top)?;
        all.iter_mut().zip(places).for_each(|(own, at)| own.at = at);
        let is_near = |own: &EndName| (own.at - own.end).abs() <= FAR;
        all.iter().all(is_near).then_some(EndNames(all))
    }
}

impl EndNames {
    /// Width that they take beside the frame \[px\].
    pub(super) fn width(&self) -> f64 {
        let widths = self.0.iter().map(|own| text_width(&own.name, theme::TICK_SIZE));
        NAME + widths.fold(0.0, f64::max)
    }

    /// The samples from the ends of the curves to the names, with the pen of each.
    pub(super) fn samples(&self) -> impl Iterator<Item = (Pen, [(f64, f64); 3])> {
        self.0.iter().map(|own| {
            let [from, to, end] = WAY;
            (own.pen, [(from, own.end), (to, own.at), (end, own.at)])
        })
    }

    /// Writes the names beside the right upper corner of the frame.
    pub(super) fn draw(&self, area: &Area<'_>, (x, y): (f64, f64)) -> Drawn {
        let style = text_style(theme::TICK_SIZE, theme::INK, Pos::new(HPos::Left, VPos::Center));
        self.0.iter().try_for_each(|own| {
            let at = canvas((x + NAME, y + own.at));
            area.draw(&Text::new(own.name.clone(), at, style.clone()))
        })
    }
}

/// Draws one sample beside the right upper corner of the frame.
pub(super) fn draw_sample(
    area: &Area<'_>,
    (pen, way): (Pen, [(f64, f64); 3]),
    (x, y): (f64, f64),
) -> Drawn {
    area.draw(&path(&way.map(|own| (x + own.0, y + own.1)), pen.style()))
}

/// Rising heights that are `row` apart from each other, within 0 to `height`, and with the least sum of squared
/// distances from `wanted` ones, which rise (isotonic regression: neighbours that do not fit form blocks, each at the
/// mean of what its members want). `None` where there are too many.
fn spread(wanted: &[f64], row: f64, height: f64) -> Option<Vec<f64>> {
    let half = 0.5 * row;
    let lowest = height - half - row * wanted.len().saturating_sub(1) as f64;
    if lowest < half {
        return None;
    }
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for (at, wish) in wanted.iter().enumerate() {
        let mut block = (wish - row * at as f64, 1);
        while let Some(last) = blocks.pop_if(|last| last.0 > block.0) {
            let count = last.1 + block.1;
            let sum = last.0 * last.1 as f64 + block.0 * block.1 as f64;
            block = (sum / count as f64, count);
        }
        blocks.push(block);
    }
    let means = blocks.iter().flat_map(|&(mean, count)| std::iter::repeat_n(mean, count));
    Some(means.enumerate().map(|(at, own)| own.clamp(half, lowest) + row * at as f64).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Series, text_metrics::text_width};

    /// A family of lines that end at these heights.
    fn family(ends: &[f64], name: impl Fn(usize) -> String) -> Chart {
        let line = |(at, end): (usize, &f64)| {
            Series::new(name(at), (0..=20).map(f64::from).map(|i| (i, end * i / 20.0)).collect())
        };
        Chart {
            title: "Peak force of padding over stiffness".into(),
            series: ends.iter().enumerate().map(line).collect(),
            family: ends.len(),
            ..Chart::default()
        }
    }

    /// Left, right, top and bottom of every text of a group \[px\].
    pub(super) fn boxes(svg: &str, class: &str) -> Vec<[f64; 4]> {
        let groups = svg.split("<g ").filter(|own| own.contains(&format!("class=\"{class}\"")));
        let texts = groups.flat_map(|own| own.split("<text ").skip(1));
        let of = |text: &str| -> Option<[f64; 4]> {
            let value = |key: &str| -> Option<f64> {
                text.split(&format!("{key}=\"")).nth(1)?.split('"').next()?.parse().ok()
            };
            let content = text.split('>').nth(1)?.split('<').next()?.trim().to_owned();
            let (x, y) = (value("x")? / theme::OVERSAMPLING, value("y")? / theme::OVERSAMPLING);
            let size = value("font-size")? / theme::OVERSAMPLING;
            let wide = text_width(&content, size);
            Some([x, x + wide, y - 0.5 * size, y + 0.5 * size])
        };
        texts.filter_map(of).collect()
    }

    fn overlap(one: &[f64; 4], other: &[f64; 4]) -> bool {
        one[0] < other[1] && other[0] < one[1] && one[2] < other[3] && other[2] < one[3]
    }

    /// Asserts that all names are there, inside of the drawing and apart; returns whether they are at the ends.
    fn assert_apart(chart: &Chart) -> bool {
        let mut at_ends = false;
        for (svg, width) in [(chart.svg(), theme::PAGE.width), (chart.narrow_svg(), 358.0)] {
            let svg = svg.unwrap();
            let (ends, legend) = (boxes(&svg, "names"), boxes(&svg, "sample"));
            at_ends |= !ends.is_empty();
            let all = if ends.is_empty() { legend } else { ends };
            assert_eq!(all.len(), chart.series.len(), "{svg}");
            for (i, own) in all.iter().enumerate() {
                assert!(own[0] >= 0.0 && own[1] <= width + 0.5, "{own:?}");
                assert!(all[..i].iter().all(|other| !overlap(own, other)), "{own:?} in {all:?}");
            }
        }
        at_ends
    }

    #[test]
    fn names_of_four_to_twelve_curves_never_collide() {
        for count in 4..=12_usize {
            let spaced: Vec<f64> = (0..count).map(|i| 10.0 + 2.0 * i as f64).collect();
            assert!(assert_apart(&family(&spaced, |at| format!("{at} MN/m"))));
            let crowded: Vec<f64> = (0..count).map(|i| 10.0 - 0.73_f64.powf(i as f64)).collect();
            assert_apart(&family(&crowded, |at| format!("{at} MN/m")));
            // All end at one value: a legend.
            let same: Vec<f64> = vec![10.0; count];
            assert!(!assert_apart(&family(&same, |at| format!("{at} MN/m"))));
            let long = |at: usize| format!("{at} of a liner with a name that nobody would read");
            assert!(!assert_apart(&family(&spaced, long)));
        }
    }

    #[test]
    fn a_family_has_colours_that_rise_in_lightness_on_curves_and_at_names() {
        let svg = family(&[1.0, 2.0, 3.0, 4.0, 5.0], |at| at.to_string()).svg().unwrap();
        let strokes = |class: &str| -> Vec<u32> {
            let groups = svg.split("<g ").filter(|own| own.contains(&format!("class=\"{class}\"")));
            let colour = |own: &str| {
                let hex = own.split("stroke=\"#").nth(1).unwrap();
                u32::from_str_radix(&hex[..6], 16).unwrap()
            };
            groups.map(colour).collect()
        };
        let curves = strokes("series");
        let light = |own: &u32| {
            let part = |shift: u32| f64::from(own >> shift & 255);
            0.2126 * part(16).powf(2.2) + 0.7152 * part(8).powf(2.2) + 0.0722 * part(0).powf(2.2)
        };
        assert!(curves.is_sorted_by(|one, next| light(one) < light(next)), "{curves:X?}");
        // Names stand from top to bottom, so the highest curve's comes first.
        let names: Vec<u32> = strokes("end").into_iter().rev().collect();
        assert_eq!(names, curves);
    }

    #[test]
    fn heights_are_spread_around_their_mean_and_kept_within() {
        assert_eq!(spread(&[50.0, 80.0], 10.0, 100.0), Some(vec![50.0, 80.0]));
        assert_eq!(spread(&[50.0, 50.0, 50.0], 10.0, 100.0), Some(vec![40.0, 50.0, 60.0]));
        assert_eq!(spread(&[0.0, 1.0, 99.0], 10.0, 100.0), Some(vec![5.0, 15.0, 95.0]));
        assert_eq!(spread(&[1.0; 12], 10.0, 100.0), None);
    }
}
