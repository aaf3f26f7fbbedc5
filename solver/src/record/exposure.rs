//! Exposed length: the part of a surface that is worn to a depth, for depths that are linear between the nodes.

/// Length along x on which the depth at nodes in ascending order is at least a limit above 0, mm.
pub(super) fn exposed_length(x: &[f64], depth: &[f64], limit: f64) -> f64 {
    let ends = x.windows(2).zip(depth.windows(2));
    ends.map(|(x, depth)| (x[1] - x[0]) * share_beyond(depth[0], depth[1], limit))
        .sum()
}

/// Part of an element on which a value that is linear between those of its ends is at least a limit.
fn share_beyond(a: f64, b: f64, limit: f64) -> f64 {
    match (a >= limit, b >= limit) {
        (true, true) => 1.0,
        (false, false) => 0.0,
        _ => (a.max(b) - limit) / (a - b).abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::exposed_length;

    #[test]
    fn the_ends_of_an_exposed_part_lie_between_nodes() {
        let (x, depth) = ([0.0, 1.0, 2.0, 4.0], [0.0, 2.0, 2.0, 0.0]);
        assert!((exposed_length(&x, &depth, 1.0) - 2.5).abs() < 1e-15);
        assert!((exposed_length(&x, &depth, 2.0) - 1.0).abs() < 1e-15);
        assert!(exposed_length(&x, &depth, 2.1) <= 0.0);
        assert!(exposed_length(&[0.0], &[3.0], 1.0) <= 0.0);
    }
}
