-- The small results of an ended job in one compressed block: the documents of its manifest, and for a succeeded job its
-- history and snapshots, of which there are no rows then. `entries` is JSON, `content` the results one after the other, both
-- as Brotli (RFC 7932).
CREATE TABLE result_blocks (
    job_id  TEXT NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    entries BLOB NOT NULL,
    content BLOB NOT NULL
) STRICT;
