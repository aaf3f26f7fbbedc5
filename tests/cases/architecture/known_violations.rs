//! What still contradicts the rules.

/// Sentence of the rule, and the files that contradict it. **This list only shrinks**: an entry that is no longer
/// violated fails the test until it is deleted.
pub(super) const KNOWN_VIOLATIONS: [(&str, &str); 88] = [
    ("laws know no mesh", "solver/src/law does not exist"),
    ("`mesh` knows no law", "solver/src/law does not exist"),
    (
        "storage does not know evaluation",
        "server/src/store/sqlite/studies.rs -> server/src/batch/accuracy/grid.rs",
    ),
    (
        "one file per route",
        "server/src/http/routes/operation/health.rs -> a second route",
    ),
    (
        "one file per route",
        "server/src/http/routes/operation/pages.rs -> a second route",
    ),
    (
        "one file per route",
        "server/src/http/routes/systems/read.rs -> a second route",
    ),
    ("no two files need each other", "api/src/job.rs"),
    ("no two files need each other", "api/src/results/summary.rs"),
    ("no two files need each other", "solver/src/ale.rs"),
    (
        "no two files need each other",
        "solver/src/cycle/cycle_record.rs",
    ),
    ("no two files need each other", "solver/src/cycle/path.rs"),
    ("no two files need each other", "solver/src/cycle/state.rs"),
    ("no two files need each other", "solver/src/fields.rs"),
    ("no two files need each other", "solver/src/history.rs"),
    ("no two files need each other", "solver/src/contact.rs"),
    (
        "no two files need each other",
        "solver/src/contact/newton.rs",
    ),
    (
        "no two files need each other",
        "solver/src/contact/response.rs",
    ),
    (
        "no two files need each other",
        "solver/src/contact/status.rs",
    ),
    ("no two files need each other", "solver/src/cycle.rs"),
    ("no two files need each other", "solver/src/cycle/probe.rs"),
    (
        "no two files need each other",
        "server/src/batch/accuracy.rs",
    ),
    (
        "no two files need each other",
        "server/src/batch/accuracy/process.rs",
    ),
    (
        "no two files need each other",
        "server/src/batch/accuracy/reference.rs",
    ),
    ("no two files need each other", "server/src/cli.rs"),
    ("no two files need each other", "server/src/cli/backup.rs"),
    ("no two files need each other", "server/src/cli/bench.rs"),
    ("no two files need each other", "server/src/cli/child.rs"),
    ("no two files need each other", "server/src/cli/demo.rs"),
    ("no two files need each other", "server/src/cli/export.rs"),
    ("no two files need each other", "server/src/cli/options.rs"),
    ("no two files need each other", "server/src/cli/plan.rs"),
    ("no two files need each other", "server/src/cli/probe.rs"),
    ("no two files need each other", "server/src/cli/serve.rs"),
    ("no two files need each other", "server/src/cli/solve.rs"),
    ("no two files need each other", "server/src/cli/study.rs"),
    ("no two files need each other", "server/src/cli/terminal.rs"),
    (
        "no two files need each other",
        "server/src/estimate/machine.rs",
    ),
    (
        "no two files need each other",
        "server/src/estimate/machine/cache.rs",
    ),
    (
        "no two files need each other",
        "server/src/estimate/machine/calibration.rs",
    ),
    ("no two files need each other", "server/src/http.rs"),
    ("no two files need each other", "server/src/http/extract.rs"),
    (
        "no two files need each other",
        "server/src/http/job_error.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/cancel_study.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/cancel_sweep.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/list_sweeps.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/remove_sweep.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/show_study.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/show_sweep.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/study_picture.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/study_table.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/submit_study.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/submit_sweep.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/batches/sweep_outcomes.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/cancel.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/delete.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/list.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/make_plan.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/show.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/stream_events.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/jobs/submit.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/operation/health.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/operation/metrics.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/operation/openapi.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/operation/pages.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/archive.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/download.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/friction_loop.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/list.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/pressure.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/profile.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/stored_part.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/results/wear_history.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/systems/read.rs",
    ),
    (
        "no two files need each other",
        "server/src/http/routes/systems/schema.rs",
    ),
    ("no two files need each other", "server/src/store.rs"),
    (
        "no two files need each other",
        "server/src/store/sqlite/checkpoints.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/conclusion.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/document.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/files.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/jobs.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/leases.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/queries.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/submissions.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/studies.rs",
    ),
    (
        "no two files need each other",
        "server/src/store/sqlite/sweeps.rs",
    ),
    ("no two files need each other", "server/src/worker.rs"),
    (
        "no two files need each other",
        "server/src/worker/ending.rs",
    ),
    (
        "no two files need each other",
        "server/src/worker/supervisor.rs",
    ),
];
