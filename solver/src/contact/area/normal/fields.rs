//! Fields of the iterations of a normal contact, and what is done with them cell by cell.

use crate::contact::area::cells::Cells;
use crate::number::real;

/// Fields of an iteration; each has a value for each cell.
pub(super) struct Fields {
    /// Displacement by pressure and wear, mm.
    pub(super) displacement: Vec<f64>,
    /// Gap less its mean in contact, and the last one, mm.
    pub(super) residual: Vec<f64>,
    pub(super) last_residual: Vec<f64>,
    /// Preconditioned residual, MPa.
    pub(super) steepest: Vec<f64>,
    /// Pressure of a uniform displacement of the contact by the preconditioner, MPa/mm, where the wear differs from place to place; 1
    /// elsewhere.
    pub(super) uniform: Vec<f64>,
    /// Direction, MPa, and its displacement, mm.
    pub(super) direction: Vec<f64>,
    pub(super) response: Vec<f64>,
}

impl Fields {
    /// Mean in contact of gap and displacement: the approach, mm.
    pub(super) fn mean_gap(&self, gap: &[f64], pressure: &[f64]) -> f64 {
        mean_over_contact(
            pressure,
            self.displacement.iter().zip(gap).map(|(u, h)| u + h),
        )
    }

    /// Updates the residual of the cells in contact; returns the relative one.
    pub(super) fn update_residual(&mut self, gap: &[f64], approach: f64, pressure: &[f64]) -> f64 {
        let (mut open, mut worst, mut total, mut work) = (0.0, 0.0_f64, 0.0, 0.0);
        let places = self.displacement.iter().zip(gap).zip(pressure);
        for (residual, ((u, h), p)) in self.residual.iter_mut().zip(places) {
            let g = u + h - approach;
            if *p > 0.0 {
                *residual = g;
                open += p * g.abs();
                total += p;
                work += p * u;
            } else {
                *residual = 0.0;
                worst = worst.max(-g);
            }
        }
        (open / total).max(worst) / (work / total)
    }
}

/// Scales a pressure to the force, or begins with a uniform one.
pub(super) fn start(cells: &Cells, force_n: f64, pressure: &mut [f64]) {
    let is_usable = pressure.iter().all(|p| p.is_finite() && *p >= 0.0);
    if !is_usable || pressure.iter().sum::<f64>() <= 0.0 {
        pressure.fill(1.0);
    }
    scale(cells, force_n, pressure);
}

/// Scales a pressure to the force; returns the factor.
pub(super) fn scale(cells: &Cells, force_n: f64, pressure: &mut [f64]) -> f64 {
    let factor = force_n / cells.integral(pressure);
    for p in pressure {
        *p *= factor;
    }
    factor
}

pub(super) fn add_wear(wear: &[f64], pressure: &[f64], displacement: &mut [f64]) {
    for ((u, p), wear) in displacement.iter_mut().zip(pressure).zip(wear) {
        *u += wear * p;
    }
}

/// Sets a field to 0 out of contact, and subtracts as much of a uniform one that it has no resultant.
pub(super) fn remove_resultant(pressure: &[f64], uniform: &[f64], field: &mut [f64]) {
    let part = mean_in_contact(field, pressure) / mean_in_contact(uniform, pressure);
    for ((value, uniform), p) in field.iter_mut().zip(uniform).zip(pressure) {
        *value = if *p > 0.0 {
            *value - part * uniform
        } else {
            0.0
        };
    }
}

pub(super) fn mean_in_contact(field: &[f64], pressure: &[f64]) -> f64 {
    mean_over_contact(pressure, field.iter().copied())
}

/// Mean of a field over the cells in contact.
pub(super) fn mean_over_contact(pressure: &[f64], field: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for (value, p) in field.zip(pressure) {
        if *p > 0.0 {
            sum += value;
            count += 1;
        }
    }
    sum / real(count.max(1))
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
