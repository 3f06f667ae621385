//! Begin and end of contact forces.

use super::*;

fn line(start: f64, end: f64) -> Signal {
    let coefficients = [0.5 * (start + end), 0.5 * (end - start)].into();
    Signal::new(vec![Panel { start: 0.0, end: 2.0, coefficients }], Some(1e-6), 1e-12)
}

#[test]
fn impact_ends_where_the_force_falls_through_zero() {
    let impact = Impact::of_force(&line(3.0, -1.0), 2.0, 0.0);
    assert_eq!(impact.contact, Contact::Released);
    assert!((impact.end - 1.5).abs() < 1e-15);
    assert!((impact.end_error.unwrap() - 5e-7).abs() < 1e-14);
}

#[test]
fn force_that_starts_at_zero_and_pushes_is_a_contact() {
    let impact = Impact::of_force(&line(0.0, 1.0), 2.0, 0.0);
    assert_eq!((impact.contact, impact.end), (Contact::Lasting, 2.0));
    let span = impact.span(WindowWish::Impact, 2.0).unwrap();
    assert_eq!(span.note, Some(Note::StillInContact));
}

#[test]
fn run_that_stops_at_release_has_its_impact() {
    let impact = Impact::of_force(&line(1.0, 1e-17), 2.0, 0.0);
    assert_eq!((impact.contact, impact.end), (Contact::Released, 2.0));
    let decaying = Impact::of_force(&line(1.0, 1e-6), 2.0, 0.0);
    assert_eq!(decaying.contact, Contact::Lasting);
}

/// Adjoining lines through these values, one a second apart from the next.
fn polygon(values: &[f64]) -> Signal {
    let mut start = 0.0;
    let panels = values.windows(2).map(|pair| {
        let panel = Panel {
            start,
            end: start + 1.0,
            coefficients: [0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0])].into(),
        };
        start = panel.end;
        panel
    });
    Signal::new(panels.collect(), None, 1e-12)
}

#[test]
fn touch_of_rounding_before_the_push_is_none() {
    let force = polygon(&[0.0, 1e-15, 0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0]);
    for threshold in [0.0, 1e-3, NO_PULL] {
        let impact = Impact::of_force(&force, 8.0, threshold);
        assert_eq!((impact.start, impact.end), (4.0, 6.0));
        assert_eq!(impact.contact, Contact::Parted);
    }
    let span = |impact: Impact| (impact.start, impact.end);
    let faint = VelocityJump { time: 0.0, impulse: 1e-14, lost: 0.0 };
    assert_eq!(span(Impact::of_contact(&force, &[faint], 8.0, NO_PULL)), (4.0, 6.0));
    let real = VelocityJump { impulse: 1.0, ..faint };
    assert_eq!(span(Impact::of_contact(&force, &[faint, real], 8.0, NO_PULL)), (0.0, 0.0));
}

#[test]
fn ripples_and_slight_pulls_before_the_push_are_no_release() {
    let force = polygon(&[0.0, 1e-9, -0.2, 100.0, -5.0]);
    let impact = Impact::of_force(&force, 4.0, 0.0);
    assert_eq!((impact.start, impact.contact), (0.0, Contact::Released));
    assert!((impact.end - (3.0 + 100.0 / 105.0)).abs() < 1e-12, "{}", impact.end);
    let early = polygon(&[0.0, 2.0, -0.2, 100.0, -5.0]);
    let end = Impact::of_force(&early, 4.0, 0.0).end;
    assert!((end - (1.0 + 2.0 / 2.2)).abs() < 1e-12, "{end}");
}

#[test]
fn light_touch_is_one_from_a_thousandth_of_the_largest_on() {
    let touch = |light: f64| {
        let force = polygon(&[0.0, light, 0.0, 0.0, 100.0, 0.0, 0.0]);
        Impact::of_force(&force, 6.0, NO_PULL).start
    };
    assert_eq!((touch(0.09), touch(0.3)), (3.0, 0.0));
}

#[test]
fn fall_below_zero_within_the_methods_error_is_no_release() {
    let decaying = polygon(&[100.0, 0.05, -0.05, -0.02]);
    assert_eq!(Impact::of_force(&decaying, 3.0, 1e-3).contact, Contact::Lasting);
    assert_eq!(Impact::of_force(&decaying, 3.0, 1e-4).contact, Contact::Released);
    let loaded_later = polygon(&[100.0, 0.05, -0.05, 50.0, -50.0]);
    let impact = Impact::of_force(&loaded_later, 4.0, 1e-3);
    assert_eq!(impact.contact, Contact::Released);
    assert!((impact.end - 3.5).abs() < 1e-12, "{}", impact.end);
}

#[test]
fn force_that_pulls_from_the_start_is_no_impact() {
    for force in [line(0.0, -1.0), line(-1.0, 1.0)] {
        let impact = Impact::of_force(&force, 2.0, 0.0);
        assert_eq!((impact.contact, impact.end), (Contact::Pulling, 0.0));
        assert!(impact.span(WindowWish::Impact, 2.0).is_err());
        assert!(impact.span(WindowWish::Run, 2.0).is_ok());
    }
}

#[test]
fn force_that_never_pulls_is_no_pull_however_deep() {
    let released = polygon(&[100.0, 1.0, -1.0, 0.0, 0.0]);
    let impact = Impact::of_force(&released, 4.0, NO_PULL);
    assert_eq!((impact.contact, impact.end), (Contact::Parted, 3.0));
    let below = polygon(&[-1e-3, 100.0, 0.0, 0.0]);
    assert_eq!(Impact::of_force(&below, 3.0, NO_PULL).contact, Contact::Parted);
    let none = line(-1e-13, -1e-13);
    assert_eq!(Impact::of_force(&none, 2.0, NO_PULL).contact, Contact::Unloaded);
    let ends = Impact::of_force(&line(1.0, 1e-17), 2.0, NO_PULL);
    assert_eq!((ends.contact, ends.end), (Contact::Released, 2.0));
}

#[test]
fn two_impacts_join_to_the_longer_one() {
    let short = Impact::of_force(&line(3.0, -1.0), 2.0, 0.0);
    let long = Impact::of_force(&line(1.0, 1.0), 2.0, 0.0);
    assert_eq!(short.joined(long), long);
    let pulling = Impact::of_force(&line(-1.0, 1.0), 2.0, 0.0);
    assert_eq!(pulling.joined(short), short);
}

#[test]
fn windows_are_cut_to_the_run() {
    let impact = Impact::without_impactor(2.0);
    let span = impact.span(WindowWish::Times(1.0, 5.0), 2.0).unwrap();
    assert_eq!(span.window(), (1.0, 2.0));
    assert!(span.note.is_some());
    assert!(impact.span(WindowWish::Times(3.0, 5.0), 2.0).is_err());
}
