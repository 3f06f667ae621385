//! `dashpot compare`.

use serde_json::Value;

use super::{Desk, SCENE, ends};

/// The JSON answer; the exit code must say the same.
#[track_caller]
fn compared(first: &str, second: &str, more: &[&str]) -> Value {
    let arguments = [&["compare", first, second, "--json"], more].concat();
    let output = crate::cli::run(&arguments);
    let answer: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{arguments:?}: {}", crate::cli::err(&output)));
    let expected = if answer["same"].as_bool().unwrap() { 0 } else { 3 };
    assert_eq!(crate::cli::code(&output), expected, "{arguments:?}");
    answer
}

#[track_caller]
fn assert_same(first: &str, second: &str) {
    let answer = compared(first, second, &[]);
    assert_eq!(answer["same"], true, "{first} and {second}: {answer:#}");
}

#[track_caller]
fn assert_not_same(first: &str, second: &str) {
    let answer = compared(first, second, &[]);
    assert_eq!(answer["same"], false, "{first} and {second}: {answer:#}");
}

/// The thesis' pad in halves, 1 to 3, with a dashpot across.
const BRIDGE: &str = r#"
[nodes]
top = {}
left = {}
right = {}
[elements]
a1 = { between = ["top", "left"], maxwell = { spring = "5 MN/m", dashpot = "1.5 kN s/m" } }
a2 = { between = ["left", "ground"], kelvin = { spring = "5 MN/m", dashpot = "1 kN s/m" } }
b1 = { between = ["top", "right"], maxwell = { spring = "15 MN/m", dashpot = "4.5 kN s/m" } }
b2 = { between = ["right", "ground"], kelvin = { spring = "15 MN/m", dashpot = "3 kN s/m" } }
across = { between = ["left", "right"], dashpot = "70 N s/m" }
"#;

#[test]
fn a_tree_its_forms_and_a_bridge_are_the_same_pairwise() {
    let desk = Desk::with(&[("scene.toml", SCENE), ("bridge.toml", BRIDGE)]);
    let tree = desk.word("scene.toml:valox-pad");
    let [maxwell, kelvin] = ["generalized-maxwell", "generalized-kelvin"].map(|form| {
        let path = desk.word(&format!("{form}.toml"));
        ends(&["convert", &tree, "--to", form, "--out", &path], 0);
        path + ":valox-pad"
    });
    let bridge = desk.word("bridge.toml:top,ground");
    let all = [&tree, &maxwell, &kelvin, &bridge, &"reference:padding".to_owned()];
    for (at, first) in all.iter().enumerate() {
        for second in &all[..at] {
            assert_same(first, second);
        }
    }
    let said = ends(&["compare", &tree, &bridge], 0).0;
    assert!(said.starts_with("The same: ") && said.contains("a zero cancels a pole"), "{said}");
    let answer = compared(&tree, &maxwell, &["--impact", "reference:padding"]);
    // One for one: four parameters from four.
    let map = &answer["map"];
    assert_eq!(map["relative"].as_array().unwrap().len(), 4);
    let condition = map["condition"].as_f64().unwrap();
    assert!((1.0..100.0).contains(&condition), "{condition}");
    // Stiffnesses and dampings of a form all have the same unit, so what scales all of the first
    // by one percent does so to all of the second.
    for row in map["relative"].as_array().unwrap() {
        let sum: f64 = row.as_array().unwrap().iter().map(|own| own.as_f64().unwrap()).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{row}");
    }
    let measures = answer["impact"]["measures"].as_array().unwrap();
    assert!(measures.len() >= 8);
    for measure in measures {
        assert!(measure["difference"].as_f64().unwrap() < 1e-10, "{measure}");
    }
    let answer = compared(&bridge, &kelvin, &["--impact", "reference:padding"]);
    for own in answer["impact"]["measures"].as_array().unwrap() {
        assert!(own["difference"].as_f64().unwrap() < 1e-10, "{own}");
    }
}

#[test]
fn constants_are_listed_in_the_units_that_they_have() {
    let answer = compared("reference:padding", "reference-stiff:padding", &[]);
    let constants = |at: usize| answer["forms"][at]["constants"].as_array().unwrap().clone();
    let value = |value: &Value| value["value"][0].as_f64().unwrap();
    let find = |at: usize, part: &str| {
        constants(at)
            .into_iter()
            .find(|constant| constant["part"] == part)
            .unwrap_or_else(|| panic!("{part}"))
    };
    // The Kelvin form is the pad itself.
    for (part, expected, unit) in
        [("spring", 2e7, "N/m"), ("dashpot", 6e3, "N s/m"), ("kelvin-1", 2e7, "N/m")]
    {
        let found = find(1, part);
        assert_eq!(found["unit"], unit);
        assert!((value(&found) / expected - 1.0).abs() < 1e-12, "{found}");
    }
    // A.1 and A.2: K3 + K4 = K2.
    let sum: f64 = constants(0).iter().map(value).sum();
    assert!((sum / 2e7 - 1.0).abs() < 1e-12, "{sum}");
}

/// The thesis' pad beside a Maxwell element that relaxes over 11 days.
fn slow(spring: f64, dashpot: f64) -> String {
    format!(
        "[models.pad]\nparallel = [{{ burgers = {{ maxwell = {{ spring = 2e7, dashpot = 6e3 }}, \
         kelvin = {{ spring = 2e7, dashpot = 4e3 }} }} }}, \
         {{ maxwell = {{ spring = {spring:e}, dashpot = {dashpot:e} }} }}]\n"
    )
}

#[test]
fn a_billionth_in_a_mode_that_the_impact_does_not_see_is_told() {
    let desk = Desk::with(&[
        ("one.toml", &slow(10.0, 1e7)),
        ("time.toml", &slow(10.0, 1e7 * (1.0 + 1e-9))),
        ("strength.toml", &slow(10.0 * (1.0 + 1e-9), 1e7 * (1.0 + 1e-9))),
    ]);
    for other in ["time.toml", "strength.toml"] {
        let words = [desk.word("one.toml"), desk.word(other)];
        let answer = compared(&words[0], &words[1], &["--impact", "reference:padding"]);
        assert_eq!(answer["same"], false, "{answer:#}");
        let worst = &answer["worst"];
        assert!(worst["frequency"].as_f64().unwrap() < 1e-3, "{worst}");
        assert!(worst["response"].as_f64().unwrap() > 1e-12, "{worst}");
        for own in answer["impact"]["measures"].as_array().unwrap() {
            let [a, b] = [0, 1].map(|at| own["value"][at].as_f64().unwrap());
            let errors: f64 = (0..2).map(|at| own["error"][at].as_f64().unwrap()).sum();
            assert!((a - b).abs() <= errors && errors < 1e-11 * a.abs(), "{own}");
        }
        let said = ends(&["compare", &words[0], &words[1]], 3).0;
        assert!(said.starts_with("Not the same: "), "{said}");
    }
}

const ODDS: &str = r#"
[models.twice]
parallel = [{ maxwell = { spring = "1 MN/m", dashpot = "2 kN s/m" } }, { maxwell = { spring = "3 MN/m", dashpot = "6 kN s/m" } }]
[models.once]
maxwell = { spring = "4 MN/m", dashpot = "8 kN s/m" }
[models.hard]
spring = "1e30 N/m"
[models.fixed]
rigid = true
[models.soft]
spring = "2 MN/m"
[materials.foam]
maxwell = { spring = "4 MPa", dashpot = "8 kPa s" }
[nodes]
top = {}
left = {}
right = {}
[elements]
a = { between = ["top", "left"], spring = "1 MN/m" }
b = { between = ["left", "ground"], spring = "3 MN/m" }
c = { between = ["top", "right"], spring = "1.6666666666666667 MN/m" }
d = { between = ["right", "ground"], spring = "5 MN/m" }
across = { between = ["left", "right"], dashpot = "5 kN s/m" }
"#;

#[test]
fn poles_that_cancel_are_listed_and_do_not_count() {
    let desk = Desk::with(&[("odds.toml", ODDS)]);
    let [twice, once, bridge, soft] =
        ["twice", "once", "top,ground", "soft"].map(|name| desk.word(&format!("odds.toml:{name}")));
    let answer = compared(&twice, &once, &[]);
    assert_eq!(answer["same"], true);
    let cancelled = &answer["models"][0]["cancelled"][0];
    // C/K = 2 ms.
    assert!((cancelled["pole"][0].as_f64().unwrap() / -500.0 - 1.0).abs() < 1e-12, "{cancelled}");
    assert_eq!(cancelled["count"], 1);
    assert_eq!(answer["models"][1]["cancelled"].as_array().unwrap().len(), 0);
    // Two springs of 3/4 and 5/4 MN/m side by side.
    let answer = compared(&bridge, &soft, &[]);
    assert_eq!(answer["same"], true, "{answer:#}");
    assert_eq!(answer["models"][0]["least_elements"], 1);
    assert_eq!(answer["models"][0]["cancelled"].as_array().unwrap().len(), 1);
}

#[test]
fn a_rigid_link_is_no_spring_however_stiff() {
    let desk = Desk::with(&[("odds.toml", ODDS)]);
    let [hard, fixed] = ["hard", "fixed"].map(|name| desk.word(&format!("odds.toml:{name}")));
    assert_not_same(&hard, &fixed);
    assert_same(&fixed, &fixed);
}

#[test]
fn a_material_and_a_pad_cannot_be_compared() {
    let desk = Desk::with(&[("odds.toml", ODDS)]);
    let [foam, pad] = ["foam", "once"].map(|name| desk.word(&format!("odds.toml:{name}")));
    let (shown, said) = ends(&["compare", &foam, &pad], 2);
    assert!(shown.is_empty() && said.contains("a material, in Pa"), "{said}");
    assert_same(&foam, &foam);
    let (_, said) = ends(&["compare", &foam, &foam, "--impact", "reference:padding"], 2);
    assert!(said.contains("the impact needs a pad with thickness and area"), "{said}");
}

/// The reference impact the other way round, its springs and its panel in pieces.
fn in_pieces(k1: f64) -> String {
    format!(
        "[nodes]\none = {{}}\nhalf = {{}}\nhead = {{ mass = 10 }}\npanel = {{ mass = 75 }}\n\
         rest = {{ mass = 25 }}\n[elements]\n\
         k3a = {{ between = [\"ground\", \"panel\"], spring = 2.5e7 }}\n\
         k3b = {{ between = [\"rest\", \"ground\"], spring = 2.5e7 }}\n\
         c3 = {{ between = [\"rest\", \"ground\"], dashpot = 1e4 }}\n\
         weld = {{ between = [\"rest\", \"panel\"], rigid = true }}\n\
         k1 = {{ between = [\"panel\", \"one\"], spring = {k1:e} }}\n\
         c1 = {{ between = [\"one\", \"panel\"], dashpot = 4e3 }}\n\
         c2 = {{ between = [\"one\", \"half\"], dashpot = 6e3 }}\n\
         k2 = {{ between = [\"half\", \"head\"], series = [{{ spring = 4e7 }}, {{ spring = 4e7 }}] }}\n"
    )
}

#[test]
fn networks_with_masses_are_compared_at_nodes() {
    let desk = Desk::with(&[
        ("pieces.toml", &in_pieces(2e7)),
        ("other.toml", &in_pieces(2e7 * (1.0 + 1e-9))),
    ]);
    for nodes in ["head,ground", "head,panel", "panel,ground"] {
        let [pieces, other] =
            ["pieces.toml", "other.toml"].map(|name| desk.word(&format!("{name}:{nodes}")));
        let reference = format!("reference:{nodes}");
        let answer = compared(&reference, &pieces, &[]);
        assert_eq!(answer["same"], true, "{nodes}: {answer:#}");
        // Decimal numbers with units are rounded on their way; all halves are exact.
        assert!(answer["largest_difference"].as_f64().unwrap() < 1e-14, "{answer:#}");
        let answer = compared(&reference, &other, &[]);
        assert_eq!(answer["same"], false, "{nodes}");
        let size = answer["worst"]["response"].as_f64().unwrap();
        assert!(size > 1e-12 && size < 1e-7, "{nodes}: {size:e}");
        assert!(answer["worst"]["frequency"].as_f64().is_some(), "{answer:#}");
    }
}

#[test]
fn a_mass_that_moves_is_no_spring() {
    let desk = Desk::with(&[("odds.toml", ODDS)]);
    assert_not_same("reference:head,ground", &desk.word("odds.toml:soft"));
    assert_not_same(&desk.word("odds.toml:top,ground"), "reference:head,ground");
}

#[test]
fn what_is_misspelt_is_told() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    for (word, expected) in [
        ("scene.toml:valox-pda", "did you mean `valox-pad`?"),
        ("scene.toml:haed,ground", "the nodes are ground, head, panel"),
        ("scene.toml", "name one of: foam, mount, padding, valox-pad"),
        ("scen.toml:padding", "there is no such file"),
    ] {
        let (shown, said) = ends(&["compare", &desk.word(word), "reference:padding"], 2);
        assert!(shown.is_empty() && said.contains(expected), "{word}: {said}");
        let (shown, said) = ends(&["compare", "reference:padding", &desk.word(word)], 2);
        assert!(shown.is_empty() && said.contains(expected), "{word}: {said}");
    }
    let own = "reference:padding";
    let (_, said) = ends(&["compare", own, own, "--impact", "reference:pading"], 2);
    assert!(
        said.contains("there is no element `pading`; the elements are padding, mount"),
        "{said}"
    );
    let (_, said) = ends(&["compare", "reference:head,loose", own], 2);
    assert!(said.contains("there is no node `loose`"), "{said}");
}

#[test]
fn values_set_from_outside_hold_for_both() {
    let other = SCENE.replace("K = \"20 MN/m\"", "K = \"21 MN/m\"");
    let desk = Desk::with(&[("scene.toml", SCENE), ("other.toml", &other)]);
    let [own, other] = ["scene.toml:valox-pad", "other.toml:padding"].map(|word| desk.word(word));
    let answer = compared(&own, &other, &[]);
    assert_eq!(answer["same"], false);
    // 1 in 21 of the spring that is there at once, and no more at any frequency.
    let size = answer["worst"]["response"].as_f64().unwrap();
    assert!((size * 21.0 - 1.0).abs() < 1e-6, "{size:e}");
    assert_eq!(compared(&own, &other, &["--set", "K = 25 MN/m"])["same"], true);
}

#[test]
fn the_worst_place_is_said_in_words_where_it_is_a_limit() {
    let own = "[models.pad]\nmaxwell = { spring = \"10 MN/m\", dashpot = \"6 kN s/m\" }\n";
    let other = own.replace("10 MN/m", "20 MN/m");
    let desk = Desk::with(&[("own.toml", own), ("other.toml", &other)]);
    let said = ends(&["compare", &desk.word("own.toml"), &desk.word("other.toml")], 3).0;
    let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("differ most at ever higher frequencies, by 50 %"), "{said}");
    assert!(flat.contains("in creep most at once, by 50 %"), "{said}");
}
