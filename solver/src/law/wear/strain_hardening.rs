//! Wear as creep that hardens by strain (thesis, equation 20, after Thompson 2006):
//!   de/dt = C1 p^C2 e^C3 exp(-C4/T),  h = t0 e.
//!
//! e: wear strain, -; p: pressure, MPa (the source's "stress"); t: time, s; T: absolute temperature, K; C1 .. C4: constants of the user;
//! t0: length over which the strain is worn, mm; h: worn depth, mm. The source's strain belongs to an element, whose height t0 was: the
//! wear depended on the mesh. Here t0 is a length that the user gives, and no mesh. The law has no slip: points that stick wear too.
//!
//! e^(1 - C3) adds (`power`), with c = 1/(1 - C3), so that a step is exact where Euler's is not. Range: C3 < 1, since strain would grow
//! without bound in a finite time; C2 >= 1 and C2 >= 1 - C3. Limiting case: C3 = 0 is a rate that does not depend on the depth.

use super::power::{Measure, PowerLaw, Thermal};
use crate::law::temperature::Temperature;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainHardening {
    /// C1, 1/(MPa^C2 s).
    pub factor: f64,
    /// C2, -.
    pub pressure_exponent: f64,
    /// C3, -.
    pub strain_exponent: f64,
    /// C4, K.
    pub activation_k: f64,
    /// T.
    pub temperature: Temperature,
    /// t0, mm.
    pub length_mm: f64,
}

impl StrainHardening {
    /// The law in the form in which it adds.
    pub fn power_law(&self) -> PowerLaw {
        let rest = 1.0 - self.strain_exponent;
        let thermal = Thermal {
            activation_k: self.activation_k,
            temperature: self.temperature,
        };
        PowerLaw {
            exponent: rest.recip(),
            factor: rest * self.length_mm.powf(rest) * self.factor * thermal.factor(),
            pressure_exponent: self.pressure_exponent,
            measure: Measure::Time,
            thermal: Some(thermal),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::pace::Pace;

    /// C1 = 1e-9, C2 = 2, C3 = -0.5, C4 = 1 000 K, 300 K, 150 MPa, 10 s from e = 1e-4: e = 5.540102e-4, of which 4.546886e-6 for each
    /// MPa more, whatever the length; Euler's backward step ends at 4.7017e-4.
    #[test]
    fn strain_hardens_under_a_pressure() {
        for length_mm in [1.0, 0.02] {
            let law = StrainHardening {
                factor: 1e-9,
                pressure_exponent: 2.0,
                strain_exponent: -0.5,
                activation_k: 1_000.0,
                temperature: Temperature::OfContact(300.0),
                length_mm,
            };
            let law = law.power_law();
            // 1 mm at 0.1 mm/s; sticking.
            let exposure = law.exposure(Pace::at_speed(0.1), 1.0);
            let [increase, by_pressure, by_slip] = exposure.increase(150.0, 0.0);
            let (worn, end) = law.recession(1e-4 * length_mm, increase);
            let strain = 1e-4 + worn / length_mm;
            assert!((strain / 5.540_102e-4 - 1.0).abs() < 1e-6, "{strain}");
            let slope = end * by_pressure / length_mm;
            assert!((slope / 4.546_886e-6 - 1.0).abs() < 1e-6, "{slope}");
            assert!(by_slip <= 0.0);
        }
    }
}
