//! Records of one material as one problem of least squares: rows with weights, terms as columns.

use nalgebra::{DMatrix, DVector};

use super::{
    kernel::{Channel, Scale, Term},
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
    /// Between which times its branches are \[s\]: no row could determine one that is faster or slower.
    pub(super) limits: (f64, f64),
    /// Whether it comes to rest under a constant load.
    pub(super) is_solid: bool,
}

/// A branch has relaxed to 1 % after so many of its times.
const MOST_SEEN: f64 = 5.0;

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
        Self { channels, target, form, range, limits: range, is_solid: false }
    }

    /// The slowest branch of which most is seen \[s\].
    pub(super) fn slowest(&self) -> f64 {
        self.range.1 / MOST_SEEN
    }

    /// That of a solid: what relaxes so slowly that little of it is seen is a spring, and nothing flows.
    pub(super) fn of_solid(self) -> Self {
        let (low, high) = self.limits;
        Self { limits: (low, self.slowest().clamp(low, high)), is_solid: true, ..self }
    }

    /// The same, with times of relaxations from the first row on if there is nothing else: what branches have
    /// lost by then changes their strengths alone.
    pub(super) fn aligned(&self) -> Self {
        let first = self.range.0;
        let channels: Option<Vec<(usize, Channel)>> =
            self.channels.iter().map(|(at, own)| Some((*at, own.since(first)?))).collect();
        channels.map_or_else(|| self.clone(), |channels| Self { channels, ..self.clone() })
    }

    /// What its branches are multiplied by to have limits.
    pub(super) fn scale(&self) -> Scale {
        match (self.form, self.channels.iter().filter_map(|own| own.1.fades()).min()) {
            (Form::Kelvin, _) => Scale::Slow(self.range.1),
            (Form::Maxwell, None | Some(0)) => Scale::None,
            (Form::Maxwell, Some(power)) => Scale::Fast(self.range.0, power),
        }
    }

    /// The shortest and the longest time between which branches change \[s\].
    pub(super) fn span(&self) -> (f64, f64) {
        let all = self.channels.iter().map(|own| own.1.span());
        all.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), own| {
            (low.min(own.0), high.max(own.1))
        })
    }

    /// Bounds of the second derivatives of the rows of scaled branches by the logarithm of their time.
    pub(super) fn curvature(&self, scale: Scale) -> Vec<f64> {
        let rows = self.channels.iter().flat_map(|own| own.1.curvature(scale));
        rows.zip(self.weights()).map(|(own, weight)| own * weight.abs()).collect()
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
