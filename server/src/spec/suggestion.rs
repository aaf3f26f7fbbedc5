//! Suggestions for mistyped names.

use std::collections::BTreeMap;

use api::problem::Fault;
use api::spec::Spec;
use strsim::normalized_damerau_levenshtein;
use utoipa::openapi::schema::{AdditionalProperties, ArrayItems, Schema};
use utoipa::openapi::{Ref, RefOr};
use utoipa::{PartialSchema, ToSchema};

/// Smallest similarity of a name that is suggested, from 0 to 1. `amplitude_um` and `amplitude_mm` have 0.92, `cycels` and
/// `cycles` 0.83, `radius` and `length` 0.17.
const SIMILAR: f64 = 0.6;

/// Longest name that is compared, bytes.
const LONGEST: usize = 64;
/// Number of unknown fields that get a suggestion.
const MOST: usize = 64;

/// Returns the most similar of some names, if one is similar.
pub(crate) fn closest<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // No name is nearly as long; comparing takes the product of the lengths.
    if name.len() > LONGEST {
        return None;
    }
    let rated = names
        .into_iter()
        .map(|known| (normalized_damerau_levenshtein(name, known), known));
    let similar = rated.filter(|(similarity, _)| *similarity >= SIMILAR);
    // Of equals the first.
    let best = similar.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, known)| known)
}

/// `; did you mean ..?` for the most similar of some names, or nothing.
pub(crate) fn did_you_mean<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    closest(name, names).map_or_else(String::new, |known| format!("; did you mean `{known}`?"))
}

/// Adds suggestions to the faults of unknown fields.
pub(super) fn suggest_fields(faults: &mut [Fault]) {
    if faults.is_empty() {
        return;
    }
    let schemas = Schemas::new();
    let places = schemas.places();
    for fault in faults.iter_mut().take(MOST) {
        let (parent, name) = fault.pointer.rsplit_once('/').unwrap_or_default();
        let parent = without_indices(parent);
        let siblings = places.iter().filter(|(place, _)| *place == parent);
        let siblings = siblings.map(|(_, field)| field.as_str());
        // Of several places the one of the fewest levels.
        let elsewhere = places.iter().filter(|(_, field)| field == name);
        let elsewhere = elsewhere.min_by_key(|(place, _)| place.matches('/').count());
        let suggestion = match (closest(name, siblings), elsewhere) {
            (Some(sibling), _) => format!("; did you mean `{sibling}`?"),
            (None, Some((place, field))) => format!("; did you mean `{place}/{field}`?"),
            (None, None) => continue,
        };
        fault.detail.push_str(&suggestion);
    }
}

/// A pointer with `-` for each index of an array, like the places below.
fn without_indices(pointer: &str) -> String {
    let tokens = pointer.split('/');
    let is_index = |token: &str| !token.is_empty() && token.bytes().all(|b| b.is_ascii_digit());
    let tokens: Vec<_> = tokens
        .map(|token| if is_index(token) { "-" } else { token })
        .collect();
    tokens.join("/")
}

/// The schemas of a specification, by name.
struct Schemas(BTreeMap<String, RefOr<Schema>>);

impl Schemas {
    fn new() -> Self {
        let mut schemas = Vec::new();
        Spec::schemas(&mut schemas);
        Self(schemas.into_iter().collect())
    }

    /// The pointer of every object, and each of its fields.
    fn places(&self) -> Vec<(String, String)> {
        let mut places = Vec::new();
        self.visit(&Spec::schema(), "", &mut places);
        places
    }

    fn visit(&self, schema: &RefOr<Schema>, pointer: &str, places: &mut Vec<(String, String)>) {
        let schema = match schema {
            RefOr::Ref(Ref { ref_location, .. }) => {
                let name = ref_location.rsplit('/').next().unwrap_or_default();
                if let Some(schema) = self.0.get(name) {
                    self.visit(schema, pointer, places);
                }
                return;
            }
            RefOr::T(schema) => schema,
        };
        match schema {
            Schema::Object(object) => {
                for (field, value) in &object.properties {
                    places.push((pointer.to_owned(), field.clone()));
                    self.visit(value, &format!("{pointer}/{field}"), places);
                }
                if let Some(AdditionalProperties::RefOr(values)) =
                    object.additional_properties.as_deref()
                {
                    self.visit(values, &format!("{pointer}/-"), places);
                }
            }
            Schema::Array(array) => {
                if let ArrayItems::RefOrSchema(items) = &array.items {
                    self.visit(items, &format!("{pointer}/-"), places);
                }
            }
            Schema::OneOf(of) => of.items.iter().for_each(|s| self.visit(s, pointer, places)),
            Schema::AllOf(of) => of.items.iter().for_each(|s| self.visit(s, pointer, places)),
            Schema::AnyOf(of) => of.items.iter().for_each(|s| self.visit(s, pointer, places)),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn similar_names_are_suggested_and_others_are_not() {
        let names = ["cycles", "motion", "materials", "load"];
        assert_eq!(closest("cycels", names), Some("cycles"));
        assert_eq!(closest("Motion", names), Some("motion"));
        assert_eq!(closest("material", names), Some("materials"));
        assert_eq!(closest("frobnicate", names), None);
        assert_eq!(did_you_mean("laod", names), "; did you mean `load`?");
    }

    #[test]
    fn unknown_fields_are_compared_with_those_of_their_object_and_then_of_all() {
        for (pointer, suggested) in [
            ("/cycels", "`cycles`"),
            ("/motion/amplitude_um", "`amplitude_mm`"),
            ("/system/wire_diameter", "`wire_diameter_mm`"),
            ("/interface/wear/slider/hardness", "`hardness_mpa`"),
            (
                "/materials/slider/youngs_modulus_gpa",
                "`youngs_modulus_mpa`",
            ),
            ("/stop/3/worn_depth", "`worn_depth_mm`"),
            ("/amplitude_mm", "`/motion/amplitude_mm`"),
            (
                "/accuracy/contact_element_mm",
                "`/accuracy/overrides/contact_element_mm`",
            ),
        ] {
            let mut faults = [Fault::new(pointer, "unknown")];
            suggest_fields(&mut faults);
            let expected = format!("unknown; did you mean {suggested}?");
            assert_eq!(faults[0].detail, expected, "{pointer}");
        }
        let mut faults = [Fault::new("/frobnicate", "unknown")];
        suggest_fields(&mut faults);
        assert_eq!(faults[0].detail, "unknown");
    }
}
