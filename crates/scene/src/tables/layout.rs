//! Where the table is in a text: what separates its columns, where its names, units and rows stand.

use super::cells::{Decimal, Field, Separator, decimal_of, is_no_unit, is_unit, split};
use super::fault::{TableError, TableFault};

/// The beginning of a table is looked for in so many lines.
const LOOKED_AT: usize = 1000;

/// The separators in the order in which they are preferred.
const SEPARATORS: [Separator; 4] =
    [Separator::Mark(';'), Separator::Mark('\t'), Separator::Mark(','), Separator::Spaces];

/// A line and the byte at which it begins.
type Line<'t> = (usize, &'t str);

/// How a text is laid out.
#[derive(Debug)]
pub(super) struct Layout<'t> {
    pub(super) separator: Separator,
    /// The names of the columns, with their units or without.
    pub(super) header: Option<Vec<Field<'t>>>,
    /// The row of units below them.
    pub(super) units: Option<Vec<Field<'t>>>,
    /// Number of columns of the header, or else of the first row.
    pub(super) columns: usize,
    /// Where the table begins, the header included.
    pub(super) table: usize,
    /// Where the rows begin.
    pub(super) rows: usize,
    /// Where they end: lines of words behind them are no rows.
    pub(super) end: usize,
}

impl<'t> Layout<'t> {
    /// The layout of a text; `None` where there is no line but comments.
    pub(super) fn of(text: &'t str) -> Option<Self> {
        let first: Vec<Line<'t>> = lines(text, 0).take(LOOKED_AT).collect();
        if first.is_empty() {
            return None;
        }
        let separator = separator(&first);
        let rows: Vec<Row<'t>> = first.iter().map(|line| Row::of(*line, separator)).collect();
        let (header, from) = start(&rows, separator);
        let units = header.and_then(|at| units_at(&rows, at).then_some(at + 1));
        let end = |at: usize| first[at].0 + first[at].1.len();
        let columns = rows[header.unwrap_or(from)].fields.len();
        let begin = units.or(header).map_or_else(|| first[from].0, end);
        let names = header.map(|at| rows[at].fields.clone());
        Some(Self {
            separator,
            columns,
            table: first[header.unwrap_or(from)].0,
            rows: begin,
            end: end_of_rows(text, begin, separator),
            header: names.or_else(|| names_in_comment(&text[..begin], separator, columns)),
            units: units.map(|at| rows[at].fields.clone()),
        })
    }

    /// The lines of the rows, with where they begin.
    pub(super) fn lines<'a>(&self, text: &'a str) -> impl Iterator<Item = Line<'a>> + use<'a> {
        lines(&text[..self.end], self.rows)
    }
}

/// Names with units in the comment that ends the text before the rows, as some programs write them.
fn names_in_comment(before: &str, separator: Separator, columns: usize) -> Option<Vec<Field<'_>>> {
    let line = before.trim_end();
    let start = line.rfind('\n').map_or(0, |at| at + 1);
    let names = line[start..].trim_start_matches('\u{feff}').trim_start().strip_prefix('#')?;
    let at = line.len() - names.len();
    let mut fields = Vec::new();
    let all = [separator].into_iter().chain(SEPARATORS);
    let mut all = all.filter_map(|own| {
        split(names, at, own, &mut fields);
        let has_unit =
            |field: &Field<'_>| field.name_and_unit().1.is_some_and(|unit| is_unit(unit.text));
        let fits = fields.len() == columns && fields.iter().any(has_unit);
        fits.then(|| fields.clone())
    });
    all.next()
}

/// Where the rows that begin at `start` end: a line of words behind the last row with a number is none.
fn end_of_rows(text: &str, start: usize, separator: Separator) -> usize {
    let mut fields = Vec::new();
    let mut end = text.len();
    let mut from = text.len();
    while from > start {
        let before = text[start..from].trim_end_matches(['\n', '\r']);
        let begin = start + before.rfind('\n').map_or(0, |at| at + 1);
        let Some((at, line)) = lines(&text[..from], begin).next() else {
            from = begin;
            continue;
        };
        split(line, at, separator, &mut fields);
        let words = fields.iter().filter(|own| !own.text.is_empty()).count();
        if fields.iter().any(|own| own.begins_with_number() || own.is_like_number()) {
            return end;
        }
        if words > 1 && separator != Separator::Spaces {
            return text.len();
        }
        (from, end) = (begin, begin);
    }
    // Without a number there is no last row.
    text.len()
}

/// A line as fields, and how many of them are numbers or were meant as such.
struct Row<'t> {
    fields: Vec<Field<'t>>,
    numbers: usize,
}

impl<'t> Row<'t> {
    fn of((at, line): Line<'t>, separator: Separator) -> Self {
        let mut fields = Vec::new();
        split(line, at, separator, &mut fields);
        let numbers = fields.iter().filter(|own| own.is_like_number()).count();
        Self { fields, numbers }
    }

    /// Whether it is one of the table: two numbers, or nothing but numbers in a table of one column.
    fn is_data(&self, wide: bool) -> bool {
        self.numbers >= 2 || (!wide && self.numbers == self.fields.len())
    }

    /// Whether it holds words alone.
    fn is_names(&self, wide: bool) -> bool {
        let named = self.fields.iter().filter(|own| !own.text.is_empty()).count();
        self.numbers == 0 && named >= if wide { 2 } else { 1 }
    }

    /// Whether it holds units, below names of which there are so many: units alone, or some that are no names
    /// for certain, beside which others are misspelt.
    fn is_units(&self, names: usize) -> bool {
        let units = || self.fields.iter().map(|own| own.bare_unit().text);
        let is_one = |own: &str| !own.is_empty() && !is_no_unit(own);
        // A single letter may be the name of a quantity.
        let is_letter =
            |own: &str| own.chars().count() == 1 && own.chars().all(char::is_alphabetic);
        let is_no_name = |own: &str| is_one(own) && is_unit(own) && !is_letter(own);
        let are_units = units().all(|own| own.is_empty() || is_unit(own)) && units().any(is_one);
        are_units || self.numbers == 0 && self.fields.len() == names && units().any(is_no_name)
    }
}

/// The number of the header's line, where there is one, and that of the first row.
fn start(rows: &[Row<'_>], separator: Separator) -> (Option<usize>, usize) {
    let wide = rows.iter().any(|row| row.numbers >= 2);
    let width = |at: usize| rows[at].fields.len();
    let is_data = |at: usize| rows.get(at).is_some_and(|row| row.is_data(wide));
    let header = (0..rows.len()).find(|&at| {
        let below = if is_data(at + 1) { at + 1 } else { at + 2 };
        let fits = is_data(below) && (below == at + 1 || units_at(rows, at));
        // Between spaces a text of several words is no header.
        let fits = fits && (separator != Separator::Spaces || width(at) == width(below));
        rows[at].is_names(wide) && fits
    });
    let first = (0..rows.len()).find(|&at| is_data(at));
    if let Some(header) = header {
        let own = width(header);
        // Rows before the names of another width are of what stands before the table.
        if (0..header).all(|at| !is_data(at) || width(at) != own) {
            return (Some(header), header + 1);
        }
    }
    let Some(mut from) = first else {
        // A table of words with one number, or no row is in order.
        let is_row = |at: usize, wanted: usize| {
            rows.get(at).is_some_and(|own| own.numbers > 0 && own.fields.len() == wanted)
        };
        let names =
            (0..rows.len()).find(|&at| rows[at].is_names(true) && is_row(at + 1, width(at)));
        let names = names.or_else(|| rows[0].is_names(false).then_some(0));
        return (names, names.map_or(0, |at| at + 1));
    };
    // A row in which something is wrong is a row.
    while from > 0 && rows[from - 1].numbers > 0 && width(from - 1) == width(from) {
        from -= 1;
    }
    let before = from.checked_sub(1).filter(|&at| rows[at].is_names(wide));
    (before.filter(|&at| width(at) == width(from)), from)
}

/// Whether the names in row `at` say no unit, and a row of units follows.
fn units_at(rows: &[Row<'_>], at: usize) -> bool {
    let says_none = rows[at].fields.iter().all(|own| own.name_and_unit().1.is_none());
    says_none && rows.get(at + 1).is_some_and(|own| own.is_units(rows[at].fields.len()))
}

/// What separates the columns: that by which most lines are rows of numbers, and, where that is none, that which
/// divides most lines.
fn separator(first: &[Line<'_>]) -> Separator {
    let mut fields = Vec::new();
    let mut best: Option<(Separator, usize, usize)> = None;
    for separator in SEPARATORS {
        let (mut score, mut earliest) = (0, usize::MAX);
        for (number, (at, line)) in first.iter().enumerate() {
            split(line, *at, separator, &mut fields);
            let own = worth(&fields, separator);
            score += own;
            earliest = if own > 0 { earliest.min(number) } else { earliest };
        }
        let is_better =
            best.is_none_or(|(_, most, since)| score > most || (score == most && earliest < since));
        if score > 0 && is_better {
            best = Some((separator, score, earliest));
        }
    }
    if let Some((separator, ..)) = best {
        return separator;
    }
    // Words, perhaps with one number in a row: that which divides most lines.
    let divided = |mark: char| {
        let has = |line: &&Line<'_>| line.1.split('"').step_by(2).any(|part| part.contains(mark));
        first.iter().filter(has).count()
    };
    let best = [',', '\t', ';'].into_iter().max_by_key(|mark| divided(*mark));
    Separator::Mark(best.filter(|mark| divided(*mark) > 0).unwrap_or(','))
}

/// 2 for a row of numbers alone, 1 for one with two numbers among others. Spaces stand within texts and between
/// thousands too, so they separate numbers alone.
fn worth(fields: &[Field<'_>], separator: Separator) -> usize {
    let numbers = fields.iter().filter(|own| own.is_number()).count();
    match numbers {
        0 | 1 => 0,
        all if all == fields.len() => 2,
        _ => usize::from(separator != Separator::Spaces),
    }
}

/// What stands before the decimals in all the rows.
///
/// # Errors
///
/// The first number with a comma that may stand between thousands, where no other tells what it is.
pub(super) fn decimal(text: &str, layout: &Layout<'_>) -> Result<Decimal, TableError> {
    let (mut fields, mut open) = (Vec::new(), None);
    // Where commas separate columns, one before decimals stands between quotes.
    let may_tell = |line: &str| match layout.separator {
        Separator::Mark(',') => line.contains('"'),
        _ => line.contains([',', '.']),
    };
    for (at, line) in layout.lines(text).filter(|(_, line)| may_tell(line)) {
        split(line, at, layout.separator, &mut fields);
        for (column, field) in fields.iter().enumerate() {
            match decimal_of(field) {
                Some(Ok(found)) => return Ok(found),
                Some(Err(())) if open.is_none() => open = Some((column, *field)),
                _ => {}
            }
        }
    }
    let Some((column, field)) = open else { return Ok(Decimal::Point) };
    let fault = TableFault::CommaOrThousands { text: field.text.to_owned() };
    Err(TableError::new(text, field.span(), fault).in_column(layout.name_of(column)))
}

/// Whether two columns between commas, without names, may be one with decimal commas: whole numbers, and digits behind the
/// comma, in all rows.
///
/// # Errors
///
/// The first row, where a name with a unit above it, digits that begin with a zero, or numbers that fall speak for one
/// column.
pub(super) fn check_columns(text: &str, layout: &Layout<'_>) -> Result<(), TableError> {
    if layout.separator != Separator::Mark(',') || layout.header.is_some() || layout.columns != 2 {
        return Ok(());
    }
    let is_whole = |own: &str| !own.is_empty() && own.bytes().all(|byte| byte.is_ascii_digit());
    let (mut fields, mut first, mut before) = (Vec::new(), None, f64::NEG_INFINITY);
    let mut is_one = is_named_alone(&text[..layout.rows], &mut fields);
    for (at, line) in layout.lines(text) {
        split(line, at, layout.separator, &mut fields);
        let whole = fields[0].text.trim_start_matches(['+', '-']);
        let digits = fields.get(1).map(|own| own.text);
        if !is_whole(whole) || digits.is_some_and(|own| !is_whole(own)) {
            return Ok(());
        }
        let value = fields[0].text.parse().unwrap_or(before);
        is_one |= value < before || digits.is_some_and(|own| own.len() > 1 && own.starts_with('0'));
        before = value;
        first = first.or_else(|| digits.map(|_| (at, line)));
    }
    let Some((at, line)) = first.filter(|_| is_one) else { return Ok(()) };
    let fault = TableFault::CommaOrColumns { text: line.trim().to_owned() };
    Err(TableError::new(text, at..at + line.len(), fault))
}

/// Whether the last line before the rows is one name with a unit.
fn is_named_alone<'t>(before: &'t str, fields: &mut Vec<Field<'t>>) -> bool {
    let Some((at, line)) = lines(before, 0).last() else { return false };
    split(line, at, Separator::Mark(','), fields);
    let unit = fields[0].name_and_unit().1;
    fields.len() == 1 && unit.is_some_and(|own| is_unit(own.text))
}

impl Layout<'_> {
    /// The name of a column for messages, or its number from 1.
    pub(super) fn name_of(&self, column: usize) -> String {
        let field = self.header.as_ref().and_then(|header| header.get(column));
        let name = field.map(|own| own.name_and_unit().0).filter(|name| !name.is_empty());
        name.map_or_else(|| (column + 1).to_string(), str::to_owned)
    }
}

/// The lines from byte `start` on that hold something, with where they begin.
pub(super) fn lines(text: &str, start: usize) -> impl Iterator<Item = Line<'_>> {
    let mut next = start;
    let all = text.get(start..).unwrap_or_default().split_inclusive('\n');
    all.map(move |line| {
        let at = next;
        next += line.len();
        let mark = if at == 0 && line.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        (at + mark, line[mark..].trim_end_matches(['\n', '\r']))
    })
    .filter(|(_, line)| {
        let is_blank = |own: char| own.is_whitespace() || matches!(own, ';' | ',' | '"');
        !line.chars().all(is_blank) && !line.trim_start().starts_with('#')
    })
}
