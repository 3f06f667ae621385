//! The exact impact of chapter II, from its groups.

use dashpot_analysis::RunError;
use dashpot_dae::{Extremum, Method, Run, Signal, Silent, methods::Exact};
use dashpot_network::Network;

use crate::{Groups, Padding, Scales, Support, ThesisError};

/// τ* until which impacts are solved; 20 ms in chapter IV.
pub const DURATION: f64 = 10.0;

/// An impact without dimensions, over τ* from 0 to [`DURATION`], by the exact method. Impactor and
/// padding stay bonded, as in the thesis: after the release the padding pulls.
#[derive(Debug)]
pub struct Impact {
    /// Its groups.
    pub groups: Groups,
    force: Signal,
    deformation: Signal,
    rate: Signal,
    impactor_speed: Signal,
    release: Option<f64>,
}

impl Impact {
    /// The impact with these groups.
    ///
    /// # Errors
    ///
    /// [`ThesisError::Similarity`] where q ≤ 0; [`ThesisError::Run`] where the groups are no numbers
    /// that can be solved.
    pub fn of_groups(groups: &Groups) -> Result<Self, ThesisError> {
        Self::solve(groups, &groups.network(&Scales::UNIT)?)
    }

    /// The impact of chapter IV on a padding and a support in SI units.
    ///
    /// # Errors
    ///
    /// As [`of_groups`](Self::of_groups).
    pub fn of_system(padding: &Padding, support: &Support) -> Result<Self, ThesisError> {
        Self::of_groups(&Groups::of(&Scales::CHAPTER_4, padding, support))
    }

    /// The impact of a network with the nodes and elements of [`Groups::network`] and unit scales.
    ///
    /// # Errors
    ///
    /// [`ThesisError::Run`] where the network cannot be solved.
    pub fn solve(groups: &Groups, network: &Network) -> Result<Self, ThesisError> {
        let assembly = network.compile(DURATION)?;
        let trajectory = Exact.integrate(&assembly.system, &Run::to(DURATION), &mut Silent)?;
        let signal = |name: &str| {
            let outputs = assembly.system.outputs.iter();
            let known = || outputs.map(|output| output.name.to_string()).collect();
            let none = || RunError::UnknownOutput { output: name.to_owned(), known: known() };
            assembly.output(name).map(|at| trajectory.signal(&assembly.system, at)).ok_or_else(none)
        };
        let force = signal("padding.force")?;
        let release = force.first_crossing(0.0, (0.0, DURATION), Some(false)).map(|own| own.time);
        Ok(Self {
            groups: *groups,
            deformation: signal("padding.deformation")?,
            rate: signal("padding.rate")?,
            impactor_speed: signal("head.velocity")?,
            force,
            release,
        })
    }

    /// Force φ at τ*.
    pub fn force(&self, time: f64) -> f64 {
        self.force.value(time)
    }

    /// Deformation ξ at τ*.
    pub fn deformation(&self, time: f64) -> f64 {
        self.deformation.value(time)
    }

    /// Speed of the impactor ζ′ at τ*.
    pub fn impactor_speed(&self, time: f64) -> f64 {
        self.impactor_speed.value(time)
    }

    /// τ* at which the force turns to tension; `None` where it does not.
    pub fn release(&self) -> Option<f64> {
        self.release
    }

    /// End of the impact: the release, or else that of the solution.
    pub fn end(&self) -> f64 {
        self.release.unwrap_or(DURATION)
    }

    /// The largest force before the release.
    pub fn peak(&self) -> Extremum {
        self.force.maximum((0.0, self.end()))
    }

    /// The largest deformation before the release, of all local maxima.
    pub fn deepest(&self) -> Extremum {
        self.deformation.maximum((0.0, self.end()))
    }

    /// The local maxima of the deformation before the release.
    pub fn maxima_of_deformation(&self) -> Vec<Extremum> {
        let all = self.deformation.extrema((0.0, self.end()));
        let is_maximum = |at: usize| {
            let least = |other: Option<&Extremum>| other.is_none_or(|o| o.value < all[at].value);
            least(at.checked_sub(1).and_then(|before| all.get(before))) && least(all.get(at + 1))
        };
        (0..all.len()).filter(|at| is_maximum(*at)).map(|at| all[at]).collect()
    }

    /// The first τ* at which the deformation is the thickness; `None` where it stays below.
    pub fn meets_thickness(&self) -> Option<f64> {
        self.deformation.first_crossing(1.0, (0.0, DURATION), Some(true)).map(|own| own.time)
    }

    /// Energy ω that has gone into the padding until τ* (3.57).
    pub fn energy(&self, time: f64) -> f64 {
        self.energy_between(0.0, time)
    }

    /// Energy that goes into the padding between two times.
    pub fn energy_between(&self, from: f64, to: f64) -> f64 {
        self.force.integral_of_product(&self.rate, (from, to))
    }

    /// `∫ φ^n dτ` until the release, with which the severity index is made.
    pub fn integral_of_power(&self, exponent: f64) -> f64 {
        self.force.integral_of((0.0, self.end()), &[0.0], |own| own.abs().powf(exponent))
    }

    /// Energy that goes into the padding after the release, until [`DURATION`]; 0 where there is none.
    pub fn energy_after_release(&self) -> f64 {
        self.release.map_or(0.0, |release| self.energy_between(release, DURATION))
    }

    /// Slope dφ/dξ of the stress–strain curve at τ*.
    pub fn slope(&self, time: f64) -> f64 {
        self.force.slope(time) / self.rate.value(time)
    }

    /// φ″ at τ*.
    pub fn curvature(&self, time: f64) -> f64 {
        self.force.derivative().slope(time)
    }

    /// The first τ* after the peak at which the force is down to a share of the peak.
    pub fn decays_to(&self, share: f64) -> Option<f64> {
        let peak = self.peak();
        let level = share * peak.value;
        self.force.first_crossing(level, (peak.time, self.end()), Some(false)).map(|own| own.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_deformation_is_that_of_all_maxima() {
        // Between b = 52 and 54 two maxima swap places.
        for (b, time) in [(52.0, 1.64), (54.0, 3.1)] {
            let own = Impact::of_groups(&Groups { b, ..Groups::PRINTED }).unwrap();
            assert!((own.deepest().time - time).abs() < 0.05, "{b}: {:?}", own.deepest());
            let all = own.maxima_of_deformation();
            assert_eq!(all.len(), 2, "{all:?}");
            let most = all.iter().map(|own| own.value).fold(0.0, f64::max);
            assert!((most - own.deepest().value).abs() < 1e-14);
        }
    }

    #[test]
    fn groups_without_a_padding_are_refused() {
        let error = Impact::of_groups(&Groups { a: 10.0, ..Groups::PRINTED }).unwrap_err();
        assert!(error.to_string().contains("q = "), "{error}");
    }

    #[test]
    fn the_curves_begin_as_their_equations_say() {
        let own = Impact::of_groups(&Groups::PRINTED).unwrap();
        let Groups { a, c, d, .. } = own.groups;
        assert!((own.slope(0.0) - c).abs() < 1e-9);
        assert!((own.curvature(0.0) - (d - a * c)).abs() < 1e-7 * a * c, "{}", own.curvature(0.0));
        assert!(own.meets_thickness().is_none());
    }
}
