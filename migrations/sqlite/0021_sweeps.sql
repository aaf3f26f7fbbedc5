-- Sweeps: jobs that were submitted together, as variations of one specification.
CREATE TABLE sweeps (
    id          TEXT    NOT NULL PRIMARY KEY,
    name        TEXT,
    created_at  INTEGER NOT NULL,
    request_key TEXT    UNIQUE,
    body_sha256 BLOB    CHECK (length(body_sha256) = 32),
    CHECK ((request_key IS NULL) = (body_sha256 IS NULL))
) STRICT;

-- `overrides` says what sets a job apart: a map of JSON pointer to value.
CREATE TABLE sweep_jobs (
    sweep_id  TEXT    NOT NULL REFERENCES sweeps (id) ON DELETE CASCADE,
    position  INTEGER NOT NULL,
    job_id    TEXT    NOT NULL UNIQUE REFERENCES jobs (id) ON DELETE CASCADE,
    overrides TEXT    NOT NULL CHECK (json_valid(overrides)),
    PRIMARY KEY (sweep_id, position)
) STRICT, WITHOUT ROWID;
