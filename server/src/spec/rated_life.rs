//! Rated matings: how many of them a worn depth takes, and warnings of platings that would last far fewer than connectors of their kind are
//! rated for.
//!
//! In a mating the contact passes the wipe in and out again, so that it is a cycle of half of the wipe as amplitude, and the closed
//! forms of `solver::closed_form::expected_life` hold: a pad of layers of the thicknesses t_i and the specific wear rates k_i lasts
//! N = sum t_i/(2 k_i P') matings, the tip, which rubs in all of the wipe, far fewer.

use api::problem::Fault;
use api::spec::{Motion, Provenance, SystemKind};
use solver::closed_form::expected_life;
use solver::law::plating::bottoms;
use solver::scene::{self, Criterion, Scene};
use solver::sides::Side;

use crate::spec::sourced::Sourced;
use crate::spec::system::{self, RatingPreset};

/// Matings over the rated ones below which the rating contradicts the wear rate. Arbitrary: wear coefficients scatter by a factor
/// of two to three.
const FAR_BELOW: f64 = 1.0 / 3.0;
/// Thickness of gold on contacts that state none, mm: 30 microinches, usual for durable sockets.
const USUAL_GOLD_MM: f64 = 0.76e-3;
/// Duration of a mating, s. No wear depends on it.
const MATING_S: f64 = 1.0;

/// The rating of a kind, and a scene with its matings as cycles.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RatedMatings {
    /// Rated number.
    pub(crate) rated: Sourced<f64>,
    /// Whose rating it is.
    pub(crate) of: &'static str,
    /// Path of the contact in one direction of a mating, mm.
    pub(crate) wipe_mm: Sourced<f64>,
    mating: Scene,
}

impl RatedMatings {
    /// Rated matings of a contact, with the wipe of its motion if that is a mating; `None` for a kind without a rating, and where the
    /// slider's surface runs past.
    pub(crate) fn of(kind: SystemKind, motion: Option<&Motion>, scene: &Scene) -> Option<Self> {
        let RatingPreset {
            matings,
            of,
            wipe_mm,
        } = (system::definition(kind).preset)().rating?;
        if matches!(scene.motion, scene::Motion::Continuous { .. }) {
            return None;
        }
        let given = motion.and_then(|motion| motion.wipe_mm);
        let wipe_mm = given.map_or(wipe_mm, |value| Sourced {
            value,
            provenance: Provenance::Given,
        });
        let mating = Scene {
            motion: scene::Motion::Reciprocating {
                amplitude_mm: 0.5 * wipe_mm.value,
                period_s: MATING_S,
            },
            mission: None,
            ..scene.clone()
        };
        Some(Self {
            rated: matings,
            of,
            wipe_mm,
            mating,
        })
    }

    /// Matings until a criterion is reached.
    pub(crate) fn until(&self, criterion: Criterion) -> Option<f64> {
        expected_life::cycles(&self.mating, criterion)
    }
}

/// The warnings of a scene of a kind.
pub(super) fn warnings(kind: SystemKind, motion: Option<&Motion>, scene: &Scene) -> Vec<Fault> {
    let Some(matings) = RatedMatings::of(kind, motion, scene) else {
        return Vec::new();
    };
    let sides = Side::BOTH.into_iter();
    let warned = sides.filter_map(|side| match bottoms(scene.plating(side)).last() {
        Some(bottom) => of_plating(kind, &matings, Criterion::deepest(side, bottom)),
        None if side == Side::Receptacle => of_bare_pad(kind, &matings, scene),
        None => None,
    });
    warned.collect()
}

/// Of a plating that is through too early.
fn of_plating(kind: SystemKind, matings: &RatedMatings, through: Criterion) -> Option<Fault> {
    let lasts = matings.until(through)?;
    let RatedMatings { rated, wipe_mm, .. } = matings;
    let ratio = lasts / rated.value;
    (ratio < FAR_BELOW).then(|| Fault {
        pointer: format!("/plating/{}", through.side.name()),
        detail: format!(
            "with this wear the plating lasts about {lasts:.0} matings of {} mm, and a `{}` is rated for {:.0}: if the rating means \
             that the plating stays closed, its wear coefficients are at most {ratio:.1e} of these",
            wipe_mm.value,
            kind.as_str(),
            rated.value
        ),
    })
}

/// Of a bare pad by whose wear the usual thickness of gold would be through too early.
fn of_bare_pad(kind: SystemKind, matings: &RatedMatings, scene: &Scene) -> Option<Fault> {
    let rated = matings.rated.value;
    let load = scene.load_n_per_mm;
    let lasts = USUAL_GOLD_MM / (2.0 * scene.receptacle.outer_rate()? * load);
    let largest = USUAL_GOLD_MM / (2.0 * rated * load);
    (lasts < FAR_BELOW * rated).then(|| Fault {
        pointer: "/interface/wear/receptacle".to_owned(),
        detail: format!(
            "with this wear {} um of gold, which is usual, lasts about {lasts:.0} matings, and a `{}` is rated for {rated:.0}: if the \
             rating means that the plating stays closed, k/H is {largest:.1e} 1/MPa at most",
            1e3 * USUAL_GOLD_MM,
            kind.as_str()
        ),
    })
}

#[cfg(test)]
mod tests {
    use crate::spec::tests::accepted;

    fn warned(text: &str) -> Vec<String> {
        let warnings = accepted(text).warnings.into_iter();
        let warnings = warnings.filter(|fault| fault.detail.contains("matings"));
        let text = warnings.map(|fault| format!("{}: {}", fault.pointer, fault.detail));
        text.collect()
    }

    /// A pad and a tip of 0.76 um of hard gold that wears at a rate.
    fn plated(rate: f64, wipe: &str) -> String {
        let layer = format!(
            r#"[{{"material":"hard_gold","thickness_um":0.76,"wear":{{"law":"archard","k_over_h_per_mpa":{rate:e}}}}}]"#
        );
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":{layer},"slider":{layer}}},"interface":{{"wear":{{"slider":null}}}}{wipe}}}"#
        )
    }

    #[test]
    fn a_wear_rate_that_contradicts_a_rating_is_named() {
        let silver = r#"{"system":{"kind":"sd_card"},"plating":{"receptacle":[]},
            "interface":{"wear":{"receptacle":{"law":"archard","k":0.004,"hardness_mpa":1700}}}}"#;
        let [bare] = &warned(silver)[..] else {
            panic!("one warning");
        };
        // 0.76 um over 2 times 0.004/1700 times 0.625 N/mm; 6.1e-8 for 10 000.
        assert!(bare.starts_with("/interface/wear/receptacle"), "{bare}");
        assert!(bare.contains("about 258 matings"), "{bare}");
        assert!(bare.contains("6.1e-8"), "{bare}");
        for kind in ["sd_card", "dimm", "zif", "fuzz_button", "cylinder_on_flat"] {
            let preset = warned(&format!(r#"{{"system":{{"kind":"{kind}"}}}}"#));
            assert!(preset.is_empty(), "{kind}: {preset:?}");
        }
    }

    /// With 6.1e-8 1/MPa the pad lasts 10 000 matings of 1.5 mm and the tip 218; it needs 1.3e-9.
    #[test]
    fn the_tip_is_compared_with_the_rating_as_the_pad_is() {
        let [tip] = &warned(&plated(6.1e-8, ""))[..] else {
            panic!("the tip alone");
        };
        assert!(tip.starts_with("/plating/slider"), "{tip}");
        assert!(tip.contains("about 218 matings of 1.5 mm"), "{tip}");
        assert!(tip.contains("at most 2.2e-2 of these"), "{tip}");
        assert!(warned(&plated(1.3e-9, "")).is_empty());
        assert_eq!(warned(&plated(6.1e-7, "")).len(), 2);
        let insertion = r#","motion":{"kind":"insertion","wipe_mm":0.3}"#;
        let [tip] = &warned(&plated(6.1e-8, insertion))[..] else {
            panic!("the tip alone");
        };
        assert!(tip.contains("about 1092 matings of 0.3 mm"), "{tip}");
    }
}
