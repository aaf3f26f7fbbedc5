-- The process that serves the database, and its heartbeats, so that a second one is found that came past the lock file.
CREATE TABLE owner (
    one INTEGER PRIMARY KEY CHECK (one = 1),
    id TEXT NOT NULL,
    process TEXT NOT NULL,
    beats INTEGER NOT NULL
) STRICT;
