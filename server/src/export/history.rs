//! The engine's reports to result documents.

use api::job::{Outcome, Phase};
use api::results::{
    AccuracyReached, Checks, Cost, CycleRow, Initial, Loop, Pressure, PressurePosition, Profile,
    SideProfile, SideRow, SideSeries, SideSummary, SlidePosition, Snapshot, Station, Summary,
    WearHistory,
};
use solver::{history, observer};

/// A phase of the work.
pub fn phase(phase: observer::Phase) -> Phase {
    match phase {
        observer::Phase::Mesh => Phase::Mesh,
        observer::Phase::Condense => Phase::Condense,
        observer::Phase::Cycles => Phase::Cycles,
        observer::Phase::Relocate => Phase::Relocate,
    }
}

/// A row of the wear history.
pub fn row(report: &history::CycleReport) -> CycleRow {
    CycleRow {
        cycle: report.cycle,
        jump: report.jump,
        jump_error: report.jump_error,
        sliding_distance_mm: report.sliding_distance_mm,
        receptacle: side_row(&report.receptacle),
        slider: side_row(&report.slider),
        station_depth_mm: report.station_depth_mm.clone(),
        load_n_per_mm: report.load_n_per_mm,
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
        dissipated_energy_mj_per_mm: report.dissipated_energy_mj_per_mm,
    }
}

fn side_row(side: &history::SideReport) -> SideRow {
    SideRow {
        max_depth_mm: side.max_depth_mm,
        worn_area_mm2: side.worn_area_mm2,
        scar_half_width_mm: side.scar_half_width_mm,
    }
}

/// What is stored at a cycle.
pub fn snapshot(snapshot: &history::Snapshot) -> Snapshot {
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

fn side_profile(profile: &history::DepthProfile) -> SideProfile {
    SideProfile {
        x_mm: profile.x_mm.clone(),
        depth_mm: profile.depth_mm.clone(),
    }
}

fn position(field: &history::TractionField) -> PressurePosition {
    PressurePosition {
        phase: match field.position {
            history::Position::Neutral => SlidePosition::Neutral,
            history::Position::Rightmost => SlidePosition::Rightmost,
            history::Position::Leftmost => SlidePosition::Leftmost,
        },
        slider_x_mm: field.slider_x_mm,
        x_mm: field.x_mm.clone(),
        pressure_mpa: field.pressure_mpa.clone(),
        shear_mpa: field.shear_mpa.clone(),
    }
}

/// The result in short. `cost` was measured outside the engine, which knows no clock; its `dofs` are filled in here.
pub fn summary(summary: &history::Summary, cost: Cost) -> Summary {
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

fn outcome(outcome: history::Outcome) -> Outcome {
    match outcome {
        history::Outcome::Completed => Outcome::Completed,
        history::Outcome::StopCondition => Outcome::StopCondition,
        history::Outcome::WornThrough => Outcome::WornThrough,
        history::Outcome::Stopped => Outcome::Stopped,
    }
}

fn side_summary(side: &history::SideReport) -> SideSummary {
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

/// Rows to columns; `stations_mm` in the order of the rows' depths.
pub fn columns(rows: &[CycleRow], stations_mm: &[f64]) -> WearHistory {
    let column = |value: fn(&CycleRow) -> f64| rows.iter().map(value).collect::<Vec<_>>();
    WearHistory {
        cycle: rows.iter().map(|row| row.cycle).collect(),
        jump: rows.iter().map(|row| row.jump).collect(),
        sliding_distance_mm: column(|row| row.sliding_distance_mm),
        stations: stations_mm
            .iter()
            .enumerate()
            .map(|(index, x_mm)| station(rows, index, *x_mm))
            .collect(),
        receptacle: side_series(rows, |row| &row.receptacle),
        slider: side_series(rows, |row| &row.slider),
        load_n_per_mm: column(|row| row.load_n_per_mm),
        peak_pressure_mpa: column(|row| row.peak_pressure_mpa),
        contact_half_width_mm: column(|row| row.contact_half_width_mm),
        dissipated_energy_mj_per_mm: column(|row| row.dissipated_energy_mj_per_mm),
    }
}

fn station(rows: &[CycleRow], index: usize, x_mm: f64) -> Station {
    let depth_mm = rows
        .iter()
        .map(|row| row.station_depth_mm.get(index).copied().unwrap_or_default())
        .collect();
    Station {
        side: "receptacle".to_owned(),
        x_mm,
        depth_mm,
    }
}

fn side_series(rows: &[CycleRow], side: fn(&CycleRow) -> &SideRow) -> SideSeries {
    SideSeries {
        max_depth_mm: rows.iter().map(|row| side(row).max_depth_mm).collect(),
        worn_area_mm2: rows.iter().map(|row| side(row).worn_area_mm2).collect(),
        scar_half_width_mm: rows
            .iter()
            .map(|row| side(row).scar_half_width_mm)
            .collect(),
    }
}
