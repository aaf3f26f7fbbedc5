//! Friction over an area under given pressures: stick and slip of half-spaces by Coulomb's law in the plane.
//!
//! An increment displaces the slider by D along x and z. With the tangential compliance C of both bodies, the shear q0 before the
//! increment and q after it, a place slips by
//!   s = D - C (q - q0),
//! where |q| <= mu p, s = 0 within the disc and q = mu p s/|s| on its edge: the minimum of 1/2 q C q - q (D + C q0) over the discs,
//! which is unique. q acts on the receptacle. Pressures are those of like bodies, which shear does not change; while they change
//! from increment to increment the bound follows them. Limiting case: Cattaneo 1938, Mindlin 1949.
//!
//! Method: projected gradients with spectral steps (Barzilai and Borwein 1988; Birgin, Martinez and Raydan, SIAM J. Optim. 10, 2000) and an
//! exact line search, which a quadratic allows, so that the energy falls in each iteration: one product with C an iteration.
//! A projection on a disc is exact, whatever the direction of slip.

use super::cells::Cells;
use super::convolution::{Convolution, Parity};
use super::kernel::ShearCompliance;
use crate::number::real;

/// Most iterations: Mindlin's sphere takes 119, 243 and 327 from no shear with 560, 2 252 and 5 048 cells in contact.
pub(crate) const MOST_TANGENTIAL_ITERATIONS: usize = 5_000;

/// Largest step of the shear over the largest bound at which the iteration ends.
pub(crate) const SHEAR_TOLERANCE: f64 = 1e-7;

/// A vector field: its components along x and z at the cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shear {
    /// Along the sliding direction.
    pub along: Vec<f64>,
    /// Across it.
    pub across: Vec<f64>,
}

/// Why an increment of friction has no solution.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("no shear after {iterations} iterations: change {change:.2e}, tolerance {tolerance:.2e}")]
pub struct TangentialError {
    /// Iterations made.
    pub iterations: usize,
    /// Change of the shear over the largest bound in the last one.
    pub change: f64,
    /// Largest change.
    pub tolerance: f64,
}

/// Result of an increment, besides the shear.
#[derive(Debug, Clone, PartialEq)]
pub struct Slip {
    /// Slip of the slider over the receptacle, mm.
    pub slip_mm: Shear,
    /// Energy dissipated, sum of q s dA, mJ (N mm).
    pub energy_mj: f64,
    /// Iterations.
    pub iterations: usize,
}

/// Solves increments of friction on a grid of cells.
pub(crate) struct TangentialContact {
    cells: Cells,
    along: Convolution,
    across: Convolution,
    mixed: Convolution,
    scratch: Vec<f64>,
}

impl TangentialContact {
    /// The contact of two half-spaces on a grid.
    pub(crate) fn new(cells: Cells, compliance: ShearCompliance) -> Self {
        let (dx, dz) = (cells.dx_mm, cells.dz_mm);
        let offset = |i: usize, j: usize| (dx * real(i), dz * real(j));
        let swapped = |i, j| {
            let (x, z) = offset(i, j);
            compliance.along((z, x), (dz, dx))
        };
        Self {
            along: Convolution::new(&cells, Parity::Even, |i, j| {
                compliance.along(offset(i, j), (dx, dz))
            }),
            across: Convolution::new(&cells, Parity::Even, swapped),
            mixed: Convolution::new(&cells, Parity::Odd, |i, j| {
                compliance.across(offset(i, j), (dx, dz))
            }),
            scratch: vec![0.0; cells.count()],
            cells,
        }
    }

    /// Tangential displacement of the slider's surface over the receptacle's that a shear takes up, mm.
    pub(crate) fn displacement(&mut self, shear: &Shear) -> Shear {
        let mut found = Shear::zero(shear.along.len());
        self.displace(shear, &mut found);
        found
    }

    fn displace(&mut self, shear: &Shear, out: &mut Shear) {
        self.along.apply(&shear.along, &mut out.along);
        self.across.apply(&shear.across, &mut out.across);
        for (from, to) in [
            (&shear.across, &mut out.along),
            (&shear.along, &mut out.across),
        ] {
            self.mixed.apply(from, &mut self.scratch);
            for (to, mixed) in to.iter_mut().zip(&self.scratch) {
                *to += mixed;
            }
        }
    }

    /// Advances the shear by an increment of the slider's displacement in mm, under the bounds mu p in MPa.
    ///
    /// # Errors
    /// No convergence.
    pub(crate) fn advance(
        &mut self,
        displacement_mm: (f64, f64),
        bound: &[f64],
        shear: &mut Shear,
    ) -> Result<Slip, TangentialError> {
        // Of the surfaces before the increment and of the imposed displacement: slip is what shear leaves of it.
        let mut target = self.displacement(shear);
        target.add(displacement_mm);
        project(shear, bound);
        let mut slip = target.minus(&self.displacement(shear));
        let largest = bound.iter().fold(0.0, |most: f64, bound| most.max(*bound));
        let (mut response, mut length) =
            (Shear::zero(bound.len()), self.first_length(largest, &slip));
        let mut change = f64::INFINITY;
        for iterations in 0..MOST_TANGENTIAL_ITERATIONS {
            let direction = direction(shear, &slip, length, bound);
            change = direction.largest() / largest.max(f64::MIN_POSITIVE);
            if change <= SHEAR_TOLERANCE {
                return Ok(self.found(shear, slip, iterations));
            }
            self.displace(&direction, &mut response);
            let curvature = direction.dot(&response);
            let part = (slip.dot(&direction) / curvature).min(1.0);
            shear.add_scaled(part, &direction);
            slip.add_scaled(-part, &response);
            length = direction.dot(&direction) / curvature;
        }
        Err(TangentialError {
            iterations: MOST_TANGENTIAL_ITERATIONS,
            change,
            tolerance: SHEAR_TOLERANCE,
        })
    }

    /// Length of the first step, MPa/mm: the largest bound over the largest displacement.
    fn first_length(&self, largest: f64, slip: &Shear) -> f64 {
        let most = slip.largest();
        if most > 0.0 {
            largest / most
        } else {
            1.0 / self.cells.dx_mm
        }
    }

    fn found(&self, shear: &Shear, slip_mm: Shear, iterations: usize) -> Slip {
        Slip {
            energy_mj: self.cells.area_mm2() * shear.dot(&slip_mm),
            slip_mm,
            iterations,
        }
    }
}

/// Step of projected gradients: from a shear to the projection of the shear moved along the slip.
fn direction(shear: &Shear, slip: &Shear, length: f64, bound: &[f64]) -> Shear {
    let mut moved = shear.clone();
    moved.add_scaled(length, slip);
    project(&mut moved, bound);
    moved.minus(shear)
}

/// Moves each vector to the nearest one of its disc.
fn project(shear: &mut Shear, bound: &[f64]) {
    let vectors = shear.along.iter_mut().zip(&mut shear.across);
    for ((along, across), bound) in vectors.zip(bound) {
        let size = along.hypot(*across);
        if size > *bound {
            let factor = bound / size;
            *along *= factor;
            *across *= factor;
        }
    }
}

impl Shear {
    /// None at any of a number of cells.
    pub fn zero(count: usize) -> Self {
        Self {
            along: vec![0.0; count],
            across: vec![0.0; count],
        }
    }

    fn add(&mut self, (along, across): (f64, f64)) {
        for value in &mut self.along {
            *value += along;
        }
        for value in &mut self.across {
            *value += across;
        }
    }

    fn add_scaled(&mut self, factor: f64, other: &Self) {
        let pairs = [
            (&mut self.along, &other.along),
            (&mut self.across, &other.across),
        ];
        for (values, others) in pairs {
            for (value, other) in values.iter_mut().zip(others) {
                *value += factor * other;
            }
        }
    }

    fn minus(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        difference.add_scaled(-1.0, other);
        difference
    }

    fn dot(&self, other: &Self) -> f64 {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        sum(&self.along, &other.along) + sum(&self.across, &other.across)
    }

    /// Largest magnitude.
    fn largest(&self) -> f64 {
        let sizes = self
            .along
            .iter()
            .zip(&self.across)
            .map(|(a, b)| a.hypot(*b));
        sizes.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests;
