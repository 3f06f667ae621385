//! What to do about an error.

use std::{fs, path::Path};

use dashpot_analysis::{RunError, similarity::SimilarityError, vibration::VibrationError};
use dashpot_dae::{MethodKind as _, SolveError, methods::Tsit45};
use dashpot_design::cushion::NoCushion;
use dashpot_rheology::conversion::Unfit;
use dashpot_scene::{suggestion, units::parse_dimension};
use dashpot_signal::{CfcFault, ChannelFault, SettingsFault};

use super::CliError;
use crate::verbs::sweep::MISSING_HELP;

impl CliError {
    /// What to do, where that can be said.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Unreadable { name, .. } if Path::new(name).is_dir() => {
                let files = fs::read_dir(name).into_iter().flatten().flatten();
                let scenes = files.map(|own| own.path());
                let first = scenes.filter(|own| own.extension().is_some_and(|own| own == "toml"));
                let such = first.min().map(|own| format!(", such as `{}`", own.display()));
                Some("name a file in it".to_owned() + &such.unwrap_or_default())
            }
            Self::Unreadable { name, similar: None, .. } if is_unit(name) => {
                Some(unquoted_help(name))
            }
            Self::Unreadable { similar: Some(near), .. }
            | Self::UnknownKind { near: Some(near), .. } => Some(format!("did you mean `{near}`?")),
            Self::Quantity { fault, .. } => fault.help(),
            Self::MeasuredTable { fault, .. } => fault.help(),
            Self::NotMeasurable { name, known, .. } => suggestion(name, "outputs", known),
            Self::SignalLimit { known, meant, .. } => Some(match meant {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("there are {}", known.join(", ")),
            }),
            Self::TooFewScattered { least } => Some(format!("`--scatter {least}` or more")),
            Self::Variation(fault) => Some(fault.help()),
            Self::Listed { fault, .. } => Some(fault.help()),
            Self::Tunable { fault, .. } | Self::Gradient(fault) => fault.help(),
            Self::Run(
                RunError::NoMeasure { key, known } | RunError::UnknownMeasure { key, known },
            ) => suggestion(key, "measures", known),
            Self::Similarity(SimilarityError::UnknownQuantity { name, known }) => {
                let speed = "`speed` is that at the end of the drop, sqrt(2 g0 h); ";
                let speed = if name == "drop" { speed } else { "" };
                Some(format!("{speed}there are {}", known.join(", ")))
            }
            Self::Vibration(VibrationError::NoDrive { known, .. }) if !known.is_empty() => {
                Some(format!("`--drive {name}` shakes `{name}`", name = known[0]))
            }
            Self::Run(RunError::Solve(SolveError::BudgetSpent { work, .. })) => Some(format!(
                "`--budget {:.0e}` grants more; a shorter `duration` or `--accuracy 1%` asks for less",
                10.0 * *work as f64
            )),
            _ => self.general_help().map(str::to_owned),
        }
    }

    /// What to do about any error of a kind.
    fn general_help(&self) -> Option<&'static str> {
        Some(match self {
            Self::BeyondEnd { .. } => "give a time within it, or a longer `duration` in [run]",
            Self::Cushion(error) => cushion_help(error),
            Self::NothingToKeep { .. } | Self::NoLimits => {
                "write [limits] in the scene, or `--limit \"head.peak-acceleration<=250 g\"`"
            }
            Self::Shard { fault, .. } => fault.help(),
            Self::Interrupted { kept: 1.., .. } => "the same command goes on from there",
            Self::ColumnTaken { .. } => {
                "give the column of the table another heading, such as `design`"
            }
            Self::ShardsMissing { .. } => MISSING_HELP,
            Self::Contradiction { .. } => "change one of them, or leave it out",
            Self::SignalSamples { fault, .. } => return sample_help(fault),
            Self::Signal { fault, .. } => return signal_help(fault),
            Self::UnknownKind { .. } => "`dashpot list` names every kind",
            Self::Unreadable { .. } => {
                "`dashpot new --out pad.toml` writes a scene to start from, `dashpot run` alone solves the built-in one"
            }
            Self::Foreign { help, .. } | Self::TooLarge { help, .. } => *help,
            Self::Busy { .. } => "choose another folder for `--out`, or wait until it is done",
            Self::Unfit { reason: Unfit::OtherShape { .. }, .. } => {
                "`--to generalized-maxwell` and `--to generalized-kelvin` take every model"
            }
            Self::NotLinear { .. } => {
                "only linear models can be converted and compared; `dashpot rheometer` tests any model, and a scene \
                 runs it"
            }
            Self::MovingMasses { .. } => "`dashpot compare` compares such networks",
            Self::MaterialAndPad | Self::MaterialInImpact { .. } => {
                "an element with `material`, `thickness` and `area` is a pad; name that"
            }
            Self::NotReplaced { .. } => {
                "give the model a table of its own, [models.NAME], and convert that"
            }
            Self::Vibration(error) => return vibration_help(error),
            Self::Run(RunError::NoneGetsThrough { .. }) => {
                "`--accuracy 1%` asks for less; a shorter `duration` gives what comes until then"
            }
            Self::Run(RunError::Solve(error)) => return solve_help(error),
            _ => return None,
        })
    }
}

/// What to do about samples that are no signal.
fn sample_help(fault: &ChannelFault) -> Option<&'static str> {
    Some(match fault {
        ChannelFault::TimeBack { .. } => {
            "the first column is that of time; sort the rows by it, and leave one of two rows of the same time; a file of \
             several tests is to be cut into one for each"
        }
        ChannelFault::TooFew { .. } => "look whether the right file was exported, and whole",
        _ => return None,
    })
}

/// What to do about a channel that cannot be read as it is asked for.
fn signal_help(fault: &SettingsFault) -> Option<&'static str> {
    Some(match fault {
        SettingsFault::NoRest => {
            "give what the channel reads at rest, `--offset \"0.3 g\"`, or record from some ms before the pulse on"
        }
        SettingsFault::UnevenSteps { .. } => {
            "`--rate \"20 kHz\"` reads the line between its samples at even steps"
        }
        SettingsFault::Rate(_) => "read a part of it, or take a lower `--rate`",
        SettingsFault::NoTouch { .. } => "without `--touch` the record tells when it begins",
        SettingsFault::Cfc(CfcFault::TooSlow { .. }) => {
            "SAE J211 wants a sampling rate of ten times the class: take a lower class, or record faster"
        }
        SettingsFault::NothingLeft(_) => {
            "look at the times of the record: without `--from`, `--to` and `--rate` they are printed"
        }
        _ => return None,
    })
}

/// What to do about a scene that cannot be shaken.
fn vibration_help(error: &VibrationError) -> Option<&'static str> {
    Some(match error {
        VibrationError::NoDrive { .. } => {
            "hold a node with `fixed = true`, or put a load on one under [loads]"
        }
        VibrationError::UnknownNode { .. } => {
            "`--of` takes a name, or a quantity behind it as in `padding.force`; `dashpot vibrate --help` lists them"
        }
        VibrationError::Loose { .. } => {
            "gravity presses parts together, `[effects]` with `gravity = { value = \"1 g0\" }`; or leave out the \
             separation: then it pulls as it pushes"
        }
        VibrationError::NotLinear { .. } | VibrationError::OnStop { .. } => {
            "`dashpot run` solves it in time: give the node that shakes `motion = { sine = { amplitude = \"1 mm\", \
             frequency = \"20 Hz\" } }` (a load likewise a `force`), a `duration` of many periods, and ask for its \
             measures with `window = \"run\"`; or leave out of [effects] what switches"
        }
        _ => return None,
    })
}

/// What to do about a solution that failed.
fn solve_help(error: &SolveError) -> Option<&'static str> {
    Some(match error {
        SolveError::NotApplicable { .. } => "`--method auto` chooses one that can",
        SolveError::TooManySteps { method, .. }
        | SolveError::StepTooSmall { method, .. }
        | SolveError::NewtonFailed { method, .. } => {
            if *method == Tsit45::KIND {
                "an explicit method takes short steps where parts are stiff, whatever the accuracy; `--method auto` \
                 chooses one that suits"
            } else {
                "`--method auto` tries another method where one gets stuck; `--accuracy 1%` asks for less"
            }
        }
        SolveError::TooLarge { .. } => {
            "a shorter `duration`, or a condition under [run] that ends it, keeps less"
        }
        SolveError::TooManySwitches { .. } => {
            "what loses nothing in its impacts bounces for ever, ever lower as others lose speed: a `restitution` \
             below 1 lets it come to rest; or a shorter `duration`"
        }
        _ => return None,
    })
}

/// Whether a word is a unit, which belongs to the quantity before it.
pub(crate) fn is_unit(word: &str) -> bool {
    !["", "1"].contains(&word.trim()) && parse_dimension(word).is_ok()
}

/// What to write where the blank before a unit has divided a quantity.
pub(crate) fn unquoted_help(unit: &str) -> String {
    format!("`{unit}` is a unit: quote what belongs together, such as \"K=25 {unit}\"")
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
