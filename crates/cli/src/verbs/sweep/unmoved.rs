//! Parameters of a sweep that move nothing.

use dashpot_scene::Variation;

use super::Swept;

/// Relative difference of two values that say the same.
const SAME: f64 = 1e-9;
/// The parameter that the force of a law in N and N/m does not hang on.
const THICKNESS: &str = "thickness";

/// The parameters that vary without changing any measure but those in parts of a thickness.
pub(super) fn unmoved(swept: &Swept) -> Vec<String> {
    let varied = &swept.varied;
    if varied.is_of_rows() {
        return Vec::new();
    }
    let is_told = |at: &usize| varied.variations[*at].len() > 1 && !moves(swept, *at);
    (0..varied.variations.len()).filter(is_told).map(|at| sentence(swept, at)).collect()
}

/// Whether a measure differs between two points that differ in this parameter alone.
fn moves(swept: &Swept, parameter: usize) -> bool {
    let (report, varied) = (&swept.report, &swept.varied);
    let columns = &report.columns;
    let is_told = |at: &usize| {
        let own = &columns[*at];
        !own.is_share && own.unit != "1" && report.column(*at).any(f64::is_finite)
    };
    let mut told = (0..columns.len()).filter(is_told).peekable();
    if told.peek().is_none() {
        return true;
    }
    // The last parameter varies fastest.
    let step: usize = varied.variations[parameter + 1..].iter().map(Variation::len).product();
    told.any(|at| {
        let values: Vec<f64> = report.column(at).collect();
        (0..values.len()).any(|point| {
            let place = point / step % varied.variations[parameter].len();
            let [own, first] = [point, point - place * step].map(|at| values[at]);
            own.is_finite() != first.is_finite()
                || (own - first).abs() > SAME * own.abs().max(first.abs())
        })
    })
}

fn sentence(swept: &Swept, parameter: usize) -> String {
    let own = &swept.varied.variations[parameter].name;
    let path = swept.varied.matched[parameter].map(|at| &swept.varied.tunables.all()[at].path);
    let is_thickness = path.is_some_and(|path| path.rsplit('.').next() == Some(THICKNESS));
    let why = if is_thickness {
        ": a law in N, N/m and N s/m is the same whatever the thickness; a material, in Pa, with an `area` follows it"
    } else {
        ""
    };
    format!("`{own}` moves none of these numbers{why}")
}
