//! Reference data with their provenance: the material library, and what each contact system takes for what a
//! specification leaves out.

pub mod materials;
pub mod presets;
