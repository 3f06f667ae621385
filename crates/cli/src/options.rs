//! The options of verbs, for programs that give them by name.

use clap::{Arg, ArgAction, CommandFactory};

use crate::verbs::Arguments;

/// The SI units of quantities, by what their places in the help are named.
const UNITS: [(&str, &str); 8] = [
    ("ACCELERATION", "m/s^2"),
    ("FREQUENCY", "Hz"),
    ("LENGTHS", "m"),
    ("MASS", "kg"),
    ("PRESSURES", "Pa"),
    ("SPEED", "m/s"),
    ("TIME", "s"),
    ("TIMES", "s"),
];

/// An option of a verb.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VerbOption {
    /// Its name, without the dashes before it.
    pub name: String,
    /// Whether each of several values has the option before it; otherwise commas divide them.
    pub is_repeated: bool,
    /// The SI unit of its numbers; empty where it has no quantity of one dimension.
    pub unit: &'static str,
    /// The words that it takes, where it takes no others.
    pub words: Vec<String>,
}

/// The options of a verb; `None` where there is no such verb.
pub fn options(verb: &str) -> Option<Vec<VerbOption>> {
    let mut command = Arguments::command();
    command.build();
    let own = command.find_subcommand(verb)?.get_arguments();
    Some(own.filter_map(option).collect())
}

fn option(own: &Arg) -> Option<VerbOption> {
    let is_asking = matches!(own.get_action(), ArgAction::Help | ArgAction::HelpShort);
    let name = own.get_long().filter(|_| !is_asking)?.to_owned();
    Some(VerbOption {
        name,
        is_repeated: matches!(own.get_action(), ArgAction::Append),
        unit: UNITS.iter().find(|unit| unit.0 == place(own)).map_or("", |unit| unit.1),
        words: own.get_possible_values().iter().map(|own| own.get_name().to_owned()).collect(),
    })
}

/// What the place of its value in the help is named.
fn place(own: &Arg) -> &str {
    let name = own.get_value_names().and_then(|names| names.first());
    name.map_or("", |name| name.trim_end_matches(",…"))
}

#[cfg(test)]
mod tests {
    use clap::{Command, CommandFactory};
    use dashpot_scene::units::parse_dimension;

    use super::{UNITS, options, place};
    use crate::verbs::Arguments;

    #[test]
    fn options_say_what_they_take() {
        let own = options("cushion").unwrap();
        let of = |name: &str| own.iter().find(|own| own.name == name).unwrap();
        assert_eq!((of("stress").unit, of("stress").is_repeated), ("Pa", false));
        assert_eq!((of("set").unit, of("set").is_repeated), ("", true));
        assert!(of("creep").is_repeated && of("method").words.contains(&"exact".to_owned()));
        assert!(own.iter().all(|own| own.name != "help"));
        assert!(options("cushions").is_none());
    }

    #[test]
    fn units_are_units_and_each_has_its_options() {
        let command = Arguments::command();
        let known = || command.get_subcommands().flat_map(Command::get_arguments).map(place);
        for (name, unit) in UNITS {
            assert!(parse_dimension(unit).is_ok(), "{unit}");
            assert!(known().any(|own| own == name), "{name}");
        }
    }
}
