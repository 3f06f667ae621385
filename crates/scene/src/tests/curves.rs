//! Curves from files: the same numbers in every dialect, and files in which something is wrong.

use dashpot_analysis::{Solve, SolveSettings};
use dashpot_network::parameters::Value;

use crate::{Checked, Diagnostics, ModelNote, ReadOptions, Remark, Scene, read, read_named_model};

fn beside(text: &str, bytes: &[u8]) -> Result<Checked<Scene>, Diagnostics> {
    let loader = |path: &str| match path {
        "lib/curve.csv" => Ok(bytes.to_vec()),
        other => Err(format!("no {other}")),
    };
    let file = Some("lib/scene.toml");
    read(text, &ReadOptions { file, loader: Some(&loader), ..ReadOptions::default() })
}

/// A kind of input: how a scene takes it, the units of the columns, its rows, and the same as points in a scene.
struct Input {
    scene: fn(&str) -> String,
    names: [&'static str; 2],
    units: [&'static str; 2],
    rows: &'static [[&'static str; 2]],
    inline: &'static str,
}

fn pad(law: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 5, velocity = \"4 m/s\" }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], {law} }}\n[run]\nduration = \"8 ms\"\n"
    )
}

const RISING: &[[&str; 2]] =
    &[["0", "0"], ["2", "0.5"], ["5", "1.25"], ["12", "1.5"], ["20", "30"]];

const INPUTS: [Input; 5] = [
    Input {
        scene: |points| pad(&format!("table-spring = {points}")),
        names: ["Weg", "Kraft"],
        units: ["mm", "kN"],
        rows: RISING,
        inline: "[[0, 0], [\"2 mm\", \"0.5 kN\"], [\"5 mm\", \"1.25 kN\"], [\"12 mm\", \"1.5 kN\"], \
                 [\"20 mm\", \"30 kN\"]]",
    },
    Input {
        scene: |points| pad(&format!("piecewise-spring = {points}")),
        names: ["deflection", "force"],
        units: ["cm", "N"],
        rows: &[["-1", "-250"], ["0", "0"], ["0.5", "100"], ["2", "2500"]],
        inline: "[[\"-1 cm\", \"-250 N\"], [0, 0], [\"0.5 cm\", \"100 N\"], [\"2 cm\", \"2500 N\"]]",
    },
    Input {
        scene: |points| pad(&format!("hysteretic-table = {points}")),
        names: ["x", "F"],
        units: ["mm", "N"],
        rows: &[
            ["0", "0"],
            ["5", "1500"],
            ["10", "2000"],
            ["20", "16000"],
            ["15", "4000"],
            ["10", "500"],
            ["2.5", "0"],
        ],
        inline: "{ loading = [[0, 0], [\"5 mm\", 1500], [\"10 mm\", 2000], [\"20 mm\", 16000]], \
                 unloading = [[\"2.5 mm\", 0], [\"10 mm\", 500], [\"15 mm\", 4000], [\"20 mm\", 16000]] }",
    },
    Input {
        scene: |points| {
            let pad = pad("material = \"foam\", thickness = \"3 cm\", area = \"100 cm^2\"");
            format!("[materials]\nfoam = {{ table-spring = {points} }}\n{pad}")
        },
        names: ["Dehnung", "Spannung"],
        units: ["%", "kPa"],
        rows: &[["0", "0"], ["5", "100.5"], ["40", "200"], ["80", "1500"]],
        inline: "[[0, 0], [\"5 %\", \"100.5 kPa\"], [\"40 %\", \"200 kPa\"], [\"80 %\", \"1500 kPa\"]]",
    },
    Input {
        scene: |points| {
            let load = "[loads.ram]\non = \"head\"\nforce";
            format!("{}{load} = {{ table = {points} }}\n", pad("spring = \"100 kN/m\""))
        },
        names: ["time", "force"],
        units: ["ms", "kN"],
        rows: &[["0", "0"], ["2", "1.5"], ["2", "1"], ["6.5", "-0.25"], ["7", "0"]],
        inline: "[[0, 0], [\"2 ms\", \"1.5 kN\"], [\"2 ms\", \"1 kN\"], [\"6.5 ms\", \"-0.25 kN\"], \
                 [\"7 ms\", 0]]",
    },
];

impl Input {
    /// Rows as text: `pair` makes one line of two cells.
    fn lines(&self, pair: impl Fn(&str, &str) -> String) -> String {
        self.rows.iter().map(|[one, other]| pair(one, other)).collect()
    }

    fn header(&self, open: &str, close: &str, between: &str) -> String {
        let [one, other] =
            [0, 1].map(|at| format!("{}{open}{}{close}", self.names[at], self.units[at]));
        format!("{one}{between}{other}")
    }

    /// The file in every dialect, each by its name.
    fn dialects(&self) -> Vec<(&'static str, Vec<u8>)> {
        let comma = |own: &str| own.replace('.', ",");
        let latin =
            |text: String| text.chars().map(|own| u8::try_from(u32::from(own)).unwrap()).collect();
        let commas = self.lines(|x, y| format!("{};{}\n", comma(x), comma(y)));
        let [names, units] = [self.names, self.units].map(|own| own.join(";"));
        let points = self.lines(|x, y| format!("{x},{y}\n"));
        let science = |own: &str| format!("{:E}", own.parse::<f64>().unwrap());
        let wide = |x: &str, y: &str| format!("1;{y};23.5;{x};ok\n");
        let bracketed = self.header(" [", "]", ",");
        let tabbed = format!("{}\n{}", self.header(" (", ")", "\t"), points.replace(',', "\t"));
        let utf16 = [0xfeff].into_iter().chain(tabbed.encode_utf16()).flat_map(u16::to_le_bytes);
        let [x, y] = [0, 1].map(|at| format!("{} [{}]", self.names[at], self.units[at]));
        vec![
            ("commas, points", format!("{bracketed}\n{points}").into()),
            ("semicolons, CRLF", format!("{}\r\n{}", self.header(" (", ")", ";"), points.replace(',', ";").replace('\n', "\r\n")).into()),
            ("semicolons, decimal commas", format!("{}\n{commas}", self.header(" [", "]", ";")).into()),
            ("tabs", tabbed.clone().into()),
            ("tabs, decimal commas", format!("{}\n{}", self.header(" / ", "", "\t"), commas.replace(';', "\t")).into()),
            ("spaces", format!("  {}\n{}", self.header(" [", "]", "   "), self.lines(|x, y| format!("   {x}    {y}\n"))).into()),
            ("a machine's preamble and a row of units", format!("Prüfmaschine;Z010\n\nDatum;01.03.2024\nVorkraft;5;N\nProbe;20,5;30,0;mm\n\n{names}\n{units}\n{commas}").into()),
            ("quoted", format!("\"{x}\",\"{y}\"\n{}", self.lines(|x, y| format!("\"{x}\",\"{y}\"\n"))).into()),
            ("a mark and comments", format!("\u{feff}# from a logger\n{bracketed}\n# rows\n{points}# end\n").into()),
            ("UTF-16", utf16.collect()),
            ("Latin-1", latin(format!("Temperatur: 23 °C; Dichte 30 µg/mm³\n{}\n{commas}", self.header(" in ", "", ";")))),
            ("powers of ten and separators at the end", format!("{};;\n{}", self.header(" [", "]", ";"), self.lines(|x, y| format!("{};{};;\n", science(x), science(y)))).into()),
            ("quoted decimal commas between commas", format!("{bracketed}\n{}", self.lines(|x, y| format!("\"{}\",\"{}\"\n", comma(x), comma(y)))).into()),
            ("words behind the rows", format!("{}\n{commas}\nEnde der Messung;\n", self.header(" [", "]", ";")).into()),
            ("lines that end with CR", format!("{}\n{commas}", self.header(" [", "]", ";")).replace('\n', "\r").into()),
            ("names in a comment", format!("# a logger\n# {bracketed}\n{points}").into()),
            ("other columns beside", format!("n;{y};T [°C];{x};state\n{}", self.lines(wide)).into()),
            ("bracketed units below", format!("{}\n[{}],[{}]\n{points}", self.names.join(","), self.units[0], self.units[1]).into()),
        ]
    }
}

/// The numbers of the law, or of the driving function at many times.
fn numbers(scene: &Scene) -> Vec<f64> {
    if let [load] = scene.network.loads() {
        return (0..=800).map(|at| load.force.value(f64::from(at) * 1e-5)).collect();
    }
    let dashpot_rheology::Tree::Part(element) = &scene.network.connections()[0].model else {
        panic!()
    };
    let values = element.values().into_iter().flat_map(|value| match value {
        Value::Table(points) => points.into_iter().flat_map(|(x, y)| [x, y]).collect::<Vec<f64>>(),
        other => panic!("{other:?}"),
    });
    values.collect()
}

#[test]
fn every_input_is_the_same_in_every_dialect() {
    for input in INPUTS {
        let inline =
            beside(&(input.scene)(input.inline), b"").unwrap_or_else(|errors| panic!("{errors}"));
        let expected = numbers(&inline.value);
        // Between points a function of time is a difference of its values.
        let largest = expected.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let scale =
            |own: f64| if inline.value.network.loads().is_empty() { own.abs() } else { largest };
        assert!(input.dialects().len() >= 12);
        for (dialect, bytes) in input.dialects() {
            let checked = beside(&(input.scene)("\"curve.csv\""), &bytes)
                .unwrap_or_else(|errors| panic!("{dialect}: {errors}"));
            let warnings = checked.warnings.render(false);
            assert_eq!(warnings, inline.warnings.render(false), "{dialect}");
            let is_left_out = |own: &ModelNote| matches!(own.what, Remark::LeftOut(_));
            let is_of_inline = |own: &ModelNote| inline.value.notes.contains(own);
            let notes = &checked.value.notes;
            let is_meant = |own: &ModelNote| is_left_out(own) || is_of_inline(own);
            assert!(notes.iter().all(is_meant), "{dialect}: {notes:?}");
            let found = numbers(&checked.value);
            assert_eq!(found.len(), expected.len(), "{dialect}: {found:?} for {expected:?}");
            for (own, other) in found.iter().zip(&expected) {
                assert!(
                    (own - other).abs() <= 4.0 * f64::EPSILON * scale(*other),
                    "{dialect}: {own} for {other}"
                );
            }
        }
    }
}

/// What is said of a table spring with this file.
fn told(bytes: impl AsRef<[u8]>) -> String {
    let text = pad("table-spring = \"curve.csv\"");
    beside(&text, bytes.as_ref()).unwrap_err().render(false)
}

fn has(shown: &str, parts: &[&str]) {
    for part in parts {
        assert!(shown.contains(part), "`{part}` is not in\n{shown}");
    }
}

#[test]
fn what_is_wrong_with_a_file_is_told_with_row_column_and_remedy() {
    let head = "x [mm];F [kN]\n0;0\n";
    let at = |rows: &str, parts: &[&str]| has(&told(format!("{head}{rows}")), parts);
    at(
        "1;abc\n",
        &["curve.csv:3:3", "`abc` is not a number", "column `F`", "help: a cell holds one"],
    );
    at("1;\n", &["curve.csv:3:1", "a number is missing here", "column `F`", "help"]);
    at("1;2 kN\n", &["curve.csv:3:3", "`2 kN` has a unit", "column `F`", "into a header line"]);
    at("1;1'000\n", &["curve.csv:3:3", "within the number", "column `F`", "write `1000`"]);
    at(
        "1;1.234,5\n",
        &["curve.csv:3:3", "marks between thousands", "column `F`", "write `1234,5`"],
    );
    at(
        "1;1,000\n2;2,500\n",
        &[
            "curve.csv:3:3",
            "before decimals or between thousands",
            "column `F`",
            "write `1000`",
            "`1,0000`",
        ],
    );
    at("1;0,5\n2;1.5\n", &["curve.csv:4:3", "`1.5` has a point", "column `F`", "write `1,5`"]);
    at("1;1.5\n2;2,25\n", &["curve.csv:4:3", "`2,25` has a comma", "column `F`", "write `2.25`"]);
    at("1;nan\n", &["curve.csv:3:3", "`nan` is not finite", "column `F`", "help"]);
    at(
        "1;2;3;4\n",
        &["curve.csv:3:1", "has 4 fields", "line of the table has 2", "help: decimals"],
    );
    at("1;-2\n2;-5\n", &["curve.csv:4:1", "largest value", "negative", "turn the signs of both"]);
    at(
        "9;2\n10;5\n5;1\n9;3\n",
        &["curve.csv:4:1", "turns back after this row", "cut the file behind"],
    );
    at("9;2\n5;1\n10;5\n", &["curve.csv:3:1", "turns back after this row", "`hysteretic-table`"]);
    at("x [mm];F [kN]\n1;1\n", &["curve.csv:3:1", "`x [mm]` is not a number", "column `x`"]);
    has(&told("x [mm];F [kg]\n0;0\n1;1\n"), &["curve.csv:1:11", "a force (N) is expected here"]);
    has(
        &told("x [mm];F [kNN]\n0;0\n1;1\n"),
        &["curve.csv:1:11", "`kNN` is not a known unit", "did you mean `kN`?"],
    );
    // In a row of its own it is a unit as well, and no name.
    has(
        &told("x;F\n%;kNN\n0;0\n1;1\n"),
        &["curve.csv:2:1", "is a pure number; a length (m) is expected here", "`kNN` is not"],
    );
    has(
        &told("Weg;Kraft\nmm;kNN\n0;0\n1;1\n"),
        &["curve.csv:2:4", "`kNN` is not a known unit", "did you mean `kN`?", "column `Kraft`"],
    );
    has(
        &told("a;b;c\n0;0;0\n1;1;1\n"),
        &["3 columns", "deformation and force", "columns = [1, 2]", "a, b, c"],
    );
    has(
        &told("0,0,0,0\n1,5,2,5\n".replace("0,0,0,0", "x [mm],F [kN]\n0,0,0,0")),
        &["curve.csv:2:1", "has 4 fields", "a point where commas separate"],
    );
    has(&told("Nothing here\n"), &["curve.csv:1:1", "one column", "help: columns are separated"]);
}

#[test]
fn records_that_are_no_cycle_are_told_where_they_go_on() {
    let told = |rows: &str| {
        let text = pad("hysteretic-table = \"curve.csv\"");
        beside(&text, format!("x [mm],F [N]\n{rows}").as_bytes()).unwrap_err().render(false)
    };
    let cycle = "0,0\n5,100\n10,400\n5,50\n0,0\n";
    has(
        &told(&format!("{cycle}5,90\n9,300\n")),
        &["curve.csv:7:1", "a second cycle begins here", "cut the file"],
    );
    has(
        &told("0,0\n5,100\n10,400\n"),
        &["curve.csv:4:1", "never turns back", "use `table-spring`"],
    );
}

#[test]
fn a_measured_material_runs_as_its_points_do() {
    let input = &INPUTS[3];
    let peak = |points: &str, bytes: &[u8]| {
        let scene = beside(&(input.scene)(points), bytes).unwrap().value;
        let settings = SolveSettings::lasting(scene.run.duration);
        let run = scene.network.solve_with(&settings).unwrap();
        run.value("pad.peak-force").unwrap()
    };
    let expected = peak(input.inline, b"");
    for (dialect, bytes) in input.dialects() {
        let found = peak("\"curve.csv\"", &bytes);
        assert!((found / expected - 1.0).abs() < 1e-12, "{dialect}: {found} for {expected}");
    }
}

#[test]
fn noise_is_pooled_and_the_largest_change_is_told_with_its_line() {
    // 500 and 300 become 400 twice: 100 N from each of 2 of 6 rows.
    let rows = "x [mm],F [N]\n0,0\n1,200\n2,500\n3,300\n4,5000\n5,9000\n";
    let text = pad("table-spring = \"curve.csv\"");
    let scene = beside(&text, rows.as_bytes()).unwrap().value;
    let points = numbers(&scene);
    let expected = [0.0, 0.0, 1e-3, 200.0, 2.5e-3, 400.0, 4e-3, 5000.0, 5e-3, 9000.0];
    for (own, other) in points.iter().zip(expected) {
        assert!((own - other).abs() <= 1e-15 * other.abs().max(1.0), "{points:?}");
    }
    let [note] = &scene.notes[..] else { panic!("{:?}", scene.notes) };
    let Remark::Curve(change) = &note.what else { panic!("{note:?}") };
    assert_eq!(note.subject, "file `lib/curve.csv`");
    assert_eq!((change.line, change.rows, change.points), (4, 6, 5));
    assert!((change.largest - 100.0).abs() < 1e-12 && (change.mean - 200.0 / 6.0).abs() < 1e-12);
    has(&note.what.to_string(), &["100 N at most", "in line 4", "33.3 N in the mean"]);
    // Above 5 % of the peak it is a warning.
    let large = beside(&text, rows.replace("3,300", "3,-900").as_bytes()).unwrap();
    has(&large.warnings.render(false), &["scene.toml:4", "of the peak, in line", "never falls"]);
}

#[test]
fn lines_before_a_table_are_told_and_units_that_nobody_writes_are_names() {
    let text = pad("table-spring = \"curve.csv\"");
    let rows = "Machine: A 12\n\nSpecimen: EPS\nx [mm];F [N]\n0;0\n1;100\n";
    let notes = beside(&text, rows.as_bytes()).unwrap().value.notes;
    let told: Vec<_> = notes.iter().map(|own| (own.what.code(), own.what.to_string())).collect();
    let right = "lines 1 to 3 are no part of the table and left out".to_owned();
    assert_eq!(told, [("lines-left-out", right)]);
    // Letters may be names of quantities below the name of a test.
    let rows = "Test;EPS\nt;F\n0;0\n0.001;100\n";
    let checked = beside(&text, rows.as_bytes()).unwrap();
    has(
        &checked.warnings.render(false),
        &[
            "deformations are read in m, the largest is 1 mm; forces are read in N, the largest is 100 N",
        ],
    );
}

#[test]
fn a_law_of_one_branch_takes_a_record_up_to_its_largest_deformation() {
    let text = pad("table-spring = \"curve.csv\"");
    let rows = |back: &str| format!("x [mm],F [N]\n0,0\n5,100\n10,400\n{back}");
    let alone = numbers(&beside(&text, rows("").as_bytes()).unwrap().value);
    for (back, lines) in [
        ("9.8,350\n", "line 5, after"),
        ("10,380\n9.8,350\n9,300\n", "lines 5 to 7, after"),
        ("5,50\n0,0\n", "lines 5 to 6, after"),
    ] {
        let scene = beside(&text, rows(back).as_bytes()).unwrap().value;
        assert_eq!(numbers(&scene), alone, "{back}");
        let [note] = &scene.notes[..] else { panic!("{:?}", scene.notes) };
        assert_eq!(note.what.code(), "way-back-left-out");
        has(&note.what.to_string(), &[lines]);
    }
}

#[test]
fn a_named_model_reads_its_curve_beside_its_own_file() {
    let text = "[materials]\nfoam = { table-spring = \"curve.csv\" }\n\
                other = { table-spring = \"absent.csv\" }\n[models]\nlost = { table-spring = \"gone.csv\" }\n";
    let loader = |path: &str| match path {
        "lib/curve.csv" => Ok(b"eps [%],s [kPa]\n0,0\n50,100\n40,80\n".to_vec()),
        other => Err(format!("no {other}")),
    };
    let options = ReadOptions {
        file: Some("lib/scene.toml"),
        loader: Some(&loader),
        ..ReadOptions::default()
    };
    let own = read_named_model(text, "foam", &options).unwrap().value;
    let dashpot_rheology::Tree::Part(element) = &own.model else { panic!("{own:?}") };
    assert_eq!(element.values(), [Value::Table(vec![(0.0, 0.0), (0.5, 1e5)])]);
    assert!(own.notes.iter().any(|own| own.what.code() == "way-back-left-out"), "{:?}", own.notes);
    // What it has to do with another file is told of the model that names it.
    let told = read_named_model(text, "lost", &options).unwrap_err().render(false);
    has(&told, &["gone.csv", "no lib/gone.csv"]);
    let told = read_named_model(text, "lost", &ReadOptions::default()).unwrap_err().render(false);
    has(&told, &["no other files can be read here"]);
}

#[test]
fn a_factor_on_the_values_of_a_file_is_a_number_of_the_scene() {
    let rows = "x [mm],F [N]\n0,0\n5,100\n10,400\n";
    let text = |scale: &str| pad(&format!("table-spring = {{ file = \"curve.csv\"{scale} }}"));
    let plain = numbers(&beside(&text(""), rows.as_bytes()).unwrap().value);
    let scattered = beside(&text(", scale = \"1.5 ± 0.1\""), rows.as_bytes()).unwrap().value;
    let right: Vec<f64> = plain.chunks(2).flat_map(|own| [own[0], 1.5 * own[1]]).collect();
    assert_eq!(numbers(&scattered), right);
    assert_eq!(scattered.scatter[0].path, "elements.pad.table-spring.scale");
    // Both branches of a record.
    let record = format!("{rows}5,50\n0,0\n");
    let both = |scale: &str| {
        let law = format!("hysteretic-table = {{ file = \"curve.csv\"{scale} }}");
        numbers(&beside(&pad(&law), record.as_bytes()).unwrap().value)
    };
    let right: Vec<f64> = both("").chunks(2).flat_map(|own| [own[0], 2.0 * own[1]]).collect();
    assert_eq!(both(", scale = 2"), right);
    let told = beside(&text(", scale = -1"), rows.as_bytes()).unwrap_err().render(false);
    has(&told, &["scene.toml:4", "`scale`", "positive"]);
}

#[test]
fn a_number_with_a_unit_is_no_unit() {
    let text = pad("table-spring = { file = \"curve.csv\", units = [\"mm\", \"1.3 kN\"] }");
    let told = beside(&text, b"0,0\n1,2\n").unwrap_err().render(false);
    has(&told, &["`1.3 kN` is a quantity; a unit stands here without a number", "write \"kN\""]);
}

#[test]
fn an_elastic_foam_is_told_where_its_losses_are_asked_for() {
    let rows = b"x [mm],F [N]\n0,0\n5,100\n10,400\n5,50\n0,0\n";
    let elastic = |law: &str, rest: &str| {
        let notes = beside(&format!("{}{rest}", pad(law)), rows).unwrap().value.notes;
        notes.iter().filter(|own| own.what.code() == "elastic").count()
    };
    let [limit, peak] =
        ["[limits]\nhead.hic15 = 700\n", "[limits]\nhead.peak-acceleration = \"99 g\"\n"];
    assert_eq!(elastic("table-spring = \"curve.csv\"", limit), 1);
    assert_eq!(elastic("table-spring = \"curve.csv\"", "[measures]\nhead = [\"hic15\"]\n"), 1);
    assert_eq!(elastic("table-spring = \"curve.csv\"", peak), 0);
    assert_eq!(elastic("hysteretic-table = \"curve.csv\"", limit), 0);
    assert_eq!(elastic("spring = \"2 kN/m\"", limit), 0);
}

#[test]
fn a_record_is_split_where_it_turns() {
    let text = pad("hysteretic-table = { file = \"curve.csv\", columns = [\"x\", \"F\"] }");
    // It is held at 10 mm, where the force relaxes, and taken off before the force is gone.
    let rows =
        "t [s],x [mm],F [N]\n0,-1,0\n1,0,0\n2,5,100\n3,10,400\n4,10,360\n5,8,200\n6,5,50\n7,4,10\n";
    let scene = beside(&text, rows.as_bytes()).unwrap().value;
    let dashpot_rheology::Tree::Part(element) = &scene.network.connections()[0].model else {
        panic!()
    };
    let [Value::Table(loading), Value::Table(unloading)] = &element.values()[..] else { panic!() };
    assert_eq!(loading, &[(0.0, 0.0), (0.005, 100.0), (0.01, 400.0)]);
    assert_eq!(unloading.first(), Some(&(unloading[0].0, 0.0)));
    // The line from (4 mm, 10 N) to (5 mm, 50 N) leads to zero at 3.75 mm.
    assert!((unloading[0].0 - 3.75e-3).abs() < 1e-12, "{unloading:?}");
    assert_eq!(unloading.last(), Some(&(0.01, 400.0)));
    let shares: Vec<f64> =
        unloading[1..].iter().map(|own| own.1 / element.force(own.0, 1.0)).collect();
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]), "{shares:?}");
}

#[test]
fn any_bytes_are_read_or_refused() {
    const PIECES: [&[u8]; 24] = [
        b"0",
        b"1",
        b"9.5",
        b"2,5",
        b"-",
        b"e9",
        b"1e400",
        b";",
        b",",
        b"\t",
        b" ",
        b"\n",
        b"\r\n",
        b"[mm]",
        b"(kN)",
        b"\"",
        b"#",
        b"x",
        b"F / N",
        b"\xff",
        b"\0",
        b"\xc3",
        b"\xef\xbb\xbf",
        b"%",
    ];
    // A linear congruential generator: the same bytes in every run.
    let mut state = 7_u32;
    let mut next = |below: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        usize::try_from(state >> 8).unwrap() % below
    };
    let text = [
        pad("table-spring = \"curve.csv\""),
        pad("hysteretic-table = \"curve.csv\""),
        pad(
            "piecewise-spring = { file = \"curve.csv\", columns = [1, 2], units = [\"mm\", \"N\"] }",
        ),
        (INPUTS[4].scene)("\"curve.csv\""),
    ];
    for _ in 0..4000 {
        let bytes: Vec<u8> =
            (0..next(60)).flat_map(|_| PIECES[next(PIECES.len())]).copied().collect();
        let scene = &text[next(text.len())];
        if let Err(errors) = beside(scene, &bytes) {
            assert!(!errors.render(false).is_empty());
        }
    }
}
