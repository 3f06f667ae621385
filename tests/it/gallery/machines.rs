//! Things on supports that move, in closed form.

use std::f64::consts::TAU;

use super::{G0, by_hand, close, solved};

/// The forced oscillator `ÿ + 2 δ ẏ + ω² y = p + a sin(Ω t) + b cos(Ω t)`, lightly damped.
struct Oscillator {
    /// Half the damping over the mass, `δ` \[1/s\].
    decay: f64,
    /// `ω²` \[1/s²\].
    square: f64,
    constant: f64,
    /// Of `sin(Ω t)` and `cos(Ω t)` in the steady part.
    steady: [f64; 2],
    /// `Ω` \[rad/s\].
    omega: f64,
    /// Of `e^(−δ t) cos(ω' t)` and `e^(−δ t) sin(ω' t)`.
    free: [f64; 2],
}

impl Oscillator {
    fn new(
        [decay, square]: [f64; 2],
        constant: f64,
        [a, b]: [f64; 2],
        omega: f64,
        [start, rate]: [f64; 2],
    ) -> Self {
        let (p, q) = (square - omega * omega, 2.0 * decay * omega);
        let size = p * p + q * q;
        let steady = [(p * a + q * b) / size, (p * b - q * a) / size];
        let own = f64::sqrt(square - decay * decay);
        let first = start - constant / square - steady[1];
        let second = (rate - omega * steady[0] + decay * first) / own;
        Self { decay, square, constant, steady, omega, free: [first, second] }
    }

    /// Deflection and rate.
    fn at(&self, t: f64) -> [f64; 2] {
        let own = f64::sqrt(self.square - self.decay * self.decay);
        let ([s, c], [sine, cosine]) =
            ([(self.omega * t).sin(), (self.omega * t).cos()], [(own * t).sin(), (own * t).cos()]);
        let fading = (-self.decay * t).exp();
        let ([a, b], [first, second]) = (self.steady, self.free);
        [
            self.constant / self.square + a * s + b * c + fading * (first * cosine + second * sine),
            self.omega * (a * c - b * s)
                + fading
                    * ((own * second - self.decay * first) * cosine
                        - (own * first + self.decay * second) * sine),
        ]
    }
}

#[test]
fn a_parcel_lifts_off_flies_and_meets_the_cushion_at_the_times_in_closed_form() {
    let solved = solved("truck-parcel");
    let (mass, k, c) = (12.0, 120e3, 480.0);
    let (amplitude, omega) = (5e-3, 9.0 * TAU);
    assert!(amplitude * omega * omega > G0, "the bed must shake with more than 1 g");
    let static_equilibrium = mass * G0 / k;
    let deformation = solved.signal("cushion.deformation");
    close("static sag, m g/k", deformation.value(0.0), static_equilibrium, 1e-12);
    // The bed is at −A sin Ω t; y is how far the cushion is pressed in.
    let bed = |t: f64| -amplitude * (omega * t).sin();
    let way = Oscillator::new(
        [0.5 * c / mass, k / mass],
        G0,
        [-amplitude * omega * omega, 0.0],
        omega,
        [static_equilibrium, amplitude * omega],
    );
    let push = |t: f64| k * way.at(t)[0] + c * way.at(t)[1];
    let first = (1..1000).map(|at| f64::from(at) * 1e-4).find(|&t| push(t) < 0.0).unwrap();
    let lifts = by_hand::zero(first - 1e-4, first, push);
    let contact = "cushion.contact";
    close("it lifts off", solved.times(contact, "open")[0], lifts, 1e-9);
    // In flight the parcel falls freely, and the cushion returns by itself.
    let [pressed, rate] = way.at(lifts);
    let speed = rate - amplitude * omega * (omega * lifts).cos();
    let start = pressed + bed(lifts);
    let gap = |t: f64| {
        let own = t - lifts;
        let parcel = start + speed * own + 0.5 * G0 * own * own;
        bed(t) + pressed * (-k / c * own).exp() - parcel
    };
    let second = (1..2000).map(|at| lifts + 1e-3 + f64::from(at) * 1e-4);
    let second = second.into_iter().find(|&t| gap(t) < 0.0).unwrap();
    let lands = by_hand::zero(second - 1e-4, second, gap);
    close("it lands", solved.times(contact, "closed")[0], lands, 1e-9);
    let height = solved.signal("parcel.position");
    for part in [0.2, 0.5, 0.8] {
        let own = part * (lands - lifts);
        let expected = start + speed * own + 0.5 * G0 * own * own;
        close("free flight", height.value(lifts + own), expected, 1e-9);
    }
}

#[test]
fn a_slide_sticks_breaks_loose_and_sticks_again_in_closed_form() {
    let solved = solved("machine-slide");
    let (mass, k, friction): (f64, f64, f64) = (180.0, 4e6, 600.0);
    let (amplitude, omega) = (0.5e-3, 2.0 * TAU);
    // It breaks loose when the drive is ahead by what the friction can hold.
    let loose = (friction / (k * amplitude)).asin() / omega;
    close("it breaks loose", solved.times("guides.friction", "sliding forward")[0], loose, 1e-9);
    // With time from then on: m ẍ = k (A sin(Ω (t + t1)) − x) − F_c.
    let (sine, cosine) = (omega * loose).sin_cos();
    let drive = [k * amplitude * cosine / mass, k * amplitude * sine / mass];
    let way = Oscillator::new([0.0, k / mass], -friction / mass, drive, omega, [0.0, 0.0]);
    let first = (1..100_000).map(|at| f64::from(at) * 1e-5).find(|&t| way.at(t)[1] < 0.0).unwrap();
    let stuck = by_hand::zero(first - 1e-5, first, |t| way.at(t)[1]);
    let sticks = solved.times("guides.friction", "stuck");
    close("it sticks", sticks[0], loose + stuck, 1e-8);
    let position = solved.signal("slide.position");
    for part in [0.25, 0.5, 0.75, 1.0] {
        let own = part * stuck;
        close("on its way", position.value(loose + own), way.at(own)[0], 1e-12);
    }
    // What the guides took is friction times the way, to and fro.
    let velocity = solved.signal("slide.velocity");
    let travelled = velocity.integral_of((0.0, 0.5), &[0.0], f64::abs);
    let lost = solved.first().energy.total_dissipated();
    close("friction times way", lost, friction * travelled, 1e-8 * lost);
}

#[test]
fn a_shock_through_isolators_is_the_forced_oscillation_in_closed_form() {
    let solved = solved("shock-table");
    let (mass, k, c) = (3.0, 18e3, 46.0);
    let (peak, duration) = (40.0 * G0, 11e-3);
    let own = [0.5 * c / mass, k / mass];
    let omega = std::f64::consts::PI / duration;
    // y is how far the isolators are pressed in; the table drives it with minus its acceleration.
    let pulse = Oscillator::new(own, 0.0, [-peak, 0.0], omega, [0.0, 0.0]);
    let after = Oscillator::new(own, 0.0, [0.0, 0.0], omega, pulse.at(duration));
    let way = |t: f64| if t < duration { pulse.at(t) } else { after.at(t - duration) };
    let reads = |t: f64| -(k * way(t)[0] + c * way(t)[1]) / mass;
    let (deformation, felt) =
        (solved.signal("isolators.deformation"), solved.signal("instrument.acceleration"));
    for at in 1..300 {
        let t = 0.5e-3 * f64::from(at);
        close("deformation", deformation.value(t), way(t)[0], 1e-9);
        close("acceleration", felt.value(t), reads(t), 1e-6);
    }
    let (largest, error) = solved.measure("instrument.peak-acceleration");
    let sampled = (0..150_000).map(|at| reads(1e-6 * f64::from(at)).abs()).fold(0.0, f64::max);
    close("peak", largest, sampled, error + 1e-6 * largest);
    // The table goes on with the speed that the pulse gave it, 2 a T/π.
    let speed = solved.signal("table.velocity").value(0.1);
    close("speed of the table", speed, 2.0 * peak * duration / std::f64::consts::PI, 1e-9);
}
