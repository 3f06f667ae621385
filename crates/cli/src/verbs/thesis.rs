//! `dashpot thesis`.

use std::path::PathBuf;

use clap::Args;
use dashpot_dae::Extremum;
use dashpot_report::{ReportFigure, Table};
use dashpot_thesis::{
    Claim, DURATION, Drawing, Figure, Member, Misprint, Number, NumberVerdict, Recomputation,
    Scales, Verdict, figure_stems, figures,
};
use serde::Serialize;

use crate::{
    error::{CliError, Status},
    folder::{Folder, Staged},
    output::{PAGE, Study, Text, VERSION, csv, emit, list, object},
    terminal::Terminal,
};
use dashpot_studies::sketch::sketch;

/// The same in Markdown.
const MARKDOWN: &str = "report.md";
/// Columns of the equations' numbers.
const PLACE: usize = 13;

/// `thesis`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot thesis                                   numbers, claims with verdicts\n  \
    dashpot thesis --out thesis                      figures, CSV and a report\n  \
    dashpot thesis --json | jq '.claims[] | [.verdict, .claim]'\n\n\
    The values that the figures of the thesis used for a, b, c and d are lost; those shown are chosen. \
    Beside each curve stand its springs, dashpots, q and largest deformation; what exceeds the \
    thickness is dashed.")]
pub(crate) struct ThesisArguments {
    /// Folder for SVG, CSV, JSON, Markdown and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object in place of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn thesis(arguments: &ThesisArguments, terminal: Terminal) -> Result<Status, CliError> {
    let figures = figure_stems()
        .flat_map(|figure_stem| [format!("{figure_stem}.svg"), format!("{figure_stem}.csv")]);
    let names = figures.chain([PAGE, MARKDOWN].map(str::to_owned));
    let folder = Folder::wanted(arguments.out.as_deref(), names)?;
    emit(&Recomputation::new()?, arguments.json, folder, terminal)?;
    Ok(Status::Done)
}

impl Study for Recomputation {
    fn text(&self, text: &mut Text) {
        self.summary().iter().for_each(|own| text.words(own));
        text.heading("Numbers of the text, without those that are given");
        for own in self.numbers.iter().filter(|number| number.verdict != NumberVerdict::Given) {
            let Number { place, what, printed, recomputed, verdict, .. } = own;
            let verdict = verdict.text();
            let words = format!("{what}: printed {printed}, recomputed {recomputed}: {verdict}");
            text.labelled(place, PLACE, &words);
        }
        text.heading("Claims");
        for Claim { place, says, verdict, finding, .. } in &self.claims {
            text.labelled(place, PLACE, &format!("{says}: {}. {finding}", verdict.text()));
        }
    }

    /// Groups and impacts without dimensions, constants of paddings in SI units.
    fn object(&self) -> impl Serialize {
        object! {
            dashpot: VERSION,
            summary: self.summary(),
            numbers: list(self.numbers.iter().map(|number| object! {
                place: number.place, what: number.what, printed: number.printed, value: number.value,
                verdict: number.verdict.text(),
            })),
            misprints: list(self.misprints.iter().map(misprint)),
            claims: list(self.claims.iter().map(claim)),
            families: list(self.study.families().map(|family| object! {
                parameter: family.varied.symbol(),
                members: list(family.members.iter().map(member)),
            })),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        let figures = figures(&self.study)?;
        let mut drawings = Vec::new();
        for figure in &figures {
            let drawing = drawing(figure)?;
            files.add(format!("{}.svg", figure.stem()), &drawing.svg)?;
            let caption = format!("Figure {}. {}", figure.number, figure.title);
            drawings.push(ReportFigure { caption, ..drawing });
            if figure.columns.is_empty() {
                continue;
            }
            let header = figure.columns.iter().map(|column| column.name.clone());
            let count = figure.columns.iter().map(|column| column.values.len()).max().unwrap_or(0);
            // A zero has no sign.
            let value = |row: usize| {
                figure.columns.iter().map(move |column| Some(column.values.get(row)? + 0.0))
            };
            let rows = (0..count).map(|row| list(value(row)));
            files.add_with(format!("{}.csv", figure.stem()), |out| csv(out, header, rows))?;
        }
        files.add(MARKDOWN, self.markdown(&figures))?;
        files.add(PAGE, self.page(drawings).html())
    }
}

fn misprint(misprint: &Misprint) -> impl Serialize {
    let shown = misprint.demonstration.as_ref().map(|demonstration| object! {
        what: demonstration.what, printed_form: demonstration.printed, correct_form: demonstration.correct, expected: demonstration.truth,
    });
    object! { place: misprint.place, printed: misprint.printed, correct: misprint.correct, shown_by: shown }
}

fn claim(claim: &Claim) -> impl Serialize {
    let (verdict, cases) = match &claim.verdict {
        Verdict::Holds => ("holds", &[][..]),
        Verdict::DoesNotHold => ("does not hold", &[][..]),
        Verdict::HoldsOnlyFor(cases) => ("holds in part", &cases[..]),
    };
    let evidence = claim.evidence.iter();
    let evidence =
        list(evidence.map(|Table { caption, header, rows }| object! { caption, header, rows }));
    object! { place: claim.place, claim: claim.says, verdict, cases, finding: &claim.finding, evidence }
}

fn member(member: &Member) -> impl Serialize {
    let pad = member.padding();
    let point = |Extremum { time, value }| object! { value, time };
    object! {
        value: member.value,
        k1: pad.map(|pad| pad.k1),
        c1: pad.map(|pad| pad.c1),
        k2: pad.map(|pad| pad.k2),
        c2: pad.map(|pad| pad.c2),
        q: member.impact.groups.q(),
        peak_force: point(member.impact.peak()),
        largest_deformation: point(member.impact.deepest()),
        release: member.impact.release(),
        exceeds_thickness: member.exceeds(),
    }
}

fn drawing(figure: &Figure) -> Result<ReportFigure, CliError> {
    Ok(match &figure.drawing {
        Drawing::Chart(chart) => ReportFigure::of(chart)?,
        Drawing::Network(network) => {
            let svg = sketch(network, DURATION * Scales::CHAPTER_4.time()).svg();
            ReportFigure::of_sketch("", svg)
        }
    })
}
