//! Barwell's laws: the dose that the worn depth of every node stands for adds up to that of the load sliding its path, whichever body
//! wears: integral of G^-1(h) dx = energy/mu.

use super::{
    ARCHARD, LONG, SHORT, check_refinement, check_swap, integral, last_profile, reports, scene,
};
use crate::verification::recorder::solve;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::scene::{Accuracy, Barwell, Course, Friction, Motion, Scene, WearLaw};
use solver::sides::{Side, Sides};

/// Rates fall to a tenth, or grow tenfold, in the deepest place of the runs below.
const COURSES: [(&str, Course); 2] = [
    ("decelerating", Course::Decelerating),
    ("accelerating", Course::Accelerating),
];

const fn barwell(course: Course) -> Barwell {
    Barwell {
        rate_per_mpa: 2e-7,
        dose_mpa_mm: 1_500.0,
        course,
    }
}

/// Dose of a depth in mm by the closed form, MPa mm.
fn dose(law: Barwell, depth: f64) -> f64 {
    let share = depth / (law.rate_per_mpa * law.dose_mpa_mm);
    match law.course {
        Course::Decelerating => -law.dose_mpa_mm * (1.0 - share).ln(),
        Course::Accelerating => law.dose_mpa_mm * (1.0 + share).ln(),
    }
}

fn check_dose(name: &str, scene: &Scene, law: Barwell) {
    let (summary, run) = solve(scene).expect("the scene can be solved");
    let Friction::Coulomb { coefficient } = scene.friction else {
        panic!("the scene has friction");
    };
    let expected = summary.last.dissipated_energy_mj_per_mm / coefficient;
    let wears = Sides {
        slider: scene.slider.wear.is_some(),
        receptacle: scene.receptacle.wear.is_some(),
    };
    for side in Side::BOTH.into_iter().filter(|side| *wears.of(*side)) {
        let found = integral(last_profile(&run, side), |depth| dose(law, depth)) / expected - 1.0;
        let deepest = reports(&summary).of(side).max_depth_mm;
        println!(
            "Barwell, {name}: dose of the {} off by {found:+.1e}, {deepest:.2e} mm deep, {:.2} of the characteristic dose, {} computed cycles",
            side.name(),
            dose(law, deepest) / law.dose_mpa_mm,
            summary.resolution.computed_cycles,
        );
        assert!(found.abs() < 1e-6, "{found}");
    }
    assert!(summary.checks.worn_area < 1e-10);
}

const SIDES: [(&str, &[Side]); 3] = [
    ("both wear", &[Side::Slider, Side::Receptacle]),
    ("slider wears", &[Side::Slider]),
    ("receptacle wears", &[Side::Receptacle]),
];

/// Each course in each stroke, and each side in one of them; sums hold at any tolerance.
#[test]
fn doses_of_barwells_law_add_up_to_the_load_times_its_path() {
    let mut sides = SIDES.into_iter().cycle();
    for (course, law) in COURSES.map(|(name, course)| (name, barwell(course))) {
        for (stroke, cycles) in [("short", SHORT), ("long", LONG)] {
            let (wear, wearing) = sides.next().expect("a cycle has no end");
            let name = format!("{course}, {stroke} stroke, {wear}");
            let mut scene = scene(cycles, WearLaw::Barwell(law), wearing);
            scene.accuracy = Accuracy::from_tolerance(0.1);
            check_dose(&name, &scene, law);
        }
    }
}

/// Beside what else a scene may have: a spring, a crown, fields, a continuous motion.
#[test]
fn doses_of_barwells_law_add_up_beside_other_features() {
    for (course, law) in COURSES.map(|(name, course)| (name, barwell(course))) {
        for (stroke, (amplitude, cycles)) in [("short", (0.004, 500)), ("long", (0.1, 100))] {
            let mut base = scene((amplitude, cycles), WearLaw::Barwell(law), &Side::BOTH);
            base.accuracy = Accuracy::from_tolerance(0.1);
            let mut sprung = base.clone();
            sprung.spring_n_per_mm2 = 200.0 * sprung.load_n_per_mm;
            check_dose(&format!("{course}, {stroke}, spring"), &sprung, law);
            let mut crowned = base.clone();
            crowned.receptacle.shape.crown_radius_mm = Some(20.0);
            check_dose(&format!("{course}, {stroke}, crown"), &crowned, law);
            base.output.fields = true;
            check_dose(&format!("{course}, {stroke}, fields"), &base, law);
        }
        let mut continuous = scene((0.0, 1_000), WearLaw::Barwell(law), &Side::BOTH[1..]);
        continuous.motion = Motion::Continuous { step_mm: 0.02 };
        check_dose(&format!("{course}, continuous"), &continuous, law);
    }
}

/// A floor that the whole contact crosses reaches the depth where the course ends, and no further; walls continue.
#[test]
fn a_decelerating_course_ends_while_the_run_goes_on() {
    let law = Barwell {
        dose_mpa_mm: 20.0,
        ..barwell(Course::Decelerating)
    };
    let end = law.rate_per_mpa * law.dose_mpa_mm;
    for (name, cycles) in [("short", SHORT), ("long", (0.1, 200))] {
        let mut scene = scene(cycles, WearLaw::Barwell(law), &Side::BOTH[1..]);
        scene.accuracy = Accuracy::from_tolerance(0.1);
        let (summary, _) = solve(&scene).expect("the scene can be solved");
        let depth = summary.last.receptacle.max_depth_mm;
        println!(
            "Barwell, {name} stroke: {:.9} of the depth where the course ends, {} computed cycles",
            depth / end,
            summary.resolution.computed_cycles
        );
        assert!(depth <= end && depth > 0.999 * end);
    }
}

/// Each course in one stroke.
#[test]
fn barwells_law_does_not_depend_on_increments_and_jumps() {
    let [decelerating, accelerating] = COURSES.map(|(_, course)| WearLaw::Barwell(barwell(course)));
    check_refinement(
        "Barwell, decelerating, long stroke",
        &scene(LONG, decelerating, &Side::BOTH[1..]),
    );
    check_refinement(
        "Barwell, accelerating, both wear",
        &scene(SHORT, accelerating, &Side::BOTH),
    );
}

#[test]
fn bodies_can_be_swapped_beside_barwells_law() {
    for (course, law) in COURSES.map(|(name, course)| {
        let law = Barwell {
            rate_per_mpa: 2e-8,
            dose_mpa_mm: 2e4,
            course,
        };
        (name, WearLaw::Barwell(law))
    }) {
        let laws = Sides {
            slider: ARCHARD,
            receptacle: law,
        };
        check_swap(&format!("Barwell, {course}, beside Archard"), &laws);
    }
}

#[test]
fn runs_by_barwells_law_resume_to_the_same_bits() {
    for (course, law) in COURSES.map(|(name, course)| (name, WearLaw::Barwell(barwell(course)))) {
        for (stroke, (amplitude, cycles)) in [("short", (0.004, 1_000)), ("long", (0.1, 100))] {
            let mut scene = scene((amplitude, cycles), law, &Side::BOTH);
            scene.accuracy = Accuracy::from_tolerance(0.1);
            scene.output.snapshots_at_cycles = vec![cycles / 2, cycles];
            resumes_to_the_same_bits(&format!("Barwell, {course}, {stroke} stroke"), &scene, 2);
        }
    }
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes 15 s"]
    fn barwells_law_does_not_depend_on_increments_and_jumps() {
        for (course, law) in COURSES.map(|(name, course)| (name, WearLaw::Barwell(barwell(course))))
        {
            for (sides, cycles, wearing) in [
                ("receptacle wears", LONG, &Side::BOTH[1..]),
                ("both wear", SHORT, &Side::BOTH),
            ] {
                check_refinement(
                    &format!("Barwell, {course}, {sides}"),
                    &scene(cycles, law, wearing),
                );
            }
        }
    }

    #[test]
    #[ignore = "long: takes 55 s"]
    fn doses_add_up_whichever_body_wears() {
        for (course, law) in COURSES.map(|(name, course)| (name, barwell(course))) {
            for (stroke, cycles) in [("short", SHORT), ("long", LONG)] {
                for (sides, wearing) in SIDES {
                    let name = format!("{course}, {stroke} stroke, {sides}");
                    check_dose(&name, &scene(cycles, WearLaw::Barwell(law), wearing), law);
                }
            }
        }
    }
}
