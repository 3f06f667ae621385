//! Which phases hold after an instant.

use dashpot_dae::{SolveError, Switch};

use super::{
    super::transfer::State,
    PhasedNetwork,
    impacts::{FOLLOWED, Impact, Meeting, Rebound},
    judge::{Admissibility, Choice, Fault, Judge, Verdict},
    search::Search,
};
use crate::phases::{Exit, Phase, Phases, Watched};

/// A way of judging who stays.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// By how much more than its scale rounding is thought to have grown.
    coarser: f64,
    /// What may part again at once after an impact.
    rebound: Rebound,
    /// Whether a way inwards counts that turns back before it can be told from the level.
    graze: bool,
}

/// The ways of judging, one after the other.
///
/// What rebounds by less than a method's doubt parts where it is known when it comes back; whatever
/// else would part by less than can be seen rests; only if nothing else holds may it part. Rounding
/// may have grown beyond its scale: then the next coarser judgement may tell.
fn ways() -> impl Iterator<Item = Way> {
    let all = Way { coarser: 1.0, rebound: Rebound::All, graze: false };
    let told = [1.0, 64.0, 4096.0].into_iter().flat_map(|coarser| {
        let order = [
            (Rebound::Fast, false),
            (Rebound::None, false),
            (Rebound::Fast, true),
            (Rebound::None, true),
        ];
        order.map(|(rebound, graze)| Way { coarser, rebound, graze })
    });
    std::iter::once(all).chain(told)
}

/// What an instant is like before anything changes.
struct Instant<'a> {
    /// When it is \[s\].
    time: f64,
    /// Whether it is a jump within which time stands still.
    is_jump: bool,
    /// The state, before impacts.
    before: State,
    /// The phases that end.
    phases: &'a [Phase],
    /// For each part the phases that may follow.
    options: Vec<Vec<Phase>>,
    /// For each part whether its deformation is at a level.
    touching: Vec<bool>,
    /// Levels that have been reached.
    on_level: Vec<(usize, Watched, f64)>,
    /// Parts whose deformation has reached a level \[m\] by the event that ended the interval.
    at_level: Vec<(usize, f64)>,
    /// Levels of suppressed events: reached by what stays in its phase nonetheless.
    suppressed: Vec<(usize, Watched, f64)>,
    /// Whether any phase is left.
    is_left: bool,
    threshold: f64,
    ways: Vec<Way>,
}

impl Instant<'_> {
    /// By what parts are judged before any way is taken.
    fn criteria(&self) -> Vec<Admissibility> {
        let criteria = |options: &Vec<Phase>| Admissibility {
            threshold: self.threshold,
            graze: false,
            may_change: options.len() > 1,
            is_smooth: true,
            rebound_speed: None,
        };
        self.options.iter().map(criteria).collect()
    }

    /// How phases are judged after impacts that have let `parted` part.
    fn judge<'a>(
        &'a self,
        state: &'a State,
        criteria: &'a [Admissibility],
        parted: &'a [(usize, [usize; 2])],
        size: (f64, f64),
    ) -> Judge<'a> {
        Judge {
            time: self.time,
            is_jump: self.is_jump,
            state,
            before: self.phases,
            on_level: &self.on_level,
            at_level: &self.at_level,
            suppressed: &self.suppressed,
            criteria,
            parted,
            size,
        }
    }
}

/// Numbers of the searches in whose groups a part does not stay.
fn at_fault(searches: &[Search], faults: &[Fault]) -> Vec<usize> {
    let fails =
        |&at: &usize| faults.iter().any(|fault| searches[at].group.parts.contains(&fault.part));
    (0..searches.len()).filter(fails).collect()
}

impl PhasedNetwork {
    /// The phases that hold after `time`, at which the exits `fired` were reached in `phases`; within a jump those that the
    /// jump leads to.
    ///
    /// Impacts come first. Then phases are looked for in which every part stays where it is, or
    /// begins to move away from its exits: judged by the first derivative of what each exit watches
    /// that is not zero. Parts that do not act on each other at this instant are looked for apart;
    /// each [group](super::groups::Group) has an order of its own in which it goes through its
    /// [combinations](Search::advance), and through the ways of judging. What is accepted is judged
    /// as a whole. Phases in which some parts stay only as far as can be told are taken where there are no others.
    pub(super) fn choose(
        &self,
        state: &mut State,
        (time, is_jump): (f64, bool),
        phases: &[Phase],
        fired: &[(usize, usize)],
        threshold: f64,
    ) -> Result<(Choice, Vec<Switch>), SolveError> {
        let instant = Instant { is_jump, ..self.instant(state, time, phases, fired, threshold) };
        let groups = self.groups(&instant.options).into_iter();
        let mut searches: Vec<Search> =
            groups.map(|group| Search::new(group, &instant.options)).collect();
        let mut criteria = instant.criteria();
        for search in &mut searches {
            self.collide(search, &instant, state, &mut criteria);
        }
        let (length, mut tried) = (self.own_length(state), phases.to_vec());
        let (mut refusal, mut spare) = (None, None);
        let mut count = 0;
        loop {
            count += 1;
            searches.iter().for_each(|search| search.enter(&mut tried));
            let verdict = self.verdict(&tried, state, &instant, (&searches, &criteria, length));
            let mut faults = Vec::new();
            let failing: Vec<usize> = match verdict {
                Verdict::Holds(choice, doubtful) => {
                    // Where all is in doubt anything holds: also what goes where there is no system.
                    let blind =
                        |own: &&Search| instant.ways[own.way].coarser * instant.threshold >= 1.0;
                    if let Some(own) = searches.iter().find(blind).filter(|_| refusal.is_some()) {
                        return Err(self.stuck(time, own, refusal));
                    }
                    let impacts: Vec<_> =
                        searches.iter().flat_map(|search| search.impacts.clone()).collect();
                    let switches = self.switches(time, phases, &choice.phases, &impacts);
                    if doubtful.is_empty() {
                        let judged = (&searches[..], &criteria[..], length);
                        let hangs_on_threshold = self.hangs(&tried, state, &instant, judged);
                        let choice = Choice { tried: count, hangs_on_threshold, ..*choice };
                        return Ok((choice, switches));
                    }
                    faults = doubtful;
                    spare.get_or_insert_with(|| (*choice, switches, state.clone()));
                    at_fault(&searches, &faults)
                }
                Verdict::Fails(found) => {
                    faults = found;
                    at_fault(&searches, &faults)
                }
                Verdict::Refused(reason) => {
                    refusal.get_or_insert(reason);
                    self.refused(&searches, phases)
                }
            };
            for at in failing {
                let search = &mut searches[at];
                if search.advance(&faults) {
                    continue;
                }
                if let Some((choice, switches, own)) = spare {
                    // What only seems to stay, because where it goes there is no system, would be met again and again.
                    if switches.is_empty() && instant.is_left && refusal.is_some() {
                        return Err(self.stuck(time, search, refusal));
                    }
                    state.clone_from(&own);
                    let hangs_on_threshold = true;
                    return Ok((Choice { tried: count, hangs_on_threshold, ..choice }, switches));
                }
                search.way += 1;
                if search.way == instant.ways.len() {
                    return Err(self.stuck(time, search, refusal));
                }
                search.restart();
                self.collide(search, &instant, state, &mut criteria);
            }
        }
    }

    /// What is known of the instant at which the exits `fired` were reached.
    fn instant<'a>(
        &self,
        state: &State,
        time: f64,
        phases: &'a [Phase],
        fired: &[(usize, usize)],
        threshold: f64,
    ) -> Instant<'a> {
        let suppressed = self.suppressed(state, time, phases, fired, threshold);
        let left: Vec<(usize, usize)> =
            fired.iter().copied().filter(|exit| !suppressed.contains(exit)).collect();
        let touching = self.touching(state, phases, &left);
        let options = (0..self.parts.len())
            .map(|part| self.options(part, (state, time), phases[part], &left, touching[part]))
            .collect();
        let exits_of = |all: &[(usize, usize)]| -> Vec<(usize, Exit)> {
            let exit = |&(part, exit): &(usize, usize)| {
                let own = self.phases_of(self.parts[part])?;
                Some((part, *own.exits(phases[part]).get(exit)?))
            };
            all.iter().filter_map(exit).collect()
        };
        let levels_of = |all: &[(usize, Exit)]| -> Vec<(usize, Watched, f64)> {
            all.iter().map(|(part, exit)| (*part, exit.watched, exit.level)).collect()
        };
        let reached = exits_of(fired);
        let deformations = reached.iter().filter(|own| own.1.watched == Watched::Deformation);
        Instant {
            time,
            is_jump: false,
            before: state.clone(),
            phases,
            options,
            touching,
            on_level: levels_of(&reached),
            at_level: deformations.map(|(part, exit)| (*part, exit.level)).collect(),
            suppressed: levels_of(&exits_of(&suppressed)),
            is_left: !left.is_empty(),
            threshold,
            ways: ways().collect(),
        }
    }

    /// Whether the phases that are tried hold, after the impacts of all groups.
    fn verdict(
        &self,
        tried: &[Phase],
        state: &State,
        instant: &Instant<'_>,
        (searches, criteria, length): (&[Search], &[Admissibility], f64),
    ) -> Verdict {
        let impacts = searches.iter().flat_map(|search| &search.impacts);
        let parted = impacts.filter(|impact| impact.rebound_speed.is_some());
        let parted: Vec<_> = parted.map(|impact| (impact.part, impact.sides)).collect();
        let size = (length, self.own_speed(state));
        self.judge(tried, &instant.judge(state, criteria, &parted, size))
    }

    /// Whether phases hold only because what moves is held to rest: by an impact whose rebound is below the threshold, or by a
    /// part whose rate is.
    fn hangs(
        &self,
        phases: &[Phase],
        state: &State,
        instant: &Instant<'_>,
        (searches, criteria, length): (&[Search], &[Admissibility], f64),
    ) -> bool {
        let threshold = FOLLOWED * instant.threshold;
        let speed = self.own_speed(&instant.before);
        let rests = |impact: &Impact| {
            let [a, b] = impact.sides.map(|side| self.velocity(&instant.before, side));
            let own = self.phases_of(self.parts[impact.part]);
            let restitution = own.map_or(0.0, Phases::restitution);
            impact.rebound_speed.is_none() && restitution * (a - b) > threshold * speed
        };
        let sharper = |own: &Admissibility| Admissibility { threshold, ..*own };
        let sharper: Vec<Admissibility> = criteria.iter().map(sharper).collect();
        let judge = instant.judge(state, &sharper, &[], (length, speed));
        searches.iter().flat_map(|search| &search.impacts).any(rests)
            || !self.held_apart(phases, &judge).is_empty()
    }

    /// Applies the impacts of a group, and sets the criteria of its parts.
    fn collide(
        &self,
        search: &mut Search,
        instant: &Instant<'_>,
        state: &mut State,
        criteria: &mut [Admissibility],
    ) {
        let Way { coarser, rebound, graze } = instant.ways[search.way];
        let threshold = coarser * instant.threshold;
        for &body in &search.group.bodies {
            for &joint in &self.apart.all[body].joints {
                state.velocity[joint] = instant.before.velocity[joint];
            }
        }
        let meeting = Meeting {
            group: &search.group,
            phases: instant.phases,
            touching: &instant.touching,
            at_level: &instant.at_level,
            threshold,
            rebound,
        };
        search.impacts = self.impacts(state, &meeting);
        let is_smooth = search.impacts.is_empty();
        for &part in &search.group.parts {
            criteria[part] = Admissibility {
                threshold,
                graze,
                is_smooth,
                rebound_speed: None,
                ..criteria[part]
            };
        }
        for impact in &search.impacts {
            criteria[impact.part].rebound_speed = impact.rebound_speed;
        }
    }

    /// The groups for whose phases there is no system, whatever the others do: all of them if it is none alone.
    fn refused(&self, searches: &[Search], phases: &[Phase]) -> Vec<usize> {
        let alone = |&at: &usize| {
            let mut tried = phases.to_vec();
            searches[at].enter(&mut tried);
            searches.len() == 1 || self.mode(&tried).is_err()
        };
        let found: Vec<usize> = (0..searches.len()).filter(alone).collect();
        if found.is_empty() { (0..searches.len()).collect() } else { found }
    }

    fn stuck(&self, time: f64, search: &Search, refusal: Option<String>) -> SolveError {
        let names: Vec<String> = search
            .open_parts()
            .map(|part| format!("`{}`", self.expansion.primitives[self.parts[part]].name))
            .collect();
        let names =
            if names.is_empty() { "the parts that switch".to_owned() } else { names.join(", ") };
        let mut sides = search.open_parts().flat_map(|part| self.sides(self.parts[part]));
        let what = if refusal.is_some() && sides.any(|side| self.apart.all[side].is_massless()) {
            "what has no mass needs a dashpot beside a part that lets go of it, or a mass"
        } else {
            "where events meet at one instant, another method or tolerance, or a gap that is a little different, \
             parts them"
        };
        let why = refusal.map_or(String::new(), |reason| format!("; {reason}"));
        let reason = format!(
            "no state of {names}, held, sliding or apart, agrees with the forces{why}; {what}"
        );
        SolveError::Switching { time, reason }
    }

    /// The phases that a part may be in after the instant, the natural one first.
    fn options(
        &self,
        part: usize,
        (state, time): (&State, f64),
        phase: Phase,
        fired: &[(usize, usize)],
        touching: bool,
    ) -> Vec<Phase> {
        let at = self.parts[part];
        let Some(own) = self.phases_of(at) else { return vec![phase] };
        let deformation = state.deformation[at];
        let next = |from: Phase, exit: &Exit| Phase {
            index: exit.to,
            memory: if exit.remembers { deformation } else { from.memory },
        };
        let mut options = Vec::new();
        let mut add = |phase: Phase| {
            let is_new = options.iter().all(|option: &Phase| option.index != phase.index);
            if is_new {
                options.push(phase);
            }
        };
        let exits = own.exits(phase);
        for (number, exit) in exits.iter().enumerate() {
            if fired.contains(&(part, number)) {
                add(next(phase, exit));
            }
        }
        add(phase);
        // A phase that was left may lead on at once, and one that was not may end with the others. What has no mass may jump.
        let jumps = self.jumps.contains(&time);
        let in_reach = |exit: &Exit| exit.watched != Watched::Deformation || touching || jumps;
        let mut at = 0;
        let mut reached: Vec<Phase> =
            exits.iter().filter(|exit| in_reach(exit)).map(|exit| next(phase, exit)).collect();
        while at < reached.len() && at < own.names().len() {
            let from = reached[at];
            add(from);
            for exit in own.exits(from) {
                let follows = next(from, &exit);
                let level = jumps || (deformation - exit.level).abs() <= 1e-9 * exit.level.abs();
                if (exit.watched != Watched::Deformation || level)
                    && reached.iter().all(|own| own.index != follows.index)
                {
                    reached.push(follows);
                }
            }
            at += 1;
        }
        options
    }

    /// A speed of the network's own \[m/s\]: the largest that it begins with, or has.
    pub(super) fn own_speed(&self, state: &State) -> f64 {
        let starts = self
            .network
            .nodes
            .iter()
            .map(|node| crate::network::start_velocity(&self.network, node.start).abs());
        let now = state.velocity.iter().map(|own| own.abs());
        starts.chain(now).filter(|start| start.is_finite()).fold(0.0, f64::max)
    }

    /// A length of the network's own \[m\]: the farthest place of a joint, or that a motion leads to.
    pub(super) fn own_length(&self, state: &State) -> f64 {
        let motions = self.network.nodes.iter().filter_map(|node| match &node.support {
            crate::Support::Prescribed(motion) => Some(motion.bound(self.duration)),
            _ => None,
        });
        let places = state.position.iter().map(|own| own.abs());
        motions.chain(places).filter(|motion| motion.is_finite()).fold(0.0, f64::max)
    }

    fn switches(
        &self,
        time: f64,
        before: &[Phase],
        after: &[Phase],
        impacts: &[Impact],
    ) -> Vec<Switch> {
        let name = |part: usize| self.expansion.primitives[self.parts[part]].name.to_string();
        let mut switches = Vec::new();
        for (part, (old, new)) in before.iter().zip(after).enumerate() {
            let impact = impacts.iter().find(|impact| impact.part == part);
            if old.index == new.index && impact.is_none() {
                continue;
            }
            let words = self.phases_of(self.parts[part]).map_or(&[][..], |own| own.names());
            let is_same = old.index == new.index;
            switches.push(Switch {
                time,
                part,
                name: name(part),
                phase: new.index,
                what: if is_same { "impact" } else { words.get(new.index).copied().unwrap_or("") },
                memory: new.memory,
                impulse: impact.map_or(0.0, |impact| impact.impulse),
                lost: impact.map_or(0.0, |impact| impact.lost),
                worked: impact.map_or(0.0, |impact| impact.worked),
            });
        }
        switches
    }
}
