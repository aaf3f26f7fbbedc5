-- The queue is read from indexes that have all of it, which the queries name: rows of jobs are long, and a claim must not read those of
-- all waiting jobs.
DROP INDEX jobs_by_place;
CREATE INDEX jobs_waiting ON jobs (place, id, status, memory_mb, queued_at, cpu_ms) WHERE status = 'queued';
CREATE INDEX jobs_running ON jobs (is_remote, status) WHERE status = 'running';
