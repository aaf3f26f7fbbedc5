//! Fields of a contact along a line, or of extruded bodies: both bodies as hexahedra between neighbouring sections, the whole ring or width
//! (`planes`). Sections of a ring are joined by straight edges: a ring of n stations on its half has a volume lower than the round one by (pi/(n - 1))^2/6, 0.6 % with 17.
//!
//! Vectors and stresses are those of space, as all programs expect that show them. Places are of single precision where that is fine enough.
//!
//! A triangle of the section becomes a wedge, written as a hexahedron with two edges of one point: VTK 9.7 turned the order of a wedge's
//! nodes around, so that either order has negative volumes in some program; this one has in none.

use solver::fields::{SectionFields, Stress, SurfaceFields, SweptFields};
use solver::mesh::columns::Cell;
use solver::record::LineFields;

use super::appended::{self, Array, Grid, Values};
use super::planes::{Plane, planes, shortest_gap};

/// Number of the cell type in VTK.
const HEXAHEDRON: u8 = 12;
/// Round-off of places over the shortest edge that is no concern.
const FINE: f64 = 1e-2;

/// Name and value of a component of the stress.
type Component = (&'static str, fn(&Stress) -> f64);

/// Content of the file of the fields at one position.
///
/// # Errors
/// The error of the compressor.
pub(super) fn bytes(fields: &LineFields) -> std::io::Result<Vec<u8>> {
    appended::file(&grid(fields))
}

/// The grid of both bodies.
fn grid(fields: &LineFields) -> Grid {
    let bodies = [&fields.bodies.slider, &fields.bodies.receptacle];
    let (planes, closed) = planes(fields.shape, &fields.at);
    let connectivity = connectivity(bodies, planes.len(), closed);
    let cells = connectivity.len() / 8;
    let ends = (1..=cells).map(|cell| number(8 * cell));
    let topology = vec![
        array("connectivity", 1, Values::I32(connectivity)),
        array("offsets", 1, Values::I32(ends.collect())),
        array("types", 1, Values::U8(vec![HEXAHEDRON; cells])),
    ];
    let points = points(bodies, &planes);
    let shortest = shortest_edge(bodies).min(shortest_gap(&planes));
    Grid {
        nodes: points.len() / 3,
        cells,
        points: array("Points", 3, places(points, shortest)),
        topology,
        point_data: point_data(bodies, &planes),
        cell_data: cell_data(bodies, &planes, closed),
    }
}

fn array(name: &'static str, components: usize, values: Values) -> Array {
    Array {
        name,
        components,
        values,
    }
}

/// A number of a node.
fn number(node: usize) -> i32 {
    i32::try_from(node).unwrap_or(i32::MAX)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "seven digits are beyond any tolerance"
)]
fn single(values: impl Iterator<Item = f64>) -> Values {
    Values::F32(values.map(|value| value as f32).collect())
}

/// Single precision with 16 binary digits, a relative error of 8e-6, which compresses by a quarter more: far below the error of a stress.
fn rounded(values: impl Iterator<Item = f64>) -> Values {
    let Values::F32(mut values) = single(values) else {
        return Values::F32(Vec::new());
    };
    for value in &mut values {
        // The sum may carry over into the exponent, which is then that of the next power of two.
        *value = f32::from_bits((value.to_bits() + 0x80) & !0xff);
    }
    Values::F32(values)
}

/// Every section of both bodies in its place.
fn sections<'a>(
    bodies: [&'a SweptFields; 2],
    planes: &'a [Plane],
) -> impl Iterator<Item = (&'a Plane, &'a SweptFields, &'a SectionFields)> {
    let placed = |body: &'a SweptFields| {
        let planes = planes.iter();
        planes.map(move |plane| (plane, body, &body.sections[plane.section]))
    };
    bodies.into_iter().flat_map(placed)
}

fn points(bodies: [&SweptFields; 2], planes: &[Plane]) -> Vec<f64> {
    sections(bodies, planes)
        .flat_map(|(plane, _, section)| section.nodes.iter().flat_map(|node| plane.place(*node)))
        .collect()
}

/// Places in single precision, if edges are far longer than its round-off.
fn places(points: Vec<f64>, shortest: f64) -> Values {
    let farthest = points.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if farthest * f64::from(f32::EPSILON) < FINE * shortest {
        single(points.into_iter())
    } else {
        Values::F64(points)
    }
}

/// Shortest edge of the elements along the contact surface, mm.
fn shortest_edge(bodies: [&SweptFields; 2]) -> f64 {
    let edges = bodies.into_iter().flat_map(|body| {
        let nodes = body.sections.first().map(|section| &section.nodes);
        let pairs = body.surface.windows(2);
        pairs.filter_map(move |pair| {
            let nodes = nodes?;
            let [from, to] = [nodes[pair[0]], nodes[pair[1]]];
            Some((to[0] - from[0]).hypot(to[1] - from[1]))
        })
    });
    edges.fold(f64::INFINITY, f64::min)
}

/// Nodes of all cells, eight each, those of a section before those of the next one.
fn connectivity(bodies: [&SweptFields; 2], planes: usize, closed: bool) -> Vec<i32> {
    let mut connectivity = Vec::new();
    let mut first = 0;
    for body in bodies {
        let nodes = body
            .sections
            .first()
            .map_or(0, |section| section.nodes.len());
        for plane in 0..joints(planes, closed) {
            let sides = [plane, (plane + 1) % planes].map(|plane| first + plane * nodes);
            for cell in &body.cells {
                let corners = match *cell {
                    Cell::Quad(corners) => corners,
                    Cell::Tri([a, b, c]) => [a, b, c, c],
                };
                for side in sides {
                    connectivity.extend(corners.map(|node| number(side + node)));
                }
            }
        }
        first += planes * nodes;
    }
    connectivity
}

/// Number of pairs of neighbouring sections.
fn joints(planes: usize, closed: bool) -> usize {
    if closed { planes } else { planes - 1 }
}

fn point_data(bodies: [&SweptFields; 2], planes: &[Plane]) -> Vec<Array> {
    let displacement = sections(bodies, planes).flat_map(|(plane, _, section)| {
        let displacements = section.displacement_mm.iter();
        displacements.flat_map(|u| plane.vector(*u))
    });
    let mut arrays = vec![array("displacement_mm", 3, single(displacement))];
    let components: [Component; 6] = [
        ("stress_xx_mpa", |s| s.xx),
        ("stress_yy_mpa", |s| s.yy),
        ("stress_zz_mpa", |s| s.zz),
        ("stress_xy_mpa", |s| s.xy),
        ("stress_xz_mpa", |s| s.xz),
        ("stress_yz_mpa", |s| s.yz),
    ];
    let stresses = |of: &dyn Fn(&Plane, &Stress) -> f64| {
        rounded(sections(bodies, planes).flat_map(|(plane, _, section)| {
            section.stress.iter().map(move |stress| of(plane, stress))
        }))
    };
    for (name, component) in components {
        let values = stresses(&|plane, stress| component(&plane.stress(stress)));
        arrays.push(array(name, 1, values));
    }
    arrays.extend([
        array(
            "von_mises_mpa",
            1,
            stresses(&|_, stress| stress.von_mises()),
        ),
        array(
            "largest_shear_mpa",
            1,
            stresses(&|_, stress| stress.largest_shear()),
        ),
    ]);
    let scalar =
        |of: fn(&SurfaceFields) -> f64| on_surface(bodies, planes, move |_, carried| [of(carried)]);
    let shear = on_surface(bodies, planes, |plane, carried| {
        plane.vector(carried.shear_mpa)
    });
    arrays.extend([
        array("worn_depth_mm", 1, scalar(|carried| carried.worn_depth_mm)),
        array(
            "contact_pressure_mpa",
            1,
            scalar(|carried| carried.pressure_mpa),
        ),
        array("contact_shear_mpa", 3, shear),
    ]);
    arrays
}

/// Values at the nodes of the contact surfaces; 0 at all others.
fn on_surface<const N: usize>(
    bodies: [&SweptFields; 2],
    planes: &[Plane],
    of: impl Fn(&Plane, &SurfaceFields) -> [f64; N],
) -> Values {
    let mut values = Vec::new();
    for (plane, body, section) in sections(bodies, planes) {
        let first = values.len();
        values.resize(first + N * section.nodes.len(), 0.0);
        for (node, carried) in body.surface.iter().zip(&section.surface_fields) {
            values[first + N * node..][..N].copy_from_slice(&of(plane, carried));
        }
    }
    single(values.into_iter())
}

/// The body of each cell, 0 of the slider and 1 of the receptacle, and the lower one of the qualities of its two sections.
fn cell_data(bodies: [&SweptFields; 2], planes: &[Plane], closed: bool) -> Vec<Array> {
    let joints = joints(planes.len(), closed);
    let marks = [0, 1].into_iter().zip(bodies);
    let body: Vec<u8> = marks
        .flat_map(|(mark, body)| vec![mark; joints * body.cells.len()])
        .collect();
    let quality = bodies.into_iter().flat_map(|body| {
        (0..joints).flat_map(move |joint| {
            let pair = [joint, (joint + 1) % planes.len()];
            let [one, other] = pair.map(|plane| &body.sections[planes[plane].section].quality);
            one.iter().zip(other).map(|(one, other)| one.min(*other))
        })
    });
    vec![
        array("body", 1, Values::U8(body)),
        array("quality", 1, single(quality)),
    ]
}

#[cfg(test)]
mod tests;
