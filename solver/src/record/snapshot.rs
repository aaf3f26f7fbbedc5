//! Snapshots: profiles, tractions, the friction loop and fields at one cycle.

use crate::along_line::StationReport;
use crate::contact::ContactState;
use crate::cycle::{CycleRecord, CycleState, FrictionLoop};
use crate::fields::{LineFields, PlacedFields};
use crate::model::Model;
use crate::point::DepthMap;
use crate::schedule::increments::Position;
use crate::sides::{Side, Sides};

/// Profiles, pressures and the friction loop at one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Physical cycles done.
    pub cycle: u64,
    /// Worn depth over the receptacle's surface.
    pub receptacle: DepthProfile,
    /// Worn depth over the slider's surface, x in the slider's own frame.
    pub slider: DepthProfile,
    /// Tractions at the neutral, rightmost and leftmost position of the cycle.
    pub positions: Vec<TractionField>,
    /// Friction force over the imposed displacement of the cycle.
    pub friction_loop: FrictionLoop,
    /// Fields inside the bodies at the same positions, if the scene asks for them.
    pub fields: Vec<PlacedFields>,
    /// Fields inside the bodies of a contact along a line.
    pub line_fields: Vec<LineFields>,
    /// The whole contact, of which profiles and tractions are those of the middle section; `None` of a section.
    pub area: Option<AreaMaps>,
    /// The sections along a line, of which profiles and tractions are those of the one across the motion or in the middle; none of
    /// another contact.
    pub stations: Vec<StationSnapshot>,
}

/// A section along a line at one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct StationSnapshot {
    /// Where it is, and what it carries.
    pub report: StationReport,
    /// Worn depth over the receptacle's surface.
    pub receptacle: DepthProfile,
    /// Worn depth over the slider's surface, x in the slider's own frame.
    pub slider: DepthProfile,
    /// Tractions at the named positions of the cycle.
    pub positions: Vec<TractionField>,
}

/// A point contact over its cells.
#[derive(Debug, Clone, PartialEq)]
pub struct AreaMaps {
    /// Worn depths, each in the frame of its body.
    pub depth: Sides<DepthMap>,
    /// Pressure at the neutral position.
    pub pressure: PressureMap,
}

/// Pressure over the cells of a contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PressureMap {
    /// Centres of the cells along the sliding direction on the receptacle, mm.
    pub x_mm: Vec<f64>,
    /// Centres of the cells across it, mm.
    pub z_mm: Vec<f64>,
    /// Pressure at (i, j), with the index i times the number of z plus j, MPa.
    pub pressure_mpa: Vec<f64>,
}

/// Worn depth along a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DepthProfile {
    /// Places along the surface, mm.
    pub x_mm: Vec<f64>,
    /// Worn depth, mm.
    pub depth_mm: Vec<f64>,
}

/// Contact tractions on the receptacle at one position of the slider.
#[derive(Debug, Clone, PartialEq)]
pub struct TractionField {
    /// Position in the cycle.
    pub position: Position,
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x_mm: f64,
    /// Positions on the receptacle, mm.
    pub x_mm: Vec<f64>,
    /// Normal pressure, MPa.
    pub pressure_mpa: Vec<f64>,
    /// Shear traction on the receptacle, MPa.
    pub shear_mpa: Vec<f64>,
}

/// The snapshot of the present state with what the last computed cycle recorded, and fields if there are any.
pub fn snapshot(
    model: &Model,
    state: &CycleState,
    record: CycleRecord,
    fields: Vec<PlacedFields>,
) -> Snapshot {
    let profile = |x: &[f64], depth: &[f64]| DepthProfile {
        x_mm: x.to_vec(),
        depth_mm: depth.to_vec(),
    };
    let x = model.bodies.receptacle.contact_x();
    let slave = model.interface.slave;
    let nodes = model.bodies.of(slave).contact_x();
    let at = |(position, contact): &(Position, ContactState)| {
        tractions(*position, slave, nodes, contact)
    };
    Snapshot {
        cycle: state.cycle,
        receptacle: profile(x, &state.depth.receptacle),
        slider: profile(model.bodies.slider.contact_x(), &state.depth.slider),
        positions: record.contacts.iter().map(at).collect(),
        friction_loop: record.friction_loop,
        fields,
        line_fields: Vec::new(),
        area: None,
        stations: Vec::new(),
    }
}

/// Tractions of the present contact, with one unloaded node at either end.
pub(crate) fn tractions(
    position: Position,
    slave: Side,
    x: &[f64],
    contact: &ContactState,
) -> TractionField {
    let shift = match slave {
        Side::Slider => contact.pairing_x,
        Side::Receptacle => 0.0,
    };
    let (first, end) = contact.active_range().unwrap_or((0, 0));
    let span = first.saturating_sub(1)..(end + 1).min(x.len());
    TractionField {
        position,
        slider_x_mm: contact.slider_x,
        x_mm: x[span.clone()].iter().map(|x| x + shift).collect(),
        pressure_mpa: contact.pressure[span.clone()].to_vec(),
        shear_mpa: contact.shear[span].to_vec(),
    }
}
