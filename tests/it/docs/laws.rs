//! Each effect, element, function of time and shift says in its file what a reader must know of it.

use dashpot::network::{
    effects::EFFECTS,
    elements::ELEMENTS,
    parameters::{Parameter, ParameterKind},
    shifts::SHIFTS,
    waveforms::WAVEFORMS,
};

use super::text;

/// Holds each kind against the description of its type, which stands in the file named after it.
#[derive(Default)]
struct Laws {
    kinds: usize,
    missing: Vec<String>,
}

/// The description of a type: the lines of documentation above its attributes and `pub struct`.
fn description<'t>(source: &'t str, name: &str) -> Vec<&'t str> {
    let lines: Vec<&str> = source.lines().map(str::trim_start).collect();
    let is_type = |line: &&str| {
        let rest = line.strip_prefix("pub struct ").and_then(|own| own.strip_prefix(name));
        rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    let at = lines.iter().position(is_type).expect("a type of that name");
    let above = lines[..at].iter().rev().skip_while(|line| line.starts_with("#["));
    let mut found: Vec<&str> = above.map_while(|line| line.strip_prefix("///")).collect();
    found.reverse();
    found
}

/// The type of a kind has its word in another script: `CubicSpring` for `cubic-spring`.
fn type_of(kind: &str) -> String {
    kind.split('-').map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}

impl Laws {
    fn hold(&mut self, folder: &str, kind: &str, parameters: &[Parameter]) {
        self.kinds += 1;
        let path = format!("crates/network/src/{folder}/{}.rs", kind.replace('-', "_"));
        let source = text(&path);
        let told = description(&source, &type_of(kind));
        let mut wanted = vec![" # Limits", " # References"];
        // A key that says it all has no unit and no range.
        let has_numbers = parameters.iter().any(|parameter| parameter.kind != ParameterKind::Flag);
        let columns = |line: &&str| {
            ["symbol", "field", "unit", "range"].iter().all(|column| line.contains(column))
        };
        if has_numbers && !told.iter().any(|line| line.starts_with(" |") && columns(line)) {
            self.missing.push(format!("{path}: a table of symbols, fields, units and ranges"));
        }
        wanted.retain(|heading| !told.contains(heading));
        self.missing.extend(wanted.iter().map(|heading| format!("{path}:{heading}")));
        // Below its heading there is more than the next one.
        for heading in [" # Limits", " # References"] {
            let below = told.iter().skip_while(|line| **line != heading).skip(1);
            let said = below.take_while(|line| !line.starts_with(" # ")).map(|line| line.len());
            if told.contains(&heading) && said.sum::<usize>() < 20 {
                self.missing.push(format!("{path}: nothing under{heading}"));
            }
        }
    }

    fn hold_all(self) {
        assert!(self.kinds > 1);
        assert!(self.missing.is_empty(), "{}", self.missing.join("\n"));
    }
}

#[test]
fn every_effect_describes_law_units_ranges_limits_and_source() {
    let mut laws = Laws::default();
    EFFECTS.iter().for_each(|own| laws.hold("effects", own.word, own.parameters));
    laws.hold_all();
}

#[test]
fn every_element_describes_law_units_ranges_limits_and_source() {
    let mut laws = Laws::default();
    ELEMENTS.iter().for_each(|own| laws.hold("elements", own.word, own.parameters));
    laws.hold_all();
}

#[test]
fn every_function_of_time_describes_law_units_ranges_limits_and_source() {
    let mut laws = Laws::default();
    WAVEFORMS.iter().for_each(|own| laws.hold("waveforms", own.word, own.parameters));
    laws.hold_all();
}

#[test]
fn every_shift_describes_law_units_ranges_limits_and_source() {
    let mut laws = Laws::default();
    SHIFTS.iter().for_each(|own| laws.hold("shifts", own.word, own.parameters));
    laws.hold_all();
}

#[test]
fn every_source_that_the_code_cites_is_in_the_list_of_references() {
    let list = text("docs/references.bib");
    let is_key = |word: &&str| {
        let is_plain = |own: char| own.is_ascii_lowercase() || own.is_ascii_digit() || own == '-';
        word.len() > 6
            && word.chars().all(is_plain)
            && word.starts_with(|own: char| own.is_ascii_lowercase())
            && word.ends_with(|own: char| own.is_ascii_digit())
    };
    let mut cited = 0;
    for file in super::sources("crates") {
        let source = text(&file);
        let lines: Vec<&str> = source.lines().map(str::trim_start).collect();
        let is_of_paragraph = |line: &&str| line.starts_with("//") && *line != "///";
        for paragraph in lines.split(|line| !is_of_paragraph(line)) {
            let paragraph = paragraph.join(" ");
            if paragraph.contains("`docs/references.bib`") {
                for key in paragraph.split('`').skip(1).step_by(2).filter(is_key) {
                    cited += 1;
                    let is_listed = list.contains(&format!("{{{key},"));
                    assert!(is_listed, "{} cites `{key}`", file.display());
                }
            }
        }
    }
    assert!(cited > 10, "{cited}");
}
