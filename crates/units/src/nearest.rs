//! The word that was probably meant.

/// The word of `known` that is nearest to `word` in letters, if one is near: the first that goes on behind it with a hyphen.
pub fn nearest<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let lower = word.to_lowercase();
    let limit = match lower.chars().count() {
        0 => return None,
        1..=3 => 1,
        count => (count / 3).max(2),
    };
    known
        .into_iter()
        .filter_map(|candidate| {
            let other = candidate.to_lowercase();
            if other.strip_prefix(&lower).is_some_and(|rest| rest.starts_with('-')) {
                return Some((0, candidate));
            }
            let distance = strsim::damerau_levenshtein(&lower, &other);
            let is_near = distance <= limit && distance < candidate.chars().count();
            is_near.then_some((distance, candidate))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}
