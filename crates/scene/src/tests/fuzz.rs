//! Mutated scenes are read or refused, never a panic.

use crate::{ReadOptions, read_bytes, references, templates};

/// Steele and Vigna's splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() % bound.max(1) as u64).unwrap()
    }
}

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
    "#",
    "-",
    "1e400",
    "nan",
    "µ",
    "\u{feff}",
    "\"\"\"",
    "'''",
    "\\",
    "0",
    "true",
    "spring",
    "series = [",
    "model = \"valox-pad\"",
    "\"1 km/h\"",
    "\"-3 N\"",
    "ground",
    "{}",
    "[]",
    "\u{0}",
    "\u{202e}",
    "🦀",
    "\r",
    "1979-05-27",
];

fn mutate(text: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(12)).min(bytes.len());
        let fragment = FRAGMENTS[random.below(FRAGMENTS.len())].as_bytes();
        match random.below(6) {
            0 => drop(bytes.drain(at..end)),
            1 => drop(bytes.splice(at..at, fragment.iter().copied())),
            2 => drop(bytes.splice(at..end, fragment.iter().copied())),
            3 => bytes.truncate(at),
            4 => {
                let copy = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                drop(bytes.splice(to..to, copy));
            }
            _ => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte = u8::try_from(random.below(256)).unwrap();
                }
            }
        }
    }
    bytes
}

#[test]
fn mutated_scenes_never_panic() {
    let mut random = Random(20_240_229);
    let mut refused = 0;
    for shipped in templates().iter().chain(references()) {
        for _ in 0..400 {
            let bytes = mutate(shipped.text.as_bytes(), &mut random);
            match read_bytes(&bytes, &ReadOptions::default()) {
                Ok(checked) => drop(checked.warnings.render(true)),
                Err(errors) => {
                    refused += 1;
                    assert!(!errors.is_empty());
                    assert!(!errors.render(false).is_empty());
                    for diagnostic in &errors.list {
                        let _ = (diagnostic.line_and_column(), diagnostic.help());
                    }
                }
            }
        }
    }
    assert!(refused > 500, "{refused}");
}

#[test]
fn mutated_quantities_never_panic() {
    let mut random = Random(7);
    for text in ["20 MN/m", "6 kN s/m^2", "-1.5e-3 (kN·m)/µs²", "1 g0", "0.1 %"] {
        for _ in 0..5000 {
            let bytes = mutate(text.as_bytes(), &mut random);
            let text = String::from_utf8_lossy(&bytes);
            if let Ok(quantity) = crate::units::parse_quantity(&text) {
                assert!(quantity.value.is_finite(), "{text}");
            }
        }
    }
}
