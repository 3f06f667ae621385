//! Maps: a value over two quantities, as colours with lines of equal value; frame, axes and the bar of colours.

mod bands;
mod bar;
mod colours;
mod contours;
mod lines;
mod markers;
mod regions;
#[cfg(test)]
mod tests;
mod texts;

use std::fmt::Write as _;

use self::{
    bands::Field,
    colours::Colours,
    lines::{draw_limit, draw_path},
    regions::patterns,
    texts::{Texts, text, upright},
};
use crate::{
    Marker, Scale,
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
///         ..MapLimit::default()
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
    /// Points that carry a text, such as the best design.
    pub markers: Vec<Marker>,
}

/// A line on which a quantity has a certain value, such as that of a padding pressed to nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MapLimit {
    /// The quantity, row by row.
    pub values: Vec<f64>,
    /// Its value on the line.
    pub at: f64,
    /// Text at the line.
    pub label: String,
    /// On which side of the line the limit is kept; the other one is hatched.
    pub kept: Side,
    /// Absolute errors of the quantity, row by row: where the line lies within them, it is undecided whether the limit
    /// is kept. Empty where values stand for themselves.
    pub errors: Vec<f64>,
    /// Where a value decides nothing unless it is beyond the line, row by row; empty for nowhere.
    pub doubted: Vec<bool>,
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

const BANDS: usize = 32;
/// What is said of dots.
const UNDECIDED: &str = "dotted: undecided";
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
            svg += &patterns(&pattern);
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
        for (at, (limit, of_limit)) in self.limits.iter().zip(&lines).enumerate() {
            self.draw_beyond(&mut own, &frame, limit, &pattern);
            self.draw_undecided(&mut own, &frame, limit, (&pattern, at));
            draw_limit(&mut own, of_limit);
        }
        self.put_markers(&frame, &mut texts, &lines.concat().concat());
        for (at, limit) in self.limits.iter().enumerate() {
            let others = lines.iter().enumerate().filter(|other| other.0 != at);
            let others: Vec<_> =
                others.flat_map(|other| other.1.iter().flatten().copied()).collect();
            texts.put(&one_line(&limit.label), &lines[at], Some(&others));
        }
        self.draw_lines(&mut svg, &frame, (&field, &shares, &colours), &mut texts);
        svg += &own;
        self.draw_markers(&mut svg, &frame);
        texts.draw(&mut svg);
        self.draw_axes(&mut svg, &frame, &heading, sheet.width);
        bar::draw(&mut svg, &frame, &colours, &self.value_label);
        svg + "</svg>\n"
    }

    /// A name for its patterns that other drawings on a page do not have (FNV-1a of what sets them apart).
    fn pattern(&self, sheet: Sheet) -> String {
        let texts = [&self.title, &self.note, &self.x_label, &self.y_label, &self.value_label];
        let bytes = texts.into_iter().flat_map(|own| own.bytes().chain([0]));
        let all = bytes.chain(sheet.width.to_bits().to_be_bytes());
        let hash = all.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        format!("{hash:016x}")
    }

    /// The remark, and which limits are kept everywhere or nowhere.
    fn remark(&self) -> String {
        let unlined = self.limits.iter().filter_map(MapLimit::unlined);
        let own = Some(self.note.clone()).filter(|own| !own.is_empty());
        let is_open = self.limits.iter().any(MapLimit::is_dotted);
        let open = is_open.then(|| UNDECIDED.to_owned());
        own.into_iter().chain(unlined).chain(open).collect::<Vec<_>>().join("; ")
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
            let label = frame.x.tick_label(tick);
            texts.push(text((at, bottom + 18.0), "middle", theme::TICK_SIZE, &label));
        }
        for &tick in frame.y.ticks() {
            let (_, at) = frame.at(x0.unwrap_or(1.0), tick);
            draw_path(svg, &[(left - theme::MINOR_LENGTH, at), (left, at)]);
            let label = frame.y.tick_label(tick);
            texts.push(text((left - 8.0, at + 4.5), "end", theme::TICK_SIZE, &label));
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
        let room = bottom - top + theme::UPRIGHT_ROOM;
        let y_label = clip_width(&frame.y.title(&self.y_label), theme::LABEL_SIZE, room);
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
