//! Dependences of the rate of each wear law, and the constants that set it.

use api::spec::{WearLaw, WearLawName};

/// What the rate of a law depends on besides pressure and slip, and the constants that set it.
pub(in crate::spec) struct Properties {
    /// The rate depends on the coefficient of friction.
    pub(in crate::spec) by_friction: bool,
    /// The rate is in proportion to the inverse of the hardness.
    pub(in crate::spec) by_hardness: bool,
    /// Constants that change with the wear coefficient: together they scale every depth.
    pub(in crate::spec) constants: &'static [Constant],
}

/// A constant of a law that changes with its wear coefficient.
pub(in crate::spec) struct Constant {
    pub(in crate::spec) field: &'static str,
    pub(in crate::spec) of: fn(&mut WearLaw) -> &mut Option<f64>,
    pub(in crate::spec) scaling: Scaling,
}

/// How a constant changes with the wear coefficient.
#[derive(Clone, Copy)]
pub(in crate::spec) enum Scaling {
    /// In proportion.
    Proportional,
    /// In proportion to the inverse.
    Inverse,
    /// With a power of it, the exponent of the cycles.
    Power(fn(&WearLaw) -> Option<f64>),
}

impl Scaling {
    /// Factor on a constant of a law for a factor on the wear coefficient.
    pub(in crate::spec) fn factor(self, law: &WearLaw, factor: f64) -> f64 {
        match self {
            Self::Proportional => factor,
            Self::Inverse => 1.0 / factor,
            Self::Power(exponent) => factor.powf(exponent(law).unwrap_or(1.0)),
        }
    }
}

const K: Constant = Constant {
    field: "k",
    of: |law| &mut law.k,
    scaling: Scaling::Proportional,
};
const K_OVER_H: Constant = Constant {
    field: "k_over_h_per_mpa",
    of: |law| &mut law.k_over_h_per_mpa,
    scaling: Scaling::Proportional,
};
const ENERGY: Constant = Constant {
    field: "energy_coefficient_mm3_per_j",
    of: |law| &mut law.energy_coefficient_mm3_per_j,
    scaling: Scaling::Proportional,
};
/// The dose after which a rate has changed.
const DOSE: Constant = Constant {
    field: "characteristic_dose_mpa_mm",
    of: |law| &mut law.characteristic_dose_mpa_mm,
    scaling: Scaling::Inverse,
};
const GROWTH_BY_MASS: Constant = Constant {
    field: "arrhenius_constant_kg2_m4s",
    of: |law| &mut law.arrhenius_constant_kg2_m4s,
    scaling: Scaling::Proportional,
};
const GROWTH: Constant = Constant {
    field: "arrhenius_constant_m2_s",
    of: |law| &mut law.arrhenius_constant_m2_s,
    scaling: Scaling::Proportional,
};
const MOLTEN: Constant = Constant {
    field: "molten_fraction",
    of: |law| &mut law.molten_fraction,
    scaling: Scaling::Proportional,
};
const FACTOR_OF_TIME: Constant = Constant {
    field: "wear_factor",
    of: |law| &mut law.wear_factor,
    scaling: Scaling::Power(|law| law.time_exponent),
};
const FACTOR_OF_REPETITIONS: Constant = Constant {
    scaling: Scaling::Power(|law| law.repetition_exponent),
    ..FACTOR_OF_TIME
};
const FACTOR_OF_STRAIN: Constant = Constant {
    scaling: Scaling::Proportional,
    ..FACTOR_OF_TIME
};

/// The properties of a law.
pub(in crate::spec) fn properties(law: WearLawName) -> Properties {
    let (by_friction, by_hardness, constants): (_, _, &[Constant]) = match law {
        WearLawName::Archard => (false, true, &[K, K_OVER_H]),
        WearLawName::Sarkar | WearLawName::Saracibar => (true, true, &[K, K_OVER_H]),
        WearLawName::DissipatedEnergy => (true, false, &[ENERGY]),
        WearLawName::Barwell => (false, true, &[K, K_OVER_H, DOSE]),
        WearLawName::Quinn => (false, true, &[GROWTH_BY_MASS]),
        WearLawName::MildOxidation => (false, true, &[GROWTH]),
        WearLawName::SevereOxidation => (true, true, &[MOLTEN]),
        WearLawName::Oxidation => (true, true, &[K, K_OVER_H, GROWTH, MOLTEN]),
        WearLawName::Rhee => (false, false, &[FACTOR_OF_TIME]),
        WearLawName::LoadRepetition => (false, false, &[FACTOR_OF_REPETITIONS]),
        WearLawName::StrainHardening => (false, false, &[FACTOR_OF_STRAIN]),
    };
    Properties {
        by_friction,
        by_hardness,
        constants,
    }
}
