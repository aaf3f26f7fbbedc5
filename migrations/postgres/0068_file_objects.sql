-- Files in a store of objects: `object` is the key of one.
ALTER TABLE result_files ADD COLUMN object text;
ALTER TABLE result_files DROP CONSTRAINT result_files_check, ADD CHECK (num_nonnulls(content, place, object) = 1);
CREATE UNIQUE INDEX result_files_by_object ON result_files (object) WHERE object IS NOT NULL;

-- Noted with a time: requests that are about to read a file have its key.
CREATE FUNCTION fretwear_leave_file() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    IF EXISTS (SELECT 1 FROM object_store WHERE removes) THEN
        INSERT INTO unnamed_objects (key, noted_at) VALUES (OLD.object, fretwear_now()) ON CONFLICT DO NOTHING;
    END IF;
    RETURN NULL;
END $$;

CREATE TRIGGER files_leave_their_objects AFTER DELETE ON result_files
    FOR EACH ROW WHEN (OLD.object IS NOT NULL) EXECUTE FUNCTION fretwear_leave_file();
CREATE TRIGGER replaced_files_leave_their_objects AFTER UPDATE OF object ON result_files
    FOR EACH ROW WHEN (OLD.object IS NOT NULL AND OLD.object IS DISTINCT FROM NEW.object) EXECUTE FUNCTION fretwear_leave_file();

-- The content of a file that could not be written to its object in time: the update that names the key takes it from here.
ALTER TABLE unnamed_objects ADD COLUMN content bytea;
ALTER TABLE unnamed_objects ALTER COLUMN content SET STORAGE EXTERNAL;
