//! Warnings where a wear law is used beyond its range. Archard's holds while the contact is elastic as a whole, a mean pressure of
//! at most a third of the hardness; beyond it the contact flows, and the wear coefficient rises steeply (Archard 1953). Oxidational
//! laws hold at speeds (`speed`); constants belong to the frequency that they were measured at (`frequency`).

mod frequency;
mod speed;

use std::f64::consts::PI;

use api::problem::Fault;
use api::spec::{Spec, WearLaw};
use solver::closed_form::unworn_contact;
use solver::scene::Effect;
use solver::scene::{Dimension, Scene};
use solver::sides::Side;

use crate::spec::{environment, plating};

/// Mean pressure over hardness up to which Archard's law holds.
const MEAN: f64 = 1.0 / 3.0;

/// The warnings of a resolved specification, for the unworn contact: wear only lowers its pressure. Of a plated side the law
/// is that of the outermost layer. A law that states k/H alone has no hardness to compare with.
pub(super) fn warnings(spec: &Spec, scene: &Scene) -> Vec<Fault> {
    // Hertz.
    let peak = unworn_contact::hertz_peak_pressure(scene);
    let mean = match scene.dimension {
        Dimension::PlaneStrain | Dimension::Line(_) | Dimension::Extruded(_) => 0.25 * PI * peak,
        Dimension::Point(_) => 2.0 / 3.0 * peak,
    };
    let warnings = Side::BOTH.into_iter().filter_map(|side| {
        let (pointer, law) = outer_law(spec, side)?;
        let hardness = law.hardness_mpa?;
        let effect = match side {
            Side::Slider => Effect::SliderWear,
            Side::Receptacle => Effect::ReceptacleWear,
        };
        let is_beyond = mean > MEAN * hardness && scene.effects.of(effect) != Some(false);
        is_beyond.then(|| warning(pointer, [mean, peak, hardness]))
    });
    let others = [
        speed::warnings(spec, scene),
        frequency::warnings(spec, scene),
    ];
    warnings.chain(others.into_iter().flatten()).collect()
}

/// The law of the surface of a side, with its pointer.
fn outer_law(spec: &Spec, side: Side) -> Option<(String, &WearLaw)> {
    let name = side.name();
    let outermost = plating::by_side(&spec.plating).of(side).first();
    if let Some(layer) = outermost {
        return Some((format!("/plating/{name}/0/wear"), layer.wear.as_ref()?));
    }
    let law = (*environment::laws(spec).of(side))?;
    Some((format!("/interface/wear/{name}"), law))
}

fn warning(pointer: String, [mean, peak, hardness]: [f64; 3]) -> Fault {
    let flows = if peak > hardness {
        "; the peak pressure is beyond the hardness itself, so that the contact flows before it wears"
    } else {
        ""
    };
    Fault {
        pointer,
        detail: format!(
            "the unworn contact has a mean pressure of {mean:.0} MPa and a peak of {peak:.0} MPa at a hardness of {hardness:.0} \
             MPa: Archard's law holds up to a mean of a third of the hardness, {:.0} MPa{flows}",
            MEAN * hardness
        ),
    }
}

#[cfg(test)]
mod tests {
    use crate::spec;

    fn fields(text: &str) -> Vec<String> {
        let resolved = spec::read(text.as_bytes()).expect("accepted");
        let warnings = super::warnings(&resolved.spec, &resolved.scene).into_iter();
        warnings.map(|warning| warning.pointer).collect()
    }

    /// 645 MPa on copper of 427 MPa; hard gold has 1 700.
    #[test]
    fn the_base_scene_is_beyond_the_range_of_its_law_and_the_presets_are_within() {
        let fuzz = include_str!("../../examples/fuzz_button.json");
        assert_eq!(fields(fuzz), ["/interface/wear/receptacle"]);
        for kind in ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"] {
            let text = format!(r#"{{"system":{{"kind":"{kind}"}}}}"#);
            assert!(fields(&text).is_empty(), "{kind}");
        }
        let loaded =
            r#"{"system":{"kind":"sd_card"},"load":{"kind":"line_force","n_per_mm":30.0}}"#;
        let outer = ["/plating/slider/0/wear", "/plating/receptacle/0/wear"];
        assert_eq!(fields(loaded), outer);
    }
}
