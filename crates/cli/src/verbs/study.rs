//! The verbs that are studies: their arguments follow from what a study says of itself.

use std::{cell::OnceCell, ffi::OsString, path::PathBuf};

use clap::{
    Arg, ArgAction, ArgMatches, Args as _, Command, FromArgMatches, Subcommand,
    builder::{PossibleValue, PossibleValuesParser},
    parser::ValueSource,
    value_parser,
};
use dashpot_report::Report;
use dashpot_studies::{
    Answer, Given, Kind, Operands, OptionInfo, Outcome, STUDIES, Study as AnyStudy,
};
use serde::Serialize;

use crate::{
    args::{MODEL, MethodNames, SCENE, ValueArguments, When},
    error::{CliError, Status},
    folder::Staged,
    operand::Surroundings,
    output::{PAGE, Study, Text, emit},
    terminal::Terminal,
};

/// Options of the command for every study.
const OUT: &str = "out";
const JSON: &str = "json";
const PLOT: &str = "plot";
/// The operand of a study of a scene.
const OF_SCENE: &str = "scene";
/// The operands of a study of files.
const FILES: &str = "files";

/// A study as it is asked for.
pub(crate) struct StudyArguments {
    study: &'static dyn AnyStudy,
    operands: Vec<OsString>,
    set: Vec<(String, String)>,
    given: Vec<(String, Given)>,
    out: Option<PathBuf>,
    json: bool,
    plot: When,
}

impl std::fmt::Debug for StudyArguments {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct(self.study.word())
            .field(OF_SCENE, &self.operands)
            .finish_non_exhaustive()
    }
}

fn named(word: &str) -> Option<&'static dyn AnyStudy> {
    STUDIES.iter().copied().find(|study| study.word() == word)
}

/// The command of a study.
fn command(study: &dyn AnyStudy) -> Command {
    let mut command = Command::new(study.word()).after_help(study.manual());
    match study.operands() {
        Operands::Scene => {
            command = command.arg(
                Arg::new(OF_SCENE)
                    .value_name("SCENE")
                    .value_parser(value_parser!(OsString))
                    .help(SCENE),
            );
        }
        Operands::Files(help) => {
            let files = Arg::new(FILES).value_name("FILE").help(help).required(true);
            let files = files.num_args(1..).action(ArgAction::Append);
            command = command.arg(files.value_parser(value_parser!(OsString)));
        }
        Operands::Models(operands) => {
            for (name, help) in operands {
                let help = if help.is_empty() { MODEL } else { help };
                let operand = Arg::new(*name).value_name(name.to_uppercase()).help(help);
                command = command.arg(operand.value_parser(value_parser!(OsString)).required(true));
            }
        }
    }
    command = command.args(study.options().iter().map(option));
    if has_values(study) {
        command = ValueArguments::augment_args(command);
    }
    if study.has_files() {
        let out = Arg::new(OUT).long(OUT).value_name("DIR").value_parser(value_parser!(PathBuf));
        command = command.arg(out.help(
            "Folder for CSV, JSON, SVG and report.html with all on one page; it is made if need be",
        ));
    }
    let json = Arg::new(JSON).long(JSON).action(ArgAction::SetTrue);
    command = command.arg(json.help("Prints one JSON object, in SI units, in place of text"));
    if study.has_files() {
        let plot = Arg::new(PLOT).long(PLOT).value_name("WHEN").default_value("auto");
        let plot = plot.value_parser(value_parser!(When)).conflicts_with(JSON);
        command = command.arg(plot.help("Plots in the text; `auto` draws them on terminals"));
    }
    // The arguments that were added have sentences of their own.
    command.about(study.about())
}

/// Whether values of what it is asked about can be set.
fn has_values(study: &dyn AnyStudy) -> bool {
    !matches!(study.operands(), Operands::Files(_))
}

fn option(info: &OptionInfo) -> Arg {
    let arg = Arg::new(info.name).long(info.flag()).help(info.about());
    let arg = if info.alias.is_empty() { arg } else { arg.alias(info.alias) };
    let check = info.check;
    let arg = match info.kind {
        Kind::Switch => {
            let arg = arg.action(ArgAction::SetTrue);
            return if info.requires.is_empty() { arg } else { arg.requires(info.requires) };
        }
        Kind::Words(words) => {
            let value = |(word, about)| match about {
                "" => PossibleValue::new(word),
                about => PossibleValue::new(word).help(about),
            };
            arg.value_parser(MethodNames(PossibleValuesParser::new(words().into_iter().map(value))))
        }
        _ => arg.value_parser(move |text: &str| {
            check(&Given::Text(text.to_owned())).map(|()| text.to_owned())
        }),
    };
    let arg = match info.several {
        Some(true) => arg.action(ArgAction::Append).value_delimiter(','),
        Some(false) => arg.action(ArgAction::Append),
        None => arg,
    };
    let arg = if info.default.is_empty() { arg } else { arg.default_value(info.default) };
    let arg = if info.requires.is_empty() { arg } else { arg.requires(info.requires) };
    arg.value_name(info.place)
        .allow_hyphen_values(matches!(info.kind, Kind::Quantity(_) | Kind::Amount))
}

impl FromArgMatches for StudyArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let unknown = || clap::Error::new(clap::error::ErrorKind::InvalidSubcommand);
        let (word, matches) = matches.subcommand().ok_or_else(unknown)?;
        let study = named(word).ok_or_else(unknown)?;
        let operands = match study.operands() {
            Operands::Scene => vec![OF_SCENE],
            Operands::Files(_) => vec![FILES],
            Operands::Models(operands) => operands.iter().map(|operand| operand.0).collect(),
        };
        let operands =
            operands.into_iter().filter_map(|name| matches.get_many::<OsString>(name)).flatten();
        let is_given =
            |info: &&OptionInfo| matches.value_source(info.name) == Some(ValueSource::CommandLine);
        let mut given = Vec::new();
        for info in study.options().iter().filter(is_given) {
            if matches!(info.kind, Kind::Switch) {
                given.push((info.name.to_owned(), Given::Switch(true)));
                continue;
            }
            let values = matches.get_many::<String>(info.name).into_iter().flatten();
            given.extend(values.map(|text| (info.name.to_owned(), Given::Text(text.clone()))));
        }
        let has_files = study.has_files();
        Ok(Self {
            study,
            operands: operands.cloned().collect(),
            set: if has_values(study) {
                ValueArguments::from_arg_matches(matches)?.set
            } else {
                Vec::new()
            },
            given,
            out: if has_files { matches.get_one(OUT).cloned() } else { None },
            json: matches.get_flag(JSON),
            plot: if has_files {
                matches.get_one(PLOT).copied().unwrap_or_default()
            } else {
                When::Never
            },
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Subcommand for StudyArguments {
    fn augment_subcommands(parent: Command) -> Command {
        STUDIES.iter().fold(parent, |parent, study| parent.subcommand(command(*study)))
    }

    fn augment_subcommands_for_update(parent: Command) -> Command {
        Self::augment_subcommands(parent)
    }

    fn has_subcommand(word: &str) -> bool {
        named(word).is_some()
    }
}

/// An answer with its report.
struct Shown<'a> {
    answer: &'a dyn Answer,
    report: OnceCell<Report>,
    is_plotted: bool,
}

impl StudyArguments {
    /// Asks the study, and shows what it answers.
    pub(crate) fn run(&self, terminal: Terminal) -> Result<Status, CliError> {
        let mut surroundings = Surroundings::of(self.study.word(), terminal);
        surroundings.out.clone_from(&self.out);
        let operands: Vec<String> =
            self.operands.iter().map(|operand| surroundings.name(operand)).collect();
        let answer = self.study.solve((&operands, &self.set), &self.given, &mut surroundings);
        let folder = surroundings.folder()?;
        let answer = answer?;
        let is_plotted = self.plot.is_now(terminal.output.attended);
        let shown = Shown { answer: &*answer, report: OnceCell::new(), is_plotted };
        emit(&shown, self.json, folder, terminal)?;
        Ok(match answer.outcome() {
            Outcome::Done => Status::Done,
            Outcome::Failed => Status::RunFailed,
            Outcome::NotSame => Status::NotSame,
            Outcome::LimitNotKept => Status::LimitNotKept,
        })
    }
}

impl Shown<'_> {
    fn report(&self) -> &Report {
        self.report.get_or_init(|| self.answer.report())
    }
}

impl Study for Shown<'_> {
    fn text(&self, text: &mut Text) {
        text.report(self.report(), self.is_plotted);
    }

    fn warnings(&self) -> Vec<String> {
        self.answer.warnings()
    }

    fn object(&self) -> impl Serialize {
        self.answer
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        for table in self.answer.tables() {
            files.add_with(table.file.clone(), |out| table.write(out))?;
        }
        files.add(PAGE, self.report().html()?)?;
        for figure in self.report().figures() {
            files.add(figure.file.clone(), figure.drawn()?.svg)?;
        }
        Ok(())
    }
}
