//! The tree of a formula.

use std::{fmt, ops::Range, sync::Arc};

use dashpot_units::{Dimension, Quantity, exact_quantity};

use crate::Function;

/// A formula as it was written: numbers with units, names, operations.
///
/// Two are equal where their trees are, whatever the spaces. It is written with those parentheses only that it
/// needs, and read back as the same.
#[derive(Clone, PartialEq)]
pub struct Formula {
    pub(crate) root: Arc<Node>,
}

/// A part of a formula and its bytes in the text.
#[derive(Clone)]
pub(crate) struct Node {
    pub(crate) kind: Kind,
    pub(crate) span: Range<usize>,
}

#[derive(Clone, PartialEq)]
pub(crate) enum Kind {
    Number(Quantity),
    Name(String),
    Negative(Arc<Node>),
    Binary(Operator, [Arc<Node>; 2]),
    Call(Function, Vec<Arc<Node>>),
}

dashpot_units::words! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(crate) enum Operator, fn symbol(self) {
        Plus = " + ",
        Minus = " - ",
        Times = " * ",
        Over = " / ",
        Power = "^",
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}

impl Formula {
    /// The names in it, in the order of the text.
    pub fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        self.root.names(&mut names);
        names
    }

    /// The same with each name for which `quantity` has one replaced by that.
    #[must_use]
    pub fn with(&self, quantity: &dyn Fn(&str) -> Option<Quantity>) -> Self {
        let replaced = |name: &str| quantity(name).map(Kind::Number);
        Self { root: self.root.replaced(&replaced) }
    }

    /// The same with other numbers, by dimension and value in SI units, which are asked for in the order of the text.
    /// A number without a unit stays one.
    #[must_use]
    pub fn renumbered(&self, by: &mut dyn FnMut(Dimension, f64) -> (Dimension, f64)) -> Self {
        Self { root: self.root.renumbered(by) }
    }

    /// `factor` times the same of other variables: each one of `names` divided by `unit`. That makes of a law of
    /// stress over strain one of force over deformation.
    #[must_use]
    pub fn scaled(&self, factor: Quantity, names: &[&str], unit: Quantity) -> Self {
        let node = |kind| Arc::new(Node { kind, span: self.root.span.clone() });
        let number = |own: Quantity| node(Kind::Number(own));
        let over = |name: &str| {
            let variable = node(Kind::Name(name.to_owned()));
            Kind::Binary(Operator::Over, [variable, number(unit)])
        };
        let inner = self.root.replaced(&|name| names.contains(&name).then(|| over(name)));
        Self { root: node(Kind::Binary(Operator::Times, [number(factor), inner])) }
    }
}

impl Node {
    fn parts(&self) -> &[Arc<Self>] {
        match &self.kind {
            Kind::Number(_) | Kind::Name(_) => &[],
            Kind::Negative(inner) => std::slice::from_ref(inner),
            Kind::Binary(_, parts) => parts,
            Kind::Call(_, parts) => parts,
        }
    }

    fn renumbered(&self, by: &mut dyn FnMut(Dimension, f64) -> (Dimension, f64)) -> Arc<Self> {
        let kind = match &self.kind {
            Kind::Name(_) => self.kind.clone(),
            Kind::Number(own) => {
                let (dimension, value) = by(own.dimension.unwrap_or(Dimension::NUMBER), own.value);
                let dimension = own.dimension.is_some().then_some(dimension);
                Kind::Number(Quantity { value, dimension, ..*own })
            }
            Kind::Negative(inner) => Kind::Negative(inner.renumbered(by)),
            Kind::Binary(operator, parts) => {
                Kind::Binary(*operator, parts.each_ref().map(|part| part.renumbered(by)))
            }
            Kind::Call(function, parts) => {
                Kind::Call(*function, parts.iter().map(|part| part.renumbered(by)).collect())
            }
        };
        Arc::new(Self { kind, span: self.span.clone() })
    }

    fn names<'n>(&'n self, names: &mut Vec<&'n str>) {
        if let Kind::Name(name) = &self.kind {
            names.push(name);
        }
        self.parts().iter().for_each(|part| part.names(names));
    }

    fn replaced(&self, by: &dyn Fn(&str) -> Option<Kind>) -> Arc<Self> {
        let kind = match &self.kind {
            Kind::Name(name) => by(name).unwrap_or_else(|| self.kind.clone()),
            Kind::Number(_) => self.kind.clone(),
            Kind::Negative(inner) => Kind::Negative(inner.replaced(by)),
            Kind::Binary(operator, parts) => {
                Kind::Binary(*operator, parts.each_ref().map(|part| part.replaced(by)))
            }
            Kind::Call(function, parts) => {
                Kind::Call(*function, parts.iter().map(|part| part.replaced(by)).collect())
            }
        };
        Arc::new(Self { kind, span: self.span.clone() })
    }
}

impl Operator {
    /// How tightly it binds.
    const fn rank(self) -> u8 {
        match self {
            Self::Plus | Self::Minus => 0,
            Self::Times | Self::Over => 1,
            Self::Power => 3,
        }
    }
}

/// Rank of a sign.
const SIGN: u8 = 2;
/// Rank of what needs no parentheses.
const ATOM: u8 = 4;

/// A part as text: how tightly its outermost operation binds, and whether it ends in a unit.
struct Written {
    text: String,
    rank: u8,
    ends_in_unit: bool,
}

impl Written {
    /// The text, in parentheses where it binds less tightly than `rank`.
    fn within(self, rank: u8) -> String {
        if self.rank < rank { format!("({})", self.text) } else { self.text }
    }
}

impl Node {
    fn written(&self) -> Written {
        let of = |text, rank, ends_in_unit| Written { text, rank, ends_in_unit };
        match &self.kind {
            Kind::Number(own) => {
                let dimension = own.dimension.unwrap_or(Dimension::NUMBER);
                let text = exact_quantity(own.value, dimension);
                let has_unit = dimension != Dimension::NUMBER;
                let rank = if own.value < 0.0 { SIGN } else { ATOM };
                // A unit takes the power behind it.
                of(text, if has_unit { rank.min(SIGN) } else { rank }, has_unit)
            }
            Kind::Name(name) => of(name.clone(), ATOM, false),
            Kind::Negative(inner) => of(format!("-{}", inner.written().within(SIGN)), SIGN, false),
            Kind::Binary(operator, [left, right]) => {
                let (rank, left, right) = (operator.rank(), left.written(), right.written());
                let ends_in_unit = right.ends_in_unit;
                let left = match operator {
                    // Behind a unit, `/` may go on with it.
                    Operator::Over if left.ends_in_unit => format!("({})", left.text),
                    Operator::Power => left.within(rank + 1),
                    _ => left.within(rank),
                };
                let right = match operator {
                    Operator::Plus => right.within(rank),
                    Operator::Power => right.within(SIGN),
                    _ => right.within(rank + 1),
                };
                of(format!("{left}{}{right}", operator.symbol()), rank, ends_in_unit)
            }
            Kind::Call(function, parts) => {
                let parts: Vec<String> = parts.iter().map(|part| part.written().text).collect();
                of(format!("{}({})", function.word(), parts.join(", ")), ATOM, false)
            }
        }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.root.written().text)
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Formula({self})")
    }
}
