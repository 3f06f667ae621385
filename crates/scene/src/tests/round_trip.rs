//! What is written is read back equal, for every kind of every register.

use dashpot_analysis::MEASURES;
use dashpot_network::{
    Element as _, Model,
    composites::COMPOSITES,
    effects::EFFECTS,
    elements::{ELEMENTS, Formula},
    parameters::{Dimension, Kind as _},
    part,
    shifts::{SHIFTS, shifted},
    waveforms::WAVEFORMS,
};
use dashpot_rheology::{Branch, FORMS, Role, Tree, forms::build};

use super::{on_model, scene, shape};
use crate::{
    NamedModel, ReadOptions,
    quantities::basis::{self, fits_material},
    read_named_model, read_network, write_effect, write_kind, write_material_table, write_model,
    write_model_table,
};

fn read_back(model: &Model) -> Model {
    let text = format!("[models]\nm = {}\n", write_model(model));
    let inline = read_table(&text).model;
    let comments = ["first\nsecond".to_owned(), "= [\u{7}".to_owned()];
    let table = read_table(&write_model_table("m", model, &comments));
    assert_eq!((shape(&table.model), table.is_material), (shape(&inline), false));
    let text = write_material_table("m", model, &comments);
    if fits(model) {
        let material = read_table(&text);
        assert!(material.is_material);
        // A formula comes back as another text of the same law, which a test of its own looks at.
        if model.parts().iter().any(|own| own.1.kind() == Formula::KIND) {
            return inline;
        }
        assert_eq!(write_material_table("m", &material.model, &comments), text);
        if !is_sized(model) {
            assert_eq!(shape(&material.model), shape(&inline));
        }
    } else {
        let refused = read_named_model(&text, "m", &ReadOptions::default()).unwrap_err();
        assert!(refused.to_string().contains("cannot stand in a material"), "{refused}");
    }
    inline
}

/// Whether an element of a model has a size, which it leaves behind in a material.
fn is_sized(model: &Model) -> bool {
    model.parts().iter().any(|(_, element)| basis::is_sized(element.parameters()))
}

/// Whether all elements of a model may stand in a material.
fn fits(model: &Model) -> bool {
    model.parts().iter().all(|(_, element)| fits_material(element.parameters()))
}

fn read_table(text: &str) -> NamedModel {
    let read = read_named_model(text, "m", &ReadOptions::default());
    read.unwrap_or_else(|e| panic!("{text}\n{e}")).value
}

/// Numbers that need all their digits, over the whole range of what may be met.
#[test]
fn tables_of_models_are_read_back_to_the_last_bit() {
    use dashpot_network::elements::{Dashpot, Spring};
    let mut constant = 1.0 / 3.0;
    let mut next = || {
        constant = (constant * 1.618_033_988_749_895 * 1e7) % 1e12 * 1.000_000_1 + 1e-9;
        constant
    };
    let branches = (0..60).map(|_| {
        let (stiffness, damping) = (next(), 1.0 / next());
        Tree::series([part(Spring { stiffness }), part(Dashpot { damping })])
    });
    let model = Tree::parallel(branches);
    assert_eq!(shape(&read_back(&model)), shape(&model));
    let text = write_material_table("foam", &model, &["by hand".to_owned()]);
    let lines: Vec<&str> = text.lines().take(3).collect();
    assert_eq!(lines, ["# by hand", "[materials.foam]", "parallel = ["]);
    assert_eq!(text.lines().count(), 64);
    assert!(text.contains(" mPa s\"") && !text.contains("N/m"), "{text}");
}

#[test]
fn a_table_of_one_part_and_of_an_odd_name() {
    use dashpot_network::elements::Spring;
    let model = part(Spring { stiffness: 2e6 });
    let text = write_material_table("soft foam", &model, &[]);
    assert_eq!(text, "[materials.\"soft foam\"]\nspring = \"2 MPa\"\n");
    let read = read_named_model(&text, "soft foam", &ReadOptions::default()).unwrap().value;
    assert_eq!(shape(&read.model), shape(&model));
}

#[test]
fn every_element_is_read_back_equal() {
    for kind in ELEMENTS {
        let own = || Tree::Part(kind.example().unwrap());
        let sample = own();
        assert_eq!(shape(&read_back(&sample)), shape(&sample), "{}", kind.word);
        let named = Tree::Series(vec![
            Branch::new("odd \"name\"", own()),
            Branch::new("ä", Tree::parallel([own(), own()])),
        ]);
        assert_eq!(shape(&read_back(&named)), shape(&named), "{}", kind.word);
    }
}

#[test]
fn a_formula_of_a_material_is_that_of_its_pads() {
    let sample = Formula::sample();
    let text = write_material_table("m", &part(sample.clone()), &[]);
    let read = read_table(&text).model;
    let Tree::Part(read) = read else { panic!("{text}") };
    for (y, v) in [(0.003, 0.5), (-0.011, -2.0), (0.04, 1.0)] {
        let (found, exact) = (read.force(y, v), sample.force(y, v));
        assert!((found / exact - 1.0).abs() < 1e-14, "{text}: {found} {exact}");
    }
}

#[test]
fn every_form_is_read_back_equal() {
    for kind in FORMS {
        let mut value = 1.0 / 3.0;
        let mut leaf = |_: &[&'static str], role: Role| {
            value *= 1.7;
            let spring = dashpot_network::elements::Spring { stiffness: value };
            let dashpot = dashpot_network::elements::Dashpot { damping: value };
            let is_spring = matches!(role, Role::Spring);
            Ok::<std::sync::Arc<dyn dashpot_network::Element>, ()>(if is_spring {
                std::sync::Arc::new(spring)
            } else {
                std::sync::Arc::new(dashpot)
            })
        };
        let form = build(kind.parts, kind.in_series, &mut leaf).unwrap();
        assert_eq!(shape(&read_back(&form)), shape(&form), "{}", kind.word);
    }
}

#[test]
fn every_composite_is_read_back_equal() {
    for kind in COMPOSITES {
        let written = write_kind(kind.word, kind.parameters, &(kind.sample)(), kind.about);
        let composed = kind.example().unwrap().model;
        let read = super::model(&written);
        assert_eq!(shape(&read), shape(&composed), "{written}");
        assert_eq!(shape(&read_back(&read)), shape(&composed), "{written}");
    }
}

#[test]
fn every_shift_is_read_back_equal() {
    for kind in SHIFTS {
        let written = write_kind(kind.word, kind.parameters, &(kind.sample)(), Dimension::NUMBER);
        let law = "kelvin-voigt = { spring = 3, dashpot = 5 }";
        let read = super::model(&format!("{law}, shift = {{ {written} }}"));
        let expected = shifted(&super::model(law), kind.example().unwrap()).unwrap();
        assert_eq!(shape(&read), shape(&expected), "{written}");
    }
}

#[test]
fn every_function_is_read_back_equal() {
    for kind in WAVEFORMS {
        let sample = (kind.sample)();
        let force = write_kind(kind.word, kind.parameters, &sample, Dimension::FORCE);
        let motion = write_kind(kind.word, kind.parameters, &sample, Dimension::LENGTH);
        let text = format!(
            "{}[loads.push]\non = \"head\"\nforce = {{ {force} }}\n",
            on_model("spring = 1").replace(
                "[elements]",
                &format!(
                    "base = {{ motion = {{ {motion} }} }}\n[elements]\n\
                     spare = {{ between = [\"head\", \"base\"], spring = 1 }}"
                )
            )
        );
        let read = scene(&text);
        let expected = kind.example().unwrap();
        assert_eq!(read.network.loads()[0].force, expected, "{}", kind.word);
        let base = read.network.node_named("base").unwrap();
        let support = &read.network.node(base).support;
        assert_eq!(*support, dashpot_network::Support::Prescribed(expected), "{}", kind.word);
    }
}

#[test]
fn every_effect_is_read_back_equal() {
    for kind in EFFECTS {
        let sample = kind.example().unwrap().on("padding");
        let sample = sample.unwrap_or_else(|| kind.example().unwrap());
        let network = on_model("spring = 1").replace("pad =", "padding =");
        let text = format!("{network}[effects]\n{}\n", write_effect(sample.as_ref()));
        let read = read_network(&text, &ReadOptions::default());
        let read = read.unwrap_or_else(|faults| panic!("{text}\n{faults}")).value;
        let effect = &read.effects()[0];
        assert_eq!((effect.kind(), effect.target()), (kind.word, sample.target()));
        assert_eq!(effect.values(), sample.values());
    }
}

#[test]
fn every_measure_is_read_back_equal() {
    for kind in MEASURES {
        let target = match kind.about.family {
            dashpot_analysis::Family::Element => "pad",
            dashpot_analysis::Family::Node => "head",
        };
        let values = (kind.sample)();
        let written = write_kind(kind.word, kind.parameters, &values, Dimension::NUMBER);
        let options = written.split_once(" = ").unwrap().1.trim_matches(['{', '}', ' ']);
        let comma = if options.is_empty() { "" } else { "," };
        let text = format!(
            "{}[measures]\n{target} = {{ kind = \"{}\"{comma} {options} }}\n",
            on_model("spring = 1"),
            kind.word
        );
        let read = scene(&text);
        let measure = &read.measures[0].measure;
        assert_eq!((measure.kind(), measure.values()), (kind.word, values), "{text}");
    }
}
