-- The manifest: what a job produced, by name. A small document is kept here; a large one is a file in the folder beside
-- the database, at a place inside that folder that the service made up itself.
CREATE TABLE result_files (
    job_id     TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    name       TEXT    NOT NULL,
    cycle      INTEGER,
    media_type TEXT    NOT NULL,
    bytes      INTEGER NOT NULL CHECK (bytes >= 0),
    sha256     TEXT    NOT NULL CHECK (length(sha256) = 64),
    content    BLOB,
    place      TEXT    UNIQUE,
    PRIMARY KEY (job_id, name),
    CHECK ((content IS NULL) <> (place IS NULL))
) STRICT;
