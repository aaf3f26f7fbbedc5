//! Reference data with provenance: the material library.

pub mod materials;
