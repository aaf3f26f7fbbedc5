//! Temperature of a line contact by frictional heat,
//!   dT = mu P' v (ln(d/a) + 1)/(pi (K1 + K2)),
//! mu coefficient of friction, P' load per depth, v speed, a half-width of the contact, d distance to where the bodies keep
//! their temperature, K conductivities of the bodies, which share the heat in proportion.
//!
//! Largest temperature of a uniform source at rest (Jaeger 1942; Carslaw and Jaeger, *Conduction of Heat in Solids*, 1959). An upper
//! limit of a source that moves. Limiting case: none without speed.

use std::f64::consts::PI;

/// Temperature rise, K, for mu P' in N/mm, a speed in mm/s, d and a in mm and the sum of both conductivities in W/(m K).
pub fn line_source(
    friction_n_per_mm: f64,
    speed_mm_s: f64,
    (d, a): (f64, f64),
    conductivity: f64,
) -> f64 {
    // N/mm mm/s = W/m.
    friction_n_per_mm * speed_mm_s * ((d / a).ln().max(0.0) + 1.0) / (PI * conductivity)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_temperature_at_rest_is_that_of_a_uniform_line_source() {
        // Q'/(pi K) (ln(d/b) + 1) of one body: 1 W/m, 2 W/(m K), d = e b.
        let rise = line_source(1.0, 1.0, (std::f64::consts::E, 1.0), 2.0);
        assert!((rise - 1.0 / PI).abs() < 1e-15);
        assert!(line_source(1.0, 0.0, (2.0, 1.0), 2.0) <= 0.0);
    }
}
