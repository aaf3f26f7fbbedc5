//! Exposure of a worn area: the part of a scar that is at least as deep as a limit, of the cells of a map.
//!
//! The cells of the scar, those deeper than a fiftieth of the deepest, are taken in descending order; each has the part of those before it and
//! half of its own above it, and between these the part is linear in the depth.

use super::exposure::Exposed;
use super::scar::SCAR_EDGE;
use crate::interpolation;

/// Depths of the cells of a scar.
pub(crate) struct WornArea {
    /// In ascending order, mm.
    depth: Vec<f64>,
    /// Part of the scar that is at least as deep.
    part: Vec<f64>,
}

impl WornArea {
    /// The scar of a map of depths, mm.
    pub(crate) fn new(map: &[f64]) -> Self {
        Self::of_cells(map.iter().map(|depth| (*depth, 1.0)))
    }

    /// The scar of cells of depths, mm, and areas in any unit.
    pub(crate) fn of_cells(cells: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let deepest = cells.clone().fold(0.0, |most: f64, cell| most.max(cell.0));
        let mut cells: Vec<(f64, f64)> =
            cells.filter(|cell| cell.0 > SCAR_EDGE * deepest).collect();
        cells.sort_by(|a, b| a.0.total_cmp(&b.0));
        let area: f64 = cells.iter().map(|cell| cell.1).sum();
        let mut above = area;
        let part = cells.iter().map(|cell| {
            above -= cell.1;
            (above + 0.5 * cell.1) / area
        });
        Self {
            part: part.collect(),
            depth: cells.iter().map(|cell| cell.0).collect(),
        }
    }
}

impl Exposed for WornArea {
    fn depth_of_part(&self, part: f64) -> f64 {
        if part <= 0.0 {
            return self.depth.last().copied().unwrap_or_default();
        }
        // By descending parts.
        let (parts, depths): (Vec<f64>, Vec<f64>) = self.part.iter().zip(&self.depth).rev().unzip();
        interpolation::linear(&parts, &depths, part)
    }

    fn exposed_part(&self, limit: f64) -> f64 {
        match (self.depth.first(), self.depth.last()) {
            (_, Some(deepest)) if *deepest >= limit => {
                interpolation::linear(&self.depth, &self.part, limit)
            }
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A paraboloid: half of its area is deeper than half of its depth.
    #[test]
    fn half_of_a_paraboloid_is_deeper_than_half_of_its_depth() {
        let places = (0..200).flat_map(|i| (0..200).map(move |j| (i, j)));
        let map: Vec<f64> = places
            .map(|(i, j)| {
                let (x, z) = (0.01 * (f64::from(i) - 99.5), 0.01 * (f64::from(j) - 99.5));
                (1.0 - x * x - z * z).max(0.0)
            })
            .collect();
        let worn = WornArea::new(&map);
        // The scar ends at 2 % of the depth.
        let exact = 0.5 / 0.98;
        assert!((worn.exposed_part(0.5) - exact).abs() < 2e-3);
        assert!((worn.depth_of_part(exact) - 0.5).abs() < 2e-3);
        assert!((worn.depth_of_part(0.0) - 1.0).abs() < 1e-3);
        assert!(worn.exposed_part(1.1) <= 0.0);
    }

    #[test]
    fn an_unworn_area_has_no_scar() {
        let worn = WornArea::new(&[0.0; 4]);
        assert!(worn.exposed_part(1e-9) <= 0.0 && worn.depth_of_part(0.0) <= 0.0);
        assert!(worn.depth_of_part(0.5) <= 0.0);
    }
}
