//! Inputs at and beyond the limits: a clear message, never a panic.

use super::{messages, on_model, read_text, scene};
use crate::{ReadOptions, read_bytes, text_of_bytes};

#[test]
fn text_that_is_too_large_or_not_utf8_is_refused() {
    let large = vec![b'#'; (64 << 20) + 1];
    let shown = text_of_bytes(&large, Some("big.toml")).unwrap_err().render(false);
    assert!(shown.contains("the text has 67108865 bytes; the limit is 64 MB"), "{shown}");
    assert!(shown.contains("big.toml"));
    let shown = read_bytes(b"a = 1\nb = '\xff'", &ReadOptions::default()).unwrap_err();
    assert!(shown.render(false).contains("not UTF-8: byte 11 cannot be read (line 2)"));
}

#[test]
fn a_byte_order_mark_is_accepted() {
    scene(&format!("\u{feff}{}", on_model("spring = 1")));
    let shown = messages(&format!("\u{feff}titel = 1\n{}", on_model("spring = 1")));
    assert!(shown.contains("scene.toml:1:1"), "{shown}");
}

#[test]
fn a_text_may_nest_to_the_limit() {
    let nested = |levels: usize| {
        let open = "series = [{ spring = 1 }, { ".repeat(levels);
        on_model(&format!("{open}spring = 1{}", " }]".repeat(levels)))
    };
    let deep = scene(&nested(63));
    assert_eq!(super::shape(&deep.network.connections()[0].model).len(), 2 * 63 + 1);
    let refused = messages(&nested(64));
    assert!(refused.contains("nests 129 levels deep; the limit is 128"), "{refused}");
    assert!(refused.contains("into one list"), "{refused}");
}

#[test]
fn very_many_faults_are_counted_and_very_long_lines_cut() {
    let nodes = "n = { mas = 1 }\n".repeat(3).replace("n =", "\"n\" =");
    assert!(messages(&format!("[nodes]\n{nodes}")).contains("given twice"));
    let many = (0..5000).map(|at| format!("n{at} = {{ mas = 1 }}")).collect::<Vec<_>>().join("\n");
    let errors = read_text(&format!("[nodes]\n{many}")).unwrap_err();
    assert_eq!(errors.list.len() + errors.omitted, 5002);
    assert!(errors.list.len() <= 100);
    let line = format!("a = [{}1]\n", "1, ".repeat(100_000));
    assert!(messages(&line).lines().all(|line| line.len() < 1000));
}

#[test]
fn values_at_the_edges_of_the_number_range() {
    for bad in ["1e400", "-1e400", "nan", "inf", "-inf", "\"nan N/m\"", "\"1e400 N/m\"", "-1"] {
        let shown = messages(&on_model(&format!("spring = {bad}")));
        assert!(shown.contains("scene.toml:4:"), "{bad}: {shown}");
    }
    for good in ["1e300", "0x10", "1_000", "\"1e-300 N/m\"", "+5"] {
        scene(&on_model(&format!("spring = {good}")));
    }
    let run = |run: &str| on_model("spring = 1").replace("duration = 1", run);
    assert!(messages(&run("duration = -1")).contains("`duration` must be zero or positive"));
    assert!(scene(&run("duration = 0")).run.duration == 0.0);
    for samples in ["0", "-1", "1.5", "10000001", "\"5\""] {
        assert!(messages(&run(&format!("duration = 1\nsamples = {samples}"))).contains("samples"));
    }
    assert_eq!(scene(&run("duration = 1\nsamples = 10_000_000")).run.samples, 10_000_000);
}
