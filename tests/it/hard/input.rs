//! What is turned down: input that is wrong, and networks that have no answer, through the command.

use std::{
    fmt::Write as _,
    fs,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use tempfile::TempDir;

use super::page;

/// A command that takes longer has hung.
const PATIENCE: Duration = Duration::from_secs(60);
/// Exit code of what is wrong with the input.
const WRONG_INPUT: i32 = 2;

/// Input that is turned down.
struct Refusal {
    name: &'static str,
    bytes: Vec<u8>,
    /// What the message must hold besides a place in the file.
    wanted: Vec<String>,
    /// Whether there is a line to point at.
    has_line: bool,
}

fn refusal(name: &'static str, text: impl Into<Vec<u8>>, wanted: &[&str]) -> Refusal {
    let wanted = wanted.iter().map(|&own| own.to_owned()).collect();
    Refusal { name, bytes: text.into(), wanted, has_line: true }
}

impl Refusal {
    fn without_line(self) -> Self {
        Self { has_line: false, ..self }
    }
}

/// A small scene in which nothing is wrong.
const GOOD: &str = "[values]\nK = \"50 kN/m\"\n\n[models.foam]\nkelvin-voigt = { spring = \"K\", dashpot = 80 }\n\n\
    [nodes]\nhead = { mass = \"5 kg\", velocity = \"6 m/s\" }\n\n\
    [elements]\npad = { between = [\"head\", \"ground\"], model = \"foam\" }\n\n\
    [run]\nduration = \"40 ms\"\n";

fn with(old: &str, new: &str) -> String {
    assert!(GOOD.contains(old), "{old}");
    GOOD.replacen(old, new, 1)
}

fn network(nodes: &str, elements: &str, more: &str) -> String {
    format!("[nodes]\n{nodes}\n[elements]\n{elements}\n{more}\n[run]\nduration = \"20 ms\"\n")
}

#[test]
fn input_that_is_wrong_is_turned_down() {
    let nested =
        format!("{GOOD}[models.deep]\nseries = {}{}\n", "[".repeat(100_000), "]".repeat(100_000));
    let many = GOOD
        .replace("K = ", "K = \"nan\"\nL = ")
        .replace("\"5 kg\"", "\"5 m\"")
        .replace("\"ground\"", "\"grond\"")
        .replace("\"foam\"", "\"fom\"")
        .replace("\"40 ms\"", "\"-40 ms\"");
    let mut bytes = GOOD.as_bytes().to_vec();
    bytes[3] = 0xff;
    let mut large = GOOD.as_bytes().to_vec();
    large.resize(100_000_000, b' ');
    judge(
        "input",
        vec![
            refusal("unknown section", with("[nodes]", "[nods]"), &["`nods`", "`nodes`"]),
            refusal("unknown key", with("mass = ", "color = 3, mass = "), &["`color`"]),
            refusal("misspelt key", with("mass = ", "mas = "), &["`mas`", "`mass`"]),
            refusal("missing key", with("between = [\"head\", \"ground\"], ", ""), &["`between`"]),
            refusal("missing section", with("[run]\nduration = \"40 ms\"\n", ""), &["run"])
                .without_line(),
            refusal(
                "duplicate key",
                with("mass = \"5 kg\"", "mass = \"5 kg\", mass = \"6 kg\""),
                &["mass"],
            ),
            refusal(
                "duplicate node",
                with("[elements]", "head = { mass = 1 }\n[elements]"),
                &["head"],
            ),
            refusal("wrong type", with("\"5 kg\"", "true"), &["mass"]),
            refusal("wrong unit", with("\"5 kg\"", "\"5 m\""), &["`5 m` is a length", "mass"]),
            refusal("unit that does not exist", with("\"5 kg\"", "\"5 kgg\""), &["kgg"]),
            refusal("unknown node", with("\"ground\"", "\"grond\""), &["`grond`", "`ground`"]),
            refusal("unknown value", with("spring = \"K\"", "spring = \"KK\""), &["`KK`"]),
            refusal("unknown model", with("\"foam\"", "\"fom\""), &["`fom`", "`foam`"]),
            refusal("1e400", with("dashpot = 80", "dashpot = 1e400"), &["1e400"]),
            refusal("1e400 with a unit", with("\"50 kN/m\"", "\"1e400 N/m\""), &["1e400"]),
            refusal("nan", with("dashpot = 80", "dashpot = nan"), &["nan"]),
            refusal("nan with a unit", with("\"50 kN/m\"", "\"nan N/m\""), &["nan"]),
            refusal("inf", with("dashpot = 80", "dashpot = inf"), &["inf"]),
            refusal("negative stiffness", with("\"50 kN/m\"", "\"-50 kN/m\""), &["`spring`"]),
            refusal("negative mass", with("\"5 kg\"", "\"-5 kg\""), &["mass"]),
            refusal("negative duration", with("\"40 ms\"", "\"-40 ms\""), &["duration"]),
            refusal("not UTF-8", bytes, &["UTF-8"]).without_line(),
            refusal("empty", "", &["empty"]),
            refusal("100 MB", large, &["MB"]).without_line(),
            refusal("nested 100 000 deep", nested, &["100000 levels"]),
            refusal(
                "a model that contains itself",
                with(
                    "kelvin-voigt = { spring = \"K\", dashpot = 80 }",
                    "series = [{ spring = \"K\" }, { model = \"foam\" }]",
                ),
                &["foam"],
            ),
            refusal(
                "a table that falls (snap-through)",
                with("model = \"foam\"", "table-spring = [[0, 0], [1e-3, 10], [2e-3, 5]]"),
                &["table-spring"],
            ),
            refusal(
                "five faults at once",
                many,
                &["K", "`5 m` is a length", "`grond`", "`fom`", "duration"],
            ),
        ],
    );
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table of cases")]
fn networks_without_an_answer_are_turned_down() {
    const HEAD: &str = "head = { mass = 1, velocity = 1 }\n";
    const PAD: &str = "pad = { between = [\"head\", \"ground\"], spring = 100 }\n";
    judge(
        "undetermined",
        vec![
            refusal(
                "isolated massless node",
                network(&format!("{HEAD}lost = {{}}"), PAD, ""),
                &["lost"],
            ),
            refusal(
                "massless nodes held by nothing",
                network(
                    &format!("{HEAD}one = {{}}\ntwo = {{}}"),
                    &format!("{PAD}link = {{ between = [\"one\", \"two\"], dashpot = 1 }}"),
                    "",
                ),
                &["one", "two"],
            ),
            refusal(
                "both ends on one node",
                network(
                    HEAD,
                    &format!("{PAD}loop = {{ between = [\"head\", \"head\"], spring = 1 }}"),
                    "",
                ),
                &["loop", "head"],
            ),
            refusal(
                "contradicting motions",
                network(
                    &format!(
                        "{HEAD}a = {{ motion = {{ constant = 1e-3 }} }}\nb = {{ motion = {{ constant = 2e-3 }} }}"
                    ),
                    &format!("{PAD}link = {{ between = [\"a\", \"b\"], rigid = true }}"),
                    "",
                ),
                &["a", "b"],
            ),
            refusal(
                "step across dashpots only",
                network(
                    &format!("{HEAD}a = {{ motion = {{ constant = 1e-3 }} }}\nmid = {{}}"),
                    &format!(
                        "{PAD}one = {{ between = [\"a\", \"mid\"], dashpot = 1 }}\ntwo = {{ between = [\"mid\", \"ground\"], dashpot = 1 }}"
                    ),
                    "",
                ),
                &["rise time"],
            ),
            refusal(
                "jump of a table across a dashpot",
                network(
                    &format!(
                        "{HEAD}a = {{ motion = {{ table = [[0, 0], [0.01, 0], [0.01, 1e-3], [0.02, 1e-3]] }} }}"
                    ),
                    &format!("{PAD}one = {{ between = [\"a\", \"ground\"], dashpot = 1 }}"),
                    "",
                ),
                &["a"],
            ),
            refusal(
                "massless pad that can part on both sides",
                network(
                    &format!("{HEAD}a = {{}}\nb = {{}}\npanel = {{ mass = 2 }}"),
                    "front = { between = [\"head\", \"a\"], contact = { gap = 0.0 } }\n\
                     pad = { between = [\"a\", \"b\"], spring = 100 }\n\
                     back = { between = [\"b\", \"panel\"], contact = { gap = 0.0 } }\n\
                     mount = { between = [\"panel\", \"ground\"], spring = 100 }",
                    "",
                ),
                &["`a`", "`b`"],
            ),
            refusal(
                "massless node between two slack gaps",
                network(
                    &format!("{HEAD}a = {{}}"),
                    "front = { between = [\"head\", \"a\"], contact = { gap = 1e-3 } }\n\
                     back = { between = [\"a\", \"ground\"], contact = { gap = 2e-3 } }",
                    "",
                ),
                &["`a`"],
            ),
            refusal(
                "weight in balance on a dashpot",
                network(
                    "head = { mass = 1 }",
                    "pad = { between = [\"head\", \"ground\"], dashpot = 100 }",
                    "[effects]\ngravity = true",
                ),
                &["head"],
            ),
            refusal(
                "motion of a mass",
                network("head = { mass = 1, motion = { constant = 1e-3 } }", PAD, ""),
                &["head"],
            ),
            refusal(
                "force across a gap on a massless node",
                network(
                    &format!("{HEAD}tip = {{}}"),
                    &format!(
                        "{PAD}gap = {{ between = [\"tip\", \"ground\"], contact = {{ gap = 1e-3 }} }}"
                    ),
                    "[loads]\nram = { on = \"tip\", force = { constant = 1 } }",
                ),
                &["tip"],
            ),
        ],
    );
}

#[test]
fn a_byte_order_mark_is_accepted() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("scene.toml"), format!("\u{feff}{GOOD}")).unwrap();
    let (code, _) = run(&folder);
    assert_eq!(code, Some(0));
}

/// Runs each scene and holds what is said against the page.
fn judge(section: &str, refusals: Vec<Refusal>) {
    let mut table = "| input | what is said |\n|---|---|\n".to_owned();
    let mut faults = Vec::new();
    for refusal in refusals {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("scene.toml"), &refusal.bytes).unwrap();
        let (code, said) = run(&folder);
        let mut missing = Vec::new();
        if code != Some(WRONG_INPUT) {
            missing.push(format!("exit code {code:?}"));
        }
        let lost = refusal.wanted.iter().filter(|wanted| !said.contains(wanted.as_str()));
        missing.extend(lost.map(|wanted| format!("no {wanted}")));
        if !said.contains("scene.toml") {
            missing.push("no file".to_owned());
        }
        if refusal.has_line && !(said.contains("--> scene.toml:") && said.contains('^')) {
            missing.push("no line with a caret".to_owned());
        }
        let first = said.lines().find(|line| line.starts_with("error")).unwrap_or_default();
        let first = first.trim_start_matches("error: ");
        writeln!(table, "| {} | {} |", refusal.name, first.replace('|', "\\|")).unwrap();
        if !missing.is_empty() {
            let said: String = said.chars().take(1500).collect();
            faults.push(format!("{}: {}\n{said}", refusal.name, missing.join(", ")));
        }
    }
    faults.extend(page::hold(section, &table));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Runs the scene of a folder: the exit code, `None` where there is none in time, and what is said.
fn run(folder: &TempDir) -> (Option<i32>, String) {
    let said = folder.path().join("said");
    let mut child = Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .args(["run", "scene.toml"])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(fs::File::create(&said).unwrap())
        .spawn()
        .unwrap();
    let start = Instant::now();
    let code = loop {
        match child.try_wait().unwrap() {
            Some(status) => break status.code(),
            None if start.elapsed() > PATIENCE => {
                child.kill().unwrap();
                child.wait().unwrap();
                break None;
            }
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    };
    (code, fs::read_to_string(said).unwrap())
}
