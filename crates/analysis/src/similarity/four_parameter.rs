//! The groups of the thesis, for impacts of its form.

mod read;

use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Touch},
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::{Branch, Tree};

use super::SimilarityError;

/// An impact of the thesis' form: a mass `m1` at the speed `V0` on a four-parameter padding, whose
/// face may have a mass `m2`, on a mass `m3` that a spring and a dashpot hold to the ground.
///
/// Any linear padding that is a spring, a dashpot and one Kelvin–Voigt element in a row from outside
/// counts as a four-parameter one, two Maxwell elements side by side, for instance.
#[derive(Debug, Clone, PartialEq)]
pub struct FourParameterImpact {
    /// Names of the impactor, the padding, the support and its mount.
    pub names: [String; 4],
    /// Mass of the impactor m₁ \[kg\].
    pub mass: f64,
    /// Its speed V₀ \[m/s\].
    pub speed: f64,
    /// Thickness of the padding δ \[m\].
    pub thickness: f64,
    /// Mass of the face of the padding m₂ \[kg\], ≥ 0.
    pub face_mass: f64,
    /// Gravitational acceleration g \[m/s²\]; 0 where gravity is off.
    pub gravity: f64,
    /// Spring of the Kelvin–Voigt element K₁ \[N/m\].
    pub k1: f64,
    /// Dashpot of the Kelvin–Voigt element C₁ \[N s/m\].
    pub c1: f64,
    /// Spring in a row K₂ \[N/m\].
    pub k2: f64,
    /// Dashpot in a row C₂ \[N s/m\].
    pub c2: f64,
    /// Mass of the support m₃ \[kg\].
    pub support_mass: f64,
    /// Spring of the mount K₃ \[N/m\], ≥ 0.
    pub support_stiffness: f64,
    /// Dashpot of the mount C₃ \[N s/m\], ≥ 0.
    pub support_damping: f64,
}

/// The nine groups of the thesis (2.27–2.36), with `J = δ/V0`, and `p1…p4`, of which `a…d` are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourParameterGroups {
    /// Gravity, `A = B g δ/V0²`.
    pub gravity: f64,
    /// Share of the impactor in the moving mass, `B = m1/(m1 + m2)`, 0 … 1.
    pub share: f64,
    /// `a = (1 + p1 + p2) p3/p1`.
    pub a: f64,
    /// `b = p2 p3²/p1`.
    pub b: f64,
    /// `c = p3/p4 = K2 J²/m1`; the start slope e is the same.
    pub c: f64,
    /// `d = b/p4`.
    pub d: f64,
    /// `α = J C3/m3`.
    pub alpha: f64,
    /// `β = J² K3/m3`.
    pub beta: f64,
    /// `γ = m1/m3`.
    pub gamma: f64,
}

/// The open ranges of `a`, `b`, `c` and `d`, each with the others as they are, in which there is a
/// padding; `None` where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ranges {
    /// That of `a`, which has no upper end.
    pub a: (f64, f64),
    /// That of `b`.
    pub b: Option<(f64, f64)>,
    /// That of `c`.
    pub c: Option<(f64, f64)>,
    /// That of `d`.
    pub d: Option<(f64, f64)>,
}

impl FourParameterImpact {
    /// Reads a network of this form.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::OtherForm`], and what is different.
    pub fn of(network: &Network) -> Result<Self, SimilarityError> {
        read::read(network).map_err(|reason| SimilarityError::OtherForm { reason })
    }

    /// `J = δ/V0` \[s\].
    pub fn time(&self) -> f64 {
        self.thickness / self.speed
    }

    /// `p1 = C1/C2`, `p2 = K1/K2`, `p3 = K2 J/C2`, `p4 = m1/(J C2)`.
    pub fn ratios(&self) -> [f64; 4] {
        let time = self.time();
        [
            self.c1 / self.c2,
            self.k1 / self.k2,
            self.k2 * time / self.c2,
            self.mass / (time * self.c2),
        ]
    }

    /// Its groups.
    pub fn groups(&self) -> FourParameterGroups {
        let (time, [p1, p2, p3, p4]) = (self.time(), self.ratios());
        let share = self.mass / (self.mass + self.face_mass);
        let b = p2 * p3 * p3 / p1;
        FourParameterGroups {
            gravity: share * self.gravity * self.thickness / (self.speed * self.speed),
            share,
            a: (1.0 + p1 + p2) * p3 / p1,
            b,
            c: p3 / p4,
            d: b / p4,
            alpha: time * self.support_damping / self.support_mass,
            beta: time * time * self.support_stiffness / self.support_mass,
            gamma: self.mass / self.support_mass,
        }
    }

    /// The impact with other groups and the same `m1`, `V0` and `δ`: `K2 = c m1/J²`,
    /// `C2 = d m1/(b J)`, `C1 = c m1/(q J)`, `K1 = d m1/(q J²)` (appendix D, its misprints mended).
    ///
    /// # Errors
    ///
    /// [`SimilarityError::NoPadding`] where `q ≤ 0` or one of `b`, `c`, `d` is not positive.
    pub fn with_groups(&self, groups: &FourParameterGroups) -> Result<Self, SimilarityError> {
        let FourParameterGroups { b, c, d, .. } = *groups;
        let q = groups.q();
        if !(q > 0.0 && b > 0.0 && c > 0.0 && d > 0.0 && q.is_finite()) {
            return Err(SimilarityError::NoPadding { q });
        }
        let (time, mass) = (self.time(), self.mass);
        let support_mass = mass / groups.gamma;
        Ok(Self {
            face_mass: (mass / groups.share - mass).max(0.0),
            gravity: groups.gravity * self.speed * self.speed / (groups.share * self.thickness),
            k1: d * mass / (q * time * time),
            c1: c * mass / (q * time),
            k2: c * mass / (time * time),
            c2: d * mass / (b * time),
            support_mass,
            support_stiffness: groups.beta * support_mass / (time * time),
            support_damping: groups.alpha * support_mass / time,
            ..self.clone()
        })
    }

    /// The impact as a network. A face with mass begins with the speed of the impactor, as in the
    /// thesis, and gravity with the support in balance.
    pub fn network(&self) -> Network {
        let [impactor, padding, support, mount] = &self.names;
        let mut network = Network::new();
        let head = network.add_node(Node::mass(&**impactor, self.mass).moving(self.speed));
        let panel = network.add_node(Node::mass(&**support, self.support_mass));
        let model = Tree::Series(vec![
            Branch::new("spring", part(Spring { stiffness: self.k2 })),
            Branch::new("dashpot", part(Dashpot { damping: self.c2 })),
            Branch::new("parallel", kelvin(self.k1, self.c1)),
        ]);
        network.connect(&**padding, head, panel, model).thickness = Some(self.thickness);
        let holder = kelvin(self.support_stiffness, self.support_damping);
        network.connect(&**mount, panel, network.ground(), holder);
        if self.face_mass > 0.0 {
            let (element, at) = (padding.clone(), Some(impactor.clone()));
            let touch = Touch::Moving;
            network.add_effect(Face { element, mass: self.face_mass, at, touch });
        }
        if self.gravity != 0.0 {
            let (acceleration, start) = (self.gravity, GravityStart::Equilibrium);
            network.add_effect(Gravity { acceleration, start });
        }
        network
    }
}

impl FourParameterGroups {
    /// `q = a − b c/d − d/c`; there is a padding only where it is positive.
    pub fn q(&self) -> f64 {
        self.a - self.b * self.c / self.d - self.d / self.c
    }

    /// Where there is a padding.
    pub fn ranges(&self) -> Ranges {
        let Self { a, b, c, d, .. } = *self;
        // q > 0 is a quadratic in c and in d; the smaller root is a quotient, so that nothing cancels.
        let root = (a * a - 4.0 * b).sqrt();
        let between = |from: f64, to: f64| (from < to).then_some((from, to));
        let of_c = between(2.0 * d / (a + root), d * (a + root) / (2.0 * b));
        let of_d = between(2.0 * b * c / (a + root), c * (a + root) / 2.0);
        let most = (a - d / c) * d / c;
        Ranges { a: (b * c / d + d / c, f64::INFINITY), b: between(0.0, most), c: of_c, d: of_d }
    }

    /// The groups with others in place of those named `A`, `B`, `a`, `b`, `c`, `d`, `alpha`, `beta`,
    /// `gamma` (or `α`, `β`, `γ`).
    ///
    /// # Errors
    ///
    /// [`SimilarityError::UnknownQuantity`] for any other name.
    pub fn with(mut self, name: &str, value: f64) -> Result<Self, SimilarityError> {
        let place = match name {
            "A" => &mut self.gravity,
            "B" => &mut self.share,
            "a" => &mut self.a,
            "b" => &mut self.b,
            "c" | "e" => &mut self.c,
            "d" => &mut self.d,
            "alpha" | "α" => &mut self.alpha,
            "beta" | "β" => &mut self.beta,
            "gamma" | "γ" => &mut self.gamma,
            _ => {
                let known = ["A", "B", "a", "b", "c", "d", "alpha", "beta", "gamma"];
                let known = known.map(str::to_owned).to_vec();
                return Err(SimilarityError::UnknownQuantity { name: name.to_owned(), known });
            }
        };
        *place = value;
        Ok(self)
    }
}

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Tree::Parallel(vec![
        Branch::new("spring", part(Spring { stiffness })),
        Branch::new("dashpot", part(Dashpot { damping })),
    ])
}
