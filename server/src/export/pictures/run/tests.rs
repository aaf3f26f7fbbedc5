use api::results::{Loop, Pressure, Profile};
use solver::record::{CycleReport, SideReport};

use super::*;
use crate::export::pictures::svg;

fn history() -> Record {
    let reports = [(0, 0.0), (10, 1e-3), (20, 2e-3)].map(|(cycle, depth)| CycleReport {
        cycle,
        station_depth_mm: vec![depth],
        receptacle: SideReport {
            max_depth_mm: depth,
            ..SideReport::default()
        },
        ..CycleReport::default()
    });
    Record::new(&reports, &[0.0])
}

fn snapshot(cycle: u64, depth_mm: f64) -> Snapshot {
    let x_mm = vec![-0.1, 0.0, 0.1];
    let worn = SideProfile {
        x_mm: x_mm.clone(),
        depth_mm: vec![0.0, depth_mm, 0.0],
    };
    let neutral = PressurePosition {
        phase: SlidePosition::Neutral,
        slider_x_mm: 0.0,
        x_mm,
        pressure_mpa: vec![0.0, 300.0, 0.0],
        shear_mpa: vec![0.0, 90.0, 0.0],
    };
    Snapshot {
        profile: Profile {
            cycle,
            receptacle: worn,
            slider: SideProfile::default(),
        },
        pressure: Pressure {
            cycle,
            positions: vec![neutral],
        },
        friction_loop: Loop {
            cycle,
            displacement_mm: vec![0.01, -0.01],
            tangential_force_n_per_mm: vec![1.0, -1.0],
            tangential_force_n: Vec::new(),
        },
    }
}

fn titles(picture: &Picture) -> Vec<&str> {
    let panels = picture.panels.iter();
    panels
        .flat_map(|panel| [panel.x.title.as_str(), panel.y.title.as_str()])
        .collect()
}

#[test]
fn a_run_has_four_pictures_whose_axes_name_their_units() {
    let snapshots = [snapshot(10, 1e-3), snapshot(20, 2e-3)];
    let pictures = pictures("a run", &history(), &snapshots);
    let found: Vec<_> = pictures
        .iter()
        .map(|(name, picture)| (*name, titles(picture)))
        .collect();
    let expected = [
        ("wear-history", vec!["cycle", "worn depth (µm)"]),
        (
            "profiles",
            vec!["place along the receptacle (µm)", "worn depth (µm)"],
        ),
        (
            "pressure",
            vec![
                "place along the receptacle (µm)",
                "pressure (MPa)",
                "place along the receptacle (µm)",
                "shear on the receptacle (MPa)",
            ],
        ),
        (
            "loops",
            vec![
                "imposed displacement (µm)",
                "friction force (N per mm of depth)",
            ],
        ),
    ];
    assert_eq!(found, expected);
}

#[test]
fn pictures_are_drawn_without_system_fonts() {
    let snapshots = [snapshot(10, 1e-3), snapshot(20, 2e-3)];
    for (name, picture) in pictures("a run", &history(), &snapshots) {
        let drawing = svg(&picture).expect("it can be drawn");
        assert!(drawing.contains("a run"), "{name}");
        assert!(drawing.matches("<text").count() > 10, "{name}");
    }
}

#[test]
fn every_name_can_be_drawn() {
    let names = [
        (
            "a\u{0}b\u{1}\u{1f}\u{ffff}",
            "a\u{fffd}b\u{fffd}\u{fffd}\u{fffd}",
        ),
        ("<b> & \"c\" ü 漢", "&lt;b&gt; &amp; &quot;c&quot; ü 漢"),
    ];
    for (name, expected) in names {
        for (_, picture) in pictures(name, &history(), &[]) {
            let drawing = svg(&picture).expect("it can be drawn");
            assert!(drawing.contains(expected), "{drawing}");
            let forbidden = |c: char| (c < ' ' && !"\t\r\n".contains(c)) || c == '\u{ffff}';
            assert!(!drawing.contains(forbidden), "{drawing}");
        }
    }
}

#[test]
fn a_run_without_wear_or_cycles_has_no_picture_of_them() {
    let mut unworn = snapshot(0, 0.0);
    unworn.friction_loop = Loop::default();
    let empty = Record::default();
    let names: Vec<_> = pictures("", &empty, &[unworn])
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    assert_eq!(names, ["pressure"]);
}

#[test]
fn of_many_snapshots_every_nth_is_drawn_and_the_last_one() {
    let snapshots: Vec<_> = (1..=40).map(|cycle| snapshot(cycle, 1e-3)).collect();
    let shown = every_nth(&snapshots);
    assert!(shown.len() <= MOST_SNAPSHOTS);
    assert_eq!(
        shown.last().map(|last| last.snapshot.profile.cycle),
        Some(40)
    );
}
