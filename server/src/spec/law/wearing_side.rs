//! The side that a wear law belongs to.

use api::spec::Material;

use crate::reference::materials::LibraryMaterial;

/// A side with its material as given and as resolved.
pub(super) struct WearingSide<'a> {
    pub(super) pointer: String,
    pub(super) given: Option<&'a Material>,
    pub(super) resolved: Option<&'a Material>,
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

    /// Hardness of the resolved material, MPa.
    pub(super) fn hardness_mpa(&self) -> Option<f64> {
        match self.resolved {
            Some(Material::Given(properties)) => properties.hardness_mpa,
            _ => None,
        }
    }
}
