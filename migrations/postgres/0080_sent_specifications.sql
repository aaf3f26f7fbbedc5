-- Specifications of jobs as they were sent; jobs of earlier versions have none.
CREATE TABLE sent_specifications (
    job_id uuid NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    spec   text NOT NULL
);

-- The base specification of a batch, as it was sent.
ALTER TABLE sweeps ADD COLUMN base text;
UPDATE sweeps SET base = (SELECT (request::json -> 'base')::text FROM expansions WHERE sweep_id = sweeps.id);
