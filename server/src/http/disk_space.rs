//! The problem of a full data disk, with its free space.

use axum::extract::State;
use axum::response::{IntoResponse, Response};

use crate::export::files;
use crate::http::app::App;
use crate::http::problem::{DISK_FULL, DiskFull, ProblemType};

/// Free space with which every request can be written, MB: the largest batch of jobs, of 32 MB, in the log and in the
/// database.
const NEEDED_MB: u64 = 64;

/// Middleware that adds the free space to the problem of a full disk, if the system reports it.
pub(super) async fn explain(State(app): State<App>, response: Response) -> Response {
    if response.extensions().get::<DiskFull>().is_none() {
        return response;
    }
    match files::free_mb(files::parent(&app.store.machine_file())) {
        Some(free_mb) => ProblemType::BUSY
            .with_detail(format!(
                "{DISK_FULL} ({free_mb} MB free, {NEEDED_MB} MB needed)"
            ))
            .into_response(),
        None => response,
    }
}

#[cfg(test)]
mod tests {
    use http_body_util::BodyExt;

    use super::*;
    use crate::http::problem::ProblemResponse;
    use crate::http::tests::Service;
    use crate::store::StoreError;

    #[tokio::test]
    async fn the_problem_of_a_full_disk_states_free_and_needed_space() {
        let service = Service::new().await;
        let full = StoreError::Prepare {
            path: "fretwear.db".into(),
            cause: std::io::ErrorKind::StorageFull.into(),
        };
        let response = ProblemResponse::from(full).into_response();
        let response = explain(State(service.app.clone()), response).await;
        assert_eq!(response.status(), 503);
        assert_eq!(response.headers()["retry-after"], "5");
        let body = response.into_body().collect().await.expect("a body");
        let text = String::from_utf8(body.to_bytes().to_vec()).expect("text");
        let numbers = text.split_once("no space left on the data disk (");
        let (free, rest) = numbers
            .and_then(|(_, rest)| rest.split_once(" MB free, "))
            .expect(&text);
        assert!(free.parse::<u64>().is_ok(), "{text}");
        assert!(rest.starts_with("64 MB needed)"), "{text}");
    }
}
