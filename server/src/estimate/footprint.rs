//! Estimated size of a solve: unknowns, memory and output.
//!
//! The memory coefficients were fitted to measured runs of all systems at tolerances of 10, 5, 2, 1 and 0.3 % (5 000 to
//! 135 000 unknowns, 70 to 1 540 surface nodes; `tests/cases/bench/night.rs` prints them), which they match within a
//! fifth: a sparse factor grows almost linearly with the unknowns, and the body with the larger surface is condensed
//! with several matrices of its surface at once. The output coefficients are rough: `fretwear plan`
//! estimates 0.91 MB for `fuzz_button.json` and 0.31 MB for `mccoll.json`, `fretwear solve` writes 1.44 and 0.66 MB.

use solver::model::{BodyLayout, Layout};
use solver::scene::{Dimension, Line, LineShape, Scene};

use crate::estimate::workload::Workload;
use crate::number::real;
use solver::closed_form::cell_mm as point_cell_mm;

/// Memory of the process without a model, MB.
const MEMORY_BASE_MB: f64 = 9.5;
/// Memory per unknown, MB.
const MEMORY_DOF_MB: f64 = 1.0e-3;
/// Memory per pair of nodes on the larger surface, MB.
const MEMORY_PAIR_MB: f64 = 2.4e-4;
/// Memory per pair of nodes of one of several zones: a block of its compliance, MB.
const STORED_PAIR_MB: f64 = 32e-6;
/// Memory of the operators of a further section along a line, per pair of nodes of its larger surface, MB.
const OPERATOR_PAIR_MB: f64 = 3.2e-5;
/// Memory of a number of the contacts at all positions of an implicit jump, MB. 50 000 cycles of `sd_card`, `dimm` and `zif` take 17 to 20 MB more
/// than one, where 19 to 20 are estimated.
const HELD_NUMBER_MB: f64 = 8e-6;
/// Fields at one position: bytes per unknown.
const FIELDS_DOF_BYTES: f64 = 101.0;
/// Fields along a line at one position: compressed bytes per unknown of a section, for each of the whole line. `fretwear solve` of 20 cycles
/// (`draft`, a ring of 20 sections, a crowned line of 23) writes files of 11.7 to 14.9 MB and of 2.2 to 2.6 MB. The sections of a ring are finely
/// meshed in different places, all of which its common mesh has.
const RING_DOF_BYTES: f64 = 42.0;
const STRAIGHT_DOF_BYTES: f64 = 11.0;
/// The same of extruded bodies, whose sections differ: `draft` wires of 2 and 8 layers and a card's spring of 4 write files of 0.71, 2.4 and
/// 1.04 MB.
const EXTRUDED_DOF_BYTES: f64 = 21.0;
/// Memory of the fields of extruded bodies at three positions and of the file of one, per unknown of a section for each of the whole width, MB.
/// Measured with and without fields: 6, 16 and 19 MB more.
const EXTRUDED_FIELDS_DOF_MB: f64 = 2e-4;
/// Maps of a line: bytes of their picture, and per surface element of a section of the whole line.
const MAPS_PICTURE_BYTES: f64 = 3e5;
const MAPS_ELEMENT_BYTES: f64 = 12.0;
/// A snapshot: bytes per surface element, as rows and as documents.
const SNAPSHOT_ELEMENT_BYTES: f64 = 200.0;
/// A computed cycle: bytes as row, event and documents; and per station.
const CYCLE_BYTES: f64 = 1000.0;
const STATION_BYTES: f64 = 60.0;

/// A point contact: memory per cell of its window and of the surfaces of both bodies, MB, and bytes of a cell of its maps.
const MEMORY_CELL_MB: f64 = 4e-4;
const MEMORY_SURFACE_MB: f64 = 2e-4;
const MAP_CELL_BYTES: f64 = 40.0;

/// Estimated size of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint {
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Unknowns of both bodies.
    pub dofs: f64,
    /// Estimated peak memory, MB.
    pub memory_mb: f64,
    /// Estimated stored output, MB.
    pub output_mb: f64,
}

impl Footprint {
    /// Estimates the footprint of a scene from its mesh lines and its workload.
    pub(crate) fn of(scene: &Scene, layout: Option<&Layout>, workload: &Workload) -> Self {
        match layout {
            Some(layout) => Self::of_section(scene, layout, workload),
            None => Self::of_point(scene, workload),
        }
    }

    /// Footprint of a point contact: the transforms of its window, and copies of the grids of both bodies.
    fn of_point(scene: &Scene, workload: &Workload) -> Self {
        let (window, surfaces) = workload.cells;
        let snapshots = real(scene.output.snapshots_at_cycles.len());
        let stations = real(scene.output.stations_mm.len());
        let bytes = snapshots * MAP_CELL_BYTES * (window + surfaces)
            + workload.computed_cycles * (CYCLE_BYTES + STATION_BYTES * stations);
        Self {
            contact_element_mm: point_cell_mm(scene),
            dofs: window,
            memory_mb: MEMORY_BASE_MB
                + MEMORY_CELL_MB * window
                + MEMORY_SURFACE_MB * surfaces
                + HELD_NUMBER_MB * workload.held_numbers,
            output_mb: 1e-6 * bytes,
        }
    }

    fn of_section(scene: &Scene, layout: &Layout, workload: &Workload) -> Self {
        let dofs = real(layout.bodies.slider.dofs() + layout.bodies.receptacle.dofs());
        let elements = real(layout.bodies.receptacle.contact_x().len());
        let largest = layout.bodies.as_ref().map(BodyLayout::largest_zone);
        let surface = real(largest.slider.max(largest.receptacle));
        let stored = layout.bodies.as_ref().map(BodyLayout::further_pairs);
        let stored = real(stored.slider + stored.receptacle);
        let snapshots = real(scene.output.snapshots_at_cycles.len());
        let stations = real(scene.output.stations_mm.len());
        // Three positions per snapshot, and the neutral position of the unworn state.
        let fields = if scene.output.fields {
            3.0 * snapshots + 1.0
        } else {
            0.0
        };
        // Sections along a line have operators of their own once they have worn, node planes have them together.
        let (sections, planes) = (real(workload.stations), real(workload.planes));
        let (joint, own) = (planes * surface, sections - planes);
        let (of_fields, of_maps) = along_line(scene, workload);
        let bytes = fields * of_fields * dofs
            + snapshots * SNAPSHOT_ELEMENT_BYTES * elements * sections
            + snapshots * of_maps(elements)
            + workload.computed_cycles * (CYCLE_BYTES * sections + STATION_BYTES * stations);
        Self {
            contact_element_mm: layout.sizes.contact_element,
            dofs: displacements_of_a_node(scene) / 2.0 * sections * dofs,
            memory_mb: MEMORY_BASE_MB
                + MEMORY_DOF_MB * dofs * planes * planes
                + MEMORY_PAIR_MB * joint * joint
                + STORED_PAIR_MB * stored * planes * planes
                + own * OPERATOR_PAIR_MB * surface * surface
                + HELD_NUMBER_MB * workload.held_numbers
                + memory_of_fields(scene, dofs),
            output_mb: 1e-6 * bytes,
        }
    }

    /// Estimates of a plan, by name.
    pub(super) fn estimates(self) -> [(&'static str, f64); 4] {
        [
            ("contact_element_mm", self.contact_element_mm),
            ("dofs", self.dofs),
            ("memory_mb", self.memory_mb),
            ("output_mb", self.output_mb),
        ]
    }
}

/// Components of the displacement of a node of a finite element.
fn displacements_of_a_node(scene: &Scene) -> f64 {
    if scene.dimension.extruded().is_some() {
        3.0
    } else {
        2.0
    }
}

/// Memory of the fields of extruded bodies whose section has so many unknowns, MB: the interior is factored again in the place of what a
/// condensation takes.
fn memory_of_fields(scene: &Scene, dofs: f64) -> f64 {
    let extruded = scene.dimension.extruded();
    let extruded = extruded.filter(|_| scene.output.fields);
    extruded.map_or(0.0, |extruded| {
        EXTRUDED_FIELDS_DOF_MB * dofs * real(extruded.layers + 1)
    })
}

/// Bytes of the fields at one position per unknown of a section, and of the maps at one cycle by the surface elements of a section.
fn along_line(scene: &Scene, workload: &Workload) -> (f64, impl Fn(f64) -> f64) {
    let whole = real(2 * workload.stations);
    let (of_fields, sections) = match scene.dimension {
        Dimension::PlaneStrain | Dimension::Point(_) => (FIELDS_DOF_BYTES, 0.0),
        Dimension::Extruded(_) => ((whole - 1.0) * EXTRUDED_DOF_BYTES, whole - 1.0),
        Dimension::Line(Line {
            shape: LineShape::Ring { .. },
            ..
        }) => ((whole - 2.0) * RING_DOF_BYTES, whole - 1.0),
        Dimension::Line(Line {
            shape: LineShape::Straight { tilt_mrad, .. },
            ..
        }) => {
            let sections = if tilt_mrad == 0.0 {
                whole - 1.0
            } else {
                0.5 * whole
            };
            (sections * STRAIGHT_DOF_BYTES, sections)
        }
    };
    let of_maps = move |elements: f64| {
        if sections > 0.0 {
            MAPS_PICTURE_BYTES + MAPS_ELEMENT_BYTES * elements * sections
        } else {
            0.0
        }
    };
    (of_fields, of_maps)
}

#[cfg(test)]
mod tests {
    use super::Footprint;
    use crate::estimate::Estimate;
    use crate::spec;

    /// The surfaces of the base scene.
    const FUZZ_BUTTON: &str = r#""plating":{"slider":[],"receptacle":[]},"materials":{"slider":"copper","receptacle":"copper"},
        "interface":{"friction":{"law":"coulomb","coefficient":1.21},
        "wear":{"slider":null,"receptacle":{"law":"archard","k":0.011,"hardness_mpa":427}}}"#;

    fn footprint(text: &str) -> Footprint {
        Estimate::of(&spec::read(text.as_bytes()).expect("accepted")).footprint
    }

    #[test]
    fn estimates_match_measured_runs() {
        let zif = r#""plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k":0.004,"hardness_mpa":1700}}}"#;
        // Unknowns and peak memory of whole runs, as `fretwear solve` reported them.
        for (kind, surfaces, preset, dofs, memory_mb) in [
            ("fuzz_button", FUZZ_BUTTON, "fine", 75_660.0, 262.0),
            ("fuzz_button", FUZZ_BUTTON, "standard", 21_488.0, 66.0),
            ("zif", zif, "fine", 56_144.0, 107.0),
            (
                "cylinder_on_flat",
                "\"materials\":{}",
                "draft",
                5_760.0,
                16.0,
            ),
        ] {
            let text = format!(
                r#"{{"system":{{"kind":"{kind}"}},{surfaces},"accuracy":{{"preset":"{preset}"}}}}"#
            );
            let footprint = footprint(&text);
            assert!(
                (footprint.dofs / dofs - 1.0).abs() < 0.2,
                "{text}: {footprint:?}"
            );
            assert!(
                (footprint.memory_mb / memory_mb - 1.0).abs() < 0.25,
                "{text}: {footprint:?}"
            );
        }
    }

    #[test]
    fn nodes_of_extruded_bodies_have_three_displacements() {
        let text = format!(
            r#"{{"system":{{"kind":"fuzz_button"}},"model":{{"preset":"source_extruded"}},{FUZZ_BUTTON},"cycles":2000}}"#
        );
        // As `fretwear solve` reported.
        let dofs = footprint(&text).dofs;
        assert!((dofs / 64_464.0 - 1.0).abs() < 0.05, "{dofs}");
    }

    /// Files of four positions, and peak memory with fields over that without, of 20 cycles.
    #[test]
    fn fields_of_extruded_bodies_are_as_large_as_measured() {
        let fuzz = |layers: u32| {
            format!(
                r#""system":{{"kind":"fuzz_button"}},"model":{{"dimension":"extruded","layers":{layers},"layer_growth":1.5}}"#
            )
        };
        let card = r#""system":{"kind":"sd_card"},"model":{"dimension":"extruded","width_mm":0.8,"layers":4,"layer_growth":3},
            "load":{"kind":"force","n":0.5}"#;
        for (bodies, files_mb, memory_mb) in [
            (fuzz(2), 2.83, 178.0),
            (fuzz(8), 9.43, 900.0),
            (card.to_owned(), 3.91, 173.0),
        ] {
            let of = |fields: bool| {
                footprint(&format!(
                    r#"{{{bodies},"cycles":20,"accuracy":{{"preset":"draft"}},"output":{{"snapshots_at_cycles":[20],"fields":{fields}}}}}"#
                ))
            };
            let (with, without) = (of(true), of(false));
            let files = with.output_mb - without.output_mb;
            assert!((files / files_mb - 1.0).abs() < 0.2, "{bodies}: {files}");
            assert!(
                (with.memory_mb / memory_mb - 1.0).abs() < 0.3,
                "{bodies}: {with:?}"
            );
        }
    }

    #[test]
    fn fields_along_lines_are_as_large_as_measured() {
        let ring = format!(
            r#""system":{{"kind":"fuzz_button"}},"model":{{"dimension":"ring","outer_diameter_mm":1.016,"top":"rigid"}},{FUZZ_BUTTON},
            "load":{{"kind":"force","n":0.834}},
            "motion":{{"kind":"reciprocating","waveform":"sine","amplitude_mm":0.033868,"period_s":16,"drive":"slider_top"}}"#
        );
        let crown = r#""system":{"kind":"sd_card"},"model":{"dimension":"line","width_mm":0.8,"crown_radius_mm":10},
            "load":{"kind":"force","n":0.5},"motion":{"kind":"reciprocating","amplitude_mm":0.02,"frequency_hz":20}"#;
        for (line, megabytes) in [(ring.as_str(), 50.2), (crown, 10.0)] {
            let of = |fields: bool| {
                footprint(&format!(
                    r#"{{{line},"cycles":20,"accuracy":{{"preset":"draft"}},"output":{{"snapshots_at_cycles":[20],"fields":{fields}}}}}"#
                ))
            };
            // Four files.
            let found = of(true).output_mb - of(false).output_mb;
            assert!((found / megabytes - 1.0).abs() < 0.3, "{line}: {found}");
        }
    }

    #[test]
    fn fields_and_fixed_jumps_add_output() {
        let of = |output: &str| {
            footprint(&format!(
                r#"{{"system":{{"kind":"fuzz_button"}},{FUZZ_BUTTON},"output":{{{output}}}}}"#
            ))
        };
        let plain = of(r#""snapshots_at_cycles":[2]"#);
        let fields = of(r#""snapshots_at_cycles":[2],"fields":true"#);
        // Four files of 2.15 MB.
        assert!(
            (fields.output_mb - plain.output_mb - 8.6).abs() < 1.0,
            "{fields:?}"
        );
        let every = footprint(
            r#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#,
        );
        assert!(every.output_mb > 1000.0, "{every:?}");
    }
}
