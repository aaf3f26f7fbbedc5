//! Resistance of an isothermal disc on a half-space of layers.
//!
//! In the Hankel transform of the radius, r/a, the potential at the surface is Z(z) times the flux, with Z = rho/z of the base and
//!   Z = s (Z' + s th)/(s + Z' th),  s = rho_i/z,  th = tanh(z t_i/a)
//! through a layer over what has Z'. The flux of the disc is a sum of f_m = (1 - r^2)^(m - 1/2), m = 0, 1, ..., whose transforms are
//! F_m (`disc_flux`). Galerkin's method with A_mn = integral of Z F_m F_n z dz gives
//!   R = 1/(2 pi a b^T A^-1 b),  b_m = F_m(0).
//! A is that of the outermost layer alone, which is integrated once for all, and the integral of what the layers below add to z Z: a
//! smooth function of z, which is interpolated at the nodes of `disc_flux`. Limiting case: one material, R = rho/(4 a) by f_0 alone.
//! Range: a disc that is small beside the body; layers far thinner than the disc have the resistance of the base.

use std::f64::consts::PI;

use nalgebra::SMatrix;

use super::disc_flux::{self, FUNCTIONS};

/// Layer, or base, of a conductor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductor {
    /// Resistivity, ohm m.
    pub resistivity_ohm_m: f64,
    /// Thickness, mm; of a base without bound.
    pub thickness_mm: f64,
}

/// Resistance, ohm, from a disc of a radius in mm to far away through conductors from the surface down, of which the last one is the
/// base.
pub(crate) fn half_space(radius_mm: f64, conductors: &[Conductor]) -> f64 {
    let integrals = disc_flux::integrals();
    let outer = conductors
        .first()
        .map_or(0.0, |outer| outer.resistivity_ohm_m);
    let mut matrix = SMatrix::<f64, FUNCTIONS, FUNCTIONS>::zeros();
    for node in &integrals.nodes {
        let beyond = impedance(node.z, radius_mm, conductors) - outer;
        for (entry, weight) in matrix.as_mut_slice().iter_mut().zip(&node.weights) {
            *entry += beyond * weight;
        }
    }
    matrix += outer * integrals.uniform;
    let flux = matrix
        .cholesky()
        .map(|factor| factor.solve(&integrals.at_zero));
    let current = flux.map_or(f64::NAN, |flux| flux.dot(&integrals.at_zero));
    // Resistivities in ohm m over lengths in mm.
    1e3 / (2.0 * PI * radius_mm * current)
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
        // A base below t = 300 a changes the resistance by a/t at most, a better conducting layer of t = 1e-5 a carries current past the edge
        // of the disc: (rho_2/rho_1) t/a ln(a/t) is 8e-4.
        for (ratio, thickness, expected, allowed) in [
            (1.0, 0.3, 1.0, 1e-12),
            (7.0, 300.0, 1.0, 5e-3),
            (7.0, 1e-5, 7.0, 8e-4),
            (0.2, 1e-5, 0.2, 8e-4),
        ] {
            let found = layered(ratio, thickness) / expected;
            assert!(
                (found - 1.0).abs() < allowed,
                "{ratio} {thickness}: {found}"
            );
        }
    }

    #[test]
    fn a_split_layer_has_the_resistance_of_the_whole_one() {
        let layer = |resistivity_ohm_m, thickness_mm| Conductor {
            resistivity_ohm_m,
            thickness_mm,
        };
        let base = layer(7e-8, f64::INFINITY);
        let whole = half_space(0.01, &[layer(3e-8, 1e-3), base]);
        let split = half_space(0.01, &[layer(3e-8, 0.3e-3), layer(3e-8, 0.7e-3), base]);
        assert!((split / whole - 1.0).abs() < 1e-12, "{split} {whole}");
    }
}
