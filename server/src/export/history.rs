//! The engine's reports to result documents.

use api::job::{Outcome, Phase};
use api::results::{
    AccuracyReached, Checks, Cost, Initial, Loop, Pressure, PressurePosition, Profile, SideProfile,
    SideSummary, SlidePosition, Snapshot, Station, Summary, WearHistory,
};
use solver::observer;
use solver::record::{self, Record, Side};

/// A phase of the work.
pub fn phase(phase: observer::Phase) -> Phase {
    match phase {
        observer::Phase::Mesh => Phase::Mesh,
        observer::Phase::Condense => Phase::Condense,
        observer::Phase::Cycles => Phase::Cycles,
        observer::Phase::Relocate => Phase::Relocate,
    }
}

/// What is stored at a cycle.
pub fn snapshot(snapshot: &record::Snapshot) -> Snapshot {
    let cycle = snapshot.cycle;
    Snapshot {
        profile: Profile {
            cycle,
            receptacle: side_profile(&snapshot.receptacle),
            slider: side_profile(&snapshot.slider),
        },
        pressure: Pressure {
            cycle,
            positions: snapshot.positions.iter().map(position).collect(),
        },
        friction_loop: Loop {
            cycle,
            displacement_mm: snapshot.friction_loop.displacement_mm.clone(),
            tangential_force_n_per_mm: snapshot.friction_loop.tangential_force_n_per_mm.clone(),
        },
    }
}

fn side_profile(profile: &record::DepthProfile) -> SideProfile {
    SideProfile {
        x_mm: profile.x_mm.clone(),
        depth_mm: profile.depth_mm.clone(),
    }
}

fn position(field: &record::TractionField) -> PressurePosition {
    PressurePosition {
        phase: match field.position {
            record::Position::Neutral => SlidePosition::Neutral,
            record::Position::Rightmost => SlidePosition::Rightmost,
            record::Position::Leftmost => SlidePosition::Leftmost,
        },
        slider_x_mm: field.slider_x_mm,
        x_mm: field.x_mm.clone(),
        pressure_mpa: field.pressure_mpa.clone(),
        shear_mpa: field.shear_mpa.clone(),
    }
}

/// The result in short. `cost` was measured outside the engine, which knows no clock; its `dofs` are filled in here.
pub fn summary(summary: &record::Summary, cost: Cost) -> Summary {
    let (last, resolution, checks) = (&summary.last, &summary.resolution, &summary.checks);
    Summary {
        cycles_done: last.cycle,
        sliding_distance_mm: last.sliding_distance_mm,
        outcome: outcome(summary.outcome),
        receptacle: side_summary(&last.receptacle),
        slider: side_summary(&last.slider),
        peak_pressure_mpa: last.peak_pressure_mpa,
        contact_half_width_mm: last.contact_half_width_mm,
        initial: Initial {
            peak_pressure_mpa: summary.initial.peak_pressure_mpa,
            contact_half_width_mm: summary.initial.contact_half_width_mm,
        },
        dissipated_energy_mj_per_mm: last.dissipated_energy_mj_per_mm,
        accuracy: AccuracyReached {
            estimated_relative_error: resolution.estimated_relative_error,
            contact_elements: count(resolution.contact_elements),
            contact_element_mm: resolution.contact_element_mm,
            increments_per_cycle: resolution.increments_per_cycle,
            computed_cycles: resolution.computed_cycles,
            increments: resolution.increments,
            relocations: resolution.relocations,
        },
        cost: Cost {
            dofs: count(resolution.dofs),
            ..cost
        },
        checks: Checks {
            force_balance: checks.force_balance,
            worn_area: checks.worn_area,
            complementarity: checks.complementarity,
            friction_cone: checks.friction_cone,
            friction_use: checks.friction_use,
        },
    }
}

fn outcome(outcome: record::Outcome) -> Outcome {
    match outcome {
        record::Outcome::Completed => Outcome::Completed,
        record::Outcome::StopCondition => Outcome::StopCondition,
        record::Outcome::WornThrough => Outcome::WornThrough,
        record::Outcome::Stopped => Outcome::Stopped,
    }
}

fn side_summary(side: &record::SideReport) -> SideSummary {
    SideSummary {
        max_depth_mm: side.max_depth_mm,
        worn_area_mm2: side.worn_area_mm2,
        ideal_area_mm2: side.ideal_area_mm2,
        scar_half_width_mm: side.scar_half_width_mm,
    }
}

fn count(count: usize) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

/// The wear history as a document.
pub fn document(record: Record) -> WearHistory {
    let mut history = WearHistory {
        cycle: record.cycle,
        jump: record.jump,
        sliding_distance_mm: record.sliding_distance_mm,
        ..WearHistory::default()
    };
    for column in record.columns {
        let columns = match (column.side, column.place_mm) {
            (Some(side), Some(x_mm)) => {
                history.stations.push(Station {
                    side: side.name().to_owned(),
                    x_mm,
                    depth_mm: column.values,
                });
                continue;
            }
            (Some(Side::Receptacle), None) => &mut history.receptacle.columns,
            (Some(Side::Slider), None) => &mut history.slider.columns,
            (None, _) => &mut history.contact,
        };
        columns.insert(column.name.to_owned(), column.values);
    }
    history
}
