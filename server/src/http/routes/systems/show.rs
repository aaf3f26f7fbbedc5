//! `GET /v1/systems/{kind}`: a contact system and its preset.

use api::problem::Problem;
use api::spec::{Spec, StringEnum, System, SystemKind};
use api::system::SystemDocument;
use axum::Json;
use axum::extract::State;
use serde_json::Value;

use crate::http::app::App;
use crate::http::extract::Name;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::systems::schema;
use crate::spec;

/// Error of a contact system.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SystemError {
    /// No contact system has this name.
    #[error("there is no system of that kind; kinds are {}", SystemKind::NAMES.join(", "))]
    Missing,
    /// The preset cannot be resolved, which is a bug.
    #[error("the preset of {0} has faults")]
    Preset(&'static str),
}

impl RouteError for SystemError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing => ProblemType::NO_SUCH_SYSTEM,
            Self::Preset(_) => ProblemType::INTERNAL,
        }
    }
}

/// A contact system with its preset.
#[utoipa::path(
    get,
    path = "/v1/systems/{kind}",
    tag = "systems",
    params(("kind" = SystemKind, Path, description = "The kind")),
    responses(
        (status = 200, description = "The system", body = SystemDocument),
        (status = 404, description = "No such system", body = Problem),
    )
)]
pub(crate) async fn system(
    State(app): State<App>,
    Name(name): Name,
) -> Result<Json<SystemDocument>, ProblemResponse> {
    let kind = SystemKind::from_name(&name).ok_or(SystemError::Missing)?;
    Ok(Json(document(kind, app.document)?))
}

/// Returns the document of a contact system, with its schema from the OpenAPI document.
pub(crate) fn document(kind: SystemKind, openapi: &Value) -> Result<SystemDocument, SystemError> {
    let spec = Spec {
        system: System::of_kind(kind),
        ..Spec::default()
    };
    let resolved = spec::resolve(&spec).map_err(|_| SystemError::Preset(kind.as_str()))?;
    Ok(SystemDocument {
        kind,
        description: spec::system_definition(kind).description.to_owned(),
        preset: resolved.spec,
        schema: schema::of(kind, openapi),
    })
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_preset_is_shown_with_provenance_and_schema() {
        let service = Service::new().await;
        let (_, _, one) = service.get("/v1/systems/fuzz_button").await;
        assert_eq!(one["preset"]["system"]["wire_diameter_mm"], 0.0508);
        assert_eq!(
            one["preset"]["provenance"]["/system/wire_diameter_mm"],
            "source"
        );
        assert_eq!(
            service.get("/v1/systems/toaster").await.2["type"],
            "/problems/no-such-system"
        );
        assert_eq!(service.get("/v1/systems/%FF").await.0, 404);
        assert_eq!(
            one["schema"]["$defs"]["System"]["properties"]["kind"]["const"],
            "fuzz_button"
        );
    }
}
