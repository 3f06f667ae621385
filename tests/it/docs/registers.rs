//! Tables in Markdown of all that the registers hold.

use std::fmt::Write as _;

use dashpot::{
    analysis::{
        limits::standards::STANDARDS,
        measures::{Family, MEASURES, MeasureEntry, STANDARD_GRAVITY},
    },
    dae::methods,
    network::{
        composites::COMPOSITES,
        effects::EFFECTS,
        elements::ELEMENTS,
        parameters::{Dimension, Parameter, ParameterKind, Registered},
        shifts::SHIFTS,
        waveforms::WAVEFORMS,
    },
    rheology::{FORMS, Part, Role},
};

/// Name and text of every generated section.
pub(super) fn sections() -> Vec<(&'static str, String)> {
    let mut kinds = Kinds::default();
    ELEMENTS.iter().for_each(|own| kinds.kind(own, None));
    let elements = kinds.take("word | law");
    COMPOSITES.iter().for_each(|own| kinds.kind(own, Some(own.about)));
    let composites = kinds.take("word | model");
    SHIFTS.iter().for_each(|own| kinds.kind(own, None));
    let shifts = kinds.take("word | law");
    WAVEFORMS.iter().for_each(|own| kinds.kind(own, None));
    let waveforms = kinds.take("word | function");
    EFFECTS.iter().for_each(|own| kinds.kind(own, None));
    let effects = kinds.take("word | what it does");
    MEASURES.iter().for_each(|own| kinds.measure(own));
    let measures = kinds.take("word | of | unit | in every run | what it is");
    for own in FORMS {
        let aliases: Vec<String> = own.aliases.iter().map(code).collect();
        let cells = [aliases.join(", "), own.summary.to_owned(), code(parts(own.parts))];
        kinds.row(&[[code(own.word)].as_slice(), &cells].concat());
    }
    let forms = kinds.take("word | other words | made of | parts, in order");
    for method in methods::all() {
        kinds.row(&[code(method.name()), method.summary().to_owned()]);
    }
    let methods = kinds.take("word | what it is good for");
    for own in STANDARDS {
        let bound = |&(most, of_mean): &(f64, bool)| {
            let of_mean = if of_mean { ", of the mean" } else { "" };
            let level = match (own.kinds[0], most) {
                ("peak-acceleration", own) => format!("{} g", own / STANDARD_GRAVITY),
                (kind, own) if kind.ends_with("force") => format!("{} kN", own / 1e3),
                (_, own) => own.to_string(),
            };
            format!("{level}{of_mean}")
        };
        let bounds: Vec<String> = own.bounds.iter().map(bound).collect();
        let kinds_of = own.kinds.iter().copied().map(code).collect::<Vec<_>>().join(" or ");
        let (bounds, test) = (bounds.join("; "), own.test.to_owned());
        kinds.row(&[
            code(own.word),
            own.edition.to_owned(),
            kinds_of,
            bounds,
            test,
            own.source.to_owned(),
        ]);
    }
    let limits = kinds.take("word | standard | on | at most | test | read from");
    vec![
        ("elements", elements),
        ("forms", forms),
        ("composites", composites),
        ("shifts", shifts),
        ("functions", waveforms),
        ("effects", effects),
        ("measures", measures),
        ("methods", methods),
        ("limits", limits),
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
    fn kind<T, A>(&mut self, own: &Registered<T, A>, amplitude: Option<Dimension>) {
        self.row(&[code(own.word), own.summary.to_owned()]);
        self.parameters(own.word, own.parameters, amplitude);
    }

    fn measure(&mut self, measure_entry: &MeasureEntry) {
        let family = match measure_entry.about.family {
            Family::Element => "an element",
            Family::Node => "a node",
        };
        let always = if measure_entry.about.by_default { "yes" } else { "" };
        let cells =
            [family, measure_entry.about.unit, always, measure_entry.summary].map(str::to_owned);
        self.row(&[[code(measure_entry.word)].as_slice(), &cells].concat());
        self.parameters(measure_entry.word, measure_entry.parameters, None);
    }

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
        for parameter in parameters {
            let is_own = |known: &(Parameter, Option<Dimension>, _)| {
                (known.0, known.1) == (*parameter, amplitude)
            };
            match self.parameters.iter_mut().find(|known| is_own(known)) {
                Some((.., kinds)) => kinds.push(kind),
                None => self.parameters.push((*parameter, amplitude, vec![kind])),
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
            return format!(
                "list of pairs `[time, {}]`, or a [file](tables.md)",
                quantity(dimension)
            );
        }
        _ => {}
    }
    match kind {
        ParameterKind::Quantity(dimension) => quantity(dimension),
        ParameterKind::TemperatureDifference => "temperature difference [K]".to_owned(),
        ParameterKind::Amplitude => "force [N] in a load, length [m] in a motion".to_owned(),
        ParameterKind::TimeTable => {
            "list of points `[time, value]`, or a [file](tables.md)".to_owned()
        }
        ParameterKind::Curve(first, second) => {
            let (first, second) = (quantity(first), quantity(second));
            format!("list of points `[{first}, {second}]`, or a [file](tables.md)")
        }
        ParameterKind::LawFormula => "formula over `y` [m] and `v` [m/s]".to_owned(),
        ParameterKind::TimeFormula => "formula over `t` [s]".to_owned(),
        ParameterKind::Choice(words) => words.iter().map(code).collect::<Vec<_>>().join(" or "),
        ParameterKind::Flag => "`true`".to_owned(),
        ParameterKind::Window => "`\"impact\"`, `\"run\"` or `[from, to]`".to_owned(),
        ParameterKind::Node => "name of a node".to_owned(),
        ParameterKind::Model => "a model: its name, or a table".to_owned(),
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
