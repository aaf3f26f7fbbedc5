//! Checks of what a worker sends: it may be any program that has a token.

use serde::de::IgnoredAny;

use crate::export::files::is_plain_name;
use crate::store::JobUpdate;
use crate::store::block::{BlockError, EncodedBlock};

/// Length of a SHA-256, hexadecimal digits.
const SHA256_DIGITS: usize = 64;

/// Fault of an update.
#[derive(Debug, thiserror::Error)]
pub enum UpdateFault {
    /// The name of a file leads out of its folder, or cannot be that of a file.
    #[error("/update/files: `{0}` is no plain file name")]
    Name(String),
    /// The checksum of a file is none.
    #[error("/update/files: `{0}` is no SHA-256, {SHA256_DIGITS} lower-case hexadecimal digits")]
    Checksum(String),
    /// The document of an event is none, or has several lines, which would be several fields of a stream.
    #[error("/update/events: `{0}` is no JSON document of one line")]
    Event(String),
    /// The block of small results cannot be read.
    #[error("/update/block: {0}")]
    Block(#[from] BlockError),
}

impl JobUpdate {
    /// Checks names, checksums, events and the block.
    ///
    /// # Errors
    /// [`UpdateFault`] with the first fault.
    pub fn check(&self) -> Result<(), UpdateFault> {
        for file in self.files.iter().map(|new| &new.file) {
            if !is_plain_name(&file.name) {
                return Err(UpdateFault::Name(file.name.clone()));
            }
            let is_digit = |c: u8| c.is_ascii_digit() || (b'a'..=b'f').contains(&c);
            if file.sha256.len() != SHA256_DIGITS || !file.sha256.bytes().all(is_digit) {
                return Err(UpdateFault::Checksum(file.sha256.clone()));
            }
        }
        for (_, data) in &self.events {
            let is_document = serde_json::from_str::<IgnoredAny>(data).is_ok();
            if !is_document || data.contains(['\n', '\r']) {
                return Err(UpdateFault::Event(data.clone()));
            }
        }
        self.block
            .as_ref()
            .map_or(Ok(()), EncodedBlock::check)
            .map_err(UpdateFault::from)
    }
}
