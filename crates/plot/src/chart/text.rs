//! A chart as text for a terminal, with curves in braille dots.

use super::naming::{Place, Tag, same_name, tags};
use super::{Chart, Direction, Pattern};
use crate::axis::Axis;
use crate::text_metrics::{clip_columns, columns, one_line};

/// Dots of a braille character at (column, row from the top), as bits above U+2800.
const DOTS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

/// What stands in one character of the plot.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Cell {
    Dots(u32),
    Char(char),
}

impl Chart {
    /// The chart as lines of at most `width` columns; the plot itself has `height` lines, the frame, title, axis
    /// labels and legend come to it. Sizes below 30 × 4 are raised to that.
    pub fn text(&self, width: usize, height: usize) -> String {
        let (width, height) = (width.max(30), height.max(4));
        let (x, y) = self.axes(width / 12, height / 3);
        let ticks: Vec<(usize, String)> =
            y.ticks().iter().map(|t| (row(&y, *t, height), y.tick_label(*t))).collect();
        let margin = ticks.iter().map(|(_, label)| columns(label)).max().unwrap_or(0);
        let wide = width - margin - 2;
        let size = (2 * wide, 4 * height);
        let dots: Vec<_> =
            (0..self.series.len()).map(|index| self.dots(index, &x, &y, size)).collect();
        let tags = tags(&dots.iter().map(|dots| places(dots)).collect::<Vec<_>>());
        let cells = self.plot(&x, &y, &dots, &tags, (wide, height));

        let mut lines = Vec::new();
        for heading in [&self.title, &self.note, &y.title(&self.y_label)] {
            if !heading.is_empty() {
                lines.push(clip_columns(&one_line(heading), width));
            }
        }
        for (index, cells) in cells.iter().enumerate() {
            let label =
                ticks.iter().find(|(row, _)| *row == index).map(|(_, label)| label.as_str());
            let border = if label.is_some() { '┤' } else { '│' };
            let plot: String = cells.iter().map(|cell| character(*cell)).collect();
            lines
                .push(format!("{:>margin$} {border}{plot}", label.unwrap_or("")).trim_end().into());
        }
        lines.extend(self.bottom(&x, margin, wide));
        lines.extend(self.names(&tags, width));
        lines.extend(self.remarks(&x, &y, width));
        lines.join("\n") + "\n"
    }

    /// All dots of a curve or of its stems, on a field of this width and height.
    fn dots(&self, index: usize, x: &Axis, y: &Axis, size: (usize, usize)) -> Vec<(usize, usize)> {
        let points = &self.series[index].points;
        let at = |p: (f64, f64)| (x.fraction(p.0), 1.0 - y.fraction(p.1));
        let takes = |p: &(f64, f64)| x.takes(p.0) && y.takes(p.1);
        if self.stroke(index).pattern == Pattern::Stems {
            let foot = 1.0 - y.foot();
            let ends = points.iter().filter(|p| takes(p)).map(|p| at(*p));
            return ends.flat_map(|end| line_dots((end.0, foot), end, size)).collect();
        }
        if self.stroke(index).pattern == Pattern::Points {
            let ends = points.iter().filter(|p| takes(p)).map(|p| at(*p));
            return ends.flat_map(|end| line_dots(end, end, size)).collect();
        }
        let mut dots: Vec<(usize, usize)> = Vec::new();
        for (i, point) in points.iter().enumerate().filter(|(_, p)| takes(p)) {
            let end = at(*point);
            let start = i.checked_sub(1).map(|i| points[i]).filter(takes).map_or(end, at);
            dots.extend(line_dots(start, end, size));
        }
        dots.dedup();
        dots
    }

    fn plot(
        &self,
        x: &Axis,
        y: &Axis,
        dots: &[Vec<(usize, usize)>],
        tags: &[Tag],
        (wide, height): (usize, usize),
    ) -> Vec<Vec<Cell>> {
        let mut cells = vec![vec![Cell::Dots(0); wide]; height];
        for limit in &self.lines {
            match limit.direction {
                Direction::Horizontal if y.holds(limit.at) => {
                    cells[row(y, limit.at, height)].fill(Cell::Char('┄'));
                }
                Direction::Vertical if x.holds(limit.at) => {
                    let at = place(x.fraction(limit.at), wide);
                    cells.iter_mut().for_each(|row| row[at] = Cell::Char('┆'));
                }
                _ => {}
            }
        }
        for (column, row) in dots.iter().flatten() {
            let cell = &mut cells[row / 4][column / 2];
            let already = if let Cell::Dots(dots) = *cell { dots } else { 0 };
            *cell = Cell::Dots(already | DOTS[column % 2][row % 4]);
        }
        self.number_lines(&mut cells, x, y);
        let is_single = !tags.iter().any(|tag| matches!(tag, Tag::Letter('b', _)));
        for tag in tags.iter().filter(|_| !is_single) {
            if let Tag::Letter(letter, Some((row, column))) = *tag {
                cells[row][column] = Cell::Char(letter);
            }
        }
        for marker in self.marked() {
            cells[row(y, marker.y, height)][place(x.fraction(marker.x), wide)] = Cell::Char('●');
        }
        cells
    }

    /// The number of a line, where several run in its direction.
    fn line_number(&self, index: usize) -> Option<char> {
        let direction = self.lines[index].direction;
        let is_single = self.lines.iter().filter(|line| line.direction == direction).count() == 1;
        ('1'..='9').nth(index).filter(|_| !is_single)
    }

    /// Puts the numbers of lines on them, right or on top, where nothing else stands.
    fn number_lines(&self, cells: &mut [Vec<Cell>], x: &Axis, y: &Axis) {
        let height = cells.len();
        for (index, line) in self.lines.iter().enumerate() {
            let Some(number) = self.line_number(index) else { continue };
            match line.direction {
                Direction::Horizontal if y.holds(line.at) => {
                    let row = &mut cells[row(y, line.at, height)];
                    let is_free = |c: &usize| row[c - 1..=*c] == [Cell::Char('┄'); 2];
                    if let Some(at) = (1..row.len()).rev().step_by(2).find(is_free) {
                        row[at] = Cell::Char(number);
                    }
                }
                Direction::Vertical if x.holds(line.at) => {
                    let at = place(x.fraction(line.at), cells[0].len());
                    let free = cells.iter_mut().find(|row| row[at] == Cell::Char('┆'));
                    if let Some(row) = free {
                        row[at] = Cell::Char(number);
                    }
                }
                _ => {}
            }
        }
    }

    /// The horizontal axis with its ticks and its label.
    fn bottom(&self, x: &Axis, margin: usize, wide: usize) -> [String; 3] {
        let mut axis = vec!['─'; wide];
        let mut labels = String::new();
        for tick in x.ticks() {
            let at = place(x.fraction(*tick), wide);
            axis[at] = '┬';
            let label = x.tick_label(*tick);
            let start = (margin + 2 + at).saturating_sub(columns(&label) / 2);
            let start = start.min((margin + 2 + wide).saturating_sub(columns(&label)));
            if labels.is_empty() || start > columns(&labels) {
                labels.extend(std::iter::repeat_n(' ', start.saturating_sub(columns(&labels))));
                labels += &label;
            }
        }
        let label = clip_columns(&one_line(&x.title(&self.x_label)), wide);
        let indent = margin + 2 + (wide - columns(&label)) / 2;
        let axis: String = axis.into_iter().collect();
        [format!("{:margin$} └{axis}", ""), labels, format!("{:indent$}{label}", "")]
    }

    /// The curves' names with their letters, in lines.
    fn names(&self, tags: &[Tag], width: usize) -> Vec<String> {
        let is_single = !tags.iter().any(|tag| matches!(tag, Tag::Letter('b', _)));
        let mut lines: Vec<String> = Vec::new();
        for (index, series) in self.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty()) {
            let name = one_line(&series.name);
            let entry = match tags[index] {
                Tag::Letter(..) if is_single => format!("  {name}"),
                Tag::Letter(letter, _) => format!("  {letter} {name}"),
                Tag::Same(host) => {
                    let host = one_line(&self.series[host].name);
                    format!("  {}", same_name(&name, &host, self.is_linear()))
                }
                Tag::Within(host) => {
                    format!("  {name} (on a part of {})", one_line(&self.series[host].name))
                }
            };
            match lines.last_mut() {
                Some(line) if columns(line) + columns(&entry) <= width => *line += &entry,
                _ => lines.push(clip_columns(&entry, width)),
            }
        }
        lines
    }

    /// Limits and markers, one a line.
    fn remarks(&self, x: &Axis, y: &Axis, width: usize) -> Vec<String> {
        let mut lines = Vec::new();
        for (index, line) in self.lines.iter().enumerate() {
            let (on_axis, dash) = match line.direction {
                Direction::Horizontal => (y.holds(line.at), '┄'),
                Direction::Vertical => (x.holds(line.at), '┆'),
            };
            let remark = if on_axis { "" } else { " (off the axis)" };
            let number = self.line_number(index).map_or(String::new(), |n| format!("{n} "));
            lines.push(format!("  {number}{dash} {}{remark}", one_line(&line.label)));
        }
        lines.extend(self.markers.iter().map(|marker| format!("  ● {}", one_line(&marker.label))));
        lines.iter().map(|line| clip_columns(line, width)).collect()
    }
}

/// The characters in which a curve's dots lie, in its order.
fn places(dots: &[(usize, usize)]) -> Vec<Place> {
    let mut places: Vec<Place> = dots.iter().map(|(column, row)| (row / 4, column / 2)).collect();
    places.dedup();
    places
}

fn character(cell: Cell) -> char {
    match cell {
        Cell::Dots(0) => ' ',
        Cell::Dots(dots) => char::from_u32(0x2800 + dots).unwrap_or(' '),
        Cell::Char(c) => c,
    }
}

/// All dots on the straight line between two places, given as parts of the field's width and height.
fn line_dots(
    start: (f64, f64),
    end: (f64, f64),
    (wide, high): (usize, usize),
) -> Vec<(usize, usize)> {
    let stride = (wide as f64).recip().min((high as f64).recip());
    let steps = 1.0_f64.max(((end.0 - start.0).abs().max((end.1 - start.1).abs()) / stride).ceil());
    let mut dots = Vec::new();
    let mut step = 0.0;
    while step <= steps {
        let part = step / steps;
        dots.push((
            place(start.0 + part * (end.0 - start.0), wide),
            place(start.1 + part * (end.1 - start.1), high),
        ));
        step += 1.0;
    }
    dots
}

fn row(y: &Axis, value: f64, height: usize) -> usize {
    place(1.0 - y.fraction(value), height)
}

/// The one of `count` equal parts of 0…1 in which `fraction` lies, kept within them.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is clamped to 0…count before"
)]
fn place(fraction: f64, count: usize) -> usize {
    ((fraction.clamp(0.0, 1.0) * count as f64) as usize).min(count - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Marker, ReferenceLine, Scale, Series};

    fn chart(points: Vec<(f64, f64)>) -> Chart {
        Chart {
            title: "Köpfe".into(),
            x_label: "time (ms)".into(),
            y_label: "force (kN)".into(),
            series: vec![Series::new("頭部", points)],
            markers: vec![Marker { x: 1.0, y: 38.0, label: "peak".into() }],
            lines: vec![ReferenceLine {
                direction: Direction::Horizontal,
                at: 20.0,
                label: "limit".into(),
                colour: None,
            }],
            ..Chart::default()
        }
    }

    #[test]
    fn lines_keep_the_width_and_carry_labels_and_markers() {
        let points = (0..500).map(|i| f64::from(i) * 0.04).map(|t| (t, 38.0 * t * (1.0 - t).exp()));
        let text = chart(points.collect()).text(80, 16);
        assert!(text.lines().all(|line| columns(line) <= 80), "{text}");
        for part in ["Köpfe", "time (ms)", "force (kN)", "頭部", "● peak", "┄ limit", "20"] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }

    #[test]
    fn any_data_give_a_plot_of_the_asked_height() {
        let hard = [
            vec![],
            vec![(0.0, 0.0)],
            vec![(0.0, f64::NAN), (1.0, f64::INFINITY)],
            vec![(-f64::MAX, -f64::MAX), (f64::MAX, f64::MAX)],
            vec![(0.0, 5.0), (1.0, 5.0)],
        ];
        for points in hard {
            let chart = Chart {
                y_label: "force (N)".into(),
                series: vec![Series::new("", points)],
                ..Chart::default()
            };
            let text = chart.text(40, 8);
            assert_eq!(text.lines().count(), 1 + 8 + 3, "{text}");
        }
    }

    #[test]
    fn lines_of_one_direction_are_numbered() {
        let mut chart = chart(vec![(0.0, 0.0), (1.0, 40.0)]);
        assert!(chart.text(80, 16).contains("  ┄ limit"));
        let second = ReferenceLine { at: 10.0, label: "floor".into(), ..chart.lines[0].clone() };
        chart.lines.push(second);
        let text = chart.text(80, 16);
        let at = |part: &str| text.find(part).unwrap_or_else(|| panic!("{part} in\n{text}"));
        assert!(at("┄1") < at("┄2"), "{text}");
        assert!(at("  1 ┄ limit") < at("  2 ┄ floor"));
    }

    #[test]
    fn curves_that_look_alike_over_decades_are_not_called_the_same() {
        let points = |size: f64| (0..9).map(|e| 10_f64.powi(e)).map(|x| (x, size * x)).collect();
        let chart = Chart {
            series: vec![Series::new("A", points(1.0)), Series::new("B", points(1.05))],
            x_scale: Scale::logarithmic("rad/s"),
            y_scale: Scale::logarithmic("N/m"),
            ..Chart::default()
        };
        assert!(chart.text(80, 16).contains("B ≈ A"));
    }

    #[test]
    fn stems_rise_from_the_foot_of_the_plot() {
        let stroke = Some(crate::Stroke { colour: 0, pattern: Pattern::Stems });
        let mut chart = Chart {
            series: vec![Series { name: String::new(), points: vec![(10.0, 1e3)], stroke }],
            markers: vec![Marker { x: 1.0, y: 1.0, label: "corner".into() }],
            x_scale: Scale::logarithmic("s"),
            y_scale: Scale::logarithmic("N/m"),
            ..Chart::default()
        };
        chart.markers.push(Marker { x: 100.0, y: 1e4, label: "corner".into() });
        let (x, y) = chart.axes(6, 6);
        let dots = chart.dots(0, &x, &y, (40, 40));
        assert!(dots.iter().all(|dot| dot.0 == 20), "{dots:?}");
        assert_eq!(dots.iter().map(|dot| dot.1).max(), Some(39));
    }

    #[test]
    fn a_rising_line_goes_from_the_lower_left_to_the_upper_right() {
        let dots = line_dots((0.0, 1.0), (1.0, 0.0), (20, 12));
        assert_eq!((dots.first(), dots.last()), (Some(&(0, 11)), Some(&(19, 0))));
        assert!(
            dots.windows(2).all(|d| d[0].0.abs_diff(d[1].0) <= 1 && d[0].1.abs_diff(d[1].1) <= 1)
        );
    }
}
