//! Linear algebra in types that cannot be used in the wrong order. The only place, with `condensation`, that
//! names the library behind it.

mod blocked_lu;
mod bordered_band;
pub(crate) mod cholesky;
pub(crate) mod condensed;
mod cross_approximation;
pub(crate) mod dense;
mod hierarchical_system;
pub(crate) mod hodlr;
pub(crate) mod hodlr_lu;
mod inverse;
pub(crate) mod lemke;
pub(crate) mod tridiagonal;
pub(crate) mod vector;

pub(crate) use bordered_band::{BorderedBand, Column};
pub(crate) use cholesky::{CholeskyFactor, CholeskyPattern, FactorError};
pub(crate) use condensed::CondensedSystem;
pub(crate) use cross_approximation::Entries;
pub(crate) use dense::{DenseLu, SquareMatrix};
pub(crate) use hierarchical_system::{Blocks, HierarchicalSystem};
pub(crate) use hodlr::{Approximation, Hodlr};
pub(crate) use hodlr_lu::HodlrLu;
pub(crate) use inverse::Inverse;
pub(crate) use lemke::Lemke;
