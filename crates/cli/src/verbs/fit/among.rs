//! `--among zener,burgers,prony`: forms of a model, of which the tests choose one.

use dashpot_fit::{
    among::{Basis, Candidate, Choice, Form, KNOWN, Verdict, choose, information},
    network::{Kind, NetworkFit, Profile, Test},
};
use dashpot_network::{first_nonlinear, linear_model};
use dashpot_report::Table;
use dashpot_scene::{NamedModel, read_named_model, with_model};
use serde::Serialize;

use super::scene::{FittedScene, Plan};
use crate::input::AsCommanded as _;
use crate::{
    error::{CliError, StudyError},
    output::{list, object},
    terminal::note,
    varied::Varied,
};
use dashpot_report::numbers::{share, significant};

/// The option, for messages.
const FLAG: &str = "--among";

/// A form in the place of a model of the scene.
pub(super) struct Replaced {
    named: NamedModel,
    form: Form,
    pub(super) constants: Vec<Varied>,
}

impl Replaced {
    /// A scene with the form in its place.
    pub(super) fn text(
        &self,
        text: &str,
        constants: &[f64],
        comment: &str,
    ) -> Result<String, CliError> {
        let text = with_model(text, &self.named, &self.form.model(constants), comment);
        text.ok_or_else(|| CliError::NotReplaced { word: self.named.name.clone() })
    }
}

/// The forms that were tried.
pub(super) struct Among {
    /// The model in whose place they stood.
    model: String,
    words: Vec<String>,
    /// Numbers, errors; `None` for one that could not be fitted.
    candidates: Vec<Option<Candidate>>,
    /// Of each the numbers that the tests do not determine.
    open: Vec<usize>,
    information: Vec<Option<f64>>,
    /// How many independent samples that counts.
    samples: f64,
    choice: Choice,
}

/// The forms that are asked for, and the model in whose place they stand.
fn asked(text: &str) -> Result<(&str, Vec<Form>), CliError> {
    let (name, words) = text.split_once('=').unwrap_or(("", text));
    let form = |word: &str| {
        Form::named(word.trim()).ok_or_else(|| {
            let known: Vec<&str> = list(KNOWN.iter().map(|own| own.0));
            let (word, known) = (word.trim(), known.join(", "));
            CliError::setting(FLAG, format!("there is no form `{word}`; there are {known}"))
        })
    };
    let forms = words.split(',').map(form).collect::<Result<Vec<_>, _>>()?;
    Ok((name.trim(), forms))
}

/// Fits each form, and tells of the one that the tests speak for.
pub(super) fn chosen<'p>(plan: Plan<'p>, text: &str) -> Result<FittedScene<'p>, CliError> {
    let (name, forms) = asked(text)?;
    let set = &plan.arguments.values.set;
    let named = read_named_model(&plan.scene.text, name, &plan.input.options(set));
    let named = named.map_err(StudyError::Scene)?.value;
    let places = forms.iter().map(|form| replaced(&plan, &named, form));
    let mut places = places.collect::<Result<Vec<_>, _>>()?;
    let mut fits: Vec<Option<NetworkFit>> = Vec::new();
    for (form, place) in forms.iter().zip(&places) {
        let fit = plan.fit(Some(place), Profile::Never);
        match &fit {
            Err(fault) => note(&format!("`{}` is not fitted: {fault}", form.word())),
            Ok(own) if !own.is_converged() => {
                let word = form.word();
                note(&format!("`{word}` is compared though its search has not converged"));
            }
            Ok(_) => {}
        }
        fits.push(fit.ok());
    }
    let candidate = |own: &Option<NetworkFit>| Some(Candidate::of(own.as_ref()?, &plan.tests));
    let candidates: Vec<Option<Candidate>> = list(fits.iter().map(candidate));
    let choice = choose(&candidates, plan.arguments.error());
    let (information, samples) = information(&list(fits.iter().map(Option::as_ref)), &plan.tests);
    let open = |own: &Option<NetworkFit>| {
        own.iter()
            .flat_map(|own| (0..own.numbers.len()).filter(|at| !own.is_identified(*at)))
            .count()
    };
    let among = Among {
        model: named.name.clone(),
        words: list(forms.iter().map(|own| own.word().to_owned())),
        open: list(fits.iter().map(open)),
        candidates,
        information,
        samples,
        choice,
    };
    let Some(at) = among.choice.chosen else {
        let reason = format!("none of {} can be fitted", among.words.join(", "));
        return Err(CliError::setting(FLAG, reason));
    };
    let place = places.swap_remove(at);
    let fit = plan.fit(Some(&place), plan.profile())?;
    plan.finished(Some(place), fit, Some(among))
}

/// A form in the place of a model, with its constants about what that is between the times of the tests.
fn replaced(plan: &Plan<'_>, named: &NamedModel, form: &Form) -> Result<Replaced, CliError> {
    let wrong = |reason: String| CliError::setting(FLAG, reason);
    if let Some(element) = first_nonlinear(&named.model) {
        return Err(wrong(format!(
            "`{}` has a {}: write a linear guess in its place, such as `spring = \"100 kN/m\"`",
            named.name,
            element.kind()
        )));
    }
    let [fast, slow] = times(&plan.tests);
    let (omega, linear) = ((fast * slow).sqrt().recip(), linear_model(&named.model));
    let stiffness = linear.storage(omega).hypot(linear.loss(omega));
    if !(stiffness.is_finite() && stiffness > 0.0) {
        return Err(wrong(format!("`{}` has no stiffness to begin with", named.name)));
    }
    let constants = form.constants().into_iter().zip(form.numbers(stiffness, [fast, slow]));
    let constants = constants.map(|(own, number)| {
        let unit = match (own.is_spring, named.is_material) {
            (true, true) => "Pa",
            (false, true) => "Pa s",
            (true, false) => "N/m",
            (false, false) => "N s/m",
        };
        Varied {
            name: format!("{}.{}", named.name, own.name),
            unit: unit.to_owned(),
            one: 1.0,
            si: unit.to_owned(),
            bounds: [number.low, number.high],
            start: number.start,
            at: None,
        }
    });
    Ok(Replaced { constants: list(constants), named: named.clone(), form: form.clone() })
}

/// The fastest and the slowest times that tests see \[s\].
fn times(tests: &[Test]) -> [f64; 2] {
    let of = |test: &Test| {
        let places = || test.rows.iter().map(|own| own.0);
        let [low, high] = [places().fold(f64::INFINITY, f64::min), places().fold(0.0, f64::max)];
        match test.kind {
            // Frequencies and times since a step: both are positive, and the first of them are angular frequencies.
            Kind::Modulus => [low.min(1.0 / high), high.max(1.0 / low)],
            _ => [(high - low) / test.rows.len() as f64, high - low],
        }
    };
    let both = tests.iter().map(of);
    both.fold([f64::INFINITY, 0.0], |[fast, slow], own| [fast.min(own[0]), slow.max(own[1])])
}

impl Among {
    fn verdict(&self, at: usize) -> &'static str {
        match self.choice.verdicts[at] {
            Verdict::Chosen => "chosen",
            Verdict::NotNeeded => "no fewer numbers, and no nearer",
            Verdict::NotConverged => {
                "not converged, or at a bound: a form that it contains is nearer"
            }
            Verdict::TooFar => "too far",
            Verdict::NotFitted => "not fitted",
        }
    }

    pub(super) fn table(&self) -> Table {
        let rows = self.words.iter().enumerate().map(|(at, word)| {
            let own = self.candidates[at];
            let told = |value: Option<f64>| value.map_or_else(String::new, share);
            let open = match self.open[at] {
                0 => String::new(),
                count => format!("{count} not identified"),
            };
            vec![
                word.clone(),
                own.map_or_else(String::new, |own| own.numbers.to_string()),
                told(own.map(|own| own.error)),
                told(own.and_then(|own| own.held_out)),
                self.information[at].map_or_else(String::new, |own| significant(own, 3)),
                open,
                self.verdict(at).to_owned(),
            ]
        });
        let header = ["form", "numbers", "error", "when left out", "AICc above the least", "", ""];
        Table::new(format!("Forms of `{}`", self.model), &header, rows)
    }

    /// What comes first.
    pub(super) fn said_first(&self) -> Option<String> {
        let Basis::Stated(error) = self.choice.basis else { return None };
        (!self.choice.is_near).then(|| {
            format!(
                "none of the forms of `{}` leaves less than {} of the peaks (`--error`): the nearest is taken",
                self.model,
                share(error)
            )
        })
    }

    pub(super) fn remark(&self) -> String {
        let by = match self.choice.basis {
            Basis::HeldOut => "what each leaves of tests that were left out".to_owned(),
            Basis::Stated(error) => {
                format!(
                    "an error of {} (`--error`), as there is no other test to leave out",
                    share(error)
                )
            }
        };
        format!(
            "the form is chosen by {by}: of those that are as near, the one with the fewest numbers; errors are parts \
             of the peaks, and the AICc counts {} independent samples",
            significant(self.samples, 3)
        )
    }

    pub(super) fn object(&self) -> impl Serialize {
        let forms = self.words.iter().enumerate().map(|(at, form)| {
            let own = self.candidates[at];
            object! {
                form,
                numbers: own.map(|own| own.numbers),
                error: own.map(|own| own.error),
                held_out: own.and_then(|own| own.held_out),
                information: self.information[at],
                not_identified: self.open[at],
                verdict: self.choice.verdicts[at],
            }
        });
        object! {
            model: &self.model,
            by: match self.choice.basis {
                Basis::HeldOut => "held-out",
                Basis::Stated(_) => "error",
            },
            independent_samples: self.samples,
            forms: list(forms),
        }
    }
}
