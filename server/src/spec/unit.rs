//! Units that a value was probably written in, where it is far from what such values are.

use std::ops::RangeInclusive;

/// A unit: its name, and its size in the unit of a field.
type Unit = (&'static str, f64);

/// Units of lengths, mm.
const LENGTHS: [Unit; 3] = [("um", 1e-3), ("m", 1e3), ("nm", 1e-6)];
/// Units of pressures, MPa.
const PRESSURES: [Unit; 3] = [("Pa", 1e-6), ("GPa", 1e3), ("kPa", 1e-3)];
/// Units of forces, N.
const FORCES: [Unit; 2] = [("mN", 1e-3), ("kN", 1e3)];
/// Units of forces per length, N/mm.
const LINE_FORCES: [Unit; 2] = [("N/m", 1e-3), ("kN/mm", 1e3)];
/// Units of a wear coefficient over a hardness, 1/MPa.
const PER_PRESSURES: [Unit; 2] = [("1/Pa", 1e6), ("1/GPa", 1e-3)];
/// Units of frequencies, Hz.
const FREQUENCIES: [Unit; 2] = [("kHz", 1e3), ("MHz", 1e6)];

/// A kind of values, with what they are in contact systems.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Typical {
    range: RangeInclusive<f64>,
    unit: &'static str,
    others: &'static [Unit],
}

/// How many times larger or smaller than its default a typical length is.
const AROUND: f64 = 100.0;

/// Lengths of which one is known, mm.
pub(crate) fn length_mm(default: f64) -> Typical {
    Typical {
        range: default / AROUND..=default * AROUND,
        unit: "mm",
        others: &LENGTHS,
    }
}

/// Amplitudes of vibration, mm: from 50 nm, below which hardly anything wears, to that many times the usual one.
pub(crate) fn amplitude_mm(default: f64) -> Typical {
    Typical {
        range: 5e-5..=default * AROUND,
        ..length_mm(default)
    }
}

/// Young's moduli, MPa: from soft polymers to diamond.
pub(crate) const YOUNGS_MODULUS_MPA: Typical = pressures(500.0, 1.3e6);
/// Indentation hardnesses, MPa: from lead to ceramics.
pub(crate) const HARDNESS_MPA: Typical = pressures(20.0, 5e4);
/// Pressures on the face of a part, MPa.
pub(crate) const PRESSURE_MPA: Typical = pressures(1e-2, 5e3);
/// Forces on a contact, N.
pub(crate) const FORCE_N: Typical = Typical {
    range: 1e-3..=2e3,
    unit: "N",
    others: &FORCES,
};
/// Forces on a line contact, N/mm.
pub(crate) const LINE_FORCE_N_PER_MM: Typical = Typical {
    range: 1e-3..=5e3,
    unit: "N/mm",
    others: &LINE_FORCES,
};
/// Archard's coefficients over hardnesses, 1/MPa: k of 1e-9 to 1 (mild to severe wear) over the hardnesses above.
pub(crate) const K_OVER_H_PER_MPA: Typical = Typical {
    range: 1e-13..=5e-2,
    unit: "1/MPa",
    others: &PER_PRESSURES,
};
/// Frequencies of vibration, Hz: from daily temperature changes to ultrasound.
pub(crate) const FREQUENCY_HZ: Typical = Typical {
    range: 1e-5..=1e5,
    unit: "Hz",
    others: &FREQUENCIES,
};

/// Layers of a plating, um: from a flash to a thick clad layer.
pub(crate) const LAYER_UM: Typical = Typical {
    range: 1e-2..=100.0,
    unit: "um",
    others: &[("mm", 1e3), ("nm", 1e-3), ("uin", 0.0254)],
};
/// Layers of a plating, mm.
pub(crate) const LAYER_MM: Typical = Typical {
    range: 1e-5..=0.1,
    unit: "mm",
    others: &LENGTHS,
};

const fn pressures(from: f64, to: f64) -> Typical {
    Typical {
        range: from..=to,
        unit: "MPa",
        others: &PRESSURES,
    }
}

impl Typical {
    /// Why a value was probably written in another unit; `None` if it is typical, or would not be in any.
    pub(crate) fn likely_unit(&self, value: f64) -> Option<String> {
        if value <= 0.0 || self.range.contains(&value) {
            return None;
        }
        let fits = |(_, size): &&Unit| self.range.contains(&(value * size));
        let (unit, size) = self.others.iter().find(fits)?;
        let own = self.unit;
        Some(format!(
            "{value} {own} is far from what such values are; was it meant in {unit}? Write {:.6} then",
            Short(value * size)
        ))
    }
}

/// A number with a precision of so many significant digits.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = formatter.precision().unwrap_or(6);
        let rounded: f64 = format!("{:.*e}", digits.saturating_sub(1), self.0)
            .parse()
            .unwrap_or(self.0);
        write!(formatter, "{rounded}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_another_unit_name_it_and_their_value() {
        let wire = length_mm(0.0508);
        let um = wire.likely_unit(50.8).expect("a unit");
        assert!(um.contains("50.8 mm") && um.contains("in um?"), "{um}");
        assert!(um.ends_with("Write 0.0508 then"), "{um}");
        assert!(wire.likely_unit(5.08e-5).expect("m").contains("in m?"));
        for (typical, value, unit) in [
            (YOUNGS_MODULUS_MPA, 117.0, "GPa"),
            (YOUNGS_MODULUS_MPA, 1.17e11, "Pa"),
            (HARDNESS_MPA, 1.275, "GPa"),
            (K_OVER_H_PER_MPA, 2e-15, "1/Pa"),
            (PRESSURE_MPA, 1e7, "Pa"),
        ] {
            let said = typical.likely_unit(value).expect("a unit");
            assert!(said.contains(&format!("in {unit}?")), "{said}");
        }
    }

    #[test]
    fn typical_values_and_those_that_no_unit_explains_are_not_commented() {
        let wire = length_mm(0.0508);
        for value in [0.0, 0.0508, 0.5, 5.0, 0.001, 1e9] {
            assert_eq!(wire.likely_unit(value), None, "{value}");
        }
        assert_eq!(YOUNGS_MODULUS_MPA.likely_unit(2e5), None);
    }
}
