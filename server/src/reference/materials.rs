//! The material library: reference data with provenance, the table `materials.csv`.
//!
//! "Source" is the thesis the product reproduces (D. Shinde, *Wear simulation of electrical contacts subjected to
//! vibrations*). It uses 427 MPa (copper) and 424 MPa (steel) as hardness in its wear formulas, and Hv 130 and
//! Hv 700 in its validation chapter; both are listed under names of their own (`copper` and `copper_hv130`, `steel` and
//! `steel_hv700`; Vickers numbers times 9.80665 MPa). The thermal and electrical properties are handbook values at room
//! temperature; of alloys the melting temperature is that of the solidus (steel: of a plain carbon steel; hard gold: of gold).

use std::sync::LazyLock;

use api::spec::{MaterialProperties, Provenance};
use serde::Deserialize;

/// A material of the library.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct LibraryMaterial {
    /// Properties, the name included, as written in a resolved specification.
    #[serde(flatten)]
    pub(crate) properties: MaterialProperties,
    /// Provenance of the hardness.
    pub(crate) hardness_provenance: Provenance,
    /// Archard's wear coefficient of the material on itself, -, from the table of the source
    /// (E. Rabinowicz, *Friction and Wear of Materials*, 1995), if listed there.
    pub(crate) archard_k: Option<f64>,
}

/// Every material of the library. A test reads every row of the table.
static MATERIALS: LazyLock<Vec<LibraryMaterial>> = LazyLock::new(|| {
    csv::Reader::from_reader(include_bytes!("materials.csv").as_slice())
        .into_deserialize()
        .filter_map(Result::ok)
        .collect()
});

impl LibraryMaterial {
    /// Returns the material of that name.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        MATERIALS
            .iter()
            .find(|material| material.properties.name.as_deref() == Some(name))
    }

    /// Names of all materials.
    pub(crate) fn names() -> Vec<&'static str> {
        let names = MATERIALS.iter().map(|material| &material.properties.name);
        names.flatten().map(String::as_str).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_hardness_values_of_the_source_have_a_name() {
        let hardness = |name| LibraryMaterial::named(name)?.properties.hardness_mpa;
        assert_eq!(hardness("copper"), Some(427.0));
        assert_eq!(hardness("copper_hv130"), Some(1275.0));
        assert_eq!(hardness("steel"), Some(424.0));
        assert_eq!(hardness("steel_hv700"), Some(6865.0));
    }

    #[test]
    fn every_row_of_the_table_is_a_material_with_a_name_of_its_own_and_all_properties() {
        let mut names = LibraryMaterial::names();
        names.sort_unstable();
        names.dedup();
        let rows = include_str!("materials.csv").lines().skip(1).count();
        assert_eq!(names.len(), rows);
        for material in MATERIALS.iter() {
            let properties = serde_json::to_value(&material.properties).expect("JSON");
            let fields = properties.as_object().expect("an object");
            assert_eq!(fields.values().filter(|value| value.is_number()).count(), 9);
        }
    }
}
