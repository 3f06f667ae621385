//! Which points of a sweep keep each limit, and where a limit is crossed.

use dashpot_analysis::{Judgement, Reason};

use super::{
    Swept,
    words::{self, short, shown},
};
use crate::output::{alike, list};

/// Stretches of so many words are told.
const MOST_STRETCHES: usize = 6;

/// How many points keep each limit.
pub(super) fn kept(swept: &Swept) -> Vec<String> {
    let report = &swept.report;
    let sentence = |at: usize| {
        let (column, own) = &report.limits[at];
        let judged = report.judged(at);
        let known = || judged.iter().copied().flatten();
        let count = |which: Judgement| known().filter(|own| *own == which).count();
        let [pass, fail, beyond] =
            [Judgement::Pass, Judgement::Fail, Judgement::Undecided(Reason::Beyond)].map(count);
        let beyond = match beyond {
            0 => String::new(),
            count => {
                format!(" ({count} would pass, but beyond the points of a law or a thickness)")
            }
        };
        let open = match known().filter_map(Judgement::reason).count() {
            0 => String::new(),
            count => format!(", {count} undecided{beyond}"),
        };
        let missing = match judged.iter().filter(|own| own.is_none()).count() {
            0 => String::new(),
            count => format!(", {count} without a value"),
        };
        let limit = words::limit(&report.columns[*column], own);
        let stretches = stretches(swept, at, &judged);
        let [within, by_words] = match &stretches[..] {
            [] => Default::default(),
            [only] => [format!(", {only}"), String::new()],
            several => [String::new(), format!("; it passes for {}", several.join(", for "))],
        };
        let of = judged.len();
        format!(
            "{} {limit}: {pass} of {of} points pass{within}, {fail} fail{open}{missing}{by_words}",
            own.key
        )
    };
    (0..report.limits.len()).map(sentence).collect()
}

/// From where to where a limit is kept over the only number that varies, for each of the words beside it; empty where
/// several numbers vary, or more words than can be read.
fn stretches(swept: &Swept, limit: usize, judged: &[Option<Judgement>]) -> Vec<String> {
    let variations = &swept.varied.variations;
    let numbers: Vec<usize> =
        (0..variations.len()).filter(|&at| !variations[at].is_of_words()).collect();
    let ([number], false) = (&numbers[..], swept.varied.is_of_rows()) else { return Vec::new() };
    let number = *number;
    let place = |point: usize| {
        let places = swept.varied.places(&swept.grid.places(point));
        let words = places.iter().enumerate().filter(|own| own.0 != number);
        let words = list(words.map(|(at, &place)| shown(&variations[at], place))).join(", ");
        (words, (places[number], point))
    };
    let groups = alike((0..judged.len()).map(place), |one, other| one.0 == other.0);
    if groups.len() > MOST_STRETCHES {
        return Vec::new();
    }
    let told = groups.iter().filter_map(|group| {
        let (words, points) = (&group[0].0, &list(group.iter().map(|own| own.1))[..]);
        let stretch = Stretch { swept, limit, number, points }.in_words(judged)?;
        Some(format!("{words} {stretch}").trim_start().to_owned())
    });
    told.collect()
}

/// Points over one number, each with the place of its value.
struct Stretch<'s> {
    swept: &'s Swept,
    limit: usize,
    number: usize,
    points: &'s [(usize, usize)],
}

impl Stretch<'_> {
    /// `from 24 mm to 40 mm (crossed near 23.1 mm)`, where all that pass stand together.
    fn in_words(&self, judged: &[Option<Judgement>]) -> Option<String> {
        let passes = |at: &usize| judged[self.points[*at].1] == Some(Judgement::Pass);
        let first = (0..self.points.len()).find(passes)?;
        let last = (0..self.points.len()).rev().find(passes)?;
        if !(first..=last).all(|at| passes(&at)) {
            return None;
        }
        let before = first.checked_sub(1).and_then(|at| self.crossing(at, first));
        let after = (last + 1 < self.points.len()).then(|| self.crossing(last, last + 1)).flatten();
        let crossed = list(before.into_iter().chain(after)).join(" and ");
        let crossed =
            if crossed.is_empty() { crossed } else { format!(" (crossed near {crossed})") };
        let [from, to] = [first, last]
            .map(|at| shown(&self.swept.varied.variations[self.number], self.points[at].0));
        Some(format!("from {from} to {to}{crossed}"))
    }

    /// Where the straight line between two points meets the bound.
    fn crossing(&self, one: usize, other: usize) -> Option<String> {
        let report = &self.swept.report;
        let (column, ref limit) = report.limits[self.limit];
        let own = &self.swept.varied.variations[self.number];
        let [a, b] = [one, other].map(|at| {
            let (place, point) = self.points[at];
            let value = report.values[point * report.columns.len() + column];
            (own.numbers[place], value - limit.bound.level())
        });
        let is_crossed = a.1.is_finite() && b.1.is_finite() && a.1 * b.1 < 0.0;
        let number = a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1);
        is_crossed.then(|| format!("{} {}", short(number), own.unit).trim_end().to_owned())
    }
}
