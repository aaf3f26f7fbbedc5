//! A stroke that leaves the receptacle.

use api::problem::Fault;
use solver::closed_form::unworn_contact;
use solver::scene::{LineShape, Scene};

/// Warnings of strokes at whose end the unworn contact hangs over the end of the receptacle, of the motion or of the blocks of a mission.
/// A ring slides along the receptacle, too; a point that leaves it is refused.
pub(super) fn warnings(scene: &Scene) -> Vec<Fault> {
    if scene.dimension.point().is_some() || is_ring(scene) {
        return Vec::new();
    }
    let Some(mission) = &scene.mission else {
        let amplitude = scene.motion.amplitude_mm();
        return leaves(scene, amplitude, "/motion").into_iter().collect();
    };
    let blocks = mission.blocks.iter().enumerate();
    let warnings = blocks.filter_map(|(number, block)| {
        let pointer = format!("/mission/{number}/motion");
        leaves(scene, block.motion.amplitude_mm(), &pointer)
    });
    warnings.collect()
}

fn is_ring(scene: &Scene) -> bool {
    let line = scene.dimension.line();
    line.is_some_and(|line| matches!(line.shape, LineShape::Ring { .. }))
}

fn leaves(scene: &Scene, amplitude_mm: f64, pointer: &str) -> Option<Fault> {
    let half_block = 0.5 * scene.receptacle.shape.length_mm;
    let half_width = unworn_contact::hertz_half_width(scene);
    let rests_on = if amplitude_mm >= half_block {
        "its middle leaves the receptacle: the slider slides down its corner"
    } else {
        "it rests on the corner of the receptacle, which wears first"
    };
    (amplitude_mm + half_width > half_block).then(|| {
        let detail = format!(
            "the contact of {half_width:.2e} mm to either side is displaced by {amplitude_mm} mm on a receptacle that ends at {half_block} mm: \
             at the ends of the stroke {rests_on}; lengthen the receptacle if it is longer"
        );
        Fault::new(pointer, detail)
    })
}

#[cfg(test)]
mod tests {
    use crate::spec;

    fn warned(kind: &str, motion: &str) -> Vec<String> {
        let text = format!(r#"{{"system":{{"kind":"{kind}"}},{motion}}}"#);
        let resolved = spec::read(text.as_bytes()).expect("accepted");
        let warnings = resolved.warnings.into_iter();
        let of_stroke = warnings.filter(|fault| fault.detail.contains("receptacle that ends at"));
        of_stroke.map(|fault| fault.pointer).collect()
    }

    #[test]
    fn a_stroke_that_leaves_the_pad_is_warned_of() {
        let reciprocating = |amplitude: &str| {
            format!(
                r#""motion":{{"kind":"reciprocating","amplitude_mm":{amplitude},"frequency_hz":20}}"#
            )
        };
        // Half of the pad is 1 mm.
        for (amplitude, expected) in [("0.99", 0), ("0.9999999", 1), ("1.2", 1)] {
            let found = warned("sd_card", &reciprocating(amplitude));
            assert_eq!(found, vec!["/motion"; expected], "{amplitude}");
        }
        let mission = format!(
            r#""mission":[{{"name":"a","cycles":5,{}}},{{"name":"b","cycles":5,{}}}]"#,
            reciprocating("0.1"),
            reciprocating("1.2")
        );
        assert_eq!(warned("sd_card", &mission), ["/mission/1/motion"]);
    }

    #[test]
    fn no_preset_leaves_its_receptacle() {
        for kind in api::spec::SystemKind::ALL {
            let name = serde_json::to_value(kind).expect("a name");
            let name = name.as_str().expect("text");
            assert!(warned(name, r#""labels":{}"#).is_empty(), "{name}");
        }
    }
}
