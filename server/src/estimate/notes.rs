//! Notes of a plan: contradictions in the source of the presets that concern the values of the specification.

use api::spec::{EnumValue, LoadKind, Preset, Provenance, Spec, SystemKind, WearLaw};
use solver::closed_form::expected_wear::{crown_half_lengths_mm, expected_end};
use solver::closed_form::unworn_contact;
use solver::closed_form::{PointScene, SlipRegime};
use solver::resolution;
use solver::scene::{LineShape, RingMotion};

use crate::spec::{Resolved, material_name};

/// Hardness values in the wear formulas of the source that differ from its validation chapter.
const HARDNESSES: [(f64, &str); 2] = [
    (
        427.0,
        "427 MPa is the hardness of copper in the source's wear formulas; its validation chapter has Hv 130, 1275 MPa, \
         at which the wear is 3 times less (material `copper_hv130`)",
    ),
    (
        424.0,
        "424 MPa is the hardness of steel in the source's wear formulas; its validation chapter has Hv 700, 6865 MPa, \
         at which the wear is 16 times less (material `steel_hv700`)",
    ),
];

/// The notes of a resolved specification.
pub(crate) fn notes(resolved: &Resolved) -> Vec<String> {
    let mut notes: Vec<String> = resolved.chosen.iter().cloned().collect();
    notes.extend(kept_platings(resolved));
    notes.extend(not_in_estimate(resolved));
    notes.extend(hardnesses(resolved));
    notes.extend(first_flat(resolved));
    if resolved.kind == SystemKind::FuzzButton {
        notes.extend(fuzz_button(resolved));
    }
    let preset = resolved.spec.accuracy.preset.as_ref();
    if let Some(Preset::SourceCoarse | Preset::SourceFine) = preset.and_then(EnumValue::known) {
        let sizes = resolution::choose(&resolved.scene);
        notes.push(format!(
            "the source's elements, {:.3e} mm here, face a contact half-width of {:.3e} mm: pressures of such a run \
             are artefacts of the mesh, its worn area is not",
            sizes.contact_element, sizes.hertz_half_width
        ));
    }
    notes
}

/// The first cycles in gross sliding, which are not resolved.
fn first_flat(resolved: &Resolved) -> Option<String> {
    let scene = &resolved.scene;
    let flat = scene.accuracy.narrowest_contact_mm?;
    let unworn = unworn_contact::hertz_half_width(scene);
    let cycles = expected_end(scene);
    Some(format!(
        "elements and increments are chosen for the contact after {} % of the {cycles} cycles, whose half-width is {flat:.2e} mm; the unworn one, \
         {unworn:.2e} mm, has a mesh of its own: wear and lives do not depend on it, pressures of earlier cycles do. \
         accuracy.overrides.contact_element_mm resolves them",
        100.0 * resolution::FIRST_FLAT
    ))
}

/// Errors of a crown or a partly sticking point that the stated ones do not hold.
fn not_in_estimate(resolved: &Resolved) -> Option<String> {
    let scene = &resolved.scene;
    if let Some((across, _)) = crown_half_lengths_mm(scene) {
        let height = scene
            .slider
            .shape
            .height_mm
            .min(scene.receptacle.shape.height_mm);
        let along = unworn_contact::largest_half_width(scene);
        return Some(format!(
            "the stated errors of an elliptical contact along a line, {along:.2e} by {across:.2e} mm, compare finer meshes, increments, jumps and \
             sections; they do not hold that the bodies are {height} mm high instead of half-spaces, and sections that only their forces couple: an \
             unworn ellipse 10 times as long as wide has 2 to 3 % more line load in its middle than Hertz' on bodies 50 to 13 half-widths high"
        ));
    }
    let partial = PointScene::of(scene, SlipRegime::Partial)?;
    let annulus = partial.slip_annulus_over_half_length()?;
    let cells = annulus * partial.accuracy.cells_per_half_length;
    (partial.may_stick() && !scene.accuracy.estimate_errors).then(|| {
        format!(
            "the edge of the stick zone lies between cells, and {cells:.1} cells are across what slips of the unworn contact: depths are \
             uncertain by up to about {:.0} %, which only estimated errors state",
            50.0 / cells
        )
    })
}

/// The platings that the preset gives, so that no plan hides what wears first.
fn kept_platings(resolved: &Resolved) -> Vec<String> {
    let Spec {
        plating,
        provenance,
        ..
    } = &resolved.spec;
    let sides = [
        ("slider", &plating.slider),
        ("receptacle", &plating.receptacle),
    ];
    let kept = sides.into_iter().filter_map(|(side, layers)| {
        let given = provenance.get(&format!("/plating/{side}/0/thickness_um"))?;
        let layers = layers.as_ref().filter(|_| *given != Provenance::Given)?;
        let words = layers.iter().map(|layer| {
            let name = layer.material.as_ref().and_then(material_name);
            let thickness = layer.thickness_um.unwrap_or_default();
            format!("{thickness} um of {}", name.unwrap_or("another metal"))
        });
        let words: Vec<_> = words.collect();
        Some(format!(
            "plating of the preset kept on the {side}: {}",
            words.join(" over ")
        ))
    });
    kept.collect()
}

fn hardnesses(resolved: &Resolved) -> Vec<String> {
    let wear = &resolved.spec.interface.wear;
    let sides = [&wear.slider, &wear.receptacle];
    let used = |hardness: f64| {
        sides.iter().any(|side| {
            let law: Option<&WearLaw> = side.as_ref().and_then(Option::as_ref);
            law.and_then(|law| law.hardness_mpa)
                .is_some_and(|used| (used - hardness).abs() < 1e-9)
        })
    };
    let found = HARDNESSES.iter().filter(|(hardness, _)| used(*hardness));
    found.map(|(_, note)| (*note).to_owned()).collect()
}

fn fuzz_button(resolved: &Resolved) -> Vec<String> {
    let mut notes = vec![
        "wear goes with the magnitude of the local slip; the source's formula takes the slider's signed velocity, which \
         would wear sticking places and deposit material during half of every cycle"
            .to_owned(),
        "a flat floor sinks by 2 (k/H) P' a cycle, 26.17 nm for the source's copper; its own check takes the pressure on \
         the top face for the contact pressure"
            .to_owned(),
    ];
    if let Some(LineShape::Ring { radius_mm, motion }) =
        resolved.scene.dimension.line().map(|line| line.shape)
    {
        let moves = match motion {
            RingMotion::InPlane => "vibrates in its plane",
            RingMotion::Torsion => "turns about its axis",
        };
        notes.push(format!(
            "the source gives its rings no dimensions, tops or directions: the centre line of the wire has a radius of {radius_mm:.4} mm here (an \
             outer circumference of 3.192 mm, the length of its extruded model, if no other diameter is given), the ring {moves}, \
             and half of it stands for both"
        ));
    }
    if resolved.scene.dimension.extruded().is_some() {
        notes.push(
            "the source holds the top of its extruded wire along z and the bottom of the block, and says nothing of their ends: they are \
             free here if `ends` is not given, and `held` ends are plane strain; it gives the layers no lengths, even ones are taken"
                .to_owned(),
        );
    }
    let load = resolved.spec.load.as_ref();
    let is_pressure = load.is_some_and(|load| load.kind == EnumValue::from(LoadKind::Pressure));
    if is_pressure {
        notes.push(
            "the source's input applies 10 MPa on the top face; it states 0.834 N a button and 51.71 MPa, but that force \
             over the annulus it describes is 5.41 MPa"
                .to_owned(),
        );
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::read;

    fn of(text: &str) -> Vec<String> {
        notes(&read(text.as_bytes()).expect("accepted"))
    }

    #[test]
    fn notes_appear_where_contradictory_values_are_used() {
        let base = of(r#"{"system":{"kind":"fuzz_button"}}"#);
        assert_eq!(base.len(), 7, "{base:?}");
        assert!(
            base[0]
                .starts_with("plating of the preset kept on the slider: 0.76 um of hard_gold over")
        );
        assert!(base[2].starts_with("427 MPa"));
        let ends = |model: &str| {
            let notes = of(&format!(
                r#"{{"system":{{"kind":"fuzz_button"}},"model":{model}}}"#
            ));
            notes.iter().any(|note| note.contains("`held` ends"))
        };
        assert!(ends(r#"{"preset":"source_extruded"}"#));
        assert!(!ends(r#"{"preset":"source_ring"}"#));
        // The copper below its plating.
        let plated = of(r#"{"system":{"kind":"sd_card"}}"#);
        assert!(plated.len() == 3 && plated[2].starts_with("427 MPa"));
        let worn = r#""plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"receptacle":{"law":"archard","k":1e-4,"hardness_mpa":1700}}}"#;
        let bare = of(&format!(r#"{{"system":{{"kind":"sd_card"}},{worn}}}"#));
        assert!(bare.len() == 1 && bare[0].starts_with("elements and increments are chosen for"));
        let fine = r#""accuracy":{"preset":"source_fine"}"#;
        let coarse = of(&format!(
            r#"{{"system":{{"kind":"sd_card"}},{worn},{fine}}}"#
        ));
        assert!(coarse[0].contains("artefacts"), "{coarse:?}");
    }

    #[test]
    fn a_long_wipe_says_what_is_resolved() {
        let matings = |rest: &str| {
            let motion = r#""motion":{"kind":"insertion","wipe_mm":1.5}"#;
            let text =
                format!(r#"{{"system":{{"kind":"sd_card"}},"cycles":10000,{motion}{rest}}}"#);
            let resolved = read(text.as_bytes()).expect("accepted");
            (
                resolved.scene.accuracy.narrowest_contact_mm,
                notes(&resolved),
            )
        };
        let (flat, said) = matings("");
        let flat = flat.expect("its slider has a flat");
        assert!((0.01..0.02).contains(&flat), "{flat}");
        let of_flat = format!("after 5 % of the 10000 cycles, whose half-width is {flat:.2e} mm");
        assert!(said.iter().any(|note| note.contains(&of_flat)), "{said:?}");
        let given = r#","accuracy":{"overrides":{"contact_element_mm":0.0004}}"#;
        for other in [given, r#","model":{"dimension":"point"}"#] {
            let (flat, said) = matings(other);
            assert_eq!(flat, None);
            assert!(!said.iter().any(|note| note.contains("of its own")));
        }
    }
}
