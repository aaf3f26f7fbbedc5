//! A regular grid of rectangular cells.

use serde::{Deserialize, Serialize};

use crate::number::real;

/// A regular grid of rectangular cells; the one at (i, j) along x and z has the index i along_z + j.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Cells {
    /// Number along the sliding direction x.
    pub along_x: usize,
    /// Number across it, along z.
    pub along_z: usize,
    /// Length of a cell, mm.
    pub dx_mm: f64,
    /// Width of a cell, mm.
    pub dz_mm: f64,
}

impl Cells {
    /// Number of cells.
    pub fn count(&self) -> usize {
        self.along_x * self.along_z
    }

    /// Area of a cell, mm^2.
    pub(crate) fn area_mm2(&self) -> f64 {
        self.dx_mm * self.dz_mm
    }

    /// Position of the centres of a row along x from the middle of the grid, mm.
    pub fn x_mm(&self, row: usize) -> f64 {
        self.dx_mm * (real(row) + 0.5 - 0.5 * real(self.along_x))
    }

    /// Position of the centres of a column along z from the middle of the grid, mm.
    pub fn z_mm(&self, column: usize) -> f64 {
        self.dz_mm * (real(column) + 0.5 - 0.5 * real(self.along_z))
    }

    /// A value at each centre from its position x, z in mm.
    pub fn map(&self, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let rows = (0..self.along_x).map(|row| self.x_mm(row));
        let at = |x| {
            let value = &value;
            (0..self.along_z).map(move |column| value(x, self.z_mm(column)))
        };
        rows.flat_map(at).collect()
    }

    /// Volume below a field of heights in mm, mm^3; or the force of a field of pressures in MPa, N.
    pub fn integral(&self, field: &[f64]) -> f64 {
        self.area_mm2() * field.iter().sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_lie_symmetrically_about_the_middle() {
        let cells = Cells {
            along_x: 4,
            along_z: 3,
            dx_mm: 2.0,
            dz_mm: 0.5,
        };
        let x: Vec<f64> = (0..4).map(|row| cells.x_mm(row)).collect();
        let z: Vec<f64> = (0..3).map(|column| cells.z_mm(column)).collect();
        assert_eq!((x, z), (vec![-3.0, -1.0, 1.0, 3.0], vec![-0.5, 0.0, 0.5]));
        let field = cells.map(|x, z| x + z);
        assert_eq!(field[3..5], [-1.5, -1.0]);
        assert!((cells.integral(&cells.map(|_, _| 2.0)) - 24.0).abs() < 1e-14);
    }
}
