//! Linear interpolation between the nodes of a curve.

/// Value at `at` of the curve through the points (`x`, `y`), x ascending; beyond its ends, its end values. A curve of
/// one point is constant, one of none is 0.
///
/// With t = (at - x_0) / (x_1 - x_0) between the neighbours x_0 < at <= x_1, the value is (1 - t) y_0 + t y_1.
pub fn linear(x: &[f64], y: &[f64], at: f64) -> f64 {
    if x.len() < 2 {
        return y.first().copied().unwrap_or_default();
    }
    let i = x.partition_point(|&x| x < at).clamp(1, x.len() - 1);
    let t = ((at - x[i - 1]) / (x[i] - x[i - 1])).clamp(0.0, 1.0);
    (1.0 - t) * y[i - 1] + t * y[i]
}

/// Value after a part of the way from one value to another, of what grows evenly; exactly the other one at the end.
pub(crate) fn part_way(from: f64, to: f64, part: f64) -> f64 {
    if part < 1.0 {
        from + part * (to - from)
    } else {
        to
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_on_the_line_between_nodes_and_are_constant_beyond_the_ends() {
        let (x, y) = ([0.0, 1.0, 3.0], [2.0, 4.0, -2.0]);
        for (at, value) in [(-1.0, 2.0), (0.5, 3.0), (1.0, 4.0), (2.0, 1.0), (9.0, -2.0)] {
            assert!((linear(&x, &y, at) - value).abs() < 1e-15, "{at}");
        }
    }

    #[test]
    fn the_end_of_the_way_is_exact() {
        let (from, to) = (0.1, 0.3);
        assert!((part_way(from, to, 0.5) - 0.2).abs() < 1e-16);
        assert_eq!(part_way(from, to, 1.0).to_bits(), to.to_bits());
    }

    #[test]
    fn short_curves_are_constant() {
        assert!((linear(&[1.0], &[5.0], 7.0) - 5.0).abs() < 1e-15);
        assert!(linear(&[], &[], 7.0).abs() < 1e-15);
    }
}
