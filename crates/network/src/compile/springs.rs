//! Balances of springs: where the algebraic clusters are, and how far every spring is compressed.

use dashpot_dae::UnknownKind;

use super::{
    mesh::{Mesh, Solution},
    row::{Combination, Row, RowSum, Scalar},
    structure::{Numbers, Structure},
    unknowns::{Draft, Inputs, Places},
};

/// Positions of the algebraic clusters and differences along the springs.
pub(super) struct SpringBalance<'a, T> {
    structure: &'a Structure,
    /// `None` where there is no algebraic cluster.
    solution: Option<Solution<Row<T>>>,
}

/// The mesh's number of a body: its algebraic cluster, or the body itself behind the clusters.
fn place(structure: &Structure, body: usize) -> usize {
    structure.algebraic_cluster(body).unwrap_or(structure.clusters.len() + body)
}

/// Position of a body relative to its algebraic cluster; zero for all others.
fn within<T: Scalar>(structure: &Structure, places: &Places<T>, body: usize) -> Row<T> {
    match structure.algebraic_cluster(body) {
        Some(_) => places.position.row(body),
        None => Row::default(),
    }
}

impl<'a, T: Scalar> SpringBalance<'a, T> {
    /// Eliminates the places of the algebraic clusters under the given `loads` on bodies, those with few links first;
    /// the ones with more than `most_links` become algebraic unknowns, with `length` as their scale.
    pub(super) fn solve(
        structure: &'a Structure,
        numbers: &Numbers<'_, T>,
        loads: &[RowSum<T>],
        most_links: usize,
        places: &mut Places<T>,
        inputs: &mut Inputs,
        draft: impl Fn(usize) -> (String, f64),
    ) -> Self {
        let clusters = structure.clusters.len();
        if !(0..clusters).any(|cluster| structure.is_algebraic(cluster)) {
            return Self { structure, solution: None };
        }
        let bodies = structure.cluster_of.len();
        let mut mesh = Mesh::<Row<T>>::new(clusters + bodies);
        for spring in &structure.springs {
            let [a, b] = spring.ends;
            let (p, q) = (place(structure, a), place(structure, b));
            if p < clusters || q < clusters {
                let offset = within(structure, places, a)
                    .plus(-1.0, &within(structure, places, b))
                    .plus(1.0, &inputs.constant(spring.offset));
                mesh.link(p, q, (numbers.slope)(spring), &offset);
            }
        }
        let algebraic: Vec<usize> =
            (0..clusters).filter(|&cluster| structure.is_algebraic(cluster)).collect();
        for &cluster in &algebraic {
            for &body in &structure.clusters[cluster].bodies {
                mesh.load(cluster, 1.0, &loads[body].total());
            }
        }
        let eliminated = mesh.eliminate(&algebraic, most_links);
        let mut is_kept = vec![false; clusters];
        algebraic.iter().for_each(|&cluster| is_kept[cluster] = true);
        eliminated.places().for_each(|cluster| is_kept[cluster] = false);
        let kept: Vec<usize> = (0..clusters).filter(|&cluster| is_kept[cluster]).collect();
        let mut values = vec![Row::default(); clusters];
        values.extend((0..bodies).map(|body| places.position.row(body)));
        for (at, &cluster) in kept.iter().enumerate() {
            values[cluster] = Row::unknown(places.drafts.len() + at);
        }
        for &cluster in &kept {
            let mut balance = RowSum::default();
            balance.add(1.0, eliminated.rest.load_at(cluster));
            for (other, link) in eliminated.rest.links(cluster) {
                balance.add(link.conductance * -1.0, &values[cluster]);
                balance.add(link.conductance, &values[other]);
                balance.add(link.conductance * -1.0, &link.offset);
            }
            let (name, scale) = draft(structure.clusters[cluster].bodies[0]);
            places.rows.set(places.drafts.len(), &balance.total());
            places.drafts.push(Draft {
                name: format!("position of {name}"),
                kind: UnknownKind::Algebraic,
                unit: "m",
                scale,
                initial: 0.0,
                law: None,
            });
        }
        Self { structure, solution: Some(eliminated.solve(values)) }
    }

    pub(super) fn position(&self, places: &Places<T>, body: usize) -> Row<T> {
        match self.structure.algebraic_cluster(body).zip(self.solution.as_ref()) {
            Some((cluster, solution)) => {
                solution.value(cluster).plus(1.0, &places.position.row(body))
            }
            None => places.position.row(body),
        }
    }

    /// How far apart the places of two bodies are, the deformation of what has no offset.
    pub(super) fn difference(&self, places: &Places<T>, [a, b]: [usize; 2]) -> Row<T> {
        let Some(solution) = &self.solution else {
            return places.position.row(a).plus(-1.0, &places.position.row(b));
        };
        let (p, q) = (place(self.structure, a), place(self.structure, b));
        let offset =
            within(self.structure, places, a).plus(-1.0, &within(self.structure, places, b));
        if p == q { offset } else { solution.difference(p, q).plus(1.0, &offset) }
    }
}
