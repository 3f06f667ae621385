//! What a chain costs from its text to its report.

use std::{fmt::Write as _, fs, process::Command, sync::Arc};

use allocation_counter::measure;
use dashpot::{
    analysis::{Solve, SolveSettings, solve_assembly},
    dae::Silent,
    plot::{Chart, Scale, Series},
    scene::{ReadOptions, read, read_shared},
};

use super::{OMEGA, end_velocity, struck_velocity, uniform_chain, until};

/// Numbers of masses.
const SIZES: [usize; 4] = [100, 1000, 10_000, 100_000];
/// Names the size in the process that measures it.
const SIZE: &str = "DASHPOT_SIZE";
/// Names the tolerance in the process that measures what a chain costs with it.
const TOLERANCE: &str = "DASHPOT_TOLERANCE";
/// Two chains, and the tolerances that make them equally accurate.
const EQUAL: [(usize, f64); 2] = [(10_000, 1e-5), (100_000, 3e-5)];

/// Where the table stands in the document.
const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/sizes.md");
/// The figure in it.
const FIGURE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/figures/cost-and-size.svg");
const PLACE: (&str, &str) = ("<!-- measured: sizes -->", "<!-- end -->");

/// Most memory \[kB\] that solving may take for each mass, beyond the network and its equations.
const MOST_MEMORY: f64 = 2.0;
/// Most memory \[kB\] that the whole process may hold for each mass of the longest chain.
const MOST_IN_ALL: f64 = 4.2;

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
    fields.take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / TICKS
}

/// Measures one size, in a process of its own, as memory is that of all that a process has done.
#[test]
#[ignore = "a part of `curve`"]
fn one() {
    let Ok(count) = std::env::var(SIZE).unwrap_or_default().parse::<usize>() else { return };
    let masses = count as f64;
    let text: Arc<str> = text(count).into();
    let begin = spent();
    let scene = read_shared(&text, &ReadOptions::default()).unwrap().value;
    let parsed = spent() - begin;
    let peak_of_text = memory("VmHWM:") / masses;
    drop(text);
    let settings: SolveSettings = scene.settings("bdf").unwrap();
    let assembly = scene.assembly;
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
    let report = uniform_chain(count).solve_with(&until(duration)).unwrap();
    let (value, own) = end_velocity(&report);
    let (error, own) = ((value - struck_velocity(duration)).abs(), own.unwrap());
    println!(
        "\n| {count} | {parsed:.2} | {solved:.2} | {steps} | {peak_of_text:.1} | {peak:.1} | \
         {taken:.2} | {trajectory:.3} | {bar:.0e} | {error:.0e} | {own:.0e} |",
    );
    assert!(error <= own, "{count} masses: {error:e} of {own:e}");
}

/// Measures one size with one tolerance: time from the text to the report with all solutions that the
/// error bars take, steps, and the largest error of the force in the first link from 40 µs on, in parts
/// of its largest value there. It is judged by a solution with a hundredth of the tolerance.
#[test]
#[ignore = "a part of `curve`"]
fn equal() {
    let read_number = |key: &str| std::env::var(key).unwrap_or_default().parse::<f64>();
    let (Ok(count), Ok(rtol)) = (read_number(SIZE), read_number(TOLERANCE)) else { return };
    let text = text(count as usize);
    let begin = spent();
    let scene = read(&text, &ReadOptions::default()).unwrap().value;
    let settings = SolveSettings { rtol: Some(rtol), ..scene.settings("bdf").unwrap() };
    let assembly = scene.assembly;
    let report = solve_assembly(&assembly, &[], &settings, &mut Silent).unwrap();
    let whole = spent() - begin;
    let steps = report.solver.statistics.accepted;
    let finer = SolveSettings { rtol: Some(0.01 * rtol), estimate: false, ..settings };
    let finer = solve_assembly(&assembly, &[], &finer, &mut Silent).unwrap();
    let times: Vec<f64> = (1..=500).map(|at| 40e-6 * f64::from(at)).collect();
    let output = assembly.output("l0.force").unwrap();
    let [own, judge] =
        [&report, &finer].map(|of| of.trajectory.signal(&assembly.system, output).sample(&times));
    let largest = judge.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let differences = own.iter().zip(&judge).map(|(own, judge)| (own - judge).abs());
    let error = differences.fold(0.0, f64::max) / largest;
    println!("\n| {count} | {whole:.2} | {steps} | {error:.1e} |");
}

/// The row of numbers that a test prints in a process of its own.
fn measured(test: &str, variables: &[(&str, String)]) -> String {
    let own = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &format!("sizes::cost::{test}"), "--ignored", "--nocapture"])
        .envs(variables.iter().map(|(key, value)| (key, value)))
        .env_remove("UPDATE_DOCS")
        .output()
        .unwrap();
    let found = String::from_utf8_lossy(&own.stdout);
    assert!(own.status.success(), "{found}");
    found.lines().find(|line| line.starts_with('|')).unwrap().to_owned()
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
        let row = measured("one", &[(SIZE, count.to_string())]);
        println!("{row}");
        let _ = writeln!(text, "{row}");
        rows.push(numbers(&row));
    }
    let [.., before, last] = rows.as_slice() else { unreachable!() };
    let per_step = (last[2] / last[3]) / (before[2] / before[3]);
    let equal = EQUAL.map(|(count, rtol)| {
        let variables = [(SIZE, count.to_string()), (TOLERANCE, rtol.to_string())];
        numbers(&measured("equal", &variables))
    });
    let [[_, time, steps, error], [_, time_after, steps_after, error_after]] =
        equal.map(|row| <[f64; 4]>::try_from(row).unwrap());
    let _ = write!(
        text,
        "\nFrom {} to {} masses a step takes {per_step:.1} times as long. At equal error of the force in \
         the first link ({error:.1e} and {error_after:.1e} of its largest value, {steps} and {steps_after} \
         steps) the whole takes {:.1} times as long.",
        before[0],
        last[0],
        time_after / time
    );
    println!("{text}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(FIGURE, figure(&rows)).unwrap();
        let own = fs::read_to_string(DOCUMENT).unwrap();
        let (head, rest) = own.split_once(PLACE.0).unwrap();
        let (_, tail) = rest.split_once(PLACE.1).unwrap();
        fs::write(DOCUMENT, format!("{head}{}\n\n{text}\n\n{}{tail}", PLACE.0, PLACE.1)).unwrap();
    }
    assert!(error_after <= error, "{error_after:e} against {error:e}");
    assert!(before[6].max(last[6]) <= MOST_MEMORY && last[5] <= MOST_IN_ALL, "{rows:?}");
}
