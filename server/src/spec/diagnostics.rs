//! What is noted while a specification is resolved: faults, and where each value comes from.

use std::collections::BTreeMap;

use api::problem::Fault;
use api::spec::{Choice, Named, Provenance};

pub(crate) use crate::text::shortened;

/// Faults and provenance, by JSON pointer.
#[derive(Debug, Default)]
pub(crate) struct Diagnostics {
    faults: Vec<Fault>,
    provenance: BTreeMap<String, Provenance>,
}

/// A closed or half-open range of a quantity.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    /// Smallest accepted value.
    pub(crate) from: f64,
    /// Largest accepted value.
    pub(crate) to: f64,
}

impl Diagnostics {
    /// Notes a fault.
    pub(crate) fn fault(&mut self, pointer: &str, detail: impl Into<String>) {
        self.faults.push(Fault::new(pointer, detail));
    }

    /// Notes where a value comes from.
    pub(crate) fn note(&mut self, pointer: impl Into<String>, from: Provenance) {
        self.provenance.insert(pointer.into(), from);
    }

    /// The given value, or the default with its provenance.
    pub(crate) fn take<T>(
        &mut self,
        pointer: &str,
        given: Option<T>,
        default: T,
        from: Provenance,
    ) -> T {
        self.note(
            pointer,
            if given.is_some() {
                Provenance::Given
            } else {
                from
            },
        );
        given.unwrap_or(default)
    }

    /// Notes a fault if the value is not finite or outside the range; returns it all the same.
    pub(crate) fn check(&mut self, pointer: &str, value: f64, range: Range) -> f64 {
        if !(value.is_finite() && value >= range.from && value <= range.to) {
            self.fault(
                pointer,
                format!("{} is outside {} to {}", short(value), range.from, range.to),
            );
        }
        value
    }

    /// Like [`Self::check`], but 0 is accepted too.
    pub(crate) fn check_or_zero(&mut self, pointer: &str, value: f64, range: Range) -> f64 {
        if value == 0.0 {
            return value;
        }
        if !(range.from..=range.to).contains(&value) {
            let detail = format!(
                "{} is neither 0 nor in {} to {}",
                short(value),
                range.from,
                range.to
            );
            self.fault(pointer, detail);
        }
        value
    }

    /// Notes a fault if a text is too long.
    pub(crate) fn text(&mut self, pointer: &str, text: &str, limit: usize) {
        let length = text.chars().count();
        if length > limit {
            self.fault(
                pointer,
                format!("{length} characters, at most {limit} are kept"),
            );
        }
    }

    /// The member of a closed list; a fault naming the list if it is none.
    pub(crate) fn known<T: Named>(&mut self, pointer: &str, choice: &Choice<T>) -> Option<T> {
        match choice {
            Choice::Known(member) => Some(*member),
            Choice::Unknown(text) => {
                self.fault(
                    pointer,
                    format!("`{}` is none of {}", shortened(text), T::NAMES.join(", ")),
                );
                None
            }
        }
    }

    /// Notes a fault for each field that is given and does not belong here.
    pub(crate) fn misplaced(&mut self, base: &str, fields: &[(&str, bool)], owner: &str) {
        for (field, given) in fields {
            if *given {
                self.fault(
                    &format!("{base}/{field}"),
                    format!("`{field}` does not belong to `{owner}`"),
                );
            }
        }
    }

    /// Notes a fault for a required value that is missing.
    pub(crate) fn missing(&mut self, pointer: &str, detail: &str) {
        self.fault(pointer, format!("missing: {detail}"));
    }

    /// Whether there is no fault so far.
    pub(crate) fn is_clean(&self) -> bool {
        self.faults.is_empty()
    }

    /// Everything noted as faults.
    pub(crate) fn into_faults(self) -> Vec<Fault> {
        self.faults
    }

    /// The provenance, or the faults if there are any.
    pub(crate) fn finish(self) -> Result<BTreeMap<String, Provenance>, Vec<Fault>> {
        if self.faults.is_empty() {
            Ok(self.provenance)
        } else {
            Err(self.faults)
        }
    }
}

/// A number as a user would write it.
fn short(value: f64) -> String {
    let size = value.abs();
    if value.is_finite() && size > 0.0 && !(1e-5..1e15).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}
