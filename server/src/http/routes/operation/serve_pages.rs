//! `GET /`, `GET /docs` and `GET /assets/{name}`: the pages of the service. They are part of the binary, contain no
//! data and load nothing from other hosts.

use api::problem::Problem;
use axum::http::{HeaderName, header};
use axum::response::{IntoResponse, Response};

use crate::http::extract::Name;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

pub(super) const HTML: &str = "text/html; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const STYLE: &str = "text/css; charset=utf-8";
/// `Content-Security-Policy` of a page: it loads and requests only from this service.
const CONTENT_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; \
                      img-src 'self' blob:; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A file of the dashboard's folder.
macro_rules! dashboard {
    ($name:literal) => {
        include_str!(concat!("../../../../dashboard/", $name))
    };
}

/// Name, media type and content of each asset.
const ASSETS: [(&str, &str, &str); 6] = [
    ("page.css", STYLE, dashboard!("page.css")),
    ("page.js", SCRIPT, dashboard!("page.js")),
    ("job.js", SCRIPT, dashboard!("job.js")),
    ("chart.js", SCRIPT, dashboard!("chart.js")),
    ("docs.js", SCRIPT, dashboard!("docs.js")),
    ("dashboard.js", SCRIPT, dashboard!("dashboard.js")),
];

/// Error of an unknown asset.
#[derive(Debug, thiserror::Error)]
#[error("there is no such asset")]
struct NoAssetError;

impl RouteError for NoAssetError {
    const TYPE: ProblemType = ProblemType::NO_SUCH_PATH;
}

/// Headers of a page or asset.
pub(super) fn headers(
    media_type: &'static str,
    content_policy: &'static str,
) -> [(HeaderName, &'static str); 3] {
    [
        (header::CONTENT_TYPE, media_type),
        (header::CONTENT_SECURITY_POLICY, content_policy),
        // The pages change with the binary.
        (header::CACHE_CONTROL, "no-cache"),
    ]
}

/// Dashboard: the newest jobs and their progress.
#[utoipa::path(
    get,
    path = "/",
    tag = "pages",
    responses((status = 200, description = "The page", content_type = "text/html", body = String))
)]
pub(crate) async fn dashboard() -> impl IntoResponse {
    (headers(HTML, CONTENT_POLICY), dashboard!("dashboard.html"))
}

/// Documentation of this interface.
#[utoipa::path(
    get,
    path = "/docs",
    tag = "pages",
    responses((status = 200, description = "The page", content_type = "text/html", body = String))
)]
pub(crate) async fn docs() -> impl IntoResponse {
    (headers(HTML, CONTENT_POLICY), dashboard!("docs.html"))
}

/// A script or style sheet of the pages.
#[utoipa::path(
    get,
    path = "/assets/{name}",
    tag = "pages",
    params(("name" = String, Path, description = "Name of the asset")),
    responses(
        (status = 200, description = "The asset", content(
            (String = "text/css"),
            (String = "text/javascript"),
        )),
        (status = 404, description = "No such asset", body = Problem),
    )
)]
pub(crate) async fn asset(Name(name): Name) -> Result<Response, ProblemResponse> {
    let found = ASSETS.iter().find(|(known, _, _)| *known == name);
    let (_, media_type, content) = found.ok_or(NoAssetError)?;
    Ok((headers(media_type, CONTENT_POLICY), *content).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::routes::operation::serve_pages::ASSETS;
    use crate::http::tests::Service;

    #[tokio::test]
    async fn pages_load_only_from_this_service() {
        let service = Service::new().await;
        for path in ["/", "/docs"] {
            let (status, headers, text) = service.text("GET", path, &[], "").await;
            assert_eq!(status, 200);
            let policy = headers["content-security-policy"].to_str().expect("text");
            assert!(policy.starts_with("default-src 'none'; script-src 'self';"));
            assert_eq!(headers["x-content-type-options"], "nosniff");
            assert!(
                !text.contains("http://") && !text.contains("https://"),
                "{path}"
            );
            assert!(
                !text.contains("<script>") && !text.contains("style="),
                "{path}"
            );
            for asset in text.split("/assets/").skip(1) {
                let name = asset.split('"').next().expect("a name");
                let (status, _, _) = service
                    .text("GET", &format!("/assets/{name}"), &[], "")
                    .await;
                assert_eq!(status, 200, "{name}");
            }
        }
    }

    #[test]
    fn assets_refer_to_no_other_host() {
        for (name, _, content) in ASSETS {
            // An XML namespace, which is never fetched.
            let content = content.replace("http://www.w3.org/2000/svg", "");
            assert!(
                !content.contains("http://") && !content.contains("https://"),
                "{name}"
            );
        }
    }

    #[tokio::test]
    async fn unknown_assets_are_404() {
        let service = Service::new().await;
        for name in ["x.js", "..%2FCargo.toml", "%FF"] {
            assert_eq!(
                service.get(&format!("/assets/{name}")).await.0,
                404,
                "{name}"
            );
        }
    }
}
