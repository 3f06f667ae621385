//! Scenes that are the same, and how far their solutions are apart.

use std::fmt;

use dashpot::analysis::RunReport;
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::{Config, RngSeed, TestRunner},
};

use crate::properties::{
    networks::{Kinds, Sketch, Units, Way, sketch},
    solved::{apart, by_auto, scene},
};

/// How many times the sum of their bars two solutions are apart in no pair.
const FAR: f64 = 3.0;

/// One way to write a scene otherwise.
struct Otherwise {
    name: &'static str,
    /// How the scene is written that is compared with.
    as_it_is: Way,
    way: Way,
    units: Units,
}

const SI: Units = Units { mass: 1.0, length: 1.0, time: 1.0 };

/// All ways for the scene of this number.
fn ways(at: usize) -> Vec<Otherwise> {
    let way = Way::default();
    let late = 10_f64.powi(i32::try_from(at % 10).unwrap());
    let from_rest = Way { late: Some(0.0), ..way };
    let otherwise = |name, way| Otherwise { name, as_it_is: Way::default(), way, units: SI };
    let scaled = |name, units| Otherwise { units, ..otherwise(name, way) };
    vec![
        scaled("in nm, ng and ns", Units { mass: 1e12, length: 1e9, time: 1e9 }),
        scaled("in km, Gg and Ms", Units { mass: 1e-6, length: 1e-3, time: 1e-6 }),
        otherwise("with units", Way { in_units: true, ..way }),
        otherwise("at references a millionth as large", Way { referred: -20, ..way }),
        otherwise("at references a million times as large", Way { referred: 20, ..way }),
        otherwise("backwards", Way { backwards: true, ..way }),
        otherwise("composed otherwise", Way { nested: 1 + at % 6, ..way }),
        otherwise("mirrored", Way { mirrored: true, ..way }),
        Otherwise {
            name: "later",
            as_it_is: from_rest,
            way: Way { late: Some(late), ..from_rest },
            units: SI,
        },
    ]
}

/// What many pairs tell.
#[derive(Default)]
pub(super) struct Tally {
    /// Scenes that have an answer.
    solved: usize,
    /// Pairs of values that were compared.
    pub(super) compared: usize,
    /// Those that are further apart than the sum of their bars.
    pub(super) outside: Vec<String>,
    /// Those that are much further apart.
    pub(super) far: Vec<String>,
    /// Pairs of which one has no answer within the steps that it is given.
    single: usize,
}

impl Tally {
    /// That of so many scenes, beginning with the one of this number.
    pub(super) fn of(first: usize, scenes: usize) -> Self {
        let seed = RngSeed::Fixed(0x0da5_4907);
        let mut runner = TestRunner::new(Config { rng_seed: seed, ..Config::default() });
        let kinds = [Kinds::Linear, Kinds::Switching, Kinds::All];
        let strategies = kinds.map(|kinds| sketch(kinds).boxed());
        let mut tally = Self::default();
        let mut at = 0;
        while tally.solved < scenes {
            let drawn = strategies[at % strategies.len()].new_tree(&mut runner).unwrap().current();
            if at >= first {
                tally.add(at, &drawn);
            }
            at += 1;
        }
        tally
    }

    fn add(&mut self, at: usize, drawn: &Sketch) {
        let mut is_solved = false;
        let mut first: Option<(Way, Option<RunReport>)> = None;
        for Otherwise { name, as_it_is, way, units } in ways(at) {
            if first.as_ref().is_none_or(|first| first.0 != as_it_is) {
                first = Some((as_it_is, report(drawn, as_it_is)));
            }
            let Some((_, one)) = &first else { continue };
            let scaled = Sketch { units: drawn.units.times(units), ..drawn.clone() };
            let other = report(&scaled, way);
            is_solved |= one.is_some();
            let what = || format!("scene {at} {name}");
            match (one, other) {
                (Some(one), Some(other)) => {
                    // What a load stores at once is there at the start if it is there from the start on, and
                    // taken up if it comes later.
                    let begins_loaded = as_it_is.late.is_some() && one.energy.start > 0.0;
                    let is_energy = |key: &str| key.contains(".energy");
                    for (key, bars) in apart(one, &other, |unit| units.factor(unit)) {
                        if begins_loaded && is_energy(&key) {
                            continue;
                        }
                        self.compared += 1;
                        let text = || format!("{}, {key}: {bars:.2} bars", what());
                        if bars > 1.0 || bars.is_nan() {
                            self.outside.push(text());
                        }
                        if bars > FAR || bars.is_nan() {
                            let texts = [drawn.text(as_it_is), scaled.text(way)];
                            self.far.push(format!("{}\n{}\n{}", text(), texts[0], texts[1]));
                        }
                    }
                }
                (None, None) => {}
                _ => self.single += 1,
            }
        }
        self.solved += usize::from(is_solved);
    }
}

/// The answer to a sketch written so, if there is one.
fn report(sketch: &Sketch, way: Way) -> Option<RunReport> {
    by_auto(&scene(&sketch.text(way))?).ok()
}

impl fmt::Display for Tally {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { solved, compared, outside, far, single } = self;
        writeln!(formatter, "{solved} scenes, {compared} values compared, {single} pairs of one")?;
        writeln!(formatter, "{} beyond the sum of their bars:", outside.len())?;
        outside.iter().try_for_each(|own| writeln!(formatter, "  {own}"))?;
        writeln!(formatter, "{} beyond {FAR} times it:", far.len())?;
        far.iter().try_for_each(|own| writeln!(formatter, "{own}"))
    }
}
