//! The uncertainty of fitted numbers as scatter of the fitted scene: what is known of them together.

use super::{scene::FittedScene, scene_words::no_band};
use crate::output::list;

/// Digits of shares: what is known of a product is small beside what is not known of its factors.
const DIGITS: usize = 9;
/// Causes that add less than this part of the largest share tell nothing but rounding.
const ROUNDING: f64 = 1e-9;

impl FittedScene<'_> {
    /// The section that states it, or why there is none.
    pub(super) fn scatter(&self) -> Result<String, &'static str> {
        if let Some(why) = self.fit.reservation() {
            return Err(no_band(why));
        }
        let paths =
            self.numbers.iter().map(|own| own.at.map(|at| &self.plan.tunables.all()[at].path));
        let Some(paths) = paths.collect::<Option<Vec<_>>>() else {
            return Err(
                "the constants of a form that was put in have no place in the text yet: fit the scene that \
                        was written once more",
            );
        };
        if self.fit.undetermined.ncols() > 0 || !self.shown.is_empty() {
            return Err("the tests do not determine all numbers: leave one of them at its value");
        }
        let causes =
            self.fit.causes().ok_or("the axes of the numbers' covariance were not found")?;
        let largest = causes.iter().flatten().map(|own| own.abs()).fold(0.0, f64::max);
        let told = causes.iter().filter(|own| own.iter().any(|own| own.abs() > ROUNDING * largest));
        let line = |shares: &Vec<f64>| {
            let each = paths.iter().zip(shares);
            let each = each.map(|(path, share)| format!("\"{path}\" = {share:.*e}", DIGITS - 1));
            format!("  {{ {} }},\n", list(each).join(", "))
        };
        Ok(format!(
            "\n# What the fit leaves open, together: of each independent cause what one standard deviation adds to the\n\
             # logarithm of each number.\n[scatter]\ntogether = [\n{}]\n",
            list(told.map(line)).concat()
        ))
    }
}
