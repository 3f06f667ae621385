//! Driving functions as solutions of linear differential equations.

use nalgebra::DMatrix;

use crate::{Input, LinearForm, Piece, System};

/// What one generator state follows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    /// `u = value + slope·s`, `u' = slope`.
    Value,
    /// `u' = slope`, constant.
    Slope,
    /// `p = sine·sin ωs + cosine·cos ωs`, `p' = ω q`; its `q` is the next state.
    Wave { omega: f64 },
    /// `q = sine·cos ωs − cosine·sin ωs`, `q' = −ω p`.
    Quadrature { omega: f64 },
}

/// The generator states that drive a system: for each waveform in use its value and slope, as far
/// as some piece needs them, and one pair for each of its frequencies.
#[derive(Debug, Clone, Default)]
pub(super) struct Generators {
    states: Vec<(usize, Role)>,
}

impl Generators {
    /// The generators of a system's inputs.
    pub(super) fn new(system: &System) -> Self {
        let mut states = Vec::new();
        for (index, waveform) in system.waveforms.iter().enumerate() {
            let orders =
                || system.inputs.iter().filter(|i| i.waveform == index).map(|i| i.derivative);
            let Some(lowest) = orders().min() else { continue };
            let sloped = waveform.pieces().iter().any(|piece| piece.slope != 0.0);
            let offset = waveform.pieces().iter().any(|piece| constant_part(piece) != 0.0);
            if lowest == 0 && (sloped || offset) {
                states.push((index, Role::Value));
            }
            if lowest <= 1 && sloped {
                states.push((index, Role::Slope));
            }
            let mut seen: Vec<f64> = Vec::new();
            for omega in waveform.pieces().iter().filter(|p| waves(p)).map(|piece| piece.omega) {
                if !seen.contains(&omega) {
                    seen.push(omega);
                    states.push((index, Role::Wave { omega }));
                    states.push((index, Role::Quadrature { omega }));
                }
            }
        }
        Self { states }
    }

    /// Number of generator states.
    pub(super) fn len(&self) -> usize {
        self.states.len()
    }

    /// The states on the pieces that hold from `start`, at `start`.
    pub(super) fn values(&self, system: &System, start: f64) -> Vec<f64> {
        let value = |&(waveform, role): &(usize, Role)| {
            let piece = system.waveforms[waveform].piece_at(start);
            let s = start - piece.start;
            match role {
                Role::Value => constant_part(piece) + piece.slope * s,
                Role::Slope => piece.slope,
                Role::Wave { omega } if matches(piece, omega) => {
                    let (sin, cos) = (omega * s).sin_cos();
                    piece.sine * sin + piece.cosine * cos
                }
                Role::Quadrature { omega } if matches(piece, omega) => {
                    let (sin, cos) = (omega * s).sin_cos();
                    piece.sine * cos - piece.cosine * sin
                }
                Role::Wave { .. } | Role::Quadrature { .. } => 0.0,
            }
        };
        self.states.iter().map(value).collect()
    }

    /// An input as a form over the augmented state, in which the generators begin at `offset`.
    pub(super) fn form(&self, input: Input, offset: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        for (at, &(waveform, role)) in self.states.iter().enumerate() {
            if waveform != input.waveform {
                continue;
            }
            let power = |omega: f64| omega.powi(input.derivative.cast_signed());
            let coefficient = match (role, input.derivative) {
                (Role::Value, 0) | (Role::Slope, 1) => 1.0,
                (Role::Wave { omega }, order) if order % 4 == 0 => power(omega),
                (Role::Wave { omega }, order) if order % 4 == 2 => -power(omega),
                (Role::Quadrature { omega }, order) if order % 4 == 1 => power(omega),
                (Role::Quadrature { omega }, order) if order % 4 == 3 => -power(omega),
                _ => 0.0,
            };
            form = form.plus(1.0, &LinearForm::term(offset + at, coefficient));
        }
        form
    }

    /// Writes the generators' own equations into rows and columns from `offset` on.
    pub(super) fn fill(&self, matrix: &mut DMatrix<f64>, offset: usize) {
        for (at, &(waveform, role)) in self.states.iter().enumerate() {
            let row = offset + at;
            match role {
                Role::Value if self.states.get(at + 1) == Some(&(waveform, Role::Slope)) => {
                    matrix[(row, row + 1)] = 1.0;
                }
                Role::Wave { omega } => {
                    matrix[(row, row + 1)] = omega;
                    matrix[(row + 1, row)] = -omega;
                }
                _ => {}
            }
        }
    }

    /// The indices of the states `p` and their frequencies `ω`.
    pub(super) fn waves(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.states.iter().enumerate().filter_map(|(at, &(_, role))| match role {
            Role::Wave { omega } => Some((at, omega)),
            _ => None,
        })
    }
}

/// Whether the piece has a sine part; at frequency zero its cosine is a constant.
fn waves(piece: &Piece) -> bool {
    piece.omega != 0.0 && (piece.sine != 0.0 || piece.cosine != 0.0)
}

#[expect(clippy::float_cmp, reason = "the frequency was copied from the pieces")]
fn matches(piece: &Piece, omega: f64) -> bool {
    waves(piece) && piece.omega == omega
}

fn constant_part(piece: &Piece) -> f64 {
    if piece.omega == 0.0 { piece.value + piece.cosine } else { piece.value }
}
