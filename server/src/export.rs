//! Results in the formats of other programs: CSV, Parquet, VTU, pictures, and the model as an input deck.

pub mod columns;
pub mod csv;
pub mod deck;
pub mod documents;
mod earlier;
pub mod files;
pub mod history;
pub mod life;
pub mod line;
pub mod line_maps;
pub mod maps;
pub mod markdown;
pub(crate) mod mission;
pub mod parquet;
pub mod pictures;
pub mod quantities;
pub(crate) mod resistance;
pub mod thin;
pub mod tractions;
pub mod vtu;

#[cfg(test)]
mod tests;
