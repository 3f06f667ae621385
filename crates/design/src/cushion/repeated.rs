//! Drops one after the other on the same cushion, which remembers them.
//!
//! All of them are one run: each drop has a platen of its own, which hangs at the height until its time, falls, strikes
//! and is taken off once the impact is over. So what becomes of the cushion meanwhile, its branches that relax, what
//! stays of its deformation, and what its law remembers, is what the solver makes of it. A cushion that has not come
//! back is met lower, after a longer fall.

use dashpot_analysis::{
    measures::PeakForce,
    sweep::{Column, Grid, ScenePoint, SweepOptions, SweepReport, Watch, columns, sweep},
};
use dashpot_dae::{Piece, Waveform};
use dashpot_network::{Network, Node, elements::Contact, parameters::Kind as _, part};

use super::{Curve, NoCushion, Platen, curves::is_beyond};

/// A platen is taken off by so many times the force that would stop it in this part of an impact.
const LIFT: f64 = 2.0;
const LIFTED: f64 = 0.02;

/// Drops in a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// How many, two at least.
    pub drops: usize,
    /// The time from one to the next \[s\].
    pub between: f64,
}

/// The peaks of drops in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeated {
    /// The peak of each drop \[m/s²\]; not a number where it could not be solved.
    pub peaks: Vec<f64>,
    /// Their errors \[m/s²\].
    pub errors: Vec<f64>,
    /// Whether none of them presses the cushion beyond what is known of it.
    pub is_known: bool,
}

impl Repeated {
    /// The mean of all but the first drop \[m/s²\], as ASTM D1596 reports it; not a number where a drop goes beyond what
    /// is known of the cushion.
    pub fn later(&self) -> f64 {
        if !self.is_known {
            return f64::NAN;
        }
        let later = self.peaks.get(1..).unwrap_or_default();
        later.iter().sum::<f64>() / later.len() as f64
    }
}

/// One platen's time.
struct Turn {
    /// When it begins to fall, and when it is taken off \[s\].
    falls: f64,
    lifted: f64,
    /// How long that takes \[s\], and the acceleration \[m/s²\].
    lift: (f64, f64),
}

impl Row {
    fn name(drop: usize) -> String {
        format!("drop-{}", drop + 1)
    }

    /// The scene of the drops in a row of a scene with one.
    fn posed(
        self,
        scene: &ScenePoint,
        platen: &Platen,
        (height, stress): (f64, f64),
        impact: f64,
    ) -> Result<ScenePoint, String> {
        let own = &scene.network;
        let pad = own.connections().iter().find(|own| own.name == platen.pad);
        let pad = pad.ok_or_else(|| format!("there is no `{}`", platen.pad))?;
        let is_fixed = pad.between.contains(&own.ground());
        if !is_fixed
            || own.nodes().count() > 2
            || own.effects().iter().any(|own| own.kind() == "stop")
        {
            let reason =
                "drops in a row are followed on a cushion that lies on the ground, without a stop";
            return Err(reason.to_owned());
        }
        let mut network = Network::new();
        let (face, ground) = (network.add_node(Node::massless("face")), network.ground());
        let connection = network.connect(pad.name.clone(), face, ground, pad.model.clone());
        (connection.thickness, connection.area) = (pad.thickness, pad.area);
        connection.pads.clone_from(&pad.pads);
        let (mass, speed) = (stress * platen.area / platen.gravity, platen.speed(height));
        let fall = speed / platen.gravity;
        if self.between <= fall + impact {
            return Err(format!(
                "a drop takes {:.3} s: more time has to lie between two",
                fall + impact
            ));
        }
        let lift = LIFTED * impact;
        for drop in 0..self.drops {
            let name = Self::name(drop);
            let node =
                network.add_node(Node::mass(format!("platen-{}", drop + 1), mass).at(-height));
            network.connect(name.clone(), node, face, part(Contact { gap: 0.0, restitution: 0.0 }));
            let falls = drop as f64 * self.between;
            let turn =
                Turn { falls, lifted: falls + fall + impact, lift: (lift, LIFT * speed / lift) };
            network.add_load(name, node, turn.force(mass, platen.gravity).ok_or("no such time")?);
        }
        let mut settings = scene.settings.clone();
        settings.measures.clear();
        let last = (self.drops - 1) as f64 * self.between;
        settings.duration = last + fall + impact;
        Ok(ScenePoint { network, settings })
    }
}

impl Turn {
    /// What acts on a platen besides its contact \[N\]: nothing while it hangs, its weight, and what takes it off.
    fn force(&self, mass: f64, gravity: f64) -> Option<Waveform> {
        let at = |start: f64, acceleration: f64| Piece {
            start,
            value: mass * acceleration,
            ..Piece::default()
        };
        let (length, up) = self.lift;
        let hangs = (self.falls > 0.0).then(|| at(0.0, 0.0));
        let rest = [at(self.falls, gravity), at(self.lifted, -up), at(self.lifted + length, 0.0)];
        Waveform::new(hangs.into_iter().chain(rest).collect())
    }
}

/// The drops in a row of all points of curves, each of which is posed with one drop.
pub(super) fn repeated(
    row: Row,
    platen: &Platen,
    curves: &mut [Curve],
    posed: &(dyn Fn(f64, f64, f64) -> Result<ScenePoint, String> + Sync),
    (impact, threads): (f64, usize),
    watch: &mut Watch<'_>,
) -> Result<(), NoCushion> {
    let count = curves.first().map_or(0, |own| own.points.len());
    let grid = Grid::new(vec![curves.len(), count]);
    let grid = grid.ok_or(dashpot_analysis::sweep::SweepError::NoPoints)?;
    let pose = |places: &[usize]| {
        let (curve, point) = (&curves[places[0]], &curves[places[0]].points[places[1]]);
        let scene = posed(curve.height, curve.thickness, point.stress)?;
        row.posed(&scene, platen, (curve.height, point.stress), impact)
    };
    let first = pose(&[0, 0]).map_err(NoCushion::NotPosed)?;
    let keys: Vec<String> =
        (0..row.drops).map(|own| format!("{}.{}", Row::name(own), PeakForce::KIND)).collect();
    let (columns, wishes) = columns(&first, &keys)?;
    let pose = |places: &[usize]| {
        let mut scene = pose(places)?;
        scene.settings.measures.clone_from(&wishes);
        Ok(scene)
    };
    let options = SweepOptions { threads, ..SweepOptions::default() };
    let report = sweep(&grid, &pose, &columns, options, watch)?;
    for (at, curve) in curves.iter_mut().enumerate() {
        let one = |place: usize| {
            let mass = curve.points[place].stress * platen.area / platen.gravity;
            read(&report, &columns, &keys, (at * count + place, mass))
        };
        curve.repeated = (0..count).map(one).collect();
    }
    Ok(())
}

/// The drops at a point, of a platen of this mass \[kg\].
fn read(
    report: &SweepReport,
    columns: &[Column],
    keys: &[String],
    (point, mass): (usize, f64),
) -> Repeated {
    let all = |values: &[f64]| -> Vec<f64> {
        let one = |key: &String| {
            let at = columns.iter().position(|own| own.key == *key && !own.is_share);
            at.map_or(f64::NAN, |at| values[point * columns.len() + at] / mass)
        };
        keys.iter().map(one).collect()
    };
    let is_known = !is_beyond(report, point);
    Repeated { peaks: all(&report.values), errors: all(&report.errors), is_known }
}
