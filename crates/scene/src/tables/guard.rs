//! Names that a sheet would take for formulas.

use std::borrow::Cow;

/// Stands before a text that a sheet would take for a formula.
const GUARD: char = '\'';

/// A name as a field of a CSV text.
///
/// A sheet evaluates what begins with `=`, `+`, `-` or `@`. Such a name gets an apostrophe before it,
/// which says to a sheet that a text follows; where this crate reads a header it belongs to no name.
/// Where a separator of any kind stands in a name, the field is quoted.
///
/// # Examples
///
/// ```
/// use dashpot_scene::text_cell;
///
/// assert_eq!(text_cell("pad.force [N]"), "pad.force [N]");
/// assert_eq!(text_cell("=1+1"), "'=1+1");
/// assert_eq!(text_cell("-x;y"), "\"'-x;y\"");
/// ```
pub fn text_cell(name: &str) -> Cow<'_, str> {
    let guarded = guarded(name);
    if guarded.contains([',', ';', '\t', '"', '\n', '\r']) {
        return format!("\"{}\"", guarded.replace('"', "\"\"")).into();
    }
    guarded
}

/// A text with an apostrophe before it where a sheet would evaluate it.
pub fn guarded(text: &str) -> Cow<'_, str> {
    if is_live(text) { format!("{GUARD}{text}").into() } else { Cow::Borrowed(text) }
}

/// A name without the apostrophe of [`text_cell`].
pub(super) fn unguarded(text: &str) -> &str {
    text.strip_prefix(GUARD).filter(|own| is_live(own)).unwrap_or(text)
}

/// Whether a sheet would evaluate the text; an apostrophe before such a text is data like any other.
fn is_live(text: &str) -> bool {
    text.trim_start_matches(GUARD).starts_with(['=', '+', '-', '@', '\t', '\r'])
}
