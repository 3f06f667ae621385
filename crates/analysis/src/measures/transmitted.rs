//! What arrives behind a padding, or at another node.

use std::borrow::Cow;

use dashpot_dae::Signal;
use dashpot_network::{
    Assembly, ConnectionOutputs, NodeId, NodeOutputs, parameters, parameters::WindowWish,
};

use super::{MeasureKind, MeasureTraits, Reading, WINDOW, reading::peaks_below_zero};
use crate::{Note, Solution};

windowed! {
    /// The largest magnitude of the force of a padding on what lies behind it, `max |F(t)|` \[N\], with
    /// its time; a peak in tension is noted.
    ///
    /// It is the force on the second of the nodes in `between`, through everything of the padding: the
    /// element, its stop, and a face at that end with its mass. A stop adds to it and not to
    /// [`PeakForce`](super::PeakForce), which is that of the element alone. In pads of layers with mass,
    /// through which the force travels, it comes later and has another size. Where masses meet in any of
    /// these and speeds jump, it is infinite.
    TransmittedForce: "transmitted-force",
        "largest magnitude of the force on what lies behind it, its stop included [N]"
}

impl MeasureKind for TransmittedForce {
    const ABOUT: MeasureTraits =
        MeasureTraits { of_layers: true, ..MeasureTraits::of_element::<Self>("N") };

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let connections = &solution.assembly().connections;
        let parts = on_support(solution.assembly(), target);
        let mut sum: Option<Signal> = None;
        for &(part, sign) in &parts {
            let connection = &connections[part];
            let force = if part == target { connection.transmitted } else { connection.force };
            let force = solution.signal(force.ok_or(Note::NoForce)?);
            sum = Some(sum.map_or_else(|| force.scaled(sign), |sum| sum.plus(force, sign)));
        }
        let force = sum.ok_or(Note::NoForce)?;
        let span = solution.element_span(target, self.window)?;
        let mut jumps = parts.iter().map(|&(part, _)| solution.element_jumps(part));
        if let Some(reading) = jumps.find_map(|jumps| Reading::infinite(&span, jumps)) {
            return Ok(reading);
        }
        let reading = Reading::peak(&force, &span);
        Ok(reading.noting_if(peaks_below_zero(&force, &span), Note::InTension))
    }
}

/// The connections of a padding that act on the node behind it, each with the sign of its force
/// there: the element itself, or the contact of a face at this end, and a stop that by-passes it.
fn on_support(assembly: &Assembly, element: usize) -> Vec<(usize, f64)> {
    let own = &assembly.connections[element];
    let ends = |connection: &ConnectionOutputs| connection.between.map(NodeId::index);
    let last = ends(own)[1];
    let pad = assembly.pad(element);
    let (contact, stop) = pad.map_or((None, None), |pad| (pad.contact, pad.stop));
    let behind_face = contact.filter(|_| pad.is_some_and(|pad| pad.face == Some(last)));
    let support = behind_face.map_or(last, |contact| ends(&assembly.connections[contact])[1]);
    let sign = |&at: &usize| {
        let [from, to] = ends(&assembly.connections[at]);
        match (from == support, to == support) {
            (false, true) => Some((at, 1.0)),
            (true, false) => Some((at, -1.0)),
            _ => None,
        }
    };
    [Some(element), contact, stop].into_iter().flatten().filter_map(|at| sign(&at)).collect()
}

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
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("1");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let nodes = &solution.assembly().nodes;
        let Some(from) = nodes.iter().position(|node| node.name == self.from) else {
            return Err(Note::NoNode(self.from.clone()));
        };
        let span = solution.node_span(target, self.window)?;
        let mut peaks = [0.0; 2];
        let mut relative = Some(0.0);
        let mut answer = Reading::default();
        for (largest, node) in peaks.iter_mut().zip([from, target]) {
            let signal = acceleration(solution, &nodes[node]).ok_or(Note::Massless)?;
            if let Some(reading) = Reading::infinite(&span, &solution.node_jumps(node)) {
                return Ok(reading);
            }
            answer = Reading::peak(&signal, &span);
            *largest = answer.value.unwrap_or(0.0);
            relative = relative.zip(answer.error).map(|(sum, error)| sum + error / *largest);
        }
        let [of_shock, own] = peaks;
        if of_shock <= 0.0 {
            return Err(Note::NotAccelerated(self.from.clone()));
        }
        let value = own / of_shock;
        let error = relative.map(|relative| if own > 0.0 { value * relative } else { 0.0 });
        Ok(Reading::over(&span, value, error)
            .at(answer.time.unwrap_or(span.to))
            .above(answer.noise / of_shock)
            .changing(answer.end_rate / of_shock))
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
