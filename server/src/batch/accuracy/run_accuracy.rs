//! The accuracy setting of a run: a tolerance, or fixed settings.

use api::spec::{Accuracy, CycleJump, Overrides};

use crate::batch::accuracy::settings::Settings;

/// Tolerance of a run whose settings are fixed: decides the parts of the mesh that they leave open.
const TOLERANCE: f64 = 0.02;

/// Accuracy setting of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RunAccuracy {
    /// A tolerance.
    Tolerance(f64),
    /// Fixed settings.
    Fixed(Settings),
}

impl RunAccuracy {
    /// The setting of a run's specification; `None` if it leaves one open.
    pub fn of(accuracy: &Accuracy) -> Option<Self> {
        match &accuracy.overrides {
            None => accuracy.tolerance.map(Self::Tolerance),
            Some(overrides) => Settings::of(overrides).map(Self::Fixed),
        }
    }

    /// The tolerance, or the fixed settings.
    pub(super) fn parts(self) -> (Option<f64>, Option<Settings>) {
        match self {
            Self::Tolerance(tolerance) => (Some(tolerance), None),
            Self::Fixed(settings) => (None, Some(settings)),
        }
    }

    /// The setting as part of a specification. Errors are not estimated: the study itself shows them.
    pub fn as_spec(self) -> Accuracy {
        match self {
            Self::Tolerance(tolerance) => Accuracy {
                tolerance: Some(tolerance),
                estimate_errors: Some(false),
                ..Accuracy::default()
            },
            Self::Fixed(settings) => Accuracy {
                preset: None,
                tolerance: Some(TOLERANCE),
                overrides: Some(Overrides {
                    contact_element_mm: Some(settings.contact_element_mm),
                    increments_per_cycle: Some(settings.increments_per_cycle),
                    cycle_jump: Some(CycleJump::Fixed(settings.jump())),
                    stations: settings.stations,
                }),
                estimate_errors: Some(false),
            },
        }
    }
}

impl std::fmt::Display for RunAccuracy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Tolerance(tolerance) => write!(f, "tolerance {tolerance}"),
            Self::Fixed(settings) => settings.fmt(f),
        }
    }
}
