//! A default value with its provenance.

use api::spec::Provenance;

/// A value with its provenance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sourced<T> {
    /// The value.
    pub(crate) value: T,
    /// Provenance.
    pub(crate) provenance: Provenance,
}

impl<T> Sourced<Option<T>> {
    /// The value with its provenance, if there is one.
    pub(crate) fn present(self) -> Option<Sourced<T>> {
        let Self { value, provenance } = self;
        value.map(|value| Sourced { value, provenance })
    }
}

impl<T> Sourced<T> {
    /// The value as one that may be absent.
    pub(crate) fn optional(self) -> Sourced<Option<T>> {
        sourced(Some(self.value), self.provenance)
    }
}

/// A value that the source states.
pub(crate) const fn source<T>(value: T) -> Sourced<T> {
    sourced(value, Provenance::Source)
}

/// A value that is typical according to the literature.
pub(crate) const fn typical<T>(value: T) -> Sourced<T> {
    sourced(value, Provenance::Typical)
}

/// An assumed value.
pub(crate) const fn assumed<T>(value: T) -> Sourced<T> {
    sourced(value, Provenance::Assumed)
}

/// A value of a provenance.
pub(crate) const fn sourced<T>(value: T, provenance: Provenance) -> Sourced<T> {
    Sourced { value, provenance }
}
