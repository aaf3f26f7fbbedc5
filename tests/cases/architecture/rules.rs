//! Rules between the folders of a crate, each with its sentence.

/// Folders and files are given from the root of the workspace without `.rs`: `solver/src/mesh` is `solver/src/mesh.rs`
/// and all below `solver/src/mesh/`.
pub(super) enum Rule {
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
    /// Texts of the crate are neither sentences nor in backticks, messages of errors and of broken invariants may be sentences; names with
    /// underscores occur only in these places.
    NoSentences(&'static str, &'static [&'static str]),
    /// A file of these places holds the handler of one route at most, unless one implementation serves several paths
    /// ([`SEVERAL_PATHS`]).
    OneRoute(&'static [&'static str]),
}

use Rule::{MustNotName, NoSentences, Nowhere, OneRoute, OnlyIn, OnlyInExcept, TextOnlyIn};

/// Route files whose one implementation serves several paths.
pub(super) const SEVERAL_PATHS: [&str; 11] = [
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

pub(super) const RULES: [(&str, Rule); 23] = [
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
        "`solver` speaks no sentences and no names of JSON fields, names of recorded channels excepted",
        NoSentences("solver", &["solver/src/record"]),
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
                "server/src/words",
            ],
        ),
    ),
    (
        "sentences about the engine know nothing of the service or of specifications",
        MustNotName(
            &["server/src/words"],
            &[
                "server/src/batch",
                "server/src/cli",
                "server/src/estimate",
                "server/src/export",
                "server/src/http",
                "server/src/solve",
                "server/src/spec",
                "server/src/store",
                "server/src/worker",
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
