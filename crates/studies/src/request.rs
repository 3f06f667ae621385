//! Requests: the options of a study, each declared once.

use std::fmt::Write as _;

/// What is given for an option: words of a command line, or values of a program, which are in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum Given {
    /// A text; of options that take lists its parts stand between commas.
    Text(String),
    /// A number in SI units.
    Number(f64),
    /// On or off.
    Switch(bool),
    /// Values with the name that they are for.
    Named(String, Vec<Self>),
}

/// What an option takes.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// Any text.
    Text,
    /// A whole number.
    Count,
    /// A quantity; as a number it is in this SI unit.
    Quantity(&'static str),
    /// A quantity whose dimension follows from what it is for; as a number it is in SI units.
    Amount,
    /// One of these words, each with what it means.
    Words(fn() -> Vec<(&'static str, &'static str)>),
    /// A name, `=` and a value.
    Assignment,
    /// Nothing: it is on where it is given.
    Switch,
}

/// A type whose values an option takes.
pub trait Single: Sized {
    /// What it is made of.
    const KIND: Kind;
    /// Whether commas divide a text into several of them, where several are taken.
    const IS_DIVIDED: bool = true;

    /// The value.
    ///
    /// # Errors
    ///
    /// What is wrong with it, and what to write.
    fn of(given: &Given) -> Result<Self, String>;
}

/// A type of a field of a request.
pub trait OptionValue: Default {
    /// What a value is made of.
    const KIND: Kind;
    /// Whether it takes several values, and whether commas divide them.
    const SEVERAL: Option<bool> = None;

    /// Takes a value.
    ///
    /// # Errors
    ///
    /// As [`Single::of`].
    fn take(&mut self, given: &Given) -> Result<(), String>;
}

/// An option of a request.
#[derive(Debug, Clone, Copy)]
pub struct OptionInfo {
    /// The name of its field; dashes stand for `_` in a command line.
    pub name: &'static str,
    /// What it does, line by line.
    help: &'static [&'static str],
    /// What stands for its value in help texts.
    pub place: &'static str,
    /// What a value is made of.
    pub kind: Kind,
    /// Whether it takes several values, and whether commas divide them.
    pub several: Option<bool>,
    /// Its value where it is not given; empty for none.
    pub default: &'static str,
    /// The option without which it does nothing; empty for none.
    pub requires: &'static str,
    /// Another name of it; empty for none.
    pub alias: &'static str,
    /// What is wrong with a value.
    pub check: fn(&Given) -> Result<(), String>,
}

impl OptionInfo {
    #[doc(hidden)]
    pub const fn declared(
        (name, help, place): (&'static str, &'static [&'static str], &'static str),
        (kind, several): (Kind, Option<bool>),
        (default, requires, alias): (&'static str, &'static str, &'static str),
        check: fn(&Given) -> Result<(), String>,
    ) -> Self {
        Self { name, help, place, kind, several, default, requires, alias, check }
    }

    /// What it does, in one paragraph without a full stop at its end.
    pub fn about(&self) -> String {
        let mut about = String::new();
        for line in self.help {
            let _ = write!(about, " {}", line.trim());
        }
        about.trim().trim_end_matches('.').to_owned()
    }

    /// Its name in a command line.
    pub fn flag(&self) -> String {
        self.name.replace('_', "-")
    }
}

/// What a study is asked for.
pub trait Request: Default {
    /// Its options.
    const OPTIONS: &'static [OptionInfo];

    /// Takes a value for the option of this name, in either spelling.
    ///
    /// # Errors
    ///
    /// What is wrong with the value, or that there is no such option.
    fn take(&mut self, name: &str, given: &Given) -> Result<(), String>;
}

/// Declares a request: `name "PLACE": Type = default, requires "other";` with the help before each option. The struct with
/// these fields, its `Default`, the options of the command and those of Python follow.
#[macro_export]
macro_rules! request {
    (
        $(#[doc = $about:literal])+
        $visibility:vis $request:ident {
            $(
                $(#[doc = $help:literal])+
                $name:ident $place:literal: $kind:ty $(= $default:literal)? $(, requires $requires:literal)?
                    $(, alias $alias:literal)?;
            )*
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        $visibility struct $request {
            $($(#[doc = $help])+ pub $name: $kind,)*
        }

        impl Default for $request {
            fn default() -> Self {
                Self { $($name: $crate::request!(@default $kind $(, $default)?),)* }
            }
        }

        impl $crate::Request for $request {
            const OPTIONS: &'static [$crate::OptionInfo] = &[$($crate::OptionInfo::declared(
                (stringify!($name), &[$($help),+], $place),
                (<$kind as $crate::OptionValue>::KIND, <$kind as $crate::OptionValue>::SEVERAL),
                (concat!($($default)?), concat!($($requires)?), concat!($($alias)?)),
                |given| <$kind as $crate::OptionValue>::take(&mut <$kind>::default(), given),
            )),*];

            fn take(&mut self, name: &str, given: &$crate::Given) -> Result<(), String> {
                match name.replace('-', "_").as_str() {
                    $(stringify!($name) => $crate::OptionValue::take(&mut self.$name, given),)*
                    _ => Err(format!("there is no option `{name}`")),
                }
            }
        }
    };
    (@default $kind:ty, $default:literal) => { $default };
    (@default $kind:ty) => { <$kind>::default() };
}

impl<T: Single> OptionValue for Option<T> {
    const KIND: Kind = T::KIND;

    fn take(&mut self, given: &Given) -> Result<(), String> {
        *self = Some(T::of(given)?);
        Ok(())
    }
}

impl<T: Single> OptionValue for Vec<T> {
    const KIND: Kind = T::KIND;
    const SEVERAL: Option<bool> = Some(T::IS_DIVIDED);

    fn take(&mut self, given: &Given) -> Result<(), String> {
        match given {
            Given::Text(text) if T::IS_DIVIDED => {
                for part in text.split(',') {
                    self.push(T::of(&Given::Text(part.trim().to_owned()))?);
                }
            }
            given => self.push(T::of(given)?),
        }
        Ok(())
    }
}

impl OptionValue for bool {
    const KIND: Kind = Kind::Switch;

    fn take(&mut self, given: &Given) -> Result<(), String> {
        match given {
            Given::Switch(is_on) => *self = *is_on,
            _ => return Err("it is on or off".to_owned()),
        }
        Ok(())
    }
}

impl OptionValue for usize {
    const KIND: Kind = Kind::Count;

    fn take(&mut self, given: &Given) -> Result<(), String> {
        *self = Self::of(given)?;
        Ok(())
    }
}

impl Single for usize {
    const KIND: Kind = Kind::Count;

    fn of(given: &Given) -> Result<Self, String> {
        let wanted = || "a whole number is wanted".to_owned();
        match given {
            Given::Text(text) => text.parse().map_err(|_| wanted()),
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "whole and not negative, and too large ones saturate"
            )]
            Given::Number(number) if *number >= 0.0 && number.fract() == 0.0 => Ok(*number as Self),
            _ => Err(wanted()),
        }
    }
}

/// A text with whatever commas.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Whole(pub String);

impl Single for Whole {
    const KIND: Kind = Kind::Text;
    const IS_DIVIDED: bool = false;

    fn of(given: &Given) -> Result<Self, String> {
        String::of(given).map(Self)
    }
}

impl Single for String {
    const KIND: Kind = Kind::Text;

    fn of(given: &Given) -> Result<Self, String> {
        match given {
            Given::Text(text) => Ok(text.clone()),
            Given::Number(number) => Ok(number.to_string()),
            _ => Err("a text is wanted".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    request! {
        /// A request.
        pub(super) Asked {
            /// How many
            /// there are.
            count "NUMBER": usize = 3;
            /// Which.
            of_names "NAME,…": Vec<String>;
            /// Where.
            at "PLACE": Option<String>, requires "count";
            /// Whether.
            quick "": bool;
        }
    }

    #[test]
    fn an_option_is_declared_once() {
        let [count, names, at, quick] = Asked::OPTIONS else { panic!("four options") };
        assert_eq!(count.about(), "How many there are");
        assert_eq!((count.default, names.default, at.requires), ("3", "", "count"));
        assert_eq!((names.flag().as_str(), names.several), ("of-names", Some(true)));
        assert!(matches!(quick.kind, Kind::Switch) && quick.several.is_none());
        assert_eq!(Asked::default().count, 3);
    }

    #[test]
    fn values_are_taken_as_words_and_as_numbers() {
        let mut asked = Asked::default();
        let text = |own: &str| Given::Text(own.to_owned());
        asked.take("of-names", &text("a, b")).unwrap();
        asked.take("of_names", &text("c")).unwrap();
        asked.take("count", &Given::Number(7.0)).unwrap();
        asked.take("quick", &Given::Switch(true)).unwrap();
        assert_eq!(asked.of_names, ["a", "b", "c"]);
        assert!(asked.count == 7 && asked.quick && asked.at.is_none());
        assert!(asked.take("count", &Given::Number(1.5)).is_err());
        assert!(asked.take("counts", &text("1")).unwrap_err().contains("`counts`"));
        assert!((Asked::OPTIONS[0].check)(&text("x")).is_err());
    }
}
