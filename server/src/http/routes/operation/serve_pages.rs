//! `GET /`, `GET /docs`, the book under `/book` and the files under `/assets/`: the pages of the service. They are part of the binary, contain no
//! data and load nothing from other hosts.

use std::io::Read;

use axum::extract::Path;
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

pub(super) const HTML: &str = "text/html; charset=utf-8";
/// `Content-Security-Policy` of a page: it loads and requests only from this service. The library of charts makes style elements that are
/// empty, whose digest is that of no text, style attributes and pictures of its own data; scripts come only from here.
const CONTENT_POLICY: &str = "default-src 'none'; script-src 'self'; \
                      style-src 'self'; style-src-elem 'self' 'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='; \
                      style-src-attr 'unsafe-inline'; connect-src 'self'; img-src 'self' blob: data:; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// Version of the files: the pages of this program refer to them by paths below it.
const VERSION: &str = env!("FRETWEAR_ASSETS");
/// `Cache-Control` of what changes with the program, and of what does not.
const CHANGES: &str = "no-cache";
const STAYS: &str = "public, max-age=31536000, immutable";
/// Buffer of a decompression, bytes.
const BUFFER: usize = 1 << 14;

/// A file of the dashboard.
struct Asset {
    path: &'static str,
    media_type: &'static str,
    etag: &'static str,
    /// Bytes, compressed by Brotli.
    compressed: &'static [u8],
}

/// All files, by their paths.
const ASSETS: &[Asset] = include!(concat!(env!("OUT_DIR"), "/assets.rs"));

/// Error of a request for an asset.
#[derive(Debug, thiserror::Error)]
enum AssetError {
    /// Unknown.
    #[error("there is no such asset")]
    Unknown,
    /// The program is damaged.
    #[error("an asset cannot be decompressed: {0}")]
    Damaged(#[source] std::io::Error),
}

impl RouteError for AssetError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Unknown => ProblemType::NO_SUCH_PATH,
            Self::Damaged(_) => ProblemType::INTERNAL,
        }
    }
}

/// Headers of a page or asset.
pub(super) fn headers(
    media_type: &'static str,
    content_policy: &'static str,
) -> [(HeaderName, &'static str); 3] {
    [
        (header::CONTENT_TYPE, media_type),
        (header::CONTENT_SECURITY_POLICY, content_policy),
        (header::CACHE_CONTROL, CHANGES),
    ]
}

/// Dashboard: jobs, their progress and their results.
#[utoipa::path(
    get,
    path = "/",
    tag = "pages",
    responses((status = 200, description = "The page", content_type = "text/html", body = String))
)]
pub(crate) async fn dashboard(request: HeaderMap) -> Result<Response, ProblemResponse> {
    serve("index.html", CHANGES, &request)
}

/// Documentation of this interface.
#[utoipa::path(
    get,
    path = "/docs",
    tag = "pages",
    responses((status = 200, description = "The page", content_type = "text/html", body = String))
)]
pub(crate) async fn docs(request: HeaderMap) -> Result<Response, ProblemResponse> {
    serve("docs/index.html", CHANGES, &request)
}

/// Front page of the book.
#[utoipa::path(
    get,
    path = "/book",
    tag = "pages",
    responses((status = 200, description = "The page", content_type = "text/html", body = String))
)]
pub(crate) async fn book(request: HeaderMap) -> Result<Response, ProblemResponse> {
    serve("book/introduction.html", CHANGES, &request)
}

/// A page or a picture of the book.
pub(crate) async fn book_page(
    Path(path): Path<String>,
    request: HeaderMap,
) -> Result<Response, ProblemResponse> {
    serve(&format!("book/{path}"), CHANGES, &request)
}

/// A script, a style sheet or a text of the pages.
pub(crate) async fn asset(
    Path(path): Path<String>,
    request: HeaderMap,
) -> Result<Response, ProblemResponse> {
    // A page of an earlier program, still open, finds the files of this one.
    let (version, name) = path.split_once('/').unwrap_or_default();
    let is_version =
        version.len() == VERSION.len() && version.bytes().all(|byte| byte.is_ascii_hexdigit());
    let name = if is_version { name } else { &path };
    let caching = if version == VERSION { STAYS } else { CHANGES };
    serve(name, caching, &request)
}

fn serve(
    path: &str,
    caching: &'static str,
    request: &HeaderMap,
) -> Result<Response, ProblemResponse> {
    let found = ASSETS.iter().find(|asset| asset.path == path);
    let asset = found.ok_or(AssetError::Unknown)?;
    let of_file = [
        (header::ETAG, asset.etag),
        (header::VARY, "accept-encoding"),
        (header::CACHE_CONTROL, caching),
    ];
    let headers = (headers(asset.media_type, CONTENT_POLICY), of_file);
    let has = |name: HeaderName, part: &str| {
        let value = request.get(name).and_then(|value| value.to_str().ok());
        value.is_some_and(|value| value.contains(part))
    };
    Ok(if has(header::IF_NONE_MATCH, asset.etag) {
        (StatusCode::NOT_MODIFIED, headers).into_response()
    } else if has(header::ACCEPT_ENCODING, "br") {
        let encoding = [(header::CONTENT_ENCODING, "br")];
        (headers, encoding, asset.compressed).into_response()
    } else {
        (headers, asset.bytes().map_err(AssetError::Damaged)?).into_response()
    })
}

impl Asset {
    /// Bytes without compression.
    fn bytes(&self) -> std::io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        brotli::Decompressor::new(self.compressed, BUFFER).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::http::tests::Service;

    fn text(asset: &Asset) -> String {
        String::from_utf8(asset.bytes().expect("it can be decompressed")).expect("it is text")
    }

    #[tokio::test]
    async fn pages_load_only_from_this_service() {
        let service = Service::new().await;
        for path in ["/", "/docs", "/book", "/book/guide/accuracy.html"] {
            let (status, headers, text) = service.text("GET", path, &[], "").await;
            assert_eq!(status, 200);
            let policy = headers["content-security-policy"].to_str().expect("text");
            assert!(policy.starts_with("default-src 'none'; script-src 'self';"));
            assert!(!policy.contains("unsafe-eval"), "{policy}");
            assert_eq!(headers["x-content-type-options"], "nosniff");
            for loaded in [
                "src=\"http",
                "<link rel=\"stylesheet\" href=\"http",
                "<script>",
            ] {
                assert!(!text.contains(loaded), "{path}: {loaded}");
            }
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
    fn modules_import_files_that_are_there_and_refer_to_no_other_host() {
        // The book may name other hosts, and loads nothing from them.
        let is_own = |path: &str| path != "plotly.js" && !path.starts_with("book/");
        let own = ASSETS.iter().filter(|asset| is_own(asset.path));
        for asset in own {
            // An XML namespace, which is never fetched.
            let text = text(asset).replace("http://www.w3.org/2000/svg", "");
            assert!(
                !text.contains("http://") && !text.contains("https://"),
                "{}",
                asset.path
            );
            let folder = asset.path.rsplit_once('/').map_or("", |(folder, _)| folder);
            for import in text.split("from \"").skip(1) {
                let target = import.split('"').next().expect("a path");
                let mut parts: Vec<&str> = folder.split('/').filter(|s| !s.is_empty()).collect();
                for step in target.split('/') {
                    match step {
                        "." => {}
                        ".." => drop(parts.pop()),
                        name => parts.push(name),
                    }
                }
                let path = parts.join("/");
                assert!(
                    ASSETS.iter().any(|asset| asset.path == path),
                    "{} imports {target}",
                    asset.path
                );
            }
        }
    }

    /// A name of a quantity that a document does not have is read as absent, and its row is left out without an error.
    #[test]
    fn quantities_that_pages_read_are_those_of_the_interface() {
        const UNITS: [&str; 15] = [
            "mm", "mm2", "mm3", "um", "n", "mpa", "mohm", "c", "hz", "s", "mj", "percent", "deg",
            "mb", "cycles",
        ];
        let interface = crate::http::openapi::text();
        let mut read = 0;
        let is_own =
            |asset: &&Asset| asset.media_type.contains("javascript") && asset.path != "plotly.js";
        for asset in ASSETS.iter().filter(is_own) {
            let text = text(asset);
            for after in text.split('.').skip(1) {
                let name = after.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
                let name = name.into_iter().next().unwrap_or_default();
                let unit = name.rsplit_once('_').map_or("", |(_, unit)| unit);
                if UNITS.contains(&unit) {
                    read += 1;
                    let quoted = format!("\"{name}\"");
                    assert!(interface.contains(&quoted), "{}: {name}", asset.path);
                }
            }
        }
        assert!(read > 50, "{read} quantities");
    }

    #[tokio::test]
    async fn every_link_of_the_book_leads_to_a_page() {
        let service = Service::new().await;
        let pages = ASSETS
            .iter()
            .filter(|asset| asset.path.starts_with("book/"));
        let pages: Vec<&Asset> = pages.filter(|asset| asset.media_type == HTML).collect();
        assert!(pages.len() > 40, "{}", pages.len());
        let bytes: usize = pages.iter().map(|page| page.compressed.len()).sum();
        assert!(bytes < 1 << 20, "{bytes} bytes");
        let mut served = BTreeMap::new();
        for page in pages {
            let text = text(page);
            for link in text.split("=\"/book/").skip(1) {
                let link = link.split('"').next().expect("a target");
                let (target, anchor) = link.split_once('#').unwrap_or((link, ""));
                let target = format!("/book/{target}");
                if !served.contains_key(&target) {
                    let (status, _, found) = service.text("GET", &target, &[], "").await;
                    assert_eq!(status, 200, "{}: {link}", page.path);
                    served.insert(target.clone(), found);
                }
                let found = &served[&target];
                let is_heading = anchor.is_empty() || found.contains(&format!("id=\"{anchor}\""));
                assert!(is_heading, "{}: {link}", page.path);
            }
        }
    }

    #[test]
    fn the_library_of_charts_is_whole() {
        let library = ASSETS.iter().find(|asset| asset.path == "plotly.js");
        let library = text(library.expect("it is embedded"));
        assert!(library.len() > 4_000_000, "{} bytes", library.len());
        assert!(library.trim_end().ends_with("}));"), "the end is cut off");
    }

    #[tokio::test]
    async fn assets_are_compressed_for_those_who_accept_it_and_not_sent_twice() {
        let service = Service::new().await;
        let path = "/assets/style.css";
        let (status, plain, text) = service.text("GET", path, &[], "").await;
        assert_eq!(status, 200);
        assert!(text.contains(":root") && !plain.contains_key("content-encoding"));
        let accepting = [("accept-encoding", "gzip, br")];
        let (_, headers, bytes) = service.bytes("GET", path, &accepting, "").await;
        assert_eq!(headers["content-encoding"], "br");
        assert!(bytes.len() < text.len() / 2);
        assert_eq!(plain["cache-control"], "no-cache");
        let known = [("if-none-match", plain["etag"].to_str().expect("text"))];
        let (status, _, bytes) = service.bytes("GET", path, &known, "").await;
        assert_eq!((status.as_u16(), bytes.len()), (304, 0));
    }

    #[tokio::test]
    async fn assets_of_this_version_stay_and_those_of_others_are_asked_for_again() {
        let service = Service::new().await;
        let (_, _, page) = service.text("GET", "/", &[], "").await;
        assert!(page.contains(&format!(
            "\"modulepreload\" href=\"/assets/{VERSION}/main.js\""
        )));
        for (version, caching) in [(VERSION, STAYS), ("0123456789abcdef", CHANGES)] {
            let path = format!("/assets/{version}/style.css");
            let (status, headers, text) = service.text("GET", &path, &[], "").await;
            assert_eq!(
                (status.as_u16(), &headers["cache-control"]),
                (200, &caching.parse().expect("a value"))
            );
            assert!(text.contains(":root"));
        }
    }

    #[tokio::test]
    async fn unknown_assets_are_404() {
        let service = Service::new().await;
        for name in [
            "0123456789abcdef",
            "0123456789abcdef/",
            "0123456789abcdef/0123456789abcdef/style.css",
            "x.js",
            "..%2FCargo.toml",
            "parts",
            "parts/",
            "%FF",
        ] {
            let (status, ..) = service.get(&format!("/assets/{name}")).await;
            assert!(status == 404 || status == 400, "{name}: {status}");
        }
    }
}
