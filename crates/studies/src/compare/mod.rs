//! Whether two models or networks are the same from outside, by their poles.

mod report;
mod result;

use dashpot_analysis::{RunReport, Solve, SolveSettings, differences};
use dashpot_network::{
    Model,
    driving_point::{Agreement, Hidden, Receptance, Response},
    primitive,
};
use dashpot_report::Report;
use dashpot_rheology::{equivalence, identifiability::Entangled, sensitivity::sensitivity};

pub use self::result::{
    About, Cancelled, Comparison, Constant, Form, Impact, Map, Measured, Together, Worst,
};
use crate::{
    Answer, Context, Operands, Outcome, Study, StudyError,
    non_identifiable::{combinations, groups},
    operand::{Operand, Subject, canonical_model, parted, remark_means},
    request,
    study::{self, about_study},
};

/// Models of more parts than this have no map: it would take longer than all else.
const MOST_MAPPED: usize = 120;
/// What may be compared.
const OPERAND: &str = "FILE:NAME, a model, material or element of a file or of a built-in scene; \
                       FILE alone if it has one model; FILE:NODE,NODE for the response of a \
                       whole network at two of its nodes";

request! {
    /// How two models are compared.
    pub CompareRequest {
        /// Scene and element: solves this impact with each of the models in the element's place, and
        /// compares what is measured.
        impact "SCENE:ELEMENT": Option<String>;
    }
}

/// Says whether two models are the same.
///
/// # Errors
///
/// [`StudyError::MaterialAndPad`] for a material and a pad, [`StudyError::Undecided`] where rounding leaves it open, and what
/// is wrong with the impact.
pub fn compare(
    operands: &[Operand; 2],
    request: &CompareRequest,
    set: &[(String, String)],
    context: &mut dyn Context,
) -> Result<Comparison, StudyError> {
    if operands[0].is_material() != operands[1].is_material() {
        return Err(StudyError::MaterialAndPad);
    }
    let mut comparison = compared(operands)?;
    comparison.models = operands.iter().map(about).collect::<Result<_, _>>()?;
    if let (true, [Some(first), Some(second)]) =
        (comparison.same, [&operands[0], &operands[1]].map(Operand::model))
    {
        comparison.map = map(first, second);
    }
    if let Some(impact) = &request.impact {
        comparison.impact = Some(same_impact(impact, operands, set, context)?);
    }
    Ok(comparison)
}

impl Answer for Comparison {
    fn report(&self) -> Report {
        report::report(self)
    }

    fn outcome(&self) -> Outcome {
        if self.same { Outcome::Done } else { Outcome::NotSame }
    }
}

/// The study.
pub(crate) struct Compare;

impl Study for Compare {
    about_study! {
        "compare", CompareRequest, Operands::Models(&[("first", OPERAND), ("second", "The other one")]),
        "Says whether two models or networks are the same from outside, by their poles",
        "Examples:\n  \
         dashpot compare pads.toml:burgers pads.toml:two-maxwell\n  \
         dashpot compare pads.toml:felt fibre.toml:felt --impact reference:padding\n  \
         dashpot compare bridge.toml:face,ground pads.toml:felt\n  \
         dashpot compare old.toml:head,ground new.toml:head,ground\n\n\
         `Same` means that all poles and residues agree within 1e-11, relatively.\n\n\
         Exit codes: 0 they are the same, 3 they are not, 2 the input is wrong.",
        |operands, set, request, context| {
            let [first, second] = study::models(operands, set, context)?;
            compare(&[first, second], &request, set, context)?
        }
    }

    fn has_files(&self) -> bool {
        false
    }
}

fn compared(operands: &[Operand; 2]) -> Result<Comparison, StudyError> {
    let words = [&operands[0], &operands[1]].map(|own| own.word.clone());
    let is_material = operands[0].is_material();
    if let [Some(first), Some(second)] = [&operands[0].linear()?, &operands[1].linear()?] {
        let found = equivalence::compare(first, second);
        let error = operands.iter().map(Operand::error).fold(0.0, f64::max);
        if !found.is_same && error > equivalence::SAME_WITHIN {
            return Err(StudyError::Undecided { error });
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
        Agreement::Undecided { error } => return Err(StudyError::Undecided { error }),
    }
    Ok(comparison)
}

/// What is known of one operand by itself.
fn about(operand: &Operand) -> Result<About, StudyError> {
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
    context: &mut dyn Context,
) -> Result<Impact, StudyError> {
    let (path, element) = parted(word, context);
    let scene = context.input(path)?.scene(set, context)?;
    remark_means(&scene, context);
    let names = || scene.network.connections().iter().map(|connection| connection.name.clone());
    let element =
        if element.is_empty() { names().next().unwrap_or_default() } else { element.to_owned() };
    let at = names().position(|name| name == element).ok_or_else(|| {
        StudyError::UnknownElement { name: element.clone(), known: names().collect() }
    })?;
    let settings = SolveSettings { measures: Vec::new(), ..scene.settings("auto")? };
    let run = |operand: &Operand| -> Result<RunReport, StudyError> {
        if operand.is_material() {
            return Err(StudyError::MaterialInImpact { word: operand.word.clone() });
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
