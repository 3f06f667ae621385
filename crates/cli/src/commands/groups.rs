//! `dashpot groups`.

use std::{fmt::Write as _, path::Path};

use dashpot_analysis::{
    SolveSettings,
    similarity::{
        FourParameterImpact, Groups, Laboratory, Similarity, SimilarityError, Wish, alone,
        measured, similar_settings,
    },
};
use dashpot_network::{Network, parameters::Dimension};
use dashpot_plot::Table;
use dashpot_scene::{Scene, units::parse_quantity, write_scene};

use crate::{
    answer::{
        groups::{Mover, Opposed, SideBySide, Test, Told},
        title,
    },
    args::GroupsArguments,
    error::{CliError, Status},
    input::read_scene,
    numbers::bound,
    operand::tell,
    part::write_text,
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data, remark},
    text::{columns, wrapped},
};

/// So many groups are moved one at a time; more would take long and say little.
const MOST_ALONE: usize = 12;

/// Tells of groups, similar scenes and laboratory tests.
pub(crate) fn groups(arguments: &GroupsArguments, terminal: Terminal) -> Result<Status, CliError> {
    let scene = read(arguments.first.as_deref(), arguments, terminal)?;
    let mut network = scene.network.clone();
    let mut name = title(&scene).to_owned();
    if !arguments.from.is_empty() {
        network = with_groups(&network, &arguments.from)?;
        name = format!("{name}, with other groups");
    }
    let thesis = FourParameterImpact::of(&network).ok();
    let found = Groups::of(&network).map_err(SimilarityError::from)?;
    let mut told = Told::new(name, &found, thesis);
    let mut status = Status::Done;
    if let Some(second) = &arguments.second {
        let other = read(Some(second), arguments, terminal)?;
        let pair = [&arguments.first, &arguments.second];
        let names =
            pair.map(|own| own.as_ref().map_or(String::new(), |own| own.display().to_string()));
        let found = side_by_side(names, (&scene, &other), arguments)?;
        if !found.similar {
            status = Status::NotSame;
        }
        told.similarity = Some(found);
    }
    if !arguments.lab.is_empty() {
        told.laboratory = Some(laboratory(&scene, arguments)?);
    } else if let Some(path) = &arguments.out {
        let title = format!("{} (groups {})", title(&scene), pairs(&arguments.from));
        let settings = scene.settings("auto");
        write(path, &title, &network, &settings, (&scene, arguments))?;
        remark(&format!("wrote {}", path.display()));
    }
    if arguments.json {
        print_data(&(serde_json::to_string_pretty(&told)? + "\n"))?;
    } else {
        print(&text(&told, terminal))?;
    }
    Ok(status)
}

fn read(
    path: Option<&Path>,
    arguments: &GroupsArguments,
    terminal: Terminal,
) -> Result<Scene, CliError> {
    let checked = read_scene(path, &arguments.values.set)?;
    terminal.diagnose(&checked.warnings);
    tell(&checked.value.notes);
    Ok(checked.value)
}

fn with_groups(network: &Network, wanted: &[(String, String)]) -> Result<Network, CliError> {
    let mut groups = FourParameterImpact::of(network)?.groups();
    for (name, text) in wanted {
        groups = groups.with(name, quantity(name, text, Dimension::NUMBER)?)?;
    }
    Ok(groups.put_into(network)?)
}

fn side_by_side(
    names: [String; 2],
    (first, second): (&Scene, &Scene),
    arguments: &GroupsArguments,
) -> Result<SideBySide, CliError> {
    let similarity = Similarity::between(&first.network, &second.network, arguments.within);
    let similarity = similarity.map_err(SimilarityError::from)?;
    let mut found = SideBySide::of(names, &similarity);
    let settings = first.settings("auto");
    found.left_out = similar_settings(&settings, &similarity.scale).1;
    found.other_pads = other_pads(&similarity.networks);
    if similarity.structure.is_empty() || similarity.differs_in_effects() {
        let [one, other] = &similarity.networks;
        let pairs = measured(one, other, &similarity.scale, &settings)?;
        found.measures = pairs.iter().map(Opposed::of).collect();
        if similarity.different().count() <= MOST_ALONE {
            let movers = alone(one, &similarity, &settings)?;
            found.alone = movers.iter().map(Mover::of).collect();
        }
    }
    Ok(found)
}

/// The elements whose parts have thicknesses of their own in one of two scenes only.
fn other_pads([first, second]: &[Network; 2]) -> Vec<String> {
    let pairs = first.connections().iter().zip(second.connections());
    let differ = pairs.filter(|(one, other)| one.pads.len() != other.pads.len());
    differ.map(|own| own.0.name.clone()).collect()
}

fn laboratory(scene: &Scene, arguments: &GroupsArguments) -> Result<Test, CliError> {
    let real = &scene.network;
    let wish = |(name, text): &(String, String)| {
        let dimension = Laboratory::parameter(real, name)?.dimension;
        Ok(Wish { name: name.clone(), value: quantity(name, text, dimension)? })
    };
    let wishes = arguments.lab.iter().map(wish).collect::<Result<Vec<_>, CliError>>()?;
    let laboratory = Laboratory::design(real, &wishes)?;
    let settings = scene.settings("auto");
    let (similar, left_out) = similar_settings(&settings, &laboratory.scale);
    let mut test = Test::of(&laboratory);
    test.left_out = left_out;
    let pairs = measured(real, &laboratory.network, &laboratory.scale, &settings)?;
    test.measures = pairs.iter().map(Opposed::read).collect();
    if test.gravity().is_some() {
        let other = laboratory.under_real_gravity()?;
        let pairs = measured(real, &other, &laboratory.scale, &settings)?;
        test.with_own_gravity = pairs.iter().map(Opposed::of).collect();
    }
    if let Some(path) = &arguments.out {
        let title = format!("Laboratory test for: {}", title(scene));
        write(path, &title, &laboratory.network, &similar, (scene, arguments))?;
        test.written = Some(path.display().to_string());
    }
    Ok(test)
}

/// Writes a scene with the settings of a run.
fn write(
    path: &Path,
    title: &str,
    network: &Network,
    settings: &SolveSettings,
    (scene, arguments): (&Scene, &GroupsArguments),
) -> Result<(), CliError> {
    let run = dashpot_scene::RunSettings {
        duration: settings.duration,
        stops: settings.stops.clone(),
        ..scene.run.clone()
    };
    let name =
        arguments.first.as_deref().map_or("reference".to_owned(), |own| own.display().to_string());
    let wish = if arguments.lab.is_empty() { &arguments.from } else { &arguments.lab };
    let comment = format!("Made from {name} for {}.", pairs(wish));
    let text = write_scene(title, &[comment], network, &run, &settings.measures)?;
    write_text(path, &text, arguments.force)
}

fn pairs(all: &[(String, String)]) -> String {
    let pairs: Vec<String> = all.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    pairs.join(", ")
}

/// A value of a parameter in SI units.
fn quantity(name: &str, text: &str, expected: Dimension) -> Result<f64, CliError> {
    let wrong = |reason: String| CliError::WrongSetting { name: name.to_owned(), reason };
    let found = parse_quantity(text).map_err(|error| wrong(error.to_string()))?;
    match found.dimension {
        Some(own) if own != expected => {
            let unit = |own: Dimension| own.named().map_or("another unit", |own| own.1);
            Err(wrong(format!("`{text}` is in {}, where {} is wanted", unit(own), unit(expected))))
        }
        _ if found.angle != 0 => Err(wrong(format!("`{text}` is an angle or angular frequency"))),
        _ => Ok(found.value),
    }
}

fn text(told: &Told, terminal: Terminal) -> String {
    let mut text = String::new();
    heading(&mut text, &told.scene, Tone::Heading, terminal);
    if let Some(found) = &told.similarity {
        similarity(&mut text, found, terminal);
        return text;
    }
    if let Some(test) = &told.laboratory {
        laboratory_text(&mut text, test, terminal);
        return text;
    }
    if let Some(thesis) = &told.thesis {
        section(&mut text, &thesis.table(), terminal);
        text.push('\n');
        paragraph(&mut text, &thesis.parameters());
        paragraph(&mut text, &thesis.independent());
        paragraph(&mut text, &thesis.region());
    }
    section(&mut text, &told.table(), terminal);
    text.push('\n');
    let count = told.count();
    paragraph(
        &mut text,
        &format!(
            "{} parameters, whose dimensions have the rank {}: {count}, by {}.",
            told.parameters,
            told.rank,
            told.references()
        ),
    );
    text
}

fn similarity(text: &mut String, found: &SideBySide, terminal: Terminal) {
    let [first, second] = &found.compared;
    let (verdict, tone) =
        if found.similar { ("Similar", Tone::Heading) } else { ("Not similar", Tone::Warning) };
    heading(text, &format!("{verdict}: {first} and {second}"), tone, terminal);
    let all = found.groups.len();
    if found.similar {
        let within = bound(found.within);
        paragraph(text, &format!("All {all} groups are equal within {within}."));
    }
    for line in &found.structure {
        paragraph(text, line);
    }
    if !found.similar {
        section(text, &found.different(), terminal);
    }
    if found.structure.is_empty() && !found.scale.is_one() {
        section(text, &found.scale.table("From the first to the second"), terminal);
    }
    section(text, &found.measures(), terminal);
    section(text, &found.movers(), terminal);
    left_out(text, &found.left_out);
    if !found.other_pads.is_empty() {
        let names = found.other_pads.join(", ");
        text.push('\n');
        paragraph(
            text,
            &format!(
                "Parts of {names} have thicknesses of their own in one of both only: there strains are \
                 those of the parts, here those of the whole."
            ),
        );
    }
}

fn laboratory_text(text: &mut String, test: &Test, terminal: Terminal) {
    section(text, &test.choices(), terminal);
    section(text, &test.map(), terminal);
    section(text, &test.predicted(), terminal);
    if let Some((warning, table)) = test.gravity() {
        text.push('\n');
        for line in wrapped(&format!("! {warning}"), WIDTH) {
            let _ = writeln!(text, "{}", terminal.toned(Tone::Warning, &line));
        }
        section(text, &table, terminal);
    }
    left_out(text, &test.left_out);
    if let Some(path) = &test.written {
        let _ = writeln!(text, "\nwrote {path}; `dashpot run {path}` solves it");
    }
}

fn left_out(text: &mut String, all: &[String]) {
    if !all.is_empty() {
        text.push('\n');
        let names = all.join(", ");
        paragraph(text, &format!("Not compared, because they have times of their own: {names}."));
    }
}

fn heading(text: &mut String, content: &str, tone: Tone, terminal: Terminal) {
    for line in wrapped(content, WIDTH) {
        let _ = writeln!(text, "{}", terminal.toned(tone, &line));
    }
}

fn paragraph(text: &mut String, content: &str) {
    for line in wrapped(content, WIDTH - 2) {
        let _ = writeln!(text, "  {line}");
    }
}

fn section(text: &mut String, content: &Table, terminal: Terminal) {
    if content.rows.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, &content.caption));
    let (header, rows) = crate::text::table(content);
    for line in [header].iter().chain(&rows).filter(|line| columns(line) > 0) {
        let _ = writeln!(text, "  {line}");
    }
}
