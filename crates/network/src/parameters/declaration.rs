//! One declaration of a kind: its struct, its parameters, and the way between values and fields.

use std::fmt::Debug;

use super::{Formula, InvalidParameter, Parameter, Value, WindowWish};

/// What things of the registers say about themselves where they are stored.
pub trait Described: Debug + Send + Sync {
    /// Word for its kind, for instance `spring`.
    fn kind(&self) -> &'static str;

    /// The parameters of its kind.
    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    /// Their values, in the same order.
    fn values(&self) -> Vec<Value> {
        Vec::new()
    }

    /// The value of the parameter of this name.
    fn value(&self, name: &str) -> Option<Value> {
        let at = self.parameters().iter().position(|parameter| parameter.name == name)?;
        self.values().into_iter().nth(at)
    }

    /// The values with `value` for the parameter of this name.
    fn values_with(&self, name: &str, value: &Value) -> Vec<Value> {
        let own = self.parameters().iter().zip(self.values());
        own.map(|(own, old)| if own.name == name { value.clone() } else { old }).collect()
    }

    /// Checks the values.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for the first one out of its range.
    fn validate(&self) -> Result<(), InvalidParameter> {
        self.parameters().iter().zip(&self.values()).try_for_each(|(own, value)| own.check(value))
    }
}

impl<K: Kind> Described for K {
    fn kind(&self) -> &'static str {
        K::KIND
    }

    fn parameters(&self) -> &'static [Parameter] {
        K::PARAMETERS
    }

    fn values(&self) -> Vec<Value> {
        self.fields()
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        K::PARAMETERS.iter().zip(&self.fields()).try_for_each(|(own, value)| own.check(value))?;
        self.check_whole()
    }
}

/// What a kind of a register says about itself; [`parameters!`](crate::parameters!) writes it.
pub trait Kind: Described + Sized + 'static {
    /// Word for it in scenes.
    const KIND: &'static str;
    /// One line for a list: what it is, law, unit.
    const SUMMARY: &'static str;
    /// Its parameters; where one alone is required, a scene may write its value alone (`{ spring = "20 MN/m" }`).
    const PARAMETERS: &'static [Parameter];

    /// The thing with these values, one for each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is missing or out of range.
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter>;

    /// The values that it has, one for each parameter.
    fn fields(&self) -> Vec<Value>;

    /// Checks what no single value tells.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for one that does not fit to the others.
    fn check_whole(&self) -> Result<(), InvalidParameter> {
        Ok(())
    }

    /// A valid example.
    fn sample() -> Self;
}

/// A kind in a register of things that are stored as `T`; `A` is what else its family says of it.
#[derive(Debug)]
pub struct Registered<T, A = ()> {
    /// Its word.
    pub word: &'static str,
    /// One line of help.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Makes one of values, one for each parameter.
    pub make: fn(&[Value]) -> Result<T, InvalidParameter>,
    /// The values of a valid example.
    pub sample: fn() -> Vec<Value>,
    /// The values that a kind made of these has.
    pub again: fn(&[Value]) -> Result<Vec<Value>, InvalidParameter>,
    /// What its family says of it.
    pub about: A,
}

/// The entry of this word.
pub fn registered<'e, T, A>(
    entries: &'e [Registered<T, A>],
    word: &str,
) -> Option<&'e Registered<T, A>> {
    entries.iter().find(|entry| entry.word == word)
}

impl<T, A: Copy> Registered<T, A> {
    /// The entry of the kind `K`, of whose values `make` makes what is stored.
    pub const fn new<K: Kind>(make: fn(&[Value]) -> Result<T, InvalidParameter>, about: A) -> Self {
        Self {
            word: K::KIND,
            summary: K::SUMMARY,
            parameters: K::PARAMETERS,
            make,
            sample: || K::sample().values(),
            again: |values| K::from_values(values).map(|from_value| from_value.values()),
            about,
        }
    }

    /// The example.
    ///
    /// # Errors
    ///
    /// None, of a kind whose sample is valid.
    pub fn example(&self) -> Result<T, InvalidParameter> {
        (self.make)(&(self.sample)())
    }
}

/// A field of a kind that holds the value of a parameter.
pub trait Field: Sized {
    /// What its value is, for a message.
    const EXPECTED: &'static str;

    /// The field of a value; `None` for a value of another sort.
    fn of(value: &Value) -> Option<Self>;

    /// Its value.
    fn value(&self) -> Value;
}

impl Field for f64 {
    const EXPECTED: &'static str = "a number";

    fn of(value: &Value) -> Option<Self> {
        value.number()
    }

    fn value(&self) -> Value {
        Value::Number(*self)
    }
}

/// Of whole numbers from 0 to 2³².
impl Field for usize {
    const EXPECTED: &'static str = "a whole number";

    fn of(value: &Value) -> Option<Self> {
        let number = value.number()?;
        let is_whole = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range")]
        is_whole.then_some(number as Self)
    }

    fn value(&self) -> Value {
        Value::Number(*self as f64)
    }
}

impl Field for Vec<(f64, f64)> {
    const EXPECTED: &'static str = "a list of points";

    fn of(value: &Value) -> Option<Self> {
        if let Value::Table(points) = value { Some(points.clone()) } else { None }
    }

    fn value(&self) -> Value {
        Value::Table(self.clone())
    }
}

impl Field for Formula {
    const EXPECTED: &'static str = "a formula";

    fn of(value: &Value) -> Option<Self> {
        if let Value::Formula(formula) = value { Some(formula.clone()) } else { None }
    }

    fn value(&self) -> Value {
        Value::Formula(self.clone())
    }
}

impl Field for String {
    const EXPECTED: &'static str = "a name";

    fn of(value: &Value) -> Option<Self> {
        if let Value::Word(word) = value { Some(word.clone()) } else { None }
    }

    fn value(&self) -> Value {
        Value::Word(self.clone())
    }
}

impl Field for WindowWish {
    const EXPECTED: &'static str = "`impact`, `run` or a pair of times";

    fn of(value: &Value) -> Option<Self> {
        if let Value::Window(window) = value { Some(*window) } else { None }
    }

    fn value(&self) -> Value {
        Value::Window(*self)
    }
}

/// Of a parameter that follows from the rest where it is left out.
impl<T: Field> Field for Option<T> {
    const EXPECTED: &'static str = T::EXPECTED;

    fn of(value: &Value) -> Option<Self> {
        if *value == Value::LeftOut { Some(None) } else { T::of(value).map(Some) }
    }

    fn value(&self) -> Value {
        self.as_ref().map_or(Value::LeftOut, T::value)
    }
}

/// Values, taken one after another for the parameters of a kind.
#[derive(Debug)]
pub struct Given<'v> {
    parameters: &'static [Parameter],
    values: &'v [Value],
}

impl<'v> Given<'v> {
    /// The values of these parameters.
    pub const fn new(parameters: &'static [Parameter], values: &'v [Value]) -> Self {
        Self { parameters, values }
    }

    /// The field of the next value.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when it is missing, of another sort, or out of range.
    pub fn take<T: Field>(&mut self) -> Result<T, InvalidParameter> {
        let missing = |name| InvalidParameter::new(name, T::EXPECTED, "missing");
        let (parameter, others) = self.parameters.split_first().ok_or_else(|| missing(""))?;
        let (value, rest) = self.values.split_first().ok_or_else(|| missing(parameter.name))?;
        (self.parameters, self.values) = (others, rest);
        parameter.check(value)?;
        T::of(value).ok_or_else(|| missing(parameter.name))
    }
}

/// What [`parameters!`](crate::parameters!) knows by name.
pub mod words {
    pub use super::super::{
        Dimension,
        ParameterKind::{
            Amplitude, Choice, Curve, Flag, LawFormula, Model, Node, Quantity,
            TemperatureDifference, TimeFormula, TimeTable, Window,
        },
        Range::{
            AboveAbsoluteZero, Angle, AtLeastOne, Count, Finite, NonNegative, NotZero, Part,
            PartBelowOne, Positive, PositivePart,
        },
    };
}

/// What an element that stands for a field says of itself: what that says.
macro_rules! described_as {
    ($field:ident) => {
        fn kind(&self) -> &'static str {
            self.$field.kind()
        }

        fn parameters(&self) -> &'static [Parameter] {
            self.$field.parameters()
        }

        fn values(&self) -> Vec<Value> {
            self.$field.values()
        }

        fn validate(&self) -> Result<(), InvalidParameter> {
            self.$field.validate()
        }
    };
}
pub(crate) use described_as;

/// Declares an enum whose variants are the words of a [`Choice`](crate::parameters::ParameterKind), each with its word.
#[macro_export]
macro_rules! choices {
    (
        $(#[$attribute:meta])*
        $vis:vis enum $name:ident {
            $($(#[$note:meta])* $variant:ident = $word:literal),* $(,)?
        }
    ) => {
        $crate::parameters::words! {
            $(#[$attribute])*
            $vis enum $name, pub fn word(self) {
                $($(#[$note])* $variant = $word),*
            }
        }

        impl $name {
            /// Its words.
            pub const WORDS: &'static [&'static str] = &[$($word),*];
        }

        impl $crate::parameters::Field for $name {
            const EXPECTED: &'static str = "one of its words";

            fn of(value: &$crate::parameters::Value) -> Option<Self> {
                let $crate::parameters::Value::Word(word) = value else { return None };
                match word.as_str() {
                    $($word => Some(Self::$variant),)*
                    _ => None,
                }
            }

            fn value(&self) -> $crate::parameters::Value {
                $crate::parameters::Value::Word(self.word().to_owned())
            }
        }
    };
}

/// Declares a kind of a register once: its struct, its table of parameters, and the way between its
/// fields and their [`Value`]s. It writes [`Kind`].
///
/// ```
/// use dashpot_network::parameters::{Kind, Range};
///
/// dashpot_network::parameters! {
///     /// A pad with a stiffness, and with a damping that may be left out.
///     #[derive(Debug, Clone, PartialEq)]
///     pub struct Pad: "pad", "spring beside a dashpot", checked by Self::slow {
///         /// spring constant k [N/m], positive
///         pub stiffness: f64 = Quantity(Dimension::STIFFNESS), range Positive;
///         /// dashpot constant c [N s/m], zero or positive
///         pub damping as "damped-by": f64 = Quantity(Dimension::DAMPING),
///             default "0 N s/m", range NonNegative;
///     }
///     sample { stiffness: 2e6, damping: 3e3 }
/// }
///
/// impl Pad {
///     /// What no single parameter tells.
///     fn slow(&self) -> Result<(), dashpot_network::parameters::InvalidParameter> {
///         Range::Finite.check("damped-by", self.damping / self.stiffness)
///     }
/// }
///
/// assert_eq!(Pad::from_values(&Pad::sample().values())?, Pad::sample());
/// assert_eq!(Pad::PARAMETERS[0].help, "spring constant k [N/m], positive");
/// assert_eq!(Pad::PARAMETERS[1].name, "damped-by");
/// # use dashpot_network::parameters::Described as _;
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// The head has word and summary, and where ranges are not all that is checked, what checks the rest. Every field is a
/// parameter. Its comment is the line of help: what it is, symbol, unit, range. Then come its key where it is not the
/// field's name, the [`ParameterKind`] of its value, and, in any order, `default` (as a scene would write it),
/// `follows` (from what, in words; the field is then an `Option`), and the [`Range`] of its number,
/// [`Finite`](crate::parameters::Range::Finite) where none is stated. `field: Type => PARAMETER` takes over a [`Parameter`] that several kinds share.
/// A struct `on` a field has the name of what it acts on there, which is no parameter: made of values it is that of the
/// example. Below stands an example of the fields, as `sample` or as `default`, which writes [`Default`]; without
/// either it is the [`Default`] that is there.
///
/// [`ParameterKind`]: crate::parameters::ParameterKind
/// [`Range`]: crate::parameters::Range
#[macro_export]
macro_rules! parameters {
    (
        $(#[$attribute:meta])*
        $vis:vis struct $name:ident $(on $target:ident)?: $kind:literal, $summary:literal
            $(, checked by $check:path)?
        {
            $(
                $(#[doc = $help:literal])+
                $field_vis:vis $field:ident $(as $key:literal)?: $type:ty
                    $(= $what:expr $(, $word:ident $argument:expr)*)? $(=> $shared:expr)?;
            )*
        }
        $(sample { $($sample:tt)* })?
        $(default { $($default:tt)* })?
    ) => {
        $(#[$attribute])*
        $vis struct $name {
            $(
                /// Name of the element that it acts on.
                $vis $target: String,
            )?
            $(
                $(#[doc = $help])+
                #[allow(
                    rustdoc::broken_intra_doc_links,
                    clippy::doc_markdown,
                    clippy::doc_link_with_quotes,
                    reason = "a line of help is plain text"
                )]
                $field_vis $field: $type,
            )*
        }

        $(
            impl Default for $name {
                fn default() -> Self {
                    Self { $($default)* }
                }
            }
        )?

        impl $crate::parameters::Kind for $name {
            const KIND: &'static str = $kind;
            const SUMMARY: &'static str = $summary;
            const PARAMETERS: &'static [$crate::parameters::Parameter] = {
                #[allow(unused_imports, reason = "not every declaration needs all words")]
                use $crate::parameters::words::*;
                &[$(
                    $crate::parameters!(
                        @parameter [$($help)+] [$field $($key)?]
                        $($what $(, $word $argument)*)? $(=> $shared)?
                    )
                ),*]
            };

            fn from_values(
                values: &[$crate::parameters::Value],
            ) -> Result<Self, $crate::parameters::InvalidParameter> {
                #[allow(unused_variables, unused_mut, reason = "a kind may have no parameter")]
                let mut given = $crate::parameters::Given::new(Self::PARAMETERS, values);
                let own = Self {
                    $($target: Self::sample().$target,)?
                    $($field: given.take()?),*
                };
                $($check(&own)?;)?
                Ok(own)
            }

            fn fields(&self) -> Vec<$crate::parameters::Value> {
                vec![$($crate::parameters::Field::value(&self.$field)),*]
            }

            $(
                fn check_whole(&self) -> Result<(), $crate::parameters::InvalidParameter> {
                    $check(self)
                }
            )?

            fn sample() -> Self {
                $crate::parameters!(@sample $({ $($sample)* })?)
            }
        }
    };
    (@parameter [$($help:literal)+] $name:tt $what:expr $(, $word:ident $argument:expr)*) => {
        $crate::parameters::Parameter::new(
            $crate::parameters!(@name $name),
            $what,
            concat!($($help),+).trim_ascii(),
        )$(.$word($argument))*
    };
    (@parameter [$($help:literal)+] $name:tt => $shared:expr) => { $shared };
    (@name [$field:ident]) => { stringify!($field) };
    (@name [$field:ident $key:literal]) => { $key };
    (@sample { $($sample:tt)* }) => { Self { $($sample)* } };
    (@sample) => { Self::default() };
}
