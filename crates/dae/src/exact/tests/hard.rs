//! Stiffness, guards and refusals. Reference values are those of `many_digits.py`.

use super::Scene;
use crate::{
    Direction, Guard, Method, Outcome, Piece, Run, Silent, SolveError, UnknownKind, Waveform,
    methods::Exact,
};

/// A unit mass on Maxwell branches of unit stiffness: x, v and the dashpots' strokes.
fn maxwell_branches(relaxation_times: &[f64]) -> Vec<Vec<f64>> {
    let count = relaxation_times.len();
    let mut rows = vec![vec![0.0; count + 2]; count + 2];
    rows[0][1] = 1.0;
    rows[1][0] = -(count as f64);
    for (k, tau) in relaxation_times.iter().enumerate() {
        rows[1][2 + k] = 1.0;
        rows[2 + k][0] = 1.0 / tau;
        rows[2 + k][2 + k] = -(1.0 / tau);
    }
    rows
}

fn scene(rows: &[Vec<f64>], initial: &[f64]) -> Scene {
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    Scene::new(&rows, initial)
}

/// Compares outputs with their references: within the stated error, and that within `relative` of
/// the largest value.
fn judge(scene: &Scene, relative: f64, outputs: &[usize], table: &[(f64, &[f64])]) {
    let end = table.last().unwrap().0;
    let solved = scene.solve(end);
    for (place, &output) in outputs.iter().enumerate() {
        let signal = solved.signal(output);
        let error = signal.error.unwrap();
        let size = signal.absolute_maximum((0.0, end)).value;
        assert!(error <= relative * size, "stated error {error:e} at a size of {size:e}");
        for &(t, expected) in table {
            let off = signal.value(t) - expected[place];
            assert!(
                off.abs() <= error,
                "output {output} at {t:e} off by {off:e}, {error:e} stated"
            );
        }
    }
}

#[test]
fn thirteen_decades_of_relaxation_times() {
    let times = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];
    let mut initial = vec![0.0; 15];
    initial[1] = 1.0;
    judge(
        &scene(&maxwell_branches(&times), &initial),
        1e-13,
        &[0, 1],
        &[
            (1e-3, &[0.000_999_998_326_027_184_072, 0.999_995_049_331_244_893]),
            (1.0, &[0.190_931_542_562_047_158, -0.794_060_136_418_497_126]),
            (30.0, &[-0.003_903_810_290_784_393_87, -0.019_413_574_805_289_021_6]),
            (1e3, &[0.000_039_782_819_894_024_384_6, -2.251_408_895_040_376_93e-8]),
            (1e5, &[2.006_057_684_322_393_63e-6, -6.653_214_458_282_183_79e-12]),
            (1e6, &[9.086_258_992_876_915_12e-7, -4.642_258_327_694_574_6e-14]),
        ],
    );
}

#[test]
fn relaxation_times_twelve_decades_apart() {
    judge(
        &scene(&maxwell_branches(&[1e-9, 1e3]), &[0.0, 1.0, 0.0, 0.0]),
        2e-13,
        &[0, 1],
        &[
            (1e-9, &[1.000_000_000_000_000_06e-9, 1.0]),
            (1.0, &[0.841_509_938_835_784_131, 0.540_452_851_878_128_282]),
            (100.0, &[-0.481_500_202_919_081_425, 0.820_016_182_830_803_425]),
            (1e4, &[-0.001_044_763_363_405_602_74, -0.006_419_134_904_960_472_59]),
        ],
    );
}

#[test]
fn mass_ratio_of_a_million_millions() {
    let rows: [&[f64]; 4] = [
        &[0.0, 0.0, 1.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
        &[-2e12, 1e12, 0.0, 0.0],
        &[1.0, -2.0, 0.0, 0.0],
    ];
    judge(
        &Scene::new(&rows, &[0.0, 0.0, 0.0, 1.0]),
        1e-13,
        &[0, 1],
        &[
            (1e-6, &[1.507_720_006_816_800_94e-7, 9.999_999_999_967_456_9e-7]),
            (0.125, &[0.062_256_379_326_812_598, 0.124_512_290_635_352_16]),
            (1.0, &[0.384_046_891_354_065_367, 0.768_094_119_612_359_129]),
        ],
    );
}

#[test]
fn a_chain_of_fifteen_masses() {
    let count = 15;
    let mut rows = vec![vec![0.0; 2 * count]; 2 * count];
    let stiffness = |k: usize| 1.0 + ((k * 7) % 11) as f64;
    let damping = |k: usize| 0.0625 * (1 + (k * 5) % 7) as f64;
    for k in 0..count {
        let mass = 1.0 + 0.125 * k as f64;
        rows[k][count + k] = 1.0;
        let row = &mut rows[count + k];
        for (offset, values) in
            [(0, &stiffness as &dyn Fn(usize) -> f64), (count, &damping as &dyn Fn(usize) -> f64)]
        {
            row[offset + k] = -(values(k) + values(k + 1)) / mass;
            if k > 0 {
                row[offset + k - 1] = values(k) / mass;
            }
            if k + 1 < count {
                row[offset + k + 1] = values(k + 1) / mass;
            }
        }
    }
    let mut initial = vec![0.0; 2 * count];
    initial[count] = 1.0;
    judge(
        &scene(&rows, &initial),
        1e-12,
        &[0, 14],
        &[
            (0.5, &[0.320_845_328_920_073_391, 1.019_337_803_376_117_31e-26]),
            (5.0, &[0.137_544_150_315_418_841, 0.000_035_761_551_520_959_401]),
            (50.0, &[0.032_193_305_319_332_634_1, 0.011_993_935_264_733_297_1]),
        ],
    );
}

#[test]
fn two_evaluations_that_share_nothing_agree_on_a_hundred_states() {
    let size = 100;
    let rows: Vec<Vec<f64>> = (0..size)
        .map(|i| {
            (0..size)
                .map(|j| {
                    let coupling = ((3 * i + 7 * j + i * j) as f64).sin() / 10.0;
                    if i == j { coupling - 1.0 } else { coupling }
                })
                .collect()
        })
        .collect();
    let solved = scene(&rows, &vec![1.0; size]).solve(3.0);
    let times: Vec<f64> = (0..=30).map(|k| 0.1 * f64::from(k)).collect();
    let samples = solved.samples(&times);
    for output in [0, 50, 99] {
        let signal = solved.signal(output);
        let error = signal.error.unwrap();
        assert!(error < 1e-10 * signal.bound(), "{error:e}");
        for (k, &t) in times.iter().enumerate() {
            let off = samples[k * size + output] - signal.value(t);
            assert!(off.abs() <= error, "output {output} at {t}: {off:e}, {error:e} stated");
        }
    }
}

#[test]
fn a_guard_ends_the_run_at_the_crossing() {
    let system = Scene::new(&[&[0.0, 1.0], &[-1.0, 0.0]], &[0.0, 1.0]).system();
    let guard = Guard {
        name: "velocity turns".to_owned(),
        output: 1,
        level: 0.0,
        direction: Direction::Falling,
        stops: true,
        begins: None,
        rate_of: None,
    };
    let run = Run { guards: vec![guard], ..Run::to(10.0) };
    let trajectory = Exact.integrate(&system, &run, &mut Silent).unwrap();
    assert_eq!(trajectory.outcome, Outcome::Stopped { guard: 0 });
    assert!((trajectory.t_end - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let signal = trajectory.signal(&system, 0);
    assert_eq!((signal.end(), trajectory.events.len()), (trajectory.t_end, 1));
    assert!((signal.value(signal.end()) - 1.0).abs() < 1e-15);
}

#[test]
fn a_decaying_tail_keeps_its_sign() {
    let signal = Scene::new(&[&[-1.0, 0.0], &[0.0, -2.0]], &[1.0, 1.0]).solve(1e4).signal(0);
    assert!(signal.crossings(0.0, (0.0, 1e4)).is_empty());
    assert!(signal.panels.len() < 60, "panels grow: {}", signal.panels.len());
}

#[test]
fn what_it_cannot_do_is_declined_with_the_reason() {
    let reason = |scene: &Scene, t_end: f64| {
        let declined = Exact.applies(&scene.system(), &Run::to(t_end)).unwrap_err();
        assert!(matches!(declined, SolveError::NotApplicable { .. }));
        declined.to_string()
    };
    let oscillator = Scene::new(&[&[0.0, 1.0], &[-1.0, 0.0]], &[0.0, 1.0]);
    assert!(reason(&oscillator, 1e7).contains("radians"));
    assert!(reason(&oscillator, 1e17).contains("‖A‖T = 1.0e17"));
    let many = scene(&vec![vec![0.0; 201]; 201], &[0.0; 201]);
    assert!(reason(&many, 1.0).contains("201 states"));
    let mut system = oscillator.system();
    system.unknowns[1].kind = UnknownKind::Algebraic;
    assert!(Exact.applies(&system, &Run::to(1.0)).is_err());
    let why = Exact.applies(&oscillator.system(), &Run::to(10.0)).unwrap();
    assert_eq!(why, "the scene is linear with 2 states");
}

#[test]
fn a_load_in_another_unit_changes_nothing() {
    for size in [1e-200, 1e-12, 1.0, 1e12, 1e200] {
        let drive = Waveform::new(vec![Piece { value: size, slope: size, ..Piece::default() }]);
        Scene::new(&[&[0.0, 1.0], &[-1.0, 0.0]], &[0.0, 0.0])
            .driven(1, 1.0, 0, drive.unwrap())
            .solve(20.0)
            .judge(0, 1e-12 * size, |t| size * (1.0 - t.cos() + t - t.sin()));
    }
}
