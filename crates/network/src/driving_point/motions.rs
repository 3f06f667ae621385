//! The motions of two receptances after an impulse, pole by pole, so that what agrees does not hide
//! what differs.

use nalgebra_sparse::na::Complex as Double;

use super::{Receptance, complex::Complex, grouped::Grouped, terms::Term};
use crate::compile::bodies::Groups;

/// Poles this close, relative, are taken together.
const NEAR: f64 = 1e-2;
/// Least width of a group, relative.
const NARROW: f64 = 1e-6;
/// Decay over which a motion ends: e⁻⁶⁰ is below the rounding of all others.
const DEAD: f64 = 60.0;
/// Decay after which nothing new is to be seen, and what each further pole of a group adds.
const DECAY: [f64; 2] = [14.0, 4.0];
/// Evaluations of single poles that one of a group takes the time of.
const GROUP_COST: usize = 60;

/// Poles of both that belong together, those of conjugates included.
pub(super) struct Motion {
    pole: [f64; 2],
    /// 2 for a pole that stands for its conjugate as well.
    weight: f64,
    /// How fast it changes \[1/s\].
    pub(super) speed: f64,
    /// How fast the slowest part decays \[1/s\], ≥ 0.
    decay: f64,
    order: usize,
    kind: Kind,
    /// What an evaluation costs.
    pub(super) cost: usize,
}

enum Kind {
    Single { residues: [Double<f64>; 2], change: Double<f64>, apart: Double<f64> },
    Group([Option<Grouped>; 2]),
}

/// A motion at a time.
#[derive(Clone, Copy, Default)]
pub(super) struct Moment {
    /// Of the first \[m/(N s)\], as a complex amplitude.
    pub(super) first: Double<f64>,
    /// The first less the second.
    pub(super) change: Double<f64>,
}

impl Motion {
    /// Time after which nothing new is to be seen \[s\]; infinite without decay.
    pub(super) fn life(&self) -> f64 {
        (DECAY[0] + DECAY[1] * (self.order - 1) as f64) / self.decay
    }

    pub(super) fn is_dead(&self, t: f64) -> bool {
        self.decay * t > DEAD
    }

    pub(super) fn at(&self, t: f64) -> Moment {
        let [re, im] = self.pole;
        let own = Double::from_polar(self.weight * (re * t).exp(), im * t);
        match &self.kind {
            Kind::Single { residues: [first, second], change, apart } => {
                let path = *apart * t;
                let away = if path.norm() < 1.0 {
                    own * grown(path)
                } else {
                    let end = [re + apart.re, im + apart.im];
                    Double::from_polar(self.weight * (end[0] * t).exp(), end[1] * t) - own
                };
                Moment { first: own * first, change: own * change - away * second }
            }
            Kind::Group(sides) => {
                let [first, second] = [&sides[0], &sides[1]]
                    .map(|side| side.as_ref().map_or(Complex::zero(), |side| side.at(t)));
                Moment { first: own * double(first), change: own * double(first - second) }
            }
        }
    }
}

/// `e^z − 1`.
fn grown(z: Double<f64>) -> Double<f64> {
    let half = (0.5 * z.im).sin();
    let re = z.re.exp_m1() * z.im.cos() - 2.0 * half * half;
    Double::new(re, z.re.exp() * z.im.sin())
}

fn double(value: Complex) -> Double<f64> {
    Double::new(value.re.high(), value.im.high())
}

/// Terms of both sides that belong together.
struct Bunch<'a> {
    sides: [Vec<&'a Term>; 2],
}

impl<'a> Bunch<'a> {
    fn terms(&self) -> impl Iterator<Item = &&'a Term> {
        self.sides.iter().flatten()
    }

    /// What it moves like up to the time that `until` makes of it.
    fn motion(&self, until: impl Fn(&Motion) -> f64) -> Option<Motion> {
        let about = self.terms().next()?.at;
        let order = |side: &Vec<&Term>| side.iter().map(|term| term.residues.len()).sum::<usize>();
        let order = order(&self.sides[0]).max(order(&self.sides[1]));
        let width = self.terms().map(|term| (term.at - about).size() + term.reach());
        let width = width.fold(0.0, f64::max);
        let is_single = |side: &Vec<&Term>| side.iter().all(|term| term.residues.len() == 1);
        let is_single =
            self.sides.iter().all(|side| side.len() < 2) && self.sides.iter().all(is_single);
        let strength =
            |at: usize| self.sides[at].first().map_or(Complex::zero(), |a| a.residues[0]);
        let apart = match (&self.sides[0][..], &self.sides[1][..]) {
            ([a], [b]) => b.at - a.at,
            _ => Complex::zero(),
        };
        let damping = |term: &&Term| -term.at.re.high();
        let mut motion = Motion {
            pole: about.rounded(),
            weight: if self.terms().all(|term| term.at.im > 0.0) { 2.0 } else { 1.0 },
            speed: about.size() + width,
            decay: if is_single {
                self.terms().map(damping).fold(f64::INFINITY, f64::min).max(0.0)
            } else {
                (damping(self.terms().next()?) - width).max(0.0)
            },
            order,
            kind: Kind::Single {
                residues: [0, 1].map(|at| double(strength(at))),
                change: double(strength(0) - strength(1)),
                apart: double(apart),
            },
            cost: 1,
        };
        if !is_single {
            let longest = until(&motion);
            let width = width.max(NARROW * about.size());
            motion.cost = GROUP_COST * order * order;
            motion.kind = Kind::Group([0, 1].map(|at| {
                let side = &self.sides[at];
                (!side.is_empty()).then(|| Grouped::of(side, about, width, longest))
            }));
        }
        Some(motion)
    }
}

/// All poles but those at zero; `until` gives the longest time of interest \[s\] from all of them.
pub(super) fn motions(
    a: &Receptance,
    b: &Receptance,
    until: impl Fn(&[Motion]) -> f64,
) -> (Vec<Motion>, f64) {
    let bunches = bunches(a, b);
    let plain: Vec<Motion> = bunches.iter().filter_map(|bunch| bunch.motion(|_| 0.0)).collect();
    let longest = until(&plain);
    let all = bunches.iter().filter_map(|bunch| bunch.motion(|_| longest)).collect();
    (all, longest)
}

fn bunches<'a>(a: &'a Receptance, b: &'a Receptance) -> Vec<Bunch<'a>> {
    let side = |own: &'a Receptance, at: usize| own.terms.iter().map(move |term| (term, at));
    let all: Vec<(&Term, usize)> =
        side(a, 0).chain(side(b, 1)).filter(|(term, _)| term.at.size() > 0.0).collect();
    let mut groups = Groups::new(all.len());
    let mut pairs = Vec::new();
    for (i, &(first, _)) in all.iter().enumerate().filter(|(_, own)| own.1 == 0) {
        for (j, &(second, _)) in all.iter().enumerate().filter(|(_, own)| own.1 == 1) {
            let gap = (first.at - second.at).size() / first.at.size();
            if gap > NEAR {
                continue;
            }
            if first.residues.len() > 1 || second.residues.len() > 1 {
                groups.join(i, j);
            } else if sign(first) == sign(second) {
                pairs.push((gap, i, j));
            }
        }
    }
    let mut is_taken: Vec<bool> = (0..all.len())
        .map(|at| (0..all.len()).any(|other| other != at && groups.of(other) == groups.of(at)))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, i, j) in pairs {
        if !is_taken[i] && !is_taken[j] {
            groups.join(i, j);
            (is_taken[i], is_taken[j]) = (true, true);
        }
    }
    let mut members: Vec<[Vec<&Term>; 2]> = vec![[Vec::new(), Vec::new()]; all.len()];
    for (at, &(term, side)) in all.iter().enumerate() {
        members[groups.of(at)][side].push(term);
    }
    members
        .into_iter()
        .map(|sides| Bunch { sides })
        .filter(|bunch| bunch.terms().any(|term| sign(term) >= 0))
        .collect()
}

/// On which side of the real axis the pole is.
fn sign(term: &Term) -> i8 {
    i8::from(term.at.im > 0.0) - i8::from(term.at.im < 0.0)
}
