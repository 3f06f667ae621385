//! Random trees: the model object against the simulated network.

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    part,
};
use dashpot_numerics::Stream;

use super::*;

/// A tree of springs and dashpots whose times C/K spread over six decades.
fn tree(stream: &mut Stream, depth: u32) -> Model {
    if depth == 0 || stream.share() < 0.25 {
        return if stream.share() < 0.5 {
            part(Spring { stiffness: stream.between(1e5, 1e8) })
        } else {
            part(Dashpot { damping: stream.between(1e2, 1e5) })
        };
    }
    let count = if stream.share() < 0.5 { 2 } else { 3 };
    let branches: Vec<Model> = (0..count).map(|_| tree(stream, depth - 1)).collect();
    if stream.share() < 0.5 { Model::series(branches) } else { Model::parallel(branches) }
}

#[test]
fn the_model_object_and_the_network_agree() {
    let kinds =
        ["creep", "creep-recovery", "load-hold-unload", "relaxation", "constant-rate", "sweep"];
    let mut stream = Stream::new(2024);
    let (mut compared, mut beyond, mut coarse) = (0, 0, 0);
    for case in 0..100 {
        let specimen = Specimen::new(&tree(&mut stream, 4)).unwrap();
        for kind in kinds {
            let test = protocol(kind, &[("points", 40.0)]).unwrap();
            let report = test.run(&specimen, &default_methods()).unwrap();
            for series in &report.series {
                for found in series.computed.iter().filter_map(|own| own.difference) {
                    let stated = found.stated.unwrap() + ROUNDING;
                    let what = format!("{case} {kind} {}: {found:?}", series.name);
                    assert!(found.relative <= 10.0 * stated, "{what}");
                    // In a sweep the scale is the magnitude at the same frequency.
                    assert!(found.relative <= 1e-10_f64.max(stated), "{what}");
                    compared += 1;
                    beyond += usize::from(found.relative > stated);
                    coarse += usize::from(found.relative > 1e-10);
                }
            }
        }
    }
    assert!(100 * beyond <= compared, "{beyond} of {compared} are further apart than stated");
    assert!(100 * coarse <= compared, "{coarse} of {compared} are further apart than 1e-10");
}
