//! Records of one material as one problem of least squares: rows with weights, terms as columns.

use nalgebra::{DMatrix, DVector};

use super::{
    kernel::{Channel, Term},
    record::{Form, Record},
};

/// The rows of several records.
#[derive(Debug, Clone)]
pub(super) struct Problem {
    /// The channels, and the number of the record that each is of.
    channels: Vec<(usize, Channel)>,
    /// What was measured, with its weights.
    pub(super) target: DVector<f64>,
    /// The form in which its terms are.
    pub(super) form: Form,
    /// From the shortest to the longest time \[s\].
    pub(super) range: (f64, f64),
}

impl Problem {
    /// That of these records, whose answers were written down so much later than what was done \[s\].
    pub(super) fn of(records: &[Record], shifts: &[f64]) -> Self {
        let each = records.iter().zip(shifts).enumerate();
        let channels: Vec<(usize, Channel)> = each
            .flat_map(|(at, (record, shift))| {
                Channel::of(record, *shift).into_iter().map(move |own| (at, own))
            })
            .collect();
        let rows = channels.iter().flat_map(|(_, own)| own.values.iter().zip(&own.weights));
        let target = DVector::from_vec(rows.map(|(value, weight)| value * weight).collect());
        let ranges = records.iter().map(Record::range);
        let range = ranges.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), own| {
            (low.min(own.0), high.max(own.1))
        });
        let form = records.first().map_or(Form::Maxwell, Record::form);
        Self { channels, target, form, range }
    }

    pub(super) fn rows(&self) -> usize {
        self.target.len()
    }

    /// The rows of each channel, with the number of its record.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> + '_ {
        let mut from = 0;
        self.channels.iter().map(move |(record, channel)| {
            let rows = from..from + channel.values.len();
            from = rows.end;
            (*record, rows)
        })
    }

    /// The weight of each row.
    pub(super) fn weights(&self) -> impl Iterator<Item = f64> + '_ {
        self.channels.iter().flat_map(|(_, own)| own.weights.iter().copied())
    }

    /// What a term of unit strength adds to each row, and how that changes with the logarithm of its time.
    pub(super) fn term(&self, term: Term, value: &mut [f64], slope: &mut [f64]) {
        let mut from = 0;
        for (_, channel) in &self.channels {
            let rows = from..from + channel.values.len();
            from = rows.end;
            channel.term(term, &mut value[rows.clone()], &mut slope[rows.clone()]);
            for (row, weight) in rows.zip(&channel.weights) {
                value[row] *= weight;
                slope[row] *= weight;
            }
        }
    }

    /// The columns of terms.
    pub(super) fn columns(&self, terms: &[Term]) -> DMatrix<f64> {
        let mut columns = DMatrix::zeros(self.rows(), terms.len());
        let mut slope = vec![0.0; self.rows()];
        for (term, column) in
            terms.iter().zip(columns.as_mut_slice().chunks_exact_mut(self.rows().max(1)))
        {
            self.term(*term, column, &mut slope);
        }
        columns
    }
}
