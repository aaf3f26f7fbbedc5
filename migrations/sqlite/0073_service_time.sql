-- Time that the services of this database have seen pass, ms, and the time by which it was last counted. Retention is measured by it, because
-- the system's clock may be wrong.
CREATE TABLE service_time (
    id         INTEGER NOT NULL PRIMARY KEY CHECK (id = 1),
    passed_ms  INTEGER NOT NULL,
    counted_at INTEGER NOT NULL
) STRICT;
INSERT INTO service_time (id, passed_ms, counted_at) VALUES (1, 0, 0);

-- The same at the end of a job. Jobs that ended before this migration are retained as if they had ended with it.
ALTER TABLE jobs ADD COLUMN ended_ms INTEGER NOT NULL DEFAULT 0;
DROP INDEX jobs_by_end;
CREATE INDEX jobs_by_end ON jobs (ended_ms, finished_at) WHERE finished_at IS NOT NULL;
