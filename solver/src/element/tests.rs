//! One list of properties, every element.

use super::*;
use crate::scene::Elastic;

fn check_properties<E: Element<N>, const N: usize>() {
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
            for d in 0..2 {
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
fn energy<const N: usize>(
    nodes: &[[f64; 2]; N],
    k: &[[Matrix2<f64>; N]; N],
    field: &dyn Fn([f64; 2]) -> [f64; 2],
) -> f64 {
    let u = nodes.map(|node| nalgebra::Vector2::from(field(node)));
    let mut sum = 0.0;
    for a in 0..N {
        for b in 0..N {
            sum += (u[a].transpose() * k[a][b] * u[b])[(0, 0)];
        }
    }
    sum
}

/// A linear displacement field gives forces that do the work of its constant stress, and a rigid motion none.
fn check_stiffness<const N: usize>(
    nodes: [[f64; 2]; N],
    area: f64,
    k: Option<[[Matrix2<f64>; N]; N]>,
) {
    let lame = Lame::from(STEEL);
    let k = k.expect("the element is not inverted");
    let energy = |field: &dyn Fn([f64; 2]) -> [f64; 2]| energy(&nodes, &k, field);
    let stretch = energy(&|x| [1e-3 * x[0], 0.0]);
    let expected = (lame.lambda + 2.0 * lame.mu) * 1e-6 * area;
    assert!(
        (stretch - expected).abs() < 1e-12 * expected,
        "{stretch} {expected}"
    );
    let shear = energy(&|x| [1e-3 * x[1], 0.0]);
    assert!((shear - lame.mu * 1e-6 * area).abs() < 1e-12 * expected);
    let rotation = energy(&|x| [-1e-3 * x[1] + 1.0, 1e-3 * x[0] - 2.0]);
    assert!(rotation.abs() < 1e-9 * expected.max(200e3));
}

#[test]
fn quad4_is_an_element() {
    check_properties::<Quad4, 4>();
    let nodes = [[0.0, 0.0], [2.0, 0.1], [2.2, 1.3], [-0.1, 1.0]];
    let area = 0.5 * ((2.2 - 0.0) * (1.0 - 0.1) - (-0.1 - 2.0) * (1.3 - 0.0));
    let lame = Lame::from(STEEL);
    for b_bar in [false, true] {
        check_stiffness(nodes, area, stiffness::<Quad4, 4>(&nodes, lame, b_bar));
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
    let bilinear = stiffness::<Quad4, 4>(&nodes, lame, false).expect("the same element");
    assert!(energy(&nodes, &bilinear, &bent) > 36.0 * expected);
}

#[test]
fn tri3_is_an_element() {
    check_properties::<Tri3, 3>();
    let nodes = [[0.0, 0.0], [2.0, 0.0], [0.5, 1.5]];
    let k = stiffness::<Tri3, 3>(&nodes, Lame::from(STEEL), false);
    check_stiffness(nodes, 1.5, k);
}

#[test]
fn an_inverted_element_has_no_stiffness() {
    let nodes = [[0.0, 0.0], [0.5, 1.5], [2.0, 0.0]];
    assert!(stiffness::<Tri3, 3>(&nodes, Lame::from(STEEL), false).is_none());
}
