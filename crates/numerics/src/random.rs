//! Numbers that look random and are the same everywhere.

/// A stream of numbers that its seed determines: `SplitMix64` (Steele, Lea and Flood, 2014).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stream(u64);

impl Stream {
    /// The stream of a seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to less than 1.
    pub fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 2.0_f64.powi(53)
    }

    /// A number between two positive ones, evenly in its logarithm.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.share())
    }

    /// One of the numbers below `count`, which is at least 1.
    pub fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % count as u64).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of the seed 1234567 in the tests of other implementations of the method.
    #[test]
    fn numbers_are_those_of_the_method() {
        let mut stream = Stream::new(1_234_567);
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!([(); 5].map(|()| stream.bits()), expected);
    }

    #[test]
    fn shares_have_the_mean_and_the_spread_of_even_ones() {
        let mut stream = Stream::new(1);
        let shares: Vec<f64> = (0..10_000).map(|_| stream.share()).collect();
        let mean = shares.iter().sum::<f64>() / 1e4;
        let spread = shares.iter().map(|own| (own - mean).powi(2)).sum::<f64>() / 1e4;
        // Four standard errors: 1/√(12 n) of the mean, 1/√(180 n) of the variance.
        assert!((mean - 0.5).abs() < 4.0 / (12e4_f64).sqrt(), "{mean}");
        assert!((spread - 1.0 / 12.0).abs() < 4.0 / (180e4_f64).sqrt(), "{spread}");
        assert!((0..100).all(|_| (2.0..8.0).contains(&stream.between(2.0, 8.0))));
        assert!((0..100).all(|_| stream.below(3) < 3));
    }
}
