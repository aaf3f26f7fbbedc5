//! `GET /v1/systems`: contact systems and their presets.

use api::spec::SystemKind;
use api::system::SystemList;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::routes::systems::show::document;

/// All contact systems with their presets.
#[utoipa::path(
    get,
    path = "/v1/systems",
    tag = "systems",
    responses((status = 200, description = "The systems", body = SystemList))
)]
pub(crate) async fn systems(State(app): State<App>) -> Result<Json<SystemList>, ProblemResponse> {
    let systems = SystemKind::ALL
        .into_iter()
        .map(|kind| document(kind, app.document))
        .collect::<Result<_, _>>()?;
    Ok(Json(SystemList { systems }))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn every_system_is_listed() {
        let service = Service::new().await;
        let (status, _, list) = service.get("/v1/systems").await;
        assert_eq!(
            (status.as_u16(), list["systems"].as_array().map(Vec::len)),
            (200, Some(5))
        );
    }
}
