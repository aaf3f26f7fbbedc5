//! Both surfaces opposite each other at one position, over a range of the slave's nodes.

use std::ops::Range;

use super::local_slopes::LocalSlopes;
use super::mortar::Coupling;
use super::pair::{Pair, Surfaces, Zones};
use super::rate_contrast::{NextWorn, Thickness, share_by_resistance};
use super::state::ContactState;
use crate::model::Interface;
use crate::sides::Side;

/// Position of the slider, the vertical load at height 0 with its increase per mm of height, and the scale of the gaps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setting {
    /// Imposed displacement, mm.
    pub(super) slider_x: f64,
    /// Displacement at which the surfaces are paired, mm.
    pub(super) pairing_x: f64,
    /// Load at height 0, N/mm.
    pub(super) load: f64,
    /// Increase per mm of height.
    pub(super) spring: f64,
    /// Indentation of the last increment, mm.
    pub(super) indentation: f64,
}

impl Setting {
    /// At an imposed displacement and that of the pairing, after a contact. A given height is the reference of a spring of the contact's modulus
    /// that nothing else loads.
    pub(super) fn new(
        interface: &Interface,
        last: &ContactState,
        slider_x: f64,
        pairing_x: f64,
        height: Option<f64>,
    ) -> Self {
        if let Some(height) = height {
            return Self {
                slider_x,
                pairing_x,
                load: -interface.modulus * height,
                spring: interface.modulus,
                indentation: last.indentation,
            };
        }
        // Before the first load the spring has no reference height.
        let (spring, reference) = last
            .reference_height
            .map_or((0.0, 0.0), |height| (interface.spring, height));
        Self {
            slider_x,
            pairing_x,
            load: interface.load - spring * reference,
            spring,
            indentation: last.indentation,
        }
    }
}

/// Coupling, slopes and gaps of a range of nodes. Buffers are reused.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    pub(super) coupling: Coupling,
    pub(super) slopes: LocalSlopes,
    /// Gap of the worn bodies at height 0 under the far-face load there, mm.
    pub(super) gap: Vec<f64>,
    /// Change per height by that load's growth.
    pub(super) sag: Vec<f64>,
}

impl Geometry {
    /// Couples a range of the slave's nodes, which must be covered, to the master.
    pub(super) fn place(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        setting: Setting,
        nodes: Range<usize>,
    ) {
        let next = NextWorn {
            depth: surfaces.depth.of(pair.interface.slave.other()),
            thickness: Thickness::Even(setting.indentation),
        };
        self.place_where_worn(pair, surfaces, setting, nodes, next);
    }

    /// Couples a range of the slave's nodes, whose paths the master's nodes share by what they wear next.
    pub(super) fn place_where_worn(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        setting: Setting,
        nodes: Range<usize>,
        next: NextWorn<'_>,
    ) {
        self.coupling
            .integrate(pair, setting.pairing_x, nodes.start, nodes.end);
        share_by_resistance(&mut self.coupling, pair, next);
        self.slopes.assemble(pair, &self.coupling, surfaces);
    }

    /// Measures the gaps of the coupled nodes.
    pub(super) fn measure(
        &mut self,
        pair: &Pair<'_>,
        zones: Zones<'_>,
        surfaces: &Surfaces<'_>,
        setting: Setting,
    ) {
        let coupling = &self.coupling;
        let slave = pair.interface.slave;
        let (own, other) = (surfaces.depth.of(slave), surfaces.depth.of(slave.other()));
        let slider = match slave {
            Side::Slider => zones.slave,
            Side::Receptacle => zones.master,
        };
        // The gap that the master opens by its displacement beyond the pairing.
        let lag = setting.slider_x - setting.pairing_x;
        self.gap.clear();
        self.sag.clear();
        for (i, slope) in (coupling.first..coupling.end).zip(&self.slopes.master) {
            let (from, weights) = coupling.dual_row(i);
            let moved_by = |j: usize| {
                let [x, y] = slider.under_load(j);
                y - slope * x
            };
            let (mut worn, mut moved) = (0.0, 0.0);
            for (j, weight) in (from..).zip(weights) {
                worn += weight * other[j];
                if slave == Side::Receptacle {
                    moved += weight * moved_by(j);
                }
            }
            if slave == Side::Slider {
                moved = moved_by(i);
            }
            let shape = coupling.gap[i - coupling.first] + own[i];
            self.gap
                .push(shape + worn + setting.load * moved - slope * lag);
            self.sag.push(setting.spring * moved);
        }
    }
}
