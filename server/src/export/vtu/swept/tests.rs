use std::f64::consts::{PI, TAU};

use solver::along_line::Along;
use solver::element::{Element, Hex8, physical_gradient};
use solver::record::Position;
use solver::scene::{LineShape, RingMotion};
use solver::sides::Sides;

use super::*;
use crate::number::real;

/// Half the width and the height of the sections of both bodies, mm.
const HALF: f64 = 0.05;
const HEIGHT: f64 = 0.2;
const RADIUS: f64 = 0.5;

/// Two bodies of a quadrilateral and two triangles in each section, the receptacle below y = 0, the slider above.
fn fields(shape: LineShape, at: Vec<Along>) -> LineFields {
    let body = |bottom: f64| {
        let top = bottom + HEIGHT;
        let below = [-HALF, 0.0, HALF].map(|x| [x, bottom]);
        let above = [-HALF, 0.0, HALF].map(|x| [x, top]);
        let section = SectionFields {
            nodes: below.into_iter().chain(above).collect(),
            displacement_mm: vec![[0.0; 3]; 6],
            stress: vec![Stress::default(); 6],
            quality: vec![1.0; 3],
            surface_fields: vec![SurfaceFields::default(); 3],
        };
        SweptFields {
            cells: vec![
                Cell::Quad([0, 1, 4, 3]),
                Cell::Tri([1, 2, 4]),
                Cell::Tri([2, 5, 4]),
            ],
            surface: vec![3, 4, 5],
            sections: vec![section; at.len()],
        }
    };
    LineFields {
        position: Position::Neutral,
        shape,
        bodies: Sides {
            slider: body(0.0),
            receptacle: body(-HEIGHT),
        },
        at,
    }
}

fn ring(stations: usize) -> LineFields {
    let step = 180.0 / real(stations - 1);
    let at = (0..stations).map(|station| Along::AngleDeg(step * real(station)));
    fields(
        LineShape::Ring {
            radius_mm: RADIUS,
            motion: RingMotion::InPlane,
        },
        at.collect(),
    )
}

/// Determinants of the Jacobian of all cells at the quadrature points of the hexahedron, which sum to the volume.
fn determinants(grid: &Grid) -> Vec<f64> {
    let places: Vec<f64> = match &grid.points.values {
        Values::F32(values) => values.iter().map(|x| f64::from(*x)).collect(),
        Values::F64(values) => values.clone(),
        other => panic!("{other:?}"),
    };
    let Values::I32(nodes) = &grid.topology[0].values else {
        panic!("nodes are whole numbers");
    };
    let (cells, rest) = nodes.as_chunks::<8>();
    assert!(rest.is_empty());
    let corners = cells.iter().map(|cell| {
        cell.map(|node| {
            let first = 3 * usize::try_from(node).expect("a number");
            [places[first], places[first + 1], places[first + 2]]
        })
    });
    let determinants = corners.flat_map(|corners| {
        Hex8::QUADRATURE.iter().map(move |(at, weight)| {
            let found = physical_gradient(&corners, &Hex8::gradient(*at));
            let (_, determinant) = found.expect("a cell is not inverted");
            determinant * weight
        })
    });
    determinants.collect()
}

/// By Pappus' theorem, less what the straight edges cut off.
#[test]
fn a_ring_has_the_volume_of_its_sections_on_straight_edges_and_no_inverted_cell() {
    let area = 2.0 * (2.0 * HALF * HEIGHT);
    for stations in [5, 17] {
        let fields = ring(stations);
        let found = determinants(&grid(&fields));
        assert!(found.iter().all(|determinant| *determinant > 0.0));
        let volume: f64 = found.iter().sum();
        let step = PI / real(stations - 1);
        let expected = TAU * RADIUS * area * step.sin() / step;
        assert!(
            (volume / expected - 1.0).abs() < 1e-5,
            "{volume} {expected}"
        );
        let lost = 1.0 - volume / (TAU * RADIUS * area);
        assert!((lost / (step * step / 6.0) - 1.0).abs() < 0.05, "{lost}");
    }
}

/// Two alike sections stand for all: within 1e-3 of Pappus' volume times what 64 straight edges leave.
#[test]
fn a_ring_of_two_sections_is_round() {
    let found = determinants(&grid(&ring(2)));
    assert!(found.iter().all(|determinant| *determinant > 0.0));
    let expected = TAU * RADIUS * 4.0 * HALF * HEIGHT;
    assert!((found.iter().sum::<f64>() / expected - 1.0).abs() < 2e-3);
}

#[test]
fn half_a_straight_line_is_mirrored() {
    let shape = LineShape::Straight {
        width_mm: 0.8,
        crown_radius_mm: Some(10.0),
        tilt_mrad: 0.0,
    };
    let at = [0.0, 0.1, 0.4].map(Along::DistanceMm);
    let grid = grid(&fields(shape, at.to_vec()));
    let found = determinants(&grid);
    assert!(found.iter().all(|determinant| *determinant > 0.0));
    let expected = 0.8 * 4.0 * HALF * HEIGHT;
    assert!((found.iter().sum::<f64>() / expected - 1.0).abs() < 1e-5);
    assert_eq!((grid.nodes, grid.cells), (2 * 5 * 6, 2 * 4 * 3));
}
