//! The files of the dashboard and its library of charts, compressed, as a table for `routes::operation::serve_pages`.
//!
//! The library, plotly.js, is part of the crate `plotly`, so that a build needs neither Node nor another host.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Brotli's level and window: higher levels take half a minute for three per cent.
const LEVEL: u32 = 9;
const WINDOW: u32 = 22;
const FOLDER: &str = "dashboard";
/// Bytes of a digest that name a version.
const DIGEST_BYTES: usize = 8;

/// Writes the compressed assets and `assets.rs`, their table, to the folder of the build's output.
///
/// # Errors
/// A file that cannot be read or written.
pub(crate) fn embed() -> io::Result<()> {
    println!("cargo::rerun-if-changed={FOLDER}");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let mut files = vec![("plotly.js".to_owned(), plotly().into_bytes())];
    collect(Path::new(FOLDER), "", &mut files)?;
    files.extend(crate::book::pages()?);
    files.sort();
    let version = version(&files);
    println!("cargo::rustc-env=FRETWEAR_ASSETS={version}");
    complete_pages(&mut files, &version);
    let mut table = String::from("&[\n");
    for (number, (path, bytes)) in files.iter().enumerate() {
        let Some(media_type) = media_type(path) else {
            continue;
        };
        let mut packed = brotli::CompressorWriter::new(Vec::new(), 1 << 16, LEVEL, WINDOW);
        packed.write_all(bytes)?;
        fs::write(out.join(format!("{number}.br")), packed.into_inner())?;
        let digest = digest(bytes);
        writeln!(
            table,
            "    Asset {{ path: {path:?}, media_type: {media_type:?}, etag: \"\\\"{digest}\\\"\", compressed: include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{number}.br\")) }},"
        )
        .expect("text can be written");
    }
    table.push_str("]\n");
    fs::write(out.join("assets.rs"), table)
}

/// Digest of all files and their paths.
fn version(files: &[(String, Vec<u8>)]) -> String {
    let mut all = Vec::new();
    for (path, bytes) in files {
        all.extend_from_slice(path.as_bytes());
        all.extend_from_slice(bytes);
    }
    digest(&all)
}

/// Lets pages refer to files below their version, which a browser never asks for again, and name all modules of the dashboard, which
/// it else finds one after the other.
fn complete_pages(files: &mut [(String, Vec<u8>)], version: &str) {
    let folder = format!("\"/assets/{version}/");
    let is_module = |path: &str| {
        let path = Path::new(path);
        path.extension().is_some_and(|extension| extension == "js")
            && !path.starts_with("docs")
            && path != Path::new("plotly.js")
    };
    let modules = files.iter().map(|(path, _)| path);
    let mut preloads = String::new();
    for path in modules.filter(|path| is_module(path)) {
        writeln!(
            preloads,
            "<link rel=\"modulepreload\" href={folder}{path}\">"
        )
        .expect("text can be written");
    }
    for (path, bytes) in files.iter_mut() {
        if Path::new(path)
            .extension()
            .is_none_or(|extension| extension != "html")
        {
            continue;
        }
        let preloads = if path == "index.html" { &preloads } else { "" };
        let text = String::from_utf8_lossy(bytes);
        let text = text.replace("\"/assets/", &folder);
        *bytes = text
            .replace("</head>", &format!("{preloads}</head>"))
            .into_bytes();
    }
}

/// Start of a digest, in hexadecimal digits.
fn digest(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in &Sha256::digest(bytes)[..DIGEST_BYTES] {
        write!(text, "{byte:02x}").expect("text can be written");
    }
    text
}

/// Files of a folder with their paths from the dashboard's.
fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, Vec<u8>)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            collect(&entry.path(), &format!("{name}/"), files)?;
        } else {
            files.push((name, fs::read(entry.path())?));
        }
    }
    Ok(())
}

/// Media type of a file that is served; `None` of one that is not.
fn media_type(path: &str) -> Option<&'static str> {
    match Path::new(path).extension()?.to_str()? {
        "html" => Some("text/html; charset=utf-8"),
        "js" => Some("text/javascript; charset=utf-8"),
        "css" => Some("text/css; charset=utf-8"),
        "svg" => Some("image/svg+xml"),
        "txt" => Some("text/plain; charset=utf-8"),
        _ => None,
    }
}

/// The library: the first of the two scripts that its crate has for pages without a network.
fn plotly() -> String {
    let scripts = plotly::Plot::offline_js_sources();
    let open = "<script type=\"text/javascript\">";
    let first = scripts.split_once(open).map(|(_, rest)| rest);
    let first = first.and_then(|rest| Some(rest.split_at(rest.rfind(open)?).0));
    let first = first.and_then(|text| text.trim_end().strip_suffix("</script>"));
    let script = first.expect("the crate has two scripts");
    assert!(script.contains("plotly.js v"), "the first one is plotly.js");
    script.to_owned()
}
