//! Frictionless contact of half-spaces under a given normal force, with wear inside the solve.
//!
//! On the cells of a grid, with the gap h of the undeformed surfaces, the compliance C of the half-spaces and the diagonal
//! compliance d of the wear of the present increment in mm/MPa (backward Euler: h_worn = d p, d = (k_slider +
//! k_receptacle) |slip| cycles), pressures p and the approach delta satisfy
//!   g = h + C p + d p - delta >= 0,  p >= 0,  g p = 0,  sum of p dA = F:
//! the minimum of 1/2 p (C + d) p + h p under p >= 0 and the given force, which is unique, since C is positive definite.
//!
//! Method: conjugate gradients on the cells in contact, whose pressures are cut off at 0 and scaled to the force, and which
//! cells without pressure join where the surfaces overlap (Polonsky and Keer, Wear 231, 1999, 206-219). The direction is
//! preconditioned by the filter 1/(2/(E* kappa) + d) of the wave number kappa, the inverse of the operator on the whole plane,
//! on the grid without padding, at a quarter of the cost of a product with C (`preconditioner`; d differs from place to place where a part
//! sticks). Directions have no resultant. Polak and Ribiere's coefficient, at least 0, restarts them where the contact changes. A product with
//! C is computed once an iteration, and once more where pressures were cut off. Iterations of Hertz' sphere from a uniform pressure, on 32^2, 64^2 and 128^2 cells: 11, 12, 15
//! and 19, 26, 33 without the preconditioner; on 64^2 cells with wear d p0 of a third and of four times the approach 6 and 6, and 10 and 7.
//!
//! A cell joins with the pressure of its overlap by the stiffness of the last direction. Where many cells overlap a little, as those of a scar
//! that fits its slider do, that is too much: the contact grows beyond its size and shrinks again, for ever. Little pressure is always safe,
//! since the energy falls with the first of it; an iteration that does not come nearer takes a tenth, once or more.
//!
//! The residual is the larger of sum p |g|/sum p and of the deepest overlap, over the mean displacement sum p (C + d) p/sum p.

mod fields;

use super::cells::Cells;
use super::convergence::Convergence;
use super::convolution::{Convolution, Parity};
use super::error::AreaError;
use super::kernel::normal_influence;
use super::preconditioner::{Preconditioner, least_compliance};
use crate::number::real;

use fields::{
    Fields, add_wear, dot, mean_in_contact, mean_over_contact, remove_resultant, scale, start,
};

/// Most iterations. Unworn contacts take 11 to 15, worn ones about 6.
pub(crate) const MOST_ITERATIONS: usize = 1_000;

/// Largest residual: pressures of Hertz' sphere are then within 4e-6 of their peak with 32 to 128 cells along the window (1.3e-4 with
/// 1e-6), far below the error of the grid, for two more iterations.
pub(crate) const RESIDUAL_TOLERANCE: f64 = 1e-8;

/// A contact to be solved.
#[derive(Debug, Clone, Copy)]
pub struct NormalProblem<'a> {
    /// Gap of the undeformed surfaces at the cells, up to a constant, mm.
    pub gap_mm: &'a [f64],
    /// Depth by which both surfaces wear in the increment per pressure, mm/MPa.
    pub wear_mm_per_mpa: &'a [f64],
    /// Normal force F, N.
    pub force_n: f64,
}

/// Result of a normal solve, besides the pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalSolution {
    /// Approach delta of the bodies, by deformation and wear, from where the gap is 0, mm.
    pub approach_mm: f64,
    /// Iterations.
    pub iterations: usize,
    /// Residual of the last one.
    pub residual: f64,
}

/// Solves contacts on a grid of cells.
pub struct NormalContact {
    cells: Cells,
    modulus: f64,
    compliance: Convolution,
    preconditioner: Option<Preconditioner>,
    fields: Fields,
}

impl NormalContact {
    /// The contact of half-spaces of a contact modulus in MPa on a grid.
    pub fn new(cells: Cells, modulus: f64) -> Self {
        let size = (cells.dx_mm, cells.dz_mm);
        let compliance = Convolution::new(&cells, Parity::Even, |i, j| {
            normal_influence((size.0 * real(i), size.1 * real(j)), size, modulus)
        });
        let field = || vec![0.0; cells.count()];
        Self {
            cells,
            modulus,
            compliance,
            preconditioner: Some(Preconditioner::new(&cells, modulus)),
            fields: Fields {
                displacement: field(),
                residual: field(),
                last_residual: field(),
                steepest: field(),
                uniform: vec![1.0; cells.count()],
                direction: field(),
                response: field(),
            },
        }
    }

    /// The same without a preconditioner, to compare with.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn without_preconditioner(self) -> Self {
        Self {
            preconditioner: None,
            ..self
        }
    }

    /// The grid.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Solves for the pressure, from one of a like contact or from 0.
    ///
    /// # Errors
    /// A force that is not positive, no convergence, a contact that the grid does not hold.
    pub fn solve(
        &mut self,
        problem: &NormalProblem<'_>,
        pressure: &mut [f64],
    ) -> Result<NormalSolution, AreaError> {
        let force_n = problem.force_n;
        if !(force_n > 0.0 && force_n.is_finite()) {
            return Err(AreaError::Force { force_n });
        }
        start(&self.cells, force_n, pressure);
        if let Some(preconditioner) = &mut self.preconditioner {
            let wear = problem.wear_mm_per_mpa;
            let mean = mean_in_contact(wear, pressure);
            preconditioner.set_wear(&self.cells, wear, mean, pressure);
        }
        self.fields.direction.fill(0.0);
        self.displace(problem, pressure);
        let mut convergence = Convergence::default();
        let mut residual = f64::INFINITY;
        for iterations in 0..MOST_ITERATIONS {
            let approach_mm = self.fields.mean_gap(problem.gap_mm, pressure);
            residual = self
                .fields
                .update_residual(problem.gap_mm, approach_mm, pressure);
            if residual <= RESIDUAL_TOLERANCE {
                self.check_edge(pressure)?;
                return Ok(NormalSolution {
                    approach_mm,
                    iterations,
                    residual,
                });
            }
            convergence.note(residual);
            convergence.product = self.choose_direction(pressure, convergence.product);
            self.step(problem, pressure, &mut convergence);
        }
        self.check_edge(pressure)?;
        Err(AreaError::NotConverged {
            iterations: MOST_ITERATIONS,
            residual,
            tolerance: RESIDUAL_TOLERANCE,
        })
    }

    /// Computes the displacement by a pressure.
    fn displace(&mut self, problem: &NormalProblem<'_>, pressure: &[f64]) {
        let displacement = &mut self.fields.displacement;
        self.compliance.apply(pressure, displacement);
        add_wear(problem.wear_mm_per_mpa, pressure, displacement);
    }

    /// Chooses the next direction; returns the product of the residual with the preconditioned one. The last product is 0
    /// where directions begin again.
    fn choose_direction(&mut self, pressure: &[f64], last: f64) -> f64 {
        let Fields {
            residual,
            last_residual,
            steepest,
            uniform,
            direction,
            ..
        } = &mut self.fields;
        uniform.fill(1.0);
        match &mut self.preconditioner {
            Some(preconditioner) => {
                preconditioner.apply(residual, steepest);
                if preconditioner.is_local() {
                    // The multiplier of the force acts through the preconditioner: what is subtracted is a uniform approach's pressure.
                    let contact = pressure.iter().map(|p| if *p > 0.0 { 1.0 } else { 0.0 });
                    let contact: Vec<f64> = contact.collect();
                    preconditioner.apply(&contact, uniform);
                }
            }
            None => steepest.copy_from_slice(residual),
        }
        remove_resultant(pressure, uniform, steepest);
        let product = dot(residual, steepest);
        let beta = if last > 0.0 {
            ((product - dot(last_residual, steepest)) / last).max(0.0)
        } else {
            0.0
        };
        for (direction, steepest) in direction.iter_mut().zip(steepest) {
            *direction = *steepest + beta * *direction;
        }
        remove_resultant(pressure, uniform, direction);
        last_residual.copy_from_slice(residual);
        product
    }

    /// Moves the pressure along the direction, and the contact with it.
    fn step(
        &mut self,
        problem: &NormalProblem<'_>,
        pressure: &mut [f64],
        convergence: &mut Convergence,
    ) {
        let Fields {
            direction,
            response,
            residual,
            steepest,
            displacement,
            ..
        } = &mut self.fields;
        self.compliance.apply(direction, response);
        add_wear(problem.wear_mm_per_mpa, direction, response);
        let length = dot(residual, direction) / dot(direction, response);
        // Stiffness that turns an overlap into pressure.
        let stiffness = (dot(steepest, steepest) / dot(residual, residual)).sqrt();
        let is_local = self
            .preconditioner
            .as_ref()
            .is_some_and(Preconditioner::is_local);
        let least = least_compliance(&self.cells, self.modulus);
        let mut has_changed = false;
        let gaps = displacement.iter().zip(problem.gap_mm);
        let approach = mean_over_contact(pressure, gaps.clone().map(|(u, h)| u + h));
        let places = gaps.zip(problem.wear_mm_per_mpa);
        for ((pressure, direction), ((u, h), wear)) in
            pressure.iter_mut().zip(direction.iter()).zip(places)
        {
            if *pressure > 0.0 {
                *pressure -= length * direction;
                if *pressure <= 0.0 {
                    *pressure = 0.0;
                    has_changed = true;
                }
            } else if u + h < approach {
                let stiffness = if is_local {
                    1.0 / (least + wear)
                } else {
                    length * stiffness
                };
                *pressure = convergence.joining * stiffness * (approach - u - h);
                has_changed = true;
                convergence.product = 0.0;
            }
        }
        let factor = scale(&self.cells, problem.force_n, pressure);
        if has_changed {
            self.displace(problem, pressure);
        } else {
            for (u, response) in displacement.iter_mut().zip(response) {
                *u = factor * (*u - length * *response);
            }
        }
    }

    /// Refuses a contact that reaches the outermost cells.
    fn check_edge(&self, pressure: &[f64]) -> Result<(), AreaError> {
        let Cells {
            along_x, along_z, ..
        } = self.cells;
        let is_edge = |index: usize| {
            let (i, j) = (index / along_z, index % along_z);
            i == 0 || i + 1 == along_x || j == 0 || j + 1 == along_z
        };
        let mut loaded = pressure.iter().enumerate().filter(|(_, p)| **p > 0.0);
        if loaded.any(|(index, _)| is_edge(index)) {
            return Err(AreaError::ReachesEdge { along_x, along_z });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
