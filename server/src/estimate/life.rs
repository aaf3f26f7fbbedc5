//! Lives of a plan: cycles of the motion until each criterion, and matings until each exposure beside the rated ones, in closed form.

use api::plan::{PlannedLife, RatedLife};
use api::spec::{Criterion, CriterionKind, EnumValue};
use solver::closed_form::expected_life;
use solver::scene::{self, Motion, Scene};

use crate::number::real;
use crate::spec::{RatedMatings, Resolved};

/// The lives of a resolved specification, by the criteria of its `life`.
pub(super) fn planned(resolved: &Resolved) -> Vec<PlannedLife> {
    let Resolved {
        spec, kind, scene, ..
    } = resolved;
    let rated = RatedMatings::of(*kind, spec.motion.as_ref(), scene);
    let criteria = spec.life.criteria.iter().flatten();
    // The engine knows every criterion but those of a resistance.
    let modelled = criteria.filter(|criterion| kind_of(criterion) != CriterionKind::Resistance);
    let lives = modelled.zip(&scene.life);
    lives
        .map(|(criterion, depth)| life(scene, rated.as_ref(), criterion, *depth))
        .collect()
}

fn kind_of(criterion: &Criterion) -> CriterionKind {
    match criterion.kind {
        EnumValue::Known(kind) => kind,
        // Refused before.
        EnumValue::Unknown(_) => CriterionKind::Resistance,
    }
}

fn life(
    scene: &Scene,
    rated: Option<&RatedMatings>,
    criterion: &Criterion,
    depth: scene::Criterion,
) -> PlannedLife {
    let cycles = expected_life::cycles(scene, depth);
    let is_exposure = kind_of(criterion) != CriterionKind::WornDepth;
    let rated = rated.filter(|_| is_exposure).and_then(|rated| {
        let matings = rated.until(depth)?;
        Some(RatedLife {
            matings,
            rated_matings: rated.rated.value,
            matings_over_rated: matings / rated.rated.value,
            rated_matings_provenance: rated.rated.provenance,
            rating: rated.of.to_owned(),
            wipe_mm: rated.wipe_mm.value,
            wipe_provenance: rated.wipe_mm.provenance,
        })
    });
    PlannedLife {
        criterion: criterion.clone(),
        side: depth.side.name().to_owned(),
        // The parts of a continuous motion are no cycles of the user.
        cycles: cycles.filter(|_| !matches!(scene.motion, Motion::Continuous { .. })),
        repetitions: cycles
            .zip(scene.mission.as_ref())
            .map(|(cycles, mission)| cycles / real(mission.cycles())),
        sliding_distance_mm: cycles.map(|cycles| cycles * scene.motion.distance_per_cycle_mm()),
        rated,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec;

    fn accepted(text: &str) -> Resolved {
        spec::read(text.as_bytes()).expect("accepted")
    }

    fn of<'a>(lives: &'a [PlannedLife], side: &str, kind: CriterionKind) -> &'a PlannedLife {
        let mut lives = lives.iter();
        let life = lives.find(|life| life.side == side && kind_of(&life.criterion) == kind);
        life.expect("it is planned")
    }

    fn ratio(lives: &[PlannedLife], side: &str, kind: CriterionKind) -> f64 {
        let rated = of(lives, side, kind).rated.as_ref();
        rated.expect("it is rated").matings_over_rated
    }

    #[test]
    fn a_preset_states_its_life_beside_the_rated_one() {
        let lives =
            |kind: &str| planned(&accepted(&format!(r#"{{"system":{{"kind":"{kind}"}}}}"#)));
        let sd = lives("sd_card");
        assert_eq!(sd.len(), 4);
        let (exposed, base) = (CriterionKind::FirstExposure, CriterionKind::BaseMetal);
        // (4/3) sqrt(2 R t) t/(k/H) over 0.625 N/mm and 3 mm a mating; at least 0.76 um over 2 k/H P'.
        let tip = ratio(&sd, "slider", exposed);
        assert!((tip - 0.2265).abs() < 1e-3, "{tip}");
        let pad = ratio(&sd, "receptacle", exposed);
        // The tip's flat is a part of the wipe by then.
        assert!(pad > 10.336 && pad < 1.4 * 10.336, "{pad}");
        assert!(ratio(&sd, "slider", base) > tip && ratio(&sd, "receptacle", base) > pad);
        for kind in ["dimm", "zif"] {
            assert!(ratio(&lives(kind), "slider", exposed) > 1.0, "{kind}");
        }
        let fuzz = lives("fuzz_button");
        assert!(fuzz.len() == 4 && fuzz.iter().all(|life| life.rated.is_none()));
        assert!(fuzz.iter().all(|life| life.cycles.is_some()));
        assert!(lives("cylinder_on_flat").is_empty());
    }

    #[test]
    fn matings_are_those_of_the_motion_where_that_is_a_mating() {
        let text = r#"{"system":{"kind":"sd_card"},"motion":{"kind":"insertion","wipe_mm":0.4}}"#;
        for life in planned(&accepted(text)) {
            let rated = life.rated.expect("it is rated");
            assert_eq!(life.cycles, Some(rated.matings));
            assert!((rated.wipe_mm - 0.4).abs() < 1e-15);
        }
    }

    #[test]
    fn depths_and_continuous_motions_have_no_matings() {
        let text = r#"{"system":{"kind":"sd_card"},"life":{"criteria":[{"kind":"resistance","mohm":10},
            {"kind":"worn_depth","mm":1e-4,"side":"receptacle"}]}}"#;
        let lives = planned(&accepted(text));
        assert_eq!(lives.len(), 1);
        assert!(lives[0].rated.is_none() && lives[0].cycles.is_some());
        let text =
            r#"{"system":{"kind":"sd_card"},"motion":{"kind":"continuous","distance_mm":10}}"#;
        let lives = planned(&accepted(text));
        assert_eq!(lives.len(), 2);
        let is_distance = |life: &PlannedLife| {
            life.cycles.is_none() && life.rated.is_none() && life.sliding_distance_mm.is_some()
        };
        assert!(lives.iter().all(is_distance), "{lives:?}");
    }
}
