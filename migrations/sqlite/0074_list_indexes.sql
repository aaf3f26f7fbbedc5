-- Lists by wear and name, and the search in names: the rows of jobs are many times as long as what these need.
CREATE INDEX jobs_by_wear ON jobs (max(summary ->> '$.receptacle.max_depth_mm', summary ->> '$.slider.max_depth_mm'), id);
CREATE INDEX jobs_by_name ON jobs (lower(spec ->> '$.name'), id);
