//! Balances of dashpots: how fast massless bodies move, and how fast every dashpot is compressed.

use std::collections::BTreeMap;

use dashpot_dae::UnknownKind;

use super::{
    mesh::{Mesh, Solution},
    row::{Row, RowSum, Rows, Scalar},
    structure::{Numbers, Structure},
    unknowns::{Draft, Places},
};

/// Velocities of the massless bodies that dashpots hold.
pub(super) struct DashpotBalance<'a, T> {
    structure: &'a Structure,
    ends: Ends,
    solution: Solution<Row<T>>,
}

/// The mesh's numbers: bodies in clusters, and for each cluster its own copy of each anchor,
/// because velocities in a cluster with one anchor are counted from that anchor.
struct Ends {
    anchors: BTreeMap<(usize, usize), usize>,
}

impl Ends {
    fn of(structure: &Structure) -> Self {
        let bodies = structure.cluster_of.len();
        let pairs = structure
            .clusters
            .iter()
            .enumerate()
            .flat_map(|(at, cluster)| cluster.anchors.iter().map(move |&anchor| (at, anchor)));
        Self { anchors: pairs.enumerate().map(|(at, pair)| (pair, bodies + at)).collect() }
    }

    /// The numbers of a dashpot's ends; `None` if neither is in a cluster.
    fn numbers(&self, structure: &Structure, [a, b]: [usize; 2]) -> Option<[usize; 2]> {
        let cluster = structure.cluster_of[a].or(structure.cluster_of[b])?;
        Some([a, b].map(|end| match structure.cluster_of[end] {
            Some(_) => end,
            None => self.anchors.get(&(cluster, end)).copied().unwrap_or(end),
        }))
    }
}

impl<'a, T: Scalar> DashpotBalance<'a, T> {
    /// Solves the balances under the forces `net` of springs and loads; the velocities in clusters
    /// of more than `most_bodies` become algebraic unknowns.
    pub(super) fn solve(
        structure: &'a Structure,
        numbers: &Numbers<'_, T>,
        (net, velocity): (&[RowSum<T>], &Rows<T>),
        most_bodies: usize,
        places: &mut Places<T>,
        draft: impl Fn(usize) -> (String, f64),
    ) -> Self {
        let ends = Ends::of(structure);
        if structure.clusters.is_empty() {
            return Self { structure, ends, solution: Solution::default() };
        }
        let mut mesh = Mesh::<Row<T>>::new(net.len() + ends.anchors.len());
        for dashpot in &structure.dashpots {
            if let Some([p, q]) = ends.numbers(structure, dashpot.ends) {
                mesh.link(p, q, (numbers.slope)(dashpot), &Row::default());
            }
        }
        let mut values = vec![Row::default(); net.len() + ends.anchors.len()];
        for (&(cluster, anchor), &at) in &ends.anchors {
            if structure.clusters[cluster].anchors.len() > 1 {
                values[at] = velocity.row(anchor);
            }
        }
        let (mut solved, mut kept) = (Vec::new(), Vec::new());
        for cluster in &structure.clusters {
            let moving =
                || cluster.bodies.iter().copied().filter(|&body| places.unknown[body].is_some());
            for body in moving() {
                mesh.load(body, 1.0, &net[body].total());
            }
            let list = if cluster.bodies.len() <= most_bodies { &mut solved } else { &mut kept };
            list.extend(moving());
        }
        for (at, &body) in kept.iter().enumerate() {
            values[body] = Row::unknown(places.drafts.len() + at);
        }
        for &body in &kept {
            let mut balance = RowSum::default();
            balance.add(1.0, mesh.load_at(body));
            for (other, link) in mesh.links(body) {
                balance.add(link.conductance * -1.0, &values[body]);
                balance.add(link.conductance, &values[other]);
            }
            let (name, scale) = draft(body);
            places.rows.set(places.drafts.len(), &balance.total());
            places.drafts.push(Draft {
                name: format!("velocity of {name}"),
                kind: UnknownKind::Algebraic,
                unit: "m/s",
                scale,
                initial: 0.0,
                law: None,
            });
        }
        let solution = mesh.eliminate(&solved, usize::MAX).solve(values);
        Self { structure, ends, solution }
    }

    /// Velocity of a body in a cluster, relative to the cluster's anchor if it has one only, and to
    /// its first body if it has none.
    pub(super) fn velocity(&self, body: usize) -> &Row<T> {
        self.solution.value(body)
    }

    /// Difference of the velocities of two bodies in one cluster.
    pub(super) fn difference(&self, p: usize, q: usize) -> Row<T> {
        self.solution.difference(p, q)
    }

    /// Deformation rate of a dashpot, one end of which is in a cluster.
    pub(super) fn rate(&self, ends: [usize; 2]) -> Option<Row<T>> {
        let [p, q] = self.ends.numbers(self.structure, ends)?;
        Some(self.solution.difference(p, q))
    }
}
