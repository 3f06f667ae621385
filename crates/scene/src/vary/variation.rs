//! What values a parameter takes in a sweep, from a text such as `K2=5..30 MN/m,26,log`.

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, UnitError, parse_quantity, si_unit};
use thiserror::Error;

use crate::text::nearest::nearest;

/// Values in a range where their number is not given.
const USUAL: usize = 11;
/// A parameter takes at most so many values.
const MOST: usize = 1_000_000;
/// The words for the distances between values.
const SCALES: [&str; 2] = ["lin", "log"];

/// The values that a parameter takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// The parameter, as it was named.
    pub name: String,
    /// The unit of the values as it was written; empty where they are bare numbers.
    pub unit: String,
    /// The values in that unit, rising.
    pub numbers: Vec<f64>,
    /// The same in SI units.
    pub values: Vec<f64>,
    /// What they measure, where there is a unit.
    pub dimension: Option<Dimension>,
    /// Whether they stand at equal ratios.
    pub is_logarithmic: bool,
    /// Whether they are a range whose count is not given.
    pub is_range: bool,
    /// The words that it takes in place of numbers, which are then their positions.
    pub words: Vec<String>,
}

/// Why a text does not say how a parameter varies.
///
/// `text` and `word` are what was given.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum VariationFault {
    /// There is no name, or nothing behind it.
    #[error("`{text}` does not name a parameter and its values")]
    NoValues { text: String },
    /// A further number among the values.
    #[error("`{text}` is another number of the scene")]
    Another { text: String },
    /// A value that is no quantity.
    #[error("{error}")]
    BadValue { error: UnitError },
    /// Values of different dimensions.
    #[error("`{first}` and `{second}` do not measure the same")]
    Mixed { first: String, second: String },
    /// Values that do not rise.
    #[error("the values do not rise: `{second}` stands behind `{first}`")]
    Falling { first: String, second: String },
    /// A count that cannot be used.
    #[error("`{text}` is not a number of values from 2 to 1000000")]
    BadCount { text: String },
    /// A word that is no scale.
    #[error("`{word}` is not a scale; there are `lin` and `log`")]
    UnknownScale { word: String, near: Option<&'static str> },
    /// Equal ratios from zero or below.
    #[error("equal ratios cannot begin at `{text}`: `log` is for positive values")]
    NotPositive { text: String },
    /// Something behind the scale.
    #[error("`{text}` stands behind the values, their number and their scale")]
    TooMuch { text: String },
}

impl VariationFault {
    /// What to write.
    pub fn help(&self) -> String {
        match self {
            Self::UnknownScale { near: Some(near), .. } => format!("did you mean `{near}`?"),
            Self::Another { text } => format!("write `--vary` once more, for all combinations: `--vary \"{text}\"`"),
            Self::Falling { first, second } if first == second => {
                "give a lower and an upper end, and leave out what does not vary".to_owned()
            }
            Self::Falling { first, second } => format!("write them as `{second}..{first}`, rising"),
            _ => "write `--vary \"K=5..30 MN/m,26,log\"` for 26 values at equal ratios (`lin`: equal \
                  differences), or `--vary \"K=5,10,20 MN/m\"` for a list"
                .to_owned(),
        }
    }
}

/// A number, its unit, and the text of both.
pub(crate) struct Written<'t> {
    pub(crate) number: f64,
    /// The number as it is written.
    pub(crate) digits: &'t str,
    /// Its unit, empty where it has none.
    pub(crate) unit: &'t str,
    text: &'t str,
}

impl<'t> Written<'t> {
    pub(crate) fn of(text: &'t str) -> Result<Self, VariationFault> {
        parse_quantity(text).map_err(|error| VariationFault::BadValue { error })?;
        Ok(Self::split(text))
    }

    /// The number and the unit of a text that is a quantity.
    pub(crate) fn split(text: &'t str) -> Self {
        let text = text.trim();
        // The longest beginning that is a number.
        let borders = text.char_indices().map(|char_index| char_index.0).chain([text.len()]);
        let mut found =
            borders.filter_map(|at| Some((text[..at].trim().parse().ok()?, text.split_at(at))));
        let (number, (digits, unit)) = found.next_back().unwrap_or((f64::NAN, ("", text)));
        Self { number, digits: digits.trim(), unit: unit.trim(), text }
    }

    /// The number in another unit, where it has one of its own.
    pub(crate) fn in_unit(&self, unit: &str) -> Result<f64, VariationFault> {
        if self.unit.is_empty() || self.unit == unit {
            return Ok(self.number);
        }
        let parse =
            |text: &str| parse_quantity(text).map_err(|error| VariationFault::BadValue { error });
        let (own, one) = (parse(self.text)?, parse(&format!("1 {unit}"))?);
        if own.dimension != one.dimension || own.is_celsius || one.is_celsius {
            let first = self.text.to_owned();
            return Err(VariationFault::Mixed { first, second: format!("1 {unit}") });
        }
        Ok(own.value / one.value)
    }
}

impl Variation {
    /// Reads a text: `name=first..last unit,count,scale` or `name=one,other,… unit`. Without a count a range
    /// has eleven values, without a scale they stand at equal differences.
    ///
    /// # Errors
    ///
    /// What is wrong with the text.
    pub fn parse(text: &str) -> Result<Self, VariationFault> {
        let nothing = || VariationFault::NoValues { text: text.trim().to_owned() };
        let (name, values) = text.rsplit_once('=').ok_or_else(nothing)?;
        let (name, values) = (name.trim(), values.trim());
        if let Some((_, other)) = name.rsplit_once(',').filter(|own| own.0.contains('=')) {
            return Err(VariationFault::Another { text: format!("{}={values}", other.trim()) });
        }
        if name.is_empty() || values.is_empty() {
            return Err(nothing());
        }
        let parts: Vec<&str> = values.split(',').map(str::trim).collect();
        let is_number = |part: &&str| {
            let begins = part.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
            begins || part.contains("..")
        };
        if !parts.iter().any(is_number) && !parts.contains(&"") {
            return Ok(Self::of_words(name, parts.iter().map(|&own| own.to_owned()).collect()));
        }
        let (numbers, unit, is_logarithmic) = match parts[0].split_once("..") {
            Some((first, last)) => range(first, last, &parts[1..])?,
            None => list(&parts)?,
        };
        let is_scale = |own: &&str| own.is_empty() || SCALES.contains(own);
        let mut own = Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            values: Vec::with_capacity(numbers.len()),
            numbers,
            dimension: None,
            is_logarithmic,
            is_range: parts[0].contains("..") && parts[1..].iter().all(is_scale),
            words: Vec::new(),
        };
        for at in 0..own.numbers.len() {
            let quantity = parse_quantity(&own.text(at))
                .map_err(|error| VariationFault::BadValue { error })?;
            own.dimension = quantity.dimension;
            own.values.push(quantity.value);
        }
        match own.values.windows(2).position(|pair| pair[1] <= pair[0]) {
            None => Ok(own),
            Some(at) => {
                Err(VariationFault::Falling { first: own.text(at), second: own.text(at + 1) })
            }
        }
    }

    /// Takes its values for what they are where this dimension is wanted.
    pub(crate) fn settle(&mut self, wanted: Dimension) {
        self.revalue(|quantity| quantity.meant(wanted));
    }

    /// Takes its values from its numbers, each as `meant`.
    pub(crate) fn revalue(&mut self, meant: impl Fn(Quantity) -> Quantity) {
        for at in 0..self.len() {
            let Ok(quantity) = parse_quantity(&self.text(at)) else { continue };
            let quantity = meant(quantity);
            (self.values[at], self.dimension) = (quantity.value, quantity.dimension);
        }
    }

    /// A parameter that takes words.
    pub(crate) fn of_words(name: &str, words: Vec<String>) -> Self {
        let numbers: Vec<f64> = (0..words.len()).map(|at| at as f64).collect();
        Self {
            name: name.to_owned(),
            unit: String::new(),
            values: numbers.clone(),
            numbers,
            dimension: None,
            is_logarithmic: false,
            is_range: false,
            words,
        }
    }

    /// Whether it takes words in place of numbers.
    pub fn is_of_words(&self) -> bool {
        !self.words.is_empty()
    }

    /// How many values there are.
    #[expect(clippy::len_without_is_empty, reason = "there is one at least")]
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Its name and the range of its values without their unit.
    pub(crate) fn range_text(&self) -> String {
        let [first, last] = [self.numbers[0], self.numbers[self.len() - 1]];
        let rest = if self.len() == 1 { String::new() } else { format!("..{last}") };
        format!("{}={first}{rest}", self.name)
    }

    /// A value as it would be written in a scene.
    pub fn text(&self, at: usize) -> String {
        if let Some(word) = self.words.get(at) {
            return word.clone();
        }
        number_text(self.numbers[at], &self.unit)
    }
}

/// A number with its unit as it would be written in a scene.
pub(crate) fn number_text(number: f64, unit: &str) -> String {
    let (plain, scientific) = (number.to_string(), format!("{number:e}"));
    let number = if scientific.len() < plain.len() { scientific } else { plain };
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

type Numbers<'t> = (Vec<f64>, &'t str, bool);

fn range<'t>(first: &'t str, last: &'t str, rest: &[&str]) -> Result<Numbers<'t>, VariationFault> {
    let (first, last) = (Written::of(first)?, Written::of(last)?);
    let unit = if last.unit.is_empty() { first.unit } else { last.unit };
    let (low, high) = (first.in_unit(unit)?, last.in_unit(unit)?);
    let mut rest = rest.iter().filter(|own| !own.is_empty()).peekable();
    let count = match rest.next_if(|own| own.starts_with(|c: char| !c.is_alphabetic())) {
        None => USUAL,
        Some(text) => match text.parse() {
            Ok(count @ 2..=MOST) => count,
            _ => return Err(VariationFault::BadCount { text: (*text).to_owned() }),
        },
    };
    let is_logarithmic = match rest.next() {
        None => false,
        Some(word) if SCALES.contains(word) => *word == "log",
        Some(word) => {
            let near = nearest(word, SCALES);
            return Err(VariationFault::UnknownScale { word: (*word).to_owned(), near });
        }
    };
    if let Some(text) = rest.next() {
        return Err(VariationFault::TooMuch { text: (*text).to_owned() });
    }
    if high <= low {
        let text = |number: f64| format!("{number} {unit}").trim_end().to_owned();
        return Err(VariationFault::Falling { first: text(low), second: text(high) });
    }
    if is_logarithmic && low <= 0.0 {
        return Err(VariationFault::NotPositive { text: first.text.to_owned() });
    }
    let value = |at: usize| {
        let share = at as f64 / (count - 1) as f64;
        match at {
            0 => low,
            _ if at == count - 1 => high,
            _ if is_logarithmic => handy(low * (high / low).powf(share)),
            _ => handy(low + (high - low) * share),
        }
    };
    Ok(((0..count).map(value).collect(), unit, is_logarithmic))
}

/// A number without the rounding in its last digit.
pub(crate) fn handy(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}

fn list<'t>(parts: &[&'t str]) -> Result<Numbers<'t>, VariationFault> {
    let written: Vec<Written<'t>> =
        parts.iter().map(|part| Written::of(part)).collect::<Result<_, _>>()?;
    let unit = written.iter().rev().map(|own| own.unit).find(|own| !own.is_empty());
    let unit = unit.unwrap_or("");
    let numbers = written.iter().map(|own| own.in_unit(unit)).collect::<Result<Vec<f64>, _>>()?;
    Ok((numbers, unit, false))
}

/// What is wrong with values of one dimension where another is wanted.
pub(crate) fn other_dimension(text: &str, dimension: Dimension, wanted: Dimension) -> String {
    format!("`{text}` is in {}, the value in the scene in {}", si_unit(dimension), si_unit(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        Variation::parse(text).unwrap_err().to_string()
    }

    #[test]
    fn a_range_has_its_ends_exactly_and_equal_ratios_or_differences_between() {
        let own = Variation::parse("K2 = 5..30 MN/m, 26, log").unwrap();
        assert_eq!((own.name.as_str(), own.unit.as_str(), own.len()), ("K2", "MN/m", 26));
        assert_eq!((own.values[0], own.values[25]), (5e6, 3e7));
        assert!(own.is_logarithmic && own.dimension == Some(Dimension::STIFFNESS));
        let ratio = own.values[1] / own.values[0];
        assert!(own.values.windows(2).all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-14));
        let own = Variation::parse("head.velocity=1..2 m/s,5").unwrap();
        assert_eq!(own.numbers, [1.0, 1.25, 1.5, 1.75, 2.0]);
        assert_eq!(Variation::parse("x=0..1").unwrap().len(), 11);
        assert_eq!(Variation::parse("x=500 g..2 kg,2").unwrap().numbers, [0.5, 2.0]);
    }

    #[test]
    fn a_list_takes_the_unit_that_stands_last() {
        let own = Variation::parse("C=2, 4,6.5 kN s/m").unwrap();
        assert_eq!(own.values, [2e3, 4e3, 6.5e3]);
        assert_eq!(own.text(2), "6.5 kN s/m");
        assert_eq!(Variation::parse("h=8 mm,2 cm").unwrap().numbers, [0.8, 2.0]);
    }

    #[test]
    fn a_second_number_asks_for_an_argument_of_its_own() {
        let fault = Variation::parse("T=5..10 mm,V=2..4 m/s,3").unwrap_err();
        assert_eq!(fault.to_string(), "`V=2..4 m/s,3` is another number of the scene");
        assert!(fault.help().contains("`--vary \"V=2..4 m/s,3\"`"), "{}", fault.help());
    }

    #[test]
    fn words_are_taken_where_none_is_a_quantity() {
        let own = Variation::parse("liner.material = eps, epp,vn").unwrap();
        assert_eq!(own.words, ["eps", "epp", "vn"]);
        assert_eq!((own.text(2), own.len()), ("vn".to_owned(), 3));
        assert!(fault("liner.material=eps,5 mm").contains("does not begin with a number"));
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        assert!(fault("K2").contains("does not name a parameter"));
        assert!(fault("K2=").contains("does not name a parameter"));
        assert!(fault("K2=a..b").contains("does not begin with a number"));
        assert!(fault("K2=1..2 N/m,1").contains("not a number of values from 2"));
        assert!(fault("K2=1..2 N/m,5,lgo").contains("`lgo` is not a scale"));
        let help = Variation::parse("K2=1..2 N/m,5,lgo").unwrap_err().help();
        assert_eq!(help, "did you mean `log`?");
        assert!(fault("K2=0..2 N/m,5,log").contains("cannot begin at `0`"));
        assert!(fault("K2=1..2 N/m,5,log,7").contains("`7` stands behind"));
        assert!(fault("K2=30..5 N/m").contains("do not rise"));
        assert!(fault("K2=1,1 N/m").contains("do not rise"));
        assert!(fault("K2=1 s..2 m").contains("do not measure the same"));
        assert!(fault("K2=1..2 MegaN").contains("not a known unit"));
    }
}
