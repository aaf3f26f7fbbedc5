//! Picture of the life of a contact: the exposed part of each layer and the contact resistance over the cycles, with the limits of the
//! criteria and the band by the scatter of the wear coefficients.
//!
//! Worn depths depend on coefficient and cycles by their product, so that a contact whose coefficient is c times as large has the same
//! curve over 1/c of the cycles.

use api::spec::{CriterionKind, EnumValue, LifeSettings};
use solver::record::{Column, Layer, Record, Side};

use crate::export::pictures::{
    Axis, AxisRange, COLOURS, Colour, Mark, Panel, Picture, Scale, Series,
};
use crate::number::real;
use crate::spec::scatter::{FollowsProduct, Scatter};

/// Colour of limits.
const GREY: Colour = [90, 90, 90];

/// The picture of a run; `None` where nothing is exposed and no criterion is about the resistance.
pub(crate) fn picture(
    name: &str,
    settings: &LifeSettings,
    is_continuous: bool,
    follows: FollowsProduct,
    record: &Record,
) -> Option<Picture> {
    if record.cycle.len() < 2 {
        return None;
    }
    let done = if is_continuous {
        Done {
            title: "sliding distance (mm)",
            values: record.sliding_distance_mm.clone(),
        }
    } else {
        Done {
            title: "cycle",
            values: record.cycle.iter().map(|cycle| real(*cycle)).collect(),
        }
    };
    let scatter = |follows: bool| {
        let scatter = Scatter::of(settings);
        let (b10, b90) = (scatter.b10(), scatter.b90());
        (follows && b10 < b90).then_some([b10, b90])
    };
    let exposed = exposed(settings, &done, scatter(follows.depths), record);
    let limits = limits(settings, CriterionKind::Resistance);
    let is_drawn = exposed.is_some() || !limits.is_empty();
    let resistance = is_drawn.then(|| {
        let scatter = scatter(follows.resistance);
        resistance(&limits, &done, scatter, record)
    });
    let panels: Vec<Panel> = exposed
        .into_iter()
        .chain(resistance.into_iter().flatten())
        .collect();
    let title = if name.is_empty() {
        "Life".to_owned()
    } else {
        format!("Life: {name}")
    };
    (!panels.is_empty()).then_some(Picture { title, panels })
}

/// The horizontal axis.
struct Done {
    title: &'static str,
    values: Vec<f64>,
}

impl Done {
    fn axis(&self) -> Axis {
        Axis::new(self.title, Scale::Linear).with_range(AxisRange::DataAndZero)
    }

    fn last(&self) -> f64 {
        self.values.last().copied().unwrap_or_default()
    }

    /// A curve over what is done, and the same for the contacts at both ends of the band.
    fn curves(
        &self,
        label: String,
        colour: Colour,
        values: &[f64],
        scatter: Option<[f64; 2]>,
    ) -> Vec<Series> {
        let over = |factor: f64| -> Vec<[f64; 2]> {
            let points = self.values.iter().zip(values);
            let points = points.map(|(done, value)| [factor * done, *value]);
            points.filter(|point| point[0] <= self.last()).collect()
        };
        let band = scatter.into_iter().flatten().map(|factor| Series {
            label: "b10, b90".to_owned(),
            mark: Mark::Dashes,
            colour,
            points: over(factor),
        });
        let median = Series {
            label,
            mark: Mark::Line,
            colour,
            points: over(1.0),
        };
        band.chain([median]).collect()
    }

    fn limit(&self, limit: f64) -> Series {
        Series {
            label: "limit".to_owned(),
            mark: Mark::Dashes,
            colour: GREY,
            points: vec![[0.0, limit], [self.last(), limit]],
        }
    }
}

/// Values of the criteria of a kind.
fn limits(settings: &LifeSettings, kind: CriterionKind) -> Vec<f64> {
    let criteria = settings.criteria.iter().flatten();
    let of_kind = criteria.filter(|criterion| criterion.kind == EnumValue::Known(kind));
    of_kind
        .filter_map(|criterion| criterion.fraction.or(criterion.mohm))
        .collect()
}

/// Exposed part of the scar for each layer of each side that is exposed.
fn exposed(
    settings: &LifeSettings,
    done: &Done,
    scatter: Option<[f64; 2]>,
    record: &Record,
) -> Option<Panel> {
    let layers = record.columns.iter().filter_map(|column| {
        let (side, layer) = (column.side?, column.layer?);
        let is_exposed = column.values.iter().any(|length| *length > 0.0);
        is_exposed.then(|| {
            (
                format!("{}, {}", side.name(), named(layer)),
                parts(record, side, column),
            )
        })
    });
    let curves = layers.zip(COLOURS.into_iter().cycle());
    let mut series: Vec<Series> = curves
        .flat_map(|((label, parts), colour)| done.curves(label, colour, &parts, scatter))
        .collect();
    if series.is_empty() {
        return None;
    }
    let limits = limits(settings, CriterionKind::ExposedFraction);
    series.extend(limits.into_iter().map(|limit| done.limit(limit)));
    Some(Panel {
        x: done.axis(),
        y: Axis::new("exposed part of the scar (-)", Scale::Linear)
            .with_range(AxisRange::Fixed(0.0, 1.0)),
        series,
    })
}

fn named(layer: Layer) -> String {
    match layer {
        Layer::Plated(number) => format!("layer {number}"),
        Layer::BaseMetal => "base metal".to_owned(),
    }
}

/// Exposed lengths over the width of the scar.
fn parts(record: &Record, side: Side, lengths: &Column) -> Vec<f64> {
    let mut columns = record.columns.iter();
    let half_widths =
        columns.find(|column| column.side == Some(side) && column.name == "scar_half_width_mm");
    let half_widths = half_widths.map_or(&[][..], |column| &column.values);
    let parts = lengths.values.iter().zip(half_widths);
    parts
        .map(|(length, half)| {
            if *length > 0.0 {
                (0.5 * length / half).min(1.0)
            } else {
                0.0
            }
        })
        .collect()
}

/// The resistance of the contact, if it is computed.
fn resistance(
    limits: &[f64],
    done: &Done,
    scatter: Option<[f64; 2]>,
    record: &Record,
) -> Option<Panel> {
    let mut columns = record.columns.iter();
    let values = columns.find(|column| column.name == "contact_resistance_mohm")?;
    let label = "contact resistance".to_owned();
    let mut series = done.curves(label, COLOURS[0], &values.values, scatter);
    series.extend(limits.iter().map(|limit| done.limit(*limit)));
    Some(Panel {
        x: done.axis(),
        y: Axis::new("contact resistance (mOhm)", Scale::Linear).with_range(AxisRange::DataAndZero),
        series,
    })
}

#[cfg(test)]
mod tests {
    use solver::record::{CycleReport, ResistanceReport, SideReport};
    use solver::sides::Sides;

    const ALL: FollowsProduct = FollowsProduct {
        depths: true,
        resistance: true,
    };

    use super::*;

    use crate::export::pictures::svg;

    /// A tip with a layer, of which half is through after 20 cycles.
    fn history() -> Record {
        let rows = [(0, 0.0, 1.0), (10, 0.0, 1.0), (20, 0.1, 3.0)];
        let reports = rows.map(|(cycle, length, mohm)| CycleReport {
            cycle,
            slider: SideReport {
                scar_half_width_mm: 0.1,
                ..SideReport::default()
            },
            exposed_length_mm: Sides {
                slider: vec![length],
                receptacle: Vec::new(),
            },
            resistance: Some(ResistanceReport {
                contact_resistance_mohm: mohm,
                ..ResistanceReport::default()
            }),
            ..CycleReport::default()
        });
        Record::new(&reports, &[])
    }

    fn settings(criteria: &str) -> LifeSettings {
        let text = format!(r#"{{"coefficient_of_variation":0.5,"criteria":[{criteria}]}}"#);
        serde_json::from_str(&text).expect("settings")
    }

    const LIMITS: &str =
        r#"{"kind":"resistance","mohm":2.5},{"kind":"exposed_fraction","fraction":0.5}"#;

    #[test]
    fn a_life_has_its_exposed_part_and_its_resistance_with_band_and_limits() {
        let given = settings(LIMITS);
        let picture = picture("a tip", &given, false, ALL, &history()).expect("a picture");
        let [exposed, resistance] = &picture.panels[..] else {
            panic!("two panels");
        };
        let labels = |panel: &Panel| -> Vec<String> {
            let series = panel.series.iter();
            series.map(|series| series.label.clone()).collect()
        };
        assert_eq!(
            labels(exposed),
            ["b10, b90", "b10, b90", "slider, base metal", "limit"]
        );
        assert_eq!(
            labels(resistance),
            ["b10, b90", "b10, b90", "contact resistance", "limit"]
        );
        assert_eq!(
            exposed.series[2].points,
            [[0.0, 0.0], [10.0, 0.0], [20.0, 0.5]]
        );
        // The worst tenth reaches the same part 0.546 times as late, the best one not within the run.
        let b10 = exposed.series[0].points[2];
        assert!(
            (b10[0] - 10.917).abs() < 1e-3 && (b10[1] - 0.5).abs() < 1e-15,
            "{b10:?}"
        );
        assert_eq!(exposed.series[1].points.len(), 2);
        assert_eq!(resistance.series[3].points, [[0.0, 2.5], [20.0, 2.5]]);
        let drawing = svg(&picture).expect("it can be drawn");
        assert!(drawing.contains("contact resistance (mOhm)") && drawing.contains("limit"));
    }

    #[test]
    fn a_film_that_grows_or_certain_coefficients_have_no_band() {
        let given = settings(LIMITS);
        let grows = FollowsProduct {
            resistance: false,
            ..ALL
        };
        let grows = picture("", &given, false, grows, &history()).expect("a picture");
        assert_eq!(
            (grows.panels[0].series.len(), grows.panels[1].series.len()),
            (4, 2)
        );
        let certain = LifeSettings {
            coefficient_of_variation: Some(0.0),
            ..given
        };
        let drawn = picture("", &certain, false, ALL, &history()).expect("a picture");
        assert_eq!(drawn.panels[0].series.len(), 2);
    }

    #[test]
    fn a_run_without_exposure_or_criterion_has_no_picture_of_its_life() {
        let reports = [0, 10].map(|cycle| CycleReport {
            cycle,
            resistance: Some(ResistanceReport::default()),
            ..CycleReport::default()
        });
        let record = Record::new(&reports, &[]);
        assert_eq!(picture("", &settings(""), false, ALL, &record), None);
        let limited = picture("", &settings(LIMITS), true, ALL, &record);
        assert_eq!(limited.map(|drawn| drawn.panels.len()), Some(1));
        assert_eq!(
            picture("", &settings(LIMITS), false, ALL, &Record::default()),
            None
        );
    }
}
