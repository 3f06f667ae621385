//! The motion of a mass on a spring, a dashpot, a slider and sliders behind springs, in closed form
//! from one turn, slip or stop to the next. No code is shared with what it judges.

/// A spring and a slider in series.
#[derive(Debug, Clone)]
pub(super) struct Jenkins {
    pub(super) stiffness: f64,
    pub(super) force: f64,
}

/// A mass that runs into a spring, a dashpot, a slider and branches, all side by side.
#[derive(Debug, Clone)]
pub(super) struct Pad {
    pub(super) mass: f64,
    pub(super) velocity: f64,
    pub(super) stiffness: f64,
    pub(super) damping: f64,
    pub(super) guard: f64,
    pub(super) branches: Vec<Jenkins>,
}

/// A span of the motion on which no slider stops or slips: `x = middle + e^{−δt} (a cos ωt + b sin ωt)`.
#[derive(Debug, Clone)]
struct Span {
    start: f64,
    end: f64,
    middle: f64,
    decay: f64,
    frequency: f64,
    cosine: f64,
    sine: f64,
}

/// The motion until the mass rests.
#[derive(Debug)]
pub(super) struct Motion {
    spans: Vec<Span>,
}

impl Span {
    fn place(&self, time: f64) -> f64 {
        let t = time - self.start;
        let (sin, cos) = (self.frequency * t).sin_cos();
        self.middle + (-self.decay * t).exp() * (self.cosine * cos + self.sine * sin)
    }

    fn speed(&self, time: f64) -> f64 {
        let t = time - self.start;
        let (sin, cos) = (self.frequency * t).sin_cos();
        let along = self.frequency * self.sine - self.decay * self.cosine;
        let across = self.frequency * self.cosine + self.decay * self.sine;
        (-self.decay * t).exp() * (along * cos - across * sin)
    }
}

impl Motion {
    /// When the mass has come to rest \[s\].
    pub(super) fn rest(&self) -> f64 {
        self.spans[self.spans.len() - 1].end
    }

    /// The place of the mass \[m\].
    pub(super) fn place(&self, time: f64) -> f64 {
        let last = &self.spans[self.spans.len() - 1];
        let own = self.spans.iter().find(|span| time < span.end).unwrap_or(last);
        own.place(time.min(own.end))
    }
}

impl Pad {
    pub(super) fn motion(&self) -> Motion {
        let (mut time, mut place, mut speed) = (0.0, 0.0, self.velocity);
        let mut way = 1.0;
        // The force of each branch, and whether its slider sticks.
        let mut forces = vec![0.0; self.branches.len()];
        let mut sticks = vec![true; self.branches.len()];
        let mut spans = Vec::new();
        loop {
            let span = self.span((time, place, speed), way, &forces, &sticks);
            let slip = |(branch, force): (&Jenkins, &f64)| {
                place + (way * branch.force - force) / branch.stiffness
            };
            let slips: Vec<f64> = self.branches.iter().zip(&forces).map(slip).collect();
            let farthest = span.place(span.end);
            let next = (0..slips.len())
                .filter(|&at| sticks[at] && way * (farthest - slips[at]) > 0.0)
                .min_by(|&a, &b| (way * slips[a]).total_cmp(&(way * slips[b])));
            let end = next.map_or(span.end, |at| when(&span, slips[at], way));
            let span = Span { end, ..span };
            let before = place;
            (time, place, speed) = (end, span.place(end), span.speed(end));
            for (at, branch) in self.branches.iter().enumerate().filter(|own| sticks[own.0]) {
                forces[at] += branch.stiffness * (place - before);
            }
            spans.push(span);
            if let Some(at) = next {
                (place, forces[at], sticks[at]) = (slips[at], way * self.branches[at].force, false);
                continue;
            }
            speed = 0.0;
            sticks.fill(true);
            let push = self.stiffness * place + forces.iter().sum::<f64>();
            if push.abs() <= self.guard {
                return Motion { spans };
            }
            way = -push.signum();
            for (at, branch) in self.branches.iter().enumerate() {
                sticks[at] = way * forces[at] < branch.force;
            }
        }
    }

    /// The motion in one direction, up to where it turns.
    fn span(
        &self,
        (time, place, speed): (f64, f64, f64),
        way: f64,
        forces: &[f64],
        sticks: &[bool],
    ) -> Span {
        let own = self.branches.iter().zip(sticks).filter(|own| *own.1);
        let stiffness = self.stiffness + own.map(|own| own.0.stiffness).sum::<f64>();
        let push = self.stiffness * place + forces.iter().sum::<f64>() + way * self.guard;
        let middle = place - push / stiffness;
        let decay = self.damping / (2.0 * self.mass);
        let frequency = (stiffness / self.mass - decay * decay).sqrt();
        let cosine = place - middle;
        let sine = (speed + decay * cosine) / frequency;
        let across = decay * sine + frequency * cosine;
        // The first zero of the speed after the start.
        let angle = (way * speed + 0.0).atan2(way * across);
        let angle = if angle > 0.0 { angle } else { angle + std::f64::consts::PI };
        let end = time + angle / frequency;
        Span { start: time, end, middle, decay, frequency, cosine, sine }
    }

    /// The pad as a scene, its parts in this order.
    pub(super) fn scene(&self, order: &[usize], duration: f64) -> String {
        let mut parts = vec![
            format!("{{ spring = {:?} }}", self.stiffness),
            format!("{{ friction = {:?} }}", self.guard),
            format!("{{ dashpot = {:?} }}", self.damping),
        ];
        parts.extend(self.branches.iter().map(|branch| {
            format!(
                "{{ series = [{{ spring = {:?} }}, {{ friction = {:?} }}] }}",
                branch.stiffness, branch.force
            )
        }));
        let parts: Vec<&str> = order.iter().map(|&at| parts[at].as_str()).collect();
        format!(
            "[nodes]\nhead = {{ mass = {:?}, velocity = {:?} }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], parallel = [{}] }}\n[run]\nduration = {duration:?}\n",
            self.mass,
            self.velocity,
            parts.join(", ")
        )
    }
}

/// When a span reaches a place on its way \[s\], by bisection.
fn when(span: &Span, place: f64, way: f64) -> f64 {
    let (mut low, mut high) = (span.start, span.end);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if way * (span.place(middle) - place) < 0.0 { low = middle } else { high = middle }
    }
    high
}
