//! Linear algebra in types that cannot be used in the wrong order. The only place, with `condensation`, that
//! names the library behind it.

mod blocked_lu;
pub mod cholesky;
pub mod condensed;
mod cross_approximation;
pub mod dense;
mod hierarchical_system;
pub mod hodlr;
pub mod hodlr_lu;
pub mod lemke;
pub mod tridiagonal;
pub mod vector;

pub use cholesky::{CholeskyFactor, CholeskyPattern, FactorError};
pub use condensed::CondensedSystem;
pub use cross_approximation::Entries;
pub use dense::{DenseLu, SquareMatrix};
pub use hierarchical_system::{Blocks, HierarchicalSystem};
pub use hodlr::{Approximation, Hodlr, Triplets};
pub use hodlr_lu::HodlrLu;
pub use lemke::Lemke;
