use std::f64::consts::PI;

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
    assert!((table.jump(0.5) + 1.0).abs() < 1e-15);
    assert!((table.value(0.25) - 1.0).abs() < 1e-15);
    assert!((table.value(0.5) - 1.0).abs() < 1e-15);
    assert!(table.jump(1.0) == 0.0);
    assert!(table.value(7.0) == 0.0);
}

#[test]
fn a_table_out_of_order_is_refused() {
    let table = Table { points: vec![(1.0, 0.0), (0.5, 1.0)] };
    assert!(table.waveform().unwrap_err().to_string().contains("in order of time"));
    let nan = Table { points: vec![(0.0, 0.0), (f64::NAN, 1.0)] };
    assert!(nan.waveform().is_err());
}

#[test]
fn a_ramp_is_continuous() {
    let ramp = Ramp { height: 2.0, rise: 0.5, start: 0.25 }.waveform().unwrap();
    assert!((ramp.value(0.5) - 1.0).abs() < 1e-15 && (ramp.value(9.0) - 2.0).abs() < 1e-15);
    assert!(ramp.breakpoints().all(|t| ramp.jump(t) == 0.0));
}
