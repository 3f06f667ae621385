//! Models by name, and networks without a run.

use super::shape;
use crate::{ReadOptions, read_named_model, read_network, reference};

const PADS: &str = "[values]\nK = \"3 N/m\"\n\n# A soft one.\n[models.felt]\n# inside\n\
                    series = [\n  { spring = \"K\" },\n  { dashpot = 2 },\n]\n\n\
                    [materials]\nfoam = { spring = \"2 MPa\" }\nfelt = { spring = 1 }\n";

fn refused(text: &str, name: &str) -> String {
    read_named_model(text, name, &ReadOptions::default()).unwrap_err().render(false)
}

#[test]
fn a_name_is_looked_up_among_models_then_materials_then_elements() {
    let get = |text: &str, name: &str| {
        let read = read_named_model(text, name, &ReadOptions::default());
        read.unwrap_or_else(|errors| panic!("{errors}")).value
    };
    let felt = get(PADS, "felt");
    assert!(!felt.is_material && felt.name == "felt");
    assert_eq!(shape(&felt.model).len(), 3);
    assert!(PADS[felt.span.clone()].starts_with("[models.felt]\n# inside\nseries"));
    assert!(PADS[felt.span].ends_with("]\n"));
    let foam = get(PADS, "foam");
    assert!(foam.is_material);
    assert_eq!(&PADS[foam.span], "foam = { spring = \"2 MPa\" }\n");
    let mount = get(reference(), "mount");
    assert_eq!(shape(&mount.model)[0], "0  parallel");
    let set = [("K".to_owned(), "5 N/m".to_owned())];
    let options = ReadOptions { set: &set, ..ReadOptions::default() };
    let felt = read_named_model(PADS, "felt", &options).unwrap().value;
    assert!(shape(&felt.model)[1].contains("5.0"), "{:?}", shape(&felt.model));
}

#[test]
fn the_only_model_needs_no_name() {
    let get = |text: &str| read_named_model(text, "", &ReadOptions::default()).unwrap().value.name;
    assert_eq!(get(reference()), "valox-pad");
    assert_eq!(get("[materials.foam]\nspring = 1\n"), "foam");
    assert_eq!(get(&super::on_model("spring = 1")), "pad");
    let shown = refused(PADS, "");
    assert!(shown.contains("there are several models here"), "{shown}");
    assert!(shown.contains("name one of: felt, foam"), "{shown}");
    assert!(refused("title = \"x\"\n", "").contains("there is no model here"));
}

#[test]
fn a_name_that_nothing_has_is_told_with_all_that_there_are() {
    let shown = refused(reference(), "valox");
    assert!(shown.contains("there is no model, material or element named `valox`"), "{shown}");
    let known = "known models, materials and elements: mount, padding, valox-pad";
    assert!(shown.contains(known), "{shown}");
    assert!(
        refused("title = \"x\"\n", "a").contains("there are no models, materials and elements")
    );
    assert!(refused(PADS, "foma").contains("did you mean `foam`?"));
}

#[test]
fn a_network_needs_no_run_and_need_not_compile() {
    let text = "[nodes]\nhead = { mass = 1 }\nfree = {}\n\
                [elements]\npad = { between = [\"head\", \"free\"], spring = 1 }\n";
    let network = read_network(text, &ReadOptions::default()).unwrap().value;
    assert_eq!(network.connections().len(), 1);
    assert!(network.node_named("free").is_some());
    for (odd, told) in [
        ("[runn]\n", "unknown key `runn`"),
        ("[run]\nduratoin = 1\n", "unknown key `duratoin`"),
        ("[loads.f]\non = \"haed\"\nforce = { constant = 1 }\n", "no node named `haed`"),
        ("[materials.a]\nspring = \"1 kN/m\"\n", "a pressure (Pa) is expected"),
    ] {
        let text = format!("{text}{odd}");
        let shown = read_network(&text, &ReadOptions::default()).unwrap_err().render(false);
        assert!(shown.contains(told), "{shown}");
    }
}
