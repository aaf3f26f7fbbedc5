//! Diagnostics of a resolution: faults, warnings, and the provenance of each value.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use api::problem::Fault;
use api::spec::{EnumValue, Provenance, StringEnum};
use serde::Serialize;
use serde_json::Value;

use crate::spec::sourced::Sourced;
use crate::spec::suggestion::did_you_mean;
use crate::spec::unit::Typical;

pub(crate) use crate::text::shortened;

/// Longest accepted name, characters.
pub(crate) const NAME_LIMIT: usize = 200;

/// Faults, warnings and provenance, by JSON pointer.
#[derive(Debug, Default)]
pub(crate) struct Diagnostics {
    faults: Vec<Fault>,
    warnings: Vec<Fault>,
    provenance: BTreeMap<String, Provenance>,
}

impl Diagnostics {
    /// Adds a fault, once: what holds for both sides is read for each.
    pub(crate) fn fault(&mut self, pointer: &str, detail: impl Into<String>) {
        let fault = Fault::new(pointer, detail);
        if !self.faults.contains(&fault) {
            self.faults.push(fault);
        }
    }

    /// Adds a fault for a required value that is missing.
    pub(crate) fn missing(&mut self, pointer: &str, detail: &str) {
        self.fault(pointer, format!("missing: {detail}"));
    }

    /// Records the provenance of a value.
    pub(crate) fn provenance(&mut self, pointer: impl Into<String>, provenance: Provenance) {
        self.provenance.insert(pointer.into(), provenance);
    }

    /// Returns the given value, or the default; records the provenance of either.
    pub(crate) fn or_default<T>(
        &mut self,
        pointer: &str,
        given: Option<T>,
        default: Sourced<T>,
    ) -> T {
        let (value, provenance) = match given {
            Some(value) => (value, Provenance::Given),
            None => (default.value, default.provenance),
        };
        self.provenance(pointer, provenance);
        value
    }

    /// Adds a fault if the value is outside the range (or no number); returns the value in any case.
    pub(crate) fn check_range(
        &mut self,
        pointer: &str,
        value: f64,
        range: &RangeInclusive<f64>,
    ) -> f64 {
        if !range.contains(&value) {
            let (from, to) = range.clone().into_inner();
            let value = formatted(value);
            let mut detail = format!("{value} is outside {from} to {to}");
            // A warning would not be seen beside a fault.
            if let Some(unit) = self.warnings.iter().find(|fault| fault.pointer == pointer) {
                detail = format!("{detail}; {}", unit.detail);
            }
            self.fault(pointer, detail);
        }
        value
    }

    /// Adds a warning if a given value was probably written in another unit than that of its field.
    pub(crate) fn check_unit(&mut self, pointer: &str, given: Option<f64>, typical: &Typical) {
        let likely = given.and_then(|value| typical.likely_unit(value));
        self.warnings
            .extend(likely.map(|detail| Fault::new(pointer, detail)));
    }

    /// All warnings.
    pub(crate) fn warnings(&self) -> &[Fault] {
        &self.warnings
    }

    /// Adds a fault if the value is neither 0 nor in the range; returns the value in any case.
    pub(crate) fn check_zero_or_range(
        &mut self,
        pointer: &str,
        value: f64,
        range: &RangeInclusive<f64>,
    ) -> f64 {
        if value != 0.0 && !range.contains(&value) {
            let (from, to) = range.clone().into_inner();
            let value = formatted(value);
            self.fault(
                pointer,
                format!("{value} is neither 0 nor in {from} to {to}"),
            );
        }
        value
    }

    /// A required value; adds a fault if it is missing or outside the range. The least of the range stands for a missing one.
    pub(crate) fn required(
        &mut self,
        pointer: &str,
        given: Option<f64>,
        range: &RangeInclusive<f64>,
        needs: &str,
    ) -> f64 {
        let Some(value) = self.optional(pointer, given, range) else {
            self.missing(pointer, needs);
            return *range.start();
        };
        value
    }

    /// A value without a default; adds a fault if it is outside the range.
    pub(crate) fn optional(
        &mut self,
        pointer: &str,
        given: Option<f64>,
        range: &RangeInclusive<f64>,
    ) -> Option<f64> {
        let value = given?;
        self.provenance(pointer, Provenance::Given);
        Some(self.check_range(pointer, value, range))
    }

    /// Adds a fault if a count is outside the range; returns the count in any case.
    pub(crate) fn check_count<T: Into<u64> + Copy>(
        &mut self,
        pointer: &str,
        count: T,
        range: &RangeInclusive<u64>,
    ) -> T {
        let number: u64 = count.into();
        if !range.contains(&number) {
            let (from, to) = range.clone().into_inner();
            self.fault(pointer, format!("{number} is outside {from} to {to}"));
        }
        count
    }

    /// Adds a fault if a text is too long, or has the character that databases cannot store in a text.
    pub(crate) fn check_text(&mut self, pointer: &str, text: &str, limit: usize) {
        let length = text.chars().count();
        if length > limit {
            let detail = format!("{length} characters, at most {limit} are allowed");
            self.fault(pointer, detail);
        } else if text.contains('\0') {
            self.fault(pointer, "the character U+0000 is not allowed");
        }
    }

    /// Adds a fault if a list is too long.
    pub(crate) fn check_length(&mut self, pointer: &str, length: usize, limit: usize) {
        if length > limit {
            let detail = format!("{length} entries, at most {limit} are allowed");
            self.fault(pointer, detail);
        }
    }

    /// Returns the member of an enum; adds a fault naming all members if the text is none.
    pub(crate) fn enum_member<T: StringEnum>(
        &mut self,
        pointer: &str,
        value: &EnumValue<T>,
    ) -> Option<T> {
        match value {
            EnumValue::Known(member) => Some(*member),
            EnumValue::Unknown(text) => {
                let members = T::NAMES.join(", ");
                let meant = did_you_mean(text, T::NAMES.iter().copied());
                let text = shortened(text);
                self.fault(pointer, format!("`{text}` is not one of {members}{meant}"));
                None
            }
        }
    }

    /// Adds a fault for each given field of an object that `owner`, the selected variant, does not have.
    pub(crate) fn check_fields<T: Serialize>(
        &mut self,
        base: &str,
        object: &T,
        fields: &[&str],
        owner: &str,
    ) {
        let Ok(Value::Object(given)) = serde_json::to_value(object) else {
            return;
        };
        for (field, value) in &given {
            if !value.is_null() && !fields.contains(&field.as_str()) {
                self.foreign_field(base, field, owner);
            }
        }
    }

    /// Adds a fault for a field that `owner`, the selected variant, does not have.
    pub(crate) fn foreign_field(&mut self, base: &str, field: &str, owner: &str) {
        let detail = format!("`{field}` does not belong to `{owner}`");
        self.fault(&format!("{base}/{field}"), detail);
    }

    /// Adds a fault for the second of two fields that exclude each other.
    pub(crate) fn exclusive_fields(&mut self, pointer: &str, other: &str) {
        self.fault(
            pointer,
            format!("cannot be combined with `{other}`; give one of them"),
        );
    }

    /// Takes over the diagnostics of a part that was resolved like a specification, whose fields of these pointers stand below
    /// another pointer here.
    pub(crate) fn adopt(&mut self, below: &str, pointers: &[&str], part: Self) {
        let here = |pointer: String| {
            let is_moved = pointers.iter().any(|moved| pointer.starts_with(moved));
            if is_moved {
                format!("{below}{pointer}")
            } else {
                pointer
            }
        };
        for fault in part.faults {
            self.fault(&here(fault.pointer), fault.detail);
        }
        let warnings = part.warnings.into_iter();
        self.warnings
            .extend(warnings.map(|warning| Fault::new(here(warning.pointer), warning.detail)));
        let provenance = part.provenance.into_iter();
        self.provenance
            .extend(provenance.map(|(pointer, provenance)| (here(pointer), provenance)));
    }

    /// Returns `true` if there is no fault so far.
    pub(crate) fn is_clean(&self) -> bool {
        self.faults.is_empty()
    }

    /// All faults, and the warnings: a value in another unit may be the cause of a fault elsewhere.
    pub(crate) fn into_faults(self) -> Vec<Fault> {
        let Self {
            mut faults,
            warnings,
            ..
        } = self;
        let is_new = |warning: &Fault| faults.iter().all(|fault| fault.pointer != warning.pointer);
        let warnings: Vec<_> = warnings.into_iter().filter(is_new).collect();
        faults.extend(warnings);
        faults
    }

    /// The provenance of all values, or all faults if there are any.
    pub(crate) fn finish(self) -> Result<BTreeMap<String, Provenance>, Vec<Fault>> {
        if self.faults.is_empty() {
            Ok(self.provenance)
        } else {
            Err(self.into_faults())
        }
    }
}

/// A number as a user would write it.
fn formatted(value: f64) -> String {
    let size = value.abs();
    if value.is_finite() && size > 0.0 && !(1e-5..1e15).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}
