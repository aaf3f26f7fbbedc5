-- How far the clock of the system was stepped while the last process served the database, ms. That process measured
-- deadlines, ages and places in the queue by a monotonic clock, so the next one moves them by as much.
CREATE TABLE clock (
    one        INTEGER PRIMARY KEY CHECK (one = 1),
    stepped_ms INTEGER NOT NULL
) STRICT;
