-- Number of jobs by status: counting them reads the whole index.
CREATE TABLE job_counts (
    status TEXT    NOT NULL PRIMARY KEY,
    jobs   INTEGER NOT NULL CHECK (jobs >= 0)
) STRICT, WITHOUT ROWID;

INSERT INTO job_counts (status, jobs) SELECT status, count(*) FROM jobs GROUP BY status;

CREATE TRIGGER jobs_counted_on_insert AFTER INSERT ON jobs BEGIN
    INSERT INTO job_counts (status, jobs) VALUES (NEW.status, 1) ON CONFLICT DO UPDATE SET jobs = jobs + 1;
END;

CREATE TRIGGER jobs_counted_on_delete AFTER DELETE ON jobs BEGIN
    UPDATE job_counts SET jobs = jobs - 1 WHERE status = OLD.status;
END;

CREATE TRIGGER jobs_counted_on_transition AFTER UPDATE OF status ON jobs WHEN OLD.status <> NEW.status BEGIN
    UPDATE job_counts SET jobs = jobs - 1 WHERE status = OLD.status;
    INSERT INTO job_counts (status, jobs) VALUES (NEW.status, 1) ON CONFLICT DO UPDATE SET jobs = jobs + 1;
END;
