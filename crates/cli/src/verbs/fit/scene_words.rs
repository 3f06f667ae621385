//! What a fit of numbers of a scene says.

use dashpot_analysis::Missing;
use dashpot_fit::network::{Convergence, Interval, Kind, NetworkFit, Source, Test, TestFit};
use dashpot_plot::Table;
use serde::Serialize;

use super::{
    among::Among, files::write_fitted_scene, scene::FittedScene, shown::Shown, target::Compared,
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    numbers::{percent_signed, quantity, significant},
    output::{Study, Text, list},
    unevaluated,
    varied::Varied,
};

/// Digits of fitted values.
const DIGITS: usize = 4;
/// Digits of times and residuals.
const FEW: usize = 3;
/// A peak that is missed by more than this part is told first.
const MISSED: f64 = 0.05;
/// A record that ends behind the run by more than this part of it is told.
const BEYOND: f64 = 0.01;
/// What is left of a record in parts of its noise, beyond which it is not noise alone.
const NOISIER: f64 = 1.5;
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

impl FittedScene {
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
        let rows = self.curves.iter().zip(&self.fit.tests).map(|((asked, curve), own)| {
            let of = |value: f64| curve.output.told(value, FEW);
            let peak = own.model_peak / own.measured_peak - 1.0;
            let held_out = own.held_out.map_or_else(String::new, |own| percent_signed(own.peak));
            let has_clock = curve.output.kind() != Kind::Modulus;
            let if_any = |word: String| if has_clock { word } else { String::new() };
            vec![
                asked.file.clone(),
                curve.output.key(),
                of(own.rms),
                percent_signed(peak),
                held_out,
                if_any(quantity(own.shift, "s", FEW)),
                if_any(of(own.offset)),
            ]
        });
        let header =
            ["file", "output", "rms", "peak off by", "when left out", "clock late by", "zero at"];
        Table::new("Tests", &header, rows)
    }

    /// What tests have to themselves besides, and what noise there is.
    fn own_table(&self) -> Option<Table> {
        let is_more = self.tests.iter().any(|own| {
            own.gain.is_some()
                || own.filter.is_some()
                || own.noise.is_some()
                || !own.known.is_empty()
        });
        let rows = self.curves.iter().zip(&self.fit.tests).enumerate().map(|(at, both)| {
            let ((asked, curve), own) = both;
            let of = |value: f64| curve.output.told(value, FEW);
            let cfc =
                self.tests[at].filter.map_or_else(String::new, |own| own.0.class().to_string());
            let gain =
                self.tests[at].gain.map_or_else(String::new, |_| percent_signed(own.gain - 1.0));
            let known = self.known[at].iter().zip(&own.known);
            let known = known.map(|(own, found)| format!("{} {}", own.name, value(own, *found)));
            let at_rest = own.noise_at_rest.map_or_else(String::new, of);
            vec![
                asked.file.clone(),
                cfc,
                of(own.noise),
                at_rest,
                gain,
                known.collect::<Vec<_>>().join(", "),
            ]
        });
        let header =
            ["file", "CFC", "noise of a sample", "before the impact", "gain", "its own numbers"];
        is_more.then(|| Table::new("Records", &header, rows))
    }

    /// What the uncertainty of the numbers makes of the measures.
    fn measures_table(&self) -> Table {
        let rows = self.measures.iter().map(|own| {
            let of = |value: f64| quantity(value, own.unit, DIGITS);
            let half = own.band.half.map_or("not determined".to_owned(), |half| {
                format!("± {}", quantity(half, own.unit, 2))
            });
            let bent = if own.band.is_bent { "curved: an order only" } else { "" };
            vec![own.key.clone(), of(own.band.value), half, bent.to_owned()]
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
        if let Some(why) = self.scatter().err().filter(|_| self.has_scatter) {
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
        all.extend(self.curves.iter().zip(&fit.tests).filter_map(|((asked, _), own)| {
            let held_out = own.held_out.map(|own| own.peak).filter(|off| off.abs() > MISSED)?;
            Some(format!(
                "fitted to the other tests alone, the peak of {} is off by {}: the scene does not carry from one \
                 test to the other",
                asked.file,
                percent_signed(held_out)
            ))
        }));
        let duration = self.scene.run.duration;
        all.extend(self.curves.iter().zip(&fit.tests).filter_map(|((asked, curve), own)| {
            let Compared::Output(_) = curve.output else { return None };
            let last = curve.rows.last()?.0 - own.shift;
            (last > duration * (1.0 + BEYOND)).then(|| {
                format!(
                    "{} goes on for {} behind the end of the run, where the last value stands: give the scene a \
                     longer `duration`",
                    asked.file,
                    quantity(last - duration, "s", FEW)
                )
            })
        }));
        let each = || self.curves.iter().zip(&fit.tests).zip(&self.tests);
        all.extend(each().filter_map(|(((asked, curve), own), _)| {
            other_zero(own, &asked.file, &|own| curve.output.told(own, FEW))
        }));
        all.extend(each().filter_map(|(((asked, curve), own), test)| {
            misses(&asked.file, &curve.output.key(), own, test)
        }));
        all.extend(each().filter_map(|(((asked, curve), own), test)| {
            let scatter = own.scatter.map(|own| own.deviation);
            let known = test.noise.or(scatter).or(own.noise_at_rest)?;
            (own.noise > NOISIER * known).then(|| {
                let of = |value: f64| curve.output.told(value, FEW);
                format!(
                    "{}: what is left is {} where noise is {}: the scene, or what is said of the record, is not quite \
                     what was tested, and intervals tell nothing of that",
                    asked.file,
                    of(own.noise),
                    of(known)
                )
            })
        }));
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
        let profiled = profiled.filter(|own| own.1.source == Source::Profile);
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
        all.extend(self.curves.iter().zip(&fit.tests).filter_map(|((asked, curve), own)| {
            let jump = curve.output.told(own.jump?, FEW);
            Some(format!(
                "{}: `{}` jumps by {jump} as the impact begins, so that only samples beside it tell of the clock: it may \
                 be anywhere between them, which the intervals hold",
                asked.file,
                curve.output.key()
            ))
        }));
        all.extend(self.curves.iter().zip(&fit.tests).filter_map(|((asked, curve), own)| {
            let later = own.later_jump?;
            Some(format!(
                "{}: `{}` jumps again, by {} at {} of the record, where it is touched once more; which sample is the \
                 first behind that is not looked for: the rows beside it are left out",
                asked.file,
                curve.output.key(),
                curve.output.told(later.height, FEW),
                quantity(later.time, "s", FEW)
            ))
        }));
        all.extend(self.repeats());
        if let [_] = fit.tests[..] {
            all.push(
                "one test tells nothing of how the scene carries to another height, mass or temperature".to_owned(),
            );
        }
        all
    }

    /// What records of one test differ by.
    fn repeats(&self) -> Vec<String> {
        let each = self.curves.iter().zip(&self.fit.tests).enumerate();
        let first = each.filter(|own| self.tests[own.0].repeated == Some(own.0));
        let told = first.filter_map(|(_, ((asked, curve), own))| {
            let scatter = own.scatter?;
            Some(format!(
                "{} records of `{}`, {} the first: a row of them differs by {} (standard deviation), and {} rows stand \
                 for one that is independent; that is their noise, and leaving out one of them tells nothing",
                scatter.records,
                asked.what(),
                asked.file,
                curve.output.told(scatter.deviation, FEW),
                significant(scatter.correlation, 2)
            ))
        });
        told.collect()
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
        let tests = self.curves.iter().zip(&self.fit.tests).map(|((asked, curve), own)| {
            format!(
                "{} ({}, {} rms)",
                asked.file,
                curve.output.key(),
                curve.output.told(own.rms, FEW)
            )
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

/// Rows before the impact that contradict the zero of a test.
fn other_zero(own: &TestFit, file: &str, of: &dyn Fn(f64) -> String) -> Option<String> {
    let other = own.other_zero?;
    Some(format!(
        "{file}: the {} rows before the impact read {} where nothing happens, and the fitted zero is {}: they \
         contradict each other, so that the model, its bounds or the clock is not right (`--offset off` takes the zero \
         as it is)",
        other.rows,
        of(other.median),
        of(own.offset)
    ))
}

/// What there is to say of a search that did not converge.
fn unconverged(fit: &NetworkFit) -> Option<String> {
    match fit.convergence {
        Convergence::Reached => None,
        Convergence::Unsettled => Some(
            "the search has not converged: these numbers are not at a minimum, and have no intervals".to_owned(),
        ),
        Convergence::Alone => Some(format!(
            "the search has not converged: of {} starts one alone leads to this minimum, and there may be a lower one, so \
             there are no intervals: search from more starts (`--starts`), or within narrower bounds",
            fit.reached[1]
        )),
    }
}

fn misses(file: &str, key: &str, own: &TestFit, test: &Test) -> Option<String> {
    let off = own.model_peak / own.measured_peak - 1.0;
    let largest = test.rows.iter().map(|row| row.1);
    let largest = largest.max_by(|one, other| one.abs().total_cmp(&other.abs()))?;
    if test.kind == Kind::Blow && off.abs() > MISSED && largest * own.model_peak < 0.0 {
        let [measured, model] =
            [largest, own.model_peak].map(|own| if own < 0.0 { "negative" } else { "positive" });
        return Some(format!(
            "the largest value of {file} is {measured}, and `{key}` is {model}: turn the sign of the column"
        ));
    }
    (off.abs() > MISSED).then(|| {
        format!(
            "the peak of {file} is missed by {}: noise, {}a model that it is not",
            percent_signed(off),
            if test.filter.is_none() && test.kind == Kind::Blow {
                "a filter that the record went through (`--cfc`), or "
            } else {
                "or "
            }
        )
    })
}

impl Study for FittedScene {
    fn warnings(&self) -> Vec<String> {
        self.said_first()
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&self.said_first());
        text.title(title(&self.scene));
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
