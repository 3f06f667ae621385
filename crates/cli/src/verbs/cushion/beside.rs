//! What stands beside cushion curves, in words: the stress–energy method, drops in a row, and creep.

use dashpot_design::cushion::{Collapse, Creep, Curve, Repeated, StressEnergy, Trust};
use dashpot_report::Table;
use dashpot_units::percent;

use super::{
    Drawn,
    words::{in_g, in_kpa},
};
use crate::{output::list, verbs::run::Line};
use dashpot_report::numbers::{quantity, rounded};

/// Digits of a number that is read in passing, and of a peak.
const FEW: usize = 3;
const DIGITS: usize = 4;

/// By how much drops scatter about what they are taken for.
pub(super) fn scatter(own: &StressEnergy) -> String {
    format!(
        "{} drops of {} curves; root mean square about the smooth curve {}, about the exponential {}",
        own.of[0],
        own.of[1],
        percent(own.scatter, 2),
        percent(own.left, 2)
    )
}

/// Whether one curve of dynamic stress over dynamic energy stands for all of them.
pub(super) fn stress_energy(own: &StressEnergy) -> Line {
    let scatter = percent(own.scatter, 2);
    let left = percent(own.left, 2);
    let [a, b] = own.fit;
    let text = match own.collapse {
        Collapse::Holds => format!(
            "G σ over σ h/t scatters by {scatter} about one curve: the stress–energy method holds, {} e^(σ h/t / \
             {}) leaves {left}",
            quantity(a, "Pa", FEW),
            quantity(b.recip(), "Pa", FEW),
        ),
        Collapse::OtherForm => format!(
            "G σ over σ h/t scatters by {scatter} about one curve, but an exponential leaves {left}: the \
             stress–energy method holds as a curve, not as a e^(b x)"
        ),
        Collapse::Fails => format!(
            "G σ over σ h/t scatters by {scatter} about one curve: the peaks depend on more than σ h/t, and \
             the stress–energy method predicts nothing here"
        ),
    };
    Line { label: "method", text }
}

/// How long a creep is known.
pub(super) fn slowest(own: &Creep) -> Option<Line> {
    let is_beyond = own.crept.iter().any(|own| own.3 == Trust::BeyondTimes);
    let text = match own.slowest {
        _ if !is_beyond => return None,
        Some(slowest) => format!(
            "* the slowest time of the model is {}: it stands still behind it, and a real cushion creeps on",
            quantity(slowest, "s", FEW)
        ),
        None => "* the model has no branch that creeps; a real cushion does".to_owned(),
    };
    Some(Line { label: "creep", text })
}

/// The compression under the weight.
pub(super) fn creep_table(drawn: &Drawn) -> Table {
    let creep = &drawn.cushion.creep;
    let times = creep.first().map_or(&[][..], |own| &own.crept);
    let time = |own: f64| match own {
        _ if own >= 86_400.0 => format!("{} d", rounded(own / 86_400.0, "1", DIGITS)),
        _ if own >= 3600.0 => format!("{} h", rounded(own / 3600.0, "1", DIGITS)),
        _ if own >= 60.0 => format!("{} min", rounded(own / 60.0, "1", DIGITS)),
        _ => quantity(own, "s", FEW),
    };
    let header = times.iter().map(|own| format!("{}\n%", time(own.0)));
    let header = ["stress\nkPa".to_owned()].into_iter().chain(header);
    let row = |own: &Creep| {
        let cells = own.crept.iter().map(|(_, strain, _, trust)| {
            let text = percent(*strain, FEW);
            let mark = match trust {
                Trust::Within => "",
                Trust::BeyondTimes => "*",
                Trust::PressedThrough => "!",
            };
            format!("{}{mark}", text.trim_end_matches(" %"))
        });
        list([in_kpa().number(own.stress, FEW)].into_iter().chain(cells))
    };
    Table::new("Compression under the weight", header, creep.iter().map(row))
}

/// The best stresses for drops in a row, by the mean of all but the first.
pub(super) fn row_table(drawn: &Drawn) -> Table {
    let count = drawn.wanted.asked.row.map_or(0, |own| own.drops);
    let mean = if count > 2 { format!("mean of 2 to {count}\ng") } else { "second\ng".to_owned() };
    let header = ["height\nmm", "thickness\nmm", "best stress\nkPa", "first\ng", &mean, "last\ng"];
    let row = |own: &Curve| {
        let mm = |value: f64| rounded(value * 1e3, "1", DIGITS);
        let usable = own.points.iter().zip(&own.repeated).filter(|own| own.0.is_usable());
        let usable = usable.filter(|own| own.1.later().is_finite());
        let (point, row) = usable.min_by(|one, other| one.1.later().total_cmp(&other.1.later()))?;
        let last = row.peaks.last().copied().unwrap_or(f64::NAN);
        let peaks = [row.peaks[0], Repeated::later(row), last];
        let cells = [mm(own.height), mm(own.thickness), in_kpa().number(point.stress, FEW)];
        Some(list(cells.into_iter().chain(peaks.map(|own| in_g().number(own, DIGITS)))))
    };
    Table::new("Drops in a row", header, drawn.cushion.curves.iter().filter_map(row))
}
