//! The words of the main errors, in full.

use dashpot_dae::methods::METHODS;

use super::{messages, on_model, read_text};
use crate::{kinds::model_words, text::nearest::list};

const FAULTS_OF_THE_TEXT: &str = r#"titel = "Head on a pad"

[values]
K = "20 NM/m"

[models.pad]
series = [
  { spring = "20 kN s/m" },
  { dashpot = "6,5 kN s/m" },
  { sprnig = "K2" },
  { kelvin = { spring = "K2" } },
  { spring = 1, dashpot = 2 },
]

[models.a]
parallel = [{ spring = 1 }, { model = "b" }]

[models.b]
series = [{ dashpot = 1 }, { model = "a" }]

[nodes]
head = { mass = 10 kg, velocity = nan }
head = { mass = "12 kg" }
panel = { mass = [100], drop = "-1.5 m" }
base = { motion = { sine = { amplitude = "2 mm", frequency = "50 rad/s" } } }

[elements]
padding = { between = ["haed", "panel"], model = "pda", thickness = "2 s" }
mount = { spring = "1e400 N/m" }

[run]
duration = "-20 ms"
methods = ["exat"]
"#;

const FAULTS_OF_THE_TEXT_SHOWN: &str = r#"
error: unknown key `titel` in the scene
 --> scene.toml:1:1
  |
1 | titel = "Head on a pad"
  | ^^^^^
  |
  = help: did you mean `title`? known keys: title, values, models, materials, nodes, elements, effects, loads, measures, limits, accuracy, run, fit, design, scatter

error: `NM` is not a known unit
 --> scene.toml:4:5
  |
4 | K = "20 NM/m"
  |     ^^^^^^^^^
  |
  = help: did you mean `MN`?

error: `20 kN s/m` is a damping (N s/m); a stiffness (N/m) is expected here
 --> scene.toml:8:14
  |
8 |   { spring = "20 kN s/m" },
  |              ^^^^^^^^^^^
  |
  = help: for example "20 MN/m"

error: `6,5 kN s/m` has a comma: decimals are written with a point
 --> scene.toml:9:15
  |
9 |   { dashpot = "6,5 kN s/m" },
  |               ^^^^^^^^^^^^
  |
  = help: write "6.5 kN s/m"

error: unknown key `sprnig` in this branch
  --> scene.toml:10:5
   |
10 |   { sprnig = "K2" },
   |     ^^^^^^
   |
   = help: did you mean `spring`? known keys: LAWS

error: `kelvin` has no `dashpot`
  --> scene.toml:11:5
   |
11 |   { kelvin = { spring = "K2" } },
   |     ^^^^^^
   |
   = help: for example `dashpot = "6 kN s/m"`

error: there is no value named `K2`
  --> scene.toml:11:25
   |
11 |   { kelvin = { spring = "K2" } },
   |                         ^^^^
   |
   = help: known values: K

error: this branch has several laws (spring, dashpot) and does not say how they are composed
  --> scene.toml:12:17
   |
12 |   { spring = 1, dashpot = 2 },
   |                 ^^^^^^^
   |
   = help: for example `parallel = [{ spring = … }, { dashpot = … }]`

error: the model `a` contains itself (a → b → a)
  --> scene.toml:19:38
   |
19 | series = [{ dashpot = 1 }, { model = "a" }]
   |                                      ^^^

error: text and quantities with units are written in quotes
  --> scene.toml:22:17
   |
22 | head = { mass = 10 kg, velocity = nan }
   |                 ^^^^^
   |
   = help: write "10 kg"

error: `nan` is not finite: every quantity is a finite number
  --> scene.toml:22:35
   |
22 | head = { mass = 10 kg, velocity = nan }
   |                                   ^^^
   |
   = help: a velocity (m/s) is expected, for example "10 m/s"

error: `head` is given twice
  --> scene.toml:23:1
   |
23 | head = { mass = "12 kg" }
   | ^^^^ second one
   |
   = help: names and keys are unique within their table; remove or rename one

error: a mass (kg) is expected here, but this is a list of 1 entry
  --> scene.toml:24:18
   |
24 | panel = { mass = [100], drop = "-1.5 m" }
   |                  ^^^^^
   |
   = help: for example "10 kg"

error: `drop` must be zero or positive, and finite, but it is -1.5
  --> scene.toml:24:32
   |
24 | panel = { mass = [100], drop = "-1.5 m" }
   |                                ^^^^^^^^

error: `50 rad/s` is an angular frequency; a frequency (Hz) is expected here
  --> scene.toml:25:62
   |
25 | base = { motion = { sine = { amplitude = "2 mm", frequency = "50 rad/s" } } }
   |                                                              ^^^^^^^^^^ in radians
   |
   = help: divide by 2 pi: "7.957747 Hz"

error: there is no node named `haed`
  --> scene.toml:28:24
   |
28 | padding = { between = ["haed", "panel"], model = "pda", thickness = "2 s" }
   |                        ^^^^^^
   |
   = help: did you mean `head`? known nodes: base, ground, head, panel

error: there is no model named `pda`
  --> scene.toml:28:50
   |
28 | padding = { between = ["haed", "panel"], model = "pda", thickness = "2 s" }
   |                                                  ^^^^^
   |
   = help: did you mean `pad`? known models: a, b, pad

error: `2 s` is a time (s); a length (m) is expected here
  --> scene.toml:28:69
   |
28 | padding = { between = ["haed", "panel"], model = "pda", thickness = "2 s" }
   |                                                                     ^^^^^
   |
   = help: for example "2 cm"

error: element `mount` has no `between`
  --> scene.toml:29:1
   |
29 | mount = { spring = "1e400 N/m" }
   | ^^^^^
   |
   = help: for example `between = ["head", "ground"]`

error: `1e400 N/m` is too large: it does not fit into double precision
  --> scene.toml:29:20
   |
29 | mount = { spring = "1e400 N/m" }
   |                    ^^^^^^^^^^^
   |
   = help: a stiffness (N/m) is expected, for example "20 MN/m"

error: `duration` must be zero or positive, and finite, but it is -0.02
  --> scene.toml:32:12
   |
32 | duration = "-20 ms"
   |            ^^^^^^^^

error: `exat` is not a method
  --> scene.toml:33:12
   |
33 | methods = ["exat"]
   |            ^^^^^^
   |
   = help: did you mean `exact`? known words: METHODS
"#;

#[test]
fn faults_of_the_text_come_all_at_once() {
    // The registers grow.
    let laws =
        [&["name", "shift", "thickness", "area", "pressed-by", "loaded"], &*model_words()].concat();
    let methods: Vec<&str> = METHODS.iter().map(|own| own.name).collect();
    let shown = FAULTS_OF_THE_TEXT_SHOWN.replace("LAWS", &list(&laws));
    let shown = shown.replace("METHODS", &methods.join(", "));
    assert_eq!(messages(FAULTS_OF_THE_TEXT), shown.trim_matches('\n'));
}

const FAULTS_OF_MATERIALS: &str = r#"[materials.foam]
parallel = [{ spring = "20 kN/m" }, { model = "pad" }, { dashpot = "-3 Pa s" }, { material = "foma" }]

[materials.wax]
material = "foam"
thickness = "2 cm"

[models.pad]
series = [{ spring = "2 MPa" }, { kelvin-chain = [["1 ms", "2 1/MPa"]] }]
shift = { wfl = { temperature = "0 degC", reference = "20 degC" } }

[elements]
one = { between = ["head", "ground"], material = "foam", thickness = "2 cm" }
two = { between = ["head", "ground"], material = "pad", thickness = "0 cm", area = "1 cm" }
three = { between = ["head", "ground"], model = "foam", area = "1 cm^2" }
four = { between = ["head", "ground"], spring = 1, shift = { wlf = { temperature = -10, reference = "20 degC", c2 = "50 degC" } } }
five = { between = ["head", "ground"], dashpot = 1, shift = "wlf" }

[nodes]
head = { mass = 1, velocity = 1 }

[run]
duration = 1
"#;

const FAULTS_OF_MATERIALS_SHOWN: &str = r#"
error: `20 kN/m` is a stiffness (N/m); a pressure (Pa) is expected here
 --> scene.toml:2:24
  |
2 | parallel = [{ spring = "20 kN/m" }, { model = "pad" }, { dashpot = "-3 Pa s" }, { material = "foma" }]
  |                        ^^^^^^^^^
  |
  = help: values in N/m belong in [models]; for a material, multiply them by thickness / area of the specimen

error: `model` cannot stand in a material: models are in N/m, materials in Pa
 --> scene.toml:2:39
  |
2 | parallel = [{ spring = "20 kN/m" }, { model = "pad" }, { dashpot = "-3 Pa s" }, { material = "foma" }]
  |                                       ^^^^^
  |
  = help: write `material = "…"` for another material; to join both, compose them in [models] with `{ material = "…", thickness = "2 cm", area = "100 cm^2" }`

error: `dashpot` must be zero or positive, and finite, but it is -3
 --> scene.toml:2:68
  |
2 | parallel = [{ spring = "20 kN/m" }, { model = "pad" }, { dashpot = "-3 Pa s" }, { material = "foma" }]
  |                                                                    ^^^^^^^^^

error: there is no material named `foma`
 --> scene.toml:2:94
  |
2 | parallel = [{ spring = "20 kN/m" }, { model = "pad" }, { dashpot = "-3 Pa s" }, { material = "foma" }]
  |                                                                                              ^^^^^^
  |
  = help: did you mean `foam`? known materials: foam, wax

error: a material has no `thickness`; the pads that are made of it have one
 --> scene.toml:6:1
  |
6 | thickness = "2 cm"
  | ^^^^^^^^^
  |
  = help: leave `thickness` out here, and write it beside `material = "…"` in [models] or [elements]

error: `2 MPa` is a pressure (Pa); a stiffness (N/m) is expected here
 --> scene.toml:9:22
  |
9 | series = [{ spring = "2 MPa" }, { kelvin-chain = [["1 ms", "2 1/MPa"]] }]
  |                      ^^^^^^^
  |
  = help: stresses and strains belong in [materials]; a pad is made of one by `material = "…", thickness = "2 cm", area = "100 cm^2"`

error: `2 1/MPa` is a compliance of a material (1/Pa); a compliance (m/N) is expected here
 --> scene.toml:9:60
  |
9 | series = [{ spring = "2 MPa" }, { kelvin-chain = [["1 ms", "2 1/MPa"]] }]
  |                                                            ^^^^^^^^^
  |
  = help: stresses and strains belong in [materials]; a pad is made of one by `material = "…", thickness = "2 cm", area = "100 cm^2"`

error: unknown key `wfl` in `shift`
  --> scene.toml:10:11
   |
10 | shift = { wfl = { temperature = "0 degC", reference = "20 degC" } }
   |           ^^^
   |
   = help: did you mean `wlf`? known keys: wlf, arrhenius

error: element `one` has no `area`
  --> scene.toml:13:1
   |
13 | one = { between = ["head", "ground"], material = "foam", thickness = "2 cm" }
   | ^^^
   |
   = help: a material becomes a pad by its thickness and area, for example `area = "100 cm^2"`

error: there is no material named `pad`
  --> scene.toml:14:50
   |
14 | two = { between = ["head", "ground"], material = "pad", thickness = "0 cm", area = "1 cm" }
   |                                                  ^^^^^
   |
   = help: `pad` is a model: write `model = "pad"`

error: `thickness` must be positive and finite, but it is 0
  --> scene.toml:14:69
   |
14 | two = { between = ["head", "ground"], material = "pad", thickness = "0 cm", area = "1 cm" }
   |                                                                     ^^^^^^

error: `1 cm` is a length (m); an area (m^2) is expected here
  --> scene.toml:14:84
   |
14 | two = { between = ["head", "ground"], material = "pad", thickness = "0 cm", area = "1 cm" }
   |                                                                                    ^^^^^^
   |
   = help: for example "100 cm^2"

error: there is no model named `foam`
  --> scene.toml:15:49
   |
15 | three = { between = ["head", "ground"], model = "foam", area = "1 cm^2" }
   |                                                 ^^^^^^
   |
   = help: `foam` is a material: write `material = "foam"` with the `thickness` and the `area` of the pad

error: `50 degC` is a temperature; a difference of temperatures (K) is expected here
  --> scene.toml:16:117
   |
16 | four = { between = ["head", "ground"], spring = 1, shift = { wlf = { temperature = -10, reference = "20 degC", c2 = "50 degC" } } }
   |                                                                                                                     ^^^^^^^^^
   |
   = help: write the same number with `K`: a difference of 1 degree Celsius is 1 K

error: `shift` is a table with one kind of shift, for example `{ wlf = { temperature = "20 degC", reference = "20 degC" } }`, but this is a text
  --> scene.toml:17:61
   |
17 | five = { between = ["head", "ground"], dashpot = 1, shift = "wlf" }
   |                                                             ^^^^^

warning: `temperature` is -10 K, which is very little
  --> scene.toml:16:84
   |
16 | four = { between = ["head", "ground"], spring = 1, shift = { wlf = { temperature = -10, reference = "20 degC", c2 = "50 degC" } } }
   |                                                                                    ^^^
   |
   = help: a bare number is in K; write it with its unit: "-10 degC"
"#;

#[test]
fn faults_of_materials_name_both_units_and_the_way_out() {
    assert_eq!(messages(FAULTS_OF_MATERIALS), FAULTS_OF_MATERIALS_SHOWN.trim_matches('\n'));
}

#[test]
fn a_pad_beyond_double_precision_is_refused() {
    let text = |size: &str| {
        format!(
            "[materials.foam]\nmaxwell = {{ spring = 2e6, dashpot = 1e3 }}\n{}",
            on_model(&format!("material = \"foam\", {size}"))
        )
    };
    let told = "fits into double precision for a pad of this size, but it is 2000000";
    for size in ["thickness = \"1e-200 m\", area = 1e200", "thickness = 1e160, area = 1e-160"] {
        let shown = messages(&text(size));
        assert!(shown.contains(told) && shown.contains("spring = 2e6"), "{shown}");
    }
    assert!(read_text(&text("thickness = 1, area = 1")).is_ok());
}

const FAULTS_OF_THE_NETWORK: &str = r#"[nodes]
head = { mass = "10 kg", velocity = "10 m/s" }
lost = {}

[elements]
padding = { between = ["head", "head"], spring = "20 MN/m" }

[run]
duration = "20 ms"
"#;

const FAULTS_OF_THE_NETWORK_SHOWN: &str = r#"
error: `lost` has no mass and no element holds it: its motion is undetermined
 --> scene.toml:3:1
  |
3 | lost = {}
  | ^^^^

error: both ends of `padding` are at `head`
 --> scene.toml:6:23
  |
6 | padding = { between = ["head", "head"], spring = "20 MN/m" }
  |                       ^^^^^^^^^^^^^^^^
"#;

#[test]
fn faults_of_the_network_point_at_its_parts() {
    assert_eq!(messages(FAULTS_OF_THE_NETWORK), FAULTS_OF_THE_NETWORK_SHOWN.trim_matches('\n'));
}

const FAULTS_OF_THE_BALANCE: &str = r#"[nodes]
head = { mass = "10 kg" }
panel = { mass = "1 kg" }

[elements]
padding = { between = ["panel", "head"], dashpot = "2 kN s/m" }

[effects]
gravity = true

[run]
duration = "20 ms"
"#;

const FAULTS_OF_THE_BALANCE_SHOWN: &str = r#"
error: `head` cannot start in balance: no spring carries the load to a fixed or prescribed node; choose `start = "unloaded"`
 --> scene.toml:2:1
  |
2 | head = { mass = "10 kg" }
  | ^^^^

error: `panel` cannot start in balance: no spring carries the load to a fixed or prescribed node; choose `start = "unloaded"`
 --> scene.toml:3:1
  |
3 | panel = { mass = "1 kg" }
  | ^^^^^
"#;

#[test]
fn a_load_without_balance_is_refused_by_name() {
    assert_eq!(messages(FAULTS_OF_THE_BALANCE), FAULTS_OF_THE_BALANCE_SHOWN.trim_matches('\n'));
}

#[test]
fn an_empty_scene_is_told_how_to_begin() {
    let shown = messages(" \n");
    assert!(shown.starts_with("error: the scene is empty"), "{shown}");
    assert!(shown.contains("`dashpot new` writes a commented scene"), "{shown}");
    let shown = messages("title = \"x\"\n");
    assert!(shown.contains("the scene has no [elements]") && shown.contains("no [run]"), "{shown}");
}

#[test]
fn a_table_of_numbers_is_told_to_stand_in_a_scene() {
    for table in
        ["x [mm];F [kN]\n0;0\n2,5;1,2\n", "Machine A\n\n0 0\n1 2\n", "# of the lab\n0\t0\n1\t2\n"]
    {
        let shown = messages(table);
        assert!(shown.starts_with("error: this is a table of numbers, and no scene"), "{shown}");
        assert!(shown.contains("`table-spring = \"scene.toml\"`"), "{shown}");
    }
    let options = crate::ReadOptions { file: Some("pr\u{fc}f.csv"), ..Default::default() };
    let latin = crate::read_bytes(b"Pr\xfcfer A\nx;F\n0;0\n1;2\n", &options).unwrap_err();
    assert!(latin.render(false).contains("this is a table of numbers"), "{latin}");
    for text in ["nodes\n", "a = 1\n", "[nodes\n1, 2\n"] {
        assert!(!messages(text).contains("a table of numbers"), "{text}");
    }
}

#[test]
fn examples_lie_in_the_range_of_what_they_are_of() {
    for (law, example) in [
        ("power-spring = { force = 1, at = 1 }", "`exponent = 1.5`"),
        ("power-dashpot = { force = 1, speed = 1 }", "`exponent = 0.5`"),
    ] {
        let shown = messages(&on_model(law));
        assert!(shown.contains(example), "{shown}");
    }
}

#[test]
fn a_constant_area_is_told_where_a_standard_has_a_dome() {
    let notes = |size: &str, limit: &str| {
        let law = "table-spring = [[0, 0], [0.9, 1e5]]";
        let pad = on_model(&format!("material = \"foam\", thickness = 0.02, {size}"));
        let text =
            format!("[materials]\nfoam = {{ {law} }}\n{pad}[limits]\npad.peak-force = {limit}\n");
        let notes = super::scene(&text).notes.into_iter();
        let of_pad = notes.filter(|own| own.subject.starts_with("element"));
        of_pad.map(|own| (own.subject, own.what.code())).collect::<Vec<_>>()
    };
    let told = vec![("element `pad`".to_owned(), "constant-area")];
    let dome = "pressed-by = { shape = \"dome\", radius = 0.05, diameter = 0.04 }";
    for limit in ["\"en-1621-1-level-1\"", "{ max = \"20 kN\", from = \"EN 1621-1:2012\" }"] {
        assert_eq!(notes("area = 0.0012", limit), told, "{limit}");
        assert_eq!(notes(dome, limit), [], "{limit}");
    }
    assert_eq!(notes("area = 0.0012", "\"20 kN\""), []);
}

#[test]
fn what_is_missing_is_said_of_the_file() {
    let errors = read_text("title = \"x\"\n").unwrap_err();
    assert!(!errors.is_empty());
    for own in &errors.list {
        assert_eq!((own.file(), own.line_and_column()), (Some("scene.toml"), None), "{own:?}");
    }
    assert!(errors.render(false).contains("--> scene.toml\n"), "{errors}");
}

#[test]
fn of_many_faults_of_one_kind_the_first_are_shown_and_the_others_counted() {
    let rows: Vec<String> =
        (0..160).map(|at| format!("m{at} = {{ spring = \"5 N/n\" }}")).collect();
    let text = format!("[models]\n{}\n{}", rows.join("\n"), on_model("spring = 1"));
    let errors = read_text(&text).unwrap_err();
    let shown = errors.render(false);
    assert_eq!(shown.matches("error: ").count(), 3, "{shown}");
    assert!(shown.contains("and 97 errors of the same kind, in lines 5, 6, 7"), "{shown}");
    // Those to which something else is to be done are shown by themselves.
    let two = "[models]\na = { spring = \"5 N/n\" }\nb = { spring = \"5 N/mk\" }\n";
    let errors = read_text(&format!("{two}{}", on_model("spring = 1"))).unwrap_err();
    assert_eq!(errors.render(false).matches("error: ").count(), 2, "{errors}");
}

#[test]
fn a_diagnostic_knows_its_place() {
    let errors = read_text(FAULTS_OF_THE_NETWORK).unwrap_err();
    let first = &errors.list[0];
    assert_eq!((first.file(), first.line_and_column()), (Some("scene.toml"), Some((3, 1))));
    let span = first.span.clone().unwrap();
    assert_eq!(&FAULTS_OF_THE_NETWORK[span], "lost");
    assert!(errors.render(true).contains("\u{1b}["));
}
