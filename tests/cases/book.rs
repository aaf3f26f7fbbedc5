//! Requirement: the book holds what it says: every page is listed, every link leads somewhere, specifications are accepted, commands work, and
//! reference pages are those of the program.

mod commands;
mod reference;
mod thickness;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use tests::fretwear_reading;

/// Root of the workspace.
fn house() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Markdown files below a folder, with their texts.
fn pages(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(pages(&path));
        } else if path.extension().is_some_and(|extension| extension == "md") {
            let text = std::fs::read_to_string(&path).expect("text");
            found.push((path, text));
        }
    }
    found
}

/// Pages of the book and the front pages beside it.
fn documents() -> Vec<(PathBuf, String)> {
    let mut documents = pages(&house().join("docs"));
    for name in ["README.md", "docker/README.md", "tests/README.md"] {
        let path = house().join(name);
        let text = std::fs::read_to_string(&path).expect("text");
        documents.push((path, text));
    }
    documents
}

/// Targets of the links of a page, without those to other hosts.
fn links(text: &str) -> Vec<&str> {
    let ends = text.match_indices("](").map(|(at, open)| at + open.len());
    let target = |from: usize| text[from..].split_once(')').map(|(target, _)| target);
    let links = ends.filter_map(target);
    links.filter(|link| !link.contains("://")).collect()
}

/// Names by which the headings of a page are linked to.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        words
            .chars()
            .filter(kept)
            .collect::<String>()
            .replace(' ', "-")
    };
    headings.map(anchor).collect()
}

#[test]
fn every_page_is_listed_and_every_listed_page_exists() {
    let docs = house().join("docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).expect("the list of pages");
    let listed: BTreeSet<PathBuf> = links(&summary).iter().map(|link| docs.join(link)).collect();
    let mut existing: BTreeSet<PathBuf> = pages(&docs).into_iter().map(|(path, _)| path).collect();
    existing.remove(&docs.join("SUMMARY.md"));
    assert_eq!(listed, existing);
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut broken = Vec::new();
    for (path, text) in documents() {
        for link in links(&text) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = path.parent().expect("a folder");
            let target = if file.is_empty() {
                path.clone()
            } else {
                folder.join(file)
            };
            let found = target.exists()
                && (anchor.is_empty()
                    || std::fs::read_to_string(&target)
                        .is_ok_and(|text| anchors(&text).contains(anchor)));
            if !found {
                broken.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// Texts of the blocks of a language.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    let starts = text
        .match_indices(&fence)
        .map(|(at, fence)| at + fence.len());
    let block = |from: usize| text[from..].split_once("```").map(|(block, _)| block);
    starts.filter_map(block).collect()
}

#[test]
fn every_specification_is_accepted() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut count = 0;
    for (path, text) in documents() {
        for block in blocks(&text, "json") {
            let ran = fretwear_reading(folder.path(), &["plan", "-"], block);
            assert_eq!(
                ran.code,
                Some(0),
                "{}: {block}\n{}",
                path.display(),
                ran.stderr
            );
            count += 1;
        }
    }
    assert!(count >= 2, "{count}");
}

#[test]
fn the_front_page_is_short() {
    let readme = std::fs::read_to_string(house().join("README.md")).expect("the front page");
    let lines = readme.lines().count();
    assert!(lines <= 150, "{lines} lines");
}
