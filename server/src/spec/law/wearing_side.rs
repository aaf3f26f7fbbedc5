//! The side that a wear law belongs to.

use api::spec::Material;

use crate::reference::materials::LibraryMaterial;
use crate::spec::materials;

/// A side with its material as given and as resolved.
pub(in crate::spec) struct WearingSide<'a> {
    pub(in crate::spec) pointer: String,
    pub(in crate::spec) given: Option<&'a Material>,
    pub(in crate::spec) resolved: Option<&'a Material>,
    /// The material whose coefficients stand where the specification gives none; nothing where those of the preset do.
    pub(in crate::spec) wears_as: Option<&'a Material>,
    /// Temperature of the surroundings, °C.
    pub(in crate::spec) surroundings_c: f64,
}

impl WearingSide<'_> {
    /// JSON pointer of a field of the law.
    pub(super) fn field(&self, name: &str) -> String {
        format!("{}/{name}", self.pointer)
    }

    /// The material of the library whose coefficients stand, named alone or as the name of given properties.
    pub(super) fn library(&self) -> Option<&'static LibraryMaterial> {
        LibraryMaterial::named(materials::name(self.wears_as?)?)
    }

    /// The given hardness of a material with the name of one of the library, if it is another than the library's, MPa.
    pub(super) fn changed_hardness_mpa(&self) -> Option<f64> {
        let Some(Material::Given(properties)) = self.given else {
            return None;
        };
        let listed = LibraryMaterial::named(properties.name.as_deref()?)?;
        let hardness = properties.hardness_mpa;
        hardness.filter(|_| hardness != listed.properties.hardness_mpa)
    }

    /// The material of the library that the side consists of, named or by default.
    pub(super) fn resolved_library(&self) -> Option<&'static LibraryMaterial> {
        match (self.given, self.resolved) {
            (Some(Material::Given(_)), _) | (_, None) => None,
            (_, Some(Material::Given(properties))) => {
                LibraryMaterial::named(properties.name.as_deref()?)
            }
            (_, Some(Material::Named(name))) => LibraryMaterial::named(name),
        }
    }

    /// Hardness of the resolved material, MPa.
    pub(super) fn hardness_mpa(&self) -> Option<f64> {
        match self.resolved {
            Some(Material::Given(properties)) => properties.hardness_mpa,
            _ => None,
        }
    }
}
