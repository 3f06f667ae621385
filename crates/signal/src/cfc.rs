//! Channel frequency classes of SAE J211-1 and ISO 6487.

use std::f64::consts::{PI, SQRT_2};

use thiserror::Error;

/// The design frequency in parts of the class: where the gain is one half.
const DESIGN: f64 = 2.0775;
/// After so many periods of the design frequency the answer to an impulse has died out to 10⁻¹².
const MEMORY: f64 = 7.0;
/// Samples that it remembers at most.
const MOST_REMEMBERED: f64 = 1e7;

/// A channel frequency class: a two-pole Butterworth filter that runs forward and backward, so that it has four poles
/// and no phase. Its `ω_d = 2π · 2.0775 · CFC`, warped for the sampling interval `T` as `ω_a = tan(ω_d T/2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cfc {
    class: f64,
}

/// What stands before the first sample and behind the last, as far as the filter is concerned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Padding {
    /// The record turned about its end point, `2 x₀ − x₍₋ₖ₎`: keeps value and slope.
    #[default]
    Odd,
    /// The record mirrored at its end: keeps the value.
    Even,
    /// The value of the end.
    Hold,
    /// Nothing: each pass begins in the steady state of its first value.
    None,
    /// Zero.
    Zero,
}

impl Padding {
    /// Every mode, the first by default.
    pub const ALL: [Self; 5] = [Self::Odd, Self::Even, Self::Hold, Self::None, Self::Zero];

    /// Its word, and what it is.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Odd => ["odd", "the record turned about its end point: value and slope go on"],
            Self::Even => ["even", "the record mirrored at its end"],
            Self::Hold => ["hold", "the value of the end"],
            Self::None => {
                ["none", "nothing: each pass begins in the steady state of its first value"]
            }
            Self::Zero => ["zero", "zero, as if the record were part of a longer one at rest"],
        }
    }
}

/// Why a record cannot be filtered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CfcFault {
    /// A class that is no positive number.
    #[error("a channel frequency class is a positive number of hertz, such as 180")]
    NoClass,
    /// A rate at which the design frequency does not exist.
    #[error(
        "CFC {class} has its design frequency at {design:.0} Hz, and {rate:.0} Hz sample no more than {:.0} Hz",
        0.5 * .rate
    )]
    TooSlow { class: f64, design: f64, rate: f64 },
    /// A rate at which the filter remembers more samples than there is room for.
    #[error(
        "CFC {class} has its design frequency at {design:.0} Hz, and remembers {samples:.1e} samples of {rate:.1e} Hz; up \
         to {MOST_REMEMBERED:.0e} are kept: look at the unit of the times"
    )]
    TooFast { class: f64, design: f64, rate: f64, samples: f64 },
}

/// The coefficients of one pass: `y = a (x + 2 x₁ + x₂) + b1 y₁ + b2 y₂`.
struct Pass {
    a: f64,
    b1: f64,
    b2: f64,
}

impl Cfc {
    /// The classes that the standards name.
    pub const STANDARD: [f64; 4] = [60.0, 180.0, 600.0, 1000.0];

    /// A class \[Hz\].
    ///
    /// # Errors
    ///
    /// [`CfcFault::NoClass`].
    pub fn new(class: f64) -> Result<Self, CfcFault> {
        if class.is_finite() && class > 0.0 { Ok(Self { class }) } else { Err(CfcFault::NoClass) }
    }

    /// The class \[Hz\].
    pub fn class(self) -> f64 {
        self.class
    }

    /// The frequency at which the gain is one half \[Hz\].
    pub fn design_frequency(self) -> f64 {
        DESIGN * self.class
    }

    fn warped(self, rate: f64) -> f64 {
        (PI * self.design_frequency() / rate).tan()
    }

    /// The gain of both passes at a frequency, for records of this sampling rate \[both Hz\]:
    /// `1/(1 + (tan(π f T)/ω_a)⁴)`; 0 from half the rate on.
    pub fn gain(self, frequency: f64, rate: f64) -> f64 {
        if 2.0 * frequency >= rate {
            return 0.0;
        }
        let ratio = (PI * frequency / rate).tan() / self.warped(rate);
        1.0 / (1.0 + ratio.powi(4))
    }

    /// For how many samples at a rate \[Hz\] the filter remembers a value.
    ///
    /// # Errors
    ///
    /// [`CfcFault::TooSlow`] where half of the rate is not above the design frequency, [`CfcFault::TooFast`] where
    /// there are more than 10⁷.
    pub(crate) fn memory(self, rate: f64) -> Result<f64, CfcFault> {
        let (class, design) = (self.class, self.design_frequency());
        let samples = MEMORY * rate / design;
        if 2.0 * design >= rate {
            Err(CfcFault::TooSlow { class, design, rate })
        } else if samples <= MOST_REMEMBERED {
            Ok(samples)
        } else {
            Err(CfcFault::TooFast { class, design, rate, samples })
        }
    }

    /// Filters samples at even steps.
    ///
    /// # Errors
    ///
    /// [`CfcFault::TooSlow`] where half of the sampling rate \[Hz\] is not above the design frequency, and
    /// [`CfcFault::TooFast`] where the filter remembers more than 10⁷ samples.
    pub fn filter(self, values: &[f64], rate: f64, padding: Padding) -> Result<Vec<f64>, CfcFault> {
        let wanted = self.memory(rate)?;
        let pass = self.pass(rate);
        let mut length = 0;
        while (length as f64) < wanted && padding != Padding::None {
            length += 1;
        }
        let mut all = padded(values, length, padding);
        let rests_at = |first: f64| if padding == Padding::Zero { 0.0 } else { first };
        pass.run(&mut all, rests_at);
        all.reverse();
        pass.run(&mut all, rests_at);
        all.reverse();
        Ok(all[length..length + values.len()].to_vec())
    }

    fn pass(self, rate: f64) -> Pass {
        let warped = self.warped(rate);
        let square = warped * warped;
        let whole = 1.0 + SQRT_2 * warped + square;
        Pass {
            a: square / whole,
            b1: 2.0 * (1.0 - square) / whole,
            b2: (SQRT_2 * warped - 1.0 - square) / whole,
        }
    }
}

impl Pass {
    /// One pass over the values, from the steady state of `rests_at` the first one.
    fn run(&self, values: &mut [f64], rests_at: impl Fn(f64) -> f64) {
        let Some(first) = values.first().map(|own| rests_at(*own)) else { return };
        let [mut x1, mut x2, mut y1, mut y2] = [first; 4];
        for value in values {
            let x = *value;
            let y = self.a * (x + 2.0 * x1 + x2) + self.b1 * y1 + self.b2 * y2;
            (x2, x1, y2, y1) = (x1, x, y1, y);
            *value = y;
        }
    }
}

/// The values with `length` more before and behind.
fn padded(values: &[f64], length: usize, padding: Padding) -> Vec<f64> {
    let last = values.len() - 1;
    // The value so many steps beyond an end; what a mirror does not reach is held.
    let beyond = |end: f64, inward: &dyn Fn(usize) -> f64, steps: usize| match padding {
        Padding::Odd => 2.0 * end - inward(steps.min(last)),
        Padding::Even => inward(steps.min(last)),
        Padding::Hold | Padding::None => end,
        Padding::Zero => 0.0,
    };
    let before = (1..=length).rev().map(|at| beyond(values[0], &|k| values[k], at));
    let behind = (1..=length).map(|at| beyond(values[last], &|k| values[last - k], at));
    before.chain(values.iter().copied()).chain(behind).collect()
}
