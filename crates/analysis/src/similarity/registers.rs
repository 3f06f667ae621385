//! Elements and effects by their words, so that they can be made again with other values.

use std::sync::{Arc, LazyLock};

use dashpot_network::{
    Effect, Element,
    effects::{EffectKind, EffectVisitor, visit_effects},
    elements::{ElementKind, ElementVisitor, visit_elements},
    parameters::{InvalidParameter, Parameter, Value},
};

type MakeElement = fn(&[Value]) -> Result<Arc<dyn Element>, InvalidParameter>;
type MakeEffect = fn(&str, &[Value]) -> Result<Arc<dyn Effect>, InvalidParameter>;

/// How things of one kind are made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Maker<F> {
    word: &'static str,
    /// Their parameters.
    pub(super) parameters: &'static [Parameter],
    /// Makes one of values.
    pub(super) make: F,
}

#[derive(Debug, Default)]
struct Makers {
    elements: Vec<Maker<MakeElement>>,
    effects: Vec<Maker<MakeEffect>>,
}

impl ElementVisitor for Makers {
    fn visit<E: ElementKind>(&mut self) {
        let make: MakeElement = |values| Ok(Arc::new(E::from_values(values)?));
        self.elements.push(Maker { word: E::KIND, parameters: E::PARAMETERS, make });
    }
}

impl EffectVisitor for Makers {
    fn visit<E: EffectKind>(&mut self) {
        let make: MakeEffect = |target, values| Ok(Arc::new(E::from_values(target, values)?));
        self.effects.push(Maker { word: E::KIND, parameters: E::PARAMETERS, make });
    }
}

fn makers() -> &'static Makers {
    static MAKERS: LazyLock<Makers> = LazyLock::new(|| {
        let mut makers = Makers::default();
        visit_elements(&mut makers);
        visit_effects(&mut makers);
        makers
    });
    &MAKERS
}

/// How elements of this kind are made; `None` for one that is in no register.
pub(super) fn element(kind: &str) -> Option<&'static Maker<MakeElement>> {
    makers().elements.iter().find(|own| own.word == kind)
}

/// How effects of this kind are made; `None` for one that is in no register.
pub(super) fn effect(kind: &str) -> Option<&'static Maker<MakeEffect>> {
    makers().effects.iter().find(|own| own.word == kind)
}
