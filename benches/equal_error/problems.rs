//! The problems: each as a network and as equations by hand.

use dashpot::{
    network::{
        Assembly, Network, Node,
        elements::{Contact, Dashpot, Spring},
        part,
    },
    rheology::Tree,
};

use super::{
    by_hand::ByHand,
    chain::Chain,
    impact::{self, Impact},
};

/// Times at which solutions are compared.
pub(crate) const SAMPLES: u32 = 500;

/// A problem in both forms.
pub(crate) struct Problem {
    /// What it is.
    pub(crate) title: String,
    /// The network, compiled.
    pub(crate) assembly: Assembly,
    /// Number of the output that is compared.
    pub(crate) output: usize,
    /// The same by hand.
    pub(crate) by_hand: Box<dyn ByHand>,
    /// End \[s\].
    pub(crate) end: f64,
    /// Wanted errors, in parts of the largest value.
    pub(crate) wanted: [f64; 3],
    /// Seconds beyond which a run is not waited for.
    pub(crate) patience: f64,
    /// How far below and above the diagonal the slopes of the equations by hand reach, where they are banded.
    pub(crate) band: Option<(usize, usize)>,
}

impl Problem {
    fn of(
        title: &str,
        network: &Network,
        (output, end): (&str, f64),
        by_hand: Box<dyn ByHand>,
    ) -> Result<Self, String> {
        let assembly = network.compile(end).map_err(|error| error.to_string())?;
        let output = assembly.output(output).ok_or_else(|| format!("no output {output}"))?;
        Ok(Self {
            title: title.to_owned(),
            assembly,
            output,
            by_hand,
            end,
            wanted: [1e-3, 1e-6, 1e-9],
            patience: 1.0,
            band: None,
        })
    }

    /// The times of comparison \[s\].
    pub(crate) fn times(&self) -> Vec<f64> {
        (1..=SAMPLES).map(|at| self.end * f64::from(at) / f64::from(SAMPLES)).collect()
    }
}

/// All problems.
pub(crate) fn all() -> Result<Vec<Problem>, String> {
    let end = 0.02;
    let force = ("padding.force", end);
    let mut all = vec![
        Problem::of(
            "Reference impact, 6 states: force of the padding",
            &impact::network(1, 1e4),
            force,
            Box::new(Impact::with_mount(0.2)),
        )?,
        Problem::of(
            "The same with a stiff mount (10 MN s/m)",
            &impact::network(1, 1e7),
            force,
            Box::new(Impact::with_mount(200.0)),
        )?,
        Problem::of(
            "Contact: a mass between a soft spring and a hard one with free travel, 50 ms: force of \
             the soft one",
            &Stop::network(),
            ("spring.force", 0.05),
            Box::new(Stop),
        )?,
        Problem::of(
            "Padding of 30 Maxwell elements over six decades of times: its force",
            &Modes::network(),
            force,
            Box::new(Modes),
        )?,
    ];
    let wanted = [1e-3, 6e-6, 2e-8];
    for (nodes, patience, wanted) in [
        (100, 3.0, wanted),
        (1000, 3.0, wanted),
        (10_000, 10.0, wanted),
        (100_000, 60.0, [1e-3, 1e-4, 6e-6]),
    ] {
        let chain = Chain { nodes };
        let problem = Problem::of(
            &format!("Impact on a chain of {nodes} masses: force of the first link"),
            &chain.network(),
            ("link-0.force", end),
            Box::new(chain),
        )?;
        all.push(Problem {
            wanted,
            patience,
            // The force on a mass depends on positions and speeds of its neighbours.
            band: Some((3, 2)),
            ..problem
        });
    }
    Ok(all)
}

/// 10 kg at 10 m/s on a suspension of 1 MN/m and 300 N s/m, with a stop of 20 MN/m after 5 mm.
///
/// Units by hand: 5 mm and 1 ms.
struct Stop;

impl Stop {
    const GAP: f64 = 5e-3;

    fn network() -> Network {
        let mut network = Network::new();
        let mass = network.add_node(Node::mass("mass", 10.0).moving(10.0));
        let ground = network.ground();
        network.connect("spring", mass, ground, part(Spring { stiffness: 1e6 }));
        network.connect("damper", mass, ground, part(Dashpot { damping: 300.0 }));
        let contact = part(Contact { gap: Self::GAP, restitution: 0.0 });
        let stop = Tree::series([contact, part(Spring { stiffness: 2e7 })]);
        network.connect("stop", mass, ground, stop);
        network
    }
}

impl ByHand for Stop {
    fn start(&self) -> Vec<f64> {
        vec![0.0, 2.0]
    }

    fn end(&self) -> f64 {
        50.0
    }

    fn rates(&self, state: &[f64], rates: &mut [f64]) {
        rates[0] = state[1];
        rates[1] = -0.1 * state[0] - 0.03 * state[1] - 2.0 * (state[0] - 1.0).max(0.0);
    }

    fn slopes(&self, state: &[f64], change: &[f64], rates: &mut [f64]) {
        let stop = if state[0] > 1.0 { 2.0 } else { 0.0 };
        rates[0] = change[1];
        rates[1] = -(0.1 + stop) * change[0] - 0.03 * change[1];
    }

    fn observed(&self, state: &dyn Fn(usize) -> f64) -> f64 {
        1e6 * Self::GAP * state(0)
    }
}

/// 10 kg at 10 m/s on a spring of 1 MN/m beside 30 Maxwell elements of 1 MN/m each with times from
/// 1 µs to 1 s.
///
/// Units by hand: 1 cm, 10 m/s, 1 ms and 10 kN; the states are deformation, speed and the elements'
/// forces.
struct Modes;

impl Modes {
    const COUNT: u32 = 30;

    /// Relaxation time \[s\] of an element.
    fn time(at: u32) -> f64 {
        10_f64.powf(6.0 * f64::from(at) / f64::from(Self::COUNT - 1) - 6.0)
    }

    fn network() -> Network {
        let spring = || part(Spring { stiffness: 1e6 });
        let element =
            |at| Tree::series([spring(), part(Dashpot { damping: 1e6 * Self::time(at) })]);
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
        let pad = Tree::parallel([spring()].into_iter().chain((0..Self::COUNT).map(element)));
        network.connect("padding", head, network.ground(), pad);
        network
    }
}

impl ByHand for Modes {
    fn start(&self) -> Vec<f64> {
        let mut state = vec![0.0; 2 + Self::COUNT as usize];
        state[1] = 1.0;
        state
    }

    fn end(&self) -> f64 {
        20.0
    }

    fn rates(&self, state: &[f64], rates: &mut [f64]) {
        rates[0] = state[1];
        rates[1] = -0.1 * (state[0] + state[2..].iter().sum::<f64>());
        for (at, (rate, force)) in (0..).zip(rates[2..].iter_mut().zip(&state[2..])) {
            *rate = state[1] - 1e-3 * force / Self::time(at);
        }
    }

    fn slopes(&self, _state: &[f64], change: &[f64], rates: &mut [f64]) {
        self.rates(change, rates);
    }

    fn observed(&self, state: &dyn Fn(usize) -> f64) -> f64 {
        1e4 * (state(0) + (2..2 + Self::COUNT as usize).map(state).sum::<f64>())
    }
}
