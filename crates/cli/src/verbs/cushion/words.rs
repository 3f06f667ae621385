//! Cushion curves in words.

use std::collections::BTreeSet;

use dashpot_analysis::{
    Missing,
    measures::{PeakAcceleration, STANDARD_GRAVITY},
};
use dashpot_design::cushion::{
    Assumed, Best, Curve, CushionPoint, Known, Passing, Place, Reach, Thinnest, Unmet,
};
use dashpot_network::parameters::Kind as _;
use dashpot_report::Table;
use dashpot_units::percent;

use super::{
    Drawn,
    batches::{self, Batches},
    beside,
};
use crate::{output::list, unevaluated, verbs::run::Line};
use dashpot_report::numbers::{Unit, constant, counted, digits, quantity, rounded};

/// Digits of a number that is read in passing, and of one that is an answer.
const FEW: usize = 3;
const DIGITS: usize = 4;
const MANY: usize = 12;
/// Digits of a peak, whatever its error.
const MOST_DIGITS: usize = 5;
/// What a whole number of units may be off by rounding, in parts of itself.
const ROUNDING: f64 = 1e-12;
/// What stands where there is nothing.
const NONE: &str = "–";

/// Peaks are read in g, stresses in kPa.
pub(super) fn in_g() -> Unit {
    Unit::new("g", STANDARD_GRAVITY)
}

pub(super) fn in_kpa() -> Unit {
    Unit::new("kPa", 1e3)
}

pub(super) fn length(value: f64) -> String {
    rounded(value, "m", DIGITS)
}

/// A length that is not below the value, as a thinner cushion than one that just keeps a limit does not keep it.
pub(super) fn no_less(value: f64) -> String {
    length(towards(value, DIGITS, f64::ceil))
}

/// Stresses that keep a limit in kPa, so rounded that what is printed keeps it as well, and how many digits that takes.
fn inside([low, high]: [f64; 2]) -> ([f64; 2], usize) {
    let own = |digits| [towards(low, digits, f64::ceil), towards(high, digits, f64::floor)];
    let digits = (FEW..MANY).find(|digits| own(*digits)[0] <= own(*digits)[1]).unwrap_or(MANY);
    (own(digits), digits)
}

/// A positive value of so many significant digits.
fn towards(value: f64, digits: usize, side: fn(f64) -> f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - (digits - 1) as f64);
    let units = value / unit;
    let is_whole = (units - units.round()).abs() <= ROUNDING * units;
    let own = if is_whole { units.round() } else { side(units) } * unit;
    if own.is_finite() { own } else { value }
}

/// `parcel falls on cushion of 133.3 cm², whose static stress is …`.
pub(super) fn asked(drawn: &Drawn) -> String {
    let own = &drawn.cushion.platen;
    let area = Unit::new("cm²", 1e-4).text(own.area, DIGITS);
    let masses = drawn.cushion.curves.first().map(|curve| {
        let mass = |at: usize| curve.points[at].stress * own.area / own.gravity;
        let [low, high] = [mass(0), mass(curve.points.len() - 1)];
        let [low, high] = [low, high].map(|own| quantity(own, "kg", FEW));
        if low == high { format!(", with {low}") } else { format!(", with {low} to {high}") }
    });
    format!("{} falls flat on {area} of {}{}", own.body, own.pad, masses.unwrap_or_default())
}

/// What was found, before the table.
pub(super) fn lines(drawn: &Drawn) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut add = |label, text: String| lines.push(Line { label, text });
    for own in &drawn.cushion.platen.assumed {
        let text = match own {
            Assumed::Gravity => "gravity acts with 1 g, of which the scene says nothing",
            Assumed::Separation => {
                "the platen may leave the cushion, of which the scene says nothing"
            }
        };
        add("assumed", text.to_owned());
    }
    for own in &drawn.cushion.thinnest {
        for (label, text) in thinnest(drawn, own) {
            add(label, text);
        }
    }
    if drawn.cushion.thinnest.is_empty() {
        let least = least(&drawn.cushion.curves);
        lines.extend(least.map(|(curve, best)| Line {
            label: "least peak",
            text: format!(
                "{} from {} on {} at {}",
                in_g().text(best.point.peak, DIGITS),
                length(curve.height),
                length(curve.thickness),
                in_kpa().text(best.point.stress, DIGITS)
            ) + of_evaluated(drawn),
        }));
    }
    if drawn.cushion.thinnest.is_empty()
        && let Some(limit) = drawn.wanted.asked.limit
    {
        lines.extend(drawn.cushion.of_heights().map(|own| of_limit(drawn, own, limit)));
    }
    lines.push(own_stress(drawn));
    lines.extend(drawn.batches.iter().flat_map(Batches::lines));
    lines.extend(drawn.cushion.stress_energy.as_ref().map(beside::stress_energy));
    lines.extend(drawn.cushion.creep.iter().find_map(beside::slowest));
    lines
}

/// What is said of a least value where not everything could be evaluated.
fn of_evaluated(drawn: &Drawn) -> &'static str {
    let missing = &drawn.cushion.unevaluated;
    if missing.is_empty() { "" } else { ", of the drops that could be evaluated" }
}

/// What could not be evaluated.
pub(super) fn missing(drawn: &Drawn) -> Vec<String> {
    let place = |own: &Missing| {
        let [height, thickness, stress] = own.values[..] else { return String::new() };
        format!("{} on {} with {}", length(height), length(thickness), in_kpa().text(stress, FEW))
    };
    unevaluated::sentences(&drawn.cushion.unevaluated, "drop", place)
}

/// The static stress of what falls in the scene.
fn own_stress(drawn: &Drawn) -> Line {
    let own = &drawn.cushion.platen;
    let [mass, stress] = [constant(own.mass, "kg"), in_kpa().text(own.stress(), DIGITS)];
    Line { label: "scene", text: format!("{} of {mass} has a static stress of {stress}", own.body) }
}

/// The curve with the least peak.
fn least(curves: &[Curve]) -> Option<(&Curve, Best)> {
    let bests = curves.iter().filter_map(|own| Some((own, own.best?)));
    bests.min_by(|one, other| one.1.point.peak.total_cmp(&other.1.point.peak))
}

/// Whether one of the cushions keeps the limit from a height at any static stress: the thinnest one that does.
fn of_limit(drawn: &Drawn, curves: &[Curve], limit: f64) -> Line {
    let height = curves.first().map_or(String::new(), |own| length(own.height));
    let line = |label, text: String| Line {
        label,
        text: format!("{} from {height}: {text}", in_g().text(limit, FEW)),
    };
    let has =
        |known: Known| curves.iter().flat_map(|own| &own.points).any(|own| own.known == known);
    let is_missing = has(Known::Unsolved);
    if let Some((own, kept)) = curves.iter().find_map(|own| Some((own, own.passing?))) {
        let ([low, high], digits) = inside(kept.stress);
        let (low, high) = (in_kpa().number(low, digits), in_kpa().text(high, digits));
        return line("PASS", format!("{} keep it at {low} to {high}", length(own.thickness)));
    }
    let Some((own, Best { point, place, .. })) = least(curves) else {
        let pressed = format!("every drop presses {} {}", drawn.cushion.platen.pad, end(drawn));
        let is_certain = !is_missing && !has(Known::BeyondLaw);
        return line(if is_certain { "FAIL" } else { "UNDECIDED" }, pressed);
    };
    // The least peak may lie beyond the stresses, or within the error of what was found.
    let is_end = |place: Place| matches!(place, Place::Low | Place::High);
    let is_at_end = |own: &Curve| own.best.is_some_and(|own| is_end(own.place));
    let error = if point.error.is_finite() { point.error } else { 0.0 };
    let is_near = point.peak - error <= limit;
    let falls_on = |own: &Curve| own.best.is_some_and(|own| own.place == Place::EndOfKnown);
    let is_beyond = curves.iter().any(falls_on) && has(Known::BeyondLaw);
    let is_open = is_near || is_missing || is_beyond || curves.iter().any(is_at_end);
    let error = if is_near && error > 0.0 {
        format!(" ± {}", in_g().number(error, 2))
    } else {
        String::new()
    };
    let text = format!(
        "the least peak is {}{error} on {} at {}{}",
        in_g().text(point.peak, DIGITS),
        length(own.thickness),
        in_kpa().text(point.stress, FEW),
        if is_end(place) { ", where the range ends" } else { "" }
    );
    line(if is_open { "UNDECIDED" } else { "FAIL" }, text)
}

/// Where a law ends, which may be that of another element.
fn beyond_law(drawn: &Drawn) -> &'static str {
    if drawn.cushion.platen.has_others {
        "until it or another element is beyond what is known of it"
    } else {
        "beyond the last point of its law"
    }
}

/// How far the cushion is pressed where curves are no longer known.
fn end(drawn: &Drawn) -> String {
    let ends = [
        (Known::BeyondLaw, beyond_law(drawn)),
        (Known::PressedThrough, "beyond its thickness"),
        (Known::Infinite, "to where its peak is infinite"),
    ];
    let is_end = |own: &&CushionPoint| ends.iter().any(|end| end.0 == own.known);
    let first = |own: &Curve| own.points.iter().find(is_end).map(|own| own.known);
    let has = |known: Known| drawn.cushion.curves.iter().any(|own| first(own) == Some(known));
    let said = ends.iter().filter(|own| has(own.0)).map(|own| own.1);
    let said = list(said);
    if said.is_empty() { "further than is known of it".to_owned() } else { said.join(" or ") }
}

fn thinnest(drawn: &Drawn, own: &Thinnest) -> Vec<(&'static str, String)> {
    let asked = &drawn.wanted.asked;
    let limit = asked.limit.map_or(String::new(), |own| in_g().text(own, FEW));
    let over = asked.over.unwrap_or_default();
    let over = format!("{} to {}", in_kpa().number(over[0], FEW), in_kpa().text(over[1], FEW));
    let height = length(own.height);
    let first = match own.over_all {
        Ok((thickness, worst)) => {
            let first = match (own.is_first, own.is_open) {
                (true, _) => "; it is the thinnest one that was asked for",
                (false, true) => "; thinner ones could not be evaluated and may keep it as well",
                (false, false) => "",
            };
            let error = worst.error / worst.peak;
            let error = if error.is_finite() {
                format!(" ± {}", percent(error, 1))
            } else {
                String::new()
            };
            let text = format!(
                "{} keep {limit} from {height} over {over}: at most {}{error} at {}{first}",
                no_less(thickness),
                in_g().text(worst.peak, DIGITS),
                in_kpa().text(worst.stress, FEW),
            );
            (if own.is_open { "UNDECIDED" } else { "thinnest" }, text)
        }
        Err(why) => {
            let label = if why.is_certain() { "NONE" } else { "UNDECIDED" };
            let why = match why {
                Unmet::Peak(peak, stress) => {
                    format!("has {} at {}", in_g().text(peak, DIGITS), in_kpa().text(stress, FEW))
                }
                Unmet::Known(stress, Known::Unsolved) => {
                    format!("could not be evaluated at {}", in_kpa().text(stress, FEW))
                }
                Unmet::Known(stress, _) => {
                    format!("is pressed {} at {}", end(drawn), in_kpa().text(stress, FEW))
                }
            };
            let thickest = asked.thicknesses.last().map_or(String::new(), |own| length(*own));
            (label, format!("nothing keeps {limit} from {height} over {over}: {thickest} {why}"))
        }
    };
    let lightest = own.lightest.map(|[volume, thickness, stress]| {
        let text = format!(
            "{} at {} take the least over {over} for {limit} from {height}: {} for each kg",
            no_less(thickness),
            in_kpa().text(stress, FEW),
            Unit::new("cm³", 1e-6).text(volume * drawn.cushion.platen.gravity, FEW),
        ) + of_evaluated(drawn);
        ("lightest", text)
    });
    let sure = batches::sure(own, &limit);
    [first].into_iter().chain(sure).chain(lightest).collect()
}

/// The best stress of each curve, its peak, its floor and what keeps the limit.
pub(super) fn table(drawn: &Drawn) -> Table {
    let limit = drawn.wanted.asked.limit;
    let has_floor = drawn.cushion.curves.iter().any(|own| own.floor.is_some());
    let header =
        ["height\nmm", "thickness\nmm", "best stress\nkPa", "peak\ng", "±\n%", "strain\n%"];
    let has_bands = drawn.batches.is_some();
    let more = [has_bands.then_some("95 % of designs\ng"), has_floor.then_some("floor\ng")];
    let limited = limit.map(|own| format!("at most {}\nkPa", in_g().text(own, FEW)));
    let header = header.into_iter().chain(more.into_iter().flatten()).chain(limited.as_deref());
    let stress = drawn.cushion.platen.stress();
    let row = |own: &Curve| {
        let mm = |value: f64| rounded(value * 1e3, "1", DIGITS);
        let best = own.best.map_or([NONE; 4].map(str::to_owned), |own| of_best(&own));
        let floor = own.floor.map_or(NONE.to_owned(), |own| in_g().number(own, FEW));
        let passing =
            limit.map(|_| own.passing.map_or(NONE.to_owned(), |own| passing(own, stress)));
        let band = batches::range(own.best_band.as_ref()).unwrap_or_else(|| NONE.to_owned());
        let first = [mm(own.height), mm(own.thickness)].into_iter().chain(best);
        let more = [has_bands.then_some(band), has_floor.then_some(floor), passing];
        list(first.chain(more.into_iter().flatten()))
    };
    let rows = drawn.cushion.curves.iter().map(row);
    Table::new("The best static stress of each curve", header, rows)
}

fn of_best(Best { point, place }: &Best) -> [String; 4] {
    let CushionPoint { stress, peak, error, strain, .. } = *point;
    let mark = match place {
        Place::Within => "",
        Place::Low => "≤ ",
        Place::High => "≥ ",
        Place::EndOfKnown => "→ ",
    };
    let known = Some(error).filter(|own| own.is_finite());
    let peak_text = in_g().number(peak, digits(peak, known, MOST_DIGITS));
    let error = known.map_or(NONE.to_owned(), |own| dashpot_report::numbers::bound(own / peak));
    [
        format!("{mark}{}", in_kpa().number(stress, FEW)),
        peak_text,
        error.trim_end_matches(" %").to_owned(),
        percent(strain, FEW).trim_end_matches(" %").to_owned(),
    ]
}

/// The stresses that keep the limit, with a mark where that of the scene is one of them.
fn passing(Passing { stress, ends }: Passing, own: f64) -> String {
    let (stress, digits) = inside(stress);
    let mark = if within(stress, own) { " ✓" } else { "" };
    let [low, high] = stress.map(|own| in_kpa().number(own, digits));
    let [before, behind] = ends.map(|own| match own {
        Reach::Limit => "",
        Reach::Range => "…",
        Reach::Known => "!",
    });
    format!("{before}{low}–{high}{behind}{mark}")
}

fn within([low, high]: [f64; 2], own: f64) -> bool {
    (low..=high).contains(&own)
}

/// Whether there are several thicknesses, and cushions of all of them have the same peaks.
fn is_unmoved_by_thickness(curves: &[Curve]) -> bool {
    let of_height = |one: &&[Curve]| {
        let peaks = |own: &Curve| list(own.points.iter().map(|own| own.peak.to_bits()));
        one.windows(2).all(|pair| peaks(&pair[0]) == peaks(&pair[1]))
    };
    let mut heights = curves.chunk_by(|one, other| one.height.to_bits() == other.height.to_bits());
    let has_peak = |own: &Curve| own.points.iter().any(|own| own.peak.is_finite());
    let has_thicknesses =
        curves.iter().any(|own| own.thickness.to_bits() != curves[0].thickness.to_bits());
    has_thicknesses && curves.iter().all(has_peak) && heights.all(|own| of_height(&own))
}

/// What is to be known of the curves, below the table.
pub(super) fn notes(drawn: &Drawn) -> Vec<String> {
    let curves = &drawn.cushion.curves;
    let points = || curves.iter().flat_map(|own| &own.points);
    let all = points().count();
    let count = |known: Known| points().filter(|own| own.known == known).count();
    let pad = &drawn.cushion.platen.pad;
    let told = [
        (Known::OnStop, format!("meet the stop of {pad}")),
        (Known::Infinite, "have an infinite peak: masses meet, as on a rigid stop".to_owned()),
        (Known::BeyondLaw, format!("press {pad} {}", beyond_law(drawn))),
        (Known::PressedThrough, format!("press {pad} by more than its thickness")),
    ];
    let told = told.into_iter().map(|(known, text)| (count(known), text));
    let told = told.filter(|own| own.0 > 0);
    let mut notes: Vec<String> =
        list(told.map(|(own, text)| format!("{own} of {} {text}", counted(all, "drop"))));
    if is_unmoved_by_thickness(curves) {
        notes.push(format!(
            "no peak changes with the thickness of {pad}: a law of force and deformation has none; write it as a \
             material, of stress and strain, with an area"
        ));
    }
    let has =
        |place: Place| curves.iter().any(|own| own.best.is_some_and(|own| own.place == place));
    if has(Place::EndOfKnown) {
        notes.push(format!("→ the peak falls until {pad} is pressed {}", end(drawn)));
    }
    if has(Place::Low) || has(Place::High) {
        notes.push("≤, ≥ the least peak may lie beyond the end of the range".to_owned());
    }
    let ends = |reach: Reach| {
        curves.iter().filter_map(|own| own.passing).any(|own| own.ends.contains(&reach))
    };
    if ends(Reach::Range) {
        notes.push("… the range of stresses ends there, not what keeps the limit".to_owned());
    }
    if ends(Reach::Known) {
        notes.push(format!("! {pad} is pressed {} there, before the limit", end(drawn)));
    }
    let own = drawn.cushion.platen.stress();
    if curves.iter().filter_map(|own| own.passing).any(|kept| within(inside(kept.stress).0, own)) {
        notes.push(format!("✓ the static stress of {} in the scene", drawn.cushion.platen.body));
    }
    let rows = || curves.iter().flat_map(|own| &own.repeated);
    let ended = rows().filter(|own| !own.is_known).count();
    if ended > 0 {
        notes.push(format!(
            "{ended} of {} press {pad} {}: no mean is told there",
            counted(rows().count(), "row"),
            end(drawn)
        ));
    }
    let work = drawn.cushion.work;
    notes.push(format!(
        "{} solved, {} of them in full; {} between them",
        counted(work.points, "drop"),
        work.points - work.instantiated,
        counted(work.probes, "further one")
    ));
    if drawn.batches.is_some() {
        notes.extend(batches_notes(drawn));
    }
    notes.extend(not_judged(drawn));
    notes
}

/// The limits of the scene that cushion curves say nothing of.
fn not_judged(drawn: &Drawn) -> Option<String> {
    let judged = format!("{}.{}", drawn.cushion.platen.body, PeakAcceleration::KIND);
    let others = drawn.scene.limits.iter().map(|limit| &limit.key).filter(|key| **key != judged);
    let others: BTreeSet<String> = others.map(|key| format!("`{key}`")).collect();
    let all = list(others).join(", ");
    (!all.is_empty()).then(|| {
        format!("not judged: the scene's limits on {all}; `dashpot run` judges one design")
    })
}

/// What is to be known of bands.
fn batches_notes(drawn: &Drawn) -> Vec<String> {
    let work = drawn.cushion.work;
    let solved = format!(
        "{} of scattered designs, {} of them in full",
        counted(work.scattered, "drop"),
        work.scattered - work.scattered_instantiated
    );
    let bands = || drawn.cushion.curves.iter().flat_map(|own| &own.bands);
    let ended = bands().filter(|own| own.without > 0).count();
    let ended = (ended > 0).then(|| {
        format!(
            "at {ended} of {} a design presses {} {}: no band is told there",
            counted(bands().count(), "drop"),
            drawn.cushion.platen.pad,
            end(drawn)
        )
    });
    [solved].into_iter().chain(ended).collect()
}
