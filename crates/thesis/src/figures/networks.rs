//! Figures 1, 2 and 21: the impact, the padding under a load that is held, and its equivalent model.

use dashpot_analysis::rheometer::{LoadHoldUnload, ProtocolKind, RheometerReport, Specimen};
use dashpot_network::Network;
use dashpot_plot::{Chart, Series};
use dashpot_rheology::{Branch, Tree, appendix_a::SpringDashpot};

use super::{Column, Drawing, Figure};
use crate::{
    Groups, Padding, Scales, Study, Support, ThesisError,
    groups::{burgers, maxwell},
};

/// Force \[N\] and times \[s\] of figure 2: held so long, and looked at until.
const FORCE: f64 = 20e3;
const HOLD: f64 = 1e-3;
const END: f64 = 2.5e-3;

/// The impact of chapter IV in SI units.
fn network(groups: &Groups) -> Result<Network, ThesisError> {
    let none = || ThesisError::NoPadding { q: groups.q() };
    groups.network(&Scales::CHAPTER_4).ok_or_else(none)
}

pub(super) fn impact(study: &Study) -> Result<Figure, ThesisError> {
    Ok(Figure {
        number: 1,
        title: "Schematic of impact system".to_owned(),
        drawing: Drawing::Network(network(&study.system.groups)?),
        columns: Vec::new(),
    })
}

pub(super) fn equivalent() -> Result<Figure, ThesisError> {
    let two = burgers(Padding::CHAPTER_4).to_two_maxwell()?;
    let branch =
        |name: &str, own: SpringDashpot| Branch::new(name, maxwell(own.spring, own.dashpot));
    let pad = Tree::Parallel(vec![branch("slow", two.slow), branch("fast", two.fast)]);
    let groups = Groups::of(&Scales::CHAPTER_4, &Padding::CHAPTER_4, &Support::CHAPTER_4);
    Ok(Figure {
        number: 21,
        title: "An equivalent model".to_owned(),
        drawing: Drawing::Network(groups.network_with(&Scales::CHAPTER_4, pad)),
        columns: Vec::new(),
    })
}

/// The names of the parts in the thesis.
fn part(name: &str) -> String {
    match name {
        "deformation" => "ε, all of it".to_owned(),
        "instantaneous" => "ε2, spring K2".to_owned(),
        "delayed" => "ε1, Kelvin element K1, C1".to_owned(),
        "viscous" => "ε3, dashpot C2".to_owned(),
        other => other.to_owned(),
    }
}

pub(super) fn load_hold_unload() -> Result<Figure, ThesisError> {
    let specimen = Specimen::new(&Padding::CHAPTER_4.model())?;
    let test = LoadHoldUnload {
        force: Some(FORCE),
        hold: Some(HOLD),
        end: Some(END),
        ..LoadHoldUnload::default()
    };
    let report: RheometerReport = test.test(&specimen, &[])?;
    let times = &report.abscissa.values;
    let of_length = || report.series.iter().filter(|own| own.unit == "m");
    let series = of_length().map(|own| {
        let points = times.iter().zip(&own.model).map(|(time, value)| (1e3 * time, 1e3 * value));
        Series::new(part(own.name), points.collect())
    });
    let title = "Stress-strain characteristic of four parameter padding system".to_owned();
    let chart = Chart {
        title: "Figure 2. Load, hold and unload of the padding".to_owned(),
        note: "A force of 20 kN is put on, held for 1 ms and taken away.".to_owned(),
        x_label: "time (ms)".to_owned(),
        y_label: "deformation (mm)".to_owned(),
        series: series.collect(),
        ..Chart::default()
    };
    let time = Column { name: "time [s]".to_owned(), values: times.clone() };
    let columns = of_length()
        .map(|own| Column { name: format!("{} [m]", own.name), values: own.model.clone() });
    Ok(Figure {
        number: 2,
        title,
        drawing: Drawing::Chart(Box::new(chart)),
        columns: [time].into_iter().chain(columns).collect(),
    })
}
