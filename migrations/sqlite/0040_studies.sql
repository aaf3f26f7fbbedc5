-- Studies of accuracy: sweeps whose jobs differ in their accuracy alone. `plan` is what their results are compared by: the
-- specification, the grid, and what was left out.
CREATE TABLE studies (
    sweep_id TEXT NOT NULL PRIMARY KEY REFERENCES sweeps (id) ON DELETE CASCADE,
    plan     TEXT NOT NULL CHECK (json_valid(plan))
) STRICT;
