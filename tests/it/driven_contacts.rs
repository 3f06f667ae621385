//! Contacts and sliders under loads and motions, by the methods that take steps.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    numerics::Stream,
    scene::{ReadOptions, read},
};

const STEPPING: [&str; 3] = ["bdf", "esdirk34", "tr-bdf2"];
const GRAVITY: f64 = 9.80665;

fn run_at(text: &str, method: &str, rtol: Option<f64>) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    let settings = SolveSettings { rtol, ..scene.settings(method).unwrap() };
    scene.network.solve_with(&settings).unwrap()
}

fn run(text: &str, method: &str) -> RunReport {
    run_at(text, method, None)
}

fn value(report: &RunReport, key: &str) -> (f64, f64) {
    let found = report.measure(key).unwrap();
    (found.value.unwrap(), found.error.unwrap())
}

/// A parcel on a bed that falls away under it and comes back.
const PERTURBED: &str = "[nodes]\n\
    parcel = { mass = \"4 kg\" }\n\
    bed = { motion = { haversine = { peak = \"0.7 mm\", duration = \"21 ms\" } } }\n\
    [elements.cushion]\n\
    between = [\"parcel\", \"bed\"]\n\
    parallel = [{ cubic-spring = { stiffness = \"500 kN/m\", cubic = 1e6 } }, { dashpot = \"1.3 kN s/m\" }]\n\
    [effects]\n\
    gravity = { start = \"unloaded\" }\n\
    separation.cushion = { at = \"parcel\" }\n\
    [measures]\n\
    parcel = [{ kind = \"peak-acceleration\", window = \"run\" }]\n\
    [run]\n\
    duration = \"0.2 s\"\n";

#[test]
fn parcel_that_a_bed_falls_away_from_meets_it_when_its_free_fall_does() {
    let bed = |time: f64| 0.7e-3 * (std::f64::consts::PI * time / 21e-3).sin().powi(2);
    let (mut before, mut after) = (5e-3, 20e-3);
    for _ in 0..60 {
        let time: f64 = 0.5 * (before + after);
        if 0.5 * GRAVITY * time * time < bed(time) { before = time } else { after = time }
    }
    let accurate = run_at(PERTURBED, "esdirk34", Some(1e-9));
    let (peak, own) = value(&accurate, "parcel.peak-acceleration");
    for method in STEPPING {
        let report = run(PERTURBED, method);
        let met = report.events.iter().find(|event| event.what.code() == "meets").unwrap();
        assert!((met.time / after - 1.0).abs() < 1e-4, "{method}: {} of {after}", met.time);
        let (found, error) = value(&report, "parcel.peak-acceleration");
        let gap = (found - peak).abs();
        assert!(gap <= error + own && error <= 1e-3 * peak, "{method}: {gap:e} of {error:e}");
    }
}

#[test]
fn slider_that_a_jump_of_the_load_sets_going_never_holds_more_than_its_force() {
    let text = "[nodes]\n\
        a = { mass = \"1 kg\" }\n\
        [elements]\n\
        f = { between = [\"a\", \"ground\"], friction = \"100 N\" }\n\
        s = { between = [\"a\", \"ground\"], cubic-spring = { stiffness = \"1 N/m\", cubic = 1 } }\n\
        [loads.p]\n\
        on = \"a\"\n\
        force = { trapezoid = { peak = \"500 N\", start = \"20 ms\", rise = \"0 s\", hold = \"5 ms\", \
        fall = \"0 s\" } }\n\
        [run]\n\
        duration = \"0.1 s\"\n";
    for method in STEPPING {
        let report = run(text, method);
        let (slider, _) = value(&report, "f.peak-force");
        assert!((slider - 100.0).abs() < 1e-9, "{method}: {slider}");
        let (acceleration, _) = value(&report, "a.peak-acceleration");
        assert!((acceleration - 400.0).abs() < 1e-6, "{method}: {acceleration}");
    }
}

/// A parcel on a stiffening cushion, whose bed is stopped: for a while the contact force is small beside
/// what the equations are scaled for.
const STOPPED: &str = "[nodes]\n\
    parcel = { mass = \"5.6 kg\" }\n\
    bed = { acceleration = { half-sine = { peak = \"-15 g0\", duration = \"21 ms\", start = \"21 ms\" } } }\n\
    [elements.cushion]\n\
    between = [\"parcel\", \"bed\"]\n\
    parallel = [{ cubic-spring = { stiffness = \"400 kN/m\", cubic = 6e13 } }, { dashpot = \"250 N s/m\" }]\n\
    [effects]\n\
    gravity = true\n\
    separation.cushion = { at = \"parcel\" }\n\
    [run]\n\
    duration = \"53 ms\"\n";

/// The energy that the cushion of [`STOPPED`] takes up \[J\], by the Runge-Kutta method of order four in steps of
/// 1 µs, until the contact force falls to zero; it does not come back.
fn taken_up_until_release() -> f64 {
    const STEP: f64 = 1e-6;
    let cushion = |y: f64, v: f64| 4e5 * y + 6e13 * y.powi(3) + 250.0 * v;
    let stop = |time: f64| {
        let phase = (time - 21e-3) / 21e-3;
        let inside = (0.0..=1.0).contains(&phase);
        if inside { -15.0 * GRAVITY * (std::f64::consts::PI * phase).sin() } else { 0.0 }
    };
    let slopes = |time: f64, [y, v, _]: [f64; 3]| {
        let force = cushion(y, v);
        [v, GRAVITY - stop(time) - force / 5.6, force * v]
    };
    let mut state = [1e-4, 0.0, 0.0];
    for _ in 0..100 {
        let y: f64 = state[0];
        state[0] -= (cushion(y, 0.0) - 5.6 * GRAVITY) / (4e5 + 1.8e14 * y * y);
    }
    let mut time = 21e-3;
    while cushion(state[0], state[1]) > 0.0 {
        let moved = |by: f64, slope: [f64; 3]| [0, 1, 2].map(|at| state[at] + by * slope[at]);
        let first = slopes(time, state);
        let second = slopes(time + 0.5 * STEP, moved(0.5 * STEP, first));
        let third = slopes(time + 0.5 * STEP, moved(0.5 * STEP, second));
        let last = slopes(time + STEP, moved(STEP, third));
        state = [0, 1, 2].map(|at| {
            state[at] + STEP / 6.0 * (first[at] + 2.0 * (second[at] + third[at]) + last[at])
        });
        time += STEP;
    }
    assert!((43.5e-3..43.53e-3).contains(&time), "{time}");
    state[2]
}

#[test]
fn no_contact_that_pulls_is_taken_for_accurate() {
    let energy = taken_up_until_release();
    // The third of them takes 200 000 steps.
    for method in &STEPPING[..2] {
        let report = run(STOPPED, method);
        let (found, error) = value(&report, "cushion.energy");
        assert!((found - energy).abs() <= error + 1e-7, "{method}: {found} {energy} by {error:e}");
        assert!(
            report.warnings.iter().all(|warning| !warning.code().contains("pulls")
                && !warning.to_string().contains("pulls")),
            "{:?}",
            report.warnings
        );
    }
}

#[test]
fn contact_that_pulls_at_a_given_tolerance_is_warned_of() {
    let report = run_at(STOPPED, "esdirk34", Some(1e-6));
    let told = |own: &&dashpot::analysis::Warning| {
        own.to_string().contains("cushion.contact pulls with 82")
    };
    assert_eq!(report.warnings.iter().filter(told).count(), 1, "{:?}", report.warnings);
}

/// A head on a spring and sliders side by side, which come to hold it until a load moves it again.
fn held(sliders: &[f64]) -> String {
    let slider = |(at, force): (usize, &f64)| {
        format!("slider{at} = {{ between = [\"head\", \"ground\"], friction = \"{force} N\" }}\n")
    };
    let sliders: String = sliders.iter().enumerate().map(slider).collect();
    format!(
        "[nodes]\nhead = {{ mass = \"2 kg\", velocity = \"1.3 m/s\" }}\n[elements]\n\
         spring = {{ between = [\"head\", \"ground\"], spring = \"1 kN/m\" }}\n{sliders}\
         [loads.push]\non = \"head\"\nforce = {{ table = [[0, 0], [0.2, 0], [0.2, 500]] }}\n\
         [run]\nduration = \"0.4 s\"\n"
    )
}

#[test]
fn impact_of_what_sliders_hold_ends_however_many_share_the_force() {
    let (one, own) = value(&run(&held(&[100.0]), "exact"), "head.severity-index");
    for sliders in [&[30.0, 70.0][..], &[26.2, 73.8], &[20.0, 33.0, 47.0]] {
        for method in ["exact", "bdf"] {
            let (found, error) = value(&run(&held(sliders), method), "head.severity-index");
            let gap = (found - one).abs();
            assert!(
                gap <= error + own && error < 1e-3 * one,
                "{method} {sliders:?}: {found} {one}"
            );
        }
    }
}

/// All methods that solve it.
const METHODS: [&str; 4] = ["exact", "bdf", "esdirk34", "tr-bdf2"];

fn is_near(report: &RunReport, key: &str, expected: f64) {
    let (found, error) = value(report, key);
    let allowed = error + 1e-12 * expected.abs();
    let method = &report.solver.method;
    assert!((found - expected).abs() <= allowed, "{method}: {key} {found} ± {error:e}, {expected}");
    assert!(error <= 2e-3 * expected.abs(), "{method}: {key} ± {error:e}");
}

#[test]
fn mass_that_a_slider_holds_to_a_floor_slips_where_the_floor_starts_and_stops() {
    // From rest to 3 m/s at once, and back to rest: twice 2 kg · 3 m/s : 100 N = 60 ms of sliding.
    let text = "[nodes]\n\
        floor = { motion = { ramp = { height = 0.3, rise = 0.1, start = 0.05 } } }\n\
        box = { mass = 2 }\n\
        [elements]\n\
        pad = { between = [\"floor\", \"box\"], friction = 100 }\n\
        [measures]\n\
        box = [\"peak-acceleration\", \"peak-displacement\"]\n\
        pad = [\"peak-deformation\", \"energy\"]\n\
        [run]\n\
        duration = 0.4\n";
    for method in METHODS {
        let report = run(text, method);
        is_near(&report, "pad.peak-deformation", 0.09);
        is_near(&report, "pad.energy", 18.0);
        is_near(&report, "box.peak-acceleration", 50.0);
        is_near(&report, "box.peak-displacement", 0.3);
        let switches: Vec<&str> =
            report.trajectory.switches.iter().map(|switch| switch.what).collect();
        let slips = ["sliding forward", "stuck", "sliding backward", "stuck"];
        assert_eq!(switches, slips, "{method}");
    }
}

#[test]
fn kinks_of_a_table_move_what_sticks_as_friction_lets_them() {
    // Between its points the floor goes at 1, −1 and 0.5 m/s; a change by Δv slides for m Δv / F and
    // takes m Δv² / 2.
    let text = "[nodes]\n\
        floor = { motion = { table = { points = [[0, 0], [0.1, 0], [0.2, 0.1], [0.3, 0], [0.5, 0.1]] } } }\n\
        box = { mass = 3 }\n\
        [elements]\n\
        pad = { between = [\"floor\", \"box\"], friction = 300 }\n\
        [measures]\n\
        pad = [\"energy\", \"impulse\"]\n\
        [run]\n\
        duration = 0.45\n";
    for method in METHODS {
        let report = run(text, method);
        is_near(&report, "pad.energy", 1.5 * (1.0 + 4.0 + 2.25));
        is_near(&report, "pad.impulse", 1.5);
    }
}

#[test]
fn floor_that_starts_and_stops_at_once_hits_and_throws_what_lies_on_it() {
    // It goes up at 3 m/s from 50 ms to 150 ms.
    let text = |restitution: f64| {
        format!(
            "[nodes]\n\
            ball = {{ mass = 2 }}\n\
            floor = {{ motion = {{ ramp = {{ height = -0.3, rise = 0.1, start = 0.05 }} }} }}\n\
            [elements]\n\
            pad = {{ between = [\"ball\", \"floor\"], contact = {{ restitution = {restitution} }} }}\n\
            [effects]\n\
            gravity = {{ value = 9.81, start = \"unloaded\" }}\n\
            [measures]\n\
            ball = [\"peak-displacement\"]\n\
            pad = [\"impulse\", \"energy\"]\n\
            [run]\n\
            duration = 0.6\n"
        )
    };
    for method in METHODS {
        // Carried by the floor, and thrown where it stops.
        let report = run(&text(0.0), method);
        is_near(&report, "pad.impulse", 2.0 * 3.0 + 2.0 * 9.81 * 0.15);
        is_near(&report, "pad.energy", 0.5 * 2.0 * 9.0);
        is_near(&report, "ball.peak-displacement", 0.3 + 4.5 / 9.81);
        // Hit where it starts, and thrown from there.
        let report = run(&text(0.5), method);
        is_near(&report, "pad.impulse", 2.0 * 4.5 + 2.0 * 9.81 * 0.05);
        is_near(&report, "pad.energy", 0.5 * 2.0 * 9.0 * 0.75);
    }
}

/// A knee that meets a foam pad on a car, which a pulse of so many corners with noise brakes.
fn knee(corners: u32, gap: f64, noise: f64) -> String {
    let mut stream = Stream::new(u64::from(corners));
    let row = |at: u32| {
        let time = 0.12 * f64::from(at) / f64::from(corners);
        let bump = |middle: f64, width: f64| (-((time - middle) / width).powi(2)).exp();
        let pulse = -20.0 * bump(0.03, 0.012) - 12.0 * bump(0.06, 0.02);
        let pulse = if at == 0 { 0.0 } else { pulse + noise * (stream.share() - 0.5) };
        format!("[{time:?}, {:?}]", pulse * GRAVITY)
    };
    let rows: Vec<String> = (0..=corners).map(row).collect();
    format!(
        "[materials]\nsoft = {{ foam = {{ modulus = \"0.8 MPa\", plateau = \"0.15 MPa\", densification = \"40 kPa\", \
         exponent = 2.5 }} }}\n[nodes]\ncar = {{ velocity = 12, acceleration = {{ table = [{}] }} }}\n\
         knee = {{ mass = 12, velocity = 12, position = {:?} }}\n[elements]\nskin = {{ between = [\"knee\", \"car\"], \
         material = \"soft\", thickness = 0.06, area = 0.008 }}\n[effects]\nseparation.skin = {{ at = \"knee\" }}\n\
         [run]\nduration = 0.12\n",
        rows.join(", "),
        -gap
    )
}

#[test]
fn a_measured_pulse_costs_few_steps_a_corner_wherever_the_pad_lets_go() {
    for corners in [55, 400] {
        for gap in [0.0, 0.005, 0.04, 0.05, 0.055] {
            let scene = knee(corners, gap, 3.0);
            let steps = |method: &str, most: usize| {
                let report = run_at(&scene, method, Some(1e-6));
                let steps = report.solver.statistics.accepted;
                let allowed = most * corners as usize + 200;
                assert!(steps <= allowed, "{method}, {corners} corners, gap {gap}: {steps}");
            };
            steps("dop853", 5);
            steps("bdf", 30);
        }
    }
}

#[test]
fn rows_of_noise_are_crossed_by_steps() {
    for rows in [600, 2400] {
        // Without a gap the force is at first what the noise makes of it, row by row.
        for (gap, most) in [(0.0, 2 * rows as usize), (0.05, 600)] {
            let scene = knee(rows, gap, 3.0);
            let own = run_at(&scene, "dop853", Some(1e-6));
            let steps = own.solver.statistics;
            assert!(steps.accepted <= most, "{rows} rows, gap {gap}: {steps:?}");
            assert!(steps.rejected <= most, "{rows} rows, gap {gap}: {steps:?}");
        }
    }
}

/// A mass on a soft pad, whose support is carried by a slight acceleration with a row every millisecond, and by rows from
/// number `at` on that carry it away and back.
fn carried(at: u32) -> String {
    let row = |row: u32| {
        let bump = match row.wrapping_sub(at) {
            1 | 7 => 400.0,
            3 | 5 => -400.0,
            _ => 0.0,
        };
        format!("[{:?}, {:?}]", 1e-3 * f64::from(row), 1e-3 + bump)
    };
    let rows: Vec<String> = (0..=2000).map(row).collect();
    format!(
        "[nodes]\nm = {{ mass = 10 }}\nbase = {{ velocity = 0, acceleration = {{ table = [{}] }} }}\n[elements]\npad = {{ \
         between = [\"base\", \"m\"], kelvin-voigt = {{ spring = 400, dashpot = 2 }} }}\n[measures]\npad = [{{ kind = \
         \"peak-deformation\", window = \"run\" }}]\n[run]\nduration = 2\n",
        rows.join(", ")
    )
}

#[test]
fn motions_that_come_back_are_not_missed_between_stages() {
    for at in (0..12).map(|number| 1000 + 7 * number) {
        let scene = carried(at);
        let [right, own] = ["exact", "dop853"].map(|method| run(&scene, method));
        let key = "pad.peak-deformation";
        let ((right, _), (found, error)) = (value(&right, key), value(&own, key));
        assert!((found - right).abs() <= 2.0 * error, "{at}: {found} ± {error:e}, {right}");
        assert!(error < 1e-2 * right, "{at}: {found} ± {error:e}");
        // Rows that carry it evenly ask for no steps.
        assert!(own.solver.statistics.accepted < 400, "{at}: {:?}", own.solver.statistics);
    }
}

/// A block on a pad before a plate on a mount; the mount, or the plate, is driven by so many rows of noise with a spike a
/// row wide.
fn noisy(rows: u32, drives: &str, unit: &str) -> String {
    let mut stream = Stream::new(u64::from(rows));
    let row = |at: u32| {
        let spike = if at == rows / 3 { 400.0 } else { 0.0 };
        let value = if at == 0 { 0.0 } else { 60.0 * (stream.share() - 0.5) + spike };
        format!("[\"{:?} s\", \"{value:?} {unit}\"]", 0.06 * f64::from(at) / f64::from(rows))
    };
    let rows: Vec<String> = (0..=rows).map(row).collect();
    format!(
        "[nodes]\nplate = {{ mass = \"2 kg\" }}\nblock = {{ mass = \"12 kg\", velocity = \"2 m/s\", position = \"-1 mm\" \
         }}\nbase = {{ velocity = 0{} }}\n[elements]\npad = {{ between = [\"block\", \"plate\"], kelvin-voigt = {{ \
         spring = \"80 kN/m\", dashpot = \"150 N s/m\" }} }}\nmount = {{ between = [\"plate\", \"base\"], kelvin-voigt = {{ \
         spring = \"200 kN/m\", dashpot = \"300 N s/m\" }} }}\n[effects]\nseparation.pad = {{ at = \"block\" }}\n{}\
         [run]\nduration = \"60 ms\"\n",
        if drives == "base" {
            format!(", acceleration = {{ table = [{}] }}", rows.join(", "))
        } else {
            String::new()
        },
        if drives == "plate" {
            format!("[loads.push]\non = \"plate\"\nforce = {{ table = [{}] }}\n", rows.join(", "))
        } else {
            String::new()
        }
    )
}

#[test]
fn what_is_driven_by_rows_of_noise_is_as_by_exact() {
    for (rows, drives, unit) in
        [(60, "base", "m/s^2"), (1200, "base", "m/s^2"), (1200, "plate", "N")]
    {
        let scene = noisy(rows, drives, unit);
        let right = run(&scene, "exact");
        for rtol in [None, Some(1e-5), Some(1e-8)] {
            let own = run_at(&scene, "dop853", rtol);
            for measure in &own.measures {
                let (Some(found), Some(error)) = (measure.value, measure.error) else { continue };
                let right = right.measure(&measure.key).unwrap().value.unwrap();
                let (key, within) = (&measure.key, 2.0 * error + 1e-11 * right.abs());
                assert!(
                    (found - right).abs() <= within,
                    "{rows} rows on {drives}, {rtol:?}, {key}: {found} ± {error:e}, {right}"
                );
            }
        }
    }
}

/// A mass at rest on a pad that stiffens, pushed to and fro within some milliseconds that leave it no speed.
fn pushed(start: f64, loads: &str) -> f64 {
    let scene = format!(
        "[nodes]\nm = {{ mass = 10 }}\n[elements]\npad = {{ between = [\"m\", \"ground\"], cubic-spring = {{ stiffness = 400, \
         cubic = 1e5 }} }}\n{loads}[run]\nduration = 4\n"
    );
    let [own, other] = ["auto", "bdf"].map(|method| value(&run(&scene, method), "pad.peak-force"));
    let within = own.1 + other.1;
    assert!((own.0 - other.0).abs() <= within, "{start}: {own:?}, {other:?}");
    own.0
}

#[test]
fn pushes_that_leave_no_speed_are_not_missed_between_stages() {
    let mass = 10.0;
    for at in 0..8 {
        let start = 1.0 + 0.02 * f64::from(at);
        let point = |after: f64, force: f64| format!("[{:?}, {force:?}]", start + after);
        let rows = [(0.0, 0.0), (2e-3, 4e3), (4e-3, 0.0), (6e-3, -4e3), (8e-3, 0.0)];
        let rows: Vec<String> = rows.iter().map(|own| point(own.0, own.1)).collect();
        let loads = format!(
            "[loads.f]\non = \"m\"\nforce = {{ table = {{ outside = \"zero\", points = [[0.0, 0.0], {}, [4.0, 0.0]] }} }}\n",
            rows.join(", ")
        );
        // It is moved by the impulse of 8 N s for 4 ms, which is the most that it ever moves.
        let moved: f64 = 8.0 / mass * 4e-3;
        let peak = pushed(start, &loads);
        let expected = 400.0 * moved + 1e5 * moved.powi(3);
        assert!((peak / expected - 1.0).abs() < 0.01, "{start}: {peak}, {expected}");
        let wave = |name: &str, peak: f64, after: f64| {
            format!(
                "[loads.{name}]\non = \"m\"\nforce = {{ haversine = {{ peak = {peak:?}, duration = 6e-3, start = {:?} }} }}\n",
                start + after
            )
        };
        pushed(start, &(wave("a", 4e3, 0.0) + &wave("b", -4e3, 7e-3)));
    }
}

#[test]
fn bars_under_a_measured_pulse_hold_where_its_corners_limit_the_steps() {
    for (corners, gap, noise) in [(120, 0.0, 6.0), (120, 0.005, 6.0), (30, 0.0, 3.0)] {
        let scene = knee(corners, gap, noise);
        let own = run(&scene, "auto");
        assert_eq!(own.solver.method, "dop853");
        let right = run_at(&scene, "bdf", Some(1e-11));
        for measure in &own.measures {
            let (Some(found), Some(error)) = (measure.value, measure.error) else { continue };
            let right = right.measure(&measure.key).unwrap().value.unwrap();
            // What the other method leaves.
            let within = 2.0 * error + 2e-8 * right.abs();
            let key = &measure.key;
            assert!(
                (found - right).abs() <= within,
                "{corners} {key}: {found} ± {error:e}, {right}"
            );
        }
    }
}

/// A head that moves with a panel until a record begins to brake that, after a rest \[ms\].
fn braked_after(rest: u32) -> String {
    let row = |after: u32, value: &str| format!("[\"{} ms\", \"{value} g\"]", rest + after);
    let rows = [row(0, "0"), row(10, "-40"), row(20, "0")].join(", ");
    let before = if rest > 0 { "[\"0 ms\", \"0 g\"], " } else { "" };
    format!(
        "[nodes]\npanel = {{ velocity = \"15 m/s\", acceleration = {{ table = {{ points = [{before}{rows}], outside = \
         \"zero\" }} }} }}\nhead = {{ mass = \"5 kg\", velocity = \"15 m/s\" }}\n[elements]\npad = {{ between = [\"head\", \
         \"panel\"], kelvin = {{ spring = \"40 kN/m\", dashpot = \"100 N s/m\" }} }}\n[run]\nduration = \"{} ms\"\n",
        80 + rest
    )
}

/// What rests while all moves together is off from zero by rounding: that is no contact.
#[test]
fn contact_begins_with_the_record_however_long_all_has_moved_together() {
    let of = |rest: u32, method: &str| value(&run(&braked_after(rest), method), "pad.contact-time");
    for method in ["auto", "exact", "dop853"] {
        let (expected, own) = of(0, method);
        for rest in [1, 20, 300] {
            let (found, error) = of(rest, method);
            let off = (found - expected).abs();
            assert!(
                off <= error + own,
                "{method}, {rest} ms: {found} ± {error}, {expected} ± {own}"
            );
        }
    }
}

/// The border between its layers has no mass: as they part, its speed follows from the equations.
#[test]
fn speed_of_parting_follows_a_noisy_drive_at_coarse_tolerances() {
    let text = include_str!("../../scenes/knee-crash.toml");
    let [coarse, fine] = [1e-6, 1e-11].map(|rtol| {
        let report = run_at(text, "dop853", Some(rtol));
        report.measure("soft.coefficient-of-restitution").unwrap().value.unwrap()
    });
    assert!((coarse - fine).abs() < 1e-4, "{coarse}, not {fine}");
}
