//! Elimination before the factorisation.

use super::{
    tests::{Numbers, difference_of, places_of, values_of},
    *,
};

/// `M − c J` of masses in a row or a tree, with further springs between any two, a spring, a dashpot and maybe a
/// Maxwell element in each link; all unknowns are numbered at random.
fn network(
    masses: usize,
    is_chain: bool,
    c: f64,
    numbers: &mut Numbers,
) -> Vec<(usize, usize, f64)> {
    let mut links: Vec<(usize, usize)> =
        (1..masses).map(|at| (if is_chain { at - 1 } else { numbers.below(at) }, at)).collect();
    if !is_chain {
        links.extend((0..masses / 4).map(|_| (numbers.below(masses), numbers.below(masses))));
    }
    links.retain(|link| link.0 != link.1);
    let (position, speed) = (|at: usize| 2 * at, |at: usize| 2 * at + 1);
    let mut entries = Vec::new();
    for at in 0..masses {
        entries.extend([(position(at), position(at), 1.0), (speed(at), speed(at), 1.0)]);
        entries.push((position(at), speed(at), -c));
    }
    let mut size = 2 * masses;
    for (one, other) in links {
        let (stiffness, damping) = (1.0 + numbers.next(), 1.0 + numbers.next());
        for (row, near, far) in [(one, one, other), (other, other, one)] {
            for (column, sign) in [(near, 1.0), (far, -1.0)] {
                entries.push((speed(row), position(column), c * sign * stiffness));
                entries.push((speed(row), speed(column), c * sign * damping));
            }
        }
        if numbers.next() > 0.0 {
            entries.extend([
                (size, size, 1.0 + c),
                (size, speed(one), -c),
                (size, speed(other), c),
            ]);
            entries.extend([(speed(one), size, c), (speed(other), size, -c)]);
            size += 1;
        }
    }
    let names = numbers.shuffled(size);
    entries.iter_mut().for_each(|entry| {
        (entry.0, entry.1) = (names[entry.0], names[entry.1]);
    });
    // Diagonals come once, as in the matrices of the integrators.
    let mut sums = std::collections::BTreeMap::new();
    entries.iter().for_each(|own| *sums.entry((own.1, own.0)).or_insert(0.0) += own.2);
    sums.into_iter().map(|((column, row), value)| (row, column, value)).collect()
}

fn size_of(entries: &[(usize, usize, f64)]) -> usize {
    entries.iter().map(|entry| entry.0 + 1).max().unwrap()
}

fn reduced(entries: &[(usize, usize, f64)]) -> Banded {
    let size = size_of(entries);
    Banded::reduced(size, places_of(entries), size).unwrap()
}

#[test]
fn solutions_of_reduced_matrices_are_those_of_a_dense_factorisation() {
    let numbers = &mut Numbers(13);
    for masses in [1, 2, 3, 10, 40] {
        for c in [1e-3, 1.0, 900.0] {
            for is_chain in [true, false] {
                let entries = network(masses, is_chain, c, numbers);
                let mut banded = reduced(&entries);
                banded.factorise(&values_of(&entries)).unwrap();
                assert!(banded.layout.order.len() <= masses, "{masses} masses");
                let found = difference_of(&banded, size_of(&entries), &entries, numbers);
                assert!(found < 1.0, "{masses} masses, c = {c:e}: {found:e}");
            }
        }
    }
}

#[test]
fn chains_become_matrices_of_their_masses_with_next_neighbours_alone() {
    let entries = network(50, true, 0.1, &mut Numbers(17));
    let banded = reduced(&entries);
    assert_eq!((banded.layout.order.len(), banded.layout.reach), (50, 1));
    let size = size_of(&entries);
    let whole = Banded::whole(size, places_of(&entries), size).unwrap();
    assert!(whole.layout.reach >= 3);
}

#[test]
fn what_would_cost_digits_is_not_eliminated() {
    let numbers = &mut Numbers(19);
    let mut entries = network(20, true, 1.0, numbers);
    let mut banded = reduced(&entries);
    let positions: Vec<usize> = (0..size_of(&entries))
        .filter(|&row| entries.iter().filter(|entry| entry.0 == row).count() == 2)
        .collect();
    for (pivot, is_fit) in [(1.0, true), (0.0, false), (1e-12, false), (f64::NAN, false)] {
        for entry in entries.iter_mut().filter(|own| own.0 == own.1 && own.0 == positions[7]) {
            entry.2 = pivot;
        }
        assert_eq!(banded.factorise(&values_of(&entries)).is_ok(), is_fit, "{pivot:e}");
        assert_eq!(banded.solve(&mut vec![1.0; size_of(&entries)]), is_fit, "{pivot:e}");
    }
}

#[test]
fn factors_of_one_matrix_are_the_same_each_time() {
    let entries = network(40, false, 0.3, &mut Numbers(23));
    let solution = |mut banded: Banded| {
        banded.factorise(&values_of(&entries)).unwrap();
        let mut right = vec![1.0; size_of(&entries)];
        assert!(banded.solve(&mut right));
        right.into_iter().map(f64::to_bits).collect::<Vec<_>>()
    };
    let mut used = reduced(&entries);
    used.factorise(&values_of(&entries).iter().map(|own| 2.0 * own).collect::<Vec<_>>()).unwrap();
    assert_eq!(solution(used), solution(reduced(&entries)));
}
