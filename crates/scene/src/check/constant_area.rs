//! Pads of a constant area under the limits of standards that load one that grows.

use dashpot_analysis::{
    Limit,
    limits::standards::{STANDARDS, Standard},
};
use dashpot_network::{Connection, Network};

use crate::models::notes::{ModelNote, Remark};

/// The standard of a limit, where it is one that lays pads on a dome, and the radius of that.
fn on_dome(limit: &Limit) -> Option<(&'static Standard, f64)> {
    let from = limit.from.as_deref().filter(|own| !own.is_empty())?;
    let standard = STANDARDS.iter().find(|own| own.edition.starts_with(from))?;
    Some((standard, standard.dome?))
}

/// What is to be said of elements of a constant area that such limits are on, each once.
pub(crate) fn constant_areas(network: &Network, limits: &[Limit]) -> Vec<ModelNote> {
    let mut notes: Vec<ModelNote> = Vec::new();
    for limit in limits {
        let Some((standard, dome)) = on_dome(limit) else { continue };
        let target = limit.key.rsplit_once('.').map_or("", |own| own.0);
        // What a body presses has none.
        let has_area = |own: &Connection| own.name == target && own.area.is_some();
        let subject = format!("element `{target}`");
        let is_known = notes.iter().any(|own| own.subject == subject);
        if !is_known && network.connections().iter().any(has_area) {
            let what = Remark::ConstantArea { standard: standard.edition, dome };
            notes.push(ModelNote { subject, what, until: None });
        }
    }
    notes
}
