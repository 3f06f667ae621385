//! The two evaluations, which share no arithmetic, against each other on scenes of all sorts, and outputs that share
//! panels against those on panels of their own.

use dashpot_numerics::chebyshev;

use super::{Scene, Sequence, Solved};
use crate::{
    Budget, Dense, Piece, Waveform,
    exact::{
        Augmented, Solution,
        coordinates::follow,
        modal_row::ModalRow,
        modes::Modes,
        panels::{Tally, interpolate},
        propagator::Grid,
        tables::Tables,
    },
};

/// Masses joined by springs and dashpots at random, some of them free of the ground, driven by
/// every kind of piece.
fn network(random: &mut Sequence) -> (Scene, f64) {
    let count = 1 + random.index(6);
    // In every other network many values are equal, and so are many rates.
    let alike = random.index(2) == 0;
    let value = |random: &mut Sequence| {
        if alike { [1.0, 1.0, 10.0][random.index(3)] } else { random.decades(3.0) }
    };
    let masses: Vec<f64> = (0..count).map(|_| value(random)).collect();
    let mut rows = vec![vec![0.0; 2 * count]; 2 * count];
    for (k, row) in rows.iter_mut().enumerate().take(count) {
        row[count + k] = 1.0;
    }
    let elements = 1 + random.index(3 * count);
    for element in 0..elements {
        let offset = if element % 3 == 1 { count } else { 0 };
        let value = value(random);
        let (a, b) = (random.index(count), random.index(count + 1));
        if a == b {
            continue;
        }
        rows[count + a][offset + a] -= value / masses[a];
        if b < count {
            rows[count + a][offset + b] += value / masses[a];
            rows[count + b][offset + a] += value / masses[b];
            rows[count + b][offset + b] -= value / masses[b];
        }
    }
    let initial: Vec<f64> = (0..2 * count).map(|_| random.next() - 0.5).collect();
    let views: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let end = 10.0 * random.next();
    let mut scene = Scene::new(&views, &initial);
    for _ in 0..random.index(3) {
        let mut start = -random.next();
        let mut pieces = Vec::new();
        for _ in 0..=random.index(4) {
            let mut piece = Piece { start, value: random.next(), ..Piece::default() };
            match random.index(3) {
                0 => piece.slope = random.next() - 0.5,
                1 => (piece.sine, piece.omega) = (1.0, 1.0 + random.index(3) as f64),
                _ => {}
            }
            pieces.push(piece);
            start += 0.01 + end * random.next();
        }
        let row = count + random.index(count);
        scene = scene.driven(row, random.next(), 0, Waveform::new(pieces).unwrap());
    }
    (scene, end)
}

fn compare(solved: &Solved, allowed: f64) {
    let end = solved.trajectory.t_end;
    let times: Vec<f64> = (0..=20).map(|k| end * f64::from(k) / 20.0).collect();
    let marched = Solution::new(Augmented::new(&solved.system, end), (end, 1.0), Budget::default());
    let samples = marched.by_propagator(Grid { first: 0.0, step: end / 20.0, count: 21 });
    let size = solved.system.len();
    let signals: Vec<_> = (0..size).map(|output| solved.signal(output)).collect();
    let scale = signals.iter().fold(0.0_f64, |scale, signal| scale.max(signal.bound()));
    let apart = marched.apart();
    for (output, signal) in signals.iter().enumerate() {
        let error = signal.error.unwrap();
        // On panels of its own it is the same, within the errors of both.
        let alone = apart.signal(&solved.system, output);
        let room = error + alone.error.unwrap();
        for &t in &times {
            let off = (alone.value(t) - signal.value(t)).abs();
            assert!(off <= room, "output {output} at {t:e}: {off:e} beside {room:e}");
        }
        assert!(error <= allowed * scale, "stated error {error:e} at a scale of {scale:e}");
        for (k, &t) in times.iter().enumerate() {
            let off = samples[k * size + output] - signal.value(t);
            assert!(off.abs() <= allowed * scale, "output {output} at {t:e}: {off:e} at {scale:e}");
        }
    }
}

#[test]
fn modes_and_propagator_agree_on_random_networks() {
    let mut random = Sequence(20_240_229);
    for number in 0..600 {
        let state = random.0;
        let (scene, end) = network(&mut random);
        let solved = std::panic::catch_unwind(|| compare(&scene.solve(end), 1e-10));
        assert!(solved.is_ok(), "network {number}, sequence {state}");
    }
}

#[test]
fn without_eigenvalues_the_values_are_still_right() {
    let system = Scene::new(&[&[0.0, 1.0], &[-25.0, -0.5]], &[0.0, 1.0]).system();
    let augmented = Augmented::new(&system, 8.0);
    let modes = Modes::undivided(&augmented);
    let spans = follow(&augmented, &modes);
    let row = ModalRow::new(&modes, &augmented.form(system.outputs.at(0)));
    let (mut tally, mut pieces) = (Tally::default(), Vec::new());
    interpolate(
        &row,
        (&modes, &Tables::default()),
        &spans[0],
        (0.0, 8.0),
        0.2,
        (&mut tally, &Budget::default()),
        &mut pieces,
    );
    let w = 24.9375_f64.sqrt();
    for piece in &pieces {
        for x in [-1.0, -0.3, 0.4, 1.0] {
            let t = piece.start + 0.5 * (piece.end - piece.start) * (1.0 + x);
            let off =
                chebyshev::evaluate(&piece.coefficients, x) - (-0.25 * t).exp() * (w * t).sin() / w;
            assert!(off.abs() < 1e-13, "{t}: {off:e}");
        }
    }
    assert!(!tally.error.is_finite(), "no bound is claimed");
}
