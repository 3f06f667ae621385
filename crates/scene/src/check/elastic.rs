//! Elastic pads where what is asked for hangs on what a pad loses.

use dashpot_analysis::{Limit, MeasureWish};
use dashpot_network::{
    Element, Model, Network,
    elements::{Foam, Foundation, TableSpring},
    parameters::{Kind as _, Value},
};
use dashpot_rheology::Tree;

use crate::models::notes::{ModelNote, Remark};

/// The beginnings of the words of measures that hang on the losses of a pad.
const LOSSES: [&str; 5] =
    ["hic", "severity-index", "energy", "coefficient-of-restitution", "impulse"];

/// What is to be said of the elements that are elastic foams or measured curves alone, where a measure that is asked
/// for or limited shows too little of a real one.
pub(crate) fn elastic_pads(
    network: &Network,
    limits: &[Limit],
    measures: &[MeasureWish],
) -> Vec<ModelNote> {
    let limited = limits.iter().filter_map(|own| Some(own.key.rsplit_once('.')?.1));
    let mut asked = limited.chain(measures.iter().map(|own| own.measure.kind()));
    if !asked.any(|kind| LOSSES.iter().any(|own| kind.starts_with(own))) {
        return Vec::new();
    }
    let pads = network.connections().iter().filter(|own| is_elastic_foam(&own.model));
    let note = |name: &String| ModelNote {
        subject: format!("element `{name}`"),
        what: Remark::Elastic,
        until: None,
    };
    pads.map(|own| note(&own.name)).collect()
}

fn is_elastic_foam(model: &Model) -> bool {
    match model {
        Tree::Part(part) => is_elastic_law(part.as_ref()),
        _ => model.branches().iter().all(|branch| is_elastic_foam(&branch.tree)),
    }
}

fn is_elastic_law(element: &dyn Element) -> bool {
    match element.value(Foundation::LAW) {
        Some(Value::Model(law)) => law.model().is_some_and(is_elastic_foam),
        _ => [Foam::KIND, TableSpring::KIND].contains(&element.kind()),
    }
}
