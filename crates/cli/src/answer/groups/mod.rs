//! Groups, similar scenes and laboratory tests, as tables and as JSON.

mod factors;
mod laboratory;
mod opposed;
mod side_by_side;
mod thesis;

use dashpot_analysis::similarity::{FourParameterImpact, Groups, Quantity};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use serde::Serialize;

use self::{factors::Factors, thesis::Thesis};
pub(crate) use self::{
    laboratory::Test,
    opposed::Opposed,
    side_by_side::{Mover, SideBySide},
};
use crate::numbers::{constant, significant};

/// Digits of groups.
const DIGITS: usize = 6;

/// All that is told.
#[derive(Serialize)]
pub(crate) struct Told {
    /// What the groups are of.
    pub(crate) scene: String,
    /// How many parameters there are.
    pub(crate) parameters: usize,
    /// The rank of their dimensions.
    pub(crate) rank: usize,
    /// The units of the groups.
    pub(crate) references: Vec<Reference>,
    /// The groups.
    pub(crate) groups: Vec<Numbered>,
    /// Those of the thesis, for scenes of its form.
    pub(crate) thesis: Option<Thesis>,
    /// Another scene beside this one.
    pub(crate) similarity: Option<SideBySide>,
    /// The laboratory test.
    pub(crate) laboratory: Option<Test>,
}

/// A reference.
#[derive(Serialize)]
pub(crate) struct Reference {
    symbol: &'static str,
    name: String,
    value: f64,
    unit: String,
}

/// A group.
#[derive(Serialize)]
pub(crate) struct Numbered {
    parameter: String,
    formula: String,
    value: f64,
}

impl Told {
    /// The groups alone.
    pub(crate) fn new(scene: String, groups: &Groups, thesis: Option<FourParameterImpact>) -> Self {
        let numbered = groups.groups.iter().map(|own| Numbered {
            parameter: own.quantity.name.clone(),
            formula: own.formula.clone(),
            value: own.value,
        });
        Self {
            scene,
            parameters: groups.groups.len() + groups.references.len(),
            rank: groups.rank(),
            references: groups
                .references
                .iter()
                .map(|own| reference(own.symbol, &own.quantity))
                .collect(),
            groups: numbered.collect(),
            thesis: thesis.map(Thesis::of),
            similarity: None,
            laboratory: None,
        }
    }

    /// What the groups refer to, in a line.
    pub(crate) fn references(&self) -> String {
        let one = |own: &Reference| {
            format!("{} = {} = {}", own.symbol, own.name, constant(own.value, &own.unit))
        };
        self.references.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// How many groups there are.
    pub(crate) fn count(&self) -> String {
        let (all, zero) = (self.groups.len(), self.groups.iter().filter(|own| own.value == 0.0));
        match zero.count() {
            0 => format!("{all} groups"),
            zero => format!("{all} groups, {zero} of them 0 and not shown"),
        }
    }

    /// The groups that are not zero.
    pub(crate) fn table(&self) -> Table {
        let rows = self.groups.iter().filter(|own| own.value != 0.0);
        let rows = rows.map(|own| vec![own.formula.clone(), significant(own.value, DIGITS)]);
        Table {
            caption: "Independent groups".to_owned(),
            header: vec!["group".to_owned(), "value".to_owned()],
            rows: rows.collect(),
        }
    }
}

fn reference(symbol: &'static str, own: &Quantity) -> Reference {
    Reference { symbol, name: own.name.clone(), value: own.value, unit: si(own.dimension) }
}

/// The SI unit of a dimension; that without a name is left out.
fn si(dimension: Dimension) -> String {
    dimension.named().map_or_else(String::new, |own| own.1.to_owned())
}
