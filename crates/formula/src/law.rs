//! From tree to numbers: dimensions are checked, names replaced, constants folded.

use dashpot_units::{Dimension, Quantity};

use crate::{
    Expression, Formula, FormulaError, FormulaFault, Function,
    tree::{Kind, Node, Operator},
};

/// A name that is not a constant: its word and its dimension.
pub type Variable = (&'static str, Dimension);

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meaning {
    /// A quantity.
    Quantity(Quantity),
    /// The variable of this number, of this dimension.
    Variable(usize, Dimension),
}

/// A part of a formula in SI units.
struct Part {
    expression: Expression,
    /// `None` of numbers without a unit.
    dimension: Option<Dimension>,
    angle: i8,
}

impl Part {
    fn dimension(&self) -> Dimension {
        self.dimension.unwrap_or(Dimension::NUMBER)
    }

    /// Whether it is a plain 0, which fits every dimension.
    fn is_zero(&self) -> bool {
        self.dimension.is_none() && self.expression.constant() == Some(0.0)
    }
}

impl Formula {
    /// Its value where every name is a quantity; without a dimension where no unit is in it.
    ///
    /// # Errors
    ///
    /// [`FormulaError`] where a name is not known, dimensions do not fit, or a part has no finite value.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_formula::Formula;
    /// use dashpot_units::{Dimension, parse_quantity};
    ///
    /// let force = Formula::parse("2 * A * 100 kPa", &|name| name == "A")?;
    /// let area = parse_quantity("50 cm^2").ok();
    /// let force = force.quantity(&|_| area)?;
    /// assert_eq!(force.dimension, Some(Dimension::FORCE));
    /// assert!((force.value - 1000.0).abs() < 1e-12);
    /// # Ok::<(), dashpot_formula::FormulaError>(())
    /// ```
    pub fn quantity(
        &self,
        named: &dyn Fn(&str) -> Option<Quantity>,
    ) -> Result<Quantity, FormulaError> {
        let part = part(&self.root, &|name| named(name).map(Meaning::Quantity))?;
        // Without variables there is nothing but a constant.
        let value = part.expression.constant().unwrap_or(f64::NAN);
        let (dimension, angle) = (part.dimension, part.angle);
        Ok(Quantity { dimension, angle, ..Quantity::of(value, Dimension::NUMBER) })
    }

    /// The dimension of its value over `variables`.
    ///
    /// # Errors
    ///
    /// As [`quantity`](Self::quantity).
    pub fn dimension(&self, variables: &[Variable]) -> Result<Dimension, FormulaError> {
        Ok(part(&self.root, &among(variables))?.dimension())
    }

    /// The law over `variables`, whose value is to have the dimension `expected`, in SI units.
    ///
    /// # Errors
    ///
    /// As [`quantity`](Self::quantity), and where the result has another dimension.
    pub fn law(
        &self,
        variables: &[Variable],
        expected: Dimension,
    ) -> Result<Expression, FormulaError> {
        let part = part(&self.root, &among(variables))?;
        let found = part.dimension();
        if found != expected && !part.is_zero() {
            let fault = FormulaFault::Dimension { found, expected };
            return Err(FormulaError { fault, span: self.root.span.clone() });
        }
        Ok(part.expression)
    }
}

/// What names stand for that are variables.
fn among(variables: &[Variable]) -> impl Fn(&str) -> Option<Meaning> + '_ {
    |name| {
        let at = variables.iter().position(|own| own.0 == name)?;
        Some(Meaning::Variable(at, variables[at].1))
    }
}

impl Node {
    fn error(&self, fault: FormulaFault) -> FormulaError {
        FormulaError { fault, span: self.span.clone() }
    }

    fn text(&self) -> String {
        Formula { root: std::sync::Arc::new(self.clone()) }.to_string()
    }
}

fn part(node: &Node, meaning: &dyn Fn(&str) -> Option<Meaning>) -> Result<Part, FormulaError> {
    let found = match &node.kind {
        Kind::Number(own) => of_quantity(*own),
        Kind::Name(name) => match meaning(name) {
            Some(Meaning::Quantity(own)) => of_quantity(own),
            Some(Meaning::Variable(at, dimension)) => {
                Part { expression: Expression::variable(at), dimension: Some(dimension), angle: 0 }
            }
            None => return Err(node.error(FormulaFault::UnknownName { name: name.clone() })),
        },
        Kind::Negative(inner) => {
            let inner = part(inner, meaning)?;
            Part { expression: inner.expression.negative(), ..inner }
        }
        Kind::Binary(Operator::Power, [base, exponent]) => {
            raised(node, [base, exponent], [part(base, meaning)?, part(exponent, meaning)?])?
        }
        Kind::Binary(operator, [left, right]) => {
            let parts = [part(left, meaning)?, part(right, meaning)?];
            combined(node, *operator, [left, right], parts)?
        }
        Kind::Call(function, inner) => {
            let parts = inner.iter().map(|own| part(own, meaning));
            called(node, *function, inner, parts.collect::<Result<Vec<_>, _>>()?)?
        }
    };
    match found.expression.constant() {
        Some(value) if !value.is_finite() => {
            Err(node.error(FormulaFault::NotFinite { text: node.text() }))
        }
        _ => Ok(found),
    }
}

fn of_quantity(own: Quantity) -> Part {
    let expression = Expression::number(own.value);
    Part { expression, dimension: own.dimension, angle: own.angle }
}

/// The dimension of two parts that are added or compared.
fn alike(
    node: &Node,
    nodes: [&Node; 2],
    parts: &[Part; 2],
    verb: &'static str,
) -> Result<Option<Dimension>, FormulaError> {
    let [left, right] = parts;
    if right.is_zero() || left.dimension == right.dimension {
        return Ok(left.dimension);
    }
    if left.is_zero() {
        return Ok(right.dimension);
    }
    if left.dimension() == right.dimension() {
        return Ok(Some(left.dimension()));
    }
    let [left_text, right_text] = nodes.map(Node::text);
    Err(node.error(FormulaFault::Unlike {
        left: left_text,
        left_is: left.dimension(),
        right: right_text,
        right_is: right.dimension(),
        verb,
    }))
}

fn combined(
    node: &Node,
    operator: Operator,
    nodes: [&Node; 2],
    parts: [Part; 2],
) -> Result<Part, FormulaError> {
    let out_of_range = || node.error(FormulaFault::NotFinite { text: node.text() });
    Ok(match operator {
        Operator::Plus | Operator::Minus => {
            let verb = if operator == Operator::Plus { "added" } else { "subtracted" };
            let dimension = alike(node, nodes, &parts, verb)?;
            let [left, right] = parts;
            let angle = left.angle.max(right.angle);
            let expression = match operator {
                Operator::Plus => left.expression.plus(&right.expression),
                _ => left.expression.minus(&right.expression),
            };
            Part { expression, dimension, angle }
        }
        _ => {
            let [left, right] = parts;
            let sign = if operator == Operator::Over { -1 } else { 1 };
            let dimension = match (left.dimension, right.dimension) {
                (None, None) => None,
                _ => Some(
                    left.dimension()
                        .times(right.dimension(), f64::from(sign))
                        .ok_or_else(out_of_range)?,
                ),
            };
            let expression = match operator {
                Operator::Over => left.expression.over(&right.expression),
                _ => left.expression.times(&right.expression),
            };
            let angle = left.angle.saturating_add(sign * right.angle);
            Part { expression, dimension, angle }
        }
    })
}

fn pure(node: &Node, part: &Part) -> Result<(), FormulaError> {
    match part.dimension() {
        Dimension::NUMBER => Ok(()),
        found => Err(node.error(FormulaFault::NotPure { text: node.text(), found })),
    }
}

fn raised(node: &Node, nodes: [&Node; 2], parts: [Part; 2]) -> Result<Part, FormulaError> {
    let [base, exponent] = parts;
    pure(nodes[1], &exponent)?;
    let dimension = match (base.dimension, exponent.expression.constant()) {
        (None | Some(Dimension::NUMBER), _) => base.dimension,
        (Some(own), power) => {
            let found = power.and_then(|power| Dimension::NUMBER.times(own, power));
            let fault = || FormulaFault::Power { text: node.text(), base: own };
            Some(found.ok_or_else(|| node.error(fault()))?)
        }
    };
    Ok(Part { expression: base.expression.to_the(&exponent.expression), dimension, angle: 0 })
}

fn called(
    node: &Node,
    function: Function,
    nodes: &[std::sync::Arc<Node>],
    parts: Vec<Part>,
) -> Result<Part, FormulaError> {
    let parts = match <[Part; 2]>::try_from(parts) {
        Ok(both) => {
            let [first, second] = [&*nodes[0], &*nodes[1]];
            let dimension = alike(node, [first, second], &both, "compared")?;
            let [left, right] = both;
            let expression = left.expression.called_with(function, &right.expression);
            return Ok(Part { expression, dimension, angle: left.angle.max(right.angle) });
        }
        Err(parts) => parts,
    };
    let Some(inner) = parts.into_iter().next() else {
        return Err(node.error(FormulaFault::NotFinite { text: node.text() }));
    };
    let (dimension, angle) = match function {
        Function::Abs => (inner.dimension, inner.angle),
        Function::Sqrt => match inner.dimension {
            None => (None, 0),
            Some(own) => {
                let fault = || FormulaFault::Power { text: node.text(), base: own };
                (Some(Dimension::NUMBER.times(own, 0.5).ok_or_else(|| node.error(fault()))?), 0)
            }
        },
        _ => {
            pure(&nodes[0], &inner)?;
            (None, 0)
        }
    };
    Ok(Part { expression: inner.expression.called(function), dimension, angle })
}
