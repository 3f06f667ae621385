//! Models and kinds as TOML text that is read back equal, to the last bit.

use std::collections::HashMap;

use dashpot_network::{
    Element, Model,
    parameters::{Dimension, Parameter, ParameterKind, Value, WindowWish},
};
use dashpot_rheology::{Branch, Tree};

use crate::{kinds::registers, units::exact_quantity};

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
    enum Step<'m> {
        Table(&'m Model, Option<&'m str>),
        Text(&'static str),
        Name(Option<&'m str>),
    }
    let mut text = String::new();
    // Models nest without limit, so the way back is kept here and not on the stack.
    let mut steps = vec![Step::Table(model, None)];
    while let Some(step) = steps.pop() {
        match step {
            Step::Text(own) => text.push_str(own),
            Step::Name(Some(name)) => {
                text.push_str(", name = ");
                text.push_str(&quoted(name));
            }
            Step::Name(None) => {}
            Step::Table(tree, name) => {
                text.push_str("{ ");
                steps.extend([Step::Text(" }"), Step::Name(name)]);
                let (word, branches) = match tree {
                    Tree::Part(element) => {
                        text.push_str(&write_element(element.as_ref()));
                        continue;
                    }
                    Tree::Series(branches) => ("series = [", branches),
                    Tree::Parallel(branches) => ("parallel = [", branches),
                };
                text.push_str(word);
                steps.push(Step::Text("]"));
                let named = !has_plain_names(branches);
                for (at, branch) in branches.iter().enumerate().rev() {
                    let name = named.then_some(branch.name.as_str());
                    steps.push(Step::Table(&branch.tree, name));
                    if at > 0 {
                        steps.push(Step::Text(", "));
                    }
                }
            }
        }
    }
    text
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
    let pairs = parameters.iter().zip(values);
    if let ([parameter], [value]) = (parameters, values)
        && parameter.default.is_none()
    {
        return format!("{word} = {}", write_value(parameter.kind, value, driven));
    }
    let written = pairs.map(|(parameter, value)| {
        format!("{} = {}", parameter.name, write_value(parameter.kind, value, driven))
    });
    format!("{word} = {{ {} }}", written.collect::<Vec<_>>().join(", "))
}

fn write_element(element: &dyn Element) -> String {
    let parameters = registers().element(element.kind()).map_or(&[][..], |kind| kind.parameters);
    write_kind(element.kind(), parameters, &element.values(), Dimension::FORCE)
}

fn write_value(kind: ParameterKind, value: &Value, driven: Dimension) -> String {
    let quantity = |value: f64, dimension| quoted(&exact_quantity(value, dimension));
    let time = |time: f64| quantity(time, Dimension::TIME);
    match value {
        Value::Number(number) => match kind {
            ParameterKind::Quantity(Dimension::NUMBER) => format!("{number:?}"),
            ParameterKind::Quantity(dimension) => quantity(*number, dimension),
            _ => quantity(*number, driven),
        },
        Value::Table(points) => {
            let points = points
                .iter()
                .map(|&(at, value)| format!("[{}, {}]", time(at), quantity(value, driven)));
            format!("[{}]", points.collect::<Vec<_>>().join(", "))
        }
        Value::Word(word) => quoted(word),
        Value::Flag => "true".to_owned(),
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

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
