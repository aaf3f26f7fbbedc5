//! The limits of a specification as JSON Schema keywords, from the constants that its resolution checks.

use std::ops::RangeInclusive;

use api::spec::MaterialProperties;
use serde_json::{Value, json};
use solver::scene::MOST_LAYERS;

use crate::reference::materials::LibraryMaterial;
use crate::spec::diagnostics::NAME_LIMIT;
use crate::spec::law::friction_table::COEFFICIENT_RANGE;
use crate::spec::law::{self, friction_table};
use crate::spec::motion::{fourier, insertion, thermal_cycle, vibration};
use crate::spec::{
    LABEL_LIMIT, LABEL_TEXT_LIMIT, accuracy, criterion, effects, environment, films, life, load,
    materials, mission, motion, output, plating, spots, stop, system,
};

/// Keywords of the schema of a field.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Keywords {
    /// Name of the object's schema.
    pub(crate) object: &'static str,
    /// The field.
    pub(crate) field: &'static str,
    /// The keywords and their values.
    pub(crate) values: Value,
}

/// The keywords of every field whose values have limits. Limits that depend on other fields are not among them.
pub(crate) fn keywords() -> Vec<Keywords> {
    let numbers = numbers().into_iter();
    let numbers = numbers.map(|(object, field, range)| (object, field, within(&range)));
    let others = others().into_iter();
    let dimensions = system::dimension_names().into_iter();
    let dimensions = dimensions.map(|field| ("System", field, within(&system::LENGTH_MM)));
    numbers
        .chain(others)
        .chain(dimensions)
        .map(|(object, field, values)| Keywords {
            object,
            field,
            values,
        })
        .collect()
}

/// Fields whose values are in a range.
fn numbers() -> Vec<(&'static str, &'static str, RangeInclusive<f64>)> {
    let materials = materials::numbers(&MaterialProperties::default()).into_iter();
    let materials =
        materials.map(|(field, _)| ("MaterialProperties", field, materials::range(field)));
    let others = [
        ("Model", "radius_z_mm", system::LENGTH_MM),
        ("Load", "mpa", load::PRESSURE_MPA),
        ("Load", "n_per_mm", load::LINE_FORCE_N_PER_MM),
        ("Load", "n", load::FORCE_N),
        ("Load", "width_mm", load::WIDTH_MM),
        ("Load", "spring_n_per_mm", load::SPRING_N_PER_MM),
        ("Motion", "period_s", motion::PERIOD_S),
        ("Motion", "frequency_hz", motion::FREQUENCY_HZ),
        ("Motion", "distance_mm", motion::DISTANCE_MM),
        ("Motion", "speed_mm_s", motion::SPEED_MM_S),
        ("Motion", "acceleration_g", vibration::ACCELERATION_G),
        ("Motion", "duration_s", vibration::DURATION_S),
        ("Motion", "mass_g", vibration::MASS_G),
        (
            "Motion",
            "tangential_stiffness_n_per_mm",
            vibration::STIFFNESS_N_PER_MM,
        ),
        ("Motion", "natural_frequency_hz", motion::FREQUENCY_HZ),
        ("Motion", "quality_factor", vibration::QUALITY),
        ("Motion", "clearance_mm", vibration::CLEARANCE_MM),
        ("Motion", "delta_t_k", thermal_cycle::DELTA_T_K),
        ("Motion", "length_mm", thermal_cycle::LENGTH_MM),
        (
            "Motion",
            "expansion_mismatch_per_k",
            thermal_cycle::MISMATCH_PER_K,
        ),
        ("Motion", "wipe_mm", insertion::WIPE_MM),
        ("PsdPoint", "frequency_hz", motion::FREQUENCY_HZ),
        ("PsdPoint", "g2_per_hz", vibration::G2_PER_HZ),
        ("Environment", "temperature_c", environment::TEMPERATURE_C),
        ("Environment", "current_a", environment::CURRENT_A),
        ("Environment", "frequency_hz", environment::FREQUENCY_HZ),
        ("Friction", "coefficient", COEFFICIENT_RANGE),
        ("FrictionAtCycle", "coefficient", COEFFICIENT_RANGE),
        ("FrictionAtDose", "coefficient", COEFFICIENT_RANGE),
        ("FrictionAtDose", "dose_mpa_mm", friction_table::DOSE_MPA_MM),
        ("Spots", "cluster_diameter_mm", spots::CLUSTER_DIAMETER_MM),
        ("Spots", "asperity_radius_mm", spots::ASPERITY_RADIUS_MM),
        (
            "Film",
            "specific_resistance_ohm_mm2",
            films::SPECIFIC_RESISTANCE_OHM_MM2,
        ),
        ("Film", "growth_exponent", films::GROWTH_EXPONENT),
        ("Film", "growth_time_h", films::GROWTH_TIME_H),
        ("PlatingLayer", "thickness_um", plating::THICKNESS_UM),
        ("PlatingLayer", "thickness_mm", plating::THICKNESS_MM),
        ("PlatingLayer", "friction_coefficient", COEFFICIENT_RANGE),
        ("LifeSettings", "coefficient_of_variation", life::VARIATION),
        ("Criterion", "fraction", criterion::FRACTION),
        ("Criterion", "mm", criterion::WORN_DEPTH_MM),
        ("Criterion", "mohm", criterion::RESISTANCE_MOHM),
        ("Stop", "fraction", criterion::FRACTION),
        ("Stop", "mm", criterion::WORN_DEPTH_MM),
        ("Accuracy", "tolerance", accuracy::TOLERANCE),
        ("Stop", "worn_depth_mm", criterion::WORN_DEPTH_MM),
    ];
    let laws = law::numbers().into_iter();
    let laws = laws.map(|(field, range)| ("WearLaw", field, range));
    materials.chain(others).chain(laws).collect()
}

fn others() -> Vec<(&'static str, &'static str, Value)> {
    let amplitude = within(&motion::AMPLITUDE_MM);
    let (cycles, increments) = (counts(&motion::CYCLES), counts(&accuracy::INCREMENTS));
    let mut jump = counts(&motion::CYCLES);
    jump["type"] = json!("integer");
    let points = json!({"minItems": 2, "maxItems": friction_table::MOST_POINTS});
    let text = json!({"minLength": 1, "maxLength": LABEL_TEXT_LIMIT});
    let labels = json!({
        "maxProperties": LABEL_LIMIT,
        "propertyNames": text,
        "additionalProperties": {"type": "string", "maxLength": LABEL_TEXT_LIMIT}
    });
    let name = json!({"maxLength": NAME_LIMIT});
    vec![
        ("Spec", "name", name.clone()),
        ("Spec", "labels", labels),
        ("Spec", "cycles", cycles.clone()),
        ("MissionBlock", "cycles", cycles.clone()),
        ("MissionBlock", "name", name.clone()),
        ("Spec", "mission", entries(mission::BLOCK_LIMIT)),
        ("Spec", "repeat", counts(&mission::REPEAT)),
        ("Spec", "stop", entries(stop::STOP_LIMIT)),
        ("LifeSettings", "contacts", counts(&life::CONTACTS)),
        ("LifeSettings", "target_cycles", cycles),
        (
            "LifeSettings",
            "reliability",
            shares(&life::RELIABILITY, life::MOST_SHARES),
        ),
        ("Spots", "count", counts(&spots::COUNT)),
        ("Interface", "films", entries(films::FILM_LIMIT)),
        ("Motion", "contacts", counts(&vibration::CONTACTS)),
        ("Motion", "terms", entries(fourier::TERM_LIMIT)),
        ("FourierTerm", "order", counts(&fourier::ORDER)),
        ("FrictionAtCycle", "cycle", counts(&friction_table::CYCLE)),
        ("Friction", "by_cycle", points.clone()),
        ("Friction", "by_dose", points),
        (
            "Motion",
            "psd",
            json!({"minItems": 2, "maxItems": vibration::MOST_POINTS}),
        ),
        ("LifeSettings", "criteria", entries(life::CRITERION_LIMIT)),
        ("Platings", "slider", entries(MOST_LAYERS)),
        ("Platings", "receptacle", entries(MOST_LAYERS)),
        (
            "Spec",
            "effects",
            json!({"propertyNames": {"enum": effects::names()}}),
        ),
        (
            "Motion",
            "amplitude_mm",
            json!({"anyOf": [{"const": 0}, amplitude]}),
        ),
        ("Overrides", "increments_per_cycle", increments),
        (
            "Overrides",
            "cycle_jump",
            json!({"oneOf": [{"const": "adaptive"}, jump, {"type": "null"}]}),
        ),
        (
            "Overrides",
            "contact_element_mm",
            json!({"exclusiveMinimum": 0}),
        ),
        ("Output", "stations_mm", entries(output::STATION_LIMIT)),
        (
            "Output",
            "snapshots_at_cycles",
            entries(output::SNAPSHOT_LIMIT),
        ),
        (
            "Output",
            "snapshots_at_distance_mm",
            json!({"maxItems": output::SNAPSHOT_LIMIT, "items": {"type": "number", "format": "double", "minimum": 0}}),
        ),
        ("MaterialProperties", "name", name),
    ]
}

/// Names of the materials that a specification can name.
pub(crate) fn material_names() -> Vec<&'static str> {
    LibraryMaterial::names()
}

fn within(range: &RangeInclusive<f64>) -> Value {
    json!({"minimum": range.start(), "maximum": range.end()})
}

/// A list of so many entries at most.
fn entries(most: usize) -> Value {
    json!({"maxItems": most})
}

/// A list of so many shares at most.
fn shares(range: &RangeInclusive<f64>, most: usize) -> Value {
    let mut share = within(range);
    share["type"] = json!("number");
    share["format"] = json!("double");
    json!({"maxItems": most, "items": share})
}

fn counts(range: &RangeInclusive<u64>) -> Value {
    json!({"minimum": range.start(), "maximum": range.end()})
}

#[cfg(test)]
mod tests;
