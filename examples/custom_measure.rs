//! A measure of one's own that honours windows, impulses and error bounds as those of the library do: the
//! mean force of an element over its impact.
//!
//! `cargo run --example custom_measure`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::{error::Error, f64::consts::PI};

use dashpot::{
    analysis::{
        MeasureKind, MeasureReport, MeasureTraits, MeasureWish, Note, Reading, Solution, Solve,
        SolveSettings, VelocityJump, measures::WINDOW,
    },
    network::{Network, Node, elements::Contact, parameters, parameters::WindowWish, spring},
};

parameters! {
    /// The mean force of an element, `∫ F dt / T` \[N\], with the impulses of masses that meet in it.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct MeanForce: "mean-force", "mean of the force over the window [N]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for MeanForce {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("N");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let force = solution.element_force(target)?;
        let span = solution.element_span(target, self.window)?;
        if span.length() <= 0.0 {
            return Err(Note::NoLength);
        }
        let jumps = VelocityJump::within(solution.element_jumps(target), span.window());
        let sum: f64 = jumps.iter().map(|jump| jump.impulse).sum();
        // The exact method finds the speeds at which masses meet to rounding.
        let error = force.error.map(|_| 1e-12 * sum);
        Ok(Reading::integral(force, &span).plus(sum, sum.abs(), error).mean(&span))
    }
}

/// The mean force of `element` in a network that runs for `duration` \[s\].
fn mean_force(
    network: &Network,
    (element, window): (&str, WindowWish),
    (method, duration): (&str, f64),
) -> Result<MeasureReport, Box<dyn Error>> {
    let mut settings = SolveSettings::lasting(duration).by_name(method)?;
    settings.measures.push(MeasureWish::new(element, MeanForce { window }));
    let report = network.solve_with(&settings)?;
    let measure = report.measure(&format!("{element}.mean-force")).ok_or("it is not reported")?;
    Ok(measure.clone())
}

pub fn main() -> Result<(), Box<dyn Error>> {
    // 2 kg at 3 m/s on 80 kN/m: half a period, in which the momentum turns round.
    let mut struck = Network::new();
    let head = struck.add_node(Node::mass("head", 2.0).moving(3.0));
    struck.connect("pad", head, struck.ground(), spring(80e3));
    let expected = 2.0 * 2.0 * 3.0 / (PI / 200.0);
    for method in ["exact", "bdf"] {
        let own = mean_force(&struck, ("pad", WindowWish::Impact), (method, 0.05))?;
        let (value, error) = own.value.zip(own.error).ok_or("no value")?;
        println!("{method:<6} {value:10.4} N ± {error:.1e} N");
        assert!((value - expected).abs() <= error, "{value} is not {expected}");
    }

    // 1 kg meets a rigid stop after 0.1 s, and comes back as fast: all of the force is one impulse.
    let mut thrown = Network::new();
    let ball = thrown.add_node(Node::mass("ball", 1.0).moving(2.0));
    let wall = Contact { gap: 0.2, restitution: 1.0 };
    thrown.connect("wall", ball, thrown.ground(), wall);
    let run = ("wall", WindowWish::Times(0.0, 0.4));
    let own = mean_force(&thrown, run, ("exact", 0.5))?;
    let (value, error) = own.value.zip(own.error).ok_or("no value")?;
    println!("wall   {value:10.4} N ± {error:.1e} N");
    assert!((value - 4.0 / 0.4).abs() <= error, "{value}");

    // A window of no length has no mean, and says so.
    let none = mean_force(&thrown, ("wall", WindowWish::Impact), ("exact", 0.5))?;
    assert_eq!((none.value, none.notes), (None, vec![Note::NoLength]));
    Ok(())
}
