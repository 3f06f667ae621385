//! How deeply a text nests, found before it is parsed.

use std::ops::Range;

/// The deepest nesting of arrays, tables and dotted keys in a TOML text, bounded from above, and
/// the byte at which it is reached.
///
/// Strings and comments are skipped; a text that is not TOML gets a number as well.
pub(crate) fn depth(text: &str) -> (usize, usize) {
    let mut scan = Scan::default();
    walk(text, |byte, at| scan.step(byte, at));
    (scan.deepest, scan.place)
}

/// A TOML text cut at ends of lines that are in no brackets: before every line that begins with a
/// bracket, and where a part is longer than `most` bytes.
pub(crate) fn blocks(text: &str, most: usize) -> Vec<Range<usize>> {
    let mut scan = Scan::default();
    let (mut blocks, mut start) = (Vec::new(), 0);
    walk(text, |byte, at| {
        scan.step(byte, at);
        let next = at + 1;
        let is_end = byte == b'\n' && scan.level == 0;
        let has_header = || text[next..].trim_start_matches([' ', '\t']).starts_with('[');
        if is_end && (next - start >= most || has_header()) {
            blocks.push(start..next);
            start = next;
        }
    });
    blocks.push(start..text.len());
    blocks
}

/// Shows all bytes that are in no string and no comment, and where they stand, to `see`.
fn walk(text: &str, mut see: impl FnMut(u8, usize)) {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        match bytes[at] {
            b'#' => at = skip_to_newline(bytes, at),
            quote @ (b'"' | b'\'') => at = skip_string(bytes, at, quote),
            byte => {
                see(byte, at);
                at += 1;
            }
        }
    }
}

#[derive(Default)]
struct Scan {
    /// Depth at each open bracket.
    open: Vec<usize>,
    level: usize,
    deepest: usize,
    place: usize,
}

impl Scan {
    fn step(&mut self, byte: u8, at: usize) {
        match byte {
            b'[' | b'{' => {
                self.level += 1;
                self.open.push(self.level);
            }
            b']' | b'}' => {
                self.open.pop();
                self.level = self.base();
            }
            b'.' => self.level += 1,
            b',' | b'\n' => self.level = self.base(),
            _ => {}
        }
        if self.level > self.deepest {
            (self.deepest, self.place) = (self.level, at);
        }
    }

    fn base(&self) -> usize {
        self.open.last().copied().unwrap_or(0)
    }
}

fn skip_to_newline(bytes: &[u8], at: usize) -> usize {
    bytes[at..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |skip| at + skip)
}

/// The byte after the string that opens at `at`; a single-line string ends with its line.
fn skip_string(bytes: &[u8], at: usize, quote: u8) -> usize {
    let long = bytes[at..].starts_with(&[quote; 3]);
    let mut at = at + if long { 3 } else { 1 };
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if quote == b'"' => at += 1,
            b'\n' if !long => return at,
            byte if byte == quote && !long => return at + 1,
            byte if byte == quote && bytes[at..].starts_with(&[quote; 3]) => {
                // Up to two quotes may stand directly before the closing three.
                return at + bytes[at..].iter().take(5).take_while(|&&byte| byte == quote).count();
            }
            _ => {}
        }
        at += 1;
    }
    bytes.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_in_strings_and_comments_do_not_count() {
        assert_eq!(depth("a = [[1]]").0, 2);
        assert_eq!(depth("a = \"[[[[\" # [[[[\nb = '{{{'").0, 0);
        assert_eq!(depth("a = \"\"\"\n[[[ \\\" \"\"\"\nb = [1]").0, 1);
        assert_eq!(depth("a = '''[['[[''''\nb = [1]").0, 1);
        assert_eq!(depth("a = \"[\\\"[\"\nb = [[[1]]]").0, 3);
    }

    #[test]
    fn dots_nest_as_well() {
        assert_eq!(depth("a.b.c = { d.e = 1 }").0, 4);
        assert_eq!(depth("a = [1.5, 2.5, 3.5]").0, 2);
        assert_eq!(depth("]]]]] a = 1").0, 0);
    }
}
