//! Inputs of a derived motion from the rest of a specification: friction and force of a contact.

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

/// Limits of the slip of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Amplitude of the displacement of both parts that the arm takes up without slip, mm.
    pub(super) held_mm: f64,
    /// Amplitude at which a stop ends the displacement of both parts, mm; infinite without one.
    pub(super) stop_mm: f64,
}

impl Limits {
    /// No arm and no stop.
    pub(super) const NONE: Self = Self {
        held_mm: 0.0,
        stop_mm: f64::INFINITY,
    };

    /// Limits by an arm and by the play between both parts, mm: half of it lies to either side of the middle.
    pub(super) fn of(held_mm: f64, clearance_mm: Option<f64>) -> Self {
        Self {
            held_mm,
            stop_mm: clearance_mm.map_or(f64::INFINITY, |clearance| 0.5 * clearance),
        }
    }

    /// Checks whether any displacement makes the contact slip.
    pub(super) fn let_slip(self) -> bool {
        self.held_mm < self.stop_mm
    }
}

/// The displacement that is demanded of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demand {
    /// Amplitude of the displacement of both parts relative to each other without a stop, mm.
    pub(super) free_mm: f64,
    /// Amplitude of that displacement, mm.
    pub(super) relative_mm: f64,
    /// Amplitude that the arm takes up, mm.
    pub(super) held_mm: f64,
    /// Amplitude of the slip, mm.
    pub(super) slip_mm: f64,
    pub(super) slips_from_g: Option<f64>,
    pub(super) frequency_hz: f64,
}

impl Demand {
    /// A displacement that ends at the stop, and of which the arm takes up a part: the slip is min(u, stop) - held.
    pub(super) fn beyond(free_mm: f64, limits: Limits, frequency_hz: f64) -> Self {
        let relative_mm = free_mm.min(limits.stop_mm);
        Self {
            free_mm,
            relative_mm,
            held_mm: limits.held_mm.min(relative_mm),
            slip_mm: (relative_mm - limits.held_mm).max(0.0),
            slips_from_g: None,
            frequency_hz,
        }
    }

    /// The motion that it imposes.
    pub(super) fn imposed(
        self,
        spec: Motion,
        drive: Drive,
        how: &str,
        diagnostics: &mut Diagnostics,
    ) -> ImposedMotion {
        // Less than the least amplitude, far below the width of an atom, is no slip.
        let amplitude_mm = if self.slip_mm < *AMPLITUDE_MM.start() {
            0.0
        } else {
            self.slip_mm
        };
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
        if self.relative_mm < self.free_mm {
            parts.push(format!(
                "the clearance leaves the parts +-{} of +-{} um",
                microns(self.relative_mm),
                microns(self.free_mm)
            ));
        } else if self.relative_mm > 0.0 {
            parts.push(format!(
                "the parts move by +-{} um",
                microns(self.relative_mm)
            ));
        }
        if self.held_mm > 0.0 {
            parts.push(format!("the arm takes up {} um", microns(self.held_mm)));
        }
        parts.push(if amplitude_mm > 0.0 {
            format!("the contact slips by +-{} um", microns(amplitude_mm))
        } else {
            "the contact does not slip".to_owned()
        });
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
