//! Coefficients of friction of a model: one at a time everywhere, or those of both surfaces by how far they have worn.
//!
//! The dose of a place is the one that its worn depth stands for (`law::plating`), and the layer that lies open there is that of the
//! depth, so that neither is a state of its own.

use crate::law::friction::{Friction, Table, of_both};
use crate::law::plating::bottoms;
use crate::law::surface::SurfaceWear;
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// Coefficients of friction of a model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ContactFriction {
    /// The same at every place, after so many cycles.
    Uniform(Table),
    /// Friction of each surface, of at least one of them.
    BySurface(Box<Sides<Option<SurfaceFriction>>>),
}

/// Coefficients of friction of a surface over its worn depth.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SurfaceFriction {
    /// By the dose of a depth.
    ByDose {
        table: Table,
        wear: SurfaceWear,
        /// Specific wear rate of the surface, or of its outermost layer, 1/MPa.
        rate: f64,
    },
    /// By the layer at a depth.
    ByLayer {
        /// Depth of the lower end of each layer, mm.
        bottoms: Vec<f64>,
        /// Coefficient of each layer, and of the base below them, -.
        coefficients: Vec<f64>,
    },
}

impl ContactFriction {
    /// Friction of a scene whose surfaces wear in this way, through the layers of their platings or by the outermost one alone.
    pub(crate) fn new(scene: &Scene, wear: &Sides<Option<SurfaceWear>>, layered: bool) -> Self {
        let constant = |coefficient| Self::Uniform(Table::new(&[(0.0, coefficient)]));
        let surfaces = match &scene.friction {
            Friction::Frictionless | Friction::Coulomb { .. } => {
                return constant(scene.friction.unworn());
            }
            Friction::ByCycle(table) => return Self::Uniform(table.clone()),
            Friction::ByDose(table) => {
                Sides::from_fn(|side| SurfaceFriction::by_dose(table, (*wear.of(side))?))
            }
            Friction::ByLayer(layers) => Sides::from_fn(|side| {
                SurfaceFriction::by_layer(scene, side, layers.of(side), layered)
            }),
        };
        if surfaces.slider.is_none() && surfaces.receptacle.is_none() {
            // Nothing wears, and so nothing changes.
            return constant(scene.friction.unworn());
        }
        Self::BySurface(Box::new(surfaces))
    }

    /// The surface of a side by which the coefficient differs from place to place.
    pub(crate) fn of_surface(&self, side: Side) -> Option<&SurfaceFriction> {
        match self {
            Self::Uniform(_) => None,
            Self::BySurface(surfaces) => surfaces.of(side).as_ref(),
        }
    }

    /// The mean coefficient from one number of cycles to another, -; of places that differ the largest of those of both surfaces.
    pub(crate) fn between(&self, from: f64, to: f64, nodal: &Sides<Option<Vec<f64>>>) -> f64 {
        match self {
            Self::Uniform(table) => table.mean(from, to),
            Self::BySurface(_) => {
                let most = nodal.as_ref().map(|nodes| {
                    let nodes = nodes.as_ref()?.iter();
                    Some(nodes.fold(0.0, |most: f64, mu| most.max(*mu)))
                });
                of_both(most).unwrap_or(0.0)
            }
        }
    }

    /// Coefficients at the nodes of the surfaces with these depths, mm.
    pub(crate) fn nodal(&self, depth: &Sides<Vec<f64>>) -> Sides<Option<Vec<f64>>> {
        Sides::from_fn(|side| {
            let surface = self.of_surface(side)?;
            let nodes = depth.of(side).iter();
            Some(nodes.map(|depth| surface.at(*depth)).collect())
        })
    }
}

impl SurfaceFriction {
    /// By the doses of a surface whose depths stand for them: where its rate is the same in every state.
    fn by_dose(table: &Table, wear: SurfaceWear) -> Option<Self> {
        let rate = wear.dose_rate().filter(|rate| *rate > 0.0)?;
        Some(Self::ByDose {
            table: table.clone(),
            wear,
            rate,
        })
    }

    fn by_layer(scene: &Scene, side: Side, coefficients: &[f64], layered: bool) -> Option<Self> {
        let outer = *coefficients.first()?;
        if !layered {
            return Some(Self::ByLayer {
                bottoms: Vec::new(),
                coefficients: vec![outer],
            });
        }
        Some(Self::ByLayer {
            bottoms: bottoms(scene.plating(side)).collect(),
            coefficients: coefficients.to_vec(),
        })
    }

    /// The coefficient at a depth in mm, -.
    pub(crate) fn at(&self, depth: f64) -> f64 {
        match self {
            Self::ByDose { table, wear, rate } => table.at(wear.equivalent(depth) / rate),
            Self::ByLayer {
                bottoms,
                coefficients,
            } => {
                let layer = bottoms.iter().take_while(|bottom| depth >= **bottom);
                let last = coefficients.len() - 1;
                coefficients[layer.count().min(last)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::scene::{Layer, SurfaceEffects};

    const ALL: SurfaceEffects = SurfaceEffects {
        plating: true,
        softening: true,
    };

    /// The fuzz button with 1 um of a layer at 1e-6 1/MPa on its receptacle.
    fn plated(friction: Friction) -> Scene {
        let mut scene = fuzz_button();
        scene.receptacle.plating = vec![Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-6,
        }];
        scene.friction = friction;
        scene
    }

    fn friction(scene: &Scene, layered: bool) -> ContactFriction {
        let wear = Sides {
            slider: scene.slider.surface_wear(ALL, None),
            receptacle: scene.receptacle.surface_wear(ALL, None),
        };
        ContactFriction::new(scene, &wear, layered)
    }

    #[test]
    fn the_layer_that_lies_open_determines_the_coefficient() {
        let coefficients = vec![0.2, 0.6];
        let scene = plated(Friction::ByLayer(Sides {
            slider: Vec::new(),
            receptacle: coefficients,
        }));
        let depth = Sides {
            slider: vec![0.0; 2],
            receptacle: vec![0.0, 0.99e-3, 1e-3, 1.0],
        };
        let nodal = friction(&scene, true).nodal(&depth);
        assert_eq!(nodal.receptacle, Some(vec![0.2, 0.2, 0.6, 0.6]));
        assert_eq!(nodal.slider, None);
        let outer = friction(&scene, false).nodal(&depth);
        assert_eq!(outer.receptacle, Some(vec![0.2; 4]));
    }

    #[test]
    fn the_dose_of_a_depth_is_that_of_its_layers() {
        let base = 0.011 / 427.0;
        let table = Table::new(&[(0.0, 0.2), (1_000.0, 0.4), (1_100.0, 0.5)]);
        let scene = plated(Friction::ByDose(table));
        let depth = Sides {
            slider: vec![0.0],
            receptacle: vec![0.0, 0.5e-3, 1e-3, 1e-3 + 50.0 * base],
        };
        let friction = friction(&scene, true);
        let nodal = friction.nodal(&depth).receptacle.unwrap_or_default();
        for (found, expected) in nodal.iter().zip([0.2, 0.3, 0.4, 0.45]) {
            assert!((found - expected).abs() < 1e-12, "{nodal:?}");
        }
        // The slider does not wear.
        assert!(friction.of_surface(Side::Slider).is_none());
    }

    #[test]
    fn doses_change_nothing_where_nothing_wears() {
        let table = Table::new(&[(0.0, 0.2), (1_000.0, 0.4)]);
        let mut scene = fuzz_button();
        scene.friction = Friction::ByDose(table);
        let unworn = ContactFriction::new(&scene, &Sides::default(), true);
        assert_eq!(unworn, ContactFriction::Uniform(Table::new(&[(0.0, 0.2)])));
        let nodal = Sides::default();
        assert!((unworn.between(5.0, 6.0, &nodal) - 0.2).abs() < 1e-15);
    }
}
