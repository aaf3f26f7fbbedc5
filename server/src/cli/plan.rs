//! `fretwear plan SPEC`.

use std::path::Path;
use std::process::ExitCode;

use api::plan::PlanDocument;

use super::terminal::{failed, say, specification};
use crate::translate;

pub(super) fn run(spec: &Path) -> ExitCode {
    let resolved = match specification(spec) {
        Ok(resolved) => resolved,
        Err(code) => return code,
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
