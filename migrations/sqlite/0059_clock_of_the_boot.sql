-- Under which start of the system the process that serves the database measures, and its monotonic clock minus the system's one since
-- that start, ms. The next process under the same start of the system knows from it what was stepped, also while none served.
ALTER TABLE clock ADD COLUMN boot TEXT;
ALTER TABLE clock ADD COLUMN offset_ms INTEGER;
