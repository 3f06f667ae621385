//! The figures of the thesis from the exact impact: what is drawn, and its numbers.

mod families;
mod networks;

use dashpot_network::Network;
use dashpot_plot::Chart;

use crate::{Study, ThesisError};

pub use networks::{GraphCase, graph_cases};

/// A figure.
#[derive(Debug)]
pub struct Figure {
    /// Its number in the thesis.
    pub number: usize,
    /// Its title there.
    pub title: String,
    /// What is drawn.
    pub drawing: Drawing,
    /// Its numbers; empty for networks.
    pub columns: Vec<Column>,
}

/// What a figure shows.
#[derive(Debug)]
pub enum Drawing {
    /// Curves.
    Chart(Box<Chart>),
    /// A network of masses, springs and dashpots.
    Network(Network),
}

/// Numbers of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What they are, with their unit.
    pub name: String,
    /// Their values.
    pub values: Vec<f64>,
}

/// In place of figure 3, the circuit of the analogue computer: what it integrated (2.20 to 2.26).
pub const EQUATIONS: [&str; 5] = [
    "ζ″ = A − B φ,                        ζ(0) = 0, ζ′(0) = 1",
    "η″ = −α η′ − β η + γ φ,              η(0) = 0, η′(0) = 0",
    "φ″ = −a φ′ − b φ + c ξ″ + d ξ′,      φ(0) = 0, φ′(0) = e",
    "ξ = ζ − η",
    "ω = ∫ φ ξ′ dτ*",
];

impl Figure {
    fn of_network(number: usize, title: &str, network: Network) -> Self {
        let drawing = Drawing::Network(network);
        Self { number, title: title.to_owned(), drawing, columns: Vec::new() }
    }

    fn of_chart(number: usize, title: &str, chart: Chart, columns: Vec<Column>) -> Self {
        let drawing = Drawing::Chart(Box::new(chart));
        Self { number, title: title.to_owned(), drawing, columns }
    }

    /// Name of its file without an ending, as in `figure-05`.
    pub fn stem(&self) -> String {
        format!("figure-{:02}", self.number)
    }
}

/// The figures 1, 2, 4, 5 to 20 and 21.
///
/// # Errors
///
/// [`ThesisError::Similarity`], [`ThesisError::Rheometer`] and [`ThesisError::EquivalentModel`] for
/// paddings that do not exist; that of chapter IV does.
pub fn figures(study: &Study) -> Result<Vec<Figure>, ThesisError> {
    let mut all = vec![networks::impact(study)?, networks::load_hold_unload()?, networks::graph()];
    all.extend(families::figures(study));
    all.push(networks::equivalent(study)?);
    Ok(all)
}

/// The names of all files of figures.
pub fn figure_stems() -> impl Iterator<Item = String> {
    [1, 2].into_iter().chain(4..=21).map(|number| format!("figure-{number:02}"))
}
