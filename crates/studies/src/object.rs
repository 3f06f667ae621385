//! Results as objects for programs.

use serde::{Serialize, Serializer};

/// An object with these keys, in this order: `object! { method: own.method, rtol }`; a key that has the attribute
/// `#[serde(flatten)]` stands for those of its value.
#[macro_export]
macro_rules! object {
    (@value $key:ident) => { $key };
    (@value $key:ident $value:expr) => { $value };
    ($($(#[$flatten:meta])? $key:ident $(: $value:expr)?),* $(,)?) => {{
        #[expect(non_camel_case_types, reason = "a key is the name of its own type as well")]
        mod object {
            #[derive(serde::Serialize)]
            pub(super) struct Object<$($key),*> { $($(#[$flatten])? pub(super) $key: $key),* }
        }
        object::Object { $($key: $crate::object!(@value $key $($value)?)),* }
    }};
}
/// All of these.
pub fn list<T>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    items.into_iter().collect()
}

/// Items that are alike in groups, in the order of their first ones.
pub fn alike<T>(
    items: impl IntoIterator<Item = T>,
    is_alike: impl Fn(&T, &T) -> bool,
) -> Vec<Vec<T>> {
    let mut all: Vec<Vec<T>> = Vec::new();
    for item in items {
        match all.iter_mut().find(|group| is_alike(&group[0], &item)) {
            Some(group) => group.push(item),
            None => all.push(vec![item]),
        }
    }
    all
}

/// Each item where it stands first.
pub fn each_once<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    list(alike(items, T::eq).into_iter().filter_map(|group| group.into_iter().next()))
}

/// A map in an order of its own.
#[derive(Debug)]
pub struct Pairs<K, V>(Vec<(K, V)>);

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
