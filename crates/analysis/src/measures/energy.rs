//! Energy taken up.

use dashpot_dae::Signal;
use dashpot_network::{ConnectionOutputs, PrimitiveOutputs, parameters, parameters::WindowWish};

use super::{MeasureKind, MeasureTraits, Reading, reading::moved};
use crate::{
    Note, Solution, VelocityJump,
    energy::{
        ledger,
        roles::{self, EnergyRole},
    },
    impact::interval::Span,
};

windowed! {
    /// The energy that an element takes up, `∫ F ẏ dt` \[J\]: at the end of an impact what it has not
    /// given back, be it stored or dissipated.
    ///
    /// Where a prescribed motion or a load jumps, the jump of the stored energy is counted; where masses
    /// meet in the element, the energy that the impact loses. What it holds as the run begins is not: of a load
    /// or motion that is there from the start on, and of what has no mass, that is all that they do at once.
    Energy: "energy", "energy taken up by the element during the window [J]"
}

impl MeasureKind for Energy {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("J").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let force = solution.element_force(target)?;
        let span = solution.element_span(target, self.window)?;
        Ok(work(solution, (target, force), &span))
    }
}

parameters! {
    /// The energy that an element has taken up at the end of the run, `∫ F ẏ dt` over all of it \[J\];
    /// otherwise as [`Energy`].
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct EnergyAtEnd: "energy-at-end",
        "energy taken up by the element until the end of the run [J]"
    {}
}

impl MeasureKind for EnergyAtEnd {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("J").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        MeasureKind::read(&Energy { window: WindowWish::Run }, solution, target)
    }
}

/// The work that an element takes up over a span, `∫ F ẏ dt`, what jumps of its deformation store,
/// and what impacts in it lose.
fn work(solution: &Solution<'_>, (target, force): (usize, &Signal), span: &Span) -> Reading {
    let connection = &solution.assembly().connections[target];
    let rate = solution.rate_of(connection);
    let window = span.window();
    let last = (force.left_value(span.to) * rate.left_value(span.to)).abs();
    let (value, error) = if span.length() <= 0.0 {
        (0.0, Some(0.0))
    } else if connection.has_layers
        || rate.error.is_none()
        || !solution.has_rate(connection)
        || has_only_springs(solution, connection)
    {
        work_of_parts(solution, connection, window)
    } else {
        let steps = ledger::steps(solution, connection.primitives.clone(), window);
        let work = force.integral_of_product(&rate, window) + steps;
        (work, ledger::work_error(force, &rate, window))
    };
    let error = error.zip(span.to_error).map(|(error, shift)| error + moved(last, shift));
    let magnitude = |signal: &Signal| signal.absolute_maximum(window).value;
    let most_force = magnitude(force);
    // What a spring of this peak force and deformation takes up, and may give back.
    let deformation = solution.glance(connection.deformation);
    let deformation = if connection.never_pulls {
        deformation.maximum(window).value.max(0.0)
    } else {
        magnitude(&deformation)
    };
    let area = |signal: &Signal| signal.area_bound(window);
    let noise = force.noise * area(&rate) + rate.noise * area(force);
    let jumps = VelocityJump::within(solution.element_jumps(target), window);
    let lost: f64 = jumps.iter().map(|jump| jump.lost).sum();
    let push: f64 = jumps.iter().map(|jump| jump.impulse).sum();
    // What is lost changes with the speeds by no more than the impulse.
    let of_approach = if lost == 0.0 { None } else { solution.approach(connection).error };
    let error_of_lost = of_approach.map(|error| push * error);
    let reading = Reading::over(span, value, error)
        .of_size(0.5 * most_force * deformation)
        .above(noise)
        .changing(last);
    reading.plus(lost, lost.abs(), error_of_lost)
}

/// Whether an element is made of springs alone, and contacts that do no work: then its work is a matter of
/// both ends of the window, and errors on the way do not add up.
fn has_only_springs(solution: &Solution<'_>, connection: &ConnectionOutputs) -> bool {
    let parts = solution.assembly().primitives.get(connection.primitives.clone());
    let is_spring = |part: &PrimitiveOutputs| {
        let own = EnergyRole::of(part.element.as_ref());
        own.stores && !own.dissipates
    };
    parts.is_some_and(|parts| parts.iter().all(|part| is_spring(part) || !ledger::does_work(part)))
}

/// The work \[J\] that an element takes up as the sum over its parts, and a bound of its error: in
/// networks that switch, where elements have no rate of their own, of springs alone, and of layers with
/// masses between them, which do not all feel one force.
fn work_of_parts(
    solution: &Solution<'_>,
    connection: &ConnectionOutputs,
    window: (f64, f64),
) -> (f64, Option<f64>) {
    let primitives = solution.assembly().primitives.get(connection.primitives.clone());
    let (mut work, mut bound) = (0.0, Some(0.0));
    for primitive in primitives.unwrap_or(&[]) {
        let own = EnergyRole::of(primitive.element.as_ref());
        let error = if own.dissipates {
            let force = &solution.glance(primitive.force);
            let rate = solution.rate(primitive.rate, primitive.deformation);
            if ledger::does_work(primitive) {
                work += force.integral_of_product(&rate, window);
                ledger::work_error(force, &rate, window)
            } else {
                Some(0.0)
            }
        } else if own.stores {
            let deformation = solution.glance(primitive.deformation);
            let stored = |time, y| roles::stored(solution.run(), primitive, time, y);
            let (from, to) = (deformation.value(window.0), deformation.left_value(window.1));
            work += stored(window.1, to) - stored(window.0, from);
            // No force in between is larger than those at both sides: they rise with the deformation.
            let at = |y: f64, error: f64| {
                let force = |y: f64| primitive.element.force(y, 0.0).abs();
                error * force(y - error).max(force(y + error))
            };
            deformation.error.map(|error| at(from, error) + at(to, error))
        } else {
            Some(0.0)
        };
        bound = bound.zip(error).map(|(sum, error)| sum + error);
    }
    (work, bound)
}
