//! Hard cases: every method on every case that it claims to solve.
//!
//! A case is a scene and a judge: a closed form, an invariant, a limit, another way to the same
//! number, or `hard_cases_reference.py`. The program runs as it does for a user, with the accuracy of
//! 0.1 % unless the case wants another, and every number that is claimed is held against the error
//! that the report states. What came out is kept in `docs/hard-cases.md`, which the tests write with
//! `UPDATE_DOCS=1` and compare otherwise; errors there are powers of ten that must not be exceeded.
//!
//! `FULL_SIZE=1` solves the largest networks at full size (names and outcomes differ from those of the
//! page then, so it is for `HARD_CASE`), `HARD_CASE=text` those cases alone whose name has that text, and
//! prints all that is checked.

mod attempt;
mod case;
mod criteria;
mod degenerate;
mod events;
mod extremes;
mod input;
mod limits;
mod nonlinear;
mod outcome;
mod page;
mod reference;
mod scene;
mod spectra;
mod table;
mod time;
mod topology;
mod trial;

use case::Case;

/// Names and texts of all hard cases that are scenes.
pub(crate) fn texts() -> Vec<(String, String)> {
    let groups: [fn() -> Vec<Case>; 9] = [
        criteria::cases,
        degenerate::cases,
        events::cases,
        extremes::cases,
        limits::cases,
        nonlinear::cases,
        spectra::cases,
        time::cases,
        topology::cases,
    ];
    let cases = groups.into_iter().flat_map(|cases| cases());
    cases.filter_map(|case| Some((case.name.clone(), case.text()?.to_owned()))).collect()
}
