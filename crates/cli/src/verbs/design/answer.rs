//! What a search has found, for people and for programs.

use dashpot_analysis::{Reason, RunReport};
use dashpot_design::optimum::{Aim, Design, Kept, Looked, Requirement};
use dashpot_scene::Scene;
use serde::Serialize;

use super::{
    among::Choice,
    asked::{Asked, Least},
    files,
    front::Point,
    tables, words,
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    out::SceneText,
    output::{Pairs, Study, Text, VERSION, each_once, list, object},
    verbs::run::{FloorTold, scatter},
};

const LABELS: usize = 15;

/// What was found with one choice of words and steps.
pub(super) struct Found {
    pub(super) choice: Choice,
    pub(super) design: Result<Design, String>,
}

/// The best design.
pub(super) struct Answer {
    pub(super) scene: Scene,
    pub(super) asked: Asked,
    /// One for each choice, the best first.
    pub(super) found: Vec<Found>,
    /// The front of two aims, from the least of the first one.
    pub(super) front: Vec<Point>,
    /// Of the best, test by test.
    pub(super) floors: Vec<FloorTold>,
    /// The files of the scenes of all tests, that of the command first, and their texts with the best.
    pub(super) texts: Vec<(String, String)>,
    /// What the command line sets.
    pub(super) set: Vec<(String, String)>,
    /// For figures: what becomes of the best along each number.
    pub(super) slices: Vec<Vec<Looked>>,
    /// What the command line asks for, in words.
    pub(super) settings: Vec<(&'static str, String)>,
}

impl Found {
    /// The better, the less: what keeps everything by its aim, what does not by how much it exceeds.
    pub(super) fn rank(&self) -> (u8, f64) {
        match &self.design {
            Ok(own) if own.borne.is_some_and(|own| !own.is_enough()) => {
                (1, -own.borne.map_or(0.0, |own| own.kept as f64))
            }
            Ok(own) if own.is_feasible => (0, own.aim),
            Ok(own) => (2, -own.least_margin()),
            Err(_) => (3, 0.0),
        }
    }
}

impl Answer {
    /// The best design, with the choice of its words and steps.
    pub(super) fn best(&self) -> Option<(&Choice, &Design)> {
        let Found { choice, design } = self.found.first()?;
        Some((choice, design.as_ref().ok()?))
    }

    /// How many designs that could not be evaluated may be better than the best, or keep everything where it does not.
    pub(super) fn open(&self) -> usize {
        let best = self.best().map(|own| own.1);
        if best.and_then(|own| own.borne).is_some_and(|own| !own.is_enough()) {
            let borne = |own: &Found| own.design.as_ref().ok().and_then(|own| own.borne);
            let may_be = |own: &&Found| borne(own).is_none_or(|own| own.may_be_enough());
            return self.found.iter().filter(may_be).count();
        }
        let aim = best.filter(|own| own.is_feasible).map(|own| own.aim);
        let open = |own: &Found| match &own.design {
            Ok(own) => own.lost.open(aim),
            // Of a choice that could not be searched it is known what is made least only where that is a step of it.
            Err(_) => match self.asked.least.aim(&self.asked, &own.choice) {
                Aim::Given(least) => usize::from(aim.is_none_or(|aim| least < aim)),
                _ => 1,
            },
        };
        self.found.iter().map(open).sum()
    }

    /// The limits of which it is not known whether the best keeps them, for another reason than how many scattered
    /// designs do.
    pub(super) fn undecided(&self) -> Vec<&str> {
        let best = self.best().map(|own| own.1);
        let is_robust = best.is_some_and(|own| own.borne.is_some());
        let all = best.into_iter().flat_map(|own| &own.runs).flat_map(|run| {
            let is_cut = run.scatter.as_ref().is_some_and(|own| own.within() < 1.0);
            let counts = move |own: Reason| own != Reason::Scatter || is_robust && is_cut;
            run.judged().into_iter().filter(move |own| own.judgement.reason().is_some_and(counts))
        });
        list(all.map(|own| own.limit.key.as_str()))
    }

    /// The numbers that change nothing beside the best.
    pub(super) fn unmoving(&self, best: &Design) -> impl Iterator<Item = usize> {
        let is_measure = matches!(self.asked.least, Least::Measure(_));
        (0..self.asked.numbers.len()).filter(move |at| !best.moves(*at, is_measure))
    }

    /// Whether the answer is claimed: nothing that could not be evaluated, or is not known of the best, can change it.
    pub(super) fn is_claimed(&self) -> bool {
        let has_none = self.best().is_none_or(|own| !own.1.is_feasible);
        self.open() == 0 && (has_none || self.undecided().is_empty())
    }

    /// The scene with the best.
    pub(super) fn text(&self) -> &str {
        self.texts.first().map_or("", |own| own.1.as_str())
    }

    /// The text of one of the scenes with the best, as it is written.
    pub(super) fn written(&self, scene: usize) -> SceneText<'_> {
        let (file, text) = self.texts.get(scene).map_or(("", ""), |own| (&own.0, &own.1));
        SceneText { text, file, set: &self.set }
    }

    /// The name of a test, where there is more than one.
    pub(super) fn test_name(&self, test: usize) -> Option<&str> {
        let name = &self.asked.tests[test].name;
        (!name.is_empty()).then_some(name)
    }

    /// The test in which a measure that is made least is largest, where there is more than one.
    pub(super) fn test_of_aim(&self, best: &Design) -> Option<&str> {
        let Least::Measure(key) = &self.asked.least else { return None };
        let value = |run: &RunReport| run.measure(key).and_then(|own| own.value);
        let each = best.runs.iter().enumerate().filter_map(|(at, run)| Some((at, value(run)?)));
        let (at, _) = each.max_by(|one, other| one.1.total_cmp(&other.1))?;
        self.test_name(at)
    }

    fn limits<'a>(&'a self, best: &'a Design) -> Vec<impl Serialize> {
        let each = best.kept.iter().filter_map(|kept| {
            let Requirement::Limit(limit) = &kept.required.what else { return None };
            let judged = best.runs[kept.required.test].judged();
            let judged = judged.into_iter().find(|own| own.limit.is_same(limit))?;
            let (test, decides) = (self.test_name(kept.required.test), best.decides(kept));
            let (active, price) = (kept.is_active, price(kept));
            Some(object! { test, decides, #[serde(flatten)] judged, active, price })
        });
        list(each)
    }
}

/// Change of the aim per unit of a bound.
fn price(own: &Kept) -> Option<f64> {
    own.price.filter(|own| own.is_finite())
}

/// The numbers and words of a design.
fn parameters(
    asked: &Asked,
    choice: &Choice,
    values: &[f64],
) -> Pairs<String, impl Serialize + use<>> {
    let numbers = asked.numbers.iter().zip(values);
    let numbers = numbers.map(|(own, value)| (own.name.clone(), Some(*value), None, &own.si));
    let chosen = asked.chosen(choice).map(|(name, own)| {
        let word = own.value.is_none().then(|| own.text.clone());
        (name.to_owned(), own.value, word, &own.si)
    });
    let all = numbers.chain(chosen);
    all.map(|(name, value, word, unit)| (name, object! { value, word, unit: unit.clone() }))
        .collect()
}

/// The measures of the runs of all tests, of each the one with the largest value.
fn worst(runs: &[RunReport]) -> Pairs<String, impl Serialize + use<>> {
    let first = runs.first().into_iter().flat_map(RunReport::told);
    let each = first.map(|own| {
        let all = runs.iter().filter_map(|run| run.measure(&own.key));
        let size = |value: Option<f64>| value.unwrap_or(f64::NEG_INFINITY);
        let most = all.max_by(|one, other| size(one.value).total_cmp(&size(other.value)));
        let own = most.unwrap_or(own);
        (own.key.clone(), object! { value: own.value, error: own.error, unit: own.unit })
    });
    each.collect()
}

impl Study for Answer {
    fn text(&self, text: &mut Text) {
        let Some((choice, best)) = self.best() else { return };
        text.warnings(&self.warnings());
        text.title(title(&self.scene));
        text.faint(&words::asked(&self.asked));
        text.blank();
        for line in words::lines(self, choice, best) {
            text.labelled(line.label, LABELS, &line.text);
        }
        for run in &best.runs {
            scatter::table(run).iter().for_each(|own| text.rows_below(own));
        }
        tables::all(self, best).iter().for_each(|own| text.rows_below(own));
    }

    fn warnings(&self) -> Vec<String> {
        let unsolved = self.found.iter().filter_map(|own| {
            let why = own.design.as_ref().err()?;
            let chosen = self.asked.chosen(&own.choice);
            let chosen = chosen.map(|(name, own)| format!("{name} = {}", own.shown));
            Some(format!("{} has no design: {why}", list(chosen).join(", ")))
        });
        let missing = self.best().map(|own| words::missing(self, own.1));
        let runs = self.best().into_iter().flat_map(|own| &own.1.runs);
        let warned = runs.flat_map(|run| &run.warnings).map(ToString::to_string);
        each_once(missing.into_iter().flatten().chain(unsolved).chain(warned))
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }

    fn object(&self) -> impl Serialize {
        let best = self.best();
        let design = best.map(|own| own.1);
        let kept = || design.into_iter().flat_map(|own| &own.kept);
        let depths = kept().filter_map(|own| {
            let Requirement::Depth(of, _) = &own.required.what else { return None };
            let test = self.test_name(own.required.test);
            let (active, price) = (own.is_active, price(own));
            let decides = design.is_some_and(|design| design.decides(own));
            Some(object! { test, decides, of, part: own.value, margin: own.margin, active, price })
        });
        let tests = design.into_iter().flat_map(|own| own.runs.iter().zip(&self.floors));
        let tests = tests.enumerate().map(|(at, (run, floor))| {
            let measures = worst(std::slice::from_ref(run));
            let (name, scatter) = (self.test_name(at), &run.scatter);
            object! { name, measures, floor: floor.object(run), scatter }
        });
        let front = self.front.iter().map(|own| {
            let [(value, error), (other, other_error)] = own.aims(&self.asked);
            object! {
                least: object! { value, error },
                and: object! { value: other, error: other_error },
                parameters: parameters(&self.asked, &own.choice, &own.own.design.values),
                active: words::active(&self.asked, &own.own.design),
            }
        });
        let choices = self.found.iter().map(|own| {
            let design = own.design.as_ref();
            let values = design.map_or(&[][..], |own| &own.values);
            object! {
                parameters: parameters(&self.asked, &own.choice, values),
                aim: design.ok().map(|own| own.aim),
                feasible: design.is_ok_and(|own| own.is_feasible),
                why: design.err().cloned(),
                unevaluated: design.ok().map(|own| &own.lost.unevaluated),
            }
        });
        object! {
            dashpot: VERSION,
            unevaluated: design.map(|own| &own.lost.unevaluated),
            claimed: self.is_claimed(),
            open: self.open(),
            parameters: best.map(|(choice, own)| parameters(&self.asked, choice, &own.values)),
            least: self.asked.least.name(&self.asked),
            and: self.asked.and.as_ref().map(|own| own.name(&self.asked)),
            aim: design.map(|own| own.aim),
            aim_test: design.and_then(|own| self.test_of_aim(own)),
            feasible: design.is_some_and(super::is_feasible),
            measures: design.map(|own| worst(&own.runs)),
            limits: design.map(|own| self.limits(own)),
            depths: list(depths),
            active: design.map(|own| words::active(&self.asked, own)),
            unmoved: design.map(|own| {
                list(self.unmoving(own).map(|at| self.asked.numbers[at].name.as_str()))
            }),
            floor: FloorTold::highest(&self.floors, design.map_or(&[], |own| &own.runs)),
            tests: list(tests),
            choices: list(choices),
            front: list(front),
            robust: design.and_then(|own| own.borne).map(|own| object! {
                wanted: own.wanted, kept: own.kept, designs: own.designs,
                unevaluated: own.unevaluated, deviations: own.deviations,
                enough: own.is_enough(),
            }),
            search: design.map(|own| own.search),
        }
    }
}
