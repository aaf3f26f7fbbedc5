//! Warning of a receptacle whose plating would last far fewer matings than connectors of its kind are rated for.
//!
//! In a mating each place of a pad is passed twice by the load P' for each mm of depth, so that layers of the thicknesses t_i and the
//! specific wear rates k_i last N = sum t_i/(2 k_i P') matings.

use api::problem::Fault;
use api::spec::SystemKind;
use solver::law::plating::bottoms;
use solver::scene::Scene;
use solver::sides::Side;

/// Matings over the rated ones below which the rating contradicts the wear rate. Arbitrary: wear coefficients scatter by a factor
/// of two to three.
const FAR_BELOW: f64 = 1.0 / 3.0;
/// Thickness of gold on contacts that state none, mm: 30 microinches, usual for durable sockets.
const USUAL_GOLD_MM: f64 = 0.76e-3;

/// Rated matings of the kinds of which a rating is published: miniSD sockets, DIMM sockets, mPGA604 sockets.
fn rated(kind: SystemKind) -> Option<f64> {
    match kind {
        SystemKind::SdCard => Some(10_000.0),
        SystemKind::Dimm => Some(25.0),
        SystemKind::Zif => Some(50.0),
        SystemKind::FuzzButton | SystemKind::CylinderOnFlat => None,
    }
}

/// The warning of a scene of a kind, if there is one.
pub(super) fn warning(kind: SystemKind, scene: &Scene) -> Option<Fault> {
    let rated = rated(kind)?;
    let load = scene.load_n_per_mm;
    let plating = scene.plating(Side::Receptacle);
    let (matings, what, field) = if plating.is_empty() {
        let rate = scene.receptacle.outer_rate()?;
        let what = format!("{} um of gold, which is usual,", 1e3 * USUAL_GOLD_MM);
        (
            USUAL_GOLD_MM / (2.0 * rate * load),
            what,
            "/interface/wear/receptacle",
        )
    } else {
        let layers = plating.iter();
        let matings = layers.map(|layer| layer.thickness_mm / (2.0 * layer.rate_per_mpa * load));
        let what = "the plating".to_owned();
        (matings.sum(), what, "/plating/receptacle")
    };
    let thickness = bottoms(plating).last().unwrap_or(USUAL_GOLD_MM);
    let largest = thickness / (2.0 * rated * load);
    (matings < FAR_BELOW * rated).then(|| Fault {
        pointer: field.to_owned(),
        detail: format!(
            "with this wear {what} lasts about {matings:.0} matings, and a `{}` is rated for {rated:.0}: if the rating means that the \
             plating stays closed, k/H is {largest:.1e} 1/MPa at most",
            kind.as_str()
        ),
    })
}

#[cfg(test)]
mod tests {
    use crate::spec::tests::accepted;

    fn warned(text: &str) -> Option<String> {
        let warnings = accepted(text).warnings.into_iter();
        let mut warnings = warnings.map(|fault| fault.detail);
        warnings.find(|detail| detail.contains("matings"))
    }

    #[test]
    fn a_wear_rate_that_contradicts_a_rating_is_named() {
        let preset = warned(r#"{"system":{"kind":"sd_card"}}"#).expect("a warning");
        // 0.76 um over 2 times 0.004/1700 times 0.625 N/mm; 6.1e-8 for 10 000.
        assert!(preset.contains("about 258 matings"), "{preset}");
        assert!(preset.contains("6.1e-8"), "{preset}");
        for rated_less in ["dimm", "zif", "fuzz_button"] {
            let text = format!(r#"{{"system":{{"kind":"{rated_less}"}}}}"#);
            assert_eq!(warned(&text), None);
        }
        let plated = |rate: f64| {
            format!(
                r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[{{"material":"hard_gold","thickness_um":0.76,
                "wear":{{"law":"archard","k_over_h_per_mpa":{rate}}}}}]}}}}"#
            )
        };
        assert_eq!(warned(&plated(6e-8)), None);
        assert!(warned(&plated(6e-7)).is_some_and(|detail| detail.contains("the plating lasts")));
    }
}
