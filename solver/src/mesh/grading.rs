//! Mesh grading: fine under the contact, growing away from it.

use crate::number::{count_at_least, real};

/// Target spacing along a line, as a function of the distance from its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spacing {
    /// Spacing in the core, mm.
    pub core: f64,
    /// Half the length of the core, where spacing is uniform, mm.
    pub core_half: f64,
    /// Growth per element in the zone that the contact may reach later.
    pub zone_growth: f64,
    /// Half the length of that zone, mm.
    pub zone_half: f64,
    /// Growth per element beyond it.
    pub outer_growth: f64,
    /// Largest spacing, mm.
    pub largest: f64,
}

impl Spacing {
    /// The spacing that is nowhere coarser than either of two.
    pub(crate) fn for_both(self, other: Self) -> Self {
        Self {
            core: self.core.min(other.core),
            core_half: self.core_half.max(other.core_half),
            zone_growth: self.zone_growth.min(other.zone_growth),
            zone_half: self.zone_half.max(other.zone_half),
            outer_growth: self.outer_growth.min(other.outer_growth),
            largest: self.largest.min(other.largest),
        }
    }
}

/// Part of the line beyond the core that is no element of its own. Arbitrary: on an arc that ends at its rim an element this long along the
/// arc is its half square, 5e-13 of the radius, wide, still far above round-off.
const LEAST_REST: f64 = 1e-6;

/// Symmetric node positions on [-half, half] with one node in the middle and one at each end, ascending.
///
/// The core is divided evenly. Beyond it the spacing grows by a fixed ratio per element, more slowly in the zone that
/// the contact may reach later; the rest is scaled so that a node lies on the end.
pub(crate) fn symmetric(half: f64, spacing: &Spacing) -> Vec<f64> {
    let core_half = spacing.core_half.min(half);
    let n_core = count_at_least(core_half / spacing.core - 1e-9);
    let mut right: Vec<f64> = (1..=n_core)
        .map(|i| core_half * real(i) / real(n_core))
        .collect();
    let remaining = half - core_half;
    let mut step = core_half / real(n_core);
    if remaining > LEAST_REST * half {
        let mut outer = Vec::new();
        let mut x = 0.0;
        while x < remaining {
            let zone = core_half + x < spacing.zone_half;
            step *= 1.0
                + if zone {
                    spacing.zone_growth
                } else {
                    spacing.outer_growth
                };
            step = step.min(spacing.largest);
            x += step;
            outer.push(x);
        }
        let scale = remaining / x;
        right.extend(outer.iter().map(|x| core_half + scale * x));
    }
    if let Some(end) = right.last_mut() {
        *end = half;
    }
    right
        .iter()
        .rev()
        .map(|x| -x)
        .chain(std::iter::once(0.0))
        .chain(right.iter().copied())
        .collect()
}

/// Length that belongs to each of several places, ascending: half of the distances to its neighbours.
pub(crate) fn tributary(x: &[f64]) -> Vec<f64> {
    (0..x.len())
        .map(|i| 0.5 * (x[(i + 1).min(x.len() - 1)] - x[i.saturating_sub(1)]))
        .collect()
}

/// Fractions 0 = surface .. 1 = far face of layers that begin with `first` of a height 1 and grow by about `growth`.
pub(crate) fn layers(first: f64, growth: f64) -> Vec<f64> {
    let first = first.clamp(1e-9, 1.0);
    let n = count_at_least((1.0 + (growth - 1.0) / first).ln() / growth.ln() - 0.5);
    let ratio = ratio_of_sum(first, n);
    let mut fractions = vec![0.0];
    let (mut y, mut step) = (0.0, first);
    for _ in 0..n {
        y += step;
        step *= ratio;
        fractions.push(y);
    }
    let end = y;
    fractions.iter().map(|f| f / end).collect()
}

/// The ratio r with first (1 + r + ... + r^(n-1)) = 1, by bisection.
fn ratio_of_sum(first: f64, n: usize) -> f64 {
    let sum = |ratio: f64| (0..n).fold((0.0, first), |(s, t), _| (s + t, t * ratio)).0;
    let (mut low, mut high) = (0.5, 4.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if sum(middle) < 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: Spacing = Spacing {
        core: 0.1,
        core_half: 0.5,
        zone_growth: 0.05,
        zone_half: 1.0,
        outer_growth: 0.2,
        largest: 2.0,
    };

    #[test]
    fn places_are_symmetric_ascending_and_end_at_the_ends() {
        let x = symmetric(3.0, &SPACING);
        assert!(x.windows(2).all(|w| w[0] < w[1]));
        assert!((x[0] + 3.0).abs() < 1e-15 && (x[x.len() - 1] - 3.0).abs() < 1e-15);
        assert!(
            x.iter()
                .zip(x.iter().rev())
                .all(|(a, b)| (a + b).abs() < 1e-15)
        );
        assert!(x.contains(&0.0));
    }

    #[test]
    fn the_core_has_the_wanted_spacing() {
        let x = symmetric(3.0, &SPACING);
        for w in x.windows(2).filter(|w| w[0] > -0.5 && w[1] < 0.5) {
            assert!((w[1] - w[0] - 0.1).abs() < 1e-12);
        }
    }

    #[test]
    fn a_core_longer_than_the_line_is_cut_evenly() {
        let x = symmetric(0.3, &SPACING);
        assert_eq!(x.len(), 7);
    }

    #[test]
    fn layers_begin_thin_and_fill_the_height() {
        let f = layers(0.01, 1.2);
        assert!((f[1] - 0.01).abs() < 1e-6 && (f[f.len() - 1] - 1.0).abs() < 1e-15);
        assert!(f.windows(2).all(|w| w[0] < w[1]));
    }
}
