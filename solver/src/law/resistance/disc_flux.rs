//! Flux functions of a disc, f_m = (1 - r^2)^(m - 1/2), and the integrals of their Hankel transforms
//!   F_m = (2 m - 1)!! j_m(z)/z^m,  F_m(0) = 1/(2 m + 1),
//! j_m the spherical Bessel functions. The integral of g F_m F_n over z, g smooth on the scale of z itself, is a sum over nodes z_k with
//! weights, the integrals of Lagrange's polynomials times F_m F_n: the weights do not depend on g and are computed once. Panels double in
//! length. The g of layers have their poles at Re z <= 0, so that the interpolation converges by at least (3 + sqrt 8)^-1 a node.

use std::f64::consts::PI;
use std::sync::LazyLock;

use nalgebra::{SMatrix, SVector};

/// Flux functions: the references of ten times and a tenth of the resistivity are met in all digits.
pub(super) const FUNCTIONS: usize = 10;
const ENTRIES: usize = FUNCTIONS * FUNCTIONS;

/// Nodes of a panel: 5.83^-10 = 2e-8 of what the layers change.
const NODES: usize = 10;
/// The first panel ends here: layers of up to 1e5 radii show at smaller z only.
const BEGIN: f64 = 1e-5;
/// Panels that double in length, to z = 1e6: layers down to 1e-6 radii.
const PANELS: u32 = 37;
/// From here on only F_0^2 is left, by its mean 1/(2 z^2): the other products are smaller by 1/z.
const MEAN_FROM: f64 = 1_000.0;
/// From here on j_m follows from its recurrence, which is stable beyond its order; before by its series.
const SERIES_TO: f64 = 12.0;
/// Gauss-Legendre rule of four points on pieces of a panel, at most half a unit long and no fewer than these.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
];
const LONGEST_PIECE: f64 = 0.5;
const FEWEST_PIECES: usize = 8;

type Functions = SVector<f64, FUNCTIONS>;

/// A node of the integration with the weights of all products F_m F_n.
pub(super) struct Node {
    pub(super) z: f64,
    pub(super) weights: [f64; ENTRIES],
}

/// Integrals that do not depend on the conductors.
pub(super) struct Integrals {
    pub(super) nodes: Vec<Node>,
    /// Integrals of F_m F_n alone: A of one material of resistivity 1.
    pub(super) uniform: SMatrix<f64, FUNCTIONS, FUNCTIONS>,
    /// F_m(0).
    pub(super) at_zero: Functions,
}

static INTEGRALS: LazyLock<Integrals> = LazyLock::new(integrate);

/// The integrals, computed by the first call.
pub(super) fn integrals() -> &'static Integrals {
    &INTEGRALS
}

fn integrate() -> Integrals {
    let mut nodes = panel(0.0, BEGIN);
    let mut begin = BEGIN;
    for _ in 0..PANELS {
        nodes.extend(panel(begin, 2.0 * begin));
        begin *= 2.0;
    }
    let at_zero = transforms(0.0);
    let mut uniform = SMatrix::<f64, FUNCTIONS, FUNCTIONS>::zeros();
    for node in &nodes {
        let entries = uniform.as_mut_slice().iter_mut();
        entries
            .zip(&node.weights)
            .for_each(|(entry, weight)| *entry += weight);
    }
    // The potential of f_0 on a half-space is pi/2 all over the disc.
    for m in 0..FUNCTIONS {
        let known = 0.5 * PI * at_zero[m];
        uniform[(0, m)] = known;
        uniform[(m, 0)] = known;
    }
    Integrals {
        nodes,
        uniform,
        at_zero,
    }
}

/// The nodes of a panel with their weights.
fn panel(begin: f64, end: f64) -> Vec<Node> {
    let (middle, half) = (0.5 * (begin + end), 0.5 * (end - begin));
    let places: [f64; NODES] = std::array::from_fn(chebyshev);
    let mut weights = vec![[0.0; ENTRIES]; NODES];
    let pieces = FEWEST_PIECES.max(crate::number::count_at_least((end - begin) / LONGEST_PIECE));
    let pieces = if begin < MEAN_FROM {
        pieces
    } else {
        FEWEST_PIECES
    };
    let length = 2.0 / crate::number::real(pieces);
    for piece in 0..pieces {
        let centre = -1.0 + (crate::number::real(piece) + 0.5) * length;
        for (at, weight) in GAUSS {
            let t = centre + 0.5 * length * at;
            let products = products(middle + half * t);
            let weight = 0.5 * length * half * weight;
            for (node, weights) in weights.iter_mut().enumerate() {
                let polynomial = weight * lagrange(&places, node, t);
                let entries = weights.iter_mut().zip(&products);
                entries.for_each(|(entry, product)| *entry += polynomial * product);
            }
        }
    }
    let nodes = places.into_iter().zip(weights);
    nodes
        .map(|(t, weights)| Node {
            z: middle + half * t,
            weights,
        })
        .collect()
}

/// Chebyshev's nodes of the interval from -1 to 1.
fn chebyshev(node: usize) -> f64 {
    let angle = PI * (crate::number::real(node) + 0.5) / crate::number::real(NODES);
    angle.cos()
}

/// Lagrange's polynomial of a node at t.
fn lagrange(places: &[f64; NODES], node: usize, t: f64) -> f64 {
    let others = places
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != node);
    others.fold(1.0, |product, (_, place)| {
        product * (t - place) / (places[node] - place)
    })
}

/// F_m F_n at z, by columns; beyond `MEAN_FROM` their means over a period.
fn products(z: f64) -> [f64; ENTRIES] {
    let mut products = [0.0; ENTRIES];
    if z >= MEAN_FROM {
        products[0] = 0.5 / (z * z);
        return products;
    }
    let values = transforms(z);
    let of_columns = products.chunks_exact_mut(FUNCTIONS);
    for (column, right) in of_columns.zip(values.iter()) {
        for (entry, left) in column.iter_mut().zip(values.iter()) {
            *entry = left * right;
        }
    }
    products
}

/// F_m at z.
fn transforms(z: f64) -> Functions {
    if z < SERIES_TO {
        SVector::from_fn(|m, _| series(m, z))
    } else {
        recurrence(z)
    }
}

/// F_m = sum over k of (-z^2/2)^k (2 m - 1)!!/(k! (2 m + 2 k + 1)!!).
fn series(order: usize, z: f64) -> f64 {
    let order = crate::number::real(order);
    let mut term = 1.0 / (2.0 * order + 1.0);
    let (mut sum, mut k) = (term, 1.0);
    while term.abs() > 1e-18 {
        term *= -0.5 * z * z / (k * (2.0 * order + 2.0 * k + 1.0));
        sum += term;
        k += 1.0;
    }
    sum
}

/// F_m by j_(m+1) = (2 m + 1)/z j_m - j_(m-1).
fn recurrence(z: f64) -> Functions {
    let mut values = SVector::zeros();
    let (mut before, mut bessel) = (z.cos() / z, z.sin() / z);
    let (mut factor, mut odd) = (1.0, 1.0);
    for m in 0..FUNCTIONS {
        values[m] = factor * bessel;
        let next = odd / z * bessel - before;
        (before, bessel) = (bessel, next);
        // (2 m + 1)!!/z^(m + 1) of the next one.
        factor *= odd / z;
        odd += 2.0;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_the_same_by_series_and_recurrence() {
        let by_recurrence = recurrence(SERIES_TO);
        for m in 0..FUNCTIONS {
            let apart = series(m, SERIES_TO) - by_recurrence[m];
            assert!(apart.abs() < 1e-10, "{m}: {apart}");
        }
        assert!((transforms(0.0)[3] - 1.0 / 7.0).abs() < 1e-15);
    }

    #[test]
    fn integrals_of_the_transforms_are_those_of_the_closed_forms() {
        // The integral of F_0 F_m is pi/2 F_m(0), which the nodes give too, beyond the last panel but for 1/(2 z).
        let sum = |m: usize| -> f64 {
            let nodes = integrals().nodes.iter();
            nodes.map(|node| node.weights[m]).sum()
        };
        for m in 0..FUNCTIONS {
            let apart = sum(m) / (0.5 * PI * integrals().at_zero[m]) - 1.0;
            assert!(apart.abs() < 1e-6, "{m}: {apart}");
        }
        // The integral of F_1^2 = j_1^2/z^2 is pi/15.
        let square = integrals().uniform[(1, 1)];
        assert!((square - PI / 15.0).abs() < 1e-9, "{square}");
    }
}
