//! What errors say about slips of the pen and of the mind.

use super::{messages, on_model, read_text};
use crate::{ReadOptions, read, units::parse_quantity};

/// A scene with these entries in its tables.
fn with(nodes: &str, elements: &str, rest: &str) -> String {
    format!("{rest}\n[nodes]\n{nodes}\n[elements]\n{elements}\n[run]\nduration = \"20 ms\"\n")
}

const HEAD: &str = "head = { mass = \"1 kg\", velocity = \"1 m/s\" }";
const PAD: &str = "pad = { between = [\"head\", \"ground\"], spring = \"1 kN/m\" }";

#[track_caller]
fn has(shown: &str, parts: &[&str]) {
    for part in parts {
        assert!(shown.contains(part), "no {part:?} in\n{shown}");
    }
}

#[track_caller]
fn is_single(shown: &str) {
    assert_eq!(shown.matches("error: ").count(), 1, "{shown}");
}

#[test]
fn a_comma_before_three_digits_is_read_in_both_ways() {
    let shown = messages(&on_model("spring = \"60,000 N/m\""));
    has(
        &shown,
        &["write \"60000 N/m\" (a comma between thousands is not read) or \"60.000 N/m\" \
             (a decimal comma is written as a point)"],
    );
    let help = |value: &str| messages(&on_model(&format!("spring = \"{value}\"")));
    has(&help("60,5 N/m"), &["help: write \"60.5 N/m\"\n"].map(str::trim_end));
    has(&help("0,500 N/m"), &["help: write \"0.500 N/m\""]);
    has(&help("1,234.5 N/m"), &["help: write \"1234.5 N/m\" (a comma between"]);
    has(&help("1,000,000 N/m"), &["help: write \"1000000 N/m\" (a comma between"]);
    let named = format!("[values]\nK = \"60,000 N/m\"\n{}", on_model("spring = \"K\""));
    has(&messages(&named), &["write \"60000 N/m\"", "or \"60.000 N/m\""]);
}

#[test]
fn spaces_within_a_number_are_not_read() {
    for text in ["60 000 N/m", "60'000 N/m", "60_000 N/m", "60\u{202f}000 N/m"] {
        let shown = messages(&on_model(&format!("spring = \"{text}\"")));
        let said = format!("`{text}` has a space or a mark within the number, which is not read");
        has(&shown, &[&said, "help: write \"60000 N/m\""]);
    }
    assert!(parse_quantity("50 1/s").is_ok());
}

#[test]
fn an_unquoted_decimal_comma_is_one_error() {
    for text in [
        with("head = { mass = 5,5, velocity = 1 }", PAD, ""),
        with("head = { mass = 5,5 }", PAD, ""),
        with("[nodes.head]\nmass = 5,5 # kg\n", PAD, ""),
    ] {
        let text = text.replace("[nodes]\n[nodes", "[nodes");
        let shown = messages(&text);
        is_single(&shown);
        has(&shown, &["`5,5` has a comma: decimals are written with a point", "help: write 5.5"]);
        has(&shown, &["^^^"]);
    }
    let shown = messages(&with("head = { mass = 5,500, velocity = 1 }", PAD, ""));
    is_single(&shown);
    has(&shown, &["write 5500 (a comma between thousands is not read) or 5.500"]);
}

#[test]
fn a_pair_without_brackets_is_one_error() {
    for pad in [
        "pad = { between = \"head\", \"ground\", spring = 1 }",
        "pad = { spring = 1, between = \"head\", \"ground\" }",
    ] {
        let shown = messages(&with(HEAD, pad, ""));
        is_single(&shown);
        has(&shown, &["brackets are missing", "help: write [\"head\", \"ground\"]"]);
    }
}

#[test]
fn an_acceleration_is_no_motion() {
    let motion = |value: &str| {
        let base = format!("base = {{ motion = {{ {value} }} }}");
        messages(&with(&format!("{HEAD}\n{base}"), PAD, ""))
    };
    let expected = "help: a motion is a displacement: write `acceleration` in place of `motion`";
    has(&motion("constant = \"5 g0\""), &["a length (m) is expected here", expected]);
    has(&motion("table = [[0, 0], [\"1 ms\", \"5 m/s^2\"]]"), &[expected]);
    has(
        &motion("constant = \"3 m/s\""),
        &["a motion is a displacement: write `velocity` in place of `motion`"],
    );
    let shown = messages(&with("head = { mass = 1, drop = \"1 g0\" }", PAD, ""));
    has(&shown, &["help: for example \"2 cm\""]);
}

#[test]
fn other_units_are_read_or_offered_by_dimension() {
    let value = |text: &str| parse_quantity(text).unwrap().value;
    assert!((value("20 mph") - 8.9408).abs() < 1e-14);
    assert!((value("1 kgf") - 9.806_65).abs() < 1e-15);
    assert!((value("1 lbf") - 4.448_221_615_260_5).abs() < 1e-15);
    let velocity = |text: &str| {
        messages(&with(&format!("head = {{ mass = 1, velocity = \"{text}\" }}"), PAD, ""))
    };
    has(&velocity("20 mhp"), &["did you mean `mph`? a velocity (m/s) is expected"]);
    has(&messages(&on_model("dashpot = \"4 N.s/m\"")), &["did you mean `N s/m`?"]);
    has(&velocity("20 kmh"), &["did you mean `km/h`?"]);
    has(&velocity("20 KN"), &["did you mean `kN`?"]);
    has(&velocity("20 kMs"), &["a velocity (m/s) is expected"]);
    assert!(!velocity("20 mpp").contains("MPa"), "{}", velocity("20 mpp"));
    has(
        &messages(&with("head = { mass = 1, drop = \"3 inch\" }", PAD, "")),
        &["did you mean `in`?"],
    );
}

#[test]
fn a_wrong_value_is_traced_to_its_definition() {
    let text = |value: &str| format!("[values]\nK = \"{value}\"\n{}", on_model("spring = \"K\""));
    let shown = messages(&text("60 kN"));
    has(&shown, &["`K` is a force (N); a stiffness (N/m) is expected here"]);
    has(&shown, &["note: `K` is \"60 kN\", defined in line 2", "help: for example \"20 MN/m\""]);
    has(&messages(&text("-5 N/m")), &["note: `K` is \"-5 N/m\", defined in line 2"]);
    let chain = format!("[values]\nK = \"60 kN\"\nL = \"K\"\n{}", on_model("spring = \"L\""));
    has(&messages(&chain), &["note: `L` is \"60 kN\", defined in line 2"]);
    let set = [("K".to_owned(), "80 kN".to_owned())];
    let options = ReadOptions { set: &set, ..ReadOptions::default() };
    let shown = read(&text("60 kN/m"), &options).unwrap_err().render(false);
    has(&shown, &["note: `K` is \"80 kN\", set by `--set`"]);
    let mass = "[values]\nM = \"-2 kg\"\n";
    let shown = messages(&with("head = { mass = \"M\", velocity = 1 }", PAD, mass));
    has(&shown, &["but it is -2", "note: `M` is \"-2 kg\", defined in line 2"]);
}

#[test]
fn gravity_is_a_table_and_its_unit_is_g0_or_g() {
    let shown = messages(&with(HEAD, PAD, "[effects]\ngravity = 9.81\n"));
    has(&shown, &["`gravity` is a table, but this is a number"]);
    has(
        &shown,
        &["help: write `gravity = { value = \"9.81 m/s^2\" }`, or `gravity = {}` for 1 g0"],
    );
    let shown = messages(&with(HEAD, PAD, "[effects]\ngravity = \"1 g\"\n"));
    has(&shown, &["write `gravity = { value = \"1 g0\" }`"]);
    let gravity = |unit: &str| {
        let text = with(HEAD, PAD, &format!("[effects]\ngravity = {{ value = \"2 {unit}\" }}\n"));
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        format!("{:?}", scene.network.effects()[0].values())
    };
    assert_eq!(gravity("g"), gravity("g0"));
    let shown = messages(&with(HEAD, PAD, "[effects]\ngravity = { value = \"2 kg\" }\n"));
    has(&shown, &["`2 kg` is a mass (kg); an acceleration (m/s^2) is expected here"]);
}

#[test]
fn a_table_in_a_wrong_place_is_sent_to_its_own() {
    let shown = |rest: &str| messages(&with(HEAD, PAD, rest));
    has(&shown("[gravity]\n"), &["help: write it under [effects]: `gravity = {}`"]);
    for word in ["force", "load"] {
        let shown = shown(&format!("[{word}]\n"));
        has(&shown, &["help: write [loads.name] with `on` and `force`"]);
    }
    has(&shown("duration = 1\n"), &["help: write it under [run]"]);
    has(&shown("[spring]\n"), &["help: write [elements.name] with `between` and `spring`"]);
    has(&shown("mass = 1\n"), &["help: write [nodes.name] with `mass`"]);
    let shown = shown("[loads]\nhead = \"5 N\"\n");
    has(&shown, &["load `head` is a table, but this is a text"]);
    has(&shown, &["write [loads.name] with `on = \"head\"` and `force = { constant = \"5 N\" }`"]);
}

#[test]
fn measures_of_the_other_family_name_where_they_belong() {
    let shown = messages(&with(HEAD, PAD, "[measures]\npad = [\"hic15\"]\n"));
    has(&shown, &["`hic15` is not a measure of an element"]);
    has(&shown, &["help: `hic15` is a measure of nodes: head"]);
    let window = "[measures]\nhead = { kind = \"severity-index\", window = \"all\" }\n";
    has(
        &messages(&with(HEAD, PAD, window)),
        &["`all` is not a window", "help: write \"impact\", \"run\" for the whole run, or a pair"],
    );
}

#[test]
fn words_of_other_books_are_understood() {
    for (word, meant) in [
        ("damper", "dashpot"),
        ("damping", "dashpot"),
        ("c", "dashpot"),
        ("stiffness", "spring"),
        ("k", "spring"),
    ] {
        let shown = messages(&on_model(&format!("{word} = 1")));
        is_single(&shown);
        has(&shown, &[&format!("did you mean `{meant}`?")]);
        let form = format!("kelvin-voigt = {{ spring = 1, dashpot = 1, {word} = 1 }}");
        let form =
            form.replace(&format!(", {meant} = 1"), "").replace(&format!(" {meant} = 1,"), "");
        let shown = messages(&on_model(&form));
        is_single(&shown);
        has(&shown, &[&format!("did you mean `{meant}`?")]);
    }
}

#[test]
fn the_slips_leave_sound_texts_alone() {
    let text = with(HEAD, PAD, "title = \"a = 5,5 and = 'x', 'y'\" # b = 5,5\n");
    assert!(read_text(&text).is_ok());
    let shown = messages(&text.replace("duration", "duration = 1\nduration"));
    is_single(&shown);
    has(&shown, &["`duration` is given twice"]);
}

#[test]
fn a_size_that_is_faulty_is_not_told_as_missing() {
    let foam = "foam = { modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \"20 kPa\", \
                exponent = 3 }, thickness = \"2 cm\", area = \"A\"";
    let text = format!("[values]\nA = \"80 cm^2\"\n{}", on_model(foam));
    let set = [("A".to_owned(), "3 kg".to_owned())];
    let shown = read(&text, &ReadOptions { set: &set, ..ReadOptions::default() });
    let shown = shown.unwrap_err().render(false);
    is_single(&shown);
    has(&shown, &["`A` is a mass (kg); an area (m^2) is expected here", "set by `--set`"]);
}

#[test]
fn each_part_of_a_series_has_a_size_of_its_own() {
    let eps =
        "modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \"20 kPa\", exponent = 3";
    let size = "thickness = \"2 cm\", area = \"100 cm^2\"";
    let help =
        "help: each part of a `series` has a thickness and an area of its own, beside its law";
    let shown = messages(&on_model(&format!("series = [{{ foam = {{ {eps} }} }}], {size}")));
    has(&shown, &["`foam` has no `thickness`", help, "for example `thickness = \"2 cm\"`"]);
    let eps = format!("[materials]\neps = {{ foam = {{ {eps} }} }}\n");
    let shown = messages(&format!(
        "{eps}{}",
        on_model(&format!("series = [{{ material = \"eps\", thickness = \"2 cm\" }}], {size}"))
    ));
    is_single(&shown);
    has(&shown, &["this branch has no `area`", help]);
}

#[test]
fn a_unit_that_is_not_read_is_told_with_its_factor() {
    let material = |value: &str| {
        let eps = format!("[materials]\neps = {{ spring = \"{value}\" }}\n");
        let pad = "material = \"eps\", thickness = \"2 cm\", area = \"100 cm^2\"";
        messages(&format!("{eps}{}", on_model(pad)))
    };
    has(&material("7 bar"), &["`bar` is not a known unit", "help: 1 bar is 100 kPa"]);
    has(&material("30 psi"), &["help: 1 psi is 6.894757 kPa: write it in that"]);
    let named = format!("[values]\nE = \"7 bar\"\n{}", on_model("spring = \"E\""));
    has(&messages(&named), &["help: 1 bar is 100 kPa: write it in that"]);
    // Where a pressure is out of place, its unit is not what is wrong.
    has(&messages(&on_model("spring = \"7 bar\"")), &["help: a stiffness (N/m) is expected"]);
}

#[test]
fn paths_are_set_in_the_text_and_those_that_lead_nowhere_are_told() {
    let text = "[values]\nK = \"1 kN/m\"\n[materials]\nsoft = { spring = \"1 MPa\" }\nfirm = { spring = \"4 MPa\" }\n\
        [nodes]\nhead = { mass = \"5 kg\", velocity = \"1 m/s\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], material = \"soft\", thickness = \"1 cm\", area = \"10 cm^2\" }\n\
        mat = { between = [\"head\", \"ground\"], spring = \"K\", thickness = \"3 cm\" }\n[run]\nduration = \"9 ms\"\n";
    let read_with = |set: &[(&str, &str)]| {
        let set: Vec<(String, String)> =
            set.iter().map(|own| (own.0.to_owned(), own.1.to_owned())).collect();
        read(text, &ReadOptions { set: &set, ..ReadOptions::default() })
            .map(|checked| checked.value)
            .map_err(|faults| faults.render(false))
    };
    let own = read_with(&[
        ("head.mass", "1 kg"),
        ("pad.material", "firm"),
        ("K", "2 kN/m"),
        ("head.mass", "2 * 3 kg"),
    ])
    .unwrap();
    let head = own.network.nodes().find(|node| node.1.name == "head").unwrap().1;
    assert!((head.mass - 6.0).abs() < 1e-12 && (own.values[0].value - 2e3).abs() < 1e-9);
    assert!(own.text.contains("mass = \"2 * 3 kg\"") && own.text.contains("material = \"firm\""));
    let told = |name: &str, value: &str| read_with(&[(name, value)]).unwrap_err();
    has(&told("pad.materal", "firm"), &["--set:1:1", "did you mean `pad.material`?"]);
    has(&told("elements.thickness", "1 cm"), &["may be `pad.thickness` or `mat.thickness`"]);
    has(&told("velocty", "1 m/s"), &["no value named `velocty`"]);
    has(&told("head.mass", "6 m"), &["scene, as set:", "`6 m` is a length"]);
}

#[test]
fn what_has_no_place_stands_in_line_with_its_help() {
    let text = with(HEAD, PAD, "").replace("[run]\nduration = \"20 ms\"\n", "");
    let shown = messages(&text);
    has(&shown, &["has no [run]\n  --> scene.toml\n   = help: for example:"]);
}

#[test]
fn an_energy_is_the_speed_that_makes_it() {
    let of = |node: &str| with(&format!("head = {{ {node} }}\n"), PAD, "");
    let network = |node: &str| {
        let scene = read(&of(node), &ReadOptions::default()).unwrap().value;
        format!("{:?}", scene.network.nodes().collect::<Vec<_>>())
    };
    // V = √(2 · 50 J / 4 kg) = 5 m/s.
    let by_speed = network("mass = \"4 kg\", velocity = \"5 m/s\"");
    assert_eq!(network("mass = \"4 kg\", energy = \"50 J\""), by_speed);
    has(&messages(&of("energy = \"50 J\"")), &["node `head` with `energy` has no `mass`"]);
    let shown = messages(&of("mass = 4, energy = 50, drop = 1"));
    has(&shown, &["`drop` and `energy` exclude each other"]);
    has(&messages(&of("mass = 4, energy = -1")), &["`energy` must be zero or positive"]);
}

#[test]
fn a_limit_with_a_sign_is_told_its_key() {
    let told = messages(&format!("{}[limits]\nhead.hic15 = \"< 1000\"\n", on_model("spring = 1")));
    assert!(told.contains("`< 1000` has a sign, which the key says here"), "{told}");
    assert!(told.contains("write { max = \"1000\" }"), "{told}");
}

#[test]
fn a_level_of_an_index_is_a_number() {
    let scene = |level: &str| format!("{}[limits]\nhead.hic15 = {level}\n", on_model("spring = 1"));
    for (level, fault) in [
        ("\"10 g\"", "`10 g` is an acceleration (m/s^2); a pure number is expected here"),
        ("{ max = \"700 mm\" }", "`700 mm` is a length (m); a pure number is expected here"),
        ("\"700 gg\"", "gg"),
    ] {
        let told = messages(&scene(level));
        has(&told, &[fault, "help: an index is written without a unit, for example `700`"]);
        assert!(!told.contains("ms\""), "{told}");
    }
    assert!(read_text(&scene("700")).is_ok());
    let told = crate::parse_limits("head.hic15<=10 g").unwrap_err();
    assert!(told.ends_with("an index is written without a unit, for example `700`"), "{told}");
}

#[test]
fn a_body_without_a_shape_is_told_the_keys_of_each() {
    for keys in ["{ radius = \"5 cm\" }", "{ sphere = \"5 cm\" }", "{}"] {
        let text = format!(
            "[nodes]\nhead = {{ mass = 5, velocity = \"4 m/s\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], thickness = \"3 cm\", pressed-by = {keys}, spring = \"1 MPa\" }}\n\
             [run]\nduration = \"8 ms\"\n"
        );
        let shown = read_text(&text).unwrap_err().render(false);
        let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains("`pressed-by` has no `shape`"), "{shown}");
        for part in ["radius = \"50 mm\"", "cylinder", "`length`", "flat", "pad-radius"] {
            assert!(shown.contains(part), "{keys}: {part}: {shown}");
        }
    }
}
