//! Transmissibility of a shock.

use std::borrow::Cow;

use dashpot_dae::Signal;
use dashpot_network::{NodeOutputs, parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Needs, Reading, WINDOW,
    reading::{infinite, peak},
};
use crate::{Note, Solution};

parameters! {
    /// The largest acceleration of a node over that of another, `max |a|/max |a_from|`: what of a shock
    /// arrives, in time. Both are what accelerometers read; that of a node without mass whose motion is
    /// given is the second derivative of this.
    ///
    /// The answer to a sine of one frequency is that of `dashpot vibrate`.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Transmissibility: "transmissibility",
        "largest acceleration over that of another node [1]"
    {
        /// the other node, that of the shock
        pub from: String = Node;
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
    default { from: "head".to_owned(), window: WindowWish::Impact }
}

impl MeasureKind for Transmissibility {
    const UNIT: &'static str = "1";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let nodes = &solution.assembly().nodes;
        let Some(from) = nodes.iter().position(|node| node.name == self.from) else {
            return Reading::undefined(Note::NoNode(self.from.clone()));
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let mut peaks = [0.0; 2];
        let mut relative = Some(0.0);
        let mut answer = Reading::default();
        for (largest, node) in peaks.iter_mut().zip([from, target]) {
            let Some(signal) = acceleration(solution, &nodes[node]) else {
                return Reading::undefined(Note::Massless);
            };
            if let Some(reading) = infinite(&span, &solution.node_blows(node)) {
                return reading;
            }
            answer = peak(&signal, &span);
            *largest = answer.value.unwrap_or(0.0);
            relative = relative.zip(answer.error).map(|(sum, error)| sum + error / *largest);
        }
        let [of_shock, own] = peaks;
        if of_shock <= 0.0 {
            return Reading::undefined(Note::NotAccelerated(self.from.clone()));
        }
        let value = own / of_shock;
        let error = relative.map(|relative| if own > 0.0 { value * relative } else { 0.0 });
        Reading::over(&span, value, error)
            .at(answer.time.unwrap_or(span.to))
            .above(answer.noise / of_shock)
            .changing(answer.end_rate / of_shock)
    }
}

fn acceleration<'s>(solution: &'s Solution<'_>, node: &NodeOutputs) -> Option<Cow<'s, Signal>> {
    match (node.acceleration, node.velocity) {
        (Some(own), _) => Some(Cow::Borrowed(solution.signal(own))),
        (None, Some(velocity)) if !node.free => {
            Some(Cow::Owned(solution.signal(velocity).derivative()))
        }
        _ => None,
    }
}
