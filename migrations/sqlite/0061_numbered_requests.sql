-- Requests of workers are numbered, so that one that is repeated, because its answer was lost, has no further effect: the last
-- write under the present lease, and the claim that took the job.
ALTER TABLE jobs ADD COLUMN last_write INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN worker TEXT;
ALTER TABLE jobs ADD COLUMN claim_number INTEGER;
-- Whether the worker is another process, which lives on when the service ends.
ALTER TABLE jobs ADD COLUMN is_remote INTEGER NOT NULL DEFAULT 0 CHECK (is_remote IN (0, 1));

-- Processor time that its plan expects, ms: short jobs are claimed several at a time, and the sum is the demand.
ALTER TABLE jobs ADD COLUMN cpu_ms INTEGER NOT NULL DEFAULT 0;

UPDATE jobs SET cpu_ms = CAST(1000 * COALESCE(json_extract(plan, '$.estimates.cpu_s'), 0) AS INTEGER)
    WHERE status IN ('queued', 'running');

CREATE INDEX jobs_by_claim ON jobs (worker, claim_number) WHERE status = 'running';
