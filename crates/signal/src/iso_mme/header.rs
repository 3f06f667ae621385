//! Lines `name :value` before the samples.

use super::{MmeError, MmeFault, NO_VALUE};

/// An entry: name, value, line from 1.
type Entry<'t> = (&'t str, &'t str, usize);

/// The entries of a text, and the lines behind them.
pub(super) struct Header<'t> {
    entries: Vec<Entry<'t>>,
    rest: Vec<(usize, &'t str)>,
    /// The line behind the header.
    end: usize,
}

impl<'t> Header<'t> {
    /// Reads a text.
    pub(super) fn read(text: &'t str) -> Result<Self, MmeError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim()));
        let lines: Vec<(usize, &str)> = lines.filter(|own| !own.1.is_empty()).collect();
        let is_sample = |own: &(usize, &str)| !own.1.contains(':');
        let split = lines.iter().position(is_sample).unwrap_or(lines.len());
        let entries = lines[..split].iter().filter_map(|(line, own)| {
            let (name, value) = own.split_once(':')?;
            Some((name.trim(), value.trim(), *line))
        });
        let rest = lines[split..].to_vec();
        let begins_odd = rest.first().filter(|own| own.1.starts_with(char::is_alphabetic));
        let (line, begins) = begins_odd.copied().unwrap_or_default();
        let is_number = begins.replacen(',', ".", 1).parse::<f64>().is_ok();
        if !begins.is_empty() && !is_number {
            return Err(MmeError { line, fault: MmeFault::NoEntry { text: begins.to_owned() } });
        }
        let end = rest.first().map_or(lines.len() + 1, |own| own.0);
        Ok(Self { entries: entries.collect(), rest, end })
    }

    /// The value of an entry with its line, where it says something.
    pub(super) fn value(&self, name: &str) -> Option<(&'t str, usize)> {
        let found = self.entries.iter().find(|own| own.0.eq_ignore_ascii_case(name))?;
        let says = !found.1.is_empty() && !found.1.eq_ignore_ascii_case(NO_VALUE);
        says.then_some((found.1, found.2))
    }

    pub(super) fn wanted(&self, name: &'static str) -> Result<(&'t str, usize), MmeError> {
        let fault = MmeFault::Missing { name };
        self.value(name).ok_or(MmeError { line: self.end, fault })
    }

    /// A number, with a unit of time behind it or without.
    pub(super) fn number(&self, name: &'static str) -> Result<Option<f64>, MmeError> {
        let Some((text, line)) = self.value(name) else { return Ok(None) };
        let plain = text.trim_end_matches('s').trim_end().replacen(',', ".", 1);
        let number = plain.parse::<f64>().ok().filter(|own| own.is_finite());
        let fault = || MmeFault::NoNumber { name, text: text.to_owned() };
        number.map(Some).ok_or_else(|| MmeError { line, fault: fault() })
    }

    pub(super) fn positive(&self, name: &'static str) -> Result<f64, MmeError> {
        let (text, line) = self.wanted(name)?;
        let fault = MmeFault::NoNumber { name, text: text.to_owned() };
        self.number(name)?.filter(|own| *own > 0.0).ok_or(MmeError { line, fault })
    }

    pub(super) fn count(&self, name: &'static str) -> Result<Option<(usize, usize)>, MmeError> {
        let Some((text, line)) = self.value(name) else { return Ok(None) };
        let fault = MmeFault::NoNumber { name, text: text.to_owned() };
        text.parse().map(|count| Some((count, line))).map_err(|_| MmeError { line, fault })
    }

    /// The lines behind the header.
    pub(super) fn samples(&self) -> impl Iterator<Item = (usize, &'t str)> + '_ {
        self.rest.iter().copied()
    }
}
