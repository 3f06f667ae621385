//! Where the scenes are that come with the project.

use std::path::{Path, PathBuf};

/// The file of a scene: of the folder `scenes`, or a reference scene that the crate carries with it.
pub(crate) fn scene_path(name: &str) -> PathBuf {
    let folder = if name.starts_with("reference") { "crates/scene/templates" } else { "scenes" };
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(format!("{name}.toml"))
}

/// All of them, in order of their names.
pub(crate) fn scene_paths() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut names: Vec<String> = folder
        .read_dir()
        .unwrap()
        .filter_map(|entry| {
            entry.unwrap().file_name().to_str()?.strip_suffix(".toml").map(str::to_owned)
        })
        .chain(dashpot::scene::references().iter().map(|reference| reference.name.to_owned()))
        .collect();
    names.sort();
    assert!(names.len() > 10);
    names.iter().map(|name| scene_path(name)).collect()
}
