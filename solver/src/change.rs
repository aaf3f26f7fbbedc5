//! A quantity before and after a computed cycle.

/// Both values of a quantity that a computed cycle changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change<T> {
    pub(crate) before: T,
    pub(crate) after: T,
}
