//! Answers to claims.

use uuid::Uuid;

use crate::store::Claim;

/// Jobs that a request has claimed.
#[derive(Debug)]
pub(super) struct Claimed {
    pub(super) claims: Vec<Claim>,
    /// Jobs that were given another reason to wait.
    pub(super) reasoned: Vec<Uuid>,
}
