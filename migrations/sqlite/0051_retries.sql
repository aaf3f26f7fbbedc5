-- When a job was submitted or queued again by its user: its deadline counts from then.
ALTER TABLE jobs ADD COLUMN queued_at INTEGER NOT NULL DEFAULT 0;

UPDATE jobs SET queued_at = created_at;
