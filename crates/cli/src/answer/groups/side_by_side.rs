//! Two scenes side by side.

use dashpot_analysis::similarity::{Alone, GroupPair, Similarity};
use dashpot_plot::Table;
use serde::Serialize;

use super::{DIGITS, Factors, Opposed, opposed::opposed};
use crate::numbers::{apart, significant};

/// Two scenes.
#[derive(Serialize)]
pub(crate) struct SideBySide {
    pub(crate) compared: [String; 2],
    pub(crate) similar: bool,
    pub(crate) within: f64,
    pub(crate) structure: Vec<String>,
    pub(crate) groups: Vec<Pair>,
    pub(crate) scale: Factors,
    /// The measures of the first, and those of the second at its scale.
    pub(crate) measures: Vec<Opposed>,
    /// By how much each group that differs moves the measures of the first by itself.
    pub(crate) alone: Vec<Mover>,
    /// What was not compared.
    pub(crate) left_out: Vec<String>,
    /// Elements whose parts have thicknesses of their own in one of both only.
    pub(crate) other_pads: Vec<String>,
}

/// A group of both.
#[derive(Serialize)]
pub(crate) struct Pair {
    parameter: String,
    formula: String,
    values: [f64; 2],
    apart: f64,
}

impl SideBySide {
    /// Two scenes of which nothing has been solved.
    pub(crate) fn of(compared: [String; 2], found: &Similarity) -> Self {
        let pair = |own: &GroupPair| Pair {
            parameter: own.name.clone(),
            formula: own.formula.clone(),
            values: own.values,
            apart: own.apart,
        };
        Self {
            compared,
            similar: found.is_similar(),
            within: found.within,
            structure: found.structure.clone(),
            groups: found.groups.iter().map(pair).collect(),
            scale: Factors::of(&found.scale),
            measures: Vec::new(),
            alone: Vec::new(),
            left_out: Vec::new(),
            other_pads: Vec::new(),
        }
    }

    /// The groups that differ.
    pub(crate) fn different(&self) -> Table {
        let rows =
            self.groups.iter().filter(|own| own.apart > self.within || own.apart.is_nan()).map(
                |own| {
                    let [one, other] = own.values.map(|value| significant(value, DIGITS));
                    vec![own.formula.clone(), one, other, apart(own.apart)]
                },
            );
        Table {
            caption: "Groups that differ".to_owned(),
            header: ["group", "first", "second", "apart"].map(str::to_owned).into(),
            rows: rows.collect(),
        }
    }

    /// The measures of both.
    pub(crate) fn measures(&self) -> Table {
        opposed(
            "Measures, those of the second at the scale of the first",
            ["first", "second"],
            &self.measures,
        )
    }

    /// What each group moves by itself: the measure that it moves the most, and the first one.
    pub(crate) fn movers(&self) -> Table {
        let row = |own: &Mover| {
            let moved = own.measures.iter().filter(|own| !own.within_errors);
            let moved = moved.filter_map(|own| Some((own.apart?, own)));
            let most = moved.max_by(|one, other| one.0.total_cmp(&other.0));
            let most = most.filter(|own| own.0 > 0.0);
            let text = most.map_or("nothing".to_owned(), |(by, own)| {
                format!("{} by {}", own.measure, apart(by))
            });
            vec![own.parameter.clone(), text]
        };
        Table {
            caption: "What each of them alone moves the most".to_owned(),
            header: ["group of", "measure"].map(str::to_owned).into(),
            rows: self.alone.iter().map(row).collect(),
        }
    }
}

/// A group by itself.
#[derive(Serialize)]
pub(crate) struct Mover {
    parameter: String,
    measures: Vec<Opposed>,
}

impl Mover {
    /// A group by itself.
    pub(crate) fn of(own: &Alone) -> Self {
        Self {
            parameter: own.name.clone(),
            measures: own.measures.iter().map(Opposed::of).collect(),
        }
    }
}
