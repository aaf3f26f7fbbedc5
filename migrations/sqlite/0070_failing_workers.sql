-- Why a remote process starts no solves at present.
ALTER TABLE workers ADD COLUMN failing TEXT;
