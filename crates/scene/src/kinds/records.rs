//! Records over time from files: their clock, what is taken off, the filter that they go through.

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, Range};
use dashpot_signal::{Cfc, Channel, Removal, Settings, iso_mme::MmeChannel};
use dashpot_units::format_short;

use super::parameters::KindReader;
use crate::{
    curves::Row,
    diagnostics::fault::Fault,
    models::notes::{Remark, RestRemoved},
    text::{
        document::Item,
        source::Place,
        table::{Table, text_of},
        table_file::TableFile,
    },
};

/// The keys of a record beside its file.
pub(crate) const RECORD_KEYS: [&str; 3] = ["shift", "offset", "cfc"];

/// The key of a channel of a test in ISO-MME.
pub(crate) const CHANNEL: &str = "channel";

/// What a record holds before the run is told above this part of its peak.
const EARLY: f64 = 0.05;

/// Rows of two columns of a file, with where they are from.
#[derive(Clone)]
pub(super) struct FileRows<'d> {
    pub(super) file: &'d TableFile,
    pub(super) rows: Vec<Row>,
    /// The place of the file's name.
    pub(super) place: Place,
}

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
            self.warn_of_nothing(&rows, place);
        }
        Some(FileRows { file, rows, place })
    }

    /// Warns of a record that is zero throughout.
    fn warn_of_nothing(self, rows: &[Row], place: Place) {
        if rows.iter().all(|own| own.value == 0.0) {
            let message = "every value of the record is zero: nothing acts";
            let help = "look at its column, `columns = [\"t\", \"acc\"]`, and at the file";
            self.quantities.faults.warning(place, Fault::odd(message, help));
        }
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

    /// The rows of a channel of a test: of the one that is named, by its code or name, or of the only one that measures
    /// what is driven.
    pub(super) fn of_channel<'d>(
        self,
        file: &'d TableFile,
        channels: &[MmeChannel],
        (wanted, scale): (Option<&Item>, f64),
        place: Place,
    ) -> Option<FileRows<'d>> {
        let code = |own: &MmeChannel| own.code.as_ref().map(|own| own.text().to_owned());
        let told = |own: &MmeChannel| code(own).unwrap_or_else(|| own.channel.name().to_owned());
        let fits = |own: &&MmeChannel| own.channel.dimension() == self.driven;
        let known = || channels.iter().map(told).collect::<Vec<String>>();
        let found = if let Some(item) = wanted {
            let name = text_of(item, &format!("`{CHANNEL}`"), self.quantities.faults)?;
            let is_it = |own: &&MmeChannel| {
                let code = code(own).is_some_and(|own| own.eq_ignore_ascii_case(name));
                code || own.channel.name().eq_ignore_ascii_case(name)
            };
            let Some(found) = channels.iter().find(is_it) else {
                let (family, name) = (CHANNEL, name.to_owned());
                self.refuse(item.place, Fault::UnknownName { family, name, known: known() });
                return None;
            };
            found
        } else {
            let all: Vec<&MmeChannel> = channels.iter().filter(fits).collect();
            let [one] = all[..] else {
                let message = format!(
                    "{} of its channels measure what is driven here; it has {}",
                    all.len(),
                    known().join(", ")
                );
                let help = "name one: `{ file = …, channel = \"…\" }`";
                self.refuse(place, Fault::odd(message, help));
                return None;
            };
            one
        };
        if !fits(&found) {
            let is = dashpot_units::si_unit(found.channel.dimension());
            let wanted = dashpot_units::si_unit(self.driven);
            let message = format!("channel `{}` is in {is}, where {wanted} is wanted", told(found));
            let help = "name another channel, or drive with what it measures".to_owned();
            self.refuse(place, Fault::odd(message, help));
            return None;
        }
        let own = found.channel.times().iter().zip(found.channel.values());
        let rows = own.map(|(at, value)| Row { at: *at, value: scale * value, start: 0 });
        Some(FileRows { file, rows: rows.collect(), place })
    }

    fn refuse(self, place: Place, fault: Fault) {
        self.quantities.faults.error(place, fault);
    }
}
