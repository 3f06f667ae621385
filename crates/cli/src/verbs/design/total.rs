//! `--total "A.thickness+B.thickness=30 mm"`: numbers with a given sum.

use dashpot_design::optimum::Total;
use dashpot_network::parameters::Dimension;
use dashpot_scene::units::parse_dimension;

use crate::{error::CliError, input::setting, varied::Varied};

const FLAG: &str = "--total";

/// The sums that the command line gives, over the numbers that vary.
pub(super) fn totals(texts: &[String], numbers: &[Varied]) -> Result<Vec<Total>, CliError> {
    let mut all: Vec<Total> = Vec::new();
    for text in texts {
        let own = total(text, numbers)?;
        if let Some(at) = own.of.iter().find(|at| all.iter().any(|other| other.of.contains(at))) {
            return Err(wrong(format!("`{}` is in two sums", numbers[*at].name)));
        }
        all.push(own);
    }
    Ok(all)
}

fn total(text: &str, numbers: &[Varied]) -> Result<Total, CliError> {
    let help = "write the numbers and their sum, such as \"front.thickness+back.thickness=30 mm\"";
    let (names, sum) = text.rsplit_once('=').ok_or_else(|| wrong(help.to_owned()))?;
    let position = |name: &str| {
        numbers.iter().position(|own| own.name == name).ok_or_else(|| {
            wrong(format!("`{name}` does not vary: give its bounds, `--vary \"{name}=…\"`"))
        })
    };
    let of = names.split('+').map(|name| position(name.trim()));
    let of = of.collect::<Result<Vec<usize>, _>>()?;
    let is_twice = |at: usize| of[..at].contains(&of[at]);
    if of.len() < 2 || (0..of.len()).any(is_twice) {
        return Err(wrong(format!("two numbers or more have a sum: {help}")));
    }
    let first = &numbers[of[0]];
    if let Some(other) = of.iter().map(|at| &numbers[*at]).find(|own| own.si != first.si) {
        let (name, other) = (&first.name, &other.name);
        return Err(wrong(format!("`{name}` and `{other}` do not measure the same")));
    }
    let dimension = parse_dimension(&first.si).unwrap_or(Dimension::NUMBER);
    let sum = setting(FLAG, sum.trim(), dimension)?;
    let of_bounds = |side: usize| of.iter().map(|at| numbers[*at].bounds[side]).sum::<f64>();
    let [low, high] = [of_bounds(0), of_bounds(1)];
    if !(low..=high).contains(&sum) {
        let [low, high] = [low, high].map(|own| first.short(own, 7));
        return Err(wrong(format!(
            "the bounds of its numbers allow sums from {low} to {high} alone"
        )));
    }
    Ok(Total { of, sum })
}

fn wrong(reason: String) -> CliError {
    CliError::setting(FLAG, reason)
}
