//! Maps of a point contact as JSON, cut to what is worn or in contact, with a margin of one cell.

use std::ops::Range;

use api::results::{ContactMaps, DepthMap, PressureMap};
use solver::record::{self, AreaMaps};

/// The document of the maps at a cycle.
pub fn document(cycle: u64, maps: &AreaMaps) -> ContactMaps {
    let depth = |map: &solver::point::DepthMap| {
        let cut = Cut::of(map.z_mm.len(), &map.depth_mm);
        DepthMap {
            x_mm: map.x_mm[cut.rows.clone()].to_vec(),
            z_mm: map.z_mm[cut.columns.clone()].to_vec(),
            theta_deg: Vec::new(),
            depth_mm: cut.values(&map.depth_mm),
        }
    };
    ContactMaps {
        cycle,
        receptacle: depth(&maps.depth.receptacle),
        slider: depth(&maps.depth.slider),
        contact: pressure(&maps.pressure),
    }
}

/// Name of the file of a cycle.
pub fn file_name(cycle: u64) -> String {
    format!("maps-{cycle}.json")
}

fn pressure(map: &record::PressureMap) -> PressureMap {
    let cut = Cut::of(map.z_mm.len(), &map.pressure_mpa);
    PressureMap {
        x_mm: map.x_mm[cut.rows.clone()].to_vec(),
        z_mm: map.z_mm[cut.columns.clone()].to_vec(),
        theta_deg: Vec::new(),
        pressure_mpa: cut.values(&map.pressure_mpa),
    }
}

/// Rows and columns of a map that hold all values above 0.
pub(super) struct Cut {
    width: usize,
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
}

impl Cut {
    pub(super) fn of(width: usize, values: &[f64]) -> Self {
        let height = values.len() / width.max(1);
        let (mut rows, mut columns) = (height..0, width..0);
        for (index, _) in values.iter().enumerate().filter(|(_, value)| **value > 0.0) {
            let (row, column) = (index / width, index % width);
            rows = rows.start.min(row)..rows.end.max(row + 1);
            columns = columns.start.min(column)..columns.end.max(column + 1);
        }
        let widened = |range: Range<usize>, most: usize| {
            if range.is_empty() {
                // An unworn body: its middle.
                most / 2 - 1..most / 2 + 1
            } else {
                range.start.saturating_sub(1)..(range.end + 1).min(most)
            }
        };
        Self {
            width,
            rows: widened(rows, height),
            columns: widened(columns, width),
        }
    }

    /// The same rows in all columns.
    pub(super) fn of_all_columns(self) -> Self {
        Self {
            columns: 0..self.width,
            ..self
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "seven digits are beyond any tolerance"
    )]
    pub(super) fn values(&self, values: &[f64]) -> Vec<Vec<f32>> {
        let rows = self.rows.clone();
        rows.map(|row| {
            let row = &values[row * self.width..][self.columns.clone()];
            row.iter().map(|value| *value as f32).collect()
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_cut_to_what_is_worn() {
        let mut values = vec![0.0; 8 * 6];
        values[3 * 6 + 2] = 0.5;
        values[4 * 6 + 3] = 0.25;
        let cut = Cut::of(6, &values);
        assert_eq!((cut.rows.clone(), cut.columns.clone()), (2..6, 1..5));
        assert_eq!(cut.values(&values)[1], [0.0, 0.5, 0.0, 0.0]);
        let unworn = Cut::of(6, &[0.0; 48]);
        assert_eq!((unworn.rows, unworn.columns), (3..5, 2..4));
    }
}
