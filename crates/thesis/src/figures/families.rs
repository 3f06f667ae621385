//! Figures 5 to 20: four curves for the families of a, b, c and d.

use dashpot_plot::{Chart, Direction, Marker, Pattern, ReferenceLine, Series};

use super::{Column, Figure};
use crate::{
    Family, Groups, Impact, Member, Scales, Study,
    words::{short, significant},
};

/// Curves run from τ* = 0 to this, 10 ms in chapter IV, with so many points in between.
const END: f64 = 5.0;
const POINTS: u32 = 500;

/// What is drawn over what.
struct Kind {
    /// Number of the first figure.
    first: usize,
    /// The title in the thesis, `_` being the letter of the parameter.
    title: &'static str,
    heading: &'static str,
    /// Places of the abscissa and the ordinate in a [`State`].
    axes: [usize; 2],
    /// The line at the thickness.
    limit: Option<Direction>,
}

const KINDS: [Kind; 4] = [
    Kind {
        first: 5,
        title: "Padding deformation history during impact, effect of parameter _",
        heading: "Deformation over time",
        axes: [0, 1],
        limit: Some(Direction::Horizontal),
    },
    Kind {
        first: 9,
        title: "Impact force as a function of time with _ as parameter",
        heading: "Force over time",
        axes: [0, 2],
        limit: None,
    },
    Kind {
        first: 13,
        title: "Stress-strain response as a function of parameter _",
        heading: "Force over deformation",
        axes: [1, 2],
        limit: Some(Direction::Vertical),
    },
    Kind {
        first: 17,
        title: "Energy absorption with _ as parameter",
        heading: "Energy over time",
        axes: [0, 3],
        limit: None,
    },
];

/// τ*, ξ, φ and ω.
type State = [f64; 4];
const LABELS: [&str; 4] = ["τ*", "deformation ξ", "force φ", "energy ω"];
const COLUMNS: [&str; 4] = ["tau*", "xi", "phi", "omega"];

fn state(impact: &Impact, time: f64, energy: f64) -> State {
    [time, impact.deformation(time), impact.force(time), energy]
}

/// The figures in their order: a, b, c and d of each kind.
pub(super) fn figures(study: &Study) -> Vec<Figure> {
    let families = study.groups.each_ref().map(|family| (family, family.each(samples)));
    let of = |kind: &Kind| {
        let numbered = families.iter().enumerate();
        let figures = numbered.map(|(at, own)| figure(kind.first + at, kind, own));
        figures.collect::<Vec<_>>()
    };
    KINDS.iter().flat_map(of).collect()
}

fn samples(impact: &Impact) -> Vec<State> {
    let time = |at: u32| END * f64::from(at) / f64::from(POINTS);
    let mut energy = 0.0;
    let state = |at: u32| {
        if at > 0 {
            energy += impact.energy_between(time(at - 1), time(at));
        }
        state(impact, time(at), energy)
    };
    (0..=POINTS).map(state).collect()
}

fn figure(number: usize, kind: &Kind, own: &(&Family, [Vec<State>; 5])) -> Figure {
    let (family, curves) = own;
    let symbol = family.varied.symbol();
    let [x, y] = kind.axes;
    let members = || family.members.iter().zip(curves);
    let series = members().enumerate().map(|(colour, (member, curve))| {
        let pattern = if member.exceeds() { Pattern::Dashed } else { Pattern::Solid };
        let points = curve.iter().map(|own| (own[x], own[y]));
        Series::drawn(legend(family, member), (colour, pattern), points)
    });
    let marker = |member: &Member| {
        let own = &member.impact;
        let time = own.meets_thickness().filter(|time| *time <= END)?;
        let state = state(own, time, own.energy(time));
        let label = format!("{}: ξ = 1", family.varied.equals(member.value));
        Some(Marker { x: state[x], y: state[y], label })
    };
    let line = |direction| ReferenceLine::new(direction, 1.0, "thickness");
    let chart = Chart {
        title: format!("Figure {number}. {}, {symbol} varied", kind.heading),
        note: note(),
        x_label: LABELS[x].to_owned(),
        y_label: LABELS[y].to_owned(),
        family: family.members.len(),
        series: series.collect(),
        markers: family.members.iter().filter_map(marker).collect(),
        lines: kind.limit.into_iter().map(line).collect(),
        ..Chart::default()
    };
    let column = |curve: &[State], at: usize, what: &str| Column {
        name: format!("{}{what} [1]", COLUMNS[at]),
        values: curve.iter().map(|own| own[at]).collect(),
    };
    let shown = || kind.axes.into_iter().filter(|at| *at > 0);
    let columns = members().flat_map(|(member, curve)| {
        let value = format!(" at {symbol} = {}", short(member.value, 6));
        shown().map(move |at| column(curve, at, &value))
    });
    let columns = [column(&curves[0], 0, "")].into_iter().chain(columns).collect();
    Figure::of_chart(number, &kind.title.replace('_', symbol), chart, columns)
}

fn note() -> String {
    let Groups { a, b, c, d, alpha, beta, gamma, .. } = Groups::PRINTED;
    let milliseconds = 1e3 * Scales::CHAPTER_4.time();
    format!(
        "Base: a {a}, b {b}, c = e = {c}, d {d}, α {alpha}, β {beta}, γ {gamma}; {milliseconds} ms are 1 \
         of τ*"
    )
}

/// The padding of a curve in SI units, q, and the largest deformation.
fn legend(family: &Family, member: &Member) -> String {
    let pad = member.padding().map_or_else(String::new, |own| {
        let [k1, k2] = [own.k1, own.k2].map(|own| significant(own / 1e6, 3));
        let [c1, c2] = [own.c1, own.c2].map(|own| significant(own / 1e3, 3));
        format!("K1 {k1}, K2 {k2} MN/m, C1 {c1}, C2 {c2} kN s/m, ")
    });
    let q = significant(member.impact.groups.q(), 3);
    let deepest = significant(member.impact.deepest().value, 3);
    let mark = if member.exceeds() { ", exceeds" } else { "" };
    format!("{}: {pad}q {q}, ξmax {deepest}{mark}", family.varied.equals(member.value))
}
