//! What a run says about its limits, in words, and whether they are kept.

use dashpot_analysis::{Judged, Judgement, MeasureReport, Reason, RunReport, Warning};
pub(crate) use dashpot_studies::measure_units::{level, stated, unit_of_limit};
use dashpot_units::percent;

use super::{
    scatter,
    verdict::{Line, TIME_DIGITS},
};
use dashpot_report::numbers::{self, MOST_DIGITS, bound, counted, percent_signed};

/// Digits of a value beside its limit.
const DIGITS: usize = 4;

/// One line for each limit.
pub(crate) fn lines(run: &RunReport) -> Vec<Line> {
    let line = |judged: &Judged<'_>| {
        let label = match judged.judgement {
            Judgement::Pass => "PASS",
            Judgement::Fail => "FAIL",
            Judgement::Undecided(_) => "UNDECIDED",
        };
        Line { label, text: text(run, judged) }
    };
    run.judged().iter().map(line).collect()
}

/// Whether every limit is kept in every run.
pub(super) fn all_pass(runs: &[RunReport]) -> bool {
    let mut all = runs.iter().flat_map(RunReport::judged);
    all.all(|judged| judged.judgement == Judgement::Pass)
}

/// What is known of a limit, with its margin: `pass, 62 %`.
pub(super) fn short(run: &RunReport, judged: &Judged<'_>) -> String {
    let word = match judged.judgement {
        Judgement::Pass => "pass",
        Judgement::Fail => "FAIL",
        Judgement::Undecided(_) => "UNDECIDED",
    };
    let value = judged.measure.map(|own| value(own, judged));
    let value = value.map_or(String::new(), |value| format!(", {value}"));
    let margin = margin(judged).map(|margin| format!(", margin {margin}"));
    let chance = scatter::chance(judged).map_or(String::new(), |own| format!(", {own}"));
    let doubt = doubt(run, judged).map_or(String::new(), |own| format!(", {own}"));
    word.to_owned() + &value + &margin.unwrap_or_default() + &doubt + &chance
}

fn text(run: &RunReport, judged: &Judged<'_>) -> String {
    let limit = judged.limit;
    let value = judged.measure.map_or("is not reported".to_owned(), |own| value(own, judged));
    let margin = margin(judged).map_or(String::new(), |margin| format!("; margin {margin}"));
    let mean = match judged.sampled {
        Some(_) => "; judged by the mean of the sample",
        None if limit.of_mean => "; one run stands for the mean of the tests",
        None => "",
    };
    let chance = scatter::chance(judged).map_or(String::new(), |own| format!("; {own}"));
    let is_bare = judged.value().is_some() && judged.error().is_none();
    let bare = if is_bare { "; its error is not known" } else { "" };
    let advice = advice(run, judged).map_or(String::new(), |own| format!("; {own}"));
    let stated = stated(limit, judged.measure);
    let doubt = doubt(run, judged).map_or(String::new(), |own| format!("; {own}"));
    format!("{} {value}, {stated}{margin}{doubt}{chance}{bare}{mean}{advice}", limit.key)
}

/// Why a limit that would be kept is not kept for certain.
fn doubt(run: &RunReport, judged: &Judged<'_>) -> Option<String> {
    beyond(run, judged).or_else(|| outside(run, judged)).or_else(|| of_designs(run, judged))
}

/// What is left to the bound; nothing where the value hangs on what is not known.
fn margin(judged: &Judged<'_>) -> Option<String> {
    judged.margin().filter(|_| !is_beyond(judged)).map(percent_signed)
}

/// Whether it hangs on something that is pressed further than is known of it.
fn is_beyond(judged: &Judged<'_>) -> bool {
    matches!(judged.judgement, Judgement::Undecided(Reason::Beyond | Reason::NoLaw))
}

/// What a limit hangs on that would be kept, where something is pressed further than is known of it.
fn beyond(run: &RunReport, judged: &Judged<'_>) -> Option<String> {
    if !is_beyond(judged) {
        return None;
    }
    // Of a sample it is single designs that are.
    let Some(warning) = run.beyond_known().next().filter(|_| judged.sampled.is_none()) else {
        let designs = judged.chance.map_or(0, |own| own.beyond);
        let are = if designs == 1 { "is" } else { "are" };
        let designs = counted(designs, "design");
        return Some(format!("{designs} of the sample {are} pressed beyond a law or a thickness"));
    };
    let at_equator = run.beyond_known().find_map(|own| match own {
        Warning::BeyondLaw(own) => Some(&own.name).filter(|_| own.at_equator),
        _ => None,
    });
    if let Some(name) = at_equator {
        return Some(format!(
            "it hangs on {name} deeper in than the radius of its body, where its shape is not modelled"
        ));
    }
    let what = match warning {
        Warning::BeyondLaw(own) => format!(
            "{} beyond the points of its law, where a foam that densifies is stiffer than the straight line that is \
             taken",
            own.name
        ),
        Warning::PressedThrough { through, .. } => format!("{} beyond its thickness", through.name),
        other => format!("{} beyond its thickness", other.names().join(", ")),
    };
    Some(format!("it would pass, but hangs on {what}"))
}

/// That a limit is kept at the means alone.
fn of_designs(run: &RunReport, judged: &Judged<'_>) -> Option<String> {
    let is_it = judged.judgement == Judgement::Undecided(Reason::Scatter);
    let scatter = run.scatter.as_ref().filter(|_| is_it)?;
    let wanted = scatter.wanted;
    if judged.chance.is_some_and(|own| own.odds.range().0 >= wanted) {
        return Some(format!(
            "it passes at the means, but only {} of what scatters is within what the scene allows, and it has to be kept \
             by {}",
            percent(scatter.within(), 3),
            percent(wanted, 3)
        ));
    }
    Some(format!(
        "it passes at the means, but the whole range of the probability has to be {} or more, and a larger `--sample` \
         makes it narrower",
        percent(wanted, 3)
    ))
}

/// What exceeds a limit that is kept in the impact, outside of it.
fn outside(run: &RunReport, judged: &Judged<'_>) -> Option<String> {
    if judged.judgement != Judgement::Undecided(Reason::Outside) {
        return None;
    }
    if judged.sampled.is_some() {
        let designs = judged.chance.map_or(0, |own| own.outside);
        let designs = counted(designs, "design");
        return Some(format!("in {designs} of the sample there is more outside the impact"));
    }
    let harder = run.warnings.iter().find_map(|own| match own {
        Warning::HarderOutside(all) => all.iter().find(|own| own.measure == judged.limit.key),
        _ => None,
    })?;
    let measure = judged.measure?;
    let level =
        unit_of_limit(measure.kind, measure.unit, judged.limit).text(harder.outside, DIGITS);
    let time = numbers::quantity(harder.time, "s", TIME_DIGITS);
    let pulls = run.warnings.iter().find_map(|own| match own {
        Warning::Pulls { element, since } if since.is_none_or(|since| since <= harder.time) => {
            Some(element)
        }
        _ => None,
    });
    let way = match pulls {
        Some(element) => format!(
            "the {element} pulls before, and lets go with `separation.{element} = {{}}` under [effects]"
        ),
        None => "`window = \"run\"` counts that, a window of two times need not".to_owned(),
    };
    Some(format!("it passes in the impact, but over the run it is {level}, at {time}: {way}"))
}

/// The value with as many digits as tell it from the bound, and with its error where that reaches across.
fn value(measure: &MeasureReport, judged: &Judged<'_>) -> String {
    let (limit, error) = (judged.limit, judged.error());
    let Some(value) = judged.value() else {
        let is_infinite = measure.is_infinite() && judged.sampled.is_none();
        return if is_infinite { "is infinite" } else { "is not determined" }.to_owned();
    };
    let unit = unit_of_limit(measure.kind, measure.unit, limit);
    let apart = (value - limit.bound.level()).abs();
    let wanted = numbers::digits(value, Some(0.1 * apart), MOST_DIGITS).max(DIGITS);
    let digits = numbers::digits(value, error, wanted);
    match error.filter(|error| *error >= apart && error.is_finite()) {
        Some(error) => format!("{} ± {}", unit.text(value, digits), unit.text(error, 2)),
        None => unit.text(value, digits),
    }
}

/// What may decide what is open.
fn advice(run: &RunReport, judged: &Judged<'_>) -> Option<String> {
    let is_of_run = judged.sampled.is_none();
    match judged.judgement.reason()? {
        Reason::Cut if is_of_run => {
            let end = numbers::quantity(run.energy.time, "s", TIME_DIGITS);
            return Some(format!("the run ends in contact at {end}: make `duration` longer"));
        }
        Reason::Error if is_of_run => {}
        Reason::Beyond
        | Reason::NoLaw
        | Reason::Outside
        | Reason::NoValue
        | Reason::OtherAxes
        | Reason::Clipped
        | Reason::Unit
        | Reason::Scatter => return None,
        Reason::Cut | Reason::Error => return Some("a larger `--sample` may decide".to_owned()),
    }
    let value = judged.measure?.value?;
    let apart = (value - judged.limit.bound.level()).abs() / value.abs();
    // Half of it, for the value will move as well.
    let wanted = 0.5 * apart;
    run.solver.rtol.filter(|_| wanted > 1e-10)?;
    Some(format!("`--accuracy {}` may decide", bound(wanted).replace(' ', "")))
}
