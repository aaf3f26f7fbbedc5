-- The tables of PostgreSQL, with the meaning that those of SQLite have after their migration of the same number.
--
-- Documents are JSON as text, because their digits are kept. Times are milliseconds since 1970-01-01 UTC by the clock of this
-- database. A claim raises `lease`; every write of a worker names the lease it holds, so a worker that was given up cannot write any
-- more.

-- Now, ms.
CREATE FUNCTION fretwear_now() RETURNS bigint LANGUAGE sql VOLATILE
    RETURN floor(1000 * extract(epoch FROM clock_timestamp()))::bigint;

-- Rows are written several times in their life, long documents once: these are kept apart from the row, and renewals of leases, which
-- change no index, find a place on its page.
CREATE TABLE jobs (
    id                uuid    NOT NULL PRIMARY KEY,
    system            text    NOT NULL,
    spec              text    NOT NULL,
    plan              text    NOT NULL,
    status            text    NOT NULL
                      CHECK (status IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
    status_reason     text,
    outcome           text,
    created_at        bigint  NOT NULL,
    started_at        bigint,
    finished_at       bigint,
    progress          text    NOT NULL,
    summary           text,
    attempts          bigint  NOT NULL DEFAULT 0,
    lease             bigint  NOT NULL DEFAULT 0,
    lease_expires_at  bigint,
    cancel_requested  boolean NOT NULL DEFAULT false,
    last_event        bigint  NOT NULL DEFAULT 0,
    version           bigint  NOT NULL DEFAULT 0,
    priority          bigint  NOT NULL DEFAULT 0,
    place             bigint  NOT NULL DEFAULT 0,
    deadline_at       bigint,
    memory_mb         bigint  NOT NULL DEFAULT 0,
    fruitless         bigint  NOT NULL DEFAULT 0,
    queued_at         bigint  NOT NULL DEFAULT 0,
    revision          bigint  NOT NULL DEFAULT 0,
    last_write        bigint  NOT NULL DEFAULT 0,
    worker            uuid,
    claim_number      bigint,
    is_remote         boolean NOT NULL DEFAULT false,
    cpu_ms            bigint  NOT NULL DEFAULT 0,
    CHECK ((status = 'running') = (lease_expires_at IS NOT NULL)),
    CHECK ((status IN ('succeeded', 'failed', 'cancelled')) = (finished_at IS NOT NULL))
) WITH (fillfactor = 70, toast_tuple_target = 512, autovacuum_vacuum_scale_factor = 0.01, autovacuum_analyze_scale_factor = 0.02);

ALTER TABLE jobs ALTER COLUMN progress SET STORAGE MAIN;

CREATE INDEX jobs_waiting ON jobs (place, id) INCLUDE (memory_mb, queued_at, cpu_ms) WHERE status = 'queued';
CREATE INDEX jobs_running ON jobs (id) WHERE status = 'running';
CREATE INDEX jobs_by_claim ON jobs (worker, claim_number) WHERE status = 'running';
CREATE INDEX jobs_by_deadline ON jobs (deadline_at) WHERE status = 'queued' AND deadline_at IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs (finished_at) WHERE finished_at IS NOT NULL;
CREATE INDEX jobs_by_status ON jobs (status, id);
CREATE INDEX jobs_by_age ON jobs (status, created_at);
CREATE INDEX jobs_by_system ON jobs (system, id);
CREATE INDEX jobs_by_revision ON jobs (revision, id);

-- The order of all changes: the number of the transaction that made a change, beyond a first number that is raised when the
-- database is restored in another cluster, whose transactions count from the start.
CREATE TABLE revisions (
    name text   NOT NULL PRIMARY KEY CHECK (name = 'jobs'),
    last bigint NOT NULL
);

INSERT INTO revisions (name, last) VALUES ('jobs', 0);

CREATE FUNCTION fretwear_revision() RETURNS bigint LANGUAGE sql VOLATILE
    RETURN (SELECT last FROM revisions) + pg_current_xact_id()::text::bigint;

-- The last revision of which, and of all before it, every change can be seen: by the snapshot of the statement that asks.
CREATE FUNCTION fretwear_last_revision() RETURNS bigint LANGUAGE sql STABLE
    RETURN (SELECT last FROM revisions) + pg_snapshot_xmin(pg_current_snapshot())::text::bigint - 1;

CREATE TABLE deleted_jobs (
    revision bigint NOT NULL,
    id       uuid   NOT NULL PRIMARY KEY
);

CREATE INDEX deleted_jobs_by_revision ON deleted_jobs (revision, id);

CREATE FUNCTION fretwear_revise() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    NEW.revision := fretwear_revision();
    RETURN NEW;
END $$;

CREATE TRIGGER jobs_revised BEFORE INSERT OR UPDATE OF version ON jobs
    FOR EACH ROW EXECUTE FUNCTION fretwear_revise();

CREATE FUNCTION fretwear_note_deletion() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    INSERT INTO deleted_jobs (revision, id) VALUES (fretwear_revision(), OLD.id);
    RETURN NULL;
END $$;

CREATE TRIGGER jobs_deleted AFTER DELETE ON jobs FOR EACH ROW EXECUTE FUNCTION fretwear_note_deletion();

CREATE TABLE labels (
    job_id uuid NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    key    text NOT NULL,
    value  text NOT NULL,
    PRIMARY KEY (job_id, key)
);

CREATE INDEX labels_by_value ON labels (key, value);

CREATE TABLE events (
    job_id uuid   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    seq    bigint NOT NULL CHECK (seq > 0),
    name   text   NOT NULL,
    data   text   NOT NULL,
    PRIMARY KEY (job_id, seq)
);

CREATE TABLE history_rows (
    job_id uuid   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    cycle  bigint NOT NULL,
    data   text   NOT NULL,
    PRIMARY KEY (job_id, cycle)
);

CREATE TABLE snapshots (
    job_id        uuid   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    cycle         bigint NOT NULL,
    profile       text   NOT NULL,
    pressure      text   NOT NULL,
    friction_loop text   NOT NULL,
    PRIMARY KEY (job_id, cycle)
);

-- A key is inserted before its job, so that of two requests with one key the second waits for the first.
CREATE TABLE request_keys (
    key         text  NOT NULL PRIMARY KEY,
    body_sha256 bytea NOT NULL CHECK (length(body_sha256) = 32),
    job_id      uuid  NOT NULL REFERENCES jobs (id) ON DELETE CASCADE DEFERRABLE INITIALLY DEFERRED
);

CREATE INDEX request_keys_by_job ON request_keys (job_id);

CREATE TABLE checkpoints (
    job_id     uuid   NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    lease      bigint NOT NULL,
    cycle      bigint NOT NULL CHECK (cycle >= 0),
    written_at bigint NOT NULL,
    sha256     bytea  NOT NULL CHECK (length(sha256) = 32),
    state      bytea  NOT NULL
);

CREATE TABLE probes (
    name       text   NOT NULL PRIMARY KEY,
    written_at bigint NOT NULL
);

CREATE TABLE result_files (
    job_id     uuid   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    name       text   NOT NULL,
    cycle      bigint,
    media_type text   NOT NULL,
    bytes      bigint NOT NULL CHECK (bytes >= 0),
    sha256     text   NOT NULL CHECK (length(sha256) = 64),
    content    bytea,
    place      text   UNIQUE,
    damaged    text,
    PRIMARY KEY (job_id, name),
    CHECK ((content IS NULL) <> (place IS NULL))
);

CREATE TABLE sweeps (
    id          uuid   NOT NULL PRIMARY KEY,
    name        text,
    created_at  bigint NOT NULL,
    request_key text   UNIQUE,
    body_sha256 bytea  CHECK (length(body_sha256) = 32),
    CHECK ((request_key IS NULL) = (body_sha256 IS NULL))
);

CREATE TABLE sweep_jobs (
    sweep_id  uuid   NOT NULL REFERENCES sweeps (id) ON DELETE CASCADE,
    position  bigint NOT NULL,
    job_id    uuid   NOT NULL UNIQUE REFERENCES jobs (id) ON DELETE CASCADE,
    overrides text   NOT NULL,
    PRIMARY KEY (sweep_id, position)
);

CREATE TABLE studies (
    sweep_id uuid NOT NULL PRIMARY KEY REFERENCES sweeps (id) ON DELETE CASCADE,
    plan     text NOT NULL
);

-- The blocks are compressed already.
CREATE TABLE result_blocks (
    job_id        uuid    NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    entries       bytea   NOT NULL,
    content       bytea   NOT NULL,
    object        text,
    content_bytes bigint,
    documents     bytea,
    is_movable    boolean NOT NULL DEFAULT false
);

ALTER TABLE result_blocks ALTER COLUMN entries SET STORAGE EXTERNAL, ALTER COLUMN content SET STORAGE EXTERNAL,
    ALTER COLUMN documents SET STORAGE EXTERNAL;

CREATE INDEX result_blocks_to_move ON result_blocks (job_id) WHERE is_movable AND object IS NULL;
CREATE UNIQUE INDEX result_blocks_by_object ON result_blocks (object) WHERE object IS NOT NULL;

CREATE TABLE worker_tokens (
    id         uuid   NOT NULL PRIMARY KEY,
    name       text   NOT NULL,
    sha256     bytea  NOT NULL UNIQUE,
    created_at bigint NOT NULL,
    revoked_at bigint
);

-- A key that a process is about to remove cannot be named any more.
CREATE TABLE unnamed_objects (
    key         text    NOT NULL PRIMARY KEY,
    is_removing boolean NOT NULL DEFAULT false
);

CREATE TABLE object_store (
    address text    NOT NULL,
    removes boolean NOT NULL DEFAULT true
);

CREATE FUNCTION fretwear_leave_object() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    IF OLD.object IS NOT NULL AND EXISTS (SELECT 1 FROM object_store WHERE removes) THEN
        INSERT INTO unnamed_objects (key) VALUES (OLD.object) ON CONFLICT DO NOTHING;
    END IF;
    RETURN NULL;
END $$;

CREATE TRIGGER result_blocks_leave_their_objects AFTER DELETE ON result_blocks
    FOR EACH ROW EXECUTE FUNCTION fretwear_leave_object();
