//! Run, accuracy, measures, values.

use dashpot_dae::Direction;

use super::{messages, on_model, read_text, scene};
use crate::{ReadOptions, read};

fn is_close(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 1e-14 * expected.abs()
}

#[test]
fn defaults_are_those_of_the_documentation() {
    let read = scene(&on_model("spring = 1"));
    assert_eq!((read.run.samples, read.run.methods.as_slice()), (501, &["auto".to_owned()][..]));
    assert!(read.run.stops.is_empty() && read.run.rtol.is_none() && read.title.is_none());
    assert!((read.accuracy.default - 1e-3).abs() < 1e-18 && read.measures.is_empty());
}

#[test]
fn wishes_are_read_in_both_forms() {
    let text = format!(
        "title = \"t\"\n{}methods = [\"exact\", \"bdf\"]\nrtol = 1e-8\n\
         stop = [{{ when = \"pad.force\", falls-below = \"2 kN\" }}, \
         {{ when = \"head.position\", rises-above = \"3 mm\" }}]\n\
         [accuracy]\ndefault = \"1 %\"\npad.peak-force = 0.02\n\"head.hic15\" = \"3 %\"\n\
         [measures]\nhead = [\"hic15\", {{ kind = \"severity-index\", window = [0, \"5 ms\"] }}]\n\
         pad = \"peak-rate\"\n",
        on_model("spring = 1")
    );
    let read = scene(&text);
    assert_eq!(read.run.methods, ["exact", "bdf"]);
    assert_eq!(read.run.rtol, Some(1e-8));
    let stops = &read.run.stops;
    assert_eq!((stops[0].output.as_str(), stops[0].level), ("pad.force", 2e3));
    assert_eq!((stops[1].level, stops[1].direction), (3e-3, Direction::Rising));
    assert!(is_close(read.accuracy.of("pad.peak-force"), 0.02));
    assert!(is_close(read.accuracy.of("head.hic15"), 0.03));
    assert!(is_close(read.accuracy.of("head.peak-acceleration"), 0.01));
    let kinds: Vec<_> =
        read.measures.iter().map(|wish| (wish.target.as_str(), wish.measure.kind())).collect();
    assert_eq!(kinds, [("head", "hic15"), ("head", "severity-index"), ("pad", "peak-rate")]);
}

#[test]
fn what_may_be_left_out_is_a_share() {
    let read = |value: &str| {
        read_text(&format!("{}[accuracy]\nneglect-below = {value}\n", on_model("spring = 1")))
    };
    let bound = |value: &str| read(value).unwrap().value.accuracy.neglect_below;
    assert_eq!(scene(&on_model("spring = 1")).accuracy.neglect_below, None);
    assert!(is_close(bound("\"0.5 %\"").unwrap(), 0.005));
    assert!(is_close(bound("0.2").unwrap(), 0.2));
    for value in ["0", "\"-1 %\"", "\"21 %\"", "1", "\"2 mm\"", "true"] {
        assert!(read(value).is_err(), "{value}");
    }
}

#[test]
fn named_values_are_overridden_from_outside() {
    let text = format!("[values]\nK = \"20 MN/m\"\nL = \"K\"\n{}", on_model("spring = \"L\""));
    let set = |name: &str, value: &str| {
        let set = [(name.to_owned(), value.to_owned())];
        read(&text, &ReadOptions { set: &set, ..ReadOptions::default() })
    };
    let stiffness = |read: &crate::Scene| super::shape(&read.network.connections()[0].model);
    assert_eq!(stiffness(&scene(&text)), ["0  spring [Number(20000000.0)]"]);
    let changed = set("K", "25 MN/m").unwrap().value;
    assert_eq!(stiffness(&changed), ["0  spring [Number(25000000.0)]"]);
    assert!(is_close(changed.values[0].value, 2.5e7));
    assert_eq!(stiffness(&set("L", "7").unwrap().value), ["0  spring [Number(7.0)]"]);
    let shown = set("KK", "1").unwrap_err().render(false);
    assert!(shown.contains("there is no value named `KK`"), "{shown}");
    assert!(shown.contains("known values: K, L"), "{shown}");
    let shown = set("K", "25 MNm").unwrap_err().render(false);
    assert!(shown.contains("--set:1:3") && shown.contains("did you mean `MN m`?"), "{shown}");
}

#[test]
fn a_reversed_element_is_warned_of_at_its_ends() {
    let text = "[nodes]\nhead = { mass = 1, velocity = 1 }\npanel = { mass = 1 }\n[elements]\n\
                pad = { between = [\"panel\", \"head\"], spring = 1 }\n\
                mount = { between = [\"panel\", \"ground\"], spring = 1 }\n[run]\nduration = 1\n";
    let shown = read_text(text).unwrap().warnings.render(false);
    assert!(shown.starts_with("warning: `pad` looks reversed"), "{shown}");
    assert!(shown.contains("scene.toml:5:19"), "{shown}");
}

#[test]
fn what_a_stop_watches_must_exist() {
    let with = |stop: &str| format!("{}stop = [{{ {stop} }}]\n", on_model("spring = 1"));
    let shown = messages(&with("when = \"pad.forse\", falls-below = 0"));
    assert!(shown.contains("did you mean `pad.force`?"), "{shown}");
    let shown = messages(&with("when = \"pat.force\", falls-below = 0"));
    assert!(shown.contains("did you mean `pad`?"), "{shown}");
    let shown = messages(&with("when = \"pad.force\", falls-below = \"1 mm\""));
    assert!(shown.contains("a force (N) is expected here"), "{shown}");
    assert!(messages(&with("when = \"pad.force\"")).contains("`falls-below` or `rises-above`"));
}

#[test]
fn measures_are_asked_of_what_effects_put_there() {
    let text = |rest: &str| {
        let effects = "[effects]\nseparation.pad = {}\nface.pad = { mass = 0.1 }\n\
                       stop.pad = { at = \"5 mm\", stiffness = \"1 MN/m\" }\n";
        format!("{}{effects}{rest}", on_model("spring = 1"))
    };
    let asked = |read: &crate::Scene| -> Vec<String> {
        read.measures
            .iter()
            .map(|measure| format!("{}.{}", measure.target, measure.measure.kind()))
            .collect()
    };
    for stop in ["\"pad.stop\"", "pad.stop"] {
        let read = scene(&text(&format!(
            "[measures]\n{stop} = [\"peak-rate\", {{ kind = \"impulse\", window = \"run\" }}]\n\
             \"pad.face\" = \"hic15\"\npad.contact = \"peak-rate\"\n\
             head = {{ kind = \"transmissibility\", from = \"pad.face\" }}\n\
             [accuracy]\npad.peak-force = 0.02\n{stop}.peak-force = 0.03\n\
             \"pad.face.hic15\" = 0.04\n"
        )));
        let mut found = asked(&read);
        found.sort();
        let wanted = [
            "head.transmissibility",
            "pad.contact.peak-rate",
            "pad.face.hic15",
            "pad.stop.impulse",
            "pad.stop.peak-rate",
        ];
        assert_eq!(found, wanted);
        for (key, wish) in
            [("pad.peak-force", 0.02), ("pad.stop.peak-force", 0.03), ("pad.face.hic15", 0.04)]
        {
            assert!(is_close(read.accuracy.of(key), wish), "{key}");
        }
    }
    let said = |rest: &str| messages(&text(rest));
    let found = said("[measures]\npad.stpo = [\"peak-force\"]\n");
    assert!(found.contains("no element or node named `pad.stpo`"), "{found}");
    let found = said("[measures]\npad.stop = [\"hic15\"]\n");
    assert!(found.contains("`hic15` is not a measure of an element"), "{found}");
    let found = said("[accuracy]\npad.stop.hic15 = 0.01\n");
    assert!(found.contains("`hic15` is not a measure of an element"), "{found}");
    let found = said("[measures]\npad = { window = \"run\" }\n");
    assert!(found.contains("this measure of `pad` has no `kind`"), "{found}");
    // Without the effect there is nothing of the name.
    let found =
        messages(&format!("{}[measures]\n\"pad.stop\" = \"impulse\"\n", on_model("spring = 1")));
    assert!(found.contains("no element or node named `pad.stop`"), "{found}");
}

#[test]
fn an_accuracy_of_no_measure_is_told_what_is_missing() {
    for name in ["pad", "head"] {
        let text = format!("{}[accuracy]\n{name} = \"1 %\"\n", on_model("spring = 1"));
        let shown = messages(&text);
        assert!(shown.contains(&format!("the accuracy of `{name}` is a table")), "{shown}");
        assert!(shown.contains("default"), "{shown}");
    }
}
