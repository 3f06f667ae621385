//! Tables in Markdown of all that the registers hold.

use std::fmt::Write as _;

use dashpot::{
    analysis::measures::{Family, MeasureKind, MeasureVisitor, visit_measures},
    dae::methods,
    network::{
        composites::{CompositeKind, CompositeVisitor, visit_composites},
        effects::{EffectKind, EffectVisitor, visit_effects},
        elements::{ElementKind, ElementVisitor, visit_elements},
        parameters::{Dimension, Parameter, ParameterKind},
        shifts::{ShiftKind, ShiftVisitor, visit_shifts},
        waveforms::{WaveformKind, WaveformVisitor, visit_waveforms},
    },
    rheology::{Form, FormVisitor, Part, Role, visit_forms},
};

/// Name and text of every generated section.
pub(super) fn sections() -> Vec<(&'static str, String)> {
    let mut kinds = Kinds::default();
    visit_elements(&mut kinds);
    let elements = kinds.take("word | law");
    visit_composites(&mut kinds);
    let composites = kinds.take("word | model");
    visit_shifts(&mut kinds);
    let shifts = kinds.take("word | law");
    visit_waveforms(&mut kinds);
    let waveforms = kinds.take("word | function");
    visit_effects(&mut kinds);
    let effects = kinds.take("word | what it does");
    visit_measures(&mut kinds);
    let measures = kinds.take("word | of | unit | in every run | what it is");
    visit_forms(&mut kinds);
    let forms = kinds.take("word | other words | made of | parts, in order");
    for method in methods::all() {
        kinds.row(&[code(method.name()), method.summary().to_owned()]);
    }
    vec![
        ("elements", elements),
        ("forms", forms),
        ("composites", composites),
        ("shifts", shifts),
        ("functions", waveforms),
        ("effects", effects),
        ("measures", measures),
        ("methods", kinds.take("word | what it is good for")),
    ]
}

/// The rows of one family, and its parameters with the words of the kinds that have them.
#[derive(Default)]
struct Kinds {
    rows: String,
    words: Vec<&'static str>,
    parameters: Vec<(Parameter, Option<Dimension>, Vec<&'static str>)>,
}

impl Kinds {
    fn row(&mut self, cells: &[String]) {
        self.rows += &row(cells);
    }

    /// The parameters of a kind, and the dimension of their amplitudes where it is fixed.
    fn parameters(
        &mut self,
        kind: &'static str,
        parameters: &[Parameter],
        amplitude: Option<Dimension>,
    ) {
        self.words.push(kind);
        for own in parameters {
            let is_own =
                |known: &(Parameter, Option<Dimension>, _)| (known.0, known.1) == (*own, amplitude);
            match self.parameters.iter_mut().find(|known| is_own(known)) {
                Some((.., kinds)) => kinds.push(kind),
                None => self.parameters.push((*own, amplitude, vec![kind])),
            }
        }
    }

    /// The tables of the family, and none of it left.
    fn take(&mut self, header: &str) -> String {
        let Self { rows, words, parameters } = std::mem::take(self);
        let mut text = format!("| {header} |\n{}\n{rows}", rule(header.split('|').count()));
        if parameters.is_empty() {
            return text;
        }
        text += "\n| of | key | value | default | meaning |\n|---|---|---|---|---|\n";
        for (parameter, amplitude, kinds) in parameters {
            text += &row(&[
                owners(&words, &kinds),
                code(parameter.name),
                value(parameter.kind, amplitude),
                default(&parameter),
                parameter.help.to_owned(),
            ]);
        }
        text
    }
}

/// The kinds that have a parameter; of many kinds rather those that do not.
fn owners(all: &[&str], some: &[&str]) -> String {
    let listed = |words: &[&str]| words.iter().map(code).collect::<Vec<_>>().join(", ");
    if some.len() < all.len().max(5) / 2 || all.len() == some.len() {
        return listed(some);
    }
    let others: Vec<&str> = all.iter().copied().filter(|word| !some.contains(word)).collect();
    format!("all but {}", listed(&others))
}

fn rule(columns: usize) -> String {
    "|---".repeat(columns) + "|"
}

fn row(cells: &[String]) -> String {
    let mut row = String::new();
    for cell in cells {
        let _ = write!(row, "| {} ", cell.replace('|', "\\|"));
    }
    row + "|\n"
}

fn default(parameter: &Parameter) -> String {
    match parameter.default {
        None => "required".to_owned(),
        Some(from) if parameter.follows => from.to_owned(),
        Some(value) => code(value),
    }
}

fn code(word: impl AsRef<str>) -> String {
    format!("`{}`", word.as_ref())
}

fn value(kind: ParameterKind, amplitude: Option<Dimension>) -> String {
    let quantity = |dimension: Dimension| match dimension.named() {
        Some((name, "1")) => name.to_owned(),
        Some((name, unit)) => format!("{name} [{unit}]"),
        None => "number".to_owned(),
    };
    match (kind, amplitude) {
        (ParameterKind::Amplitude, Some(dimension)) => return quantity(dimension),
        (ParameterKind::TimeTable, Some(dimension)) => {
            return format!("list of pairs `[time, {}]`", quantity(dimension));
        }
        _ => {}
    }
    match kind {
        ParameterKind::Quantity(dimension) => quantity(dimension),
        ParameterKind::TemperatureDifference => "temperature difference [K]".to_owned(),
        ParameterKind::Amplitude => "force [N] in a load, length [m] in a motion".to_owned(),
        ParameterKind::TimeTable => "list of points `[time, value]`".to_owned(),
        ParameterKind::Curve(first, second) => {
            format!("list of points `[{}, {}]`", quantity(first), quantity(second))
        }
        ParameterKind::Choice(words) => words.iter().map(code).collect::<Vec<_>>().join(" or "),
        ParameterKind::Flag => "`true`".to_owned(),
        ParameterKind::Window => "`\"impact\"`, `\"run\"` or `[from, to]`".to_owned(),
        ParameterKind::Node => "name of a node".to_owned(),
        ParameterKind::Model => "a model: its name, or a table".to_owned(),
    }
}

impl ElementVisitor for Kinds {
    fn visit<E: ElementKind>(&mut self) {
        self.row(&[code(E::KIND), E::SUMMARY.to_owned()]);
        self.parameters(E::KIND, E::PARAMETERS, None);
    }
}

impl CompositeVisitor for Kinds {
    fn visit<C: CompositeKind>(&mut self) {
        self.row(&[code(C::KIND), C::SUMMARY.to_owned()]);
        self.parameters(C::KIND, C::PARAMETERS, Some(C::AMPLITUDE));
    }
}

impl ShiftVisitor for Kinds {
    fn visit<S: ShiftKind>(&mut self) {
        self.row(&[code(S::KIND), S::SUMMARY.to_owned()]);
        self.parameters(S::KIND, S::PARAMETERS, None);
    }
}

impl WaveformVisitor for Kinds {
    fn visit<W: WaveformKind>(&mut self) {
        self.row(&[code(W::KIND), W::SUMMARY.to_owned()]);
        self.parameters(W::KIND, W::PARAMETERS, None);
    }
}

impl EffectVisitor for Kinds {
    fn visit<E: EffectKind>(&mut self) {
        self.row(&[code(E::KIND), E::SUMMARY.to_owned()]);
        self.parameters(E::KIND, E::PARAMETERS, None);
    }
}

impl MeasureVisitor for Kinds {
    fn visit<M: MeasureKind>(&mut self) {
        let family = match M::APPLIES_TO {
            Family::Element => "an element",
            Family::Node => "a node",
        };
        let always = if M::BY_DEFAULT { "yes" } else { "" };
        self.row(&[
            code(M::KIND),
            family.to_owned(),
            M::UNIT.to_owned(),
            always.to_owned(),
            M::SUMMARY.to_owned(),
        ]);
        self.parameters(M::KIND, M::PARAMETERS, None);
    }
}

impl FormVisitor for Kinds {
    fn visit<F: Form>(&mut self) {
        let aliases: Vec<String> = F::ALIASES.iter().map(code).collect();
        self.row(&[
            code(F::KIND),
            aliases.join(", "),
            F::SUMMARY.to_owned(),
            code(parts(F::PARTS)),
        ]);
    }
}

fn parts(all: &[Part]) -> String {
    let part = |part: &Part| match part.role {
        Role::Spring => format!("{} = [N/m]", part.name),
        Role::Dashpot => format!("{} = [N s/m]", part.name),
        Role::Form { parts: inner, .. } => format!("{} = {}", part.name, parts(inner)),
    };
    format!("{{ {} }}", all.iter().map(part).collect::<Vec<_>>().join(", "))
}
