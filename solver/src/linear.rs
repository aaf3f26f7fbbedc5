//! Linear algebra in types that cannot be used in the wrong order. The only place, with `condensation`, that
//! names the library behind it.

pub mod cholesky;
pub mod dense;
pub mod lemke;

pub use cholesky::{CholeskyFactor, CholeskyPattern, FactorError};
pub use dense::{DenseLu, SquareMatrix};
pub use lemke::Lemke;
