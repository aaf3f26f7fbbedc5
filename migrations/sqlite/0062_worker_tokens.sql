-- Tokens of remote workers, which reach `/v1/worker/` only. Only their SHA-256 is stored.
CREATE TABLE worker_tokens (
    id         TEXT    NOT NULL PRIMARY KEY,
    name       TEXT    NOT NULL,
    sha256     BLOB    NOT NULL UNIQUE,
    created_at INTEGER NOT NULL,
    revoked_at INTEGER
) STRICT;
