//! The motion of a mass on a spring, a slider and branches of a law that is not linear in series with a
//! slider, by the classical Runge–Kutta method from one turn or slip to the next. Where a slider slides,
//! its place follows from the balance by bisection. No code is shared with what it judges.

/// A law in series with a slider, which may have a spring beside it.
pub(super) struct Branch {
    /// The law as it stands in a scene.
    pub(super) text: &'static str,
    /// Its force \[N\], rising with the deformation.
    pub(super) law: fn(f64) -> f64,
    /// Stiffness beside the slider.
    pub(super) beside: f64,
    pub(super) slider: f64,
}

/// A mass that runs into a spring, a slider and branches, all side by side.
pub(super) struct Body {
    pub(super) mass: f64,
    pub(super) velocity: f64,
    pub(super) stiffness: f64,
    pub(super) guard: f64,
    pub(super) branches: Vec<Branch>,
}

/// Steps of an output interval.
const STEPS: usize = 100;

impl Branch {
    /// What the slider bears, where the mass is at `x` and it is at `z`.
    fn load(&self, x: f64, z: f64) -> f64 {
        (self.law)(x - z) - self.beside * z
    }

    /// Where the slider is while it slides the way that `way` points.
    fn place(&self, x: f64, way: f64) -> f64 {
        zero(|z| way * self.slider - self.load(x, z))
    }
}

/// Where a function rises through zero, within 2 m.
pub(super) fn zero(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (-2.0, 2.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The mass, its sliders, and which of them slide.
#[derive(Clone)]
struct State {
    x: f64,
    v: f64,
    sliders: Vec<f64>,
    slides: Vec<bool>,
    way: f64,
}

impl Body {
    /// Places of the mass at `count` equal intervals of `duration`.
    pub(super) fn places(&self, duration: f64, count: usize) -> Vec<f64> {
        let none = self.branches.len();
        let mut state = State {
            x: 0.0,
            v: self.velocity,
            sliders: vec![0.0; none],
            slides: vec![false; none],
            way: 1.0,
        };
        let step = duration / (count * STEPS) as f64;
        let mut places = Vec::new();
        for _ in 0..count {
            for _ in 0..STEPS {
                self.advance(&mut state, step);
            }
            places.push(state.x);
        }
        places
    }

    /// One step, with as many turns and slips as there are in it.
    fn advance(&self, state: &mut State, step: f64) {
        let mut left = step;
        for _ in 0..50 {
            if state.way == 0.0 {
                return;
            }
            let next = self.stepped(state, left);
            if !self.is_over(state, &next) {
                *state = next;
                return;
            }
            let (mut low, mut high) = (0.0, left);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                let over = self.is_over(state, &self.stepped(state, middle));
                if over { high = middle } else { low = middle }
            }
            let next = self.stepped(state, high);
            left -= high;
            self.switch(state, next);
        }
    }

    /// Whether the mass has turned, or a slider that sticks bears more than it can.
    fn is_over(&self, before: &State, now: &State) -> bool {
        let way = before.way;
        way * now.v < 0.0
            || self.branches.iter().enumerate().any(|(at, own)| {
                !before.slides[at] && way * own.load(now.x, now.sliders[at]) > own.slider
            })
    }

    fn switch(&self, state: &mut State, next: State) {
        let turned = state.way * next.v < 0.0;
        *state = next;
        if !turned {
            for (at, own) in self.branches.iter().enumerate() {
                state.slides[at] |= state.way * own.load(state.x, state.sliders[at]) > own.slider;
            }
            return;
        }
        state.v = 0.0;
        let push: f64 = self.stiffness * state.x
            + self
                .branches
                .iter()
                .zip(&state.sliders)
                .map(|(own, z)| (own.law)(state.x - z))
                .sum::<f64>();
        state.slides.fill(false);
        state.way = if push.abs() <= self.guard { 0.0 } else { -push.signum() };
    }

    /// The state a time later, if nothing turns or slips.
    fn stepped(&self, from: &State, time: f64) -> State {
        let rate = |x: f64, v: f64| [v, self.acceleration(from, x)];
        let [a, b] = rate(from.x, from.v);
        let half = 0.5 * time;
        let [c, d] = rate(from.x + half * a, from.v + half * b);
        let [e, f] = rate(from.x + half * c, from.v + half * d);
        let [g, h] = rate(from.x + time * e, from.v + time * f);
        let x = from.x + time / 6.0 * (a + 2.0 * c + 2.0 * e + g);
        let v = from.v + time / 6.0 * (b + 2.0 * d + 2.0 * f + h);
        State { x, v, sliders: self.sliders(from, x), ..from.clone() }
    }

    fn sliders(&self, from: &State, x: f64) -> Vec<f64> {
        let all = self.branches.iter().enumerate();
        all.map(|(at, own)| if from.slides[at] { own.place(x, from.way) } else { from.sliders[at] })
            .collect()
    }

    fn acceleration(&self, from: &State, x: f64) -> f64 {
        let sliders = self.sliders(from, x);
        let branches = self.branches.iter().zip(sliders).map(|(own, z)| (own.law)(x - z));
        let push = self.stiffness * x + branches.sum::<f64>() + from.way * self.guard;
        -push / self.mass
    }

    /// As a scene.
    pub(super) fn scene(&self, duration: f64) -> String {
        let mut parts = vec![format!("{{ spring = {:?} }}", self.stiffness)];
        if self.guard > 0.0 {
            parts.push(format!("{{ friction = {:?} }}", self.guard));
        }
        for branch in &self.branches {
            let mut slider = format!("{{ friction = {:?} }}", branch.slider);
            if branch.beside > 0.0 {
                slider = format!("{{ parallel = [{slider}, {{ spring = {:?} }}] }}", branch.beside);
            }
            parts.push(format!("{{ series = [{}, {slider}] }}", branch.text));
        }
        format!(
            "[nodes]\nhead = {{ mass = {:?}, velocity = {:?} }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], parallel = [{}] }}\n[run]\nduration = {duration:?}\n",
            self.mass,
            self.velocity,
            parts.join(", ")
        )
    }
}
