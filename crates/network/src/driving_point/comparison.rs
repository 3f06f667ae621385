//! Whether two receptances are the same, decided on their poles and strengths.

use dashpot_numerics::extrema::largest_on_half_line;

use super::{Receptance, complex::Complex, terms::Term};
use crate::compile::bodies::Groups;

/// What the poles and strengths of two receptances say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Agreement {
    /// Every pole and every strength is the same to within 10⁻¹¹ of itself.
    Same {
        /// Largest relative difference.
        difference: f64,
    },
    /// A pole or a strength differs.
    Different {
        /// Angular frequency at which `H(iω)` disagrees most \[rad/s\]; 0 and infinity are the limits.
        omega: f64,
        /// The disagreement there, `|H₁ − H₂|` over the larger of the two, between 0 and 2.
        size: f64,
    },
    /// The receptances are known less well than this asks for.
    Undecided {
        /// Their relative errors together.
        error: f64,
    },
}

/// Relative difference up to which poles and strengths are the same.
const SAME: f64 = 1e-11;
/// Groups and single poles this close, relative, are compared as a whole.
const NEAR: f64 = 1e-2;
/// Least width, relative, on which the shape of a group counts.
const NARROW: f64 = 1e-4;
/// Noise of the creep beside free motion.
const NOISE: f64 = 1e-25;
/// Points between neighbouring frequencies at which something may happen.
const BETWEEN: usize = 8;
/// Steps of the search for a maximum between two points.
const STEPS: usize = 60;
/// How far beyond the poles the limits are taken.
const FAR: f64 = 1e8;

impl Receptance {
    /// Compares with another receptance.
    ///
    /// Poles that stand alone are compared one by one, each with its strength. Where poles nearly
    /// coincide and single ones are ill determined (critical damping), what is compared is the
    /// moments of the group, `Σ residue·(pole − p)^k`.
    pub fn agreement(&self, other: &Self) -> Agreement {
        let error = self.error + other.error;
        if error >= SAME || error.is_nan() {
            return Agreement::Undecided { error };
        }
        let difference = self.difference(other);
        if difference <= SAME {
            return Agreement::Same { difference };
        }
        let (omega, size) = worst_frequency(self, other);
        Agreement::Different { omega, size }
    }

    /// Largest relative difference of poles and strengths; infinite where one has no counterpart.
    fn difference(&self, other: &Self) -> f64 {
        let mut worst =
            relative(self.compliance.high(), (self.compliance - other.compliance).high());
        let all: Vec<(&Term, usize)> = self
            .terms
            .iter()
            .map(|term| (term, 0))
            .chain(other.terms.iter().map(|term| (term, 1)))
            .filter(|(term, _)| term.at.size() > 0.0)
            .collect();
        worst = worst.max(self.difference_at_rest(other));
        let mut groups = Groups::new(all.len());
        for (i, (a, side)) in all.iter().enumerate() {
            for (j, (b, other)) in all.iter().enumerate().skip(i + 1) {
                let gap = (a.at - b.at).size() / a.at.size();
                let is_group = a.residues.len() > 1 || b.residues.len() > 1;
                if (side != other && gap <= SAME) || (is_group && gap <= NEAR) {
                    groups.join(i, j);
                }
            }
        }
        let mut members: Vec<[Vec<&Term>; 2]> = vec![[Vec::new(), Vec::new()]; all.len()];
        for (at, &(term, side)) in all.iter().enumerate() {
            members[groups.of(at)][side].push(term);
        }
        for [ours, theirs] in &members {
            worst = worst.max(match (&ours[..], &theirs[..]) {
                ([], []) => 0.0,
                ([a], [b]) if a.residues.len() == 1 && b.residues.len() == 1 => {
                    let pole = (a.at - b.at).size() / a.at.size();
                    let (a, b) = (a.residues[0], b.residues[0]);
                    pole.max((a - b).size() / a.size())
                }
                ([], _) | (_, []) => f64::INFINITY,
                (ours, theirs) => group_difference(ours, theirs),
            });
        }
        worst
    }

    /// Difference of the terms of free motion and creep.
    fn difference_at_rest(&self, other: &Self) -> f64 {
        let slowest = self
            .terms
            .iter()
            .map(|term| term.at.size())
            .filter(|size| *size > 0.0)
            .fold(f64::INFINITY, f64::min);
        let [a, b] = [self, other].map(|receptance| {
            let term = receptance.terms.iter().find(|term| term.at.size() <= 0.0);
            match term.map(|term| &term.residues[..]) {
                Some([double, simple]) => (*double, *simple),
                Some([simple]) => (Complex::zero(), *simple),
                _ => (Complex::zero(), Complex::zero()),
            }
        });
        let double = relative(a.0.size(), (a.0 - b.0).size());
        let noise = NOISE * a.0.size() / slowest;
        let change = (a.1 - b.1).size();
        double.max(if change <= noise { 0.0 } else { relative(a.1.size(), change) })
    }
}

/// A change in units of what changes; infinite where that is nothing.
fn relative(size: f64, change: f64) -> f64 {
    if change == 0.0 { 0.0 } else { change.abs() / size.abs() }
}

/// Difference of groups of poles by their moments about a common point.
fn group_difference(ours: &[&Term], theirs: &[&Term]) -> f64 {
    let about = ours[0].at;
    let width = ours
        .iter()
        .chain(theirs)
        .map(|term| (term.at - about).size() + term.reach())
        .fold(0.0, f64::max);
    let scale = width.max(about.re.high().abs()).max(NARROW * about.size());
    let count = ours.iter().chain(theirs).map(|term| term.residues.len()).sum();
    let moments = |terms: &[&Term]| {
        let mut sums = vec![Complex::zero(); count];
        for term in terms {
            for (sum, moment) in sums.iter_mut().zip(term.moments(about, count)) {
                *sum = *sum + moment;
            }
        }
        sums
    };
    let (ours, theirs) = (moments(ours), moments(theirs));
    let (mut largest, mut change) = (0.0_f64, 0.0_f64);
    let mut unit = 1.0;
    for (a, b) in ours.iter().zip(&theirs) {
        largest = largest.max(a.size() / unit);
        change = change.max((*a - *b).size() / unit);
        unit *= scale;
    }
    relative(largest, change)
}

/// The angular frequency of the largest relative difference of `H(iω)`, and that difference.
///
/// It changes on the scale of the poles' own frequencies and dampings: points are placed there and
/// between them, and every local maximum is enclosed by a golden section.
fn worst_frequency(a: &Receptance, b: &Receptance) -> (f64, f64) {
    let mut marks = Vec::new();
    for term in a.terms.iter().chain(&b.terms).filter(|term| term.at.size() > 0.0) {
        let (damping, frequency) = (term.at.re.high().abs(), term.at.im.high().abs());
        marks.extend([term.at.size(), frequency, frequency - damping, frequency + damping]);
    }
    marks.retain(|mark| *mark > 0.0);
    marks.sort_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (marks.first(), marks.last()) else {
        return (0.0, apart(a, b, 1.0));
    };
    let mut points = vec![low / FAR, low / FAR.sqrt()];
    marks.insert(0, low * 1e-3);
    marks.push(high * 1e3);
    for pair in marks.windows(2) {
        let ratio = (pair[1] / pair[0]).ln() / BETWEEN as f64;
        points.extend((0..BETWEEN).map(|at| pair[0] * (ratio * at as f64).exp()));
    }
    points.extend([high * 1e3, high * FAR.sqrt(), high * FAR]);
    points.dedup();
    largest_on_half_line(&points, STEPS, |omega| apart(a, b, omega))
}

/// Relative difference at one frequency.
fn apart(a: &Receptance, b: &Receptance, omega: f64) -> f64 {
    let s = Complex::new(0.0, omega);
    let (a, b) = (a.value(s), b.value(s));
    let size = a.size().max(b.size());
    if size > 0.0 && size.is_finite() { (a - b).size() / size } else { 0.0 }
}
