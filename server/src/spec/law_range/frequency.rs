//! Warnings where a wear law is used at another frequency than its constants were measured at.
//!
//! Beyond the dissipated energy the worn volume of steel flat on flat followed V ~ f^-0.3, in 45 fretting tests: at a lower frequency films
//! have more time to grow and break. Other metals differ; the exponent says when the difference may matter, not what the wear is.

use api::problem::Fault;
use api::spec::{Spec, WearLaw};
use solver::scene::{Motion, Scene};
use solver::sides::Side;

use crate::spec::{environment, plating};

/// Exponent of the frequency.
const EXPONENT: f64 = -0.3;

/// The warnings of a resolved specification.
pub(super) fn warnings(spec: &Spec, scene: &Scene) -> Vec<Fault> {
    let laws = environment::laws(spec);
    let layers = plating::by_side(&spec.plating);
    let given = Side::BOTH.into_iter().flat_map(|side| {
        let name = side.name();
        let base = (*laws.of(side)).map(|law| (format!("/interface/wear/{name}"), law));
        let layers = layers
            .of(side)
            .iter()
            .enumerate()
            .filter_map(move |(number, layer)| {
                Some((
                    format!("/plating/{name}/{number}/wear"),
                    layer.wear.as_ref()?,
                ))
            });
        base.into_iter().chain(layers)
    });
    let warnings = given.filter_map(|(pointer, law)| {
        let detail = at_another_frequency(law, scene)?;
        Some(Fault::new(format!("{pointer}/measured_at_hz"), detail))
    });
    warnings.collect()
}

/// Warning if the wear at the farthest frequency of the motion or the mission deviates by more than the tolerance.
fn at_another_frequency(law: &WearLaw, scene: &Scene) -> Option<String> {
    let measured = law.measured_at_hz?;
    let change = |frequency: f64| ((frequency / measured).powf(EXPONENT) - 1.0).abs();
    let farthest = frequencies(scene).reduce(|farthest, next| {
        if change(next) > change(farthest) {
            next
        } else {
            farthest
        }
    })?;
    (change(farthest) > scene.accuracy.tolerance).then(|| {
        format!(
            "measured at {measured} Hz and used at {farthest:.4} Hz: the wear of steel falls with the frequency to the power of 0.3, which \
             would be {:.0} % of it",
            100.0 * (farthest / measured).powf(EXPONENT)
        )
    })
}

/// Frequencies of the motion, or of the blocks of the mission, Hz.
fn frequencies(scene: &Scene) -> impl Iterator<Item = f64> {
    let motions: Vec<Motion> = match &scene.mission {
        Some(mission) => mission.blocks.iter().map(|block| block.motion).collect(),
        None => vec![scene.motion],
    };
    motions
        .into_iter()
        .filter_map(|motion| motion.period_s().map(f64::recip))
}

#[cfg(test)]
mod tests {
    use crate::spec::tests::{accepted, faults};

    fn details(measured: &str, motion: &str) -> Vec<(String, String)> {
        let text = format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},{motion},"interface":{{"wear":{{"slider":null,"receptacle":{{"law":"archard",
            "k_over_h_per_mpa":1e-8,"measured_at_hz":{measured}}}}}}}}}"#
        );
        let resolved = accepted(&text);
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, resolved.scene);
        let warnings = super::warnings(&resolved.spec, &resolved.scene).into_iter();
        warnings
            .map(|warning| (warning.pointer, warning.detail))
            .collect()
    }

    #[test]
    fn a_coefficient_of_another_frequency_is_warned_of() {
        const AT_20_HZ: &str =
            r#""motion":{"kind":"reciprocating","amplitude_mm":0.025,"frequency_hz":20}"#;
        assert!(details("20", AT_20_HZ).is_empty());
        // 5 % in frequency are 1.5 % in wear.
        assert!(details("21", AT_20_HZ).is_empty());
        let found = details("200", AT_20_HZ);
        assert_eq!(found[0].0, "/interface/wear/receptacle/measured_at_hz");
        assert!(found[0].1.contains("200 % of it"), "{}", found[0].1);
        let block = |frequency: f64| {
            format!(
                r#"{{"cycles":10,"motion":{{"kind":"reciprocating","amplitude_mm":0.01,"frequency_hz":{frequency}}}}}"#
            )
        };
        let mission = format!(r#""mission":[{},{}]"#, block(20.0), block(0.02));
        assert!(details("20", &mission)[0].1.contains("0.0200 Hz"));
        let zero = r#"{"system":{"kind":"cylinder_on_flat"},"interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-8,
            "measured_at_hz":0}}}}"#;
        assert_eq!(
            faults(zero)[0].pointer,
            "/interface/wear/receptacle/measured_at_hz"
        );
    }
}
