//! Parses a [`Spec`]: all unknown fields at once, or the place of a parse error.

mod objects;
mod wording;

use serde::de::DeserializeOwned;
use serde_ignored::Path as IgnoredPath;
use serde_path_to_error::{Path as TrackedPath, Segment, Track};

use super::Spec;
use crate::problem::Fault;
use objects::Objects;

/// The bytes are no specification: malformed JSON, a number out of range, or a wrong type.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}{}: {detail}", at_pointer(.pointer))]
pub struct ParseError {
    /// JSON pointer of the value; empty for malformed JSON.
    pub pointer: String,
    /// Description.
    pub detail: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// Other faults of the document.
    pub others: Vec<Fault>,
}

impl Spec {
    /// Parses a specification and lists its unknown fields.
    ///
    /// # Errors
    /// [`ParseError`] for malformed JSON, a wrong type, a missing `system.kind`, or a field given twice.
    pub fn read(bytes: &[u8]) -> Result<(Self, Vec<Fault>), ParseError> {
        match no_object(bytes) {
            Some(error) => Err(error),
            None => read(bytes),
        }
    }
}

/// Parses a document and lists its unknown fields, as far as its type does not refuse them. An array of the fields of an object is not
/// taken for the object.
///
/// # Errors
/// [`ParseError`] for malformed JSON, a wrong type, a missing field, or a field given twice.
pub fn read<T: DeserializeOwned>(bytes: &[u8]) -> Result<(T, Vec<Fault>), ParseError> {
    let mut faults = Vec::new();
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let mut track = Track::new();
    let document = {
        let tracked = serde_path_to_error::Deserializer::new(&mut json, &mut track);
        let mut collect = |path: IgnoredPath<'_>| {
            let pointer = ignored_pointer(&path);
            let field = pointer.rsplit('/').next().unwrap_or_default().to_owned();
            faults.push(Fault::new(pointer, format!("unknown field `{field}`")));
        };
        let collected = serde_ignored::Deserializer::new(tracked, &mut collect);
        T::deserialize(Objects(collected))
    };
    let document =
        document.map_err(|error| ParseError::of(&error, &tracked_pointer(&track.path())))?;
    json.end().map_err(|error| ParseError::of(&error, ""))?;
    Ok((document, faults))
}

/// A key as a token of a JSON pointer (RFC 6901).
pub fn pointer_token(key: &str) -> String {
    key.replace('~', "~0").replace('/', "~1")
}

fn at_pointer(pointer: &str) -> String {
    if pointer.is_empty() {
        String::new()
    } else {
        format!(" ({pointer})")
    }
}

/// The error of a document that is no object.
fn no_object(bytes: &[u8]) -> Option<ParseError> {
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace());
    let start = start.unwrap_or(bytes.len());
    if bytes.get(start) == Some(&b'{') {
        return None;
    }
    let lines = || bytes[..start].split(|byte| *byte == b'\n');
    Some(ParseError {
        pointer: String::new(),
        detail: format!(
            r#"expected an object such as {{"system": {{"kind": "sd_card"}}}}, found {}"#,
            wording::of_document(&bytes[start..])
        ),
        line: lines().count(),
        column: 1 + lines().next_back().map_or(0, <[u8]>::len),
        others: Vec::new(),
    })
}

impl ParseError {
    /// The error of a document, with the pointer of the value.
    pub fn of(error: &serde_json::Error, pointer: &str) -> Self {
        let mut detail = error.to_string();
        if let Some(end) = detail.rfind(" at line ") {
            detail.truncate(end);
        }
        // In malformed JSON the path depends on the reading order only.
        let pointer = if error.is_data() { pointer } else { "" };
        Self {
            pointer: pointer.to_owned(),
            detail: wording::of_type_error(&detail),
            line: error.line(),
            column: error.column(),
            others: Vec::new(),
        }
    }
}

fn tracked_pointer(path: &TrackedPath) -> String {
    let mut pointer = String::new();
    for segment in path {
        let token = match segment {
            Segment::Seq { index } => index.to_string(),
            Segment::Map { key } => pointer_token(key),
            Segment::Enum { .. } | Segment::Unknown => continue,
        };
        pointer.push('/');
        pointer.push_str(&token);
    }
    pointer
}

fn ignored_pointer(path: &IgnoredPath<'_>) -> String {
    match path {
        IgnoredPath::Root => String::new(),
        IgnoredPath::Seq { parent, index } => format!("{}/{index}", ignored_pointer(parent)),
        IgnoredPath::Map { parent, key } => {
            format!("{}/{}", ignored_pointer(parent), pointer_token(key))
        }
        IgnoredPath::Some { parent }
        | IgnoredPath::NewtypeStruct { parent }
        | IgnoredPath::NewtypeVariant { parent } => ignored_pointer(parent),
    }
}

#[cfg(test)]
mod tests;
