-- The time that the services had seen pass when a batch was submitted, ms: one without jobs is retained as long as a job is. Batches that
-- were there before this migration are retained as if they had been submitted with it.
ALTER TABLE sweeps ADD COLUMN submitted_ms bigint NOT NULL DEFAULT 0;
UPDATE sweeps SET submitted_ms = (SELECT passed_ms FROM service_time);
