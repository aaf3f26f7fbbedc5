//! Counts, which may be written as integers or as numbers without a fraction: `1e9`, `2000.0`.

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

/// Largest integer up to which every one is exact in a double.
const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Deserializes an optional count.
pub(super) fn optional<'de, D, T>(deserializer: D) -> Result<Option<T>, D::Error>
where
    D: Deserializer<'de>,
    T: TryFrom<u64>,
{
    let Some(Count(count)) = Option::deserialize(deserializer)? else {
        return Ok(None);
    };
    let too_large = |_| D::Error::invalid_value(Unexpected::Unsigned(count), &"a smaller count");
    T::try_from(count).map(Some).map_err(too_large)
}

/// Deserializes a count.
pub(super) fn required<'de, D>(deserializer: D) -> Result<u64, D::Error>
where
    D: Deserializer<'de>,
{
    Count::deserialize(deserializer).map(|Count(count)| count)
}

/// Deserializes an optional list of counts.
pub(super) fn optional_list<'de, D>(deserializer: D) -> Result<Option<Vec<u64>>, D::Error>
where
    D: Deserializer<'de>,
{
    let counts: Option<Vec<Count>> = Option::deserialize(deserializer)?;
    Ok(counts.map(|counts| counts.into_iter().map(|Count(count)| count).collect()))
}

struct Count(u64);

impl<'de> Deserialize<'de> for Count {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CountVisitor)
    }
}

struct CountVisitor;

impl Visitor<'_> for CountVisitor {
    type Value = Count;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("a count")
    }

    fn visit_u64<E>(self, count: u64) -> Result<Count, E> {
        Ok(Count(count))
    }

    fn visit_i64<E: Error>(self, count: i64) -> Result<Count, E> {
        let negative = |_| E::invalid_value(Unexpected::Signed(count), &self);
        u64::try_from(count).map(Count).map_err(negative)
    }

    fn visit_f64<E: Error>(self, count: f64) -> Result<Count, E> {
        integer(count)
            .map(Count)
            .ok_or_else(|| E::invalid_value(Unexpected::Float(count), &self))
    }
}

/// A number without a fraction as an integer, if it is one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is checked to be an integer in the range"
)]
pub(super) fn integer(number: f64) -> Option<u64> {
    let is_integer = (0.0..=LARGEST_EXACT).contains(&number) && number.fract() == 0.0;
    is_integer.then_some(number as u64)
}
