//! Loops over vectors, compiled for the widest registers of the processor.

use pulp::Arch;

/// Runs loops compiled for the widest vector registers of this processor. Products and sums are not fused, so that the bits do
/// not depend on them.
pub fn vectorized<R>(loops: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(loops)
}

/// sum += a x, compiled for the vector registers of its caller.
#[expect(clippy::inline_always, reason = "only then it is compiled for them")]
#[inline(always)]
pub fn add_scaled(sum: &mut [f64], a: f64, x: &[f64]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += a * x;
    }
}
