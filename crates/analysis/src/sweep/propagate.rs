//! The impact of one scene, by the powers of one matrix exponential.
//!
//! The state is carried from node to node by `e^{A h}`, until the contact force falls through zero.
//! At the nodes force and deformation are known with two rates each; where one turns, or the force
//! falls through zero, the state is carried into the step by its own series, and the place is found
//! by Newton's method on the solution itself. Integrals are Gauss's sums over each step; the two
//! steps at which the force is zero are taken in the root of time, in which powers of it are smooth.

use std::ops::ControlFlow;

use dashpot_dae::Signal;
use dashpot_numerics::{
    exponential::Powers,
    small::{Square, apply, apply_left},
};

use super::{
    bracket::{Flank, Step},
    plain::shown::Wanted,
    scene_point::{Figure, Impact, ScenePoint},
    sums::{Integrals, Recorder},
};
use crate::measures::NO_APPROACH;

/// A step is so long, in units of the shortest time of the system, where only peaks are looked for …
const COARSE: f64 = 3.0;
/// … and where integrals are formed.
const FINE: f64 = 1.0;
/// A run has at least so many steps …
const FEWEST: f64 = 16.0;
/// … and at most so many; beyond, it is not followed here.
const MOST: f64 = 20_000.0;
/// A force that comes so near to zero without passing it, in parts of its peak, is not judged here.
const GRAZING: f64 = 1e-6;
/// A force that comes up to this part of its peak again may exceed it between two looks.
const NEARLY: f64 = 0.8;
/// What is less than this part of its terms cannot be told from zero.
const NOTHING: f64 = 64.0 * f64::EPSILON;
/// What the error of a value is counted in: roundings per unit of norm times time.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// The largest value of a signal so far.
#[derive(Debug, Clone, Copy)]
struct Peak {
    value: f64,
    time: f64,
    /// What it may be between nodes where it is not known to run straight.
    doubtful: f64,
}

impl Peak {
    fn meet(&mut self, value: f64, time: f64) {
        if value > self.value {
            (self.value, self.time) = (value, time);
        }
    }
}

impl<const N: usize> ScenePoint<'_, N> {
    /// Solves the impact. `None` where it is not of the plain kind: the force does not push from the start, or does not
    /// fall through zero within the run, or comes near to zero before, or one of both turns twice within a step where
    /// it is largest, or comes near to its peak once more after the impact, or the system is too stiff.
    pub(super) fn solve(&self, wanted: Wanted) -> Option<Impact> {
        let mut propagate = Propagation::new(self, wanted)?;
        while propagate.start() < self.end {
            if let ControlFlow::Break(time) = propagate.advance()? {
                return propagate.impact(time);
            }
        }
        None
    }
}

/// A solution on its way from node to node.
struct Propagation<'p, const N: usize> {
    scene_point: &'p ScenePoint<'p, N>,
    wanted: Wanted,
    /// How fast the system changes, and the step that suits it.
    rate: f64,
    step: f64,
    carry: Square<N>,
    /// Force and deformation with two rates each, over the states.
    looks: [[f64; 6]; N],
    sums: Option<Integrals<N>>,
    recorder: Option<Recorder<N>>,
    /// Steps done, the state there, and what is seen.
    at: u32,
    z: [f64; N],
    seen: [f64; 6],
    /// The largest magnitude of each state.
    most: [f64; N],
    /// Of the force and of the deformation.
    peaks: [Peak; 2],
    /// Whether the force rises to one place and falls behind it, as far as its rates at the nodes tell; either may be
    /// missing.
    is_hump: bool,
    has_top: bool,
    /// The lowest turn of the force and the least deformation.
    lowest: f64,
    shallowest: f64,
    /// By how much the force falls in the step in which it passes zero, per time.
    fall: f64,
    /// The rate of the deformation at the start, and its own with its rate at the end of the impact.
    meeting: f64,
    parting: [f64; 2],
}

impl<'p, const N: usize> Propagation<'p, N> {
    fn new(scene_point: &'p ScenePoint<'p, N>, wanted: Wanted) -> Option<Self> {
        let powers = Powers::of(*scene_point.matrix);
        let rate = powers.rate();
        let integrates = wanted.work || wanted.work_at_end || wanted.power.is_some();
        let longest = if integrates { FINE } else { COARSE } / rate;
        let step = longest.min(scene_point.end / FEWEST);
        if !(step > 0.0 && scene_point.end / step <= MOST) {
            return None;
        }
        let rates = |row: &[f64; N]| apply_left(row, scene_point.matrix);
        let (force_rate, speed) = (rates(scene_point.force), rates(scene_point.deformation));
        let (force_bend, bend) = (rates(&force_rate), rates(&speed));
        let mut looks = [[0.0; 6]; N];
        for (at, look) in looks.iter_mut().enumerate() {
            let force = [scene_point.force[at], force_rate[at], force_bend[at]];
            let depth = [scene_point.deformation[at], speed[at], bend[at]];
            *look = [force[0], force[1], force[2], depth[0], depth[1], depth[2]];
        }
        let most = scene_point.start.map(f64::abs);
        let seen = apply(&looks, scene_point.start);
        let noise = |row: &[f64; N]| NOTHING * size(row, &most);
        let begins = if seen[0].abs() > noise(scene_point.force) {
            seen[0] > 0.0
        } else {
            seen[1] > noise(&force_rate)
        };
        let peak = |value: f64| Peak { value: value.max(0.0), time: 0.0, doubtful: 0.0 };
        begins.then(|| Self {
            scene_point,
            wanted,
            rate,
            step,
            carry: powers.exponential(step),
            looks,
            sums: integrates.then(|| Integrals::new(scene_point, wanted, step, &speed)),
            recorder: wanted.course.then(|| Recorder::new(scene_point, step)),
            at: 0,
            z: *scene_point.start,
            seen,
            most,
            peaks: [peak(seen[0]), peak(seen[3])],
            is_hump: true,
            has_top: false,
            lowest: f64::INFINITY,
            shallowest: 0.0,
            fall: 0.0,
            meeting: seen[4],
            parting: [0.0; 2],
        })
    }

    /// When the next step begins.
    fn start(&self) -> f64 {
        f64::from(self.at) * self.step
    }

    /// Takes a step, or breaks off where the force falls through zero, with how long after the beginning
    /// of the step that is. `None` where the impact is not of the plain kind.
    fn advance(&mut self) -> Option<ControlFlow<f64>> {
        let next = apply(&self.carry, &self.z);
        let found = apply(&self.looks, &next);
        for (own, state) in self.most.iter_mut().zip(&next) {
            *own = own.max(state.abs());
        }
        let flanks = [Flank::of(&self.seen, &found, 0), Flank::of(&self.seen, &found, 3)];
        let (matrix, looks) = (self.scene_point.matrix, &self.looks);
        let whole = Step { matrix, looks, length: self.step, ends: [&self.z, &next] };
        let mut until = None;
        if found[0] <= 0.0 {
            let (time, depth) = whole.fall(&flanks[0])?;
            if self.at == 0 || self.start() + time > self.scene_point.end {
                return None;
            }
            self.shallowest = self.shallowest.min(depth);
            self.peaks[1].meet(depth, self.start() + time);
            self.fall = found[1].min(self.seen[1]).abs();
            let [_, _, _, _, speed, bend] = apply(looks, &whole.state(time));
            self.parting = [speed, bend];
            until = Some(time);
        } else {
            if self.seen[1] < 0.0 && found[1] > 0.0 {
                self.lowest = self.lowest.min(whole.turn(&flanks[0], 0)?.1);
            }
            let end = self.start() + self.step;
            self.peaks[0].meet(found[0], end);
            self.peaks[1].meet(found[3], end);
        }
        if self.recorder.is_some() {
            let turns = flanks[0].rises_then_falls();
            self.is_hump &= if turns { !self.has_top } else { flanks[0].is_steady(self.step) };
            self.has_top |= turns;
        }
        let start = self.start();
        for ((peak, flank), place) in self.peaks.iter_mut().zip(&flanks).zip([0, 3]) {
            if flank.rises_then_falls() {
                let (time, value) = whole.turn(flank, place)?;
                if time <= until.unwrap_or(self.step) {
                    peak.meet(value, start + time);
                }
            } else if !flank.is_straight(self.step) {
                peak.doubtful = peak.doubtful.max(flank.bound(self.step));
            }
        }
        self.shallowest = self.shallowest.min(found[3]);
        if let Some(recorder) = &mut self.recorder {
            recorder.add(&self.z, start);
        }
        let ahead = self.scene_point.end - self.start();
        if let Some(sums) = &mut self.sums {
            if until.is_some() && self.wanted.work_at_end {
                sums.complete(&self.carry, &self.z, ahead);
            }
            sums.add(self.scene_point, &self.z, self.at, until)?;
        }
        if let Some(time) = until {
            return Some(ControlFlow::Break(time));
        }
        (self.z, self.seen) = (next, found);
        self.at += 1;
        Some(ControlFlow::Continue(()))
    }

    /// Whether the force may get beyond its peak after the impact. It is looked at every other node, and what
    /// comes near to the peak there counts.
    fn may_strike_again(&self) -> bool {
        let twice = self.carry.map(|column| apply(&self.carry, &column));
        let most = NEARLY * self.peaks[0].value;
        let (mut z, mut time) = (self.z, self.start());
        while time < self.scene_point.end {
            z = apply(&twice, &z);
            let force: f64 =
                self.scene_point.force.iter().zip(&z).map(|(row, own)| row * own).sum();
            if force.abs() > most {
                return true;
            }
            time += 2.0 * self.step;
        }
        false
    }

    /// What is known of the impact that ends so long after the beginning of the last step.
    fn impact(mut self, time: f64) -> Option<Impact> {
        let [force, depth] = self.peaks;
        let release = self.start() + time;
        let is_clear = force.doubtful <= force.value
            && depth.doubtful <= depth.value
            && self.lowest > GRAZING * force.value
            && -self.shallowest <= depth.value;
        if !is_clear || !self.scene_point.opens && self.may_strike_again() {
            return None;
        }
        let steps = f64::from(self.at) + 16.0 + self.rate * release;
        let grown = ROUNDINGS * steps * N as f64;
        let noise = grown * size(self.scene_point.force, &self.most);
        let figure = |value: f64, error: f64| Figure { value, error };
        let speed: [f64; N] = self.looks.map(|look| look[4]);
        let release_error = noise / self.fall + 4.0 * f64::EPSILON * release;
        let [parting, bend] = self.parting;
        // Ends that meet without speed have none; a full run says so.
        let is_met = self.meeting.abs() > NO_APPROACH * size(&speed, &self.most);
        let restitution = if is_met { -parting / self.meeting } else { f64::NAN };
        let speed = grown * size(&speed, &self.most);
        let moved = speed * (1.0 + restitution.abs()) + bend.abs() * release_error;
        let mut impact = Impact {
            force: figure(force.value, noise),
            depth: figure(depth.value, grown * size(self.scene_point.deformation, &self.most)),
            deepest_at: depth.time,
            top: self.is_hump.then_some(force.time),
            release: figure(release, release_error),
            restitution: figure(restitution, moved / self.meeting.abs()),
            ..Impact::default()
        };
        if let Some(sums) = &self.sums {
            sums.finish(&mut impact, self.scene_point.end, noise, speed);
        }
        impact.course = self.recorder.take().map(|own| Signal::new(own.panels, None, noise));
        let all = [impact.force, impact.depth, impact.release, impact.power, impact.work];
        let is_finite = |figure: &Figure| figure.value.is_finite() && figure.error.is_finite();
        all.iter().all(is_finite).then_some(impact)
    }
}

/// What a row may come to at most.
fn size<const N: usize>(row: &[f64; N], most: &[f64; N]) -> f64 {
    row.iter().zip(most).map(|(one, other)| (one * other).abs()).sum()
}
