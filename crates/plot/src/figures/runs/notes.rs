//! What stands below the heading of a figure of runs: where in the run it is, what is left out and cut off.

use super::{
    super::unit::{self, Unit},
    RunSeries,
    series::MOST_LISTED,
};

/// What stands below a heading: which part of the run is shown, what is left out and cut off.
pub(super) fn note(runs: &[RunSeries], left_out: String, gaps: Option<String>) -> String {
    let place = first_touch(runs).or_else(|| runs.first().and_then(excerpt));
    let parts = [place, Some(left_out), gaps].into_iter().flatten();
    parts.filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; ")
}

/// When in the run the first touch is, where times count from there: `first touch at 451.5 ms of 600 ms`.
fn first_touch(runs: &[RunSeries]) -> Option<String> {
    let touching = || runs.iter().filter_map(|run| Some((run, run.first_touch?)));
    let (first, touch) = touching().next()?;
    let shown = touching().flat_map(|(run, _)| &run.time).copied().filter(|time| time.is_finite());
    let (low, high) = shown.fold((0.0_f64, 0.0_f64), |(l, h), time| (l.min(time), h.max(time)));
    let unit = Unit::of(&unit::TIME, touching().map(|own| own.1));
    let at = |touch: f64| format!("{} {}", unit.number_within(touch, high - low), unit.symbol());
    let times: Vec<String> = touching().map(|own| at(own.1)).collect();
    if !first.is_design || times.iter().all(|own| *own == times[0]) {
        let of = first.excerpt_of.map_or(String::new(), |end| format!(" of {}", unit.print(end)));
        return Some(format!("first touch at {}{of}", at(touch)));
    }
    if times.len() <= MOST_LISTED {
        let named =
            touching().zip(&times).map(|((run, _), time)| format!("{} at {time}", run.name));
        return Some(format!("first touch: {}", named.collect::<Vec<_>>().join(", ")));
    }
    let all = || touching().map(|own| own.1);
    let (soonest, latest) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    Some(format!("first touch from {} to {}", at(soonest), at(latest)))
}

/// Which part of a run is shown, as in `from 552.1 to 564.5 ms of 600 ms`.
fn excerpt(run: &RunSeries) -> Option<String> {
    let (end, from, to) = (run.excerpt_of?, *run.time.first()?, *run.time.last()?);
    let unit = Unit::of(&unit::TIME, run.time.iter().copied());
    let [first, last] = [from, to].map(|time| unit.number_within(time, to - from));
    Some(format!("from {first} to {last} {} of {}", unit.symbol(), unit.print(end)))
}

#[cfg(test)]
mod tests {
    use crate::figures::{FIGURES, FORCE_DEFORMATION, FORCE_TIME, tests::runs};

    #[test]
    fn every_figure_says_which_part_of_the_run_it_shows() {
        let mut runs = runs();
        assert!(FIGURES.iter().all(|figure| figure.chart(&runs).note.is_empty()));
        runs[0].excerpt_of = Some(1.0);
        runs[0].time.iter_mut().for_each(|time| *time += 0.5);
        for figure in FIGURES {
            assert_eq!(
                figure.chart(&runs).note,
                "from 500 to 520 ms of 1000 ms",
                "{}",
                figure.name
            );
        }
    }

    #[test]
    fn times_from_first_touch_are_called_so_and_the_run_time_is_told() {
        let mut runs = runs();
        runs.truncate(1);
        runs[0].excerpt_of = Some(0.6);
        runs[0].first_touch = Some(0.451_523_6);
        runs[0].time.iter_mut().for_each(|time| *time -= 1e-3);
        let chart = FORCE_TIME.chart(&runs);
        assert_eq!(chart.x_label, "time from first touch (ms)");
        assert_eq!(chart.note, "first touch at 451.5 ms of 600 ms");
        assert_eq!(FORCE_DEFORMATION.chart(&runs).x_label, "deformation (mm)");
    }

    #[test]
    fn each_design_has_its_own_first_touch() {
        let mut runs = runs();
        runs.iter_mut().for_each(|run| run.is_design = true);
        runs[0].first_touch = Some(0.45);
        runs[1].first_touch = Some(0.32);
        let note = FORCE_TIME.chart(&runs).note;
        assert_eq!(note, "first touch: exact at 450 ms, bdf at 320 ms");
        runs[1].first_touch = Some(0.45);
        assert_eq!(FORCE_TIME.chart(&runs).note, "first touch at 450 ms");
    }
}
