//! What runs of sections along a line share: reports and snapshots are those of the reference section, and of each section besides.

use crate::along_line::{StationCycle, StationProfile};
use crate::contact::ContactState;
use crate::cycle::FrictionLoop;
use crate::record::{
    self, CycleReport, DepthProfile, LineEnd, Snapshot, StationSnapshot, TractionField, WornArea,
    tractions,
};
use crate::scene::Scene;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

/// Sections along a line after a computed cycle.
pub(super) trait Sections {
    /// Worn depths of a section.
    fn profile(&self, section: usize) -> StationProfile;
    /// Contacts of a section at the named positions of the cycle, with the displacement of the slider, mm.
    fn contacts(&self, section: usize) -> impl Iterator<Item = (Position, f64, &ContactState)>;
    /// The body that carries the tractions.
    fn slave(&self) -> Side;
    /// The section whose profile stands for all.
    fn reference(&self) -> usize;
    /// The friction loop of the cycle.
    fn friction_loop(&self) -> &FrictionLoop;
}

/// Worn depths of all sections.
pub(super) fn worn(sections: &impl Sections, count: usize) -> Vec<StationProfile> {
    (0..count)
        .map(|section| sections.profile(section))
        .collect()
}

/// The scar over the whole line.
pub(super) fn scars(worn: &[StationProfile]) -> Sides<WornArea> {
    Sides::from_fn(|side| {
        let cells = worn.iter().flat_map(|station| station.cells(side));
        WornArea::of_cells(cells)
    })
}

/// The report of a cycle.
pub(super) fn report(
    sections: &impl Sections,
    scene: &Scene,
    (cycle, profiles): (&StationCycle, &[StationProfile]),
) -> CycleReport {
    record::line_report(&LineEnd {
        scene,
        cycle,
        profiles,
        reference: sections.reference(),
    })
}

/// The snapshot of a cycle.
pub(super) fn snapshot(
    sections: &impl Sections,
    cycle: &StationCycle,
    worn: Vec<StationProfile>,
) -> Snapshot {
    let reports = cycle.stations.iter();
    let stations: Vec<StationSnapshot> = reports
        .zip(worn)
        .enumerate()
        .map(|(number, (report, profile))| StationSnapshot {
            report: *report,
            receptacle: depths(&profile, Side::Receptacle),
            slider: depths(&profile, Side::Slider),
            positions: placed(sections, (number, &profile)),
        })
        .collect();
    let reference = &stations[sections.reference()];
    Snapshot {
        cycle: cycle.cycle,
        receptacle: reference.receptacle.clone(),
        slider: reference.slider.clone(),
        positions: reference.positions.clone(),
        friction_loop: sections.friction_loop().clone(),
        fields: Vec::new(),
        area: None,
        stations,
    }
}

fn depths(profile: &StationProfile, side: Side) -> DepthProfile {
    DepthProfile {
        x_mm: profile.x_mm.of(side).clone(),
        depth_mm: profile.depth_mm.of(side).clone(),
    }
}

/// Tractions of a section at the named positions of the last computed cycle.
fn placed(
    sections: &impl Sections,
    (number, profile): (usize, &StationProfile),
) -> Vec<TractionField> {
    let nodes = profile.x_mm.of(sections.slave());
    let contacts = sections.contacts(number);
    contacts
        .map(|(position, slider_x_mm, contact)| TractionField {
            slider_x_mm,
            ..tractions(position, sections.slave(), nodes, contact)
        })
        .collect()
}
