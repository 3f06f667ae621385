//! Enums whose variants have words.

/// Declares an enum with a word for each of its variants, and the method that tells it.
///
/// ```
/// dashpot_units::words! {
///     /// What bounds a travel.
///     #[derive(Debug, Clone, Copy, PartialEq)]
///     pub enum Bound, pub fn word(self) {
///         /// The thickness of a pad.
///         Thickness = "thickness",
///         /// A limit on it \[m\].
///         Limit(f64) = "limit",
///         /// A stop there.
///         Stop {
///             /// Where \[m\].
///             place: f64,
///         } = "stop",
///     }
/// }
///
/// assert_eq!(Bound::Limit(0.02).word(), "limit");
/// ```
#[macro_export]
macro_rules! words {
    (
        $(#[$attribute:meta])*
        $vis:vis enum $name:ident, $seen:vis fn $word:ident($($own:tt)+) {
            $(
                $(#[$note:meta])*
                $variant:ident $({ $($fields:tt)* })? $(( $($values:tt)* ))? = $text:literal
            ),* $(,)?
        }
    ) => {
        $(#[$attribute])*
        $vis enum $name {
            $($(#[$note])* $variant $({ $($fields)* })? $(( $($values)* ))?),*
        }

        impl $name {
            #[doc = concat!("What it is in words that stay the same:", $(" `", $text, "`"),*, ".")]
            $seen const fn $word($($own)+) -> &'static str {
                match $($own)+ {
                    $(Self::$variant { .. } => $text),*
                }
            }
        }
    };
}
