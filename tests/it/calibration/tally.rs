//! What the trials of many scenes come to.

use std::{collections::BTreeMap, fmt::Write as _, time::Duration};

use super::{
    scenes::{Kind, kinds},
    trial::{Judged, Outcome},
};

/// Trials of one method.
#[derive(Debug, Default, Clone)]
pub(super) struct Tally {
    /// Scenes that were judged.
    pub(super) scenes: usize,
    /// Those of them with the truth of every measure inside its bar.
    pub(super) inside: usize,
    pub(super) measures: usize,
    pub(super) measures_outside: usize,
    /// Bars in parts of the true error.
    ratios: Vec<f64>,
    /// Scenes with a measure whose bar exceeds the accuracy wanted.
    unreached: usize,
    /// Scenes whose truth is not known well enough.
    unknown: usize,
    /// Scenes that it was not given the time for.
    too_long: usize,
    pub(super) failed: usize,
    time: Duration,
    /// What is outside, and what failed.
    pub(super) remarks: Vec<String>,
}

impl Tally {
    pub(super) fn add(&mut self, name: &str, outcome: Outcome) {
        match outcome {
            Outcome::Judged(judged) => self.add_judged(name, judged),
            Outcome::Declined => {}
            Outcome::TooLong => self.too_long += 1,
            Outcome::Unknown => self.unknown += 1,
            Outcome::Failed(why) => {
                self.failed += 1;
                self.remarks.push(format!("{name} fails: {why}"));
            }
        }
    }

    fn add_judged(&mut self, name: &str, judged: Judged) {
        self.scenes += 1;
        self.inside += usize::from(judged.outside.is_empty());
        self.measures += judged.measures;
        self.measures_outside += judged.outside.len();
        self.unreached += usize::from(judged.unreached > 0);
        self.ratios.extend(judged.ratios);
        self.time += judged.time;
        self.remarks.extend(judged.outside.iter().map(|own| format!("{name}: {own}")));
    }

    /// Both together.
    pub(super) fn with(mut self, other: &Self) -> Self {
        self.scenes += other.scenes;
        self.inside += other.inside;
        self.measures += other.measures;
        self.measures_outside += other.measures_outside;
        self.ratios.extend(&other.ratios);
        self.unreached += other.unreached;
        self.unknown += other.unknown;
        self.too_long += other.too_long;
        self.failed += other.failed;
        self.time += other.time;
        self.remarks.extend(other.remarks.iter().cloned());
        self
    }

    /// It as a row of a table in Markdown.
    fn row(&self, method: &str, scenes: &str) -> String {
        let inside = self.measures - self.measures_outside;
        format!(
            "| `{method}` | {scenes} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.0} ms |\n",
            self.scenes,
            percent(self.coverage()),
            percent(inside as f64 / self.measures.max(1) as f64),
            digits(self.ratio(0.5)),
            digits(self.ratio(0.9)),
            self.unreached,
            self.failed,
            self.too_long,
            self.unknown,
            1e3 * self.time.as_secs_f64() / self.scenes.max(1) as f64,
        )
    }

    /// Part of the scenes inside of all bars.
    pub(super) fn coverage(&self) -> f64 {
        self.inside as f64 / self.scenes.max(1) as f64
    }

    /// The bar in parts of the error, so that a part `rank` of all is smaller.
    pub(super) fn ratio(&self, rank: f64) -> f64 {
        let mut sorted = self.ratios.clone();
        sorted.sort_by(f64::total_cmp);
        let at = (rank * sorted.len() as f64) as usize;
        sorted.get(at.min(sorted.len().saturating_sub(1))).copied().unwrap_or(0.0)
    }
}

/// Trials of all methods, by method and kind of scenes.
#[derive(Debug, Default)]
pub(super) struct Tallies {
    of: BTreeMap<(&'static str, &'static str), Tally>,
}

impl Tallies {
    /// Adds a trial of the scene `name`.
    pub(super) fn add(
        &mut self,
        method_and_kind: (&'static str, &'static str),
        name: &str,
        outcome: Outcome,
    ) {
        self.of.entry(method_and_kind).or_default().add(name, outcome);
    }

    /// What is outside, and what failed.
    pub(super) fn remarks(&self) -> Vec<String> {
        self.of.values().flat_map(|own| own.remarks.iter().cloned()).collect()
    }

    /// Those of one method and some kinds.
    pub(super) fn of(&self, method: &str, is_wanted: impl Fn(&Kind) -> bool) -> Tally {
        let wanted = kinds().filter(|kind| is_wanted(kind));
        let own = wanted.filter_map(|kind| self.of.get(&(method, kind.name)));
        own.fold(Tally::default(), Tally::with)
    }

    /// All of it, with what `auto` has `chosen`, as two tables in Markdown.
    pub(super) fn tables(&self, methods: &[&str], chosen: &Tally) -> String {
        let mut text = String::from(
            "| method | scenes | judged | inside | measures inside | median | 90 % | not reached | \
             failed | too long | truth unknown | time |\n\
             |---|---|---|---|---|---|---|---|---|---|---|---|\n",
        );
        for method in methods {
            for (name, is_wanted) in PARTS {
                text += &self.of(method, is_wanted).row(method, name);
            }
        }
        text += &chosen.row("auto", "not linear, or switching");
        let heads: Vec<String> = methods.iter().map(|method| format!(" `{method}` |")).collect();
        let heads = heads.concat();
        let _ = write!(text, "\n| scenes |{heads}\n|---|{}\n", "---|".repeat(methods.len()));
        for kind in kinds() {
            let _ = write!(text, "| {} |", kind.name);
            for method in methods {
                let own = self.of(method, |other| other.name == kind.name);
                let _ = match own.scenes {
                    0 => write!(text, " |"),
                    scenes => {
                        write!(text, " {} of {scenes}, {} |", own.inside, digits(own.ratio(0.5)))
                    }
                };
            }
            text.push('\n');
        }
        text
    }
}

/// A name, and which kinds of scenes it stands for.
type Part = (&'static str, fn(&Kind) -> bool);

/// Which kinds of scenes the table takes together.
const PARTS: [Part; 3] = [
    ("all", |_| true),
    ("linear", |kind| kind.is_linear),
    ("not linear, or switching", |kind| !kind.is_linear),
];

fn percent(part: f64) -> String {
    format!("{:.1} %", 100.0 * part)
}

fn digits(number: f64) -> String {
    if number < 10.0 { format!("{number:.1}") } else { format!("{number:.0}") }
}
