//! Limiting cases: wide and thin bodies, scaled and swapped ones, scenes that are refused.

use super::{TWO, button, difference, loaded, loaded_plane, over_plane, solved};
use solver::along_line::SectionsError;
use solver::extruded::{ExtrudedError, ExtrudedScene, MOST_LAYERS, run};
use solver::scene::Effect;
use solver::scene::{Ends, Friction, Motion, WearLaw};
use std::ops::ControlFlow;

/// The ends concern lengths of some heights, whatever the width: what they take off the load, and what they add to the approach and to the load in
/// the middle, falls with the inverse of the width. 0.6 a doubling, and 1 % at 13 heights of the block.
fn wide_bodies_are_plane_strain_in_the_middle() {
    let mut excess = Vec::new();
    for width_mm in [0.2, 0.4, 0.8] {
        let mut scene = loaded(Ends::Free, (16, 1.8));
        scene.width_mm = width_mm;
        let (approach, peaks, loads) = over_plane(&scene);
        let found = [approach, peaks[8], loads[8]].map(|ratio| ratio - 1.0);
        println!(
            "extruded, free, {width_mm} mm wide: approach {:+.3} %, in the middle peak {:+.3} %, line load {:+.3} %",
            100.0 * found[0],
            100.0 * found[1],
            100.0 * found[2]
        );
        excess.push(found);
    }
    for pair in excess.windows(2) {
        for (narrow, wide) in pair[0].iter().zip(&pair[1]) {
            assert!(*wide > 0.0 && *wide < 0.6 * narrow);
        }
    }
    assert!(excess[2].iter().all(|excess| *excess < 0.01));
}

/// Bodies that are thin against their contact are in plane stress: a plane strain of E (1 + 2 nu)/(1 + nu)^2 and nu/(1 + nu). Linear elements
/// contract evenly where that of plane stress would follow the pressure, and the supports are held across.
#[test]
fn thin_bodies_are_in_plane_stress() {
    let mut scene = loaded(Ends::Free, TWO);
    scene.width_mm = 1e-5;
    let summary = solved(&scene);
    let found = &summary.initial;
    let mut section = scene.section.clone();
    for elastic in [&mut section.slider.elastic, &mut section.receptacle.elastic] {
        let nu = elastic.poisson_ratio;
        elastic.youngs_modulus_mpa *= (1.0 + 2.0 * nu) / (1.0 + nu).powi(2);
        elastic.poisson_ratio = nu / (1.0 + nu);
    }
    // The mesh of the thin body.
    section.accuracy.contact_element_mm = scene.section.accuracy.contact_element_mm;
    let plane = loaded_plane(&section);
    let approach = summary.approach_mm / -plane.height - 1.0;
    println!("extruded, free, thin: approach off plane stress by {approach:.4}");
    for report in &found.stations {
        let peak = report.peak_pressure_mpa / plane.peak_pressure() - 1.0;
        println!("extruded, free, thin: peak pressure off plane stress by {peak:.4}");
        assert!(peak.abs() < 0.01);
    }
    assert!(approach.abs() < 0.01);
}

/// All lengths doubled, and the line load with them: the same pressures, depths doubled. A power of two changes no bits.
#[test]
fn doubled_lengths_wear_twice_as_deep() {
    let run = |factor: f64| {
        let mut scene = button(Ends::Free, (4, 1.5), 2);
        scene.section.accuracy.cycle_jump = Some(1);
        scene.section.accuracy.increments_per_cycle = Some(200);
        let Motion::Reciprocating { amplitude_mm, .. } = &mut scene.section.motion else {
            panic!("a reciprocating motion");
        };
        let (slider, receptacle) = (
            &mut scene.section.slider.shape,
            &mut scene.section.receptacle.shape,
        );
        for length in [
            &mut slider.radius_mm,
            &mut slider.half_width_mm,
            &mut slider.height_mm,
            &mut receptacle.length_mm,
            &mut receptacle.height_mm,
            &mut scene.width_mm,
            &mut scene.section.load_n_per_mm,
            amplitude_mm,
        ] {
            *length *= factor;
        }
        solved(&scene)
    };
    let (one, two) = (run(1.0), run(2.0));
    let mut off = 0.0_f64;
    for (one, two) in one.profiles.iter().zip(&two.profiles) {
        let halved = two
            .depth_mm
            .clone()
            .map(|depth| depth.iter().map(|d| 0.5 * d).collect());
        off = off.max(difference(&one.depth_mm, &halved));
    }
    println!("extruded, free: doubled lengths off by {off:.1e}");
    assert!(off < 1e-9);
}

/// k F s wears off whichever body wears, and in proportion to the load: 1 % for the walls. The end carries the less of its share the smaller
/// the load is.
#[test]
fn volumes_follow_the_load_and_the_rate_of_either_body() {
    let volume = |load: f64, slider: bool| {
        let mut scene = button(Ends::Free, TWO, 1);
        scene.section.accuracy.cycle_jump = Some(1);
        scene.section.load_n_per_mm *= load;
        let law = WearLaw::Archard {
            k_over_h_per_mpa: 2e-6,
        };
        scene.section.slider.wear = Some(law).filter(|_| slider);
        scene.section.receptacle.wear = Some(law).filter(|_| !slider);
        let found = solved(&scene);
        let volume = found.last.worn_volume_mm3;
        let end = found.initial.stations[0].line_load_n_per_mm / scene.section.load_n_per_mm;
        (volume.slider + volume.receptacle, end)
    };
    let (reference, end) = volume(1.0, false);
    for (load, slider) in [(0.5, false), (2.0, false), (1.0, true)] {
        let (found, share) = volume(load, slider);
        let ratio = found / (load * reference);
        println!(
            "extruded, free, load times {load}, slider worn {slider}: volume over k F s {ratio:.4}, load of the end {share:.3} ({end:.3})"
        );
        assert!((ratio - 1.0).abs() < 0.01);
    }
}

#[test]
fn the_same_scene_gives_the_same_bits() {
    let mut scene = button(Ends::Free, (4, 1.5), 3);
    scene.section.accuracy.increments_per_cycle = Some(200);
    assert_eq!(solved(&scene), solved(&scene));
}

#[test]
fn scenes_that_extruded_bodies_do_not_describe_are_refused() {
    let refused = |change: &dyn Fn(&mut ExtrudedScene)| {
        let mut scene = button(Ends::Free, TWO, 1);
        change(&mut scene);
        run(&scene, |_| ControlFlow::Continue(())).expect_err("refused")
    };
    assert_eq!(
        refused(&|scene| scene.layers = 3),
        ExtrudedError::Layers {
            layers: 3,
            limit: MOST_LAYERS
        }
    );
    let width = refused(&|scene| scene.width_mm = 0.0);
    assert_eq!(width.to_string(), "width in mm is 0, must be positive");
    let sticks = refused(&|scene| {
        scene.section.motion = Motion::Reciprocating {
            amplitude_mm: 1e-5,
            period_s: 1.0,
        };
        scene.section.effects = scene
            .section
            .effects
            .clone()
            .with(Effect::StickMemory, true);
    });
    let is_sticking = matches!(
        sticks,
        ExtrudedError::Sections(SectionsError::Sticks { .. })
    );
    assert!(is_sticking, "{sticks}");
    let large = refused(&|scene| {
        scene.section.friction = Friction::Frictionless;
        scene.layers = 40;
    });
    assert!(matches!(large, ExtrudedError::TooLarge { .. }), "{large}");
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 10 s"]
    fn wide_bodies_are_plane_strain_in_the_middle() {
        super::wide_bodies_are_plane_strain_in_the_middle();
    }
}
