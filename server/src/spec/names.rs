//! Name and labels of a job.

use api::spec::Spec;

use crate::spec::diagnostics::{Diagnostics, NAME_LIMIT};

/// Most labels of a job.
pub(crate) const LABEL_LIMIT: usize = 64;
/// Longest key or value of a label, characters.
pub(crate) const LABEL_TEXT_LIMIT: usize = 256;

/// Checks their lengths.
pub(super) fn check(spec: &Spec, diagnostics: &mut Diagnostics) {
    if let Some(name) = &spec.name {
        diagnostics.check_text("/name", name, NAME_LIMIT);
    }
    let labels = spec.labels.len();
    if labels > LABEL_LIMIT {
        let detail = format!("{labels} labels, at most {LABEL_LIMIT} are allowed");
        diagnostics.fault("/labels", detail);
        return;
    }
    for (key, value) in &spec.labels {
        let pointer = format!("/labels/{}", api::spec::pointer_token(key));
        if key.is_empty() {
            diagnostics.fault(&pointer, "the key of a label is empty");
        }
        diagnostics.check_text(&pointer, key, LABEL_TEXT_LIMIT);
        diagnostics.check_text(&pointer, value, LABEL_TEXT_LIMIT);
    }
}
