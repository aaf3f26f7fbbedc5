-- Checkpoints in a store of objects: `object` is the key of the one that has the state, which is empty here then.
ALTER TABLE checkpoints ADD COLUMN object text;
CREATE UNIQUE INDEX checkpoints_by_object ON checkpoints (object) WHERE object IS NOT NULL;

-- When the key of the object of a checkpoint was noted, ms of the database's clock: while it is being written it must not be removed. 0 for others.
ALTER TABLE unnamed_objects ADD COLUMN noted_at bigint NOT NULL DEFAULT 0;

CREATE TRIGGER checkpoints_leave_their_objects AFTER DELETE ON checkpoints
    FOR EACH ROW EXECUTE FUNCTION fretwear_leave_object();
CREATE TRIGGER replaced_checkpoints_leave_their_objects AFTER UPDATE OF object ON checkpoints
    FOR EACH ROW WHEN (OLD.object IS DISTINCT FROM NEW.object) EXECUTE FUNCTION fretwear_leave_object();

-- Whether the store of objects has the mark by which it is known, and, of a server, which database it belongs to: another one is a copy, and
-- removes no objects.
ALTER TABLE object_store ADD COLUMN is_marked boolean NOT NULL DEFAULT false;
ALTER TABLE object_store ADD COLUMN owner text;
