//! Laws that are not linear in materials, the size of what they make, and numbers that no pad can have.

use super::{on_model, read_text, scene};

const EPS: &str =
    "modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \"20 kPa\", exponent = 3";
const PAD: &str = "thickness = \"2 cm\", area = \"100 cm^2\"";

/// Thickness and area of the element `pad` with this law, beside these tables.
fn size(tables: &str, law: &str) -> [Option<f64>; 2] {
    let scene = scene(&format!("{tables}\n{}", on_model(law)));
    let pad = &scene.network.connections()[0];
    [pad.thickness, pad.area]
}

#[track_caller]
fn refused(tables: &str, law: &str, expected: &[&str]) {
    let shown = read_text(&format!("{tables}\n{}", on_model(law))).unwrap_err().render(false);
    for expected in expected {
        assert!(shown.contains(expected), "{expected}\nis not in\n{shown}");
    }
}

#[test]
fn the_size_of_an_element_is_that_of_its_foam() {
    let all = [Some(0.02), Some(0.01)];
    let foam = format!("[materials]\neps = {{ foam = {{ {EPS} }} }}\n");
    let models = format!("[models]\npad = {{ foam = {{ {EPS}, {PAD} }} }}\n");
    assert_eq!(size("", &format!("foam = {{ {EPS}, {PAD} }}")), all);
    assert_eq!(size("", &format!("foam = {{ {EPS} }}, {PAD}")), all);
    assert_eq!(size(&foam, &format!("material = \"eps\", {PAD}")), all);
    assert_eq!(size(&models, "model = \"pad\""), all);
    // The force of what stands beside the foam is not that on its area, unless the scene says so.
    let beside = "parallel = [{ model = \"pad\" }, { dashpot = 1 }]";
    assert_eq!(size(&models, beside), [Some(0.02), None]);
    assert_eq!(size(&models, &format!("{beside}, area = \"100 cm^2\"")), all);
    // In a row, stress and strain are not the same all over.
    assert_eq!(size(&models, "series = [{ model = \"pad\" }, { spring = 1 }]"), [None; 2]);
}

#[test]
fn what_lies_beside_a_dashpot_has_the_thickness_of_its_element() {
    let area = "area = \"100 cm^2\"";
    let tables = format!("[materials]\neps = {{ foam = {{ {EPS} }} }}\n");
    let model = |law: &str| {
        super::shape(&scene(&format!("{tables}{}", on_model(law))).network.connections()[0].model)
    };
    for law in [
        format!("hysteretic-foam = {{ {EPS}, set = \"10 %\", unloading-exponent = 2 }}, {area}"),
        format!("hysteretic-foam = {{ {EPS}, set = \"10 %\", unloading-exponent = 2, {area} }}"),
        format!("material = \"eps\", {area}"),
    ] {
        let thick = "thickness = \"2 cm\"";
        let around = format!("parallel = [{{ {law} }}, {{ dashpot = 1 }}], {thick}");
        let within = format!("parallel = [{{ {law}, {thick} }}, {{ dashpot = 1 }}]");
        assert_eq!(model(&around), model(&within), "{law}");
        assert_eq!(size(&tables, &around)[0], Some(0.02));
        // Parts in series have their own.
        let in_row = format!("series = [{{ {law} }}, {{ dashpot = 1 }}], {thick}");
        refused(&tables, &in_row, &["has no `thickness`", "each part of a `series`"]);
    }
}

#[test]
fn sizes_that_contradict_each_other_are_told_with_both_places() {
    let foam = |size: &str| format!("foam = {{ {EPS}, {size} }}");
    let thick = "thickness = \"25 mm\", area = \"100 cm^2\"";
    let both = ["`thickness` is 25 mm here, but 20 mm in line 5 of scene.toml"];
    refused("", &format!("{}, {PAD}", foam(thick)), &both);
    let beside =
        format!("parallel = [{{ {} }}, {{ dashpot = 1 }}], thickness = \"2 cm\"", foam(thick));
    refused("", &beside, &both);
    let in_row =
        format!("series = [{{ {} }}, {{ spring = 1 }}], thickness = \"2 cm\"", foam(thick));
    refused("", &in_row, &[both[0], "no thicker than the whole"]);
    refused("", &in_row.replace("25 mm", "30 mm"), &["`thickness` is 30 mm here, but 20 mm"]);
    let small = "thickness = \"20 mm\", area = \"1 cm^2\"";
    let areas = ["`area` is 0.0001 m^2 here, but 0.01 m^2 in line 5 of scene.toml"];
    refused("", &format!("{}, {PAD}", foam(small)), &areas);
    let material = format!("[materials]\neps = {{ {} }}\n", foam("area = 1"));
    refused(&material, &format!("material = \"eps\", {PAD}"), &["a material has no `area`"]);
    refused("", &format!("foam = {{ {EPS} }}, thickness = 0.02"), &["`foam` has no `area`"]);
    refused("", &format!("series = [{{ spring = 1, {PAD} }}]"), &["goes with a material or foam"]);
}

#[test]
fn one_thickness_in_two_units_is_one_thickness() {
    let foam = format!("foam = {{ {EPS}, thickness = \"20 mm\", area = \"0.01 m^2\" }}, {PAD}");
    assert_eq!(size("", &foam), [Some(0.02), Some(0.01)]);
}

#[test]
fn percent_without_their_sign_are_told() {
    let material = |law: &str| format!("[materials]\nown = {{ {law} }}\n");
    let law = format!("material = \"own\", {PAD}");
    for (own, key) in [
        ("table-spring = [[0, 0], [35, \"50 kPa\"]]".to_owned(), "table-spring"),
        ("power-spring = { force = \"1 kPa\", at = 35, exponent = 2 }".to_owned(), "at"),
        ("stiffening-spring = { stiffness = \"1 kPa\", limit = 35 }".to_owned(), "limit"),
        (format!("hysteretic-foam = {{ {EPS}, set = 35, unloading-exponent = 2 }}"), "set"),
    ] {
        let told = format!("`{key}` must be ");
        let expected = [told.as_str(), ", but it is 35", "write 0.35, or \"35 %\""];
        refused(&material(&own), &law, &expected);
        read_text(&format!("{}{}", material(&own.replace("35", "\"35 %\"")), on_model(&law)))
            .unwrap();
    }
    for (own, key) in [
        ("contact = { restitution = 35 }", "restitution"),
        ("bumper = { force = 1, at = 0.01, restitution = 35, speed = 1 }", "restitution"),
    ] {
        let told = format!("`{key}` must be ");
        refused("", own, &[&told, "write 0.35, or \"35 %\""]);
    }
    // More than a hundred percent is no strain either, and another number does not help.
    refused(
        &material("table-spring = [[0, 0], [\"350 %\", \"50 kPa\"]]"),
        &law,
        &["but it is 3.5"],
    );
}

#[test]
fn what_belongs_to_a_pad_is_told_how_it_becomes_that_of_a_material() {
    let law = format!("material = \"own\", {PAD}");
    let own = |law: &str| format!("[materials]\nown = {{ {law} }}\n");
    let refused = |own: &str, expected: &[&str]| refused(own, &law, expected);
    refused(
        &own("power-spring = { force = \"3 N\", at = \"1 mm\", exponent = 2 }"),
        &[
            "divide them by the area of the specimen",
            "divide them by the thickness of the specimen",
        ],
    );
    refused(
        &own("cubic-spring = { stiffness = \"1 kPa\", cubic = \"1 N/m^3\" }"),
        &["multiply them by thickness^3 / area of the specimen"],
    );
    refused(&own("contact = {}"), &["`contact` cannot stand in a material: it acts across a gap"]);
    let model = "power-spring = { force = \"3 kPa\", at = \"10 %\", exponent = 2 }";
    self::refused("", model, &["stresses and strains belong in [materials]"]);
}

#[test]
fn numbers_without_a_unit_that_are_odd_in_a_foam_are_warned_of() {
    let foam = EPS.replace("\"2 MPa\"", "2").replace("exponent = 3", "exponent = 35");
    let law = format!("foam = {{ {foam}, thickness = 20, area = 0.01 }}");
    let shown = read_text(&on_model(&law)).unwrap().warnings.render(false);
    for told in [
        "`modulus` is 2 Pa, which is very little",
        "\"2 MPa\"",
        "`exponent` is 35, which is very much",
        "`thickness` is 20 m: did you mean mm?",
    ] {
        assert!(shown.contains(told), "{told}\nis not in\n{shown}");
    }
}
