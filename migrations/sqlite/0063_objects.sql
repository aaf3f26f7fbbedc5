-- Results of succeeded jobs in a store of objects: `object` is the key of the one that has the content of the block, of
-- `content_bytes` bytes, and behind it the events before the last one and the files that the entries list. `content` is empty then.
ALTER TABLE result_blocks ADD COLUMN object TEXT;
ALTER TABLE result_blocks ADD COLUMN content_bytes INTEGER;

-- Specification and plan of the job, which are in its row no more: a JSON array, as Brotli (RFC 7932).
ALTER TABLE result_blocks ADD COLUMN documents BLOB;

-- Whether the job has succeeded and its results are complete, so that they can be moved.
ALTER TABLE result_blocks ADD COLUMN is_movable INTEGER NOT NULL DEFAULT 0;
UPDATE result_blocks SET is_movable = 1 WHERE job_id IN (SELECT id FROM jobs WHERE status = 'succeeded');

CREATE INDEX result_blocks_to_move ON result_blocks (job_id) WHERE is_movable = 1 AND object IS NULL;
CREATE UNIQUE INDEX result_blocks_by_object ON result_blocks (object) WHERE object IS NOT NULL;

-- Objects that no job names, which are removed: those that are being written, and those of deleted jobs.
CREATE TABLE unnamed_objects (
    key TEXT NOT NULL PRIMARY KEY
) STRICT, WITHOUT ROWID;

-- Address of the store of objects that the keys belong to, once there is one, and whether objects of deleted jobs are removed from it:
-- not by a restored copy, because the original names them, too.
CREATE TABLE object_store (
    address TEXT    NOT NULL,
    removes INTEGER NOT NULL DEFAULT 1
) STRICT;

CREATE TRIGGER result_blocks_leave_their_objects AFTER DELETE ON result_blocks
WHEN OLD.object IS NOT NULL AND EXISTS (SELECT 1 FROM object_store WHERE removes) BEGIN
    INSERT OR IGNORE INTO unnamed_objects (key) VALUES (OLD.object);
END;
