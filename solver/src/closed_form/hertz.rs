//! Hertz' contact of two bodies with unlike curvatures along and across (K. L. Johnson, *Contact Mechanics*, 1985, eqs. 4.26 to 4.32).
//!
//! With the radii R' >= R'' of relative curvature and the half-lengths a >= b of the ellipse, e^2 = 1 - (b/a)^2 and the complete elliptic
//! integrals K(e) and E(e),
//!   R'/R'' = ((a/b)^2 E - K)/(K - E),
//!   sqrt(ab) = (3 F R_e/(4 E*))^(1/3) F_1,  F_1^3 = 4/(pi e^2) (b/a)^(3/2) sqrt(((a/b)^2 E - K)(K - E)),  R_e = sqrt(R' R'').
//! The integrals are found by the arithmetic-geometric mean. Limiting case: a sphere, a^3 = 3 F R/(4 E*).

use std::f64::consts::{FRAC_PI_2, PI};

/// Halvings of the interval that holds the logarithm of b/a, and steps of the mean, which doubles its digits in each.
const HALVINGS: usize = 60;
const STEPS: usize = 12;
/// Smallest b/a: R'/R'' is then about 1e14.
const SLENDEREST: f64 = 1e-8;
/// Ratio of the radii above 1 below which the contact is taken as a circle: far below any tolerance, above round-off.
const CIRCLE: f64 = 1e-6;

/// Half-lengths along and across, mm, of the contact of bodies with these radii of relative curvature in mm, a contact modulus in MPa, under
/// a force in N.
pub(super) fn half_lengths((along, across): (f64, f64), modulus: f64, force: f64) -> (f64, f64) {
    let (long, short) = (along.max(across), along.min(across));
    let circle = (0.75 * force * (long * short).sqrt() / modulus).cbrt();
    let ratio = long / short;
    if !(ratio > 1.0 + CIRCLE && ratio.is_finite()) {
        return (circle, circle);
    }
    let (mut low, mut high) = (SLENDEREST.ln(), 0.0);
    for _ in 0..HALVINGS {
        let middle: f64 = 0.5 * (low + high);
        let (above, below) = terms(middle.exp());
        if above > ratio * below {
            low = middle;
        } else {
            high = middle;
        }
    }
    let aspect = (0.5_f64 * (low + high)).exp();
    let (above, below) = terms(aspect);
    let factor = 4.0 / (PI * (1.0 - aspect * aspect)) * aspect.powf(1.5) * (above * below).sqrt();
    let mean = circle * factor.cbrt();
    let (major, minor) = (mean / aspect.sqrt(), mean * aspect.sqrt());
    if along > across {
        (major, minor)
    } else {
        (minor, major)
    }
}

/// (a/b)^2 E - K and K - E for b/a.
fn terms(aspect: f64) -> (f64, f64) {
    let (mut a, mut b) = (1.0, aspect);
    let (mut sum, mut weight) = (0.5 * (1.0 - aspect * aspect), 0.5);
    for _ in 0..STEPS {
        let difference = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        weight *= 2.0;
        sum += weight * difference * difference;
    }
    let first = FRAC_PI_2 / a;
    let second = first * (1.0 - sum);
    (second / (aspect * aspect) - first, first * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipse_has_the_half_lengths_of_the_reference() {
        // R 1 and 36.5 mm, E 117e3 and nu 0.34 on the same, 5 N: kappa 9.994, p0 644.07.
        let modulus = 117e3 / (2.0 * (1.0 - 0.34 * 0.34));
        let (a, b) = half_lengths((1.0, 36.5), modulus, 5.0);
        assert!((b / a / 9.994 - 1.0).abs() < 1e-4, "{}", b / a);
        let peak = 7.5 / (PI * a * b);
        assert!((peak / 644.07 - 1.0).abs() < 1e-5, "{peak}");
        let turned = half_lengths((36.5, 1.0), modulus, 5.0);
        assert!((turned.0 / b - 1.0).abs() < 1e-14 && (turned.1 / a - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_sphere_is_a_limiting_case() {
        let sphere = half_lengths((10.0, 10.0), 109_890.1, 100.0);
        assert!((sphere.0 / 0.189_686 - 1.0).abs() < 1e-5, "{sphere:?}");
        let nearly = half_lengths((10.0, 10.0001), 109_890.1, 100.0);
        assert!(
            (nearly.1 / sphere.1 - 1.0).abs() < 1e-4 && nearly.1 > nearly.0,
            "{nearly:?}"
        );
    }
}
