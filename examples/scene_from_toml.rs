//! A scene as text: read, solved, and drawn to an SVG figure.
//!
//! `cargo run --example scene_from_toml`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{Solve, regular_times},
    plot::{Chart, Series},
    scene::{ReadOptions, read},
};

const SCENE: &str = r#"
title = "A phone falls on a floor mat"

[models.mat]
zener = { spring = "30 kN/m", maxwell = { spring = "90 kN/m", dashpot = "60 N s/m" } }

[nodes]
phone = { mass = "200 g", drop = "80 cm" }

[elements]
mat = { between = ["phone", "ground"], model = "mat", thickness = "1 cm" }

[run]
duration = "15 ms"
"#;

pub fn main() -> Result<(), Box<dyn Error>> {
    let scene = read(SCENE, &ReadOptions::default())?.value;
    let report = scene.network.solve_with(&scene.settings("auto")?)?;
    let deepest = report.value("mat.peak-deformation")?;
    println!("{}: {:.2} mm deep", scene.title.as_deref().unwrap_or("scene"), 1e3 * deepest);

    let times = regular_times(scene.run.duration, 200);
    let force = report.assembly.output("mat.force").ok_or("no such output")?;
    let force = report.trajectory.signal(&report.assembly.system, force);
    let points = times.iter().map(|&t| (1e3 * t, force.value(t))).collect();
    let chart = Chart {
        title: "Force in the mat".to_owned(),
        x_label: "time (ms)".to_owned(),
        y_label: "force (N)".to_owned(),
        series: vec![Series::new("mat", points)],
        ..Chart::default()
    };
    let svg = chart.svg()?;
    println!("{}", chart.text(80, 14));
    println!("the same as SVG: {} bytes", svg.len());
    assert!(svg.contains("time (ms)") && deepest > 0.0 && deepest < 0.01);
    Ok(())
}
