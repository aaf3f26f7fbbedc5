//! The wear history as a list of named columns of equal length.

use crate::along_line::{Along, StationReport};
use crate::record::{Channels, CycleReport};
use crate::sides::{Side, Sides};

/// A layer below the outermost one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    /// A layer of the plating, the outermost one being 1.
    Plated(usize),
    /// The base.
    BaseMetal,
}

/// One scalar over the computed cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name of the scalar; it ends with the unit.
    pub name: &'static str,
    /// Unit as names spell it.
    pub unit: &'static str,
    /// The body it belongs to; `None` for the contact as a whole.
    pub side: Option<Side>,
    /// The place on the body, mm; `None` for the body as a whole.
    pub place_mm: Option<f64>,
    /// The layer that it belongs to, from the surface down; `None` for the body as a whole.
    pub layer: Option<Layer>,
    /// Name of its curve in the picture of worn depths; empty if it is not drawn there.
    pub curve: &'static str,
    /// One value a report.
    pub values: Vec<f64>,
}

impl Column {
    /// Header in tables: `receptacle_depth_at_0.1_mm`, `slider_exposed_length_of_layer_2_mm`, `slider_max_depth_mm`,
    /// `peak_pressure_mpa`.
    pub fn header(&self) -> String {
        let side = self
            .side
            .map_or_else(String::new, |side| format!("{}_", side.name()));
        let of = match (self.place_mm, self.layer) {
            (None, None) => return format!("{side}{}", self.name),
            (Some(place), _) => format!("at_{place}"),
            (None, Some(Layer::Plated(number))) => format!("of_layer_{number}"),
            (None, Some(Layer::BaseMetal)) => "of_base_metal".to_owned(),
        };
        let quantity = self.name.strip_suffix(self.unit).unwrap_or(self.name);
        format!("{side}{quantity}{of}_{}", self.unit)
    }
}

/// The wear history of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Record {
    /// Physical cycles done.
    pub cycle: Vec<u64>,
    /// Physical cycles that each computed cycle represents.
    pub jump: Vec<u64>,
    /// Accumulated imposed sliding distance, mm.
    pub sliding_distance_mm: Vec<f64>,
    /// Worn depth at the stations, then the channels of the receptacle and its exposed layers, the same of the slider, and the
    /// channels of the contact, of its resistance, of its temperature and of its extent across, if these are computed.
    pub columns: Vec<Column>,
    /// The sections along a line, in their order; none of another contact.
    pub line: Vec<LineColumns>,
}

/// Histories of a section along a line, one value a report.
#[derive(Debug, Clone, PartialEq)]
pub struct LineColumns {
    /// Where it is.
    pub at: Along,
    /// Line load, N/mm.
    pub line_load_n_per_mm: Vec<f64>,
    /// Largest worn depth of each side, mm.
    pub max_depth_mm: Sides<Vec<f64>>,
}

impl LineColumns {
    /// The columns under their headers: `line_load_at_22.5_deg_n_per_mm`, `receptacle_max_depth_at_z_-0.2_mm_mm`.
    pub fn named(&self) -> [(String, &[f64]); 3] {
        let at = match self.at {
            Along::AngleDeg(theta) => format!("at_{theta}_deg"),
            Along::DistanceMm(z) => format!("at_z_{z}_mm"),
        };
        [
            (
                format!("line_load_{at}_n_per_mm"),
                &self.line_load_n_per_mm[..],
            ),
            (
                format!("receptacle_max_depth_{at}_mm"),
                &self.max_depth_mm.receptacle,
            ),
            (
                format!("slider_max_depth_{at}_mm"),
                &self.max_depth_mm.slider,
            ),
        ]
    }
}

impl Record {
    /// The columns of reports; `stations_mm` in the order of the reports' station depths.
    pub fn new(reports: &[CycleReport], stations_mm: &[f64]) -> Self {
        let stations = stations_mm.iter().enumerate().map(|(index, &x)| Column {
            name: "depth_mm",
            unit: "mm",
            side: Some(Side::Receptacle),
            place_mm: Some(x),
            layer: None,
            curve: "",
            values: reports
                .iter()
                .map(|report| {
                    report
                        .station_depth_mm
                        .get(index)
                        .copied()
                        .unwrap_or_default()
                })
                .collect(),
        });
        let receptacle = columns(reports, Some(Side::Receptacle), |report| &report.receptacle);
        let slider = columns(reports, Some(Side::Slider), |report| &report.slider);
        let contact = columns(reports, None, |report| report);
        let resistance = computed(reports, |report| report.resistance.as_ref());
        let temperature = computed(reports, |report| report.temperature.as_ref());
        let extent = computed(reports, |report| report.extent.as_ref());
        Self {
            cycle: reports.iter().map(|report| report.cycle).collect(),
            jump: reports.iter().map(|report| report.jump).collect(),
            sliding_distance_mm: reports
                .iter()
                .map(|report| report.sliding_distance_mm)
                .collect(),
            columns: stations
                .chain(receptacle)
                .chain(volume(reports, Side::Receptacle))
                .chain(exposed(reports, Side::Receptacle))
                .chain(slider)
                .chain(volume(reports, Side::Slider))
                .chain(exposed(reports, Side::Slider))
                .chain(contact)
                .chain(resistance)
                .chain(temperature)
                .chain(extent)
                .collect(),
            line: line(reports),
        }
    }
}

/// The sections along a line.
fn line(reports: &[CycleReport]) -> Vec<LineColumns> {
    let stations = reports
        .first()
        .map_or(&[][..], |report| &report.stations[..]);
    let column = |number: usize, of: &dyn Fn(&StationReport) -> f64| {
        let found = reports
            .iter()
            .map(|report| report.stations.get(number).map_or(0.0, of));
        found.collect()
    };
    let stations = stations.iter().enumerate();
    stations
        .map(|(number, station)| LineColumns {
            at: station.at,
            line_load_n_per_mm: column(number, &|station| station.line_load_n_per_mm),
            max_depth_mm: Sides::from_fn(|side| {
                column(number, &|station| *station.max_depth_mm.of(side))
            }),
        })
        .collect()
}

/// The worn volume of a side; none of a section.
fn volume(reports: &[CycleReport], side: Side) -> Option<Column> {
    let volumes = reports
        .iter()
        .map(|report| report.side(side).worn_volume_mm3);
    let is_known = volumes.clone().any(|volume| volume.is_some());
    is_known.then(|| Column {
        name: "worn_volume_mm3",
        unit: "mm3",
        side: Some(side),
        place_mm: None,
        layer: None,
        curve: "",
        values: volumes.map(Option::unwrap_or_default).collect(),
    })
}

/// One column a layer of a side below its outermost one.
fn exposed(reports: &[CycleReport], side: Side) -> impl Iterator<Item = Column> {
    let lengths = move |report: &CycleReport| report.exposed_length_mm.of(side).clone();
    let layers = reports.last().map_or(0, |report| lengths(report).len());
    (0..layers).map(move |index| Column {
        name: "exposed_length_mm",
        unit: "mm",
        side: Some(side),
        place_mm: None,
        layer: Some(if index + 1 == layers {
            Layer::BaseMetal
        } else {
            Layer::Plated(index + 2)
        }),
        curve: "",
        values: reports
            .iter()
            .map(|report| lengths(report).get(index).copied().unwrap_or_default())
            .collect(),
    })
}

/// One column a channel of a part of the reports; none where it is not computed.
fn computed<R: Channels>(
    reports: &[CycleReport],
    part: fn(&CycleReport) -> Option<&R>,
) -> impl Iterator<Item = Column> {
    let is_computed = reports.iter().any(|report| part(report).is_some());
    let channels = R::CHANNELS.iter().filter(move |_| is_computed);
    channels.map(move |channel| Column {
        name: channel.name,
        unit: channel.unit,
        side: None,
        place_mm: None,
        layer: None,
        curve: channel.curve,
        values: reports
            .iter()
            .map(|report| part(report).map_or(0.0, channel.value))
            .collect(),
    })
}

/// One column a channel of the part of each report that `part` selects.
fn columns<R: Channels>(
    reports: &[CycleReport],
    side: Option<Side>,
    part: fn(&CycleReport) -> &R,
) -> impl Iterator<Item = Column> {
    R::CHANNELS.iter().map(move |channel| Column {
        name: channel.name,
        unit: channel.unit,
        side,
        place_mm: None,
        layer: None,
        curve: channel.curve,
        values: reports
            .iter()
            .map(|report| (channel.value)(part(report)))
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::channel::declare_report;
    use crate::record::{ExtentReport, ResistanceReport, SideReport, TemperatureReport};

    declare_report! {
        /// A report with one channel more than any other.
        Probe from temperature: f64;
        fields {
            /// Where it was taken.
            place: usize = 3,
        }
        channels {
            /// Flash temperature, degrees Celsius.
            flash_temperature_c ["c"] = temperature,
        }
    }

    #[test]
    fn one_line_declares_a_field_its_value_and_its_channel() {
        let probe = Probe::of(85.0);
        let channel = &Probe::CHANNELS[0];
        assert_eq!(
            (channel.name, channel.unit, channel.curve),
            ("flash_temperature_c", "c", "")
        );
        assert_eq!(channel.description, "Flash temperature, degrees Celsius.");
        assert!(((channel.value)(&probe) - 85.0).abs() < 1e-15 && probe.place == 3);
    }

    fn names_end_with_units<R: Channels>() {
        for channel in R::CHANNELS {
            let (name, unit) = (channel.name, channel.unit);
            assert!(name.ends_with(&format!("_{unit}")), "{name}: {unit}");
        }
    }

    #[test]
    fn every_channel_has_its_unit_in_its_name() {
        names_end_with_units::<SideReport>();
        names_end_with_units::<CycleReport>();
        names_end_with_units::<ResistanceReport>();
        names_end_with_units::<TemperatureReport>();
        names_end_with_units::<ExtentReport>();
    }

    #[test]
    fn columns_are_named_after_side_quantity_place_and_unit() {
        let report = CycleReport {
            cycle: 7,
            station_depth_mm: vec![0.25],
            ..CycleReport::default()
        };
        let record = Record::new(&[report], &[-0.1]);
        let headers: Vec<String> = record.columns.iter().map(Column::header).collect();
        assert_eq!(headers[0], "receptacle_depth_at_-0.1_mm");
        assert_eq!(headers[1], "receptacle_max_depth_mm");
        assert_eq!(
            headers.last().map(String::as_str),
            Some("friction_coefficient")
        );
        assert_eq!(record.cycle, [7]);
        assert!(record.columns.iter().all(|column| column.values.len() == 1));
        assert!((record.columns[0].values[0] - 0.25).abs() < 1e-15);
    }
}
