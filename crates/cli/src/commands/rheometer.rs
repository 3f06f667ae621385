//! `dashpot rheometer`.

use std::{f64::consts::TAU, fmt::Write as _, fs, path::Path};

use dashpot_analysis::rheometer::{
    ProtocolKind, ProtocolVisitor, RheometerReport, Series, Specimen, protocol, visit_protocols,
};
use dashpot_network::parameters::{Dimension, ParameterKind};
use dashpot_plot::{
    Measured, ModelSeries, ModelSubject, RheometerLine, RheometerSeries, Table,
    figures::model::{LossFactor, MODEL_FIGURES, ModelFigure, Sweep},
};
use dashpot_scene::units::parse_quantity;

use crate::{
    answer::rheometer::{
        Document, Units, agreement, characteristics, figure_table, missing, settings,
        spectrum_table,
    },
    args::{RheometerArguments, When},
    error::{CliError, Status},
    folder::{prepare_for, unwritable},
    operand::{Operand, canonical_model},
    terminal::{Terminal, Tone, WIDTH, note, print},
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
    if let Some(path) = &arguments.out {
        prepare_for(path, file_names(&tests(arguments)))?;
    }
    let given = given(arguments, units)?;
    let mut reports = Vec::new();
    for test in tests(arguments) {
        let own: Vec<(&str, f64)> =
            given.iter().filter(|own| has_parameter(&test, own.0)).copied().collect();
        match protocol(&test, &own)?.run(&specimen, &methods) {
            Ok(report) => reports.push(report),
            // One test alone was asked for; of all of them, the others go on.
            Err(error) if arguments.test.is_empty() => note(&format!("note: {error}")),
            Err(error) => return Err(error.into()),
        }
    }
    let document = Document::of(&operand.word, units, &specimen, &reports);
    let json = serde_json::to_string_pretty(&document)? + "\n";
    if arguments.json {
        print(&json)?;
    } else {
        print(&text(&operand, units, &specimen, &reports, (arguments.plot, terminal)))?;
    }
    if let Some(path) = &arguments.out {
        let names = write(path, &json, units, (&operand.word, &specimen), &reports)?;
        let listing = format!("wrote {} to {}", names.join(", "), path.display());
        let listing = wrapped(&listing, WIDTH).join("\n");
        if arguments.json { note(&listing) } else { print(&format!("\n{listing}\n"))? }
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

/// The points of a series, from the model and from the first computation.
fn points(report: &RheometerReport, series: &Series) -> [Vec<(f64, f64)>; 2] {
    let places = &report.abscissa.values;
    let model = places.iter().copied().zip(series.model.iter().copied());
    let computed = series.computed.first().map_or(&[][..], |own| &own.values);
    let computed = places.iter().zip(computed).filter_map(|(&at, value)| Some((at, (*value)?)));
    [model.collect(), computed.collect()]
}

/// A test over time as a figure; a sweep is one of the model's.
fn figure(report: &RheometerReport, units: Units) -> Option<RheometerSeries> {
    let series = report.series.first().filter(|_| report.abscissa.unit == "s")?;
    let [model, simulated] = points(report, series);
    let measured = match (series.unit, units.is_material) {
        ("N", false) => Measured::Force,
        ("N", true) => Measured::Stress,
        (_, false) => Measured::Deformation,
        (_, true) => Measured::Strain,
    };
    let line = |at: f64, label: &str| RheometerLine { at, label: label.to_owned() };
    let lasting = report.figure("stays for good").and_then(|own| own.model);
    let held = report.settings.iter().filter(|own| matches!(own.name, "hold" | "rise"));
    let held: f64 = held.map(|own| own.value).sum();
    Some(RheometerSeries {
        title: report.protocol.to_owned(),
        measured,
        model,
        simulated,
        levels: lasting.map(|own| line(own, "ε3, stays for good")).into_iter().collect(),
        instants: (held > 0.0 && measured_under_force(measured))
            .then(|| line(held, "unloading"))
            .into_iter()
            .collect(),
    })
}

fn measured_under_force(measured: Measured) -> bool {
    matches!(measured, Measured::Deformation | Measured::Strain)
}

/// The files of these tests.
fn file_names(tests: &[String]) -> Vec<String> {
    let models = MODEL_FIGURES.iter().map(|own| format!("model-{}.svg", own.name()));
    let tests = tests.iter().flat_map(|test| [format!("{test}.csv"), format!("{test}.svg")]);
    models.chain(tests).collect()
}

/// Writes everything into the folder `path`, and returns the names of the files.
fn write(
    path: &Path,
    json: &str,
    units: Units,
    (word, specimen): (&str, &Specimen),
    reports: &[RheometerReport],
) -> Result<Vec<String>, CliError> {
    let mut files = vec![(crate::folder::RESULT.to_owned(), json.to_owned())];
    let subject = if units.is_material { ModelSubject::Material } else { ModelSubject::Pad };
    let curves = curves(word, specimen, reports);
    for own in MODEL_FIGURES {
        let is_swept = [Sweep.name(), LossFactor.name()].contains(&own.name());
        let shown = if is_swept { &curves[..] } else { &curves[..1] };
        files.push((format!("model-{}.svg", own.name()), own.chart(shown, subject).svg()?));
    }
    for report in reports {
        files.push((format!("{}.csv", report.protocol), csv(report, units)));
        if let Some(series) = figure(report, units) {
            files.push((format!("{}.svg", report.protocol), series.chart().svg()?));
        }
    }
    for (name, content) in &files {
        let file = path.join(name);
        fs::write(&file, content).map_err(unwritable(&file))?;
    }
    Ok(files.into_iter().map(|own| own.0).collect())
}

/// The model's own functions, and what a sweep of the network found.
fn curves(word: &str, specimen: &Specimen, reports: &[RheometerReport]) -> Vec<ModelSeries> {
    /// Points of a curve, and how far beyond the times of the model it goes.
    const POINTS: i32 = 400;
    const BEYOND: f64 = 100.0;
    let (fastest, slowest) = specimen.range_of_times();
    let (low, high) = (fastest / BEYOND, slowest * BEYOND);
    let times: Vec<f64> =
        (0..=POINTS).map(|at| low * (high / low).powf(f64::from(at) / f64::from(POINTS))).collect();
    let linear = specimen.linear();
    let over = |value: &dyn Fn(f64) -> f64, places: &[f64]| {
        places.iter().map(|&at| (at, value(at))).filter(|own| own.1.is_finite()).collect::<Vec<_>>()
    };
    let omegas: Vec<f64> = times.iter().rev().map(|time| time.recip()).collect();
    let spectrum = linear.maxwell().map(|form| form.elements()).unwrap_or_default();
    let model = ModelSeries {
        name: word.to_owned(),
        relaxation: over(&|t| linear.relaxation(t), &times),
        spectrum: spectrum.iter().map(|own| (own.relaxation_time, own.stiffness)).collect(),
        creep: over(&|t| linear.creep(t), &times),
        storage: over(&|omega| linear.storage(omega), &omegas),
        loss: over(&|omega| linear.loss(omega), &omegas),
        loss_factor: over(&|omega| linear.loss_factor(omega), &omegas),
        markers: Vec::new(),
    };
    let sweep = reports.iter().find(|report| report.abscissa.unit == "Hz");
    let network = sweep.map(|report| {
        let of = |name: &str| {
            let found = report.series(name).map(|series| points(report, series)[1].clone());
            found.unwrap_or_default().into_iter().map(|(at, value)| (TAU * at, value)).collect()
        };
        ModelSeries {
            name: "network".to_owned(),
            storage: of("storage stiffness"),
            loss: of("loss stiffness"),
            loss_factor: of("loss factor"),
            ..ModelSeries::default()
        }
    });
    [model].into_iter().chain(network).collect()
}

/// A test as CSV.
fn csv(report: &RheometerReport, units: Units) -> String {
    let header = |name: &str, unit| format!("{name} [{}]", units.of(unit));
    let mut columns: Vec<(String, Vec<String>)> = Vec::new();
    let number =
        |value: &f64| if value.is_finite() { format!("{:?}", value + 0.0) } else { String::new() };
    for own in [Some(&report.abscissa), report.drive.as_ref()].into_iter().flatten() {
        columns.push((header(&own.name, own.unit), own.values.iter().map(number).collect()));
    }
    for series in &report.series {
        columns.push((header(series.name, series.unit), series.model.iter().map(number).collect()));
        for (own, by) in series.computed.iter().zip(&report.computations) {
            let name = format!("{} by {}", series.name, by.method);
            let values = own.values.iter().map(|own| own.as_ref().map(number).unwrap_or_default());
            columns.push((header(&name, series.unit), values.collect()));
        }
    }
    let mut text = columns.iter().map(|own| own.0.as_str()).collect::<Vec<_>>().join(",") + "\n";
    for row in 0..report.abscissa.values.len() {
        let cells = columns.iter().map(|own| own.1.get(row).map_or("", String::as_str));
        text += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    text
}
