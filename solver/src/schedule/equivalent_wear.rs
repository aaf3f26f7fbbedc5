//! Wear of a computed cycle as the jump control measures it: equivalent depths of both surfaces before and after it, and the weights of their
//! nodes.

use std::borrow::Cow;

use crate::change::Change;
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
        depth: Change<&'a Sides<Vec<f64>>>,
    ) -> Self {
        let equivalents = |depth: &'a Sides<Vec<f64>>| {
            Sides::from_fn(|side| surface::equivalents(*wear.of(side), depth.of(side)))
        };
        Self {
            weights: Sides::from_fn(|side| {
                surface::at_relative_rates(*wear.of(side), widths.of(side), depth.after.of(side))
            }),
            before: equivalents(depth.before),
            after: equivalents(depth.after),
        }
    }

    /// Weights of the nodes, mm.
    pub(crate) fn weights(&self) -> Sides<&[f64]> {
        slices(&self.weights)
    }

    /// Equivalent depths before and after, mm.
    pub(crate) fn depths(&self) -> Change<Sides<&[f64]>> {
        Change {
            before: slices(&self.before),
            after: slices(&self.after),
        }
    }
}

fn slices<'a>(values: &'a Sides<Cow<'_, [f64]>>) -> Sides<&'a [f64]> {
    values.as_ref().map(|values| &values[..])
}
