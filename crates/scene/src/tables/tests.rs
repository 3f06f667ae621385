use super::*;

/// The text at the place of a fault, and the fault.
type Told = (String, String);

/// The points of two columns, or the faults.
fn points(text: &str, columns: [usize; 2]) -> Result<Vec<(f64, f64)>, Vec<Told>> {
    scaled(text, columns, [1.0; 2])
}

fn scaled(
    text: &str,
    columns: [usize; 2],
    factors: [f64; 2],
) -> Result<Vec<(f64, f64)>, Vec<Told>> {
    let told = |error: TableError| (text[error.span].to_owned(), error.fault.to_string());
    let table = DataTable::read(text).map_err(|error| vec![told(error)])?;
    let mut faults = Vec::new();
    let scales = factors.map(|factor| Scale { factor, offset: 0.0 });
    let found = table.samples(columns, scales, |error| faults.push(told(error)));
    found.map(|own| own.points).ok_or(faults)
}

fn first(text: &str) -> Told {
    points(text, [0, 1]).unwrap_err().swap_remove(0)
}

#[test]
fn columns_are_separated_by_commas_semicolons_tabs_or_spaces() {
    let expected = vec![(0.0, 1.5), (0.5, -2e3)];
    for text in [
        "0,1.5\n0.5,-2e3\n",
        "0; 1.5\r\n0.5 ;-2e3",
        "0\t1.5\n\n0.5\t-2e3\n",
        "\u{feff}# from a logger, at 10 kHz\n0,1.5\n  # in between\n+.5,-2000.0,\n",
        "\"0\",\"1.5\"\n\"0.5\",\"-2e3\"\n",
        "0 1.5\n 0.5   -2e3\n",
        "0;1,5;;;\n0,5;-2E3;;;\n;;;;\n",
        "0 1,5\n0,5 -2,0e3\n",
    ] {
        assert_eq!(points(text, [0, 1]).unwrap(), expected, "{text}");
    }
}

#[test]
fn any_two_columns_may_be_taken() {
    let text = "# measured\ntime [ms];\"head; force (kN)\"; state\n0;1;2\n";
    let table = DataTable::read(text).unwrap();
    let heading = |at| table.heading(at);
    assert_eq!((heading(0).name, heading(0).unit), ("time", Some("ms")));
    assert_eq!((heading(1).name, heading(1).unit), ("head; force", Some("kN")));
    assert_eq!((heading(2).name, heading(2).unit), ("state", None));
    assert_eq!(points(text, [2, 0]).unwrap(), [(2.0, 0.0)]);
    assert_eq!(scaled(text, [0, 1], [1e-3, 1e3]).unwrap(), [(0.0, 1e3)]);
}

#[test]
fn a_first_line_with_a_number_is_no_header() {
    for text in ["0,1\n", "x,1\n", "time,1e3\n", "NaN,2\n", "-inf,2\n", "1e999,2\n"] {
        assert!(!DataTable::read(text).unwrap().has_header(), "{text}");
    }
    assert_eq!(*DataTable::read("# nothing\n\n").unwrap_err().fault, TableFault::Empty);
}

#[test]
fn a_name_that_begins_like_a_formula_is_read_as_it_was_written() {
    for name in ["=1+1", "-pad", "+x", "@sum", "'=quoted", "a;b", "plain"] {
        let text = format!("time [s],{},z\n0,1,2\n", text_cell(&format!("{name} [kN]")));
        assert!(!text.contains(",=") && !text.contains(",-") && !text.contains(",@"), "{text}");
        let table = DataTable::read(&text).unwrap();
        assert_eq!((table.heading(1).name, table.columns()), (name, 3));
        assert_eq!(&text[table.unit(1).unwrap().span()], "kN");
    }
}

#[test]
fn cells_that_are_no_numbers_are_told_where_they_stand() {
    let message = |text| first(text);
    let is = |found: Told, place: &str, message: &str| {
        assert_eq!((found.0.as_str(), found.1.as_str()), (place, message));
    };
    is(message("0,1\nabc,2\n"), "abc", "`abc` is not a number");
    is(message("0;1.5\n1;0,5\n"), "0,5", "`0,5` has a comma: decimals are written with a point");
    is(
        message("0,1\n1,5 kN\n"),
        "5 kN",
        "`5 kN` has a unit; the numbers of a file have none of their own",
    );
    is(
        message("0;1\n1;60 000\n"),
        "60 000",
        "`60 000` has a space or a mark within the number, which is not read",
    );
    is(message("0,1\n1;2\n"), "1;2", "`1;2` is not a number");
    is(message("0,1\n1,\n"), "1,", "a number is missing here");
    is(message("0,1,2\n1,,2\n"), "", "a number is missing here");
    is(
        message("0,1\n1,5,5\n"),
        "1,5,5",
        "this row has 3 fields, but the first line of the table has 2",
    );
    is(message("0,1\n1,NaN\n"), "NaN", "`NaN` is not finite: every quantity is a finite number");
    is(
        message("0,1\n1,1e400\n"),
        "1e400",
        "`1e400` is too large: it does not fit into double precision",
    );
    // In other units it is too large.
    assert_eq!(scaled("0,1e300\n", [0, 1], [1.0, 1e10]).unwrap_err().len(), 1);
}

#[test]
fn faults_of_one_kind_are_one_with_the_first_lines_and_their_number() {
    let text = "x;y\n".to_owned() + &"0;a\n1;b\n".repeat(1000) + "2;3;4\n";
    let table = DataTable::read(&text).unwrap();
    let mut told = Vec::new();
    assert!(table.samples([0, 1], [Scale::SI; 2], |error| told.push(error.to_string())).is_none());
    let [first, second] = &told[..] else { panic!("{told:?}") };
    assert_eq!(
        first,
        "line 2, column `y`: `a` is not a number; likewise in lines 3, 4, 5 and 1996 more"
    );
    assert!(second.starts_with("line 2002: this row has 3 fields"), "{second}");
}

#[test]
fn a_comma_before_decimals_may_stand_between_quotes() {
    let expected = vec![(0.0, 1.5), (0.5, -2e3)];
    for text in ["0,\"1,5\"\n\"0,5\",\"-2,0e3\"\n", "x,y\n\"0,0\",\"1,5\"\n\"0,5\",-2000\n"] {
        assert_eq!(points(text, [0, 1]).unwrap(), expected, "{text}");
    }
    assert!(first("0,\"1,5\"\n\"2,5\",0.5\n").1.contains("has a point"));
    assert!(first("1,\"1,000\"\n").1.contains("between thousands"));
}

#[test]
fn words_behind_the_rows_are_no_part_of_the_table() {
    let rows = "x;y\n0;1\n1;2\n";
    for (end, behind) in [
        ("", None),
        ("\nEnd of the test\n", Some([5, 5])),
        ("# rows\nEnd;;\n\nby hand\n\n", Some([5, 7])),
    ] {
        let text = format!("{rows}{end}");
        let table = DataTable::read(&text).unwrap();
        assert_eq!(points(&text, [0, 1]).unwrap(), [(0.0, 1.0), (1.0, 2.0)], "{end}");
        assert_eq!((table.behind(), table.lines().len()), (behind, 2), "{end}");
    }
    // A row with a number, or as wide as the table, is one of it; so is what stands between rows.
    for end in ["Max;2\n", "a;b\n", "in between\n2;3\n"] {
        assert!(points(&format!("{rows}{end}"), [0, 1]).is_err(), "{end}");
    }
    let words = "material\neps\nepp\n";
    assert_eq!(DataTable::read(words).unwrap().lines(), [2, 3]);
}

#[test]
fn names_with_units_may_stand_in_the_comment_above() {
    for text in [
        "# a logger\n# time [ms], force [kN]\n0,1\n1,2\n",
        "#time [ms]\tforce [kN]\n0 1\n1 2\n",
        "\u{feff}# time (ms); force (kN)\n\n0;1\n1;2\n",
    ] {
        let table = DataTable::read(text).unwrap();
        let told = [0, 1].map(|at| (table.heading(at).name, table.heading(at).unit));
        assert_eq!(told, [("time", Some("ms")), ("force", Some("kN"))], "{text}");
        assert_eq!(table.lines().len(), 2);
    }
    // Words without a unit are no names.
    assert!(!DataTable::read("# by hand\n0 1\n").unwrap().has_header());
}

#[test]
fn a_million_rows_are_read_and_one_more_is_not() {
    let mut text = String::new();
    for row in 0..MOST_ROWS {
        text.push_str(&row.to_string());
        text.push_str(",1\n");
    }
    assert_eq!(points(&text, [0, 1]).unwrap().len(), MOST_ROWS);
    text += "1000000,1";
    let (place, message) = first(&text);
    assert_eq!(
        (place.as_str(), message.as_str()),
        ("1000000,1", "the file has more than 1000000 rows")
    );
}

#[test]
fn one_column_with_decimal_commas_is_not_taken_for_two() {
    for text in [
        "acc [g]\n1,5\n2,25\n3,5\n",
        "Logger 7\nacc [g]\n-1,5\n2\n3,5\n",
        "1,5\n2,5\n1,75\n",
        "0,5\n1,05\n",
    ] {
        let error = DataTable::read(text).unwrap_err();
        assert!(matches!(*error.fault, TableFault::CommaOrColumns { .. }), "{text}: {error}");
        assert!(error.help().is_some_and(|own| own.contains('.') && own.contains("time [s]")));
    }
    // Names, points, signs, and columns that rise say that there are two.
    for text in [
        "t [s],acc [g]\n1,5\n2,25\n1,5\n",
        "0,5\n1.5,5\n1,2\n",
        "3,5\n2,-5\n1,2\n",
        "0,0\n1,0\n1,5\n2,5\n",
        "# t [s],acc [g]\n1,5\n0,5\n",
    ] {
        assert_eq!(DataTable::read(text).unwrap().columns(), 2, "{text}");
    }
    let quoted = DataTable::read("acc [g]\n\"1,5\"\n\"2,25\"\n").unwrap();
    assert_eq!(quoted.columns(), 1);
}
