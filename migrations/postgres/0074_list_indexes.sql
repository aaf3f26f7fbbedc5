-- Lists by wear and name: the rows of jobs are many times as long as what these need.
CREATE INDEX jobs_by_wear ON jobs ((GREATEST((summary::json #>> '{receptacle,max_depth_mm}')::float8, (summary::json #>> '{slider,max_depth_mm}')::float8)) DESC NULLS LAST, id DESC);
CREATE INDEX jobs_by_name ON jobs ((lower((spec::json ->> 'name') COLLATE "C")), id DESC);
