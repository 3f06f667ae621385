use std::cell::OnceCell;

use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};

use crate::{Solution, Solve, SolveSettings, energy::ledger::ledger};

/// Masses in a row, the last of which moves.
fn row(count: usize) -> Network {
    let mut network = Network::new();
    let mut before = network.ground();
    for at in 0..count {
        let node = Node::mass(format!("mass-{at}"), 1.0);
        let node = if at + 1 == count { node.moving(-1.0) } else { node };
        let node = network.add_node(node);
        let kelvin =
            Model::parallel([part(Spring { stiffness: 100.0 }), part(Dashpot { damping: 1.0 })]);
        network.connect(format!("pad-{at}"), node, before, kelvin);
        before = node;
    }
    network
}

fn at_hand(solution: &Solution<'_>) -> usize {
    solution.known.signals.cells.iter().filter(|cell| OnceCell::get(cell).is_some()).count()
}

#[test]
fn looks_beyond_the_bound_keep_no_signal_and_tell_the_same() {
    for method in ["exact", "bdf"] {
        let report =
            row(6).solve_with(&SolveSettings::lasting(0.5).by_name(method).unwrap()).unwrap();
        let roomy = Solution::new(&report.assembly, &report.trajectory);
        let mut narrow = Solution::new(&report.assembly, &report.trajectory);
        narrow.known.signals.most = 0;
        let balances = [&roomy, &narrow].map(|own| ledger(own, own.end()));
        assert_eq!(balances[0], balances[1], "{method}");
        assert!(at_hand(&roomy) > 20, "{method}: {}", at_hand(&roomy));
        assert_eq!(at_hand(&narrow), 1, "{method}: the first one is within the bound");

        let force = report.assembly.connections[5].force.unwrap();
        let before = narrow.signal(force).clone();
        narrow.make_room();
        assert_eq!(at_hand(&narrow), 0);
        assert_eq!(narrow.signal(force), &before);
        let mut roomy = roomy;
        let many = at_hand(&roomy);
        roomy.make_room();
        assert_eq!(at_hand(&roomy), many, "nothing is dropped within the bound");
    }
}
