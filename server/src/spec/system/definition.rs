//! Definition of a kind of contact system.

use api::spec::{Provenance, System};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::system::preset::Preset;
use crate::spec::system::shapes::Shapes;

/// One kind of contact system.
pub(crate) struct SystemDefinition {
    /// Description in a few words.
    pub(crate) description: &'static str,
    /// Dimensions, in the order in which defaults are computed from one another.
    pub(super) dimensions: &'static [Dimension],
    /// Builds both bodies from the dimensions.
    pub(super) shapes: fn(&System) -> Shapes,
    /// Adds a fault for each dimension that cannot be combined with the others.
    pub(super) check: fn(&Shapes, &mut Diagnostics),
    /// Values for what a specification leaves out.
    pub(crate) preset: fn() -> Preset,
}

/// A dimension of a kind.
pub(super) struct Dimension {
    /// Field in the specification.
    pub(super) name: &'static str,
    pub(super) field: fn(&mut System) -> &mut Option<f64>,
    /// Default, from the dimensions before it; `None` for an optional dimension.
    pub(super) default: fn(&System) -> Option<f64>,
    /// Provenance of the default.
    pub(super) provenance: Provenance,
}

/// `dimension!(field, |system| default, provenance)`, or `dimension!(field)` for an optional dimension.
macro_rules! dimension {
    ($field:ident, |$system:pat_param| $default:expr, $provenance:ident) => {
        $crate::spec::system::definition::Dimension {
            name: stringify!($field),
            field: |system| &mut system.$field,
            default: |$system| Some($default),
            provenance: api::spec::Provenance::$provenance,
        }
    };
    ($field:ident) => {
        $crate::spec::system::definition::Dimension {
            name: stringify!($field),
            field: |system| &mut system.$field,
            default: |_| None,
            provenance: api::spec::Provenance::Given,
        }
    };
}
pub(super) use dimension;

impl SystemDefinition {
    /// Names of all dimensions, optional ones included.
    pub(crate) fn dimension_names(&self) -> impl Iterator<Item = &'static str> {
        self.dimensions.iter().map(|dimension| dimension.name)
    }
}
