//! Random networks: topology and eight decades of parameters, from fixed seeds.

use dashpot::{
    dae::{Run, Silent, methods},
    network::{Assembly, Network, NetworkError, Node, NodeId},
};

use crate::{
    order::Pencil,
    thesis::{dashpot, spring},
};

/// `SplitMix64` (Steele, Lea, Flood 2014): small, fixed, good enough to draw networks.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// Between 0 and 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Log-uniform over `decades` around 1.
    pub(crate) fn decades(&mut self, decades: f64) -> f64 {
        10f64.powf(decades * (self.unit() - 0.5))
    }
}

/// A network as a list, so that it can be built in any order.
#[derive(Debug, Clone)]
pub(crate) struct Recipe {
    /// Mass and start velocity of each node.
    pub(crate) nodes: Vec<(f64, f64)>,
    /// Ends (the number of nodes stands for the ground), whether a spring, and its constant.
    pub(crate) elements: Vec<(usize, usize, bool, f64)>,
}

impl Recipe {
    pub(crate) fn draw(dice: &mut Dice, decades: f64) -> Self {
        let count = 2 + dice.below(6);
        let mut nodes: Vec<(f64, f64)> = (0..count)
            .map(|_| if dice.below(2) == 0 { (dice.decades(decades), 0.0) } else { (0.0, 0.0) })
            .collect();
        nodes[0] = (dice.decades(decades), 1.0 + dice.unit());
        let mut elements = Vec::new();
        for node in (0..count).filter(|_| dice.below(8) > 0).collect::<Vec<_>>() {
            let other = node + 1 + dice.below(count - node);
            elements.push((node, other, dice.below(2) == 0, dice.decades(decades)));
        }
        for _ in 0..dice.below(2 * count) {
            let (a, b) = (dice.below(count + 1), dice.below(count + 1));
            if a != b {
                elements.push((a, b, dice.below(2) == 0, dice.decades(decades)));
            }
        }
        Self { nodes, elements }
    }

    pub(crate) fn build(&self) -> Network {
        let identity: Vec<usize> = (0..self.nodes.len()).collect();
        self.build_in_order(&identity, false)
    }

    /// The same network with its nodes and elements declared in another order.
    fn build_in_order(&self, order: &[usize], backwards: bool) -> Network {
        let mut network = Network::new();
        let mut ids = vec![network.ground(); self.nodes.len() + 1];
        for &at in order {
            let (mass, velocity) = self.nodes[at];
            let node = Node::mass(format!("n{at}"), mass);
            ids[at] = network.add_node(if velocity == 0.0 { node } else { node.moving(velocity) });
        }
        let mut connect =
            |(at, &(a, b, is_spring, constant)): (usize, &(usize, usize, bool, f64))| {
                let model = if is_spring { spring(constant) } else { dashpot(constant) };
                let ends: [NodeId; 2] = [ids[a], ids[b]];
                network.connect(format!("e{at}"), ends[0], ends[1], model);
            };
        if backwards {
            self.elements.iter().enumerate().rev().for_each(&mut connect);
        } else {
            self.elements.iter().enumerate().for_each(&mut connect);
        }
        network
    }

    /// Bound of the radians that the fastest mode passes through; the work of exact signals grows
    /// with it.
    pub(crate) fn radians(&self) -> f64 {
        let fastest = (0..self.nodes.len())
            .filter(|&node| self.nodes[node].0 > 0.0)
            .map(|node| {
                let springs = self.elements.iter().filter(|e| e.2 && (e.0 == node || e.1 == node));
                (2.0 * springs.map(|e| e.3).sum::<f64>() / self.nodes[node].0).sqrt()
            })
            .fold(0.0, f64::max);
        fastest * self.duration()
    }

    /// A few periods of the fastest start.
    pub(crate) fn duration(&self) -> f64 {
        let (mass, _) = self.nodes[0];
        let sum = |springs: bool| -> f64 {
            self.elements
                .iter()
                .filter(|&&(a, b, is_spring, _)| (a == 0 || b == 0) && is_spring == springs)
                .map(|element| element.3)
                .sum()
        };
        8.0 / (sum(true) / mass).sqrt().max(sum(false) / mass)
    }
}

fn compile(recipe: &Recipe) -> Result<Assembly, Vec<NetworkError>> {
    recipe.build().compile(recipe.duration()).map_err(|errors| errors.0)
}

#[test]
fn the_order_of_the_system_is_the_degree_of_the_determinant() {
    let mut dice = Dice(1);
    let (mut determined, mut refused) = (0, 0);
    for case in 0..1500 {
        let recipe = Recipe::draw(&mut dice, 8.0);
        let degree = Pencil::of(&recipe).degree(&mut dice);
        match (compile(&recipe), degree) {
            (Ok(assembly), Some(degree)) => {
                determined += 1;
                assert_eq!(assembly.system.algebraic(), 0, "case {case}");
                assert_eq!(assembly.system.states(), degree, "case {case}: {recipe:?}");
            }
            (Err(errors), None) => {
                refused += 1;
                let is_topology = |error: &NetworkError| {
                    matches!(
                        error,
                        NetworkError::Undetermined { .. } | NetworkError::IsolatedNode { .. }
                    )
                };
                assert!(errors.iter().all(is_topology), "case {case}: {errors:?}");
            }
            (found, degree) => panic!("case {case}: {:?} but {degree:?}", found.err()),
        }
    }
    assert!(determined > 1000 && refused > 20, "{determined} and {refused}");
}

#[test]
fn forces_balance_at_massless_nodes_and_energy_closes() {
    let mut dice = Dice(2);
    let exact = methods::by_name("exact").unwrap();
    let mut solved = 0;
    for case in 0..300 {
        let recipe = Recipe::draw(&mut dice, 8.0);
        if recipe.radians() > 1e3 {
            continue;
        }
        let Ok(assembly) = compile(&recipe) else { continue };
        let (system, duration) = (&assembly.system, recipe.duration());
        let run = Run::to(duration);
        if exact.applies(system, &run).is_err() {
            continue;
        }
        let trajectory = exact.integrate(system, &run, &mut Silent).unwrap();
        solved += 1;
        let signal = |output: usize| trajectory.signal(system, output);
        let forces: Vec<_> =
            assembly.connections.iter().map(|c| signal(c.force.unwrap())).collect();
        let times: Vec<f64> = (0..=10).map(|at| duration * f64::from(at) / 10.0).collect();
        let dimensionless: Vec<f64> = times.iter().map(|t| t / system.time_scale).collect();
        let states = trajectory.dense.sample(system, &dimensionless);
        for (node, &(mass, _)) in recipe.nodes.iter().enumerate().filter(|(_, n)| n.0 == 0.0) {
            for (t, state) in times.iter().zip(states.chunks(system.len())) {
                // Rounding of the rows shows as that of the products they sum up.
                let (mut sum, mut threshold) = (mass, 0.0_f64);
                for (at, (element, force)) in recipe.elements.iter().zip(&forces).enumerate() {
                    let sign = f64::from(i8::from(element.1 == node) - i8::from(element.0 == node));
                    if sign == 0.0 {
                        continue;
                    }
                    sum += sign * force.value(*t);
                    let output = system.outputs.at(assembly.connections[at].force.unwrap());
                    let products = output.scale * output.unknowns.magnitude_at(state);
                    threshold += force.error.unwrap() + 32.0 * f64::EPSILON * products;
                }
                assert!(
                    sum.abs() <= threshold,
                    "case {case}, n{node} at {t}: {sum:e} beyond {threshold:e}"
                );
            }
        }
        let products = |output: usize| {
            let output = system.outputs.at(output);
            let products = |state| output.scale * output.unknowns.magnitude_at(state);
            states.chunks(system.len()).map(products).fold(0.0, f64::max)
        };
        positions_match(case, &recipe, &assembly, duration, &signal, &products);
        close_energy(case, &recipe, &assembly, duration, &signal);
    }
    assert!(solved > 150, "only {solved} were solved");
}

/// Every deformation is the difference of the positions at its ends, and every rate that of the
/// velocities, but for the rounding of the rows, which shows as that of the `products` they sum up.
fn positions_match(
    case: usize,
    recipe: &Recipe,
    assembly: &Assembly,
    duration: f64,
    signal: &dyn Fn(usize) -> dashpot::dae::Signal,
    products: &dyn Fn(usize) -> f64,
) {
    let ground = recipe.nodes.len();
    let node = |at: usize| &assembly.nodes[if at == ground { 0 } else { at + 1 }];
    for (element, found) in recipe.elements.iter().zip(&assembly.connections) {
        let (a, b) = (node(element.0), node(element.1));
        let pairs = [
            (found.deformation, a.position, b.position),
            (found.rate.unwrap(), a.velocity.unwrap(), b.velocity.unwrap()),
        ];
        for (whole, first, second) in pairs {
            let rounding: f64 = [whole, first, second].iter().map(|&at| products(at)).sum();
            let [whole, first, second] = [whole, first, second].map(signal);
            let errors: f64 = [&whole, &first, &second].iter().map(|s| s.error.unwrap()).sum();
            let scale = first.bound().max(second.bound()).max(whole.bound());
            for step in 0..=5 {
                let t = duration * f64::from(step) / 5.0;
                let gap = (first.value(t) - second.value(t) - whole.value(t)).abs();
                let allowed = errors + 1e-12 * scale + 4.0 * f64::EPSILON * rounding;
                assert!(
                    gap <= allowed,
                    "case {case} at {t}: {gap:e} beyond {allowed:e}, {found:?}"
                );
            }
        }
    }
}

fn close_energy(
    case: usize,
    recipe: &Recipe,
    assembly: &Assembly,
    duration: f64,
    signal: &dyn Fn(usize) -> dashpot::dae::Signal,
) {
    let mut threshold = 0.0;
    let mut square = |factor: f64, value: f64, error: Option<f64>| {
        threshold += factor * (2.0 * value.abs() + error.unwrap()) * error.unwrap();
        factor * value * value
    };
    let start: f64 = recipe.nodes.iter().map(|(mass, v)| 0.5 * mass * v * v).sum();
    let kinetic: f64 = assembly
        .nodes
        .iter()
        .filter(|node| node.mass > 0.0)
        .map(|node| {
            let speed = signal(node.velocity.unwrap());
            square(0.5 * node.mass, speed.value(duration), speed.error)
        })
        .sum();
    let rest: f64 = assembly
        .primitives
        .iter()
        .map(|part| {
            let tangent = part.element.tangent(0.0, 0.0);
            let way = signal(part.deformation);
            let stored = square(0.5 * tangent.stiffness, way.value(duration), way.error);
            let rate = signal(part.rate.unwrap());
            let whole = (0.0, duration);
            let speed = rate.integral_of(whole, &[0.0], f64::abs) / duration;
            square(tangent.damping * duration, speed, rate.error);
            stored + tangent.damping * rate.integral_of_product(&rate, whole)
        })
        .sum();
    let closure = (kinetic + rest - start).abs();
    let allowed = threshold + 1e-12 * start;
    assert!(allowed < 1e-3 * start, "case {case}: {threshold:e} of {start:e} says nothing");
    assert!(
        closure <= allowed,
        "case {case}: closure {closure:e} of {start:e}, allowed {allowed:e}, {recipe:?}"
    );
}

#[test]
fn the_order_of_nodes_and_elements_does_not_matter() {
    let mut dice = Dice(3);
    let exact = methods::by_name("exact").unwrap();
    let mut compared = 0;
    for case in 0..200 {
        let recipe = Recipe::draw(&mut dice, 8.0);
        if recipe.radians() > 1e3 {
            continue;
        }
        let mut order: Vec<usize> = (0..recipe.nodes.len()).collect();
        for at in (1..order.len()).rev() {
            order.swap(at, dice.below(at + 1));
        }
        let duration = recipe.duration();
        let one = recipe.build().compile(duration);
        let other = recipe.build_in_order(&order, true).compile(duration);
        let (Ok(one), Ok(other)) = (&one, &other) else {
            assert_eq!(one.is_err(), other.is_err(), "case {case}");
            continue;
        };
        let run = Run::to(duration);
        if exact.applies(&one.system, &run).is_err() {
            continue;
        }
        let [first, second] = [one, other]
            .map(|assembly| exact.integrate(&assembly.system, &run, &mut Silent).unwrap());
        // Entries of the two systems differ by a few roundings, which move a solution by at most
        // as many times the norm of the matrix and the duration.
        let norm: f64 = one.system.jacobian.values().iter().map(|value| value.abs()).sum();
        let roundings = 8.0 * f64::EPSILON * (1.0 + norm * duration / one.system.time_scale);
        let names = || (0..recipe.elements.len()).map(|at| format!("e{at}.force"));
        let force = |name: &String| first.signal(&one.system, one.output(name).unwrap());
        let scale = names().map(|name| force(&name).bound()).fold(0.0, f64::max);
        for name in names() {
            let a = force(&name);
            let b = second.signal(&other.system, other.output(&name).unwrap());
            let bound = a.error.unwrap() + b.error.unwrap() + roundings * scale;
            for step in 0..=20 {
                let t = duration * f64::from(step) / 20.0;
                let gap = (a.value(t) - b.value(t)).abs();
                assert!(gap <= bound, "case {case}, {name} at {t}: {gap:e} beyond {bound:e}");
            }
        }
        compared += 1;
    }
    assert!(compared > 100, "only {compared} were compared");
}
