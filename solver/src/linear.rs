//! Linear algebra in types that cannot be used in the wrong order. The only place, with `condensation`, that
//! names the library behind it.

pub mod cholesky;
pub mod condensed;
pub mod dense;
pub mod lemke;
pub mod tridiagonal;
pub mod vector;

pub use cholesky::{CholeskyFactor, CholeskyPattern, FactorError};
pub use condensed::CondensedSystem;
pub use dense::{DenseLu, SquareMatrix};
pub use lemke::Lemke;
