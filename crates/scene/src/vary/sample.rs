//! Designs sampled from ranges: the Latin hypercube.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

use super::variation::{Variation, handy};

impl Variation {
    /// `count` designs of a Latin hypercube: the values of these parameters that go together stand at one
    /// position of each.
    ///
    /// The range of each parameter is cut into `count` parts of equal length (`log`: of equal ratio), one
    /// value lies at a random place in each, and their order is random, independently for each parameter. Of a
    /// list, of a range with a given count and of words each value is taken equally often, to one. A parameter's
    /// values depend on `seed`, on `count` and on its position in the list, and on nothing else: the generator,
    /// `ChaCha8`, gives the same numbers on every machine. `count` is at least 1.
    ///
    /// Source: M. D. `McKay`, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239–245.
    #[must_use]
    pub fn sampled(all: &[Self], count: usize, seed: u64) -> Vec<Self> {
        let own = all.iter().zip(0..);
        own.map(|(own, stream)| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(stream);
            own.taken(&stratified(&mut random, count))
        })
        .collect()
    }

    /// The parameter with its values at these places of its range, from 0 to less than 1.
    fn taken(&self, places: &[f64]) -> Self {
        let count = self.len();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place is from 0 to less than 1"
        )]
        let position = |place: &f64| ((place * count as f64) as usize).min(count - 1);
        let (low, high) = (self.numbers[0], self.numbers[count - 1]);
        let number = |place: &f64| match (self.is_range, self.is_logarithmic) {
            (true, true) => handy(low * (high / low).powf(*place)),
            (true, false) => handy(low + (high - low) * place),
            (false, _) => self.numbers[position(place)],
        };
        let words = places.iter().filter_map(|own| self.words.get(position(own)).cloned());
        let mut own = Self {
            numbers: places.iter().map(number).collect(),
            words: words.collect(),
            ..self.clone()
        };
        own.values.clone_from(&own.numbers);
        own.revalue(|quantity| quantity);
        own
    }
}

/// One place in each of `count` equal parts of the range from 0 to 1, in random order.
pub(super) fn stratified(random: &mut ChaCha8Rng, count: usize) -> Vec<f64> {
    // 53 bits: all that a number from 0 to 1 holds.
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut places: Vec<f64> =
        (0..count).map(|part| (part as f64 + unit()) / count as f64).collect();
    for last in (1..count).rev() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of what is there"
        )]
        let other = (unit() * (last + 1) as f64) as usize;
        places.swap(last, other.min(last));
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Variation {
        Variation::parse(text).unwrap()
    }

    #[test]
    fn every_part_of_a_range_has_one_value() {
        let all = [parsed("K=5..30 MN/m"), parsed("v=1..100 m/s,log"), parsed("h=8,12 mm")];
        let count = 200;
        let [stiffness, speed, height] = &Variation::sampled(&all, count, 7)[..] else {
            panic!("three parameters")
        };
        let parts: Vec<f64> =
            stiffness.numbers.iter().map(|own| ((own - 5.0) / 25.0 * 200.0).floor()).collect();
        assert!(parts.windows(2).any(|pair| pair[0] > pair[1]), "in random order");
        let of_speed =
            speed.numbers.iter().map(|own| (own.ln() / 100_f64.ln() * 200.0).floor()).collect();
        for mut parts in [parts, of_speed] {
            parts.sort_by(f64::total_cmp);
            assert!(parts.iter().zip(0..count).all(|(part, at)| (part - at as f64).abs() < 0.5));
        }
        assert_eq!(height.values.iter().filter(|own| **own < 0.01).count(), 100);
        assert!(
            stiffness
                .values
                .iter()
                .zip(&stiffness.numbers)
                .all(|(si, own)| { (si / own / 1e6 - 1.0).abs() < 1e-15 })
        );
        // Independent: a correlation of n independent pairs is some 1/√n.
        let mean = |own: &[f64]| own.iter().sum::<f64>() / own.len() as f64;
        let (a, b) = (&stiffness.values, &speed.values);
        let (of_a, of_b) = (mean(a), mean(b));
        let product = |a: &[f64], b: &[f64], of: (f64, f64)| -> f64 {
            a.iter().zip(b).map(|(a, b)| (a - of.0) * (b - of.1)).sum()
        };
        let own = product(a, b, (of_a, of_b))
            / (product(a, a, (of_a, of_a)) * product(b, b, (of_b, of_b))).sqrt();
        assert!(own.abs() < 4.0 / (count as f64).sqrt(), "{own}");
    }

    #[test]
    fn a_seed_repeats_and_a_further_parameter_changes_no_other() {
        let all = [parsed("K=5..30 MN/m"), parsed("m=eps,epp,vn")];
        let one = Variation::sampled(&all, 30, 1);
        assert_eq!(one, Variation::sampled(&all, 30, 1));
        assert_eq!(one[0], Variation::sampled(&all[..1], 30, 1)[0]);
        assert_ne!(one[0], Variation::sampled(&all, 30, 2)[0]);
        for word in ["eps", "epp", "vn"] {
            assert_eq!(one[1].words.iter().filter(|own| *own == word).count(), 10);
        }
    }
}
