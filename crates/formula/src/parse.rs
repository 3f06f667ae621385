//! From text to tree.

use std::{ops::Range, sync::Arc};

use dashpot_units::{Dimension, Quantity, STANDARD_GRAVITY, UnitError, parse_quantity};

use crate::{
    Formula, FormulaError, FormulaFault, Function,
    tree::{Kind, Node, Operator},
    unit::{number, quantity},
};

/// So long a formula may be, in bytes.
const LONGEST: usize = 1000;
/// So deep parentheses and signs may stand in each other.
const DEEPEST: usize = 50;

/// Whether `text` is meant to be computed: more than a number with a unit, or a name alone. Then what is wrong with
/// it is best said by [`Formula::parse`](crate::Formula::parse).
pub fn is_arithmetic(text: &str, is_name: &dyn Fn(&str) -> bool) -> bool {
    let text = text.trim();
    if is_name(text) {
        return false;
    }
    if parse_quantity(text).is_ok() {
        // Unless a name stands where a unit could.
        let unsigned = text.trim_start_matches(['+', '-']);
        let length = number(unsigned);
        let unit = length.map_or("", |length| unsigned[length..].trim_start());
        if unit.chars().all(char::is_alphabetic) {
            return is_name(unit);
        }
        return match length.map(|length| quantity(unsigned, length, is_name)) {
            Some(Ok((_, end))) => unsigned[end..].trim_start().starts_with(['*', '·', '⋅']),
            found => found.is_some(),
        };
    }
    let mut last: Option<char> = None;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if starts_word(first) {
            let name = name(rest, is_name);
            // A word that stands for something, wherever it may be.
            if is_name(name) || Function::of(name).is_some() || constant(name).is_some() {
                return true;
            }
            // An unknown word at the start, with an operation behind it.
            let behind = rest[name.len()..].trim_start();
            if last.is_none() {
                return behind.starts_with(['*', '/', '+', '(', '^']);
            }
            name.len()
        } else if let Some(length) = number(rest) {
            if matches!(last, Some('*' | '·' | '⋅' | '/' | '+' | '-' | '('))
                && rest.len() < text.len() - 1
            {
                return true;
            }
            // What belongs to its unit is no name.
            quantity(rest, length, is_name).map_or_else(|error| error.span.end, |found| found.1)
        } else {
            first.len_utf8()
        };
        if !first.is_whitespace() {
            last = rest[..length].chars().next_back();
        }
        rest = &rest[length..];
    }
    false
}

impl Formula {
    /// Reads a text in which the words that `is_name` knows are names.
    ///
    /// # Errors
    ///
    /// [`FormulaError`] where it cannot be read.
    pub fn parse(text: &str, is_name: &dyn Fn(&str) -> bool) -> Result<Self, FormulaError> {
        parse(text, is_name).map(|root| Self { root: Arc::new(root) })
    }
}

fn parse(text: &str, is_name: &dyn Fn(&str) -> bool) -> Result<Node, FormulaError> {
    if text.len() > LONGEST {
        return Err(FormulaError { fault: FormulaFault::TooLong, span: 0..text.len() });
    }
    let mut parser = Parser { text, at: 0, depth: 0, is_name };
    let root = parser.sum()?;
    parser.skip();
    match parser.rest() {
        "" => Ok(root),
        rest if rest.starts_with(',') => {
            let text = text.to_owned();
            let fault = FormulaFault::Quantity(UnitError::DecimalComma { text });
            Err(parser.error(fault, 1))
        }
        _ => Err(parser.unexpected("an operation, + - * / or ^,")),
    }
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    is_name: &'t dyn Fn(&str) -> bool,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn error(&self, fault: FormulaFault, length: usize) -> FormulaError {
        FormulaError { fault, span: self.at..(self.at + length).min(self.text.len()) }
    }

    fn unexpected(&self, expected: &'static str) -> FormulaError {
        let rest = self.rest();
        let first = rest.chars().next().map_or(0, char::len_utf8);
        let length =
            if rest.starts_with(starts_word) { name(rest, self.is_name).len() } else { first };
        let found = rest[..length].to_owned();
        self.error(FormulaFault::Unexpected { expected, found }, length.max(1))
    }

    /// Takes the first one of `symbols` that stands here.
    fn take<T: Copy>(&mut self, symbols: &[(char, T)]) -> Option<T> {
        self.skip();
        let first = self.rest().chars().next()?;
        let found = symbols.iter().find(|own| own.0 == first)?.1;
        self.at += first.len_utf8();
        Some(found)
    }

    /// One level deeper.
    fn deeper(
        &mut self,
        inner: impl FnOnce(&mut Self) -> Result<Node, FormulaError>,
    ) -> Result<Node, FormulaError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.error(FormulaFault::TooLong, 1));
        }
        let node = inner(self);
        self.depth -= 1;
        node
    }

    fn sum(&mut self) -> Result<Node, FormulaError> {
        const SYMBOLS: [(char, Operator); 3] =
            [('+', Operator::Plus), ('-', Operator::Minus), ('−', Operator::Minus)];
        let mut left = self.product()?;
        while let Some(operator) = self.take(&SYMBOLS) {
            left = binary(operator, left, self.product()?);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Node, FormulaError> {
        const SYMBOLS: [(char, Operator); 4] = [
            ('*', Operator::Times),
            ('·', Operator::Times),
            ('⋅', Operator::Times),
            ('/', Operator::Over),
        ];
        let mut left = self.sign()?;
        while let Some(operator) = self.take(&SYMBOLS) {
            left = binary(operator, left, self.sign()?);
        }
        Ok(left)
    }

    fn sign(&mut self) -> Result<Node, FormulaError> {
        self.skip();
        let start = self.at;
        match self.take(&[('-', true), ('−', true), ('+', false)]) {
            Some(is_negative) => {
                let inner = self.deeper(Self::sign)?;
                let span = start..inner.span.end;
                Ok(if is_negative {
                    Node { kind: Kind::Negative(Arc::new(inner)), span }
                } else {
                    inner
                })
            }
            None => self.power(),
        }
    }

    fn power(&mut self) -> Result<Node, FormulaError> {
        let base = self.atom()?;
        match self.take(&[('^', ())]) {
            Some(()) => Ok(binary(Operator::Power, base, self.deeper(Self::sign)?)),
            None => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Node, FormulaError> {
        self.skip();
        let (start, rest) = (self.at, self.rest());
        if self.take(&[('(', ())]).is_some() {
            let inner = self.deeper(Self::sum)?;
            self.close("a closing parenthesis")?;
            return Ok(Node { span: start..self.at, ..inner });
        }
        if let Some(length) = number(rest) {
            let (own, length) = quantity(rest, length, self.is_name).map_err(|error| {
                FormulaError { span: start + error.span.start..start + error.span.end, ..error }
            })?;
            self.at += length;
            if own.is_celsius {
                let unit = self.text[start..self.at].to_owned();
                let fault = FormulaFault::Quantity(UnitError::CelsiusInProduct { unit });
                return Err(FormulaError { fault, span: start..self.at });
            }
            return Ok(Node { kind: Kind::Number(own), span: start..self.at });
        }
        if !rest.starts_with(starts_word) {
            return Err(self.unexpected("a number or a name"));
        }
        let word = name(rest, self.is_name);
        self.at += word.len();
        let span = start..self.at;
        if !(self.is_name)(word) {
            if self.rest().trim_start().starts_with('(') {
                return self.call(word, span);
            }
            if let Some(own) = constant(word) {
                return Ok(Node { kind: Kind::Number(own), span });
            }
        }
        Ok(Node { kind: Kind::Name(word.to_owned()), span })
    }

    fn close(&mut self, expected: &'static str) -> Result<(), FormulaError> {
        self.take(&[(')', ())]).ok_or_else(|| self.unexpected(expected))
    }

    fn call(&mut self, word: &str, span: Range<usize>) -> Result<Node, FormulaError> {
        let Some(function) = Function::of(word) else {
            let fault = FormulaFault::UnknownFunction { name: word.to_owned() };
            return Err(FormulaError { fault, span });
        };
        self.take(&[('(', ())]);
        let mut parts = vec![Arc::new(self.deeper(Self::sum)?)];
        while self.take(&[(',', ())]).is_some() {
            parts.push(Arc::new(self.deeper(Self::sum)?));
        }
        self.close("a comma or a closing parenthesis")?;
        let span = span.start..self.at;
        let (expected, found) = (function.arguments(), parts.len());
        if expected != found {
            let fault = FormulaFault::Arguments { function: function.word(), expected, found };
            return Err(FormulaError { fault, span });
        }
        Ok(Node { kind: Kind::Call(function, parts), span })
    }
}

fn binary(operator: Operator, left: Node, right: Node) -> Node {
    let span = left.span.start..right.span.end;
    Node { kind: Kind::Binary(operator, [left, right].map(Arc::new)), span }
}

fn starts_word(own: char) -> bool {
    own.is_alphabetic() || own == '_'
}

/// The word at the start of `text`; it goes on behind a `-` only where that is a name.
fn name<'t>(text: &'t str, is_name: &dyn Fn(&str) -> bool) -> &'t str {
    let is_in = |own: char| own.is_alphanumeric() || own == '_';
    let longest = text.find(|own: char| !is_in(own) && own != '-').unwrap_or(text.len());
    let ends = text[..longest].char_indices().filter(|own| own.1 == '-').map(|own| own.0);
    let mut ends: Vec<usize> = ends.chain([longest]).collect();
    let first = ends[0];
    ends.reverse();
    &text[..ends.into_iter().find(|&end| is_name(&text[..end])).unwrap_or(first)]
}

/// What a word stands for everywhere.
fn constant(word: &str) -> Option<Quantity> {
    match word {
        "pi" | "π" => {
            let own = Quantity::of(std::f64::consts::PI, Dimension::NUMBER);
            Some(Quantity { dimension: None, ..own })
        }
        "g0" => Some(Quantity::of(STANDARD_GRAVITY, Dimension::ACCELERATION)),
        _ => None,
    }
}
