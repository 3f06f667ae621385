//! A laboratory test.

use dashpot_analysis::similarity::{Laboratory, Measured, Wish, measured, similar_settings};
use dashpot_report::Table;
use dashpot_scene::Scene;
use serde::Serialize;

use super::{
    DIGITS, GroupsArguments, left_out,
    opposed::{self, factor_table, factors},
    quantity, si, write,
};
use crate::{
    error::CliError,
    input::{setting, title},
    output::{Text, list, object},
    terminal::Tone,
};
use dashpot_report::numbers::{constant, significant};

pub(super) struct Test {
    design: Laboratory,
    /// The measures of the real scene, and those of the laboratory with its own gravity, at the scale
    /// of the real one; none where gravity is right.
    with_own_gravity: Vec<Measured>,
    /// The measures of the real scene, and what the laboratory reads.
    measures: Vec<Measured>,
    left_out: Vec<String>,
    written: Option<String>,
}

impl Test {
    /// Designs, solves and writes it.
    pub(super) fn of(scene: &Scene, arguments: &GroupsArguments) -> Result<Self, CliError> {
        let real = &scene.network;
        let wish = |(name, text): &(String, String)| {
            let dimension = Laboratory::parameter(real, name)?.dimension;
            Ok(Wish { name: name.clone(), value: setting(name, text, dimension)? })
        };
        let wishes = arguments.lab.iter().map(wish).collect::<Result<Vec<_>, CliError>>()?;
        let design = Laboratory::design(real, &wishes)?;
        let settings = scene.settings("auto")?;
        let (similar, left_out) = similar_settings(&settings, &design.scale);
        let mut measures =
            opposed::cleared(measured(real, &design.network, &design.scale, &settings)?);
        for measure in &mut measures {
            measure.values[1] = measure.values[1].map(|value| value * measure.factor);
        }
        let mut with_own_gravity = Vec::new();
        if other_gravity(&design).is_some() {
            let other = design.under_real_gravity()?;
            with_own_gravity = opposed::cleared(measured(real, &other, &design.scale, &settings)?);
        }
        let mut written = None;
        if let Some(path) = &arguments.out {
            let title = format!("Laboratory test for: {}", title(scene));
            write(path, &title, &design.network, &similar, (scene, arguments))?;
            written = Some(path.display().to_string());
        }
        Ok(Self { design, with_own_gravity, measures, left_out, written })
    }

    pub(super) fn object(&self) -> impl Serialize {
        let design = &self.design;
        object! {
            chosen: list(design.chosen.iter().map(|own| object! {
                parameter: &own.real.name,
                real: own.real.value,
                laboratory: own.value,
                unit: si(own.real.dimension),
            })),
            kept: list(design.kept.iter().map(|own| quantity("", own))),
            scale: factors(&design.scale),
            gravity: design.gravity,
            with_own_gravity: opposed::objects(&self.with_own_gravity),
            measures: opposed::objects(&self.measures),
            left_out: &self.left_out,
            written: &self.written,
        }
    }

    pub(super) fn text(&self, text: &mut Text) {
        text.table(&self.choices());
        text.table(&factor_table("The map: laboratory over real, and back", &self.design.scale));
        text.table(&self.predicted());
        if let Some([real, needed]) = other_gravity(&self.design) {
            let [real, needed] = [real, needed].map(|value| constant(value, "m/s^2"));
            text.blank();
            text.toned(
                Tone::Warning,
                &format!(
                    "! gravity would have to be {needed} in the laboratory, where it is {real} in \
                     the real scene; the scene that is written has it so. What a laboratory under \
                     {real} measures is shown below."
                ),
            );
            let caption = "The laboratory with gravity as it is, at the real scale";
            let measures = &self.with_own_gravity;
            text.table(&opposed::table(caption, ["real", "laboratory"], measures));
        }
        left_out(text, &self.left_out);
        if let Some(path) = &self.written {
            text.line(&format!("\nwrote {path}; `dashpot run {path}` solves it"));
        }
    }

    /// What is chosen, and what stays as it is.
    fn choices(&self) -> Table {
        let chosen = self.design.chosen.iter().map(|own| {
            let text_of = |value| constant(value, si(own.real.dimension));
            vec![own.real.name.clone(), text_of(own.real.value), text_of(own.value)]
        });
        let kept = self.design.kept.iter().map(|own| {
            let value = constant(own.value, si(own.dimension));
            vec![own.name.clone(), value.clone(), format!("{value} (kept)")]
        });
        let header = ["parameter", "real", "laboratory"];
        Table::new("The laboratory test", &header, chosen.chain(kept))
    }

    /// What the laboratory will read.
    fn predicted(&self) -> Table {
        let row = |measured: &Measured| {
            let [one, other] = measured.values.map(|value| opposed::shown(measured, value));
            vec![measured.key.clone(), one, other, significant(measured.factor.recip(), DIGITS)]
        };
        let header = ["measure", "real", "laboratory", "and back"];
        Table::new("What the laboratory reads", &header, self.measures.iter().map(row))
    }
}

/// Gravity in the real scene, and that which the laboratory would need, where they differ.
fn other_gravity(design: &Laboratory) -> Option<[f64; 2]> {
    design.gravity.filter(|[real, needed]| (needed - real).abs() > 1e-9 * real.abs())
}
