-- Claims of a job since its last new checkpoint, without the released ones: only these count toward the limit of attempts.
ALTER TABLE jobs ADD COLUMN fruitless INTEGER NOT NULL DEFAULT 0;

UPDATE jobs SET fruitless = attempts WHERE status IN ('queued', 'running');
