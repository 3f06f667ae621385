//! The energy ledger, summed over each element.

use dashpot_analysis::{Ledger, RunReport};
use dashpot_network::{DriveOutputs, Source};
use dashpot_report::Table;

use dashpot_report::numbers::{Unit, quantity, share};

/// Elements that take up less than this part of the energy share one line.
const SMALL: f64 = 1e-4;
/// More elements than this share one line.
const MOST: usize = 6;
/// More decimals are never shown.
const MOST_DECIMALS: usize = 2;

/// What does the work from outside, where it is of one kind.
fn work_of(drives: &[DriveOutputs]) -> String {
    let first = drives.first().map(|drive| drive.source);
    match first.filter(|first| drives.iter().all(|drive| drive.source == *first)) {
        Some(Source::Effect(word)) => format!("work of {word}"),
        Some(Source::Load) => "work of loads".to_owned(),
        Some(Source::Motion) => "work of motions".to_owned(),
        None => "put in from outside".to_owned(),
    }
}

/// Where the energy came from and where it is, at the end of the impact and of the run.
pub(super) fn energy_table(run: &RunReport) -> Table {
    let after = run.energy_after_impact.as_ref().filter(|own| own.time < run.energy.time);
    let after = after.map(|after| ("end of impact", after)).into_iter();
    let ledgers: Vec<(&str, &Ledger)> = after.chain([("end of run", &run.energy)]).collect();
    let turned_over = run.energy.turned_over;
    let unit = Unit::suiting(turned_over, "J");
    let of_energy = run.measures.iter().filter(|measure| measure.unit == "J");
    let error = of_energy.filter_map(|measure| measure.error).reduce(f64::max);
    let decimals = unit.decimals(error.unwrap_or(0.0), MOST_DECIMALS);
    let heading =
        |(when, ledger): &(&str, &Ledger)| format!("{when}, {}", quantity(ledger.time, "s", 3));
    let mut header = vec![format!("energy in {}", unit.symbol)];
    header.extend(ledgers.iter().map(heading));
    let row = |label: &str, amount: &dyn Fn(&Ledger) -> f64| {
        let amounts = ledgers.iter().map(|(_, ledger)| unit.decimal(amount(ledger), decimals));
        [label.to_owned()].into_iter().chain(amounts).collect::<Vec<_>>()
    };
    let mut rows = vec![row("initial energy", &|ledger| ledger.start)];
    if !run.energy.work_in.is_empty() {
        rows.push(row(&work_of(&run.assembly.drives), &Ledger::total_work_in));
    }
    rows.push(row("kinetic", &|ledger| ledger.kinetic));
    let sums: Vec<Vec<(&str, f64, f64)>> =
        ledgers.iter().map(|(_, ledger)| ledger.by_element(&run.assembly)).collect();
    let stored = |ledger: usize, element: usize| sums[ledger][element].1;
    let dissipated = |ledger: usize, element: usize| sums[ledger][element].2;
    let size = |element: usize| {
        let each = (0..sums.len()).map(|at| stored(at, element).max(dissipated(at, element)));
        each.fold(0.0, f64::max)
    };
    let sizes: Vec<f64> = (0..run.assembly.connections.len()).map(size).collect();
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|&one, &other| sizes[other].total_cmp(&sizes[one]));
    let mut shown: Vec<usize> =
        order.into_iter().take(MOST).filter(|&at| sizes[at] > SMALL * turned_over).collect();
    shown.sort_unstable();
    let mut line = |label: String, amount: &dyn Fn(usize) -> f64| {
        let amounts: Vec<f64> = (0..ledgers.len()).map(amount).collect();
        if amounts.iter().any(|amount| amount.abs() > SMALL * turned_over) {
            let texts = amounts.iter().map(|&amount| unit.decimal(amount, decimals));
            rows.push([label].into_iter().chain(texts).collect());
        }
    };
    let in_layers = |at: usize, name: &str| {
        ledgers[at].1.in_layers.iter().find(|own| own.0 == name).map_or(0.0, |own| own.1)
    };
    for (name, _) in &run.energy.in_layers {
        line(format!("of it in {name}"), &|at| in_layers(at, name));
    }
    for &element in &shown {
        let name = &run.assembly.connections[element].name;
        line(format!("stored in {name}"), &|at| stored(at, element));
        line(format!("dissipated in {name}"), &|at| dissipated(at, element));
    }
    let others: Vec<usize> = (0..sizes.len()).filter(|at| !shown.contains(at)).collect();
    let sum = |of: &dyn Fn(usize) -> f64| others.iter().map(|&element| of(element)).sum::<f64>();
    line("stored in the others".to_owned(), &|at| sum(&|element| stored(at, element)));
    line("dissipated in the others".to_owned(), &|at| sum(&|element| dissipated(at, element)));
    let missing = ledgers.iter().map(|(_, ledger)| share(ledger.closure()));
    rows.push(["balance error".to_owned()].into_iter().chain(missing).collect());
    Table::new("Energy", header, rows)
}
