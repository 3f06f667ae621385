//! Effects on single elements: how they are written, and what is said where they are wrong.

use dashpot_network::{
    Network,
    effects::{Face, Separation, Stop, Touch},
};

use crate::{ReadOptions, read_network, write_effect};

/// A head on a pad on a sprung panel, with `effects`.
fn text(effects: &str) -> String {
    format!(
        "[values]\ndepth = \"15 mm\"\n\
         [nodes]\nhead = {{ mass = 10, velocity = 10 }}\npanel = {{ mass = 100 }}\n\
         [elements]\n\
         padding = {{ between = [\"head\", \"panel\"], spring = \"20 MN/m\", thickness = \"2 cm\" }}\n\
         mount = {{ between = [\"panel\", \"ground\"], spring = \"50 MN/m\" }}\n\
         {effects}\n"
    )
}

fn network(effects: &str) -> Network {
    let text = text(effects);
    let read = read_network(&text, &ReadOptions::default());
    read.unwrap_or_else(|faults| panic!("{text}\n{faults}")).value
}

fn messages(effects: &str) -> String {
    read_network(&text(effects), &ReadOptions::default()).unwrap_err().render(false)
}

fn says(effects: &str, expected: &[&str]) {
    let shown = messages(effects);
    for expected in expected {
        assert!(shown.contains(expected), "{expected}\nis not in\n{shown}");
    }
}

/// The effects that are on, as a scene says them.
fn written(effects: &str) -> Vec<String> {
    network(effects).effects().iter().map(|effect| write_effect(effect.as_ref())).collect()
}

#[test]
fn an_effect_on_an_element_is_read_however_its_table_is_written() {
    let separation = Separation {
        element: "padding".to_owned(),
        at: Some("panel".to_owned()),
        restitution: 0.0,
    };
    for effects in [
        "[effects]\nseparation.padding = { at = \"panel\" }",
        "[effects.separation]\npadding = { at = \"panel\" }",
        "[effects.separation.padding]\nat = \"panel\"",
    ] {
        assert_eq!(written(effects), [write_effect(&separation)]);
    }
    let defaults = write_effect(&Separation { at: None, ..separation });
    assert_eq!(defaults, "separation.padding = { restitution = 0.0 }");
    for effects in ["separation.padding = true", "separation.padding = {}", &defaults] {
        assert_eq!(written(&format!("[effects]\n{effects}")), [&*defaults]);
    }
}

#[test]
fn several_elements_have_effects_of_one_kind() {
    let effects = "[effects]\nseparation.padding = true\nseparation.mount = true\n\
         face.padding = \"0.2 kg\"\nstop.padding = { at = \"depth\" }\n\
         stop.mount = { at = \"1 cm\", stiffness = \"1 GN/m\", damping = \"2 kN s/m\" }";
    let face = Face { element: "padding".to_owned(), mass: 0.2, at: None, touch: Touch::Impact };
    let stop = |element: &str, at, stiffness, damping| Stop {
        element: element.to_owned(),
        at: Some(at),
        restitution: 0.0,
        stiffness,
        damping,
    };
    let expected = [
        "separation.padding = { restitution = 0.0 }".to_owned(),
        "separation.mount = { restitution = 0.0 }".to_owned(),
        write_effect(&face),
        write_effect(&stop("padding", 0.015, None, 0.0)),
        write_effect(&stop("mount", 0.01, Some(1e9), 2000.0)),
    ];
    assert_eq!(written(effects), expected);
}

#[test]
fn names_with_blanks_are_written_in_quotes() {
    let separation = Separation { element: "left pad".to_owned(), at: None, restitution: 0.0 };
    assert_eq!(write_effect(&separation), "separation.\"left pad\" = { restitution = 0.0 }");
}

#[test]
fn unknown_elements_and_nodes_are_told_with_the_nearest_name() {
    says(
        "[effects]\nseparation.pading = true\nstop.mounts = { at = 1 }",
        &[
            "there is no element named `pading`",
            "did you mean `padding`?",
            "there is no element named `mounts`",
            "did you mean `mount`?",
        ],
    );
    says(
        "[effects]\nseparation.padding = { at = \"haed\" }",
        &["there is no node named `haed`", "did you mean `head`?", "at = \"haed\""],
    );
    says(
        "[effects]\nseparation.padding = { at = \"ground\" }",
        &[
            "`separation.padding` is at `ground`, but `padding` is between `head` and `panel`",
            "write \"head\" or \"panel\"",
        ],
    );
}

#[test]
fn an_effect_without_an_element_is_told_how_it_is_written() {
    says(
        "[effects]\nseparation = true",
        &["`separation` is a table with the names of elements", "write `separation.mount = {}`"],
    );
    says(
        "[effects]\nseparation = { at = \"head\" }",
        &["there is no element named `at`", "write `separation.mount = { at = \"head\" }`"],
    );
    says("[separation]\npadding = true", &["[effects]: `separation.ELEMENT = {}`"]);
    says("[face]\npadding = 1", &["[effects]: `face.ELEMENT = \"10 kg\"`"]);
}

#[test]
fn values_of_effects_are_checked_at_their_places() {
    says(
        "[effects]\nseparation.padding = { restitution = 2 }",
        &["`restitution` must be from 0 to 1, but it is 2", "restitution = 2"],
    );
    says(
        "[effects]\nstop.padding = { stiffness = 1e8, restitution = 0.5 }",
        &["`restitution` must be zero beside `stiffness`"],
    );
    says("[effects]\nstop.padding = { at = \"1 s\" }", &["a length (m) is expected here"]);
    says("[effects]\nface.padding = {}", &["`face.padding` has no `mass`"]);
    says("[effects]\nface.padding = { mass = 1, toch = 1 }", &["unknown key `toch`", "`touch`"]);
    says(
        "[effects]\nface.padding = { mass = 1, touch = \"plastic\" }",
        &["`plastic` is not a value of `touch`", "impact", "moving"],
    );
    says(
        "[effects]\nseparation.padding = \"head\"",
        &["`separation.padding` is a table", "write `separation.padding = { at = \"head\" }`"],
    );
}

#[test]
fn a_share_of_the_thickness_is_told_as_a_length() {
    says(
        "[effects]\nstop.padding = { at = \"80 %\" }",
        &[
            "`80 %` is a pure number; a length (m) is expected here",
            "write \"16 mm\", which is 80 % of the thickness of `padding`",
        ],
    );
    says(
        "[effects]\nstop.mount = { at = \"80 %\" }",
        &["write a length such as \"10 mm\": `mount` has no `thickness` to take a share of"],
    );
}
