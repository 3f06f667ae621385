//! Driving functions as solutions of linear differential equations.

use nalgebra::DMatrix;

use crate::{Input, LinearForm, Piece, System};

/// What one generator state follows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    /// The derivative of this order of the polynomial part, whose rate is the next state or zero.
    Polynomial(u32),
    /// `p = sine·sin ωs + cosine·cos ωs`, `p' = ω q`; its `q` is the next state.
    Wave { omega: f64 },
    /// `q = sine·cos ωs − cosine·sin ωs`, `q' = −ω p`.
    Quadrature { omega: f64 },
}

/// The generator states that drive a system: for each waveform in use its polynomial part and the
/// derivatives of it that are not zero, from the lowest order in use on, and one pair for each of its
/// frequencies. Frequencies that are swept have no generators.
#[derive(Debug, Clone, Default, PartialEq)]
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
            if let Some(degree) = waveform.pieces().iter().filter_map(Piece::degree).max() {
                states.extend((lowest..=degree).map(|order| (index, Role::Polynomial(order))));
            }
            let mut seen: Vec<f64> = Vec::new();
            for omega in waveform.pieces().iter().filter(|p| is_steady(p)).map(|piece| piece.omega)
            {
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
                Role::Polynomial(order) => piece.polynomial(order, start),
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
                (Role::Polynomial(own), order) if own == order => 1.0,
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
                Role::Polynomial(order)
                    if self.states.get(at + 1)
                        == Some(&(waveform, Role::Polynomial(order + 1))) =>
                {
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

/// Whether the piece has a part of one frequency.
fn is_steady(piece: &Piece) -> bool {
    piece.is_wave() && !piece.is_swept()
}

#[expect(clippy::float_cmp, reason = "the frequency was copied from the pieces")]
fn matches(piece: &Piece, omega: f64) -> bool {
    is_steady(piece) && piece.omega == omega
}
