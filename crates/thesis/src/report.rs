//! All of it as one report, in Markdown and as a page.

use std::fmt::Write as _;

use dashpot_report::{Page, ReportFigure, Table};

use crate::{
    Claim, EQUATIONS, Figure, Misprint, Number, NumberVerdict, Study, ThesisError, Verdict, claims,
    misprint_table, misprints,
    numbers::{chapter_3_table, exact_table, fit_table, number_table, numbers},
};

/// Title of the report.
const TITLE: &str = "The thesis, recomputed";
/// What stands in place of figure 3.
const FIGURE_3: &str = "In place of figure 3: what the analogue computer integrated";

/// Everything that is recomputed, but for the figures.
#[derive(Debug)]
pub struct Recomputation {
    /// The impacts that it is read off.
    pub study: Study,
    /// Numbers of the text.
    pub numbers: Vec<Number>,
    /// Misprints.
    pub misprints: Vec<Misprint>,
    /// Claims beside evidence.
    pub claims: Vec<Claim>,
}

impl Recomputation {
    /// Computes all of it.
    ///
    /// # Errors
    ///
    /// As [`Study::new`], [`misprints`] and [`claims`](crate::claims()); the thesis' own paddings give none.
    pub fn new() -> Result<Self, ThesisError> {
        let study = Study::new()?;
        Ok(Self {
            numbers: numbers(&study)?,
            misprints: misprints(&study)?,
            claims: claims(&study)?,
            study,
        })
    }

    /// What came out, in a few lines.
    pub fn summary(&self) -> Vec<String> {
        let count = |of: fn(&NumberVerdict) -> bool| {
            self.numbers.iter().filter(|number| of(&number.verdict)).count()
        };
        let judged = self.numbers.len() - count(|own| matches!(own, NumberVerdict::Given));
        let right = count(|own| matches!(own, NumberVerdict::Right | NumberVerdict::Rounded));
        let cut = count(|own| matches!(own, NumberVerdict::Truncated));
        let holding = |of: fn(&Verdict) -> bool| {
            self.claims.iter().filter(|claim| of(&claim.verdict)).count()
        };
        let hold = holding(|own| matches!(own, Verdict::Holds));
        let partly = holding(|own| matches!(own, Verdict::HoldsOnlyFor(_)));
        vec![
            format!(
                "Of {judged} numbers of the text that can be recomputed, {right} are right to their \
                 digits, {cut} are cut off, {} are not: they are off, misprinted, or right in part.",
                judged - right - cut
            ),
            format!("{} misprints, with the correct forms.", self.misprints.len()),
            format!(
                "Of {} claims {hold} hold, {partly} hold in part, {} do not hold.",
                self.claims.len(),
                self.claims.len() - hold - partly
            ),
        ]
    }

    /// The tables of numbers: those of the text, chapter III, the exact impact, and the best pulse.
    pub fn number_tables(&self) -> [Table; 4] {
        [
            number_table(&self.numbers),
            chapter_3_table(),
            exact_table(&self.study),
            fit_table(&self.study),
        ]
    }

    /// The claims with their verdicts and findings.
    pub fn claim_table(&self) -> Table {
        let row = |claim: &Claim| {
            let says = claim.says.to_owned();
            vec![claim.place.to_owned(), says, claim.verdict.text(), claim.finding.clone()]
        };
        Table::new(
            "Claims beside the exact impact",
            &["place", "claim", "verdict", "finding"],
            self.claims.iter().map(row),
        )
    }

    fn family_tables(&self) -> Vec<Table> {
        self.study.families().map(crate::Family::table).collect()
    }

    /// The report as a page, with the drawings in the order of the figures.
    pub fn page(&self, drawings: Vec<ReportFigure>) -> Page {
        let equations = Table::plain(FIGURE_3, EQUATIONS.iter().map(|own| vec![(*own).to_owned()]));
        let mut tables = self.number_tables().to_vec();
        tables.extend([misprint_table(&self.misprints), self.claim_table(), equations]);
        tables.extend(self.family_tables());
        let evidence = self.claims.iter().flat_map(|claim| {
            claim.evidence.iter().map(|table| Table {
                caption: format!("{} ({}): {}", claim.place, claim.verdict.text(), table.caption),
                ..table.clone()
            })
        });
        Page {
            title: TITLE.to_owned(),
            verdict: self.summary(),
            tables,
            figures: drawings,
            details: evidence.collect(),
            ..Page::default()
        }
    }

    /// The report in Markdown; figures are pictures beside it, named by their
    /// [stems](Figure::stem).
    pub fn markdown(&self, figures: &[Figure]) -> String {
        let mut text = format!("# {TITLE}\n\n");
        for line in self.summary() {
            let _ = writeln!(text, "- {line}");
        }
        for table in &self.number_tables() {
            text += &section(table, 2);
        }
        text += &section(&misprint_table(&self.misprints), 2);
        text += "\n## Claims beside the exact impact\n";
        for claim in &self.claims {
            let _ = writeln!(
                text,
                "\n### {}: {}\n\n**{}.** {}",
                claim.place,
                claim.says,
                capital(&claim.verdict.text()),
                claim.finding
            );
            claim.evidence.iter().for_each(|table| text += &section(table, 4));
        }
        let _ = writeln!(text, "\n## {FIGURE_3}\n\n```text\n{}\n```", EQUATIONS.join("\n"));
        text += "\n## Families of the figures\n";
        self.family_tables().iter().for_each(|table| text += &section(table, 3));
        text += "\n## Figures\n";
        for figure in figures {
            let _ = writeln!(
                text,
                "\n![Figure {}. {}]({}.svg)",
                figure.number,
                figure.title,
                figure.stem()
            );
        }
        text
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A table in Markdown under a heading of this level.
fn section(table: &Table, level: usize) -> String {
    let columns = table.rows.iter().map(Vec::len).fold(table.header.len(), usize::max);
    let line = |cells: &[String]| {
        let cell =
            |at: usize| cells.get(at).map_or_else(String::new, |cell| cell.replace('|', "\\|"));
        let cells: Vec<String> = (0..columns).map(cell).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let mut text = format!("\n{} {}\n\n", "#".repeat(level), table.caption);
    text += &line(&table.header);
    let _ = writeln!(text, "|{}", "---|".repeat(columns));
    table.rows.iter().for_each(|row| text += &line(row));
    text
}
