-- Specifications of jobs as they were sent; jobs of earlier versions have none.
CREATE TABLE sent_specifications (
    job_id TEXT NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    spec   TEXT NOT NULL
) STRICT;

-- The base specification of a batch, as it was sent.
ALTER TABLE sweeps ADD COLUMN base TEXT;
UPDATE sweeps SET base = (SELECT request -> '$.base' FROM expansions WHERE sweep_id = sweeps.id);
