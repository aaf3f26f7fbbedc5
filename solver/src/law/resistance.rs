//! Resistance of an electrical contact: the current converges to spots of real contact (`spots`), crosses the films that cover them (`film`)
//! and spreads into both bodies, half-spaces of layers over a base (`layered`). Limiting case: one clean spot between two like bodies,
//! R = rho/(2 a).

mod disc_flux;
pub mod film;
pub(crate) mod layered;
pub mod spots;

pub use film::{Film, Growth};
pub use layered::Conductor;
pub(crate) use layered::half_space;
pub use spots::{Asperity, Deformation};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spot_of_hard_gold_is_that_of_the_reference() {
        let radius = Deformation::Plastic.radius_mm(0.5, 1_700.0);
        // Two bodies of gold, 2.21e-8 ohm m: 1.142 03 mOhm.
        let gold = half_space(
            radius,
            &[Conductor {
                resistivity_ohm_m: 2.21e-8,
                thickness_mm: f64::INFINITY,
            }],
        );
        assert!((2.0e3 * gold - 1.142_03).abs() < 1e-5, "{gold}");
    }
}
