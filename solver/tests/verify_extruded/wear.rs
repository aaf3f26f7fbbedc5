//! Wear of extruded bodies in gross sliding: volumes are those of the sliding work, floors those of the line load, whatever the ends.

use super::{TWO, WIDTH, button, difference, solved};
use crate::verification::recorder::solve;
use crate::verification::scenes::{COPPER_WEAR, groove, pin, scar, sprung_contact};
use solver::along_line::SectionsOutcome;
use solver::extruded::{ExtrudedScene, ExtrudedSummary};
use solver::interpolation;
use solver::scene::{Accuracy, Drive, Ends, Friction, Motion, WearLaw};
use solver::scene::{Effect, Switches};
use solver::sides::{Side, Sides};

fn wear(factor: f64) -> Option<WearLaw> {
    (factor > 0.0).then_some(WearLaw::Archard {
        k_over_h_per_mpa: factor * COPPER_WEAR,
    })
}

fn in_single_cycles(mut scene: ExtrudedScene) -> ExtrudedScene {
    scene.section.accuracy.cycle_jump = Some(1);
    scene
}

fn known(volume: Option<f64>) -> f64 {
    volume.expect("dead load and a law that knows no depth")
}

/// Worn depths of the receptacle in the middle of the stroke in all planes, nm.
fn floors_nm(summary: &ExtrudedSummary) -> Vec<f64> {
    let planes = summary.profiles.iter();
    let floor = planes.map(|plane| {
        let (x, depth) = (&plane.x_mm.receptacle, &plane.depth_mm.receptacle);
        1e6 * interpolation::linear(x, depth, 0.0)
    });
    floor.collect()
}

/// A body loses what p |slip| wears, to round-off: 1e-10, in jumps too and with either body worn or both. In thin grooves that is k F s but
/// for the walls at the ends of the stroke, 1 %. The forces of all nodes carry the load, and friction dissipates mu F s, but for the walls.
#[test]
fn volumes_are_those_of_the_sliding_work() {
    for (name, [slider, receptacle], layers, jump) in [
        ("receptacle", [0.0, 1.0], (4, 1.5), Some(1)),
        ("receptacle", [0.0, 1.0], TWO, None),
        ("slider", [0.1, 0.0], TWO, Some(1)),
        ("both", [0.1, 1.0], TWO, Some(1)),
    ] {
        let mut scene = button(Ends::Free, layers, 4);
        scene.section.accuracy.cycle_jump = jump;
        scene.section.slider.wear = wear(slider);
        scene.section.receptacle.wear = wear(receptacle);
        let last = solved(&scene).last;
        for side in Side::BOTH {
            let worn = *last.worn_volume_mm3.of(side);
            if worn <= 0.0 {
                continue;
            }
            let balance = worn / known(*last.sliding_work_volume_mm3.of(side)) - 1.0;
            let ideal = worn / known(*last.ideal_volume_mm3.of(side)) - 1.0;
            println!(
                "extruded, free, {name} worn, jump {jump:?}: volume of the {} off the sliding work by {balance:.1e}, off k F s by {ideal:.4}",
                side.name()
            );
            assert!(balance.abs() < 1e-10 && ideal.abs() < 0.01);
        }
        assert!((last.force_n / scene.force_n() - 1.0).abs() < 1e-9);
        let slid = 4.0 * scene.section.motion.distance_per_cycle_mm();
        let friction = last.dissipated_energy_mj / (1.21 * scene.force_n() * slid);
        assert!((friction - 1.0).abs() < 0.01, "{friction}");
    }
}

/// A floor that the contact passes twice a cycle sinks by 2 k P', as soon as it has sunk by some of the differences of the approach: from cycle
/// 5 to 15, 2 %, which are ripples of increments. The line load of the unworn end is up to 15 % too small.
#[test]
fn floors_sink_by_the_line_load_whatever_the_ends() {
    let ideal = 2e6 * COPPER_WEAR * 0.508;
    for (ends, layers) in [(Ends::Held, TWO), (Ends::Free, TWO), (Ends::Free, (4, 3.0))] {
        let run = |cycles| solved(&in_single_cycles(button(ends, layers, cycles)));
        let (early, late) = (run(5), run(15));
        let rates: Vec<f64> = (floors_nm(&late).iter().zip(floors_nm(&early)))
            .map(|(late, early)| (late - early) / 10.0)
            .collect();
        let loads: Vec<f64> = (early.initial.stations.iter())
            .map(|plane| plane.line_load_n_per_mm / 0.508)
            .collect();
        println!(
            "extruded, {ends:?}, {layers:?} layers: {rates:.2?} nm a cycle, 2 k P' {ideal:.2} nm; unworn line loads {loads:.2?}; {:?} increments and iterations",
            late.solves
        );
        for rate in rates {
            assert!((rate / ideal - 1.0).abs() < 0.02);
        }
    }
}

/// Other sections of the suite between free ends, in jumps: a sprung contact and a pin of 0.2 mm, McColl's scar of 5 mm, a crowned block, the
/// thesis' drive, a wall at its friction angle. Volumes and forces as above; k F s but for walls, 5 %. The end wears less where the stroke is shorter
/// than the contact, because nothing evens the pressure out but wear.
#[test]
fn sections_of_the_suite_run_between_free_ends() {
    let mut crown = groove();
    crown.receptacle.shape.crown_radius_mm = Some(0.2);
    let mut guided = groove();
    guided.drive = Drive::WholeBody;
    let mut steep = groove();
    steep.friction = Friction::Coulomb { coefficient: 1.5 };
    steep.cycles = 300;
    for (name, section, width_mm) in [
        ("sprung contact", sprung_contact(), 0.2),
        ("pin", pin(), 0.2),
        ("scar", scar(), 5.0),
        ("crown", crown, WIDTH),
        ("whole slider driven", guided, WIDTH),
        ("steep wall", steep, WIDTH),
    ] {
        let mut scene = button(Ends::Free, TWO, 0);
        scene.section = section;
        scene.section.accuracy = Accuracy::from_tolerance(0.1);
        scene.width_mm = width_mm;
        let found = solved(&scene);
        let last = &found.last;
        let worn = last.worn_volume_mm3.receptacle;
        let balance = worn / known(last.sliding_work_volume_mm3.receptacle) - 1.0;
        let ideal = worn / known(last.ideal_volume_mm3.receptacle) - 1.0;
        let depths = last
            .stations
            .iter()
            .map(|plane| 1e3 * plane.max_depth_mm.receptacle);
        println!(
            "extruded, free, {name}: {:.4?} um, volume off the sliding work by {balance:.1e}, off k F s by {ideal:.4}, {} computed cycles",
            depths.collect::<Vec<f64>>(),
            found.computed_cycles
        );
        assert_eq!(found.outcome, SectionsOutcome::Completed);
        assert!(balance.abs() < 1e-10 && ideal.abs() < 0.05);
        assert!((last.force_n / scene.force_n() - 1.0).abs() < 1e-9);
        assert!(
            last.stations[0].max_depth_mm.receptacle < last.stations[1].max_depth_mm.receptacle
        );
    }
}

/// Motion that begins the other way wears the mirror image: 1e-9.
fn mirrored_motion_wears_the_mirror_image() {
    let run = |sign: f64| {
        let mut scene = in_single_cycles(button(Ends::Free, (4, 1.5), 3));
        scene.section.slider.wear = wear(0.1);
        scene.section.motion = Motion::Reciprocating {
            amplitude_mm: sign * 0.033_868,
            period_s: 16.0,
        };
        solved(&scene)
    };
    let (one, other) = (run(1.0), run(-1.0));
    let mut off = 0.0_f64;
    for (one, other) in one.profiles.iter().zip(&other.profiles) {
        let mirrored = other.depth_mm.clone().map(|mut depth| {
            depth.reverse();
            depth
        });
        off = off.max(difference(&one.depth_mm, &mirrored));
    }
    println!("extruded, free: mirror image off by {off:.1e}");
    assert!(off < 1e-9);
}

/// Bodies that are condensed again as they wear, each section with its own heights: of held ones as in the plane, 1e-9.
fn relocated_bodies_follow_their_own_surfaces() {
    let worn = |ends| {
        let mut scene = in_single_cycles(button(ends, (4, 1.5), 64));
        scene.section.accuracy.increments_per_cycle = Some(200);
        // A micrometre is then half of the block's height: a drift.
        scene.section.receptacle.shape.height_mm = 0.002;
        scene.section.slider.wear = wear(0.1);
        scene.section.effects = Switches::default().with(Effect::Relocation, true);
        scene
    };
    let held = worn(Ends::Held);
    let (found, mut plane) = (solved(&held), held.section);
    plane.effects = plane.effects.with(Effect::StickMemory, false);
    let (_, recorder) = solve(&plane).expect("the scene can be solved");
    let last = recorder.snapshots.last().expect("of the last cycle");
    let depth = Sides {
        slider: last.slider.depth_mm.clone(),
        receptacle: last.receptacle.depth_mm.clone(),
    };
    let off = difference(&found.profiles[0].depth_mm, &depth);
    let free = solved(&worn(Ends::Free));
    let last = &free.last;
    let balance = Sides::from_fn(|side| {
        last.worn_volume_mm3.of(side) / known(*last.sliding_work_volume_mm3.of(side)) - 1.0
    });
    println!(
        "extruded, condensed again {} and {} times: held off the plane by {off:.1e}; free, volumes off the sliding work by {:.1e} and {:.1e}",
        found.relocations, free.relocations, balance.slider, balance.receptacle
    );
    assert!(found.relocations > 1 && free.relocations > 1);
    assert!(off < 1e-9);
    assert!(balance.slider.abs() < 1e-10 && balance.receptacle.abs() < 1e-10);
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 26 s"]
    fn relocated_bodies_follow_their_own_surfaces() {
        super::relocated_bodies_follow_their_own_surfaces();
    }

    #[test]
    #[ignore = "long: takes 10 s"]
    fn mirrored_motion_wears_the_mirror_image() {
        super::mirrored_motion_wears_the_mirror_image();
    }
}
