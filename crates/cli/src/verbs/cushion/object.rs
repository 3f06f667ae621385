//! Cushion curves as an object, in SI units.

use dashpot_analysis::Band;
use dashpot_design::cushion::{
    Assumed, Best, Creep, Curve, Passing, Reach, Repeated, StressEnergy, Thinnest, Unmet,
};
use serde::Serialize;

use super::{Drawn, batches::Batches};
use crate::{
    output::{list, object},
    said,
};
use dashpot_studies::origin;

pub(super) fn object(drawn: &Drawn) -> impl Serialize {
    let Drawn { scene, wanted, cushion, .. } = drawn;
    let own = &cushion.platen;
    let assumed = list(own.assumed.iter().map(|own| match own {
        Assumed::Gravity => "gravity",
        Assumed::Separation => "separation",
    }));
    let platen = object! {
        body: &own.body, pad: &own.pad, mass: own.mass, stress: own.stress(), area: own.area, gravity: own.gravity, assumed,
    };
    object! {
        #[serde(flatten)]
        head: origin::head(scene, &crate::input::load),
        unevaluated: &cushion.unevaluated,
        platen,
        limit: wanted.asked.limit,
        over: wanted.asked.over,
        curves: list(cushion.curves.iter().map(curve)),
        thinnest: list(cushion.thinnest.iter().map(thinnest)),
        scatter: drawn.batches.as_ref().map(scatter),
        creep: list(cushion.creep.iter().map(creep)),
        stress_energy: cushion.stress_energy.as_ref().map(stress_energy),
        work: cushion.work,
        scene_warnings: said::warning_objects(scene),
        scene_notes: said::note_objects(scene),
    }
}

fn curve(own: &Curve) -> impl Serialize {
    let points = || own.points.iter();
    let Curve { height, thickness, floor, .. } = own;
    let later = || list(own.repeated.iter().map(Repeated::later));
    let drops = || {
        list(own.repeated.iter().map(|own| {
            object! { peak: &own.peaks, error: &own.errors, known: own.is_known }
        }))
    };
    let has_row = !own.repeated.is_empty();
    object! {
        height, thickness, floor,
        stress: list(points().map(|own| own.stress)),
        peak: list(points().map(|own| own.peak)),
        error: list(points().map(|own| own.error)),
        strain: list(points().map(|own| own.strain)),
        known: list(points().map(|own| own.known.word())),
        best: own.best.as_ref().map(best),
        best_band: own.best_band.as_ref(),
        bands: (!own.bands.is_empty()).then(|| bands(&own.bands)),
        passing: own.passing.map(passing),
        later: has_row.then(later),
        drops: has_row.then(drops),
    }
}

fn best(own: &Best) -> impl Serialize {
    let (point, place) = (own.point, own.place.word());
    object! {
        stress: point.stress, peak: point.peak, error: point.error, strain: point.strain, known: point.known.word(),
        place,
    }
}

fn passing(Passing { stress, ends }: Passing) -> impl Serialize {
    object! { low: stress[0], high: stress[1], ends: ends.map(Reach::word) }
}

fn scatter(Batches { sources, designs, seed }: &Batches) -> impl Serialize {
    object! { designs, seed, sources }
}

fn bands(own: &[Band]) -> impl Serialize {
    let all = |of: fn(&Band) -> Option<f64>| list(own.iter().map(of));
    object! {
        mean: all(|own| own.mean), deviation: all(|own| own.deviation),
        low: all(|own| own.low), high: all(|own| own.high), without: list(own.iter().map(|own| own.without)),
    }
}

fn creep(own: &Creep) -> impl Serialize {
    let crept = own.crept.iter().map(|(time, strain, error, trust)| {
        object! { time, strain, error, trust: trust.word() }
    });
    object! { stress: own.stress, slowest: own.slowest, crept: list(crept) }
}

fn stress_energy(own: &StressEnergy) -> impl Serialize {
    let [a, b] = own.fit;
    let StressEnergy { left, scatter, collapse, range, of, .. } = own;
    object! { a, b, left, scatter, collapse: collapse.word(), range, points: of[0], curves: of[1] }
}

fn thinnest(own: &Thinnest) -> impl Serialize {
    let all = own.over_all.ok();
    let unmet = own.over_all.err().map(|own| {
        let (peak, stress) = match own {
            Unmet::Peak(peak, stress) => (Some(peak), stress),
            Unmet::Known(stress, _) => (None, stress),
        };
        object! { peak, stress, certain: own.is_certain() }
    });
    let lightest = own.lightest.map(|[volume, thickness, stress]| {
        object! { volume_per_weight: volume, thickness, stress }
    });
    object! {
        height: own.height,
        thickness: all.map(|own| own.0), peak: all.map(|own| own.1.peak), error: all.map(|own| own.1.error),
        stress: all.map(|own| own.1.stress),
        is_first: own.is_first, is_open: own.is_open, unmet, lightest, sure: own.sure,
    }
}
