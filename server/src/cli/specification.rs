//! The specification that a command reads: from a file, or with `-` from standard input. JSON with comments and trailing commas is
//! accepted.

use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use api::problem::Fault;

use crate::cli::destination;
use crate::cli::terminal::{refused, unusable, write_err};
use crate::spec;
use crate::spec::Resolved;

/// Name of standard input in arguments.
const STDIN: &str = "-";

/// A document as JSON, every value where it was written, and its name in messages.
pub(super) struct Document {
    pub(super) name: String,
    pub(super) json: Vec<u8>,
}

/// Reads a document; reports a failure and returns its exit code.
pub(super) fn read(path: &Path) -> Result<Document, ExitCode> {
    let name = name(path);
    let bytes = if path == Path::new(STDIN) {
        let mut bytes = Vec::new();
        let read = std::io::stdin().lock().read_to_end(&mut bytes);
        read.map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    match bytes {
        Ok(bytes) => Ok(Document {
            name,
            json: without_comments(bytes),
        }),
        Err(cause) => Err(unusable(format_args!("{name}: {cause}"))),
    }
}

/// The name of a document in messages.
pub(super) fn name(path: &Path) -> String {
    if path == Path::new(STDIN) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

/// Reads and resolves a specification; reports a failure and returns its exit code.
pub(super) fn resolved(path: &Path) -> Result<Resolved, ExitCode> {
    let document = read(path)?;
    let resolved = spec::read(&document.json).map_err(|error| refused(&document.name, &error))?;
    for Fault { pointer, detail } in &resolved.warnings {
        write_err(format_args!("fretwear: warning: {pointer}: {detail}"));
    }
    Ok(resolved)
}

/// The same, with a folder for the results.
pub(super) fn resolved_for(path: &Path, out: Option<&Path>) -> Result<Resolved, ExitCode> {
    let resolved = resolved(path)?;
    out.map_or(Ok(()), destination::folder)?;
    Ok(resolved)
}

/// Replaces comments and trailing commas by spaces. Other bytes stay where they are, so that errors name their positions; JSON without
/// comments stays as it is.
fn without_comments(bytes: Vec<u8>) -> Vec<u8> {
    let mut json = bytes.clone();
    // A comment that is malformed is an error of the document, which its parser reports.
    if json_strip_comments::strip_slice(&mut json).is_err() {
        return bytes;
    }
    for (stripped, original) in json.iter_mut().zip(&bytes) {
        if *original == b'\n' {
            *stripped = b'\n';
        }
    }
    json
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stripped(text: &str) -> String {
        String::from_utf8(without_comments(text.into())).expect("text")
    }

    #[test]
    fn comments_and_trailing_commas_become_spaces() {
        for (text, json) in [
            ("{} // the end", "{}           "),
            (
                "# a\n{\"a\": 1, /* b,\n ] */ }",
                "   \n{\"a\": 1       \n      }",
            ),
            ("[1, 2,\n // é\n]", "[1, 2 \n      \n]"),
            ("[1,]", "[1 ]"),
        ] {
            assert_eq!(stripped(text), json, "{text}");
        }
    }

    #[test]
    fn json_without_comments_stays_as_it_is() {
        for text in [
            r#"{"name": "a // b /* c */ # d, ] \\\" # e", "stop": [{"worn_depth_mm": 1e-3}, {}]}"#,
            "[1,,]",
            "{\"a\": 1 / 2}",
            "",
        ] {
            assert_eq!(stripped(text), text);
        }
    }
}
