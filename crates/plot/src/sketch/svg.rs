//! A network as a mechanical diagram in SVG.

use super::blocks::{Pen, Sizes};
use super::layout::{Metrics, plan};
use super::order::Extent;
use super::symbols::{Canvas, GRAVITY, LINE, Weight, gravity_width, leaf_extent, node_extent};
use super::{Sketch, SketchLink, SketchTree, list};
use crate::text_metrics::{escape, text_width};
use crate::theme;

/// Elements or nodes beyond which a drawing helps nobody.
const MOST: usize = 80;
/// Room for the name of a link above its symbols \[px\].
const NAME: f64 = 1.5 * theme::LABEL_SIZE;

impl Pen for Canvas {
    fn wire(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.straight(from, to);
    }

    fn symbol(&mut self, leaf: &SketchTree, at: (f64, f64), extent: Extent) {
        self.element(leaf, at, extent);
    }
}

impl Sketch {
    /// The network as one SVG element without any outer resource, in its natural size (1 unit = 1 px).
    ///
    /// Nodes stand in layers from the impactor on the left to the support on the right, parallel branches one above
    /// the other, unconnected parts one below the other. Above 80 elements or nodes it says what the network has.
    pub fn svg(&self) -> String {
        if !self.is_drawable(MOST) {
            return self.summary();
        }
        let sizes = Sizes { leaf: &leaf_extent, gap: 8.0, rail: 14.0, wire: 0.0 };
        let link_extent = |index: usize| named_extent(&self.links[index], &sizes);
        let metrics = Metrics {
            node: &|index| node_extent(&self.nodes[index]),
            link: &link_extent,
            through: Extent { width: 0.0, up: 6.0, down: 6.0 },
            gap: 16.0,
            lead: 9.0,
            track: 9.0,
            wire: 0.0,
        };
        let plan = plan(self, &metrics);
        let mut canvas = Canvas::default();
        let mut size = (plan.width, plan.height);
        if let Some(gravity) = &self.gravity {
            canvas.gravity(gravity, (theme::MARGIN, theme::MARGIN + theme::TICK_SIZE));
            size = (size.0.max(gravity_width(gravity)), size.1 + GRAVITY);
        }
        let top = theme::MARGIN + size.1 - plan.height;
        let moved = |(x, y): (f64, f64)| (x + theme::MARGIN, y + top);
        for wire in &plan.wires {
            let points: Vec<(f64, f64)> = wire.iter().map(|p| moved(*p)).collect();
            canvas.line(&points, theme::LINE_WIDTH);
        }
        for placed in &plan.links {
            let link = &self.links[placed.index];
            let tree = sizes.extent(&link.tree);
            let (x, y) = moved((placed.x, placed.y));
            let start = x + (0.5 * (placed.extent.width - tree.width)).floor();
            let (end, right) = (start + tree.width, x + placed.extent.width);
            canvas.wire((x, y), (start, y));
            canvas.wire((end, y), (right, y));
            sizes.draw(&link.tree, (start, y), placed.reversed, &mut canvas);
            let name = (x + 0.5 * placed.extent.width, y - tree.up - 0.35 * theme::LABEL_SIZE);
            canvas.text(name, &link.name, Weight::Bold);
        }
        for placed in &plan.nodes {
            let at = moved((placed.x, placed.y));
            canvas.node(&self.nodes[placed.index], at, placed.extent, placed.wired);
        }
        framed(size, &canvas)
    }

    fn summary(&self) -> String {
        let mut canvas = Canvas::default();
        let mut height = 0.0;
        let mut width = 0.0_f64;
        let lines = list::counts(self);
        for line in &lines {
            width = width.max(text_width(line, theme::TICK_SIZE));
        }
        for line in &lines {
            height += LINE;
            canvas.text((0.5 * width + theme::MARGIN, height + 10.0), line, Weight::Plain);
        }
        framed((width, height), &canvas)
    }
}

/// Extent of a link with its name.
fn named_extent(link: &SketchLink, sizes: &Sizes<'_>) -> Extent {
    let tree = sizes.extent(&link.tree);
    if link.name.is_empty() {
        return tree;
    }
    let name = (1.1 * text_width(&link.name, theme::LABEL_SIZE) + 8.0).ceil();
    Extent { width: tree.width.max(name), up: tree.up + NAME, down: tree.down }
}

fn framed((width, height): (f64, f64), canvas: &Canvas) -> String {
    let width = (width + 2.0 * theme::MARGIN).ceil();
    let height = (height + 2.0 * theme::MARGIN).ceil();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n{}</svg>\n",
        escape("Network"),
        theme::PAPER.hex(),
        canvas.svg
    )
}

#[cfg(test)]
mod tests {
    use crate::sketch::tests::{chain, reference, tangled};
    use crate::well_formed::assert_well_formed;

    #[test]
    fn the_reference_network_shows_every_name_and_value() {
        let svg = reference().svg();
        assert_well_formed(&svg);
        for text in ["head", "10 m/s →", "padding", "6 kN s/m", "50 MN/m", "mount", "ground"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
        let bodies = svg.matches("<rect").count() - 1;
        assert_eq!(bodies, 2);
    }

    #[test]
    fn any_graph_is_drawn_with_its_texts_escaped() {
        let svg = tangled().svg();
        assert_well_formed(&svg);
        assert!(svg.contains(">&lt;joint&gt; &amp; pivot</text>"), "{svg}");
        assert!(svg.contains("Körper 頭"));
    }

    #[test]
    fn large_and_empty_networks_have_a_picture_too() {
        let svg = chain(1000).svg();
        assert_well_formed(&svg);
        assert!(svg.contains("1000 masses") && svg.len() < 4000, "{svg}");
        assert_well_formed(&crate::Sketch::default().svg());
    }
}
