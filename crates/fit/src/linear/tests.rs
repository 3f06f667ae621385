use std::{fs, path::Path, time::Instant};

use dashpot_numerics::Stream;

use super::*;

const SETTINGS: LinearSettings =
    LinearSettings { error: 0.01, is_shifted: true, is_robust: true, is_solid: false };

/// Times at equal ratios.
fn times(low: f64, high: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |at| low * (high / low).powf(f64::from(at) / f64::from(count - 1)))
}

/// A normal deviate (Box and Muller).
fn normal(stream: &mut Stream) -> f64 {
    let (one, other) = (1.0 - stream.share(), stream.share());
    (-2.0 * one.ln()).sqrt() * (std::f64::consts::TAU * other).cos()
}

fn relaxing(spectrum: &Spectrum, t: f64) -> f64 {
    spectrum.at(Form::Maxwell, t)
}

/// Eight modes over twelve decades.
fn eight() -> Spectrum {
    let strength = [9.0, 30.0, 14.0, 40.0, 8.0, 25.0, 5.0, 12.0].map(|own| own * 1e6);
    let branches = times(1e-6, 1e6, 8).zip(strength).collect();
    Spectrum { spring: 3e6, dashpot: 0.0, branches }
}

#[test]
fn a_noisy_spectrum_of_eight_modes_lies_within_its_band() {
    let truth = eight();
    for seed in 1..6 {
        let mut stream = Stream::new(seed);
        let rows = times(1e-7, 1e7, 281)
            .map(|t| (t, relaxing(&truth, t) * (1.0 + 0.01 * normal(&mut stream))));
        let own = fit(&[Record::Relaxation(rows.collect())], SETTINGS).unwrap();
        assert_eq!(own.against, Against::Floor);
        // The floor follows the noise with some of its terms.
        assert!((0.008..0.0105).contains(&own.floor), "{:?}", own.floor);
        let rows = own.curves[0].rows.iter().filter(|own| (1e-6..=1e6).contains(&own.at));
        let off = rows.map(|row| {
            let half = row.half.unwrap();
            ((row.model - relaxing(&truth, row.at)).abs() / half, half / row.model)
        });
        let off: Vec<(f64, f64)> = off.collect();
        let share = |count: usize| count as f64 / off.len() as f64;
        let inside = off.iter().filter(|own| own.0 <= 1.0).count();
        let worst = off.iter().fold(0.0, |most: f64, own| most.max(own.0));
        assert!(share(inside) >= 0.9 && worst < 2.0, "{seed}: {inside} inside, worst {worst}");
        // A band that says something is not much wider than the noise.
        assert!(off.iter().all(|own| own.1 < 0.03), "{off:?}");
    }
}

#[test]
fn exact_modes_are_found_and_no_more() {
    let truth = Spectrum {
        spring: 1e5,
        dashpot: 0.0,
        branches: vec![(1e-3, 4e5), (0.3, 2e5), (50.0, 3e5)],
    };
    let rows = times(1e-4, 1e3, 200).map(|t| (t, relaxing(&truth, t))).collect();
    let settings = LinearSettings { error: 1e-4, ..SETTINGS };
    let own = fit(&[Record::Relaxation(rows)], settings).unwrap();
    assert!(own.is_kept && own.against == Against::Data);
    assert!(own.misfit.largest <= 1e-4);
    assert_eq!(own.spectrum.branches.len(), 3, "{:?}", own.spectrum);
    for (found, wanted) in own.spectrum.branches.iter().zip(&truth.branches) {
        assert!((found.0 / wanted.0 - 1.0).abs() < 1e-2, "{found:?}");
        assert!((found.1 / wanted.1 - 1.0).abs() < 1e-2, "{found:?}");
    }
}

#[test]
fn creep_gives_back_the_compliances_that_made_it() {
    let truth = Spectrum { spring: 1e-7, dashpot: 2e-9, branches: vec![(0.01, 3e-7), (2.0, 5e-7)] };
    let rows = times(1e-3, 300.0, 150).map(|t| (t, truth.at(Form::Kelvin, t))).collect();
    let settings = LinearSettings { error: 1e-4, ..SETTINGS };
    let own = fit(&[Record::Creep(rows)], settings).unwrap();
    assert_eq!((own.form, own.spectrum.branches.len()), (Form::Kelvin, 2), "{:?}", own.spectrum);
    assert!((own.spectrum.dashpot / 2e-9 - 1.0).abs() < 1e-2, "{:?}", own.spectrum);
    let model = own.spectrum.model(own.form);
    for t in [1e-3, 0.02, 1.0, 100.0] {
        assert!((model.creep(t) / truth.at(Form::Kelvin, t) - 1.0).abs() < 2e-4, "{t}");
    }
}

#[test]
fn loss_that_is_not_that_of_the_storage_is_named() {
    let model = eight().model(Form::Maxwell);
    let rows = |factor: f64| {
        let omegas = times(1e-5, 1e5, 100);
        let row = move |omega: f64| [omega, model.storage(omega), factor * model.loss(omega)];
        Record::Oscillation(omegas.map(row).collect())
    };
    let own = fit(&[rows.clone()(1.0)], SETTINGS).unwrap();
    assert!(own.floor < 1e-3 && own.records[0].contradiction.is_none(), "{:?}", own.floor);
    let own = fit(&[rows(1.5)], SETTINGS).unwrap();
    let found = own.records[0].contradiction.unwrap();
    assert!(own.floor > 0.05, "{:?}", own.floor);
    // Storage predicts two thirds of the loss that was written down, and the loss 1.5 times the storage.
    assert!((found.loss_from_storage - 1.0 / 3.0).abs() < 0.02, "{found:?}");
    assert!(found.storage_alone < 0.01 && found.loss_alone < 0.01, "{found:?}");
}

/// A relaxation over four decades with 1 % of noise, fitted.
fn relaxed(modulus: impl Fn(f64) -> f64, rows: u32, seed: u64) -> LinearFit {
    let mut stream = Stream::new(seed);
    let rows = times(1e-2, 1e2, rows).map(|t| (t, modulus(t) * (1.0 + 0.01 * normal(&mut stream))));
    fit(&[Record::Relaxation(rows.collect())], SETTINGS).unwrap()
}

fn covers(own: Range, value: f64) -> bool {
    own.low <= value && own.high.is_none_or(|high| value <= high)
}

#[test]
fn what_rows_are_still_on_the_way_to_is_not_identified() {
    let power = |exponent: f64, part: f64| move |t: f64| part * t.powf(-exponent);
    for seed in 1..6 {
        for rows in [60, 200] {
            for (rest, exponent, part) in
                [(0.0, 0.15, 1.0), (100.0, 0.15, 36.0), (100.0, 0.3, 25.0)]
            {
                let own = relaxed(|t| rest + power(exponent, part)(t), rows, seed).spring;
                assert!(!own.is_identified(), "{rest} {exponent} {rows}: {own:?}");
                assert!(covers(own, rest), "{rest} {exponent} {rows}: {own:?}");
            }
        }
    }
    // A plateau of more than a decade is.
    let solid = |t: f64| 100.0 + 150.0 * (-t / 0.1).exp() + 80.0 * (-t / 2.0).exp();
    let is_one = |seed: &u64| relaxed(solid, 200, *seed).spring.is_identified();
    assert!((1..=10).filter(is_one).count() >= 8);
}

/// Intervals of 95 % hold the truth of two branches in 95 of 100 cases.
#[test]
fn two_branches_lie_within_their_bands_as_often_as_is_said() {
    let solid = |t: f64| 100.0 + 150.0 * (-t / 0.1).exp() + 80.0 * (-t / 2.0).exp();
    let (mut ranges, mut sums, mut inside, mut all) = (0, 0, 0, 0);
    for seed in 1..=200 {
        let fit = relaxed(solid, 60, seed);
        ranges += u32::from(covers(fit.spring, 100.0));
        sums += u32::from(covers(fit.sum, 330.0));
        for row in &fit.curves[0].rows {
            all += 1;
            inside += u32::from((row.model - solid(row.at)).abs() <= row.half.unwrap());
        }
    }
    println!("spring {ranges} of 200, sum {sums} of 200, rows {inside} of {all}");
    assert!(ranges >= 186 && sums >= 186, "{ranges} {sums}");
    assert!(f64::from(inside) >= 0.93 * f64::from(all), "{inside} of {all}");
}

/// Strains that rise within three samples, and the stress of a material at the same samples, or written down later.
fn ramp(truth: &Spectrum, late: f64, noise: f64) -> Record {
    let step = 0.15;
    let rise = 3.0 * step;
    let strain = |t: f64| 0.3 * (t / rise).clamp(0.0, 1.0);
    let answer = |t: f64| {
        let of_branch = |(time, modulus): &(f64, f64)| {
            let rate = 0.3 / rise;
            let at = |t: f64| if t > 0.0 { -(-t / time).exp_m1() } else { 0.0 };
            modulus * time * rate * (at(t) - at(t - rise))
        };
        truth.spring * strain(t) + truth.branches.iter().map(of_branch).sum::<f64>()
    };
    let mut stream = Stream::new(3);
    let rows = (0..900).map(|at| {
        let t = step * f64::from(at);
        [t, strain(t), answer(t - late) + noise * normal(&mut stream)]
    });
    Record::Strained(rows.collect())
}

#[test]
fn what_relaxes_within_the_ramp_is_not_identified_and_what_remains_is() {
    // Two materials that differ in what has relaxed before the ramp ends.
    let slow = vec![(0.6, 900.0), (15.0, 500.0)];
    let truth = |fast: f64| {
        let branches = [vec![(0.02, fast)], slow.clone()].concat();
        Spectrum { spring: 400.0, dashpot: 0.0, branches }
    };
    let own = fit(&[ramp(&truth(1000.0), 0.0, 1.0)], SETTINGS).unwrap();
    assert!(!own.sum.is_identified(), "{:?}", own.sum);
    assert!(covers(own.sum, 2800.0) && covers(own.sum, 2000.0), "{:?}", own.sum);
    assert!(own.spring.is_identified() && (own.spring.value / 400.0 - 1.0).abs() < 0.03, "{own:?}");
}

#[test]
fn a_clock_that_is_late_is_found() {
    let truth =
        Spectrum { spring: 400.0, dashpot: 0.0, branches: vec![(0.6, 900.0), (15.0, 500.0)] };
    let record = ramp(&truth, 0.06, 0.5);
    let own = fit(std::slice::from_ref(&record), SETTINGS).unwrap();
    assert!((own.records[0].shift - 0.06).abs() < 0.25 * 0.15, "{}", own.records[0].shift);
    let exact = fit(&[ramp(&truth, 0.0, 0.0)], SETTINGS).unwrap();
    assert!(exact.records[0].shift == 0.0 && exact.floor_unshifted.is_none(), "{exact:?}");
    let unshifted = own.floor_unshifted.unwrap();
    assert!(unshifted > 2.0 * own.floor);
    let blind = LinearSettings { is_shifted: false, ..SETTINGS };
    let own = fit(&[record], blind).unwrap();
    assert!((own.floor / unshifted - 1.0).abs() < 1e-9 && own.floor_unshifted.is_none());
}

#[test]
fn faults_are_told() {
    let fault = |record: Record| fit(&[record], SETTINGS).unwrap_err();
    assert_eq!(fit(&[], SETTINGS).unwrap_err(), LinearFault::NoRecords);
    assert!(fault(Record::Creep(vec![(1.0, 1.0)])).to_string().contains("1 rows are too few"));
    let rows = vec![(1.0, 3.0), (2.0, 2.0), (3.0, 0.0), (4.0, 1.0)];
    let own = fault(Record::Relaxation(rows));
    assert!(own.to_string().contains("the modulus is 0"), "{own}");
    let rows = vec![[0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [0.5, 1.0, 1.0], [2.0, 1.0, 1.0]];
    assert!(fault(Record::Strained(rows)).to_string().contains("from 1 s to 0.5 s"));
    let rows = [0.0, 1.0, 2.0, 3.0].map(|t| [t, 1.0, -2.0]).to_vec();
    assert_eq!(fault(Record::Strained(rows)), LinearFault::NoAnswer);
    let pairs = vec![(1.0, 3.0), (2.0, 2.0), (3.0, 1.5), (4.0, 1.0)];
    let both = [Record::Creep(pairs.clone()), Record::Relaxation(pairs)];
    assert_eq!(fit(&both, SETTINGS).unwrap_err(), LinearFault::MixedForms { record: 1 });
}

/// Rows of numbers of a file below the folder of measured data; `None`, with a word, where there is none.
fn rows(path: &str) -> Option<Vec<Vec<f64>>> {
    let Some(folder) = std::env::var_os("DASHPOT_TEST_DATA") else {
        println!("skipped: DASHPOT_TEST_DATA names no folder of measured data");
        return None;
    };
    let text = fs::read_to_string(Path::new(&folder).join(path)).unwrap();
    let numbers = |line: &str| line.split(',').map(|own| own.trim().parse().ok()).collect();
    let finite = |row: &Vec<f64>| row.iter().all(|own| own.is_finite());
    Some(text.lines().filter_map(numbers).filter(finite).collect())
}

#[test]
fn a_relaxation_master_of_thirty_decades_takes_few_branches() {
    let Some(rows) = rows("pyvisco/time_user_master.csv") else { return };
    let record = Record::Relaxation(rows.iter().map(|own| (own[0], own[1] * 1e6)).collect());
    let started = Instant::now();
    let own = fit(&[record], SETTINGS).unwrap();
    println!("{:?}: floor {:?}, misfit {:?}", started.elapsed(), own.floor, own.misfit);
    println!("{} branches, {:?}, {:?}", own.spectrum.branches.len(), own.sum, own.spring);
    assert!(own.is_kept && own.misfit.largest <= 0.01 && own.spectrum.branches.len() <= 24);
    assert!((own.floor - 8e-4).abs() < 1e-4, "{:?}", own.floor);
}

#[test]
fn a_master_of_storage_and_loss_that_is_stretched_is_named() {
    let Some(rows) = rows("pyvisco/freq_user_master.csv") else { return };
    let row = |own: &Vec<f64>| [own[0] * std::f64::consts::TAU, own[1] * 1e6, own[2] * 1e6];
    let started = Instant::now();
    let own = fit(&[Record::Oscillation(rows.iter().map(row).collect())], SETTINGS).unwrap();
    println!("{:?}: floor {:?}, misfit {:?}", started.elapsed(), own.floor, own.misfit);
    println!("{} branches; {:?}", own.spectrum.branches.len(), own.records[0].contradiction);
    assert!((own.floor - 0.171).abs() < 0.002, "{:?}", own.floor);
    let found = own.records[0].contradiction.unwrap();
    assert!((found.storage_alone - 0.014).abs() < 0.002, "{found:?}");
    assert!((found.loss_alone - 0.027).abs() < 0.002, "{found:?}");
    assert!((found.loss_from_storage - 0.43).abs() < 0.02, "{found:?}");
}

#[test]
fn a_measured_ramp_identifies_the_equilibrium_and_not_the_instant() {
    let Some(rows) = rows("rheos/Epi_relax.csv") else { return };
    let hold = rows.iter().filter(|own| own[0] < 140.0).map(|own| [own[0], own[2], own[1]]);
    let started = Instant::now();
    let own = fit(&[Record::Strained(hold.collect())], SETTINGS).unwrap();
    let pascals = own.records[0].largest.unwrap();
    let [before, after] = [own.floor_unshifted.unwrap(), own.floor].map(|own| own * pascals);
    println!("{:?}: floors {before} and {after} Pa", started.elapsed());
    println!("shift {} s; {:?}; {:?}", own.records[0].shift, own.spring, own.sum);
    println!("{:?} {:?}", own.spectrum, own.misfit);
    assert!((before - 9.1).abs() < 0.1 && (after - 5.2).abs() < 0.1, "{before} {after}");
    assert!(own.spring.is_identified() && !own.sum.is_identified());
    assert!(own.spring.low < 409.0 && own.spring.high.unwrap() > 405.0, "{:?}", own.spring);
}
