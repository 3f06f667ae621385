//! One file of points as Parquet: the table of a sweep's CSV by columns, in one group of rows, with what is known of
//! all of it in the footer.

use std::{fs::File, io, ops::Range, path::Path, sync::Arc};

use dashpot_analysis::{
    Judgement,
    sweep::{Grid, SweepReport},
};
use dashpot_scene::Variation;
use parquet::{
    basic::{Compression, LogicalType, Repetition, Type as Physical},
    column::writer::ColumnWriter,
    data_type::ByteArray,
    errors::{ParquetError, Result},
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        reader::{FileReader, SerializedFileReader},
        writer::SerializedFileWriter,
    },
    schema::types::Type,
};
use serde::{Deserialize, Serialize};

use super::{
    super::{
        files::{WARNINGS, header},
        identity::Identity,
        varied::Varied,
        words::name,
    },
    Wanted,
    summary::Summary,
};
use crate::output::{VERSION, list};

/// Heading of the reasons why a point or value is missing.
const MISSING: &str = "missing";
/// The headings of texts that are said of points.
pub(super) const SAID: [&str; 2] = [WARNINGS, MISSING];
/// What the footer calls what is known of the points.
const KEY: &str = "dashpot";

/// What the footer of a file says.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Footer {
    /// The version of the program.
    dashpot: String,
    /// The hash of the sweep that the points are of.
    pub(super) sweep: String,
    pub(super) identity: Identity,
    /// The points, by their numbers in the whole grid, from 0.
    pub(super) points: Range<usize>,
    pub(super) summary: Summary,
}

impl Footer {
    pub(super) fn of(wanted: &Wanted<'_>, points: Range<usize>, report: &SweepReport) -> Self {
        let (sweep, identity) = (wanted.sweep.clone(), wanted.identity.clone());
        let summary = Summary::of(report, points.start);
        Self { dashpot: VERSION.to_owned(), sweep, identity, points, summary }
    }

    /// That of a file; `None` where it is not one of these.
    pub(super) fn read(path: &Path) -> Option<Self> {
        let file = SerializedFileReader::new(File::open(path).ok()?).ok()?;
        let all = file.metadata().file_metadata().key_value_metadata()?;
        let own = all.iter().find(|own| own.key == KEY)?;
        serde_json::from_str(own.value.as_deref()?).ok()
    }
}

/// What a column holds; blank where there is nothing.
enum Cells {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

/// The points of a report as the bytes of a file.
pub(super) fn bytes(
    (varied, grid): (&Varied, &Grid),
    footer: &Footer,
    report: &SweepReport,
) -> io::Result<Vec<u8>> {
    written(varied, grid, footer, report).map_err(io::Error::other)
}

fn written(varied: &Varied, grid: &Grid, footer: &Footer, report: &SweepReport) -> Result<Vec<u8>> {
    let mut names = header(varied, report);
    names.push(MISSING.to_owned());
    let mut is_of_words = list(varied.variations.iter().map(Variation::is_of_words));
    is_of_words.resize(is_of_words.len() + 2 * report.columns.len(), false);
    is_of_words.resize(names.len(), true);
    let field = |(name, is_of_words): (&String, bool)| {
        let physical = if is_of_words { Physical::BYTE_ARRAY } else { Physical::DOUBLE };
        let own = Type::primitive_type_builder(name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(is_of_words.then_some(LogicalType::String));
        own.build().map(Arc::new)
    };
    let fields = names.iter().zip(is_of_words).map(field).collect::<Result<_>>()?;
    let schema = Type::group_type_builder("points").with_fields(fields).build()?;
    let said =
        serde_json::to_string(footer).map_err(|error| ParquetError::External(error.into()))?;
    let properties = WriterProperties::builder()
        .set_created_by(format!("dashpot {VERSION}"))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(vec![KeyValue::new(KEY.to_owned(), said)]));
    let mut bytes = Vec::new();
    let mut file =
        SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties.build()))?;
    let mut rows = file.next_row_group()?;
    let mut columns = columns((varied, grid), &footer.points, report);
    while let Some(mut column) = rows.next_column()? {
        match (column.untyped(), columns.next()) {
            (ColumnWriter::DoubleColumnWriter(out), Some(Cells::Numbers(all))) => {
                let is_there = list(all.iter().map(|own| i16::from(own.is_finite())));
                let there = list(all.into_iter().filter(|own| own.is_finite()));
                out.write_batch(&there, Some(&is_there), None)?;
            }
            (ColumnWriter::ByteArrayColumnWriter(out), Some(Cells::Words(all))) => {
                let is_there = list(all.iter().map(|own| i16::from(!own.is_empty())));
                let there = all.iter().filter(|own| !own.is_empty());
                let there = list(there.map(|own| ByteArray::from(own.as_str())));
                out.write_batch(&there, Some(&is_there), None)?;
            }
            _ => return Err(ParquetError::General("a column is of another type".to_owned())),
        }
        column.close()?;
    }
    rows.close()?;
    file.close()?;
    Ok(bytes)
}

/// What the columns hold, in the order of the headings.
fn columns<'c>(
    (varied, grid): (&'c Varied, &'c Grid),
    points: &'c Range<usize>,
    report: &'c SweepReport,
) -> impl Iterator<Item = Cells> + 'c {
    let places = list(points.clone().map(|point| varied.places(&grid.places(point))));
    let parameters = varied.variations.iter().enumerate().map(move |(at, own)| {
        let own_places = places.iter().map(|places| places[at]);
        if own.is_of_words() {
            Cells::Words(list(own_places.map(|place| own.words[place].clone())))
        } else {
            Cells::Numbers(list(own_places.map(|place| own.values[place])))
        }
    });
    let found = (0..report.columns.len())
        .flat_map(|at| [list(report.column(at)), list(report.errors_of(at))].map(Cells::Numbers));
    let word = |judged: Option<Judgement>| judged.map_or("", Judgement::word).to_owned();
    let judged = (0..report.limits.len())
        .map(move |at| Cells::Words(list(report.judged(at).into_iter().map(word))));
    let warned = report
        .warnings
        .iter()
        .flat_map(|own| own.points.iter().map(|&point| (point, own.warning.code().to_owned())));
    let missing = report.gaps.iter().map(|gap| {
        let of = gap.column.map_or(String::new(), |at| name(&report.columns[at]) + ": ");
        (gap.point, of + &gap.cause.message)
    });
    let said = [joined(report, warned), joined(report, missing)];
    parameters.chain(found).chain(judged).chain(said)
}

/// What is said of each point, with semicolons between.
fn joined(report: &SweepReport, said: impl Iterator<Item = (usize, String)>) -> Cells {
    let mut all = vec![String::new(); report.points()];
    for (point, word) in said {
        let own = &mut all[point];
        *own += if own.is_empty() { "" } else { "; " };
        *own += &word;
    }
    Cells::Words(all)
}
