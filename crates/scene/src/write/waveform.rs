//! Driving functions as text.

use dashpot_dae::Waveform;
use dashpot_network::{parameters::Dimension, waveforms::Recognized};

use super::write_kind;

/// A driving function of what is measured in `driven`, as `word = …`; `None` where it is of a kind
/// that does not show in its pieces.
pub(crate) fn write_waveform(waveform: &Waveform, driven: Dimension) -> Option<String> {
    Recognized::of(waveform).map(|own| written(&own, driven))
}

/// The motion of a node as `motion = { … }`, or as the `acceleration` that it was made of.
pub(crate) fn write_motion(motion: &Waveform) -> Option<String> {
    let acceleration = || {
        let own = Recognized::as_acceleration(motion)?;
        Some(format!("acceleration = {{ {} }}", written(&own, Dimension::ACCELERATION)))
    };
    let own = write_waveform(motion, Dimension::LENGTH);
    own.map(|own| format!("motion = {{ {own} }}")).or_else(acceleration)
}

fn written(own: &Recognized, driven: Dimension) -> String {
    write_kind(own.word, own.parameters, &own.values, driven)
}
