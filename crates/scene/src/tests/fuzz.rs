//! Mutated scenes are read or refused, never a panic.

use crate::{ReadOptions, read_bytes, read_named_model, read_network, references, templates};

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
    "material = \"foam\"",
    "thickness = 0, ",
    "area = \"1e300 m^2\", ",
    "shift = { wlf = {",
    "prony = { terms = [[",
    "\"-300 degC\"",
    "\"2 MPa\"",
];

/// Everything that a model may be.
const PADS: &str = r#"
[values]
E = "2 MPa"
cold = "-10 degC"

[materials]
foam = { series = [{ material = "core", name = "core" }, { spring = "E" }], shift = { wlf = { temperature = "cold", reference = "20 degC" } } }
core = { prony = { equilibrium = "E", terms = [["1 ms", "3 MPa"], ["0.1 s", "1 MPa"]] } }
wax = { kelvin-chain = [["2 ms", "0.5 1/MPa"], ["1 s", "0.1 1/MPa"]] }

[models.pad]
series = [
  { material = "foam", thickness = "1 cm", area = "80 cm^2" },
  { material = "wax", thickness = 0.01, area = 0.008, name = "wax", shift = { arrhenius = { temperature = 280, reference = 300, energy = "80 kJ/mol" } } },
]

[nodes]
head = { mass = 1, velocity = 1 }

[elements]
pad = { between = ["head", "ground"], model = "pad" }
other = { between = ["head", "ground"], material = "foam", thickness = "2 cm", area = "100 cm^2" }

[run]
duration = 1
"#;

#[test]
fn mutated_models_never_panic() {
    let mut random = Random(31);
    let options = ReadOptions::default();
    let mut read = 0;
    let whole = read_bytes(PADS.as_bytes(), &options).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(whole.warnings.is_empty(), "{}", whole.warnings);
    for _ in 0..1500 {
        let bytes = mutate(PADS.as_bytes(), &mut random);
        read += usize::from(read_bytes(&bytes, &options).is_ok());
        let text = String::from_utf8_lossy(&bytes);
        for name in ["", "foam", "pad", "other"] {
            match read_named_model(&text, name, &options) {
                Ok(checked) => drop(crate::write_model_table(name, &checked.value.model, &[])),
                Err(errors) => assert!(!errors.render(false).is_empty()),
            }
        }
        drop(read_network(&text, &options));
    }
    assert!(read > 0);
}

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
