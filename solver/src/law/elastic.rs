//! Isotropic linear elasticity in plane strain.
//!
//! sigma = lambda tr(eps) I + 2 mu eps with eps_zz = 0;
//! lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)), both in MPa.
//! Valid for 0 <= nu < 0.5; as nu -> 0.5 lambda grows without bound and the volume is kept.

/// Isotropic linear elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Young's modulus E, MPa.
    pub youngs_modulus_mpa: f64,
    /// Poisson's ratio nu, -.
    pub poisson_ratio: f64,
}

/// Lame's constants, MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lame {
    /// First constant, lambda.
    pub lambda: f64,
    /// Shear modulus, mu.
    pub mu: f64,
}

impl From<Elastic> for Lame {
    fn from(elastic: Elastic) -> Self {
        let (e, nu) = (elastic.youngs_modulus_mpa, elastic.poisson_ratio);
        Self {
            lambda: e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            mu: e / (2.0 * (1.0 + nu)),
        }
    }
}

/// Compliance of a body in plane strain, 1/MPa: (1 - nu^2)/E.
pub(crate) fn plane_strain_compliance(m: Elastic) -> f64 {
    (1.0 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus_mpa
}

/// Contact modulus of two bodies, MPa: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 (Johnson, Contact Mechanics, 1985, eq.
/// 4.20).
pub fn contact_modulus(a: Elastic, b: Elastic) -> f64 {
    1.0 / (plane_strain_compliance(a) + plane_strain_compliance(b))
}

/// Dundurs' second parameter of two bodies in plane strain, -: how far pressure displaces their surfaces along x relative to
/// each other,
///   beta = [(1 - 2 nu_a)/G_a - (1 - 2 nu_b)/G_b] / (2 [(1 - nu_a)/G_a + (1 - nu_b)/G_b])
/// (Johnson 1985, eq. 5.3); 0 for equal bodies. A body that is held along x does not spread: its term above is 0.
pub(crate) fn dundurs_beta(a: Elastic, b: Elastic, held: [bool; 2]) -> f64 {
    let terms = |body: Elastic, held: bool| {
        let (shear, nu) = (Lame::from(body).mu, body.poisson_ratio);
        let spread = if held { 0.0 } else { (1.0 - 2.0 * nu) / shear };
        (spread, (1.0 - nu) / shear)
    };
    let ((spread_a, sinks_a), (spread_b, sinks_b)) = (terms(a, held[0]), terms(b, held[1]));
    (spread_a - spread_b) / (2.0 * (sinks_a + sinks_b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lame_constants_give_back_young_and_poisson() {
        let lame = Lame::from(Elastic {
            youngs_modulus_mpa: 200e3,
            poisson_ratio: 0.3,
        });
        let e = lame.mu * (3.0 * lame.lambda + 2.0 * lame.mu) / (lame.lambda + lame.mu);
        let nu = lame.lambda / (2.0 * (lame.lambda + lame.mu));
        assert!((e - 200e3).abs() < 1e-9 * 200e3 && (nu - 0.3).abs() < 1e-14);
    }

    #[test]
    fn contact_modulus_of_equal_bodies_is_half_the_plane_strain_modulus() {
        let steel = Elastic {
            youngs_modulus_mpa: 200e3,
            poisson_ratio: 0.3,
        };
        let expected = 0.5 * 200e3 / (1.0 - 0.09);
        assert!((contact_modulus(steel, steel) - expected).abs() < 1e-9 * expected);
    }

    #[test]
    fn unlike_bodies_have_opposite_parameters_when_swapped() {
        let steel = Elastic {
            youngs_modulus_mpa: 200e3,
            poisson_ratio: 0.3,
        };
        let rubber = Elastic {
            youngs_modulus_mpa: 5.0,
            poisson_ratio: 0.2,
        };
        let free = [false; 2];
        assert!(dundurs_beta(steel, steel, free).abs() < 1e-15);
        let beta = dundurs_beta(rubber, steel, free);
        assert!((beta + dundurs_beta(steel, rubber, free)).abs() < 1e-15);
        // Against a rigid body: (1 - 2 nu)/(2 (1 - nu)).
        assert!((beta - 0.6 / 1.6).abs() < 1e-4, "{beta}");
        // Steel on steel that is held: half of that of steel on a rigid body.
        let held = dundurs_beta(steel, steel, [true, false]);
        assert!((held + 0.5 * 0.4 / 1.4).abs() < 1e-15, "{held}");
    }
}
