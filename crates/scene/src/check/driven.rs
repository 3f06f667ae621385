//! What motions leave behind: supports that drift away.

use dashpot_dae::Waveform;
use dashpot_network::{
    parameters::{Dimension, ParameterKind, registered},
    waveforms::WAVEFORMS,
};

use crate::{
    diagnostics::fault::Fault,
    sections::Reading,
    text::document::{Entry, Item},
    units::format_short,
};

/// How often a drift exceeds the way to and fro about it.
const DRIFT: f64 = 3.0;
/// Points at which a motion is looked at.
const POINTS: u32 = 2000;

/// What drives a load or a node in a scene.
pub(crate) struct Driven<'d> {
    /// Name of the load or node.
    pub(crate) name: &'d str,
    /// The key: `force`, `motion` or `acceleration`.
    pub(crate) key: &'d str,
    /// Its value.
    pub(crate) item: &'d Item,
    /// The force, or the displacement.
    pub(crate) waveform: &'d Waveform,
}

impl Driven<'_> {
    /// Warns of what it leaves behind in a run of `duration` \[s\].
    pub(crate) fn review(&self, reading: &Reading<'_>, duration: f64) {
        let Some(own) = self.item.table().unwrap_or(&[]).iter().find(|own| is_waveform(&own.key))
        else {
            return;
        };
        match (self.key, kind_of(own)) {
            // A shock of one sign is meant to leave its support with a speed.
            ("acceleration", Kind::Table) if self.shakes() => self.drift(reading, own, duration),
            ("acceleration", Kind::Sine) => self.drift(reading, own, duration),
            _ => {}
        }
    }

    /// Whether an acceleration has both signs.
    fn shakes(&self) -> bool {
        let pieces = self.waveform.pieces().iter();
        let mut signs = pieces.map(|piece| piece.derivative(2, piece.start));
        signs.clone().any(|sign| sign > 0.0) && signs.any(|sign| sign < 0.0)
    }

    /// Warns of an acceleration whose mean velocity is not zero.
    fn drift(&self, reading: &Reading<'_>, entry: &Entry, duration: f64) {
        let end = self.waveform.value(duration);
        let aside = (0..=POINTS).map(|at| {
            let share = f64::from(at) / f64::from(POINTS);
            (self.waveform.value(share * duration) - share * end).abs()
        });
        // A constant acceleration goes one way, too.
        let aside = aside.fold(0.0, f64::max);
        if duration <= 0.0 || end.abs() <= DRIFT * aside {
            return;
        }
        let (name, millimetres) = (self.name, 1e3 * end);
        let speed = format_short(end / duration, Dimension::VELOCITY, 3);
        let run = format_short(duration, Dimension::TIME, 4);
        let message = format!(
            "the acceleration makes `{name}` drift away: {millimetres:.3} mm in {run}, at {speed} in \
             the mean"
        );
        let help = match kind_of(entry) {
            Kind::Sine => {
                "a sine that is to shake about one place begins with its peak: \
                 `phase = \"90 deg\"`; or give its displacement as `motion`"
            }
            _ => {
                "take its mean off the record, so that velocity and displacement end near zero, or \
                 give the displacement as `motion`"
            }
        };
        reading.faults.warning(entry.item.place, Fault::odd(message, help));
    }
}

/// The functions of time of which something may be said.
enum Kind {
    Table,
    Sine,
    Other,
}

fn is_waveform(word: &str) -> bool {
    registered(WAVEFORMS, word).is_some()
}

fn kind_of(entry: &Entry) -> Kind {
    let kind = registered(WAVEFORMS, &entry.key);
    let has = |wanted: ParameterKind| {
        kind.is_some_and(|kind| kind.parameters.iter().any(|parameter| parameter.kind == wanted))
    };
    match entry.key.as_str() {
        _ if has(ParameterKind::TimeTable) => Kind::Table,
        "sine" => Kind::Sine,
        _ => Kind::Other,
    }
}
