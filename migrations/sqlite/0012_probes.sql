-- What is written only to see that the database can be written.
CREATE TABLE probes (
    name       TEXT    NOT NULL PRIMARY KEY,
    written_at INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
