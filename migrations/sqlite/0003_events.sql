-- Events of a job; `seq` counts from 1 without gaps and is the id of the event stream.
CREATE TABLE events (
    job_id TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    seq    INTEGER NOT NULL CHECK (seq > 0),
    name   TEXT    NOT NULL,
    data   TEXT    NOT NULL CHECK (json_valid(data)),
    PRIMARY KEY (job_id, seq)
) STRICT, WITHOUT ROWID;
