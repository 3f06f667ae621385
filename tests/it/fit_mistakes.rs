//! What a new user of `fit` trips over first: each is refused, or told, with what to write in its place.

use std::{fmt::Write as _, fs};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, out, run};

const SCENE: &str = "[values]\nK = \"100 kN/m\"\n[nodes]\nhead = { mass = \"4 kg\", velocity = \"2 m/s\" }\n\
     [elements]\npad = { between = [\"head\", \"ground\"], spring = \"K\" }\n[effects]\n\
     separation.pad = { at = \"head\" }\n[run]\nduration = \"40 ms\"\n";

/// Stiffness \[N/m\] of the pad of the records.
const STIFFNESS: f64 = 60e3;

/// The blow of 4 kg at 2 m/s on a spring, 3 ms late, with a sign.
fn blow(sign: f64) -> String {
    let omega: f64 = (STIFFNESS / 4.0).sqrt();
    let row = |at: u32| {
        let time = 1e-4 * f64::from(at);
        let place = omega * (time - 3e-3);
        let inside = (0.0..=std::f64::consts::PI).contains(&place);
        let value = if inside { sign * 2.0 * omega * place.sin() } else { 0.0 };
        format!("{:.1},{value:.6}\n", 1e3 * time)
    };
    "t [ms],acc [m/s^2]\n".to_owned() + &(0..350).map(row).collect::<String>()
}

/// A ramp and a hold on a spring beside two Maxwell elements, in closed form.
fn held(ramp: f64, depth: f64) -> String {
    let branches = [(60e3, 0.05), (20e3, 2.0)];
    let row = |at: u32| {
        let time = 0.05 * f64::from(at);
        let speed = depth / ramp;
        let way = depth * (time / ramp).min(1.0);
        let force = |(stiffness, tau): (f64, f64)| {
            let grown = -(-time.min(ramp) / tau).exp_m1();
            stiffness * speed * tau * grown * (-(time - ramp).max(0.0) / tau).exp()
        };
        let all: f64 = branches.into_iter().map(force).sum::<f64>() + 30e3 * way;
        format!("{time:.3},{:.9},{all:.9}\n", 1e3 * way)
    };
    "t [s],way [mm],force [N]\n".to_owned() + &(0..201).map(row).collect::<String>()
}

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let own = Self(TempDir::new().unwrap());
        for (name, text) in [
            ("pad.toml", SCENE.to_owned()),
            ("drop.csv", blow(1.0)),
            ("turned.csv", blow(-1.0)),
            ("pressed.csv", "way [mm],force [N]\n0,0\n1,60\n2,120\n1,60\n".to_owned()),
            ("fast.csv", held(0.1, 0.005)),
            ("slow.csv", held(1.0, 0.01)),
        ] {
            fs::write(own.0.path().join(name), text).unwrap();
        }
        own
    }

    fn at(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    /// The exit code and all words of a fit of the scene.
    fn fit(&self, to: &str, rest: &[&str]) -> (i32, String) {
        let (scene, to) = (self.at("pad.toml"), self.at(to));
        let found = run(&[&["fit", &scene, "--to", &to], rest].concat());
        let text = out(&found) + &err(&found);
        (code(&found), text.split_whitespace().collect::<Vec<_>>().join(" "))
    }
}

#[test]
fn what_is_asked_for_wrongly_is_refused_with_what_to_write() {
    let folder = Folder::new();
    let range = ["--vary", "K=5..500 kN/m"];
    for (to, rest, word) in [
        ("pressed.csv:force=pad.force", range, "pressed.csv:force=pad,rate=10 mm/min"),
        ("drop.csv:acc=head.acceleration,rate=10 mm/min", range, "a model alone is pressed"),
        ("drop.csv:acc=head.acceleration", ["--vary", "K"], "\"K=10..1000 kN/m\""),
        ("drop.csv:acc=head.acceleration", ["--vary", "K=5..500 kN/m,26,log"], "wants bounds"),
        ("drop.csv:acc=head.acceleration", ["--vary", "K=5,10 kN/m"], "wants bounds"),
    ] {
        let (status, text) = folder.fit(to, &rest);
        assert_eq!(status, 2, "{to} {rest:?}: {text}");
        assert!(text.contains(word), "{to} {rest:?}: {text}");
    }
    let (status, text) = folder.fit("pressed.csv:force=models.pad,rate=10 mm/min", &range);
    assert!(status == 2 && text.contains("models.pad"), "{text}");
}

#[test]
fn a_column_of_the_other_sign_is_told_first() {
    let folder = Folder::new();
    let range = ["--vary", "K=5..500 kN/m"];
    let (status, text) = folder.fit("turned.csv:acc=head.acceleration", &range);
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("is negative, and `head.acceleration` is positive: turn"), "{text}");
    let (_, text) = folder.fit("drop.csv:acc=head.acceleration", &range);
    assert!(!text.contains("turn the sign"), "{text}");
}

#[test]
fn a_zero_that_rows_before_the_impact_contradict_is_told() {
    // The record is that of 2 m/s, and the scene says 1 m/s: the zero makes up for the impulse.
    let folder = Folder::new();
    let scene = SCENE.replace("2 m/s", "1 m/s");
    fs::write(folder.0.path().join("pad.toml"), scene).unwrap();
    let omega = 400e3_f64.sqrt() / 2.0;
    let mut rows = "t [s],acc [m/s^2]\n".to_owned();
    for at in 0..240 {
        let time = f64::from(at - 40) / 20e3;
        let inside = (0.0..=std::f64::consts::PI).contains(&(omega * time));
        let value = if inside { 2.0 * omega * (omega * time).sin() } else { 0.0 };
        _ = writeln!(rows, "{time:.6},{value:.4}");
    }
    fs::write(folder.0.path().join("other.csv"), rows).unwrap();
    let range = ["--vary", "K=5..5000 kN/m"];
    let (status, text) = folder.fit("other.csv:acc=head.acceleration", &range);
    assert_eq!(status, 0, "{text}");
    let told = "rows before the impact read 0 g where nothing happens, and the fitted zero is ";
    assert!(text.contains(told), "{text}");
    assert!(text.contains("not identified") && !text.contains('±'), "{text}");
    fs::write(folder.0.path().join("pad.toml"), SCENE).unwrap();
    let (_, text) = folder.fit("drop.csv:acc=head.acceleration", &range);
    assert!(!text.contains("the fitted zero is"), "{text}");
}

#[test]
fn a_scale_turns_the_sign_of_a_column() {
    let folder = Folder::new();
    let range = ["--vary", "K=5..500 kN/m", "--json"];
    let fitted = |to: &str| {
        let (status, text) = folder.fit(to, &range);
        assert_eq!(status, 0, "{text}");
        let end = text.rfind('}').map_or(0, |at| at + 1);
        serde_json::from_str::<Value>(&text[..end]).unwrap()["parameters"]["K"].clone()
    };
    let right = fitted("drop.csv:acc=head.acceleration");
    assert_eq!(fitted("turned.csv:acc=head.acceleration,scale=-1"), right);
    let (status, text) = folder.fit("turned.csv:acc=head.acceleration,scale=x", &range);
    assert!(status == 2 && text.contains("a scale is a number"), "{text}");
    // Of a model alone the answer is scaled, and not what was done.
    let alone = |to: &str| fitted_stiffness(&folder, to);
    let [one, other] = ["fast.csv:force=pad", "fast.csv:force=pad,scale=2"].map(alone);
    assert!((other / one - 2.0).abs() < 1e-6, "{one} {other}");
}

fn fitted_stiffness(folder: &Folder, to: &str) -> f64 {
    let own = crate::cli::json(&["fit", "--to", &folder.at(to), "--json"]);
    own["spring"].as_f64().unwrap()
}

#[test]
fn a_table_in_the_place_of_a_scene_is_told() {
    let folder = Folder::new();
    for verb in ["fit", "run", "check"] {
        let found = run(&[verb, &folder.at("drop.csv")]);
        let text = err(&found);
        assert!(code(&found) == 2 && text.contains("it is a table"), "{text}");
        assert!(text.contains("--to") && !text.contains("TOML parse"), "{text}");
    }
}

#[test]
fn accelerations_are_in_one_unit() {
    let folder = Folder::new();
    let (_, text) = folder.fit("drop.csv:acc=head.acceleration", &["--vary", "K=5..500 kN/m"]);
    assert!(text.contains(" g ") && !text.contains("m/s²") && !text.contains("m/s^2"), "{text}");
}

#[test]
fn a_clipped_record_identifies_nothing() {
    let folder = Folder::new();
    let whole = blow(1.0);
    let most = 2.0 * (STIFFNESS / 4.0).sqrt() * 0.6;
    let clipped = whole.lines().enumerate().map(|(at, line)| match line.split_once(',') {
        Some((time, value)) if at > 0 => {
            format!("{time},{:.6}\n", value.parse::<f64>().unwrap().min(most))
        }
        _ => format!("{line}\n"),
    });
    fs::write(folder.0.path().join("clipped.csv"), clipped.collect::<String>()).unwrap();
    let range = ["--vary", "K=5..500 kN/m"];
    let (status, text) = folder.fit("clipped.csv:acc=head.acceleration", &range);
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("the record is clipped") && !text.contains('±'), "{text}");
    // That is the reason why there are no bands, before that the model misses it.
    assert!(text.contains("a record is clipped"), "{text}");
    let (_, text) = folder.fit("drop.csv:acc=head.acceleration", &range);
    assert!(!text.contains("clipped"), "{text}");
}

#[test]
fn like_parts_that_change_places_are_no_other_minimum() {
    let folder = Folder::new();
    let other = format!("{}:force=pad", folder.at("slow.csv"));
    let (status, text) =
        folder.fit("fast.csv:force=pad", &["--among", "pad=prony", "--to", &other, "--json"]);
    assert_eq!(status, 0, "{text}");
    let end = text.rfind('}').map_or(0, |at| at + 1);
    let own: Value = serde_json::from_str(&text[..end]).unwrap();
    assert_eq!(own["others"].as_array().unwrap().len(), 0, "{}", own["others"]);
    let value = |name: &str| own["parameters"][name]["value"].as_f64().unwrap();
    let mut branches = [("pad.k1", "pad.c1"), ("pad.k2", "pad.c2")]
        .map(|(spring, dashpot)| (value(spring), value(dashpot)));
    branches.sort_by(|one, other| one.0.total_cmp(&other.0));
    let right = [(20e3, 40e3), (60e3, 3e3)];
    for (found, right) in branches.into_iter().zip(right) {
        assert!((found.0 / right.0 - 1.0).abs() < 1e-3, "{branches:?}");
        assert!((found.1 / right.1 - 1.0).abs() < 1e-3, "{branches:?}");
    }
    assert!((value("pad.k") / 30e3 - 1.0).abs() < 1e-4, "{}", value("pad.k"));
}

#[test]
fn what_a_scene_leaves_out_is_told_where_it_is_set() {
    let folder = Folder::new();
    let found = run(&["run", &folder.at("pad.toml"), "--set", "pad.thickness=20 mm"]);
    let text = err(&found).split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(code(&found), 2, "{text}");
    assert!(text.contains("to give `pad` a `thickness`, write it there first"), "{text}");
}
