-- Remote workers, as the services note them that they are in contact with; times are those by which leases are measured.
CREATE TABLE workers (
    id              TEXT    NOT NULL PRIMARY KEY,
    host            TEXT    NOT NULL,
    slots           INTEGER NOT NULL,
    memory_mb       INTEGER NOT NULL,
    free_memory_mb  INTEGER NOT NULL,
    last_contact_at INTEGER NOT NULL,
    is_draining     INTEGER NOT NULL DEFAULT 0 CHECK (is_draining IN (0, 1))
) STRICT;
