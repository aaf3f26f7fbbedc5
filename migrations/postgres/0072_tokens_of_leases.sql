-- The token with which a job was claimed: no other one writes under the lease.
ALTER TABLE jobs ADD COLUMN lease_token uuid;
