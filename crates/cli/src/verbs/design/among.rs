//! Numbers and words that are chosen: among values, or all orders of some words.

use dashpot_scene::{Variation, units::si_unit};

use crate::{error::CliError, output::list};

/// Digits of a step that is shown.
const DIGITS: usize = 7;

/// A number or a word with what it may be, or several words of which each takes another one.
#[derive(Debug, Clone)]
pub(super) struct Among {
    pub(super) names: Vec<String>,
    places: Vec<usize>,
    /// What all of them take, option by option.
    pub(super) options: Vec<Vec<Taken>>,
}

/// What a number or a word takes.
#[derive(Debug, Clone)]
pub(super) struct Taken {
    /// As it stands in the scene.
    pub(super) text: String,
    /// As people read it.
    pub(super) shown: String,
    /// In SI units, where it is a number, and their unit.
    pub(super) value: Option<f64>,
    pub(super) si: String,
}

/// Which of its options everything takes that is chosen.
pub(super) type Choice = Vec<usize>;

impl Among {
    /// Reads `name=values`, or `one,other=words` for all orders; one variation for each name.
    pub(super) fn parse(text: &str) -> Result<Vec<Variation>, CliError> {
        let several = text.split_once('=').filter(|own| own.0.contains(','));
        let Some((names, words)) = several else { return Ok(vec![Variation::parse(text)?]) };
        let each =
            names.split(',').map(|name| Variation::parse(&format!("{}={words}", name.trim())));
        let each = each.collect::<Result<Vec<Variation>, _>>()?;
        let is_odd = |own: &Variation| !own.is_of_words() || own.len() < each.len();
        if each.iter().any(is_odd) {
            let reason = format!(
                "of `{text}` each name takes another of the words, such as \
                 \"front.material,back.material=soft,hard\": as many words as names at least"
            );
            return Err(CliError::setting("--vary", reason));
        }
        Ok(each)
    }

    /// Of one variation, or of all orders of the words of several.
    pub(super) fn of(group: Vec<(Variation, usize)>) -> Self {
        let count = group.first().map_or(0, |own| own.0.len());
        let orders = orders(count, group.len());
        let option = |order: &Vec<usize>| {
            list(group.iter().zip(order).map(|((own, _), at)| Taken::of(own, *at)))
        };
        let options = orders.iter().map(option).collect();
        let (variations, places): (Vec<Variation>, Vec<usize>) = group.into_iter().unzip();
        Self { names: list(variations.into_iter().map(|own| own.name)), places, options }
    }

    /// How many options there are.
    pub(super) fn len(&self) -> usize {
        self.options.len()
    }

    /// Whether it is one number of this name.
    pub(super) fn is_number(&self, name: &str) -> bool {
        let is_number = self.options.iter().flatten().all(|own| own.value.is_some());
        is_number && matches!(&self.names[..], [own] if own == name)
    }

    /// The value of an option of one number.
    pub(super) fn value(&self, option: usize) -> f64 {
        self.options[option].first().and_then(|own| own.value).unwrap_or(f64::NAN)
    }

    /// Its numbers and words in the text of the scene.
    pub(super) fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.places.iter().copied()
    }

    /// What stands in its places in an option.
    pub(super) fn written(&self, option: usize) -> impl Iterator<Item = String> + '_ {
        self.options[option].iter().map(|own| own.text.clone())
    }
}

impl Taken {
    fn of(own: &Variation, at: usize) -> Self {
        let text = own.text(at);
        if own.is_of_words() {
            return Self { shown: text.clone(), text, value: None, si: String::new() };
        }
        let number = own.numbers[at];
        let rounded: f64 = format!("{number:.*e}", DIGITS - 1).parse().unwrap_or(number);
        let shown = format!("{rounded} {}", own.unit).trim_end().to_owned();
        let si = own.dimension.map_or(String::new(), si_unit);
        Self { text, shown, value: Some(own.values[at]), si }
    }
}

/// All ways to take so many of some, each once, in an order.
fn orders(of: usize, taken: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..taken {
        let longer = |own: &Vec<usize>| {
            let others = (0..of).filter(|at| !own.contains(at));
            others.map(|at| [&own[..], &[at]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_take_each_word_once() {
        assert_eq!(orders(3, 1), [[0], [1], [2]]);
        assert_eq!(orders(2, 2), [[0, 1], [1, 0]]);
        assert_eq!(orders(4, 3).len(), 24);
        let group = Among::parse("a.material, b.material = soft,hard").unwrap();
        let own = Among::of(group.into_iter().zip([3, 5]).collect());
        assert_eq!(own.names, ["a.material", "b.material"]);
        let written: Vec<_> = own.written(1).collect();
        assert_eq!(written, ["hard", "soft"]);
        assert_eq!(own.places().collect::<Vec<_>>(), [3, 5]);
        assert!(Among::parse("a.material,b.material=soft").is_err());
    }

    #[test]
    fn steps_are_shown_without_the_rounding_of_their_division() {
        let own = Variation::parse("K=20..50 kN/m,20").unwrap();
        let own = Taken::of(&own, 10);
        assert_eq!((own.shown.as_str(), own.si.as_str()), ("35.78947 kN/m", "N/m"));
        assert!(own.text.starts_with("35.789473684"));
    }
}
