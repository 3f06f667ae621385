//! Pads so long that waves travel in them.

use super::{close, solved};

#[test]
fn a_blow_on_a_bar_arrives_with_the_speed_of_waves_and_begins_with_the_impedance() {
    let solved = solved("polymer-bar");
    let (modulus, density, length, area): (f64, f64, f64, f64) = (3e9, 1150.0, 0.6, 3e-4);
    let (mass, blow) = (0.3, 2.0);
    let wave = f64::sqrt(modulus / density);
    let arrival = length / wave;
    let impedance = density * wave * area;
    let near = solved.signal("bar.contact.force");
    let far = solved.signal("cell.force");
    // Before the echo, the hammer is braked by the impedance alone: F = Z V e^(−Z t/m).
    let before = 2.0 * arrival;
    let impulse = near.integral((0.0, 0.9 * before));
    let expected = mass * blow * (1.0 - (-impedance * 0.9 * before / mass).exp());
    close("impulse before the echo", impulse, expected, 0.02 * expected);
    // Half of the first rise of the force at the held end, which is twice that of the wave.
    let half = impedance * blow;
    let time = far.first_crossing(half, (0.0, 3.0 * arrival), Some(true)).unwrap().time;
    close("arrival, L/c", time, arrival, 0.03 * arrival);
}
