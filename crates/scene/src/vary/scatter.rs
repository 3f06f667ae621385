//! Numbers with scatter, and designs drawn from them.

use dashpot_numerics::normal::{distribution, quantile};
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

use super::{
    sample::stratified,
    scattered::{ScatteredNumber, in_causes, is_possible, scattered, shares},
    together::{Cause, causes},
    tunable::{Tunable, Tunables},
    variation::{Written, handy, number_text},
};
use crate::{Posed, ReadOptions, diagnostics::Diagnostics, quantities::scatter::Scatter};

/// What was drawn for a number with scatter.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The number.
    pub number: ScatteredNumber,
    /// Between which values in SI units the distribution is cut off, because the scene allows no others while
    /// all else has its mean; `None` where it is not.
    pub cut: [Option<f64>; 2],
    /// The part of the normal distribution that is cut off.
    pub beyond: f64,
    at: usize,
    unit: String,
    values: Vec<f64>,
    /// Which random numbers it was drawn with; those of causes have streams of their own.
    stream: u64,
}

/// Designs drawn from the scatter of a scene.
#[derive(Debug, Clone)]
pub struct Sample {
    tunables: Tunables,
    drawn: Vec<Drawn>,
    /// The causes of what scatters together: the paths of their numbers, and which random numbers they were drawn with.
    causes: Vec<(Vec<String>, u64)>,
    count: usize,
}

/// What another value of a number does to a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The scene cannot be read with it.
    Refused,
    /// Nothing: the number is of no use there.
    Nothing,
    /// It may have other results.
    Some,
}

/// The bounds of what is allowed are sought to this part of the standard deviation.
const FINEST: f64 = 1e-6;
/// Halvings until then, from as far as any value is drawn.
const HALVINGS: usize = 30;
/// Streams of random numbers from here on are those of causes.
const OF_CAUSES: u64 = 1 << 32;
/// No value is drawn nearer to the ends of its distribution than this part of it.
const OUTERMOST: f64 = 1e-12;

impl Sample {
    /// `count` designs of a Latin hypercube of the numbers with scatter in a scene's text: each distribution is
    /// cut into `count` parts of equal probability, one value lies at a random place in each, and their order is
    /// random, independently for each number. The values of a number depend on `seed`, on `count`, on its
    /// position among those with scatter, and on nothing else; what another scene of the same design has drawn as
    /// well, by the same path, is drawn as there. Numbers that scatter together are `x exp(Σ sᵢ zᵢ)` with
    /// their shares `sᵢ` of independent causes, `zᵢ` from such a hypercube of normal distributions; a cause is that of
    /// the other scene in the same place if they have a number in common. `change` tells what another value of one of
    /// them, in its text, is to the scene. A number that changes nothing is not drawn, and does not count; where the outermost
    /// values are refused, the distribution is cut off at the first of them. `None` where no number has scatter.
    ///
    /// Source: M. D. `McKay`, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239–245.
    ///
    /// # Errors
    ///
    /// What is wrong with the text as TOML.
    pub fn of(
        text: &str,
        count: usize,
        seed: u64,
        change: &dyn Fn(&Tunables, (usize, String)) -> Change,
        beside: Option<&Self>,
    ) -> Result<Option<Self>, Diagnostics> {
        if !is_possible(text) {
            return Ok(None);
        }
        let tunables = Tunables::of(text, None)?;
        let changed =
            |at: usize, value: f64, unit: &str| change(&tunables, (at, number_text(value, unit)));
        let is_used = |at: usize, sides: [f64; 2], unit: &str| {
            let mut read = sides.into_iter().map(|value| changed(at, value, unit));
            read.find(|own| *own != Change::Refused) != Some(Change::Nothing)
        };
        let is_scattered = |(at, _, scatter): &(usize, &Tunable, &Scatter)| {
            let sides = [1.0, -1.0].map(|side| scatter.mean + side * scatter.deviation);
            is_used(*at, sides, &scatter.unit)
        };
        // Behind those of the other scene, which have their own.
        let known = beside.map_or(&[][..], Self::drawn);
        let mut next = known.iter().filter(|own| !own.number.is_together).count() as u64;
        let mut stream_of = |path: &str| {
            let known = known.iter().find(|own| own.number.path == path).map(|own| own.stream);
            known.unwrap_or_else(|| {
                next += 1;
                next - 1
            })
        };
        let mut all: Vec<Drawn> = scattered(&tunables)
            .filter(is_scattered)
            .map(|(at, own, scatter)| {
                let stream = stream_of(&own.path);
                let number = ScatteredNumber::of(own, scatter);
                let reads = |value: f64| changed(at, value, &scatter.unit) != Change::Refused;
                drawn((at, number), scatter, (stream, &places(seed, stream, count)), &reads)
            })
            .collect();
        let causes = causes(text, &tunables);
        let streams = streams(&causes, &tunables, beside.map_or(&[], |own| &own.causes));
        let z = |(_, stream): &(Vec<String>, u64)| -> Vec<f64> {
            let places = places(seed, *stream, count).into_iter();
            places.map(|own| quantile(own.clamp(OUTERMOST, 1.0 - OUTERMOST))).collect()
        };
        let z: Vec<Vec<f64>> = streams.iter().map(z).collect();
        for at in in_causes(&causes) {
            let number = ScatteredNumber::of_causes(&tunables, at, &causes);
            let (written, unit) = tunables.written(at);
            let mean = Written::split(written).number;
            let part = number.deviation / number.mean.abs();
            if !is_used(at, [part, -part].map(|own| mean * own.exp()), unit) {
                continue;
            }
            let sum = |design: usize| -> f64 {
                shares(&causes, at).zip(&z).map(|(share, z)| share * z[design]).sum()
            };
            let values = (0..count).map(|design| handy(mean * sum(design).exp())).collect();
            let (unit, cut) = (unit.to_owned(), [None, None]);
            all.push(Drawn { number, cut, beyond: 0.0, at, unit, values, stream: OF_CAUSES });
        }
        Ok((!all.is_empty()).then_some(Self { tunables, drawn: all, causes: streams, count }))
    }

    /// How many designs there are.
    #[expect(clippy::len_without_is_empty, reason = "there is one at least")]
    pub fn len(&self) -> usize {
        self.count
    }

    /// What was drawn for each number.
    pub fn drawn(&self) -> &[Drawn] {
        &self.drawn
    }

    /// What a run of the scene needs in a design, counted from 0.
    ///
    /// # Errors
    ///
    /// What is wrong with the scene there.
    pub fn posed(&self, design: usize, options: &ReadOptions<'_>) -> Result<Posed, Diagnostics> {
        let value = |own: &Drawn| (own.at, number_text(own.values[design], &own.unit));
        self.tunables.posed(&self.drawn.iter().map(value).collect::<Vec<_>>(), options)
    }
}

/// The paths of the numbers of each cause, and which random numbers it is drawn with: those of the cause of another
/// scene in the same place, if they have a number in common.
fn streams(
    causes: &[Cause],
    tunables: &Tunables,
    known: &[(Vec<String>, u64)],
) -> Vec<(Vec<String>, u64)> {
    let mut next = OF_CAUSES + known.len() as u64;
    let each = causes.iter().enumerate().map(|(at, cause)| {
        let paths: Vec<String> =
            cause.shares.iter().map(|own| tunables.all()[own.0].path.clone()).collect();
        let same = known.get(at).filter(|own| own.0.iter().any(|path| paths.contains(path)));
        let stream = same.map_or(next, |own| own.1);
        next += u64::from(same.is_none());
        (paths, stream)
    });
    each.collect()
}

/// Places in a distribution, from 0 to 1, one in each of so many parts of it.
fn places(seed: u64, stream: u64, count: usize) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    stratified(&mut random, count)
}

/// The values of a number at these places of its distribution, from 0 to 1.
fn drawn(
    (at, number): (usize, ScatteredNumber),
    scatter: &Scatter,
    (stream, places): (u64, &[f64]),
    reads: &dyn Fn(f64) -> bool,
) -> Drawn {
    let &Scatter { mean, deviation, .. } = scatter;
    let values = |[low, high]: [f64; 2]| -> Vec<f64> {
        let value = |place: &f64| {
            let share = (low + (high - low) * place).clamp(OUTERMOST, 1.0 - OUTERMOST);
            handy(mean + deviation * quantile(share))
        };
        places.iter().map(value).collect()
    };
    let whole = values([0.0, 1.0]);
    let ends = [f64::min, f64::max].map(|pick| whole.iter().copied().reduce(pick).unwrap_or(mean));
    let cut = ends.map(|end| (!reads(end)).then(|| bound(mean, end, deviation, reads)));
    let share = |cut: Option<f64>, none: f64| {
        cut.map_or(none, |own| distribution((own - mean) / deviation))
    };
    let [low, high] = [share(cut[0], 0.0), share(cut[1], 1.0)];
    let values = if cut == [None, None] { whole } else { values([low, high]) };
    let per_unit = number.deviation / deviation;
    Drawn {
        cut: cut.map(|own| own.map(|own| number.mean + (own - mean) * per_unit)),
        beyond: low + (1.0 - high),
        number,
        at,
        unit: scatter.unit.clone(),
        values,
        stream,
    }
}

/// Where what is read ends, between a value that is and one that is not; zero, where that is in between.
fn bound(read: f64, refused: f64, deviation: f64, reads: &dyn Fn(f64) -> bool) -> f64 {
    let (mut inner, mut outer) = (read, refused);
    for _ in 0..HALVINGS {
        if (outer - inner).abs() <= FINEST * deviation {
            break;
        }
        let middle = 0.5 * (inner + outer);
        if reads(middle) { inner = middle } else { outer = middle }
    }
    let is_between = |own: f64| (own - inner) * (own - outer) <= 0.0;
    let short = |digits: usize| format!("{inner:.digits$e}").parse::<f64>();
    let round = (0..6).filter_map(|digits| short(digits).ok());
    [0.0].into_iter().chain(round).find(|own| is_between(*own)).unwrap_or(inner)
}

#[cfg(test)]
mod tests {
    use dashpot_units::parse_quantity;

    use super::{super::together, *};
    use crate::{diagnostics::Faults, text::source::Source};

    const TEXT: &str =
        "[values]\nK = \"20 ± 2 MN/m\"\n[nodes]\nhead = { mass = \"5 kg ± 10 %\" }\n";

    fn sample(text: &str, count: usize, accepts: &dyn Fn(&str) -> bool) -> Sample {
        let change = |tunables: &Tunables, value: (usize, String)| {
            if accepts(&tunables.text_with(&[value])) { Change::Some } else { Change::Refused }
        };
        Sample::of(text, count, 1, &change, None).unwrap().unwrap()
    }

    #[test]
    fn values_are_quantiles_of_their_distributions_one_in_each_part() {
        let count = 400;
        let own = sample(TEXT, count, &|_| true);
        for drawn in own.drawn() {
            let mut shares: Vec<f64> = (0..count)
                .map(|at| {
                    let unit = drawn.number.mean / if drawn.at == 0 { 20.0 } else { 5.0 };
                    let value = drawn.values[at] * unit;
                    distribution((value - drawn.number.mean) / drawn.number.deviation)
                })
                .collect();
            assert!(shares.windows(2).any(|pair| pair[0] > pair[1]), "in random order");
            shares.sort_by(f64::total_cmp);
            for (part, share) in shares.iter().enumerate() {
                let within = share * count as f64 - part as f64;
                assert!((-1e-9..=1.0 + 1e-9).contains(&within), "{part}: {within}");
            }
            assert_eq!((drawn.cut, drawn.beyond), ([None, None], 0.0));
        }
        assert_eq!(own.drawn()[1].number.text, "5 ± 0.5 kg");
        assert!((own.drawn()[1].number.deviation - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_cause_is_that_of_the_other_scene_where_both_have_a_number_in_common() {
        let text = |name: &str| {
            format!(
                "[values]\nK = \"20 MN/m\"\nC = \"20 N s/m\"\n[scatter]\ntogether = [{{ {name} = \"10 %\" }}]\n"
            )
        };
        let of = |name: &str, beside: Option<&Sample>| {
            Sample::of(&text(name), 50, 1, &|_, _| Change::Some, beside).unwrap().unwrap()
        };
        let values = |own: &Sample| -> Vec<String> {
            own.drawn()[0].values.iter().map(f64::to_string).collect()
        };
        let first = of("\"values.K\"", None);
        assert_eq!(values(&of("\"values.K\"", Some(&first))), values(&first));
        // By itself any first cause is drawn alike; beside another one it is independent of that.
        assert_eq!(values(&of("\"values.C\"", None)), values(&first));
        assert_ne!(values(&of("\"values.C\"", Some(&first))), values(&first));
    }

    #[test]
    fn a_distribution_is_cut_off_where_the_scene_refuses_it() {
        let text = "[nodes]\nhead = { mass = \"5 ± 4 kg\" }\n";
        let mass = |text: &str| {
            let number = text.split('"').nth(1).unwrap();
            parse_quantity(number).unwrap().value
        };
        let own = sample(text, 1000, &|text| mass(text) >= 0.0 && mass(text) < 10.125);
        let drawn = &own.drawn()[0];
        assert_eq!(drawn.cut[0], Some(0.0));
        assert!((drawn.cut[1].unwrap() - 10.125).abs() < 4e-6, "{:?}", drawn.cut);
        let [low, high] = [-1.25, 5.125 / 4.0].map(distribution);
        assert!((drawn.beyond - (low + 1.0 - high)).abs() < 1e-6);
        let values = &drawn.values;
        assert!(values.iter().all(|own| (0.0..10.126).contains(own)));
        // The median of what is left.
        let below = values.iter().filter(|own| **own < 5.0 + 4.0 * quantile(0.5 * (low + high)));
        assert_eq!(below.count(), 500);
    }

    #[test]
    fn a_number_that_changes_nothing_is_not_drawn_and_moves_no_other() {
        let with = TEXT.replace("K =", "L = \"3 ± 1 mm\"\nK =");
        let is_other = |_: &Tunables, (at, _): (usize, String)| {
            if at == 0 { Change::Nothing } else { Change::Some }
        };
        let values =
            |own: &Sample| own.drawn().iter().map(|own| own.values.clone()).collect::<Vec<_>>();
        let own = Sample::of(&with, 20, 1, &is_other, None).unwrap().unwrap();
        assert_eq!(values(&own), values(&sample(TEXT, 20, &|_| true)));
        assert!(Sample::of(TEXT, 20, 1, &|_, _| Change::Nothing, None).unwrap().is_none());
    }

    #[test]
    fn a_seed_repeats_and_a_scene_without_scatter_has_no_sample() {
        let values = |seed: u64| {
            let own = Sample::of(TEXT, 20, seed, &|_, _| Change::Some, None).unwrap().unwrap();
            own.drawn.into_iter().map(|own| own.values).collect::<Vec<_>>()
        };
        assert_eq!(values(1), values(1));
        assert_ne!(values(1), values(2));
        for text in ["[values]\nK = \"20 MN/m\"\n", "[values]\nK = \"20 ± 0 MN/m\"\n"] {
            assert!(Sample::of(text, 20, 1, &|_, _| Change::Some, None).unwrap().is_none());
        }
    }

    /// Two factors that have a product with far less scatter than each of them, and one that moves alone.
    const TOGETHER: &str = "[values]\nA = \"20 MN/m\"\nB = 3.0\n[nodes]\nhead = { mass = \"5 kg\" }\n\
        [scatter]\ntogether = [{ A = \"30 %\", B = \"-30 %\" }, { A = 0.005, B = 0.005 }, { head.mass = 0.1 }]\n";

    #[test]
    fn what_scatters_together_has_the_spread_of_its_causes_and_of_what_is_made_of_it() {
        let count = 4000;
        let own = sample(TOGETHER, count, &|_| true);
        let logs =
            |at: usize| -> Vec<f64> { own.drawn[at].values.iter().map(|own| own.ln()).collect() };
        let deviation = |all: &[f64]| {
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            (all.iter().map(|own| (own - mean).powi(2)).sum::<f64>() / all.len() as f64).sqrt()
        };
        let (a, b, mass) = (logs(0), logs(1), logs(2));
        let product: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + b).collect();
        for (all, known) in [(&a, 0.3_f64.hypot(0.005)), (&product, 0.01), (&mass, 0.1)] {
            // A hypercube with so many parts has the deviation of the distribution to 1/√count at the worst.
            assert!((deviation(all) / known - 1.0).abs() < 0.02, "{} {known}", deviation(all));
        }
        let numbers = ScatteredNumber::all(TOGETHER, None).unwrap();
        assert_eq!(numbers.len(), 3);
        assert!(numbers.iter().all(|own| own.is_together));
        assert!((numbers[2].deviation - 0.5).abs() < 1e-12 && numbers[2].text == "5 kg ± 10 %");
    }

    #[test]
    fn a_number_of_two_scenes_is_drawn_as_in_the_first() {
        let first = sample(TEXT, 20, &|_| true);
        let other = "[values]\nL = \"3 ± 1 mm\"\nK = \"20 ± 2 MN/m\"\n";
        let own = Sample::of(other, 20, 1, &|_, _| Change::Some, Some(&first)).unwrap().unwrap();
        assert_eq!(own.drawn[1].values, first.drawn[0].values);
        assert!(own.drawn[0].stream == 2 && own.drawn[0].values != first.drawn[0].values);
    }

    #[test]
    fn a_section_that_says_nothing_of_a_number_is_refused() {
        for (line, told) in [
            ("together = [{ C = 0.1 }]", "no number `C`"),
            ("together = [{ A = \"3 kN\" }]", "part of itself"),
            ("together = [{ A = 3 }]", "part of itself"),
            ("together = { A = 0.1 }", "a list of tables"),
            ("apart = []", "apart"),
            ("together = [{ A = 0.1, values.A = 0.2 }]", "twice"),
        ] {
            let text = format!("[values]\nA = \"20 MN/m\"\n[scatter]\n{line}\n");
            let faults = Faults::default();
            together::check(&Source::new("a.toml", text.as_str()).into(), &faults);
            let found = faults.finish().render(false);
            assert!(found.contains(told) && found.contains("a.toml:4"), "{line}: {found}");
        }
    }
}
