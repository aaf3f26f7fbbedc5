//! The reader of sources, on a small crate with every form that it must understand.

use std::fs;

use super::cycles;
use super::sources::{Sources, Target};
use super::surface;
use super::violations::is_spoken;

const FILES: [(&str, &str); 5] = [
    (
        "lib.rs",
        "mod shapes;\nmod report;\npub use shapes::Circle;\n#[cfg(test)]\nmod tests;",
    ),
    (
        "shapes.rs",
        "mod circle;\npub(crate) mod square;\npub use circle::Circle;\nuse std::fmt;\n\
         pub const SIDES: usize = 4;\npub fn area() { circle::unit(); fmt::format(); }",
    ),
    (
        "shapes/circle.rs",
        "pub struct Circle;\npub fn unit() -> &'static str { \"SELECT 1\" }\n\
         #[derive(Error)]\npub enum CircleError { /// No circle.\n#[error(\"no circle of {0} mm\")] Radius(f64) }\n\
         pub fn check(a: f64) { debug_assert!(a > 0.0, \"a circle has an area\"); }\n\
         table! { /// Diameter of it.\n diameter_mm }\n\
         pub fn told() { say(\"give `a`\"); say(\"radius_mm\"); say(\"round\"); say(\"it is round\") }",
    ),
    (
        "shapes/square.rs",
        "use super::{\n    super::report::{self as said},\n    SIDES,\n};\n\
         pub fn corners() -> usize { let report = SIDES; said::say(report); report }\n\
         #[cfg(test)]\nmod tests { use super::super::circle::unit; }",
    ),
    (
        "report.rs",
        "pub fn say(_: usize) { println!(\"{}\", crate::shapes::square::corners()); }\n\
         pub fn of(_: crate::Circle) {}",
    ),
];

fn read() -> Sources {
    let folder = tempfile::tempdir().expect("a folder");
    let source = folder.path().join("small/src");
    fs::create_dir_all(source.join("shapes")).expect("a folder");
    for (name, text) in FILES {
        fs::write(source.join(name), text).expect("the file is written");
    }
    Sources::read(folder.path(), "small")
}

/// Every item that a file names of another, with the line.
fn named(sources: &Sources) -> Vec<String> {
    let short = |file: usize| sources.files[file].replace("small/src/", "");
    let mut lines = Vec::new();
    for reference in &sources.references {
        if let Target::Item(file, name) = &reference.target
            && *file != reference.file
        {
            let (from, to) = (short(reference.file), short(*file));
            lines.push(format!("{from}:{} {name} of {to}", reference.line));
        }
    }
    lines.sort();
    lines.dedup();
    lines
}

#[test]
fn an_item_counts_as_named_from_the_file_that_defines_it() {
    let expected = [
        "report.rs:1 corners of shapes/square.rs",
        "report.rs:2 Circle of shapes/circle.rs",
        "shapes.rs:6 unit of shapes/circle.rs",
        "shapes/square.rs:3 SIDES of shapes.rs",
        "shapes/square.rs:5 SIDES of shapes.rs",
        "shapes/square.rs:5 say of report.rs",
    ];
    assert_eq!(named(&read()), expected);
}

#[test]
fn paths_into_other_crates_are_expanded_and_texts_are_found() {
    let sources = read();
    let external = |path: &[&str]| Target::External(path.iter().map(ToString::to_string).collect());
    let names = |path: &[&str]| {
        sources
            .references
            .iter()
            .any(|r| r.target == external(path))
    };
    assert!(names(&["std", "fmt", "format"]) && names(&["println"]));
    assert!(
        sources
            .literals
            .iter()
            .any(|literal| literal.line == 2 && literal.text == "SELECT 1")
    );
}

#[test]
fn sentences_and_names_of_fields_are_found_beside_messages() {
    let sources = read();
    let spoken = |may_name: bool| {
        let literals = sources.literals.iter();
        let spoken = literals.filter(move |literal| is_spoken(literal, may_name));
        let texts = spoken.map(|literal| literal.text.as_str());
        texts.collect::<Vec<_>>()
    };
    let expected = ["give `a`", "radius_mm", "it is round"];
    assert_eq!(spoken(false), expected);
    assert_eq!(spoken(true), ["give `a`", "it is round"]);
    let messages = sources.literals.iter().filter(|literal| literal.is_message);
    let messages: Vec<_> = messages.map(|literal| literal.text.as_str()).collect();
    assert_eq!(messages, ["no circle of {0} mm", "a circle has an area"]);
}

#[test]
fn a_cycle_is_reported_with_the_lines_that_make_it() {
    let found = cycles::between_files(&read());
    let lines: Vec<&str> = found
        .iter()
        .flat_map(|v| v.lines.iter().map(String::as_str))
        .collect();
    let expected = [
        "small/src/shapes/square.rs:5 names `say` of small/src/report.rs",
        "small/src/report.rs:1 names `corners` of small/src/shapes/square.rs",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn a_file_and_a_folder_that_need_each_other_are_reported() {
    let found = cycles::between_folders(&read());
    let circles: Vec<&str> = found.iter().map(|circle| circle.what.as_str()).collect();
    assert_eq!(circles, ["small/src/report", "small/src/shapes"]);
}

#[test]
fn public_names_without_a_user_are_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [
        (
            "engine/src/lib.rs",
            "pub fn used() -> Held { Held }\npub struct Held;\npub fn unused() {}\npub(crate) fn hidden() {}\n\
             impl Held { pub fn alone(&self) {} }\n#[cfg(test)]\nmod tests { pub fn fixture() {} }",
        ),
        ("user/main.rs", "fn main() { engine::used(); } // unused"),
    ] {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    assert_eq!(
        surface::unused(folder.path(), "engine/src", &["user"]),
        [
            "engine/src/lib.rs:3: `unused` is public, and no other crate uses it",
            "engine/src/lib.rs:5: `alone` is public, and no other crate uses it"
        ]
    );
}
