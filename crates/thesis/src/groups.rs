//! The thesis' groups (2.27 to 2.36, appendices C and D with their misprints mended).

use dashpot_dae::Waveform;
use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::{Branch, Tree};

/// The groups of an impact; all ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Groups {
    /// Gravity, `A = B g δ/V₀²`.
    pub gravity: f64,
    /// Share of the impactor in the moving mass, `B = m₁/(m₁ + m₂)`, 0 … 1.
    pub share: f64,
    /// `a = (K₂ J/C₁)(1 + K₁/K₂ + C₁/C₂)`, J = δ/V₀.
    pub a: f64,
    /// `b = K₁ K₂ J²/(C₁ C₂)`.
    pub b: f64,
    /// `c = K₂ J²/m₁`, and e, the start slope of the force.
    pub c: f64,
    /// `d = K₁ K₂ J³/(C₁ m₁)`.
    pub d: f64,
    /// `α = C₃ J/m₃`.
    pub alpha: f64,
    /// `β = K₃ J²/m₃`.
    pub beta: f64,
    /// `γ = m₁/m₃`.
    pub gamma: f64,
}

/// The spring and dashpot parameters of a four-parameter padding, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Padding {
    /// Spring of the Kelvin element K₁ \[N/m\].
    pub k1: f64,
    /// Dashpot of the Kelvin element C₁ \[N s/m\].
    pub c1: f64,
    /// Spring in a row K₂ \[N/m\].
    pub k2: f64,
    /// Dashpot in a row C₂ \[N s/m\].
    pub c2: f64,
}

/// What the groups refer to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Mass of the impactor m₁ \[kg\], > 0.
    pub mass: f64,
    /// Its speed V₀ \[m/s\], > 0.
    pub speed: f64,
    /// Thickness of the padding δ \[m\], > 0.
    pub thickness: f64,
}

impl Scales {
    /// m₁ = V₀ = δ = 1: deformation, force and time are ξ, φ and τ*.
    pub const UNIT: Self = Self { mass: 1.0, speed: 1.0, thickness: 1.0 };
    /// Those of chapter IV.
    pub const CHAPTER_4: Self = Self { mass: 10.0, speed: 10.0, thickness: 0.02 };

    /// J = δ/V₀ \[s\].
    pub fn time(&self) -> f64 {
        self.thickness / self.speed
    }

    /// m₁ V₀²/δ \[N\].
    pub fn force(&self) -> f64 {
        self.mass * self.speed * self.speed / self.thickness
    }
}

/// The support m₃, K₃, C₃ in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// m₃ \[kg\].
    pub mass: f64,
    /// K₃ \[N/m\].
    pub stiffness: f64,
    /// C₃ \[N s/m\].
    pub damping: f64,
}

impl Groups {
    /// The groups that chapter IV prints; α = 0.2 stands for C₃ = 10 kN s/m.
    pub const PRINTED: Self = Self {
        gravity: 0.0,
        share: 1.0,
        a: 26.6,
        b: 66.66,
        c: 8.0,
        d: 80.0,
        alpha: 0.2,
        beta: 2.0,
        gamma: 0.1,
    };

    /// The groups of an impact without gravity and without a mass m₂ on the padding.
    pub fn of(scales: &Scales, padding: &Padding, support: &Support) -> Self {
        let Padding { k1, c1, k2, c2 } = *padding;
        let (j, m1) = (scales.time(), scales.mass);
        Self {
            gravity: 0.0,
            share: 1.0,
            a: k2 * j / c1 * (1.0 + k1 / k2 + c1 / c2),
            b: k1 / c1 * (k2 / c2) * j * j,
            c: k2 * j * j / m1,
            d: k1 / c1 * k2 * j * j * j / m1,
            alpha: support.damping * j / support.mass,
            beta: support.stiffness * j * j / support.mass,
            gamma: m1 / support.mass,
        }
    }

    /// `q = a − b c/d − d/c`: only where it is positive there is a padding with these groups.
    pub fn q(&self) -> f64 {
        self.a - self.b * self.c / self.d - self.d / self.c
    }

    /// The padding with these groups (appendix D): K₂ = c m₁/J², C₂ = d m₁/(b J), C₁ = c m₁/(q J),
    /// K₁ = d m₁/(q J²). `None` where q ≤ 0.
    pub fn padding(&self, scales: &Scales) -> Option<Padding> {
        let q = self.q();
        let (j, m1) = (scales.time(), scales.mass);
        (q > 0.0).then(|| Padding {
            k1: self.d * m1 / (q * j * j),
            c1: self.c * m1 / (q * j),
            k2: self.c * m1 / (j * j),
            c2: self.d * m1 / (self.b * j),
        })
    }

    /// The range of c in which a padding exists, others as they are: `b c²/d − a c + d < 0`.
    pub fn range_of_c(&self) -> Option<(f64, f64)> {
        let Self { a, b, d, .. } = *self;
        let root = (a * a - 4.0 * b).sqrt();
        // The smaller root as a quotient, so that nothing cancels.
        (root > 0.0).then(|| (2.0 * d / (a + root), d * (a + root) / (2.0 * b)))
    }

    /// The support with these groups.
    pub fn support(&self, scales: &Scales) -> Support {
        let (j, mass) = (scales.time(), scales.mass / self.gamma);
        Support { mass, stiffness: self.beta * mass / (j * j), damping: self.alpha * mass / j }
    }

    /// The impact with these groups: `head` on `padding` on `panel` on `mount`. `None` where q ≤ 0.
    ///
    /// The weight acts on the impactor alone; that of the support is borne by its spring from the
    /// beginning, as in 2.9.
    pub fn network(&self, scales: &Scales) -> Option<Network> {
        Some(self.network_with(scales, self.padding(scales)?.model()))
    }

    /// The same with another model as the padding.
    pub fn network_with(&self, scales: &Scales, padding: Model) -> Network {
        let support = self.support(scales);
        let mut network = Network::new();
        let moving = scales.mass / self.share;
        let head = network.add_node(Node::mass("head", moving).moving(scales.speed));
        let panel = network.add_node(Node::mass("panel", support.mass));
        network.connect("padding", head, panel, padding).thickness = Some(scales.thickness);
        let mount = kelvin(support.stiffness, support.damping);
        network.connect("mount", panel, network.ground(), mount);
        if self.gravity > 0.0 {
            let acceleration = self.gravity * scales.speed * scales.speed / scales.thickness;
            network.add_load("weight", head, Waveform::constant(moving * acceleration));
        }
        network
    }
}

impl Support {
    /// That of chapter IV with C₃ = 10 kN s/m, for which α is the 0.2 that is printed.
    pub const CHAPTER_4: Self = Self { mass: 100.0, stiffness: 50e6, damping: 10e3 };
    /// With the C₃ that chapter IV prints, for which α is 200.
    pub const CHAPTER_4_STIFF: Self = Self { damping: 10e6, ..Self::CHAPTER_4 };
}

impl Padding {
    /// That of chapter IV, Valox 310.
    pub const CHAPTER_4: Self = Self { k1: 20e6, c1: 4e3, k2: 20e6, c2: 6e3 };

    /// K₂ and C₂ in a row with K₁ ∥ C₁, K₂ on the impactor's side.
    pub fn model(&self) -> Model {
        let spring = part(Spring { stiffness: self.k2 });
        let dashpot = part(Dashpot { damping: self.c2 });
        Tree::series([spring, dashpot, kelvin(self.k1, self.c1)])
    }
}

/// A spring and a dashpot in a row.
pub(crate) fn maxwell(stiffness: f64, damping: f64) -> Model {
    Tree::series([part(Spring { stiffness }), part(Dashpot { damping })])
}

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Tree::Parallel(vec![
        Branch::new("spring", part(Spring { stiffness })),
        Branch::new("dashpot", part(Dashpot { damping })),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-13 * expected.abs(), "{found} is not {expected}");
    }

    fn chapter_4() -> Groups {
        Groups::of(&Scales::CHAPTER_4, &Padding::CHAPTER_4, &Support::CHAPTER_4)
    }

    #[test]
    fn the_groups_of_chapter_4_are_those_of_2_29_to_2_40() {
        let own = chapter_4();
        let (p1, p2, p3, p4) = (4.0 / 6.0, 1.0, 20e6 * 0.02 / 6e4, 100.0 / 120.0);
        near(own.a, (1.0 + p1 + p2) * p3 / p1);
        near(own.b, p2 * p3 * p3 / p1);
        near(own.c, p3 / p4);
        near(own.d, own.b / p4);
        near(own.a, 80.0 / 3.0);
        near(own.b, 200.0 / 3.0);
        near(own.alpha, 0.2);
        near(own.beta, 2.0);
        near(own.gamma, 0.1);
    }

    #[test]
    fn padding_and_support_come_back_from_their_groups() {
        let scales = Scales { mass: 3.0, speed: 7.0, thickness: 0.05 };
        let pad = Padding { k1: 3e5, c1: 200.0, k2: 7e5, c2: 900.0 };
        let support = Support { mass: 40.0, stiffness: 2e6, damping: 500.0 };
        let own = Groups::of(&scales, &pad, &support);
        let back = own.padding(&scales).unwrap();
        // q is a difference of terms up to ten times as large.
        for (found, expected) in
            [(back.k1, pad.k1), (back.c1, pad.c1), (back.k2, pad.k2), (back.c2, pad.c2)]
        {
            assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
        }
        let stands = own.support(&scales);
        near(stands.mass, 40.0);
        near(stands.stiffness, 2e6);
        near(stands.damping, 500.0);
    }

    #[test]
    fn the_printed_groups_stand_for_another_padding() {
        let pad = Groups::PRINTED.padding(&Scales::CHAPTER_4).unwrap();
        assert!((pad.k1 / 1e6 - 20.13).abs() < 0.005 && (pad.c1 - 4027.0).abs() < 0.5, "{pad:?}");
    }

    #[test]
    fn a_padding_exists_between_two_values_of_c() {
        let (low, high) = Groups::PRINTED.range_of_c().unwrap();
        assert!((low - 3.361).abs() < 5e-4 && (high - 28.562).abs() < 5e-4, "{low} {high}");
        let with = |c: f64| Groups { c, ..Groups::PRINTED }.padding(&Scales::UNIT);
        assert!(with(low * 0.999).is_none() && with(low * 1.001).is_some());
        assert!(with(high * 1.001).is_none() && with(high * 0.999).is_some());
        // K2 from 8.4 to 71.4 MN/m.
        let stiffness = |c: f64| c * 10.0 / 4e-6 / 1e6;
        assert!((stiffness(low) - 8.4).abs() < 0.05 && (stiffness(high) - 71.4).abs() < 0.05);
        assert!(Groups { a: 10.0, ..Groups::PRINTED }.range_of_c().is_none());
    }
}
