//! The plain numbers of one linear model that figures are drawn from.

/// What models stand for, which gives their units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ModelSubject {
    /// A pad: forces over deformations; stiffnesses \[N/m\] and compliances \[m/N\].
    Pad,
    /// A material: stresses over strains; moduli \[Pa\] and compliances \[1/Pa\].
    Material,
}

impl ModelSubject {
    /// Unit of a stiffness or modulus.
    pub(super) fn stiffness_unit(self) -> &'static str {
        match self {
            Self::Pad => "N/m",
            Self::Material => "Pa",
        }
    }

    /// Unit of a compliance.
    pub(super) fn compliance_unit(self) -> &'static str {
        match self {
            Self::Pad => "m/N",
            Self::Material => "1/Pa",
        }
    }

    /// What forces over deformations are called.
    pub(super) fn stiffness(self) -> &'static str {
        match self {
            Self::Pad => "stiffness",
            Self::Material => "modulus",
        }
    }
}

/// Curves of one linear model as points along them, in the units of its [`ModelSubject`].
///
/// Curves that are not wanted stay empty. Times and frequencies are best sampled at equal ratios, some forty a decade;
/// points that are not positive are gaps, since both axes are logarithmic.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModelSeries {
    /// Name.
    pub name: String,
    /// Relaxation function: (time \[s\], `G(t)` \[N/m or Pa\]), ascending in time.
    pub relaxation: Vec<(f64, f64)>,
    /// Relaxation spectrum: (relaxation time `τ_j` \[s\], strength `K_j` \[N/m or Pa\]).
    pub spectrum: Vec<(f64, f64)>,
    /// Creep function: (time \[s\], `J(t)` \[m/N or 1/Pa\]), ascending in time.
    pub creep: Vec<(f64, f64)>,
    /// Storage: (angular frequency \[rad/s\], `k′` \[N/m or Pa\]), ascending in frequency.
    pub storage: Vec<(f64, f64)>,
    /// Loss: (angular frequency \[rad/s\], `k″` \[N/m or Pa\]), ascending in frequency.
    pub loss: Vec<(f64, f64)>,
    /// Loss factor: (angular frequency \[rad/s\], `tan δ` \[1\]), ascending in frequency.
    pub loss_factor: Vec<(f64, f64)>,
    /// Points worth a text, such as the worst disagreement with another model.
    pub markers: Vec<ModelMarker>,
}

impl ModelSeries {
    /// The points of one curve.
    pub(super) fn points(&self, curve: ModelCurve) -> &[(f64, f64)] {
        match curve {
            ModelCurve::Relaxation => &self.relaxation,
            ModelCurve::Creep => &self.creep,
            ModelCurve::Storage => &self.storage,
            ModelCurve::Loss => &self.loss,
            ModelCurve::LossFactor => &self.loss_factor,
        }
    }
}

/// A point of a model's curve that carries a text.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelMarker {
    /// The curve; decides which figure shows it.
    pub curve: ModelCurve,
    /// Time \[s\] or angular frequency \[rad/s\].
    pub at: f64,
    /// Value of the curve there, in the curve's unit.
    pub value: f64,
    /// Text beside the point, as in `worst: 3 % at 2 ms`.
    pub label: String,
}

/// A curve of a linear model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ModelCurve {
    /// `G(t)`.
    Relaxation,
    /// `J(t)`.
    Creep,
    /// `k′(ω)`.
    Storage,
    /// `k″(ω)`.
    Loss,
    /// `tan δ(ω)`.
    LossFactor,
}
