//! Pad of independent columns under a body of a given shape.

use std::sync::Arc;

use dashpot_rheology::Tree;

use super::{
    Element, Law, Spring, Tangent, TwoCurves, hysteresis,
    indenter::{Face, Indenter, Over},
};
use crate::{
    parameters::{
        Described, Field, Given, InvalidParameter, Kind, Parameter, ParameterKind, Value,
        described_as,
    },
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// A pad of independent columns that is pressed by a rigid body of a given shape, so that the loaded area grows with
/// the deformation: `F(y) = ∫ σ dA`, with each column shortened by `y − z` under the gap `z`.
///
/// | symbol | field      | unit | range |
/// |--------|------------|------|-------|
/// | `f`    | `law`      | N    | a law of the deformation, on one curve or on two |
/// |        | `indenter` |      | see [`Indenter`] |
///
/// `f` is the law of the pad where all of the area `A₀` of the body is loaded at once, `f(s) = A₀ σ(s/h)`. So `F(y) =
/// (1/A₀) ∫ f(y − z) dA`, with `A(z)` of the [`Indenter`] and `y − z > 0`. For `f = k s` that is, up to the edge,
///
/// * under a sphere or dome `F = (π k/A₀) (R y² − y³/3)`,
/// * under a cylinder `F = (L k/A₀) (R² asin(w/R) − w (R − y))`, `w = √(2 R y − y²)`.
///
/// Once the edge of a dome is in the pad, all of its area is loaded and grows no further. The body pushes and
/// never pulls. The pad stores `(1/A₀) ∫ W(y − z) dA` with the `W` that `f` stores, and dissipates none.
///
/// A law that is unloaded on another curve is so in every column from where that has been deepest: pressed in to
/// `y_m`, the column under the gap `z` to `y_m − z`. So `F(y) = (1/A₀) ∫ f φ(y − z, y_m − z) dA`, and the pad has the
/// one memory `y_m` and the set of its deepest column. It dissipates what its columns do.
///
/// Integrals are exact for laws of cubics (springs, cubic springs, piecewise linear springs, tables) under shapes of
/// rotation as they are loaded, and to about 10⁻¹⁴ of their value for all others.
///
/// # Limits
///
/// The columns do not hold each other: no shear, so nothing outside of the body sinks in. No friction at
/// the face; the thickness is measured along the stroke, so slopes of the face of more than 30° or so are
/// out of its reach. A sphere or cylinder that is in by more than its radius has no answer here: a run warns of it. A law
/// that depends on the rate needs the history of every column, and is refused.
///
/// # Examples
///
/// ```
/// use std::sync::Arc;
/// use dashpot_network::{Element, elements::{Foundation, Indenter, Shape, Spring}};
///
/// // 1 MPa on 20 mm of pad, under a ball of 50 mm: the whole area would have 1 MPa·πR²/h.
/// let ball = Indenter { shape: Shape::Sphere, radius: Some(0.05), diameter: None, length: None, pad_radius: None };
/// let pad = Spring { stiffness: 1e6 * ball.area()? / 0.02 };
/// let pad = Foundation::new(Arc::new(pad), ball)?;
/// let hertz_like = std::f64::consts::PI * 1e6 / 0.02 * (0.05 * 1e-4 - 1e-6 / 3.0);
/// assert!((pad.force(0.01, 0.0) / hertz_like - 1.0).abs() < 1e-14);
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # References
///
/// `johnson1985` in `docs/references.bib`, section 4.3, for the elastic foundation.
#[derive(Debug, Clone)]
pub struct Foundation {
    law: Arc<dyn Element>,
    indenter: Indenter,
    face: Face,
    /// Deformations \[m\] between which the law is smooth, and whether it is a cubic there.
    breaks: Vec<f64>,
    is_cubic: bool,
}

const LAW: &str = Foundation::LAW;

impl Foundation {
    /// The key of its law.
    pub const LAW: &str = "law";

    /// The pad with the law that it has where all of the area of the body is loaded at once.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for a law that is none of the deformation alone or has no force in compression, and for a body
    /// that is none.
    pub fn new(law: Arc<dyn Element>, indenter: Indenter) -> Result<Self, InvalidParameter> {
        indenter.validate()?;
        law.validate()?;
        let face = indenter.face()?;
        check(law.as_ref())?;
        let cubics = law.two_curves().map_or_else(|| law.cubics(), |own| own.loading().cubics());
        let is_cubic = cubics.is_some();
        let end = || law.range().map(|range| range.1).into_iter().collect();
        let breaks = cubics.unwrap_or_else(end);
        let own = Self { law, indenter, face, breaks, is_cubic };
        let secant = own.secant();
        if secant.is_normal() && secant > 0.0 {
            return Ok(own);
        }
        let range = "a law with a force in compression that fits into double precision";
        Err(InvalidParameter::new(LAW, range, format!("`{}` of {secant} N/m", own.law.kind())))
    }

    /// The law of the pad where all of the area is loaded at once.
    pub fn column(&self) -> &Arc<dyn Element> {
        &self.law
    }

    /// The body that presses it.
    pub fn indenter(&self) -> &Indenter {
        &self.indenter
    }

    /// A typical slope \[N/m\]: the secant as far as the law is known, or with all of the area loaded.
    fn secant(&self) -> f64 {
        if self.face.is_flat() {
            return match whole(self.law.as_ref()) {
                Law::Spring(stiffness) | Law::Nonlinear { stiffness, .. } => stiffness,
                _ => 0.0,
            };
        }
        let end = self.law.range().map(|range| range.1);
        let depth = end.filter(|end| *end > 0.0 && end.is_finite()).unwrap_or(self.face.rim);
        self.force(depth, 0.0) / depth
    }

    /// The mean over the area of what `of` gives for how much a column is shortened.
    fn mean(&self, over: Over, deformation: f64, of: impl Fn(f64) -> f64) -> f64 {
        self.mean_of(over, deformation, (self.is_cubic, &[]), of)
    }

    /// The same of what is a cubic between its breaks or not, with further breaks, which are gaps.
    fn mean_of(
        &self,
        over: Over,
        deformation: f64,
        (is_cubic, further): (bool, &[f64]),
        of: impl Fn(f64) -> f64,
    ) -> f64 {
        let to = deformation.min(self.face.rim);
        let breaks = self.breaks.iter().map(|at| deformation - at);
        let breaks = breaks.chain(further.iter().copied());
        let of = |gap: f64| of(deformation - gap);
        self.face.integrated(over, to, (is_cubic, breaks), of) / self.face.area()
    }

    /// The mean over the area of what `of` gives for how much a column is shortened and how much it was at most,
    /// where the pad was pressed in to `deepest` \[m\].
    fn mean_unloaded(
        &self,
        curves: &dyn TwoCurves,
        [deformation, deepest]: [f64; 2],
        of: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let parts = curves.bends().into_iter().filter(|part| *part < 1.0);
        let bends: Vec<f64> =
            parts.map(|part| (deformation - part * deepest) / (1.0 - part)).collect();
        let beyond = (deepest - deformation).max(0.0);
        let of_column = |own: f64| if own > 0.0 { of(own, own + beyond) } else { 0.0 };
        self.mean_of(Over::Area, deformation.max(0.0), (false, &bends), of_column)
    }
}

/// A law as the compiler of networks sees it, of one that switches the whole of it as it is loaded.
fn whole(law: &dyn Element) -> Law {
    let loading = law.two_curves().map(|own| own.loading().law());
    let at_rest = || law.phases().and_then(Phases::at_rest);
    loading.or_else(at_rest).unwrap_or_else(|| law.law())
}

/// Refuses laws that depend on the rate, and such as push before they are pressed.
fn check(law: &dyn Element) -> Result<(), InvalidParameter> {
    let refused =
        |range: &'static str| Err(InvalidParameter::new(LAW, range, format!("`{}`", law.kind())));
    match whole(law) {
        Law::Nonlinear { damping, .. } if damping > 0.0 => {}
        Law::Spring(_) | Law::Nonlinear { .. } if law.force(0.0, 0.0) == 0.0 => return Ok(()),
        Law::Spring(_) | Law::Nonlinear { .. } => {
            return refused("a law that has no force until it is pressed");
        }
        _ => {}
    }
    refused(
        "a law of the deformation, such as `spring`, `foam`, `table-spring` or `hysteretic-table`: with an area \
         that grows, what depends on the rate does so in every column for itself",
    )
}

impl Element for Foundation {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        if deformation <= 0.0 {
            return 0.0;
        }
        if self.face.is_flat() {
            return self.law.force(deformation, 0.0);
        }
        self.mean(Over::Area, deformation, |own| self.law.force(own, 0.0))
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        if deformation <= 0.0 {
            return Tangent::default();
        }
        if self.face.is_flat() {
            return self.law.tangent(deformation, 0.0);
        }
        let slope = |own: f64| self.law.tangent(own, 0.0).stiffness;
        Tangent { stiffness: self.mean(Over::Area, deformation, slope), damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        if deformation <= 0.0 {
            return 0.0;
        }
        if self.face.is_flat() {
            return self.law.stored(deformation);
        }
        if let Some(curves) = self.law.two_curves() {
            return self.mean_unloaded(curves, [deformation; 2], |own, deepest| {
                curves.recoverable(own, deepest)
            });
        }
        // By parts: what all columns store that are shortened since the edge is in the pad, and the
        // work of the area before.
        let before = self.mean(Over::Gap, deformation, |own| self.law.force(own, 0.0));
        self.law.stored((deformation - self.face.rim).max(0.0)) + before
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }

    fn range(&self) -> Option<(f64, f64)> {
        let known = self.law.range().map(|range| range.1);
        let equator = self.indenter.has_equator().then_some(self.face.rim);
        let end = known.into_iter().chain(equator).reduce(f64::min);
        end.map(|end| (f64::NEG_INFINITY, end))
    }

    fn ends_at_equator(&self) -> bool {
        let known = self.law.range().map_or(f64::INFINITY, |range| range.1);
        self.indenter.has_equator() && self.face.rim < known
    }
}

const FREE: usize = 0;
const PRESSED: usize = 1;

impl Phases for Foundation {
    fn names(&self) -> &'static [&'static str] {
        if self.law.two_curves().is_some() { hysteresis::NAMES } else { &["free", "pressed"] }
    }

    fn first(&self, deformation: f64) -> Phase {
        if self.law.two_curves().is_some() {
            return hysteresis::first(deformation);
        }
        Phase { index: if deformation < 0.0 { FREE } else { PRESSED }, memory: 0.0 }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        let pressed = |deepest| PhaseLaw::Element(Arc::new(Pressed { pad: self.clone(), deepest }));
        let is_plain = self.law.law() != Law::Phased;
        if let (true, Some(_), Some(column)) =
            (self.face.is_flat(), self.law.two_curves(), self.law.phases())
        {
            return column.law(phase);
        }
        match (phase.index, self.law.two_curves()) {
            (hysteresis::UNLOADING, Some(_)) if phase.memory > 0.0 => pressed(Some(phase.memory)),
            (PRESSED, None) if self.face.is_flat() && is_plain => {
                PhaseLaw::Element(Arc::clone(&self.law))
            }
            (hysteresis::LOADING, Some(_)) | (PRESSED, None) => pressed(None),
            _ => PhaseLaw::Open,
        }
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        if let Some(curves) = self.law.two_curves() {
            // The deepest column is the last one to be slack.
            return hysteresis::exits(curves, phase);
        }
        let is_free = phase.index == FREE;
        vec![Exit {
            watched: Watched::Deformation,
            level: 0.0,
            rising: is_free,
            to: if is_free { PRESSED } else { FREE },
            remembers: false,
        }]
    }
}

/// The pad while it is pressed.
#[derive(Debug)]
struct Pressed {
    pad: Foundation,
    /// The deformation from which it is unloaded on its second curve \[m\].
    deepest: Option<f64>,
}

impl Pressed {
    /// The second curve, and from where it is followed.
    fn unloaded(&self) -> Option<(&dyn TwoCurves, f64)> {
        self.pad.law.two_curves().zip(self.deepest)
    }
}

impl Described for Pressed {
    described_as!(pad);
}

impl Element for Pressed {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        let Some((curves, deepest)) = self.unloaded() else {
            return self.pad.force(deformation, rate);
        };
        self.pad.mean_unloaded(curves, [deformation, deepest], |own, deepest| {
            curves.loading().force(own, 0.0) * curves.factor(own, deepest).0
        })
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let Some((curves, deepest)) = self.unloaded() else {
            return self.pad.tangent(deformation, rate);
        };
        let stiffness = self.pad.mean_unloaded(curves, [deformation, deepest], |own, deepest| {
            let (factor, slope) = curves.factor(own, deepest);
            let loading = curves.loading();
            loading.tangent(own, 0.0).stiffness * factor + loading.force(own, 0.0) * slope
        });
        Tangent { stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        let Some((curves, deepest)) = self.unloaded() else {
            return self.pad.stored(deformation);
        };
        self.pad.mean_unloaded(curves, [deformation, deepest], |own, deepest| {
            curves.recoverable(own, deepest)
        })
    }

    fn law(&self) -> Law {
        Law::Nonlinear { stiffness: self.pad.secant(), damping: 0.0 }
    }

    fn grows_from(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// The law, and the parameters of the body.
const PARAMETERS: [Parameter; 6] = {
    let help = "law of the pad where all of the area of the body is loaded at once";
    let law = Parameter::new(LAW, ParameterKind::Model, help);
    let mut all = [law; 6];
    all.split_at_mut(1).1.copy_from_slice(Indenter::PARAMETERS);
    all
};

impl Kind for Foundation {
    const KIND: &'static str = "foundation";
    const SUMMARY: &'static str =
        "pad of independent columns under a sphere, dome, cylinder or flat; never pulls";
    const PARAMETERS: &'static [Parameter] = &PARAMETERS;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let law: Tree<Arc<dyn Element>> = Given::new(Self::PARAMETERS, values).take()?;
        let indenter = Indenter::from_values(values.get(1..).unwrap_or_default())?;
        match law {
            Tree::Part(law) => Self::new(law, indenter),
            Tree::Series(_) | Tree::Parallel(_) => {
                let range = "one element; in parallel, each has a `foundation` of its own";
                Err(InvalidParameter::new(LAW, range, "composed"))
            }
        }
    }

    fn fields(&self) -> Vec<Value> {
        let mut values = vec![Tree::Part(Arc::clone(&self.law)).value()];
        values.extend(self.indenter.values());
        values
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        self.indenter.validate()?;
        self.law.validate()
    }

    fn sample() -> Self {
        let (indenter, law) = (Indenter::sample(), Arc::new(Spring { stiffness: 2e5 }));
        let face = Face::new([0.05, f64::INFINITY], 0.05, None);
        Self { law, indenter, face, breaks: Vec::new(), is_cubic: true }
    }
}
