//! What `cushion` writes into a folder.

use std::io;

use dashpot_design::cushion::{Asked, Curve, Known, StressEnergy};
use dashpot_plot::{CushionCurve, CushionMark, CushionSeries, StressEnergySeries};
use dashpot_report::{Page, ReportFigure, Table};

use super::{
    Drawn, batches, beside,
    words::{self, in_g, in_kpa, length},
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    output::{PAGE, csv, list},
    said,
};
use dashpot_studies::{origin, sketch};

/// All points of all curves.
const TABLE: &str = "cushion.csv";
const BAND: [&str; 3] =
    ["2.5 % of designs [m/s^2]", "97.5 % of designs [m/s^2]", "designs beyond what is known [1]"];
/// All points as the stress–energy method sees them.
const STRESS_ENERGY: &str = "stress-energy.svg";
/// Places at which its curves are drawn.
const DRAWN: u16 = 120;

/// `cushion-760mm.svg`.
fn figure_file(height: f64) -> String {
    format!("cushion-{}.svg", length(height).replace(' ', ""))
}

/// The files that are written besides the result.
pub(super) fn names(asked: &Asked) -> Vec<String> {
    let figures = asked.heights.iter().map(|own| figure_file(*own));
    let is_one = asked.heights.len() * asked.thicknesses.len() < 2;
    let method = (!is_one).then_some(STRESS_ENERGY);
    let rest = method.into_iter().chain([TABLE, PAGE]).map(str::to_owned);
    figures.chain(rest).collect()
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, drawn: &Drawn) -> Result<(), CliError> {
    files.add_with(TABLE, |out| table(drawn, out))?;
    let mut figures = Vec::new();
    for height in &drawn.wanted.asked.heights {
        let own = ReportFigure::of(&series(drawn, *height).chart())?;
        files.add(figure_file(*height), &own.svg)?;
        figures.push(own);
    }
    if let Some(own) = &drawn.cushion.stress_energy {
        let own = ReportFigure::of(&energies(own).chart())?;
        files.add(STRESS_ENERGY, &own.svg)?;
        figures.push(own);
    }
    files.add(PAGE, page(drawn, figures).html())
}

/// The stress–energy method as the plain numbers that a figure is drawn from.
fn energies(own: &StressEnergy) -> StressEnergySeries {
    let [low, high] = own.range;
    let places = |at: u16| low + (high - low) * f64::from(at) / f64::from(DRAWN);
    let place = |energy: f64, stress: f64| (energy / 1e3, in_kpa().of(stress));
    let drawn = |law: &dyn Fn(f64) -> f64| {
        list((0..=DRAWN).map(places).map(|energy| place(energy, law(energy))))
    };
    StressEnergySeries {
        note: beside::scatter(own),
        points: list(own.points.iter().map(|own| place(own[0], own[1]))),
        smooth: drawn(&|energy| own.smooth(energy)),
        exponential: drawn(&|energy| own.exponential(energy)),
    }
}

/// Writes all points in SI units as CSV; what is missing is blank.
pub(super) fn table(drawn: &Drawn, out: &mut dyn io::Write) -> io::Result<()> {
    let has_bands = drawn.batches.is_some();
    let mut header = vec![
        "height [m]",
        "thickness [m]",
        "static stress [Pa]",
        "peak acceleration [m/s^2]",
        "error [m/s^2]",
        "strain [1]",
        "known",
    ];
    if has_bands {
        header.extend(BAND);
    }
    let rows = drawn.cushion.curves.iter().flat_map(|curve| {
        curve.points.iter().enumerate().map(|(at, own)| {
            let number = |own: f64| own.is_finite().then_some(own);
            let all = [own.stress, own.peak, own.error, own.strain].map(number);
            let band = curve.bands.get(at).map(|own| (own.low, own.high, own.without));
            (curve.height, curve.thickness, all, own.known.word(), list(band))
        })
    });
    csv(out, header.into_iter().map(str::to_owned), rows)
}

/// The curves of one height as the plain numbers that a figure is drawn from.
fn series(drawn: &Drawn, height: f64) -> CushionSeries {
    let platen = &drawn.cushion.platen;
    let of_height = |own: &&Curve| own.height.to_bits() == height.to_bits();
    CushionSeries {
        title: format!("Cushion curves, drops from {}", length(height)),
        note: title(&drawn.scene).to_owned(),
        curves: drawn.cushion.curves.iter().filter(of_height).map(curve).collect(),
        limit: drawn.wanted.asked.limit.map(|own| in_g().of(own)),
        own: Some((in_kpa().of(platen.stress()), platen.body.clone())),
    }
}

fn curve(own: &Curve) -> CushionCurve {
    let place = |stress: f64, peak: f64| (in_kpa().of(stress), in_g().of(peak));
    let points = list(own.points.iter().map(|own| {
        let is_on_stop = own.known == Known::OnStop;
        let mark = if is_on_stop { CushionMark::OnStop } else { CushionMark::Known };
        // A law that is followed beyond its range tells nothing of the peak there.
        let peak = if own.is_usable() { own.peak } else { f64::NAN };
        let (x, y) = place(own.stress, peak);
        (x, y, mark)
    }));
    let best = own.best.map(|own| place(own.point.stress, own.point.peak));
    let floor = own.floor.map(|own| in_g().of(own));
    let later = own.points.iter().zip(&own.repeated);
    let later = list(later.map(|(own, row)| place(own.stress, row.later())));
    let band = own.points.iter().zip(&own.bands).map(|(own, band)| {
        let (low, high) = batches::ends(band).unwrap_or((f64::NAN, f64::NAN));
        (in_kpa().of(own.stress), in_g().of(low), in_g().of(high))
    });
    CushionCurve { name: length(own.thickness), points, floor, best, later, band: list(band) }
}

fn page(drawn: &Drawn, figures: Vec<ReportFigure>) -> Page {
    let scene = &drawn.scene;
    let settings = Table::plain("Settings", origin::rows(scene, &crate::input::load));
    let verdict = words::lines(drawn).into_iter();
    let verdict = verdict.map(|own| format!("{}: {}", own.label, own.text));
    let remarks = words::notes(drawn).into_iter().chain(said::notes(scene));
    let beside = [beside::row_table(drawn), beside::creep_table(drawn)];
    let tables = [words::table(drawn)].into_iter().chain(beside);
    let tables = tables.chain([Table::list("Remarks", remarks)]);
    Page {
        title: title(scene).to_owned(),
        warnings: list(words::missing(drawn).into_iter().chain(said::warnings(scene, &[]))),
        verdict: [words::asked(drawn)].into_iter().chain(verdict).collect(),
        network: sketch::figure(scene),
        tables: tables.into_iter().filter(|own| !own.rows.is_empty()).collect(),
        figures,
        details: vec![settings],
        scene_text: scene.text.to_string(),
    }
}
