//! Objects for programs: JSON in SI units, where what is infinite or missing is null.

use serde::{Serialize, Serializer};

/// Version of the program; also the mark of files that it wrote.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// An object with these keys, in this order: `object! { method: own.method, rtol }`.
macro_rules! object {
    (@value $key:ident) => { $key };
    (@value $key:ident $value:expr) => { $value };
    ($($key:ident $(: $value:expr)?),* $(,)?) => {{
        #[expect(non_camel_case_types, reason = "a key is the name of its own type as well")]
        mod object {
            #[derive(serde::Serialize)]
            pub(super) struct Object<$($key),*> { $(pub(super) $key: $key),* }
        }
        object::Object { $($key: object!(@value $key $($value)?)),* }
    }};
}
pub(crate) use object;

/// The items as a list.
pub(crate) fn list<T>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    items.into_iter().collect()
}

/// A map in an order of its own.
pub(crate) struct Pairs<K, V>(Vec<(K, V)>);

impl<K, V> FromIterator<(K, V)> for Pairs<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(pairs: I) -> Self {
        Self(list(pairs))
    }
}

impl<K: Serialize, V: Serialize> Serialize for Pairs<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}
