//! Contact forces that come within their error of zero and push on.

use std::{borrow::Cow, cell::OnceCell};

use dashpot_dae::Signal;

use super::Solution;
use crate::impact::{
    contacts::between,
    interval::{Impact, NO_PULL, first_pull},
};

/// How much larger one force may be than another that is the same.
const SAME: f64 = 1.5;
/// How many times as long as it would take to reach zero at its pace a force may take that is about to.
const SLOW: f64 = 3.0;

/// Where a force comes near zero without going on to pull: it turns back, or lingers.
struct ForceMinimum {
    /// When it has come near \[s\].
    start: f64,
    /// When it is lowest or, while it falls, has taken too long \[s\].
    low: f64,
}

impl ForceMinimum {
    /// The first below the given level \[N\] in the window; `None` where the force passes zero at the end
    /// of the window.
    fn first(force: &Signal, window: (f64, f64), level: f64) -> Option<Self> {
        let fall = force.first_crossing(level, window, Some(false))?;
        let latest = fall.time + SLOW * level / fall.slope.abs();
        let turns = force.extrema((fall.time, latest.min(window.1)));
        // The first is where it falls below the level, the last where the window ends.
        let low = turns.get(1).filter(|_| turns.len() > 2).map_or(latest, |turn| turn.time);
        (low < window.1).then_some(Self { start: fall.time, low })
    }
}

/// When a contact may end whose force comes so near to zero, before it pushes on, that it cannot be told
/// whether it would pull \[s\]; `None` if it does not. The last of the forces is that of the finest
/// solution, which is in doubt below `level` \[N\], and less so where all agree that it pushes.
fn earliest_end(forces: &[&Signal], window: (f64, f64), level: f64) -> Option<f64> {
    let (finest, others) = forces.split_last()?;
    let (mut window, mut level) = (window, level);
    while level > finest.noise {
        let minimum = ForceMinimum::first(finest, window, level)?;
        let low = finest.value(minimum.low);
        let agrees = |other: f64| low.max(other) <= SAME * low.min(other) && low < level;
        if low <= 0.0 || !others.iter().all(|other| agrees(other.value(minimum.low))) {
            let passage = finest.first_crossing(0.0, (minimum.start, minimum.low), Some(false));
            return Some(passage.map_or(minimum.start, |passage| passage.time));
        }
        (window.0, level) = (minimum.start, 0.5 * low);
    }
    None
}

/// Whose contact force it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ForceOf {
    /// The element of this number, which touches an impactor.
    Element(usize),
    /// The body of this number, to which an impactor belongs: the sum of all that acts on it.
    Body(usize),
}

/// Impacts that may end at the time given \[s\], before they seem to.
pub(crate) type UndecidedReleases = Vec<(ForceOf, f64)>;

/// What a solution leaves open that `others`, which are coarser, do not agree on with it, where pulls below
/// the part `threshold` of the largest force may be errors of it; without others, where it pulls by less.
fn undecided_releases<'a>(
    finest: &Solution<'a>,
    make_others: &dyn Fn() -> Vec<Solution<'a>>,
    threshold: f64,
) -> UndecidedReleases {
    let others = OnceCell::new();
    let undecided = |force_of: ForceOf| {
        let force = finest.contact_force(force_of)?;
        let window = finest.impact_felt(force_of).pushing()?;
        let level = threshold * force.bound();
        // Most forces go straight through zero, and nothing need be asked of the others.
        ForceMinimum::first(&force, window, level)?;
        let others: Vec<Cow<'_, Signal>> = others
            .get_or_init(make_others)
            .iter()
            .map(|own| own.contact_force(force_of))
            .collect::<Option<_>>()?;
        let mut forces: Vec<&Signal> = others.iter().map(AsRef::as_ref).collect();
        forces.push(&force);
        Some((force_of, earliest_end(&forces, window, level)?))
    };
    finest.contacts_felt().filter_map(undecided).collect()
}

/// The same without what lets go for a moment in the ripples of segments of layers: that ends no impact, and what it may
/// hide is for [`releases_in_ripples`].
pub(crate) fn undecided_ends<'a>(
    finest: &Solution<'a>,
    make_others: &dyn Fn() -> Vec<Solution<'a>>,
    threshold: f64,
) -> UndecidedReleases {
    let mut all = undecided_releases(finest, make_others, threshold);
    all.retain(|own| finest.passage(own.0) <= 0.0);
    all
}

/// The way of a force to zero is looked at from so many heights of ripples on: its pace is known to an eighth then …
const DESCENT: f64 = 8.0;
/// … but from no more than this part of the largest force on, or from two heights.
const HALF: f64 = 0.5;

/// When impacts may end whose forces are known up to ripples of this `height`, in parts of the largest force: where a force
/// comes within them before and the `others` do not agree that it pushes on, else before it is zero by what they are worth
/// on its last way there; see [`DESCENT`].
pub(crate) fn releases_in_ripples<'a>(
    finest: &Solution<'a>,
    make_others: &dyn Fn() -> Vec<Solution<'a>>,
    height: f64,
) -> UndecidedReleases {
    let earlier = undecided_releases(finest, make_others, height);
    let heights = DESCENT.min(HALF / height).max(2.0);
    // From when on it only falls, and when it may be zero then.
    let descent = |force_of: ForceOf| {
        let impact = finest.impact_felt(force_of);
        let window = impact.pushing().filter(|_| impact.has_ended())?;
        let force = finest.contact_force(force_of)?;
        let falls = force.crossings(heights * height * force.bound(), window);
        let last = falls.iter().rfind(|own| own.rising == Some(false))?.time;
        Some((last, window.1 - (window.1 - last) / (heights - 1.0)))
    };
    let release = |force_of: ForceOf| {
        let earlier = earlier.iter().find(|own| own.0 == force_of).map(|own| own.1);
        let time = match (earlier, descent(force_of)) {
            (Some(earlier), Some((last, _))) if earlier < last => earlier,
            (_, Some((_, time))) => time,
            (earlier, None) => earlier?,
        };
        Some((force_of, time))
    };
    finest.contacts_felt().filter_map(release).collect()
}

impl Solution<'_> {
    /// The same solution, whose impacts end at the given times.
    #[must_use]
    pub(crate) fn ending(self, ends: UndecidedReleases) -> Self {
        Self { ends, ..self }
    }

    /// An impact with the end that it has been given, or with what follows it in the ripples of segments.
    pub(super) fn ended(&self, impact: Impact, force: &Signal, force_of: ForceOf) -> Impact {
        match self.ends.iter().find(|(own, _)| *own == force_of) {
            Some(&(_, time)) => impact.ending(time),
            None => impact.beyond_ripples(force, self.passage(force_of), self.end()),
        }
    }

    /// The longest passage of a wave through a segment \[s\] of the layers that are struck there, themselves or through
    /// their contact.
    fn passage(&self, force_of: ForceOf) -> f64 {
        let assembly = self.assembly;
        let layered = assembly.connections.iter().enumerate().filter(|own| own.1.passage > 0.0);
        let is_there = |at: usize| match force_of {
            ForceOf::Element(element) => at == element,
            ForceOf::Body(body) => between(assembly, &assembly.connections[at]).contains(&body),
        };
        let struck = layered.filter(|&(at, _)| {
            let contact = assembly.pad(at).and_then(|pad| pad.contact);
            is_there(at) || contact.is_some_and(is_there)
        });
        struck.map(|own| own.1.passage).fold(0.0, f64::max)
    }

    /// How deep each contact force first pulls, in parts of its largest magnitude: those of the
    /// elements that touch an impactor and of the bodies with one. `None` where it never does.
    pub(crate) fn first_pulls(&self) -> Vec<Option<f64>> {
        let pull = |force_of: ForceOf| {
            let never_pulls = match force_of {
                ForceOf::Element(at) => self.assembly.connections[at].never_pulls,
                ForceOf::Body(body) => self.threshold_of_body(body) >= NO_PULL,
            };
            if never_pulls {
                return None;
            }
            first_pull(self.contact_force(force_of)?.as_ref(), self.end())
        };
        self.contacts_felt().map(pull).collect()
    }

    /// The contacts with impactors.
    fn contacts_felt(&self) -> impl Iterator<Item = ForceOf> {
        let elements = self.assembly.connections.iter().enumerate();
        let touching = elements.filter(|(_, own)| self.touches_impactor(own));
        let bodies = (0..self.has_impactor.len()).filter(|&body| self.has_impactor[body]);
        touching.map(|(at, _)| ForceOf::Element(at)).chain(bodies.map(ForceOf::Body))
    }

    fn contact_force(&self, force_of: ForceOf) -> Option<Cow<'_, Signal>> {
        match force_of {
            ForceOf::Element(at) => {
                self.assembly.connections[at].force.map(|force| Cow::Borrowed(self.signal(force)))
            }
            ForceOf::Body(body) => self.push_on(body).map(Cow::Owned),
        }
    }

    fn impact_felt(&self, force_of: ForceOf) -> Impact {
        match force_of {
            ForceOf::Element(at) => self.element_impact(at),
            ForceOf::Body(body) => self.body_impact(body),
        }
    }
}

#[cfg(test)]
mod tests;
