//! The time span of an impact.

use dashpot_dae::{Crossing, Panel, Signal};
use dashpot_network::parameters::WindowWish;

use crate::{Note, impact::impulses::VelocityJump};

/// How the contact of an impact ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// The contact force falls to zero and would turn to tension.
    Released,
    /// The contact opens: its force falls to zero and stays there, or the impulse with which masses
    /// meet parts them again at once.
    Parted,
    /// The contact force pushes until the run ends.
    Lasting,
    /// The contact force pulls from the start, so there is no impact.
    Pulling,
    /// There is never a contact force.
    Unloaded,
    /// The scene has no impactor.
    NoImpactor,
}

/// The time from first contact to the first zero of the contact force after it has been more than slight: the part 0.01 of the
/// most that it pushes with in the run.
///
/// Masses that meet and part at once have an impact of no length. A force that is zero at the start and then pushes (a Maxwell element's) has its first zero
/// later; a force that decays towards zero from above has none. A touch that stays below a thousandth
/// of the largest force of the run, and after which the force rests on zero again, is none.
///
/// A padding whose face has mass and can part is struck through its face: its impact begins with the first impulse or
/// push on the face, and ends when what struck it has left it for good or the padding is unloaded. Bounces of the face
/// on what strikes it belong to it as long as the padding stays pressed between them: its force does not fall to what
/// it bore before, or to a hundredth of the most that it has borne since.
///
/// Layers with mass that are struck directly let go of a body for moments in the ripples of their segments: those belong to
/// the impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// When it begins \[s\].
    pub start: f64,
    /// When it ends \[s\]: at release, or with the run.
    pub end: f64,
    /// Bound of the error of `end` \[s\], where the method states one.
    pub end_error: Option<f64>,
    /// How it ends.
    pub contact: Contact,
}

impl Impact {
    /// The impact of a contact force that exists from the start of a run of `run_end` \[s\].
    ///
    /// The force pulls where it goes below zero by more than its noise and the part `threshold` of its
    /// largest magnitude; the release is where it passes zero on the way there. With a doubt of
    /// [`NO_PULL`] it never does.
    pub(crate) fn of_force(force: &Signal, run_end: f64, threshold: f64) -> Self {
        let run =
            Self { start: 0.0, end: run_end, end_error: Some(0.0), contact: Contact::Lasting };
        match begins(force, threshold) {
            None => Self { contact: Contact::Unloaded, ..run },
            Some(false) => Self { end: 0.0, contact: Contact::Pulling, ..run },
            Some(true) => Self::of_push(
                force,
                Self { start: first_load(force).unwrap_or(0.0), ..run },
                threshold,
            ),
        }
    }

    /// The impact of a contact force with the impulses that act beside it.
    pub(crate) fn of_contact(
        force: &Signal,
        jumps: &[VelocityJump],
        run_end: f64,
        threshold: f64,
    ) -> Self {
        let Some(first) = first_felt(jumps, force).filter(|jump| Self::begins_with(jump, force))
        else {
            return Self::of_force(force, run_end, threshold);
        };
        let run = Self {
            start: first.time,
            end: run_end,
            end_error: Some(0.0),
            contact: Contact::Lasting,
        };
        let stays = pushes(force).iter().any(|push| push.holds(first.time));
        if stays && force.departure(0.0, first.time) == Some(true) {
            return Self::of_push(force, run, threshold);
        }
        let end_error = force.error.map(|_| 4.0 * f64::EPSILON * first.time);
        Self { end: first.time, end_error, contact: Contact::Parted, ..run }
    }

    /// Whether nothing acts before the jump.
    pub(crate) fn begins_with(jump: &VelocityJump, force: &Signal) -> bool {
        first_load(force).is_none_or(|loaded| jump.time <= loaded)
    }

    /// The impact of a force that pushes first.
    pub(crate) fn of_push(force: &Signal, run: Self, threshold: f64) -> Self {
        let run_end = run.end;
        let parted = rest_after(force, run.start);
        let released = release(force, (pushed(force, run.start, threshold), run_end), threshold)
            .filter(|release| parted.is_none_or(|parted| release.time < parted));
        match (parted, released) {
            (Some(parted), None) => {
                let slope = force.panels
                    [..force.panels.partition_point(|panel| panel.end <= parted)]
                    .last()
                    .map_or(0.0, |panel| panel.slope(parted).abs());
                // A force that ends with a jump is ended by something else, found to rounding.
                let jumps = force.left_value(parted).abs() > 1e-6 * force.bound();
                let rate = if jumps { f64::INFINITY } else { slope };
                let shift = |error: f64| if slope > 0.0 { error / rate } else { 0.0 };
                let rounding = 4.0 * f64::EPSILON * parted;
                let end_error = force.error.map(|error| shift(error).min(run_end) + rounding);
                Self { end: parted, end_error, contact: Contact::Parted, ..run }
            }
            (_, released) => match released {
                None if ends_at_zero(force, run_end, threshold) => {
                    Self { end_error: force.error.map(|_| 0.0), contact: Contact::Released, ..run }
                }
                None => run,
                Some(release) => {
                    let rounding = 4.0 * f64::EPSILON * release.time;
                    let (before, after) =
                        (force.left_value(release.time), force.value(release.time));
                    // Where the force jumps, a switch rules the time, which is found to rounding.
                    let jumps = (after - before).abs() > force.noise.max(0.5 * before.abs());
                    let rate = if jumps { f64::INFINITY } else { release.slope.abs() };
                    let shift = |error: f64| (error / rate).min(run_end) + rounding;
                    let end_error = force.error.map(shift);
                    Self { end: release.time, end_error, contact: Contact::Released, ..run }
                }
            },
        }
    }

    /// The impact with the pushes that follow its end so soon that segments of layers do not tell them apart, where
    /// a wave crosses one of them in `passage` \[s\].
    ///
    /// A front is spread over the time [`front`] by then, and the force swings about its true course for as long: a
    /// chain of segments lets go of what strikes it in the swing, and meets it again.
    pub(crate) fn beyond_ripples(self, force: &Signal, passage: f64, run_end: f64) -> Self {
        let mut impact = self;
        let most = if passage > 0.0 { MOST_RIPPLES } else { 0 };
        for _ in 0..most {
            if !impact.has_ended() {
                break;
            }
            let again = if impact.contact == Contact::Parted {
                let next = pushes(force).into_iter().find(|own| own.start >= impact.end);
                next.map(|own| own.start)
            } else {
                let rise = force.first_crossing(0.0, (impact.end, run_end), Some(true));
                rise.map(|own| own.time)
            };
            let until = impact.end + front(passage, impact.end - impact.start);
            let Some(start) = again.filter(|again| *again <= until) else { break };
            impact =
                Self { start: impact.start, ..Self::again(force, start, run_end, impact.contact) };
        }
        impact
    }

    /// The push that begins at `start` \[s\] and ends as this contact does.
    fn again(force: &Signal, start: f64, run_end: f64, contact: Contact) -> Self {
        let run = Self { start, end: run_end, end_error: Some(0.0), contact: Contact::Lasting };
        if contact == Contact::Parted {
            return Self::of_push(force, run, NO_PULL);
        }
        let Some(fall) = force.first_crossing(0.0, (start, run_end), Some(false)) else {
            return run;
        };
        let rounding = 4.0 * f64::EPSILON * fall.time;
        let shift = |error: f64| (error / fall.slope.abs()).min(run_end) + rounding;
        Self { end: fall.time, end_error: force.error.map(shift), contact, ..run }
    }

    /// Whether it takes place and ends before the run does, or with it.
    pub fn has_ended(self) -> bool {
        matches!(self.contact, Contact::Released | Contact::Parted)
    }

    /// The span over which its force pushes \[s\]; `None` where it has no length.
    pub(crate) fn pushing(self) -> Option<(f64, f64)> {
        (self.takes_place() && self.end > self.start).then_some((self.start, self.end))
    }

    /// The same impact if it ends by release at `time` \[s\].
    pub(crate) fn ending(self, time: f64) -> Self {
        Self { end: time, end_error: None, contact: Contact::Released, ..self }
    }

    /// The impact of a node that nothing touches.
    pub(crate) fn unloaded(run_end: f64) -> Self {
        Self { start: 0.0, end: run_end, end_error: Some(0.0), contact: Contact::Unloaded }
    }

    /// The run of a scene without an impactor.
    pub(crate) fn without_impactor(run_end: f64) -> Self {
        Self { contact: Contact::NoImpactor, ..Self::unloaded(run_end) }
    }

    /// The span from the first contact of either to the last end of either; an impact that does
    /// not take place adds nothing.
    pub(crate) fn joined(self, other: Self) -> Self {
        if !self.takes_place() {
            return other;
        }
        if !other.takes_place() {
            return self;
        }
        let later = if other.end > self.end { other } else { self };
        Self { start: self.start.min(other.start), ..later }
    }

    fn takes_place(self) -> bool {
        self.has_ended() || self.contact == Contact::Lasting
    }

    /// The part of a run of `run_end` \[s\] that a measure with the given wish looks at.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn span(self, wish: WindowWish, run_end: f64) -> Result<Span, Note> {
        let fixed = |from, to, note| Ok(Span { from, to, to_error: Some(0.0), note });
        match wish {
            WindowWish::Run => fixed(0.0, run_end, None),
            WindowWish::Times(from, to) => {
                if from > run_end || to < 0.0 {
                    return Err(Note::OutsideTheRun);
                }
                let note = (to > run_end).then_some(Note::RunEndsBefore);
                fixed(from.max(0.0), to.min(run_end), note)
            }
            WindowWish::Impact => match self.contact {
                Contact::Released | Contact::Parted => Ok(Span {
                    from: self.start,
                    to: self.end,
                    to_error: self.end_error,
                    note: None,
                }),
                Contact::Lasting => fixed(self.start, self.end, Some(Note::StillInContact)),
                Contact::NoImpactor => fixed(0.0, run_end, None),
                Contact::Pulling => Err(Note::PullsFromTheStart),
                Contact::Unloaded => Err(Note::NeverLoaded),
            },
        }
    }
}

/// So many pushes are joined at most.
const MOST_RIPPLES: usize = 1000;

/// The time \[s\] over which a chain of segments, each of which a wave crosses in `passage` \[s\], spreads a front
/// that has travelled for `time` \[s\]: `Δt^⅔ t^⅓`.
pub(crate) fn front(passage: f64, time: f64) -> f64 {
    (passage * passage * time).cbrt()
}

/// Part of its largest push that a force may pull with before, as a pad does that was left unloaded
/// between parts that sag.
pub(crate) const SLIGHT: f64 = 1e-2;

/// A push that stays below this part of the largest is none, where the force rests before and after.
const NEXT_TO_NOTHING: f64 = 1e-3;

/// Part of the largest impulse below which an impulse is rounding.
const SMALLEST_JUMP: f64 = 1e-9;

/// The doubt of a force that by its law never pulls: no fall below zero counts.
pub(crate) const NO_PULL: f64 = 1.0;

/// The sign, `true` for positive, with which a force first reaches a share of its largest magnitude that is not slight.
pub(crate) fn first_way(force: &Signal) -> Option<bool> {
    let floor = (SLIGHT * force.bound()).max(force.noise);
    first_beyond(force, floor)
}

/// The sign, `true` for positive, with which a force first leaves what is within `floor` of zero.
fn first_beyond(force: &Signal, floor: f64) -> Option<bool> {
    let first = force.value(0.0);
    if first.abs() > floor {
        return Some(first > 0.0);
    }
    let window = (0.0, force.end());
    let up = force.first_crossing(floor, window, Some(true)).map(|own| own.time);
    let down = force.first_crossing(-floor, window, Some(false)).map(|own| own.time);
    match (up, down) {
        (Some(up), Some(down)) => Some(up < down),
        (Some(_), None) => Some(true),
        (None, Some(_)) => Some(false),
        (None, None) => force.departure(0.0, 0.0),
    }
}

/// Which way a contact force first goes, `true` if it pushes; a pull that is slight beside the push that
/// follows does not count.
fn begins(force: &Signal, threshold: f64) -> Option<bool> {
    let most = force.maximum((0.0, force.end())).value;
    if threshold >= NO_PULL {
        return (most > force.noise).then_some(true);
    }
    let floor = (SLIGHT.max(threshold) * most).max(force.noise);
    if most <= force.noise {
        return force.departure(0.0, 0.0);
    }
    first_beyond(force, floor)
}

/// A time over which a force acts without rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Push {
    /// When it begins \[s\].
    pub(crate) start: f64,
    /// When the force comes to rest on zero \[s\], as it does where a contact opens; `None` if it acts
    /// until the run ends.
    pub(crate) end: Option<f64>,
}

impl Push {
    /// Whether it has begun at `time` and not ended yet.
    pub(crate) fn holds(&self, time: f64) -> bool {
        self.start <= time && self.end.is_none_or(|end| time < end)
    }
}

/// The pushes of a force in order of time, without those that are next to nothing beside its largest
/// magnitude: a touch that rounding makes is none. What rests while all moves together is off from zero by rounding: where
/// the error of the force is bounded, no push begins within its noise.
pub(crate) fn pushes(force: &Signal) -> Vec<Push> {
    let floor = (NEXT_TO_NOTHING * force.bound()).max(force.noise);
    let mut found = Vec::new();
    let mut open: Option<(f64, f64)> = None;
    for panel in &force.panels {
        if !rests(panel) {
            let size: f64 = panel.coefficients.iter().map(|coefficient| coefficient.abs()).sum();
            if open.is_none() && force.error.is_some() && size <= force.noise {
                continue;
            }
            let (start, most) = open.unwrap_or((panel.start, 0.0));
            open = Some((start, most.max(size)));
        } else if panel.length() > 0.0
            && let Some((start, most)) = open.take()
            && most > floor
        {
            found.push(Push { start, end: Some(panel.start) });
        }
    }
    if let Some((start, _)) = open.filter(|open| open.1 > floor) {
        found.push(Push { start, end: None });
    }
    found
}

/// The first impulse of those that act beside a force which is not next to nothing.
pub(crate) fn first_felt<'b>(
    jumps: &'b [VelocityJump],
    force: &Signal,
) -> Option<&'b VelocityJump> {
    let most = jumps.iter().map(|jump| jump.impulse.abs()).reduce(f64::max)?;
    let size = most.max(force.integral((0.0, force.end())).abs());
    jumps.iter().find(|jump| jump.impulse.abs() > SMALLEST_JUMP * size)
}

/// When a force that is zero at first begins to act \[s\].
fn first_load(force: &Signal) -> Option<f64> {
    pushes(force).first().map(|push| push.start)
}

/// When the force comes to rest on zero after `start` \[s\], as it does where a contact opens.
fn rest_after(force: &Signal, start: f64) -> Option<f64> {
    pushes(force).iter().find(|push| push.end.is_none_or(|end| end > start))?.end
}

/// Whether the force is zero all over a panel, as it is by structure where a contact is open; a force
/// that decays is not.
fn rests(panel: &Panel) -> bool {
    panel.coefficients.iter().all(|coefficient| *coefficient == 0.0)
}

/// From when on a force that pushes first may have been released: before it has been more than slight, passages of zero
/// are those of a rest, or of a pull that does not count either.
fn pushed(force: &Signal, start: f64, threshold: f64) -> f64 {
    let window = (start, force.end());
    let floor = (SLIGHT * force.maximum(window).value).max(force.noise);
    if threshold >= NO_PULL || force.value(start) > floor {
        return start;
    }
    force.first_crossing(floor, window, Some(true)).map_or(start, |own| own.time)
}

/// The last passage of zero before the force pulls for the first time in a window.
fn release(force: &Signal, window: (f64, f64), threshold: f64) -> Option<Crossing> {
    let floor = if threshold > 0.0 { threshold * force.bound() } else { 0.0 };
    if floor <= force.noise {
        return force.first_crossing(0.0, window, Some(false));
    }
    let pull = force.first_crossing(-floor, window, Some(false))?;
    let latest = pull.time * (1.0 + 4.0 * f64::EPSILON);
    let passages = force.crossings(0.0, window).into_iter();
    let falls = passages.take_while(|passage| passage.time <= latest);
    Some(falls.filter(|passage| passage.rising == Some(false)).last().unwrap_or(pull))
}

/// How deep a force that pushes at first goes below zero before it comes back, in parts of its
/// largest magnitude; `None` if it does not.
pub(crate) fn first_pull(force: &Signal, run_end: f64) -> Option<f64> {
    if force.departure(0.0, 0.0) != Some(true) {
        return None;
    }
    let fall = force.first_crossing(0.0, (0.0, run_end), Some(false))?.time;
    let rise = force.first_crossing(0.0, (fall, run_end), Some(true));
    let until = rise.map_or(run_end, |rise| rise.time);
    let deepest = -force.minimum((fall, until)).value;
    (deepest > 0.0).then(|| deepest / force.bound())
}

/// Whether the force is about to pass zero where the run ends, as it is when the run stops there; a
/// force that decays towards zero would take longer.
fn ends_at_zero(force: &Signal, run_end: f64, threshold: f64) -> bool {
    const SOON: f64 = 1e-9;
    let slope = force.slope(run_end);
    let falls = slope < 0.0 && -slope * run_end > threshold.min(SLIGHT) * force.bound();
    falls && force.left_value(run_end).abs() <= SOON * run_end * slope.abs()
}

/// The part of a run that a measure looks at.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Its begin \[s\].
    pub from: f64,
    /// Its end \[s\].
    pub to: f64,
    /// Bound of the error of the end \[s\], where the method states one.
    pub to_error: Option<f64>,
    /// What is to be said about it.
    pub note: Option<Note>,
}

impl Span {
    /// Both ends.
    pub fn window(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// How long it is \[s\].
    pub fn length(&self) -> f64 {
        self.to - self.from
    }
}

#[cfg(test)]
mod tests;
