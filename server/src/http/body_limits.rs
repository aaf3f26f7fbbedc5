//! Limits of the bodies of requests, by who sends them.

use crate::http::access::WORKER_FOLDER;
use crate::http::worker_body;

/// Maximum size of the body of a user's request, bytes.
pub(super) const MAX_BODY_BYTES: usize = 1 << 20;
/// Folder of the files that remote workers send.
const FILE_FOLDER: &str = "/v1/worker/files/";
/// Maximum size of a file, bytes: twice the largest estimated output of a job, all files together.
const MAX_FILE_BYTES: u64 = 8_000_000_000;

/// Who sends a body, and what is done with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BodyKind {
    /// A user: it is received into memory.
    User,
    /// A remote worker: the same.
    Worker,
    /// A remote worker: it is written to the disk while it arrives.
    File,
}

/// Limits of bodies of a kind, bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyLimits {
    /// Of one body.
    pub(super) body: u64,
    /// In memory, of the requests of one address.
    pub(super) memory_of_peer: usize,
    /// In memory, of all requests.
    pub(super) memory: usize,
}

impl BodyKind {
    /// The kind of body that is sent to a path.
    pub(super) fn of(path: &str) -> Self {
        if path.starts_with(FILE_FOLDER) {
            Self::File
        } else if path.starts_with(WORKER_FOLDER) {
            Self::Worker
        } else {
            Self::User
        }
    }

    /// The limits of this kind.
    pub(super) fn limits(self) -> BodyLimits {
        match self {
            Self::User => BodyLimits {
                body: MAX_BODY_BYTES as u64,
                memory_of_peer: 64 << 20,
                memory: 128 << 20,
            },
            // Many workers may have one address: that of their network.
            Self::Worker => BodyLimits {
                body: worker_body::MAX_BYTES as u64,
                memory_of_peer: worker_body::MAX_BYTES,
                memory: 2 * worker_body::MAX_BYTES,
            },
            Self::File => BodyLimits {
                body: MAX_FILE_BYTES,
                memory_of_peer: 0,
                memory: 0,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_body_that_is_not_too_large_fits_into_memory_alone() {
        for kind in [BodyKind::User, BodyKind::Worker] {
            let limits = kind.limits();
            assert!(u64::try_from(limits.memory_of_peer).is_ok_and(|m| m >= limits.body));
            assert!(limits.memory >= limits.memory_of_peer);
        }
    }
}
