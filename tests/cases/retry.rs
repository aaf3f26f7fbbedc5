//! Requirement: a cancelled job that is tried again continues from its last checkpoint, to the bits of an uninterrupted run,
//! and its events can be replayed from the first to the last.

use futures_util::StreamExt;
use serde_json::Value;
use tests::{Server, bits, fuzz_button_with_jump};

/// Computed cycles of some seconds together.
const JUMP: u64 = 8;

async fn submitted(server: &Server) -> String {
    let (status, job) = server.submit(fuzz_button_with_jump(JUMP)).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("a job has an id").to_owned()
}

async fn ended(server: &Server, id: &str) -> Value {
    server
        .job_when(id, |job| job["finished_at"].is_string())
        .await
}

/// The names of all events, with ids that count without gaps.
async fn events(server: &Server, id: &str) -> Vec<String> {
    use eventsource_stream::Eventsource;
    let url = format!("{}/v1/jobs/{id}/events", server.base);
    let request = server.client.get(url).header("last-event-id", "0");
    let answer = request.send().await.expect("the service answers");
    let mut stream = answer.bytes_stream().eventsource();
    let mut names = Vec::new();
    while let Some(event) = stream.next().await {
        let event = event.expect("the stream is whole");
        names.push(event.event);
        assert_eq!(event.id, names.len().to_string());
    }
    names
}

#[tokio::test]
async fn a_cancelled_job_that_is_tried_again_reaches_the_bits_of_an_uninterrupted_one() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--checkpoint-every-s", "0"]);
    let id = submitted(&server).await;
    server
        .job_when(&id, |job| job["progress"]["cycle"].as_u64() > Some(200))
        .await;
    server.post(&format!("/v1/jobs/{id}/cancel")).await;
    let cancelled = ended(&server, &id).await;
    assert_eq!(cancelled["status"], "cancelled", "{cancelled}");

    let (status, job) = server.post(&format!("/v1/jobs/{id}/retry")).await;
    assert_eq!(status, 202, "{job}");
    let job = ended(&server, &id).await;
    assert_eq!(
        (job["status"].as_str(), job["attempts"].as_u64()),
        (Some("succeeded"), Some(2)),
        "{job}"
    );
    let names = events(&server, &id).await;
    let done = names.iter().filter(|name| *name == "done").count();
    assert_eq!((done, names.last().map(String::as_str)), (2, Some("done")));
    // The second attempt did not start at cycle 0 again.
    let cycles = names.iter().filter(|name| *name == "cycle").count();
    let all = 2_000 / usize::try_from(JUMP).expect("a small number");
    assert!(cycles < all + all / 4, "{cycles} cycles for {all}");

    let other = tempfile::tempdir().expect("a folder can be made");
    let undisturbed = Server::start(other.path());
    let reference = submitted(&undisturbed).await;
    ended(&undisturbed, &reference).await;
    assert_eq!(
        bits::of(&server, &id).await,
        bits::of(&undisturbed, &reference).await
    );
}
