//! Pads of layers with mass, in which waves travel.
//!
//! A layer of thickness `h`, area `A`, density `ρ` and stiffness `K` (`A/h` times the modulus `E`) has the mass `m = ρ
//! A h`. A wave crosses it in the time `√(m/K)`, with the speed `c = √(E/ρ) = h √(K/m)`, and has the impedance `Z = ρ c
//! A = √(m K)`, the force over the speed of the particles.
//!
//! To resolve it, a layer is cut into `n` equal segments with their masses at their centres. Between the centres stand
//! segments of the layer without mass, at its faces half ones, so that both faces are massless and the force on a face
//! is that of its half segment. Waves of the angular frequency `ω` travel too slowly in such a chain, by the part
//!
//! `1 − sin(x)/x ≈ (ω Δt)²/24`, with `x = ω Δt/2` and the time of passage `Δt` of one segment.
//!
//! That is an accuracy of what is smooth. Steps, as a body sends them into a layer that it strikes at
//! once, keep ripples however many segments there are; the network warns of them.
//!
//! In a layer that is not linear, waves have no speed of their own: it goes with the slope of the law
//! where the layer happens to be pressed, from nearly none on a plateau to that of a wall, and where
//! the law bends upwards fronts get steeper until they are as wide as a segment. So the number of
//! segments of such a layer is given, and not found from an accuracy.

use dashpot_rheology::{Branch, Tree};

use crate::{
    elements::Law,
    memory::{MOST_BYTES, PART_BYTES},
    model::{Model, stiffness::Stiffness},
    parameters::{InvalidParameter, Range},
};

/// One layer of a pad.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Its name, for instance that of its material.
    pub name: String,
    /// Thickness `h` \[m\], > 0.
    pub thickness: f64,
    /// Area `A` \[m²\], > 0.
    pub area: f64,
    /// Density `ρ` \[kg/m³\], ≥ 0; 0 is a layer without mass.
    pub density: f64,
    /// The law between its faces, as if it had no mass.
    pub model: Model,
}

/// A pad of layers in series, the impactor's side first.
#[derive(Debug, Clone)]
pub struct Layers {
    /// The layers, one or more.
    pub all: Vec<Layer>,
    /// How finely they are resolved.
    pub resolution: Resolution,
}

/// How finely a pad of layers is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Resolution {
    /// Into so many segments altogether, at least one for each layer with mass. They are shared out
    /// so that the longest time of passage of a segment is as short as possible.
    Segments(usize),
    /// Such that the speed of waves is right to this relative error, 0 … 1, up to the frequency
    /// [`Layers::frequency`]. Where waves have no speed of their own, because a layer with mass is
    /// not linear, none is said.
    Accuracy(f64),
}

/// A part of a layer that carries one force: what stands between two masses of a pad, or between a mass and a face.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Piece {
    /// Name of the layer.
    pub(crate) layer: String,
    /// Depth of its beginning below the first face of the pad \[m\].
    pub(crate) from: f64,
    /// Thickness \[m\].
    pub(crate) thickness: f64,
    /// Area \[m²\].
    pub(crate) area: f64,
}

/// A wave in a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Phase speed `c` \[m/s\].
    pub speed: f64,
    /// Time in which it crosses the layer \[s\].
    pub transit: f64,
    /// Size of the characteristic impedance `|Z| = √(m |K*|)` \[N s/m\].
    pub impedance: f64,
    /// Natural logarithm of the factor by which it gets weaker on its way through the layer.
    pub decay: f64,
}

/// No pad is cut into more segments.
pub const MOST_SEGMENTS: usize = 10_000;

impl Layer {
    /// Mass `m = ρ A h` \[kg\].
    pub fn mass(&self) -> f64 {
        self.density * self.area * self.thickness
    }

    /// The wave of small amplitude of the angular frequency `omega` > 0 \[rad/s\]; `None` in a layer
    /// without mass or stiffness, and in a rigid one. Elements that are not linear count with a
    /// typical slope, so that in a layer of such elements it is a scale and no wave.
    pub fn wave(&self, omega: f64) -> Option<Wave> {
        let (mass, stiffness) = (self.mass(), Stiffness::of(&self.model, omega));
        let slowness = (mass / stiffness.size()).sqrt();
        if !slowness.is_normal() {
            return None;
        }
        let (sine, cosine) = (0.5 * stiffness.angle()).sin_cos();
        let transit = slowness * cosine;
        Some(Wave {
            speed: self.thickness / transit,
            transit,
            impedance: (mass * stiffness.size()).sqrt(),
            decay: omega * slowness * sine,
        })
    }

    /// Whether its law is one of springs and dashpots, which waves cross at a speed of their own.
    pub(crate) fn is_linear(&self) -> bool {
        let linear = |law: Law| matches!(law, Law::Spring(_) | Law::Dashpot(_) | Law::Rigid);
        self.model.leaves().all(|element| linear(element.law()))
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        Range::Positive.check("thickness", self.thickness)?;
        Range::Positive.check("area", self.area)?;
        Range::NonNegative.check("density", self.density)
    }
}

impl Layers {
    /// Thickness of the pad \[m\].
    pub fn thickness(&self) -> f64 {
        self.all.iter().map(|layer| layer.thickness).sum()
    }

    /// Mass of the pad \[kg\].
    pub fn mass(&self) -> f64 {
        self.all.iter().map(Layer::mass).sum()
    }

    /// The law between the faces of the pad, as if it had no mass.
    pub fn model(&self) -> Model {
        match self.all.as_slice() {
            [only] => only.model.clone(),
            all => {
                let branch = |(at, layer): (usize, &Layer)| {
                    Branch::new(format!("{}-{}", layer.name, at + 1), layer.model.clone())
                };
                Tree::Series(all.iter().enumerate().map(branch).collect())
            }
        }
    }

    /// The angular frequency \[rad/s\] up to which waves are to be right in a pad that a body of `mass` \[kg\] strikes:
    /// the larger one of `√(K/mass)`, that of the impact, whose half period is the time of contact on a spring, and `π
    /// √(K/m)`, that of the first standing wave between the faces of a uniform pad of mass `m` that are held. `K` is
    /// the stiffness of the pad at this frequency. `None` for a pad without mass, without stiffness or rigid.
    pub fn frequency(&self, mass: Option<f64>) -> Option<f64> {
        let own = std::f64::consts::PI / self.mass().sqrt();
        let factor =
            mass.filter(|mass| *mass > 0.0).map_or(own, |mass| own.max(mass.sqrt().recip()));
        let mut omega = 1.0;
        // The stiffness rises with the frequency by a power from 0 to 1, so each round at least
        // halves the distance in decades.
        for _ in 0..64 {
            let of_layers = self.all.iter().map(|layer| Stiffness::of(&layer.model, omega));
            let stiffness = Stiffness::in_series(&of_layers.collect::<Vec<_>>());
            omega = factor * stiffness.size().sqrt();
            if !omega.is_normal() {
                return None;
            }
        }
        Some(omega)
    }

    /// How many segments each layer gets in a pad that a body of `mass` \[kg\] strikes; none for a layer without mass.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] where too few segments are asked for, or more than [`MOST_SEGMENTS`] are
    /// needed.
    pub fn segments(&self, mass: Option<f64>) -> Result<Vec<usize>, InvalidParameter> {
        let mut counts: Vec<usize> =
            self.all.iter().map(|layer| usize::from(layer.mass() > 0.0)).collect();
        let omega = self.frequency(mass);
        let transits = self.transits(omega);
        match self.resolution {
            Resolution::Segments(wanted) => {
                let least: usize = counts.iter().sum();
                if wanted < least || wanted > MOST_SEGMENTS {
                    let range = format!("from {least}, one for each layer, to {MOST_SEGMENTS}");
                    return Err(InvalidParameter::new("segments", range, wanted));
                }
                for _ in least..wanted {
                    share_out(&mut counts, &transits);
                }
            }
            Resolution::Accuracy(accuracy) => {
                if let Some(layer) = self.nonlinear() {
                    let range = format!(
                        "given, for instance 10: the layer {} is not linear, so that waves in it \
                         have no speed from which an accuracy could tell how many",
                        layer.name
                    );
                    return Err(InvalidParameter::new("segments", range, "left out"));
                }
                let longest = (24.0 * accuracy).sqrt() / omega.unwrap_or(0.0);
                let needed = transits.iter().map(|transit| (transit / longest).ceil().max(1.0));
                if needed.clone().sum::<f64>() > MOST_SEGMENTS as f64 {
                    let range = format!("such that {MOST_SEGMENTS} segments are enough");
                    return Err(InvalidParameter::new("accuracy", range, accuracy));
                }
                for (count, transit) in counts.iter_mut().zip(&transits) {
                    while *count > 0 && *transit > longest * *count as f64 {
                        *count += 1;
                    }
                }
            }
        }
        self.fit(&counts)?;
        Ok(counts)
    }

    /// Times \[s\] in which a wave of this angular frequency crosses each layer; 0 where none travels.
    fn transits(&self, omega: Option<f64>) -> Vec<f64> {
        let transit = |layer: &Layer| {
            let wave = omega.and_then(|omega| layer.wave(omega));
            wave.map_or(0.0, |wave| wave.transit)
        };
        self.all.iter().map(transit).collect()
    }

    /// The longest time \[s\] in which a wave crosses one of so many segments of each layer.
    pub(crate) fn passage(&self, mass: Option<f64>, counts: &[usize]) -> f64 {
        let transits = self.transits(self.frequency(mass));
        let cut = transits.iter().zip(counts).filter(|own| *own.1 > 0);
        cut.map(|(transit, &count)| transit / count as f64).fold(0.0, f64::max)
    }

    /// Refuses segments whose models take too much memory.
    fn fit(&self, counts: &[usize]) -> Result<(), InvalidParameter> {
        let sizes = self.all.iter().map(|layer| layer.model.size() as u64);
        let parts = sizes.zip(counts).map(|(size, &count)| size.saturating_mul(count as u64 + 1));
        let parts = parts.fold(0, u64::saturating_add);
        if parts.saturating_mul(PART_BYTES) <= MOST_BYTES {
            return Ok(());
        }
        let segments: usize = counts.iter().sum();
        let limit = MOST_BYTES / 1_000_000_000;
        let most = segments as u64 * (MOST_BYTES / PART_BYTES) / parts;
        Err(match self.resolution {
            Resolution::Segments(wanted) => {
                let range = format!("at most {most}: more would take over {limit} GB of memory");
                InvalidParameter::new("segments", range, wanted)
            }
            Resolution::Accuracy(accuracy) => {
                let range = format!(
                    "such that {most} segments are enough: more would take over {limit} GB"
                );
                InvalidParameter::new("accuracy", range, accuracy)
            }
        })
    }

    /// The first layer with mass that is not linear.
    fn nonlinear(&self) -> Option<&Layer> {
        self.all.iter().find(|layer| layer.mass() > 0.0 && !layer.is_linear())
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidParameter> {
        if self.all.is_empty() {
            return Err(InvalidParameter::new("layers", "one layer or more", "an empty list"));
        }
        self.all.iter().try_for_each(Layer::validate)?;
        match self.resolution {
            Resolution::Accuracy(accuracy) if !(accuracy > 0.0 && accuracy < 1.0) => {
                Err(InvalidParameter::new("accuracy", "more than 0 and less than 1", accuracy))
            }
            _ => Ok(()),
        }
    }
}

/// Gives one more segment to the layer whose segments are crossed in the longest time.
fn share_out(counts: &mut [usize], transits: &[f64]) {
    let time = |(count, transit): &(&mut usize, &f64)| **transit / **count as f64;
    let with_mass = counts.iter_mut().zip(transits).filter(|(count, _)| **count > 0);
    if let Some((count, _)) = with_mass.max_by(|a, b| time(a).total_cmp(&time(b))) {
        *count += 1;
    }
}
