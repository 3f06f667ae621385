//! Rates of what follows from the balance of a law that is not linear.
//!
//! A place between a spring and a slider that slides has no rate of its own: it is where the spring
//! pushes with the slider's force. Its rate follows from the balance differentiated once. With the
//! force `φ` of a law beyond its linear part ([`nonlinear_forces`](super::nonlinear_forces)) that reads
//! `0 = F'(y) ẏ − k ẏ − φ̇`, and `φ̇` is an algebraic unknown like `φ`. Only rates that something
//! watches, or by which it dissipates, are asked for; most networks have none.

use std::{collections::VecDeque, sync::Arc};

use dashpot_dae::{Characteristic, UnknownKind};

use super::{
    expand::Expansion,
    motion::Motion,
    row::{Row, RowSum},
    unknowns::{Draft, Inputs, Law, Places},
};
use crate::elements::Element;

/// Sets the rates of those parts that switch and whose ends follow from balances; `time` \[s\] is the unit of time.
pub(super) fn complete(
    expansion: &Expansion,
    time: f64,
    inputs: &mut Inputs,
    places: &mut Places,
    motion: &mut Motion,
) {
    if !expansion.switches {
        return;
    }
    let mut rates = Rates { expansion, time, of: Vec::new(), open: VecDeque::new() };
    for (at, primitive) in expansion.primitives.iter().enumerate() {
        let is_missing = primitive.is_phased() && primitive.needs_rate() && !motion.rate.has(at);
        if !is_missing || !motion.force.has(at) {
            continue;
        }
        if let Some(deformation) = motion.deformation.get(at)
            && let Some(rate) = rates.of(&deformation, inputs, places)
        {
            motion.rate.set(at, &rate);
        }
    }
    rates.balance(inputs, places, motion);
}

struct Rates<'a> {
    expansion: &'a Expansion,
    time: f64,
    /// Algebraic unknowns, and the unknowns that are their rates.
    of: Vec<(usize, usize)>,
    /// Those whose balance has not been differentiated yet.
    open: VecDeque<(usize, usize)>,
}

impl Rates<'_> {
    /// The rate of a combination of unknowns and inputs; `None` where it hangs on the rate of a force that
    /// depends on rates itself.
    fn of(&mut self, row: &Row, inputs: &mut Inputs, places: &mut Places) -> Option<Row> {
        let mut sum = RowSum::default();
        for &(unknown, coefficient) in row.unknowns.terms() {
            if coefficient.high() == 0.0 {
                continue;
            }
            let rate = match places.drafts[unknown].kind {
                UnknownKind::Differential => places.rows.row(unknown),
                UnknownKind::Algebraic => Row::unknown(self.unknown(unknown, places)?),
            };
            sum.add(coefficient, &rate);
        }
        sum.add(1.0, &inputs.rate(row));
        Some(sum.total())
    }

    /// The unknown that is the rate of an algebraic one.
    fn unknown(&mut self, of: usize, places: &mut Places) -> Option<usize> {
        if let Some(own) = self.of.iter().find(|own| own.0 == of) {
            return Some(own.1);
        }
        let Draft { name, unit, scale, law, .. } = &places.drafts[of];
        let law = match *law {
            None => None,
            Some(Law::Force(primitive)) => {
                let [_, damping] = self.expansion.primitives[primitive].slopes();
                if damping > 0.0 {
                    return None;
                }
                Some(Law::ForceRate(primitive))
            }
            Some(Law::ForceRate(_)) => return None,
        };
        let draft = Draft {
            name: format!("rate of {name}"),
            kind: UnknownKind::Algebraic,
            unit: match *unit {
                "N" => "N/s",
                "m" => "m/s",
                _ => "m/s^2",
            },
            scale: scale / self.time,
            initial: 0.0,
            law,
        };
        let rate = places.drafts.len();
        places.drafts.push(draft);
        self.of.push((of, rate));
        self.open.push_back((of, rate));
        Some(rate)
    }

    /// Differentiates the balances of all algebraic unknowns whose rates are unknowns.
    fn balance(mut self, inputs: &mut Inputs, places: &mut Places, motion: &mut Motion) {
        while let Some((of, rate)) = self.open.pop_front() {
            let balance = places.rows.row(of);
            if let Some(row) = self.of(&balance, inputs, places) {
                places.rows.set(rate, &row);
            }
            if let Some(Law::ForceRate(primitive)) = places.drafts[rate].law
                && !motion.rate.has(primitive)
                && let Some(deformation) = motion.deformation.get(primitive)
                && let Some(row) = self.of(&deformation, inputs, places)
            {
                motion.rate.set(primitive, &row);
            }
        }
    }
}

/// The rate of the force of a law of the deformation alone, over the deformation and its rate.
///
/// Its slope is that of a narrow secant: a method cannot step through the place at which the slope of a
/// power law is infinitely steep, or that of a table jumps.
#[derive(Debug)]
pub(super) struct ForceRate {
    element: Arc<dyn Element>,
    /// Half the length of the secant \[m\].
    half: f64,
}

/// Half the length of the secant in parts of the deformation at which sliders slip, or without them the law bears the
/// size of its force. What it leaves out of the slope is its square.
const NARROW: f64 = 1e-4;

impl ForceRate {
    /// Of the law of `primitive`, among whose neighbours there may be sliders that slip, and the size of its force \[N\].
    pub(super) fn of(expansion: &Expansion, primitive: usize, size: f64) -> Self {
        let own = &expansion.primitives[primitive];
        let sliders = expansion
            .primitives
            .iter()
            .filter_map(|primitive| primitive.origin.phases()?.capacity());
        let most = sliders.reduce(f64::max).unwrap_or(size);
        let force = |deformation: f64| own.element.force(deformation, 0.0).abs();
        let [stiffness, _] = own.slopes();
        let mut slips = most / stiffness;
        for _ in 0..DOUBLINGS {
            slips *= match (force(slips) < most, force(0.5 * slips) > most) {
                (true, _) => 2.0,
                (_, true) => 0.5,
                _ => break,
            };
        }
        Self { element: Arc::clone(&own.element), half: NARROW * slips }
    }

    fn secant(&self, deformation: f64, of: impl Fn(f64) -> f64) -> f64 {
        (of(deformation + self.half) - of(deformation - self.half)) / (2.0 * self.half)
    }

    fn slope(&self, deformation: f64) -> f64 {
        self.secant(deformation, |at| self.element.force(at, 0.0))
    }
}

/// Doublings of a deformation until a law bears what is asked for.
const DOUBLINGS: usize = 100;

impl Characteristic for ForceRate {
    fn value(&self, [deformation, rate]: [f64; 2]) -> f64 {
        self.slope(deformation) * rate
    }

    fn slopes(&self, [deformation, rate]: [f64; 2]) -> [f64; 2] {
        let bend = self.secant(deformation, |at| self.element.tangent(at, 0.0).stiffness);
        [bend * rate, self.slope(deformation)]
    }
}
