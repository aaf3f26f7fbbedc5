-- Jobs: what was asked for, where it stands, and who may write about it.
--
-- Times are milliseconds since 1970-01-01 UTC. A claim raises `lease`; every write of a worker names the lease it
-- holds, so a worker that was given up cannot write any more.
CREATE TABLE jobs (
    id                TEXT    NOT NULL PRIMARY KEY,
    system            TEXT    NOT NULL,
    spec              TEXT    NOT NULL CHECK (json_valid(spec)),
    plan              TEXT    NOT NULL CHECK (json_valid(plan)),
    status            TEXT    NOT NULL
                      CHECK (status IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
    status_reason     TEXT,
    outcome           TEXT,
    created_at        INTEGER NOT NULL,
    started_at        INTEGER,
    finished_at       INTEGER,
    progress          TEXT    NOT NULL CHECK (json_valid(progress)),
    summary           TEXT    CHECK (summary IS NULL OR json_valid(summary)),
    attempts          INTEGER NOT NULL DEFAULT 0,
    lease             INTEGER NOT NULL DEFAULT 0,
    lease_expires_at  INTEGER,
    cancel_requested  INTEGER NOT NULL DEFAULT 0 CHECK (cancel_requested IN (0, 1)),
    last_event        INTEGER NOT NULL DEFAULT 0,
    version           INTEGER NOT NULL DEFAULT 0,
    CHECK ((status = 'running') = (lease_expires_at IS NOT NULL)),
    CHECK ((status IN ('succeeded', 'failed', 'cancelled')) = (finished_at IS NOT NULL))
) STRICT;

CREATE INDEX jobs_waiting ON jobs (created_at, id) WHERE status = 'queued';
CREATE INDEX jobs_leased ON jobs (lease_expires_at) WHERE status = 'running';
CREATE INDEX jobs_by_status ON jobs (status, id);
