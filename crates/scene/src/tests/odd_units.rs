//! Columns of files whose unit is probably another.

use crate::{ReadOptions, read};

/// What is told of a scene with a material of these rows.
fn told(header: &str, rows: &str, law: &str) -> String {
    let text = format!("{header}\n{rows}");
    let loader = move |_: &str| Ok(text.clone().into_bytes());
    let scene = format!(
        "[materials]\nfoam = {{ {law} }}\n[nodes]\nhead = {{ mass = 5, velocity = \"4 m/s\" }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], material = \"foam\", thickness = \"3 cm\", area = \"100 cm^2\" }}\n\
         [run]\nduration = \"8 ms\"\n"
    );
    let options =
        ReadOptions { file: Some("scene.toml"), loader: Some(&loader), ..ReadOptions::default() };
    let shown = match read(&scene, &options) {
        Ok(own) => own.warnings.render(false),
        Err(faults) => panic!("{}", faults.render(false)),
    };
    shown.split_whitespace().collect::<Vec<_>>().join(" ")
}

const FILE: &str = "table-spring = \"curve.csv\"";

#[test]
fn strains_in_parts_under_percent_are_warned_of() {
    let parts = "0,0\n0.1,100\n0.4,200\n0.7,900\n";
    let shown = told("strain [%],stress [kPa]", parts, FILE);
    assert!(shown.contains("the largest strain of the file is 0.7 %"), "{shown}");
    assert!(shown.contains("[1]"), "{shown}");
    for (header, rows) in [
        ("strain [1],stress [kPa]", parts),
        ("strain [%],stress [kPa]", "0,0\n10,100\n40,200\n70,900\n"),
    ] {
        let shown = told(header, rows, FILE);
        assert!(!shown.contains("largest"), "{shown}");
    }
}

#[test]
fn stresses_that_are_a_thousand_times_off_are_warned_of() {
    let rows = "0,0\n10,0.1\n40,0.2\n70,0.9\n";
    let shown = told("strain [%],stress [kPa]", rows, FILE);
    assert!(shown.contains("the largest stress of the file is 900 Pa"), "{shown}");
    assert!(shown.contains("if 900 kPa is meant"), "{shown}");
    let shown = told("strain [%],stress [MPa]", "0,0\n10,100\n40,200\n70,900\n", FILE);
    assert!(shown.contains("if 900 kPa is meant"), "{shown}");
    let shown = told("strain [%],stress [MPa]", rows, FILE);
    assert!(!shown.contains("largest"), "{shown}");
}
