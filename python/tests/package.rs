//! The package as Python has it: made of what was built, and tested in a virtual environment. Without a Python of
//! version 3.10 or later, or without its packages, that is said, and nothing is tested.

#![expect(clippy::unwrap_used, reason = "what a test cannot do fails it")]

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// A machine without a network is not waited for.
const INSTALL: [&str; 8] = ["-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "30"];
/// What the tests need; what they use besides is skipped where it is not there.
const NEEDED: [&str; 2] = ["numpy", "pytest"];
/// What they use besides, where it can be had.
const BESIDES: [&str; 3] = ["xarray", "pyarrow", "distributed"];

/// The output of a command that went well.
fn done(program: &Path, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new(program).args(arguments).output().map_err(|own| own.to_string())?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) }
}

/// The interpreter of an environment with what is needed.
fn interpreter(folder: &Path) -> Result<PathBuf, String> {
    let own = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !own.is_file() {
        let python = PathBuf::from(if cfg!(windows) { "python" } else { "python3" });
        done(&python, &["-c", "import sys; sys.exit(sys.version_info < (3, 10))"])?;
        done(&python, &["-m", "venv", &folder.to_string_lossy()])?;
    }
    if done(&own, &["-c", &format!("import {}", NEEDED.join(", "))]).is_err() {
        let install = |packages: &[&str]| done(&own, &[&INSTALL[..], packages].concat());
        install(&NEEDED)?;
        // What cannot be had is skipped, and that is told.
        let _ = install(&BESIDES);
    }
    Ok(own)
}

/// Puts the package together beside what was built.
fn packed(built: &Path) -> PathBuf {
    let (from, to) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("dashpot"), built.join("python"));
    let package = to.join("dashpot");
    let _ = fs::remove_dir_all(&package);
    fs::create_dir_all(&package).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap).filter(|own| own.path().is_file())
    {
        fs::copy(entry.path(), package.join(entry.file_name())).unwrap();
    }
    let (library, module) = match env::consts::OS {
        "windows" => ("_dashpot.dll", "_dashpot.pyd"),
        "macos" => ("lib_dashpot.dylib", "_dashpot.abi3.so"),
        _ => ("lib_dashpot.so", "_dashpot.abi3.so"),
    };
    let library = [built.join(library), built.join("deps").join(library)]
        .into_iter()
        .find(|own| own.is_file());
    fs::copy(library.unwrap(), package.join(module)).unwrap();
    to
}

#[test]
fn the_package_passes_its_tests() {
    let own = env::current_exe().unwrap();
    let built = own.ancestors().nth(2).unwrap();
    let python = match interpreter(&built.join("python-environment")) {
        Ok(python) => python,
        Err(why) => return eprintln!("skipped: no Python for the tests of the package: {why}"),
    };
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let run = Command::new(python)
        .args(["-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider"])
        .arg(tests)
        // Not where the package lies without its engine.
        .current_dir(built)
        .env("PYTHONPATH", packed(built))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{text}{}", String::from_utf8_lossy(&run.stderr));
    println!("{text}");
}
