use std::fmt::Write as _;

use super::*;
use crate::text::document::Words;

fn builder() -> Builder {
    Builder { number: 3, words: Words::default() }
}

/// The tree of a text in blocks, and that of the same text in one piece.
fn both(text: &str) -> (Option<String>, String) {
    let (whole, errors) = DeTable::parse_recoverable(text);
    assert!(errors.is_empty(), "{errors:?}");
    let place = Place::new(3, &whole.span());
    let value = Content::Table(builder().entries(whole.into_inner(), 0).into_boxed_slice());
    let whole = format!("{:?}", Item { value, place });
    (root(text, &mut builder()).map(|own| format!("{own:?}")), whole)
}

/// A text of some three blocks, with `rest` behind them.
fn long(rest: &str) -> String {
    let mut text = "\u{feff}title = \"many\"\n\n  [nodes] # all of them\n".to_owned();
    for at in 0..5000 {
        let _ = writeln!(text, "m{at} = {{ mass = \"{at} kg\", drop = 1_0 }} # [a\r");
    }
    assert!(text.len() > 3 * BLOCK);
    text + rest
}

#[test]
fn a_text_in_blocks_is_that_in_one_piece() {
    let rest = "[models]\na.series = [\n [1,\n 2],\n]\nb = \"\"\"\n[c]\n\"\"\"\n\n[ \"x y\" ]\nz = 0x10\n\
                [run]";
    for rest in [rest, "", "[run.\"a b\"]\n", "[[run]]\n", "[nodes.a]\nmass = 1\n"] {
        let (blocks, whole) = both(&long(rest));
        assert!(blocks.is_none_or(|blocks| blocks == whole), "{rest}");
    }
    assert!(both(&long(rest)).0.is_some());
}

#[test]
fn errors_and_what_stands_in_several_places_ask_for_one_piece() {
    let apart = format!("a.b = 1\n{}a.c = 2\n", "# long\n".repeat(BLOCK));
    let rests =
        ["[nodes]\n", "m0 = 1\n", "a = [\n", "[title]\n", "a.b = 1\n]\n", "[a\nb = 1\n", &apart];
    for rest in rests {
        assert!(root(&long(rest), &mut builder()).is_none(), "{rest}");
    }
}
