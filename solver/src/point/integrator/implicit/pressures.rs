//! Pressures at all positions of a cycle, with the wear of a jump by them: one convex minimum.
//!
//! With the gaps g of the unworn shapes, the compliance C of the half-spaces, and the depths h = G(D) of both surfaces under the doses of
//! all positions (`surface`), pressures p and approaches delta of the positions m satisfy
//!   r_m = g_m + C p_m + h_s + h_r - delta_m >= 0,  p_m >= 0,  r_m p_m = 0,  sum of p_m dA = F:
//! the minimum of sum path (1/2 p C p + g p) + 1/n (the integrals of G over the doses of both sides), because G increases. Layers are
//! kinks of its gradient.
//!
//! Method: semi-smooth Newton steps (`newton`), each to a lower energy. The approach is the mean of the gaps by the pressure, so that
//! sum r p = 0 at each position and pressures may be scaled to the force without a change of first order. Cells without pressure whose surfaces
//! overlap take part in a step; those that the step before would have cut off leave.

use std::ops::Range;

use super::fields::{reaches_edge, scale};
use super::filter::PressureFilter;
use super::positions::JumpPosition;
use super::surface::JumpSurface;
use crate::contact::area::{AreaError, Cells, Convolution, Parity, normal_influence};
use crate::linear::vector::dot;
use crate::number::real;
use crate::sides::{Side, Sides};

/// Most iterations of conjugate gradients: a shorter jump takes less work than more of them. With 400 and 1 200 a ball that is plated on both sides
/// takes jumps of 0.3 and 2 % of the cycles done, in the mean from 150 000 to 300 000 cycles, where both are through to their bases.
const MOST_ITERATIONS: usize = 1_200;

/// Largest gap in contact over the elastic indentation and over the tolerance of the run, and the largest for any. With 3e-4 and 1e-3 at 2 % lives
/// of a plated ball differ by 2e-4, for an eighth of the iterations.
const RESIDUAL_OF_TOLERANCE: f64 = 0.05;
const LARGEST_RESIDUAL: f64 = 1e-3;

/// Both surfaces at the end of a jump.
pub(super) type JumpSurfaces<'a> = Sides<JumpSurface<'a>>;

/// Pressures at all positions of a cycle on a window.
pub(in crate::point) struct CyclePressures {
    pub(super) cells: Cells,
    pub(super) positions: Vec<JumpPosition>,
    /// Gaps of the unworn shapes at all positions, mm.
    unworn: Vec<f64>,
    pub(super) compliance: Convolution,
    pub(super) filter: PressureFilter,
    least_compliance: f64,
    /// Largest residual.
    tolerance: f64,
    /// Displacement by the pressures, and gap with the worn depths less the approach, mm.
    pub(super) displacement: Vec<f64>,
    pub(super) gap: Vec<f64>,
    /// 1 in cells that take part in a step, and 1 in those whose pressure the last one would have cut off.
    pub(super) free: Vec<f64>,
    pub(super) cut: Vec<f64>,
    /// Gap in free cells that the step leaves, mm, and the same preconditioned, MPa.
    pub(super) residual: Vec<f64>,
    pub(super) steepest: Vec<f64>,
    /// Direction of conjugate gradients, MPa, the displacement by it, and that with its wear, mm.
    pub(super) direction: Vec<f64>,
    pub(super) response: Vec<f64>,
    pub(super) opening: Vec<f64>,
    /// Pressures that the step takes off, MPa, and the displacement by them, mm.
    pub(super) step: Vec<f64>,
    pub(super) relief: Vec<f64>,
}

impl CyclePressures {
    /// On a window, between half-spaces of a contact modulus in MPa, for a run of a tolerance.
    pub(super) fn new(cells: Cells, modulus: f64, tolerance: f64) -> Self {
        let size = (cells.dx_mm, cells.dz_mm);
        let compliance = Convolution::new(&cells, Parity::Even, |i, j| {
            normal_influence((size.0 * real(i), size.1 * real(j)), size, modulus)
        });
        Self {
            cells,
            positions: Vec::new(),
            unworn: Vec::new(),
            compliance,
            filter: PressureFilter::new(&cells, modulus),
            least_compliance: 2.0 * size.0.min(size.1) / (std::f64::consts::PI * modulus),
            tolerance: (RESIDUAL_OF_TOLERANCE * tolerance).min(LARGEST_RESIDUAL),
            displacement: Vec::new(),
            gap: Vec::new(),
            free: Vec::new(),
            cut: Vec::new(),
            residual: Vec::new(),
            steepest: Vec::new(),
            direction: Vec::new(),
            response: Vec::new(),
            opening: Vec::new(),
            step: Vec::new(),
            relief: Vec::new(),
        }
    }

    /// Takes positions with the gaps of the unworn shapes there, mm.
    pub(super) fn place(&mut self, positions: Vec<JumpPosition>, unworn: Vec<f64>) {
        let count = unworn.len();
        for field in [
            &mut self.displacement,
            &mut self.gap,
            &mut self.free,
            &mut self.cut,
            &mut self.residual,
            &mut self.steepest,
            &mut self.direction,
            &mut self.response,
            &mut self.opening,
            &mut self.step,
            &mut self.relief,
        ] {
            field.clear();
            field.resize(count, 0.0);
        }
        self.filter.place(&positions);
        self.positions = positions;
        self.unworn = unworn;
    }

    /// Solves for the pressures under a force in N; returns the iterations.
    ///
    /// # Errors
    /// No convergence, a contact that the window does not hold.
    pub(super) fn solve(
        &mut self,
        force_n: f64,
        surfaces: &mut JumpSurfaces<'_>,
        pressure: &mut [f64],
    ) -> Result<usize, AreaError> {
        self.start(force_n, surfaces, pressure);
        let (mut residual, mut iterations) = (f64::INFINITY, 0);
        while iterations < MOST_ITERATIONS {
            for side in Side::BOTH {
                let surface = surfaces.of_mut(side);
                surface.load(&self.positions, pressure);
            }
            residual = self.update_residual(surfaces, pressure);
            if residual <= self.tolerance || !residual.is_finite() {
                break;
            }
            for side in Side::BOTH {
                let surface = surfaces.of_mut(side);
                surface.set_scale(&self.positions, &self.free, self.least_compliance);
            }
            self.filter.wear = surfaces.as_ref().map(JumpSurface::mean_wear);
            iterations += self.take_step(force_n, surfaces, pressure);
        }
        let Cells {
            along_x, along_z, ..
        } = self.cells;
        if reaches_edge(&self.cells, pressure) {
            return Err(AreaError::ReachesEdge { along_x, along_z });
        }
        if residual <= self.tolerance {
            return Ok(iterations);
        }
        Err(AreaError::NotConverged {
            iterations,
            residual,
            tolerance: self.tolerance,
        })
    }

    /// Limits the pressures to begin with to those of like wear, and applies them.
    fn start(&mut self, force_n: f64, surfaces: &mut JumpSurfaces<'_>, pressure: &mut [f64]) {
        for side in Side::BOTH {
            surfaces.of_mut(side).limit_wear(&self.positions, pressure);
        }
        let count = self.cells.count();
        let displacements = self.displacement.chunks_exact_mut(count);
        for (pressure, displacement) in pressure.chunks_exact_mut(count).zip(displacements) {
            scale(&self.cells, force_n, pressure);
            self.compliance.apply(pressure, displacement);
        }
        self.cut.fill(0.0);
    }

    /// Updates gaps, free cells and residuals; returns the largest relative residual of a position, NaN where one has no pressure.
    fn update_residual(&mut self, surfaces: &JumpSurfaces<'_>, pressure: &[f64]) -> f64 {
        let places = self.unworn.iter().zip(&self.displacement);
        for (gap, (unworn, displacement)) in self.gap.iter_mut().zip(places) {
            *gap = unworn + displacement;
        }
        for side in Side::BOTH {
            surfaces.of(side).add_depths(&self.positions, &mut self.gap);
        }
        let count = self.cells.count();
        let mut largest = 0.0;
        for number in 0..self.positions.len() {
            let range = number * count..(number + 1) * count;
            let relative = self.update_residual_at(range.clone(), &pressure[range]);
            if relative.is_nan() || relative > largest {
                largest = relative;
            }
        }
        largest
    }

    /// The same for the pressure of the position of these cells.
    fn update_residual_at(&mut self, range: Range<usize>, pressure: &[f64]) -> f64 {
        let gap = &mut self.gap[range.clone()];
        let total: f64 = pressure.iter().sum();
        let approach = dot(pressure, gap) / total;
        let (mut open, mut worst) = (0.0, 0.0_f64);
        let cells = gap.iter_mut().zip(pressure).zip(&self.cut[range.clone()]);
        let residuals = self.residual[range.clone()].iter_mut();
        let fields = residuals.zip(&mut self.free[range.clone()]);
        for (((gap, p), cut), (residual, free)) in cells.zip(fields) {
            *gap -= approach;
            let is_free = *gap < 0.0 || (*p > 0.0 && *cut <= 0.0);
            (*residual, *free) = if is_free { (*gap, 1.0) } else { (0.0, 0.0) };
            if *p > 0.0 {
                open += p * gap.abs();
            } else {
                worst = worst.max(-*gap);
            }
        }
        let work = dot(pressure, &self.displacement[range]);
        (open / total).max(worst) / (work / total)
    }

    /// Product of fields of all positions by their paths.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        let count = self.cells.count();
        let fields = a.chunks_exact(count).zip(b.chunks_exact(count));
        let products = self.positions.iter().zip(fields);
        products
            .map(|(position, (a, b))| position.path * dot(a, b))
            .sum()
    }
}
