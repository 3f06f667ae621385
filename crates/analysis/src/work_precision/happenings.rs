//! Events of a run, and how well another run meets their times.

use crate::{Contact, RunReport};

/// Something that happens at a time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Happening {
    /// What, without any number that depends on the solution.
    what: String,
    /// When \[s\].
    pub(super) time: f64,
    /// Whether quantities may jump there.
    jumps: bool,
}

/// What switches, what crosses a level that is watched, and glued contacts whose force turns.
pub(super) fn happenings(report: &RunReport) -> Vec<Happening> {
    let trajectory = &report.trajectory;
    let switches = trajectory.switches.iter().map(|switch| Happening {
        what: format!("{}: {}", switch.name, switch.what),
        time: switch.time,
        jumps: true,
    });
    let crossings = trajectory.events.iter().map(|event| Happening {
        what: format!("condition {}", event.guard),
        time: event.time,
        jumps: false,
    });
    let released =
        |own: &&crate::ContactReport| own.is_glued && own.impact.contact == Contact::Released;
    let releases = report.contacts.iter().filter(released).map(|contact| Happening {
        what: format!("{} turns to tension", contact.element),
        time: contact.impact.end,
        jumps: false,
    });
    switches.chain(crossings).chain(releases).collect()
}

/// How two runs compare in what happens: the first of a kind with the first, and so on.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Match {
    /// The largest difference of a time \[s\] of those events that both have; `None` where they have none.
    pub(super) apart: Option<f64>,
    /// Events of the first run that the second one has not.
    pub(super) missed: usize,
    /// Events of the second run that the first one has not.
    pub(super) extra: usize,
    /// The times between a jump in one run and the same jump in the other \[s\], in order. Where they
    /// are as far apart as half the way to the next one of the kind, they are not the same.
    pub(super) jumps: Vec<(f64, f64)>,
}

/// Matches the events of `run` with the `true` ones.
pub(super) fn matched(truth: &[Happening], run: &[Happening]) -> Match {
    let mut found = Match::default();
    let mut kinds: Vec<&str> = truth.iter().chain(run).map(|own| own.what.as_str()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in kinds {
        let of = |all: &[Happening]| -> Vec<(f64, bool)> {
            let same = all.iter().filter(|own| own.what == kind);
            same.map(|same| (same.time, same.jumps)).collect()
        };
        let (one, other) = (of(truth), of(run));
        for (at, (&(time, jumps), &(in_run, _))) in one.iter().zip(&other).enumerate() {
            let apart = (time - in_run).abs();
            found.apart = Some(found.apart.unwrap_or(0.0).max(apart));
            let before = at.checked_sub(1).and_then(|at| one.get(at));
            let neighbours = before.into_iter().chain(one.get(at + 1));
            let is_same = |other: &(f64, bool)| apart <= 0.5 * (time - other.0).abs();
            if jumps && neighbours.into_iter().all(is_same) {
                found.jumps.push((time.min(in_run), time.max(in_run)));
            }
        }
        found.missed += one.len().saturating_sub(other.len());
        found.extra += other.len().saturating_sub(one.len());
    }
    found.jumps.sort_by(|one, other| one.0.total_cmp(&other.0));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(what: &str, time: f64) -> Happening {
        Happening { what: what.to_owned(), time, jumps: true }
    }

    #[test]
    fn events_are_matched_by_kind_and_order() {
        let truth = [at("closes", 1.0), at("opens", 2.0), at("closes", 3.0)];
        let run = [at("opens", 2.25), at("closes", 1.0), at("closes", 2.875)];
        let own = matched(&truth, &run);
        assert_eq!((own.apart, own.missed, own.extra), (Some(0.25), 0, 0));
        assert_eq!(own.jumps, [(1.0, 1.0), (2.0, 2.25), (2.875, 3.0)]);
    }

    #[test]
    fn jumps_that_are_nearer_to_the_next_one_are_not_the_same() {
        let truth = [at("opens", 1.0), at("opens", 2.0), at("opens", 3.0)];
        let own = matched(&truth, &[at("opens", 1.25), at("opens", 3.0)]);
        assert_eq!((own.jumps, own.missed), (vec![(1.0, 1.25)], 1));
    }

    #[test]
    fn events_that_only_one_run_has_are_counted() {
        let truth = [at("closes", 1.0), at("opens", 2.0)];
        let own = matched(&truth, &[at("closes", 1.0), at("sticks", 1.0)]);
        assert_eq!((own.apart, own.missed, own.extra), (Some(0.0), 1, 1));
        assert_eq!(matched(&[], &[]), Match::default());
    }
}
