//! Models and kinds as TOML text that is read back equal, to the last bits.

pub(crate) mod limits;
pub(crate) mod references;
pub(crate) mod rewrite;
pub(crate) mod scene;

use std::collections::HashMap;

use dashpot_network::{
    Effect, Element, Model,
    parameters::{Dimension, Formula, Parameter, ParameterKind, Value, WindowWish},
};
use dashpot_rheology::{Branch, Tree};
use dashpot_units::{Quantity, exact_quantity, tidy};

use crate::quantities::basis::{Basis, is_size};

/// A model as an inline table, for instance `{ parallel = [{ spring = "20 MN/m" }, …] }`.
///
/// # Examples
///
/// ```
/// use dashpot_network::{elements::{Dashpot, Spring}, part};
/// use dashpot_rheology::Tree;
/// use dashpot_scene::write_model;
///
/// let pad = Tree::series([part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 6e3 })]);
/// assert!(write_model(&pad).starts_with("{ series = [{ spring = \"20 MN/m\", name = \"1\" }, "));
/// ```
pub fn write_model(model: &Model) -> String {
    format!("{{ {} }}", law(model, Basis::Model, false))
}

/// A model as a table `[models.NAME]` with one branch on each line, below comment lines.
///
/// # Examples
///
/// ```
/// use dashpot_network::{elements::{Dashpot, Spring}, part};
/// use dashpot_rheology::{Branch, Tree};
/// use dashpot_scene::write_model_table;
///
/// let pad = Tree::Parallel(vec![
///     Branch::new("spring", part(Spring { stiffness: 2e7 })),
///     Branch::new("rest", part(Dashpot { damping: 6e3 })),
/// ]);
/// let text = write_model_table("pad", &pad, &["relaxes within 1 ms".to_owned()]);
/// assert_eq!(
///     text,
///     r#"# relaxes within 1 ms
/// [models.pad]
/// parallel = [
///   { spring = "20 MN/m", name = "spring" },
///   { dashpot = "6 kN s/m", name = "rest" },
/// ]
/// "#
/// );
/// ```
pub fn write_model_table(name: &str, model: &Model, comments: &[String]) -> String {
    table("models", name, model, Basis::Model, comments)
}

/// A material as a table `[materials.NAME]` with one branch on each line, below comment lines.
///
/// `model` has the values of a pad of 1 m² that is 1 m thick, as in
/// [`NamedModel`](crate::NamedModel): its stiffnesses in N/m are the moduli in Pa.
pub fn write_material_table(name: &str, model: &Model, comments: &[String]) -> String {
    table("materials", name, model, Basis::MATERIAL, comments)
}

fn table(section: &str, name: &str, model: &Model, basis: Basis, comments: &[String]) -> String {
    comment_lines(comments) + &format!("[{section}.{}]\n{}\n", key(name), law(model, basis, true))
}

/// Comments, each of their lines with its mark.
pub(crate) fn comment_lines(comments: &[String]) -> String {
    let mut text = String::new();
    for line in comments.iter().flat_map(|comment| comment.lines()) {
        // Other control characters may not stand in a comment.
        let line = line.replace(char::is_control, " ");
        text.push_str(if line.is_empty() { "#" } else { "# " });
        text.push_str(&line);
        text.push('\n');
    }
    text
}

pub(crate) fn key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    if !name.is_empty() && name.chars().all(is_bare) { name.to_owned() } else { quoted(name) }
}

/// A model by its law: `spring = "20 MN/m"`, `series = […]`; `in_lines` gives each of the outer
/// branches a line of its own.
pub(crate) fn law(model: &Model, basis: Basis, in_lines: bool) -> String {
    let (word, branches) = match model {
        Tree::Part(element) => return write_element(element.as_ref(), basis),
        Tree::Series(branches) => ("series", branches),
        Tree::Parallel(branches) => ("parallel", branches),
    };
    let has_plain_names = has_plain_names(branches);
    let branches = branches.iter().map(|branch| {
        let law = law(&branch.tree, basis, false);
        let name = if has_plain_names {
            String::new()
        } else {
            format!(", name = {}", quoted(&branch.name))
        };
        format!("{{ {law}{name} }}")
    });
    if in_lines {
        let lines = branches.map(|branch| format!("  {branch},\n")).collect::<Vec<_>>();
        format!("{word} = [\n{}]", lines.concat())
    } else {
        format!("{word} = [{}]", branches.collect::<Vec<_>>().join(", "))
    }
}

/// A kind with its values as `word = …`; `driven` is the dimension of amplitudes.
///
/// The values are those for `parameters`, in their order.
pub fn write_kind(
    word: &str,
    parameters: &[Parameter],
    values: &[Value],
    driven: Dimension,
) -> String {
    write_kind_in(Basis::Model, (word, parameters, values), driven)
}

fn write_kind_in(
    basis: Basis,
    (word, parameters, values): (&str, &[Parameter], &[Value]),
    driven: Dimension,
) -> String {
    let mut required = parameters.iter().zip(values).filter(|own| own.0.default.is_none());
    let others = parameters.iter().zip(values).filter(|own| own.0.default.is_some());
    let is_alone = others.clone().all(|other| *other.1 == Value::LeftOut);
    // A model is a table itself, which would be read as that of the parameters.
    if let (Some((parameter, value)), None) = (required.next(), required.next())
        && is_alone
        && (parameters.len() == 1 || !matches!(value, Value::Model(_)))
    {
        return format!("{word} = {}", write_parameter(basis, parameter, value, driven));
    }
    format!("{word} = {{ {} }}", write_pairs(basis, parameters, values, driven).join(", "))
}

/// The values of parameters as `name = …`, each; those that follow from the rest of a scene are left out.
pub(crate) fn write_pairs(
    basis: Basis,
    parameters: &[Parameter],
    values: &[Value],
    driven: Dimension,
) -> Vec<String> {
    let is_given = |(parameter, value): &(&Parameter, &Value)| {
        **value != Value::LeftOut && !(basis.is_material() && is_size(parameter))
    };
    let given = parameters.iter().zip(values).filter(is_given);
    let written = given.map(|(own, value)| {
        format!("{} = {}", own.name, write_parameter(basis, own, value, driven))
    });
    written.collect()
}

fn write_parameter(
    basis: Basis,
    parameter: &Parameter,
    value: &Value,
    driven: Dimension,
) -> String {
    if let Value::Formula(formula) = value {
        return quoted(&written_formula(basis, parameter.kind, formula, driven).to_string());
    }
    let (beside, dimension) = match parameter.kind {
        ParameterKind::Quantity(dimension) => (Dimension::TIME, dimension),
        ParameterKind::TemperatureDifference => (Dimension::TIME, Dimension::TEMPERATURE),
        ParameterKind::Curve(first, second) => (first, second),
        _ => (Dimension::TIME, driven),
    };
    write_value(value, basis.dimension(dimension), basis.dimension(beside))
}

/// A formula in the dimensions in which it is read: in those of a material, or with those of what is driven.
fn written_formula(
    basis: Basis,
    kind: ParameterKind,
    formula: &Formula,
    driven: Dimension,
) -> Formula {
    let own = formula.dimension(kind.variables()).unwrap_or(driven);
    if kind == ParameterKind::TimeFormula && own != driven {
        let one = Quantity::of(1.0, driven.over(own));
        return formula.scaled(one, &[], one);
    }
    formula.renumbered(&mut |dimension, value| (basis.dimension(dimension), value))
}

/// An effect as it stands under `[effects]`.
///
/// # Examples
///
/// ```
/// use dashpot_network::effects::Separation;
/// use dashpot_scene::write_effect;
///
/// let separation =
///     Separation { element: "padding".into(), at: Some("head".into()), restitution: 0.0 };
/// let written = write_effect(&separation);
/// assert_eq!(written, "separation.padding = { at = \"head\", restitution = 0.0 }");
/// ```
pub fn write_effect(effect: &dyn Effect) -> String {
    let word = effect.kind();
    let word = match effect.target() {
        Some(element) => format!("{word}.{}", key(element)),
        None => word.to_owned(),
    };
    write_kind(&word, effect.parameters(), &effect.values(), Dimension::FORCE)
}

fn write_element(element: &dyn Element, basis: Basis) -> String {
    let own = (element.kind(), element.parameters(), &*element.values());
    write_kind_in(basis, own, Dimension::FORCE)
}

/// A value; numbers, and the second ones of pairs, are of this dimension, the first ones of pairs of that `beside`.
fn write_value(value: &Value, dimension: Dimension, beside: Dimension) -> String {
    let quantity = |value: f64, dimension| match dimension {
        Dimension::NUMBER => format!("{:?}", tidy(value)),
        dimension => quoted(&exact_quantity(value, dimension)),
    };
    let time = |time: f64| quantity(time, Dimension::TIME);
    match value {
        Value::Number(number) => quantity(*number, dimension),
        Value::Table(points) => {
            let points = points.iter().map(|&(at, own)| {
                format!("[{}, {}]", quantity(at, beside), quantity(own, dimension))
            });
            format!("[{}]", points.collect::<Vec<_>>().join(", "))
        }
        Value::Word(word) => quoted(word),
        Value::Formula(formula) => quoted(&formula.to_string()),
        Value::Flag => "true".to_owned(),
        Value::LeftOut => String::new(),
        Value::Model(value) => value.model().map_or_else(String::new, write_model),
        Value::Window(WindowWish::Impact) => quoted("impact"),
        Value::Window(WindowWish::Run) => quoted("run"),
        Value::Window(WindowWish::Times(from, to)) => format!("[{}, {}]", time(*from), time(*to)),
    }
}

/// Whether a reader would give the branches these names by itself.
fn has_plain_names(branches: &[Branch<std::sync::Arc<dyn Element>>]) -> bool {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    branches.iter().all(|branch| {
        let word = match &branch.tree {
            Tree::Part(element) => element.kind(),
            Tree::Series(_) => "series",
            Tree::Parallel(_) => "parallel",
        };
        let count = counts.entry(word).or_default();
        *count += 1;
        match *count {
            1 => branch.name == word,
            count => branch.name == format!("{word}-{count}"),
        }
    })
}

pub(crate) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
