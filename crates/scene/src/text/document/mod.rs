//! A TOML text as a tree of values that know their places.

mod blocks;
pub(crate) mod scattered;
mod tree;

use std::sync::Arc;

use toml::de::DeTable;

use self::tree::{Builder, Words};
pub(crate) use self::tree::{Content, Entry, Item, Word};
use super::{
    nesting,
    repair::repaired,
    source::{Place, Source},
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    quantities::scatter::Scatter,
};

/// A text may have so many bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// Arrays, tables and dotted keys may nest so deeply in a text. A level takes less than 4 kB of the stack.
pub(crate) const MAX_LEVELS: usize = 128;

/// The value of a key in an entry that is a table.
pub(crate) fn value_of<'d>(entry: &'d Entry, key: &str) -> Option<&'d Item> {
    entry.item.table()?.iter().find(|own| own.key == key).map(|own| &own.item)
}

/// Parses `source`; `None` when there is nothing to go on with. Numbers with scatter are read as their means.
pub(crate) fn parse(source: &Arc<Source>, faults: &Faults) -> Option<Item> {
    parse_scattered(source, faults).map(|own| own.0)
}

/// A document and the numbers with scatter whose means stand in it, with their places.
pub(crate) type Scattered = (Item, Vec<(Place, Scatter)>);

/// The same, with the numbers that have scatter.
pub(crate) fn parse_scattered(source: &Arc<Source>, faults: &Faults) -> Option<Scattered> {
    let mut root = parse_plain(source, faults)?;
    let found = if Scatter::is_possible(&source.text) {
        scattered::take(&mut root, faults)
    } else {
        Vec::new()
    };
    Some((root, found))
}

fn parse_plain(source: &Arc<Source>, faults: &Faults) -> Option<Item> {
    let number = faults.add_source(Arc::clone(source));
    let text = &source.text;
    if text.len() > MAX_BYTES {
        faults.error(None, Fault::TooLarge { bytes: text.len() });
        return None;
    }
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        faults.error(Place::new(number, &(0..0)), Fault::Empty);
        return None;
    }
    let (levels, deepest) = nesting::depth(text);
    if levels > MAX_LEVELS {
        let place = Place::new(number, &(deepest..deepest + 1));
        faults.error(place, Fault::TooDeep { levels, limit: MAX_LEVELS });
        return None;
    }
    let (mut root, mut errors) = parse_text(text, number);
    if !errors.is_empty() {
        let (text, slips) = repaired(text);
        if !slips.is_empty() {
            (root, errors) = parse_text(&text, number);
        }
        for (span, fault) in slips {
            faults.error(Place::new(number, &span), fault);
        }
    }
    let mut last = None;
    for (place, fault) in errors {
        // The parser may say the same thing twice in other words.
        let is_echo = last.replace(place.start) == Some(place.start);
        if is_echo && matches!(fault, Fault::Syntax { .. }) {
            continue;
        }
        if !matches!(fault, Fault::DuplicateKey { .. } | Fault::NotQuoted { .. }) {
            faults.damage();
        }
        faults.error(place, fault);
    }
    root
}

type Parsed = (Option<Item>, Vec<(Place, Fault)>);

fn parse_text(text: &str, number: u32) -> Parsed {
    let mut builder = Builder { number, words: Words::default() };
    if let Some(root) = blocks::root(text, &mut builder) {
        return (Some(root), Vec::new());
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    let place = Place::new(number, &root.span());
    let entries = builder.entries(root.into_inner(), 0);
    let faults = errors.iter().map(|error| syntax_fault(text, number, error)).collect();
    (Some(Item { value: Content::Table(entries.into_boxed_slice()), place }), faults)
}

fn syntax_fault(text: &str, number: u32, error: &toml::de::Error) -> (Place, Fault) {
    let span = error.span().unwrap_or(0..0);
    let at = text.get(span.clone()).unwrap_or_default().to_owned();
    let fault = match error.message() {
        "duplicate key" => Fault::DuplicateKey { key: at },
        message if message.starts_with("string values must be quoted") => {
            Fault::NotQuoted { text: at }
        }
        message => Fault::Syntax { message: message.to_owned() },
    };
    (Place::new(number, &span), fault)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> (Option<Item>, String) {
        let faults = Faults::default();
        let item = parse(&Arc::new(Source::new("a.toml", text)), &faults);
        (item, faults.finish().render(false))
    }

    #[test]
    fn entries_keep_the_order_of_the_text() {
        let (item, errors) = parsed("z = 1\na = 2\n[m]\nc = 0x10\nb = true\n");
        let item = item.unwrap();
        let keys = |item: &Item| {
            item.table().unwrap().iter().map(|entry| entry.key.to_string()).collect::<Vec<_>>()
        };
        assert_eq!(keys(&item), ["z", "a", "m"]);
        let inner = &item.table().unwrap()[2].item;
        assert_eq!(keys(inner), ["c", "b"]);
        assert!(matches!(&inner.table().unwrap()[0].item.value, Content::Number(n) if *n == "16"));
        assert!(errors.is_empty());
    }

    #[test]
    fn deep_texts_are_parsed_up_to_the_limit_and_refused_beyond() {
        for (open, close) in [("[", "]"), ("{a=", "}")] {
            let text = |n: usize| format!("a = {}1{}\n", open.repeat(n), close.repeat(n));
            let (item, errors) = parsed(&text(MAX_LEVELS));
            assert!(item.is_some() && errors.is_empty(), "{errors}");
            for n in [MAX_LEVELS + 1, 100_000] {
                let (item, errors) = parsed(&text(n));
                assert!(item.is_none() && errors.contains("the limit is 128"), "{errors}");
            }
        }
        let dotted = format!("{}a = 1\n", "a.".repeat(100_000));
        assert!(parsed(&dotted).1.contains("the limit is 128"));
        assert!(parsed(&"[".repeat(100_000)).1.contains("the limit is 128"));
    }

    #[test]
    fn a_byte_order_mark_is_no_content() {
        assert!(parsed("\u{feff}a = 1\n").1.is_empty());
        assert!(parsed("\u{feff} \n").1.contains("the scene is empty"));
    }

    #[test]
    fn several_syntax_errors_come_at_once() {
        let (_, errors) = parsed("a = 10 kg\na = 3\nb = 'x\n");
        assert!(errors.contains("write \"10 kg\""), "{errors}");
        assert!(errors.contains("`a` is given twice"), "{errors}");
        assert!(errors.contains("invalid literal string"), "{errors}");
    }
}
