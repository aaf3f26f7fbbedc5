//! Contacts of the fuzz button's wire, and their missions.

use super::*;
use crate::closed_form::middle_line_load_n_per_mm;
use crate::scene::{
    Accuracy, Block, Dimension, Ends, Extruded, Line, LineShape, Mission, Point, RingMotion,
    Timing, Top,
};
use crate::sides::Sides;

/// The wire, of which both sides wear by rates in 1/MPa.
fn wire(friction: f64, slider: f64, receptacle: f64) -> Scene {
    let law = |k_over_h_per_mpa| Some(WearLaw::Archard { k_over_h_per_mpa });
    let mut scene = fuzz_button();
    (scene.slider.wear, scene.receptacle.wear) = (law(slider), law(receptacle));
    scene.friction = Friction::Coulomb {
        coefficient: friction,
    };
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.stop.clear();
    scene
}

/// A ball of its radius under 10 mN.
pub(super) fn ball(friction: f64) -> Scene {
    let mut scene = wire(friction, 5e-8, 1e-7);
    scene.dimension = Dimension::Point(Point {
        force_n: 0.01,
        radius_across_mm: Sides {
            slider: Some(0.0254),
            receptacle: None,
        },
    });
    scene.load_n_per_mm = middle_line_load_n_per_mm(&scene);
    scene
}

fn along(shape: LineShape, stations: Option<usize>) -> Scene {
    let mut scene = wire(0.1, 1e-7, 1e-6);
    scene.load_n_per_mm = 0.1;
    scene.dimension = Dimension::Line(Line {
        shape,
        top: Top::Rigid,
        force_n: scene.load_n_per_mm * shape.length_mm(),
        stations,
    });
    scene
}

/// A straight line of it.
pub(super) fn straight_line() -> Scene {
    let shape = LineShape::Straight {
        width_mm: 0.1,
        crown_radius_mm: None,
        tilt_mrad: 0.0,
    };
    along(shape, None)
}

/// The ring that it is bent to.
pub(super) fn ring() -> Scene {
    let shape = LineShape::Ring {
        radius_mm: 0.4826,
        motion: RingMotion::InPlane,
    };
    along(shape, Some(3))
}

/// A width of it.
pub(super) fn pressed_bodies() -> Scene {
    let mut scene = wire(0.1, 1e-7, 1e-6);
    scene.load_n_per_mm = 0.1;
    scene.dimension = Dimension::Extruded(Extruded {
        width_mm: 0.010_58,
        layers: 2,
        layer_growth: 1.0,
        ends: Ends::Free,
    });
    scene
}

/// Normal force of one of these contacts, N.
pub(super) fn force_n(scene: &Scene) -> f64 {
    match &scene.dimension {
        Dimension::PlaneStrain => scene.load_n_per_mm,
        Dimension::Point(point) => point.force_n,
        Dimension::Line(line) => line.force_n,
        Dimension::Extruded(bodies) => scene.load_n_per_mm * bodies.width_mm,
    }
}

fn reciprocating(amplitude_mm: f64) -> Motion {
    Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    }
}

/// A scene in one motion.
pub(super) fn alone(scene: &Scene, amplitude_mm: f64, cycles: u64) -> Scene {
    Scene {
        motion: reciprocating(amplitude_mm),
        cycles,
        ..scene.clone()
    }
}

fn with_mission(scene: &Scene, blocks: &[(f64, u64)], repeat: u64, order: Order) -> Scene {
    let block = |(amplitude_mm, cycles): &(f64, u64)| Block {
        motion: reciprocating(*amplitude_mm),
        timing: Timing::Sine,
        cycles: *cycles,
    };
    let mission = Mission {
        blocks: blocks.iter().map(block).collect(),
        repeat,
        order,
    };
    Scene {
        motion: mission.mean_motion(),
        cycles: mission.cycles() * repeat,
        mission: Some(mission),
        ..scene.clone()
    }
}

/// A scene with blocks of these amplitudes in mm and cycles, in order.
pub(super) fn in_order(scene: &Scene, blocks: &[(f64, u64)], repeat: u64) -> Scene {
    with_mission(scene, blocks, repeat, Order::InOrder)
}

/// The same, mixed.
pub(super) fn mixed(scene: &Scene, blocks: &[(f64, u64)], repeat: u64) -> Scene {
    with_mission(scene, blocks, repeat, Order::Mixed)
}
