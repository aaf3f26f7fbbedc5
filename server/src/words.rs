//! Sentences that a user reads about effects, errors and warnings of the engine: the engine returns facts as enums with numbers.

mod absences;
pub(crate) mod decisions;
pub(crate) mod extent;
pub(crate) mod restarts;
pub(crate) mod warnings;
