-- Remote workers, as the services note them that they are in contact with; times are those by which leases are measured.
CREATE TABLE workers (
    id              uuid    NOT NULL PRIMARY KEY,
    host            text    NOT NULL,
    slots           bigint  NOT NULL,
    memory_mb       bigint  NOT NULL,
    free_memory_mb  bigint  NOT NULL,
    last_contact_at bigint  NOT NULL,
    is_draining     boolean NOT NULL DEFAULT false
);
