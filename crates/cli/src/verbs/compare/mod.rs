//! `dashpot compare`.

mod found;
mod words;

use clap::Args;
use dashpot_analysis::{RunReport, Solve, SolveSettings, differences};
use dashpot_network::{
    Model,
    driving_point::{Agreement, Hidden, Receptance, Response},
    primitive,
};
use dashpot_rheology::{equivalence, identifiability::Entangled, sensitivity::sensitivity};
use serde::Serialize;

use self::{
    found::{About, Cancelled, Comparison, Form, Impact, Map, Measured, Together, Worst},
    words::sentences,
};
use crate::{
    args::ValueArguments,
    error::{CliError, Status},
    non_identifiable::{combinations, groups},
    operand::{Operand, Subject, canonical_model, note_means, parted, read_scene},
    output::{Study, Text, emit},
    terminal::{Terminal, Tone},
};

/// Maps of more parameters than this are in the JSON only.
const MOST_SHOWN: usize = 8;
/// Models of more parts than this have no map: it would take longer than all else.
const MOST_MAPPED: usize = 120;

/// What may be compared.
const OPERAND: &str = "FILE:NAME, a model, material or element of a file or of a built-in scene; \
                       FILE alone if it has one model; FILE:NODE,NODE for the response of a \
                       whole network at two of its nodes";

/// `compare`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot compare pads.toml:burgers pads.toml:two-maxwell\n  \
    dashpot compare pads.toml:felt fibre.toml:felt --impact reference:padding\n  \
    dashpot compare bridge.toml:face,ground pads.toml:felt\n  \
    dashpot compare old.toml:head,ground new.toml:head,ground\n\n\
    `Same` means that all poles and residues agree within 1e-11, relatively.\n\n\
    Exit codes: 0 they are the same, 3 they are not, 2 the input is wrong.")]
pub(crate) struct CompareArguments {
    /// The model.
    #[arg(value_name = "FIRST", help = OPERAND)]
    first: String,
    /// The other one.
    #[arg(value_name = "SECOND")]
    second: String,
    /// Scene and element: solves this impact with each of the models in the element's place, and
    /// compares what is measured.
    #[arg(long, value_name = "SCENE:ELEMENT")]
    impact: Option<String>,
    #[command(flatten)]
    values: ValueArguments,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

/// Says whether two models are the same.
pub(crate) fn compare(
    arguments: &CompareArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let set = &arguments.values.set;
    let operands =
        [&arguments.first, &arguments.second].map(|word| Operand::read(word, set, terminal));
    let [first, second] = operands;
    let operands = [first?, second?];
    if operands[0].is_material() != operands[1].is_material() {
        return Err(CliError::MaterialAndPad);
    }
    let mut found = compared(&operands)?;
    found.models = operands.iter().map(about).collect::<Result<_, _>>()?;
    if let (true, [Some(first), Some(second)]) =
        (found.same, [&operands[0], &operands[1]].map(Operand::model))
    {
        found.map = map(first, second);
    }
    if let Some(impact) = &arguments.impact {
        found.impact = Some(same_impact(impact, &operands, set, terminal)?);
    }
    emit(&found, arguments.json, None, terminal)?;
    Ok(if found.same { Status::Done } else { Status::NotSame })
}

impl Study for Comparison {
    fn text(&self, text: &mut Text) {
        let [first, second] = &self.compared;
        let (verdict, tone) =
            if self.same { ("The same", Tone::Heading) } else { ("Not the same", Tone::Warning) };
        text.begun(tone, verdict, &format!(": {first} and {second}"));
        text.paragraphs(sentences(self));
        let small = self.map.as_ref().filter(|map| map.is_at_most(MOST_SHOWN)).map(Map::table);
        let impact = self.impact.as_ref().map(Impact::table);
        let tables = self.forms.iter().map(Form::table).chain(small).chain(impact);
        tables.for_each(|table| text.table(&table));
    }

    fn object(&self) -> impl Serialize {
        self
    }
}

fn compared(operands: &[Operand; 2]) -> Result<Comparison, CliError> {
    let words = [&operands[0], &operands[1]].map(|own| own.word.clone());
    let is_material = operands[0].is_material();
    if let [Some(first), Some(second)] = [&operands[0].linear()?, &operands[1].linear()?] {
        let found = equivalence::compare(first, second);
        let error = operands.iter().map(Operand::error).fold(0.0, f64::max);
        if !found.is_same && error > equivalence::SAME_WITHIN {
            return Err(CliError::Undecided { error });
        }
        return Ok(Comparison::of(words, is_material, &found));
    }
    let receptance = |operand: &Operand| match &operand.subject {
        Subject::Response(Response::Massive(receptance)) => Some(receptance.clone()),
        _ => None,
    };
    let none =
        equivalence::Equivalence { is_same: false, maxwell: None, kelvin: None, worst: None };
    let mut comparison = Comparison::of(words, is_material, &none);
    let [Some(first), Some(second)] = [&operands[0], &operands[1]].map(receptance) else {
        return Ok(comparison);
    };
    match first.agreement(&second) {
        Agreement::Same { difference } => {
            comparison.same = true;
            comparison.largest_difference = Some(difference);
        }
        Agreement::Different { omega, size } => {
            let frequency = Some(omega / std::f64::consts::TAU);
            comparison.worst = Some(Worst { frequency, response: size, time: None, creep: None });
        }
        Agreement::Undecided { error } => return Err(CliError::Undecided { error }),
    }
    Ok(comparison)
}

/// What is known of one operand by itself.
fn about(operand: &Operand) -> Result<About, CliError> {
    let linear = operand.linear()?;
    let hidden = |hidden: &Hidden| Cancelled { pole: hidden.rate, count: hidden.count };
    let mut cancelled: Vec<Cancelled> = match &operand.subject {
        Subject::Model(_) => Vec::new(),
        Subject::Response(Response::Massless(own)) => own.hidden.iter().map(hidden).collect(),
        Subject::Response(Response::Massive(own)) => {
            Receptance::hidden(own).iter().map(hidden).collect()
        }
    };
    let merged = linear.iter().flat_map(|own| own.merged().to_vec());
    cancelled.extend(
        merged
            .map(|merged| Cancelled { pole: [-merged.time.recip(), 0.0], count: merged.count - 1 }),
    );
    let tree = operand.model();
    let poles = match &operand.subject {
        Subject::Response(Response::Massive(own)) => {
            Some(own.poles().iter().map(|pole| pole.order).sum())
        }
        _ => None,
    };
    Ok(About {
        poles,
        elements: tree.map(|tree| tree.leaves().count()),
        least_elements: linear.as_ref().map(dashpot_rheology::LinearModel::least_elements),
        maxwell_form: linear.as_ref().is_some_and(|linear| linear.maxwell().is_some()),
        kelvin_form: linear.as_ref().is_some_and(|linear| linear.kelvin().is_some()),
        cancelled,
        entangled: tree.map(together).unwrap_or_default(),
    })
}

fn together(model: &Model) -> Vec<Together> {
    let of = |group: &Entangled| Together {
        parameters: group.parameters.clone(),
        combinations: combinations(group),
    };
    groups(model).iter().map(of).collect()
}

fn map(first: &Model, second: &Model) -> Option<Map> {
    let is_small = |model: &&Model| model.leaves().nth(MOST_MAPPED).is_none();
    let of = |own: &Model| sensitivity(own, |element| primitive(element.as_ref()));
    let [first, second] = [first, second].map(|own| Some(own).filter(is_small).and_then(of));
    Some(Map::of(&first?.map_to(&second?)?))
}

/// Solves the impact with each model in the place of the element's own.
fn same_impact(
    word: &str,
    operands: &[Operand; 2],
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Impact, CliError> {
    let (path, element) = parted(word);
    let scene = read_scene(Some(std::path::Path::new(path)), set, terminal)?;
    note_means(&scene);
    let names = || scene.network.connections().iter().map(|connection| connection.name.clone());
    let element =
        if element.is_empty() { names().next().unwrap_or_default() } else { element.to_owned() };
    let at = names().position(|name| name == element).ok_or_else(|| CliError::UnknownElement {
        name: element.clone(),
        known: names().collect(),
    })?;
    let settings = SolveSettings { measures: Vec::new(), ..scene.settings("auto")? };
    let run = |operand: &Operand| -> Result<RunReport, CliError> {
        if operand.is_material() {
            return Err(CliError::MaterialInImpact { word: operand.word.clone() });
        }
        let mut network = scene.network.clone();
        network.set_model(at, canonical_model(operand)?);
        Ok(network.solve_with(&settings)?)
    };
    let [first, second] = [run(&operands[0])?, run(&operands[1])?];
    let apart = differences(&first, &second);
    let measures = first.measures.iter().filter_map(|measure| {
        let other = second.measures.iter().find(|other| other.key == measure.key)?;
        Some(Measured {
            measure: measure.key.clone(),
            unit: measure.unit,
            value: [measure.value, other.value],
            error: [measure.error, other.error],
            difference: apart.iter().find(|known| known.key == measure.key).map(|own| own.relative),
        })
    });
    Ok(Impact {
        scene: path.to_owned(),
        element,
        method: [first.solver.method, second.solver.method],
        measures: measures.collect(),
    })
}
