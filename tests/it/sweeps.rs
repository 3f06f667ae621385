//! Sweeps as users of the command meet them.

use dashpot::{
    analysis::Solve,
    scene::{ReadOptions, read, reference},
};
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// The records of a table in CSV, the header first.
fn records(table: &str) -> Vec<Vec<&str>> {
    table.lines().map(|line| line.split(',').collect()).collect()
}

const TWO: [&str; 6] = [
    "sweep",
    "reference",
    "--vary",
    "padding.maxwell.spring=5..80 MN/m,5,log",
    "--vary",
    "head.velocity=5,10 m/s",
];

#[test]
fn values_are_those_of_single_runs() {
    let run = run(&TWO);
    assert_eq!(code(&run), 0, "{}", err(&run));
    let table = out(&run);
    let records = records(&table);
    assert_eq!(records.len(), 1 + 10);
    assert_eq!(records[0][0], "padding.maxwell.spring [N/m]");
    for record in &records[1..] {
        let spring = format!("maxwell = {{ spring = \"{} N/m\",", record[0]);
        let text = reference()
            .replace("maxwell = { spring = \"20 MN/m\",", &spring)
            .replace("velocity = \"10 m/s\"", &format!("velocity = \"{} m/s\"", record[1]));
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        let report = scene.network.solve_with(&scene.settings("exact").unwrap()).unwrap();
        let mut compared = 0;
        let measures = records[0].iter().enumerate().filter(|own| *own.1 != "warnings");
        for (at, name) in measures.skip(2).step_by(2) {
            let (key, _) = name.split_once(" [").unwrap();
            let (key, thickness) = match key.strip_suffix(" over thickness") {
                Some(key) => (key, 0.02),
                None => (key, 1.0),
            };
            let own = report.measure(key).unwrap();
            let right = own.value.unwrap() / thickness;
            let [value, error]: [f64; 2] = [at, at + 1].map(|at| record[at].parse().unwrap());
            let room = error + own.error.unwrap_or(0.0) / thickness;
            assert!((value - right).abs() <= room, "{name}: {value} against {right}");
            assert!(error <= 1e-6 * value.abs(), "{name}: {error}");
            compared += 1;
        }
        assert_eq!(compared, 10, "all that the scene reports, and the share of the thickness");
    }
}

#[test]
fn a_deformation_over_thickness_is_told_once() {
    let told = |measure: &str, table: &str| {
        let vary = ["sweep", "reference", "--vary", "head.velocity=5,10 m/s", "--table", table];
        out(&run(&[&vary[..], &["--measure", measure]].concat()))
    };
    let share = "over thickness";
    assert!(told("padding.peak-deformation", "always").contains(share));
    // The strain of a pad in one piece is that share.
    let strain = told("padding.peak-strain", "always");
    assert!(strain.contains("peak-strain") && !strain.contains(share), "{strain}");
    let all = told("padding.peak-strain", "never");
    let records = records(&all);
    assert!(records[0].iter().any(|own| own.contains(share)), "programs get all: {all}");
}

#[test]
fn the_bytes_are_the_same_by_one_thread_and_by_many() {
    let by = |threads: &str, json: bool| {
        let mut arguments = TWO.to_vec();
        arguments.extend(["--threads", threads]);
        if json {
            arguments.push("--json");
        }
        out(&run(&arguments))
    };
    for json in [false, true] {
        let one = by("1", json);
        assert!(one.len() > 500);
        for threads in ["2", "7"] {
            assert_eq!(by(threads, json), one);
        }
    }
}

#[test]
fn a_named_value_varies_wherever_its_name_stands() {
    let folder = TempDir::new().unwrap();
    let scene = reference()
        .replace("[nodes]", "[values]\nK2 = \"20 MN/m\"\n\n[nodes]")
        .replace("kelvin = { spring = \"20 MN/m\"", "kelvin = { spring = \"K2\"")
        .replace("maxwell = { spring = \"20 MN/m\"", "maxwell = { spring = \"K2\"");
    let path = file(&folder, "scene.toml", &scene);
    let json = json(&["sweep", text(&path), "--vary", "K2=5..30 MN/m,4,log", "--json"]);
    assert_eq!(json["parameters"][0]["path"], "values.K2");
    assert_eq!(json["parameters"][0]["unit"], "N/m");
    assert_eq!((json["points"].as_u64(), json["instantiated"].as_u64()), (Some(4), Some(4)));
    let forces = json["measures"][0]["values"].as_array().unwrap();
    assert_eq!(json["measures"][0]["key"], "padding.peak-force");
    assert!(forces.windows(2).all(|pair| pair[0].as_f64() < pair[1].as_f64()));
}

#[test]
fn effects_and_other_measures_vary_too() {
    let json = json(&[
        "sweep",
        "reference-gravity",
        "--vary",
        "gravity.value=0.5..1.5 g0,3",
        "--measure",
        "head.hic15,mount.peak-force",
        "--json",
    ]);
    assert_eq!(json["instantiated"], 0);
    let keys: Vec<&str> = json["measures"]
        .as_array()
        .unwrap()
        .iter()
        .map(|own| own["key"].as_str().unwrap())
        .collect();
    assert_eq!(keys, ["head.hic15", "mount.peak-force", "padding.peak-deformation"]);
    assert!(
        json["measures"][0]["values"].as_array().unwrap().iter().all(serde_json::Value::is_f64)
    );
}

#[test]
fn counts_vary_too() {
    let vary = ["--vary", "bar.segments=10,20", "--measure", "bar.peak-stress", "--json"];
    let json = json(&[&["sweep", "scenes/polymer-bar.toml"][..], &vary].concat());
    let stresses = json["measures"][0]["values"].as_array().unwrap();
    let [few, many] = [0, 1].map(|at| stresses[at].as_f64().unwrap());
    assert!((few / many - 1.0).abs() < 0.2 && few.to_bits() != many.to_bits(), "{few} {many}");
}

#[test]
fn what_matters_little_is_left_out_after_a_proof() {
    let json = json(&[
        "sweep",
        "reference-gravity",
        "--vary",
        "head.velocity=12..16 m/s,9",
        "--measure",
        "padding.peak-force",
        "--neglect",
        "1%",
        "--json",
    ]);
    assert_eq!(json["left_out"]["effects"][0], "gravity");
    assert_eq!(json["left_out"]["checked"], serde_json::json!([0, 4, 8]));
    assert_eq!(json["instantiated"], 9, "without gravity it is of the plain kind");
    let moves = json["left_out"]["moves"].as_f64().unwrap();
    assert!(moves > 0.0 && moves <= 0.01);
    for at in 0..9 {
        let own = |what: &str| json["measures"][0][what][at].as_f64().unwrap();
        assert!(own("errors") >= moves * own("values"));
    }
}

#[test]
fn a_folder_holds_table_object_lines_and_maps() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("map").display().to_string();
    let mut arguments = TWO.to_vec();
    arguments[5] = "padding.kelvin.dashpot=2..8 kN s/m,4";
    arguments.extend(["--measure", "padding.peak-force", "--out", &path]);
    let done = run(&arguments);
    assert_eq!(code(&done), 0, "{}", err(&done));
    let read = |name: &str| std::fs::read_to_string(folder.path().join("map").join(name)).unwrap();
    assert_eq!(records(&read("sweep.csv")).len(), 1 + 20);
    assert!(read("result.json").starts_with("{\n  \"dashpot\""));
    let lines = read("padding.peak-force.svg");
    assert!(lines.contains("Peak force of padding over maxwell spring of padding"), "{lines}");
    assert!(lines.contains("data-name=\"2 kN s/m\""));
    let map = read("padding.peak-force-map.svg");
    assert!(
        map.contains("peak force of padding (kN)")
            && map.contains("kelvin dashpot of padding (kN s/m)")
    );
    let shown = out(&done);
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    assert!(shown.contains("20 points, instantiated from one compiled form"), "{shown}");
    // It may be written again, but not over what others have written.
    assert_eq!(code(&run(&arguments)), 0);
    std::fs::remove_file(folder.path().join("map/result.json")).unwrap();
    let refused = run(&arguments);
    assert_eq!(code(&refused), 2);
    let said = err(&refused);
    let said: Vec<&str> = said.split_whitespace().collect();
    assert!(said.join(" ").contains("overwrites its own results only"), "{said:?}");
}

/// What is said of a wrong command line.
fn fault(arguments: &[&str]) -> String {
    let done = run(arguments);
    assert_eq!(code(&done), 2, "{arguments:?}: {}", out(&done));
    let said = err(&done);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    said.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn faults_are_named_with_the_nearest_word() {
    let vary = |text: &'static str| fault(&["sweep", "reference", "--vary", text]);
    assert!(vary("head.velocty=1..2 m/s").contains("did you mean `head.velocity`?"));
    assert!(vary("spring=1..2 N/m").contains("may be"));
    assert!(vary("head.velocity=1..2 mm").contains("is in m, the value in the scene in m/s"));
    assert!(vary("head.velocity=1..2 m/s,5,lgo").contains("did you mean `log`?"));
    assert!(vary("head.velocity=2..1 m/s").contains("do not rise"));
    assert!(vary("head.velocity").contains("does not name a parameter and its values"));
    assert!(vary("head.mass=-1..2 kg").contains("mass"));
    assert!(vary("head.velocity=1..2 m/s,100000000").contains("not a number of values"));
    let measure = |key: &'static str| {
        let vary = "head.velocity=1..2 m/s";
        fault(&["sweep", "reference", "--vary", vary, "--measure", key])
    };
    assert!(measure("padding.peak-forse").contains("did you mean `padding.peak-force`?"));
    assert!(measure("hed.hic15").contains("there is no such node"));
    let twice = fault(&[
        "sweep",
        "reference",
        "--vary",
        "head.velocity=1..2 m/s",
        "--vary",
        "nodes.head.velocity=1..2 m/s",
    ]);
    assert!(twice.contains("are the same number of the scene"));
    assert!(fault(&["sweep", "reference"]).contains("--vary"));
}

#[test]
fn bare_values_are_those_of_the_scene_or_refused() {
    let thickness = &["sweep", "reference", "--vary", "padding.thickness=20..40,5"];
    let said = fault(thickness);
    assert!(said.contains("a bare number is in m, and the scene says 2 cm"), "{said}");
    assert!(said.contains("help: write \"padding.thickness=20..40 cm\""), "{said}");
    // Where the scene has none, either, they are in SI units, and what is unusual is warned of.
    let folder = TempDir::new().unwrap();
    let scene = reference().replace("thickness = \"2 cm\"", "thickness = 0.02");
    let path = file(&folder, "scene.toml", &scene);
    let vary = |values: &'static str| {
        let arguments = ["sweep", text(&path), "--vary", values, "--measure", "padding.peak-force"];
        let output = run(&arguments);
        assert_eq!(code(&output), 0);
        err(&output)
    };
    let told = vary("padding.thickness=20,40");
    assert!(told.contains("warning: `thickness` is 20 m: did you mean mm?"), "{told}");
    assert!(told.contains("warning: `thickness` is 40 m: did you mean mm?"), "{told}");
    assert!(!vary("padding.thickness=0.02,0.04").contains("did you mean"));
}

#[test]
fn a_value_that_is_set_cannot_vary_as_well() {
    let folder = TempDir::new().unwrap();
    let scene = reference()
        .replace("[nodes]", "[values]\nV = \"10 m/s\"\n\n[nodes]")
        .replace("velocity = \"10 m/s\"", "velocity = \"V\"");
    let path = file(&folder, "scene.toml", &scene);
    let said = fault(&["sweep", text(&path), "--vary", "V=1..2 m/s", "--set", "V=5 m/s"]);
    assert!(said.contains("`V` is set and varied"), "{said}");
}

#[test]
fn what_a_run_is_warned_of_is_told_with_its_points() {
    let arguments =
        ["sweep", "reference", "--vary", "duration=1..30 ms,4", "--measure", "padding.peak-force"];
    let done = run(&arguments);
    let said = err(&done).split_whitespace().collect::<Vec<_>>().join(" ");
    let lasting = "at 1 of 4 points, first at duration = 1 ms: the padding is still in contact";
    assert!(said.contains(lasting), "{said}");
    assert!(said.contains("at 3 of 4 points"), "{said}");
    let table = out(&done);
    let flags: Vec<&str> = records(&table).iter().map(|record| record[record.len() - 1]).collect();
    assert_eq!(flags, ["warnings", "1", "2", "2", "2"]);
    let json = json(&[&arguments[..], &["--json"]].concat());
    assert_eq!(json["warnings"][0]["points"], serde_json::json!([0]));
    assert_eq!(json["warnings"][1]["points"], serde_json::json!([1, 2, 3]));
    // Stamped points pull too, and are pressed through.
    let speeds = ["sweep", "reference", "--vary", "head.velocity=2,8,14 m/s", "--json"];
    let json = crate::cli::json(&speeds);
    assert_eq!(json["instantiated"], 3);
    let told = |at: usize| json["warnings"][at]["text"].as_str().unwrap();
    assert!(told(0).ends_with("the padding is in tension: separation is off"), "{}", told(0));
    assert_eq!(json["warnings"][0]["points"], serde_json::json!([0, 1, 2]));
    assert!(told(1).contains("more than its thickness"), "{}", told(1));
    assert_eq!(json["warnings"][1]["points"], serde_json::json!([2]));
}

#[test]
fn a_method_may_be_chosen_and_only_exact_ones_are_instantiated() {
    let by = |method: &str| {
        let vary = "head.velocity=8,12 m/s";
        json(&["sweep", "reference", "--vary", vary, "--method", method, "--json"])
    };
    let (exact, bdf) = (by("exact"), by("bdf"));
    assert_eq!((exact["instantiated"].as_u64(), bdf["instantiated"].as_u64()), (Some(2), Some(0)));
    for at in 0..2 {
        let of =
            |own: &serde_json::Value, what: &str| own["measures"][0][what][at].as_f64().unwrap();
        let room = of(&bdf, "errors") + of(&exact, "errors");
        assert!((of(&bdf, "values") - of(&exact, "values")).abs() <= room);
    }
    assert!(
        fault(&["sweep", "reference", "--vary", "head.velocity=8,12 m/s", "--method", "bfd"])
            .contains("bfd")
    );
}

#[test]
fn three_parameters_have_no_figure_and_many_lines_are_thinned() {
    let folder = TempDir::new().unwrap();
    let into = |name: &str| folder.path().join(name).display().to_string();
    let [one, two, three] = [
        "head.velocity=8,9 m/s",
        "padding.maxwell.spring=5..80 MN/m,13,log",
        "panel.mass=50,100 kg",
    ];
    let force = ["--measure", "padding.peak-force", "--out"];
    let all = ["sweep", "reference", "--vary", one, "--vary", two, "--vary", three];
    let done = run(&[&all[..], &force, &[&into("three")]].concat());
    assert!(err(&done).contains("no figures: lines and maps"), "{}", err(&done));
    let done = run(&[&all[..6], &force, &[&into("two")]].concat());
    assert_eq!(code(&done), 0, "{}", err(&done));
    let lines = std::fs::read_to_string(folder.path().join("two/padding.peak-force.svg")).unwrap();
    assert!(lines.contains("for 7 of 13 values of maxwell"), "{lines}");
    assert!(lines.contains("=\"5 MN/m\"") && lines.contains("=\"80 MN/m\""));
    let flipped = ["sweep", "reference", "--vary", two, "--vary", "padding.thickness=100,400 mm"];
    let done = run(&[&flipped[..], &force, &[&into("axis")]].concat());
    assert_eq!(code(&done), 0, "{}", err(&done));
    let lines = std::fs::read_to_string(folder.path().join("axis/padding.peak-force.svg")).unwrap();
    assert!(lines.contains("maxwell spring of padding (MN/m)"), "{lines}");
}

/// A scene on foam or on a spring, with the numbers that a table gives other values.
fn listed_scene(pad: &str) -> String {
    format!(
        "[values]\nK = \"25 kN/m\"\n[nodes]\nhead = {{ mass = \"4 kg\", velocity = \"5 m/s\" }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], {pad}, thickness = \"40 mm\" }}\n\
         [run]\nduration = \"60 ms\"\n"
    )
}

#[test]
fn rows_of_a_table_are_designs_each_as_if_it_were_run_alone() {
    let folder = TempDir::new().unwrap();
    let table = "head.velocity [m/s];K [kN/m]\n# a comment\n3;10\n7;80\n\n5;25\n2;200\n";
    let table = file(&folder, "designs.csv", table);
    let table = table.to_str().unwrap();
    let foam = "parallel = [{ spring = \"K\" }, { power-spring = { force = \"1 kN\", at = \"20 mm\", \
                exponent = 1.5 } }]";
    for pad in ["spring = \"K\"", foam] {
        let scene = file(&folder, "scene.toml", &listed_scene(pad));
        let scene = scene.to_str().unwrap();
        let found = json(&["sweep", scene, "--points", table, "--json"]);
        assert_eq!((&found["listed"], &found["points"]), (&true.into(), &4.into()));
        assert_eq!(found["parameters"][1]["values"], serde_json::json!([1e4, 8e4, 2.5e4, 2e5]));
        let column = found["measures"].as_array().unwrap().iter();
        let column = column.clone().find(|own| own["key"] == "pad.peak-force").unwrap();
        for (at, (velocity, stiffness)) in
            [("3", "10"), ("7", "80"), ("5", "25"), ("2", "200")].iter().enumerate()
        {
            let text = listed_scene(pad).replace("5 m/s", &format!("{velocity} m/s"));
            let alone = file(&folder, "alone.toml", &text);
            let set = format!("K={stiffness} kN/m");
            let alone = json(&["run", alone.to_str().unwrap(), "--set", &set, "--json"]);
            let right = &alone["runs"][0]["measures"]["pad.peak-force"];
            let [own, right, error] = [&column["values"][at], &right["value"], &right["error"]]
                .map(|own| own.as_f64().unwrap());
            assert!((own - right).abs() <= error + 1e-9 * right, "{own} is not {right}");
            assert!(column["errors"][at].as_f64().unwrap() > 0.0);
        }
        let text = out(&run(&["sweep", scene, "--points", table]));
        let first = text.lines().nth(1).unwrap();
        assert!(first.starts_with("3,1e4,") || first.starts_with("3,10000,"), "{first}");
    }
    let scene = file(&folder, "scene.toml", &listed_scene("spring = \"K\""));
    let table = file(&folder, "dated.csv", "Designs;of May\nhead.velocity [m/s];K [kN/m]\n3;10\n");
    let output = run(&["sweep", scene.to_str().unwrap(), "--points", table.to_str().unwrap()]);
    let shown = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains("line 1 is no part of the table and left out"), "{shown}");
}

#[test]
fn a_table_of_designs_that_does_not_fit_is_refused_with_line_and_column() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "scene.toml", &listed_scene("spring = \"K\""));
    let scene = scene.to_str().unwrap();
    for (table, told) in [
        (
            "K [kN/m],head.velocity [m/s]\n1,2\n1,fast\n",
            "line 3, column `head.velocity`: `fast` is not a number",
        ),
        ("K [mm]\n1\n", "is in m, the value in the scene in N/m"),
        ("Q [kN/m]\n1\n", "the scene has no number `Q`"),
        ("K [kN/m],values.K [kN/m]\n1,1\n", "`K` and `values.K`"),
        ("1,2\n", "names no numbers of the scene"),
    ] {
        let path = file(&folder, "designs.csv", table);
        let output = run(&["sweep", scene, "--points", path.to_str().unwrap()]);
        assert_eq!(code(&output), 2, "{table:?}: {}", err(&output));
        let words = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(told), "{table:?}: {words}");
    }
    let output = run(&["sweep", scene, "--points", "none.csv"]);
    assert!(err(&output).contains("`none.csv` cannot be read"), "{}", err(&output));
    assert_eq!(code(&run(&["sweep", scene])), 2);
}

const LINERS: &str = r#"
[materials]
soft = { spring = "1 MPa" }
firm = { spring = "4 MPa" }
[nodes]
head = { mass = "5 kg", velocity = "5 m/s" }
[elements]
liner = { between = ["head", "ground"], material = "soft", thickness = "20 mm", area = "40 cm^2" }
[run]
duration = "60 ms"
"#;

#[test]
fn rows_of_a_table_have_words_and_names() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "liners.toml", LINERS);
    // As a spreadsheet in German writes it: Latin-1, decimal commas, lines before and behind.
    let text = "Entw\u{fc}rfe;Mai\n\nEntwurf;liner.material;liner.thickness [mm]\nA1;soft;22,5\nA2;firm;25,0\n\
                B \u{e4};soft;30\nEnde\n";
    let bytes: Vec<u8> = text.chars().map(|own| u8::try_from(u32::from(own)).unwrap()).collect();
    let table = folder.path().join("designs.csv");
    std::fs::write(&table, bytes).unwrap();
    let words = ["sweep", path.to_str().unwrap(), "--points", table.to_str().unwrap()];
    let output = run(&[&words[..], &["--measure", "liner.peak-force"]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("`Entwurf` is nothing in the scene: it names the designs"), "{said}");
    assert!(said.contains("line 1 and line 7 are no part of the table"), "{said}");
    let shown = out(&output);
    let rows: Vec<Vec<&str>> = shown.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["Entwurf", "liner.material", "liner.thickness [m]"]);
    let right =
        [("A1", "soft", 1e6, 0.0225), ("A2", "firm", 4e6, 0.025), ("B \u{e4}", "soft", 1e6, 0.03)];
    for (row, (name, material, modulus, thickness)) in rows[1..].iter().zip(right) {
        assert_eq!((row[0], row[1]), (name, material));
        let found: f64 = row[3].parse().unwrap();
        assert!((found / liner_force(modulus, thickness) - 1.0).abs() < 1e-9, "{row:?}");
    }
    assert_eq!(rows.len(), 4);
    let told = json(&[&words[..], &["--json"]].concat());
    assert_eq!(told["parameters"][0]["values"], serde_json::json!(["A1", "A2", "B \u{e4}"]));
    assert!(told["parameters"][0]["path"].is_null(), "{}", told["parameters"][0]);
}

#[test]
fn a_row_that_does_not_fit_the_scene_is_told_by_its_line() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "liners.toml", LINERS);
    let scene = path.to_str().unwrap();
    for (table, told) in [
        ("liner.material,head.mass [kg]\nsoft,5\nsfot,5\n", "line 3 of"),
        (
            "liner.material,head.mass [kg]\nsoft,5\nsoft,five\n",
            "line 3, column `head.mass`: `five` is not",
        ),
        ("liner.materal,head.mass [kg]\nsoft,5\n", "did you mean"),
        ("batch,head.mass\nx,one\ny,two\n", "`head.mass` is a number"),
    ] {
        let file = file(&folder, "designs.csv", table);
        let output = run(&["sweep", scene, "--points", file.to_str().unwrap()]);
        assert_eq!(code(&output), 2, "{table:?}: {}", err(&output));
        let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(told), "{table:?}: {said}");
    }
}

/// V √(m E A/h).
fn liner_force(modulus: f64, thickness: f64) -> f64 {
    5.0 * (5.0 * modulus * 40e-4 / thickness).sqrt()
}

#[test]
fn words_are_swept_beside_numbers() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "liners.toml", LINERS);
    let measure = ["--measure", "liner.peak-force"];
    let ranges = ["--vary", "liner.material=soft,firm", "--vary", "thickness=10,20,40 mm"];
    let swept = run(&[&["sweep", text(&path)], &ranges[..], &measure].concat());
    assert_eq!(code(&swept), 0, "{}", err(&swept));
    let table = out(&swept);
    let records = records(&table);
    assert_eq!(records[0][..2], ["liner.material", "thickness [m]"]);
    assert_eq!(records.len(), 7);
    for record in &records[1..] {
        let modulus = if record[0] == "soft" { 1e6 } else { 4e6 };
        let right = liner_force(modulus, record[1].parse().unwrap());
        let value: f64 = record[2].parse().unwrap();
        assert!((value / right - 1.0).abs() < 1e-9, "{record:?} against {right}");
    }
    // One line for each word over the numbers, whichever comes first.
    let drawn = folder.path().join("drawn");
    let to = ["--out", text(&drawn)];
    let turned = [ranges[2], ranges[3], ranges[0], ranges[1]];
    let swept = run(&[&["sweep", text(&path)], &turned[..], &measure, &to].concat());
    assert_eq!(code(&swept), 0, "{}", err(&swept));
    let figure = std::fs::read_to_string(drawn.join("liner.peak-force.svg")).unwrap();
    for word in ["soft", "firm"] {
        assert!(figure.contains(&format!("data-name=\"{word}\"")), "{word}");
    }
    let object = json(&[&["sweep", text(&path), "--json"], &ranges[..], &measure].concat());
    assert_eq!(object["parameters"][0]["values"], serde_json::json!(["soft", "firm"]));
}

#[test]
fn words_that_are_none_are_told_by_their_place() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "liners.toml", LINERS);
    for (vary, told) in [
        ("liner.material=soft,frim,firm", "did you mean `firm`?"),
        ("liner.materal=soft,firm", "did you mean `liner.material`?"),
        ("liner.thickness=soft,firm", "`liner.thickness` is a number, 20 mm in the scene"),
        ("liner.material=1,2", "`liner.material` is a word, `soft` in the scene"),
    ] {
        let swept = run(&["sweep", text(&path), "--vary", vary]);
        assert_eq!(code(&swept), 2);
        assert!(err(&swept).contains(told), "{vary}: {}", err(&swept));
    }
}

#[test]
fn a_sample_is_a_latin_hypercube_that_repeats() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "liners.toml", LINERS);
    let sampled = |seed: &str| {
        let ranges = ["--vary", "thickness=10..30 mm", "--vary", "liner.material=soft,firm"];
        let wishes = ["--measure", "liner.peak-force", "--sample", "40", "--seed", seed];
        let swept = run(&[&["sweep", text(&path)], &ranges[..], &wishes].concat());
        assert_eq!(code(&swept), 0, "{}", err(&swept));
        out(&swept)
    };
    let table = sampled("5");
    assert_eq!(table, sampled("5"));
    assert_ne!(table, sampled("6"));
    let records = records(&table);
    let mut parts: Vec<usize> = Vec::new();
    for record in &records[1..] {
        let modulus = if record[1] == "soft" { 1e6 } else { 4e6 };
        let thickness: f64 = record[0].parse().unwrap();
        let value: f64 = record[2].parse().unwrap();
        let right = liner_force(modulus, thickness);
        assert!((value / right - 1.0).abs() < 1e-9, "{record:?} against {right}");
        parts.push(((thickness - 0.01) / 0.02 * 40.0) as usize);
    }
    parts.sort_unstable();
    assert_eq!(parts, (0..40).collect::<Vec<_>>());
    assert_eq!(records[1..].iter().filter(|own| own[1] == "soft").count(), 20);
}
