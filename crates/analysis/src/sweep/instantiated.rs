//! Points of a sweep that are solved by instantiating: one compiled form, other numbers.

use dashpot_network::{ConnectionOutputs, ParametricSystem};

use super::{
    Column, Estimates, Grid, Pose, ScenePoint as Scene, SweepOptions,
    plain::{
        MOST_STATES,
        shown::{Shown, Wanted, shown_by},
    },
    stamper::{Sized, Stamper},
    stopped,
    table::Table,
};
use crate::measures::selection::select;

/// How the points of a sweep are solved by instantiating.
#[derive(Debug)]
pub(super) struct Plan<'g> {
    pub(super) grid: &'g Grid,
    pub(super) parametric: ParametricSystem,
    /// Whether what becomes of the pad once it has let go what struck it has to be looked at: laws are not linear, and
    /// other masses may throw back what has left, or a measure reaches beyond the impact.
    pub(super) is_parting: bool,
    /// The element that is struck.
    element: String,
    pub(super) table: Table,
    pub(super) shown: Vec<Shown>,
    /// For each column the part of a value that it may be off by.
    pub(super) wishes: Vec<f64>,
    pub(super) wanted: Wanted,
    /// Where the errors of scenes that are not linear are estimated.
    pub(super) estimates: Estimates,
    pub(super) duration: f64,
}

impl<'g> Plan<'g> {
    /// A plan, where the scene at the first point and the columns allow one.
    pub(super) fn of(
        grid: &'g Grid,
        pose: &Pose<'_>,
        first: &Scene,
        columns: &[Column],
        SweepOptions { threads, estimates }: SweepOptions,
    ) -> Option<Self> {
        let settings = &first.settings;
        if settings.is_duration_found {
            return None;
        }
        let is_exact = matches!(settings.method.name(), "auto" | "exact");
        if !is_exact || !settings.stops.is_empty() || settings.accuracy.neglect_below.is_some() {
            return None;
        }
        let duration = settings.duration;
        let parametric = ParametricSystem::of(&stopped::unmet(&first.network), duration)?;
        if parametric.states() > MOST_STATES {
            return None;
        }
        let struck = parametric.element();
        if !stopped::are_at(&first.network, &first.network.connections()[struck].name) {
            return None;
        }
        let assembly = first
            .network
            .compile(duration)
            .ok()
            .filter(|own| own.warnings.is_empty() && own.held.is_empty())?;
        // Another padding would have to be watched as well.
        let is_other = |(at, own): (usize, &ConnectionOutputs)| {
            at != struck && !(own.segments.is_empty() && own.thickness.is_none())
        };
        if assembly.connections.iter().enumerate().any(is_other) {
            return None;
        }
        let selected = select(&assembly, &settings.measures, &settings.limits).ok()?;
        let mut wanted = Wanted::default();
        let mut shown = Vec::with_capacity(columns.len());
        for column in columns {
            let own = selected.iter().find(|own| own.key == column.key)?;
            let own = shown_by(own, &parametric, &mut wanted)?;
            shown.push(if column.is_share { Shown::Share } else { own });
        }
        let is_parting = !parametric.is_linear()
            && parametric.opens()
            && (wanted.work_at_end || parametric.masses() > 1);
        if is_parting && !parametric.parts() {
            return None;
        }
        // Other masses may make the force dip, and what is known of neighbours tells little of a point near that.
        let has_dips = !parametric.is_linear() && parametric.masses() > 1;
        let estimates = match estimates {
            Estimates::Some if has_dips => Estimates::All,
            own => own,
        };
        let wishes = columns.iter().map(|column| settings.accuracy.of(&column.key)).collect();
        let table = Table::of(&parametric, grid, pose, duration, threads)?;
        let element = first.network.connections()[struck].name.clone();
        Some(Self {
            grid,
            parametric,
            is_parting,
            element,
            table,
            shown,
            wishes,
            wanted,
            estimates,
            duration,
        })
    }

    /// The element that is struck.
    pub(super) fn element(&self) -> &str {
        &self.element
    }

    /// The strictest accuracy that is wanted of a column.
    pub(super) fn strictest(&self) -> f64 {
        self.wishes.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Whether the numbers at a point are those of its network.
    pub(super) fn agrees(&self, point: usize, scene: &Scene) -> bool {
        let mut places = vec![0; self.grid.counts().len()];
        self.grid.locate(point, &mut places);
        self.table.agrees(&self.parametric, &places, &scene.network)
    }

    /// What solves points; one for each thread.
    pub(super) fn stamper(&self) -> Option<Box<dyn Stamper + '_>> {
        match self.parametric.states() {
            0..=2 => self.sized::<2>(),
            3..=4 => self.sized::<4>(),
            5..=6 => self.sized::<6>(),
            7..=8 => self.sized::<8>(),
            9..=10 => self.sized::<10>(),
            11..=MOST_STATES => self.sized::<MOST_STATES>(),
            _ => None,
        }
    }

    fn sized<const N: usize>(&self) -> Option<Box<dyn Stamper + '_>> {
        Some(Box::new(Sized::<N>::of(self)?))
    }
}
