//! Models: nesting, names, other files.

use super::{messages, model, on_model, read_text, shape};
use crate::{ReadOptions, read, read_named_model};

#[test]
fn branches_are_named_by_their_words_and_numbered() {
    let text = format!(
        "[models.foam]\nspring = 3\n{}",
        on_model(
            "series = [{ spring = 1 }, { spring = 2 }, { kelvin = { spring = 1, dashpot = 1 } }, \
             { model = \"foam\" }, { spring = 5, name = \"spring-3\" }, { spring = 6 }]"
        )
    );
    let pad = super::scene(&text).network.connections()[0].model.clone();
    let names = pad.branches().iter().map(|branch| &*branch.name).collect::<Vec<_>>();
    assert_eq!(names, ["spring", "spring-2", "kelvin", "foam", "spring-3", "spring-4"]);
}

#[test]
fn aliases_stand_for_their_forms() {
    let of = |word: &str| shape(&model(&format!("{word} = {{ spring = 1, dashpot = 2 }}")));
    assert_eq!(of("kelvin"), of("kelvin-voigt"));
    assert_eq!(of("voigt"), of("kelvin-voigt"));
    assert_ne!(of("maxwell"), of("kelvin-voigt"));
}

#[test]
fn models_come_from_other_files_with_their_own_values() {
    let pads = "[values]\nK = \"3 N/m\"\n[models]\nfoam = { model = \"deep/er.toml:core\" }\n";
    let deeper = "[models]\ncore = { series = [{ spring = 7 }, { model = \"own\" }] }\n\
                  own = { dashpot = 2 }\n";
    let loader = |path: &str| match path {
        "lib/pads.toml" => Ok(pads.into()),
        "lib/deep/er.toml" => Ok(deeper.into()),
        other => Err(format!("no {other}")),
    };
    let options =
        ReadOptions { file: Some("lib/scene.toml"), loader: Some(&loader), ..Default::default() };
    let text = on_model("model = \"pads.toml:foam\"");
    let read = read(&text, &options).unwrap_or_else(|errors| panic!("{errors}")).value;
    assert_eq!(shape(&read.network.connections()[0].model).len(), 3);
    let alone = read_named_model(deeper, "core", &ReadOptions::default()).unwrap().value;
    assert_eq!(shape(&alone.model).len(), 3);
    assert!(read_named_model(deeper, "cor", &ReadOptions::default()).is_err());
}

#[test]
fn another_file_that_cannot_be_read_is_told_at_its_name() {
    let text = on_model("model = \"pads.toml:foam\"");
    let shown = messages(&text);
    assert!(shown.contains("`pads.toml` cannot be read: no other files can be read here"));
    let loader = |_: &str| Ok("[models]\nfaom = { sprin = 1 }\n".into());
    let options = ReadOptions { loader: Some(&loader), ..Default::default() };
    let shown = read(&text, &options).unwrap_err().render(false);
    assert!(shown.contains("there is no model named `foam`"), "{shown}");
    assert!(shown.contains("did you mean `faom`?"), "{shown}");
}

#[test]
fn circles_of_models_and_values_are_refused() {
    let text = format!(
        "[models]\na = {{ series = [{{ spring = 1 }}, {{ model = \"b\" }}] }}\n\
         b = {{ parallel = [{{ model = \"c\" }}] }}\nc = {{ model = \"a\" }}\n\
         d = {{ model = \"d\" }}\n[values]\nx = \"y\"\ny = \"x\"\nz = \"z\"\n{}",
        on_model("model = \"b\"")
    );
    let shown = messages(&text);
    assert!(shown.contains("the model `b` contains itself (b → c → a → b)"), "{shown}");
    assert!(shown.contains("the model `d` contains itself (d → d)"), "{shown}");
    assert!(shown.contains("the value `x` refers to itself (x → y → x)"), "{shown}");
    assert!(shown.contains("the value `z` refers to itself (z → z)"), "{shown}");
}

/// Models of so many tables within each other, by names and branches in turn, with springs beside them.
fn nested_by_name(tables: usize) -> String {
    use std::fmt::Write;
    let mut text = "[models]\n".to_owned();
    for at in 0..tables / 2 {
        let next = at + 1;
        let inner =
            if 2 * next < tables { format!("model = \"m{next}\"") } else { "spring = 1".into() };
        let _ = writeln!(text, "m{at} = {{ parallel = [{{ spring = 1 }}, {{ {inner} }}] }}");
    }
    text
}

#[test]
fn models_nest_to_the_limit_through_names_on_a_small_stack() {
    let on_stack = |tables: usize| {
        let read = move || read_named_model(&nested_by_name(tables), "m0", &ReadOptions::default());
        std::thread::Builder::new().stack_size(2 << 20).spawn(read).unwrap().join().unwrap()
    };
    let deep = on_stack(128).unwrap().value.model;
    assert_eq!(shape(&deep).len(), 128 + 1);
    assert!(!deep.is_deeper_than(64) && deep.is_deeper_than(63));
    let refused = on_stack(130).unwrap_err().render(false);
    let said = refused.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("nested 128 levels deep already, which is the limit"), "{refused}");
    assert!(said.contains("scene:66:1"), "{refused}");
    assert!(said.contains("into one list"), "{refused}");
}

#[test]
fn models_in_an_element_nest_to_the_limit() {
    let element = |tables: usize| {
        let element = "[elements]\npad = { between = [\"head\", \"ground\"], model = \"m0\" }\n";
        let nodes = "[nodes]\nhead = { mass = 1, velocity = 1 }\n";
        format!("{}{nodes}{element}[run]\nduration = 1\n", nested_by_name(tables))
    };
    assert!(read_text(&element(126)).is_ok());
    assert!(messages(&element(128)).contains("nested 128 levels deep already"));
}

#[test]
fn models_that_explode_are_refused() {
    use std::fmt::Write;
    let mut text = "[models]\n".to_owned();
    for at in 0..60 {
        let next = at + 1;
        let _ = writeln!(
            text,
            "m{at} = {{ series = [{{ model = \"m{next}\" }}, {{ model = \"m{next}\" }}] }}"
        );
    }
    text += "m60 = { spring = 1 }\n";
    let errors = read_named_model(&text, "m0", &ReadOptions::default()).unwrap_err();
    // 2⁶¹ − 1 parts and compositions, of which none is made.
    let expected = "model `m0` expands to 2305843009213693951 parts, about 18446744074 GB";
    let shown = errors.render(false).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains(expected), "{shown}");
}

#[test]
fn faults_of_models_that_nobody_uses_are_told() {
    let text = format!("[models]\nspare = {{ spring = \"2 kg\" }}\n{}", on_model("spring = 1"));
    assert!(messages(&text).contains("`2 kg` is a mass (kg)"));
    assert!(read_text(&on_model("spring = 1")).unwrap().warnings.is_empty());
}
