//! Bytes of a file of numbers as text.
//!
//! A rule of our own and no crate: what loggers and test machines write is UTF-8, UTF-16 with or without a mark, or
//! the one-byte set of western Windows, which is 27 characters besides Latin-1.

use std::borrow::Cow;

/// What the bytes from 0x80 to 0x9F stand for in Windows-1252; the five that are not in use stay control
/// characters, as on the web.
const WINDOWS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// The text of a file of numbers, in whichever encoding it is: UTF-8; UTF-16 where it has a byte order mark, or
/// where every second one of its first bytes is zero; else Windows-1252, which holds Latin-1. Where lines end with a
/// carriage return alone, they end with a line feed in the text.
///
/// # Examples
///
/// ```
/// use dashpot_scene::table_text;
///
/// assert_eq!(table_text("Weg [µm]".as_bytes()), "Weg [µm]");
/// assert_eq!(table_text(b"Weg [\xb5m]"), "Weg [µm]");
/// assert_eq!(table_text(b"\xff\xfes\0;\0N\0"), "s;N");
/// assert_eq!(table_text(b"0;0\r1;2\r"), "0;0\n1;2\n");
/// ```
pub fn table_text(bytes: &[u8]) -> Cow<'_, str> {
    let text = decoded(bytes);
    if text.contains('\r') && !text.contains('\n') { text.replace('\r', "\n").into() } else { text }
}

fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    if let Some(rest) = bytes.strip_prefix(b"\xff\xfe") {
        return utf16(rest, u16::from_le_bytes).into();
    }
    if let Some(rest) = bytes.strip_prefix(b"\xfe\xff") {
        return utf16(rest, u16::from_be_bytes).into();
    }
    let first = &bytes[..bytes.len().min(64)];
    let zeros = |odd: usize| {
        let own = first.chunks_exact(2).filter(|pair| pair[odd] == 0 && pair[1 - odd] != 0).count();
        own > 0 && own == first.len() / 2
    };
    if zeros(1) {
        return utf16(bytes, u16::from_le_bytes).into();
    }
    if zeros(0) {
        return utf16(bytes, u16::from_be_bytes).into();
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| windows(byte)).collect::<String>().into(),
    }
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).map(|own| own.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

fn windows(byte: u8) -> char {
    match byte {
        0x80..=0x9f => WINDOWS[usize::from(byte - 0x80)],
        other => char::from(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_of_a_text_is_the_same_text() {
        let text = "Kraft [µN]; Temperatur [°C]; – 5 €\r\n1;2;3\r\n";
        let le: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let be: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let marked = |mark: &[u8], own: &[u8]| [mark, own].concat();
        let windows: Vec<u8> = text
            .chars()
            .map(|own| match own {
                '–' => 0x96,
                '€' => 0x80,
                _ => u8::try_from(u32::from(own)).unwrap(),
            })
            .collect();
        for bytes in
            [text.as_bytes().to_vec(), windows, marked(b"\xff\xfe", &le), marked(b"\xfe\xff", &be)]
        {
            assert_eq!(table_text(&bytes), text);
        }
        // Without a mark, as long as the first characters are in Latin-1.
        let plain = "time [s];force [N]\n0;1\n";
        let units = plain.encode_utf16();
        assert_eq!(
            table_text(&units.clone().flat_map(u16::to_le_bytes).collect::<Vec<_>>()),
            plain
        );
        assert_eq!(table_text(&units.flat_map(u16::to_be_bytes).collect::<Vec<_>>()), plain);
    }

    #[test]
    fn half_a_character_at_the_end_is_none() {
        assert_eq!(table_text(b"\xff\xfea\0b"), "a");
        assert_eq!(table_text(b""), "");
        assert_eq!(table_text(b"\0"), "\0");
    }
}
