//! What a search makes least: one aim, or the largest of several values.

use super::{
    evaluate::Evaluated,
    programme::{Programme, least},
    search::{Search, worst},
};

/// One aim within what is required.
pub(super) struct Direct<'s, 'p> {
    pub(super) search: &'s Search<'p>,
    pub(super) slack: &'s [f64],
    pub(super) unit: f64,
}

impl Programme for Direct<'_, '_> {
    fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let count = self.slack.len();
        let Some(found) = self.search.at(unknowns) else { return vec![f64::NAN; count + 1] };
        let aim = found.aims[0] / self.unit;
        [vec![aim], self.search.excesses(&found, self.slack)].concat()
    }

    fn slopes(&self, unknowns: &[f64]) -> Vec<Vec<f64>> {
        let all = self.search.slopes(unknowns, self.slack);
        let aim = all.iter().map(|own| own[0].first().map_or(f64::NAN, |own| own / self.unit));
        let excess =
            |at: usize| all.iter().map(move |own| own[1].get(at).copied().unwrap_or(f64::NAN));
        let excesses = (0..self.slack.len()).map(|at| excess(at).collect());
        [aim.collect()].into_iter().chain(excesses).collect()
    }
}

/// The largest of several: a further unknown above all of them, which is made least. Of aims within what is required,
/// or of what exceeds.
pub(super) struct Epigraph<'s, 'p> {
    search: &'s Search<'p>,
    slack: &'s [f64],
    is_of_aims: bool,
    /// The further unknown is in this unit …
    unit: f64,
    /// … above this.
    floor: f64,
}

impl<'s, 'p> Epigraph<'s, 'p> {
    pub(super) fn new(
        search: &'s Search<'p>,
        slack: &'s [f64],
        is_of_aims: bool,
        start: &[f64],
    ) -> Option<Self> {
        let found = search.at(start)?;
        let now = if is_of_aims { worst(&found.aims) } else { search.excess(&found, slack) };
        // Everything kept is enough: below −1 nothing exceeds anything.
        let (floor, unit) = if is_of_aims { (0.0, 2.0 * now.abs()) } else { (-0.1, now + 0.2) };
        (unit > 0.0 && unit.is_finite()).then_some(Self { search, slack, is_of_aims, unit, floor })
    }

    /// How many values have to be below zero.
    fn count(&self) -> usize {
        self.slack.len() + if self.is_of_aims { self.search.evaluator.aims() } else { 0 }
    }

    fn soft(&self, found: &Evaluated) -> Vec<f64> {
        if self.is_of_aims { found.aims.clone() } else { self.search.excesses(found, self.slack) }
    }

    fn hard(&self, found: &Evaluated) -> Vec<f64> {
        if self.is_of_aims { self.search.excesses(found, self.slack) } else { Vec::new() }
    }

    pub(super) fn least(&self, start: &[f64]) -> Option<Vec<f64>> {
        let now = worst(&self.soft(&self.search.at(start)?));
        let further = ((now - self.floor) / self.unit).clamp(0.0, 1.0);
        let mut found = least(self, &[start, &[further]].concat())?.unknowns;
        found.pop();
        Some(found)
    }
}

impl Programme for Epigraph<'_, '_> {
    fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let (further, own) = (unknowns[unknowns.len() - 1], &unknowns[..unknowns.len() - 1]);
        let Some(found) = self.search.at(own) else { return vec![f64::NAN; 1 + self.count()] };
        let level = self.floor + self.unit * further;
        let soft = self.soft(&found).into_iter().map(|own| (own - level) / self.unit);
        [further].into_iter().chain(soft).chain(self.hard(&found)).collect()
    }

    fn slopes(&self, unknowns: &[f64]) -> Vec<Vec<f64>> {
        let own = &unknowns[..unknowns.len() - 1];
        let all = self.search.slopes(own, self.slack);
        let mut aim = vec![0.0; own.len()];
        aim.push(1.0);
        let which = usize::from(!self.is_of_aims);
        let softs = all.first().map_or(0, |own| own[which].len());
        let soft = (0..softs).map(|at| {
            let each = all.iter().map(|own| own[which][at] / self.unit);
            each.chain([-1.0]).collect::<Vec<f64>>()
        });
        let hards = if self.is_of_aims { self.slack.len() } else { 0 };
        let hard = (0..hards).map(|at| {
            let each = all.iter().map(|own| own[1].get(at).copied().unwrap_or(f64::NAN));
            each.chain([0.0]).collect::<Vec<f64>>()
        });
        [aim].into_iter().chain(soft).chain(hard).collect()
    }
}
