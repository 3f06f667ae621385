//! Vectors of a few numbers that lie on the stack, and matrices of such columns, for `diffsol`'s integrators: small
//! systems are stepped without allocation, by loops of constant length.
//!
//! Numbers behind the last row are of no meaning and are read by no result.

mod factor;
mod matrix;
#[cfg(test)]
mod tests;
mod vector;

pub(in crate::methods) use self::{matrix::StackMatrix, vector::StackVector};

/// Most rows.
pub(in crate::methods) const ROWS: usize = 8;

/// The numbers of a column.
type Column = [f64; ROWS];

/// Single systems, one at a time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::methods) struct Single;

impl diffsol::Context for Single {
    fn clone_with_nbatch(&self, nbatch: usize) -> Result<Self, diffsol_la::LaError> {
        match nbatch {
            1 => Ok(Self),
            more => Err(diffsol_la::LaError::Other(format!("{more} systems at once"))),
        }
    }
}

/// Numbers of rows.
#[derive(Debug, Clone)]
pub(in crate::methods) struct Indices(Vec<usize>);

impl diffsol::VectorIndex for Indices {
    type C = Single;

    fn context(&self) -> &Single {
        &Single
    }

    fn zeros(len: usize, _context: Single) -> Self {
        Self(vec![0; len])
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn clone_as_vec(&self) -> Vec<usize> {
        self.0.clone()
    }

    fn from_vec(indices: Vec<usize>, _context: Single) -> Self {
        Self(indices)
    }
}
