//! Half-width of a wear scar.

/// The scar ends where the depth falls below this part of the largest, or a little further out.
pub(super) const SCAR_EDGE: f64 = 0.02;

/// A scar that runs out flat is extended by the line through its depths of `SCAR_EDGE` and of this part of the largest.
const SLOPE_FROM: f64 = 0.1;

/// Depth of the first node beyond the edge over that of the last one within it, below which the scar ends at an angle: the
/// node beyond is the foot of an element or two that the mesh makes.
const FOOT: f64 = 0.1;

/// Half the distance between the edges of the scar, mm.
///
/// Mostly the depth goes to zero at an angle. The line through the last two nodes above the foot then gives the edge to
/// about a tenth of an element; interpolating to the first unworn node would put it up to an element too far out. Where the
/// scar runs out flat, as at the ends of a groove, that line would depend on where the mesh has nodes, and depths are taken
/// instead that every mesh has.
pub(super) fn half_width(x: &[f64], depth: &[f64]) -> f64 {
    let largest = depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    let deep = |d: &f64| *d > SCAR_EDGE * largest;
    let (Some(first), Some(last)) = (depth.iter().position(deep), depth.iter().rposition(deep))
    else {
        return 0.0;
    };
    let mut scar: Vec<(f64, f64)> = x.iter().copied().zip(depth.iter().copied()).collect();
    let right = edge(&scar[first..], last - first, largest);
    scar.truncate(last + 1);
    scar.reverse();
    let left = edge(&scar, last - first, largest);
    0.5 * (right - left)
}

/// Edge of a scar from its places and depths in outward order, of which `last` is the last deep one: not beyond the first
/// unworn node or the end of the body.
fn edge(scar: &[(f64, f64)], last: usize, largest: f64) -> f64 {
    let (x, _) = scar[last];
    let beyond = &scar[last + 1..];
    let unworn = beyond.iter().find(|(_, depth)| *depth <= 0.0);
    let Some((bound, _)) = unworn.or(beyond.last()) else {
        return x;
    };
    let Some(out) = extended(scar, last, largest).filter(|out| out.is_finite()) else {
        return x;
    };
    out.clamp(x.min(*bound), x.max(*bound))
}

/// Where the depth would vanish; `None` for a scar of one deep node that ends at an angle.
fn extended(scar: &[(f64, f64)], last: usize, largest: f64) -> Option<f64> {
    let (x, depth) = scar[last];
    let (_, foot) = scar[last + 1];
    if foot > FOOT * depth {
        let at = |part: f64| place(&scar[..=last + 1], part * largest);
        let (end, within) = (at(SCAR_EDGE), at(SLOPE_FROM));
        return Some(end + (end - within) * SCAR_EDGE / (SLOPE_FROM - SCAR_EDGE));
    }
    let (inner, deeper) = scar[last.checked_sub(1)?];
    Some(x - depth * (inner - x) / (deeper - depth))
}

/// Outermost place that is deeper than `depth`, interpolated; the innermost place if none is.
fn place(scar: &[(f64, f64)], depth: f64) -> f64 {
    let beyond = scar.windows(2).rev().find(|pair| pair[0].1 > depth);
    beyond.map_or(scar[0].0, |pair| {
        let [(x, above), (outer, below)] = [pair[0], pair[1]];
        x + (outer - x) * (above - depth) / (above - below)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(element: f64, nodes: u32) -> Vec<f64> {
        (0..=nodes)
            .map(|i| element * (f64::from(i) - 0.5 * f64::from(nodes)))
            .collect()
    }

    /// A circular segment on a mesh that does not meet its edges, with a foot on the right: 0.5 (1.7 + 1.3).
    #[test]
    fn edges_lie_between_the_nodes() {
        let x = mesh(0.05, 80);
        let mut depth: Vec<f64> = x.iter().map(|x| ((1.7 + x) * (1.3 - x)).max(0.0)).collect();
        let foot = depth.iter().rposition(|d| *d > 0.0).expect("worn") + 1;
        depth[foot] = 1e-3;
        assert!((half_width(&x, &depth) - 1.5).abs() < 0.01);
    }

    /// Depth (1.7 - |x|)^2 beyond |x| = 0.7 and 1 between: 2 % at 1.5586, 10 % at 1.3838.
    #[test]
    fn scars_that_run_out_flat_have_one_width_on_any_mesh() {
        let expected = 1.5586 + 0.25 * (1.5586 - 1.3838);
        for (element, nodes) in [(0.1, 40), (0.07, 58), (0.03, 134), (0.01, 400)] {
            let x = mesh(element, nodes);
            let depth: Vec<f64> = x
                .iter()
                .map(|x| (1.7 - x.abs()).clamp(0.0, 1.0).powi(2))
                .collect();
            let width = half_width(&x, &depth);
            assert!((width / expected - 1.0).abs() < 0.01, "{element}: {width}");
        }
    }

    #[test]
    fn a_groove_over_the_whole_block_ends_with_it() {
        assert!((half_width(&[-1.0, 0.0, 1.0], &[0.5, 1.0, 0.4]) - 1.0).abs() < 1e-15);
        // The line through 10 and 2 % reaches beyond the last nodes.
        let [x, depth] = [[-2.0, -1.0, 0.0, 1.0, 2.0], [0.015, 0.1, 1.0, 0.1, 0.015]];
        assert!((half_width(&x, &depth) - 2.0).abs() < 1e-15);
        assert!(half_width(&[-1.0, 0.0, 1.0], &[0.0; 3]).abs() < 1e-15);
        assert!(half_width(&[-1.0, 0.0, 1.0], &[0.0, 1.0, 0.0]).abs() < 1e-15);
    }
}
