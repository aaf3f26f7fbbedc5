//! `GET /openapi.json`: the OpenAPI document of the interface.

use std::sync::OnceLock;

use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;

use crate::http::app::App;

/// OpenAPI document of the interface.
#[utoipa::path(
    get,
    path = "/openapi.json",
    tag = "operation",
    responses((status = 200, description = "The document", content_type = "application/json"))
)]
pub(crate) async fn openapi(State(app): State<App>) -> impl IntoResponse {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(|| format!("{:#}\n", app.document));
    ([(header::CONTENT_TYPE, "application/json")], text.as_str())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_document_defines_every_schema_that_it_refers_to() {
        let service = Service::new().await;
        let (status, headers, document) = service.get("/openapi.json").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "application/json");
        assert_eq!(document["openapi"], "3.1.0");
        for path in [
            "/v1/jobs",
            "/v1/jobs/{id}/events",
            "/v1/sweeps/{id}/outcomes",
            "/healthz",
        ] {
            assert!(document["paths"][path].is_object(), "{path}");
        }
        let text = document.to_string();
        for reference in text.split("#/components/schemas/").skip(1) {
            let name = reference.split('"').next().expect("a name");
            assert!(
                document["components"]["schemas"][name].is_object(),
                "{name} is not described"
            );
        }
    }
}
