//! The picture of the maps of a contact: worn depths of the bodies that wear, and the pressure, over the place along the line and across it.

use api::results::{ContactMaps, DepthMap, PressureMap};

use crate::export::pictures::run::{largest, unit};
use crate::export::pictures::{ColourMap, MapPanel};

/// Places across the line, mm, and the title of their axis.
type Across<'a> = (&'a [f64], &'a str);
/// Places along the line, mm, or angles, degrees; one of both is empty.
type Along<'a> = (&'a [f64], &'a [f64]);

/// The picture of the maps at a cycle.
pub fn picture(maps: &ContactMaps) -> ColourMap {
    let depths = [("receptacle", &maps.receptacle), ("slider", &maps.slider)];
    let depths = depths
        .into_iter()
        .filter_map(|(side, map)| depth(side, map));
    ColourMap {
        title: format!("Contact at cycle {}", maps.cycle),
        panels: depths.chain(pressure(&maps.contact)).collect(),
    }
}

/// Name of the file of a cycle.
pub fn file_name(cycle: u64) -> String {
    format!("maps-{cycle}.svg")
}

/// The worn depth of a side; `None` if it is not worn.
fn depth(side: &str, map: &DepthMap) -> Option<MapPanel> {
    let values = rows(&map.depth_mm);
    let deepest = largest(values.iter().flatten());
    let (name, factor) = unit(deepest);
    let across = format!("across, on the {side}");
    (deepest > 0.0).then(|| {
        let place = (&map.x_mm[..], across.as_str());
        panel(
            format!("depth ({name})"),
            (place, (&map.z_mm, &map.theta_deg)),
            (values, factor),
        )
    })
}

/// The pressure; `None` without contact.
fn pressure(map: &PressureMap) -> Option<MapPanel> {
    let values = rows(&map.pressure_mpa);
    (largest(values.iter().flatten()) > 0.0).then(|| {
        panel(
            "pressure (MPa)".to_owned(),
            ((&map.x_mm, "across"), (&map.z_mm, &map.theta_deg)),
            (values, 1.0),
        )
    })
}

fn rows(values: &[Vec<f32>]) -> Vec<Vec<f64>> {
    let rows = values.iter();
    rows.map(|row| row.iter().map(|value| f64::from(*value)).collect())
        .collect()
}

/// Values times a factor, with a row for each place across the line.
fn panel(
    quantity: String,
    ((x_mm, across), (z_mm, theta_deg)): (Across<'_>, Along<'_>),
    (mut rows, factor): (Vec<Vec<f64>>, f64),
) -> MapPanel {
    for value in rows.iter_mut().flatten() {
        *value *= factor;
    }
    let (y_name, y) = unit(largest(x_mm));
    let (x, at_x) = if theta_deg.is_empty() {
        let (name, factor) = unit(largest(z_mm));
        let places = z_mm.iter().map(|z| factor * z).collect();
        (format!("place along the line ({name})"), places)
    } else {
        ("angle from the motion (deg)".to_owned(), theta_deg.to_vec())
    };
    MapPanel {
        quantity,
        x,
        y: format!("{across} ({y_name})"),
        at_x,
        at_y: x_mm.iter().map(|x| y * x).collect(),
        rows,
    }
}
