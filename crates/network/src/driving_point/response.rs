//! The response of a circuit: poles and residues, computed twice.

use dashpot_numerics::DoubleDouble;

use super::{
    DrivingPointError, Hidden, Receptance,
    circuit::{Circuit, shift},
    complex::Complex,
    massless,
    modes::modes,
    spectrum,
    terms::{Term, terms},
};

/// Most bodies of a circuit without masses, and of one with masses.
const MOST_BODIES: [usize; 2] = [200, 80];
/// Terms with less than this share of the receptance are looked at again.
const DOUBTFUL: f64 = 1e-22;
/// What two runs with different scales of time may differ by before a third one is made.
const WANTED: f64 = 1e-14;
/// Exponents by which the later units of time differ from the middle of the poles.
const OFFSETS: [i32; 4] = [3, -2, 5, -4];
/// Relative error of what is known best.
const ROUNDING: f64 = 1e-30;

/// The response of a circuit.
pub(super) fn response(circuit: &Circuit) -> Result<Receptance, DrivingPointError> {
    let most = MOST_BODIES[usize::from(!circuit.is_massless())];
    if circuit.bodies > most {
        return Err(DrivingPointError::TooLarge { bodies: circuit.bodies, most });
    }
    let (scaled, force) = circuit.scaled(0)?;
    let mut compliance = scaled.instantaneous_compliance();
    shift(&mut compliance, -force);
    let rest = Rest { compliance, term: at_rest(&scaled, force) };
    let ([found, other], difference, time) = settled(circuit, &rest)?;
    let (is_hidden, faint) = hidden(circuit, [&found, &other], time, rest.total(&found))?;
    let mut kept: Vec<Term> = rest.term.into_iter().collect();
    let mut cancelled = Vec::new();
    let at_rest = scaled.creeping_parts() + scaled.free_parts();
    let seen: usize = kept.iter().map(|term| term.residues.len()).sum();
    if seen < at_rest {
        cancelled.push(Hidden { rate: [0.0, 0.0], count: at_rest - seen });
    }
    let mut error = difference.max(faint);
    for (term, is_hidden) in found.into_iter().zip(is_hidden) {
        let seen = if is_hidden { 0 } else { term.residues.len() };
        if seen < term.count {
            cancelled.push(Hidden { rate: term.at.rounded(), count: term.count - seen });
        }
        if !is_hidden {
            error = error.max(term.error);
            kept.push(term);
        }
    }
    Ok(Receptance { compliance, terms: kept, hidden: cancelled, error })
}

/// What the graph alone says of the response.
struct Rest {
    compliance: DoubleDouble,
    term: Option<Term>,
}

impl Rest {
    /// The compliance in the slowest pole's time, by which single strengths are judged.
    fn total(&self, terms: &[Term]) -> f64 {
        let slowest = terms.first().map_or(1.0, |term| term.at.size());
        let creep = self.term.as_ref().map_or(0.0, |term| term.compliance_at(slowest));
        terms.iter().fold(self.compliance.high() + creep, |sum, term| sum + term.compliance())
    }
}

/// The term of free motion and of creep.
fn at_rest(scaled: &Circuit, force: i32) -> Option<Term> {
    let origin = scaled.origin();
    let (double, simple) = (Complex::new(origin.double, 0.0), Complex::new(origin.simple, 0.0));
    let mut term = Term::simple(Complex::zero(), simple);
    if double.size() > 0.0 {
        term.residues = vec![double, simple];
        term.spread = vec![Complex::zero(); 2];
    } else if simple.size() <= 0.0 {
        return None;
    }
    term.scale(0, force);
    Some(term)
}

/// The terms in physical units, with the unit of time in the middle of the poles; with them those of another unit of
/// time and another order of the bodies, and what they differ by.
fn settled(
    circuit: &Circuit,
    rest: &Rest,
) -> Result<([Vec<Term>; 2], f64, i32), DrivingPointError> {
    let mut time = exponent(1.0 / circuit.middle_rate());
    // Another unit of time alone would repeat many roundings: it is a power of two.
    let turned = circuit.reversed();
    let mut last = run(circuit, time)?;
    let mut best: Option<([Vec<Term>; 2], f64, i32)> = None;
    for round in 0..OFFSETS.len() {
        let (Some(first), Some(end)) = (last.first(), last.last()) else {
            return Ok(([last, Vec::new()], ROUNDING, time));
        };
        let middle = -0.5 * (first.at.size().log2() + end.at.size().log2());
        let centre = exponent(middle.exp2());
        time = if centre == time || round > 0 { centre + OFFSETS[round] } else { centre };
        let next = if round % 2 == 0 { run(&turned, time)? } else { run(circuit, time)? };
        let error = difference(&next, &last, rest.total(&next));
        if best.as_ref().is_none_or(|(_, least, _)| error < *least) {
            best = Some(([next.clone(), last], error, time));
        }
        if error < WANTED {
            break;
        }
        last = next;
    }
    match best {
        Some(best) if best.1.is_finite() => Ok(best),
        _ => Err(DrivingPointError::NoConvergence),
    }
}

/// All terms besides that at zero, in rising order of the pole.
fn run(circuit: &Circuit, time: i32) -> Result<Vec<Term>, DrivingPointError> {
    let (scaled, force) = circuit.scaled(time)?;
    let mut found = if circuit.is_massless() {
        massless::terms(&scaled)?
    } else {
        terms(&scaled, &modes(&scaled, &spectrum::poles(&scaled)?))
    };
    found.iter_mut().for_each(|term| term.scale(time, force));
    let is_finite = |value: &Complex| value.size().is_finite();
    if !found.iter().all(|term| is_finite(&term.at) && term.residues.iter().all(is_finite)) {
        return Err(DrivingPointError::NoConvergence);
    }
    found.sort_by(|a, b| {
        let key = |term: &Term| term.at.size();
        key(a).total_cmp(&key(b)).then(a.at.im.high().total_cmp(&b.at.im.high()))
    });
    Ok(found)
}

/// The exponent of the power of two next to a positive number.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a double")]
fn exponent(number: f64) -> i32 {
    number.log2().round().clamp(-1000.0, 1000.0) as i32
}

/// The term among `others` that is the same pole.
fn counterpart<'a>(term: &Term, others: &'a [Term]) -> Option<&'a Term> {
    let distance = |other: &Term| (other.at - term.at).size();
    others
        .iter()
        .filter(|other| other.residues.len() == term.residues.len())
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Relative difference of the strengths of two terms.
fn residue_difference(a: &Term, b: &Term) -> f64 {
    let change: Vec<Complex> = a.residues.iter().zip(&b.residues).map(|(a, b)| *a - *b).collect();
    let part = Term { residues: change, ..a.clone() }.compliance() / a.compliance();
    if part.is_nan() { f64::INFINITY } else { part }
}

fn difference(terms: &[Term], others: &[Term], total: f64) -> f64 {
    if terms.len() != others.len() {
        return f64::INFINITY;
    }
    let mut worst = ROUNDING;
    for term in terms {
        let Some(other) = counterpart(term, others) else { return f64::INFINITY };
        worst = worst.max((other.at - term.at).size() / term.at.size());
        if term.compliance() > DOUBTFUL * total {
            worst = worst.max(residue_difference(term, other));
        }
    }
    worst
}

/// Which terms have no residue to within the rounding of the constants: very weak ones that change as a whole when every
/// constant is changed in its last place, or that are rounding alone. With them the relative error of those that are weak
/// and stay, by what they are in the other unit of time.
fn hidden(
    circuit: &Circuit,
    [found, turned]: [&[Term]; 2],
    time: i32,
    total: f64,
) -> Result<(Vec<bool>, f64), DrivingPointError> {
    let mut hidden: Vec<bool> = found.iter().map(|term| term.compliance() <= 0.0).collect();
    let doubtful: Vec<usize> =
        (0..found.len()).filter(|&at| found[at].compliance() <= DOUBTFUL * total).collect();
    if doubtful.is_empty() {
        return Ok((hidden, 0.0));
    }
    for pattern in [11, 12] {
        let others = run(&circuit.rounded(pattern), time)?;
        for &at in &doubtful {
            let differs = |others: &[Term]| {
                let other = counterpart(&found[at], others);
                other.is_none_or(|other| residue_difference(&found[at], other) > 0.5)
            };
            // Without masses a residue is a quotient of sums of positive terms, and never rounding alone.
            hidden[at] |= differs(&others) || !circuit.is_massless() && differs(turned);
        }
    }
    let seen = doubtful.into_iter().filter(|&at| !hidden[at]);
    let faint = seen.filter_map(|at| Some((at, counterpart(&found[at], turned)?)));
    let error = faint.map(|(at, other)| residue_difference(&found[at], other)).fold(0.0, f64::max);
    Ok((hidden, error))
}
