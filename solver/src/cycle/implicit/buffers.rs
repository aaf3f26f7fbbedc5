//! Buffers that implicit jumps reuse.

use super::contacts::Contacts;
use super::jump::JumpSystem;

/// Buffers of implicit jumps.
#[derive(Default)]
pub(in super::super) struct ImplicitJumps {
    pub(super) contacts: Contacts,
    pub(super) system: JumpSystem,
}
