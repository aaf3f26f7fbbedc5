//! Wear of all planes: one coupling where rates are the same in all of them, else one for each plane, at its depths.

use super::super::line::mortar::Coupling;
use super::super::line::wear_coupling::WearCoupling;
use super::super::line::{Pair, Surfaces};
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::sides::Sides;

/// Gap opening of an increment in each plane.
#[derive(Debug, Default)]
pub(super) struct PlanesWear {
    planes: Vec<WearCoupling>,
}

impl PlanesWear {
    /// Assembles the opening for the wear of both surfaces, worn to the depths of each plane, and a number of cycles.
    pub(super) fn assemble(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        wear: &Sides<Option<SurfaceWear>>,
        surfaces: &[Surfaces<'_>],
        cycles: f64,
    ) {
        let is_even = |wear: Option<SurfaceWear>| wear.is_none_or(|wear| wear.uniform().is_some());
        let count = if is_even(wear.slider) && is_even(wear.receptacle) {
            1
        } else {
            surfaces.len()
        };
        self.planes.resize_with(count, WearCoupling::default);
        for (own, surfaces) in self.planes.iter_mut().zip(surfaces) {
            own.assemble(coupling, pair, wear, surfaces.depth, cycles);
        }
    }

    /// Wear coupling of a plane.
    pub(super) fn of(&self, plane: usize) -> &WearCoupling {
        &self.planes[plane.min(self.planes.len() - 1)]
    }

    /// Linearises rates that depend on the depth about the pressures and slips of all planes, which have `nodes` coupled ones each.
    pub(super) fn linearise(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        nodes: usize,
        pressure: &[f64],
        slip: &[f64],
    ) {
        for (plane, own) in self.planes.iter_mut().enumerate() {
            let states = (plane * nodes..(plane + 1) * nodes).map(|node| LocalState {
                pressure: pressure[node],
                slip: slip[node],
                ..LocalState::default()
            });
            own.linearise(coupling, pair, &states);
        }
    }
}
