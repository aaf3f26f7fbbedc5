//! `GET /v1/systems` and `GET /v1/systems/{kind}`: contact systems and their presets.

use api::problem::Problem;
use api::spec::{Spec, System, SystemKind};
use api::system::{SystemDocument, SystemList};
use axum::Json;
use axum::response::{IntoResponse, Response};

use crate::http::extract::SystemName;
use crate::http::problem::Kind;
use crate::http::routes::systems::schema;
use crate::spec;

/// Why there is no system.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum SystemError {
    /// There is none of that kind.
    #[error("there is no system of that kind; kinds are {}", kinds())]
    Missing,
    /// Its preset cannot be resolved: a mistake of the product.
    #[error("the preset of {0} has faults")]
    Preset(&'static str),
}

impl IntoResponse for SystemError {
    fn into_response(self) -> Response {
        match self {
            Self::Missing => Kind::NoSystem.because(self.to_string()),
            Self::Preset(_) => crate::http::problem::Refusal::internal(&self),
        }
        .into_response()
    }
}

fn kinds() -> String {
    SystemKind::ALL
        .iter()
        .map(|kind| kind.as_str())
        .collect::<Vec<_>>()
        .join(", ")
}

/// Every contact system with its preset.
#[utoipa::path(
    get,
    path = "/v1/systems",
    tag = "systems",
    responses((status = 200, description = "The systems", body = SystemList))
)]
pub(in crate::http) async fn systems() -> Result<Json<SystemList>, SystemError> {
    let systems = SystemKind::ALL
        .iter()
        .map(|kind| document(*kind))
        .collect::<Result<_, _>>()?;
    Ok(Json(SystemList { systems }))
}

/// One contact system with its preset.
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
pub(in crate::http) async fn system(
    SystemName(name): SystemName,
) -> Result<Json<SystemDocument>, SystemError> {
    let kind = SystemKind::ALL
        .iter()
        .find(|kind| kind.as_str() == name)
        .ok_or(SystemError::Missing)?;
    document(*kind).map(Json)
}

fn document(kind: SystemKind) -> Result<SystemDocument, SystemError> {
    let spec = Spec {
        system: System::of_kind(kind),
        ..Spec::default()
    };
    let resolved = spec::resolve(&spec).map_err(|_| SystemError::Preset(kind.as_str()))?;
    Ok(SystemDocument {
        kind,
        description: spec::system_description(kind).to_owned(),
        preset: resolved.spec,
        schema: schema::of(kind),
    })
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn every_preset_is_told_with_provenance() {
        let service = Service::new().await;
        let (status, _, list) = service.get("/v1/systems").await;
        assert_eq!(
            (status.as_u16(), list["systems"].as_array().map(Vec::len)),
            (200, Some(5))
        );
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
