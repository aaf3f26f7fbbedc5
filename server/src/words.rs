//! Sentences that a user reads about effects, errors and warnings of the engine, and names of effects: the engine returns facts as enums
//! with numbers.

mod absences;
pub(crate) mod decisions;
pub mod effects;
pub(crate) mod errors;
pub(crate) mod extent;
pub(crate) mod restarts;
pub(crate) mod warnings;

#[cfg(test)]
mod tests;
