//! The curves of a figure of runs: which are shown, in which colours and patterns.

use super::{Of, RunRank, RunSeries, series::Quantity};
use crate::{Pattern, Series, theme::COLOURS};

/// The widest gap that is shown, as a part of the largest deformation.
const WIDEST: f64 = 0.5;
/// Curves beyond these in one figure cannot be told apart.
const MOST_CURVES: usize = 6;

/// The quantities of largest magnitude, in their order, and a remark when some are left out.
pub(super) fn largest(mut quantities: Vec<Quantity>, of: Of) -> (Vec<Quantity>, String) {
    let total = quantities.len();
    if total <= MOST_CURVES {
        return (quantities, String::new());
    }
    let size = |q: &Quantity| {
        let values = q.curves.iter().flatten().map(|p| p.1.abs()).filter(|v| v.is_finite());
        values.fold(0.0_f64, f64::max)
    };
    let mut sizes: Vec<f64> = quantities.iter().map(size).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let least = sizes[MOST_CURVES - 1];
    quantities.retain(|q| size(q) >= least);
    quantities.truncate(MOST_CURVES);
    let kind = match of {
        Of::Energy => "energies",
        Of::Acceleration | Of::Velocity => "masses",
        _ => "elements",
    };
    (quantities, format!("the {MOST_CURVES} largest of {total} {kind}"))
}

/// Whether the curves are those of one quantity in designs that have an order.
pub(super) fn has_order(runs: &[RunSeries], shown: &[Quantity]) -> bool {
    let is_whole = |quantity: &Quantity| quantity.curves.iter().all(|curve| !curve.is_empty());
    matches!(shown, [one] if is_whole(one)) && runs.iter().all(|run| run.rank.is_some())
}

/// Patterns of designs, in turn.
const DESIGNS: [Pattern; 4] =
    [Pattern::Solid, Pattern::Dashed, Pattern::Dotted, Pattern::DashDotted];

/// Pattern and colour of a design that has a place in an order.
fn ordered(own: RunRank) -> (Pattern, usize) {
    (DESIGNS[own.group % DESIGNS.len()], own.place)
}

/// Curves scaled from SI to the units of the axes: one colour per quantity, one pattern per run, and of a single
/// quantity of several designs one colour per design. Of several methods the first is broad and pale, so that another
/// one on it stays visible.
pub(super) fn curves(
    runs: &[RunSeries],
    quantities: &[Quantity],
    x_factor: f64,
    y_factor: f64,
) -> Vec<Series> {
    let alone = quantities.len() == 1;
    let has_order = has_order(runs, quantities);
    let mut series = Vec::new();
    for (run, of_run) in runs.iter().enumerate() {
        for (colour, quantity) in quantities.iter().enumerate() {
            let Some(curve) = quantity.curves.get(run).filter(|curve| !curve.is_empty()) else {
                continue;
            };
            let name = match (runs.len(), alone) {
                (0 | 1, _) => quantity.name.clone(),
                (_, true) if of_run.is_design => of_run.name.clone(),
                _ => format!("{}, {}", quantity.name, of_run.name),
            };
            let rank = of_run.rank.filter(|_| has_order);
            let (pattern, colour) = match run {
                _ if rank.is_some() => rank.map_or((Pattern::Solid, run), ordered),
                _ if of_run.is_design && alone => (DESIGNS[run / COLOURS % DESIGNS.len()], run),
                _ if of_run.is_design => (DESIGNS[run % DESIGNS.len()], colour),
                0 if runs.len() > 1 => (Pattern::Broad, colour),
                0 => (Pattern::Solid, colour),
                // A single quantity has colours to spare for its runs.
                _ if alone => (if run == 1 { Pattern::Dashed } else { Pattern::Dotted }, run),
                1 => (Pattern::Dashed, colour),
                _ => (Pattern::Dotted, colour),
            };
            let points = curve.iter().map(|&(x, y)| (x / x_factor, y / y_factor));
            series.push(Series::drawn(name, (colour, pattern), points));
        }
    }
    series
}

/// Leaves out the parts of flights in which a contact is wide open, so that they do not flatten the curves of what
/// deforms. Returns the widest gap that is shown \[m\] where any is wider.
pub(super) fn cut_off(runs: &[RunSeries], all: &mut [Quantity]) -> Option<f64> {
    let is_contact = |quantity: &Quantity| {
        let elements = runs.iter().flat_map(|run| &run.elements);
        elements.filter(|element| element.name == quantity.name).any(|element| element.is_contact)
    };
    let deforming = all.iter().filter(|own| !is_contact(own));
    let sizes = deforming.flat_map(|own| own.curves.iter().flatten()).map(|point| point.1.abs());
    let widest = WIDEST * sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    if widest <= 0.0 {
        return None;
    }
    let mut is_cut = false;
    for quantity in all.iter_mut().filter(|own| is_contact(own)) {
        for point in quantity.curves.iter_mut().flatten().filter(|point| point.1 < -widest) {
            (point.1, is_cut) = (f64::NAN, true);
        }
    }
    is_cut.then_some(widest)
}
