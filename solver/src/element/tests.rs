//! One list of properties, every element.

use super::*;
use crate::scene::Elastic;

fn check_properties<E: Element<N, D>, const N: usize, const D: usize>() {
    for (a, corner) in E::CORNERS.iter().enumerate() {
        for (b, n) in E::shape(*corner).iter().enumerate() {
            let expected = if a == b { 1.0 } else { 0.0 };
            assert!((n - expected).abs() < 1e-14, "nodal value {a} {b}");
        }
    }
    for &(xi, _) in E::QUADRATURE {
        let sum: f64 = E::shape(xi).iter().sum();
        assert!((sum - 1.0).abs() < 1e-14, "partition of unity");
        for (a, g) in E::gradient(xi).iter().enumerate() {
            for d in 0..D {
                let step = 1e-6;
                let (mut left, mut right) = (xi, xi);
                left[d] -= step;
                right[d] += step;
                let central = (E::shape(right)[a] - E::shape(left)[a]) / (2.0 * step);
                assert!((g[d] - central).abs() < 1e-9, "gradient {a} {d}");
            }
        }
    }
}

const STEEL: Elastic = Elastic {
    youngs_modulus_mpa: 200e3,
    poisson_ratio: 0.3,
};

/// Twice the strain energy of a displacement field.
fn energy<const N: usize, const D: usize>(
    nodes: &[[f64; D]; N],
    k: &Stiffness<N, D>,
    field: &dyn Fn([f64; D]) -> [f64; D],
) -> f64 {
    let u = nodes.map(field);
    let forces = forces(k, &u);
    u.iter().zip(&forces).map(|(u, f)| dot(u, f)).sum()
}

/// Nodal forces under nodal displacements.
fn forces<const N: usize, const D: usize>(k: &Stiffness<N, D>, u: &[[f64; D]; N]) -> [[f64; D]; N] {
    std::array::from_fn(|a| {
        std::array::from_fn(|i| {
            let terms = (0..N).flat_map(|b| (0..D).map(move |j| (b, j)));
            terms.map(|(b, j)| k[a][b][(i, j)] * u[b][j]).sum()
        })
    })
}

/// A linear displacement field gives forces that do the work of its constant stress, and a rigid motion none.
fn check_stiffness<const N: usize, const D: usize>(
    nodes: [[f64; D]; N],
    volume: f64,
    k: Option<Stiffness<N, D>>,
) {
    let lame = Lame::from(STEEL);
    let k = k.expect("the element is not inverted");
    let energy = |field: &dyn Fn([f64; D]) -> [f64; D]| energy(&nodes, &k, field);
    let stretched = (lame.lambda + 2.0 * lame.mu) * 1e-6 * volume;
    let along = |i: usize, value: f64| {
        let mut u = [0.0; D];
        u[i] = value;
        u
    };
    for i in 0..D {
        let stretch = energy(&|x| along(i, 1e-3 * x[i]));
        assert!((stretch / stretched - 1.0).abs() < 1e-12, "{stretch}");
        for j in (0..D).filter(|j| *j != i) {
            let shear = energy(&|x| along(i, 1e-3 * x[j]));
            let expected = lame.mu * 1e-6 * volume;
            assert!((shear - expected).abs() < 1e-12 * stretched, "{i} {j}");
            let rotation = energy(&|x| {
                let mut u = along(i, -1e-3 * x[j] + 1.0);
                u[j] = 1e-3 * x[i] - 2.0;
                u
            });
            assert!(rotation.abs() < 1e-9 * stretched.max(200e3), "{rotation}");
        }
    }
}

#[test]
fn quad4_is_an_element() {
    check_properties::<Quad4, 4, 2>();
    let nodes = [[0.0, 0.0], [2.0, 0.1], [2.2, 1.3], [-0.1, 1.0]];
    let area = 0.5 * ((2.2 - 0.0) * (1.0 - 0.1) - (-0.1 - 2.0) * (1.3 - 0.0));
    let lame = Lame::from(STEEL);
    for b_bar in [false, true] {
        check_stiffness(nodes, area, stiffness::<Quad4, 4, 2>(&nodes, lame, b_bar));
        check_stiffness(nodes, area, quad_stiffness(&nodes, lame, b_bar));
    }
}

/// A flat rectangle bends by E/(1 - nu^2) I kappa^2 L; without the modes its shear would make it 36 times as stiff.
#[test]
fn a_quadrilateral_with_incompatible_modes_bends_like_a_beam() {
    let (length, height, curvature) = (2.0, 0.2, 1e-3);
    let (x, y) = (0.5 * length, 0.5 * height);
    let nodes = [[-x, -y], [x, -y], [x, y], [-x, y]];
    let lame = Lame::from(STEEL);
    let bent = |x: [f64; 2]| [curvature * x[0] * x[1], 0.0];
    let inertia = height * height * height / 12.0;
    let expected = 200e3 / (1.0 - 0.3 * 0.3) * inertia * curvature * curvature * length;
    let k = quad_stiffness(&nodes, lame, false).expect("the element is not inverted");
    let found = energy(&nodes, &k, &bent);
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    let bilinear = stiffness::<Quad4, 4, 2>(&nodes, lame, false).expect("the same element");
    assert!(energy(&nodes, &bilinear, &bent) > 36.0 * expected);
}

#[test]
fn tri3_is_an_element() {
    check_properties::<Tri3, 3, 2>();
    let nodes = [[0.0, 0.0], [2.0, 0.0], [0.5, 1.5]];
    let k = stiffness::<Tri3, 3, 2>(&nodes, Lame::from(STEEL), false);
    check_stiffness(nodes, 1.5, k);
}

/// The volume by the element's own quadrature.
fn volume<E: Element<N, 3>, const N: usize>(nodes: &[[f64; 3]; N]) -> f64 {
    let points = E::QUADRATURE.iter();
    let dv = points.map(|(xi, weight)| {
        let (_, det) = physical_gradient(nodes, &E::gradient(*xi)).expect("not inverted");
        weight * det
    });
    dv.sum()
}

#[test]
fn hex8_is_an_element() {
    check_properties::<Hex8, 8, 3>();
    let mut nodes = Hex8::CORNERS;
    assert!((volume::<Hex8, 8>(&nodes) - 8.0).abs() < 1e-14);
    nodes[1] = [1.2, -0.9, -1.1];
    nodes[6] = [0.9, 1.3, 1.2];
    nodes[7][1] = 0.8;
    let lame = Lame::from(STEEL);
    let volume = volume::<Hex8, 8>(&nodes);
    for b_bar in [false, true] {
        check_stiffness(nodes, volume, stiffness::<Hex8, 8, 3>(&nodes, lame, b_bar));
        check_stiffness(nodes, volume, hex_stiffness(&nodes, lame, b_bar));
    }
}

#[test]
fn wedge6_is_an_element() {
    check_properties::<Wedge6, 6, 3>();
    let mut nodes = Wedge6::CORNERS;
    assert!((volume::<Wedge6, 6>(&nodes) - 1.0).abs() < 1e-14);
    nodes[1] = [1.2, -0.1, -1.1];
    nodes[5] = [0.1, 1.3, 1.2];
    let volume = volume::<Wedge6, 6>(&nodes);
    let k = stiffness::<Wedge6, 6, 3>(&nodes, Lame::from(STEEL), false);
    check_stiffness(nodes, volume, k);
}

/// A bar of a rectangular section bends by E I kappa^2 L about either axis of its section, with the anticlastic curvature nu kappa of its
/// section: here without it, by E/(1 - nu^2).
#[test]
fn a_hexahedron_with_incompatible_modes_bends_like_a_plate() {
    let (half, curvature) = ([1.0, 0.1, 0.7], 1e-3);
    let nodes = Hex8::CORNERS.map(|c| std::array::from_fn(|i| c[i] * half[i]));
    let k = hex_stiffness(&nodes, Lame::from(STEEL), false).expect("not inverted");
    let rigidity = 200e3 / (1.0 - 0.3 * 0.3) * 2.0 / 3.0 * half[1] * half[1] * half[1];
    let area = 4.0 * half[0] * half[2];
    let expected = rigidity * curvature * curvature * area;
    for axis in [0, 2] {
        let found = energy(&nodes, &k, &|x| {
            let mut u = [0.0; 3];
            u[axis] = curvature * x[axis] * x[1];
            u
        });
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
    let both = energy(&nodes, &k, &|x| {
        [curvature * x[0] * x[1], 0.0, -0.3 * curvature * x[2] * x[1]]
    });
    let bar = 200e3 * 2.0 / 3.0 * half[1] * half[1] * half[1] * curvature * curvature * area;
    assert!((both / bar - 1.0).abs() < 1e-12, "{both} {bar}");
}

/// Prisms over plane elements, with the same displacements at both ends and none along them, have the forces of the plane elements
/// times half of their length at either end.
#[test]
fn prisms_held_along_their_axis_are_the_plane_elements() {
    let lame = Lame::from(STEEL);
    let length = 0.37;
    let quad = [[0.0, 0.0], [2.0, 0.1], [2.2, 1.3], [-0.1, 1.0]];
    let moved = [[0.2, -0.1], [0.4, 0.3], [-0.5, 0.7], [0.1, 0.9]];
    let hex = std::array::from_fn(|a| extruded(quad[a % 4], length * crate::number::real(a / 4)));
    for b_bar in [false, true] {
        let plane = quad_stiffness(&quad, lame, b_bar).expect("not inverted");
        let solid = hex_stiffness(&hex, lame, b_bar).expect("not inverted");
        let solid = forces(
            &solid,
            &std::array::from_fn(|a| extruded(moved[a % 4], 0.0)),
        );
        check_prism(&forces(&plane, &moved), &solid, length);
    }
    let (tri, moved) = ([quad[0], quad[1], quad[2]], [moved[0], moved[1], moved[2]]);
    let wedge = std::array::from_fn(|a| extruded(tri[a % 3], length * crate::number::real(a / 3)));
    let plane = stiffness::<Tri3, 3, 2>(&tri, lame, false).expect("not inverted");
    let solid = stiffness::<Wedge6, 6, 3>(&wedge, lame, false).expect("not inverted");
    let solid = forces(
        &solid,
        &std::array::from_fn(|a| extruded(moved[a % 3], 0.0)),
    );
    check_prism(&forces(&plane, &moved), &solid, length);
}

fn extruded([x, y]: [f64; 2], z: f64) -> [f64; 3] {
    [x, y, z]
}

fn check_prism<const N: usize>(plane: &[[f64; 2]; N], solid: &[[f64; 3]], length: f64) {
    for (a, solid) in solid.iter().enumerate() {
        for (plane, solid) in plane[a % N].iter().zip(solid) {
            let expected = 0.5 * length * plane;
            assert!((solid - expected).abs() < 1e-9 * 200e3, "{a}");
        }
    }
}

/// Eight distorted hexahedra around one node, or two wedges in place of each: a linear field leaves no force on the node inside.
#[test]
fn a_patch_of_solids_carries_a_constant_stress() {
    let at = |i: [usize; 3]| -> [f64; 3] {
        let inside = i == [1; 3];
        let shift = [0.23, -0.17, 0.31];
        std::array::from_fn(|d| {
            let bulge = 0.07 * f64::from(u8::from(i[(d + 1) % 3] == 1 && i[d] != 1));
            crate::number::real(i[d]) + bulge + if inside { shift[d] } else { 0.0 }
        })
    };
    let field = |x: [f64; 3]| {
        [
            1e-3 * x[0] + 4e-4 * x[2],
            -2e-3 * x[1] + 3e-4 * x[0],
            5e-4 * x[2] - 7e-4 * x[1],
        ]
    };
    let lame = Lame::from(STEEL);
    let (mut on_hexes, mut on_wedges) = ([0.0; 3], [0.0; 3]);
    for cell in 0..8 {
        let origin = [cell % 2, cell / 2 % 2, cell / 4];
        let corner = |a: usize| {
            let c = Hex8::CORNERS[a];
            std::array::from_fn(|d| origin[d] + usize::from(c[d] > 0.0))
        };
        let ids: [[usize; 3]; 8] = std::array::from_fn(corner);
        let hex = ids.map(at);
        for b_bar in [false, true] {
            let k = hex_stiffness(&hex, lame, b_bar).expect("not inverted");
            add_inside(&mut on_hexes, &ids, &forces(&k, &hex.map(field)));
        }
        for half in [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]] {
            let ids = half.map(|a| ids[a]);
            let wedge = ids.map(at);
            let k = stiffness::<Wedge6, 6, 3>(&wedge, lame, false).expect("not inverted");
            add_inside(&mut on_wedges, &ids, &forces(&k, &wedge.map(field)));
        }
    }
    for force in [on_hexes, on_wedges] {
        assert!(force.iter().all(|f| f.abs() < 1e-11 * 200e3), "{force:?}");
    }
}

fn add_inside(sum: &mut [f64; 3], ids: &[[usize; 3]], forces: &[[f64; 3]]) {
    for (_, force) in ids.iter().zip(forces).filter(|(id, _)| **id == [1; 3]) {
        for (sum, f) in sum.iter_mut().zip(force) {
            *sum += f;
        }
    }
}

#[test]
fn an_inverted_element_has_no_stiffness() {
    let nodes = [[0.0, 0.0], [0.5, 1.5], [2.0, 0.0]];
    assert!(stiffness::<Tri3, 3, 2>(&nodes, Lame::from(STEEL), false).is_none());
    let mut nodes = Hex8::CORNERS;
    nodes.swap(0, 4);
    assert!(hex_stiffness(&nodes, Lame::from(STEEL), false).is_none());
}
