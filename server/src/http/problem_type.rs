//! The table of problem types. A type, once published, is never renamed.

/// Type of a problem: a row of the table below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::http) struct ProblemType {
    pub(in crate::http) status: u16,
    /// Last part of its address, `/problems/{name}`.
    pub(in crate::http) name: &'static str,
    /// Title, the same for every problem of the type.
    pub(in crate::http) title: &'static str,
    /// Meaning and remedy, in Markdown without lists and links.
    pub(in crate::http) explanation: &'static str,
}

/// Declares the types: constant, status, name, title, explanation.
macro_rules! problem_types {
    ($($constant:ident, $status:literal, $name:literal, $title:literal, $explanation:literal;)+) => {
        impl ProblemType {
            $(
                #[doc = concat!("Problem: ", $title, ".")]
                pub(in crate::http) const $constant: Self = Self {
                    status: $status,
                    name: $name,
                    title: $title,
                    explanation: $explanation,
                };
            )+

            /// All types.
            pub(in crate::http) const ALL: &[Self] = &[$(Self::$constant),+];
        }
    };
}

problem_types! {
    UNREADABLE_BODY, 400, "unreadable-body", "the body cannot be read",
        "The body is no JSON document of the expected form. `detail` and `faults` say where. Correct it and send it again.";
    INVALID_SPECIFICATION, 422, "invalid-specification", "the specification has faults",
        "The document was read, but some of its values are outside their limits, contradict each other or ask for more than a job may take. `faults` lists all of them, each with the JSON pointer of its field. `/v1/systems/{kind}` has the limits as JSON Schema.";
    KEY_REUSED, 422, "idempotency-key-reused", "the key was used for another request",
        "A request with the same Idempotency-Key and another body or query was accepted before. Use a new key for another request.";
    INVALID_KEY, 400, "invalid-idempotency-key", "the key is not valid",
        "An Idempotency-Key has 1 to 255 printable ASCII characters.";
    INVALID_QUERY, 400, "invalid-query", "a query parameter is not valid",
        "A parameter of the query or a header is unknown, given twice or not valid; `detail` names it. `/docs` lists the parameters.";
    RANGE, 416, "range", "the range lies outside the file",
        "The requested byte range begins after the end of the file; `Content-Range` has its length.";
    BODY_TOO_LARGE, 413, "body-too-large", "the body is too large",
        "A body has at most 1 MiB. Split a sweep into several, or name its values in a grid instead of a list.";
    MEDIA_TYPE, 415, "media-type", "the body is not declared as JSON",
        "Send the body with `Content-Type: application/json`; `curl --json` does.";
    NO_SUCH_PATH, 404, "no-such-path", "there is no such path",
        "The service has no such path. `/docs` lists all.";
    WRONG_METHOD, 405, "wrong-method", "the path does not support this method",
        "The path exists, but not with this method. `/docs` lists the methods of each.";
    NO_SUCH_JOB, 404, "no-such-job", "there is no such job",
        "No job has this id. It may have been deleted, by a request or after `--keep-days`.";
    NO_SUCH_SWEEP, 404, "no-such-sweep", "there is no such sweep",
        "No sweep has this id. It may have been deleted.";
    NO_SUCH_STUDY, 404, "no-such-study", "there is no such study",
        "No accuracy study has this id. It may have been deleted.";
    STUDY_OUTDATED, 410, "study-outdated", "the study cannot be compared any more",
        "The study was planned by another version of the service, which compared runs in another way. Its jobs and their results are still there; submit the study again for a comparison.";
    NO_SUCH_TOKEN, 404, "no-such-token", "there is no such token",
        "No token for workers has this id. `/v1/worker-tokens` lists all.";
    NO_SUCH_RESULT, 404, "no-such-result", "the job has no such result",
        "The job has not produced this result, or not yet. `/v1/jobs/{id}/results` lists what there is.";
    NO_SUCH_SYSTEM, 404, "no-such-system", "there is no such system",
        "`/v1/systems` lists the kinds of contact system.";
    JOB_ACTIVE, 409, "job-active", "the job has not ended",
        "The job is queued or running. Wait for its end or cancel it first.";
    JOB_SUCCEEDED, 409, "job-succeeded", "the job has succeeded",
        "A job that has succeeded is not solved again: the result would be the same. Submit another one for another specification.";
    SWEEP_ACTIVE, 409, "sweep-active", "the sweep has jobs that have not ended",
        "Jobs of the sweep are queued or running. Wait for their end or cancel the sweep first.";
    STUDY_ACTIVE, 409, "study-active", "the study has jobs that have not ended",
        "Jobs of the study are queued or running. Wait for their end or cancel the study first.";
    INVALID_HOST, 400, "invalid-host", "the Host header is missing or repeated",
        "HTTP/1.1 requires exactly one Host header.";
    FOREIGN_HOST, 403, "foreign-host", "the request is for another host",
        "The Host or Origin header names another host than the service accepts, which protects browsers from pages of other hosts. Start the service with `--allowed-host NAME` to accept a name.";
    WORKER_VERSION, 409, "worker-version", "the worker is of another version",
        "A remote worker has the version and commit of the service, so that every job has the same bits wherever it is solved. Install the version that `detail` names for the service on the worker's machine.";
    WORKER_DRAINED, 409, "worker-drained", "the worker takes no more jobs",
        "The worker was drained by `POST /v1/workers/{id}/drain`. It ends by itself when it has solved the jobs that it holds.";
    NO_SUCH_WORKER, 404, "no-such-worker", "there is no such worker",
        "No remote worker of this id was in contact within the last minute. A worker has another id after each start; `/v1/workers` lists them.";
    LEASE_LOST, 409, "lease-lost", "the worker does not hold the job any more",
        "The lease of a worker has ended, and its job was given to another one. The worker gives the attempt up by itself.";
    FILE_DIFFERS, 422, "file-differs", "a file was not received as it was sent",
        "A worker sent a file of a result that arrived with another SHA-256. The worker sends it again by itself.";
    TOKEN_REQUIRED, 401, "token-required", "the access token is missing or wrong",
        "Send the access token of the service as `Authorization: Bearer TOKEN`.";
    REQUEST_TIMEOUT, 408, "request-timeout", "the request did not arrive in time",
        "The body of a request was 30 s behind a rate of 64 KiB a second. Send it again.";
    BUSY, 503, "busy", "the service cannot take the request at present",
        "More requests, streams or archives are open than the service allows, bodies of other requests need the memory for this one, or the database is busy. Send the request again after the time in `Retry-After`.";
    DISK_FULL, 503, "disk-full", "the data disk is full",
        "The disk of the database has too little free space to store anything. Jobs wait and continue by themselves; cancelling and deleting still work. Free space on it, or delete jobs.";
    RESULT_DAMAGED, 500, "result-damaged", "a stored result is damaged",
        "The stored bytes of a result differ from its length or SHA-256 in the manifest, so they are not sent. Restore the file from a backup (`fretwear verify` lists all that are damaged), or submit the job again: the same specification gives the same bits.";
    RESULTS_UNREACHABLE, 503, "results-unreachable", "the results cannot be read at present",
        "The results of this job are in a store of objects (`--objects`), which does not answer. Jobs are solved all the same, and their results stay in the database until it answers. Send the request again after the time in `Retry-After`.";
    TASK_FAILING, 503, "task-failing", "a task of the service fails repeatedly",
        "A task inside the service ended repeatedly and is restarted each time; `detail` names it, the log of the service says why.";
    WORKERS_FAILING, 503, "workers-failing", "no job can be started here",
        "The solving process of a job could not be started on the machine of the service, or had no space for its files; `detail` says why. The job has gone back to the queue without an attempt lost, for other workers or a later try: the service tries again after pauses that grow up to a minute. Repair the machine; a service that was replaced while it ran is best restarted.";
    INTERNAL, 500, "internal", "internal error",
        "An error of the service, or of its machine. The cause is in the log of the service, not in the answer. Send the request again; if it fails again, report it with the log.";
}
