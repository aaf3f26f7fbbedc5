//! Wear laws: recession of a surface from the local state of the contact. One file a law.
//!
//! A law returns its specific wear rate with derivatives; the contact solve takes these and knows no law.
//!
//! The thesis' own subroutine takes the signed velocity of the slider; here it is the magnitude of the local slip, so
//! that sticking points do not wear and a return stroke removes material like the stroke before.

pub mod archard;
mod arrhenius;
pub mod barwell;
pub mod dissipated_energy;
pub mod load_repetition;
pub mod mechanism;
pub mod mild_oxidation;
pub mod power;
#[cfg(test)]
mod pressure_power;
pub mod quinn;
mod rate;
pub mod rhee;
pub mod saracibar;
pub mod sarkar;
pub mod severe_oxidation;
pub mod speed;
pub mod strain_hardening;
pub(crate) mod surface_state;

use barwell::Barwell;
use power::PowerLaw;
pub use rate::{LocalState, Rate};
use speed::SpeedLaw;

use super::pace::Pace;

/// Wear laws: normal recession rate of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WearLaw {
    /// Archard: recession = (k/H) p |slip| (thesis, equations 5 and 6).
    Archard {
        /// k/H, 1/MPa.
        k_over_h_per_mpa: f64,
    },
    /// Sarkar: recession = (k/H) sqrt(1 + 3 mu^2) p |slip| (thesis, equation 9).
    Sarkar {
        /// k/H without friction, 1/MPa.
        k_over_h_per_mpa: f64,
        /// Coefficient of friction mu, -.
        friction: f64,
    },
    /// Saracibar and Chiumenti: recession = k q |slip|/(mu0 H) (thesis, equation 10).
    Saracibar {
        /// k/H at the coefficient of friction mu0, 1/MPa.
        k_over_h_per_mpa: f64,
        /// Coefficient of friction mu, -.
        friction: f64,
        /// Coefficient of friction mu0 that k was measured at, -.
        reference_friction: f64,
    },
    /// Dissipated energy: recession = alpha q |slip|.
    DissipatedEnergy {
        /// Worn volume per energy alpha, mm^3/J.
        mm3_per_j: f64,
        /// Coefficient of friction mu, -.
        friction: f64,
    },
    /// Barwell: the rate falls or grows with the dose (thesis, equations 1 and 3).
    Barwell(Barwell),
    /// Oxidational: the rate depends on the speed (thesis, equations 7, 11 and 12).
    OfSpeed(SpeedLaw),
    /// A power of the depth adds (thesis, equations 4, 18, 19 and 20).
    Power(PowerLaw),
    /// A specific wear rate that grows with the pressure, for tests of the contact solve.
    #[cfg(test)]
    PressurePower {
        /// Specific wear rate at the reference pressure, 1/MPa.
        k_per_mpa: f64,
        /// Reference pressure, MPa.
        reference_mpa: f64,
        /// Exponent of the pressure, -.
        exponent: f64,
    },
}

impl WearLaw {
    /// Specific wear rate at a local state.
    pub fn rate(self, at: LocalState) -> Rate {
        match self {
            Self::Archard { k_over_h_per_mpa } => archard::rate(k_over_h_per_mpa, at),
            Self::Sarkar {
                k_over_h_per_mpa,
                friction,
            } => sarkar::rate(k_over_h_per_mpa, friction, at),
            Self::Saracibar {
                k_over_h_per_mpa,
                friction,
                reference_friction,
            } => saracibar::rate(k_over_h_per_mpa, friction, reference_friction, at),
            Self::DissipatedEnergy {
                mm3_per_j,
                friction,
            } => dissipated_energy::rate(mm3_per_j, friction, at),
            Self::Barwell(law) => barwell::rate(law, at),
            Self::OfSpeed(law) => Rate::uniform(law.rate(at.pace)),
            Self::Power(law) => power::rate(law, at),
            #[cfg(test)]
            Self::PressurePower {
                k_per_mpa,
                reference_mpa,
                exponent,
            } => pressure_power::rate(k_per_mpa, reference_mpa, exponent, at),
        }
    }

    /// Returns `true` if its constants hold at a temperature that is given for the contact, which no further heat changes.
    pub(crate) fn has_given_temperature(self) -> bool {
        matches!(self, Self::OfSpeed(law) if law.has_given_temperature())
    }

    /// The law of a contact that is warmer than its surroundings by a rise in K, at the same hardness.
    #[must_use]
    pub fn heated(self, rise_k: f64) -> Self {
        match self {
            Self::OfSpeed(law) => Self::OfSpeed(law.with_surface(|surface| surface.heated(rise_k))),
            Self::Power(law) => Self::Power(law.heated(rise_k)),
            _ => self,
        }
    }

    /// The law at another hardness than it was given with; the energy that detaches a volume, and laws
    /// without a hardness, do not depend on it.
    #[must_use]
    pub(crate) fn softened(self, ratio: f64) -> Self {
        match self {
            Self::Archard { k_over_h_per_mpa } => Self::Archard {
                k_over_h_per_mpa: k_over_h_per_mpa / ratio,
            },
            Self::Sarkar {
                k_over_h_per_mpa,
                friction,
            } => Self::Sarkar {
                k_over_h_per_mpa: k_over_h_per_mpa / ratio,
                friction,
            },
            Self::Saracibar {
                k_over_h_per_mpa,
                friction,
                reference_friction,
            } => Self::Saracibar {
                k_over_h_per_mpa: k_over_h_per_mpa / ratio,
                friction,
                reference_friction,
            },
            Self::DissipatedEnergy { .. } | Self::Power(_) => self,
            Self::Barwell(law) => Self::Barwell(law.softened(ratio)),
            Self::OfSpeed(law) => {
                Self::OfSpeed(law.with_surface(|surface| surface.softened(ratio)))
            }
            #[cfg(test)]
            Self::PressurePower { .. } => self,
        }
    }

    /// The law as it is at a pace.
    #[must_use]
    pub(crate) fn at_pace(self, pace: Pace) -> Self {
        match self {
            Self::OfSpeed(law) => Self::Archard {
                k_over_h_per_mpa: law.rate(pace),
            },
            law => law,
        }
    }

    /// The specific wear rate of a law for which it is the same in every state, 1/MPa.
    pub fn uniform(self) -> Option<f64> {
        match self {
            Self::Archard { .. }
            | Self::Sarkar { .. }
            | Self::Saracibar { .. }
            | Self::DissipatedEnergy { .. } => Some(self.rate(LocalState::default()).value),
            Self::Barwell(_) | Self::OfSpeed(_) | Self::Power(_) => None,
            #[cfg(test)]
            Self::PressurePower { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::barwell::Course;
    use super::power::Measure;
    use super::quinn::Quinn;
    use super::surface_state::SurfaceState;
    use super::*;
    use crate::law::temperature::Temperature;

    const LAWS: [WearLaw; 15] = [
        WearLaw::Archard {
            k_over_h_per_mpa: 2.5761e-5,
        },
        WearLaw::Sarkar {
            k_over_h_per_mpa: 2.5761e-5,
            friction: 0.9,
        },
        WearLaw::Saracibar {
            k_over_h_per_mpa: 2.5761e-5,
            friction: 0.6,
            reference_friction: 0.3,
        },
        WearLaw::DissipatedEnergy {
            mm3_per_j: 4.23e-5,
            friction: 0.8,
        },
        barwell(Course::Decelerating),
        barwell(Course::Accelerating),
        power(
            0.5,
            Measure::SlipTime {
                speed_exponent: 0.8,
            },
        ),
        power(
            0.9,
            Measure::SlipTime {
                speed_exponent: 1.3,
            },
        ),
        power(0.9, Measure::Repetitions),
        power(0.7, Measure::Time),
        power(1.5, Measure::Time),
        WearLaw::OfSpeed(SpeedLaw::Quinn(Quinn {
            asperity_um: 20.0,
            arrhenius_kg2_m4s: 1.5e6,
            activation_j_mol: 208e3,
            film_um: 1.0,
            oxide_density_kg_m3: 5_240.0,
            oxygen_fraction: 0.3006,
            surface: SurfaceState {
                hardness_mpa: 6_865.0,
                temperature: Temperature::OfContact(673.15),
            },
        })),
        WearLaw::OfSpeed(SpeedLaw::MildOxidation(mild_oxidation::STEEL)),
        WearLaw::OfSpeed(SpeedLaw::SevereOxidation(severe_oxidation::STEEL)),
        WearLaw::PressurePower {
            k_per_mpa: 2.5761e-5,
            reference_mpa: 100.0,
            exponent: 0.6,
        },
    ];
    const STATE: LocalState = LocalState {
        pressure: 150.0,
        slip: 0.02,
        depth: 1e-4,
        pace: Pace {
            s_per_mm: 1e-3,
            cycles_per_mm: 10.0,
        },
    };

    /// Wears as much in an increment as before it.
    const fn power(exponent: f64, measure: Measure) -> WearLaw {
        WearLaw::Power(PowerLaw {
            exponent,
            factor: 1e-5,
            pressure_exponent: 2.0,
            measure,
            thermal: None,
        })
    }

    /// A fifth of the characteristic dose in an increment.
    const fn barwell(course: Course) -> WearLaw {
        WearLaw::Barwell(Barwell {
            rate_per_mpa: 2.5761e-5,
            dose_mpa_mm: 15.0,
            course,
        })
    }

    #[test]
    fn derivatives_are_those_of_the_value() {
        let at = STATE;
        for law in LAWS {
            let rate = law.rate(at);
            let step = 1e-4;
            let value = |pressure: f64, slip: f64| {
                let to = LocalState {
                    pressure,
                    slip,
                    ..at
                };
                law.rate(to).value
            };
            let central = |more: f64, less: f64, h: f64| (more - less) / (2.0 * h);
            let h = step * at.pressure;
            let d_pressure = central(
                value(at.pressure + h, at.slip),
                value(at.pressure - h, at.slip),
                h,
            );
            let h = step * at.slip;
            let d_slip = central(
                value(at.pressure, at.slip + h),
                value(at.pressure, at.slip - h),
                h,
            );
            assert!((rate.d_pressure - d_pressure).abs() <= 1e-7 * rate.value / at.pressure);
            assert!((rate.d_slip - d_slip).abs() <= 1e-7 * rate.value / at.slip);
        }
    }

    #[test]
    fn a_uniform_rate_is_that_of_every_state() {
        for law in LAWS {
            let (here, unloaded) = (law.rate(STATE), law.rate(LocalState::default()));
            assert_eq!(law.uniform().is_some(), here == unloaded, "{law:?}");
            assert!(law.uniform().is_none_or(|k| (k - here.value).abs() <= 0.0));
        }
    }
}
