-- The order of all changes: each change of a job that its document shows gives it the next revision, and so does its
-- deletion, so that a client that knows one revision is told what has changed since.
CREATE TABLE revisions (
    name TEXT    NOT NULL PRIMARY KEY CHECK (name = 'jobs'),
    last INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

INSERT INTO revisions (name, last) VALUES ('jobs', 0);

ALTER TABLE jobs ADD COLUMN revision INTEGER NOT NULL DEFAULT 0;
CREATE INDEX jobs_by_revision ON jobs (revision);

-- Deletions among the last million revisions.
CREATE TABLE deleted_jobs (
    revision INTEGER NOT NULL PRIMARY KEY,
    id       TEXT    NOT NULL
) STRICT;

CREATE TRIGGER jobs_revised_on_insert AFTER INSERT ON jobs BEGIN
    UPDATE revisions SET last = last + 1;
    UPDATE jobs SET revision = (SELECT last FROM revisions) WHERE id = NEW.id;
END;

CREATE TRIGGER jobs_revised_on_change AFTER UPDATE OF version ON jobs BEGIN
    UPDATE revisions SET last = last + 1;
    UPDATE jobs SET revision = (SELECT last FROM revisions) WHERE id = NEW.id;
END;

CREATE TRIGGER jobs_revised_on_delete AFTER DELETE ON jobs BEGIN
    UPDATE revisions SET last = last + 1;
    INSERT INTO deleted_jobs (revision, id) SELECT last, OLD.id FROM revisions;
    DELETE FROM deleted_jobs WHERE revision <= (SELECT last FROM revisions) - 1000000;
END;
