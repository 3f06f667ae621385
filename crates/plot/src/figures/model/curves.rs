//! The plain numbers of one linear model that figures are drawn from, and how its curves are drawn.

use crate::{Pattern, Series};

/// What models stand for, which gives their units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ModelSubject {
    /// A pad: forces over deformations; stiffnesses \[N/m\] and compliances \[m/N\].
    Pad,
    /// A material: stresses over strains; moduli \[Pa\] and compliances \[1/Pa\].
    Material,
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

/// Models beyond these in one figure cannot be told apart in black and white.
const MOST_MODELS: usize = 4;
/// Values this far below the largest one are not drawn, lest they flatten everything else.
const SMALLEST_SHARE: f64 = 1e-24;

/// A curve of every model, with what tells it from other curves of the same model.
#[derive(Debug)]
pub(super) struct Kind {
    pub(super) curve: ModelCurve,
    /// Name in the legend and in remarks, as in `storage`.
    pub(super) name: &'static str,
    /// Colour where a figure has several kinds; where it has one, models have colours of their own.
    pub(super) colour: usize,
}

/// The curves of all models, and a remark on what is not shown.
pub(super) struct Drawn {
    pub(super) series: Vec<Series>,
    pub(super) note: String,
}

/// Draws `kinds` of curves of `models`.
pub(super) fn draw(models: &[ModelSeries], kinds: &[Kind]) -> Drawn {
    let shown = &models[..models.len().min(MOST_MODELS)];
    let is_single = kinds.len() == 1;
    let mut drawn = Drawn { series: Vec::new(), note: String::new() };
    if shown.len() < models.len() {
        drawn.note_also(&format!("the first {MOST_MODELS} of {} models", models.len()));
    }
    let mut is_cut = false;
    let floor = SMALLEST_SHARE * largest(shown, kinds);
    for (index, model) in shown.iter().enumerate() {
        for kind in kinds {
            let name = match (is_single, shown.len()) {
                (true, _) => model.name.clone(),
                (false, 1) => kind.name.to_owned(),
                (false, _) => format!("{}, {}", model.name, kind.name),
            };
            let points = model.points(kind.curve);
            if points.is_empty() {
                continue;
            }
            if !points.iter().any(|p| is_positive(p.1)) {
                drawn.note_also(&format!("{} of {} is zero", kind.name, model.name));
                continue;
            }
            let colour = if is_single { index } else { kind.colour };
            let pattern = if shown.len() == 1 { Pattern::Solid } else { pattern(index) };
            let is_small = |value: f64| is_positive(value) && value < floor;
            is_cut |= points.iter().any(|p| is_small(p.1));
            let visible = |&(x, y): &(f64, f64)| (x, if is_small(y) { f64::NAN } else { y });
            let points = points.iter().map(visible);
            drawn.series.push(Series::drawn(name, (colour, pattern), points));
        }
    }
    if is_cut {
        drawn.note_also("values below 10⁻²⁴ of the largest are not shown");
    }
    drawn
}

impl Drawn {
    /// Adds to what stands below the heading.
    pub(super) fn note_also(&mut self, text: &str) {
        if !self.note.is_empty() {
            self.note += "; ";
        }
        self.note += text;
    }
}

fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

fn largest(models: &[ModelSeries], kinds: &[Kind]) -> f64 {
    let curves = models.iter().flat_map(|m| kinds.iter().map(|kind| m.points(kind.curve)));
    let values = curves.flatten().map(|p| p.1).filter(|v| v.is_finite());
    values.fold(0.0, f64::max)
}

/// Pattern of the `index`-th of several models.
fn pattern(index: usize) -> Pattern {
    match index {
        0 => Pattern::Broad,
        1 => Pattern::Dashed,
        2 => Pattern::Dotted,
        _ => Pattern::DashDotted,
    }
}
