//! What is determined in the place of numbers that no test tells apart.

use dashpot_fit::{
    network::NetworkFit,
    structure::{Undetermined, undetermined},
};
use dashpot_network::Network;

use crate::{error::CliError, output::list, varied::Varied};

/// A number is moved by this part to see what it acts on.
const MOVED: f64 = 1e-3;

/// Constants that are determined in the place of numbers that are not.
pub(super) struct Shown {
    pub(super) element: String,
    pub(super) numbers: Vec<String>,
    /// Name, value, and the ends of its interval, each in an SI unit.
    pub(super) constants: Vec<(String, f64, Option<[f64; 2]>, &'static str)>,
}

/// What is determined of the networks that are posed at the numbers that were found.
pub(super) fn shown(
    fit: &NetworkFit,
    numbers: &[Varied],
    network: &dyn Fn(&[f64]) -> Result<Network, CliError>,
) -> Result<Vec<Shown>, CliError> {
    let values: Vec<f64> = list(fit.numbers.iter().map(|own| own.value));
    let moved = (0..values.len()).map(|at| {
        let mut own = values.clone();
        own[at] *= 1.0 + MOVED;
        network(&own)
    });
    let (base, moved) = (network(&values)?, moved.collect::<Result<Vec<_>, _>>()?);
    let groups = undetermined(&base, &moved);
    Ok(list(groups.iter().map(|own| constants(own, (&base, &moved), numbers, fit))))
}

fn constants(
    own: &Undetermined,
    (base, moved): (&Network, &[Network]),
    numbers: &[Varied],
    fit: &NetworkFit,
) -> Shown {
    let values = own.constants(base);
    let beside: Vec<Vec<f64>> = list(moved.iter().map(|other| own.constants(other)));
    let constant = |(at, (name, value)): (usize, (&String, &f64))| {
        // Of the logarithm, by the logarithms of the numbers.
        let gradient: Vec<f64> =
            list(beside.iter().map(|other| (other[at] / value).ln() / MOVED.ln_1p()));
        let ends = fit.interval_of(&gradient).map(|factor| [value / factor, value * factor]);
        let unit = if own.is_spring(base, at) { "N/m" } else { "N s/m" };
        (name.clone(), *value, ends, unit)
    };
    let constants = own.shown.iter().zip(&values).enumerate().map(constant);
    let names = own.numbers.iter().map(|at| numbers[*at].name.clone());
    Shown {
        element: own.element.clone(),
        numbers: names.collect(),
        constants: constants.filter(|own| own.1.is_finite()).collect(),
    }
}
