//! Objects in a folder.

use std::slice;

use futures_util::TryStreamExt;

use super::*;
use crate::export::files::sha256;

/// A file that should have a content.
fn file(path: &std::path::Path, content: &[u8]) -> ObjectFile {
    ObjectFile {
        source: Source::File(path.to_owned()),
        bytes: u64::try_from(content.len()).expect("small"),
        sha256: sha256(content),
    }
}

#[tokio::test]
async fn an_object_has_its_head_and_its_files_and_is_read_in_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.vtu");
    let file = file(&path, b"fields");
    std::fs::write(&path, "fields").expect("written");
    let address = format!("file://{}/objects", folder.path().display());
    let objects = Objects::open(&address).expect("opened");
    objects.mark().await.expect("marked");
    let files = [file.clone(), file];
    let written = objects.put("jobs/1/a", b"head", &files).await;
    written.expect("written");
    let whole = objects.get("jobs/1/a", 0..16).await.expect("read");
    assert_eq!(whole, b"headfieldsfields");
    let part = ObjectPart::new(&objects, "jobs/1/a", 4..10);
    assert_eq!(part.read().await.expect("read"), b"fields");
    let some: Vec<_> = part
        .stream(2..5)
        .await
        .expect("a stream")
        .try_collect()
        .await
        .expect("read");
    assert_eq!(some.concat(), b"eld");
    objects.remove("jobs/1/a").await.expect("removed");
    objects
        .remove("jobs/1/a")
        .await
        .expect("a repeated request");
    let gone = objects.get("jobs/1/a", 0..4).await;
    assert!(matches!(gone, Err(ObjectsError::Missing(_))), "{gone:?}");
}

#[tokio::test]
async fn an_object_whose_files_are_missing_or_damaged_is_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let objects = Objects::open(&format!("file://{}", folder.path().display()));
    let objects = objects.expect("opened");
    objects.mark().await.expect("marked");
    let path = folder.path().join("a.vtu");
    let file = file(&path, b"fields");
    for found in [None, Some("field"), Some("FIELDS")] {
        if let Some(found) = found {
            std::fs::write(&path, found).expect("written");
        }
        let written = objects.put("a", b"head", slice::from_ref(&file)).await;
        let is_damaged = matches!(written, Err(ObjectsError::Damaged { .. }));
        assert!(is_damaged, "{found:?}: {written:?}");
        assert!(objects.get("a", 0..4).await.is_err());
    }
}

#[test]
fn other_addresses_are_refused() {
    for address in [
        "",
        "objects",
        "file://relative",
        "s3://",
        "gs://bucket",
        "sqlite://x.db",
    ] {
        let opened = Objects::open(address);
        assert!(matches!(opened, Err(ObjectsError::Address(_))), "{address}");
    }
}

#[tokio::test]
async fn a_store_without_its_mark_has_no_missing_objects_and_takes_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().join("objects");
    let objects = Objects::open(&format!("file://{}", place.display()));
    let objects = objects.expect("opened");
    objects.mark().await.expect("marked");
    assert!(objects.is_marked().await.expect("an answer"));
    let missing = objects.get_all("a").await;
    assert!(
        matches!(missing, Err(ObjectsError::Missing(_))),
        "{missing:?}"
    );
    std::fs::remove_dir_all(&place).expect("removed");
    // The folder of a file system that is not mounted may be there or not.
    for is_there in [false, true] {
        if is_there {
            std::fs::create_dir(&place).expect("a folder");
        }
        assert!(!objects.is_marked().await.expect("an answer"));
        let failed = [
            objects.get_all("a").await.map(drop),
            objects.get("a", 0..4).await.map(drop),
            objects.put("a", b"head", &[]).await,
            objects.put_whole("a", b"head".to_vec()).await,
            objects.remove("a").await,
        ];
        for failed in failed {
            let is_unmarked = matches!(failed, Err(ObjectsError::Unmarked(_)));
            assert!(is_unmarked, "{failed:?}");
        }
    }
}
