//! The numbers of a network at every point of a grid, from those along its axes.

use std::ops::ControlFlow;

use dashpot_network::{Network, ParametricSystem};

use super::{
    Grid, Pose,
    parallel::{GROUP, share},
    scene_point::Figure,
    stopped::{gap, unmet},
};

/// Numbers that are products of others may be so many roundings off.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON;

/// What one parameter makes of the numbers.
#[derive(Debug, Clone)]
struct Axis {
    /// Which numbers depend on it.
    moved: Vec<usize>,
    /// For each value of the parameter what those are over their values at the first point; `None`
    /// where the network is of another form.
    factors: Vec<Option<Vec<f64>>>,
    /// For each value of the parameter what those are.
    values: Vec<Option<Vec<f64>>>,
}

/// What stands behind the numbers of a [`ParametricSystem`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Besides {
    /// Thickness \[m\] of the element that is struck; not a number where it has none.
    pub(super) thickness: f64,
    /// That of the thinnest of its parts.
    pub(super) thinnest: f64,
    /// The deformation at which its stop is met \[m\]; not a number where it has none.
    pub(super) gap: f64,
    /// How long what strikes falls before \[s\].
    pub(super) fall: f64,
}

impl Besides {
    pub(super) fn of(numbers: &[f64]) -> Self {
        let &[.., thickness, thinnest, gap, fall] = numbers else {
            return Self { thickness: f64::NAN, thinnest: f64::NAN, gap: f64::NAN, fall: f64::NAN };
        };
        Self { thickness, thinnest, gap, fall }
    }

    /// Whether the stop may be met where the element is pressed in so far \[m\].
    pub(super) fn are_stopped(&self, depth: Figure) -> bool {
        !self.gap.is_nan() && depth.value + depth.error >= self.gap
    }
}

/// The numbers of a [`ParametricSystem`], and what stands [behind](Besides) them.
#[derive(Debug, Clone)]
pub(super) struct Table {
    base: Vec<f64>,
    axes: Vec<Axis>,
    /// Whether no number depends on two parameters.
    is_apart: bool,
}

impl Table {
    /// Reads the networks along each axis of the grid by so many threads. `None` where the first one is of
    /// another form, or the scenes differ in more than their networks.
    pub(super) fn of(
        parametric: &ParametricSystem,
        grid: &Grid,
        pose: &Pose<'_>,
        duration: f64,
        threads: usize,
    ) -> Option<Self> {
        let read = |point: usize| {
            let scene_point = pose(&grid.places(point)).ok()?;
            let is_same = scene_point.settings.duration.to_bits() == duration.to_bits();
            is_same.then(|| numbers(parametric, &scene_point.network)).flatten()
        };
        let base = read(0)?;
        let mut axes = Vec::with_capacity(grid.counts().len());
        let mut owners = vec![0; base.len()];
        for (axis, &count) in grid.counts().iter().enumerate() {
            let mut rows: Vec<_> =
                (0..count).map(|place| (grid.on_axis(axis, place), None)).collect();
            let work = |(): &mut (), rows: &mut [(usize, Option<Vec<f64>>)]| {
                rows.iter_mut().for_each(|(point, found)| *found = read(*point));
            };
            let groups = (GROUP, threads);
            share(&mut rows, groups, &|| (), &work, &mut |_, _| ControlFlow::Continue(()));
            let all: Vec<Option<Vec<f64>>> = rows.into_iter().map(|row| row.1).collect();
            let differs = |at: &usize| {
                all.iter().flatten().any(|own| own[*at].to_bits() != base[*at].to_bits())
            };
            let moved: Vec<usize> = (0..base.len()).filter(differs).collect();
            moved.iter().for_each(|&at| owners[at] += 1);
            let picked = |of: &dyn Fn(&[f64], usize) -> f64| {
                let one = |own: &Option<Vec<f64>>| {
                    own.as_ref().map(|own| moved.iter().map(|&at| of(own, at)).collect())
                };
                all.iter().map(one).collect()
            };
            let factors = picked(&|own, at| own[at] / base[at]);
            let values = picked(&|own, at| own[at]);
            axes.push(Axis { moved, factors, values });
        }
        Some(Self { base, axes, is_apart: owners.iter().all(|count| *count <= 1) })
    }

    /// How many numbers there are.
    pub(super) fn len(&self) -> usize {
        self.base.len()
    }

    /// Writes the numbers at a point, by which value each parameter takes. False where the network is of
    /// another form there. Nothing is allocated.
    pub(super) fn write(&self, places: &[usize], numbers: &mut [f64]) -> bool {
        numbers.copy_from_slice(&self.base);
        for (axis, &place) in self.axes.iter().zip(places) {
            let own = if self.is_apart { &axis.values[place] } else { &axis.factors[place] };
            let Some(own) = own else { return false };
            for (&at, value) in axis.moved.iter().zip(own) {
                if self.is_apart {
                    numbers[at] = *value;
                } else {
                    numbers[at] *= value;
                }
            }
        }
        true
    }

    /// Whether the numbers at a point are those of its network.
    pub(super) fn agrees(
        &self,
        parametric: &ParametricSystem,
        places: &[usize],
        network: &Network,
    ) -> bool {
        let mut own = vec![0.0; self.len()];
        match (numbers(parametric, network), self.write(places, &mut own)) {
            (Some(right), true) => own.iter().zip(right).all(|(own, right)| {
                (own - right).abs() <= ROUNDINGS * right.abs() || own.is_nan() && right.is_nan()
            }),
            (right, is_known) => right.is_none() && !is_known,
        }
    }
}

fn numbers(parametric: &ParametricSystem, network: &Network) -> Option<Vec<f64>> {
    let mut numbers = parametric.numbers(&unmet(network))?;
    let struck = &network.connections()[parametric.element()];
    let thinnest = struck.pads.iter().map(|pad| pad.thickness).fold(f64::NAN, f64::min);
    let fall = if parametric.opens() { network.time_of_fall() } else { 0.0 };
    let gap = gap(network, &struck.name, struck.thickness);
    numbers.extend([struck.thickness.unwrap_or(f64::NAN), thinnest, gap, fall]);
    Some(numbers)
}
