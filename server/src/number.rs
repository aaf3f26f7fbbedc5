//! Conversions of counts, in one place because the lints forbid lossy casts elsewhere.

/// A count as a real number; exact below 2^53.
#[expect(
    clippy::cast_precision_loss,
    reason = "counts, cycles and seconds stay far below 2^53"
)]
pub(crate) fn real(count: impl TryInto<u64>) -> f64 {
    count.try_into().unwrap_or(u64::MAX) as f64
}
