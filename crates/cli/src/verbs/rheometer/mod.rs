//! `dashpot rheometer`.

mod files;
mod tables;

use std::path::PathBuf;

use clap::{
    Args,
    builder::{PossibleValue, PossibleValuesParser},
};
use dashpot_analysis::{
    Choice,
    rheometer::{
        Note, Obstacle, PROTOCOLS, ProtocolEntry, RheometerReport, Series, Specimen, protocol,
    },
};
use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, registered};
use dashpot_plot::Table;
use serde::Serialize;

use self::tables::{
    agreement, characteristics, figure_table, missing, settings, spectra, spectrum_table,
};
use crate::{
    args::{MODEL, MethodNames, ValueArguments, When, assignment, method_names},
    error::{CliError, Status},
    folder::{Folder, Staged},
    input::setting,
    operand::{Operand, canonical_model},
    output::{Study, Text, VERSION, emit, list, object},
    terminal::{Terminal, WIDTH, note},
    text::{columns, table, wrapped},
};

/// Lines of a plot.
const PLOT_HEIGHT: usize = 12;
/// Unit of a strain rate.
const STRAIN_RATE: &str = "1/s";

/// `rheometer`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot rheometer reference:padding\n  \
    dashpot rheometer pads.toml:felt --test load-hold-unload --with \"hold=5 ms\"\n  \
    dashpot rheometer pads.toml:felt --test sweep --out felt\n  \
    dashpot rheometer pads.toml:felt --method exact,bdf\n\n\
    Each test is computed from the model's poles and residues in closed form, and \
    independently from the equations of its network; both are shown. `dashpot list tests` \
    tells of each test and its parameters.")]
pub(crate) struct RheometerArguments {
    /// The model.
    #[arg(value_name = "MODEL", help = MODEL)]
    model: String,
    /// Tests [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = test_names())]
    test: Vec<String>,
    /// Sets a parameter of the tests that have it: `--with "hold=5 ms"`; repeatable.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    with: Vec<(String, String)>,
    /// Methods that simulate the network.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "exact", value_parser = MethodNames(method_names()))]
    method: Vec<String>,
    #[command(flatten)]
    values: ValueArguments,
    /// Folder for CSV, JSON and SVG; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
    /// Plots in the text; `auto` draws them on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
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
    units: Units,
    specimen: Specimen,
    reports: Vec<RheometerReport>,
    plot: When,
}

/// Tests a model.
pub(crate) fn rheometer(
    arguments: &RheometerArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let operand = Operand::read(&arguments.model, &arguments.values.set, terminal)?;
    let model = canonical_model(&operand)?;
    let units = Units { is_material: operand.is_material() };
    let specimen = Specimen::new(&model)?;
    let methods = arguments.method.iter().map(|own| Choice::named(own));
    let methods = methods.collect::<Result<Vec<Choice>, _>>()?;
    let folder = Folder::wanted(arguments.out.as_deref(), files::names(&tests(arguments)))?;
    let given = given(arguments, units)?;
    let mut reports = Vec::new();
    for test in tests(arguments) {
        let own: Vec<(&str, f64)> =
            given.iter().filter(|own| has_parameter(&test, own.0)).copied().collect();
        match protocol(&test, &own)?.run(&specimen, &methods) {
            Ok(report) => reports.push(report),
            // One test alone was asked for; of several, the others go on.
            Err(error) if arguments.test.len() != 1 => note(&error.to_string()),
            Err(error) => return Err(error.into()),
        }
    }
    let tested = Tested { word: operand.word, units, specimen, reports, plot: arguments.plot };
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
}

impl Study for Tested {
    fn text(&self, text: &mut Text) {
        let Self { units, reports, .. } = self;
        let common = characteristics(reports);
        text.title(&self.word);
        show(text, &figure_table(common, *units));
        text.paragraphs(missing(common, *units));
        let spectra = spectrum_table(&self.specimen, *units);
        if !spectra.rows.is_empty() {
            text.heading(&spectra.caption);
            show(text, &spectra);
        }
        for report in reports {
            text.heading(&format!("{}: {}", report.protocol, summary(report.protocol)));
            text.faint(&settings(&report.settings, *units));
            show(text, &figure_table(&report.figures[common.len()..], *units));
            let notes = report.notes.iter().map(Note::to_string);
            text.paragraphs(agreement(report).into_iter().chain(notes));
            let series = files::series(report, *units).filter(|_| text.is_plotted(self.plot));
            if let Some(series) = series {
                text.chart(&series.chart(), PLOT_HEIGHT);
            }
        }
    }

    fn object(&self) -> impl Serialize {
        let [relaxation, retardation] = spectra(&self.specimen);
        object! {
            dashpot: VERSION,
            model: &self.word,
            material: self.units.is_material,
            relaxation_spectrum: relaxation,
            retardation_spectrum: retardation,
            tests: list(self.reports.iter().map(|report| test(report, self.units))),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}

fn test(report: &RheometerReport, units: Units) -> impl Serialize {
    object! {
        test: report.protocol,
        settings: list(report.settings.iter().map(|setting| object! {
            name: setting.name, unit: units.of(setting.unit), value: setting.value,
        })),
        abscissa: column(&report.abscissa, units),
        drive: report.drive.as_ref().map(|drive| column(drive, units)),
        series: list(report.series.iter().map(|own| answers(report, own, units))),
        figures: list(report.figures.iter().map(|figure| object! {
            name: units.word(figure.name),
            unit: units.of(figure.unit),
            model: figure.model,
            computed: figure.computed,
            note: figure.note.as_ref().map(Note::to_string),
            note_code: figure.note.map(Note::code),
        })),
        notes: list(report.notes.iter().map(Note::to_string)),
        note_codes: list(report.notes.iter().copied().map(Note::code)),
    }
}

fn column(own: &dashpot_analysis::Column, units: Units) -> impl Serialize {
    object! { name: units.word(&own.name), unit: units.of(own.unit), values: &own.values }
}

fn answers(report: &RheometerReport, own: &Series, units: Units) -> impl Serialize {
    let computed = own.computed.iter().zip(&report.computations);
    object! {
        name: units.word(own.name),
        unit: units.of(own.unit),
        model: &own.model,
        computed: list(computed.map(|(own, by)| object! {
            method: by.method,
            obstacle: by.obstacle.as_ref().map(Obstacle::to_string),
            obstacle_code: by.obstacle.as_ref().map(Obstacle::code),
            values: &own.values,
            difference: own.difference.map(|difference| difference.relative),
            stated: own.difference.and_then(|difference| difference.stated),
        })),
    }
}

/// Adds the lines of a table, those that are too wide cut.
fn show(text: &mut Text, own: &Table) {
    let (header, rows) = table(own);
    for line in [header].iter().chain(&rows).filter(|line| !line.trim().is_empty()) {
        if columns(line) <= WIDTH - 2 {
            text.line(&format!("  {line}"));
            continue;
        }
        for (at, part) in wrapped(line, WIDTH - 6).iter().enumerate() {
            text.line(&format!("{}{part}", if at == 0 { "  " } else { "      " }));
        }
    }
}

/// The words of the tests that are asked for, all of them by default.
pub(super) fn tests(arguments: &RheometerArguments) -> Vec<String> {
    if arguments.test.is_empty() {
        PROTOCOLS.iter().map(|own| own.word.to_owned()).collect()
    } else {
        arguments.test.clone()
    }
}

/// What is to be given for a parameter.
fn dimension(parameter: &Parameter) -> Dimension {
    match parameter.kind {
        ParameterKind::Quantity(dimension) => dimension,
        _ => Dimension::NUMBER,
    }
}

/// What a test is.
pub(super) fn summary(test: &str) -> &'static str {
    registered(PROTOCOLS, test).map_or("", |own| own.summary)
}

/// Whether a test has a parameter.
pub(super) fn has_parameter(test: &str, name: &str) -> bool {
    registered(PROTOCOLS, test)
        .is_some_and(|own| own.parameters.iter().any(|parameter| parameter.name == name))
}

/// The parameters of `--with` in SI units; each must belong to one of the tests.
pub(super) fn given<'a>(
    arguments: &'a RheometerArguments,
    units: Units,
) -> Result<Vec<(&'a str, f64)>, CliError> {
    let tests = tests(arguments);
    let asked: Vec<&Parameter> = PROTOCOLS
        .iter()
        .filter(|own| tests.iter().any(|test| test == own.word))
        .flat_map(|own| own.parameters)
        .collect();
    let read = |(name, text): &'a (String, String)| {
        let Some(parameter) = asked.iter().find(|own| own.name == name) else {
            let mut known: Vec<&'static str> = asked.iter().map(|own| own.name).collect();
            known.sort_unstable();
            known.dedup();
            return Err(CliError::UnknownSetting { name: name.clone(), known });
        };
        let expected = dimension(parameter);
        let expected = if units.is_material { per_material(expected) } else { expected };
        Ok((name.as_str(), setting(name, text, expected)?))
    };
    arguments.with.iter().map(read).collect()
}

/// What a force, deformation or velocity becomes per area and thickness.
fn per_material(dimension: Dimension) -> Dimension {
    match dimension {
        Dimension::FORCE => Dimension::PRESSURE,
        Dimension::LENGTH => Dimension::NUMBER,
        Dimension::VELOCITY => Dimension::FREQUENCY,
        other => other,
    }
}
