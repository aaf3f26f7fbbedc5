//! What a derived motion takes from the rest of a specification: friction and force of a contact.

use api::spec::{DerivedMotion, Drive, Motion, MotionKind};
use solver::scene;

use super::imposed::{AMPLITUDE_MM, ImposedMotion, engine_drive};
use crate::spec::diagnostics::Diagnostics;

/// A contact of the connector.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldContact {
    /// Coefficient of friction, -.
    pub(crate) friction: f64,
    /// Normal force, N; unknown of a load for each mm of depth.
    pub(crate) force_n: Option<f64>,
}

impl HeldContact {
    /// The largest tangential force that friction transmits, N; a fault where the force is unknown.
    pub(super) fn friction_n(self, kind: MotionKind, diagnostics: &mut Diagnostics) -> f64 {
        let Some(force_n) = self.force_n else {
            let detail = format!(
                "`{}` needs the force on a contact: a load of the kind `force`",
                kind.as_str()
            );
            diagnostics.fault("/load/kind", detail);
            return 0.0;
        };
        self.friction * force_n
    }
}

/// The displacement that is demanded of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demand {
    /// Amplitude of the displacement of both parts relative to each other, mm.
    pub(super) relative_mm: f64,
    /// Amplitude that the arm takes up, mm.
    pub(super) held_mm: f64,
    /// Amplitude of the slip without a clearance, mm.
    pub(super) slip_mm: f64,
    pub(super) slips_from_g: Option<f64>,
    pub(super) frequency_hz: f64,
}

impl Demand {
    /// A displacement of which the arm takes up a part.
    pub(super) fn beyond(relative_mm: f64, held_mm: f64, frequency_hz: f64) -> Self {
        Self {
            relative_mm,
            held_mm: held_mm.min(relative_mm),
            slip_mm: (relative_mm - held_mm).max(0.0),
            slips_from_g: None,
            frequency_hz,
        }
    }

    /// The motion that it imposes, at most that of a clearance, mm.
    pub(super) fn imposed(
        self,
        spec: Motion,
        drive: Drive,
        (clearance_mm, how): (Option<f64>, &str),
        diagnostics: &mut Diagnostics,
    ) -> ImposedMotion {
        let most = clearance_mm.map_or(f64::INFINITY, |clearance| 0.5 * clearance);
        let amplitude_mm = self.slip_mm.min(most);
        if amplitude_mm > *AMPLITUDE_MM.end() {
            let detail = format!(
                "the contact would slip by +-{amplitude_mm:.3e} mm, {} are the most",
                AMPLITUDE_MM.end()
            );
            diagnostics.fault("/motion", detail);
        }
        let reason = self.reason(how, amplitude_mm);
        let derived = DerivedMotion {
            relative_amplitude_mm: self.relative_mm,
            held_amplitude_mm: self.held_mm,
            slip_amplitude_mm: amplitude_mm,
            sticks: amplitude_mm <= 0.0,
            slips_from_g: self.slips_from_g,
            frequency_hz: self.frequency_hz,
            reason,
        };
        ImposedMotion {
            spec,
            drive: engine_drive(drive),
            scene: scene::Motion::Reciprocating {
                amplitude_mm,
                period_s: 1.0 / self.frequency_hz,
            },
            timing: scene::Timing::Sine,
            derived: Some(derived),
            duration_cycles: None,
        }
    }
}

impl Demand {
    /// How a slip of an amplitude came about.
    fn reason(self, how: &str, amplitude_mm: f64) -> String {
        let mut parts = vec![how.to_owned()];
        if self.relative_mm > 0.0 {
            parts.push(format!(
                "the parts move by +-{} um",
                microns(self.relative_mm)
            ));
        }
        if self.held_mm > 0.0 {
            parts.push(format!("the arm takes up {} um", microns(self.held_mm)));
        }
        parts.push(if self.slip_mm > 0.0 {
            format!("the contact slips by +-{} um", microns(self.slip_mm))
        } else {
            "the contact does not slip".to_owned()
        });
        if amplitude_mm < self.slip_mm {
            parts.push(format!(
                "the clearance leaves +-{} um",
                microns(amplitude_mm)
            ));
        }
        parts.extend(
            self.slips_from_g
                .map(|from| format!("slip begins at {from:.3} g")),
        );
        parts.join(", ")
    }
}

/// A length in um with four digits.
fn microns(mm: f64) -> String {
    let um = 1e3 * mm;
    if um >= 1e3 {
        format!("{um:.0}")
    } else if um >= 1.0 {
        format!("{um:.2}")
    } else if um > 0.0 {
        format!("{um:.3e}")
    } else {
        "0".to_owned()
    }
}

/// Amplitude that an arm of a tangential stiffness takes up before friction is exceeded, mm; none without a stiffness.
pub(super) fn held_mm(friction_n: f64, stiffness_n_per_mm: Option<f64>) -> f64 {
    stiffness_n_per_mm.map_or(0.0, |stiffness| friction_n / stiffness)
}
