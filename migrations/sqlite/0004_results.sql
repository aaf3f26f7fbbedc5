-- Results that are polled while a job runs: rows of the wear history, and the documents stored at snapshots.
CREATE TABLE history_rows (
    job_id TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    cycle  INTEGER NOT NULL,
    data   TEXT    NOT NULL CHECK (json_valid(data)),
    PRIMARY KEY (job_id, cycle)
) STRICT, WITHOUT ROWID;

CREATE TABLE snapshots (
    job_id        TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    cycle         INTEGER NOT NULL,
    profile       TEXT    NOT NULL CHECK (json_valid(profile)),
    pressure      TEXT    NOT NULL CHECK (json_valid(pressure)),
    friction_loop TEXT    NOT NULL CHECK (json_valid(friction_loop)),
    PRIMARY KEY (job_id, cycle)
) STRICT;
