//! The numbers of a scene that a sweep may give other values.
//!
//! Every number in the text is one, by its path: `nodes.head.velocity`,
//! `models.valox-pad.burgers.maxwell.spring`. Any parts of the path that are not needed to tell it may be
//! left out, but for the last one. The numbers of a model also go by the elements that are made of it, as
//! `padding.maxwell.spring`; and a number that stands for a named value is that value.

use std::{collections::BTreeMap, ops::Range, sync::Arc};

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, parse_quantity, si_unit};
use thiserror::Error;

use super::variation::{Written, other_dimension};
use crate::{
    Variation,
    diagnostics::{Diagnostics, Faults},
    quantities::{
        arithmetic::quietly,
        bare::{BareNumber, BareNumbers},
        named::Values,
        scatter::Scatter,
        values::{Overrides, read as read_values},
    },
    text::{
        document::{Content, Item, parse_scattered, scattered::SECTIONS},
        nearest::{list, nearest, synonym},
        source::Source,
    },
};

/// The key under `[run]` that may vary.
const RUN: (&str, &str) = ("run", "duration");
/// A node has one of these.
const START: [&str; 3] = ["drop", "velocity", "energy"];

/// A number or a word in the text of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Tunable {
    /// Its path in full.
    pub path: String,
    /// The shortest end of the path that tells it from all others.
    pub name: String,
    /// Its value in SI units; that of a word is no number.
    pub value: f64,
    /// What it measures, where a unit is given.
    pub dimension: Option<Dimension>,
    /// Its unit as written, empty where there is none.
    pub unit: String,
    /// The word that stands in place of a number, such as that of a material.
    pub word: Option<String>,
    /// Mean and standard deviation as they are written, where it has scatter.
    pub(crate) scatter: Option<Scatter>,
    span: Range<usize>,
}

/// The numbers of a scene's text, and its words.
#[derive(Debug, Clone)]
pub struct Tunables {
    source: Arc<Source>,
    /// The text, parsed; numbers with scatter are their means.
    root: Arc<Item>,
    all: Vec<Tunable>,
    /// Every path, the alternative ones included, and the number or word that it leads to.
    paths: Vec<(Vec<String>, usize)>,
}

/// What stands in a text: numbers with their units, and words that may be names of values.
#[derive(Default)]
struct Found {
    numbers: Vec<(Vec<String>, Range<usize>, String, Quantity)>,
    words: Vec<(Vec<String>, Range<usize>, String)>,
    /// The values that numbers may be computed of.
    values: Values,
}

impl Tunables {
    /// The numbers of a scene's text; those of other files are not among them.
    ///
    /// # Errors
    ///
    /// What is wrong with the text as TOML.
    pub fn of(text: &str, file: Option<&str>) -> Result<Self, Diagnostics> {
        let faults = Faults::default();
        let source = Arc::new(Source::new(file.unwrap_or("scene"), text));
        let root = parse_scattered(&source, &faults);
        let Some((root, scattered)) = root.filter(|_| faults.errors() == 0) else {
            return Err(faults.finish());
        };
        let named = root.table().unwrap_or(&[]).iter().find(|entry| entry.key == "values");
        let unheard = Faults::default();
        let values = read_values(named.map(|entry| &entry.item), &Overrides::default(), &unheard);
        let mut found = Found { values, ..Found::default() };
        for entry in root.table().unwrap_or(&[]) {
            if SECTIONS.contains(&entry.key.as_str()) {
                collect(&entry.item, &mut vec![entry.key.to_string()], &mut found);
            } else if entry.key == RUN.0 {
                let own = entry.item.table().unwrap_or(&[]).iter().filter(|own| own.key == RUN.1);
                let path = || vec![RUN.0.to_owned(), RUN.1.to_owned()];
                own.for_each(|own| collect(&own.item, &mut path(), &mut found));
            }
        }
        let mut own = Self::with((source, Arc::new(root)), found);
        for (place, scatter) in scattered {
            let number = own.all.iter_mut().find(|number| number.span == place.span());
            number.into_iter().for_each(|number| number.scatter = Some(scatter.clone()));
        }
        Ok(own)
    }

    fn with((source, root): (Arc<Source>, Arc<Item>), found: Found) -> Self {
        let mut own = Self { source, root, all: Vec::new(), paths: Vec::new() };
        let add = |own: &mut Self, path: Vec<String>, span, (value, dimension), unit, word| {
            own.paths.push((path.clone(), own.all.len()));
            let (path, name, scatter) = (path.join("."), String::new(), None);
            own.all.push(Tunable { path, name, value, dimension, unit, word, scatter, span });
        };
        for (path, span, unit, mut quantity) in found.numbers {
            if is_acceleration(&path) {
                quantity = quantity.meant(Dimension::ACCELERATION);
            }
            add(&mut own, path, span, (quantity.value, quantity.dimension), unit, None);
        }
        // Where a word is the name of a value, it stands for its number.
        for (path, _, word) in &found.words {
            let value = ["values".to_owned(), word.clone()];
            let known = own.paths.iter().find(|known| known.0 == value).map(|known| known.1);
            own.paths.extend(known.map(|at| (path.clone(), at)));
        }
        // An element of a model has the numbers of the model.
        for (path, _, word) in &found.words {
            let [section, element, key] = path.as_slice() else { continue };
            let shared = if key == "material" { "materials" } else { "models" };
            if section != "elements" || !["model", "material"].contains(&key.as_str()) {
                continue;
            }
            let inner = own.paths.iter().filter_map(|(known, at)| {
                let [first, second, rest @ ..] = &known[..] else { return None };
                let is_meant = !rest.is_empty() && first == shared && second == word;
                is_meant.then(|| ([&[section.clone(), element.clone()][..], rest].concat(), *at))
            });
            let inner: Vec<(Vec<String>, usize)> = inner.collect();
            own.paths.extend(inner);
        }
        let is_ruled = |own: &&(Vec<String>, Range<usize>, String)| {
            !own.0.iter().any(|part| part == "between")
        };
        for (path, span, word) in found.words.iter().filter(is_ruled).cloned() {
            add(&mut own, path, span, (f64::NAN, None), String::new(), Some(word));
        }
        for at in 0..own.all.len() {
            own.all[at].name = own.shortest(at);
        }
        own
    }

    /// All numbers in the order of the text, and all words behind them.
    pub fn all(&self) -> &[Tunable] {
        &self.all
    }

    /// The position of the number of this name.
    ///
    /// # Errors
    ///
    /// Where none or several go by it.
    pub fn find(&self, name: &str) -> Result<usize, TunableFault> {
        self.find_one(name, false)
    }

    /// The position of the number or, where there is none, of the word of this name.
    ///
    /// # Errors
    ///
    /// Where none or several go by it.
    pub fn anything(&self, name: &str) -> Result<usize, TunableFault> {
        match self.find(name) {
            Err(TunableFault::IsWord { .. }) => self.find_one(name, true),
            // No number is like it; a word may be.
            Err(fault @ TunableFault::Unknown { near: None, .. }) => {
                match self.find_one(name, true) {
                    Err(of_words @ TunableFault::Unknown { near: Some(_), .. }) => Err(of_words),
                    _ => Err(fault),
                }
            }
            found => found,
        }
    }

    /// The position of the number, or of the word, of this name.
    fn find_one(&self, name: &str, is_word: bool) -> Result<usize, TunableFault> {
        let wanted: Vec<&str> = name.split('.').map(str::trim).collect();
        match self.led_to(&wanted, is_word)[..] {
            [only] => Ok(only),
            [] => {
                if let [other] = self.led_to(&wanted, !is_word)[..] {
                    let (name, own) = (name.to_owned(), &self.all[other]);
                    return Err(match own.word.clone() {
                        Some(word) => TunableFault::IsWord { name, word },
                        None => TunableFault::IsNumber { name, number: self.shown(other) },
                    });
                }
                let of_kind = |at: usize| self.all[at].word.is_some() == is_word;
                let own = (0..self.all.len()).filter(|at| of_kind(*at));
                let known: Vec<String> = own.map(|at| self.all[at].name.clone()).collect();
                let near = self.akin(&wanted).filter(|_| !is_word).or_else(|| {
                    let own = self.paths.iter().filter(|path| of_kind(path.1));
                    let paths = own.map(|path| path.0[1..].join("."));
                    let words: Vec<String> = known.iter().cloned().chain(paths).collect();
                    nearest(name, words.iter().map(String::as_str)).map(str::to_owned)
                });
                let is_owner = |part: &String| wanted.iter().rev().nth(1) == Some(&part.as_str());
                let has_owner = |own: &(Vec<String>, usize)| {
                    own.0.split_last().is_some_and(|own| own.1.iter().any(is_owner))
                };
                let is_left_out = near.is_none() && self.paths.iter().any(has_owner);
                let name = name.to_owned();
                Err(TunableFault::Unknown { name, is_word, near, known, is_left_out })
            }
            ref several => {
                let names = several.iter().map(|&at| format!("`{}`", self.all[at].name)).collect();
                Err(TunableFault::Ambiguous { name: name.to_owned(), names })
            }
        }
    }

    /// The name of the number that goes by another word for the end of a path, or has this end and
    /// belongs to another part of the scene.
    fn akin(&self, wanted: &[&str]) -> Option<String> {
        let (last, owner) = wanted.split_last()?;
        let starts = START.into_iter().filter(|own| own != last && START.contains(last));
        let others = [synonym(last).unwrap_or(last)];
        let only = starts.chain(others).find_map(|end| {
            let with_owner = [owner, &[end]].concat();
            let found = [self.led_to(&with_owner, false), self.led_to(&[end], false)];
            found.iter().find_map(|own| if let [only] = own[..] { Some(only) } else { None })
        });
        only.map(|at| self.all[at].name.clone())
    }

    /// The number that each variation is of; in accelerations `g` is standard gravity from then on.
    ///
    /// # Errors
    ///
    /// A name that leads to none or several, values of another dimension than the number in the text,
    /// bare ones where that has a unit other than that of SI or they are refused, and two variations of one number.
    pub fn matched(
        &self,
        variations: &mut [Variation],
        bare: BareNumbers,
    ) -> Result<Vec<usize>, TunableFault> {
        let mut found: Vec<usize> = Vec::with_capacity(variations.len());
        for place in 0..variations.len() {
            let at = self.find_one(&variations[place].name, variations[place].is_of_words())?;
            if let Some(wanted) = self.all[at].dimension {
                variations[place].settle(wanted);
            }
            let variation = &variations[place];
            if let (Some(given), Some(wanted)) = (variation.dimension, self.all[at].dimension)
                && given != wanted
            {
                let reason = other_dimension(&variation.text(0), given, wanted);
                return Err(TunableFault::OtherDimension { name: variation.name.clone(), reason });
            }
            let bare = || BareNumber::of(&variation.range_text(), self.written(at), bare);
            if let Some(bare) = variation.dimension.is_none().then(bare).flatten() {
                return Err(TunableFault::NoUnit(bare));
            }
            if let Some(before) = found.iter().position(|other| *other == at) {
                let (first, second) = (variations[before].name.clone(), variation.name.clone());
                return Err(TunableFault::Twice { first, second });
            }
            found.push(at);
        }
        Ok(found)
    }

    /// A number or a word as the scene has it, and its unit.
    pub(crate) fn written(&self, at: usize) -> (&str, &str) {
        let own = &self.all[at];
        (self.source.text[own.span.clone()].trim_matches(['"', '\'']), &own.unit)
    }

    /// The text.
    pub(super) fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// The same as a tree.
    pub(super) fn root(&self) -> &Item {
        &self.root
    }

    /// Where a number or a word begins in it.
    pub(super) fn start(&self, at: usize) -> u32 {
        u32::try_from(self.all[at].span.start).unwrap_or(u32::MAX)
    }

    /// The text of the scene with other values in the place of some numbers.
    pub fn text_with(&self, values: &[(usize, String)]) -> String {
        let mut values: Vec<(&Range<usize>, &str)> =
            values.iter().map(|(at, value)| (&self.all[*at].span, value.as_str())).collect();
        values.sort_by_key(|value| value.0.start);
        let whole = &self.source.text;
        let mut text = String::with_capacity(whole.len() + 16 * values.len());
        let mut from = 0;
        for (span, value) in values {
            text.push_str(&whole[from..span.start]);
            // Counts have to stand without quotes, quantities with their units within.
            let is_bare = value.parse::<f64>().is_ok_and(f64::is_finite);
            let quote = if is_bare { "" } else { "\"" };
            text.extend([quote, value, quote]);
            from = span.end;
        }
        text.push_str(&whole[from..]);
        text
    }

    /// A number or a word as the scene has it.
    pub fn shown(&self, at: usize) -> String {
        self.written(at).0.trim().to_owned()
    }

    /// The numbers that a path leads to, or the words, rising.
    fn led_to(&self, wanted: &[&str], is_word: bool) -> Vec<usize> {
        let of_kind = || self.paths.iter().filter(|own| self.all[own.1].word.is_some() == is_word);
        let whole = of_kind().filter(|path| path.0[1..] == *wanted || path.0 == *wanted);
        let mut found: Vec<usize> = whole.map(|whole| whole.1).collect();
        if found.is_empty() {
            found = of_kind().filter(|own| holds(&own.0, wanted)).map(|own| own.1).collect();
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The shortest name that leads to a number alone and says what it is of: parts of its path, or of
    /// that of an element, with the end.
    fn shortest(&self, at: usize) -> String {
        let own = self.paths.iter().filter(|path| path.1 == at);
        let mut names: BTreeMap<(usize, usize), String> = BTreeMap::new();
        for (order, (path, _)) in own.enumerate() {
            let last = path.len() - 1;
            // The end with one part before it; with the thing's name and one part besides; all of it.
            let mut picks: Vec<Vec<usize>> = (1..last).map(|first| vec![first, last]).collect();
            picks.extend((2..last).map(|second| vec![1, second, last]));
            picks.push((1..=last).collect());
            for pick in picks {
                let parts: Vec<&str> = pick.iter().map(|&part| path[part].as_str()).collect();
                if self.led_to(&parts, self.all[at].word.is_some()) == [at] {
                    names.entry((parts.len(), order)).or_insert_with(|| parts.join("."));
                    break;
                }
            }
        }
        names.into_values().next().unwrap_or_else(|| self.all[at].path.clone())
    }
}

/// Whether a path has these parts in this order, its end included.
fn holds(path: &[String], wanted: &[&str]) -> bool {
    let Some((last, inner)) = wanted.split_last() else { return false };
    let Some((end, mut rest)) = path.split_last() else { return false };
    if end != last {
        return false;
    }
    for part in inner {
        match rest.iter().position(|own| own == part) {
            Some(at) => rest = &rest[at + 1..],
            None => return false,
        }
    }
    true
}

/// Whether a number in a text can but be an acceleration, in which `g` is standard gravity.
fn is_acceleration(path: &[String]) -> bool {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    matches!(path[..], ["effects", "gravity", "value"] | ["nodes", _, "acceleration", ..])
}

/// Adds all that stands in an item. Members of a list go by their names, or by their numbers from 1.
fn collect(item: &Item, path: &mut Vec<String>, found: &mut Found) {
    match &item.value {
        Content::Number(digits) => {
            let number = parse_quantity(digits).ok();
            found
                .numbers
                .extend(number.map(|own| (path.clone(), item.place.span(), String::new(), own)));
        }
        Content::Text(text) => {
            let is_name = found.values.contains_key(text.trim());
            let word = || (path.clone(), item.place.span(), text.trim().to_owned());
            let Some(own) = quietly(text, &found.values).filter(|_| !is_name) else {
                return found.words.push(word());
            };
            let unit = match (parse_quantity(text), Written::of(text)) {
                (Ok(_), Ok(written)) => written.unit.to_owned(),
                _ => own.dimension.map_or(String::new(), si_unit),
            };
            found.numbers.push((path.clone(), item.place.span(), unit, own));
        }
        Content::Table(entries) => {
            for entry in entries {
                path.push(entry.key.to_string());
                collect(&entry.item, path, found);
                path.pop();
            }
        }
        Content::List(items) => {
            for (at, item) in items.iter().enumerate() {
                let entries = item.table().unwrap_or(&[]);
                let name = entries.iter().find(|entry| entry.key == "name");
                let name = name.and_then(|entry| entry.item.text());
                path.push(name.map_or_else(|| (at + 1).to_string(), str::to_owned));
                collect(item, path, found);
                path.pop();
            }
        }
        Content::Switch(_) | Content::Date => {}
    }
}

/// Why there is no such number.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum TunableFault {
    /// No number goes by this name.
    #[error("the scene has no {} `{name}`", if *.is_word { "word" } else { "number" })]
    Unknown {
        name: String,
        is_word: bool,
        near: Option<String>,
        known: Vec<String>,
        /// Whether the scene has what it would be of.
        is_left_out: bool,
    },
    /// Words for what is a number.
    #[error("`{name}` is a number, {number} in the scene, and its values are none")]
    IsNumber { name: String, number: String },
    /// Numbers for what is a word.
    #[error("`{name}` is a word, `{word}` in the scene, and its values are numbers")]
    IsWord { name: String, word: String },
    /// Several numbers do.
    #[error("`{name}` may be {}", .names.join(" or "))]
    Ambiguous { name: String, names: Vec<String> },
    /// Its values would measure something else.
    #[error("`{name}`: {reason}")]
    OtherDimension { name: String, reason: String },
    /// Bare values where the scene has a unit other than that of SI.
    #[error("{0}")]
    NoUnit(BareNumber),
    /// One number is varied twice.
    #[error("`{first}` and `{second}` are the same number of the scene")]
    Twice { first: String, second: String },
}

impl TunableFault {
    /// What to do.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown { name, near, known, is_word, is_left_out } => {
                let kind = if *is_word { "words" } else { "numbers" };
                let listed = format!("its {kind} are {}", list(known));
                let listed = match near {
                    Some(near) => format!("did you mean `{near}`? {listed}"),
                    None => listed,
                };
                let (owner, key) = name.rsplit_once('.').unwrap_or_default();
                Some(if *is_left_out {
                    format!(
                        "{listed}; only what stands in the scene is set: to give `{owner}` a `{key}`, write it there first"
                    )
                } else {
                    listed
                })
            }
            Self::Ambiguous { .. } => {
                Some("write so much of the path that it is the only one".to_owned())
            }
            Self::OtherDimension { .. } | Self::IsNumber { .. } | Self::IsWord { .. } => None,
            Self::NoUnit(bare) => Some(bare.help()),
            Self::Twice { .. } => Some("vary it once".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests;
