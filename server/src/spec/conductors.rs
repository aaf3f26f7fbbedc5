//! Conductors of both parts: their layers and bases with resistivities and hardnesses, for the constriction of the current.

use api::spec::{Material, Spec, WearLaw};
use solver::law::plating::bottoms;
use solver::law::resistance::Conductor;
use solver::scene::{Layer, Scene, Softening};
use solver::sides::{Side, Sides};

use crate::spec::environment;
use crate::spec::materials;
use crate::spec::plating;

/// A layer, or a base, of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Metal {
    /// Depth of its lower end below the unworn surface, mm; of a base without bound.
    bottom_mm: f64,
    resistivity_ohm_m: f64,
    /// Hardness at the temperature of the contact, MPa.
    pub(crate) hardness_mpa: f64,
}

/// Both parts of a contact that carries a force.
#[derive(Debug, Clone, PartialEq)]
pub struct Conductors {
    /// Force on the contact, N.
    pub(crate) force_n: f64,
    /// Metals from the surface down.
    metals: Sides<Vec<Metal>>,
}

impl Conductors {
    /// Metals of both sides that are left at a depth in mm of each, from the surface down.
    pub(crate) fn left_at(&self, depth: Sides<f64>) -> Sides<Vec<(Metal, Conductor)>> {
        Sides::from_fn(|side| {
            let depth = *depth.of(side);
            let metals = self.metals.of(side).iter();
            let left = metals
                .filter(|metal| metal.bottom_mm > depth)
                .scan(depth, |top, metal| {
                    let thickness_mm = metal.bottom_mm - *top;
                    *top = metal.bottom_mm;
                    let resistivity_ohm_m = metal.resistivity_ohm_m;
                    Some((
                        *metal,
                        Conductor {
                            resistivity_ohm_m,
                            thickness_mm,
                        },
                    ))
                });
            left.collect()
        })
    }
}

/// Conductors of a resolved specification; `None` where the force on the contact, a resistivity or a hardness is not known.
pub(super) fn resolve(filled: &Spec, scene: &Scene) -> Option<Conductors> {
    let force_n = filled.load.as_ref()?.n?;
    let bases = materials::by_side(&filled.materials);
    let layers = plating::by_side(&filled.plating);
    let laws = environment::laws(filled);
    let of = |side| {
        let layers = layers.of(side).iter();
        let layers = layers.map(|layer| (layer.material.as_ref(), layer.wear.as_ref()));
        let materials = layers.chain([(*bases.of(side), *laws.of(side))]);
        let (plating, softening): (&[Layer], &Softening) = match side {
            Side::Slider => (&scene.slider.plating, &scene.slider.softening),
            Side::Receptacle => (&scene.receptacle.plating, &scene.receptacle.softening),
        };
        let bottoms = bottoms(plating).chain([f64::INFINITY]);
        let metals = materials.zip(bottoms).enumerate();
        metals
            .map(|(number, ((material, law), bottom_mm))| {
                metal((material, law), bottom_mm, softening.ratio(number))
            })
            .collect::<Option<Vec<Metal>>>()
    };
    let metals = Sides {
        slider: of(Side::Slider)?,
        receptacle: of(Side::Receptacle)?,
    };
    Some(Conductors { force_n, metals })
}

/// A metal with the hardness that its wear law states, or its own.
fn metal(
    (material, law): (Option<&Material>, Option<&WearLaw>),
    bottom_mm: f64,
    softening: f64,
) -> Option<Metal> {
    let Some(Material::Given(properties)) = material else {
        return None;
    };
    let of_law = law.and_then(|law| law.hardness_mpa);
    let hardness_mpa = of_law.or(properties.hardness_mpa)? * softening;
    Some(Metal {
        bottom_mm,
        resistivity_ohm_m: properties.resistivity_ohm_m?,
        hardness_mpa,
    })
}
