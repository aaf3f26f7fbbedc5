//! Wear by repetitions of the load (thesis, equations 18 and 19, after Thompson 2006): a wear strain
//!   e = C1 p^C2 N^C3,  h = t0 e.
//!
//! p: pressure, MPa (the source's S, the stress); N: repetitions of the load, - (its R); C1 .. C3: constants of the user; t0: length over
//! which the strain is worn, mm; h: worn depth, mm. The source's strain is its (18), a volume, over the volume of an element, so that the
//! depth depended on the mesh. Here t0 is a length that the user gives, and no mesh. The law has no slip: points that stick wear too.
//!
//! N is counted at each place by the pressure there: h^(1/C3) adds (`power`), d(h^(1/C3)) = (t0 C1 p^C2)^(1/C3) dN, which is the source's
//! formula where the pressure does not change. A place that is loaded all the time counts one repetition for each cycle of the motion,
//! one that the contact passes the part of the cycle's displacement in which it is loaded. Range: C2 >= 1 and C2 >= C3; reciprocating
//! motion. Limiting case: C3 = 1 wears the same in every repetition.

use super::power::{Measure, PowerLaw};

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadRepetition {
    /// C1, 1/MPa^C2.
    pub factor: f64,
    /// C2, -.
    pub pressure_exponent: f64,
    /// C3, -.
    pub repetition_exponent: f64,
    /// t0, mm.
    pub length_mm: f64,
}

impl LoadRepetition {
    /// The law in the form in which it adds.
    pub fn power_law(&self) -> PowerLaw {
        let exponent = self.repetition_exponent;
        PowerLaw {
            exponent,
            factor: (self.length_mm * self.factor).powf(exponent.recip()),
            pressure_exponent: self.pressure_exponent / exponent,
            measure: Measure::Repetitions,
            thermal: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::pace::Pace;

    /// t0 = 1e-3 mm, C1 = 1e-13, C2 = 1.5, C3 = 0.8 under 150 MPa, from 1 000 to 1 010 repetitions: 3.688027e-13 mm.
    #[test]
    fn ten_repetitions_more() {
        let law = LoadRepetition {
            factor: 1e-13,
            pressure_exponent: 1.5,
            repetition_exponent: 0.8,
            length_mm: 1e-3,
        };
        let law = law.power_law();
        let pace = Pace {
            cycles_per_mm: 10.0,
            ..Pace::default()
        };
        let increase = |distance| law.exposure(pace, distance).increase(150.0, 0.0)[0];
        let depth = law.recession(0.0, increase(100.0)).0;
        let worn = law.recession(depth, increase(1.0)).0;
        assert!((worn / 3.688_027e-13 - 1.0).abs() < 1e-6, "{worn}");
    }
}
