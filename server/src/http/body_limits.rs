//! Limits of the bodies of requests, by what they contain.

use crate::solve::LINE_LIMIT;

/// Maximum size of a document, bytes.
pub(super) const MAX_BODY_BYTES: usize = 1 << 20;
/// Maximum size of writes of a worker, bytes: it sends an update once it has 16 MiB, and the last line of it may be as long as any of a
/// solving process.
const MAX_WRITES_BYTES: usize = (32 << 20) + LINE_LIMIT;
/// Path of the writes of remote workers.
const WRITES: &str = "/v1/worker/writes";
/// Folder of the files that remote workers send.
const FILE_FOLDER: &str = "/v1/worker/files/";
/// Maximum size of a file, bytes: twice the largest estimated output of a job, all files together.
const MAX_FILE_BYTES: u64 = 8_000_000_000;

/// Content of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BodyKind {
    /// A document of a user, or a small one of a worker: it is received into memory.
    Document,
    /// Writes of a remote worker: they are received into memory.
    Writes,
    /// A file of a remote worker: it is written to the disk while it arrives.
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
        } else if path == WRITES {
            Self::Writes
        } else {
            Self::Document
        }
    }

    /// The limits of this kind.
    pub(super) fn limits(self) -> BodyLimits {
        match self {
            Self::Document => BodyLimits {
                body: MAX_BODY_BYTES as u64,
                memory_of_peer: 64 << 20,
                memory: 128 << 20,
            },
            // Many workers may have one address: that of their network.
            Self::Writes => BodyLimits {
                body: MAX_WRITES_BYTES as u64,
                memory_of_peer: MAX_WRITES_BYTES,
                memory: 2 * MAX_WRITES_BYTES,
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
        for kind in [BodyKind::Document, BodyKind::Writes] {
            let limits = kind.limits();
            assert!(u64::try_from(limits.memory_of_peer).is_ok_and(|m| m >= limits.body));
            assert!(limits.memory >= limits.memory_of_peer);
        }
    }
}
