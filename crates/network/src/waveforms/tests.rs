use std::f64::consts::PI;

use dashpot_dae::Piece;

use super::*;

#[test]
fn half_sine_has_its_peak_in_the_middle_and_is_zero_outside() {
    let pulse = HalfSine { peak: 2.0, duration: 0.5, start: 0.25 }.waveform().unwrap();
    assert!((pulse.value(0.5) - 2.0).abs() < 1e-15);
    assert!(pulse.value(0.2) == 0.0 && pulse.value(0.76) == 0.0);
    assert!(pulse.breakpoints().eq([0.25, 0.75]));
}

#[test]
fn sine_keeps_its_phase() {
    let wave = Sine { amplitude: 3.0, frequency: 2.0, phase: PI / 6.0 }.waveform().unwrap();
    assert!((wave.value(0.0) - 1.5).abs() < 1e-15);
    assert!(
        (wave.piece_at(0.0).derivative(1, 0.0) - 3.0 * 4.0 * PI * (PI / 6.0).cos()).abs() < 1e-13
    );
}

#[test]
fn a_table_jumps_where_a_time_stands_twice() {
    let table = Table::sample().waveform().unwrap();
    let jumps: Vec<(f64, f64)> = table.jumps().collect();
    assert!(
        jumps.len() == 1 && (jumps[0].0 - 0.5).abs() < 1e-15 && (jumps[0].1 + 1.0).abs() < 1e-15
    );
    assert!((table.value(0.25) - 1.0).abs() < 1e-15);
    assert!((table.value(0.5) - 1.0).abs() < 1e-15);
    assert!(table.value(7.0) == 0.0);
}

#[test]
fn a_table_out_of_order_is_refused() {
    let table = Table::of(vec![(1.0, 0.0), (0.5, 1.0)]);
    assert!(table.waveform().unwrap_err().to_string().contains("in order of time"));
    let nan = Table::of(vec![(0.0, 0.0), (f64::NAN, 1.0)]);
    assert!(nan.waveform().is_err());
}

#[test]
fn a_ramp_is_continuous() {
    let ramp = Ramp { height: 2.0, rise: 0.5, start: 0.25 }.waveform().unwrap();
    assert!((ramp.value(0.5) - 1.0).abs() < 1e-15 && (ramp.value(9.0) - 2.0).abs() < 1e-15);
    assert!(ramp.jumps().next().is_none());
}

#[test]
fn a_haversine_begins_and_ends_without_a_kink() {
    let pulse = Haversine { peak: 2.0, duration: 0.5, start: 0.25 }.waveform().unwrap();
    assert!((pulse.value(0.5) - 2.0).abs() < 1e-15 && (pulse.value(0.375) - 1.0).abs() < 1e-15);
    assert!(pulse.value(0.2) == 0.0 && pulse.value(0.76) == 0.0);
    assert!(pulse.jumps().next().is_none());
    for time in pulse.breakpoints() {
        for piece in pulse.pieces() {
            assert!(piece.derivative(1, time).abs() < 1e-13);
        }
    }
    let impulse = pulse.integral().unwrap();
    assert!((impulse.value(9.0) - 0.5).abs() < 1e-15);
}

#[test]
fn a_trapezoid_has_its_area_and_jumps_only_where_a_side_is_upright() {
    let pulse = Trapezoid { peak: 2.0, rise: 0.125, hold: 0.25, fall: 0.375, start: 0.25 };
    let area = |pulse: Trapezoid| pulse.waveform().unwrap().integral().unwrap().value(9.0);
    let jumps =
        |pulse: Trapezoid| pulse.waveform().unwrap().jumps().map(|jump| jump.1).collect::<Vec<_>>();
    assert!((area(pulse) - 1.0).abs() < 1e-15);
    assert!(jumps(pulse).is_empty());
    assert_eq!(jumps(Trapezoid { fall: 0.0, ..pulse }), [-2.0]);
    assert_eq!(jumps(Trapezoid { rise: 0.0, ..pulse }), [2.0]);
    let block = Trapezoid { rise: 0.0, fall: 0.0, ..pulse };
    assert_eq!(jumps(block), [2.0, -2.0]);
    assert!((area(block) - 0.5).abs() < 1e-15);
    let tooth = Trapezoid { hold: 0.0, fall: 0.0, ..pulse };
    assert!((area(tooth) - 0.125).abs() < 1e-15);
    assert_eq!(tooth.waveform().unwrap().pieces().len(), 3);
    let nothing = Trapezoid { rise: 0.0, hold: 0.0, fall: 0.0, ..pulse };
    assert!(nothing.waveform().is_err());
    let short = Trapezoid { rise: 1e-20, start: 1.0, ..pulse };
    let message = short.waveform().unwrap_err().to_string();
    assert!(message.contains("`rise`") && message.contains("tell its ends apart"), "{message}");
}

#[test]
fn a_chirp_passes_through_its_cycles_and_goes_on_smoothly() {
    // From 1 to 4 Hz in 0.5 s: 1.25 cycles, so it ends at its crest.
    let chirp = Chirp::sample().waveform().unwrap();
    let end = 0.75;
    assert!((chirp.value(end) - 3.0).abs() < 1e-13);
    assert!(chirp.value(0.2) == 0.0);
    // s + 3 s² = ½ is the first zero within.
    let zero = 0.25 + (7_f64.sqrt() - 1.0) / 6.0;
    assert!(chirp.value(zero).abs() < 1e-14);
    assert!(chirp.jumps().next().is_none());
    let [swept, steady] = [1, 2].map(|k| chirp.pieces()[k]);
    assert!((swept.frequency(end) - 8.0 * PI).abs() < 1e-13);
    for order in 0..2 {
        let [before, after] = [swept, steady].map(|piece| piece.derivative(order, end));
        assert!((before - after).abs() < 1e-12, "{order}: {before} {after}");
    }
    assert!((chirp.value(end + 0.25) - 3.0).abs() < 1e-13);
    let down = Chirp { from: 4.0, to: 0.0, ..Chirp::sample() }.waveform().unwrap();
    assert!((down.value(9.0) - down.value(end)).abs() < 1e-15);
    let still = Chirp { from: 0.0, to: 0.0, ..Chirp::sample() };
    assert!(still.waveform().unwrap_err().to_string().contains("positive where `from` is 0"));
    assert!(Chirp { from: -1.0, ..Chirp::sample() }.waveform().is_err());
}

#[test]
fn accelerations_become_displacements_without_a_kink() {
    let twice = |waveform: Waveform| waveform.integral()?.integral();
    let pulses = [
        HalfSine { peak: 500.0, duration: 0.011, start: 0.003 }.waveform(),
        Haversine { peak: 500.0, duration: 0.011, start: 0.003 }.waveform(),
        Trapezoid { peak: 500.0, rise: 0.001, hold: 0.0, fall: 0.01, start: 0.003 }.waveform(),
        Trapezoid { peak: 500.0, rise: 0.0, hold: 0.011, fall: 0.0, start: 0.003 }.waveform(),
        Constant { value: 500.0, start: 0.003 }.waveform(),
        Sine { amplitude: 500.0, frequency: 30.0, phase: 0.4 }.waveform(),
    ];
    for pulse in pulses {
        let pulse = pulse.unwrap();
        let motion = twice(pulse.clone()).unwrap();
        assert!(motion.jumps().next().is_none());
        for time in motion.breakpoints() {
            let [before, after] = [time - 1e-9, time].map(|t| *motion.piece_at(t));
            let rates = [before, after].map(|piece| piece.derivative(1, time));
            assert!((rates[0] - rates[1]).abs() < 1e-12, "{rates:?}");
        }
        for k in 0..30 {
            let t = 1e-3 * f64::from(k) + 1e-4;
            let found = motion.piece_at(t).derivative(2, t);
            assert!((found - pulse.value(t)).abs() < 1e-11, "{found}");
        }
    }
    assert_eq!(twice(Chirp::sample().waveform().unwrap()), None);
}

#[test]
fn the_velocity_of_a_motion_is_told_by_its_kind() {
    let jumping =
        Table { points: vec![(0.0, 0.0), (0.1, 2.0), (0.1, 0.5), (0.3, 0.0)], outside: None };
    let velocities = [
        ("half-sine", HalfSine { peak: 2.0, duration: 0.05, start: 0.01 }.waveform()),
        ("haversine", Haversine { peak: 3.0, duration: 0.05, start: 0.0 }.waveform()),
        ("sine", Sine { amplitude: 2.0, frequency: 7.0, phase: 0.4 }.waveform()),
        ("table", jumping.waveform()),
    ];
    for (word, velocity) in velocities {
        let velocity = velocity.unwrap();
        let motion = velocity.integral().unwrap();
        let found = Recognized::as_velocity(&motion).unwrap_or_else(|| panic!("{word}"));
        assert_eq!(found.word, word);
        let again = found.with(&found.values).unwrap();
        for at in 0..60 {
            let time = 0.005 * f64::from(at) + 0.0012;
            assert!((again.value(time) - velocity.value(time)).abs() < 1e-12, "{word} at {time}");
        }
    }
    let swept = Recognized::as_velocity(
        &Waveform::new(vec![Piece { sine: 1.0, omega: 3.0, sweep: 1.0, ..Piece::default() }])
            .unwrap(),
    );
    assert!(swept.is_none());
}
