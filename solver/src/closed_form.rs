//! The unworn contact, what a run wears of it, and its life, by closed forms: without a mesh.

pub mod expected_life;
pub mod expected_wear;
mod hertz;
pub mod line_contact;
mod point_accuracy;
mod point_scene;
mod stroke_parts;
pub mod unworn_contact;
pub(crate) mod worn_cap;
pub(crate) mod worn_depth;

pub use point_accuracy::PointAccuracy;
pub(crate) use point_scene::CyclePath;
pub use point_scene::{
    PointBody, PointScene, SlipRegime, cell_mm, half_lengths_mm, middle_line_load_n_per_mm,
};
pub(crate) use stroke_parts::StrokeParts;
