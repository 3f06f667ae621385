//! How far runs are from what was measured: in tables, in words, and for programs.

use dashpot_analysis::RunReport;
use dashpot_plot::MeasuredSeries;
use dashpot_report::Table;
use dashpot_signal::Cfc;
use serde::Serialize;

use super::{
    Answer,
    beside::{Beside, MeasuredCurve},
    compared,
    measures::unit_of_kind,
};
use crate::output::{Text, list, object};
use dashpot_report::numbers::{
    MOST_DIGITS, Unit, constant, percent_signed, quantity, rounded, share,
};

/// Digits of what was measured.
const DIGITS: usize = 4;
/// Digits of differences and times.
const FEW: usize = 3;

/// A run beside a measured curve, and what the run is called.
#[derive(Clone, Copy)]
pub(super) struct Compared<'r> {
    pub(super) name: &'r str,
    pub(super) curve: &'r MeasuredCurve,
    pub(super) beside: &'r Beside,
}

impl Compared<'_> {
    /// The model as it was compared, where it went through a filter, as a figure draws it.
    pub(super) fn filtered(&self) -> Option<MeasuredSeries> {
        let points = self.beside.filtered.clone()?;
        let class = self.curve.cfc.map_or(0.0, Cfc::class);
        let name = format!("{} through CFC {class}", self.name);
        Some(MeasuredSeries { name, of: self.curve.output.of, points })
    }
}

impl Answer {
    /// What was measured beside a run, in the order of the command line.
    pub(super) fn compared<'r>(
        &'r self,
        run: &RunReport,
        name: &'r str,
    ) -> impl Iterator<Item = Compared<'r>> + use<'r> {
        let at = self.runs.iter().position(|own| own.solver.method == run.solver.method);
        let beside = at.and_then(|at| self.beside.get(at)).map_or(&[][..], Vec::as_slice);
        let pairs = self.measured.iter().zip(beside);
        pairs.map(move |(curve, beside)| Compared { name, curve, beside })
    }

    /// Each measured curve beside all runs.
    pub(super) fn by_curve(&self) -> Vec<Vec<Compared<'_>>> {
        by_curve(self.runs.iter().map(|run| list(self.compared(run, run.solver.method))))
    }
}

/// Of some runs, each beside all curves, each curve beside all runs.
pub(super) fn by_curve<'r>(
    runs: impl Iterator<Item = Vec<Compared<'r>>>,
) -> Vec<Vec<Compared<'r>>> {
    let mut curves: Vec<Vec<Compared<'r>>> = Vec::new();
    for own in runs.flat_map(|run| run.into_iter().enumerate()) {
        match curves.get_mut(own.0) {
            Some(curve) => curve.push(own.1),
            None => curves.push(vec![own.1]),
        }
    }
    curves
}

/// Says how far runs are from each curve.
pub(super) fn show(curves: &[Vec<Compared<'_>>], text: &mut Text) {
    for own in curves {
        table(own).iter().for_each(|table| text.table(table));
        compared::table(own).iter().for_each(|table| text.table(table));
        text.paragraphs(remarks(own));
    }
}

/// How far some runs are from one curve.
pub(super) fn table(all: &[Compared<'_>]) -> Option<Table> {
    let curve = all.first()?.curve;
    let sizes = all.iter().map(|own| own.beside.deviation.measured_peak.1.abs());
    let size = sizes.fold(0.0, f64::max);
    let si = curve.output.unit();
    let unit = unit_of_kind("", si).unwrap_or_else(|| Unit::suiting(size, si));
    let value = |value: f64| unit.text(value, DIGITS);
    let time = |time: f64| quantity(time, "s", FEW);
    let row = |name: &str, cell: &dyn Fn(&Compared<'_>) -> String| {
        [name.to_owned()].into_iter().chain(all.iter().map(cell)).collect::<Vec<_>>()
    };
    let of = |own: &Compared<'_>| own.beside.deviation;
    let is_one = all.iter().all(|own| own.curve.output == curve.output);
    let output = (!is_one).then(|| row("output", &|own| own.curve.output.key()));
    let rows = [
        row("peak, measured", &|own| value(of(own).measured_peak.1)),
        row("peak, model", &|own| value(of(own).model_peak.1)),
        row("the model deviates by", &|own| percent_signed(of(own).relative_peak())),
        row("time of peak, measured", &|own| time(of(own).measured_peak.0)),
        row("time of peak, model", &|own| time(of(own).model_peak.0)),
        row("the model has it", &|own| {
            let late = of(own).place();
            format!("{} {}", time(late.abs()), if late < 0.0 { "earlier" } else { "later" })
        }),
        row("rms of the difference", &|own| {
            unit.text(of(own).rms * of(own).measured_peak.1.abs(), FEW)
        }),
        row("the same, of the measured peak", &|own| share(of(own).rms)),
    ];
    let rows = rows.into_iter().chain(compared::scores(all));
    let names = all.iter().map(|own| own.name);
    let header = [""].into_iter().chain(names).filter(|_| all.len() > 1);
    let what = if is_one { curve.output.key() } else { "Outputs".to_owned() };
    let caption = format!("{what} beside `{}` of {}", curve.column, curve.file);
    Some(Table::new(caption, header, output.into_iter().chain(rows)))
}

/// What is to be known of the comparison.
pub(super) fn remarks(all: &[Compared<'_>]) -> Vec<String> {
    let Some(first) = all.first() else { return Vec::new() };
    let (curve, own) = (first.curve, first.beside);
    let (from, to) = own.deviation.span;
    let span = format!("from {} to {}", constant(from, "s"), constant(to, "s"));
    let is_one = all.iter().all(|other| other.beside.zero.total_cmp(&own.zero).is_eq());
    let zero = match (own.zero > 0.0, is_one) {
        (_, false) => "the first touch of each design".to_owned(),
        (false, true) => "the start of the run".to_owned(),
        (true, true) => format!("the first touch, {} in the run", rounded(own.zero, "s", 5)),
    };
    let shift = match curve.shift {
        0.0 => String::new(),
        shift => {
            let way = if shift > 0.0 { "later" } else { "earlier" };
            format!(", moved {way} by {}", rounded(shift.abs(), "s", MOST_DIGITS))
        }
    };
    let rows = own.deviation.rows;
    let left = match curve.rows.len() - rows {
        0 => String::new(),
        left => format!("; {left} more lie outside of what figures show"),
    };
    let place = format!("{rows} rows {span}{shift}; time 0 is {zero}{left}");
    let opposed = all.iter().any(|own| own.beside.deviation.is_opposed()).then(|| {
        "the measured peak and that of the model have different signs: one of both counts the other way; turn the sign \
         in the file"
            .to_owned()
    });
    let filter = curve.cfc.map(|cfc| {
        format!(
            "the model is read at the times of the file and goes through CFC {}, as the record did",
            cfc.class()
        )
    });
    list(
        [Some(place), filter, opposed, compared::impossible_words(all), compared::remark(all)]
            .into_iter()
            .flatten()
            .chain(curve.note.clone()),
    )
}

/// The same for programs, in SI units; times are those of the curve.
pub(super) fn object(own: Compared<'_>) -> impl Serialize {
    let (curve, deviation) = (own.curve, own.beside.deviation);
    let point = |(time, value): (f64, f64)| object! { value, time };
    object! {
        file: &curve.file,
        sha256: &curve.sha256,
        column: &curve.column,
        output: curve.output.key(),
        unit: curve.output.unit(),
        shift: curve.shift,
        zero: own.beside.zero,
        rows: deviation.rows,
        span: deviation.span,
        measured_peak: point(deviation.measured_peak),
        model_peak: point(deviation.model_peak),
        peak: deviation.peak(),
        peak_relative: deviation.relative_peak(),
        peak_later: deviation.place(),
        rms: deviation.rms * deviation.measured_peak.1.abs(),
        rms_relative: deviation.rms,
        cfc: curve.cfc.map(Cfc::class),
        #[serde(flatten)]
        numbers: compared::object(own.beside.numbers.as_ref()),
    }
}
