-- The worker that has lost or declined a job that waits again, and until when the job is left to others.
ALTER TABLE jobs ADD COLUMN avoided_worker TEXT;
ALTER TABLE jobs ADD COLUMN avoided_until INTEGER;
DROP INDEX jobs_waiting;
CREATE INDEX jobs_waiting ON jobs (place, id, status, memory_mb, queued_at, cpu_ms, avoided_worker, avoided_until) WHERE status = 'queued';
