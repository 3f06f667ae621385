//! Figures 5 to 20: four curves for the families of a, b, c and d.

use dashpot_plot::{Chart, Direction, Marker, Pattern, ReferenceLine, Series};

use super::{Column, Drawing, Figure};
use crate::{
    Family, Groups, Impact, Member, Scales, Study,
    words::{short, significant},
};

/// Curves run from τ* = 0 to this, 10 ms in chapter IV, with so many points in between.
const END: f64 = 5.0;
const POINTS: u32 = 500;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Deformation,
    Force,
    StressStrain,
    Energy,
}

const KINDS: [Kind; 4] = [Kind::Deformation, Kind::Force, Kind::StressStrain, Kind::Energy];

impl Kind {
    /// The title in the thesis.
    fn title(self, symbol: &str) -> String {
        match self {
            Self::Deformation => {
                format!("Padding deformation history during impact, effect of parameter {symbol}")
            }
            Self::Force => {
                format!("Impact force as a function of time with {symbol} as parameter")
            }
            Self::StressStrain => {
                format!("Stress-strain response as a function of parameter {symbol}")
            }
            Self::Energy => format!("Energy absorption with {symbol} as parameter"),
        }
    }

    fn heading(self) -> &'static str {
        match self {
            Self::Deformation => "Deformation over time",
            Self::Force => "Force over time",
            Self::StressStrain => "Force over deformation",
            Self::Energy => "Energy over time",
        }
    }

    fn labels(self) -> [&'static str; 2] {
        match self {
            Self::Deformation => ["τ*", "deformation ξ"],
            Self::Force => ["τ*", "force φ"],
            Self::StressStrain => ["deformation ξ", "force φ"],
            Self::Energy => ["τ*", "energy ω"],
        }
    }

    /// The point of the curve at τ*, with the energy until then.
    fn point(self, impact: &Impact, time: f64, energy: f64) -> (f64, f64) {
        match self {
            Self::Deformation => (time, impact.deformation(time)),
            Self::Force => (time, impact.force(time)),
            Self::StressStrain => (impact.deformation(time), impact.force(time)),
            Self::Energy => (time, energy),
        }
    }
}

/// The figures in their order: a, b, c and d of each kind.
pub(super) fn figures(study: &Study) -> Vec<Figure> {
    let curves: Vec<Vec<Vec<[f64; 4]>>> = study
        .groups
        .iter()
        .map(|family| family.members.iter().map(|member| samples(&member.impact)).collect())
        .collect();
    let mut all = Vec::new();
    for (row, kind) in KINDS.into_iter().enumerate() {
        for (at, family) in study.groups.iter().enumerate() {
            let number = 5 + study.groups.len() * row + at;
            all.push(figure(number, kind, family, &curves[at]));
        }
    }
    all
}

/// τ*, ξ, φ and ω.
fn samples(impact: &Impact) -> Vec<[f64; 4]> {
    let time = |at: u32| END * f64::from(at) / f64::from(POINTS);
    let mut energy = 0.0;
    let mut all = Vec::with_capacity(POINTS as usize + 1);
    for at in 0..=POINTS {
        if at > 0 {
            energy += impact.energy_between(time(at - 1), time(at));
        }
        let own = time(at);
        all.push([own, impact.deformation(own), impact.force(own), energy]);
    }
    all
}

fn figure(number: usize, kind: Kind, family: &Family, curves: &[Vec<[f64; 4]>]) -> Figure {
    let symbol = family.varied.symbol();
    let title = kind.title(symbol);
    let [x_label, y_label] = kind.labels();
    let of = |own: &[f64; 4]| match kind {
        Kind::Deformation => (own[0], own[1]),
        Kind::Force => (own[0], own[2]),
        Kind::StressStrain => (own[1], own[2]),
        Kind::Energy => (own[0], own[3]),
    };
    let series = family.members.iter().zip(curves).enumerate().map(|(colour, (member, curve))| {
        let pattern = if member.exceeds() { Pattern::Dashed } else { Pattern::Solid };
        Series::drawn(legend(family, member), (colour, pattern), curve.iter().map(of))
    });
    let marker = |member: &Member| {
        let time = member.impact.meets_thickness().filter(|time| *time <= END)?;
        let (x, y) = kind.point(&member.impact, time, member.impact.energy(time));
        Some(Marker { x, y, label: format!("{}: ξ = 1", value(family, member)) })
    };
    let line = |direction| ReferenceLine::new(direction, 1.0, "thickness");
    let lines = match kind {
        Kind::Deformation => vec![line(Direction::Horizontal)],
        Kind::StressStrain => vec![line(Direction::Vertical)],
        Kind::Force | Kind::Energy => Vec::new(),
    };
    let chart = Chart {
        title: format!("Figure {number}. {}, {symbol} varied", kind.heading()),
        note: note(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        family: family.members.len(),
        series: series.collect(),
        markers: family.members.iter().filter_map(marker).collect(),
        lines,
        ..Chart::default()
    };
    Figure {
        number,
        title,
        drawing: Drawing::Chart(Box::new(chart)),
        columns: columns(kind, family, curves),
    }
}

fn note() -> String {
    let Groups { a, b, c, d, alpha, beta, gamma, .. } = Groups::PRINTED;
    let milliseconds = 1e3 * Scales::CHAPTER_4.time();
    format!(
        "Base: a {a}, b {b}, c = e = {c}, d {d}, α {alpha}, β {beta}, γ {gamma}; {milliseconds} ms are 1 \
         of τ*"
    )
}

fn value(family: &Family, member: &Member) -> String {
    format!("{} = {}", family.varied.symbol(), family.varied.text(member.value))
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
    format!("{}: {pad}q {q}, ξmax {deepest}{mark}", value(family, member))
}

fn columns(kind: Kind, family: &Family, curves: &[Vec<[f64; 4]>]) -> Vec<Column> {
    let column = |name: String, of: usize, curve: &[[f64; 4]]| Column {
        name,
        values: curve.iter().map(|own| own[of]).collect(),
    };
    let mut all: Vec<Column> =
        curves.first().map(|curve| column("tau* [1]".to_owned(), 0, curve)).into_iter().collect();
    let wanted: &[(&str, usize)] = match kind {
        Kind::Deformation => &[("xi", 1)],
        Kind::Force => &[("phi", 2)],
        Kind::StressStrain => &[("xi", 1), ("phi", 2)],
        Kind::Energy => &[("omega", 3)],
    };
    for (member, curve) in family.members.iter().zip(curves) {
        let value = format!("{} = {}", family.varied.symbol(), short(member.value, 6));
        for (name, of) in wanted {
            all.push(column(format!("{name} at {value} [1]"), *of, curve));
        }
    }
    all
}
