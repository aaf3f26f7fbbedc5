//! The book as pages: Markdown of `docs`, with a list of all pages beside each.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html};

/// The pages, from the folder of the crate.
const FOLDER: &str = "../docs";
/// Where they are served.
const ROOT: &str = "/book";

/// Pages and pictures by their paths below `book/`.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn pages() -> io::Result<Vec<(String, Vec<u8>)>> {
    println!("cargo::rerun-if-changed={FOLDER}");
    let summary = fs::read_to_string(Path::new(FOLDER).join("SUMMARY.md"))?;
    // Without its own heading.
    let (_, list) = summary.split_once('\n').unwrap_or_default();
    let contents = as_html(events(list, Path::new("")));
    let contents = contents.replace("<h1>", "<h2>").replace("</h1>", "</h2>");
    let mut files = Vec::new();
    for path in listed(&summary) {
        let text = fs::read_to_string(Path::new(FOLDER).join(&path))?;
        let title = text.lines().next().unwrap_or_default();
        let title = title.trim_start_matches("# ").to_owned();
        let folder = path.parent().unwrap_or(Path::new(""));
        let body = as_html(with_anchors(events(&text, folder)));
        let page = page(&title, &contents, &body);
        let name = path.with_extension("html");
        files.push((format!("book/{}", name.display()), page.into_bytes()));
    }
    for entry in fs::read_dir(Path::new(FOLDER).join("pictures"))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        files.push((format!("book/pictures/{name}"), fs::read(entry.path())?));
    }
    Ok(files)
}

/// Paths of the pages that a list links to.
fn listed(summary: &str) -> Vec<PathBuf> {
    let link = |event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => Some(PathBuf::from(&*dest_url)),
        _ => None,
    };
    Parser::new(summary).filter_map(link).collect()
}

fn page(title: &str, contents: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}: fretwear</title>\n\
         <link rel=\"icon\" href=\"/assets/icon.svg\">\n<link rel=\"stylesheet\" href=\"/assets/style.css\">\n</head>\n\
         <body class=\"book\">\n<a class=\"skip\" href=\"#content\">skip to the content</a>\n\
         <header><a class=\"brand\" href=\"/\">fretwear</a><nav aria-label=\"pages\"><a href=\"/\">Jobs</a><a href=\"/book\">Book</a><a href=\"/docs\">Interface</a></nav></header>\n\
         <nav aria-label=\"book\">{contents}</nav>\n<main id=\"content\" tabindex=\"-1\">\n{body}</main>\n</body>\n</html>\n"
    )
}

/// Markdown of a page in a folder of the book. A link that leads out of the book is its text alone.
fn events<'a>(text: &'a str, folder: &Path) -> Vec<Event<'a>> {
    let mut is_link = false;
    let linked = |mut event: Event<'a>| {
        match &mut event {
            Event::Start(Tag::Link { dest_url, .. }) => {
                let target = target(dest_url, folder);
                is_link = target.is_some();
                *dest_url = CowStr::from(target?);
            }
            Event::Start(Tag::Image { dest_url, .. }) => {
                *dest_url = CowStr::from(target(dest_url, folder)?);
            }
            Event::End(TagEnd::Link) if !is_link => return None,
            _ => {}
        }
        Some(event)
    };
    let parser = Parser::new_ext(text, Options::ENABLE_TABLES);
    parser.filter_map(linked).collect()
}

fn as_html(events: Vec<Event<'_>>) -> String {
    let mut page = String::new();
    html::push_html(&mut page, events.into_iter());
    page
}

/// The address of a target of a link; `None` outside of the book.
fn target(link: &str, folder: &Path) -> Option<String> {
    if link.contains("://") || link.starts_with('#') {
        return Some(link.to_owned());
    }
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let mut path = PathBuf::new();
    for component in folder.join(file).components() {
        match component {
            Component::ParentDir if !path.pop() => return None,
            Component::Normal(name) => path.push(name),
            _ => {}
        }
    }
    if path.extension().is_some_and(|extension| extension == "md") {
        path.set_extension("html");
    }
    let anchor = if anchor.is_empty() {
        String::new()
    } else {
        format!("#{anchor}")
    };
    Some(format!("{ROOT}/{}{anchor}", path.display()))
}

/// Headings with the names that links to them have; tables in boxes that scroll.
fn with_anchors(events: Vec<Event<'_>>) -> Vec<Event<'_>> {
    let mut found = Vec::with_capacity(events.len());
    let mut heading: Option<(usize, String)> = None;
    for event in events {
        match &event {
            Event::Start(Tag::Heading { .. }) => heading = Some((found.len(), String::new())),
            Event::Text(text) | Event::Code(text) => {
                if let Some((_, words)) = &mut heading {
                    words.push_str(text);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                if let Some((at, words)) = heading.take()
                    && let Event::Start(Tag::Heading { id, .. }) = &mut found[at]
                {
                    *id = Some(CowStr::from(anchor(&words)));
                }
            }
            Event::Start(Tag::Table(_)) => {
                found.push(Event::Html("<div class=\"scroll\" tabindex=\"0\">".into()));
            }
            _ => {}
        }
        let is_end = matches!(event, Event::End(TagEnd::Table));
        found.push(event);
        if is_end {
            found.push(Event::Html("</div>\n".into()));
        }
    }
    found
}

/// Name of a heading: its words in lower case with hyphens.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    let words = heading.trim().to_lowercase();
    words
        .chars()
        .filter(kept)
        .collect::<String>()
        .replace(' ', "-")
}
