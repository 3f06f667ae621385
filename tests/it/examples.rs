//! The examples run to their end, with the assertions in them.

#[path = "../../examples/composition.rs"]
mod composition;
#[path = "../../examples/custom_element.rs"]
mod custom_element;
#[path = "../../examples/custom_measure.rs"]
mod custom_measure;
#[path = "../../examples/custom_method.rs"]
mod custom_method;
#[path = "../../examples/custom_padding.rs"]
mod custom_padding;
#[path = "../../examples/equivalent_models.rs"]
mod equivalent_models;
#[path = "../../examples/fibre_padding.rs"]
mod fibre_padding;
#[path = "../../examples/force_table.rs"]
mod force_table;
#[path = "../../examples/reference_impact.rs"]
mod reference_impact;
#[path = "../../examples/report_json.rs"]
mod report_json;
#[path = "../../examples/scene_from_toml.rs"]
mod scene_from_toml;
#[path = "../../examples/sweep_by_axes.rs"]
mod sweep_by_axes;
#[path = "../../examples/two_mass_chain.rs"]
mod two_mass_chain;

#[test]
fn the_reference_impact_runs() {
    reference_impact::main().unwrap();
}

#[test]
fn the_composition_runs() {
    composition::main().unwrap();
}

#[test]
fn the_custom_element_runs() {
    custom_element::main().unwrap();
}

#[test]
fn the_custom_measure_runs() {
    custom_measure::main().unwrap();
}

#[test]
fn the_report_as_json_runs() {
    report_json::main().unwrap();
}

#[test]
fn the_sweep_by_axes_runs() {
    sweep_by_axes::main().unwrap();
}

#[test]
fn the_custom_method_runs() {
    custom_method::main().unwrap();
}

#[test]
fn the_custom_padding_runs() {
    custom_padding::main().unwrap();
}

#[test]
fn the_two_mass_chain_runs() {
    two_mass_chain::main().unwrap();
}

#[test]
fn the_scene_from_toml_runs() {
    scene_from_toml::main().unwrap();
}

#[test]
fn the_force_table_runs() {
    force_table::main().unwrap();
}

#[test]
fn the_equivalent_models_run() {
    equivalent_models::main().unwrap();
}

#[test]
fn the_fibre_padding_runs() {
    fibre_padding::main().unwrap();
}
