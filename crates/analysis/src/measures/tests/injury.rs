//! Injury criteria of given signals against closed forms.

use super::*;

const G: f64 = STANDARD_GRAVITY;

fn run() -> WindowWish {
    WindowWish::Run
}

fn hic(cap: f64) -> Hic {
    Hic { cap, window: run() }
}

/// The place of the largest `w (mean(w))^2.5` over windows of the width `w` around the middle of a
/// pulse: where its edge is 0.6 times its mean.
fn best(edge: impl Fn(f64) -> f64, mean: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.01, 0.99);
    for _ in 0..200 {
        let middle: f64 = 0.5 * (low + high);
        *(if edge(middle) > 0.6 * mean(middle) { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

fn haversine(_: &str, t: f64) -> f64 {
    -G * (PI * t).sin().powi(2)
}

fn triangle(_: &str, t: f64) -> f64 {
    G * (1.0 - (2.0 * t - 1.0).abs())
}

fn sine(_: &str, t: f64) -> f64 {
    G * (PI * t).sin()
}

fn rectangle(_: &str, _: f64) -> f64 {
    -G
}

/// Level and mean of a pulse's middle part, over the part.
type Shape<'s> = &'s dyn Fn(f64) -> (f64, f64);

#[test]
fn severity_index_and_hic_of_four_pulses_have_their_closed_forms() {
    // Of a window of the width w around the middle: the height at its edge, and the mean.
    let of_sine = |w: f64| ((0.5 * PI * w).cos(), (0.5 * PI * w).sin() / (0.5 * PI * w));
    let of_haversine = |w: f64| {
        let u = 0.5 * PI * w;
        (u.cos().powi(2), 0.5 * (u + u.sin() * u.cos()) / u)
    };
    let of_triangle = |w: f64| (1.0 - w, 1.0 - 0.5 * w);
    // ∫ sin^2.5 = Γ(7/4)/(√π Γ(9/4)) by 30 digits, ∫ sin^5 = 16/(15 π).
    let indices = [0.457_655_858_101_087_9, 16.0 / (15.0 * PI), 2.0 / 7.0, 1.0];
    let shapes: [Option<Shape<'_>>; 4] =
        [Some(&of_sine), Some(&of_haversine), Some(&of_triangle), None];
    let pulses = [sine, haversine, triangle, rectangle];
    for ((signal, index), shape) in pulses.into_iter().zip(indices).zip(shapes) {
        let window = run();
        let found = read(SeverityIndex { exponent: 2.5, window }, 1.0, signal);
        close(found.value, index, 1e-12);
        let found = read(hic(1e6), 1.0, signal);
        let width = shape.map_or(1.0, |shape| best(|w: f64| shape(w).0, |w: f64| shape(w).1));
        let mean = shape.map_or(1.0, |shape| shape(width).1);
        close(found.value, width * mean.powf(2.5), 1e-12);
        let (from, to) = found.window.unwrap();
        assert!((to - from - width).abs() < 1e-6, "{from} {to} {width}");
        // A window that is capped lies around the middle as well.
        for cap in [0.05, 0.3] {
            let found = read(hic(cap), 1.0, signal);
            let mean = shape.map_or(1.0, |shape| shape(cap).1);
            close(found.value, cap * mean.powf(2.5), 1e-12);
        }
    }
}

#[test]
fn clip_of_a_half_sine_has_its_closed_form() {
    let window = run();
    for counted in [Counted::Together, Counted::AtOnce] {
        let clip = |duration| Clip { duration, counted, window };
        let found = read(clip(0.5), 1.0, sine);
        close(found.value, G * (0.25 * PI).cos(), 1e-12);
        close(read(clip(2.0), 1.0, sine).value, 0.0, 0.0);
        assert!(read(clip(2.0), 1.0, sine).notes == [Note::WindowTooShort]);
    }
    let short = read(Clip3ms { counted: Counted::AtOnce, window }, 1.0, sine);
    close(short.value, G * (0.0015 * PI).cos(), 1e-12);
    // Over a whole period, both arches count together.
    let both = read(Clip { duration: 1.0, counted: Counted::Together, window }, 2.0, sine);
    close(both.value, G * (0.25 * PI).cos(), 1e-12);
}

#[test]
fn dynamic_response_index_of_a_step_overshoots_by_its_damping() {
    let ratio: f64 = 0.224;
    let overshoot = 1.0 + (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
    close(read(Dri::default(), 1.0, rectangle).value, overshoot, 1e-11);
    // What sets in slowly presses it as gravity would.
    let slow = |_: &str, t: f64| G * (PI * t / 60.0).sin();
    let found = read(Dri::default(), 60.0, slow).value.unwrap();
    assert!((found - 1.0).abs() < 1e-4, "{found}");
}

#[test]
fn displacement_index_is_that_of_its_network() {
    // 1 kg on a spring of 400 N/m under a half-sine of 1 s: y = A/(ω² − p²)(sin pt − p/ω sin ωt).
    let model = part(Spring { stiffness: 400.0 });
    let edi = Edi { model, mass: 1.0, window: run() };
    let (omega, p) = (20.0, PI);
    let exact =
        |t: f64| G / (omega * omega - p * p) * ((p * t).sin() - p / omega * (omega * t).sin());
    let largest = (0..=100_000).map(|at| exact(1e-5 * f64::from(at)).abs()).fold(0.0, f64::max);
    let found = read(edi, 1.0, sine).value.unwrap();
    // The grid misses the top by its curvature over 1e-5 s.
    assert!((found / largest - 1.0).abs() < 1e-7, "{found} {largest}");
}

#[test]
fn transmissibility_is_a_quotient_of_peaks() {
    let same = Transmissibility { from: "head".to_owned(), window: run() };
    close(read(same, 1.0, sine).value, 1.0, 1e-15);
    let other = Transmissibility { from: "nobody".to_owned(), window: run() };
    assert!(read(other, 1.0, sine).notes == [Note::NoNode("nobody".to_owned())]);
    let none = Transmissibility { from: "head".to_owned(), window: run() };
    assert_eq!(read(none, 1.0, |_, _| 0.0).value, None);
}
