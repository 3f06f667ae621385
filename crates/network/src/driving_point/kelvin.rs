//! Massless circuits: the Kelvin form of what is seen at the two nodes.

use dashpot_numerics::DoubleDouble;

use super::{
    DrivingPointError, Hidden, Massless,
    circuit::{Circuit, shift},
    jacobi::orthogonalise,
    links::dot,
};
use dashpot_rheology::LinearModel;

/// Most bodies of a massless circuit.
pub(super) const MOST_BODIES: usize = 200;
/// Rates closer than this, relative, are one rate.
const SAME_RATE: f64 = 1e-13;
/// Modes with less than this share of the compliance are looked at again.
const DOUBTFUL: f64 = 1e-22;
/// What two runs with different scales of time may differ by before a third one is made.
const WANTED: f64 = 1e-14;
/// Exponents by which the later units of time differ from the middle of the rates.
const OFFSETS: [i32; 4] = [3, -2, 5, -4];

/// Relative error of what is known best.
pub(super) const ROUNDING: f64 = 1e-30;

/// One term `strength/(s + rate)` of the compliance.
#[derive(Debug, Clone, Copy)]
struct Mode {
    rate: DoubleDouble,
    strength: DoubleDouble,
    /// How many modes of the circuit have this rate.
    count: usize,
    /// Relative difference of the strength between two runs.
    threshold: f64,
}

impl Mode {
    /// What the mode adds to the compliance at rest.
    fn compliance(self) -> f64 {
        self.strength.high() / self.rate.high()
    }
}

pub(super) fn response(circuit: &Circuit) -> Result<Massless, DrivingPointError> {
    if circuit.bodies > MOST_BODIES {
        return Err(DrivingPointError::TooLarge { bodies: circuit.bodies, most: MOST_BODIES });
    }
    let (scaled, force) = circuit.scaled(0)?;
    let physical = |mut value: DoubleDouble| {
        shift(&mut value, -force);
        value
    };
    let compliance = physical(scaled.instantaneous_compliance());
    let fluidity = physical(scaled.origin().simple);
    let (modes, error, time) = settled(circuit, compliance, fluidity)?;
    let is_hidden = hidden(circuit, &modes, time, total(&modes, compliance, fluidity))?;
    // Very weak modes that are seen count after all.
    let shown = modes.iter().zip(&is_hidden).filter(|own| !*own.1);
    let error = shown.map(|shown| shown.0.threshold).fold(error, f64::max);
    let mut kept = Vec::new();
    let mut cancelled = Vec::new();
    let at_rest = scaled.creeping_parts();
    let seen = usize::from(fluidity > 0.0);
    if seen < at_rest {
        cancelled.push(Hidden { rate: [0.0, 0.0], count: at_rest - seen });
    }
    for (mode, is_hidden) in modes.iter().zip(is_hidden) {
        let unseen = if is_hidden { mode.count } else { mode.count - 1 };
        if unseen > 0 {
            cancelled.push(Hidden { rate: [-mode.rate.high(), 0.0], count: unseen });
        }
        if !is_hidden {
            kept.push((mode.rate, mode.strength));
        }
    }
    let model = LinearModel::from_kelvin(compliance, fluidity, kept);
    Ok(Massless { model, hidden: cancelled, error })
}

/// The compliance in the slowest mode's time, by which single strengths are judged.
fn total(modes: &[Mode], compliance: DoubleDouble, fluidity: DoubleDouble) -> f64 {
    let creep = modes.first().map_or(0.0, |slowest| fluidity.high() / slowest.rate.high());
    modes.iter().fold(compliance.high() + creep, |sum, mode| sum + mode.compliance())
}

/// The modes in physical units, with the unit of time in the middle of their rates; what they
/// differ by from those of another unit of time is their error.
fn settled(
    circuit: &Circuit,
    compliance: DoubleDouble,
    fluidity: DoubleDouble,
) -> Result<(Vec<Mode>, f64, i32), DrivingPointError> {
    let mut time = exponent(1.0 / circuit.middle_rate());
    let mut last = modes(circuit, time)?;
    let mut best: Option<(Vec<Mode>, f64, i32)> = None;
    for run in 0..OFFSETS.len() {
        let (Some(first), Some(end)) = (last.first(), last.last()) else {
            return Ok((Vec::new(), ROUNDING, time));
        };
        let middle = -0.5 * (first.rate.high().log2() + end.rate.high().log2());
        let centre = exponent(middle.exp2());
        time = if centre == time || run > 0 { centre + OFFSETS[run] } else { centre };
        let next = modes(circuit, time)?;
        let mut merged = merge(&next);
        let total = total(&merged, compliance, fluidity);
        let error = difference(&last, &next, &mut merged, total);
        if best.as_ref().is_none_or(|(_, least, _)| error < *least) {
            best = Some((merged, error, time));
        }
        if error < WANTED {
            break;
        }
        last = next;
    }
    best.ok_or(DrivingPointError::NoConvergence)
}

/// The exponent of the power of two next to a positive number.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a double")]
pub(super) fn exponent(number: f64) -> i32 {
    number.log2().round().clamp(-1000.0, 1000.0) as i32
}

/// All modes in rising order of the rate, those that cannot be seen too.
///
/// With `A = K + C = L Lᵀ` at the rate 1 and `K = F Fᵀ`, the singular values `w` of `L⁻¹F` give the
/// rates `w²/(1 − w²)`; their left vectors `u` give the shapes `x = L⁻ᵀu`. Rate and strength are
/// then quotients of sums of positive terms, over the springs and over the dashpots. Those with
/// `w = 1` follow the springs at once, and the graph says how many they are.
fn modes(circuit: &Circuit, time: i32) -> Result<Vec<Mode>, DrivingPointError> {
    let (scaled, force) = circuit.scaled(time)?;
    let factor = scaled.stiffness_at_one().factor();
    let mut columns = super::links::Links::of(scaled.bodies, &scaled.springs).factor().columns();
    columns.iter_mut().for_each(|column| factor.solve_lower(column));
    orthogonalise(&mut columns)?;
    let mut pairs: Vec<(DoubleDouble, Vec<DoubleDouble>)> =
        columns.into_iter().map(|column| (dot(&column, &column), column)).collect();
    pairs.sort_by(|(a, _), (b, _)| a.high().total_cmp(&b.high()));
    let finite = pairs.len().saturating_sub(scaled.algebraic_parts());
    pairs.truncate(finite);
    let mut modes = Vec::with_capacity(finite);
    for (square, mut shape) in pairs {
        let norm = square.sqrt();
        shape.iter_mut().for_each(|value| *value = *value / norm);
        factor.solve_upper(&mut shape);
        let stored = Circuit::energy(&scaled.springs, &shape);
        let lost = Circuit::energy(&scaled.dashpots, &shape);
        let seen = Circuit::stretch(scaled.forces, &shape);
        let mut rate = stored / lost;
        let mut strength = seen * seen / lost;
        if !(rate > 0.0 && rate.high().is_finite() && strength.high().is_finite()) {
            return Err(DrivingPointError::NoConvergence);
        }
        shift(&mut rate, -time);
        shift(&mut strength, -force - time);
        modes.push(Mode { rate, strength, count: 1, threshold: 0.0 });
    }
    modes.sort_by(|a, b| a.rate.high().total_cmp(&b.rate.high()));
    Ok(modes)
}

/// Joins modes of one rate: only one combination of them is seen.
fn merge(modes: &[Mode]) -> Vec<Mode> {
    let mut merged: Vec<Mode> = Vec::new();
    for mode in modes {
        match merged.last_mut() {
            Some(last) if (mode.rate - last.rate).high() <= SAME_RATE * mode.rate.high() => {
                let strength = last.strength + mode.strength;
                if strength > 0.0 {
                    last.rate += (mode.rate - last.rate) * (mode.strength / strength);
                }
                last.strength = strength;
                last.count += 1;
            }
            _ => merged.push(*mode),
        }
    }
    merged
}

/// Largest relative difference of two runs in the rates and in the strengths that count; that of
/// each strength is noted.
fn difference(a: &[Mode], b: &[Mode], merged: &mut [Mode], total: f64) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    let mut at = 0;
    let mut worst = ROUNDING;
    for mode in merged {
        let sum = |modes: &[Mode]| {
            modes[at..at + mode.count].iter().fold(DoubleDouble::ZERO, |sum, m| sum + m.strength)
        };
        for (a, b) in a[at..at + mode.count].iter().zip(&b[at..at + mode.count]) {
            worst = worst.max(((a.rate - b.rate) / b.rate).high().abs());
        }
        let threshold = ((sum(a) - sum(b)) / mode.strength).high().abs();
        if mode.compliance() > DOUBTFUL * total {
            worst = worst.max(threshold);
        }
        mode.threshold = threshold;
        at += mode.count;
    }
    worst
}

/// Which modes have no strength to within the rounding of the constants: very weak ones that
/// change as a whole when every constant is changed in its last place.
fn hidden(
    circuit: &Circuit,
    modes: &[Mode],
    time: i32,
    total: f64,
) -> Result<Vec<bool>, DrivingPointError> {
    let mut hidden: Vec<bool> = modes.iter().map(|mode| mode.strength <= 0.0).collect();
    let doubtful: Vec<usize> =
        (0..modes.len()).filter(|&at| modes[at].compliance() <= DOUBTFUL * total).collect();
    if doubtful.is_empty() {
        return Ok(hidden);
    }
    for pattern in [11, 12] {
        let others = self::modes(&circuit.rounded(pattern), time)?;
        for &at in &doubtful {
            let first: usize = modes[..at].iter().map(|mode| mode.count).sum();
            let other = others[first..first + modes[at].count]
                .iter()
                .fold(DoubleDouble::ZERO, |sum, mode| sum + mode.strength);
            let change = (other - modes[at].strength).abs();
            hidden[at] |= change.high() > 0.5 * modes[at].strength.high();
        }
    }
    Ok(hidden)
}
