-- Lists of one kind of system, newest first; counts and ages by status without reading the jobs.
CREATE INDEX jobs_by_system ON jobs (system, id);
CREATE INDEX jobs_by_age ON jobs (status, created_at);
