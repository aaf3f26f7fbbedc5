//! Tractions on the contact surfaces of a section.

use crate::along_line::Along;
use crate::condensation::Operators;
use crate::contact::{self, ContactState};
use crate::mesh::ColumnMesh;
use crate::model::Interface;
use crate::scene::{LineShape, RingMotion};
use crate::schedule::increments::Position;
use crate::sides::{Side, Sides};

/// Wear and tractions at a place of a contact surface.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SurfaceFields {
    /// Vertical worn depth, mm.
    pub worn_depth_mm: f64,
    /// Contact pressure, MPa.
    pub pressure_mpa: f64,
    /// Shear traction on the body, MPa.
    pub shear_mpa: [f64; 3],
}

/// Nodes of a mesh on the contact surface of its body.
pub(super) struct SurfaceNodes {
    /// Their numbers in the mesh.
    pub(super) nodes: Vec<usize>,
    /// Their numbers among the contact nodes of the body.
    pub(super) contact: Vec<usize>,
}

impl SurfaceNodes {
    /// Nodes of a mesh on some spines of its body, whose contact surface has the spines from the first to the end.
    pub(super) fn of(mesh: &ColumnMesh, spines: &[usize], (first, end): (usize, usize)) -> Self {
        let spines = spines.iter().enumerate();
        let (nodes, contact) = spines
            .filter(|(_, spine)| (first..end).contains(spine))
            .map(|(i, spine)| (mesh.surface_node(i), spine - first))
            .unzip();
        Self { nodes, contact }
    }
}

/// Friction along the line of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrictionAlong<'a> {
    /// Sign of the slider's slip along the line; 0 without one.
    pub(super) direction: f64,
    /// Coefficients at the nodes from the first in contact to the last, -.
    pub(super) coefficients: &'a [f64],
}

impl FrictionAlong<'_> {
    /// Shear along the line at a node of a contact, MPa: what the limit of friction leaves beside the shear across it.
    fn shear(self, contact: &ContactState, node: usize) -> f64 {
        let (first, _) = contact.active_range().unwrap_or_default();
        let friction = node
            .checked_sub(first)
            .and_then(|i| self.coefficients.get(i));
        let limit = friction.map_or(0.0, |friction| friction * contact.pressure[node]);
        let across = contact.shear[node];
        self.direction * (limit * limit - across * across).max(0.0).sqrt()
    }
}

/// Sign of the slider's slip along the line, to larger angles: it moves to the right, or turns to larger angles, but for its way to the left.
pub(super) fn slip_sign(shape: LineShape, at: Along, position: Position) -> f64 {
    let to_the_right = match position {
        Position::Neutral | Position::Rightmost => 1.0,
        Position::Leftmost => -1.0,
    };
    match (shape, at) {
        (
            LineShape::Ring {
                motion: RingMotion::Torsion,
                ..
            },
            _,
        ) => to_the_right,
        // The tangent points against the motion from 0 to 180 degrees; there is no slip along it at either end.
        (LineShape::Ring { .. }, Along::AngleDeg(theta)) if theta > 0.0 && theta < 180.0 => {
            -to_the_right
        }
        _ => 0.0,
    }
}

/// Wear and tractions at the contact nodes of both bodies. Those of the slave are known; the master's are interpolated between them.
pub(super) fn surface_fields(
    operators: &Operators,
    interface: &Interface,
    depth: &Sides<Vec<f64>>,
    contact: &ContactState,
    along: Option<FrictionAlong<'_>>,
) -> Sides<Vec<SurfaceFields>> {
    // Places on the receptacle.
    let x = Sides::from_fn(|side| {
        let shift = match side {
            Side::Slider => contact.pairing_x,
            Side::Receptacle => 0.0,
        };
        let x = operators.of(side).x.iter();
        x.map(|x| x + shift).collect::<Vec<_>>()
    });
    // Normals are those of the receptacle.
    let slopes = contact::slopes(&operators.receptacle, &depth.receptacle, Side::Receptacle);
    let of_slave = x.of(interface.slave).iter().enumerate().map(|(i, &at)| {
        let (pressure, across) = (contact.pressure[i], contact.shear[i]);
        let along = along.map_or(0.0, |along| along.shear(contact, i));
        let slope = interpolated(&x.receptacle, at, |j| slopes[j]);
        let length = slope.hypot(1.0);
        [pressure, across / length, across * slope / length, along]
    });
    let of_slave: Vec<[f64; 4]> = of_slave.collect();
    Sides::from_fn(|side| {
        let sign = match side {
            Side::Slider => -1.0,
            Side::Receptacle => 1.0,
        };
        let places = x.of(side).iter().zip(depth.of(side)).enumerate();
        places
            .map(|(i, (&at, &worn_depth_mm))| {
                let [pressure_mpa, shear @ ..] = if side == interface.slave {
                    of_slave[i]
                } else {
                    let value =
                        |k: usize| interpolated(x.of(interface.slave), at, |j| of_slave[j][k]);
                    std::array::from_fn(value)
                };
                SurfaceFields {
                    worn_depth_mm,
                    pressure_mpa,
                    shear_mpa: shear.map(|q| sign * q),
                }
            })
            .collect()
    })
}

/// Value at a place between nodes at ascending x; 0 beyond the ends.
fn interpolated(x: &[f64], at: f64, value: impl Fn(usize) -> f64) -> f64 {
    let right = x.partition_point(|&x| x < at);
    match (right.checked_sub(1), x.get(right)) {
        (_, Some(&x)) if x <= at => value(right),
        (Some(left), Some(_)) => {
            let share = (at - x[left]) / (x[right] - x[left]);
            (1.0 - share) * value(left) + share * value(right)
        }
        _ => 0.0,
    }
}
