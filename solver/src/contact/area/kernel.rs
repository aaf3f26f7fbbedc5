//! Normal displacement of a half-space by uniform pressure on a rectangle.
//!
//! By Boussinesq's solution, a pressure p moves the surfaces of two bodies at (x, z) toward each other by
//!   u = p/(pi E*) int int dA/r,
//! and over a rectangle of half-lengths a, b about the origin (Love 1929; Johnson, Contact Mechanics, 1985, eq. 3.25)
//!   int int dA/r = f(x + a, z + b) - f(x - a, z + b) - f(x + a, z - b) + f(x - a, z - b),
//!   f(s, t) = s asinh(t/|s|) + t asinh(s/|t|),
//! with u in mm, p in MPa, the contact modulus E* in MPa. f(s, 0) = f(0, t) = 0.
//!
//! Round-off: f grows with the distance r, its differences fall with it, so that the relative error is about 1e-16 (r/a)^2:
//! below 1e-10 for a thousand cells. Limiting case: far away the rectangle is a point force, u = p 4 a b/(pi E* r).

use std::f64::consts::PI;

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

/// Normal displacement in mm at the offset x, z in mm from the centre of a cell of the length dx and the width dz in mm by a
/// pressure of 1 MPa on it, for a contact modulus in MPa.
pub fn normal_influence((x, z): (f64, f64), (dx, dz): (f64, f64), modulus: f64) -> f64 {
    let (a, b) = (0.5 * dx, 0.5 * dz);
    let f = antiderivative;
    (f(x + a, z + b) - f(x - a, z + b) - f(x + a, z - b) + f(x - a, z - b)) / (PI * modulus)
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
}
