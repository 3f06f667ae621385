//! What a fit says: tables and sentences.

use dashpot_fit::linear::{Against, Contradiction, Form, LinearFit, Range, RecordFit};
use dashpot_report::Table;

use super::{Fitted, asked::Measured};
use dashpot_report::numbers::{quantity, share};

/// Digits of fitted values.
const DIGITS: usize = 4;
/// Digits of times.
const FEW: usize = 3;

/// Units of a material or a pad.
pub(super) struct Units {
    /// Of the strengths: moduli, stiffnesses or compliances.
    pub(super) strength: &'static str,
    /// Of the dashpot.
    dashpot: &'static str,
    /// Of what answers a history.
    pub(super) answer: &'static str,
}

impl Units {
    pub(super) fn of(form: Form, is_material: bool) -> Self {
        let [strength, dashpot, answer] = match (form, is_material) {
            (Form::Maxwell, true) => ["Pa", "Pa s", "Pa"],
            (Form::Maxwell, false) => ["N/m", "N s/m", "N"],
            (Form::Kelvin, true) => ["1/Pa", "1/(Pa s)", "1"],
            (Form::Kelvin, false) => ["m/N", "m/(N s)", "m"],
        };
        Self { strength, dashpot, answer }
    }
}

/// The two ends of the spectrum, each with its key in JSON.
pub(super) fn ends(fit: &LinearFit, is_material: bool) -> [(&'static str, String, Range); 2] {
    let what = match (fit.form, is_material) {
        (Form::Maxwell, true) => "modulus",
        (Form::Maxwell, false) => "stiffness",
        (Form::Kelvin, _) => "compliance",
    };
    let (spring, sum) = match fit.form {
        Form::Maxwell => ("equilibrium", "instantaneous"),
        Form::Kelvin => ("instantaneous", "delayed"),
    };
    [(spring, format!("{spring} {what}"), fit.spring), (sum, format!("{sum} {what}"), fit.sum)]
}

/// The table of what the records determine.
pub(super) fn determined(fitted: &Fitted<'_>) -> Table {
    let unit = fitted.units().strength;
    let value = |own: f64| quantity(own, unit, DIGITS);
    let rows = ends(&fitted.fit, fitted.is_material()).into_iter().map(|(_, name, range)| {
        let high = range.high.map_or("no bound".to_owned(), value);
        let verdict = if range.is_identified() { "identified" } else { "not identified" };
        vec![name, value(range.value), value(range.low), high, verdict.to_owned()]
    });
    Table::new("What the records determine", &["", "value", "from", "to", ""], rows)
}

/// The answer in a few lines: the ends of the spectrum.
pub(super) fn verdict(fitted: &Fitted<'_>) -> Vec<String> {
    let rows = determined(fitted).rows.into_iter();
    let line = |own: Vec<String>| match &own[..] {
        [name, value, low, high, verdict] => format!("{name} {value} ({low} to {high}), {verdict}"),
        _ => own.join(" "),
    };
    rows.map(line).collect()
}

/// The table of the branches.
pub(super) fn branches(fitted: &Fitted<'_>) -> Table {
    let units = fitted.units();
    let Fitted { fit, .. } = fitted;
    let (element, time) = match fit.form {
        Form::Maxwell => ("Maxwell elements", "relaxation time"),
        Form::Kelvin => ("Kelvin–Voigt elements", "retardation time"),
    };
    let single = [
        ("spring", fit.spectrum.spring, units.strength),
        ("dashpot", fit.spectrum.dashpot, units.dashpot),
    ];
    let single = single.into_iter().filter(|own| own.1 > 0.0);
    let single = single.map(|(name, own, unit)| vec![name.to_owned(), quantity(own, unit, DIGITS)]);
    let branches = fit.spectrum.branches.iter().map(|(time, own)| {
        vec![quantity(*time, "s", DIGITS), quantity(*own, units.strength, DIGITS)]
    });
    let caption = format!("{} {element}", fit.spectrum.branches.len());
    Table::new(caption, &[time, "strength"], single.chain(branches))
}

/// A part of a record, or of its largest value: in the mean (root of the mean square).
pub(super) fn rms(own: f64, record: &RecordFit, unit: &str) -> String {
    format!("{} rms", part(own, record, unit))
}

fn part(own: f64, record: &RecordFit, unit: &str) -> String {
    record.largest.map_or_else(|| share(own), |largest| quantity(own * largest, unit, FEW))
}

/// The table of the records.
pub(super) fn records(fitted: &Fitted<'_>) -> Table {
    let unit = fitted.units().answer;
    let rows = fitted.records.iter().zip(&fitted.fit.records).map(|(told, own)| {
        vec![
            told.file.clone(),
            told.what.clone(),
            rms(own.floor, own, unit),
            format!(
                "{}, {} at most",
                rms(own.misfit.rms, own, unit),
                part(own.misfit.largest, own, unit)
            ),
        ]
    });
    let header = ["file", "record", "no network comes nearer than", "this one"];
    Table::new("How near", &header, rows)
}

/// What comes first: where the fit is not what it may be taken for.
pub(super) fn warnings(fitted: &Fitted<'_>) -> Vec<String> {
    let Fitted { fit, .. } = fitted;
    let mut all: Vec<String> = Vec::new();
    for (told, own) in fitted.records.iter().zip(&fit.records) {
        all.extend(own.contradiction.map(|of| contradicts(&told.file, &of, own.floor)));
        all.extend(apart(told, own));
    }
    if !fit.is_kept {
        all.push("refinement did not converge: the stated error is not kept".to_owned());
    }
    all
}

/// So many rows that were left out are named.
const NAMED: usize = 5;

/// The rows of a record that were left out.
fn apart(told: &Measured, record: &RecordFit) -> Option<String> {
    let rows = record.outliers.iter().take(NAMED).map(|own| {
        let way = if own.off > 0.0 { "above" } else { "below" };
        let line = told.lines.get(own.row).copied().unwrap_or_default();
        format!("line {line} is {} {way} the curve of the others", share(own.off.abs()))
    });
    let rows: Vec<String> = rows.collect();
    let more = record.outliers.len() - rows.len();
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    (!rows.is_empty()).then(|| {
        format!(
            "{}: {}{more}: an outlier, or what no branch does that the rows determine; left out (`--robust off` counts \
             all rows)",
            told.file,
            rows.join(", ")
        )
    })
}

fn contradicts(file: &str, own: &Contradiction, floor: f64) -> String {
    format!(
        "{file}: storage and loss contradict each other (Kramers–Kronig): no network of springs and dashpots comes \
         nearer than {} rms, though storage alone is met within {} and loss alone within {}. The storage asks for a \
         loss that is {} off in the median, the loss for a storage that is {} off. A master curve that is stretched \
         by its shift factors does that, and so does a loss that is not from the same strain or temperature",
        share(floor),
        share(own.storage_alone),
        share(own.loss_alone),
        share(own.loss_from_storage),
        share(own.storage_from_loss),
    )
}

/// What is to be known of the fit.
pub(super) fn notes(fitted: &Fitted<'_>) -> Vec<String> {
    let Fitted { fit, .. } = fitted;
    let unit = fitted.units().answer;
    let mut all = Vec::new();
    let error = share(fitted.arguments.error());
    let is_met = fit.is_kept && fit.misfit.largest <= fitted.arguments.error();
    let of = if fit.records.iter().any(|own| own.largest.is_some()) {
        " (of its largest value, where a record has a history)"
    } else {
        ""
    };
    all.extend(match fit.against {
        Against::Data => is_met.then(|| format!("the fewest branches within {error} of every row{of}")),
        Against::Floor => Some(format!(
            "the nearest network (least squares) is further than {error} from some rows{of}: the branches are the fewest \
             within that of its curve"
        )),
    });
    all.push(
        "the floor holds for every network of springs and dashpots, whatever its times, with these clocks".to_owned(),
    );
    let (low, high) = fit.limits;
    all.push(format!(
        "no branch is faster than {} or slower than {}: the rows could not determine it",
        quantity(low, "s", FEW),
        quantity(high, "s", FEW)
    ));
    let flows = match fit.form {
        Form::Maxwell => fit.spectrum.spring <= 0.0,
        Form::Kelvin => fit.spectrum.dashpot > 0.0,
    };
    if flows && !fitted.arguments.solid {
        all.push(
            "under a constant force it flows for ever: `--solid` if it is known not to".to_owned(),
        );
    }
    for (told, own) in fitted.records.iter().zip(&fit.records).filter(|own| own.1.shift != 0.0) {
        let largest = own.largest.unwrap_or(1.0);
        let late = if own.shift > 0.0 { "later" } else { "earlier" };
        let shift = quantity(own.shift.abs(), "s", FEW);
        let without = fit.floor_unshifted.map_or(String::new(), |before| {
            format!(
                "; without that no network comes nearer than {}",
                quantity(before * largest, unit, FEW)
            )
        });
        all.push(format!(
            "{}: what answered is best written down {shift} {late} than what was done{without}; `--shift off` takes \
             the clocks as they are",
            told.file
        ));
    }
    all.push(format!(
        "the ranges are those of all networks that are as near within the noise, with no branch slower than {}, ten \
         times the longest time: whether more relaxes later, no row tells",
        quantity(fit.slowest, "s", FEW)
    ));
    all
}

/// What stands above the model in the scene.
pub(super) fn comments(fitted: &Fitted<'_>) -> Vec<String> {
    let files: Vec<&str> = fitted.records.iter().map(|own| own.file.as_str()).collect();
    let head = format!(
        "fitted to {}; {} rms, no passive network comes nearer than {}",
        files.join(", "),
        share(fitted.fit.misfit.rms),
        share(fitted.fit.floor)
    );
    [head].into_iter().chain(verdict(fitted)).collect()
}
