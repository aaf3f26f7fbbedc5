//! Warnings where a wear law is used beyond its range. Archard's holds while the contact is elastic as a whole, a mean pressure of
//! at most a third of the hardness; beyond it the contact flows, and the wear coefficient rises steeply (Archard 1953). Oxidational
//! laws hold at speeds (`speed`).

mod speed;

use std::f64::consts::PI;

use api::problem::Fault;
use api::spec::Spec;
use solver::effects::Effect;
use solver::model::resolution;
use solver::scene::Scene;

/// Mean pressure over hardness up to which Archard's law holds.
const MEAN: f64 = 1.0 / 3.0;

/// The warnings of a resolved specification, for the unworn contact: wear only lowers its pressure. A law that states k/H alone
/// has no hardness to compare with.
pub(super) fn warnings(spec: &Spec, scene: &Scene) -> Vec<Fault> {
    let half_width = resolution::choose(scene).hertz_half_width;
    let load = scene.load_n_per_mm;
    let mean = load / (2.0 * half_width);
    // Hertz.
    let peak = 2.0 * load / (PI * half_width);
    let wear = &spec.interface.wear;
    let sides = [
        ("slider", &wear.slider, Effect::SliderWear),
        ("receptacle", &wear.receptacle, Effect::ReceptacleWear),
    ];
    let warnings = sides.into_iter().filter_map(|(side, law, effect)| {
        let hardness = law.as_ref()?.as_ref()?.hardness_mpa?;
        let is_beyond = mean > MEAN * hardness && scene.effects.of(effect) != Some(false);
        is_beyond.then(|| warning(side, [mean, peak, hardness]))
    });
    warnings.chain(speed::warnings(spec, scene)).collect()
}

fn warning(side: &str, [mean, peak, hardness]: [f64; 3]) -> Fault {
    let flows = if peak > hardness {
        "; the peak pressure is beyond the hardness itself, so that the contact flows before it wears"
    } else {
        ""
    };
    Fault {
        pointer: format!("/interface/wear/{side}"),
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

    /// 645 MPa on copper of 427 MPa.
    #[test]
    fn the_fuzz_button_is_beyond_the_range_of_its_law_and_the_sockets_are_within() {
        let fuzz = r#"{"system":{"kind":"fuzz_button"}}"#;
        assert_eq!(fields(fuzz), ["/interface/wear/receptacle"]);
        for kind in ["sd_card", "dimm", "zif", "cylinder_on_flat"] {
            let text = format!(r#"{{"system":{{"kind":"{kind}"}}}}"#);
            assert!(fields(&text).is_empty(), "{kind}");
        }
        let loaded =
            r#"{"system":{"kind":"sd_card"},"load":{"kind":"line_force","n_per_mm":30.0}}"#;
        assert_eq!(fields(loaded), ["/interface/wear/receptacle"]);
    }
}
