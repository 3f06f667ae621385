//! Materials become pads by thickness and area.

use dashpot_network::{Model, composites::COMPOSITES, elements::Law, parameters::Value};
use dashpot_rheology::Tree;

use super::{on_model, read_text, scene, shape};
use crate::{ModelNote, ReadOptions, read, read_named_model};

/// The springs and dashpots of a model in the order of the text.
fn constants(model: &Model) -> Vec<f64> {
    let mut constants = Vec::new();
    let mut open = vec![model];
    while let Some(tree) = open.pop() {
        if let Tree::Part(element) = tree {
            match element.law() {
                Law::Spring(constant) | Law::Dashpot(constant) => constants.push(constant),
                Law::Rigid | Law::Nonlinear { .. } | Law::Phased => {}
            }
        }
        open.extend(tree.branches().iter().rev().map(|branch| &branch.tree));
    }
    constants
}

/// The model of the element `pad` with this law, beside these tables.
fn pad(tables: &str, law: &str) -> Model {
    scene(&format!("{tables}\n{}", on_model(law))).network.connections()[0].model.clone()
}

#[track_caller]
fn same(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        // One division and one product on either side, each rounded once.
        let bound = 4.0 * f64::EPSILON * expected.abs();
        assert!((found - expected).abs() <= bound, "{found:e} is not {expected:e}");
    }
}

const FOAM: &str = "[materials.foam]\n\
    kelvin-voigt = { spring = \"2 MPa\", dashpot = \"5 kPa s\" }\n";

#[test]
fn a_pad_has_modulus_times_area_over_thickness() {
    let foam = pad(FOAM, "material = \"foam\", thickness = \"2 cm\", area = \"100 cm^2\"");
    same(&constants(&foam), &[2e6 * 0.01 / 0.02, 5e3 * 0.01 / 0.02]);
    let text = format!(
        "{FOAM}{}",
        on_model("material = \"foam\", thickness = \"2 cm\", area = \"100 cm^2\"")
    );
    assert_eq!(scene(&text).network.connections()[0].thickness, Some(0.02));
}

#[test]
fn layers_stand_in_series_each_with_its_own_size() {
    let layers = pad(
        FOAM,
        "series = [{ material = \"foam\", thickness = \"1 cm\", area = \"80 cm^2\" }, \
         { material = \"foam\", thickness = \"3 cm\", area = \"50 cm^2\", name = \"core\" }]",
    );
    let names: Vec<&str> = layers.branches().iter().map(|branch| &*branch.name).collect();
    assert_eq!(names, ["foam", "core"]);
    let [one, other] = [0.008 / 0.01, 0.005 / 0.03];
    same(&constants(&layers), &[2e6 * one, 5e3 * one, 2e6 * other, 5e3 * other]);
}

#[test]
fn materials_refer_to_each_other_without_a_size() {
    let tables = "[values]\nE = \"3 MPa\"\n[materials]\n\
        felt = { series = [{ spring = \"E\" }, { material = \"oil\" }, { dashpot = 7 }] }\n\
        oil = { dashpot = \"2 Pa s\" }\n";
    let felt = pad(tables, "material = \"felt\", thickness = 0.5, area = 2");
    same(&constants(&felt), &[12e6, 8.0, 28.0]);
    let own = read_named_model(tables, "felt", &ReadOptions::default()).unwrap().value;
    assert!(own.is_material);
    same(&constants(&own.model), &[3e6, 2.0, 7.0]);
}

#[test]
fn a_model_may_be_made_of_materials_and_be_used_by_name() {
    let tables = format!(
        "{FOAM}[models.pad]\nparallel = [{{ spring = 5 }}, \
         {{ material = \"foam\", thickness = 2, area = 1 }}]\n"
    );
    same(&constants(&pad(&tables, "model = \"pad\"")), &[5.0, 1e6, 2.5e3]);
}

#[test]
fn materials_come_from_other_files() {
    let loader = |path: &str| match path {
        "pads.toml" => Ok(format!("{FOAM}[materials.bar]\nmaterial = \"more.toml:iron\"\n").into()),
        "more.toml" => Ok("[materials]\niron = { spring = \"200 GPa\" }\n".into()),
        other => Err(format!("no {other}")),
    };
    let options = ReadOptions { loader: Some(&loader), ..ReadOptions::default() };
    for (name, expected) in [("foam", &[4e6, 1e4][..]), ("bar", &[4e11])] {
        let law = format!("material = \"pads.toml:{name}\", thickness = 1, area = 2");
        let read = read(&on_model(&law), &options).unwrap_or_else(|errors| panic!("{errors}"));
        same(&constants(&read.value.network.connections()[0].model), expected);
    }
}

#[test]
fn composites_of_materials_scale_with_the_pad() {
    let tables = "[materials.pvb]\n\
        prony = { equilibrium = \"1 MPa\", terms = [[\"1 ms\", \"4 MPa\"], [\"1 s\", \"2 MPa\"]] }\n\
        [materials.wax]\nkelvin-chain = [[\"2 ms\", \"0.5 1/MPa\"]]\n";
    let pvb = pad(tables, "material = \"pvb\", thickness = 0.5, area = 2");
    same(&constants(&pvb), &[4e6, 16e6, 16e3, 8e6, 8e6]);
    // A Kelvin element of modulus 2 MPa and 2 ms.
    let wax = pad(tables, "material = \"wax\", thickness = 0.5, area = 2");
    same(&constants(&wax), &[8e6, 16e3]);
}

#[test]
fn composites_are_the_models_that_they_describe() {
    use dashpot_network::{
        composites::{CompositeKind as _, KelvinChain, Prony},
        parameters::{Described as _, Kind as _},
    };
    let prony = Prony { equilibrium: 1e6, terms: vec![(1e-3, 2e6), (0.1, 5e5)] };
    let read = super::model(
        "prony = { equilibrium = \"1 MN/m\", terms = [[\"1 ms\", \"2 MN/m\"], [\"0.1 s\", \"0.5 MN/m\"]] }",
    );
    assert_eq!(shape(&read), shape(&prony.compose().unwrap().model));
    let explicit = super::model(
        "parallel = [{ spring = 1e6 }, { maxwell = { spring = 2e6, dashpot = 2e3 } }, \
         { maxwell = { spring = 5e5, dashpot = 5e4 } }]",
    );
    same(&constants(&read), &constants(&explicit));
    let sample = KelvinChain::sample();
    let written = crate::write_kind(
        KelvinChain::KIND,
        KelvinChain::PARAMETERS,
        &sample.values(),
        KelvinChain::AMPLITUDE,
    );
    assert_eq!(shape(&super::model(&written)), shape(&sample.compose().unwrap().model));
}

#[test]
fn a_shift_multiplies_every_dashpot_below_it() {
    let arrhenius = "{ arrhenius = { temperature = \"0 degC\", reference = \"20 degC\", \
                     energy = \"100 kJ/mol\" } }";
    // R = N_A k, exact since 2019.
    let gas_constant = 6.022_140_76e23 * 1.380_649e-23;
    let factor = f64::exp(1e5 / gas_constant * (1.0 / 273.15 - 1.0 / 293.15));
    let tables = format!(
        "[models]\ncore = {{ parallel = [{{ spring = 3 }}, {{ dashpot = 5 }}] }}\n\
         cold = {{ model = \"core\", shift = {arrhenius} }}\n\
         colder = {{ series = [{{ dashpot = 2 }}, {{ model = \"cold\" }}], shift = {arrhenius} }}\n\
         [materials]\nwax = {{ maxwell = {{ spring = 3, dashpot = 5 }}, shift = {arrhenius} }}\n"
    );
    let near = |law: &str, expected: &[f64]| {
        let found = constants(&pad(&tables, law));
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            // The exponent is about 3.0; a few roundings of it, and two of factors.
            assert!((found / expected - 1.0).abs() < 20.0 * f64::EPSILON, "{found} {expected}");
        }
    };
    near("model = \"core\"", &[3.0, 5.0]);
    near("model = \"cold\"", &[3.0, 5.0 * factor]);
    near("model = \"colder\"", &[2.0 * factor, 3.0, 5.0 * factor * factor]);
    near("material = \"wax\", thickness = 1, area = 2", &[6.0, 10.0 * factor]);
    near(&format!("dashpot = 4, shift = {arrhenius}"), &[4.0 * factor]);
    let read = scene(&format!("{tables}{}", on_model("model = \"cold\"")));
    let [ModelNote { subject, what, .. }] = read.notes.as_slice() else {
        panic!("{:?}", read.notes)
    };
    assert_eq!(subject, "model `cold`");
    assert_eq!(what.to_string(), format!("`arrhenius` multiplies its times by {factor:.3e}"));
}

#[test]
fn notes_of_composites_are_about_the_place_that_describes_them() {
    let terms = "[[\"1 s\", \"2 MN/m\"], [\"1 ms\", \"1 MN/m\"]]";
    let tables = format!("[models.felt]\nprony = {{ terms = {terms} }}\n");
    let text = format!(
        "{tables}{}",
        on_model("model = \"felt\"").replace(
            "[run]",
            "two = { between = [\"head\", \"ground\"], model = \"felt\" }\n\
             three = { between = [\"head\", \"ground\"], series = [{ spring = 1 }, \
             { prony = { terms = [[\"2 s\", 2], [1, 1]] }, name = \"core\" }] }\n[run]"
        )
    );
    let checked = read_text(&text).unwrap();
    assert!(checked.warnings.is_empty());
    let subjects: Vec<&str> =
        checked.value.notes.iter().map(|note| note.subject.as_str()).collect();
    assert_eq!(subjects, ["model `felt`", "element `three`, branch `core`"]);
    let felt = read_named_model(&text, "felt", &ReadOptions::default()).unwrap().value;
    assert_eq!(felt.notes, checked.value.notes[..1]);
    let shift = "shift = { wlf = { temperature = \"30 degC\", reference = \"20 degC\" } }";
    let shifted = tables.replace("prony", &format!("{shift}\nprony"));
    let notes = read_named_model(&shifted, "", &ReadOptions::default()).unwrap().value.notes;
    assert!(
        notes[1].what.to_string().contains(", before its times are multiplied by "),
        "{notes:?}"
    );
}

#[test]
fn a_material_that_contains_itself_is_refused() {
    let tables = "[materials]\na = { series = [{ material = \"b\" }] }\nb = { material = \"a\" }\n\
                  c = { spring = 1 }\n\
                  [models]\na = { material = \"c\", thickness = 1, area = 1 }\n";
    let text = format!("{tables}{}", on_model("model = \"a\""));
    let shown = read_text(&text).unwrap_err().render(false);
    assert!(shown.contains("the material `a` contains itself (a → b → a)"), "{shown}");
    assert_eq!(shown.matches("contains itself").count(), 1, "{shown}");
}

#[test]
fn every_composite_of_a_material_is_in_proportion_to_the_area() {
    assert!(COMPOSITES.len() >= 2);
    for kind in COMPOSITES {
        let sample = (kind.sample)();
        let keys = kind.parameters.iter().zip(sample).map(|(parameter, value)| {
            let bare = match value {
                Value::Number(number) => format!("{number:?}"),
                Value::Table(points) => {
                    let pairs = points.iter().map(|(at, value)| format!("[{at:?}, {value:?}]"));
                    format!("[{}]", pairs.collect::<Vec<_>>().join(", "))
                }
                other => panic!("{}: {other:?}", kind.word),
            };
            (parameter.name, bare)
        });
        let keys: Vec<(&str, String)> = keys.collect();
        let law = match keys.as_slice() {
            [(_, only)] => only.clone(),
            all => {
                let pairs = all.iter().map(|(name, bare)| format!("{name} = {bare}"));
                format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
            }
        };
        let tables = format!("[materials.own]\n{} = {law}\n", kind.word);
        let pad = pad(&tables, "material = \"own\", thickness = 0.25, area = 0.5");
        let alone = constants(&kind.example().unwrap().model);
        // A factor of two is exact in every step of a composite.
        let doubled: Vec<f64> = alone.iter().map(|own| 2.0 * own).collect();
        assert_eq!(constants(&pad), doubled, "{}", kind.word);
    }
}

#[test]
fn a_shift_of_a_law_without_times_is_told_to_change_nothing() {
    let shift = "shift = { wlf = { temperature = \"30 degC\", reference = \"20 degC\" } }";
    let warned = |law: &str| {
        let checked = read_text(&on_model(&format!("{law}, {shift}"))).unwrap();
        checked.warnings.render(false).contains("`wlf` shifts times, and this law has none")
    };
    assert!(warned("spring = 1"));
    assert!(warned("table-spring = [[0, 0], [1, 1]]"));
    assert!(warned("parallel = [{ spring = 1 }, { table-spring = [[0, 0], [1, 1]] }]"));
    assert!(!warned("dashpot = 1"));
    assert!(!warned("parallel = [{ spring = 1 }, { maxwell = { spring = 1, dashpot = 1 } }]"));
}
