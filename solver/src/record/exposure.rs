//! Exposure: how much of a worn surface is at least as deep as a limit, for depths that are linear between the nodes.

use super::scar;

/// Halvings of the interval that holds a depth.
const HALVINGS: usize = 50;

/// A surface of which parts are worn to a depth.
pub(crate) trait Exposed {
    /// Depth that a part of the scar has at least, mm; that of its deepest point for a part of 0.
    fn depth_of_part(&self, part: f64) -> f64;

    /// The part of the scar that is at least as deep as a limit above 0, mm.
    fn exposed_part(&self, limit: f64) -> f64;
}

impl<T: Exposed> Exposed for &T {
    fn depth_of_part(&self, part: f64) -> f64 {
        (**self).depth_of_part(part)
    }

    fn exposed_part(&self, limit: f64) -> f64 {
        (**self).exposed_part(limit)
    }
}

/// A worn contact surface: its nodes in ascending order and their depths, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WornSurface<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) depth: &'a [f64],
}

impl WornSurface<'_> {
    /// Length along x on which the depth is at least a limit above 0, mm.
    pub(crate) fn exposed_length(self, limit: f64) -> f64 {
        let ends = self.x.windows(2).zip(self.depth.windows(2));
        ends.map(|(x, depth)| (x[1] - x[0]) * share_beyond(depth[0], depth[1], limit))
            .sum()
    }

    /// Length of the scar, mm.
    fn scar(self) -> f64 {
        2.0 * scar::half_width(self.x, self.depth)
    }
}

impl Exposed for WornSurface<'_> {
    fn exposed_part(&self, limit: f64) -> f64 {
        let length = self.exposed_length(limit);
        if length > 0.0 {
            length / self.scar()
        } else {
            0.0
        }
    }

    fn depth_of_part(&self, part: f64) -> f64 {
        let deepest = self.depth.iter().fold(0.0, |most: f64, d| most.max(*d));
        if part <= 0.0 {
            return deepest;
        }
        let length = part * self.scar();
        // The floor of a groove, exactly.
        if self.exposed_length(deepest) >= length {
            return deepest;
        }
        let (mut low, mut high) = (0.0, deepest);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.exposed_length(middle) >= length {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }
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
    use super::*;

    #[test]
    fn the_ends_of_an_exposed_part_lie_between_nodes() {
        let worn = WornSurface {
            x: &[0.0, 1.0, 2.0, 4.0],
            depth: &[0.0, 2.0, 2.0, 0.0],
        };
        assert!((worn.exposed_length(1.0) - 2.5).abs() < 1e-15);
        assert!((worn.exposed_length(2.0) - 1.0).abs() < 1e-15);
        assert!(worn.exposed_length(2.1).max(worn.exposed_part(2.1)) <= 0.0);
        let single = WornSurface {
            x: &[0.0],
            depth: &[3.0],
        };
        assert!(single.exposed_length(1.0) <= 0.0);
    }

    #[test]
    fn the_depth_of_a_part_is_that_at_which_the_part_is_exposed() {
        let x: Vec<f64> = (-200..=200).map(|i| 0.01 * f64::from(i)).collect();
        let depth: Vec<f64> = x.iter().map(|x| (1.0 - x * x).max(0.0)).collect();
        let worn = WornSurface {
            x: &x,
            depth: &depth,
        };
        // Half of a parabola is deeper than 3/4 of its largest depth.
        assert!((worn.depth_of_part(0.5) - 0.75).abs() < 1e-2);
        assert!((worn.depth_of_part(0.0) - 1.0).abs() < 1e-15);
        for part in [0.1, 0.5, 0.9] {
            let again = worn.exposed_part(worn.depth_of_part(part));
            assert!((again - part).abs() < 1e-9, "{part}: {again}");
        }
    }
}
