//! Units of the columns of files.

use std::ops::Range;

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind};
use dashpot_units::{UnitError, format_short, parse_quantity, si_unit};

use super::parameters::KindReader;
use crate::{
    diagnostics::fault::Fault,
    quantities::quantity::Quantities,
    tables::{DataTable, Field, TableFault, is_no_unit, quantity_in},
    text::{
        document::{Content, Item},
        source::Place,
        table::text_of,
        table_file::TableFile,
    },
    vary::variation::Written,
};

impl KindReader<'_> {
    /// Warns of numbers whose unit nothing says, so that they are read in SI units, with the largest of them. Parts
    /// have no unit.
    pub(super) fn without_units(
        self,
        missing: [Option<f64>; 2],
        parameter: &Parameter,
        place: Place,
    ) {
        let dimensions = self.written(parameter);
        let names = match (parameter.kind, self.quantities.basis.is_material()) {
            (ParameterKind::Curve(..), false) => ["deformations", "forces"],
            (ParameterKind::Curve(..), true) => ["strains", "stresses"],
            _ => ["times", "values"],
        };
        let read = |at: usize| {
            let (dimension, name) = (dimensions[at], names[at]);
            let largest = missing[at].filter(|_| dimension != Dimension::NUMBER)?;
            let (unit, largest) = (si_unit(dimension), format_short(largest, dimension, 4));
            Some(format!("{name} are read in {unit}, the largest is {largest}"))
        };
        let read: Vec<String> = [0, 1].into_iter().filter_map(read).collect();
        if read.is_empty() {
            return;
        }
        let read = read.join("; ");
        let message = format!("the file does not say all its units: {read}");
        let [first, second] = dimensions.map(|own| match own {
            Dimension::NUMBER => "1".to_owned(),
            other => si_unit(other),
        });
        let [one, other] = names.map(|own| {
            own.strip_suffix("es")
                .filter(|own| own.ends_with("ss"))
                .unwrap_or(&own[..own.len() - 1])
        });
        let help = format!(
            "write a header line `{one} [{first}], {other} [{second}]`, or \
             `{{ file = \"…\", units = [\"{first}\", \"{second}\"] }}` in place of the name"
        );
        self.quantities.faults.bare(place, true, || Fault::odd(message, help));
    }
}

/// What is wrong with the unit that a column has in the file, and where.
pub(super) fn misread_unit(
    table: &DataTable<'_>,
    column: usize,
) -> Option<(UnitError, Range<usize>)> {
    let unit = table.unit(column)?;
    Some((quantity_in(unit.text).err()?, unit.span()))
}

/// What the numbers of a column are multiplied by: the unit in the scene or else in the header,
/// `Some(None)` where there is neither.
#[expect(clippy::option_option, reason = "a fault, no unit, or the factor of one")]
pub(super) fn unit(
    file: &TableFile,
    header: Option<Field<'_>>,
    given: Option<&Item>,
    expected: Dimension,
    reader: Quantities<'_>,
) -> Option<Option<f64>> {
    let header = header.filter(|own| !is_no_unit(own.text));
    let one = |unit: &str, place| {
        let text = if is_no_unit(unit) { "1".to_owned() } else { format!("1 {unit}") };
        reader.read(&Item { value: Content::Text(text.into()), place }, expected)
    };
    let Some(given) = given else {
        let Some(header) = header else { return Some(None) };
        return one(header.text, Place::new(file.number, &header.span())).map(Some);
    };
    let text = text_of(given, "a unit", reader.faults)?;
    let own = Written::split(text);
    if own.number.is_finite() && !own.unit.is_empty() {
        let message = format!("`{text}` is a quantity; a unit stands here without a number");
        let help = format!("write \"{}\": the numbers stand in the file", own.unit);
        reader.faults.error(given.place, Fault::odd(message, help));
        return None;
    }
    let factor = one(text, given.place)?;
    if let Some(header) = header
        && let Ok(said) = parse_quantity(&format!("1 {}", header.text))
        && let said = said.meant(reader.basis.dimension(expected))
        && said.dimension == Some(reader.basis.dimension(expected))
        && (said.value - factor).abs() > 1e-12 * factor.abs()
    {
        let (header, text) = (header.text.to_owned(), text.to_owned());
        let fault = TableFault::Contradiction { header, given: text };
        reader.faults.error(given.place, Fault::Table(fault));
        return None;
    }
    Some(Some(factor))
}

/// A strain of less than this in percent, and stresses of less and of more \[Pa\], are of no curve of a pad.
const LEAST_STRAIN: f64 = 0.01;
const STRESSES: [f64; 2] = [1e3, 1e8];
const PERCENT: f64 = 0.01;

impl KindReader<'_> {
    /// Warns of stresses and strains whose unit is probably another: the largest of each column, and what one of its unit
    /// is in SI units.
    pub(super) fn odd_units(
        self,
        largest: [Option<(f64, f64)>; 2],
        parameter: &Parameter,
        place: Place,
    ) {
        if self.written(parameter) != [Dimension::NUMBER, Dimension::PRESSURE] {
            return;
        }
        let [strain, stress] = largest.map(|own| own.map(|(value, unit)| (value.abs(), unit)));
        let is_percent = |own: &(f64, f64)| (own.1 / PERCENT - 1.0).abs() < 1e-9;
        if let Some((strain, _)) =
            strain.filter(|own| is_percent(own) && own.0 > 0.0 && own.0 <= LEAST_STRAIN)
        {
            let number = format_short(strain / PERCENT, Dimension::NUMBER, 4);
            let message = format!("the largest strain of the file is {number} %");
            let help = format!(
                "if it is {number} of the thickness, the unit is `[1]`: write that into the header, or \
                 `units = [\"1\", …]` beside `file`"
            );
            self.quantities.faults.warning(place, Fault::odd(message, help));
        }
        let [least, most] = STRESSES;
        if let Some((stress, _)) =
            stress.filter(|own| own.0 > 0.0 && !(least..=most).contains(&own.0))
        {
            let shown = |value: f64| format_short(value, Dimension::PRESSURE, 3);
            let meant = if stress < least { 1e3 * stress } else { 1e-3 * stress };
            let message = format!("the largest stress of the file is {}", shown(stress));
            let help =
                format!("if {} is meant, the unit is another: look at the header", shown(meant));
            self.quantities.faults.warning(place, Fault::odd(message, help));
        }
    }
}
