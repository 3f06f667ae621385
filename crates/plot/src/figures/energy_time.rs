//! Energy over time.

use super::run_series::zip;
use super::unit::Unit;
use super::{Figure, Quantity, RunSeries, curves, largest, note};
use crate::Chart;

/// The parts of the energy ledger over time.
#[derive(Debug, Clone, Copy)]
pub struct EnergyTime;

impl Figure for EnergyTime {
    fn name(&self) -> &'static str {
        "energy-time"
    }

    fn title(&self) -> &'static str {
        "Energy over time"
    }

    fn chart(&self, runs: &[RunSeries]) -> Chart {
        let (shown, left_out) = largest(energy_curves(runs), "energies");
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
        let x = Unit::time(points().map(|p| p.0));
        let y = Unit::energy(points().map(|p| p.1));
        Chart {
            title: self.title().into(),
            note: note(runs, &left_out),
            x_label: x.label("time"),
            y_label: y.label("energy"),
            markers: Vec::new(),
            lines: Vec::new(),
            series: curves(runs, &shown, x.factor, y.factor),
            ..Chart::default()
        }
    }
}

/// Per part of the first run's ledger, one curve of each run.
fn energy_curves(runs: &[RunSeries]) -> Vec<Quantity> {
    let Some(first) = runs.first() else { return Vec::new() };
    let curve = |run: &RunSeries, name: &str| {
        let part = run.energy.iter().find(|part| part.name == name);
        part.map_or_else(Vec::new, |part| zip(&run.time, &part.values))
    };
    let of_all = |name: &String| runs.iter().map(|run| curve(run, name)).collect();
    let names = first.energy.iter().map(|part| part.name.clone());
    names.map(|name| Quantity { curves: of_all(&name), name }).collect()
}
