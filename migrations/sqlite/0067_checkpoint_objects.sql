-- Checkpoints in a store of objects: `object` is the key of the one that has the state, which is empty here then.
ALTER TABLE checkpoints ADD COLUMN object TEXT;
CREATE UNIQUE INDEX checkpoints_by_object ON checkpoints (object) WHERE object IS NOT NULL;

-- When the key of the object of a checkpoint was noted, ms of the process's monotonic clock: while it is being written it must not be removed.
-- 0 for others.
ALTER TABLE unnamed_objects ADD COLUMN noted_at INTEGER NOT NULL DEFAULT 0;

CREATE TRIGGER checkpoints_leave_their_objects AFTER DELETE ON checkpoints
WHEN OLD.object IS NOT NULL AND EXISTS (SELECT 1 FROM object_store WHERE removes) BEGIN
    INSERT OR IGNORE INTO unnamed_objects (key) VALUES (OLD.object);
END;

CREATE TRIGGER replaced_checkpoints_leave_their_objects AFTER UPDATE OF object ON checkpoints
WHEN OLD.object IS NOT NULL AND OLD.object IS NOT NEW.object AND EXISTS (SELECT 1 FROM object_store WHERE removes) BEGIN
    INSERT OR IGNORE INTO unnamed_objects (key) VALUES (OLD.object);
END;

-- Whether the store of objects has the mark by which it is known, and, of a server, which database it belongs to: another one is a copy, and
-- removes no objects.
ALTER TABLE object_store ADD COLUMN is_marked INTEGER NOT NULL DEFAULT 0 CHECK (is_marked IN (0, 1));
ALTER TABLE object_store ADD COLUMN owner TEXT;
