//! A checkpoint that does not come with its claim, with the store and over HTTP.

use super::*;
use crate::objects::Objects;
use crate::store::{Limits, Store};

/// A service whose large checkpoints are objects in a folder, and on a server its files, too.
pub(super) async fn service_with_objects(place: Place) -> (Service, Place) {
    let address = format!("file://{}", place.folder.path().join("objects").display());
    let objects = Objects::open(&address).expect("opened");
    let store = Store::open_with(&place.url, &place.files(), Limits::default()).await;
    let store = store.expect("a store").with_objects(Some(objects)).await;
    let mut service = Service::new().await;
    service.app.store = Arc::new(store.expect("a store"));
    (service, place)
}

#[tokio::test]
async fn the_store_is_asked_for_it() {
    let (service, _place) = service_with_objects(Place::sqlite()).await;
    is_asked_for(&*service.app.store, &service).await;
}

#[tokio::test]
async fn a_service_is_asked_for_it() {
    let (service, _place) = service_with_objects(Place::sqlite()).await;
    let (remote, _scratch, _stop) = remote(&service).await;
    is_asked_for(&remote, &service).await;
}

async fn is_asked_for(job_source: &impl JobSource, service: &Service) {
    queued(service).await;
    let lease = Lease::from(&claimed(job_source).await);
    let checkpoint = EncodedCheckpoint {
        cycle: 5,
        state: (0..=255).cycle().take(1 << 17).collect(),
    };
    let large = JobUpdate {
        checkpoint: Some(checkpoint.clone()),
        ..update(1, 5)
    };
    let recorded = job_source.record(lease, &large, LENGTH).await;
    assert_eq!(recorded.expect("an answer"), HELD);
    let release = JobUpdate {
        number: 2,
        ..JobUpdate::default()
    };
    let ended = job_source
        .finish(lease, &release, &end(Transition::Release))
        .await;
    assert_eq!(ended.expect("an answer"), Some(Status::Queued));
    let claim = claimed(job_source).await;
    let stored = ClaimedCheckpoint::Stored { cycle: 5 };
    assert_eq!(claim.checkpoint, Some(stored));
    let lost = job_source.checkpoint(lease).await.expect("an answer");
    assert_eq!(lost, None);
    let found = job_source.checkpoint(Lease::from(&claim)).await;
    assert_eq!(found.expect("an answer"), Some(checkpoint));
}
