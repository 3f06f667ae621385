//! What a chain costs from its text to its report.

use std::{fmt::Write as _, fs, process::Command, sync::Arc};

use allocation_counter::measure;
use dashpot::{
    analysis::{SolveSettings, solve, solve_assembly},
    dae::Silent,
    plot::{Chart, Scale, Series},
    scene::{ReadOptions, read},
};

use super::{OMEGA, end_velocity, struck_velocity, uniform_chain, until};

/// Numbers of masses.
const SIZES: [usize; 4] = [100, 1000, 10_000, 100_000];
/// Names the size in the process that measures it.
const SIZE: &str = "DASHPOT_SIZE";

/// Where the table stands in the document.
const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/sizes.md");
/// The figure in it.
const FIGURE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/figures/cost-and-size.svg");
const PLACE: (&str, &str) = ("<!-- measured: sizes -->", "<!-- end -->");

/// Most memory \[kB\] that solving may take for each mass, beyond the network and its equations.
const MOST_MEMORY: f64 = 2.0;
/// Most memory \[kB\] that the whole process may hold for each mass of the longest chain.
const MOST_IN_ALL: f64 = 7.0;

/// The scene of the struck chain.
fn text(count: usize) -> String {
    let stiffness = 1e6 * count as f64;
    let mut text = "[nodes]\nimpactor = { mass = \"10 kg\", velocity = \"10 m/s\" }\n".to_owned();
    for at in 0..count {
        let _ = writeln!(text, "m{at} = {{ mass = \"{} kg\" }}", 1.0 / count as f64);
    }
    text += "[elements]\n";
    for at in 0..=count {
        let from = at.checked_sub(1).map_or("impactor".to_owned(), |at| format!("m{at}"));
        let to = if at == count { "ground".to_owned() } else { format!("m{at}") };
        let damping = 1e-4 * stiffness;
        let _ = writeln!(
            text,
            "l{at} = {{ between = [\"{from}\", \"{to}\"], kelvin = {{ spring = \"{stiffness} N/m\", \
             dashpot = \"{damping} N s/m\" }} }}"
        );
    }
    text + "[run]\nduration = \"20 ms\"\n"
}

/// A line of this process' status in kB.
fn memory(key: &str) -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(key));
    let number = line.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
    number.unwrap_or(f64::NAN)
}

/// Processor time of this process so far \[s\], which other processes do not lengthen.
fn spent() -> f64 {
    const TICKS: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11);
    fields.take(2).filter_map(|own| own.parse::<f64>().ok()).sum::<f64>() / TICKS
}

/// Measures one size, in a process of its own, as memory is that of all that a process has done.
#[test]
#[ignore = "a part of `curve`"]
fn one() {
    let Ok(count) = std::env::var(SIZE).unwrap_or_default().parse::<usize>() else { return };
    let masses = count as f64;
    let text = text(count);
    let begin = spent();
    let scene = read(&text, &ReadOptions::default()).unwrap().value;
    let parsed = spent() - begin;
    let peak_of_text = memory("VmHWM:") / masses;
    drop(text);
    let settings: SolveSettings = scene.settings("bdf");
    let assembly = Arc::new(scene.assembly);
    drop(scene.network);
    let begin = spent();
    let mut report = None;
    let taken = measure(|| {
        report = Some(solve_assembly(&assembly, &[], &settings, &mut Silent).unwrap());
    });
    let report = report.unwrap();
    let solved = spent() - begin;
    let peak = memory("VmHWM:") / masses;
    let taken = taken.bytes_max as f64 / 1e3 / masses;
    let steps = report.solver.statistics.accepted;
    let trajectory = report.trajectory.dense.bytes() as f64 / 1e3 / masses;
    let bar = report.worst_relative_error().unwrap();
    drop((report, assembly));
    let duration = 30.0 / OMEGA;
    let report = solve(&uniform_chain(count), &until(duration), &mut Silent).unwrap();
    let (value, own) = end_velocity(&report);
    let (error, own) = ((value - struck_velocity(duration)).abs(), own.unwrap());
    println!(
        "\n| {count} | {parsed:.2} | {solved:.2} | {steps} | {peak_of_text:.1} | {peak:.1} | \
         {taken:.2} | {trajectory:.3} | {bar:.0e} | {error:.0e} | {own:.0e} |",
    );
    assert!(error <= own, "{count} masses: {error:e} of {own:e}");
}

/// The numbers of a row of the table.
fn numbers(row: &str) -> Vec<f64> {
    row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect()
}

/// Times over the number of masses.
fn figure(rows: &[Vec<f64>]) -> String {
    let line = |name: &str, of: &dyn Fn(&[f64]) -> f64| {
        let points = rows.iter().map(|row| (row[0], of(row))).filter(|point| point.1 > 0.0);
        Series::new(name, points.collect())
    };
    let chart = Chart {
        title: "Cost against size".to_owned(),
        note: "Impact on a chain of masses and Kelvin links, 20 ms, by `bdf`".to_owned(),
        x_label: "masses".to_owned(),
        y_label: "processor time".to_owned(),
        x_scale: Scale::logarithmic(""),
        y_scale: Scale::logarithmic("s"),
        series: vec![
            line("from text to report", &|row| row[1] + row[2]),
            line("parse and compile", &|row| row[1]),
            line("a step", &|row| row[2] / row[3]),
        ],
        ..Chart::default()
    };
    chart.svg().unwrap()
}

#[test]
#[ignore = "takes minutes"]
fn curve() {
    let mut text = "| masses | parse and compile (s) | solve and report (s) | steps | kB/mass read | \
         kB/mass in all | kB/mass taken by solving | kB/mass of the solution | largest bar | error of \
         the struck end | its bar |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let mut rows = Vec::new();
    for count in SIZES {
        let own = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "sizes::cost::one", "--ignored", "--nocapture"])
            .env(SIZE, count.to_string())
            .env_remove("UPDATE_DOCS")
            .output()
            .unwrap();
        let found = String::from_utf8_lossy(&own.stdout);
        assert!(own.status.success(), "{found}");
        let row = found.lines().find(|line| line.starts_with('|')).unwrap();
        println!("{row}");
        let _ = writeln!(text, "{row}");
        rows.push(numbers(row));
    }
    let [.., before, last] = rows.as_slice() else { unreachable!() };
    let whole = |row: &[f64]| row[1] + row[2];
    let in_all = whole(last) / whole(before);
    let per_step = (last[2] / last[3]) / (before[2] / before[3]);
    let _ = write!(
        text,
        "\nFrom {} to {} masses the whole takes {in_all:.1} times as long, and a step {per_step:.1} times.",
        before[0], last[0]
    );
    println!("{text}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(FIGURE, figure(&rows)).unwrap();
        let own = fs::read_to_string(DOCUMENT).unwrap();
        let (head, rest) = own.split_once(PLACE.0).unwrap();
        let (_, tail) = rest.split_once(PLACE.1).unwrap();
        fs::write(DOCUMENT, format!("{head}{}\n\n{text}\n\n{}{tail}", PLACE.0, PLACE.1)).unwrap();
    }
    assert!(before[6].max(last[6]) <= MOST_MEMORY && last[5] <= MOST_IN_ALL, "{rows:?}");
}
