-- That a job waits for disk space is no longer stored.
UPDATE jobs SET status_reason = 'waiting for a worker', version = version + 1
WHERE status = 'queued' AND status_reason LIKE 'waiting for disk space: %';
