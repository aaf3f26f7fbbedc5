//! Temperature of a compact spot at rest,
//!   dT = Q/(4 a (K1 + K2)).
//!
//! Q: heat, W; a: radius of the spot, m; K1, K2: conductivities of both bodies, W/(m K), which share the heat in proportion. A disc of one
//! temperature (Carslaw and Jaeger, *Conduction of Heat in Solids*, 1959). Range: spots that move slowly against the diffusion of heat,
//! v a < the diffusivity; an upper limit of faster ones.

/// Temperature rise, K, for a heat in mW, a radius in mm and the sum of both conductivities in W/(m K).
pub(crate) fn rise_k(heat_mw: f64, radius_mm: f64, conductivity_w_mk: f64) -> f64 {
    // mW/mm = W/m.
    heat_mw / (4.0 * radius_mm * conductivity_w_mk)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Discs composed of those of one temperature, K a T/Q: the middle of a uniform source, 1/pi, its mean, 0.270190, and the middle of one in
    /// proportion to Hertz' pressure, 3/8. A disc of one temperature, 1/4, is the coldest.
    #[test]
    fn a_disc_of_one_temperature_is_colder_than_uniform_and_hertz_sources() {
        const PARTS: usize = 2_000;
        let parts = || (0..PARTS).map(|i| (f64::from(u32::try_from(i).unwrap_or(0)) + 0.5) / 2e3);
        let sum = |of: &dyn Fn(f64) -> f64| parts().map(of).sum::<f64>() / 2e3;
        // At a place r of a disc of the radius t and the heat 1.
        let at = |r: f64, t: f64| {
            let outside = if r > t {
                (t / r).asin() / std::f64::consts::FRAC_PI_2
            } else {
                1.0
            };
            outside * rise_k(1.0, t, 1.0)
        };
        // A uniform source has the heats (4/pi) sin(u)^2 du on discs of the radius sin(u), Hertz' 3 t^2 dt.
        let uniform = |r: f64| {
            sum(&|part| {
                let sine = (std::f64::consts::FRAC_PI_2 * part).sin();
                2.0 * sine * sine * at(r, sine)
            })
        };
        let mean = sum(&|r| 2.0 * r * uniform(r));
        let hertz = sum(&|t| 3.0 * t * t * at(0.0, t));
        for (found, exact) in [
            (uniform(0.0), std::f64::consts::FRAC_1_PI),
            (mean, 0.270_190),
            (hertz, 0.375),
        ] {
            assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
            assert!(found > rise_k(1.0, 1.0, 1.0));
        }
    }

    #[test]
    fn a_contact_on_one_spot_of_plastic_gold_stays_cold() {
        // 0.5 N on hard gold of 1 700 MPa, mu 0.3, 10 mm/s, gold on gold.
        let radius = (0.5 / (std::f64::consts::PI * 1_700.0)).sqrt();
        assert!((1e3 * radius - 9.675_77).abs() < 1e-4, "{radius}");
        let rise = rise_k(0.3 * 0.5 * 10.0, radius, 2.0 * 220.0);
        assert!((rise - 0.088_1).abs() < 1e-4, "{rise}");
    }
}
