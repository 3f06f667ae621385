//! What to do about an error.

use std::{fs, path::Path};

use dashpot_analysis::similarity::SimilarityError;
use dashpot_design::cushion::NoCushion;
use dashpot_rheology::conversion::Unfit;
use dashpot_scene::suggestion;
use dashpot_studies::{NO_LIMITS_HELP, StudyError};

use super::CliError;
use super::shards::MISSING_HELP;

impl CliError {
    /// What to do, where that can be said.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Study(StudyError::Unreadable { name, .. }) if Path::new(name).is_dir() => {
                let files = fs::read_dir(name).into_iter().flatten().flatten();
                let scenes = files.map(|own| own.path());
                let first = scenes.filter(|own| own.extension().is_some_and(|own| own == "toml"));
                let such = first.min().map(|own| format!(", such as `{}`", own.display()));
                Some("name a file in it".to_owned() + &such.unwrap_or_default())
            }
            Self::Study(error) => error.help(),
            Self::UnknownKind { near: Some(near), .. } => Some(format!("did you mean `{near}`?")),
            Self::NotMeasurable { name, known, .. } => suggestion(name, "outputs", known),
            Self::TooFewScattered { least } => Some(format!("`--scatter {least}` or more")),
            Self::Variation(fault) => Some(fault.help()),
            Self::Listed { fault, .. } => Some(fault.help()),
            Self::Tunable { fault, .. } | Self::Gradient(fault) => fault.help(),
            Self::Similarity(SimilarityError::UnknownQuantity { name, known }) => {
                let speed = "`speed` is that at the end of the drop, sqrt(2 g0 h); ";
                let speed = if name == "drop" { speed } else { "" };
                Some(format!("{speed}there are {}", known.join(", ")))
            }
            _ => self.general_help().map(str::to_owned),
        }
    }

    /// What to do about any error of a kind.
    fn general_help(&self) -> Option<&'static str> {
        Some(match self {
            Self::BeyondEnd { .. } => "give a time within it, or a longer `duration` in [run]",
            Self::Cushion(error) => cushion_help(error),
            Self::NothingToKeep { .. } => NO_LIMITS_HELP,
            Self::Shard { fault, .. } => fault.help(),
            Self::Interrupted { kept: 1.., .. } => "the same command goes on from there",
            Self::ColumnTaken { .. } => {
                "give the column of the table another heading, such as `design`"
            }
            Self::ShardsMissing { .. } => MISSING_HELP,
            Self::Contradiction { .. } => "change one of them, or leave it out",
            Self::UnknownKind { .. } => "`dashpot list` names every kind",
            Self::Foreign { help, .. } | Self::TooLarge { help, .. } => *help,
            Self::Busy { .. } => "choose another folder for `--out`, or wait until it is done",
            Self::Unfit { reason: Unfit::OtherShape { .. }, .. } => {
                "`--to generalized-maxwell` and `--to generalized-kelvin` take every model"
            }
            Self::NotReplaced { .. } => {
                "give the model a table of its own, [models.NAME], and convert that"
            }
            _ => return None,
        })
    }
}

/// What to write where a scene is no drop onto a cushion.
fn cushion_help(error: &NoCushion) -> &'static str {
    match error {
        NoCushion::NotOneBody { .. } => {
            "give one node `drop` or `velocity`, or name the one that falls: `--platen NAME`"
        }
        NoCushion::NotOnePad { .. } => {
            "give the element its `thickness` and `area`, or name it where there are several: `--pad NAME`"
        }
        NoCushion::Unknown { .. } => "write one of these names",
        NoCushion::Hangs { .. } => {
            "leave out what else is fastened to the platen; the guide of a drop tester bears no load"
        }
        NoCushion::NoArea { .. } => "give it one, `area = \"400 cm^2\"`, as the specimen has it",
        NoCushion::NoWeight { .. } => "give gravity a positive `value`, or leave it out for 1 g0",
        NoCushion::NoHeight { .. } => "give the body a `drop`, or `--heights \"30,60,90 cm\"`",
        NoCushion::NoStress { .. } => "give a range: `--stress \"1..20 kPa,40,log\"`",
        NoCushion::NoCreep { .. } => "leave `--creep` out for this cushion",
        NoCushion::Network(_)
        | NoCushion::NotPosed(_)
        | NoCushion::Run(_)
        | NoCushion::Sweep(_) => "`dashpot check SCENE` tells more",
    }
}
