//! Half-width of a wear scar.

/// The edge of a scar is on the line through its last two nodes that are deeper than this part of its largest depth.
const SCAR_EDGE: f64 = 0.02;

/// Half the distance between the edges of the scar, mm.
///
/// The depth goes to zero at an angle, but for a foot of an element or two that the mesh makes. The line through the
/// last two nodes above the foot gives the edge to about a tenth of an element; interpolating to the first unworn
/// node would put it up to an element too far out.
pub(super) fn half_width(x: &[f64], depth: &[f64]) -> f64 {
    let limit = SCAR_EDGE * depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    let deep = |d: &f64| *d > limit;
    let (Some(first), Some(last)) = (depth.iter().position(deep), depth.iter().rposition(deep))
    else {
        return 0.0;
    };
    let edge = |node: usize, inner: usize, end: usize| {
        let rise = (depth[inner] - depth[node]) / (x[inner] - x[node]);
        let out = x[node] - depth[node] / rise;
        if node == end || inner == node || !out.is_finite() {
            return x[node];
        }
        // Not beyond the first unworn node.
        let unworn = if node < end {
            (node..=end).find(|&i| depth[i] <= 0.0)
        } else {
            (end..=node).rev().find(|&i| depth[i] <= 0.0)
        };
        let bound = x[unworn.unwrap_or(end)];
        out.clamp(x[node].min(bound), x[node].max(bound))
    };
    let left = edge(first, (first + 1).min(last), 0);
    let right = edge(last, last.saturating_sub(1).max(first), x.len() - 1);
    0.5 * (right - left)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circular segment on a mesh that does not meet its edges, with a foot on the right: 0.5 (1.7 + 1.3).
    #[test]
    fn edges_lie_between_the_nodes() {
        let x: Vec<f64> = (0..=80_u32).map(|i| -2.0 + 0.05 * f64::from(i)).collect();
        let mut depth: Vec<f64> = x.iter().map(|x| ((1.7 + x) * (1.3 - x)).max(0.0)).collect();
        let foot = depth.iter().rposition(|d| *d > 0.0).expect("worn") + 1;
        depth[foot] = 1e-3;
        assert!((half_width(&x, &depth) - 1.5).abs() < 0.01);
    }

    #[test]
    fn a_groove_over_the_whole_block_ends_with_it() {
        assert!((half_width(&[-1.0, 0.0, 1.0], &[0.5, 1.0, 0.4]) - 1.0).abs() < 1e-15);
        assert!(half_width(&[-1.0, 0.0, 1.0], &[0.0; 3]).abs() < 1e-15);
        assert!(half_width(&[-1.0, 0.0, 1.0], &[0.0, 1.0, 0.0]).abs() < 1e-15);
    }
}
