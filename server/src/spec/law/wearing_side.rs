//! The side that a wear law belongs to.

use api::spec::Material;

use crate::reference::materials::LibraryMaterial;

/// A side with its material as given and as resolved.
pub(in crate::spec) struct WearingSide<'a> {
    pub(in crate::spec) pointer: String,
    pub(in crate::spec) given: Option<&'a Material>,
    pub(in crate::spec) resolved: Option<&'a Material>,
    /// Temperature of the surroundings, °C.
    pub(in crate::spec) surroundings_c: f64,
}

impl WearingSide<'_> {
    /// JSON pointer of a field of the law.
    pub(super) fn field(&self, name: &str) -> String {
        format!("{}/{name}", self.pointer)
    }

    /// The material of the library that was named.
    pub(super) fn library(&self) -> Option<&'static LibraryMaterial> {
        match self.given {
            Some(Material::Named(name)) => LibraryMaterial::named(name),
            _ => None,
        }
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
