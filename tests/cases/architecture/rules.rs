//! Rules between the folders of a crate, each with its sentence.

use std::fmt;

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

/// Folders and files are given from the root of the workspace without `.rs`: `solver/src/mesh` is `solver/src/mesh.rs`
/// and all below `solver/src/mesh/`.
enum Rule {
    /// No file of the first places names an item that a file of the second places defines; these may name each other.
    MustNotName(&'static [&'static str], &'static [&'static str]),
    /// Paths that begin so occur only in these places of the crate.
    OnlyIn(
        &'static str,
        &'static [&'static str],
        &'static [&'static str],
    ),
    /// Paths that begin with the first name but not with the second occur only in these places of the crate.
    OnlyInExcept(
        &'static str,
        &'static str,
        &'static str,
        &'static [&'static str],
    ),
    /// No path of the crate has one of these names in it.
    Nowhere(&'static str, &'static [&'static str]),
    /// Texts that begin so occur only in these places of the crate.
    TextOnlyIn(
        &'static str,
        &'static [&'static str],
        &'static [&'static str],
    ),
    /// A file of these places holds the handler of one route at most, unless one implementation serves several paths
    /// ([`SEVERAL_PATHS`]).
    OneRoute(&'static [&'static str]),
}

use Rule::{MustNotName, Nowhere, OneRoute, OnlyIn, OnlyInExcept, TextOnlyIn};

/// Route files whose one implementation serves several paths.
const SEVERAL_PATHS: [&str; 11] = [
    // Both kinds of batches: `/v1/sweeps` and `/v1/studies`.
    "server/src/http/routes/batches/cancel.rs",
    "server/src/http/routes/batches/delete.rs",
    "server/src/http/routes/batches/list.rs",
    "server/src/http/routes/batches/outcomes.rs",
    "server/src/http/routes/batches/retry.rs",
    "server/src/http/routes/batches/show.rs",
    "server/src/http/routes/batches/show_base.rs",
    "server/src/http/routes/batches/submit.rs",
    // The three parts of a snapshot.
    "server/src/http/routes/results/read_snapshot.rs",
    // Liveness and readiness.
    "server/src/http/routes/operation/check_health.rs",
    // The pages and their assets, all embedded files.
    "server/src/http/routes/operation/serve_pages.rs",
];

const RULES: [(&str, Rule); 21] = [
    (
        "laws know no mesh",
        MustNotName(
            &["solver/src/law"],
            &["solver/src/mesh", "solver/src/element", "solver/src/model"],
        ),
    ),
    (
        "`mesh` knows no law",
        MustNotName(&["solver/src/mesh"], &["solver/src/law"]),
    ),
    (
        "`contact` knows operators, not meshes",
        MustNotName(
            &["solver/src/contact"],
            &["solver/src/mesh", "solver/src/element", "solver/src/ale"],
        ),
    ),
    (
        "contacts of half-spaces know neither meshes nor contacts of lines, and share laws with them",
        MustNotName(
            &["solver/src/point", "solver/src/contact/area"],
            &[
                "solver/src/mesh",
                "solver/src/model",
                "solver/src/condensation",
                "solver/src/cycle",
                "solver/src/contact/line",
            ],
        ),
    ),
    (
        "stations know the plane contact and its schedule, but not the run of a plane scene or what it reports",
        MustNotName(
            &["solver/src/station"],
            &[
                "solver/src/checkpoint",
                "solver/src/forecast",
                "solver/src/point",
                "solver/src/record",
                "solver/src/run",
            ],
        ),
    ),
    (
        "the plane contact does not know stations",
        MustNotName(
            &[
                "solver/src/condensation",
                "solver/src/contact",
                "solver/src/cycle",
                "solver/src/model",
                "solver/src/schedule",
            ],
            &["solver/src/station"],
        ),
    ),
    (
        "extruded bodies know the contact of node planes and its schedule, but not the run of a plane scene or what it reports",
        MustNotName(
            &["solver/src/extruded"],
            &[
                "solver/src/checkpoint",
                "solver/src/forecast",
                "solver/src/point",
                "solver/src/record",
                "solver/src/run",
                "solver/src/station",
            ],
        ),
    ),
    (
        "the plane contact knows neither extruded bodies nor the contact of their planes",
        MustNotName(
            &[
                "solver/src/contact/line",
                "solver/src/cycle",
                "solver/src/model",
                "solver/src/record",
                "solver/src/schedule",
                "solver/src/station",
            ],
            &[
                "solver/src/condensation/extruded",
                "solver/src/contact/planes",
                "solver/src/extruded",
            ],
        ),
    ),
    (
        "operators and the contact of node planes do not know the run of extruded bodies",
        MustNotName(
            &["solver/src/condensation", "solver/src/contact"],
            &["solver/src/extruded"],
        ),
    ),
    (
        "only `error_control` knows `run`, and nothing knows `error_control`",
        MustNotName(
            &["solver/src"],
            &["solver/src/run", "solver/src/error_control"],
        ),
    ),
    (
        "`faer` is named only in `linear` and `condensation`",
        OnlyIn(
            "solver",
            &["faer"],
            &["solver/src/linear", "solver/src/condensation"],
        ),
    ),
    (
        "the same scene gives the same bits: no order of hashes in `solver`",
        Nowhere("solver", &["HashMap", "HashSet", "RandomState"]),
    ),
    (
        "`solver` knows no clock, file, environment, network, process or terminal",
        OnlyIn(
            "solver",
            &[
                "std::time",
                "std::fs",
                "std::env",
                "std::net",
                "std::process",
                "std::io",
                "println",
                "eprintln",
                "print",
                "eprint",
                "dbg",
            ],
            &[],
        ),
    ),
    (
        "sqlx is named only under `store/`",
        OnlyIn("server", &["sqlx"], &["server/src/store"]),
    ),
    (
        "SQL text stands only under `store/`",
        TextOnlyIn(
            "server",
            &[
                "SELECT ",
                "INSERT ",
                "UPDATE ",
                "DELETE FROM ",
                "CREATE ",
                "ALTER ",
                "DROP ",
                "WITH ",
                "PRAGMA ",
                "VACUUM",
                "BEGIN",
            ],
            &["server/src/store"],
        ),
    ),
    (
        "storage does not know evaluation",
        MustNotName(&["server/src/store"], &["server/src/batch"]),
    ),
    (
        "storage does not know HTTP, workers or the command line",
        MustNotName(
            &["server/src/store"],
            &[
                "server/src/http",
                "server/src/worker",
                "server/src/cli",
                "server/src/service",
            ],
        ),
    ),
    (
        "HTTP, queue, store and workers know of the engine only its records",
        OnlyInExcept(
            "server",
            "solver",
            "solver::record",
            &[
                "server/src/batch",
                "server/src/cli",
                "server/src/estimate",
                "server/src/export",
                "server/src/rating",
                "server/src/solve",
                "server/src/spec",
            ],
        ),
    ),
    (
        "only the command line and the service know the routes",
        MustNotName(
            &[
                "server/src/batch",
                "server/src/estimate",
                "server/src/export",
                "server/src/queue",
                "server/src/reference",
                "server/src/solve",
                "server/src/spec",
                "server/src/worker",
            ],
            &["server/src/http"],
        ),
    ),
    (
        "the client knows nothing of the service but the wire contract",
        MustNotName(
            &["server/src/client"],
            &[
                "server/src/batch",
                "server/src/cli",
                "server/src/http",
                "server/src/queue",
                "server/src/service",
                "server/src/spec",
                "server/src/worker",
            ],
        ),
    ),
    ("one file per route", OneRoute(&["server/src/http/routes"])),
];

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
