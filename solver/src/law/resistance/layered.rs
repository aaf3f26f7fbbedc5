//! Resistance of an isothermal disc on a half-space of layers.
//!
//! In the Hankel transform of the radius, r/a, the potential at the surface is Z(z) times the flux, with Z = rho/z of the base and
//!   Z = s (Z' + s th)/(s + Z' th),  s = rho_i/z,  th = tanh(z t_i/a)
//! through a layer over what has Z'. The flux of the disc is a sum of f_m = (1 - r^2)^(m - 1/2), m = 0, 1, ..., whose transforms are
//!   F_m = (2 m - 1)!! j_m(z)/z^m,  F_m(0) = 1/(2 m + 1),
//! j_m the spherical Bessel functions. Galerkin's method with A_mn = integral of Z F_m F_n z dz gives
//!   R = 1/(2 pi a b^T A^-1 b),  b_m = F_m(0).
//! The part of the outermost layer alone is integrated apart: the rest decays as exp(-2 z t/a). Limiting case: one material,
//! R = rho/(4 a) by f_0 alone. Layers of a sheet that is thin beside the spot have the resistance of the base.

use std::f64::consts::PI;

use nalgebra::{SMatrix, SVector};

/// Layer, or base, of a conductor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductor {
    /// Resistivity, ohm m.
    pub resistivity_ohm_m: f64,
    /// Thickness, mm; of a base without bound.
    pub thickness_mm: f64,
}

/// Functions of the flux: the references of ten times and a tenth of the resistivity are met in all digits.
const FUNCTIONS: usize = 10;
/// Simpson's rule: panels that double from this length on, because a thick layer shows at small z only, and a last one with several
/// intervals a period of j_m.
const FIRST_PANEL: f64 = 1e-6;
const PANELS: u32 = 20;
const INTERVALS: (u32, u32) = (16, 16_000);
const END: f64 = 800.0;
/// From here on j_m follows from its recurrence, which is stable beyond its order; before by its series.
const SERIES_TO: f64 = 12.0;

/// Resistance, ohm, from a disc of a radius in mm to far away through conductors from the surface down, of which the last one is the
/// base.
pub fn half_space(radius_mm: f64, conductors: &[Conductor]) -> f64 {
    let outer = conductors
        .first()
        .map_or(0.0, |outer| outer.resistivity_ohm_m);
    let mut matrix = SMatrix::<f64, FUNCTIONS, FUNCTIONS>::zeros();
    for (z, single) in nodes() {
        let beyond = impedance(z, radius_mm, conductors) - outer;
        let functions = transforms(z);
        matrix += single * beyond * functions * functions.transpose();
        let mut outermost = single * outer * functions * functions.transpose();
        // Known in closed form below.
        outermost.row_mut(0).fill(0.0);
        outermost.column_mut(0).fill(0.0);
        matrix += outermost;
    }
    let at_zero = transforms(0.0);
    // The potential of f_0 on a half-space is pi/2 all over the disc.
    for m in 0..FUNCTIONS {
        let known = 0.5 * PI * outer * at_zero[m];
        matrix[(0, m)] += known;
        if m > 0 {
            matrix[(m, 0)] += known;
        }
    }
    let flux = matrix.cholesky().map(|factor| factor.solve(&at_zero));
    let current = flux.map_or(f64::NAN, |flux| flux.dot(&at_zero));
    // Resistivities in ohm m over lengths in mm.
    1e3 / (2.0 * PI * radius_mm * current)
}

/// Places and weights of the integration.
fn nodes() -> impl Iterator<Item = (f64, f64)> {
    let panel = |number: u32| match number {
        0 => (0.0, FIRST_PANEL, INTERVALS.0),
        PANELS => (FIRST_PANEL * f64::from(1 << (PANELS - 1)), END, INTERVALS.1),
        _ => {
            let begin = FIRST_PANEL * f64::from(1 << (number - 1));
            (begin, 2.0 * begin, INTERVALS.0)
        }
    };
    (0..=PANELS).flat_map(move |number| {
        let (begin, end, intervals) = panel(number);
        let step = (end - begin) / f64::from(intervals);
        (0..=intervals).map(move |i| {
            let weight = match i {
                0 => 1.0,
                _ if i == intervals => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            (begin + step * f64::from(i), weight * step / 3.0)
        })
    })
}

/// z Z of conductors, ohm m.
fn impedance(z: f64, radius_mm: f64, conductors: &[Conductor]) -> f64 {
    let through = |below: f64, layer: &Conductor| {
        let (own, tangent) = (
            layer.resistivity_ohm_m,
            (z * layer.thickness_mm / radius_mm).tanh(),
        );
        own * (below + own * tangent) / (own + below * tangent)
    };
    let Some((base, layers)) = conductors.split_last() else {
        return 0.0;
    };
    layers.iter().rev().fold(base.resistivity_ohm_m, through)
}

/// F_m at z.
fn transforms(z: f64) -> SVector<f64, FUNCTIONS> {
    if z < SERIES_TO {
        SVector::from_fn(|m, _| series(m, z))
    } else {
        recurrence(z)
    }
}

/// F_m = sum over k of (-z^2/2)^k (2 m - 1)!!/(k! (2 m + 2 k + 1)!!).
fn series(order: usize, z: f64) -> f64 {
    let order = crate::number::real(order);
    let mut term = 1.0 / (2.0 * order + 1.0);
    let (mut sum, mut k) = (term, 1.0);
    while term.abs() > 1e-18 {
        term *= -0.5 * z * z / (k * (2.0 * order + 2.0 * k + 1.0));
        sum += term;
        k += 1.0;
    }
    sum
}

/// F_m by j_(m+1) = (2 m + 1)/z j_m - j_(m-1).
fn recurrence(z: f64) -> SVector<f64, FUNCTIONS> {
    let mut values = SVector::zeros();
    let (mut before, mut bessel) = (z.cos() / z, z.sin() / z);
    let (mut factor, mut odd) = (1.0, 1.0);
    for m in 0..FUNCTIONS {
        values[m] = factor * bessel;
        let next = odd / z * bessel - before;
        (before, bessel) = (bessel, next);
        // (2 m + 1)!!/z^(m + 1) of the next one.
        factor *= odd / z;
        odd += 2.0;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layered(ratio: f64, thickness: f64) -> f64 {
        let conductors = [(1.0, thickness), (ratio, f64::INFINITY)].map(|(rho, t)| Conductor {
            resistivity_ohm_m: rho,
            thickness_mm: t,
        });
        4e-3 * half_space(1.0, &conductors)
    }

    #[test]
    fn layers_of_ten_times_and_a_tenth_of_the_resistivity_are_those_of_the_reference() {
        for (ratio, thickness, expected) in [
            (10.0, 1.0, 2.009_30),
            (10.0, 0.1, 5.440_99),
            (0.1, 1.0, 0.676_20),
            (0.1, 0.1, 0.216_56),
        ] {
            let found = layered(ratio, thickness);
            assert!((found - expected).abs() < 1e-5, "{found} {expected}");
        }
    }

    #[test]
    fn like_thick_and_thin_layers_have_the_resistance_of_one_material() {
        for (ratio, thickness, expected) in [
            (1.0, 0.3, 1.0),
            (7.0, 300.0, 1.0),
            (7.0, 1e-5, 7.0),
            (0.2, 1e-5, 0.2),
        ] {
            let found = layered(ratio, thickness) / expected;
            assert!((found - 1.0).abs() < 5e-3, "{ratio} {thickness}: {found}");
        }
    }

    #[test]
    fn transforms_are_the_same_by_series_and_recurrence() {
        let by_recurrence = recurrence(SERIES_TO);
        for m in 0..FUNCTIONS {
            let apart = series(m, SERIES_TO) - by_recurrence[m];
            assert!(apart.abs() < 1e-10, "{m}: {apart}");
        }
        assert!((transforms(0.0)[3] - 1.0 / 7.0).abs() < 1e-15);
    }
}
