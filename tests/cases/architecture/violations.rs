//! What contradicts the rules between the folders of a crate.

use std::fmt;

use super::rules::Rule::{
    self, MustNotName, NoSentences, Nowhere, OneRoute, OnlyIn, OnlyInExcept, TextOnlyIn,
};
use super::rules::{RULES, SEVERAL_PATHS};
use super::sources::{Literal, Sources, Target};

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
        | NoSentences(_, places)
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
            for literal in sources.literals.iter().filter(|text| !text.is_message) {
                if !within(literal.file, places)
                    && let Some(start) = starts
                        .iter()
                        .find(|start| literal.text.trim_start().starts_with(*start))
                {
                    report(literal.file, start, literal.line);
                }
            }
        }
        NoSentences(name, places) if sources.name == *name => {
            for literal in &sources.literals {
                if is_spoken(literal, within(literal.file, places)) {
                    report(literal.file, &literal.text, literal.line);
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

/// Checks whether a text is a sentence, has a name in backticks, or is a name with underscores that may not occur.
pub(super) fn is_spoken(literal: &Literal, may_name: bool) -> bool {
    let text = &literal.text;
    let words = text.split_whitespace();
    let words = words.filter(|word| word.contains(char::is_alphabetic));
    let of_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_{}".contains(c);
    let is_name = text.contains('_') && text.chars().all(of_name);
    text.contains('`') || !literal.is_message && (words.count() > 1 || is_name && !may_name)
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
