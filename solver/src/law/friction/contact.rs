//! Coefficients of friction of a contact: one at a time everywhere, or those of both surfaces by how far they have worn.
//!
//! The dose of a place is the one that its worn depth stands for (`law::plating`), and the layer that lies open there is that of the
//! depth, so that neither is a state of its own.

use std::ops::Range;

use super::{Coefficients, Friction, Table, of_both};
use crate::change::Change;
use crate::law::plating::{Layer, bottoms};
use crate::law::surface::SurfaceWear;
use crate::sides::{Side, Sides};

/// Coefficients of friction of a contact.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ContactFriction {
    /// The same at every place, after so many cycles.
    Uniform(Table),
    /// Friction of each surface, of at least one of them.
    BySurface(Box<Sides<Option<SurfaceFriction>>>),
}

/// Coefficients of friction in a computed cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct CycleFriction {
    /// Mean of the cycles that the computed one represents, -; the largest where places differ in it.
    pub(crate) coefficient: f64,
    /// Coefficients at the nodes of the surfaces that it differs on, -.
    nodal: Sides<Option<Vec<f64>>>,
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
    /// Friction by a law of surfaces that wear in this way, through the layers of their platings or, without these, by the outermost alone.
    pub(crate) fn new(
        law: &Friction,
        wear: &Sides<Option<SurfaceWear>>,
        platings: Option<Sides<&[Layer]>>,
    ) -> Self {
        if !law.changes() {
            return Self::constant(law.unworn());
        }
        let surfaces = match law {
            Friction::Frictionless | Friction::Coulomb { .. } => Sides::default(),
            Friction::ByCycle(table) => return Self::Uniform(table.clone()),
            Friction::ByDose(table) => {
                Sides::from_fn(|side| SurfaceFriction::by_dose(table, (*wear.of(side))?))
            }
            Friction::ByLayer(layers) => Sides::from_fn(|side| {
                let plating = platings.as_ref().map(|platings| *platings.of(side));
                SurfaceFriction::by_layer(layers.of(side), plating)
            }),
        };
        if surfaces.slider.is_none() && surfaces.receptacle.is_none() {
            // Nothing wears, and so nothing changes.
            return Self::constant(law.unworn());
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

    /// The same coefficient everywhere and always, -.
    pub(crate) fn constant(coefficient: f64) -> Self {
        Self::Uniform(Table::new(&[(0.0, coefficient)]))
    }

    /// Table by cycle; `None` where places differ in the coefficient.
    pub(crate) fn by_cycle(&self) -> Option<&Table> {
        match self {
            Self::Uniform(table) => Some(table),
            Self::BySurface(_) => None,
        }
    }

    /// Coefficients from one number of cycles to another on surfaces of these worn depths, mm.
    pub(crate) fn in_cycles(&self, depth: &Sides<Vec<f64>>, cycles: Range<f64>) -> CycleFriction {
        match self {
            Self::Uniform(table) => CycleFriction {
                coefficient: table.mean(cycles.start, cycles.end),
                nodal: Sides::default(),
            },
            Self::BySurface(_) => {
                let nodal = self.nodal(depth);
                let most = nodal.as_ref().map(|nodes| {
                    let nodes = nodes.as_ref()?;
                    Some(Coefficients::Local(nodes).largest())
                });
                CycleFriction {
                    coefficient: of_both(most).unwrap_or(0.0),
                    nodal,
                }
            }
        }
    }

    /// Coefficients at the nodes of the surfaces with these depths, mm.
    fn nodal(&self, depth: &Sides<Vec<f64>>) -> Sides<Option<Vec<f64>>> {
        Sides::from_fn(|side| {
            let surface = self.of_surface(side)?;
            let nodes = depth.of(side).iter();
            Some(nodes.map(|depth| surface.at(*depth)).collect())
        })
    }

    /// Half the relative change of the coefficient over a computed cycle that changes the depths of the surfaces, mm, by doses that each place
    /// has received times its size,
    ///   1/2 sum w dD |mu_after - mu_before| / sum w dD mu_after:
    /// the error of the energy of gross slip by the coefficients of its beginning; 0 where all places have one.
    pub(crate) fn change(
        &self,
        depth: Change<&Sides<Vec<f64>>>,
        dose: impl Fn(Side, usize) -> f64,
    ) -> f64 {
        let (mut change, mut total) = (0.0, 0.0);
        for side in Side::BOTH {
            let Some(friction) = self.of_surface(side) else {
                continue;
            };
            let depths = depth.before.of(side).iter().zip(depth.after.of(side));
            for (place, (before, after)) in depths.enumerate() {
                let (dose, mu) = (dose(side, place), friction.at(*after));
                change += dose * (mu - friction.at(*before)).abs();
                total += dose * mu;
            }
        }
        if total > 0.0 {
            0.5 * change / total
        } else {
            0.0
        }
    }

    /// The same for nodes of these widths whose equivalent depths change, mm.
    pub(crate) fn change_at_nodes(
        &self,
        wear: &Sides<Option<SurfaceWear>>,
        widths: Sides<&[f64]>,
        depth: Change<&Sides<Vec<f64>>>,
        worn: Change<Sides<&[f64]>>,
    ) -> f64 {
        let rates = wear.map(|wear| wear.and_then(SurfaceWear::dose_rate).unwrap_or(1.0));
        self.change(depth, |side, node| {
            let (before, after) = (worn.before.of(side)[node], worn.after.of(side)[node]);
            widths.of(side)[node] * (after - before) / rates.of(side)
        })
    }
}

impl CycleFriction {
    /// Coefficients at the nodes of the surfaces that it differs on, -.
    pub(crate) fn nodal(&self) -> Sides<Option<&[f64]>> {
        self.nodal.as_ref().map(|nodes| nodes.as_deref())
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

    fn by_layer(coefficients: &[f64], plating: Option<&[Layer]>) -> Option<Self> {
        let outer = *coefficients.first()?;
        let Some(plating) = plating else {
            return Some(Self::ByLayer {
                bottoms: Vec::new(),
                coefficients: vec![outer],
            });
        };
        Some(Self::ByLayer {
            bottoms: bottoms(plating).collect(),
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
    use crate::law::wear::WearLaw;

    /// Rate of the base, 1/MPa.
    const BASE: f64 = 2.5e-5;

    /// Friction of a receptacle with 1 um of a layer at 1e-6 1/MPa, and of a slider that does not wear.
    fn friction(law: &Friction, layered: bool) -> ContactFriction {
        let layers = [Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-6,
        }];
        let base = WearLaw::Archard {
            k_over_h_per_mpa: BASE,
        };
        let wear = Sides {
            slider: None,
            receptacle: SurfaceWear::new(&layers, Some(base)),
        };
        let platings = Sides {
            slider: &[][..],
            receptacle: &layers[..],
        };
        ContactFriction::new(law, &wear, layered.then_some(platings))
    }

    #[test]
    fn the_layer_that_lies_open_determines_the_coefficient() {
        let coefficients = vec![0.2, 0.6];
        let law = Friction::ByLayer(Sides {
            slider: Vec::new(),
            receptacle: coefficients,
        });
        let depth = Sides {
            slider: vec![0.0; 2],
            receptacle: vec![0.0, 0.99e-3, 1e-3, 1.0],
        };
        let nodal = friction(&law, true).nodal(&depth);
        assert_eq!(nodal.receptacle, Some(vec![0.2, 0.2, 0.6, 0.6]));
        assert_eq!(nodal.slider, None);
        let outer = friction(&law, false).nodal(&depth);
        assert_eq!(outer.receptacle, Some(vec![0.2; 4]));
    }

    #[test]
    fn the_dose_of_a_depth_is_that_of_its_layers() {
        let table = Table::new(&[(0.0, 0.2), (1_000.0, 0.4), (1_100.0, 0.5)]);
        let law = Friction::ByDose(table);
        let depth = Sides {
            slider: vec![0.0],
            receptacle: vec![0.0, 0.5e-3, 1e-3, 1e-3 + 50.0 * BASE],
        };
        let friction = friction(&law, true);
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
        let unworn = ContactFriction::new(&Friction::ByDose(table), &Sides::default(), None);
        assert_eq!(unworn, ContactFriction::Uniform(Table::new(&[(0.0, 0.2)])));
        let found = unworn.in_cycles(&Sides::default(), 5.0..6.0);
        assert!((found.coefficient - 0.2).abs() < 1e-15);
    }
}
