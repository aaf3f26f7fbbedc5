-- How the content of a file was found to differ from its entry.
ALTER TABLE result_files ADD COLUMN damaged TEXT;
