-- Keys that clients gave to their submissions (`Idempotency-Key`), so that a request sent twice makes one job.
CREATE TABLE request_keys (
    key         TEXT NOT NULL PRIMARY KEY,
    body_sha256 BLOB NOT NULL CHECK (length(body_sha256) = 32),
    job_id      TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;

CREATE INDEX request_keys_by_job ON request_keys (job_id);
