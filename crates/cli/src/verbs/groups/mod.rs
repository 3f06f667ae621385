//! `dashpot groups`.

mod laboratory;
mod opposed;
mod pair;
mod thesis;

use std::path::{Path, PathBuf};

use clap::Args;
use dashpot_analysis::{
    SolveSettings,
    similarity::{FourParameterImpact, Group, Groups, Quantity, Reference, SimilarityError},
};
use dashpot_network::{Network, parameters::Dimension};
use dashpot_report::Table;
use dashpot_scene::{Scene, write_scene};
use serde::Serialize;

use self::{laboratory::Test, pair::Pair, thesis::Thesis};
use crate::{
    args::{ValueArguments, refuse},
    error::{CliError, Status},
    input::{setting, title},
    operand::{note_means, print_notes, read_scene},
    out::{SceneFile, SceneText},
    output::{Study, Text, alike, emit, list, object},
    terminal::{Terminal, note},
};
use dashpot_report::numbers::{constant, significant};
use dashpot_studies::assignment;

const DIGITS: usize = 6;

/// `groups`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot groups                                   the built-in reference impact\n  \
    dashpot groups real.toml test.toml               are they similar?\n  \
    dashpot groups real.toml --lab \"mass=1 kg, speed=2 m/s, thickness=5 mm\" --out lab.toml\n  \
    dashpot groups --from \"a=26.6, b=66.66, c=8, d=80\" --out groups.toml\n\n\
    Similar scenes have one structure and equal groups; their answers differ by factors of \
    mass, length and time alone.\n\n\
    Exit codes: 0 done, or similar; 3 not similar; 2 the input is wrong, 1 a run failed.")]
pub(crate) struct GroupsArguments {
    /// File of the scene, `-` for standard input, or a built-in scene [default: reference].
    #[arg(value_name = "A")]
    first: Option<PathBuf>,
    /// Another scene: is it similar, and if not, what does each group do?
    #[arg(value_name = "B", conflicts_with_all = ["lab", "from"])]
    second: Option<PathBuf>,
    /// Groups are equal within this, relative.
    #[arg(long, value_name = "NUMBER", default_value = "1e-12", value_parser = within)]
    within: f64,
    /// Designs the laboratory test with these values: `mass`, `speed`, `thickness`, or any
    /// parameter by its name; what is left open stays as it is.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, conflicts_with = "from")]
    lab: Vec<(String, String)>,
    /// Takes other groups of the thesis (A, B, a, b, c, d, alpha, beta, gamma), and the parameters
    /// that follow from them.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment)]
    from: Vec<(String, String)>,
    #[command(flatten)]
    values: ValueArguments,
    /// File to write the scene of `--lab` or `--from` to.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    force: bool,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

fn within(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("it must be a number from 0 to 1, such as 1e-12".to_owned()),
    }
}

struct GroupsStudy {
    /// What the groups are of.
    scene: String,
    groups: Groups,
    /// Those of the thesis, for scenes of its form.
    thesis: Option<Thesis>,
    /// Another scene beside this one.
    pair: Option<Pair>,
    laboratory: Option<Test>,
}

/// Tells of groups, similar scenes and laboratory tests.
pub(crate) fn groups(arguments: &GroupsArguments, terminal: Terminal) -> Result<Status, CliError> {
    let set = &arguments.values.set;
    if arguments.second.is_none() {
        refuse(&["--within"], "it is about two scenes, A and B")?;
    }
    if arguments.lab.is_empty() && arguments.from.is_empty() {
        refuse(&["--out"], "a scene is made by `--lab` or `--from`")?;
    }
    let scene = read_scene(arguments.first.as_deref(), set, terminal)?;
    if let Some(path) = &arguments.out {
        SceneFile::new(path, arguments.force)?;
    }
    let mut network = scene.network.clone();
    let mut name = title(&scene).to_owned();
    if !arguments.from.is_empty() {
        network = with_groups(&network, &arguments.from)?;
        name = format!("{name}, with other groups");
    }
    let mut study = GroupsStudy {
        scene: name,
        groups: Groups::of(&network).map_err(SimilarityError::from)?,
        thesis: FourParameterImpact::of(&network).ok().map(Thesis::of),
        pair: None,
        laboratory: None,
    };
    let other = arguments.second.as_deref().map(|second| read_scene(Some(second), set, terminal));
    let other = other.transpose()?;
    if let Some(other) = &other {
        study.pair = Some(Pair::of(&scene, other, arguments)?);
    }
    if !arguments.lab.is_empty() {
        study.laboratory = Some(Test::of(&scene, arguments)?);
    } else if let Some(path) = &arguments.out {
        let title = format!("{} (groups {})", title(&scene), pairs(&arguments.from));
        let settings = scene.settings("auto")?;
        write(path, &title, &network, &settings, (&scene, arguments))?;
        note(&format!("wrote {}", path.display()));
    }
    for own in [&scene].into_iter().chain(&other) {
        print_notes(&own.notes);
        note_means(own, terminal);
    }
    emit(&study, arguments.json, None, terminal)?;
    let is_other = study.pair.is_some_and(|pair| !pair.found.is_similar());
    Ok(if is_other { Status::NotSame } else { Status::Done })
}

fn with_groups(network: &Network, wanted: &[(String, String)]) -> Result<Network, CliError> {
    let mut groups = FourParameterImpact::of(network)?.groups();
    for (name, text) in wanted {
        groups = groups.with(name, setting(name, text, Dimension::NUMBER)?)?;
    }
    Ok(groups.put_into(network)?)
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
        at_most: None,
        stops: settings.stops.clone(),
        ..scene.run.clone()
    };
    let name = arguments
        .first
        .as_deref()
        .map_or("reference".to_owned(), |first| first.display().to_string());
    let wish = if arguments.lab.is_empty() { &arguments.from } else { &arguments.lab };
    let comment = format!("Made from {name} for {}.", pairs(wish));
    let text = write_scene(title, &[comment], network, &run, settings)?;
    SceneFile { path, force: arguments.force }.write(&SceneText { text: &text, file: "", set: &[] })
}

fn pairs(all: &[(String, String)]) -> String {
    let pairs: Vec<String> = all.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    pairs.join(", ")
}

impl Study for GroupsStudy {
    fn text(&self, text: &mut Text) {
        text.title(&self.scene);
        if let Some(pair) = &self.pair {
            return pair.text(text);
        }
        if let Some(test) = &self.laboratory {
            return test.text(text);
        }
        if let Some(thesis) = &self.thesis {
            text.table(&thesis.table());
            text.blank();
            text.paragraphs([thesis.parameters(), thesis.independent(), thesis.region()]);
        }
        text.table(&self.table());
        text.blank();
        text.paragraphs([self.summary()]);
    }

    fn object(&self) -> impl Serialize {
        let groups = &self.groups;
        object! {
            scene: &self.scene,
            parameters: groups.groups.len() + groups.references.len(),
            rank: groups.rank(),
            references: list(groups.references.iter().map(|reference| quantity(reference.symbol, &reference.quantity))),
            groups: list(groups.groups.iter().map(|group| object! {
                parameter: &group.quantity.name, formula: &group.formula, value: group.value,
            })),
            thesis: self.thesis.as_ref().map(Thesis::object),
            similarity: self.pair.as_ref().map(Pair::object),
            laboratory: self.laboratory.as_ref().map(Test::object),
        }
    }
}

impl GroupsStudy {
    /// The groups that are not zero, those of the points of a curve together.
    fn table(&self) -> Table {
        let rows = alike(self.groups.groups.iter().filter(|own| own.value != 0.0), |one, other| {
            one.quantity.of_curve.is_some() && one.quantity.of_curve == other.quantity.of_curve
        });
        let row = |row: &Vec<&Group>| {
            let formula = row[0].formula.clone();
            let ends = [f64::min, f64::max].map(|end| row.iter().map(|own| own.value).reduce(end));
            match (row[0].quantity.of_curve.as_ref(), ends) {
                (Some(curve), [Some(least), Some(most)]) if row.len() > 1 => {
                    let units = formula.strip_prefix(&row[0].quantity.name).unwrap_or_default();
                    let [least, most] = [least, most].map(|own| significant(own, DIGITS));
                    let values = format!("{least} to {most} at {} points", row.len());
                    vec![format!("{curve}{units}"), values]
                }
                _ => vec![formula, significant(row[0].value, DIGITS)],
            }
        };
        Table::new("Independent groups", &["group", "value"], rows.iter().map(row))
    }

    /// How many groups there are, and what they refer to.
    fn summary(&self) -> String {
        let Groups { groups, references, .. } = &self.groups;
        let count = match groups.iter().filter(|group| group.value == 0.0).count() {
            0 => format!("{} groups", groups.len()),
            zero => format!("{} groups, {zero} of them 0 and not shown", groups.len()),
        };
        let one = |Reference { symbol, quantity }: &Reference| {
            let value = constant(quantity.value, si(quantity.dimension));
            format!("{symbol} = {} = {value}", quantity.name)
        };
        format!(
            "{} parameters, whose dimensions have the rank {}: {count}, by {}.",
            groups.len() + references.len(),
            self.groups.rank(),
            list(references.iter().map(one)).join(", ")
        )
    }
}

/// The object of a reference.
fn quantity(symbol: &'static str, quantity: &Quantity) -> impl Serialize {
    object! { symbol, name: &quantity.name, value: quantity.value, unit: si(quantity.dimension) }
}

/// The SI unit of a dimension; that without a name is left out.
fn si(dimension: Dimension) -> &'static str {
    dimension.named().map_or("", |own| own.1)
}

/// Tells of what was not compared.
fn left_out(text: &mut Text, all: &[String]) {
    if !all.is_empty() {
        text.blank();
        let names = all.join(", ");
        text.paragraphs([format!("Not compared, because they have times of their own: {names}.")]);
    }
}
