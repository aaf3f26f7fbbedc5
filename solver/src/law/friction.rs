//! Coulomb's law: |q| <= mu p, and q = mu p in the direction of slip where there is slip.

/// Friction laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction {
    /// No shear traction.
    Frictionless,
    /// |q| <= mu p.
    Coulomb {
        /// Coefficient of friction mu, -.
        coefficient: f64,
    },
}

/// Coefficient of friction mu, -.
pub fn coefficient(friction: Friction) -> f64 {
    match friction {
        Friction::Frictionless => 0.0,
        Friction::Coulomb { coefficient } => coefficient,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frictionless_is_coulomb_without_a_coefficient() {
        assert!(coefficient(Friction::Frictionless).abs() < f64::MIN_POSITIVE);
        assert!((coefficient(Friction::Coulomb { coefficient: 0.9 }) - 0.9).abs() < f64::EPSILON);
    }
}
