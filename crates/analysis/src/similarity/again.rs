//! Effects made again.

use std::sync::Arc;

use dashpot_network::{
    Effect,
    effects::EFFECTS,
    parameters::{InvalidParameter, Value, registered},
};

/// An effect of the same kind with other values, on `target` where it acts on an element; the same
/// one where its kind is in no register.
pub(super) fn again(
    effect: &Arc<dyn Effect>,
    target: Option<&str>,
    values: &[Value],
) -> Result<Arc<dyn Effect>, InvalidParameter> {
    let Some(kind) = registered(EFFECTS, effect.kind()) else { return Ok(Arc::clone(effect)) };
    let made = (kind.make)(values)?;
    Ok(target.and_then(|target| made.on(target)).unwrap_or(made))
}
