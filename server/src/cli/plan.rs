//! `fretwear plan SPEC`.

use std::path::Path;
use std::process::ExitCode;

use api::plan::PlanDocument;

use super::terminal::{failed, refused, say};
use crate::translate;

pub(super) fn run(spec: &Path) -> ExitCode {
    let bytes = match std::fs::read(spec) {
        Ok(bytes) => bytes,
        Err(cause) => return failed(format_args!("{}: {cause}", spec.display())),
    };
    let resolved = match translate::read(&bytes) {
        Ok(resolved) => resolved,
        Err(error) => return refused(&error),
    };
    let plan = translate::plan(&resolved);
    match serde_json::to_string_pretty(&PlanDocument {
        spec: resolved.spec,
        plan,
    }) {
        Ok(text) => {
            say(text);
            ExitCode::SUCCESS
        }
        Err(cause) => failed(cause),
    }
}
