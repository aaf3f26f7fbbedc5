//! The pair of bodies in contact, their worn surfaces, and the displacement of an increment.

use super::error::ContactError;
use super::state::ContactState;
use super::status::Status;
use crate::condensation::{BodyOperators, Operators, ZoneOperators};
use crate::model::Interface;
use crate::sides::{Side, Sides};
use std::ops::Range;

/// The interface between two bodies: operators and laws.
#[derive(Debug, Clone, Copy)]
pub struct Pair<'a> {
    /// Condensed bodies.
    pub operators: &'a Operators,
    /// Friction, wear, load.
    pub interface: Interface,
}

/// The zones of both surfaces in which a contact lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zones<'a> {
    pub(super) slave: &'a ZoneOperators,
    pub(super) master: &'a ZoneOperators,
}

impl<'a> Pair<'a> {
    /// The body whose nodes carry the contact constraints.
    pub fn slave(&self) -> &'a BodyOperators {
        self.operators.of(self.interface.slave)
    }

    /// The other body.
    pub(in crate::contact) fn master(&self) -> &'a BodyOperators {
        self.operators.of(self.interface.slave.other())
    }

    /// The zones that hold these ranges of nodes and all nodes that the last contact loads.
    ///
    /// # Errors
    /// [`ContactError::WiderThanZone`] if a body has no such zone.
    pub(super) fn zones(
        &self,
        last: &ContactState,
        slave: Range<usize>,
        master: Range<usize>,
    ) -> Result<Zones<'a>, ContactError> {
        let with_loaded = |side: Side, range: Range<usize>| {
            let loaded = last.loaded(side);
            if loaded.is_empty() {
                range
            } else {
                range.start.min(loaded.start)..range.end.max(loaded.end)
            }
        };
        let side = self.interface.slave;
        let (slave, master) = (with_loaded(side, slave), with_loaded(side.other(), master));
        self.zones_of(last.slider_x, slave, master)
    }

    /// The zones that hold these ranges of nodes.
    ///
    /// # Errors
    /// [`ContactError::WiderThanZone`] if a body has no such zone.
    pub(super) fn zones_of(
        &self,
        slider_x: f64,
        slave: Range<usize>,
        master: Range<usize>,
    ) -> Result<Zones<'a>, ContactError> {
        let zone = |side: Side, range: Range<usize>| {
            let body = self.operators.of(side);
            body.zone(&range)
                .ok_or_else(|| ContactError::WiderThanZone {
                    slider_x_mm: slider_x,
                    nodes: range.len(),
                    body: side.name(),
                    zone: body
                        .zones
                        .iter()
                        .map(|zone| zone.nodes().len())
                        .max()
                        .unwrap_or(0),
                })
        };
        let side = self.interface.slave;
        Ok(Zones {
            slave: zone(side, slave)?,
            master: zone(side.other(), master)?,
        })
    }

    /// Displacement of the master's frame in the slave's, mm.
    pub(super) fn offset(&self, pairing_x: f64) -> f64 {
        match self.interface.slave {
            Side::Receptacle => pairing_x,
            Side::Slider => -pairing_x,
        }
    }

    /// Displacement of a contact that moves with the slider over the slave, mm.
    pub(in crate::contact) fn travel(&self, last: &ContactState, pairing_x: f64) -> f64 {
        match self.interface.slave {
            Side::Receptacle => pairing_x - last.pairing_x,
            Side::Slider => 0.0,
        }
    }

    /// Unworn, undeformed gap at height 0 at a place of the slave, with the master's frame displaced by `offset`, mm.
    pub(super) fn unworn_gap(&self, x: f64, offset: f64) -> f64 {
        let (slave, master) = (&self.slave().profile, &self.master().profile);
        -self.interface.slave.recession() * (master.height(x - offset) - slave.height(x))
    }
}

/// Contact that the iteration of an increment starts from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WarmStart<'a> {
    /// First node of the slave; nodes outside are open.
    pub first: usize,
    /// Statuses from there on.
    pub status: &'a [Status],
    /// Pressures from there on, MPa.
    pub pressure: &'a [f64],
}

/// Imposed displacement of one increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement<'a> {
    /// Displacement of the slider at the end of the increment, mm.
    pub slider_x: f64,
    /// Additional slip of the slider's surface that does not move the contact, mm.
    pub surface_slip: f64,
    /// Slip of the slider's surface along the line, mm; only where slip is imposed.
    pub along: f64,
    /// Rigid height of the slider, mm, under a far face that is held; that at which its load is carried if absent.
    pub height: Option<f64>,
    /// True if only the height and the start differ from the last increment of the same solver: what that has assembled is used again.
    pub repeated: bool,
    /// Number of equal slips that each slip represents in the wear.
    pub cycles: f64,
    /// True if Lemke's method is tried where Newton's method does not converge: reliable, but far more expensive than
    /// two half increments.
    pub lemke: bool,
    /// Where the iteration starts; the last contact, moved with the slider, if it is absent.
    pub start: Option<WarmStart<'a>>,
}

impl Displacement<'_> {
    /// Slip across the line that is imposed from a displacement of the slider on, mm.
    pub(super) fn across(&self, last_x: f64) -> f64 {
        self.slider_x - last_x + self.surface_slip
    }
}

/// Worn surfaces, at the contact nodes.
#[derive(Debug, Clone, Copy)]
pub struct Surfaces<'a> {
    /// Vertical worn depth, mm.
    pub depth: Sides<&'a [f64]>,
    /// Slope dy/dx.
    pub slope: Sides<&'a [f64]>,
    /// Coefficients of friction of the surfaces whose places differ in it, -; that of the interface without them.
    pub friction: Sides<Option<&'a [f64]>>,
}

impl Surfaces<'_> {
    /// Returns `true` if all places have the coefficient of friction of the interface.
    pub(in crate::contact) fn has_uniform_friction(&self) -> bool {
        self.friction.slider.is_none() && self.friction.receptacle.is_none()
    }
}

/// Slopes dy/dx of a body's contact surface that has receded by `depth`: of the unworn shape exactly, of the depth by
/// central differences.
pub fn slopes(body: &BodyOperators, depth: &[f64], side: Side) -> Vec<f64> {
    let x = &body.x;
    (0..x.len())
        .map(|i| {
            let (left, right) = (i.saturating_sub(1), (i + 1).min(x.len() - 1));
            let worn = (depth[right] - depth[left]) / (x[right] - x[left]);
            body.profile.slope(x[i]) + side.recession() * worn
        })
        .collect()
}

/// Slopes of both surfaces as worn to these depths, mm.
pub(crate) fn slopes_of_both(operators: &Operators, depth: &Sides<Vec<f64>>) -> Sides<Vec<f64>> {
    Sides::from_fn(|side| slopes(operators.of(side), depth.of(side), side))
}
