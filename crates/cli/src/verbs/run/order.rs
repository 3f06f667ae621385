//! What sets designs of one scene apart, and the order in which it puts them.

use dashpot_plot::figures::RunRank;
use dashpot_scene::{
    Scene, Tunables,
    units::{Dimension, parse_quantity},
};

use super::designs::Design;

/// So many designs of one value can be told apart by their patterns.
const MOST_GROUPS: usize = 4;

/// A number or a word of a scene with its value in a design.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Valued {
    pub(super) name: String,
    /// As it was set or stands in the scene; `None` where the scene has no such name.
    pub(super) value: Option<String>,
    /// The number in SI units, of what has scatter its mean, and what it measures.
    number: Option<(f64, Option<Dimension>)>,
}

impl Valued {
    /// The value of this name in a scene with these values set.
    pub(super) fn of(scene: &Scene, set: &[(String, String)], name: &str) -> Self {
        let own = set.iter().rev().find(|own| own.0 == name).map(|own| own.1.clone());
        let tunables = Tunables::of(&scene.text, scene.file.as_deref()).ok();
        let found = tunables.as_ref().and_then(|all| Some((all, all.anything(name).ok()?)));
        let path = found.map(|(all, at)| &all.all()[at].path);
        let scattered = scene.scatter.iter().find(|own| Some(&own.path) == path);
        let written = || {
            let plain = found.map(|(all, at)| all.shown(at));
            scattered.map(|own| own.text.clone()).or(plain)
        };
        let value = own.or_else(written);
        let read = || {
            let own = parse_quantity(value.as_deref()?).ok()?;
            Some((own.value, own.dimension))
        };
        let mean = scattered.map(|own| (own.mean, own.dimension));
        Self { name: name.to_owned(), number: mean.or_else(read), value }
    }

    /// `K=60 kN/m`.
    pub(super) fn text(&self) -> Option<String> {
        Some(format!("{}={}", self.name, self.value.as_ref()?))
    }
}

/// The places of designs in the rising order of the first number in which they differ, and which of them are alike in
/// all else; `None` where they differ in no number, or in too much else.
pub(super) fn ranks(designs: &[&Design]) -> Option<Vec<RunRank>> {
    let count = designs.first()?.values.len();
    let (at, numbers) = (0..count).find_map(|at| Some((at, numbers(designs, at)?)))?;
    let mut rising = numbers.clone();
    rising.sort_by(f64::total_cmp);
    rising.dedup();
    let rest = |own: &Design| {
        let values = own.values.iter().enumerate().filter(|own| own.0 != at);
        let values: Vec<Valued> = values.map(|own| own.1.clone()).collect();
        (own.answer.scene.file.clone(), values)
    };
    let mut groups: Vec<(Option<String>, Vec<Valued>)> = Vec::new();
    let mut ranks = Vec::new();
    for (design, number) in designs.iter().zip(numbers) {
        let rest = rest(design);
        let group = groups.iter().position(|known| *known == rest).unwrap_or_else(|| {
            groups.push(rest);
            groups.len() - 1
        });
        let place = rising.iter().filter(|own| **own < number).count();
        ranks.push(RunRank { place, group });
    }
    (groups.len() <= MOST_GROUPS).then_some(ranks)
}

/// The numbers of the values at this place, where all are of one dimension and not all the same.
fn numbers(designs: &[&Design], at: usize) -> Option<Vec<f64>> {
    let own = designs.iter().map(|own| own.values.get(at)?.number);
    let own = own.collect::<Option<Vec<_>>>()?;
    let is_alike = own.iter().all(|other| other.1 == own[0].1);
    let differ = own.iter().any(|other| other.0.total_cmp(&own[0].0).is_ne());
    (is_alike && differ).then(|| own.iter().map(|own| own.0).collect())
}
