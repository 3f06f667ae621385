//! What was varied, and the ends of what was found.

use dashpot_analysis::sweep::{Column, SweepReport};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use dashpot_scene::{Variation, units::si_unit};

use super::Swept;
use crate::{numbers::Unit, studies::run::unit_of_kind};

/// Digits of what is computed.
const DIGITS: usize = 5;

impl Swept {
    /// How many points there are.
    pub(super) fn points(&self) -> usize {
        self.report.values.len() / self.report.columns.len().max(1)
    }

    /// SI unit of a parameter.
    pub(super) fn unit(&self, parameter: usize) -> String {
        let own = self.tunables.all()[self.matched[parameter]].dimension;
        let dimension = self.variations[parameter].dimension.or(own);
        dimension
            .filter(|dimension| *dimension != Dimension::NUMBER)
            .map_or("1".to_owned(), si_unit)
    }

    /// The values of all parameters at a point.
    pub(super) fn at(&self, point: usize) -> String {
        let places = self.grid.places(point).into_iter().zip(&self.variations);
        let all = places.map(|(place, own)| format!("{} = {}", own.name, shown(own, place)));
        all.collect::<Vec<_>>().join(", ")
    }

    /// One line for each parameter.
    pub(super) fn in_words(&self) -> Vec<String> {
        let line = |(own, &at): (&Variation, &usize)| {
            let last = own.len() - 1;
            let scale = if own.is_logarithmic { " at equal ratios" } else { "" };
            let path = &self.tunables.all()[at].path;
            let path = if *path == own.name { String::new() } else { format!(" ({path})") };
            format!(
                "{}{path}: {} values from {} to {}{scale}; {} in the scene",
                own.name,
                own.len(),
                own.text(0),
                own.text(last),
                self.tunables.shown(at)
            )
        };
        self.variations.iter().zip(&self.matched).map(line).collect()
    }
}

/// The name of a column.
pub(super) fn name(column: &Column) -> String {
    if column.is_share { format!("{} over thickness", column.key) } else { column.key.clone() }
}

/// The unit in which values of a column are read that are as large as this one.
pub(super) fn unit(column: &Column, largest: f64) -> Unit {
    let kind = column.key.rsplit_once('.').map_or("", |own| own.1);
    unit_of_kind(kind, column.unit).unwrap_or_else(|| Unit::suiting(largest, column.unit))
}

/// The smallest and the largest value of each measure.
pub(super) fn summary(report: &SweepReport) -> Table {
    let rows = report.columns.iter().enumerate().map(|(at, column)| {
        let finite = || report.column(at).filter(|own| own.is_finite());
        let ends = [finite().reduce(f64::min), finite().reduce(f64::max)];
        let text = |own: Option<f64>| {
            own.map_or("–".to_owned(), |own| unit(column, own).text(own, DIGITS))
        };
        let [low, high] = ends.map(text);
        vec![name(column), low, high]
    });
    Table::new("", &["measure", "lowest", "highest"], rows)
}

/// A value of a parameter to four digits.
pub(super) fn shown(variation: &Variation, at: usize) -> String {
    let unit = Unit::new(&variation.unit, 1.0);
    let text = unit.text(variation.numbers[at], 4);
    let (number, rest) = text.split_once(' ').unwrap_or((&text, ""));
    let short = match number.split_once('.') {
        Some(_) if !number.contains('e') => number.trim_end_matches('0').trim_end_matches('.'),
        _ => number,
    };
    format!("{short} {rest}").trim_end().to_owned()
}
