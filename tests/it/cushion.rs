//! Cushion curves: what the command prints and writes, its closed forms, and the stress–energy method.

use serde_json::Value;
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, text},
    design_answers::squeezed,
};

const G0: f64 = 9.80665;

/// A parcel on a cushion of this material; `{}` of the rest of its effects.
fn scene(material: &str, effects: &str) -> String {
    format!(
        "[materials]\nfoam = {material}\n\n[nodes]\nparcel = {{ mass = \"8 kg\", drop = \"60 cm\" }}\n\n[elements]\n\
         cushion = {{ between = [\"parcel\", \"ground\"], material = \"foam\", thickness = \"5 cm\", area = \"400 cm^2\" \
         }}\n\n[effects]\ngravity = {{}}\nseparation.cushion = {{}}\n{effects}\n[run]\nduration = \"0.6 s\"\n"
    )
}

/// The foam of the chapter on cushions, which knows no rate, and a dashpot beside it.
fn foam(folder: &TempDir, damping: &str) -> String {
    let table = folder.path().join("foam.csv");
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/data/cushion-foam.csv"), &table)
        .unwrap();
    let table = "{ table-spring = \"foam.csv\" }".to_owned();
    if damping.is_empty() {
        table
    } else {
        format!("{{ parallel = [{table}, {{ dashpot = \"{damping}\" }}] }}")
    }
}

const ALL: [&str; 6] =
    ["--heights", "30,60,90 cm", "--thickness", "2..10 cm,5", "--stress", "1..20 kPa,40,log"];

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|own| own.as_f64().unwrap_or(f64::NAN)).collect()
}

#[test]
fn the_curve_of_a_linear_cushion_is_its_closed_form_in_the_command_too() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "linear.toml", &scene("{ spring = \"0.4 MPa\" }", ""));
    let own = json(&[&["cushion", text(&path), "--json"], &ALL[..]].concat());
    let curves = own["curves"].as_array().unwrap();
    assert_eq!(curves.len(), 15);
    for curve in curves {
        let [height, thickness] = ["height", "thickness"].map(|own| curve[own].as_f64().unwrap());
        let [stress, peak] = ["stress", "peak"].map(|own| numbers(&curve[own]));
        assert_eq!(stress.len(), 40);
        for (stress, peak) in stress.iter().zip(&peak) {
            let right = 1.0 + (1.0 + 2.0 * 4e5 * height / (stress * thickness)).sqrt();
            assert!((peak / (right * G0) - 1.0).abs() < 1e-10, "{height} {thickness} {stress}");
        }
        let floor = curve["floor"].as_f64().unwrap();
        assert!((floor / (G0 * (1.0 + height / thickness)) - 1.0).abs() < 1e-9);
    }
    // All are instantiated.
    assert_eq!((&own["work"]["points"], &own["work"]["instantiated"]), (&600.into(), &600.into()));
    // At most two searches for each curve, one of which halves.
    assert!(own["work"]["probes"].as_u64().unwrap() <= 15 * 50, "{}", own["work"]);
}

#[test]
fn thicknesses_of_a_measured_curve_are_one_compiled_form() {
    let folder = TempDir::new().unwrap();
    let stop = "stop.cushion = { at = \"1.8 cm\", stiffness = \"2 MN/m\" }\n";
    // Three for each stretch of drops of one kind within a group of 64, and those beside its ends, where groups are halved.
    for (effects, estimated) in [("", 214), (stop, 143)] {
        let path = file(&folder, "foam.toml", &scene(&foam(&folder, ""), effects));
        let own = json(&[&["cushion", text(&path), "--json"], &ALL[..]].concat());
        println!("{}", own["work"]);
        let work = |key: &str| own["work"][key].as_u64().unwrap();
        let curves = own["curves"].as_array().unwrap();
        let whole: usize = curves
            .iter()
            .flat_map(|curve| curve["known"].as_array().unwrap())
            .filter(|known| **known == "whole")
            .count();
        // A drop that just comes to an end of what is known may be either.
        assert!(work("instantiated") + 4 >= whole as u64, "{whole}: {}", own["work"]);
        assert_eq!(work("estimated"), estimated, "{}", own["work"]);
        // Parabolas find a best stress in half a dozen drops.
        assert!(work("probes") <= 15 * 6, "{}", own["work"]);
    }
}

#[test]
fn a_stop_that_is_not_met_changes_nothing() {
    let folder = TempDir::new().unwrap();
    let stop = "stop.cushion = { at = \"3.5 cm\", stiffness = \"2 MN/m\" }\n";
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, "0.4 kPa s"), stop));
    let ranges = ["--heights", "60 cm", "--stress", "1..20 kPa,40,log"];
    let own = json(&[&["cushion", text(&path), "--json"], &ranges[..]].concat());
    let curve = &own["curves"][0];
    let known: Vec<&str> =
        curve["known"].as_array().unwrap().iter().map(|own| own.as_str().unwrap()).collect();
    let strains = numbers(&curve["strain"]);
    for (known, strain) in known.iter().zip(&strains) {
        assert_eq!(*known != "whole", *strain > 0.7, "{known} {strain}");
    }
    let met = known.iter().filter(|own| **own != "whole").count();
    assert!((5..35).contains(&met), "{met}");
    let instantiated = own["work"]["instantiated"].as_u64().unwrap();
    assert!(instantiated > 0 && instantiated <= 40 - met as u64, "{instantiated} {met}");
    // Each point is what a run of that scene says.
    let [stress, peak, error] = ["stress", "peak", "error"].map(|own| numbers(&curve[own]));
    for at in [5, 30] {
        let mass = format!("parcel.mass={} kg", stress[at] * 0.04 / G0);
        let one = json(&["run", text(&path), "--set", &mass, "--json"]);
        let right = &one["runs"][0]["measures"]["parcel.peak-acceleration"];
        let bar = error[at] + right["error"].as_f64().unwrap();
        let right = right["value"].as_f64().unwrap();
        assert!((peak[at] - right).abs() <= bar.max(1e-9 * right), "{at}: {} {right}", peak[at]);
    }
}

#[test]
fn curves_are_one_under_stress_energy_where_nothing_depends_on_the_rate() {
    let folder = TempDir::new().unwrap();
    for (damping, range, holds) in
        [("", 0.0..0.08, true), ("0.4 kPa s", 0.22..0.32, false), ("2 kPa s", 0.22..0.33, false)]
    {
        let path = file(&folder, "foam.toml", &scene(&foam(&folder, damping), ""));
        let ranges = ["--heights", "30,60,90 cm", "--thickness", "2..6 cm,5"];
        let stress = ["--stress", "1..20 kPa,40,log"];
        let own = json(&[&["cushion", text(&path), "--json"], &ranges[..], &stress].concat());
        let found = &own["stress_energy"];
        let scatter = found["scatter"].as_f64().unwrap();
        println!("{damping:>10}: {found}");
        assert!(range.contains(&scatter), "{damping}: {scatter}");
        assert_eq!(found["collapse"] != "fails", holds, "{damping}: {found}");
    }
}

#[test]
fn the_thinnest_cushion_keeps_the_limit_and_a_thinner_one_does_not() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, "0.4 kPa s"), ""));
    let path = text(&path);
    let asked = ["--heights", "76 cm", "--thickness", "2..14 cm,5", "--limit", "50 g"];
    let over = ["--over", "4..9 kPa"];
    let own = json(&[&["cushion", path, "--json"], &asked[..], &over].concat());
    let thinnest = own["thinnest"][0]["thickness"].as_f64().unwrap();
    let keeps = |thickness: f64| {
        let thickness = format!("{thickness} m");
        let own = ["--heights", "76 cm", "--thickness", &thickness, "--stress", "4..9 kPa,25"];
        let own = json(&[&["cushion", path, "--json"], &own[..]].concat());
        let curve = &own["curves"][0];
        let known = curve["known"].as_array().unwrap().iter().all(|own| *own == "whole");
        let bars = numbers(&curve["error"]);
        let room = |(peak, bar): (f64, &f64)| peak <= 50.0 * G0 + bar;
        known && numbers(&curve["peak"]).into_iter().zip(&bars).all(room)
    };
    let [peak, error] = ["peak", "error"].map(|key| own["thinnest"][0][key].as_f64().unwrap());
    assert!(peak + error <= 50.0 * G0 && peak + error > 49.99 * G0, "{peak} {error}");
    assert!(own["work"]["probes"].as_u64().unwrap() < 500, "{}", own["work"]);
    assert!(keeps(thinnest) && !keeps(0.99 * thinnest), "{thinnest}");
    let lightest = &own["thinnest"][0]["lightest"];
    let [volume, of, stress] =
        ["volume_per_weight", "thickness", "stress"].map(|own| lightest[own].as_f64().unwrap());
    assert!((volume * stress / of - 1.0).abs() < 1e-12 && volume <= thinnest / 4e3);
}

#[test]
fn the_lightest_cushion_does_not_depend_on_how_wide_the_range_is() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, "0.4 kPa s"), ""));
    let lightest = |over: &str| {
        let asked = ["--heights", "76 cm", "--thickness", "6 cm", "--limit", "50 g"];
        let own = [&["cushion", text(&path), "--json", "--over", over], &asked[..]].concat();
        json(&own)["thinnest"][0]["lightest"]["volume_per_weight"].as_f64().unwrap()
    };
    // The least volume of one thickness is at the largest stress that it bears.
    let all = ["4..6 kPa", "1..6 kPa", "0.5..12 kPa"].map(lightest);
    println!("{all:?}");
    let [least, most] = [f64::min, f64::max].map(|of| all.into_iter().reduce(of).unwrap());
    assert!(most / least < 1.002, "{all:?}");
}

#[test]
fn a_folder_has_a_figure_for_each_height_and_the_text_says_what_is_not_known() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, "0.4 kPa s"), ""));
    let curves = folder.path().join("curves");
    let asked = ["--heights", "30,60 cm", "--thickness", "3,6 cm", "--limit", "60 g"];
    let output = run(&[&["cushion", text(&path), "--out", text(&curves)], &asked[..]].concat());
    println!("{}{}", out(&output), err(&output));
    assert_eq!(code(&output), 0);
    assert!(out(&output).lines().all(|line| line.chars().count() <= 80));
    for name in
        ["cushion-300mm.svg", "cushion-600mm.svg", "cushion.csv", "report.html", "result.json"]
    {
        assert!(curves.join(name).is_file(), "{name}");
    }
    let svg = std::fs::read_to_string(curves.join("cushion-600mm.svg")).unwrap();
    assert!(svg.contains("static stress (kPa)") && svg.contains("limit 60 g"));
    let svg = std::fs::read_to_string(curves.join("stress-energy.svg")).unwrap();
    assert!(svg.contains("dynamic energy") && svg.contains("root mean square"));
    let table = run(&[&["cushion", text(&path), "--csv"], &asked[..]].concat());
    assert!(out(&table).starts_with("height [m],thickness [m],static stress [Pa]"));
    assert_eq!(out(&table).lines().count(), 1 + 4 * 40);
}

#[test]
fn a_limit_is_enforced_from_each_height() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, ""), ""));
    let asked =
        ["cushion", text(&path), "--enforce", "--thickness", "5 cm", "--stress", "1..4 kPa,7"];
    let with = |more: &[&str]| code(&run(&[&asked[..], more].concat()));
    assert_eq!(with(&["--heights", "30,60 cm", "--limit", "50 g"]), 0);
    assert_eq!(with(&["--heights", "30,90 cm", "--limit", "40 g"]), 4);
    assert_eq!(with(&["--heights", "60 cm", "--limit", "50 g", "--over", "1.5..2.5 kPa"]), 0);
    assert_eq!(with(&["--heights", "60 cm", "--limit", "50 g", "--over", "1.5..4 kPa"]), 4);
    assert_eq!(with(&["--heights", "60 cm"]), 2, "no limit");

    let told = |more: &[&str]| squeezed(&out(&run(&[&asked[..], more].concat())));
    let said = told(&["--heights", "30,90 cm", "--limit", "40 g"]);
    assert!(said.contains("PASS 40.0 g from 300 mm: 50 mm keep it at 1.00 to 4.00 kPa"), "{said}");
    // It may be less at lower stresses.
    assert!(said.contains("UNDECIDED 40.0 g from 900 mm: the least peak is"), "{said}");
    assert!(said.contains("at 1.00 kPa, where the range ends"), "{said}");
    let wider = ["cushion", text(&path), "--thickness", "5 cm", "--stress", "0.2..4 kPa,7"];
    let wider = [&wider[..], &["--heights", "90 cm", "--limit", "40 g"]].concat();
    let said = squeezed(&out(&run(&wider)));
    assert!(said.contains("FAIL 40.0 g from 900 mm: the least peak is"), "{said}");
    let said = told(&["--heights", "30,90 cm", "--limit", "40 g"]);
    let other = told(&["--heights", "30,90 cm", "--limit", "parcel.peak-acceleration<=40 g"]);
    assert_eq!(said, other);
}

/// The static stress of the scene's own mass is told, and marked where it keeps the limit.
#[test]
fn the_mass_of_the_scene_is_marked() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene(&foam(&folder, ""), ""));
    let results = folder.path().join("curves");
    let limit = ["--thickness", "5 cm", "--stress", "1..4 kPa,7", "--limit", "50 g"];
    let output = run(&[&["cushion", text(&path)], &limit[..], &["--out", text(&results)]].concat());
    // 8 kg on 400 cm².
    let told = squeezed(&out(&output));
    assert!(told.contains("scene parcel of 8 kg has a static stress of 1.961 kPa"), "{told}");
    assert!(told.contains("✓ the static stress of parcel in the scene"), "{told}");
    let figure = std::fs::read_to_string(results.join("cushion-600mm.svg")).unwrap();
    assert!(figure.contains("parcel 1.96 kPa"), "{figure}");
    let own = json(&["cushion", text(&path), "--stress", "1 kPa", "--json"]);
    let stress = own["platen"]["stress"].as_f64().unwrap();
    assert!((stress / (8.0 * G0 / 0.04) - 1.0).abs() < 1e-14, "{stress}");
}

#[test]
fn one_stress_is_one_mass_and_a_day_is_told() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene("{ spring = \"0.4 MPa\" }", ""));
    let own = run(&["cushion", text(&path), "--stress", "3 kPa", "--creep", "24 h,48 h"]);
    let told = out(&own);
    assert!(told.contains("with 12.2 kg\n") && !told.contains("12.2 kg to"), "{told}");
    assert!(told.contains("1 d") && told.contains("2 d"), "{told}");
}

#[test]
fn what_is_no_cushion_test_says_what_to_write() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "foam.toml", &scene("{ spring = \"0.4 MPa\" }", ""));
    let path = text(&path);
    for (arguments, told) in [
        (vec!["--heights", "30 kPa"], "for example \"2 cm\""),
        (vec!["--heights", "30,60"], "`30,60` has no unit: write \"30,60 mm\" or"),
        (vec!["--heights", "30 zm"], "a length (m) is expected"),
        (vec!["--heights", "high"], "a length (m) is expected"),
        (vec!["--stress", "5 cm"], "for example \"2 MPa\""),
        (vec!["--limit", "50 kg"], "for example \"9.81 m/s^2\""),
        (vec!["--limit", "parcel.hic15<=700"], "\"parcel.peak-acceleration<=50 g\""),
        (vec!["--limit", "parcel.peak-acceleration>=50 g"], "a most of"),
        (vec!["--over", "4..9 kPa"], "--limit"),
        (vec!["--platen", "parcels"], "parcel"),
        (vec!["--pad", "foam"], "cushion"),
    ] {
        let output = run(&[&["cushion", path][..], &arguments].concat());
        assert_eq!(code(&output), 2, "{arguments:?}: {}", out(&output));
        assert!(err(&output).contains(told), "{arguments:?}: {}", err(&output));
    }
    let output = run(&["cushion", "reference"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("has no `area`"), "{}", err(&output));
}

#[test]
fn drops_in_a_row_and_creep_are_told_beside_the_curves() {
    let folder = TempDir::new().unwrap();
    let material = "{ parallel = [{ spring = \"0.2 MPa\" }, { maxwell = { spring = \"0.1 MPa\", dashpot = \"1 MPa s\" } }] }";
    let path = file(&folder, "creeping.toml", &scene(material, ""));
    let asked = ["--stress", "2,4 kPa", "--drops", "3", "--between", "10 s", "--creep", "1 s,1 h"];
    let own = json(&[&["cushion", text(&path), "--json"], &asked[..]].concat());
    let drops = own["curves"][0]["drops"].as_array().unwrap();
    for (row, peak) in drops.iter().zip(numbers(&own["curves"][0]["peak"])) {
        let peaks = numbers(&row["peak"]);
        assert!(peaks.len() == 3 && (peaks[0] / peak - 1.0).abs() < 1e-3, "{peaks:?} {peak}");
    }
    // ε = σ (1/E − E1/(E (E + E1)) e^(−t/λ)) with λ = η (1/E + 1/E1) = 15 s.
    for creep in own["creep"].as_array().unwrap() {
        let stress = creep["stress"].as_f64().unwrap();
        for crept in creep["crept"].as_array().unwrap() {
            let [time, strain] = ["time", "strain"].map(|own| crept[own].as_f64().unwrap());
            let right = stress * (5e-6 - 1e5 / (2e5 * 3e5) * (-time / 15.0).exp());
            assert!((strain / right - 1.0).abs() < 1e-6, "{time} {strain} {right}");
            assert_eq!(crept["trust"] == "within", time < 15.0);
        }
    }
}

/// A cushion of the stiffness K that keeps a part r of its deformation y is pressed again along a straight line from
/// there to y, and goes on as it was loaded first. Up to y that takes the part 1 − r of K y²/2, so the work of a drop that goes deeper, m g (h + z), is K z²/2 less
/// the rest of that. The dashpot that a face without mass wants takes c v of the force at most.
#[test]
fn drops_in_a_row_on_a_cushion_that_keeps_a_set_are_their_closed_form() {
    let folder = TempDir::new().unwrap();
    let (modulus, viscosity, set) = (4e5, 0.1, 0.3_f64);
    let material = "{ parallel = [{ hysteretic-table = { loading = [[0, 0], [1, \"0.4 MPa\"]], unloading = [[0.3, 0], [1, \
                    \"0.4 MPa\"]] } }, { dashpot = \"0.1 Pa s\" }] }";
    let again = 1.0 - set;
    let path = file(&folder, "set.toml", &scene(material, ""));
    let asked = ["--stress", "0.5,1,2,12 kPa", "--drops", "5", "--between", "3 s", "--json"];
    let own = json(&[&["cushion", text(&path)][..], &asked].concat());
    let curve = &own["curves"][0];
    let (stresses, later) = (numbers(&curve["stress"]), numbers(&curve["later"]));
    let rows = curve["drops"].as_array().unwrap().iter();
    // Of the heaviest platen the first drop strains by 0.88, and the second would by more than 1.
    assert!(curve["known"][3] == "whole" && curve["drops"][3]["known"] == false);
    assert!(later[3].is_nan() && curve["drops"][2]["known"] == true);
    let rows = rows.take(3);
    for ((row, stress), later) in rows.zip(stresses).zip(later) {
        let [mass, stiffness] = [stress * 0.04 / G0, modulus * 0.04 / 0.05];
        let (weight, height) = (mass * G0, 0.6);
        let mut depth = 0.0_f64;
        let mut lost = 0.0;
        let right = (0..5).map(|_| {
            let kept = (1.0 - again) * depth * depth;
            let inner = weight * weight + stiffness * (2.0 * weight * height + stiffness * kept);
            depth = (weight + inner.sqrt()) / stiffness;
            let speed = (2.0 * G0 * (height + depth)).sqrt();
            // Of the force of one drop, and of what those before were not pressed by.
            lost += 2.0 * viscosity * 0.04 / 0.05 * speed / (stiffness * depth);
            (stiffness * depth / mass, lost)
        });
        let right: Vec<(f64, f64)> = right.collect();
        let [found, bars] = ["peak", "error"].map(|key| numbers(&row[key]));
        println!("{stress}: {found:?} {bars:?} {right:?}");
        for ((found, bar), (right, lost)) in found.iter().zip(&bars).zip(&right) {
            assert!((found - right).abs() <= bar + lost * right, "{stress}: {found} {bar} {right}");
        }
        // The memory shows: the second drop is harder by more than a tenth.
        assert!(found[1] > 1.1 * found[0], "{found:?}");
        let mean = found[1..].iter().sum::<f64>() / 4.0;
        assert!((later / mean - 1.0).abs() < 1e-12, "{later} {mean}");
    }
}

/// A rigid stop makes the peak infinite: such drops are told by their cause, the best stress is sought up to them, and in
/// a sweep they fail.
#[test]
fn drops_onto_a_rigid_stop_have_an_infinite_peak() {
    let folder = TempDir::new().unwrap();
    let stop = "stop.cushion = { at = \"2 cm\" }";
    let path = file(&folder, "stop.toml", &scene("{ spring = \"0.4 MPa\" }", stop));
    let own =
        json(&["cushion", text(&path), "--heights", "60 cm", "--stress", "1..20 kPa,5", "--json"]);
    let curve = &own["curves"][0];
    let known = curve["known"].as_array().unwrap();
    assert_eq!(known[0].as_str(), Some("whole"), "{known:?}");
    assert_eq!(known[4].as_str(), Some("infinite"), "{known:?}");
    // It is met where the deformation of the spring is 2 cm: `m g (h + d) = ½ k d²`.
    let met = 0.5 * 4e5 / 0.05 * 0.02 * 0.02 / 0.62;
    let best = curve["best"]["stress"].as_f64().unwrap();
    assert!((best / met - 1.0).abs() < 1e-4, "{best} {met}");
    assert_eq!(curve["best"]["place"].as_str(), Some("end-of-known"));
    let told =
        out(&run(&["cushion", text(&path), "--heights", "60 cm", "--stress", "1..20 kPa,5"]));
    assert!(told.contains("have an infinite peak: masses meet, as on a rigid stop"), "{told}");
    let all = [
        "cushion",
        text(&path),
        "--heights",
        "60 cm",
        "--limit",
        "60 g",
        "--stress",
        "5..20 kPa,4",
    ];
    let told = out(&run(&all));
    let words = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("every drop presses cushion to where its peak is infinite"), "{told}");
    let limited = std::fs::read_to_string(&path).unwrap()
        + "\n[limits]\nparcel.peak-acceleration = \"150 g\"\n";
    let path = file(&folder, "limited.toml", &limited);
    let vary = ["sweep", text(&path), "--vary", "parcel.mass=2,80 kg", "--json"];
    let own = json(&vary);
    let verdicts = own["limits"][0]["verdicts"].as_array().unwrap();
    let words: Vec<_> = verdicts.iter().map(|own| own.as_str().unwrap_or("none")).collect();
    assert_eq!(words, ["pass", "fail"], "{own}");
}

/// `∫ f` from 0 to `end`, by Simpson's rule over the fourth root, in which powers of it are smooth.
fn integral(end: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    let (count, root) = (2000, end.powf(0.25));
    let at = |step: u32| {
        let own = root * f64::from(step) / f64::from(count);
        let weight = match step {
            0 => 1.0,
            own if own == count => 1.0,
            own => 2.0 + 2.0 * f64::from(own % 2),
        };
        weight * 4.0 * own.powi(3) * f(own.powi(4))
    };
    (0..=count).map(at).sum::<f64>() * root / (3.0 * f64::from(count))
}

#[test]
fn points_of_curves_on_elastic_foam_are_what_energy_tells() {
    // Modulus, plateau, densification [Pa], exponent, thickness [m], height [m], static stresses [Pa].
    let drops = [
        ([10_216_000.0, 215_690.0, 32_010.0, 3.3531, 0.066_602, 0.7781], "5847.23..53837.3 Pa,40"),
        ([20_429_000.0, 362_750.0, 119_010.0, 2.9228, 0.07186, 0.8875], "11299.5..100628 Pa,40"),
        ([13_323_000.0, 237_130.0, 19_987.0, 2.6408, 0.057_839, 0.3839], "7784.45..42263.1 Pa,40"),
        ([6_973_300.0, 129_630.0, 23_149.0, 2.3534, 0.031_441, 0.4703], "974.066..12890.6 Pa,40"),
    ];
    let (folder, mut seen) = (TempDir::new().unwrap(), 0);
    for ([modulus, plateau, dense, exponent, thickness, height], stresses) in drops {
        let foam = format!(
            "{{ foam = {{ modulus = \"{modulus} Pa\", plateau = \"{plateau} Pa\", densification = \"{dense} Pa\", \
             exponent = {exponent} }} }}"
        );
        let path = file(&folder, "elastic.toml", &scene(&foam, ""));
        let at = [format!("{height} m"), format!("{thickness} m")];
        let [height_text, thickness_text] = at.each_ref().map(String::as_str);
        let arguments = ["--heights", height_text, "--thickness", thickness_text];
        let rest = ["--stress", stresses, "--json"];
        let own = json(&[&["cushion", text(&path)], &arguments[..], &rest].concat());
        let curve = &own["curves"][0];
        let law = |strain: f64| {
            let solid = dense * (strain / (1.0 - strain)).powf(exponent);
            solid - plateau * (-modulus * strain / plateau).exp_m1()
        };
        let [stress, peak, error] = ["stress", "peak", "error"].map(|own| numbers(&curve[own]));
        for ((stress, peak), error) in stress.iter().zip(&peak).zip(&error) {
            // σ (H + y) = h ∫ σ(ε) dε at the deepest point.
            let (mut low, mut high) = (0.0, 0.98);
            for _ in 0..50 {
                let strain = 0.5 * (low + high);
                let left = stress * (height + thickness * strain) / thickness;
                if left > integral(strain, &law) { low = strain } else { high = strain }
            }
            let right = G0 * law(low) / stress;
            let off = (peak - right).abs();
            assert!(off <= *error && *error <= 1e-3 * peak, "{stress}: {peak} ± {error}, {right}");
            seen += 1;
        }
    }
    assert_eq!(seen, 160);
}
