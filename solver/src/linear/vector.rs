//! Loops over vectors, compiled for the widest registers of the processor.

use pulp::Arch;

/// Runs loops compiled for the widest vector registers of this processor. Products and sums are not fused, so that the bits do
/// not depend on them.
pub(crate) fn vectorized<R>(loops: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(loops)
}

/// sum += a x, compiled for the vector registers of its caller.
#[expect(clippy::inline_always, reason = "only then it is compiled for them")]
#[inline(always)]
pub(crate) fn add_scaled(sum: &mut [f64], a: f64, x: &[f64]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += a * x;
    }
}

/// Sum of products, in eight parts that vector registers hold, compiled for those of its caller.
#[expect(clippy::inline_always, reason = "only then it is compiled for them")]
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, a_rest) = a.as_chunks::<8>();
    let (b, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for i in 0..8 {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
