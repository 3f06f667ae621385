//! Maps: a value over two quantities, as colours with lines of equal value; frame, axes and the bar of colours.

mod bands;
mod bar;
mod colours;
mod contours;
mod lines;
mod texts;

use std::fmt::Write as _;

use self::{
    bands::Field,
    colours::Colours,
    lines::{draw_path, hatch},
    texts::{Texts, text, upright},
};
use crate::{
    Scale,
    axis::{Axis, Frame},
    chart::Heading,
    text_metrics::{clip_width, escape, one_line, text_width},
    theme::{self, Sheet},
};

/// A value over two quantities.
///
/// The points stand on a grid of two by two at least; values that are not finite are gaps. Where values run smoothly they
/// are drawn as bands, straight between neighbours; beside gaps and jumps each point has the colour of its value.
/// Colours reach over all values unless a few of them lie far away from the others; the bar tells of these.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Map, MapLimit, Side};
///
/// let map = Map {
///     title: "Peak force".into(),
///     x_label: "stiffness (MN/m)".into(),
///     y_label: "damping (kN s/m)".into(),
///     value_label: "peak force (kN)".into(),
///     x: vec![5.0, 10.0, 20.0],
///     y: vec![2.0, 4.0],
///     values: vec![30.0, 34.0, 38.0, 31.0, 35.0, 40.0],
///     limits: vec![MapLimit {
///         values: vec![1.4, 1.1, 0.9, 1.2, 0.9, 0.8],
///         at: 1.0,
///         label: "as deep as it is thick".into(),
///         kept: Side::Below,
///     }],
///     ..Map::default()
/// };
/// assert!(map.svg().contains("as deep as it is thick"));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    /// Heading.
    pub title: String,
    /// A remark below the heading; empty for none.
    pub note: String,
    /// Quantity and unit along the horizontal axis.
    pub x_label: String,
    /// Quantity and unit along the vertical axis.
    pub y_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Quantity and unit of the values.
    pub value_label: String,
    /// Scale of the values.
    pub value_scale: Scale,
    /// Values that have a colour of their own if any value reaches them, such as the bound of a limit.
    pub shown: Vec<f64>,
    /// Places of the columns, ascending.
    pub x: Vec<f64>,
    /// Places of the rows, ascending.
    pub y: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
    /// Lines on which another quantity has a certain value.
    pub limits: Vec<MapLimit>,
}

/// A line on which a quantity has a certain value, such as that of a padding pressed to nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct MapLimit {
    /// The quantity, row by row.
    pub values: Vec<f64>,
    /// Its value on the line.
    pub at: f64,
    /// Text at the line.
    pub label: String,
    /// On which side of the line the limit is kept; the other one is hatched.
    pub kept: Side,
}

/// The side of a line of equal value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Side {
    /// None of both more than the other.
    #[default]
    Either,
    /// Where values are smaller.
    Below,
    /// Where values are larger.
    Above,
}

impl Map {
    /// Both axes, which end where the data do.
    fn axes(&self, ticks: (usize, usize)) -> (Axis, Axis) {
        let axis = |scale: &Scale, places: &[f64], ticks| {
            Axis::of(scale, places.iter().copied(), false, ticks)
        };
        (axis(&self.x_scale, &self.x, ticks.0), axis(&self.y_scale, &self.y, ticks.1))
    }
}

/// Bands of colour.
const BANDS: usize = 32;
/// How far a block reaches under what is beside it \[px\].
const OVERLAP: f64 = 0.6;

impl Map {
    /// The map as one SVG element, 760 pixels wide, without any outer resource.
    pub fn svg(&self) -> String {
        self.on(theme::PAGE)
    }

    /// The same for a phone, 358 pixels wide, with texts of the same size.
    pub fn narrow_svg(&self) -> String {
        self.on(theme::PHONE)
    }

    fn on(&self, sheet: Sheet) -> String {
        let (x, y) = self.axes((sheet.x_ticks, sheet.y_ticks));
        let colours = Colours::of(&self.values, &self.shown, &self.value_scale, sheet.y_ticks);
        let widths = y.ticks().iter().map(|own| text_width(&y.tick_label(*own), theme::TICK_SIZE));
        let left = theme::MARGIN + 1.5 * theme::LABEL_SIZE + widths.fold(0.0, f64::max) + 12.0;
        let right = sheet.width - theme::MARGIN - bar::width(&colours);
        let room = sheet.width - theme::MARGIN - left;
        let heading = Heading::new(&self.title, &self.remark(), room);
        let top = heading.bottom + 10.0;
        let bottom = top + sheet.height;
        let frame = Frame { left, right, top, bottom, x, y };
        let height = (bottom + 2.6 * theme::LABEL_SIZE + theme::MARGIN + 8.0).ceil();
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{}\">\n<title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            theme::FONT,
            escape(&self.title),
            theme::PAPER.hex(),
            width = sheet.width,
        );
        let pattern = self.pattern(sheet);
        if self.limits.iter().any(|own| own.kept != Side::Either) {
            svg += &hatch(&pattern);
        }
        let shares: Vec<f64> = (0..self.x.len() * self.y.len())
            .map(|at| self.values.get(at).map_or(f64::NAN, |own| colours.share(*own)))
            .collect();
        let mut texts = Texts::new(&frame);
        let field = Field::new(shares.clone(), self.x.len());
        self.draw_bands(&mut svg, &frame, &field);
        let mut own = String::new();
        let lines: Vec<_> =
            self.limits.iter().map(|limit| self.limit_lines(&frame, limit)).collect();
        for (limit, of_limit) in self.limits.iter().zip(&lines) {
            self.draw_limit(&mut own, &frame, (limit, of_limit), &pattern);
        }
        for (at, limit) in self.limits.iter().enumerate() {
            let others = lines.iter().enumerate().filter(|other| other.0 != at);
            let others: Vec<_> =
                others.flat_map(|other| other.1.iter().flatten().copied()).collect();
            texts.put(&one_line(&limit.label), &lines[at], Some(&others));
        }
        self.draw_lines(&mut svg, &frame, (&field, &shares, &colours), &mut texts);
        svg += &own;
        texts.draw(&mut svg);
        self.draw_axes(&mut svg, &frame, &heading, sheet.width);
        bar::draw(&mut svg, &frame, &colours, &self.value_label);
        svg + "</svg>\n"
    }

    /// A name for the hatching that other drawings on a page do not have (FNV-1a of what sets them apart).
    fn pattern(&self, sheet: Sheet) -> String {
        let texts = [&self.title, &self.note, &self.x_label, &self.y_label, &self.value_label];
        let bytes = texts.into_iter().flat_map(|own| own.bytes().chain([0]));
        let all = bytes.chain(sheet.width.to_bits().to_be_bytes());
        let hash = all.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        format!("beyond-{hash:016x}")
    }

    /// The remark, and which limits are kept everywhere or nowhere.
    fn remark(&self) -> String {
        let unlined = self.limits.iter().filter_map(MapLimit::unlined);
        let own = Some(self.note.clone()).filter(|own| !own.is_empty());
        own.into_iter().chain(unlined).collect::<Vec<_>>().join("; ")
    }

    /// Draws bands of colour where values run smoothly, each over the one below, and blocks elsewhere.
    fn draw_bands(&self, svg: &mut String, frame: &Frame, field: &Field) {
        svg.push_str("<g class=\"blocks\" shape-rendering=\"crispEdges\">\n");
        for (point, middle) in field.blocks() {
            let (x, y) = self.place(frame, (point.0 as f64, point.1 as f64));
            let (to_x, to_y) = self.place(frame, middle);
            let _ = writeln!(
                svg,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
                x.min(to_x),
                y.min(to_y),
                (to_x - x).abs() + OVERLAP,
                (to_y - y).abs() + OVERLAP,
                band_colour(field.at(point)).hex()
            );
        }
        svg.push_str("</g>\n<g class=\"bands\">\n");
        for band in 0..BANDS {
            let level = if band == 0 { f64::NEG_INFINITY } else { band as f64 / BANDS as f64 };
            let data = self.outlines(frame, field.region(level));
            if !data.is_empty() {
                let fill = band_colour((band as f64 + 0.5) / BANDS as f64).hex();
                let _ = writeln!(svg, "<path d=\"{data}\" fill=\"{fill}\" fill-rule=\"evenodd\"/>");
            }
        }
        svg.push_str("</g>\n");
    }

    fn draw_axes(&self, svg: &mut String, frame: &Frame, heading: &Heading, width: f64) {
        let Frame { left, right, top, bottom, .. } = *frame;
        let _ = writeln!(
            svg,
            "<g class=\"axes\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\">\n\
             <rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            theme::INK.hex(),
            theme::LINE_WIDTH,
            right - left,
            bottom - top
        );
        let mut texts = Vec::new();
        let (x0, y0) = (self.x.first().copied(), self.y.first().copied());
        for &tick in frame.x.ticks() {
            let (at, _) = frame.at(tick, y0.unwrap_or(1.0));
            draw_path(svg, &[(at, bottom), (at, bottom + theme::MINOR_LENGTH)]);
            texts.push(text(
                (at, bottom + 18.0),
                "middle",
                theme::TICK_SIZE,
                &frame.x.tick_label(tick),
            ));
        }
        for &tick in frame.y.ticks() {
            let (_, at) = frame.at(x0.unwrap_or(1.0), tick);
            draw_path(svg, &[(left - theme::MINOR_LENGTH, at), (left, at)]);
            texts.push(text(
                (left - 8.0, at + 4.5),
                "end",
                theme::TICK_SIZE,
                &frame.y.tick_label(tick),
            ));
        }
        svg.push_str("</g>\n");
        let _ = writeln!(svg, "<g class=\"texts\" fill=\"{}\">", theme::FAINT.hex());
        for (top, size, line) in &heading.lines {
            let own = text((left, top + size), "start", *size, line);
            if *size > theme::TICK_SIZE { texts.push(own) } else { svg.push_str(&own) }
        }
        svg.push_str("</g>\n");
        let room = width - 2.0 * theme::MARGIN;
        let x_label = clip_width(&frame.x.title(&self.x_label), theme::LABEL_SIZE, room);
        let middle = (frame.middle_of(&x_label, width), bottom + 18.0 + 1.6 * theme::LABEL_SIZE);
        texts.push(text(middle, "middle", theme::LABEL_SIZE, &x_label));
        let y_label = clip_width(&frame.y.title(&self.y_label), theme::LABEL_SIZE, bottom - top);
        texts.push(upright(theme::MARGIN + theme::LABEL_SIZE, 0.5 * (top + bottom), &y_label));
        let _ = writeln!(svg, "<g class=\"texts\" fill=\"{}\">", theme::INK.hex());
        texts.iter().for_each(|text| svg.push_str(text));
        svg.push_str("</g>\n");
    }
}

/// The colour of the band in which a share of the range lies.
fn band_colour(share: f64) -> theme::Colour {
    let band = (share * BANDS as f64).floor().clamp(0.0, BANDS as f64 - 1.0);
    theme::map_colour((band + 0.5) / BANDS as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scale, well_formed::assert_well_formed};

    fn map() -> Map {
        let (x, y): (Vec<f64>, Vec<f64>) =
            ((1..9).map(f64::from).collect(), vec![1.0, 10.0, 100.0]);
        let values =
            y.iter().flat_map(|b| x.iter().map(move |a| a + b.log10())).collect::<Vec<_>>();
        Map {
            title: "Peak force <&>".into(),
            note: "a remark".into(),
            x_label: "stiffness (MN/m)".into(),
            y_label: "damping".into(),
            y_scale: Scale::logarithmic("N s/m"),
            value_label: "peak force (kN)".into(),
            limits: vec![MapLimit {
                values: values.clone(),
                at: 4.5,
                label: "ξmax = 1".into(),
                kept: Side::Either,
            }],
            x,
            y,
            values,
            ..Map::default()
        }
    }

    /// What stands between an attribute's quotes in a tag.
    fn value<'t>(tag: &'t str, key: &str) -> &'t str {
        let is_key = |at: &usize| *at == 0 || tag[..*at].ends_with([' ', '\n']);
        let start = format!("{key}=\"");
        let at = tag.match_indices(&start).map(|own| own.0).find(is_key).unwrap();
        tag[at + start.len()..].split('"').next().unwrap()
    }

    /// The tags of a name in the groups or paths of a class.
    fn tags<'t>(svg: &'t str, class: &str, name: &str) -> Vec<&'t str> {
        let own = format!("class=\"{class}\"");
        let groups = svg.split("<g ").filter(|group| group.contains(&own));
        let inner = groups.map(|group| group.split("</g>").next().unwrap());
        let opening = format!("<{name} ");
        let mut all = Vec::new();
        inner.for_each(|group| all.extend(group.split(opening.as_str()).skip(1)));
        all
    }

    fn points(tag: &str) -> Vec<(f64, f64)> {
        let pair = |own: &str| {
            let (x, y) = own.split_once(',').unwrap();
            (x.parse().unwrap(), y.parse().unwrap())
        };
        value(tag, "points").split_whitespace().map(pair).collect()
    }

    /// x·y on both axes over two decades, with a limit.
    fn product() -> Map {
        let x: Vec<f64> = (0..=40).map(|at| 10_f64.powf(0.05 * f64::from(at))).collect();
        let values: Vec<f64> = x.iter().flat_map(|y| x.iter().map(move |x| x * y)).collect();
        Map {
            title: "x·y".into(),
            x_scale: Scale::logarithmic(""),
            y_scale: Scale::logarithmic(""),
            value_scale: Scale::suiting(values.iter().copied()),
            limits: vec![MapLimit {
                values: values.clone(),
                at: 200.0,
                label: "at most 200".into(),
                kept: Side::Below,
            }],
            y: x.clone(),
            x,
            values,
            ..Map::default()
        }
    }

    #[test]
    fn a_limit_of_a_product_is_a_straight_line_on_logarithmic_axes() {
        let svg = product().svg();
        assert_well_formed(&svg);
        let frame = tags(&svg, "axes", "rect")[0];
        let number = |key: &str| -> f64 { value(frame, key).parse().unwrap() };
        let (left, top, wide, high) = (number("x"), number("y"), number("width"), number("height"));
        let lines = tags(&svg, "limits", "polyline");
        assert_eq!(lines.len(), 1);
        let along = points(lines[0]);
        assert!(along.len() > 20);
        for (x, y) in along {
            // log x + log y = log 200, each over two decades. Between neighbours 12 % apart straight lines deviate by
            // (ln 1.12)²/8 of a value, and places are rounded to 0.05 px.
            let sum = 2.0 * (x - left) / wide + 2.0 * (top + high - y) / high;
            assert!((sum - 200_f64.log10()).abs() < 0.002, "{sum}");
        }
        assert!(svg.contains("class=\"beyond\"") && svg.contains("<pattern"));
    }

    #[test]
    fn bands_are_shades_in_their_order_and_few_paths() {
        let svg = product().svg();
        let bands = tags(&svg, "bands", "path");
        assert!((28..=BANDS).contains(&bands.len()), "{}", bands.len());
        let colours: Vec<&str> = bands.iter().map(|own| value(own, "fill")).collect();
        let shades: Vec<String> =
            (0..BANDS).map(|band| band_colour((band as f64 + 0.5) / 32.0).hex()).collect();
        let places: Vec<_> =
            colours.iter().map(|own| shades.iter().position(|s| s == own)).collect();
        assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
        assert!(tags(&svg, "blocks", "rect").is_empty());
        assert!(svg.len() < 120_000, "{}", svg.len());
    }

    #[test]
    fn texts_on_a_map_do_not_cover_each_other() {
        let mut own = product();
        let limit = |at: f64| MapLimit {
            at,
            label: format!("at most {at} (of a standard with a long name)"),
            ..own.limits[0].clone()
        };
        own.limits = [20.0, 25.0, 300.0, 320.0].map(limit).to_vec();
        for (svg, width) in [(own.svg(), 760.0), (own.narrow_svg(), 358.0)] {
            assert_well_formed(&svg);
            let mut boxes: Vec<[f64; 4]> = Vec::new();
            for (class, bold) in [("labels", 1.0), ("limit-labels", 1.12)] {
                for tag in tags(&svg, class, "text") {
                    let at = |key: &str| -> f64 { value(tag, key).parse().unwrap() };
                    let content = tag.split('>').nth(1).unwrap().split('<').next().unwrap();
                    let half = 0.5 * bold * text_width(content, theme::TICK_SIZE);
                    let (x, y) = (at("x"), at("y"));
                    boxes.push([x - half, x + half, y - 9.0, y + 2.0]);
                }
            }
            assert!(boxes.len() > 4, "{boxes:?}");
            for (i, a) in boxes.iter().enumerate() {
                assert!(a[0] >= 0.0 && a[1] <= width, "{a:?}");
                let apart =
                    |b: &[f64; 4]| a[0] >= b[1] || b[0] >= a[1] || a[2] >= b[3] || b[2] >= a[3];
                assert!(boxes[..i].iter().all(apart), "{boxes:?}");
            }
        }
    }

    #[test]
    fn a_limit_without_a_line_is_told_in_words() {
        let mut own = map();
        (own.limits[0].at, own.limits[0].kept) = (100.0, Side::Below);
        assert!(own.svg().contains("a remark; ξmax = 1: kept everywhere"));
        own.limits[0].kept = Side::Above;
        let svg = own.svg();
        assert!(svg.contains("ξmax = 1: kept nowhere") && svg.contains("class=\"beyond\""));
    }

    #[test]
    fn the_limit_is_a_line_with_its_text() {
        let svg = map().svg();
        assert_well_formed(&svg);
        assert!(!tags(&svg, "limits", "polyline").is_empty());
        assert!(svg.contains("ξmax = 1") && svg.contains("stiffness (MN/m)"));
        assert!(svg.contains("peak force (kN)") && svg.contains("a remark"));
    }

    #[test]
    fn gaps_are_left_blank_beside_blocks_and_nothing_at_all_is_drawn_too() {
        let mut own = map();
        own.values[3] = f64::NAN;
        let svg = own.svg();
        assert_well_formed(&svg);
        // Two squares of three known corners each.
        assert_eq!(tags(&svg, "blocks", "rect").len(), 6);
        assert_well_formed(&Map::default().svg());
        let flat = Map { values: vec![2.0; 24], ..map() };
        assert_well_formed(&flat.svg());
        for (x, y) in [(vec![1.0], vec![1.0, 2.0]), (vec![1.0, 2.0], vec![1.0])] {
            let values = vec![1.0, 2.0];
            assert_well_formed(&Map { x, y, values, ..Map::default() }.svg());
        }
    }

    #[test]
    fn values_far_from_the_others_are_told_at_the_bar() {
        let mut own = product();
        own.value_scale = Scale::Linear;
        own.values[0] = -5e5;
        let last = own.values.len() - 1;
        own.values[last] = 7e6;
        let svg = own.svg();
        assert_well_formed(&svg);
        assert_eq!(tags(&svg, "bar", "polygon").len(), 2);
        assert!(svg.contains("to 7") && svg.contains("to −5"), "{svg}");
    }

    #[test]
    fn lines_of_large_values_carry_their_power_of_ten() {
        let mut own = map();
        own.values.iter_mut().for_each(|value| *value *= 1e3);
        let svg = own.svg();
        let labels = svg.split("class=\"labels\"").nth(1).unwrap();
        assert!(labels.split("</g>").next().unwrap().contains("·10³"), "{svg}");
    }

    #[test]
    fn texts_of_limits_stay_within_the_frame() {
        let mut own = map();
        // A line through the corner of the lowest places.
        let value = |at: usize| if at % 8 + at / 8 < 2 { 0.0 } else { 1.0 };
        own.limits[0].values = (0..24).map(value).collect();
        own.limits[0].at = 0.5;
        let svg = own.svg();
        let number = |text: &str, key: &str| -> f64 {
            let rest = text.split(&format!(" {key}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let frame = svg.split("class=\"axes\"").nth(1).unwrap().split("<rect").nth(1).unwrap();
        let text =
            svg.split("class=\"limit-labels\"").nth(1).unwrap().split("<text").nth(1).unwrap();
        let half = 0.5 * 1.12 * text_width("ξmax = 1", theme::TICK_SIZE);
        let (left, bottom) = (number(frame, "x"), number(frame, "y") + number(frame, "height"));
        assert!(number(text, "x") - half > left + 2.0, "{text}");
        assert!(number(text, "y") + 4.0 < bottom, "{text}");
    }
}
