//! What many scenes by many methods come to.

use std::fmt;

use dashpot::analysis::{MeasureReport, RunReport};

use super::table::Entry;

/// What rounding of the reference and of the text makes, in parts of the largest measure of the same unit.
const ROUNDING: f64 = 1e-13;
/// Part of the values that may be beyond one bar.
const BEYOND_ONE: f64 = 0.01;
/// Bars beyond which no value may be.
const FARTHEST: f64 = 3.0;

/// A tally of values.
#[derive(Debug, Default)]
pub(super) struct Tally {
    runs: usize,
    /// Scenes, or runs of them, that are left out.
    pub(super) known: usize,
    values: usize,
    /// Values that are told to be anywhere, or not at all.
    open: usize,
    beyond_one: Vec<String>,
    beyond_three: Vec<String>,
    pub(super) too_long: Vec<String>,
    pub(super) failed: Vec<String>,
}

/// The measure over the whole run, or over the impact.
fn find<'a>(report: &'a RunReport, key: &str) -> Option<&'a MeasureReport> {
    if let Some(key) = key.strip_suffix("@impact") {
        return report.measure(key);
    }
    report.measure(&format!("{key}-2")).or_else(|| report.measure(key))
}

impl Tally {
    pub(super) fn add(&mut self, name: &str, entry: &Entry, report: &RunReport) {
        self.runs += 1;
        for (key, truth, threshold) in &entry.values {
            let Some(found) = find(report, key) else {
                self.failed.push(format!("{name}: no {key}"));
                continue;
            };
            let (Some(value), Some(bar)) = (found.value, found.error) else {
                self.open += 1;
                continue;
            };
            self.values += 1;
            let alike = report.measures.iter().filter(|measure| measure.unit == found.unit);
            let size = alike.map(|alike| alike.size).fold(0.0, f64::max);
            let gap = (value - truth).abs() - 3.0 * threshold - ROUNDING * size;
            let line =
                || format!("{name}: {key} = {value:e} ± {bar:.1e}, {truth:e} ± {threshold:.0e}");
            if gap > FARTHEST * bar {
                self.beyond_three.push(line());
            } else if gap > bar {
                self.beyond_one.push(line());
            }
        }
    }

    pub(super) fn is_good(&self) -> bool {
        let beyond = self.beyond_one.len() + self.beyond_three.len();
        self.beyond_three.is_empty()
            && beyond as f64 <= BEYOND_ONE * self.values as f64
            && self.failed.is_empty()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            formatter,
            "{} runs, {} left out; {} values and {} open ones: {} beyond one bar, {} beyond three; \
             {} runs too long, {} failed",
            self.runs,
            self.known,
            self.values,
            self.open,
            self.beyond_one.len(),
            self.beyond_three.len(),
            self.too_long.len(),
            self.failed.len(),
        )?;
        let lists = [
            ("beyond three", &self.beyond_three),
            ("beyond one", &self.beyond_one),
            ("too long", &self.too_long),
            ("failed", &self.failed),
        ];
        for (head, lines) in lists {
            for line in lines {
                writeln!(formatter, "{head}: {line}")?;
            }
        }
        Ok(())
    }
}
