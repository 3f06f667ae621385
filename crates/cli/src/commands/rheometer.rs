//! `dashpot rheometer`.

use std::fmt::Write as _;

use dashpot_analysis::rheometer::{
    ProtocolKind, ProtocolVisitor, RheometerReport, Specimen, protocol, visit_protocols,
};
use dashpot_network::parameters::{Dimension, ParameterKind};
use dashpot_plot::Table;
use dashpot_scene::units::parse_quantity;

use crate::{
    answer::rheometer::{
        Document, Units, agreement, characteristics, figure_table, missing, settings,
        spectrum_table,
    },
    args::{RheometerArguments, When},
    error::{CliError, Status},
    folder::Folder,
    operand::{Operand, canonical_model},
    rheometer_folder::{figure, file_names, write},
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data, remark},
    text::{table, wrapped},
};

/// Lines of a plot.
const PLOT_HEIGHT: usize = 12;

/// Tests a model.
pub(crate) fn rheometer(
    arguments: &RheometerArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let operand = Operand::read(&arguments.model, &arguments.values.set, terminal)?;
    let model = canonical_model(&operand)?;
    let units = Units { is_material: operand.is_material() };
    let specimen = Specimen::new(&model)?;
    let methods: Vec<&str> = arguments.method.iter().map(String::as_str).collect();
    let folder = Folder::wanted(arguments.out.as_deref(), file_names(&tests(arguments)))?;
    let given = given(arguments, units)?;
    let mut reports = Vec::new();
    for test in tests(arguments) {
        let own: Vec<(&str, f64)> =
            given.iter().filter(|own| has_parameter(&test, own.0)).copied().collect();
        match protocol(&test, &own)?.run(&specimen, &methods) {
            Ok(report) => reports.push(report),
            // One test alone was asked for; of several, the others go on.
            Err(error) if arguments.test.len() != 1 => remark(&error.to_string()),
            Err(error) => return Err(error.into()),
        }
    }
    let document = Document::of(&operand.word, units, &specimen, &reports);
    let json = serde_json::to_string_pretty(&document)? + "\n";
    if arguments.json {
        print_data(&json)?;
    } else {
        print(&text(&operand, units, &specimen, &reports, (arguments.plot, terminal)))?;
    }
    if let Some(folder) = folder {
        folder.write(
            |files| write(files, units, (&operand.word, &specimen), &reports),
            &json,
            arguments.json,
        )?;
    }
    Ok(Status::Done)
}

/// The words of the tests that are asked for, all of them by default.
fn tests(arguments: &RheometerArguments) -> Vec<String> {
    if arguments.test.is_empty() {
        protocols().into_iter().map(|own| own.0.to_owned()).collect()
    } else {
        arguments.test.clone()
    }
}

/// Word and parameters of every test: name and dimension.
fn protocols() -> Vec<(&'static str, Vec<(&'static str, Dimension)>)> {
    struct Collect(Vec<(&'static str, Vec<(&'static str, Dimension)>)>);
    impl ProtocolVisitor for Collect {
        fn visit<P: ProtocolKind>(&mut self) {
            let parameters = P::PARAMETERS.iter().map(|own| match own.kind {
                ParameterKind::Quantity(dimension) => (own.name, dimension),
                _ => (own.name, Dimension::NUMBER),
            });
            self.0.push((P::KIND, parameters.collect()));
        }
    }
    let mut collect = Collect(Vec::new());
    visit_protocols(&mut collect);
    collect.0
}

fn has_parameter(test: &str, name: &str) -> bool {
    protocols().iter().any(|own| own.0 == test && own.1.iter().any(|own| own.0 == name))
}

/// The parameters of `--with` in SI units; each must belong to one of the tests.
fn given<'a>(
    arguments: &'a RheometerArguments,
    units: Units,
) -> Result<Vec<(&'a str, f64)>, CliError> {
    let tests = tests(arguments);
    let all = protocols();
    let asked = || all.iter().filter(|own| tests.iter().any(|test| test == own.0));
    let read = |(name, text): &'a (String, String)| {
        let known = asked().flat_map(|own| &own.1).find(|own| own.0 == *name);
        let Some((_, dimension)) = known else {
            let mut known: Vec<&'static str> =
                asked().flat_map(|own| &own.1).map(|own| own.0).collect();
            known.sort_unstable();
            known.dedup();
            return Err(CliError::UnknownSetting { name: name.clone(), known });
        };
        let wrong = |reason: String| CliError::WrongSetting { name: name.clone(), reason };
        let quantity = parse_quantity(text).map_err(|error| wrong(error.to_string()))?;
        let expected = if units.is_material { per_material(*dimension) } else { *dimension };
        match quantity.dimension {
            Some(found) if found != expected => {
                let unit = |own: Dimension| own.named().map_or("another unit", |own| own.1);
                Err(wrong(format!(
                    "`{text}` is in {}, where {} is wanted",
                    unit(found),
                    unit(expected)
                )))
            }
            _ if quantity.angle != 0 => {
                let frequency = quantity.value / std::f64::consts::TAU;
                Err(wrong(format!("`{text}` is an angular frequency; write \"{frequency:.6} Hz\"")))
            }
            _ => Ok((name.as_str(), quantity.value)),
        }
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

fn text(
    operand: &Operand,
    units: Units,
    specimen: &Specimen,
    reports: &[RheometerReport],
    (plot, terminal): (When, Terminal),
) -> String {
    let mut text = String::new();
    let common = characteristics(reports);
    let show = |text: &mut String, own: &Table| {
        let (header, rows) = table(own);
        for line in [header].iter().chain(&rows).filter(|line| !line.trim().is_empty()) {
            for (at, part) in cut(line).iter().enumerate() {
                let indent = if at == 0 { "  " } else { "      " };
                let _ = writeln!(text, "{indent}{part}");
            }
        }
    };
    let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &operand.word));
    show(&mut text, &figure_table(common, units));
    for line in missing(common, units).iter().flat_map(|own| wrapped(own, WIDTH - 2)) {
        let _ = writeln!(text, "  {line}");
    }
    let spectra = spectrum_table(specimen, units);
    if !spectra.rows.is_empty() {
        let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, &spectra.caption));
        show(&mut text, &spectra);
    }
    let is_plotted = match plot {
        When::Auto => terminal.output.attended,
        When::Always => true,
        When::Never => false,
    };
    for report in reports {
        let heading = format!("{}: {}", report.protocol, summary(report.protocol));
        let _ = writeln!(text);
        for line in wrapped(&heading, WIDTH) {
            let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &line));
        }
        for line in wrapped(&settings(&report.settings, units), WIDTH - 2) {
            let _ = writeln!(text, "  {}", terminal.toned(Tone::Faint, &line));
        }
        show(&mut text, &figure_table(&report.figures[common.len()..], units));
        for line in
            agreement(report).iter().chain(&report.notes).flat_map(|own| wrapped(own, WIDTH - 2))
        {
            let _ = writeln!(text, "  {line}");
        }
        if is_plotted && let Some(series) = figure(report, units) {
            let _ = write!(text, "\n{}", series.chart().text(WIDTH, PLOT_HEIGHT));
        }
    }
    text
}

/// A line of a table, cut where it is too wide.
fn cut(line: &str) -> Vec<String> {
    if crate::text::columns(line) <= WIDTH - 2 {
        vec![line.to_owned()]
    } else {
        wrapped(line, WIDTH - 6)
    }
}

fn summary(test: &str) -> &'static str {
    struct Find<'t>(&'t str, &'static str);
    impl ProtocolVisitor for Find<'_> {
        fn visit<P: ProtocolKind>(&mut self) {
            if P::KIND == self.0 {
                self.1 = P::SUMMARY;
            }
        }
    }
    let mut find = Find(test, "");
    visit_protocols(&mut find);
    find.1
}
