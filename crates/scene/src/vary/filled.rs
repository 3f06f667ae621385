//! Scenes of one text that differ in numbers and words. The text is parsed once, when its [`Tunables`] are found; each
//! scene is read from its tree, with other values in their places.

use dashpot_network::Model;

use super::{set::Settled, tunable::Tunables};
use crate::{
    diagnostics::{Diagnostics, Faults},
    models::named::model_in,
    posed::{Posed, posed_in},
    quantities::{bare::BareNumbers, scatter::Scatter},
    read,
    scene::{ReadOptions, checked, library_of},
    text::{
        document::{Content, Entry, Item},
        library::Library,
    },
};

impl Tunables {
    /// What a run of the scene needs where some numbers and words are others: the same as [`pose`](crate::pose) finds in
    /// [the text with these](Self::text_with).
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_scene::{ReadOptions, Tunables, pose, reference};
    ///
    /// let scene = Tunables::of(reference(), None)?;
    /// let heavier = [(scene.find("head.mass").unwrap(), "12 kg".to_owned())];
    /// let options = ReadOptions::default();
    /// let read = scene.posed(&heavier, &options)?;
    /// assert!(read.is_solved_as(&pose(&scene.text_with(&heavier), &options)?));
    /// # Ok::<(), dashpot_scene::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// All faults of the scene with these values, each with the place of its value in the text.
    pub fn posed(
        &self,
        values: &[(usize, String)],
        options: &ReadOptions<'_>,
    ) -> Result<Posed, Diagnostics> {
        if let Some(own) = self.led_elsewhere(values, options)? {
            return own.posed(&[], options);
        }
        let posed = checked(BareNumbers::Silent, |faults| {
            Some(posed_in(&self.library(values, options, faults), faults))
        })?;
        match posed.value {
            Some(posed) => Ok(posed),
            None => read(&self.text_with(values), options).map(|scene| scene.value.into()),
        }
    }

    /// The model of this name there, as [`read_named_model`](crate::read_named_model) finds it, and whether it is a
    /// material.
    ///
    /// # Errors
    ///
    /// All faults of the model with these values; a name that the text does not have.
    pub fn model(
        &self,
        values: &[(usize, String)],
        name: &str,
        options: &ReadOptions<'_>,
    ) -> Result<(Model, bool), Diagnostics> {
        if let Some(own) = self.led_elsewhere(values, options)? {
            return own.model(&[], name, options);
        }
        let model = checked(BareNumbers::Silent, |faults| {
            model_in(&self.library(values, options, faults), name, faults)
        });
        model.map(|own| own.value)
    }

    /// The scene with these values as its text has it, where they are words and something is set: paths lead through
    /// words, that of a pad's spring to the model that the pad is made of.
    fn led_elsewhere(
        &self,
        values: &[(usize, String)],
        options: &ReadOptions<'_>,
    ) -> Result<Option<Self>, Diagnostics> {
        let is_word = |own: &(usize, String)| self.all()[own.0].word.is_some();
        let is_led = !options.set.is_empty() && values.iter().any(is_word);
        is_led.then(|| Self::of(&self.text_with(values), options.file)).transpose()
    }

    /// The documents of the scene with these values.
    fn library(
        &self,
        values: &[(usize, String)],
        options: &ReadOptions<'_>,
        faults: &Faults,
    ) -> Library {
        faults.add_source(self.source().clone());
        let mut settled = Settled::of(self, &self.source().text, options.set);
        let of_set = std::mem::take(&mut settled.changes);
        // What is set stands above all else.
        let is_set = |at: usize| of_set.iter().any(|own| own.0 == at);
        let contents: Vec<(u32, Content)> = values
            .iter()
            .filter(|own| !is_set(own.0))
            .chain(&of_set)
            .map(|(at, text)| (self.start(*at), content(text)))
            .collect();
        let root = filled(self.root(), &contents);
        library_of((root, &self.source().text), settled, options, faults)
    }
}

/// What a text in the place of a number or a word is in a document: counts stand without quotes.
fn content(text: &str) -> Content {
    if text.parse::<f64>().is_ok_and(f64::is_finite) {
        return Content::Number(text.into());
    }
    match Scatter::is_possible(text).then(|| Scatter::parse(text)).flatten() {
        Some(Ok(scatter)) => Content::Text(scatter.text.as_str().into()),
        _ => Content::Text(text.into()),
    }
}

/// An item with other contents where they begin in its text.
fn filled(item: &Item, contents: &[(u32, Content)]) -> Item {
    let value = match &item.value {
        Content::List(items) => {
            Content::List(items.iter().map(|own| filled(own, contents)).collect())
        }
        Content::Table(entries) => {
            let entry = |own: &Entry| Entry {
                item: filled(&own.item, contents),
                key: own.key.clone(),
                key_place: own.key_place,
            };
            Content::Table(entries.iter().map(entry).collect())
        }
        own => contents
            .iter()
            .find(|known| known.0 == item.place.start)
            .map_or_else(|| own.clone(), |known| known.1.clone()),
    };
    Item { value, place: item.place }
}
