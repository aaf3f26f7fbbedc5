//! What contradicts the rules between the folders of a crate.

use std::fmt;

use super::rules::Rule::{self, MustNotName, Nowhere, OneRoute, OnlyIn, OnlyInExcept, TextOnlyIn};
use super::rules::{RULES, SEVERAL_PATHS};
use super::sources::{Sources, Target};

/// Something that contradicts a rule.
pub(super) struct Violation {
    pub(super) rule: &'static str,
    /// The files concerned.
    pub(super) what: String,
    /// The lines that contradict the rule, and why.
    pub(super) lines: Vec<String>,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.rule, self.what)?;
        self.lines
            .iter()
            .try_for_each(|line| write!(f, "\n    {line}"))
    }
}

/// Everything in the crates that contradicts a rule, one entry for each pair of files or names.
pub(super) fn violations(crates: &[Sources]) -> Vec<Violation> {
    let mut found: Vec<Violation> = Vec::new();
    for (sentence, rule) in &RULES {
        for place in places(rule) {
            if !crates
                .iter()
                .any(|s| s.files.iter().any(|f| lies_in(f, place)))
            {
                add(
                    &mut found,
                    sentence,
                    format!("{place} does not exist"),
                    None,
                );
            }
        }
        for sources in crates {
            check(sentence, rule, sources, &mut found);
        }
    }
    found
}

fn places(rule: &Rule) -> Vec<&'static str> {
    match rule {
        MustNotName(from, to) => [*from, *to].concat(),
        OnlyIn(_, _, places)
        | OnlyInExcept(_, _, _, places)
        | TextOnlyIn(_, _, places)
        | OneRoute(places) => places.to_vec(),
        Nowhere(..) => Vec::new(),
    }
}

fn check(sentence: &'static str, rule: &Rule, sources: &Sources, found: &mut Vec<Violation>) {
    let within = |file: usize, places: &[&str]| {
        places
            .iter()
            .any(|place| lies_in(&sources.files[file], place))
    };
    let mut report = |file: usize, what: &str, line: usize| {
        let file = &sources.files[file];
        add(
            found,
            sentence,
            format!("{file} -> {what}"),
            Some(format!("{file}:{line} names {what}")),
        );
    };
    match rule {
        MustNotName(from, to) => {
            for reference in &sources.references {
                if let Target::Item(defined, _) = &reference.target
                    && within(reference.file, from)
                    && within(*defined, to)
                    && !(within(reference.file, to))
                {
                    report(reference.file, &sources.files[*defined], reference.line);
                }
            }
        }
        OnlyIn(name, starts, places) if sources.name == *name => {
            for reference in &sources.references {
                if let Target::External(path) = &reference.target
                    && !within(reference.file, places)
                    && let Some(start) = starts.iter().find(|start| begins(path, start))
                {
                    report(reference.file, start, reference.line);
                }
            }
        }
        OnlyInExcept(name, start, except, places) if sources.name == *name => {
            for reference in &sources.references {
                if let Target::External(path) = &reference.target
                    && !within(reference.file, places)
                    && begins(path, start)
                    && !begins(path, except)
                {
                    report(reference.file, start, reference.line);
                }
            }
        }
        Nowhere(name, names) if sources.name == *name => {
            for reference in &sources.references {
                if let Target::External(path) = &reference.target
                    && let Some(name) = names.iter().find(|name| path.iter().any(|s| s == *name))
                {
                    report(reference.file, name, reference.line);
                }
            }
        }
        TextOnlyIn(name, starts, places) if sources.name == *name => {
            for (file, line, text) in &sources.literals {
                if !within(*file, places)
                    && let Some(start) = starts
                        .iter()
                        .find(|start| text.trim_start().starts_with(*start))
                {
                    report(*file, start, *line);
                }
            }
        }
        OneRoute(places) => {
            for (i, (file, line)) in sources.routes.iter().enumerate() {
                let before = sources.routes[..i].iter().any(|(other, _)| other == file);
                let several = SEVERAL_PATHS.contains(&sources.files[*file].as_str());
                if before && !several && within(*file, places) {
                    report(*file, "a second route", *line);
                }
            }
        }
        _ => {}
    }
}

/// Adds a line to the violation of the same rule by the same files, or begins one.
fn add(found: &mut Vec<Violation>, rule: &'static str, what: String, line: Option<String>) {
    match found.iter_mut().find(|v| v.rule == rule && v.what == what) {
        Some(violation) => violation.lines.extend(line),
        None => found.push(Violation {
            rule,
            what,
            lines: line.into_iter().collect(),
        }),
    }
}

/// Checks whether a path begins with these names, separated by `::`.
fn begins(path: &[String], start: &str) -> bool {
    let mut names = path.iter();
    start
        .split("::")
        .all(|name| names.next().is_some_and(|n| n == name))
}

/// Checks whether a file belongs to a place.
fn lies_in(file: &str, place: &str) -> bool {
    file.strip_prefix(place)
        .is_some_and(|rest| rest == ".rs" || rest.starts_with('/'))
}
