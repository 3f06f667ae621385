//! Integrals of products of outputs, step by step.

use dashpot_numerics::{Forms, quadrature::GaussLegendre};
use nalgebra::DMatrix;

use super::{
    Step, between, inputs,
    lagrange::{HIGHEST, Lagrange},
};
use crate::{FormRef, LinearForm, Product, System};

/// Products that are worked on at once, so that they stay in the processor's nearest memory.
const BLOCK: usize = 256;

/// Roundings up to which two forms are multiples of each other.
const ROUNDINGS: f64 = 8.0;

/// The integrals of products of outputs over the steps so far, dimensionless, each with the factor
/// that gives it its unit.
///
/// A product of two polynomials is integrated by a Gauss rule that is exact for it. Most products are
/// those of a dashpot, whose force is a multiple of its rate: they are squares, and their integral is
/// `‖A f‖²` with the root of each point's weight times the shares of the rows in a row of `A`. With
/// the triangle `R` of `A = Q R` in its place half of the work is left.
#[derive(Debug, Default)]
pub(super) struct Products {
    squares: Vec<Sum>,
    pairs: Vec<Sum>,
    /// Products with driving functions in them, and those.
    driven: Vec<(Sum, [LinearForm; 2])>,
    /// The factors, as forms over the unknowns: those of squares once, then the first of all other
    /// pairs, then the second.
    forms: Forms,
}

/// All unknowns at one time, and of them the factors of the products.
#[derive(Debug, Default)]
pub(super) struct Row {
    pub(super) state: Vec<f64>,
    pub(super) factors: Vec<f64>,
}

/// One integral.
#[derive(Debug, Clone, Copy)]
struct Sum {
    index: usize,
    factor: f64,
    total: f64,
    largest: f64,
}

impl Sum {
    fn add(&mut self, summand: f64) {
        self.total += summand;
        self.largest = self.largest.max(self.factor.signum() * self.total);
    }

    fn product(&self) -> Product {
        Product { total: self.factor * self.total, largest: self.factor.abs() * self.largest }
    }
}

impl Products {
    pub(super) fn new(system: &System, wanted: &[[usize; 2]]) -> Self {
        let mut products = Self::default();
        let (mut squared, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
        let mut driven = (Vec::new(), Vec::new());
        for (index, &[a, b]) in wanted.iter().enumerate() {
            let (a, b) = (system.outputs.at(a), system.outputs.at(b));
            let factor = a.scale * b.scale * system.time_scale;
            let sum = Sum { index, factor, total: 0.0, largest: 0.0 };
            if !(a.inputs.is_zero() && b.inputs.is_zero()) {
                products.driven.push((sum, [a.inputs.to_form(), b.inputs.to_form()]));
                driven.0.push(a.unknowns);
                driven.1.push(b.unknowns);
            } else if let Some(ratio) = ratio(a.unknowns, b.unknowns) {
                products.squares.push(Sum { factor: factor * ratio, ..sum });
                squared.push(b.unknowns);
            } else {
                products.pairs.push(sum);
                first.push(a.unknowns);
                second.push(b.unknowns);
            }
        }
        let all = [squared, first, second, driven.0, driven.1];
        all.into_iter().flatten().for_each(|form| products.forms.push(form.terms()));
        products.forms.shrink_to_fit();
        products
    }

    /// The factors of all products where the unknowns are `state`.
    pub(super) fn factors(&self, state: &[f64], values: &mut Vec<f64>) {
        values.clear();
        values.extend(self.forms.iter().map(|form| form.at(state)));
    }

    /// Adds the integrals over one step, whose polynomials pass through `rows`.
    pub(super) fn add(
        &mut self,
        system: &System,
        step: &Step,
        lagrange: &Lagrange<'_>,
        rows: &[&Row],
    ) {
        let rule = GaussLegendre::with_points(step.degree + 1);
        let half = 0.5 * (step.end - step.start);
        let points: Vec<Point> = rule
            .nodes()
            .iter()
            .zip(rule.weights())
            .map(|(&x, weight)| Point {
                weight: half * weight,
                shares: lagrange.weights(between(step.start, step.end, x)),
            })
            .collect();
        let (squares, pairs) = (self.squares.len(), self.pairs.len());
        let triangle = triangle(&points);
        for (at, sums) in self.squares.chunks_mut(BLOCK).enumerate() {
            let first = at * BLOCK;
            let mut work = [0.0; BLOCK];
            for (at, shares) in triangle.iter().enumerate() {
                let values = values(&shares[at..], &rows[at..], first, sums.len());
                work.iter_mut().zip(values).for_each(|(work, value)| *work += value * value);
            }
            sums.iter_mut().zip(work).for_each(|(sum, work)| sum.add(work));
        }
        for (at, sums) in self.pairs.chunks_mut(BLOCK).enumerate() {
            let first = squares + at * BLOCK;
            let mut work = [0.0; BLOCK];
            for point in &points {
                let ones = values(&point.shares, rows, first, sums.len());
                let others = values(&point.shares, rows, first + pairs, sums.len());
                for ((work, one), other) in work.iter_mut().zip(ones).zip(others) {
                    *work += point.weight * one * other;
                }
            }
            sums.iter_mut().zip(work).for_each(|(sum, work)| sum.add(work));
        }
        if !self.driven.is_empty() {
            self.add_driven(system, step, lagrange, rows);
        }
    }

    /// The same for products with driving functions in them, at as many points as these ask for.
    fn add_driven(&mut self, system: &System, step: &Step, lagrange: &Lagrange<'_>, rows: &[&Row]) {
        let first = self.squares.len() + 2 * self.pairs.len();
        let count = self.driven.len();
        let mut given = vec![0.0; system.inputs.len()];
        let mut work = vec![0.0; count];
        for section in step.pieces(system) {
            let (degree, parts) = inputs::resolution(system, step, &section);
            let rule = GaussLegendre::with_points(degree + 1);
            let length = (section.end - section.start) / parts as f64;
            let points = || rule.nodes().iter().zip(rule.weights());
            for (part, (&x, weight)) in
                (0..parts).flat_map(|part| points().map(move |own| (part, own)))
            {
                let start = section.start + length * part as f64;
                let time = between(start, start + length, x);
                let point = Point { weight: 0.5 * length * weight, shares: lagrange.weights(time) };
                system.inputs_at(section.from, step.origin + time, &mut given);
                for (at, (work, (_, forms))) in work.iter_mut().zip(&self.driven).enumerate() {
                    let one = point.value(rows, first + at) + forms[0].at(&given);
                    let other = point.value(rows, first + count + at) + forms[1].at(&given);
                    *work += point.weight * one * other;
                }
            }
        }
        self.driven.iter_mut().zip(work).for_each(|(entry, work)| entry.0.add(work));
    }

    /// The integrals in the order in which they were wanted.
    pub(super) fn finish(self) -> Vec<Product> {
        let driven = self.driven.iter().map(|entry| &entry.0);
        let mut all: Vec<&Sum> = self.squares.iter().chain(&self.pairs).chain(driven).collect();
        all.sort_unstable_by_key(|sum| sum.index);
        all.into_iter().map(Sum::product).collect()
    }
}

/// By how much `a` is larger than `b`, if it is a multiple of it.
fn ratio(a: FormRef<'_>, b: FormRef<'_>) -> Option<f64> {
    let (a, b) = (a.terms(), b.terms());
    let ratio = a.clone().next()?.1 / b.clone().next()?.1;
    let is_same = |(one, other): ((usize, f64), (usize, f64))| {
        let rest = one.1 - ratio * other.1;
        one.0 == other.0 && rest.abs() <= ROUNDINGS * f64::EPSILON * one.1.abs()
    };
    (a.len() == b.len() && a.zip(b).all(is_same)).then_some(ratio)
}

/// A place in a step: what it weighs in an integral, and the shares of the step's rows in the values there.
struct Point {
    weight: f64,
    shares: [f64; HIGHEST + 1],
}

/// The sums of the rows' factors from number `first` on, `count` of them, with these shares; the rest is zero.
fn values(shares: &[f64], rows: &[&Row], first: usize, count: usize) -> [f64; BLOCK] {
    let mut values = [0.0; BLOCK];
    for (share, row) in shares.iter().zip(rows) {
        let own = &row.factors[first..first + count];
        values.iter_mut().zip(own).for_each(|(value, own)| *value += share * own);
    }
    values
}

/// The triangle `R` of `A = Q R`, where `A` has a row for each point: the root of its weight times the
/// shares of as many rows as there are points.
fn triangle(points: &[Point]) -> Vec<[f64; HIGHEST + 1]> {
    let count = points.len();
    let entry = |row: usize, column: usize| points[row].weight.sqrt() * points[row].shares[column];
    let upper = DMatrix::from_fn(count, count, entry).qr().unpack_r();
    let row = |row: usize| {
        std::array::from_fn(|column| if column < count { upper[(row, column)] } else { 0.0 })
    };
    (0..count).map(row).collect()
}

impl Point {
    /// The value of one factor.
    fn value(&self, rows: &[&Row], at: usize) -> f64 {
        self.shares.iter().zip(rows).map(|(share, row)| share * row.factors[at]).sum()
    }
}
