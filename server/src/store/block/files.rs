//! Files and events behind the content of a block, where it is part of an object.

use std::ops::Range;

use api::results::ResultFile;

use super::{Block, BlockError, Entry, Kind};
use crate::store::compression::compress;

impl Block {
    /// Returns the compressed entries of a block with those of what is behind its content: compressed events, and files in their order.
    ///
    /// # Errors
    /// [`BlockError::Entries`].
    pub(in crate::store) fn with_files(
        entries: &[u8],
        events: ResultFile,
        files: impl IntoIterator<Item = ResultFile>,
    ) -> Result<Vec<u8>, BlockError> {
        let mut block = Self::decode(entries, &[])?;
        block.entries.push(Entry {
            kind: Kind::Events,
            file: events,
        });
        let files = files.into_iter().map(|file| Entry {
            kind: Kind::File,
            file,
        });
        block.entries.extend(files);
        Ok(compress(&serde_json::to_vec(&block.entries)?))
    }

    /// Returns the entries of the files behind the content, with their ranges behind it.
    pub(in crate::store) fn files(&self) -> impl Iterator<Item = (&ResultFile, Range<u64>)> {
        let behind = self.behind();
        behind.filter_map(|(kind, file, range)| (kind == Kind::File).then_some((file, range)))
    }

    /// Returns the entry of the events behind the content, with their range behind it.
    pub(in crate::store) fn events(&self) -> Option<(&ResultFile, Range<u64>)> {
        let mut behind = self.behind();
        let (_, file, range) = behind.find(|(kind, ..)| *kind == Kind::Events)?;
        Some((file, range))
    }

    fn behind(&self) -> impl Iterator<Item = (Kind, &ResultFile, Range<u64>)> {
        let behind = self.entries.iter().filter(|entry| entry.kind.is_behind());
        behind.scan(0, |from, entry| {
            let range = *from..*from + entry.file.bytes;
            *from = range.end;
            Some((entry.kind, &entry.file, range))
        })
    }

    /// Returns `true` if a name is that of a document, a part of the content.
    pub(in crate::store) fn has_document(&self, name: &str) -> bool {
        self.documents().any(|file| file.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::documents::{CSV, VTU};
    use crate::export::files::manifest_entry;

    #[test]
    fn files_are_listed_behind_the_documents() {
        let mut block = Block::default();
        let document = manifest_entry("a.csv", None, CSV, b"cycle");
        assert!(block.push_document(&document, b"cycle"));
        let encoded = block.encode().expect("encoded");
        let files = [("b.vtu", &b"fields"[..]), ("c.vtu", b"more")]
            .map(|(name, bytes)| manifest_entry(name, Some(3), VTU, bytes));
        let events = manifest_entry("events", None, CSV, b"done");
        let entries = Block::with_files(&encoded.entries, events, files.clone());
        let entries = entries.expect("encoded");
        let listed = Block::listed(&entries).expect("decoded");
        assert_eq!(listed, [&[document], &files[..]].concat());
        let block = Block::decode(&entries, &encoded.content).expect("decoded");
        let ranges: Vec<_> = block.files().map(|(_, range)| range).collect();
        assert_eq!(ranges, [4..10, 10..14]);
        assert_eq!(block.events().map(|(_, range)| range), Some(0..4));
        assert!(block.has_document("a.csv") && !block.has_document("b.vtu"));
        let contents: Vec<&[u8]> = block.all().map(|(_, bytes)| bytes).collect();
        assert_eq!(contents, [b"cycle"]);
        assert_eq!(block.document("b.vtu"), None);
    }
}
