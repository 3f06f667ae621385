use super::*;

/// The text at the place of a fault, and the fault.
type Told = (String, String);

/// The points of two columns, or the faults.
fn points(text: &str, columns: [usize; 2]) -> Result<Vec<(f64, f64)>, Vec<Told>> {
    let csv = Csv::new(text).unwrap();
    let mut faults = Vec::new();
    let found = csv.points(columns, [1.0, 1.0], |span, fault| {
        faults.push((text[span].to_owned(), fault.to_string()));
    });
    found.ok_or(faults)
}

fn first(text: &str) -> Told {
    points(text, [0, 1]).unwrap_err().swap_remove(0)
}

#[test]
fn columns_are_separated_by_commas_semicolons_or_tabs() {
    let expected = vec![(0.0, 1.5), (0.5, -2e3)];
    for text in [
        "0,1.5\n0.5,-2e3\n",
        "0; 1.5\r\n0.5 ;-2e3",
        "0\t1.5\n\n0.5\t-2e3\n",
        "\u{feff}# from a logger, at 10 kHz\n0,1.5\n  # in between\n+.5,-2000.0,\n",
        "\"0\",\"1.5\"\n\"0.5\",\"-2e3\"\n",
    ] {
        assert_eq!(points(text, [0, 1]).unwrap(), expected, "{text}");
    }
    assert_eq!(points("9,0,1.5\n9,0.5,-2e3\n", [1, 2]).unwrap(), expected);
    assert_eq!(points("1.5;9;0\n-2e3;9;0.5\n", [2, 0]).unwrap(), expected);
}

#[test]
fn a_header_names_columns_and_units() {
    let csv = Csv::new("# measured\ntime [ms];\"head; force (kN)\"; state\n0;1;2\n").unwrap();
    let header = csv.header.as_ref().unwrap();
    let named = header.iter().map(Field::name_and_unit).collect::<Vec<_>>();
    let named = named.iter().map(|(name, unit)| (*name, unit.as_ref().map(|unit| unit.text)));
    let expected = [("time", Some("ms")), ("head; force", Some("kN")), ("state", None)];
    assert_eq!(named.collect::<Vec<_>>(), expected);
    assert_eq!(csv.columns, 3);
    let unit = header[1].name_and_unit().1.unwrap();
    assert_eq!(&csv.text[unit.span()], "kN");
    assert_eq!(csv.points([0, 1], [1e-3, 1e3], |_, _| {}).unwrap(), [(0.0, 1e3)]);
    // Numbers that are none are not taken for names.
    for text in ["nan,1\n", "0,0\n", "-,.5\n", "1e999,2\n"] {
        assert!(Csv::new(text).unwrap().header.is_none(), "{text}");
    }
    assert!(Csv::new("# nothing\n\n").is_none());
}

#[test]
fn a_name_that_begins_like_a_formula_is_read_as_it_was_written() {
    for name in ["=1+1", "-pad", "+x", "@sum", "'=quoted", "a;b", "plain"] {
        let text = format!("time [s],{},z\n0,1,2\n", text_cell(&format!("{name} [kN]")));
        assert!(!text.contains(",=") && !text.contains(",-") && !text.contains(",@"), "{text}");
        let csv = Csv::new(&text).unwrap();
        let (found, unit) = csv.header.as_ref().unwrap()[1].name_and_unit();
        assert_eq!((found, csv.columns), (name, 3));
        assert_eq!(&csv.text[unit.unwrap().span()], "kN");
    }
}

#[test]
fn equal_times_stay_and_falling_ones_are_told() {
    assert_eq!(points("0,1\n1,2\n1,3\n", [0, 1]).unwrap().len(), 3);
    let (place, message) = first("0,1\n1e0,2\n0.5,3\n");
    assert_eq!(place, "0.5");
    assert_eq!(message, "the time 0.5 stands after 1e0: times never fall");
}

#[test]
fn cells_that_are_no_numbers_are_told_where_they_stand() {
    let message = |text| first(text);
    let is = |found: Told, place: &str, message: &str| {
        assert_eq!((found.0.as_str(), found.1.as_str()), (place, message));
    };
    is(message("0,1\nabc,2\n"), "abc", "`abc` is not a number");
    is(message("0;1\n1;0,5\n"), "0,5", "`0,5` has a comma: decimals are written with a point");
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
    is(message("0,1\n1,5,5\n"), "1,5,5", "this row has 3 fields, but the first line has 2");
    is(message("0,1\n1,NaN\n"), "NaN", "`NaN` is not finite: every quantity is a finite number");
    is(
        message("0,1\n1,1e400\n"),
        "1e400",
        "`1e400` is too large: it does not fit into double precision",
    );
    // In other units it is too large.
    let csv = Csv::new("0,1e300\n").unwrap();
    let mut told = 0;
    assert_eq!(csv.points([0, 1], [1.0, 1e10], |_, _| told += 1), None);
    assert_eq!(told, 1);
}

#[test]
fn a_file_full_of_faults_is_not_read_to_its_end() {
    let text = "0;0,5\n".repeat(1000);
    assert_eq!(points(&text, [0, 1]).unwrap_err().len(), TOLD);
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
