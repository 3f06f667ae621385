//! What a fit of numbers of a scene says.

use dashpot_analysis::Missing;
use dashpot_fit::network::{Convergence, Interval, Kind, NetworkFit, NoBand, Source};
use dashpot_report::Table;
use serde::Serialize;

use super::{
    among::Among, files::write_fitted_scene, scene::FittedScene, seen::Seen, shown::Shown,
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    output::{Study, Text, list},
    unevaluated,
    varied::Varied,
    verbs::run::measure_text,
};
use dashpot_report::numbers::{percent_signed, quantity, significant};

/// Digits of fitted values.
const DIGITS: usize = 4;
/// Digits of times and residuals.
const FEW: usize = 3;
/// Runs are solved to this part of their measures at least: a band that is narrower tells of rounding.
const SOLVED: f64 = 1e-6;
/// What is said of a search that an interrupt ended.
const STOPPED: &str = "not finished: the search was interrupted. These numbers are the best that it had met, and no \
                       minimum; there are no intervals, and nothing was left out";
/// More others are not listed.
const MOST_OTHERS: usize = 3;

/// A value in the unit of a number, of a constant of a form in that which suits it.
fn value(own: &Varied, value: f64) -> String {
    if own.at.is_none() {
        return quantity(value, &own.si, DIGITS);
    }
    own.text(value, DIGITS)
}

fn ends(own: &Varied, found: &Interval) -> [String; 2] {
    found.ends.map(|end| end.map_or_else(|| "no bound".to_owned(), |end| value(own, end)))
}

impl FittedScene<'_> {
    pub(super) fn verdict(&self, at: usize) -> &'static str {
        let own = &self.fit.numbers[at];
        match own {
            Interval { is_on_bound: true, .. } => "on its bound",
            _ if !self.fit.is_converged() => "not converged",
            _ if self.is_open() => "not identified",
            _ if self.fit.is_identified(at) && !self.is_entangled(at) => "identified",
            _ => "not identified",
        }
    }

    /// Whether something could not be evaluated within the intervals of all numbers.
    fn is_open(&self) -> bool {
        let numbers = &self.fit.numbers;
        self.missing.iter().any(|(place, _)| {
            numbers.iter().zip(place).all(|(own, at)| {
                let [low, high] = own.ends;
                low.is_none_or(|low| low <= *at) && high.is_none_or(|high| *at <= high)
            })
        })
    }

    /// What could not be evaluated.
    fn missed(&self) -> Vec<String> {
        let place = |own: &Missing| {
            let each = self.numbers.iter().zip(&own.values);
            list(each.map(|(own, at)| format!("{} = {}", own.name, value(own, *at)))).join(", ")
        };
        unevaluated::sentences(&self.unevaluated, "curve", place)
    }

    /// Whether the structure says that it cannot be told.
    fn is_entangled(&self, at: usize) -> bool {
        self.shown.iter().any(|own| own.numbers.contains(&self.numbers[at].name))
    }

    /// The tests with what was found of them.
    fn each(&self) -> impl Iterator<Item = Seen<'_>> {
        let tests = self.plan.tests.iter().zip(&self.fit.tests);
        let each = self.plan.curves.iter().zip(tests);
        each.map(|((asked, curve), (test, own))| Seen { asked, curve, test, own })
    }

    fn numbers_table(&self) -> Table {
        let rows = self.numbers.iter().zip(&self.fit.numbers).enumerate();
        let rows = rows.map(|(at, (own, found))| {
            let [low, high] = ends(own, found);
            let verdict = self.verdict(at).to_owned();
            vec![own.name.clone(), value(own, found.value), low, high, verdict]
        });
        Table::new("Numbers", &["", "value", "from", "to", ""], rows)
    }

    fn tests_table(&self) -> Table {
        let rows = self.each().map(|test| {
            let Seen { asked, curve, own, .. } = test;
            let has_clock = curve.output.kind() != Kind::Modulus;
            let if_any = |word: String| if has_clock { word } else { String::new() };
            vec![
                asked.file.clone(),
                curve.output.key(),
                test.of(own.rms),
                percent_signed(own.model_peak / own.measured_peak - 1.0),
                own.held_out.map_or_else(String::new, |own| percent_signed(own.peak)),
                if_any(quantity(own.shift, "s", FEW)),
                if_any(test.of(own.offset)),
            ]
        });
        let header =
            ["file", "output", "rms", "peak off by", "when left out", "clock late by", "zero at"];
        Table::new("Tests", &header, rows)
    }

    /// What tests have to themselves besides, and what noise there is.
    fn own_table(&self) -> Option<Table> {
        let is_more = self.plan.tests.iter().any(|own| {
            own.gain.is_some()
                || own.filter.is_some()
                || own.noise.is_some()
                || !own.known.is_empty()
        });
        let rows = self.each().zip(&self.plan.known).map(|(test, known)| {
            let Seen { asked, own, test: measured, .. } = test;
            let known = known.iter().zip(&own.known);
            let known = known.map(|(own, found)| format!("{} {}", own.name, value(own, *found)));
            let cfc = measured.filter.map(|own| own.0.class().to_string());
            let gain = measured.gain.map(|_| percent_signed(own.gain - 1.0));
            vec![
                asked.file.clone(),
                cfc.unwrap_or_default(),
                test.of(own.noise),
                own.noise_at_rest.map_or_else(String::new, |own| test.of(own)),
                gain.unwrap_or_default(),
                list(known).join(", "),
            ]
        });
        let header =
            ["file", "CFC", "noise of a sample", "before the impact", "gain", "its own numbers"];
        is_more.then(|| Table::new("Records", &header, rows))
    }

    /// What the uncertainty of the numbers makes of the measures.
    fn measures_table(&self) -> Table {
        let rows = self.measures.iter().map(|own| {
            let of = |value, digits| measure_text(&own.key, value, own.unit, digits);
            let (value, least) = (own.band.value, SOLVED * own.band.value.abs());
            let half = match own.band.half {
                Ok(half) if half < least => format!("< {}", of(least, 1)),
                Ok(half) => format!("± {}", of(half, 2)),
                Err(why) => no_band(why).to_owned(),
            };
            let bent = if own.band.is_bent { "curved: an order only" } else { "" };
            vec![own.key.clone(), of(value, DIGITS), half, bent.to_owned()]
        });
        Table::new("The fitted scene", &["", "value", "from the numbers", ""], rows)
    }

    /// What comes first.
    fn said_first(&self) -> Vec<String> {
        let fit = &self.fit;
        let mut all: Vec<String> = self.missed();
        all.extend(self.among.iter().filter_map(Among::said_first));
        if fit.is_stopped {
            all.push(STOPPED.to_owned());
        } else {
            all.extend(unconverged(fit));
        }
        if let Some(why) = self.scatter().err().filter(|_| self.plan.arguments.scatter) {
            all.push(format!("no scatter is written: {why}"));
        }
        for (at, own) in
            self.numbers.iter().enumerate().filter(|own| fit.numbers[own.0].is_on_bound)
        {
            let bounds = own.bounds.map(|bound| value(own, bound));
            let found = value(own, fit.numbers[at].value);
            all.push(format!(
                "`{}` is on a bound of {} to {}, at {found}: it has no interval, those of the others hold only with it there, and none is identified",
                own.name, bounds[0], bounds[1]
            ));
        }
        if !fit.others.is_empty() {
            let others = fit.others.iter().take(MOST_OTHERS).map(|other| {
                let each = self.numbers.iter().zip(&other.values);
                let each =
                    each.map(|(own, found)| format!("{} = {}", own.name, value(own, *found)));
                each.collect::<Vec<_>>().join(", ")
            });
            let others = others.collect::<Vec<_>>().join("; ");
            all.push(format!("noise does not tell this minimum from others: {others}"));
        }
        all.extend(self.shown.iter().map(undetermined));
        let duration = self.plan.scene.run.duration;
        all.extend(self.each().flat_map(|own| own.said_first(duration)));
        all
    }

    fn remarks(&self) -> Vec<String> {
        let fit = &self.fit;
        let [reached, solved] = fit.reached;
        let mut all = vec![format!(
            "{reached} of {solved} starts lead to this minimum{}{}",
            if fit.is_converged() {
                "; intervals are those of 95 % from the covariance there"
            } else {
                ""
            },
            if fit.correlation > 1.5 {
                format!(
                    ", with {} rows for one that is independent, as the residuals follow each other",
                    significant(fit.correlation, 2)
                )
            } else {
                String::new()
            }
        )];
        all.extend(self.among.iter().map(Among::remark));
        let profiled = self.numbers.iter().zip(&fit.numbers);
        let is_one = |own: &Interval| own.source == Source::Profile && own.ends != [None; 2];
        let profiled = profiled.filter(|own| is_one(own.1));
        let profiled: Vec<String> = list(profiled.map(|own| format!("`{}`", own.0.name)));
        if !profiled.is_empty() {
            all.push(format!(
                "of {} they are those of the profile likelihood: how far it may be held elsewhere, with all else \
                 fitted to that",
                profiled.join(", ")
            ));
        }
        if fit.outliers > 0 {
            let rows = if fit.outliers == 1 { "row is" } else { "rows are" };
            all.push(format!(
                "{} {rows} far off and counted by the magnitude of that, not its square; `--robust off` counts all \
                 alike",
                fit.outliers
            ));
        }
        all.extend(self.each().enumerate().flat_map(|(at, own)| own.remarks(at)));
        if let [_] = fit.tests[..] {
            all.push(
                "one test tells nothing of how the scene carries to another height, mass or temperature".to_owned(),
            );
        }
        all
    }

    /// The answer in a few lines.
    pub(super) fn verdict_lines(&self) -> Vec<String> {
        let each = self.numbers.iter().zip(&self.fit.numbers).enumerate();
        let each = each.map(|(at, (own, found))| {
            let ([low, high], verdict) = (ends(own, found), self.verdict(at));
            format!("{} = {} ({low} to {high}), {verdict}", own.name, value(own, found.value))
        });
        each.collect()
    }

    /// All tables.
    pub(super) fn tables(&self) -> Vec<Table> {
        let measures = (!self.measures.is_empty()).then(|| self.measures_table());
        let own = [self.numbers_table(), self.tests_table()].into_iter();
        own.chain(self.own_table()).chain(measures).collect()
    }

    /// What stands above the scene.
    pub(super) fn comments(&self) -> Vec<String> {
        let tests = self.each().map(|test| {
            let (file, key) = (&test.asked.file, test.curve.output.key());
            format!("{file} ({key}, {} rms)", test.of(test.own.rms))
        });
        let unfinished = match self.fit.convergence {
            _ if self.fit.is_stopped => "not finished: ",
            Convergence::Reached => "",
            Convergence::Alone | Convergence::Unsettled => "not converged: ",
        };
        let head = format!("{unfinished}fitted to {}", tests.collect::<Vec<_>>().join(", "));
        [head].into_iter().chain(self.verdict_lines()).collect()
    }
}

/// Why there is no band, or no scatter, in words.
pub(super) fn no_band(own: NoBand) -> &'static str {
    match own {
        NoBand::NotConverged => "the search has not converged",
        NoBand::OnBound => "a number is on its bound",
        NoBand::Contradicted => "the rows contradict it",
        NoBand::Clipped => "a record is clipped",
        NoBand::Missed => "more than noise is left",
        NoBand::OtherMinimum => "there is another minimum",
        NoBand::NotDetermined => "not determined",
        _ => "not computed",
    }
}

/// Numbers of which only some constants are determined.
fn undetermined(own: &Shown) -> String {
    let constants = own.constants.iter().map(|(name, value, ends, unit)| {
        let of = |value: f64| quantity(value, unit, DIGITS);
        let ends =
            ends.map_or(String::new(), |[low, high]| format!(" ({} to {})", of(low), of(high)));
        format!("{name} {}{ends}", of(*value))
    });
    format!(
        "{} cannot all be told apart by any test of `{}`, only {}",
        own.numbers.join(", "),
        own.element,
        constants.collect::<Vec<_>>().join(", ")
    )
}

/// What there is to say of a search that did not converge.
fn unconverged(fit: &NetworkFit) -> Option<String> {
    match fit.convergence {
        Convergence::Reached => None,
        Convergence::Unsettled => Some(
            "the search has not converged: these numbers are not at a minimum, and have no intervals".to_owned(),
        ),
        Convergence::Alone => Some(format!(
            "the search has not converged: only one of {} starts leads to this minimum, and there may be a lower one, so \
             there are no intervals: search from more starts (`--starts`), or within narrower bounds",
            fit.reached[1]
        )),
    }
}

impl Study for FittedScene<'_> {
    fn warnings(&self) -> Vec<String> {
        self.said_first()
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&self.said_first());
        text.title(title(&self.plan.scene));
        self.among.iter().for_each(|own| text.table(&own.table()));
        self.tables().iter().for_each(|own| text.table(own));
        text.blank();
        text.items(self.remarks());
    }

    fn notes(&self) -> Vec<String> {
        self.remarks()
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        write_fitted_scene(files, self)
    }

    fn object(&self) -> impl Serialize {
        super::scene_object::object_of(self)
    }
}
