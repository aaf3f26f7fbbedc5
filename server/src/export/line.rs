//! Sections along the line of a contact as documents.

use api::results::{LineProfile, LineProfiles, LineSeries, LineStation, SectionSide, SideProfile};
use solver::along_line::{Along, StationReport};
use solver::record::{DepthProfile, LineColumns, Snapshot};
use solver::sides::Side;

use crate::export::tractions;

/// The section of a report.
pub fn station(report: &StationReport) -> LineStation {
    let (theta_deg, z_mm) = place(report.at);
    let side = |side: Side| SectionSide {
        max_depth_mm: *report.max_depth_mm.of(side),
        worn_area_mm2: *report.worn_area_mm2.of(side),
    };
    LineStation {
        theta_deg,
        z_mm,
        length_mm: report.weight_mm,
        line_load_n_per_mm: report.line_load_n_per_mm,
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.half_width_mm,
        receptacle: side(Side::Receptacle),
        slider: side(Side::Slider),
    }
}

/// The document of all sections of a snapshot.
pub fn document(snapshot: &Snapshot) -> LineProfiles {
    let profile = |profile: &DepthProfile| SideProfile {
        x_mm: profile.x_mm.clone(),
        depth_mm: profile.depth_mm.clone(),
    };
    let stations = snapshot.stations.iter().map(|found| LineProfile {
        station: station(&found.report),
        receptacle_profile: profile(&found.receptacle),
        slider_profile: profile(&found.slider),
        positions: found.positions.iter().map(tractions::position).collect(),
    });
    LineProfiles {
        cycle: snapshot.cycle,
        stations: stations.collect(),
    }
}

/// Name of the file of a cycle.
pub fn file_name(cycle: u64) -> String {
    format!("stations-{cycle}.json")
}

/// The histories of a section.
pub fn series(columns: LineColumns) -> LineSeries {
    let (theta_deg, z_mm) = place(columns.at);
    LineSeries {
        theta_deg,
        z_mm,
        line_load_n_per_mm: columns.line_load_n_per_mm,
        receptacle_max_depth_mm: columns.max_depth_mm.receptacle,
        slider_max_depth_mm: columns.max_depth_mm.slider,
    }
}

fn place(at: Along) -> (Option<f64>, Option<f64>) {
    match at {
        Along::AngleDeg(theta) => (Some(theta), None),
        Along::DistanceMm(z) => (None, Some(z)),
    }
}
