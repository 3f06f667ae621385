//! The normal distribution of mean 0 and standard deviation 1.

use std::f64::consts::TAU;

/// Terms of the series are below rounding long before.
const MOST_TERMS: usize = 500;
/// Beyond this the distribution is 0 or 1 to double precision.
const FAR: f64 = 9.0;

/// The part of the distribution below `x`, from 0 to 1, with an absolute error of some 1e-16.
///
/// Source: G. Marsaglia, Journal of Statistical Software 11 (2004) 4, the series around 0.
pub fn distribution(x: f64) -> f64 {
    if x.abs() > FAR {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    let (mut term, mut sum) = (x, x);
    for odd in (3..MOST_TERMS).step_by(2) {
        term *= x * x / odd as f64;
        let before = sum;
        sum += term;
        if (sum - before).abs() <= 0.0 {
            break;
        }
    }
    0.5 + sum * (-0.5 * x * x).exp() / TAU.sqrt()
}

/// The value below which the part `share` of the distribution lies, with a relative error of some 1e-16;
/// infinite at 0 and 1, NaN outside.
///
/// Source: M. J. Wichura, algorithm AS 241 (PPND16), Applied Statistics 37 (1988) 477–484.
pub fn quantile(share: f64) -> f64 {
    let centred = share - 0.5;
    if centred.abs() <= 0.425 {
        let r = 0.180_625 - centred * centred;
        return centred * ratio(r, &MIDDLE);
    }
    let tail = if centred < 0.0 { share } else { 1.0 - share };
    if tail <= 0.0 {
        return if tail < 0.0 { f64::NAN } else { f64::INFINITY.copysign(centred) };
    }
    let r = (-tail.ln()).sqrt();
    let size = if r <= 5.0 { ratio(r - 1.6, &NEAR_TAIL) } else { ratio(r - 5.0, &FAR_TAIL) };
    size.copysign(centred)
}

/// Coefficients of two polynomials, the lowest power first.
type Ratio = [[f64; 8]; 2];

fn ratio(r: f64, coefficients: &Ratio) -> f64 {
    let [above, below] =
        coefficients.map(|all| all.iter().rev().fold(0.0, |sum, own| sum * r + own));
    above / below
}

const MIDDLE: Ratio = [
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
];

const NEAR_TAIL: Ratio = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];

const FAR_TAIL: Ratio = [
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        0.001_242_660_947_388_078_4,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun, table 26.1 and 26.5, and 25 digits by series.
        for (share, right) in [
            (0.5, 0.0),
            (0.841_344_746_068_542_9, 1.0),
            (0.975, 1.959_963_984_540_054),
            (0.995, 2.575_829_303_548_901),
            (0.001, -3.090_232_306_167_813_5),
            (1e-9, -5.997_807_015_007_687),
        ] {
            let own = quantile(share);
            assert!((own - right).abs() <= 2e-15 * f64::max(1.0, right.abs()), "{share}: {own}");
        }
        let ends = [quantile(0.0), -quantile(1.0)];
        assert!(ends.iter().all(|own| own.is_infinite() && *own < 0.0));
        assert!(quantile(1.1).is_nan());
    }

    #[test]
    fn each_is_the_inverse_of_the_other() {
        for at in 1..400 {
            let share = f64::from(at) / 400.0;
            assert!((distribution(quantile(share)) - share).abs() < 4e-16, "{share}");
        }
        for at in -80..=80 {
            let x = f64::from(at) / 10.0;
            assert!((distribution(x) + distribution(-x) - 1.0).abs() < 3e-16, "{x}");
        }
        assert!((distribution(1.0) - 0.841_344_746_068_542_9).abs() < 2e-16);
        assert_eq!(
            [distribution(-40.0), distribution(40.0)].map(f64::to_bits),
            [0, 1.0_f64.to_bits()]
        );
    }
}
