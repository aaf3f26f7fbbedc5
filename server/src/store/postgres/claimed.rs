//! Answers to claims.

use uuid::Uuid;

use crate::store::Claim;

/// What a request has got.
#[derive(Debug)]
pub(super) struct Claimed {
    pub(super) claims: Vec<Claim>,
    /// Jobs that were given another reason to wait.
    pub(super) reasoned: Vec<Uuid>,
}
