//! Spots of real contact: their radius under a load, and the resistance that they add to each other.
//!
//! A spot that yields carries its load by the hardness of the softer surface, F = pi a^2 H (Holm, *Electric Contacts*, 1967). The tip of a
//! ball that stays elastic has Hertz' radius, a = (3 F R/(4 E*))^(1/3) (Johnson 1985, eq. 4.22). A spot is elastic as long as its mean
//! pressure stays below the hardness, so that of both radii the larger one holds, that of the lower pressure.
//!
//! n spots in parallel, each with the same current, have (Greenwood, *Br. J. Appl. Phys.* 17, 1966, eq. 2)
//!   R = rho/(2 n a) + rho/(pi n^2) sum over pairs i /= j of 1/s_ij,
//! s_ij their distances. Spots that fill a circle evenly, radius alpha: sum/n^2 tends to 16/(3 pi alpha), that of a disc with an even
//! flux. Range: spots that are small beside their distances. Limiting case: one spot, rho/(2 a).

use std::f64::consts::PI;

/// How a spot carries its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Deformation {
    /// By the hardness of the softer surface.
    Plastic,
    /// As the tip of a ball, by Hertz.
    Elastic(Asperity),
    /// By the one of both that has the lower pressure.
    LowerPressure(Asperity),
}

/// The tip of a ball on a flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asperity {
    /// Radius R, mm.
    pub radius_mm: f64,
    /// Contact modulus E*, MPa.
    pub modulus_mpa: f64,
}

impl Deformation {
    /// Radius, mm, of a spot that carries a force in N beside a hardness in MPa.
    pub fn radius_mm(self, force_n: f64, hardness_mpa: f64) -> f64 {
        match self {
            Self::Plastic => yielding(force_n, hardness_mpa),
            Self::Elastic(asperity) => hertz(force_n, asperity),
            Self::LowerPressure(asperity) => {
                yielding(force_n, hardness_mpa).max(hertz(force_n, asperity))
            }
        }
    }
}

fn yielding(force_n: f64, hardness_mpa: f64) -> f64 {
    (force_n / (PI * hardness_mpa)).sqrt()
}

fn hertz(force_n: f64, asperity: Asperity) -> f64 {
    (0.75 * force_n * asperity.radius_mm / asperity.modulus_mpa).cbrt()
}

/// The sum over pairs of 1/s_ij, each pair in both orders, over n^2, for spots at these places: 1/mm for mm.
pub(crate) fn pair_sum(places: &[[f64; 2]]) -> f64 {
    let count = crate::number::real(places.len());
    let of = |i: usize| {
        let others = places.iter().enumerate().filter(move |(j, _)| *j != i);
        others
            .map(|(_, [x, y])| 1.0 / (x - places[i][0]).hypot(y - places[i][1]))
            .sum::<f64>()
    };
    (0..places.len()).map(of).sum::<f64>() / (count * count).max(1.0)
}

/// Places of spots that fill a circle of a radius evenly: Fermat's spiral with the golden angle (Vogel 1979).
pub(crate) fn in_circle(count: usize, radius: f64) -> Vec<[f64; 2]> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let place = |i: usize| {
        let i = crate::number::real(i);
        let from_centre = radius * ((i + 0.5) / crate::number::real(count)).sqrt();
        let (sine, cosine) = (golden * i).sin_cos();
        [from_centre * cosine, from_centre * sine]
    };
    (0..count).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BALL: Asperity = Asperity {
        radius_mm: 0.4,
        modulus_mpa: 68_939.0,
    };

    #[test]
    fn spots_have_the_radii_of_the_references() {
        let radius = |deformation: Deformation| 1e3 * deformation.radius_mm(0.5, 1_700.0);
        let plastic = radius(Deformation::Plastic);
        assert!((plastic - 9.675_77).abs() < 1e-5, "{plastic}");
        let elastic = radius(Deformation::Elastic(BALL));
        assert!((elastic - 12.958_12).abs() < 1e-5, "{elastic}");
        // The ball is so large that its mean pressure, 948 MPa, stays below the hardness.
        let lower = radius(Deformation::LowerPressure(BALL));
        assert!(lower.to_bits() == elastic.to_bits());
        // A surface of 100 MPa yields under it.
        let soft = Deformation::LowerPressure(BALL).radius_mm(0.5, 100.0);
        assert!((soft - (0.5 / (PI * 100.0)).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn four_spots_in_a_square_have_the_resistance_of_the_reference() {
        // Gold, spots of 1 um at the corners of a square of 20 um.
        let (rho, a) = (2.21e-8, 1e-6);
        let square = [[0.0, 0.0], [20e-6, 0.0], [0.0, 20e-6], [20e-6, 20e-6]];
        let resistance = 1e3 * rho * (1.0 / (2.0 * 4.0 * a) + pair_sum(&square) / PI);
        assert!((resistance - 3.000_54).abs() < 1e-5, "{resistance}");
    }

    #[test]
    fn many_even_spots_have_the_sum_of_a_disc_with_an_even_flux() {
        assert!(pair_sum(&in_circle(1, 1.0)) <= 0.0);
        let limit = 16.0 / (3.0 * PI);
        // The self part that a disc has and spots lack falls as 1/sqrt n.
        let short: Vec<f64> = [100, 400, 1_600]
            .map(|count| 1.0 - pair_sum(&in_circle(count, 1.0)) / limit)
            .to_vec();
        assert!(short[2] > 0.0 && short[2] < 0.04, "{short:?}");
        for pair in short.windows(2) {
            let order = pair[0] / pair[1];
            assert!((order - 2.0).abs() < 0.1, "{short:?}");
        }
        let scaled = pair_sum(&in_circle(100, 0.5)) / pair_sum(&in_circle(100, 1.0));
        assert!((scaled - 2.0).abs() < 1e-12);
    }
}
