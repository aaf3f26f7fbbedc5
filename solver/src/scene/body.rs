//! A body of a scene: its geometry, its material and its surface.

use crate::law::elastic::Elastic;
use crate::law::heating::sliding::Conductor;
use crate::law::pace::Pace;
use crate::law::plating::Layer;
use crate::law::softening::Softening;
use crate::law::surface::SurfaceWear;
use crate::law::wear::WearLaw;

/// Effects on the wear of a surface that are simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceEffects {
    /// Layers below the outermost one.
    pub plating: bool,
    /// Change of the hardness with the temperature.
    pub softening: bool,
}

/// A deformable body: shape, elasticity, wear.
#[derive(Debug, Clone, PartialEq)]
pub struct Body<S> {
    /// Geometry.
    pub shape: S,
    /// Elastic constants.
    pub elastic: Elastic,
    /// Wear law of its surface, below the plating if there is one; `None` does not wear.
    pub wear: Option<WearLaw>,
    /// Layers over the base, from the surface down; at most [`MOST_LAYERS`](super::MOST_LAYERS).
    pub plating: Vec<Layer>,
    /// The body as a conductor of heat, if its conductivity is known.
    pub thermal: Option<Conductor>,
    /// Hardnesses at the temperature of the contact.
    pub softening: Softening,
}

impl<S> Body<S> {
    /// Wear of its surface by the surface effects that are simulated: with all of its layers or with the outermost one at every
    /// depth, at the temperature of the contact or at that of the measured hardness; at a pace that is the same all the time.
    pub(crate) fn surface_wear(
        &self,
        on: SurfaceEffects,
        pace: Option<Pace>,
    ) -> Option<SurfaceWear> {
        let ratio = |layer| {
            if on.softening {
                self.softening.ratio(layer)
            } else {
                1.0
            }
        };
        let softened = |(number, layer): (usize, &Layer)| Layer {
            rate_per_mpa: layer.rate_per_mpa / ratio(number),
            ..*layer
        };
        let layers = self.plating.iter().enumerate().map(softened);
        let layers: Vec<Layer> = layers.collect();
        match layers.first() {
            Some(outer) if !on.plating => Some(SurfaceWear::Law(WearLaw::Archard {
                k_over_h_per_mpa: outer.rate_per_mpa,
            })),
            _ => {
                let base = self.wear.map(|law| law.softened(ratio(layers.len())));
                let base = base.map(|law| pace.map_or(law, |pace| law.at_pace(pace)));
                SurfaceWear::new(&layers, base)
            }
        }
    }

    /// Specific wear rate of its outermost layer, or of the bare body, 1/MPa, if it is the same in every state.
    pub fn outer_rate(&self) -> Option<f64> {
        let bare = SurfaceEffects {
            plating: false,
            softening: true,
        };
        self.surface_wear(bare, None).and_then(SurfaceWear::uniform)
    }
}

/// The slider: a circular arc around x = 0 whose lowest point touches y = 0, under a flat top face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderShape {
    /// Radius of the arc, mm.
    pub radius_mm: f64,
    /// Half the modelled width, mm; the radius itself for a half-round.
    pub half_width_mm: f64,
    /// Height of the top face over the contact point, mm.
    pub height_mm: f64,
}

/// The receptacle: a block centred on x = 0, its top face flat at y = 0 or crowned with its highest point there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockShape {
    /// Length along x, mm.
    pub length_mm: f64,
    /// Height in the middle, mm.
    pub height_mm: f64,
    /// Radius of a convex top face, mm; flat if absent.
    pub crown_radius_mm: Option<f64>,
}
