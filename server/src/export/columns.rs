//! The wear history as named columns, units in the names: what its tables (CSV, Parquet) have in common.

use api::results::WearHistory;

/// The values of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'a> {
    /// Counts.
    Counts(&'a [u64]),
    /// Quantities.
    Numbers(&'a [f64]),
}

/// The columns in order.
pub fn of(history: &WearHistory) -> Vec<(String, Values<'_>)> {
    let mut columns = vec![
        ("cycle".to_owned(), Values::Counts(&history.cycle)),
        ("jump".to_owned(), Values::Counts(&history.jump)),
    ];
    let mut add = |name: String, values| columns.push((name, Values::Numbers(values)));
    add(
        "sliding_distance_mm".to_owned(),
        &history.sliding_distance_mm,
    );
    for station in &history.stations {
        let name = format!("{}_depth_at_{}_mm", station.side, station.x_mm);
        add(name, &station.depth_mm);
    }
    for (side, series) in [
        ("receptacle", &history.receptacle),
        ("slider", &history.slider),
    ] {
        add(format!("{side}_max_depth_mm"), &series.max_depth_mm);
        add(format!("{side}_worn_area_mm2"), &series.worn_area_mm2);
        add(
            format!("{side}_scar_half_width_mm"),
            &series.scar_half_width_mm,
        );
    }
    add("load_n_per_mm".to_owned(), &history.load_n_per_mm);
    add("peak_pressure_mpa".to_owned(), &history.peak_pressure_mpa);
    add(
        "contact_half_width_mm".to_owned(),
        &history.contact_half_width_mm,
    );
    add(
        "dissipated_energy_mj_per_mm".to_owned(),
        &history.dissipated_energy_mj_per_mm,
    );
    columns
}
