//! Quantiles of what was measured.

/// The least of the sorted values that so large a share of them does not exceed (nearest rank);
/// none of nothing.
pub fn nearest_rank<T: Copy>(sorted: &[T], share: f64) -> Option<T> {
    let last = sorted.len().checked_sub(1)?;
    let rank = libm::ceil(share * sorted.len() as f64) as usize;
    Some(sorted[rank.saturating_sub(1).min(last)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_rank_is_a_value_that_was_measured() {
        let values: Vec<f64> = (1..=20).map(f64::from).collect();
        let found = [0.5, 0.95, 1.0].map(|share| nearest_rank(&values, share).unwrap());
        assert_eq!(found, [10.0, 19.0, 20.0]);
        assert_eq!(nearest_rank(&[7.0], 0.5), Some(7.0));
        assert_eq!(nearest_rank::<f64>(&[], 0.5), None);
    }
}
