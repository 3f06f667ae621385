//! Bodies that press a pad, and the area that they load.

use std::f64::consts::PI;

use dashpot_numerics::quadrature::{GaussLegendre, integral};

use crate::{choices, parameters, parameters::InvalidParameter};

choices! {
    /// The shape of a body that presses a pad.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Shape {
        /// A ball, up to its equator.
        Sphere = "sphere",
        /// The cap of a ball, with an edge.
        Dome = "dome",
        /// A roller that lies on the pad, up to half its height.
        Cylinder = "cylinder",
        /// A disk.
        Flat = "flat",
    }
}

parameters! {
    /// A rigid body that presses a pad: its face has the gap `z` over the place of first touch.
    ///
    /// | shape      | keys                 | gap                    | area whose columns are shorter |
    /// |------------|----------------------|------------------------|--------------------------------|
    /// | `sphere`   | `radius`             | `z = R − √(R² − r²)`   | `π (2 R z − z²)`, `π R²` at most |
    /// | `dome`     | `radius`, `diameter` | the same for `r ≤ d/2` | the same, `π d²/4` at most     |
    /// | `cylinder` | `radius`, `length`   | `z = R − √(R² − x²)`   | `2 L √(2 R z − z²)`, `2 R L` at most |
    /// | `flat`     | `diameter`           | `z = 0`                | `π d²/4`                       |
    ///
    /// On a curved pad the gap is that between the two faces along the stroke, `z ± (R_p − √(R_p² − r²))`: a pad that
    /// bulges towards the body adds its height, a hollow one, as a liner is for a head, takes it off. To the first
    /// order in `r/R` that is a body of `1/R_e = 1/R + 1/R_p` on a flat pad. `R_p` is positive for a bulge and negative
    /// for a hollow, which is wider than the body. The pad under a cylinder is a cylinder of the same direction.
    ///
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Indenter: "pressed-by", "rigid body of a given shape that presses a pad",
        checked by Self::fits
    {
        /// shape of the body
        pub shape: Shape = Choice(Shape::WORDS);
        /// radius R [m], positive; of a sphere, dome or cylinder
        pub radius: Option<f64> = Quantity(Dimension::LENGTH), follows "none, of a flat",
            range Positive;
        /// diameter d [m], positive; of a dome or flat
        pub diameter: Option<f64> = Quantity(Dimension::LENGTH),
            follows "none, of a sphere or cylinder", range Positive;
        /// length L [m], positive; of a cylinder
        pub length: Option<f64> = Quantity(Dimension::LENGTH), follows "none, of all others",
            range Positive;
        /// radius R_p of a curved pad, negative where it is hollow [m], not zero
        pub pad_radius as "pad-radius": Option<f64> = Quantity(Dimension::LENGTH),
            follows "a flat pad", range NotZero;
    }
    sample {
        shape: Shape::Sphere,
        radius: Some(0.05),
        diameter: None,
        length: None,
        pad_radius: None,
    }
}

impl Indenter {
    /// The largest area \[m²\] that it loads.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for keys that do not belong to the shape or are missing, for a dome wider than its
    /// sphere, and for a hollow pad that is narrower than the body.
    pub fn area(&self) -> Result<f64, InvalidParameter> {
        self.face().map(|face| face.area())
    }

    fn fits(&self) -> Result<(), InvalidParameter> {
        self.face().map(|_| ())
    }

    /// The value of a key that the shape needs, or does not have.
    fn key(
        &self,
        name: &'static str,
        value: Option<f64>,
        shapes: &[Shape],
    ) -> Result<f64, InvalidParameter> {
        let of = || format!("`shape = \"{}\"`", self.shape.word());
        match (value, shapes.contains(&self.shape)) {
            (None, true) => {
                Err(InvalidParameter::new(name, format!("given for {}", of()), "missing"))
            }
            (Some(value), false) => {
                let range = format!("left out for {}, which has none", of());
                Err(InvalidParameter::new(name, range, format!("{value} m")))
            }
            (value, _) => Ok(value.unwrap_or(f64::INFINITY)),
        }
    }

    /// Its face over the pad.
    pub(super) fn face(&self) -> Result<Face, InvalidParameter> {
        use Shape::{Cylinder, Dome, Flat, Sphere};
        let radius = self.key("radius", self.radius, &[Sphere, Dome, Cylinder])?;
        let diameter = self.key("diameter", self.diameter, &[Dome, Flat])?;
        let length = self.key("length", self.length, &[Cylinder])?;
        let pad = self.pad_radius.unwrap_or(f64::INFINITY);
        let curvature = radius.recip() + pad.recip();
        if curvature < 0.0 || curvature <= 0.0 && self.shape != Flat {
            let range = "larger than the radius of the body where the pad is hollow (negative)";
            return Err(InvalidParameter::new("pad-radius", range, format!("{pad} m")));
        }
        let most = radius.min(pad.abs());
        let reach = if self.has_equator() { most } else { 0.5 * diameter };
        if reach > most {
            let range =
                format!("{} m at most, as wide as the sphere that it is a part of", 2.0 * most);
            return Err(InvalidParameter::new("diameter", range, format!("{diameter} m")));
        }
        let face = Face::new([radius, pad], reach, (self.shape == Cylinder).then_some(length));
        if face.area().is_normal() && (face.rim.is_normal() || face.is_flat()) {
            return Ok(face);
        }
        let key = if self.has_equator() { "radius" } else { "diameter" };
        let range = "such that its area and its height fit into double precision";
        Err(InvalidParameter::new(key, range, format!("{} m", 2.0 * reach)))
    }

    /// Whether its face goes on to an equator, beyond which it does not press.
    pub(super) fn has_equator(&self) -> bool {
        matches!(self.shape, Shape::Sphere | Shape::Cylinder)
    }
}

/// A face over a pad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    /// Radius `R` \[m\] of the face; of the pad under a flat; infinite where both are flat.
    radius: f64,
    /// Radius `R_p` \[m\] of the pad, negative where it is hollow; infinite where it is flat.
    pad: f64,
    /// Length \[m\] of a cylinder.
    length: Option<f64>,
    /// Half its width `a` \[m\].
    reach: f64,
    /// Gap at its edge \[m\].
    pub(super) rim: f64,
}

/// What functions of the gap are integrated over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Over {
    /// The area, `∫ g dA`.
    Area,
    /// The gap, with the area up to it, `∫ g A dz`.
    Gap,
}

/// `R − √(R² − a²)` without the difference; negative for a negative `R`.
fn height(radius: f64, reach: f64) -> f64 {
    let part = reach / radius;
    reach * part / (1.0 + ((1.0 - part) * (1.0 + part)).max(0.0).sqrt())
}

impl Face {
    /// The face of a radius over a pad of another one.
    pub(super) fn new([body, pad]: [f64; 2], reach: f64, length: Option<f64>) -> Self {
        let rim = height(body, reach) + height(pad, reach);
        // A flat body on a curved pad has the gaps of a curved body on a flat pad.
        let (radius, pad) = if body.is_finite() { (body, pad) } else { (pad.abs(), f64::INFINITY) };
        Self { radius, pad, length, reach, rim }
    }

    pub(super) fn is_flat(&self) -> bool {
        self.radius.is_infinite()
    }

    /// Whether the area is a quadratic of the gap.
    pub(super) fn is_quadratic(&self) -> bool {
        self.length.is_none() && self.pad.is_infinite()
    }

    /// The whole area \[m²\].
    pub(super) fn area(&self) -> f64 {
        self.length.map_or(PI * self.reach * self.reach, |length| 2.0 * self.reach * length)
    }

    /// Which part the height of the body is of the gap, and the slope of that height over the gap; the rest
    /// is that of the pad.
    fn of_body(&self, gap: f64) -> [f64; 2] {
        if self.pad.is_infinite() {
            return [1.0, 1.0];
        }
        // From √(R² − r²) + √(R_p² − r²) = R + R_p − z, with the sign of R_p for the second root.
        let sum = self.radius + self.pad;
        let left = sum - gap;
        let part = (self.pad - 0.5 * gap) / left;
        [part, (sum * (self.pad - gap) + 0.5 * gap * gap) / (left * left)]
    }

    /// The variable over which integrands are smooth.
    fn place(&self, gap: f64) -> f64 {
        if self.length.is_none() { gap } else { gap.sqrt() }
    }

    /// The gap at a place, and what stands beside the integrand there.
    fn at(&self, over: Over, place: f64) -> (f64, f64) {
        let Some(length) = self.length else {
            let [part, slope] = self.of_body(place);
            let height = part * place;
            let weight = match over {
                Over::Area => 2.0 * PI * (self.radius - height) * slope,
                Over::Gap => PI * height * (2.0 * self.radius - height),
            };
            return (place, weight);
        };
        let gap = place * place;
        let [part, slope] = self.of_body(gap);
        let height = part * gap;
        // Half the width over the place.
        let wide = (part * (2.0 * self.radius - height)).sqrt();
        let weight = match over {
            Over::Area => 4.0 * length * (self.radius - height) * slope / wide,
            Over::Gap => 4.0 * length * wide * gap,
        };
        (gap, weight)
    }

    /// The integral of `of` the gap up to the gap `to` \[m\], at most that at the edge. `of` is never negative
    /// and smooth but for the `breaks`, which are gaps; where `is_cubic`, it is a cubic between them.
    pub(super) fn integrated(
        &self,
        over: Over,
        to: f64,
        (is_cubic, breaks): (bool, impl Iterator<Item = f64>),
        of: impl Fn(f64) -> f64,
    ) -> f64 {
        let inner = breaks.filter(|gap| *gap > 0.0 && *gap < to);
        let mut places: Vec<f64> = inner.chain([0.0, to]).map(|gap| self.place(gap)).collect();
        places.sort_by(f64::total_cmp);
        let weighted = |place: f64| {
            let (gap, weight) = self.at(over, place);
            weight * of(gap)
        };
        // A cubic times a quadratic is a polynomial of the fifth degree.
        let exact = GaussLegendre::with_points(3);
        let last = places.len().saturating_sub(2);
        let pieces = places.windows(2).enumerate().map(|(at, pair)| {
            let length = pair[1] - pair[0];
            if is_cubic && self.is_quadratic() {
                exact.integrate(pair[0], pair[1], weighted)
            } else if at == last {
                // Powers of how little the outer columns are shortened are smooth over its root.
                integral(|root| weighted(pair[1] - length * root * root) * root, 0.0, 1.0)
                    * (2.0 * length)
            } else {
                integral(weighted, pair[0], pair[1])
            }
        });
        pieces.sum()
    }
}
