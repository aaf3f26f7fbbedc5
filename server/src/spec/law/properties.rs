//! Dependences of the rate of each wear law, and the constants that set it.

use api::spec::{WearLaw, WearLawName};

/// Dependences of the rate of a law besides pressure and slip, and the constants that set it.
pub(in crate::spec) struct Properties {
    /// The rate is the same in every state, as that of a layer or a base of a plating must be.
    pub(in crate::spec) uniform: bool,
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

const fn proportional(field: &'static str, of: fn(&mut WearLaw) -> &mut Option<f64>) -> Constant {
    Constant {
        field,
        of,
        scaling: Scaling::Proportional,
    }
}

const K: Constant = proportional("k", |law| &mut law.k);
const K_OVER_H: Constant = proportional("k_over_h_per_mpa", |law| &mut law.k_over_h_per_mpa);
const ENERGY: Constant = proportional("energy_coefficient_mm3_per_j", |law| {
    &mut law.energy_coefficient_mm3_per_j
});
/// The dose after which a rate has changed.
const DOSE: Constant = Constant {
    scaling: Scaling::Inverse,
    ..proportional("characteristic_dose_mpa_mm", |law| {
        &mut law.characteristic_dose_mpa_mm
    })
};
const GROWTH_BY_MASS: Constant = proportional("arrhenius_constant_kg2_m4s", |law| {
    &mut law.arrhenius_constant_kg2_m4s
});
const GROWTH: Constant = proportional("arrhenius_constant_m2_s", |law| {
    &mut law.arrhenius_constant_m2_s
});
const MOLTEN: Constant = proportional("molten_fraction", |law| &mut law.molten_fraction);
const FACTOR_OF_STRAIN: Constant = proportional("wear_factor", |law| &mut law.wear_factor);
const FACTOR_OF_TIME: Constant = Constant {
    scaling: Scaling::Power(|law| law.time_exponent),
    ..FACTOR_OF_STRAIN
};
const FACTOR_OF_REPETITIONS: Constant = Constant {
    scaling: Scaling::Power(|law| law.repetition_exponent),
    ..FACTOR_OF_STRAIN
};

/// The properties of a law.
pub(in crate::spec) fn properties(law: WearLawName) -> Properties {
    match law {
        WearLawName::Archard => Properties {
            uniform: true,
            by_friction: false,
            by_hardness: true,
            constants: &[K, K_OVER_H],
        },
        WearLawName::Sarkar | WearLawName::Saracibar => Properties {
            uniform: true,
            by_friction: true,
            by_hardness: true,
            constants: &[K, K_OVER_H],
        },
        WearLawName::DissipatedEnergy => Properties {
            uniform: true,
            by_friction: true,
            by_hardness: false,
            constants: &[ENERGY],
        },
        WearLawName::Barwell => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: true,
            constants: &[K, K_OVER_H, DOSE],
        },
        WearLawName::Quinn => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: true,
            constants: &[GROWTH_BY_MASS],
        },
        WearLawName::MildOxidation => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: true,
            constants: &[GROWTH],
        },
        WearLawName::SevereOxidation => Properties {
            uniform: false,
            by_friction: true,
            by_hardness: true,
            constants: &[MOLTEN],
        },
        WearLawName::Oxidation => Properties {
            uniform: false,
            by_friction: true,
            by_hardness: true,
            constants: &[K, GROWTH, MOLTEN],
        },
        WearLawName::Rhee => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: false,
            constants: &[FACTOR_OF_TIME],
        },
        WearLawName::LoadRepetition => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: false,
            constants: &[FACTOR_OF_REPETITIONS],
        },
        WearLawName::StrainHardening => Properties {
            uniform: false,
            by_friction: false,
            by_hardness: false,
            constants: &[FACTOR_OF_STRAIN],
        },
    }
}
