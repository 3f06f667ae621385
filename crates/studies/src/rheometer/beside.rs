//! A measured loop beside those of the model.

use dashpot_analysis::measured::Deviation;
use dashpot_network::parameters::Dimension;
use dashpot_report::{
    Table,
    numbers::{percent_signed, quantity, share},
};
use serde::Serialize;

use super::{Made, Units};
use crate::{Context, StudyError, measured::MeasuredFile, object};

/// Digits of what was measured.
const DIGITS: usize = 4;

/// A loop as it was measured.
#[derive(Debug)]
pub(super) struct MeasuredLoop {
    pub(super) file: String,
    /// (Deformation \[m\], force \[N\]) or (strain \[1\], stress \[Pa\]), row by row.
    pub(super) points: Vec<(f64, f64)>,
    /// What is told of the file.
    pub(super) note: Option<String>,
}

impl MeasuredLoop {
    /// Reads the loop in a file: the columns of deformation and force, or of a material those of strain and stress.
    pub(super) fn read(
        file: &str,
        units: Units,
        context: &dyn Context,
    ) -> Result<Self, StudyError> {
        let own = MeasuredFile::read("--measured", file, &|name| context.load(name))?;
        let table = own.table()?;
        let ([place, force], words) = if units.is_material {
            let words = "a strain, as in `strain [%]`, and one of a stress";
            ([Dimension::NUMBER, Dimension::PRESSURE], words)
        } else {
            let words = "a deformation, as in `way [mm]`, and one of a force";
            ([Dimension::LENGTH, Dimension::FORCE], words)
        };
        let columns = [own.only(&table, place)?, own.only(&table, force)?];
        let [Some(x), Some(y)] = columns else {
            return Err(own.unclear(format!("a column of {words} are wanted, with their units")));
        };
        let points = own.points(&table, [(x, place), (y, force)])?;
        Ok(Self { file: file.to_owned(), points, note: own.notes(&table) })
    }

    /// The deformation of the largest magnitude.
    pub(super) fn depth(&self) -> Option<f64> {
        let places = self.points.iter().map(|row| row.0);
        places.reduce(|most, own| if own.abs() > most.abs() { own } else { most })
    }
}

/// How far the loops of these tests are from what was measured, each in a column of its own.
pub(super) fn deviations(tests: &[Made], units: Units) -> Option<Table> {
    let known: Vec<(&str, Deviation)> =
        tests.iter().filter_map(|made| Some((made.label.as_str(), made.deviation?))).collect();
    let (_, first) = known.first()?;
    let force = |value: f64| quantity(value, units.of("N"), DIGITS);
    let energy = |value: f64| super::tables::in_unit(value, units.of("J"), DIGITS);
    let row = |name: &str, cell: &dyn Fn(&Deviation) -> String| {
        let cells = known.iter().map(|(_, own)| cell(own));
        [units.word(name)].into_iter().chain(cells).collect::<Vec<String>>()
    };
    let areas = |own: &Deviation| own.areas.unwrap_or([f64::NAN; 2]);
    let rows = vec![
        row("peak force, measured", &|own| force(own.measured_peak.1)),
        row("peak force, model", &|own| force(own.model_peak.1)),
        row("the model deviates by", &|own| percent_signed(own.relative_peak())),
        row("area of the loop, measured", &|own| energy(areas(own)[0])),
        row("area of the loop, model", &|own| energy(areas(own)[1])),
        row("the model deviates by", &|own| percent_signed(areas(own)[1] / areas(own)[0] - 1.0)),
        row("rms of the difference, of the measured peak", &|own| share(own.rms)),
    ];
    let has_labels = known.iter().any(|own| !own.0.is_empty());
    let labels = [""].into_iter().chain(known.iter().map(|own| own.0)).filter(|_| has_labels);
    let caption = format!("Beside the measured loop, at {} rows", first.rows);
    Some(Table::new(caption, labels, rows))
}

pub(super) fn object(own: &Deviation) -> impl Serialize {
    object! {
        rows: own.rows,
        span: [own.span.0, own.span.1],
        measured_peak: own.measured_peak.1,
        model_peak: own.model_peak.1,
        peak: own.peak(),
        peak_relative: own.relative_peak(),
        rms: own.rms,
        measured_area: own.areas.map(|areas| areas[0]),
        model_area: own.areas.map(|areas| areas[1]),
    }
}
