-- Batches whose jobs are being cancelled or deleted, a limited number at once. One that is being deleted is not shown any more.
ALTER TABLE sweeps ADD COLUMN ending TEXT CHECK (ending IN ('cancel', 'delete'));
CREATE INDEX sweeps_ending ON sweeps (id) WHERE ending IS NOT NULL;
