//! Ratings of generated pairs of curves, by a script.

use dashpot::{
    signal::{Channel, Rating},
    units::Dimension,
};

const COUNT: u32 = 260;

fn pulse(k: f64, begin: f64, length: f64) -> f64 {
    let place = (k - begin) / length;
    let inside = place > 0.0 && place < 1.0;
    if inside { (std::f64::consts::PI * place).sin().powi(2) } else { 0.0 }
}

fn test(k: f64) -> f64 {
    180.0 * pulse(k, 50.0, 110.0)
        + 9.0 * (0.31 * k).sin() * (-((k - 110.0) / 60.0).powi(2)).exp()
        + 0.4 * (0.05 * k + 1.0).sin()
}

fn model(name: &str, k: f64) -> f64 {
    match name {
        "same" => test(k),
        "higher" => 1.2 * test(k),
        "later" => test(k - 13.0),
        "earlier" => test(k + 21.0),
        "opposed" => -test(k),
        "shorter" => 205.0 * pulse(k, 58.0, 84.0) + 0.2 * (0.11 * k).sin(),
        "ringing" => test(k) + 25.0 * (0.9 * k).sin() * (-((k - 100.0) / 50.0).powi(2)).exp(),
        "far" => test(k - 80.0),
        "double" => 2.1 * test(k - 3.0) + 3.0 * (0.02 * k).sin(),
        _ => panic!("{name}"),
    }
}

fn channel(value: impl Fn(f64) -> f64) -> Channel {
    let times = (0..COUNT).map(|at| f64::from(at) * 1e-4).collect();
    let values = (0..COUNT).map(|at| value(f64::from(at))).collect();
    Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
}

#[test]
fn scores_are_those_of_the_script() {
    let mut count = 0;
    for line in include_str!("rating_reference.csv").lines().skip(2) {
        let (name, numbers) = line.split_once(',').unwrap();
        let expected: Vec<f64> = numbers.split(',').map(|own| own.parse().unwrap()).collect();
        let end = f64::from(COUNT - 1) * 1e-4;
        let found = Rating::of(&channel(test), &channel(|k| model(name, k)), (0.0, end)).unwrap();
        let parts = [found.corridor, found.phase, found.magnitude, found.slope, found.overall()];
        for (found, expected) in parts.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-9, "{line}: {parts:?}");
        }
        count += 1;
    }
    assert_eq!(count, 9);
}
