//! Errors where it is open whether an impact ends.

use crate::{
    errors::{
        accuracy::excess,
        solved::{Solved, Task},
    },
    solution::{doubt_at, grazes},
};

/// An impact that may end where its force comes within its error of zero and pushes on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OpenEnd {
    /// When \[s\]; the first of several.
    pub(crate) time: f64,
    /// The measures, by number, to which it makes more of a difference than their errors and a tenth of what
    /// is asked of them.
    pub(crate) measures: Vec<usize>,
    /// The measures that have a value at one of both ends only. Where a force only comes to nothing they are
    /// all that hangs on the end.
    pub(crate) undecided: Vec<usize>,
}

/// What is worth a word, in parts of the accuracy asked for.
const NOTABLE: f64 = 0.1;

impl OpenEnd {
    /// Widens the errors of the last of some solutions so that they cover both ends of such an impact;
    /// `None` where no measure comes by it to miss what is asked of it, or to have a value at all.
    pub(crate) fn cover(
        task: &Task<'_>,
        solved: &[Solved],
        errors: &mut [Option<f64>],
    ) -> Option<Self> {
        let (finest, others) = solved.split_last()?;
        let ends = grazes(
            &finest.as_read(task.assembly),
            &|| others.iter().map(|own| own.as_read(task.assembly)).collect(),
            doubt_at(Some(finest.rtol)),
        );
        let time = ends.iter().map(|own| own.1).reduce(f64::min)?;
        let earlier = task.read(&mut finest.as_read(task.assembly).ending(ends));
        let (mut measures, mut undecided, mut most) = (Vec::new(), Vec::new(), 0.0_f64);
        for (at, ((error, own), other)) in
            errors.iter_mut().zip(&finest.readings).zip(&earlier).enumerate()
        {
            let Some((value, error)) = own.value.zip(error.as_mut()) else {
                undecided.extend(other.value.and(Some(at)));
                continue;
            };
            let gap = other.value.map_or(f64::INFINITY, |other| (other - value).abs());
            let excess = excess(own, Some(gap), task.settings.accuracy.of(&task.selected[at].key));
            if gap > *error && excess > NOTABLE {
                measures.push(at);
                most = most.max(excess);
            }
            *error += gap;
        }
        let matters = most > 1.0 || !undecided.is_empty();
        matters.then_some(Self { time, measures, undecided })
    }
}
