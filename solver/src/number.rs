//! Conversions between counts and reals, in one place because the lints forbid lossy casts elsewhere.

/// A count as a real number; exact below 2^53.
#[expect(
    clippy::cast_precision_loss,
    reason = "counts of nodes and cycles stay far below 2^53"
)]
pub(crate) fn real(count: usize) -> f64 {
    count as f64
}

/// A number of cycles as a real number; exact below 2^53.
#[expect(clippy::cast_precision_loss, reason = "cycles stay far below 2^53")]
pub(crate) fn real_cycles(cycles: u64) -> f64 {
    cycles as f64
}

/// The smallest count that is not below `value`, and at least 1; `value` is clamped to 2^31.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is clamped to a range that fits"
)]
pub(crate) fn count_at_least(value: f64) -> usize {
    if value.is_nan() {
        return 1;
    }
    value.clamp(1.0, 2_147_483_648.0).ceil() as usize
}

/// The smallest number of cycles that is not below `value`, and at least 1; `value` is clamped to 2^53.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is clamped to a range that fits"
)]
pub(crate) fn cycles_at_least(value: f64) -> u64 {
    if value.is_nan() {
        return 1;
    }
    value.clamp(1.0, 9_007_199_254_740_992.0).ceil() as u64
}

/// The largest whole number of cycles that is not above `value`, which is clamped to 2^53.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is clamped to a range that fits"
)]
pub(crate) fn whole_cycles(value: f64) -> u64 {
    if value.is_nan() {
        return 0;
    }
    value.clamp(0.0, 9_007_199_254_740_992.0) as u64
}

/// A count as a number of fixed size.
pub(crate) fn count(count: usize) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

/// The nearest count to `value`, the larger one in the middle; `value` is clamped to 2^31.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is clamped to a range that fits"
)]
pub(crate) fn nearest(value: f64) -> usize {
    if value.is_nan() {
        return 0;
    }
    value.clamp(0.0, 2_147_483_648.0).round() as usize
}

/// Checks that a value is positive and finite.
pub(crate) fn positive<E>(value: f64, error: impl Fn(f64) -> E) -> Result<(), E> {
    let is_positive = value > 0.0 && value.is_finite();
    is_positive.then_some(()).ok_or_else(|| error(value))
}
