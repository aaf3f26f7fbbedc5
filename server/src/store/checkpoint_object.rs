//! A checkpoint whose state is in an object, as the databases name it.

/// An object that no update has named for as long is removed, ms. Its update is refused before.
pub(in crate::store) const REMOVED_AFTER_MS: i64 = 15 * 60 * 1000;
/// Longest time between the note of an object and the update that names it, ms.
pub(in crate::store) const NAMED_WITHIN_MS: i64 = 10 * 60 * 1000;

/// A checkpoint in an object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::store) struct CheckpointObject {
    pub(in crate::store) cycle: u64,
    pub(in crate::store) sha256: Vec<u8>,
    pub(in crate::store) key: String,
}
