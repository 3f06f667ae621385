//! What tests have shown as an object for programs.

use dashpot_analysis::rheometer::{Note, Obstacle, RheometerReport, Series};
use serde::{Serialize, Serializer};

use super::{Made, Tested, Units, beside, tables::spectra};
use crate::{VERSION, list, object};

impl Serialize for Tested {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [relaxation, retardation] = spectra(&self.specimen);
        let object = object! {
            dashpot: VERSION,
            model: &self.word,
            material: self.units.is_material,
            nonlinear: self.specimen.nonlinear(),
            relaxation_spectrum: relaxation,
            retardation_spectrum: retardation,
            tests: list(self.tests.iter().map(|made| test(made, self.units))),
        };
        object.serialize(serializer)
    }
}

fn test(made: &Made, units: Units) -> impl Serialize {
    let report = &made.report;
    object! {
        test: report.protocol,
        variant: Some(&made.label).filter(|label| !label.is_empty()),
        settings: list(report.settings.iter().map(|setting| object! {
            name: setting.name, unit: units.of(setting.unit), value: setting.value,
        })),
        abscissa: column(&report.abscissa, units),
        drive: report.drive.as_ref().map(|drive| column(drive, units)),
        series: list(report.series.iter().map(|own| answers(report, own, units))),
        figures: list(report.figures.iter().map(|figure| object! {
            name: units.word(figure.name),
            unit: units.of(figure.unit),
            model: figure.model,
            computed: figure.computed,
            error: figure.error,
            note: figure.note.as_ref().map(Note::to_string),
            note_code: figure.note.map(Note::code),
        })),
        measured: made.deviation.as_ref().map(beside::object),
        notes: list(report.notes.iter().map(Note::to_string)),
        note_codes: list(report.notes.iter().copied().map(Note::code)),
    }
}

fn column(own: &dashpot_analysis::Column, units: Units) -> impl Serialize {
    object! { name: units.word(&own.name), unit: units.of(own.unit), values: &own.values }
}

fn answers(report: &RheometerReport, own: &Series, units: Units) -> impl Serialize {
    let computed = own.computed.iter().zip(&report.computations);
    object! {
        name: units.word(own.name),
        unit: units.of(own.unit),
        model: Some(&own.model).filter(|model| !model.is_empty()),
        computed: list(computed.map(|(own, by)| object! {
            method: by.method,
            obstacle: by.obstacle.as_ref().map(Obstacle::to_string),
            obstacle_code: by.obstacle.as_ref().map(Obstacle::code),
            values: &own.values,
            error: own.error,
            difference: own.difference.map(|difference| difference.relative),
            stated: own.difference.and_then(|difference| difference.stated),
        })),
    }
}
