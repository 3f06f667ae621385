//! A network as a list with counts, where a drawing would be too wide or too large.

use super::symbols::{SYMBOLS, word};
use super::{Census, Sketch, SketchGravity, SketchKind, SketchNode, SketchTree};
use crate::text_metrics::{clip_columns, columns, one_line};

/// Rows of one table before the rest is only counted.
const MOST_ROWS: usize = 14;
/// Nesting beyond which parts are only counted.
const DEEPEST: usize = 6;

/// How many nodes and elements of each kind, in two lines.
pub(super) fn counts(sketch: &Sketch) -> Vec<String> {
    let of_kind = |kind| sketch.nodes.iter().filter(|n| n.kind == kind).count();
    let nodes = sentence(&[
        (of_kind(SketchKind::Mass), "mass", "masses"),
        (of_kind(SketchKind::Massless), "joint", "joints"),
        (of_kind(SketchKind::Face) + of_kind(SketchKind::HeavyFace), "face", "faces"),
        (of_kind(SketchKind::Prescribed), "prescribed motion", "prescribed motions"),
        (of_kind(SketchKind::Fixed), "support", "supports"),
    ]);
    let census = sketch.census();
    let kinds = census.of_kind.iter().map(|((place, kind), &count)| {
        let plain = kind.replace('-', " ");
        let of_kind = || [plain.clone(), format!("{plain}s")];
        let [one, many] =
            SYMBOLS.get(*place).map_or_else(of_kind, |own| own.names.map(str::to_owned));
        (count, one, many)
    });
    let kinds: Vec<(usize, String, String)> = kinds.collect();
    let kinds = kinds.iter().map(|(count, one, many)| (*count, one.as_str(), many.as_str()));
    let others = (census.others, "other element", "other elements");
    let elements = sentence(&kinds.chain([others]).collect::<Vec<_>>());
    let links = sentence(&[(sketch.links.len(), "link", "links")]);
    vec![nodes, format!("{links}: {elements}")]
}

fn sentence(counts: &[(usize, &str, &str)]) -> String {
    let parts: Vec<String> = counts
        .iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, many)| format!("{count} {}", if *count == 1 { one } else { many }))
        .collect();
    if parts.is_empty() { String::from("none") } else { parts.join(", ") }
}

/// The values of a node and the forces on it, line by line.
pub(super) fn lines_and_loads(node: &SketchNode) -> Vec<String> {
    let loads = node.loads.iter().map(|load| format!("⇒ {}", one_line(load)));
    node.lines.iter().map(|line| one_line(line)).chain(loads).collect()
}

pub(super) fn gravity(gravity: &SketchGravity) -> String {
    let arrow = if gravity.pulls_back { '←' } else { '→' };
    format!("g = {} {arrow}", one_line(&gravity.label))
}

/// Counts and tables of nodes and links in lines of at most `width` columns.
pub(super) fn list(sketch: &Sketch, width: usize) -> String {
    let nodes = sketch
        .nodes
        .iter()
        .map(|node| [node.name.clone(), word(node.kind).into(), lines_and_loads(node).join(", ")]);
    let name = |index: usize| sketch.nodes.get(index).map_or("?", |node| node.name.as_str());
    let links = sketch.links.iter().map(|link| {
        let ends = format!("{} → {}", name(link.from), name(link.to));
        [link.name.clone(), ends, words(&link.tree, 0)]
    });
    let mut lines: Vec<String> = sketch.gravity.iter().map(gravity).collect();
    lines.extend(counts(sketch));
    for rows in [table(nodes, width), table(links, width)] {
        lines.push(String::new());
        lines.extend(rows);
    }
    let clipped: Vec<String> = lines.iter().map(|line| clip_columns(line, width)).collect();
    clipped.join("\n") + "\n"
}

/// Rows of three cells, the last one wrapped; the first rows and the number of the others.
fn table(rows: impl ExactSizeIterator<Item = [String; 3]>, width: usize) -> Vec<String> {
    let hidden = if rows.len() > MOST_ROWS { rows.len() - MOST_ROWS + 1 } else { 0 };
    let shown = rows.len() - hidden;
    let rows: Vec<[String; 3]> =
        rows.take(shown).map(|row| row.map(|cell| one_line(&cell))).collect();
    let widest =
        |cell: usize| rows.iter().map(|row| columns(&row[cell])).max().unwrap_or(0).min(width / 3);
    let (first, second) = (widest(0), widest(1));
    let indent = first + second + 6;
    let mut lines = Vec::new();
    for [a, b, c] in &rows {
        let mut start = format!("  {}  {}  ", padded(a, first), padded(b, second));
        for part in wrapped(c, width.saturating_sub(indent)) {
            lines.push(format!("{start}{part}").trim_end().to_owned());
            start = " ".repeat(indent);
        }
    }
    if hidden > 0 {
        lines.push(format!("  … and {hidden} more"));
    }
    lines
}

fn padded(text: &str, width: usize) -> String {
    let clipped = clip_columns(text, width);
    let blanks = width.saturating_sub(columns(&clipped));
    clipped + &" ".repeat(blanks)
}

/// `text` broken at blanks into lines of `width` columns; at least one line.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if columns(&lines[last]) + 1 + columns(word) <= width {
            lines[last].push(' ');
            lines[last].push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A tree in words: `–` for series, `∥` for parallel.
fn words(tree: &SketchTree, depth: usize) -> String {
    let join = |parts: &[SketchTree], sign: &str| {
        if depth >= DEEPEST {
            return format!("({} elements)", Census::of(parts.iter()).elements());
        }
        let parts: Vec<String> = parts.iter().map(|part| words(part, depth + 1)).collect();
        let joined = parts.join(sign);
        if depth > 0 && parts.len() > 1 { format!("({joined})") } else { joined }
    };
    match tree {
        SketchTree::Element { kind, label, .. } if label.contains(kind.as_str()) => label.clone(),
        SketchTree::Element { kind, label, .. } => format!("{kind} {label}").trim_end().to_owned(),
        SketchTree::Series(parts) if parts.is_empty() => String::from("rigid"),
        SketchTree::Parallel(parts) if parts.is_empty() => String::from("not connected"),
        SketchTree::Series(parts) => join(parts, " – "),
        SketchTree::Parallel(parts) => join(parts, " ∥ "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::tests::{chain, reference, spring};

    #[test]
    fn a_model_reads_as_series_and_parallel() {
        assert_eq!(
            words(&reference().links[0].tree, 0),
            "spring 20 MN/m – dashpot 6 kN s/m – (spring 20 MN/m ∥ dashpot 4 kN s/m)"
        );
    }

    #[test]
    fn deep_nesting_is_counted() {
        let mut tree = spring("1 N/m");
        for _ in 0..2_000 {
            tree = SketchTree::Parallel(vec![tree, SketchTree::element("rigid", "")]);
        }
        assert!(words(&tree, 0).len() < 200);
    }

    #[test]
    fn the_list_wraps_and_counts() {
        let text = list(&reference(), 50);
        assert!(
            text.starts_with("2 masses, 1 support\n2 links: 3 springs, 3 dashpots\n"),
            "{text}"
        );
        assert!(text.lines().all(|line| columns(line) <= 50), "{text}");
        assert!(text.contains("head → panel"), "{text}");
        assert!(list(&chain(100), 80).contains("… and 87 more"));
    }
}
