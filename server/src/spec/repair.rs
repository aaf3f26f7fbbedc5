//! The other faults of a document with a value of a wrong type: such a value is left out, and the rest is read and resolved.

use api::problem::Fault;
use api::spec::{ParseError, Spec, pointer_token};
use serde_json::Value;

use crate::spec::suggestion;

/// Largest number of values of wrong types that are reported: each costs another reading of the document.
const MOST: usize = 16;
/// Largest document that is read again, bytes; specifications have a few thousand.
const LARGEST: usize = 256 << 10;

/// Adds the other faults of a document to its first error. `resolve` returns those of a specification.
pub(super) fn with_others(
    mut error: ParseError,
    bytes: &[u8],
    resolve: impl Fn(&Spec) -> Vec<Fault>,
) -> ParseError {
    if bytes.len() > LARGEST {
        return error;
    }
    let Ok(mut document) = serde_json::from_slice::<Value>(bytes) else {
        return error;
    };
    let mut left_out = vec![error.pointer.clone()];
    while left_out.len() <= MOST
        && left_out
            .last()
            .is_some_and(|last| remove(&mut document, last))
    {
        // A document that was read can be serialized.
        let rest = serde_json::to_vec(&document).unwrap_or_default();
        match Spec::read(&rest) {
            Err(next) => {
                // An object that lacks a field because that was left out is no fault of its own.
                if !left_out.iter().any(|at| at.starts_with(&next.pointer)) {
                    error.others.push(Fault::new(&next.pointer, next.detail));
                }
                left_out.push(next.pointer);
            }
            Ok((spec, mut unknown)) => {
                suggestion::suggest_fields(&mut unknown);
                error.others.extend(unknown);
                // Faults of a value that was left out follow from its removal.
                let is_own =
                    |fault: &Fault| !left_out.iter().any(|at| fault.pointer.starts_with(at));
                error
                    .others
                    .extend(resolve(&spec).into_iter().filter(is_own));
                break;
            }
        }
    }
    error
}

/// Removes the value at a pointer, or the list that it is an entry of; whether there was one.
pub(super) fn remove(document: &mut Value, pointer: &str) -> bool {
    let Some((parent, token)) = pointer.rsplit_once('/') else {
        return false;
    };
    match document.pointer_mut(parent) {
        Some(Value::Object(object)) => {
            let key = object
                .keys()
                .find(|key| pointer_token(key) == token)
                .cloned();
            key.is_some_and(|key| object.remove(&key).is_some())
        }
        Some(Value::Array(_)) => remove(document, parent),
        _ => false,
    }
}
