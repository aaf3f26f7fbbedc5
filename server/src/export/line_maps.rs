//! Maps of a contact along a line or of a width: its sections side by side, those of a half mirrored, the whole ring from 0 to 360 degrees with its beginning
//! at both ends.
//!
//! Worn depths are those at the contact nodes of each body, which all sections share: nothing is interpolated. Pressures are known at the nodes
//! of the body that carries the constraints; they stand at the receptacle's nodes, linear between those. Between sections everything is linear:
//! the trapezoidal sum over a map is the worn volume of the summary, of a ring with its radius times the angle as the length.

use api::results::{ContactMaps, DepthMap, PressureMap};
use solver::along_line::Along;
use solver::interpolation;
use solver::record::{DepthProfile, Position, Snapshot, StationSnapshot};

use crate::export::maps::Cut;

/// The document of the maps of a snapshot; `None` of a contact that has no sections along a line.
pub fn document(snapshot: &Snapshot) -> Option<ContactMaps> {
    let columns = Columns::of(&snapshot.stations)?;
    let x_mm = &snapshot.stations.first()?.receptacle.x_mm;
    let depth = |of: fn(&StationSnapshot) -> &DepthProfile| {
        let x_mm = snapshot.stations.first().map(|station| &of(station).x_mm);
        let x_mm = x_mm.cloned().unwrap_or_default();
        let sections: Vec<&[f64]> = snapshot
            .stations
            .iter()
            .map(|station| &of(station).depth_mm[..])
            .collect();
        let cut = columns.cut(&x_mm, &sections);
        DepthMap {
            x_mm: cut.x_mm,
            z_mm: cut.z_mm,
            theta_deg: cut.theta_deg,
            depth_mm: cut.values,
        }
    };
    let pressures: Vec<Vec<f64>> = snapshot
        .stations
        .iter()
        .map(|station| pressure(station, x_mm))
        .collect();
    let pressures: Vec<&[f64]> = pressures.iter().map(Vec::as_slice).collect();
    let cut = columns.cut(x_mm, &pressures);
    Some(ContactMaps {
        cycle: snapshot.cycle,
        receptacle: depth(|station| &station.receptacle),
        slider: depth(|station| &station.slider),
        contact: PressureMap {
            x_mm: cut.x_mm,
            z_mm: cut.z_mm,
            theta_deg: cut.theta_deg,
            pressure_mpa: cut.values,
        },
    })
}

/// Pressure of a section at the neutral position at places on the receptacle, MPa.
fn pressure(station: &StationSnapshot, x_mm: &[f64]) -> Vec<f64> {
    let mut positions = station.positions.iter();
    let neutral = positions.find(|found| found.position == Position::Neutral);
    let known = neutral.and_then(|found| {
        let ends = (*found.x_mm.first()?, *found.x_mm.last()?);
        Some((found, ends))
    });
    let Some((found, (first, last))) = known else {
        return vec![0.0; x_mm.len()];
    };
    x_mm.iter()
        .map(|x| {
            if *x < first || *x > last {
                0.0
            } else {
                interpolation::linear(&found.x_mm, &found.pressure_mpa, *x)
            }
        })
        .collect()
}

/// Where the sections lie on the whole line: place, and number of the section.
struct Columns {
    places: Vec<(f64, usize)>,
    is_ring: bool,
}

impl Columns {
    fn of(stations: &[StationSnapshot]) -> Option<Self> {
        let first = stations.first()?.report.at;
        let is_ring = matches!(first, Along::AngleDeg(_));
        let given = stations.iter().enumerate().map(|(number, station)| {
            let (Along::AngleDeg(place) | Along::DistanceMm(place)) = station.report.at;
            (place, number)
        });
        let mut given: Vec<(f64, usize)> = given.collect();
        // The node planes of extruded bodies begin at the end.
        given.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mirrored = given.iter().rev();
        let places = match first {
            Along::AngleDeg(_) => {
                let other = mirrored
                    .skip(1)
                    .map(|(theta, number)| (360.0 - theta, *number));
                given.iter().copied().chain(other).collect()
            }
            // Half of a line begins in its middle.
            Along::DistanceMm(_) if given[0].0 >= 0.0 => {
                let other = mirrored.map(|(z, number)| (-z, *number));
                other
                    .take(given.len() - 1)
                    .chain(given.iter().copied())
                    .collect()
            }
            Along::DistanceMm(_) => given,
        };
        Some(Self { places, is_ring })
    }

    /// The part of a map that holds all values above 0, with a margin of one; of a ring all of its angles.
    fn cut(&self, x_mm: &[f64], sections: &[&[f64]]) -> Part {
        let rows = 0..x_mm.len();
        let values: Vec<f64> = rows
            .flat_map(|row| {
                let places = self.places.iter();
                places.map(move |(_, number)| sections[*number][row])
            })
            .collect();
        let cut = Cut::of(self.places.len(), &values);
        let cut = if self.is_ring {
            cut.of_all_columns()
        } else {
            cut
        };
        let along = self.places[cut.columns.clone()].iter();
        let along: Vec<f64> = along.map(|(place, _)| *place).collect();
        let (z_mm, theta_deg) = if self.is_ring {
            (Vec::new(), along)
        } else {
            (along, Vec::new())
        };
        Part {
            x_mm: x_mm[cut.rows.clone()].to_vec(),
            z_mm,
            theta_deg,
            values: cut.values(&values),
        }
    }
}

/// A part of a map.
struct Part {
    x_mm: Vec<f64>,
    z_mm: Vec<f64>,
    theta_deg: Vec<f64>,
    values: Vec<Vec<f32>>,
}
