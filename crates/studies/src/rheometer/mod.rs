//! Tests of a model alone: creep, relaxation, oscillation, in closed form and by simulation.

mod beside;
mod figures;
mod report;
mod result;
mod tables;
mod variants;

use dashpot_analysis::{
    measured::Deviation,
    rheometer::{LoadUnload, PROTOCOLS, RheometerReport, Specimen, methods_for, protocol},
};
use dashpot_network::parameters::Kind as _;
use dashpot_report::Report;

use self::{
    beside::MeasuredLoop,
    variants::{given, tests, variants},
};
use crate::{
    Answer, Assignment, Context, DataTable, Given, Kind, MethodName, Operands, Progress, Remark,
    Single, Study, StudyError, list,
    operand::{MODEL, Operand, canonical_model},
    request,
    study::about_study,
};

/// Unit of a strain rate.
const STRAIN_RATE: &str = "1/s";

request! {
    /// How a model is tested.
    pub RheometerRequest {
        /// Tests [default: all].
        test "NAME,…": Vec<TestName>;
        /// Sets a parameter of the tests that have it, such as "hold=5 ms"; several values, as in
        /// "rate=1 mm/s,10 mm/s", stand side by side; repeatable.
        with "NAME=VALUE": Vec<Assignment>;
        /// Methods that simulate the network [default: exact for a linear model, else auto].
        method "NAME,…": Vec<MethodName>;
        /// A measured loop beside that of `load-unload`: a file with a column of deformation and one of force, or
        /// strain and stress, with their units; the motion turns where the measured one does.
        measured "FILE": Option<String>;
    }
}

/// The word of a test.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TestName(pub String);

impl Single for TestName {
    const KIND: Kind =
        Kind::Words(|| list(PROTOCOLS.iter().map(|protocol| (protocol.word, protocol.summary))));

    fn of(given: &Given) -> Result<Self, String> {
        String::of(given).map(Self)
    }
}

/// What the tests of a model have found.
#[derive(Debug)]
#[non_exhaustive]
pub struct Tested {
    word: String,
    /// The text in which the model stands, and what the command line sets in it.
    scene_text: String,
    set: Vec<(String, String)>,
    units: Units,
    specimen: Specimen,
    tests: Vec<Made>,
    measured: Option<MeasuredLoop>,
}

/// A test as it was made.
#[derive(Debug)]
pub(crate) struct Made {
    report: RheometerReport,
    /// What tells it from others of the same test; empty where it is the only one.
    label: String,
    /// The name of its files.
    name: String,
    /// How far it is from what was measured.
    deviation: Option<Deviation>,
}

impl Tested {
    /// The tests that differ in the values of their parameters alone, together.
    fn groups(&self) -> impl Iterator<Item = &[Made]> {
        self.tests.chunk_by(|one, other| one.report.protocol == other.report.protocol)
    }
}

/// Makes the tests that are asked for on what a word stands for.
///
/// # Errors
///
/// What is wrong with the request, and why the only test that is asked for cannot be made.
pub fn rheometer(
    operand: Operand,
    request: &RheometerRequest,
    set: &[(String, String)],
    context: &mut dyn Context,
) -> Result<Tested, StudyError> {
    let model = canonical_model(&operand)?;
    let units = Units { is_material: operand.is_material() };
    let specimen = Specimen::new(&model)?;
    let mut methods = MethodName::choices(&request.method)?;
    if methods.is_empty() {
        methods.extend(methods_for(&specimen));
    }
    let given = given(request, units)?;
    let measured = request.measured.as_deref();
    let measured = measured.map(|file| MeasuredLoop::read(file, units, context)).transpose()?;
    let mut asked = Vec::new();
    for test in tests(request) {
        let variants = variants(&test, &given)?;
        let is_alone = variants.len() == 1;
        let variants = variants.into_iter().map(|variant| match &measured {
            Some(measured) if test == LoadUnload::KIND => variant.beside(measured.depth()),
            _ => variant,
        });
        asked.extend(variants.enumerate().map(|(at, variant)| {
            let name = if is_alone { test.clone() } else { format!("{test}-{}", at + 1) };
            (test.clone(), name, variant)
        }));
    }
    let names = asked.iter().flat_map(|(test, name, _)| [test.as_str(), name]);
    context.prepare(figures::files(names))?;
    let (mut made, of) = (Vec::new(), asked.len());
    for (at, (test, name, variant)) in asked.into_iter().enumerate() {
        if context.progress(Progress::Count { done: at, of }).is_break() {
            return Err(StudyError::Ended);
        }
        match protocol(&test, &variant.given)?.run(&specimen, &methods) {
            Ok(report) => {
                let beside = measured.as_ref().filter(|_| test == LoadUnload::KIND);
                let deviation = beside.and_then(|beside| {
                    Deviation::of_loops(&beside.points, &figures::run_through(&report))
                });
                made.push(Made { report, label: variant.label, name, deviation });
            }
            // One test alone was asked for; of several, the others go on.
            Err(error) if request.test.len() != 1 => {
                context.remark(Remark::Note(error.to_string()));
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(Tested {
        scene_text: operand.input.text()?.to_owned(),
        set: set.to_vec(),
        word: operand.word,
        units,
        specimen,
        tests: made,
        measured,
    })
}

/// The units of a pad, or those of a material: per thickness and area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Units {
    /// Whether they are those of a material.
    pub(crate) is_material: bool,
}

impl Units {
    /// The unit that stands for one of a pad.
    pub(crate) fn of(self, unit: &'static str) -> &'static str {
        if !self.is_material {
            return unit;
        }
        match unit {
            "N" | "N/m" => "Pa",
            "N s/m" => "Pa s",
            "m" => "1",
            "m/s" => STRAIN_RATE,
            "m/N" => "1/Pa",
            "J" => "J/m³",
            other => other,
        }
    }

    /// The word that stands for one of a pad.
    pub(crate) fn word(self, name: &str) -> String {
        if !self.is_material {
            return name.to_owned();
        }
        name.replace("stiffness", "modulus")
            .replace("deformation", "strain")
            .replace("force", "stress")
    }

    /// The same for people: of what is taken up on the way out only a part is absorbed.
    pub(crate) fn label(self, name: &str) -> String {
        self.word(if name == "energy absorbed" { "energy taken up" } else { name })
    }
}

impl Answer for Tested {
    fn report(&self) -> Report {
        report::report(self)
    }

    fn tables(&self) -> Vec<DataTable<'_>> {
        list(self.tests.iter().map(|made| figures::table(made, self.units)))
    }
}

/// The study.
pub(crate) struct Rheometer;

impl Study for Rheometer {
    about_study! {
        "rheometer", RheometerRequest, Operands::Models(&[("model", MODEL)]),
        "Tests a model alone: creep, relaxation, oscillation, in closed form and by simulation",
        "Examples:\n  \
         dashpot rheometer reference:padding\n  \
         dashpot rheometer pads.toml:felt --test load-hold-unload --with \"hold=5 ms\"\n  \
         dashpot rheometer pads.toml:felt --test sweep --out felt\n  \
         dashpot rheometer pads.toml:foam --test load-unload --with \"rate=1 mm/s,1 m/s\"\n  \
         dashpot rheometer pads.toml:felt --method exact,bdf\n\n\
         Each test of a linear model is computed from its poles and residues in closed form, and \
         independently from the equations of its network; both are shown. Any other model is \
         simulated. `dashpot list tests` tells of each test and its parameters.",
        |operands, set, request, context| {
            let none = || StudyError::setting("model", "none is named");
            let word = operands.first().ok_or_else(none)?;
            let operand = Operand::read_any(word, set, context)?;
            rheometer(operand, &request, set, context)?
        }
    }
}
