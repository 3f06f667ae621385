//! `dashpot rheometer`.

mod asked;
mod beside;
mod files;
mod json;
mod page;
mod tables;

use std::path::PathBuf;

use clap::{
    Args,
    builder::{PossibleValue, PossibleValuesParser},
};
use dashpot_analysis::{
    Choice,
    measured::Deviation,
    rheometer::{
        LoadUnload, Note, PROTOCOLS, ProtocolEntry, RheometerReport, Specimen, methods_for,
        protocol,
    },
};
use dashpot_network::parameters::Kind as _;
use dashpot_report::Table;
use serde::Serialize;

use self::{
    asked::{given, summary, tests, variants},
    beside::MeasuredLoop,
    tables::{
        agreement, characteristics, error_of_all, figure_table, missing, settings, shared_settings,
        side_by_side, spectra, spectrum_table,
    },
};
use crate::{
    args::{MODEL, MethodNames, ValueArguments, When, assignment, method_names},
    error::{CliError, Status},
    folder::{Folder, Staged},
    operand::{Operand, canonical_model},
    output::{Study, Text, VERSION, emit, list, object},
    progress::Bar,
    terminal::{Terminal, WIDTH, note},
    text::{self, columns, table, wrapped},
};

const PLOT_HEIGHT: usize = 12;
/// Unit of a strain rate.
const STRAIN_RATE: &str = "1/s";

/// `rheometer`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot rheometer reference:padding\n  \
    dashpot rheometer pads.toml:felt --test load-hold-unload --with \"hold=5 ms\"\n  \
    dashpot rheometer pads.toml:felt --test sweep --out felt\n  \
    dashpot rheometer pads.toml:foam --test load-unload --with \"rate=1 mm/s,1 m/s\"\n  \
    dashpot rheometer pads.toml:felt --method exact,bdf\n\n\
    Each test of a linear model is computed from its poles and residues in closed form, and \
    independently from the equations of its network; both are shown. Any other model is \
    simulated. `dashpot list tests` tells of each test and its parameters.")]
pub(crate) struct RheometerArguments {
    /// The model.
    #[arg(value_name = "MODEL", help = MODEL)]
    model: String,
    /// Tests [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = test_names())]
    test: Vec<String>,
    /// Sets a parameter of the tests that have it: `--with "hold=5 ms"`; several values, as in
    /// "rate=1 mm/s,10 mm/s", stand side by side; repeatable.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    with: Vec<(String, String)>,
    /// Methods that simulate the network [default: exact for a linear model, else auto].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = MethodNames(method_names()))]
    method: Vec<String>,
    /// A measured loop beside that of `load-unload`: a file with a column of deformation and one of force, or
    /// strain and stress, with their units; the motion turns where the measured one does.
    #[arg(long, value_name = "FILE")]
    measured: Option<String>,
    #[command(flatten)]
    values: ValueArguments,
    /// Folder for CSV, JSON, SVG and report.html with all on one page; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
    /// Plots in the text; `auto` draws them on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto", conflicts_with = "json")]
    plot: When,
}

fn test_names() -> PossibleValuesParser {
    let value = |protocol_entry: &ProtocolEntry| {
        PossibleValue::new(protocol_entry.word).help(protocol_entry.summary)
    };
    PossibleValuesParser::new(PROTOCOLS.iter().map(value))
}

/// What the tests of a model have found.
struct Tested {
    word: String,
    /// The text in which the model stands, and what the command line sets in it.
    scene_text: String,
    set: Vec<(String, String)>,
    units: Units,
    specimen: Specimen,
    tests: Vec<Made>,
    measured: Option<MeasuredLoop>,
    plot: bool,
}

/// What is told of tests that differ in the values of their parameters alone.
struct Told<'t> {
    group: &'t [Made],
    settings: String,
    /// Below what the test is.
    figures: Table,
    /// What does not exist, how well the network agrees, and other notes.
    remarks: Vec<String>,
    /// How far they are from what was measured.
    deviations: Option<Table>,
}

impl Told<'_> {
    fn protocol(&self) -> &'static str {
        self.group.first().map_or("", |made| made.report.protocol)
    }
}

/// A test as it was made.
struct Made {
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

    fn told<'t>(&self, group: &'t [Made]) -> Told<'t> {
        let (units, common) = (self.units, characteristics(&self.tests).len());
        let (settings, figures, missing) = if let [alone] = group {
            let own = &alone.report.figures[common..];
            let settings = settings(&alone.report.settings, units);
            (settings, figure_table(own, units), missing(own, units))
        } else {
            (shared_settings(group, units), side_by_side(group, common, units), Vec::new())
        };
        let together = error_of_all(group);
        let of_each = group.iter().flat_map(|made| {
            let notes = made.report.notes.iter().map(Note::to_string);
            let label = |own: String| {
                if made.label.is_empty() { own } else { format!("{}: {own}", made.label) }
            };
            let own = if together.is_some() { Vec::new() } else { agreement(&made.report) };
            own.into_iter().chain(notes).map(label)
        });
        let protocol = group.first().map_or("", |made| made.report.protocol);
        Told {
            group,
            settings,
            figures: Table { caption: format!("{protocol}: {}", summary(protocol)), ..figures },
            remarks: missing.into_iter().chain(of_each).chain(together.clone()).collect(),
            deviations: beside::deviations(group, units),
        }
    }
}

pub(crate) fn rheometer(
    arguments: &RheometerArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let operand = Operand::read_any(&arguments.model, &arguments.values.set, terminal)?;
    let model = canonical_model(&operand)?;
    let units = Units { is_material: operand.is_material() };
    let specimen = Specimen::new(&model)?;
    let methods = arguments.method.iter().map(|own| Choice::named(own));
    let mut methods = methods.collect::<Result<Vec<Choice>, _>>()?;
    if methods.is_empty() {
        methods.extend(methods_for(&specimen));
    }
    let given = given(arguments, units)?;
    let measured = arguments.measured.as_deref();
    let measured = measured.map(|file| MeasuredLoop::read(file, units)).transpose()?;
    let mut asked = Vec::new();
    for test in tests(arguments) {
        let variants = variants(&test, &given)?;
        let is_alone = variants.len() == 1;
        let variants = variants.into_iter().map(|own| match &measured {
            Some(measured) if test == LoadUnload::KIND => own.beside(measured.depth()),
            _ => own,
        });
        asked.extend(variants.enumerate().map(|(at, variant)| {
            let name = if is_alone { test.clone() } else { format!("{test}-{}", at + 1) };
            (test.clone(), name, variant)
        }));
    }
    let names = asked.iter().flat_map(|(test, name, _)| [test.clone(), name.clone()]);
    let folder = Folder::wanted(arguments.out.as_deref(), files::names(names))?;
    let (mut made, of) = (Vec::new(), asked.len());
    let mut bar = Bar::new("rheometer", 0.0, terminal.error.attended);
    for (at, (test, name, variant)) in asked.into_iter().enumerate() {
        if bar.count(at, of).is_break() {
            return Err(CliError::Ended);
        }
        match protocol(&test, &variant.given)?.run(&specimen, &methods) {
            Ok(report) => {
                let own = measured.as_ref().filter(|_| test == LoadUnload::KIND);
                let deviation = own
                    .and_then(|own| Deviation::of_loops(&own.points, &files::run_through(&report)));
                made.push(Made { report, label: variant.label, name, deviation });
            }
            // One test alone was asked for; of several, the others go on.
            Err(error) if arguments.test.len() != 1 => note(&error.to_string()),
            Err(error) => return Err(error.into()),
        }
    }
    let tested = Tested {
        scene_text: operand.input.text()?.to_owned(),
        set: arguments.values.set.clone(),
        word: operand.word,
        units,
        specimen,
        tests: made,
        measured,
        plot: arguments.plot.is_now(terminal.output.attended),
    };
    emit(&tested, arguments.json, folder, terminal)?;
    Ok(Status::Done)
}

/// The units of a pad, or those of a material: per thickness and area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Units {
    /// Whether they are those of a material.
    pub(super) is_material: bool,
}

impl Units {
    /// The unit that stands for one of a pad.
    pub(super) fn of(self, unit: &'static str) -> &'static str {
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
    fn word(self, name: &str) -> String {
        if !self.is_material {
            return name.to_owned();
        }
        name.replace("stiffness", "modulus")
            .replace("deformation", "strain")
            .replace("force", "stress")
    }

    /// The same for people: of what is taken up on the way out only a part is absorbed.
    fn label(self, name: &str) -> String {
        self.word(if name == "energy absorbed" { "energy taken up" } else { name })
    }
}

impl Study for Tested {
    fn text(&self, text: &mut Text) {
        let units = self.units;
        let common = characteristics(&self.tests);
        text.title(&self.word);
        if let Some(kind) = self.specimen.nonlinear() {
            text.words(&format!("`{kind}` is not linear: the model is simulated"));
        }
        show(text, &figure_table(common, units));
        text.paragraphs(missing(common, units));
        let spectra = spectrum_table(&self.specimen, units);
        if !spectra.rows.is_empty() {
            text.heading(&spectra.caption);
            show(text, &spectra);
        }
        for told in self.groups().map(|group| self.told(group)) {
            text.heading(&told.figures.caption);
            text.faint(&told.settings);
            show(text, &told.figures);
            text.paragraphs(&told.remarks);
            if let Some(table) = &told.deviations {
                text.heading(&table.caption);
                show(text, table);
                text.paragraphs(self.measured.iter().filter_map(|own| own.note.as_ref()));
            }
            let is_plotted = self.plot;
            for chart in files::charts(told.group, self.measured.as_ref(), units)
                .into_iter()
                .filter(|_| is_plotted)
            {
                text.chart(&chart.1, PLOT_HEIGHT);
            }
        }
    }

    fn object(&self) -> impl Serialize {
        let [relaxation, retardation] = spectra(&self.specimen);
        object! {
            dashpot: VERSION,
            model: &self.word,
            material: self.units.is_material,
            nonlinear: self.specimen.nonlinear(),
            relaxation_spectrum: relaxation,
            retardation_spectrum: retardation,
            tests: list(self.tests.iter().map(|made| json::test(made, self.units))),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}

/// Adds a table, in parts where it is too wide, and lines that still are cut.
fn show(text: &mut Text, own: &Table) {
    for part in text::side_by_side(own, 1, WIDTH - 2) {
        let (header, rows) = table(&part);
        for line in [header].iter().chain(&rows).filter(|line| !line.trim().is_empty()) {
            for (at, words) in cut(line).iter().enumerate() {
                text.line(&format!("{}{words}", if at == 0 { "  " } else { "      " }));
            }
        }
    }
}

/// A line of a table in as many as it takes.
fn cut(line: &str) -> Vec<String> {
    if columns(line) <= WIDTH - 2 { vec![line.to_owned()] } else { wrapped(line, WIDTH - 6) }
}
