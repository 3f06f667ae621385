//! Arithmetic that is recorded while rows are assembled, and done again with other numbers.

use std::{
    cell::RefCell,
    iter::Sum,
    ops::{Add, Div, Mul},
};

use dashpot_numerics::{Coefficient, DoubleDouble, Stream};

/// What is done with two values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Sum,
    Product,
    Quotient,
}

/// What a value is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Node {
    /// A number of the network.
    Number(usize),
    Constant(f64),
    /// Made of values that stand before it.
    Done(Kind, [usize; 2]),
}

/// The operations so far; none stands there twice.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    nodes: RefCell<Vec<Node>>,
    /// Those that are asked for.
    results: RefCell<Vec<usize>>,
}

/// A coefficient that knows what it is made of: of numbers of a network, or else it is a constant.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Traced<'r> {
    /// Its value where the numbers are arbitrary ones between 1 and 2: what is zero for these is zero for all.
    sample: DoubleDouble,
    node: Option<(&'r Recorder, usize)>,
}

impl PartialEq for Traced<'_> {
    /// Whether both are made alike.
    fn eq(&self, other: &Self) -> bool {
        self.sample == other.sample && self.node.map(|own| own.1) == other.node.map(|own| own.1)
    }
}

impl Recorder {
    /// The number of a network at this place among them.
    pub(super) fn number(&self, at: usize) -> Traced<'_> {
        let sample = 1.0 + Stream::new(at as u64).share();
        Traced { sample: sample.into(), node: Some((self, self.place(Node::Number(at)))) }
    }

    /// All that was recorded, and whether each is needed for what is asked for.
    pub(super) fn nodes(&self) -> Vec<(Node, bool)> {
        let mut nodes: Vec<_> = self.nodes.borrow().iter().map(|&node| (node, false)).collect();
        self.results.borrow().iter().for_each(|&at| nodes[at].1 = true);
        for at in (0..nodes.len()).rev() {
            if let (Node::Done(_, operands), true) = nodes[at] {
                operands.into_iter().for_each(|operand| nodes[operand].1 = true);
            }
        }
        nodes
    }

    fn place(&self, node: Node) -> usize {
        let mut nodes = self.nodes.borrow_mut();
        nodes.iter().position(|own| *own == node).unwrap_or_else(|| {
            nodes.push(node);
            nodes.len() - 1
        })
    }
}

impl Traced<'_> {
    fn is_constant(self, value: f64) -> bool {
        self.node.is_none() && self.sample == DoubleDouble::from(value)
    }

    /// Asks for its value, and tells where it stands among the nodes; `None` where it is no number.
    pub(super) fn asked(self, recorder: &Recorder) -> Option<usize> {
        let place = self.sample.high().is_finite().then(|| self.place(recorder))?;
        recorder.results.borrow_mut().push(place);
        Some(place)
    }

    fn place(self, recorder: &Recorder) -> usize {
        match self.node {
            Some((_, place)) => place,
            None => recorder.place(Node::Constant(self.sample.high())),
        }
    }

    /// What two become together, which is `sample` in the sample.
    fn with(self, kind: Kind, other: Self, sample: DoubleDouble) -> Self {
        let recorder = self.node.or(other.node).map(|node| node.0);
        let node = recorder.map(|recorder| {
            let operands = [self.place(recorder), other.place(recorder)];
            (recorder, recorder.place(Node::Done(kind, operands)))
        });
        Self { sample, node }
    }
}

impl From<f64> for Traced<'_> {
    fn from(value: f64) -> Self {
        Self { sample: value.into(), node: None }
    }
}

impl Add for Traced<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self, other) {
            (zero, own) | (own, zero) if zero.is_constant(0.0) => own,
            _ => self.with(Kind::Sum, other, self.sample + other.sample),
        }
    }
}

impl Mul for Traced<'_> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        match (self, other) {
            (zero, _) | (_, zero) if zero.is_constant(0.0) => zero,
            (one, own) | (own, one) if one.is_constant(1.0) => own,
            _ => self.with(Kind::Product, other, self.sample * other.sample),
        }
    }
}

impl Div for Traced<'_> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let place = |own: Self| own.node.map(|node| node.1);
        match place(self) {
            _ if self.is_constant(0.0) => self,
            Some(own) if place(other) == Some(own) => Self::ONE,
            _ => self.with(Kind::Quotient, other, self.sample / other.sample),
        }
    }
}

impl Mul<f64> for Traced<'_> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        self * Self::from(factor)
    }
}

impl Sum for Traced<'_> {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

impl Coefficient for Traced<'_> {
    const ONE: Self = Self { sample: DoubleDouble::ONE, node: None };
    const NOTHING: f64 = DoubleDouble::NOTHING;

    fn rounded(self) -> f64 {
        self.sample.high()
    }
}
