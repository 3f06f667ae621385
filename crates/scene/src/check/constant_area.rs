//! Pads of a constant area under the limits of standards that load one that grows.

use dashpot_analysis::{
    Limit,
    limits::standards::{STANDARDS, Standard},
};
use dashpot_network::{elements::Indenter, parameters::Kind as _};

use crate::{
    models::notes::{ModelNote, Remark},
    sections::Reading,
};

/// The standard of a limit, where it is one that lays pads on a dome, and the radius of that.
fn on_dome(limit: &Limit) -> Option<(&'static Standard, f64)> {
    let from = limit.from.as_deref().filter(|own| !own.is_empty())?;
    let standard = STANDARDS.iter().find(|own| own.edition.starts_with(from))?;
    Some((standard, standard.dome?))
}

/// What is to be said of elements with an area of their own that such limits are on, each once.
pub(crate) fn constant_areas(reading: &Reading<'_>, limits: &[Limit]) -> Vec<ModelNote> {
    let mut notes: Vec<ModelNote> = Vec::new();
    for limit in limits {
        let Some((standard, dome)) = on_dome(limit) else { continue };
        let target = limit.key.rsplit_once('.').map_or("", |own| own.0);
        let entries = reading.elements.get(target).and_then(|own| own.item.table()).unwrap_or(&[]);
        let has = |key: &str| entries.iter().any(|own| own.key == key);
        let subject = format!("element `{target}`");
        if has("area") && !has(Indenter::KIND) && notes.iter().all(|own| own.subject != subject) {
            let what = Remark::ConstantArea { standard: standard.edition, dome };
            notes.push(ModelNote { subject, what, until: None });
        }
    }
    notes
}
