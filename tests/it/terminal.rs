//! What the command prints on a terminal of 80 columns.

use std::fs;

use dashpot::{
    dae::{System, switching::Switching},
    network::Network,
    scene::{ReadOptions, read_network},
};
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, out, run, text},
    scenes::{scene_path, scene_paths},
};

const WIDTH: usize = 80;

/// Checks both streams of a command. Names of files are as long as they are.
fn fits(arguments: &[&str]) {
    let output = run(arguments);
    for line in out(&output).lines().chain(err(&output).lines()) {
        let is_long =
            arguments.iter().any(|argument| argument.len() > 20 && line.contains(argument));
        assert!(is_long || line.chars().count() <= WIDTH, "{arguments:?}: {line}");
    }
}

fn network(path: &str) -> Network {
    read_network(&fs::read_to_string(path).unwrap(), &ReadOptions::default()).unwrap().value
}

#[test]
fn no_line_is_wider_than_the_terminal() {
    let folder = TempDir::new().unwrap();
    for scene in scene_paths() {
        let scene = text(&scene);
        for arguments in [
            &["check", scene][..],
            &["explain", scene],
            &["explain", scene, "--verbose"],
            &["vibrate", scene],
        ] {
            fits(arguments);
        }
        fits(&["run", scene, "--plot", "always"]);
        fits(&["run", scene, "--neglect", "0.5%"]);
        fits(&["vibrate", scene, "--drive", "ground", "--plot", "always"]);
        for element in network(scene).connections() {
            let operand = format!("{scene}:{}", element.name);
            fits(&["rheometer", &operand, "--plot", "always"]);
            // Its output is a scene, with the lines that it had.
            let file = folder.path().join("converted.toml");
            let target = ["--to", "generalized-maxwell", "--force", "--out", text(&file)];
            fits(&[&["convert", &operand], &target[..]].concat());
            fits(&["compare", &operand, "reference:padding"]);
        }
    }
}

#[test]
fn help_and_lists_fit_too() {
    for verb in
        ["run", "check", "explain", "convert", "compare", "rheometer", "vibrate", "thesis", "new"]
    {
        fits(&[verb, "--help"]);
    }
    for arguments in [&["--help"][..], &["list"], &["list", "effects"], &["list", "elements"]] {
        fits(arguments);
    }
}

#[test]
fn a_long_line_of_a_scene_is_cut_around_what_is_at_fault() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("foam.toml");
    let scene = "[nodes]\nhead = { mass = \"5 kg\", velocity = \"5 m/s\" }\n[elements]\n\
        liner = { between = [\"head\", \"ground\"], foam = { modulus = \"15 MPa\", plateau = \"0.7 MPa\", \
        densification = \"0.15 MPa\", exponent = 3 }, thickness = \"25 mm\", area = \"80 cm\" }\n\
        [run]\nduration = \"30 ms\"\n";
    fs::write(&path, scene).unwrap();
    let arguments = ["check", text(&path)];
    fits(&arguments);
    let told = err(&run(&arguments));
    let mut lines = told.lines().skip_while(|line| !line.contains("area = \"80 cm\""));
    let (line, mark) = (lines.next().unwrap(), lines.next().unwrap());
    let place = line.find("\"80 cm\"").unwrap();
    assert_eq!(mark.find("^^^^^^^"), Some(place), "{told}");
}

#[test]
fn long_notes_go_on_with_an_indent() {
    let path = scene_path("hockey-pad");
    let scene = text(&path);
    let told = err(&run(&["check", scene]));
    let mut lines = told.lines();
    assert!(lines.next().unwrap().starts_with("note: element `pad`: "), "{told}");
    assert!(lines.clone().count() > 2 && lines.all(|line| line.starts_with("  ")), "{told}");
}

/// Entries of the matrices with which a run of the network begins.
fn entries(network: &Network, duration: f64) -> usize {
    let own = |system: &System| system.jacobian.nnz() + system.input_matrix.nnz();
    let assembly = network.compile(duration).unwrap();
    match &assembly.switching {
        Some(phased) => own(&phased.first(0.0).unwrap().system),
        None => own(&assembly.system),
    }
}

#[test]
fn effects_that_remove_entries_say_so() {
    let path = scene_path("helmet-drop");
    let helmet = text(&path);
    let full = network(helmet);
    for (name, effect) in [("gravity", 0), ("separation.liner", 1)] {
        let position = full.effects().iter().position(|own| match effect {
            0 => own.kind() == "gravity",
            _ => own.kind() == "separation",
        });
        let without = full.without(&[dashpot::network::Detail::Effect(position.unwrap())]);
        let [with, without] = [&full, &without].map(|own| entries(own, 0.6));
        let expected = match with.checked_sub(without) {
            Some(more) => more.to_string(),
            None => format!("{} fewer", without - with),
        };
        let shown = out(&run(&["explain", helmet, "--verbose"]));
        let starts = format!("  {name} ");
        let row = shown.lines().find(|line| line.starts_with(&starts)).unwrap();
        assert!(row.contains(&format!(" {expected}  ")), "{expected}: {row}");
        assert!(row.contains(" on "), "{row}");
    }
}

#[test]
fn what_cannot_be_shaken_is_told_with_what_to_do_instead() {
    let told = |scene: &str, arguments: &[&str]| {
        let path = scene_path(scene);
        let output = run(&[&["vibrate", text(&path)], arguments].concat());
        assert_eq!(code(&output), 2);
        err(&output).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    assert!(told("helmet-drop", &[]).contains("help: `--drive ground` shakes `ground`"));
    assert!(told("hockey-pad", &[]).contains("there is nothing to shake"));
    let switching = told("crash-mat", &["--drive", "ground"]);
    for part in ["is not linear", "`dashpot run` solves it in time", "sine"] {
        assert!(switching.contains(part), "{switching}");
    }
}

#[test]
fn contacts_of_effects_are_named_once() {
    let path = scene_path("hockey-pad");
    let scene = text(&path);
    let shown = out(&run(&["explain", scene]));
    assert!(
        shown
            .lines()
            .any(|line| line.trim() == "contact      pad.contact               open / closed"),
        "{shown}"
    );
    let folder = TempDir::new().unwrap();
    let stopped = "[nodes]\nhead = { mass = 1, velocity = 1 }\n[elements]\npad = { between = \
                   [\"head\", \"ground\"], spring = 1000 }\n[effects]\nseparation.pad = {}\n[run]\n\
                   duration = 1\nstop = [{ when = \"pad.contact.force\", rises-above = \"10 N\" }]\n";
    let scene = file(&folder, "stop.toml", stopped);
    let shown = out(&run(&["run", text(&scene)]));
    assert!(shown.contains("  stopped  "), "{shown}");
}

#[test]
fn completions_know_all_verbs_and_options() {
    let shown = out(&run(&["completions", "bash"]));
    for word in
        ["vibrate", "--neglect", "--drive", "--amplitude", "rheometer", "--impact", "--plot"]
    {
        assert!(shown.contains(word), "{word}");
    }
}

#[test]
fn a_body_that_nothing_brings_back_is_told_of_once() {
    let folder = TempDir::new().unwrap();
    let scene = |gravity: &str| {
        format!(
            "[nodes]\nparcel = {{ mass = \"3 kg\" }}\nbed = {{ motion = {{ sine = {{ amplitude = \"5 mm\", \
             frequency = \"9 Hz\" }} }} }}\n[elements]\nfoam = {{ between = [\"parcel\", \"bed\"], \
             kelvin-voigt = {{ spring = \"9 kN/m\", dashpot = \"40 N s/m\" }} }}\n[effects]\nseparation.foam = {{}}\n\
             {gravity}[run]\nduration = \"1 s\"\n"
        )
    };
    let told = |gravity: &str| {
        let path = file(&folder, "fly.toml", &scene(gravity));
        err(&run(&["run", text(&path)]))
    };
    let off = told("");
    assert_eq!(off.matches("never comes back: gravity is off").count(), 1, "{off}");
    assert!(off.contains("parcel leaves the foam at"), "{off}");
    assert_eq!(told("gravity = {}\n"), "");
}

#[test]
fn what_is_wrong_with_an_argument_fits_the_terminal() {
    for arguments in [
        ["run", "--limit", "head.peak-acceleration<=250 mm"],
        ["run", "--limit", "head.peak-acceleration"],
        ["run", "--accuracy", "40%"],
        ["run", "--no-such-flag-that-is-rather-long-and-so-on-for-a-while", "another-word"],
        ["rheometer", "--test", "no-such-test-among-all-the-tests-that-there-are-in-the-list"],
    ] {
        let output = run(&arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        let shown = err(&output);
        assert!(shown.starts_with("error: ") && shown.contains("--help"), "{shown}");
        for line in shown.lines() {
            let is_word = !line.trim().contains(' ');
            assert!(is_word || line.chars().count() <= WIDTH, "{arguments:?}: {line}");
        }
    }
}

#[test]
fn values_and_units_are_echoed_as_they_were_written() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    let scene = "[values]\nK = \"0.06 MN/m\"\nsize = \"2.0 cm\"\nF = \"K * size\"\n[nodes]\nhead = { mass = \"5000 g\", \
                 velocity = \"4 m/s\" }\n[elements]\npad = { between = [\"head\", \"ground\"], spring = \"K\" }\n\
                 [limits]\npad.peak-force = \"10 * F\"\n[run]\nduration = \"50 ms\"\n";
    fs::write(&path, scene).unwrap();
    let path = path.to_str().unwrap();
    let results = folder.path().join("results");
    let output = run(&["run", path, "--set", "K=65.0 N/mm", "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    for text in ["65.0 N/mm", "2.0 cm", "K * size = 1.3 kN"] {
        assert!(page.contains(text), "{text}");
    }
    let swept = run(&["sweep", path, "--vary", "head.mass=4..6 kg,3", "--table", "always"]);
    let shown = out(&swept).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains("5000 g in the scene"), "{shown}");
}

#[test]
fn notes_do_not_stand_before_an_error() {
    let folder = TempDir::new().unwrap();
    let dropped = "[nodes]\nhead = { mass = \"5 kg\", drop = \"1 m\" }\n[elements]\npad = { between = [\"head\", \
                   \"ground\"], spring = \"50 kN/m\" }\n[run]\nduration = \"20 ms\"\n";
    let scene = file(&folder, "dropped.toml", dropped);
    let told = run(&["sweep", text(&scene), "--vary", "head.mass=4,5 kg"]);
    assert_eq!(code(&told), 0, "{}", err(&told));
    assert!(err(&told).contains("note: node `head`"), "{}", err(&told));
    for arguments in
        [&["sweep", "--vary", "K=4,5"][..], &["cushion"], &["design", "--vary", "K=4..5"]]
    {
        let refused = run(&[&arguments[..1], &[text(&scene)], &arguments[1..]].concat());
        assert_eq!(code(&refused), 2, "{}", err(&refused));
        assert!(err(&refused).starts_with("error: "), "{}", err(&refused));
    }
}

/// Characters that Unicode leaves to programs, and those that turn the direction of what follows, come from scenes, names
/// and arguments as text; styles are the program's.
#[test]
fn no_text_of_a_file_becomes_a_style_or_turns_around() {
    const LIVE: [char; 7] =
        ['\u{fdd0}', '\u{fdd3}', '\u{fdef}', '\u{202e}', '\u{2066}', '\u{1b}', '\u{feff}'];
    let all: String = LIVE.iter().collect();
    let escaped: String = LIVE
        .iter()
        .flat_map(|own| format!("\\u{:04x}", u32::from(*own)).into_bytes())
        .map(char::from)
        .collect();
    let room = TempDir::new().unwrap();
    let text_of = format!(
        "title = \"{escaped}error: your disk is full\"\n[nodes]\nhead = {{ mass = \"5 kg\", velocity = \"4 m/s\" }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], spring = \"80 kN/m\" }}\n\
         [limits]\nhead.peak-acceleration = {{ max = \"250 g\", from = \"EN {escaped} 1078\" }}\n[run]\nduration = \"40 ms\"\n"
    );
    let scene = file(&room, "scene.toml", &text_of);
    let folder = room.path().join("out");
    for arguments in [
        &["run", text(&scene), "--out", text(&folder)][..],
        &["run", text(&scene), "--measure", &format!("{all}.x")],
        &["explain", text(&scene), "--verbose"],
        &["check", text(&scene)],
        &["vibrate", text(&scene)],
        &["groups", text(&scene)],
        &["sweep", text(&scene), "--vary", "head.velocity=1..4 m/s,3", "--table", "always"],
        &["run", &format!("{all}.toml")],
    ] {
        for color in ["always", "never"] {
            let output = run(&[arguments, &["--color", color]].concat());
            for stream in [out(&output), err(&output)] {
                // Our own styles: bold, colours, their end.
                let rest = stream.replace("\u{1b}[", "");
                assert!(!rest.contains(LIVE), "{arguments:?} {color}: {stream:?}");
                assert!(
                    color == "always" || !stream.contains('\u{1b}'),
                    "{arguments:?}: {stream:?}"
                );
                let faked = "\u{1b}[1m\u{1b}[31merror: your";
                assert!(!stream.contains(faked), "{arguments:?}: {stream:?}");
            }
        }
    }
    let pages = fs::read_dir(&folder).unwrap().map(|own| own.unwrap().path());
    let pages =
        pages.filter(|own| own.extension().is_some_and(|own| own == "html" || own == "svg"));
    let mut count = 0;
    for page in pages {
        let own = fs::read_to_string(&page).unwrap();
        assert!(!own.contains(LIVE), "{}", page.display());
        count += 1;
    }
    assert!(count > 3, "{count}");
}
