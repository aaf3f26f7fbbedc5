//! Temperature of a compact spot at rest,
//!   dT = Q/(4 a (K1 + K2)).
//!
//! Q: heat, W; a: radius of the spot, m; K1, K2: conductivities of both bodies, W/(m K), which share the heat in proportion. A disc of one
//! temperature (Carslaw and Jaeger, *Conduction of Heat in Solids*, 1959). Range: spots that move slowly against the diffusion of heat,
//! v a < the diffusivity; an upper limit of faster ones.

/// Temperature rise, K, for a heat in mW, a radius in mm and the sum of both conductivities in W/(m K).
pub fn rise_k(heat_mw: f64, radius_mm: f64, conductivity_w_mk: f64) -> f64 {
    // mW/mm = W/m.
    heat_mw / (4.0 * radius_mm * conductivity_w_mk)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_on_one_spot_of_plastic_gold_stays_cold() {
        // 0.5 N on hard gold of 1 700 MPa, mu 0.3, 10 mm/s, gold on gold.
        let radius = (0.5 / (std::f64::consts::PI * 1_700.0)).sqrt();
        assert!((1e3 * radius - 9.675_77).abs() < 1e-4, "{radius}");
        let rise = rise_k(0.3 * 0.5 * 10.0, radius, 2.0 * 220.0);
        assert!((rise - 0.088_1).abs() < 1e-4, "{rise}");
    }
}
