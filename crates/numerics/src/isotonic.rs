//! Isotonic regression: what never falls and is nearest to given numbers.

/// A run of numbers that have one value in the regression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Number of the first one.
    pub start: usize,
    /// Number behind the last one.
    pub end: usize,
    /// Their common value: their weighted mean.
    pub value: f64,
    /// Sum of their weights.
    pub weight: f64,
}

/// The sequence that never falls and has the least weighted sum of squares from given pairs of a value and its
/// positive weight, as runs of equal values.
///
/// Neighbours that fall are pooled until none do (pool adjacent violators), in one pass. Equal neighbours stay apart.
///
/// # Examples
///
/// ```
/// use dashpot_numerics::isotonic::rising;
///
/// let blocks = rising([1.0, 3.0, 2.0, 4.0].map(|value| (value, 1.0)));
/// assert_eq!(blocks.iter().map(|own| own.value).collect::<Vec<_>>(), [1.0, 2.5, 4.0]);
/// assert_eq!((blocks[1].start, blocks[1].end), (1, 3));
/// ```
///
/// # References
///
/// `barlow1972` in `docs/references.bib`.
pub fn rising(values: impl IntoIterator<Item = (f64, f64)>) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for (at, (value, weight)) in values.into_iter().enumerate() {
        let mut own = Block { start: at, end: at + 1, value, weight };
        while let Some(before) = blocks.pop_if(|before| before.value > own.value) {
            let weight = before.weight + own.weight;
            // Between the two values, however large they are.
            let value = before.value + (own.value - before.value) * (own.weight / weight);
            own = Block { start: before.start, end: own.end, value, weight };
        }
        blocks.push(own);
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fitted(values: &[f64]) -> Vec<f64> {
        let blocks = rising(values.iter().map(|value| (*value, 1.0)));
        blocks.iter().flat_map(|own| vec![own.value; own.end - own.start]).collect()
    }

    #[test]
    fn what_rises_stays_as_it_is() {
        let values = [-1.0, 0.0, 0.0, 2.5, 1e300];
        assert_eq!(fitted(&values), values);
        assert_eq!(rising([]), []);
    }

    #[test]
    fn what_falls_throughout_becomes_its_mean() {
        assert_eq!(fitted(&[4.0, 3.0, 2.0, -1.0]), [2.0; 4]);
    }

    #[test]
    fn a_known_case_is_pooled_as_in_the_literature() {
        // Max over starts of min over ends of means: the formula of Barlow and others, in place of pooling.
        let values = [1.0, 2.0, 6.0, 2.0, 3.0, 5.0, 4.0, 7.0, 6.5, 6.0, 9.0];
        let mean = |from: usize, to: usize| {
            values[from..=to].iter().sum::<f64>() / f64::from(u32::try_from(to - from + 1).unwrap())
        };
        let exact: Vec<f64> = (0..values.len())
            .map(|at| {
                let least = |from| {
                    (at..values.len()).map(|to| mean(from, to)).fold(f64::INFINITY, f64::min)
                };
                (0..=at).map(least).fold(f64::NEG_INFINITY, f64::max)
            })
            .collect();
        for (own, exact) in fitted(&values).iter().zip(&exact) {
            assert!((own - exact).abs() < 1e-14, "{own} for {exact}");
        }
        assert!((exact[2] - 11.0 / 3.0).abs() < 1e-15, "6, 2 and 3 are pooled");
    }

    #[test]
    fn a_weight_counts_as_so_many_of_the_same() {
        let blocks = rising([(3.0, 2.0), (1.0, 1.0), (4.0, 1.0)]);
        assert_eq!(blocks.len(), 2);
        assert!((blocks[0].value - 7.0 / 3.0).abs() < 1e-15);
    }
}
