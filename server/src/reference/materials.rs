//! The material library: reference data with provenance.
//!
//! "Source" is the thesis the product reproduces (D. Shinde, *Wear simulation of electrical contacts subjected to
//! vibrations*). It uses 427 MPa (copper) and 424 MPa (steel) as hardness in its wear formulas, and Hv 130 and
//! Hv 700 in its validation chapter; both are listed under names of their own (`copper` and `copper_hv130`, `steel` and
//! `steel_hv700`; Vickers numbers times 9.80665 MPa).

use api::spec::{MaterialProperties, Provenance};

/// A material of the library.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LibraryMaterial {
    /// Its name.
    pub(crate) name: &'static str,
    /// Young's modulus, MPa.
    youngs_modulus_mpa: f64,
    /// Poisson's ratio, -.
    poisson_ratio: f64,
    /// Hardness, MPa.
    pub(crate) hardness_mpa: f64,
    /// Provenance of the hardness.
    pub(crate) hardness_provenance: Provenance,
    /// Archard's wear coefficient of the material on itself, -, from the table of the source
    /// (E. Rabinowicz, *Friction and Wear of Materials*, 1995), if listed there.
    pub(crate) archard_k: Option<f64>,
    density_kg_m3: f64,
    thermal_conductivity_w_mk: f64,
    specific_heat_j_kgk: f64,
    resistivity_ohm_m: f64,
    thermal_expansion_per_k: f64,
}

/// One row of the table below: name, E, nu, H and its provenance, k, and the five thermal and electrical properties
/// at room temperature (density, conductivity, specific heat, resistivity, expansion), which are handbook values.
const fn row(
    name: &'static str,
    elastic: (f64, f64),
    hardness: (f64, Provenance),
    archard_k: Option<f64>,
    thermal: [f64; 5],
) -> LibraryMaterial {
    LibraryMaterial {
        name,
        youngs_modulus_mpa: elastic.0,
        poisson_ratio: elastic.1,
        hardness_mpa: hardness.0,
        hardness_provenance: hardness.1,
        archard_k,
        density_kg_m3: thermal[0],
        thermal_conductivity_w_mk: thermal[1],
        specific_heat_j_kgk: thermal[2],
        resistivity_ohm_m: thermal[3],
        thermal_expansion_per_k: thermal[4],
    }
}

const COPPER: [f64; 5] = [8960.0, 398.0, 385.0, 1.68e-8, 16.5e-6];
const STEEL: [f64; 5] = [7850.0, 50.0, 470.0, 1.7e-7, 11.8e-6];

use Provenance::{Source, Typical};

/// Every material of the library.
pub(crate) const MATERIALS: &[LibraryMaterial] = &[
    row(
        "copper",
        (117_000.0, 0.34),
        (427.0, Source),
        Some(0.0110),
        COPPER,
    ),
    row(
        "copper_hv130",
        (117_000.0, 0.34),
        (1275.0, Source),
        Some(0.0110),
        COPPER,
    ),
    row(
        "steel",
        (200_000.0, 0.29),
        (424.0, Source),
        Some(0.0150),
        STEEL,
    ),
    row(
        "steel_hv700",
        (200_000.0, 0.29),
        (6865.0, Source),
        Some(0.0150),
        STEEL,
    ),
    row(
        "silver",
        (83_000.0, 0.37),
        (250.0, Typical),
        Some(0.0040),
        [10_490.0, 429.0, 235.0, 1.59e-8, 18.9e-6],
    ),
    row(
        "platinum",
        (168_000.0, 0.38),
        (540.0, Typical),
        Some(0.0130),
        [21_450.0, 71.6, 133.0, 1.06e-7, 8.8e-6],
    ),
    row(
        "becu",
        (131_000.0, 0.30),
        (3700.0, Typical),
        None,
        [8250.0, 105.0, 420.0, 7.7e-8, 17.0e-6],
    ),
    row(
        "phosphor_bronze",
        (110_000.0, 0.34),
        (1900.0, Typical),
        None,
        [8860.0, 63.0, 380.0, 1.3e-7, 17.8e-6],
    ),
    row(
        "gold",
        (78_000.0, 0.42),
        (250.0, Typical),
        None,
        [19_300.0, 318.0, 129.0, 2.21e-8, 14.2e-6],
    ),
    row(
        "hard_gold",
        (78_000.0, 0.42),
        (1700.0, Typical),
        None,
        [17_300.0, 220.0, 129.0, 3.0e-8, 14.2e-6],
    ),
    row(
        "nickel",
        (200_000.0, 0.31),
        (2000.0, Typical),
        None,
        [8908.0, 90.9, 444.0, 6.99e-8, 13.4e-6],
    ),
    row(
        "tin",
        (50_000.0, 0.36),
        (100.0, Typical),
        None,
        [7310.0, 66.8, 227.0, 1.15e-7, 22.0e-6],
    ),
    row(
        "brass",
        (105_000.0, 0.34),
        (1300.0, Typical),
        None,
        [8530.0, 120.0, 380.0, 6.4e-8, 19.9e-6],
    ),
];

impl LibraryMaterial {
    /// Returns the material of that name.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        MATERIALS.iter().find(|material| material.name == name)
    }

    /// Its properties as written in a resolved specification.
    pub(crate) fn properties(&self) -> MaterialProperties {
        MaterialProperties {
            name: Some(self.name.to_owned()),
            youngs_modulus_mpa: Some(self.youngs_modulus_mpa),
            poisson_ratio: Some(self.poisson_ratio),
            hardness_mpa: Some(self.hardness_mpa),
            density_kg_m3: Some(self.density_kg_m3),
            thermal_conductivity_w_mk: Some(self.thermal_conductivity_w_mk),
            specific_heat_j_kgk: Some(self.specific_heat_j_kgk),
            resistivity_ohm_m: Some(self.resistivity_ohm_m),
            thermal_expansion_per_k: Some(self.thermal_expansion_per_k),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_hardness_values_of_the_source_have_a_name() {
        let hardness = |name| LibraryMaterial::named(name).map(|material| material.hardness_mpa);
        assert_eq!(hardness("copper"), Some(427.0));
        assert_eq!(hardness("copper_hv130"), Some(1275.0));
        assert_eq!(hardness("steel"), Some(424.0));
        assert_eq!(hardness("steel_hv700"), Some(6865.0));
    }

    #[test]
    fn names_are_unique() {
        let mut names: Vec<_> = MATERIALS.iter().map(|material| material.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), MATERIALS.len());
    }
}
