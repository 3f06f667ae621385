//! What a study is, for faces that know it by its word.

use std::collections::HashSet;

use dashpot_scene::Scene;

use crate::{
    Answer, Assignment, Context, Given, Kind, OptionInfo, Request, Single as _, StudyError,
    operand::Operand,
};

/// Name of the built-in scene.
pub const BUILT_IN: &str = "reference";

/// What a study is asked about.
#[derive(Debug, Clone, Copy)]
pub enum Operands {
    /// One scene; the built-in one where none is named.
    Scene,
    /// Models or responses, each with its name in help texts and with what it is.
    Models(&'static [(&'static str, &'static str)]),
    /// Files of measurements, one or more, with what they are.
    Files(&'static str),
}

/// A study, for faces that know it by its word.
pub trait Study: Sync {
    /// Its word.
    fn word(&self) -> &'static str;

    /// What it does, in one sentence without its full stop.
    fn about(&self) -> &'static str;

    /// Examples, and what is to be known of it.
    fn manual(&self) -> &'static str;

    /// What it is asked about.
    fn operands(&self) -> Operands;

    /// Its options.
    fn options(&self) -> &'static [OptionInfo];

    /// Whether it has tables and figures to write.
    fn has_files(&self) -> bool {
        true
    }

    /// Asks it about these operands with the values `set` in their texts, and with what is given for its options.
    ///
    /// # Errors
    ///
    /// What is wrong with the request, or why it cannot be done.
    fn solve(
        &self,
        asked: (&[String], &[(String, String)]),
        given: &[(String, Given)],
        context: &mut dyn Context,
    ) -> Result<Box<dyn Answer>, StudyError>;
}

/// What a study says of itself: its word, request and operands, what it does, and its manual; and how it is asked.
macro_rules! about_study {
    (
        $word:literal, $request:ty, $operands:expr, $about:literal, $manual:literal,
        |$asked:ident, $set:ident, $wishes:ident, $context:ident| $solve:expr
    ) => {
        fn word(&self) -> &'static str {
            $word
        }

        fn about(&self) -> &'static str {
            $about
        }

        fn manual(&self) -> &'static str {
            $manual
        }

        fn operands(&self) -> $crate::Operands {
            $operands
        }

        fn options(&self) -> &'static [$crate::OptionInfo] {
            <$request as $crate::Request>::OPTIONS
        }

        fn solve(
            &self,
            ($asked, $set): (&[String], &[(String, String)]),
            given: &[(String, $crate::Given)],
            $context: &mut dyn $crate::Context,
        ) -> Result<Box<dyn $crate::Answer>, $crate::StudyError> {
            let $wishes: $request = $crate::study::request(given)?;
            Ok(Box::new($solve))
        }
    };
}
pub(crate) use about_study;

/// The request that is made of these values.
pub(crate) fn request<R: Request>(given: &[(String, Given)]) -> Result<R, StudyError> {
    let mut request = R::default();
    let mut assigned = HashSet::new();
    for (name, value) in given {
        let wrong = |reason| StudyError::setting(&format!("--{}", name.replace('_', "-")), reason);
        request.take(name, value).map_err(wrong)?;
        let of_assignment = |info: &&OptionInfo| matches!(info.kind, Kind::Assignment);
        if R::OPTIONS.iter().filter(of_assignment).any(|info| info.name == name) {
            let Assignment { name: of, .. } = Assignment::of(value).map_err(wrong)?;
            if !assigned.insert((name, of.clone())) {
                return Err(wrong(format!("it names `{of}` twice: only one of both can hold")));
            }
        }
    }
    Ok(request)
}

/// The scene that is asked about.
pub(crate) fn scene(
    operands: &[String],
    set: &[(String, String)],
    context: &mut dyn Context,
) -> Result<Scene, StudyError> {
    let name = operands.first().map_or(BUILT_IN, String::as_str);
    context.input(name)?.scene(set, context)
}

/// The models and responses that are asked about.
pub(crate) fn models<const N: usize>(
    operands: &[String],
    set: &[(String, String)],
    context: &mut dyn Context,
) -> Result<[Operand; N], StudyError> {
    let models = operands.iter().map(|word| Operand::read(word, set, context));
    let models: Vec<Operand> = models.collect::<Result<_, _>>()?;
    let wanted = || StudyError::setting("operands", format!("{N} models are wanted"));
    models.try_into().map_err(|_| wanted())
}
