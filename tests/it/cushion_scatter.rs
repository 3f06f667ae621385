//! Cushion curves of scenes with scatter, against the closed form of a linear cushion: G = 1 + √(1 + 2 E h/(σ t)).

use dashpot::numerics::normal::quantile;
use serde_json::Value;
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, text},
    design_answers::squeezed,
};

const G0: f64 = 9.80665;
const MODULUS: f64 = 4e5;
const HEIGHT: f64 = 0.6;
const THICKNESS: f64 = 0.05;
/// The accuracy of values whose errors are not estimated, which is far better for a linear scene.
const SOLVED: f64 = 1e-9;

/// A linear cushion with this spring, parcel and thickness.
fn scene(spring: &str, parcel: &str, thickness: &str, more: &str) -> String {
    format!(
        "[materials.foam]\nspring = \"{spring}\"\n[nodes]\nparcel = {{ {parcel} }}\n[elements]\n\
         cushion = {{ between = [\"parcel\", \"ground\"], material = \"foam\", thickness = \"{thickness}\", area = \
         \"400 cm^2\" }}\n[effects]\ngravity = {{}}\nseparation.cushion = {{}}\n[run]\nduration = \"0.6 s\"\n{more}"
    )
}

const PARCEL: &str = "mass = \"8 kg\", drop = \"60 cm\"";

fn peak(modulus: f64, height: f64, stress: f64, thickness: f64) -> f64 {
    G0 * (1.0 + (1.0 + 2.0 * modulus * height / (stress * thickness)).sqrt())
}

/// The peak where a standard normal deviate and the static stress are these.
type PeakAt<'p> = &'p dyn Fn(f64, f64) -> f64;

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap()
}

/// Of 100 designs of a Latin hypercube one lies in each hundredth of the distribution: the third one from below, which
/// is the value for 2.5 %, between 2 % and 3 %. What rises with the number is between the same bounds.
fn check_bands(own: &Value, peak_at: PeakAt<'_>) {
    let curve = &own["curves"][0];
    let stresses = curve["stress"].as_array().unwrap().iter().map(number);
    for (at, stress) in stresses.enumerate() {
        let bands = &curve["bands"];
        assert_eq!(bands["without"][at], 0);
        for (end, shares) in [("low", [0.02, 0.03]), ("high", [0.97, 0.98])] {
            let [first, second] = shares.map(|share| peak_at(quantile(share), stress));
            let (least, most) = (first.min(second), first.max(second));
            let found = number(&bands[end][at]);
            assert!(
                found > least * (1.0 - SOLVED) && found < most * (1.0 + SOLVED),
                "{end} at {stress}: {found}, not from {least} to {most}"
            );
        }
    }
}

#[test]
fn bands_are_the_quantiles_of_the_closed_form() {
    let folder = TempDir::new().unwrap();
    let ranges = ["--stress", "1..8 kPa,6,log", "--thickness", "5 cm", "--json"];
    let together = "[scatter]\ntogether = [{ \"foam.spring\" = \"10 %\" }]\n";
    let normal = |z: f64| 1.0 + 0.1 * z;
    let spring = "0.4 MPa ± 10 %";
    let stiff: PeakAt<'_> = &|z, stress| peak(MODULUS * normal(z), HEIGHT, stress, THICKNESS);
    let logs: PeakAt<'_> = &|z, stress| peak(MODULUS * (0.1 * z).exp(), HEIGHT, stress, THICKNESS);
    let heights: PeakAt<'_> = &|z, stress| peak(MODULUS, HEIGHT * normal(z), stress, THICKNESS);
    // A heavier parcel has a lower peak, and so has a thicker cushion.
    let masses: PeakAt<'_> = &|z, stress| peak(MODULUS, HEIGHT, stress * normal(-z), THICKNESS);
    let thick: PeakAt<'_> = &|z, stress| peak(MODULUS, HEIGHT, stress, THICKNESS - 0.004 * z);
    let cases = [
        (scene(spring, PARCEL, "5 cm", ""), stiff),
        (scene("0.4 MPa", PARCEL, "5 cm", together), logs),
        (scene("0.4 MPa", "mass = \"8 kg\", drop = \"60 ± 6 cm\"", "5 cm", ""), heights),
        (scene("0.4 MPa", "mass = \"8 ± 0.8 kg\", drop = \"60 cm\"", "5 cm", ""), masses),
        (scene("0.4 MPa", PARCEL, "5 ± 0.4 cm", ""), thick),
    ];
    for (at, (scene, peak_at)) in cases.into_iter().enumerate() {
        let path = file(&folder, "linear.toml", &scene);
        let own = json(&[&["cushion", text(&path)][..], &ranges].concat());
        println!("{at}: {} {}", own["scatter"], own["work"]);
        check_bands(&own, peak_at);
        assert_eq!(own["scatter"]["designs"], 100);
        let best = &own["curves"][0]["best_band"];
        assert_eq!(best["low"], own["curves"][0]["bands"]["low"][5], "the last stress is the best");
        // The curve itself is that of the means.
        let means = number(&own["curves"][0]["peak"][3]);
        let stress = number(&own["curves"][0]["stress"][3]);
        assert!((means / peak(MODULUS, HEIGHT, stress, THICKNESS) - 1.0).abs() < SOLVED);
    }
}

#[test]
fn the_thinnest_cushion_says_how_sure_it_is_and_which_one_is() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "linear.toml", &scene("0.4 MPa ± 10 %", PARCEL, "5 cm", ""));
    let asked = ["--thickness", "2..14 cm,5", "--stress", "2..4 kPa,3", "--limit", "50 g"];
    let asked = [&["cushion", text(&path), "--over", "2..4 kPa"][..], &asked].concat();
    let own = json(&[&asked[..], &["--json"]].concat());
    let thinnest = &own["thinnest"][0];
    // The least stress is the worst one: t = 2 E h/(σ ((G − 1)² − 1)) is proportional to E.
    let thickness = number(&thinnest["thickness"]);
    let right = 2.0 * MODULUS * HEIGHT / (2e3 * (49.0_f64.powi(2) - 1.0));
    assert!((thickness / right - 1.0).abs() < 1e-4, "{thickness} {right}");
    // So half of the designs keep the limit there: those with no more than the mean.
    let sure = &thinnest["sure"];
    let kept = sure["odds"]["kept"].as_u64().unwrap();
    assert!((49..=51).contains(&kept) && sure["odds"]["exceeded"] == 100 - kept, "{sure}");
    // The 95th of 100 lies between 94 % and 95 % of the distribution.
    let enough = number(&sure["thickness"]);
    let [low, high] = [0.94, 0.95].map(|share| right * (1.0 + 0.1 * quantile(share)));
    let nearest = 2e-4 * 0.14;
    assert!(enough > low - nearest && enough < high + nearest, "{enough}: {low} to {high}");
    let said = squeezed(&out(&run(&asked)));
    assert!(
        said.contains("they keep 50.0 g with a probability of 50 % (40.4 to 59.6 %)"),
        "{said}"
    );
    assert!(said.contains("keep it with 95.0 %") && said.contains("95 % of designs"), "{said}");
    assert!(said.contains("foam.spring = 0.4 ± 0.04 MPa"), "{said}");
    // A larger part takes more, and what nothing keeps is told.
    let more = json(&[&asked[..], &["--json", "--robust", "99%"]].concat());
    assert!(number(&more["thinnest"][0]["sure"]["thickness"]) > enough);
    let few = [&asked[..2], &["--over", "2..4 kPa", "--limit", "50 g", "--thickness", "2,10.5 cm"]];
    let few = json(&[&few.concat()[..], &["--json"]].concat());
    assert!(few["thinnest"][0]["sure"]["thickness"].is_null(), "{}", few["thinnest"]);
}

#[test]
fn without_scatter_nothing_is_drawn_and_nothing_else_changes() {
    let folder = TempDir::new().unwrap();
    let of = |name, spring| {
        let path = file(&folder, name, &scene(spring, PARCEL, "5 cm", ""));
        json(&["cushion", text(&path), "--stress", "1..8 kPa,6,log", "--json"])
    };
    let (own, with) = (of("plain.toml", "0.4 MPa"), of("scattered.toml", "0.4 MPa ± 10 %"));
    assert!(own["scatter"].is_null() && own["curves"][0]["bands"].is_null());
    assert_eq!(own["work"]["scattered"], 0);
    assert_eq!(own["curves"][0]["peak"], with["curves"][0]["peak"]);
    // Six stresses and the best one.
    assert_eq!(with["work"]["scattered"], 700);
    assert_eq!(with["work"]["scattered_instantiated"], 700);
}

#[test]
fn a_band_ends_where_a_design_leaves_what_is_known_and_is_drawn_and_written() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "linear.toml", &scene("60 kPa ± 10 %", PARCEL, "5 cm", ""));
    let curves = folder.path().join("curves");
    let asked = ["cushion", text(&path), "--stress", "0.5..3 kPa,12,log"];
    let own = json(&[&asked[..], &["--json"]].concat());
    let curve = &own["curves"][0];
    let without: Vec<f64> =
        curve["bands"]["without"].as_array().unwrap().iter().map(number).collect();
    // Pressed through: y/t = G σ/E > 1.
    let strain = |modulus: f64, stress: f64| {
        peak(modulus, HEIGHT, stress, THICKNESS) / G0 * stress / modulus
    };
    let designs = |stress: f64| {
        let through =
            |at: &f64| strain(6e4 * (1.0 + 0.1 * quantile((at + 0.5) / 100.0)), stress) > 1.0;
        (0..100).map(f64::from).filter(through).count() as f64
    };
    for (stress, without) in curve["stress"].as_array().unwrap().iter().zip(&without) {
        // The design on the border may be either.
        assert!((without - designs(number(stress))).abs() <= 1.0, "{stress} {without}");
    }
    assert!(without.contains(&0.0) && without.contains(&100.0), "{without:?}");
    let output = run(&[&asked[..], &["--out", text(&curves)]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(out(&output).lines().all(|line| line.chars().count() <= 80), "{}", out(&output));
    assert!(squeezed(&out(&output)).contains("no band is told there"), "{}", out(&output));
    let svg = std::fs::read_to_string(curves.join("cushion-600mm.svg")).unwrap();
    assert!(svg.contains("areas: 95 %"));
    let table = std::fs::read_to_string(curves.join("cushion.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(header.ends_with(
        "2.5 % of designs [m/s^2],97.5 % of designs [m/s^2],designs beyond what is known [1]"
    ));
    assert!(table.lines().all(|line| line.split(',').count() == 10), "{table}");
}
