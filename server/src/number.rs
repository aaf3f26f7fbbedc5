//! Conversions of counts, in one place because the lints forbid lossy casts elsewhere.

/// A count as a real number; exact below 2^53.
#[expect(
    clippy::cast_precision_loss,
    reason = "counts, cycles and seconds stay far below 2^53"
)]
pub(crate) fn real(count: impl TryInto<u64>) -> f64 {
    count.try_into().unwrap_or(u64::MAX) as f64
}

/// The nearest count of a number; 0 of a negative one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, and what a count may be is checked where it is used"
)]
pub(crate) fn whole(number: f64) -> u64 {
    number.round() as u64
}
