//! `dashpot thesis`.

use dashpot_dae::Extremum;
use dashpot_plot::{ReportFigure, Table};
use dashpot_thesis::{
    Claim, DURATION, Drawing, Figure, Member, Misprint, Number, NumberVerdict, Recomputation,
    Scales, Verdict, figure_stems, figures,
};
use serde::Serialize;

use crate::{
    args::ThesisArguments,
    error::{CliError, Status},
    folder::{Folder, Staged},
    output::{Study, Text, VERSION, csv, emit, list, object},
    sketch::sketch,
    terminal::Terminal,
};

/// Everything on one page.
const PAGE: &str = "report.html";
/// The same in Markdown.
const MARKDOWN: &str = "report.md";
/// Columns of the equations' numbers.
const PLACE: usize = 13;

/// Recomputes the thesis.
pub(crate) fn thesis(arguments: &ThesisArguments, terminal: Terminal) -> Result<Status, CliError> {
    let figures = figure_stems().flat_map(|own| [format!("{own}.svg"), format!("{own}.csv")]);
    let names = figures.chain([PAGE, MARKDOWN].map(str::to_owned));
    let folder = Folder::wanted(arguments.out.as_deref(), names)?;
    emit(&Recomputation::new()?, arguments.json, folder, terminal)?;
    Ok(Status::Done)
}

impl Study for Recomputation {
    fn text(&self, text: &mut Text) {
        self.summary().iter().for_each(|own| text.words(own));
        text.heading("Numbers of the text, without those that are given");
        for own in self.numbers.iter().filter(|own| own.verdict != NumberVerdict::Given) {
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
            numbers: list(self.numbers.iter().map(|own| object! {
                place: own.place, what: own.what, printed: own.printed, value: own.value,
                verdict: own.verdict.text(),
            })),
            misprints: list(self.misprints.iter().map(misprint)),
            claims: list(self.claims.iter().map(claim)),
            families: list(self.study.families().map(|own| object! {
                parameter: own.varied.symbol(),
                members: list(own.members.iter().map(member)),
            })),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        let figures = figures(&self.study)?;
        let mut drawings = Vec::new();
        for own in &figures {
            let svg = svg(own)?;
            files.add(format!("{}.svg", own.stem()), &svg)?;
            let caption = format!("Figure {}. {}", own.number, own.title);
            drawings.push(ReportFigure { caption, svg });
            if own.columns.is_empty() {
                continue;
            }
            let header = own.columns.iter().map(|own| own.name.clone());
            let count = own.columns.iter().map(|own| own.values.len()).max().unwrap_or(0);
            // A zero has no sign.
            let value =
                |row: usize| own.columns.iter().map(move |own| Some(own.values.get(row)? + 0.0));
            let rows = (0..count).map(|row| list(value(row)));
            files.add_with(format!("{}.csv", own.stem()), |out| csv(out, header, rows))?;
        }
        files.add(MARKDOWN, self.markdown(&figures))?;
        files.add(PAGE, self.page(drawings).html())
    }
}

fn misprint(own: &Misprint) -> impl Serialize {
    let shown = own.demonstration.as_ref().map(|own| object! {
        what: own.what, printed_form: own.printed, correct_form: own.correct, expected: own.truth,
    });
    object! { place: own.place, printed: own.printed, correct: own.correct, shown_by: shown }
}

fn claim(own: &Claim) -> impl Serialize {
    let (verdict, cases) = match &own.verdict {
        Verdict::Holds => ("holds", &[][..]),
        Verdict::DoesNotHold => ("does not hold", &[][..]),
        Verdict::HoldsOnlyFor(cases) => ("holds in part", &cases[..]),
    };
    let evidence = own.evidence.iter();
    let evidence =
        list(evidence.map(|Table { caption, header, rows }| object! { caption, header, rows }));
    object! { place: own.place, claim: own.says, verdict, cases, finding: &own.finding, evidence }
}

fn member(own: &Member) -> impl Serialize {
    let pad = own.impact.groups.padding(&Scales::CHAPTER_4);
    let point = |Extremum { time, value }| object! { value, time };
    object! {
        value: own.value,
        k1: pad.map(|own| own.k1),
        c1: pad.map(|own| own.c1),
        k2: pad.map(|own| own.k2),
        c2: pad.map(|own| own.c2),
        q: own.impact.groups.q(),
        peak_force: point(own.impact.peak()),
        largest_deformation: point(own.impact.deepest()),
        release: own.impact.release(),
        exceeds_thickness: own.exceeds(),
    }
}

fn svg(figure: &Figure) -> Result<String, CliError> {
    Ok(match &figure.drawing {
        Drawing::Chart(chart) => chart.svg()?,
        Drawing::Network(network) => sketch(network, DURATION * Scales::CHAPTER_4.time()).svg(),
    })
}
