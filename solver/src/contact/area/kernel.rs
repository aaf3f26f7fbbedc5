//! Displacement of half-spaces by uniform pressure or shear on a rectangle.
//!
//! By Boussinesq's solution, a pressure p moves the surfaces of two bodies at (x, z) toward each other by
//!   u = p/(pi E*) int int dA/r,
//! and over a rectangle of half-lengths a, b about the origin (Love 1929; Johnson, Contact Mechanics, 1985, eq. 3.25)
//!   int int dA/r = f(x + a, z + b) - f(x - a, z + b) - f(x + a, z - b) + f(x - a, z - b),
//!   f(s, t) = s asinh(t/|s|) + t asinh(s/|t|),
//! with u in mm, p in MPa, the contact modulus E* in MPa. f(s, 0) = f(0, t) = 0.
//!
//! By Cerruti's solution (Johnson 1985, section 3.6), a shear q_x moves the surface of one body by
//!   u_x = q_x/(2 pi G) int int ((1 - nu)/r + nu x^2/r^3) dA,  u_z = q_x/(2 pi G) int int nu x z/r^3 dA,
//! with the shear modulus G in MPa and Poisson's ratio nu; likewise for q_z. The antiderivatives of x^2/r^3, z^2/r^3 and x z/r^3 are
//! t asinh(s/|t|), s asinh(t/|s|) and -sqrt(s^2 + t^2). Its normal displacement is opposite on both bodies: like ones are not moved
//! apart.
//!
//! Round-off: f grows with the distance r, its differences fall with it, so that the relative error is about 1e-16 (r/a)^2:
//! below 1e-10 for a thousand cells. Limiting case: far away the rectangle is a point force, u = p 4 a b/(pi E* r).

use std::f64::consts::PI;

use crate::law::elastic::{Elastic, Lame};

/// s asinh(t/|s|), 0 for s = 0.
fn term(s: f64, t: f64) -> f64 {
    // Also what it tends to.
    if s == 0.0 {
        0.0
    } else {
        s * (t / s.abs()).asinh()
    }
}

/// The double antiderivative f of 1/r.
fn antiderivative(s: f64, t: f64) -> f64 {
    term(s, t) + term(t, s)
}

/// The difference of an antiderivative between the corners of a cell about an offset.
fn between_corners((x, z): (f64, f64), (dx, dz): (f64, f64), f: impl Fn(f64, f64) -> f64) -> f64 {
    let (a, b) = (0.5 * dx, 0.5 * dz);
    f(x + a, z + b) - f(x - a, z + b) - f(x + a, z - b) + f(x - a, z - b)
}

/// Normal displacement in mm at the offset x, z in mm from the centre of a cell of the length dx and the width dz in mm by a
/// pressure of 1 MPa on it, for a contact modulus in MPa.
pub(crate) fn normal_influence(offset: (f64, f64), size: (f64, f64), modulus: f64) -> f64 {
    between_corners(offset, size, antiderivative) / (PI * modulus)
}

/// Compliance of both surfaces to shear: the sums over both bodies of (1 - nu)/G and nu/G, 1/MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ShearCompliance {
    even: f64,
    along: f64,
}

impl ShearCompliance {
    /// Compliance of two bodies.
    pub(crate) fn new(bodies: [Elastic; 2]) -> Self {
        let sum = |part: fn(f64) -> f64| {
            let terms = bodies.map(|body| part(body.poisson_ratio) / Lame::from(body).mu);
            terms[0] + terms[1]
        };
        Self {
            even: sum(|nu| 1.0 - nu),
            along: sum(|nu| nu),
        }
    }

    /// Displacement in mm along the shear at an offset in mm from a cell of a size in mm along and across the shear, by a shear of 1 MPa.
    pub(crate) fn along(self, offset: (f64, f64), size: (f64, f64)) -> f64 {
        let isotropic = between_corners(offset, size, antiderivative);
        let along = between_corners(offset, size, |s, t| term(t, s));
        (self.even * isotropic + self.along * along) / (2.0 * PI)
    }

    /// Displacement across the shear, which is odd along both axes.
    pub(crate) fn across(self, offset: (f64, f64), size: (f64, f64)) -> f64 {
        self.along * between_corners(offset, size, |s, t| -s.hypot(t)) / (2.0 * PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centre_of_a_square_sinks_as_love_states() {
        // u = 4 p a asinh(1) 2/(pi E*) at the centre, half of that at a corner (Johnson 1985, eq. 3.26).
        let modulus = 1.1e5;
        let centre = 8.0 * 0.5 * 1.0_f64.asinh() / (PI * modulus);
        let at = |x, z| normal_influence((x, z), (1.0, 1.0), modulus);
        assert!((at(0.0, 0.0) / centre - 1.0).abs() < 1e-14);
        assert!((at(0.5, 0.5) / centre - 0.5).abs() < 1e-14);
    }

    #[test]
    fn a_distant_cell_is_a_point_force() {
        let (x, z, dx, dz): (f64, f64, f64, f64) = (30.0, -40.0, 1.0, 0.5);
        let force = dx * dz / (PI * 2.0 * x.hypot(z));
        let found = normal_influence((x, z), (dx, dz), 2.0);
        assert!((found / force - 1.0).abs() < 1e-4, "{found} {force}");
    }

    #[test]
    fn cells_add_up_to_the_cell_that_they_divide() {
        let whole = normal_influence((0.7, 0.3), (2.0, 1.0), 1.0);
        let half = |x| normal_influence((0.7 - x, 0.3), (1.0, 1.0), 1.0);
        assert!((half(0.5) + half(-0.5) - whole).abs() < 1e-14);
    }

    #[test]
    fn the_influence_is_symmetric() {
        let at = |x, z| normal_influence((x, z), (0.8, 1.7), 3.0);
        for (x, z) in [(0.8, 1.7), (2.4, 0.0), (0.0, 5.1)] {
            assert!((at(x, z) - at(-x, z)).abs() < 1e-14);
            assert!((at(x, z) - at(x, -z)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_distant_cell_in_shear_is_a_point_force() {
        let steel = Elastic {
            youngs_modulus_mpa: 200e3,
            poisson_ratio: 0.3,
        };
        let shear = ShearCompliance::new([steel, steel]);
        let modulus = 200e3 / 2.6;
        let (x, z): (f64, f64) = (30.0, -40.0);
        // Cerruti's force q dA on both bodies.
        let force = 0.5 / (PI * modulus * 50.0);
        let along = force * (0.7 + 0.3 * x * x / 2500.0);
        let across = force * 0.3 * x * z / 2500.0;
        let size = (1.0, 0.5);
        assert!((shear.along((x, z), size) / along - 1.0).abs() < 1e-4);
        assert!((shear.across((x, z), size) / across - 1.0).abs() < 1e-3);
    }
}
