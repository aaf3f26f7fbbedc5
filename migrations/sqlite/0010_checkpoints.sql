-- The newest checkpoint of a job: from where another attempt goes on. `lease` is the one that wrote it; the checksum is
-- looked at before anything is kept that was computed up to it.
CREATE TABLE checkpoints (
    job_id     TEXT    NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    lease      INTEGER NOT NULL,
    cycle      INTEGER NOT NULL CHECK (cycle >= 0),
    written_at INTEGER NOT NULL,
    sha256     BLOB    NOT NULL CHECK (length(sha256) = 32),
    state      BLOB    NOT NULL
) STRICT, WITHOUT ROWID;
