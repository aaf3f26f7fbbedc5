//! Wear of a computed cycle as the jump control measures it: equivalent depths of both surfaces before and after it, and the weights of their
//! nodes.

use std::borrow::Cow;

use crate::law::surface::{self, SurfaceWear};
use crate::sides::Sides;

/// Equivalent wear of a computed cycle. Where a rate depends on the depth, equivalents are doses, and the rate there weighs a node beside its
/// width.
pub(crate) struct EquivalentWear<'a> {
    weights: Sides<Cow<'a, [f64]>>,
    before: Sides<Cow<'a, [f64]>>,
    after: Sides<Cow<'a, [f64]>>,
}

impl<'a> EquivalentWear<'a> {
    /// From the widths of the nodes and their depths before and after, mm.
    pub(crate) fn new(
        wear: &Sides<Option<SurfaceWear>>,
        widths: Sides<&'a [f64]>,
        (before, after): (&'a Sides<Vec<f64>>, &'a Sides<Vec<f64>>),
    ) -> Self {
        let equivalents = |depth: &'a Sides<Vec<f64>>| {
            Sides::from_fn(|side| surface::equivalents(*wear.of(side), depth.of(side)))
        };
        Self {
            weights: Sides::from_fn(|side| {
                surface::at_relative_rates(*wear.of(side), widths.of(side), after.of(side))
            }),
            before: equivalents(before),
            after: equivalents(after),
        }
    }

    /// Weights of the nodes, mm.
    pub(crate) fn weights(&self) -> Sides<&[f64]> {
        slices(&self.weights)
    }

    /// Equivalent depths before and after, mm.
    pub(crate) fn depths(&self) -> (Sides<&[f64]>, Sides<&[f64]>) {
        (slices(&self.before), slices(&self.after))
    }
}

fn slices<'a>(values: &'a Sides<Cow<'_, [f64]>>) -> Sides<&'a [f64]> {
    values.as_ref().map(|values| &values[..])
}
