//! The answer of a linear model, and of laws of the deformation alone beside it, to a history of straight lines, in closed
//! form from corner to corner.

use dashpot_network::{Element, Model, elements::Law, first_nonlinear};
use dashpot_numerics::roots::{TO_THE_LAST_BIT, bisect};

use super::{
    Specimen,
    history::{Drive, History, Instant, Line, weights},
};

/// Parts of the time of a branch at which the slope of the answer is looked at for a peak between corners.
const LOOKS: [f64; 4] = [0.1, 0.4, 1.0, 3.0];
/// Parts of a line at which it is looked at where laws that are not linear stand beside.
const PARTS: [f64; 7] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];

/// One that relaxes, or creeps, by itself: at a rate \[1/s\], and how much it weighs.
#[derive(Debug, Clone, Copy)]
struct Branch {
    rate: f64,
    /// Stiffness \[N/m\] under a deformation, compliance \[m/N\] under a force.
    strength: f64,
}

/// The answer, by what each branch holds at the corners of the history.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    drive: Drive,
    /// What answers at once: spring \[N/m\], or spring compliance \[m/N\].
    spring: f64,
    /// Dashpot beside all else \[N s/m\], or fluidity of one in series \[m/(N s)\].
    dashpot: f64,
    branches: Vec<Branch>,
    /// Laws of the deformation alone, beside all else.
    laws: Option<Model>,
    parts: Vec<Line>,
    /// What the branches hold as each line begins, and what has flowed until then, line by line.
    held: Vec<f64>,
}

impl Lines {
    /// `None` of models that are neither linear nor that beside laws of the deformation, under a force of all but linear ones, of
    /// those that have no such form, of a jump that a dashpot alone meets, and of a history that does not go on.
    pub(super) fn of(model: &Model, drive: Drive, history: &History) -> Option<Self> {
        let (mut linear, mut laws) = (Vec::new(), Vec::new());
        if !divide(model, (&mut linear, &mut laws)) {
            return None;
        }
        let laws = if laws.is_empty() { None } else { Some(Model::parallel(laws)) };
        if laws.is_some() && matches!(drive, Drive::Force) {
            return None;
        }
        let whole = Model::parallel(linear.iter().cloned());
        let specimen = || Specimen::new(&whole).ok().filter(|own| own.linear().is_some());
        let (spring, dashpot, branches) = match drive {
            Drive::Deformation if linear.is_empty() => (0.0, 0.0, Vec::new()),
            Drive::Deformation => {
                let specimen = specimen()?;
                let form = specimen.maxwell()?;
                let all = form.elements().into_iter();
                let all = all.map(|own| Branch { rate: own.rate.high(), strength: own.stiffness });
                (form.spring(), form.dashpot(), all.collect())
            }
            Drive::Force => {
                let specimen = specimen()?;
                let form = specimen.kelvin()?;
                let all = form.elements().into_iter();
                let all = all.map(|own| Branch { rate: own.rate.high(), strength: own.compliance });
                (form.spring_compliance(), form.fluidity(), all.collect::<Vec<_>>())
            }
        };
        let corners = history.corners();
        let lines: Vec<Line> = history.lines_until(Instant::after(history.end())).collect();
        let jump = corners.first().map_or(0.0, |own| own.after - own.before);
        let is_met = matches!(drive, Drive::Force) || dashpot <= 0.0 || jump.abs() <= 0.0;
        if lines.is_empty() || lines.len() + 1 < corners.len() || !is_met {
            return None;
        }
        let (parts, held) = (lines, Vec::new());
        let mut own = Self { drive, spring, dashpot, branches, laws, parts, held };
        own.carry(jump);
        Some(own)
    }

    /// Carries what is held from line to line.
    fn carry(&mut self, jump: f64) {
        let width = self.branches.len() + 1;
        let mut held = Vec::with_capacity(width * self.parts.len());
        match self.drive {
            Drive::Deformation => {
                held.extend(self.branches.iter().map(|own| own.strength * jump));
            }
            Drive::Force => held.resize(width - 1, 0.0),
        }
        held.push(0.0);
        for at in 1..self.parts.len() {
            let line = self.parts[at - 1];
            let before = &held[(at - 1) * width..];
            let next: Vec<f64> = self.grown(before, line, line.length).collect();
            held.extend(next);
        }
        self.held = held;
    }

    /// What the branches hold so long after a line begins, and what has flowed then.
    fn grown<'g>(
        &'g self,
        held: &'g [f64],
        line: Line,
        since: f64,
    ) -> impl Iterator<Item = f64> + 'g {
        let to = line.from + line.slope * since;
        let branch = move |(own, held): (&Branch, &f64)| {
            let x = own.rate * since;
            let left = held * (-x).exp();
            match self.drive {
                Drive::Deformation => left - own.strength / own.rate * line.slope * (-x).exp_m1(),
                Drive::Force => {
                    let [first, last] = weights(x);
                    left + own.strength * (line.from * first + to * last)
                }
            }
        };
        let flowed = held.get(self.branches.len()).copied().unwrap_or(0.0);
        let flowed = match self.drive {
            Drive::Deformation => 0.0,
            Drive::Force => flowed + self.dashpot * 0.5 * since * (line.from + to),
        };
        self.branches.iter().zip(held).map(branch).chain([flowed])
    }

    /// The line that goes on at a time \[s\], what is held as it begins, and how long it has lasted.
    fn place(&self, time: f64) -> Option<(Line, &[f64], f64)> {
        let at = self.parts.partition_point(|own| own.start <= time).saturating_sub(1);
        let line = *self.parts.get(at)?;
        let held = self.held.get(at * (self.branches.len() + 1)..)?;
        Some((line, held, (time - line.start).clamp(0.0, line.length)))
    }

    /// The answer at a time from 0 to the end of the history \[s\]; at a corner that of what follows.
    pub(super) fn value(&self, time: f64) -> f64 {
        let Some((line, held, since)) = self.place(time) else { return 0.0 };
        self.answer(held, line, since)
    }

    fn answer(&self, held: &[f64], line: Line, since: f64) -> f64 {
        let of_branches: f64 = self.grown(held, line, since).sum();
        let at_once = self.spring * (line.from + line.slope * since);
        let by_rate = match self.drive {
            Drive::Deformation if self.dashpot > 0.0 => self.dashpot * line.slope,
            _ => 0.0,
        };
        let laws = self.laws.iter().flat_map(Model::leaves);
        let of_laws: f64 = laws.map(|own| own.force(line.from + line.slope * since, 0.0)).sum();
        at_once + by_rate + of_branches + of_laws
    }

    /// How fast the answer changes so long after a line begins.
    fn slope(&self, held: &[f64], line: Line, since: f64) -> f64 {
        let value = line.from + line.slope * since;
        let branch = |(own, held): (&Branch, f64)| match self.drive {
            Drive::Deformation => own.strength * line.slope - own.rate * held,
            Drive::Force => own.rate * (own.strength * value - held),
        };
        let held = self.grown(held, line, since);
        let of_branches: f64 = self.branches.iter().zip(held).map(branch).sum();
        let flow = match self.drive {
            Drive::Deformation => 0.0,
            Drive::Force => self.dashpot * value,
        };
        let laws = self.laws.iter().flat_map(Model::leaves);
        let stiffness: f64 = laws.map(|own| own.tangent(value, 0.0).stiffness).sum();
        (self.spring + stiffness) * line.slope + flow + of_branches
    }

    /// Time \[s\] and value of the largest magnitude, at corners and where the slope is zero between them.
    pub(super) fn peak(&self) -> (f64, f64) {
        let width = self.branches.len() + 1;
        let mut best = (0.0, 0.0);
        for (line, held) in self.parts.iter().zip(self.held.chunks(width)) {
            let mut looks: Vec<f64> =
                self.branches.iter().flat_map(|own| LOOKS.map(|part| part / own.rate)).collect();
            let inside = PARTS.map(|part| part * line.length);
            looks.extend(inside.into_iter().filter(|_| self.laws.is_some()));
            looks.retain(|own| *own < line.length);
            looks.extend([0.0, line.length]);
            looks.sort_by(f64::total_cmp);
            let slope = |since: f64| self.slope(held, *line, since);
            let turn = |pair: &[f64]| {
                let first = slope(pair[0]);
                (first * slope(pair[1]) < 0.0).then(|| {
                    bisect(pair[0], pair[1], TO_THE_LAST_BIT, |at| slope(at) * first < 0.0).0
                })
            };
            let turns: Vec<f64> = looks.windows(2).filter_map(turn).collect();
            for since in turns.into_iter().chain([0.0, line.length]) {
                let value = self.answer(held, *line, since);
                if value.abs() > f64::abs(best.1) {
                    best = (line.start + since, value);
                }
            }
        }
        best
    }
}

/// Divides what stands in parallel into linear models and laws of the deformation alone; whether that is all there is.
fn divide(model: &Model, (linear, laws): (&mut Vec<Model>, &mut Vec<Model>)) -> bool {
    let is_law =
        |own: &dyn Element| matches!(own.law(), Law::Nonlinear { damping, .. } if damping <= 0.0);
    match model {
        Model::Parallel(branches) => {
            branches.iter().all(|own| divide(&own.tree, (&mut *linear, &mut *laws)))
        }
        own if first_nonlinear(own).is_none() => {
            linear.push(own.clone());
            true
        }
        Model::Part(own) if is_law(own.as_ref()) => {
            laws.push(model.clone());
            true
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::{
        elements::{Dashpot, Spring},
        part,
    };
    use dashpot_numerics::Stream;

    use super::*;
    use crate::rheometer::history::{deformation, force};

    /// A spring beside Maxwell elements, in series with a dashpot or not, under lines with and without a first jump.
    #[test]
    fn it_is_the_sum_over_all_lines_at_every_time() {
        let mut stream = Stream::new(41);
        for case in 0..60 {
            let maxwell = |stream: &mut Stream| {
                let stiffness = stream.between(1e4, 1e5);
                let damping = stiffness * stream.between(1e-3, 3.0);
                Model::series([part(Spring { stiffness }), part(Dashpot { damping })])
            };
            let mut parts = vec![part(Spring { stiffness: stream.between(1e4, 1e5) })];
            parts.extend((0..stream.below(4)).map(|_| maxwell(&mut stream)));
            let mut model = Model::parallel(parts);
            if case % 3 == 0 {
                model = Model::series([model, part(Dashpot { damping: stream.between(1e3, 1e6) })]);
            }
            let specimen = Specimen::new(&model).unwrap();
            for drive in [Drive::Deformation, Drive::Force] {
                let unit = if matches!(drive, Drive::Force) { 1e3 } else { 0.01 };
                let mut time = 0.0;
                let points: Vec<(f64, f64)> = (0..20)
                    .map(|at| {
                        let value = if at == 0 && case % 2 == 0 { 0.0 } else { stream.share() };
                        let own = (time, unit * value);
                        time += stream.between(1e-4, 1.0);
                        own
                    })
                    .collect();
                let history = History::through(points.iter().copied());
                let own = Lines::of(&model, drive, &history).unwrap();
                let right = |time: f64| {
                    let at = Instant::after(time);
                    match drive {
                        Drive::Force => {
                            deformation(specimen.kelvin().unwrap(), &history, at).total()
                        }
                        Drive::Deformation => force(specimen.maxwell().unwrap(), &history, at),
                    }
                };
                let peak = own.peak();
                assert!((right(peak.0) - peak.1).abs() <= 1e-9 * peak.1.abs(), "{case}: {peak:?}");
                for _ in 0..200 {
                    let time = history.end() * 0.999_999 * stream.share();
                    let (found, right) = (own.value(time), right(time));
                    assert!(
                        (found - right).abs() <= 1e-11 * peak.1.abs(),
                        "{case} at {time}: {found} and {right}, {drive:?}"
                    );
                    assert!(found.abs() <= peak.1.abs() * (1.0 + 1e-12), "{case}: {peak:?}");
                }
            }
        }
    }

    #[test]
    fn a_jump_that_a_dashpot_alone_meets_has_no_answer() {
        let (spring, dashpot) = (part(Spring { stiffness: 1e4 }), part(Dashpot { damping: 1e2 }));
        let model = Model::parallel([spring, dashpot]);
        let jump = History::through([(0.0, 1e-3), (1.0, 1e-3)].into_iter());
        assert!(Lines::of(&model, Drive::Deformation, &jump).is_none());
        let ramp = History::through([(0.0, 0.0), (1.0, 1e-3)].into_iter());
        assert!(Lines::of(&model, Drive::Deformation, &ramp).is_some());
    }
}
