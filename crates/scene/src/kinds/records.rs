//! Records over time from files: their clock, what is taken off, the filter that they go through.

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, Range};
use dashpot_signal::{Cfc, Channel, Removal, Settings};

use super::{files::FileRows, parameters::KindReader};
use crate::{
    curves::Row,
    diagnostics::fault::Fault,
    models::notes::{Remark, RestRemoved},
    text::{source::Place, table::Table},
};

/// The keys of a record beside its file.
pub(crate) const RECORD_KEYS: [&str; 3] = ["shift", "offset", "cfc"];

/// What becomes of a record before it is a function of time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Treatment {
    /// How much later it is \[s\].
    shift: f64,
    settings: Settings,
}

impl KindReader<'_> {
    /// What a table says of a record; nothing of the points of a law.
    pub(super) fn treatment(self, table: &Table<'_>, parameter: &Parameter) -> Option<Treatment> {
        let mut own = Treatment::default();
        if parameter.kind != ParameterKind::TimeTable {
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
        let Treatment { shift, settings } = own;
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
        Some(FileRows { file, rows, place })
    }

    fn refuse(self, place: Place, fault: Fault) {
        self.quantities.faults.error(place, fault);
    }
}
