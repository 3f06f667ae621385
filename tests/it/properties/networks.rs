//! Random networks as scenes: topology, twelve decades of parameters, contacts, friction, laws that
//! are not linear.

use std::{f64::consts::PI, fmt::Write};

use proptest::prelude::*;

/// Units of mass, length and time: a network is drawn in its own ones, and written in SI.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    pub(crate) mass: f64,
    pub(crate) length: f64,
    pub(crate) time: f64,
}

impl Units {
    /// The SI value of 1 in this unit.
    pub(crate) fn factor(self, unit: &str) -> f64 {
        let Self { mass, length, time } = self;
        match unit {
            "kg" => mass,
            "m" => length,
            "s" => time,
            "m/s" => length / time,
            "m/s^2" => length / (time * time),
            "N" => mass * length / (time * time),
            "N/m" => mass / (time * time),
            "N/m^3" => mass / (time * time * length * length),
            "N s/m" => mass / time,
            "N s" => mass * length / time,
            "J" => mass * length * length / (time * time),
            "s/m" => time / length,
            "m^2" => length * length,
            "Pa" => mass / (length * time * time),
            "1" => 1.0,
            other => panic!("`{other}`"),
        }
    }

    /// Times other ones.
    pub(crate) fn times(self, other: Self) -> Self {
        Self {
            mass: self.mass * other.mass,
            length: self.length * other.length,
            time: self.time * other.time,
        }
    }
}

/// A node: its mass, its start velocity, and a force on it.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub(crate) mass: f64,
    pub(crate) velocity: f64,
    pub(crate) load: f64,
}

/// The law of an element; numbers in the network's units.
#[derive(Debug, Clone)]
pub(crate) enum Law {
    Spring(f64),
    Dashpot(f64),
    Kelvin(f64, f64),
    Maxwell(f64, f64),
    Zener(f64, f64, f64),
    Contact {
        gap: f64,
        restitution: f64,
    },
    Padded {
        gap: f64,
        restitution: f64,
        stiffness: f64,
        damping: f64,
    },
    Friction(f64),
    Cubic(f64, f64),
    PowerDashpot(f64, f64),
    HuntCrossley {
        force: f64,
        dissipation: f64,
        gap: f64,
    },
    PowerSpring(f64, f64),
    RateSpring {
        force: f64,
        exponent: f64,
        gain: f64,
        rate: f64,
    },
    Bumper {
        force: f64,
        restitution: f64,
        gap: f64,
    },
    /// Modulus, plateau and densification as forces on a block of area and thickness 1.
    Foam(f64, f64, f64),
}

/// An element between two nodes, by number; that of the ground is the number of nodes.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub(crate) between: [usize; 2],
    pub(crate) law: Law,
    /// At which deformation it bottoms, and how much speed is given back.
    pub(crate) stop: Option<(f64, f64)>,
    /// Whether it can part.
    pub(crate) parts: bool,
}

/// A network, and how long it runs.
#[derive(Debug, Clone)]
pub(crate) struct Sketch {
    pub(crate) units: Units,
    pub(crate) bodies: Vec<Body>,
    pub(crate) links: Vec<Link>,
}

/// How a sketch is written down.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Way {
    /// Nodes and elements in reverse order.
    pub(crate) backwards: bool,
    /// Seen in a mirror: all speeds and forces the other way, all ends exchanged.
    pub(crate) mirrored: bool,
    /// Numbers in other units than SI.
    pub(crate) in_units: bool,
    /// Power laws at references larger by this power of two.
    pub(crate) referred: i32,
    /// Models composed in another one of these ways.
    pub(crate) nested: usize,
    /// All begins at rest; pulses that bring the speeds, and the loads, begin at this time.
    pub(crate) late: Option<f64>,
}

/// What may be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kinds {
    /// Springs and dashpots.
    Linear,
    /// Those, and what switches between linear laws.
    Switching,
    /// All laws.
    All,
}

fn decades(spread: f64) -> impl Strategy<Value = f64> + Clone {
    (-spread..spread).prop_map(|exponent: f64| 10f64.powf(exponent))
}

fn law(kinds: Kinds) -> BoxedStrategy<Law> {
    // Damping spreads over all twelve decades; stiffness over fewer, as each costs oscillations.
    let stiffness = || decades(1.5);
    let damping = || decades(6.0);
    let share = || prop_oneof![Just(0.0), Just(1.0), 0.0..1.0];
    let gap = || prop_oneof![Just(0.0), 0.0..1.0];
    let linear = prop_oneof![
        4 => stiffness().prop_map(Law::Spring),
        2 => damping().prop_map(Law::Dashpot),
        3 => (stiffness(), damping()).prop_map(|(k, c)| Law::Kelvin(k, c)),
        2 => (stiffness(), damping()).prop_map(|(k, c)| Law::Maxwell(k, c)),
        2 => (stiffness(), stiffness(), damping()).prop_map(|(k, l, c)| Law::Zener(k, l, c)),
    ];
    let switching = prop_oneof![
        (gap(), share()).prop_map(|(gap, restitution)| Law::Contact { gap, restitution }),
        (gap(), share(), stiffness(), decades(2.0)).prop_map(
            |(gap, restitution, stiffness, damping)| Law::Padded {
                gap,
                restitution,
                stiffness,
                damping
            }
        ),
        decades(1.0).prop_map(Law::Friction),
    ];
    let nonlinear = prop_oneof![
        (stiffness(), decades(2.0)).prop_map(|(k, cubic)| Law::Cubic(k, cubic)),
        (decades(1.0), 0.5..2.0).prop_map(|(force, power)| Law::PowerDashpot(force, power)),
        (decades(1.0), 0.0..1.0, gap()).prop_map(|(force, dissipation, gap)| {
            Law::HuntCrossley { force, dissipation, gap }
        }),
    ];
    let powers = prop_oneof![
        (decades(1.0), 1.0..3.5).prop_map(|(force, exponent)| Law::PowerSpring(force, exponent)),
        (decades(1.0), 1.0..2.5, 0.02..0.5, decades(1.0)).prop_map(
            |(force, exponent, gain, rate)| Law::RateSpring { force, exponent, gain, rate }
        ),
        (decades(1.0), 0.1..1.0, gap()).prop_map(|(force, restitution, gap)| Law::Bumper {
            force,
            restitution,
            gap
        }),
        (decades(1.0), decades(1.0), decades(1.0))
            .prop_map(|(modulus, plateau, dense)| Law::Foam(modulus, plateau, dense)),
    ];
    match kinds {
        Kinds::Linear => linear.boxed(),
        Kinds::Switching => prop_oneof![3 => linear, 2 => switching].boxed(),
        Kinds::All => prop_oneof![3 => linear, 1 => switching, 1 => nonlinear, 2 => powers].boxed(),
    }
}

/// A network of up to five nodes. Each node but the first may be massless; each has an element to
/// a later one or to the ground, so that few of them are loose.
pub(crate) fn sketch(kinds: Kinds) -> impl Strategy<Value = Sketch> {
    let units = (decades(6.0), decades(6.0), decades(6.0)).prop_map(|(mass, length, time)| Units {
        mass,
        length,
        time,
    });
    (1..5usize, units).prop_flat_map(move |(count, units)| {
        let mass = prop_oneof![3 => decades(1.5), 1 => Just(0.0)];
        let velocity = prop_oneof![2 => Just(0.0), 1 => -1.0..1.0];
        let load = prop_oneof![3 => Just(0.0), 1 => -1.0..1.0];
        let others = (mass, velocity, load).prop_map(|(mass, velocity, load)| Body {
            mass,
            velocity: if mass > 0.0 { velocity } else { 0.0 },
            load,
        });
        let first = (decades(1.5), 0.5..1.5).prop_map(|(mass, velocity)| Body {
            mass,
            velocity,
            load: 0.0,
        });
        let link = |from: BoxedStrategy<[usize; 2]>| {
            let stop = prop::option::weighted(0.15, (0.1..1.0, prop_oneof![Just(0.0), 0.0..1.0]));
            let stop = if kinds == Kinds::Linear { Just(None).boxed() } else { stop.boxed() };
            let parts = prop::bool::weighted(if kinds == Kinds::Linear { 0.0 } else { 0.15 });
            (from, law(kinds), stop, parts).prop_map(|(between, law, stop, parts)| {
                let is_pad = !matches!(law, Law::Contact { .. } | Law::Friction(_));
                let stop = stop.filter(|_| is_pad);
                Link { between, law, stop, parts: parts && is_pad }
            })
        };
        let own: Vec<_> = (0..count)
            .map(|node| link((node + 1..=count).prop_map(move |to| [node, to]).boxed()))
            .collect();
        let between = (0..=count, 1..=count);
        let between = between.prop_map(move |(a, step)| [a, (a + step) % (count + 1)]).boxed();
        let more = prop::collection::vec(link(between), 0..=count);
        (first, prop::collection::vec(others, count - 1), own, more).prop_map(
            move |(first, others, own, more)| Sketch {
                units,
                bodies: [vec![first], others].concat(),
                links: [own, more].concat(),
            },
        )
    })
}

impl Sketch {
    /// The run's length: some periods of what strikes, but not too many of the fastest mass.
    pub(crate) fn duration(&self) -> f64 {
        let frequency = |at: usize| {
            let own = self.links.iter().filter(|link| link.between.contains(&at));
            let stiffness: f64 = own.map(|link| link.law.stiffness()).sum();
            (stiffness / self.bodies[at].mass).sqrt()
        };
        let massive = (0..self.bodies.len()).filter(|&at| self.bodies[at].mass > 0.0);
        let fastest = massive.map(frequency).fold(0.0, f64::max);
        let lead = frequency(0);
        let wanted = if lead > 0.0 { 6.0 / lead } else { 3.0 };
        if fastest > 0.0 { wanted.min(100.0 / fastest) } else { wanted }
    }

    /// The scene.
    pub(crate) fn text(&self, way: Way) -> String {
        let sign = if way.mirrored { -1.0 } else { 1.0 };
        let si = |value: f64, unit: &str| {
            let (unit_text, size) = match unit {
                "N/m^3" | "1" => (String::new(), 1.0),
                _ if way.in_units => {
                    let (name, size) = other_unit(unit);
                    (format!(" {name}"), size)
                }
                _ => (format!(" {unit}"), 1.0),
            };
            let value = value * self.units.factor(unit) / size;
            if unit_text.is_empty() {
                format!("{value:e}")
            } else {
                format!("\"{value:e}{unit_text}\"")
            }
        };
        let mut nodes: Vec<String> = Vec::new();
        let mut loads: Vec<String> = Vec::new();
        for (at, body) in self.bodies.iter().enumerate() {
            let mut keys = Vec::new();
            if body.mass > 0.0 {
                keys.push(format!("mass = {}", si(body.mass, "kg")));
            }
            if body.velocity != 0.0 && way.late.is_none() {
                keys.push(format!("velocity = {}", si(sign * body.velocity, "m/s")));
            }
            nodes.push(format!("n{at} = {{ {} }}", keys.join(", ")));
            let mut load = |name: &str, force: String| {
                let force = format!("force = {{ {force} }}");
                loads.push(format!("{name}{at} = {{ on = \"n{at}\", {force} }}"));
            };
            let start =
                way.late.map_or(String::new(), |late| format!(", start = {}", si(late, "s")));
            if body.velocity != 0.0 && way.late.is_some() {
                let peak = si(sign * 0.5 * PI * body.mass * body.velocity / PULSE, "N");
                let length = si(PULSE, "s");
                load("p", format!("half-sine = {{ peak = {peak}, duration = {length}{start} }}"));
            }
            if body.load != 0.0 {
                let force = si(sign * body.load, "N");
                load("l", format!("constant = {{ value = {force}{start} }}"));
            }
        }
        let node = |at: usize| {
            if at < self.bodies.len() { format!("n{at}") } else { "ground".to_owned() }
        };
        let mut elements: Vec<String> = Vec::new();
        let mut effects: Vec<String> = Vec::new();
        for (at, link) in self.links.iter().enumerate() {
            let [a, b] = link.between.map(node);
            let [a, b] = if way.mirrored { [b, a] } else { [a, b] };
            let law = link.law.text(way, &si);
            elements.push(format!("e{at} = {{ between = [\"{a}\", \"{b}\"], {law} }}"));
            if let Some((limit, restitution)) = link.stop {
                let limit = si(limit, "m");
                effects
                    .push(format!("stop.e{at} = {{ at = {limit}, restitution = {restitution} }}"));
            }
            if link.parts {
                // Seen in a mirror, the other of the two ends is the first one.
                let first = usize::from(link.between[0] >= self.bodies.len());
                effects.push(format!(
                    "separation.e{at} = {{ at = \"{}\" }}",
                    node(link.between[first])
                ));
            }
        }
        if way.backwards {
            nodes.reverse();
            elements.reverse();
            loads.reverse();
        }
        let mut text = String::new();
        for (section, lines) in
            [("nodes", nodes), ("elements", elements), ("effects", effects), ("loads", loads)]
        {
            if !lines.is_empty() {
                let _ = writeln!(text, "[{section}]\n{}\n", lines.join("\n"));
            }
        }
        let duration = way.late.unwrap_or(0.0) + self.duration();
        let _ = writeln!(text, "[run]\nduration = {}", si(duration, "s"));
        text
    }
}

impl Law {
    /// A typical stiffness, in the network's units.
    fn stiffness(&self) -> f64 {
        match *self {
            Self::Spring(k) | Self::Kelvin(k, _) | Self::Maxwell(k, _) => k,
            Self::Zener(k, other, _) => k + other,
            Self::Padded { stiffness, .. } => stiffness,
            Self::Cubic(k, cubic) => k + 3.0 * cubic,
            Self::HuntCrossley { force, .. } | Self::Bumper { force, .. } => 10.0 * force,
            Self::PowerSpring(force, exponent) | Self::RateSpring { force, exponent, .. } => {
                force * exponent
            }
            Self::Foam(modulus, _, densification) => modulus + 10.0 * densification,
            Self::Dashpot(_)
            | Self::Contact { .. }
            | Self::Friction(_)
            | Self::PowerDashpot(..) => 0.0,
        }
    }

    fn text(&self, way: Way, si: &dyn Fn(f64, &str) -> String) -> String {
        if let Some(text) = self.nested(way.nested, si) {
            return text;
        }
        let k = |value: f64| si(value, "N/m");
        let c = |value: f64| si(value, "N s/m");
        // A power law with a larger reference, and the force that it has there.
        let at = f64::from(way.referred).exp2();
        let power = |force: f64, exponent: f64, unit: &str| {
            let force = si(force * at.powf(exponent), "N");
            format!("force = {force}, at = {}", si(at, unit))
        };
        match *self {
            Self::Spring(own) => format!("spring = {}", k(own)),
            Self::Dashpot(own) => format!("dashpot = {}", c(own)),
            Self::Kelvin(spring, dashpot) => {
                format!("kelvin-voigt = {{ spring = {}, dashpot = {} }}", k(spring), c(dashpot))
            }
            Self::Maxwell(spring, dashpot) => {
                format!("maxwell = {{ spring = {}, dashpot = {} }}", k(spring), c(dashpot))
            }
            Self::Zener(spring, other, dashpot) => format!(
                "zener = {{ spring = {}, maxwell = {{ spring = {}, dashpot = {} }} }}",
                k(spring),
                k(other),
                c(dashpot)
            ),
            Self::Contact { gap, restitution } => {
                format!("contact = {{ gap = {}, restitution = {restitution} }}", si(gap, "m"))
            }
            Self::Padded { gap, restitution, stiffness, damping } => format!(
                "series = [{{ contact = {{ gap = {}, restitution = {restitution} }} }}, \
                 {{ kelvin-voigt = {{ spring = {}, dashpot = {} }} }}]",
                si(gap, "m"),
                k(stiffness),
                c(damping)
            ),
            Self::Friction(force) => format!("friction = {}", si(force, "N")),
            Self::Cubic(own, cubic) => format!(
                "cubic-spring = {{ stiffness = {}, cubic = {} }}",
                k(own),
                si(cubic, "N/m^3")
            ),
            Self::PowerDashpot(force, exponent) => format!(
                "power-dashpot = {{ {}, exponent = {exponent} }}",
                power(force, exponent, "m/s")
            ),
            Self::HuntCrossley { force, dissipation, gap } => format!(
                "hunt-crossley = {{ {}, dissipation = {}, gap = {} }}",
                power(force, 1.5, "m"),
                si(dissipation, "s/m"),
                si(gap, "m")
            ),
            Self::PowerSpring(force, exponent) => format!(
                "power-spring = {{ {}, exponent = {exponent} }}",
                power(force, exponent, "m")
            ),
            Self::RateSpring { force, exponent, gain, rate } => format!(
                "rate-spring = {{ {}, exponent = {exponent}, gain = {gain}, reference-rate = {} }}",
                power(force, exponent, "m"),
                si(rate, "m/s")
            ),
            Self::Bumper { force, restitution, gap } => format!(
                "bumper = {{ {}, restitution = {restitution}, speed = {}, gap = {} }}",
                power(force, 1.5, "m"),
                si(1.0, "m/s"),
                si(gap, "m")
            ),
            Self::Foam(modulus, plateau, densification) => format!(
                "foam = {{ modulus = {}, plateau = {}, densification = {}, exponent = 2, \
                 thickness = {}, area = {} }}",
                si(modulus, "Pa"),
                si(plateau, "Pa"),
                si(densification, "Pa"),
                si(1.0, "m"),
                si(1.0, "m^2")
            ),
        }
    }

    /// The same law composed otherwise; `None` for what has no other composition.
    fn nested(&self, way: usize, si: &dyn Fn(f64, &str) -> String) -> Option<String> {
        let spring = |k: f64| format!("spring = {}", si(k, "N/m"));
        let dashpot = |c: f64| format!("dashpot = {}", si(c, "N s/m"));
        let tree = |word: &str, parts: &[String]| {
            let parts: Vec<String> = parts.iter().map(|part| format!("{{ {part} }}")).collect();
            format!("{word} = [{}]", parts.join(", "))
        };
        let row = |parts: &[String]| tree("series", parts);
        let beside = |parts: &[String]| tree("parallel", parts);
        // Whole, in two halves, and those in groups of one.
        let in_two = |word: &str, half: String| match way % 3 {
            1 => tree(word, &[half.clone(), half]),
            _ => tree(
                word,
                &[tree("series", std::slice::from_ref(&half)), tree("parallel", &[half])],
            ),
        };
        Some(match *self {
            _ if way == 0 => return None,
            Self::Spring(k) if way.is_multiple_of(2) => in_two("series", spring(2.0 * k)),
            Self::Spring(k) => in_two("parallel", spring(0.5 * k)),
            Self::Dashpot(c) if way.is_multiple_of(2) => in_two("series", dashpot(2.0 * c)),
            Self::Dashpot(c) => in_two("parallel", dashpot(0.5 * c)),
            Self::Kelvin(k, c) => beside(&[dashpot(c), beside(&[spring(k)])]),
            Self::Maxwell(k, c) => row(&[dashpot(c), row(&[spring(k)])]),
            Self::Zener(k, other, c) => {
                beside(&[row(&[dashpot(c), spring(other)]), row(&[beside(&[spring(k)])])])
            }
            Self::Padded { gap, restitution, stiffness, damping } => {
                let gap = si(gap, "m");
                let contact = format!("contact = {{ gap = {gap}, restitution = {restitution} }}");
                row(&[beside(&[dashpot(damping), spring(stiffness)]), contact])
            }
            _ => return None,
        })
    }
}

/// How long the pulse is that brings a speed, in the network's unit of time.
const PULSE: f64 = 0.3;

/// Another unit than this one of SI, and its size.
fn other_unit(unit: &str) -> (&str, f64) {
    match unit {
        "kg" => ("g", 1e-3),
        "m" => ("mm", 1e-3),
        "s" => ("ms", 1e-3),
        "m/s" => ("km/h", 1.0 / 3.6),
        "N" => ("kN", 1e3),
        "N/m" => ("N/mm", 1e3),
        "N s/m" => ("kN s/m", 1e3),
        "Pa" => ("MPa", 1e6),
        "m^2" => ("cm^2", 1e-4),
        other => (other, 1.0),
    }
}
