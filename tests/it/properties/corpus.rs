//! What once failed is tried again.

use super::{corpus, scenes::check, solved::scene, symmetries::wrong};

#[test]
fn networks_of_the_corpus_keep_all_invariants() {
    for (name, bytes) in corpus("networks") {
        let text = String::from_utf8(bytes).unwrap();
        if let Some(what) = scene(&text).and_then(|scene| wrong(&scene)) {
            panic!("{name}: {what}");
        }
    }
}

#[test]
#[ignore = "each file says on its first line what is still wrong"]
fn open_networks_keep_all_invariants() {
    for (name, bytes) in corpus("open") {
        let text = String::from_utf8(bytes).unwrap();
        let scene = scene(&text).unwrap();
        assert_eq!(wrong(&scene), None, "{name}");
    }
}

#[test]
fn scenes_of_the_corpus_are_read_or_refused() {
    for (name, bytes) in corpus("scenes") {
        check(&bytes).unwrap_or_else(|what| panic!("{name}: {what}"));
    }
}

#[test]
fn tables_of_the_corpus_are_read_or_refused() {
    for (name, bytes) in corpus("tables") {
        let text = String::from_utf8_lossy(&bytes);
        super::readers::check_table(&text).unwrap_or_else(|what| panic!("{name}: {what}"));
    }
}

#[test]
fn quantities_of_the_corpus_are_read_or_refused() {
    for (name, bytes) in corpus("quantities") {
        for text in String::from_utf8_lossy(&bytes).lines() {
            super::readers::check_quantity(text).unwrap_or_else(|what| panic!("{name}: {what}"));
        }
    }
}
