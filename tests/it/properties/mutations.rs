//! Damage to texts.

use proptest::{prelude::*, sample::Index};

/// What may be put anywhere.
const FRAGMENTS: &[&str] = &[
    "\"",
    "'",
    "{",
    "}",
    "[",
    "]",
    "[[",
    "]]",
    "=",
    ",",
    ".",
    "\n",
    "\r",
    "#",
    "-",
    "\\",
    "\"\"\"",
    "'''",
    "1e400",
    "-1e-400",
    "nan",
    "inf",
    "0x7fffffffffffffff",
    "99999999999999999999999999",
    "1_0__0",
    "µ",
    "\u{feff}",
    "\u{0}",
    "\u{202e}",
    "🦀",
    "true",
    "1979-05-27",
    "spring",
    "series = [",
    "parallel = [",
    "model = \"m0\"",
    "material = \"m1\"",
    "\"1 km/h\"",
    "\"-3 N\"",
    "ground",
    "{}",
    "[]",
    "K",
    "\"1e300 m\"",
    "\"1e-300 kg\"",
    "\"5 kg^99\"",
    "\"-300 degC\"",
    "[values]",
    "K = \"K\"",
    "[nodes.n0]",
    "[run]",
    "shift = {",
    "layers = [",
    "segments = 1000000",
    "0",
    "-0.0",
];

/// One piece of damage.
#[derive(Debug, Clone)]
pub(super) enum Damage {
    Delete(Index, u8),
    Copy(Index, u8, Index),
    Exchange(Index, Index, u8),
    Insert(Index, &'static str),
    Byte(Index, u8),
    /// Brackets around one place, so many deep.
    Nest(Index, u16, bool),
    /// Digits after a digit.
    Digits(Index, u8),
    /// A line that stands twice.
    Line(Index),
    Truncate(Index),
}

pub(super) fn damage() -> impl Strategy<Value = Vec<Damage>> {
    let place = any::<Index>;
    let one = prop_oneof![
        2 => (place(), 0..40u8).prop_map(|(at, length)| Damage::Delete(at, length)),
        2 => (place(), 0..80u8, place()).prop_map(|(at, length, to)| Damage::Copy(at, length, to)),
        2 => (place(), place(), 0..12u8).prop_map(|(at, to, length)| Damage::Exchange(at, to, length)),
        4 => (place(), prop::sample::select(FRAGMENTS)).prop_map(|(at, own)| Damage::Insert(at, own)),
        2 => (place(), any::<u8>()).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        1 => (place(), 0..3000u16, any::<bool>())
            .prop_map(|(at, depth, is_list)| Damage::Nest(at, depth, is_list)),
        2 => (place(), any::<u8>()).prop_map(|(at, count)| Damage::Digits(at, count)),
        2 => place().prop_map(Damage::Line),
        1 => place().prop_map(Damage::Truncate),
    ];
    prop::collection::vec(one, 0..4)
}

/// The damaged text.
pub(super) fn damaged(text: &[u8], damage: &[Damage]) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for own in damage {
        own.apply(&mut bytes);
    }
    bytes
}

impl Damage {
    fn apply(&self, bytes: &mut Vec<u8>) {
        let size = bytes.len();
        let at = |index: &Index| index.index(size + 1);
        let part = |from: usize, length: u8| from..(from + usize::from(length)).min(size);
        match self {
            Self::Delete(from, length) => drop(bytes.drain(part(at(from), *length))),
            Self::Copy(from, length, to) => {
                let copy = bytes[part(at(from), *length)].to_vec();
                drop(bytes.splice(at(to)..at(to), copy));
            }
            Self::Exchange(one, other, length) => {
                for step in 0..usize::from(*length) {
                    let (one, other) = (at(one) + step, at(other) + step);
                    if one < size && other < size {
                        bytes.swap(one, other);
                    }
                }
            }
            Self::Insert(to, own) => drop(bytes.splice(at(to)..at(to), own.bytes())),
            Self::Byte(to, byte) => {
                if let Some(own) = bytes.get_mut(at(to)) {
                    *own = *byte;
                }
            }
            Self::Nest(to, depth, is_list) => {
                let depth = usize::from(*depth);
                let nested = if *is_list {
                    "[".repeat(depth) + &"]".repeat(depth)
                } else {
                    "{ series = [".repeat(depth) + &"] }".repeat(depth)
                };
                drop(bytes.splice(at(to)..at(to), nested.into_bytes()));
            }
            Self::Digits(after, count) => {
                let from = at(after);
                let digit = bytes[from..].iter().position(u8::is_ascii_digit);
                if let Some(found) = digit {
                    let to = from + found;
                    drop(bytes.splice(to..to, vec![b'9'; usize::from(*count)]));
                }
            }
            Self::Line(of) => {
                let from =
                    bytes[..at(of)].iter().rposition(|&own| own == b'\n').map_or(0, |own| own + 1);
                let end = bytes[from..].iter().position(|&own| own == b'\n');
                let line = bytes[from..end.map_or(size, |end| from + end + 1)].to_vec();
                drop(bytes.splice(from..from, line));
            }
            Self::Truncate(to) => bytes.truncate(at(to)),
        }
    }
}
