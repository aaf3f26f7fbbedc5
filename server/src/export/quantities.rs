//! The quantities of a whole summary as columns: common to the table of a sweep and the list of the interface.

use api::results::{
    AccuracyReached, ContactExtent, Cost, Quantities, Quantity, QuantityDescription, SideSummary,
    Summary,
};

use crate::number::real;

/// Extent of the run; the first columns.
const PROGRESS: &[Quantity<Summary>] = &[
    Quantity {
        name: "cycles_done",
        title: "cycles done",
        unit: "",
        factor: 1.0,
        value: |summary| Some(real(summary.cycles_done)),
    },
    Quantity {
        name: "sliding_distance_mm",
        title: "sliding distance",
        unit: "m",
        factor: 1e-3,
        value: |summary| Some(summary.sliding_distance_mm),
    },
];
/// Cycles after which the first criterion of life was reached; the last column.
const FIRST_LIFE: &[Quantity<Summary>] = &[Quantity {
    name: "first_life_cycles",
    title: "first life",
    unit: "cycles",
    factor: 1.0,
    value: |summary| {
        let reached = summary.life.iter().filter_map(|life| life.cycles);
        reached.min_by(f64::total_cmp)
    },
}];

/// A quantity with its value in a summary.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    place: Place,
    name: &'static str,
    title: &'static str,
    unit: &'static str,
    factor: f64,
    /// Value in a summary that has one.
    pub value: Option<f64>,
}

/// Where a quantity stands in a summary.
#[derive(Debug, Clone, Copy)]
enum Place {
    Top,
    Side(&'static str),
    Object(&'static str),
    /// Not in the document: it follows from several fields.
    Derived,
}

/// The columns in order; without a summary they have no values.
pub fn columns(summary: Option<&Summary>) -> Vec<Column> {
    let side = |name, of: fn(&Summary) -> &SideSummary| {
        part(Place::Side(name), SideSummary::QUANTITIES, summary.map(of))
    };
    let extent = summary.and_then(|summary| summary.extent.as_ref());
    let accuracy = summary.map(|summary| &summary.accuracy);
    let cost = summary.map(|summary| &summary.cost);
    part(Place::Top, PROGRESS, summary)
        .chain(side("receptacle", |summary| &summary.receptacle))
        .chain(side("slider", |summary| &summary.slider))
        .chain(part(Place::Top, Summary::QUANTITIES, summary))
        .chain(part(
            Place::Object("extent"),
            ContactExtent::QUANTITIES,
            extent,
        ))
        .chain(part(
            Place::Object("accuracy"),
            AccuracyReached::QUANTITIES,
            accuracy,
        ))
        .chain(part(Place::Object("cost"), Cost::QUANTITIES, cost))
        .chain(part(Place::Derived, FIRST_LIFE, summary))
        .collect()
}

fn part<P>(
    place: Place,
    quantities: &'static [Quantity<P>],
    part: Option<&P>,
) -> impl Iterator<Item = Column> {
    quantities.iter().map(move |quantity| Column {
        place,
        name: quantity.name,
        title: quantity.title,
        unit: quantity.unit,
        factor: quantity.factor,
        value: part.and_then(quantity.value),
    })
}

impl Column {
    /// Name in tables.
    pub fn header(&self) -> String {
        match self.place {
            Place::Side(side) => format!("{side}_{}", self.name),
            Place::Top | Place::Object(_) | Place::Derived => self.name.to_owned(),
        }
    }

    /// The document of the quantity.
    pub fn description(&self) -> QuantityDescription {
        let Self { place, name, .. } = self;
        QuantityDescription {
            column: self.header(),
            pointer: match place {
                Place::Top => Some(format!("/{name}")),
                Place::Side(part) | Place::Object(part) => Some(format!("/{part}/{name}")),
                Place::Derived => None,
            },
            title: self.title.to_owned(),
            side: match place {
                Place::Side(side) => Some((*side).to_owned()),
                Place::Top | Place::Object(_) | Place::Derived => None,
            },
            unit: self.unit.to_owned(),
            factor: self.factor,
        }
    }
}
