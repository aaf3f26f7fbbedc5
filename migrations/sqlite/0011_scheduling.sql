-- What decides when a job is taken: `place` is the time of its submission moved by its priority, so that order and
-- ageing are one index; `memory_mb` is what its plan expects it to need.
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN place INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN deadline_at INTEGER;
ALTER TABLE jobs ADD COLUMN memory_mb INTEGER NOT NULL DEFAULT 0;

UPDATE jobs SET place = created_at;

DROP INDEX jobs_waiting;
CREATE INDEX jobs_by_place ON jobs (place, id) WHERE status = 'queued';
CREATE INDEX jobs_by_deadline ON jobs (deadline_at) WHERE status = 'queued' AND deadline_at IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs (finished_at) WHERE finished_at IS NOT NULL;
