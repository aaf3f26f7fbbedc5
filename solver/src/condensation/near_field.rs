//! Near field of a condensed surface: the tangential response of nodes close to a force.
//!
//! On a half-plane a tangential force moves the surface tangentially as a normal one moves it normally (Johnson 1985,
//! section 2.3). Quadrilaterals keep this some elements away from the force. Between its node and the next, steel moves
//! by 5.0 nm along the surface and by 7.2 nm across it for 1 N/mm (4.0 nm on a half-plane), whatever the element's
//! size. Where p and q are singular, at the edge of a stick zone beside a worn slip zone, this makes q/p at the last
//! node 20 % too large on any mesh, and the edge wears back until the stick zone has that margin. The near field along
//! the surface is therefore that across it.

use super::Compliance;

/// Nodes from the force to where both responses agree. Arbitrary: with 4, 8 and 16 the edge of the stick zone is the
/// same node (`solver/tests/verify_stick_zone.rs`), without it two nodes further in at 2 %.
pub(super) const REACH: usize = 8;

/// Replaces the tangential response of near nodes by the normal one, plus the difference of both at the same place
/// between nodes that are [`REACH`] apart. The response to a uniform shear stays as it is, which keeps the patch test
/// exact.
pub(super) fn equalise(compliance: &mut Compliance, widths: &[f64]) {
    let n = widths.len();
    let mut uniform = vec![0.0; n];
    for i in 0..n {
        for j in i..n.min(i + REACH) {
            let outward = (REACH - (j - i)).div_ceil(2);
            let (Some(left), right) = (i.checked_sub(outward), j + outward) else {
                continue;
            };
            if right >= n {
                continue;
            }
            let normal = |i: usize, j: usize| compliance.get(2 * i + 1, 2 * j + 1);
            let tangential = |i: usize, j: usize| compliance.get(2 * i, 2 * j);
            let near = normal(i, j) + tangential(left, right) - normal(left, right);
            let change = near - tangential(i, j);
            *compliance.at(2 * i, 2 * j) = near;
            *compliance.at(2 * j, 2 * i) = near;
            uniform[i] += change * widths[j];
            if j > i {
                uniform[j] += change * widths[i];
            }
        }
    }
    for (i, (change, width)) in uniform.iter().zip(widths).enumerate() {
        *compliance.at(2 * i, 2 * i) -= change / width;
    }
}
