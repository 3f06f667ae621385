//! The words of the main errors, in full.

use super::{messages, read_text};

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
  = help: did you mean `title`? known keys: title, values, models, nodes, elements, effects, loads, measures, accuracy, run

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
   = help: did you mean `spring`? known keys: name, spring, dashpot, rigid, series, parallel, model, kelvin-voigt, kelvin, voigt, maxwell, zener, standard-linear-solid, sls, burgers, four-parameter

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
   = help: did you mean `exact`? known words: auto, bdf, tr-bdf2, esdirk34, tsit45, exact
"#;

#[test]
fn faults_of_the_text_come_all_at_once() {
    assert_eq!(messages(FAULTS_OF_THE_TEXT), FAULTS_OF_THE_TEXT_SHOWN.trim_matches('\n'));
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
fn a_diagnostic_knows_its_place() {
    let errors = read_text(FAULTS_OF_THE_NETWORK).unwrap_err();
    let first = &errors.list[0];
    assert_eq!((first.file(), first.line_and_column()), (Some("scene.toml"), Some((3, 1))));
    let span = first.span.clone().unwrap();
    assert_eq!(&FAULTS_OF_THE_NETWORK[span], "lost");
    assert!(errors.render(true).contains("\u{1b}["));
}
