//! Records over time from files: their clock, what is taken off, the filter that they go through.

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, Range};
use dashpot_signal::{Cfc, Channel, Removal, Settings};

use super::{files::FileRows, parameters::KindReader};
use crate::{
    curves::Row,
    diagnostics::fault::Fault,
    models::notes::{Remark, RestRemoved},
    text::{source::Place, table::Table},
    units::format_short,
};

/// The keys of a record beside its file.
pub(crate) const RECORD_KEYS: [&str; 3] = ["shift", "offset", "cfc"];

/// What a record holds before the run is told above this part of its peak.
const EARLY: f64 = 0.05;

/// What becomes of a record before it is a function of time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Treatment {
    /// Whether it is a function of time at all.
    is_over_time: bool,
    /// How much later it is \[s\].
    shift: f64,
    settings: Settings,
}

impl Treatment {
    /// That of what is taken as it stands in its file.
    pub(super) fn none(parameter: &Parameter) -> Self {
        Self { is_over_time: parameter.kind == ParameterKind::TimeTable, ..Self::default() }
    }
}

impl KindReader<'_> {
    /// What a table says of a record; nothing of the points of a law.
    pub(super) fn treatment(self, table: &Table<'_>, parameter: &Parameter) -> Option<Treatment> {
        let mut own = Treatment::none(parameter);
        if !own.is_over_time {
            return Some(own);
        }
        let [shift, offset, cfc] = RECORD_KEYS.map(|key| table.take(key));
        if let Some(entry) = shift {
            own.shift = self.quantities.read(&entry.item, Dimension::TIME)?;
        }
        if let Some(entry) = offset {
            own.settings.offset = match entry.item.text() {
                Some("auto") => Removal::Found,
                _ => Removal::Given(self.amplitude(&entry.item)?),
            };
        }
        if let Some(entry) = cfc {
            let (range, number) = (Range::Positive, Dimension::NUMBER);
            let class = self.quantities.within(range, RECORD_KEYS[2], &entry.item, number)?;
            own.settings.cfc = Cfc::new(class).ok();
        }
        Some(own)
    }

    /// The rows of a record behind what becomes of it.
    pub(super) fn treated(self, found: FileRows<'_>, own: Treatment) -> Option<FileRows<'_>> {
        let Treatment { is_over_time, shift, settings } = own;
        let FileRows { file, mut rows, place } = found;
        if settings != Settings::default() {
            let (times, values) = rows.iter().map(|own| (own.at, own.value)).unzip();
            let channel = Channel::new("", self.driven, times, values);
            let treated = channel
                .map_err(Fault::Samples)
                .and_then(|own| settings.treated(&own).map_err(Fault::Record));
            let treated = treated.map_err(|fault| self.refuse(place, fault)).ok()?;
            if let (Removal::Found, Some(rest)) = (settings.offset, treated.offset) {
                let (value, error) = (rest.value, rest.error);
                let rest =
                    RestRemoved { value, error, dimension: self.driven, window: rest.window };
                file.remark(Remark::RestRemoved(rest));
            }
            let values = treated.channel.values();
            rows.iter_mut().zip(values).for_each(|(row, value): (&mut Row, _)| row.value = *value);
        }
        rows.iter_mut().for_each(|row| row.at += shift);
        if is_over_time {
            self.warn_of_early(&rows, place);
        }
        Some(FileRows { file, rows, place })
    }

    /// Warns of what a record holds before the run, which begins at 0.
    fn warn_of_early(self, rows: &[Row], place: Place) {
        let largest = |rows: &mut dyn Iterator<Item = &Row>| {
            rows.map(|own| own.value.abs()).fold(0.0, f64::max)
        };
        let all = largest(&mut rows.iter());
        let early = largest(&mut rows.iter().filter(|own| own.at < 0.0));
        let Some(first) = rows.first().filter(|_| early > EARLY * all) else { return };
        let time = format_short(-first.at, Dimension::TIME, 4);
        let early = format_short(early, self.driven, 3);
        let message = format!(
            "the record begins {time} before the run, and up to {early} take no part in it"
        );
        let help = format!("move it into the run: `{{ file = …, shift = \"{time}\" }}`");
        self.quantities.faults.warning(place, Fault::odd(message, help));
    }

    fn refuse(self, place: Place, fault: Fault) {
        self.quantities.faults.error(place, fault);
    }
}
