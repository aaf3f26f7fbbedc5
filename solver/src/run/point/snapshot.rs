//! The snapshot of a point contact: profiles and tractions of its middle section, and the maps of the whole contact.

use crate::point::{DepthMap, Placed, PointScene, PointState};
use crate::record::{
    AreaMaps, DepthProfile, FrictionLoop, Position, PressureMap, Snapshot, TractionField,
};
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// The snapshot of the present state.
pub(super) fn snapshot(
    (scene, contact): (&Scene, &PointScene),
    state: &PointState,
    depth: Sides<DepthMap>,
) -> Snapshot {
    let profile = |side| {
        let map: &DepthMap = depth.of(side);
        DepthProfile {
            x_mm: map.x_mm.clone(),
            depth_mm: map.section(),
        }
    };
    let amplitude = scene.motion.amplitude_mm();
    // Cycles begin at the right turning point.
    let [left, right] = state.turning();
    let placed = [
        (Position::Neutral, 0.0, state.neutral()),
        (Position::Rightmost, amplitude, right),
        (Position::Leftmost, -amplitude, left),
    ];
    // Before the first cycle there are no turning points.
    let count = if state.cycle() == 0 { 1 } else { placed.len() };
    Snapshot {
        cycle: state.cycle(),
        receptacle: profile(Side::Receptacle),
        slider: profile(Side::Slider),
        positions: placed[..count].iter().map(tractions).collect(),
        friction_loop: friction_loop(contact, state),
        fields: Vec::new(),
        area: Some(AreaMaps {
            pressure: pressure_map(state.neutral()),
            depth,
        }),
    }
}

fn tractions(&(position, slider_x_mm, placed): &(Position, f64, &Placed)) -> TractionField {
    TractionField {
        position,
        slider_x_mm,
        x_mm: placed.x_on_receptacle(),
        pressure_mpa: placed.section_pressure(),
        shear_mpa: placed.shear_mpa.clone(),
    }
}

fn pressure_map(placed: &Placed) -> PressureMap {
    let cells = placed.cells;
    PressureMap {
        x_mm: placed.x_on_receptacle(),
        z_mm: (0..cells.along_z)
            .map(|column| cells.z_mm(column))
            .collect(),
        pressure_mpa: placed.pressure_mpa.clone(),
    }
}

/// The loop of the last cycle.
fn friction_loop(contact: &PointScene, state: &PointState) -> FrictionLoop {
    let mut found = FrictionLoop::default();
    for (displacement, (line, whole)) in state.friction_loop(contact) {
        found.displacement_mm.push(displacement);
        found.tangential_force_n_per_mm.push(line);
        found.tangential_force_n.push(whole);
    }
    found
}
