//! Numbers of a scene by name.

use super::*;
use crate::{BareNumbers, ReadOptions, read, reference};

const TEXT: &str = r#"
[values]
K2 = "20 MN/m"

[models.pad]
series = [
  { spring = "K2" },
  { dashpot = "6 kN s/m" },
  { parallel = [{ spring = "18 MN/m" }, { dashpot = 4000 }] },
]

[nodes]
head = { mass = "10 kg", velocity = "10 m/s" }

[elements]
padding = { between = ["head", "ground"], model = "pad", thickness = "2 cm" }

[run]
duration = "20 ms"
samples = 11
"#;

fn tunables() -> Tunables {
    Tunables::of(TEXT, None).unwrap()
}

fn path(name: &str) -> String {
    let own = tunables();
    own.find(name).map_or_else(|fault| fault.to_string(), |at| own.all()[at].path.clone())
}

#[test]
fn a_number_goes_by_any_parts_of_its_path_that_tell_it() {
    assert_eq!(path("head.velocity"), "nodes.head.velocity");
    assert_eq!(path("velocity"), "nodes.head.velocity");
    assert_eq!(path("K2"), "values.K2");
    assert_eq!(path("padding.thickness"), "elements.padding.thickness");
    assert_eq!(path("padding.parallel.dashpot"), "models.pad.series.3.parallel.2.dashpot");
    assert_eq!(path("padding.series.2.dashpot"), "models.pad.series.2.dashpot");
    assert_eq!(path("run.duration"), "run.duration");
    assert_eq!(path("padding.series.1.spring"), "values.K2", "a named value");
}

#[test]
fn what_leads_to_none_or_several_is_said() {
    assert!(path("samples").contains("no number `samples`"));
    let fault = tunables().find("head.veloctiy").unwrap_err();
    assert!(fault.help().unwrap().starts_with("did you mean `head.velocity`?"), "{fault:?}");
    assert!(path("pad.dashpot").contains(" or "), "{}", path("pad.dashpot"));
    let help = |name: &str| tunables().find(name).unwrap_err().help().unwrap();
    for (name, meant) in [
        ("head.thickness", "padding.thickness"),
        ("head.drop", "head.velocity"),
        ("head.speed", "head.velocity"),
    ] {
        let start = format!("did you mean `{meant}`? its numbers are ");
        assert!(help(name).starts_with(&start), "{name}: {}", help(name));
    }
    assert!(help("head.colour").starts_with("its numbers are "), "{}", help("head.colour"));
}

#[test]
fn every_name_that_is_shown_leads_to_its_number() {
    for text in [TEXT, reference()] {
        let own = Tunables::of(text, None).unwrap();
        for (at, tunable) in own.all().iter().enumerate() {
            let is_word = tunable.word.is_some();
            for name in [&tunable.name, &tunable.path] {
                assert_eq!(own.find_one(name, is_word), Ok(at), "{name}");
            }
        }
    }
}

#[test]
fn the_text_is_that_of_the_scene_with_the_value_in_its_place() {
    let own = tunables();
    let at = own.find("padding.parallel.dashpot").unwrap();
    let speed = own.find("velocity").unwrap();
    let text = own.text_with(&[(speed, "5 m/s".to_owned()), (at, "8 kN s/m".to_owned())]);
    let expected = TEXT.replace("dashpot = 4000", "dashpot = \"8 kN s/m\"");
    assert_eq!(text, expected.replace("\"10 m/s\"", "\"5 m/s\""));
    assert!(read(&text, &ReadOptions::default()).is_ok());
}

#[test]
fn variations_are_held_to_the_dimension_of_the_number() {
    let own = tunables();
    let matched = |texts: &[&str]| {
        let mut all: Vec<Variation> =
            texts.iter().map(|text| Variation::parse(text).unwrap()).collect();
        own.matched(&mut all, BareNumbers::Silent).map_err(|fault| fault.to_string())
    };
    assert!(matched(&["K2=5..30 MN/m", "head.mass=1..2"]).is_ok());
    let fault = matched(&["K2=5..30 mm"]).unwrap_err();
    assert!(fault.contains("is in m, the value in the scene in N/m"), "{fault}");
    let fault = matched(&["padding.thickness=20..40"]).unwrap_err();
    assert_eq!(
        fault,
        "`padding.thickness=20..40` has no unit: a bare number is in m, and the scene says 2 cm"
    );
    let bare = Variation::parse("padding.thickness=20..40,5,log").unwrap();
    let help = own.matched(&mut [bare], BareNumbers::Silent).unwrap_err().help();
    let expected = "write \"padding.thickness=20..40 cm\", or with `m` if that is meant";
    assert_eq!(help.as_deref(), Some(expected));
    assert!(matched(&["padding.parallel.dashpot=1..2"]).is_ok(), "bare in the scene");
    let fault = matched(&["K2=5..30 MN/m", "values.K2=1..2 MN/m"]).unwrap_err();
    assert!(fault.contains("are the same number"), "{fault}");
}

#[test]
fn g_is_standard_gravity_where_an_acceleration_varies() {
    let text = "[effects]\ngravity = { value = \"1 g\" }\n[nodes]\nhead = { mass = \"20 g\" }\n";
    let own = Tunables::of(text, None).unwrap();
    let mut all = ["gravity.value=1..3 g,3", "head.mass=10..30 g,3"]
        .map(|own| Variation::parse(own).unwrap());
    let found = own.matched(&mut all, BareNumbers::Silent).unwrap();
    assert!((own.all()[found[0]].value - 9.80665).abs() < 1e-12);
    assert!((all[0].values[1] - 19.6133).abs() < 1e-12, "{:?}", all[0].values);
    assert!((all[1].values[1] - 0.02).abs() < 1e-15, "{:?}", all[1].values);
}

/// Every number of every shipped scene, a little larger, and a set one besides: read from the parsed text it is the
/// scene of the text in which it is written, and so is what is refused.
#[test]
fn a_scene_filled_with_values_is_that_of_its_text() {
    let set = [("run.duration".to_owned(), "7 ms".to_owned())];
    for shipped in crate::templates().iter().chain(crate::references()) {
        let own = Tunables::of(shipped.text, None).unwrap();
        for (at, tunable) in own.all().iter().enumerate() {
            let number = own.written(at).0.split(' ').next().and_then(|own| own.parse().ok());
            let values: Vec<String> = match (&tunable.word, number) {
                (Some(word), _) => vec![word.clone(), "no such word".to_owned()],
                (None, number) => [1.0625, -2.0]
                    .map(|factor: f64| {
                        format!("{:e} {}", factor * number.unwrap_or(3.0), tunable.unit)
                    })
                    .map(|own| own.trim_end().to_owned())
                    .into(),
            };
            for value in values {
                for set in [&set[..], &[]] {
                    let options = ReadOptions { set, ..ReadOptions::default() };
                    let change = [(at, value.clone())];
                    let filled = own.posed(&change, &options);
                    let written = crate::pose(&own.text_with(&change), &options);
                    match (&filled, &written) {
                        (Ok(filled), Ok(written)) => assert!(filled.is_solved_as(written)),
                        (Err(filled), Err(written)) => {
                            let told = |own: &Diagnostics| {
                                own.list.iter().map(crate::Diagnostic::message).collect::<Vec<_>>()
                            };
                            assert_eq!(told(filled), told(written), "{}: {value}", tunable.path);
                        }
                        _ => panic!("{} {value}: {filled:?} {written:?}", tunable.path),
                    }
                }
            }
        }
    }
}

#[test]
fn what_is_set_by_a_path_through_a_word_is_set_where_the_word_leads() {
    const MODELS: &str = "[models]\nsoft = { spring = \"40 kN/m\" }\nhard = { spring = \"140 kN/m\" }\n\
        [nodes]\nhead = { mass = \"5 kg\", velocity = \"3 m/s\" }\n\
        [elements]\npad = { between = [\"head\", \"ground\"], model = \"soft\" }\n[run]\nduration = \"40 ms\"\n";
    let own = Tunables::of(MODELS, None).unwrap();
    let set = [("pad.spring".to_owned(), "777 kN/m".to_owned())];
    let options = ReadOptions { set: &set, ..ReadOptions::default() };
    let hard = [(own.anything("pad.model").unwrap(), "hard".to_owned())];
    let filled = own.posed(&hard, &options).unwrap();
    assert!(filled.is_solved_as(&crate::pose(&own.text_with(&hard), &options).unwrap()));
    let unset = own.posed(&hard, &ReadOptions::default()).unwrap();
    assert!(!filled.is_solved_as(&unset));
}
