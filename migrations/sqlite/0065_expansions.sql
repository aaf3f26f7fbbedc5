-- A sweep may have more jobs than are in the queue at once: those from position `next` on are made from its request while others are
-- solved, until `is_over`.
CREATE TABLE expansions (
    sweep_id TEXT    NOT NULL PRIMARY KEY REFERENCES sweeps (id) ON DELETE CASCADE,
    request  TEXT    NOT NULL CHECK (json_valid(request)),
    jobs     INTEGER NOT NULL,
    next     INTEGER NOT NULL CHECK (next BETWEEN 0 AND jobs),
    cpu_ms   INTEGER NOT NULL,
    refused  INTEGER NOT NULL DEFAULT 0,
    is_over  INTEGER NOT NULL DEFAULT 0
) STRICT;

-- The first combinations of values that make no valid job; `refused` is the number of all.
CREATE TABLE refused_jobs (
    sweep_id  TEXT    NOT NULL REFERENCES sweeps (id) ON DELETE CASCADE,
    position  INTEGER NOT NULL,
    overrides TEXT    NOT NULL CHECK (json_valid(overrides)),
    reason    TEXT    NOT NULL,
    PRIMARY KEY (sweep_id, position)
) STRICT, WITHOUT ROWID;

-- The jobs of a sweep are counted by status, those that have not ended are found, and all are listed in their order, from indexes.
ALTER TABLE jobs ADD COLUMN sweep_id TEXT;
UPDATE jobs SET sweep_id = (SELECT sweep_id FROM sweep_jobs WHERE job_id = jobs.id) WHERE id IN (SELECT job_id FROM sweep_jobs);
CREATE INDEX jobs_by_sweep ON jobs (sweep_id, status, id) WHERE sweep_id IS NOT NULL;
CREATE INDEX jobs_in_sweep ON jobs (sweep_id, id) WHERE sweep_id IS NOT NULL;
