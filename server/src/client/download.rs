//! Files of a job, written into a folder and checked against the manifest.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use api::results::{Manifest, ResultFile};
use futures_util::StreamExt;
use uuid::Uuid;

use crate::client::{Client, ClientError, repeated};
use crate::export::files::is_plain_name;
use crate::store::checksum::{self, Checksum};

/// Result of a download.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fetched {
    /// The file was received.
    Received,
    /// The folder had it already.
    Present,
}

impl Client {
    /// Writes files of a job into a folder, which is created; all of them if none is named. Files that are there with their
    /// SHA-256 are not requested again, so that an interrupted download continues.
    ///
    /// # Errors
    /// [`ClientError`]; files that were received stay.
    pub async fn fetch(
        &self,
        id: Uuid,
        names: &[String],
        folder: &Path,
        mut observe: impl FnMut(&ResultFile, Fetched),
    ) -> Result<(), ClientError> {
        let manifest: Manifest = self.get(&format!("/v1/jobs/{id}/results"), &[]).await?;
        let files = chosen(manifest.files, names)?;
        std::fs::create_dir_all(folder).map_err(|cause| file_error(folder, cause))?;
        let mut failed = Vec::new();
        for file in &files {
            if !is_plain_name(&file.name) {
                return Err(ClientError::Name(file.name.clone()));
            }
            let path = folder.join(&file.name);
            if is_present(&path, file) {
                observe(file, Fetched::Present);
                continue;
            }
            match repeated(async || self.receive(id, file, &path).await).await {
                Ok(()) => observe(file, Fetched::Received),
                Err(error) if error.is_of_file() => failed.push(error),
                Err(error) => return Err(error),
            }
        }
        let number = failed.len();
        let first = failed.into_iter().next().map(Box::new);
        first.map_or(Ok(()), |first| Err(ClientError::Files { number, first }))
    }

    /// Receives a file under a temporary name, and renames it once its SHA-256 was compared.
    async fn receive(&self, id: Uuid, file: &ResultFile, path: &Path) -> Result<(), ClientError> {
        let unfinished = path.with_file_name(format!("{}.unfinished", file.name));
        let received = self.receive_as(id, file, &unfinished).await;
        let renamed = received.and_then(|()| {
            std::fs::rename(&unfinished, path).map_err(|cause| file_error(path, cause))
        });
        if renamed.is_err() {
            // There may be none.
            let _ = std::fs::remove_file(&unfinished);
        }
        renamed
    }

    async fn receive_as(
        &self,
        id: Uuid,
        file: &ResultFile,
        unfinished: &Path,
    ) -> Result<(), ClientError> {
        let url = self.url(&format!("/v1/jobs/{id}/results/files/{}", file.name));
        let mut chunks = self.send(self.http.get(url)).await?.bytes_stream();
        let failed = |cause| file_error(unfinished, cause);
        let mut target = File::create(unfinished).map_err(failed)?;
        let mut checksum = Checksum::default();
        while let Some(chunk) = chunks.next().await {
            let chunk = chunk.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
            checksum.update(&chunk);
            target.write_all(&chunk).map_err(failed)?;
        }
        checksum
            .compare(file)
            .map_err(|cause| ClientError::Received {
                name: file.name.clone(),
                cause,
            })?;
        target.sync_all().map_err(failed)
    }
}

/// The named files of a manifest; all if none is named.
fn chosen(files: Vec<ResultFile>, names: &[String]) -> Result<Vec<ResultFile>, ClientError> {
    if let Some(name) = names
        .iter()
        .find(|name| files.iter().all(|file| file.name != **name))
    {
        let others: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
        return Err(ClientError::NoFile {
            name: name.clone(),
            others: if others.is_empty() {
                "none so far".to_owned()
            } else {
                others.join(", ")
            },
        });
    }
    let is_chosen = |file: &ResultFile| names.is_empty() || names.contains(&file.name);
    Ok(files.into_iter().filter(is_chosen).collect())
}

fn is_present(path: &Path, file: &ResultFile) -> bool {
    checksum::check_file(file, path).is_ok()
}

fn file_error(path: &Path, cause: std::io::Error) -> ClientError {
    ClientError::File {
        path: path.to_owned(),
        cause,
    }
}
