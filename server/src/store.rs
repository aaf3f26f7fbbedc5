//! The store: jobs, batches, events and results, durable. The only place with SQL.
//!
//! The types of this module and of its files are the contract of every storage engine; the SQL of an engine, its
//! connections and its rows are below a folder of its own (`store/sqlite/`, `store/postgres/`). Statements that differ in no more than names
//! stand once, in `store/sql/`: each engine compiles them as modules of its own, with its `dialect`. Nothing outside of the store knows
//! which engine it is. The tests in `store/tests/` are those of the contract, and run on both.
//!
//! # Guarantees
//!
//! Every operation is one transaction and durable when it returns `Ok`, unless the table says otherwise. A *fenced*
//! operation names a [`Claim`] and has an effect only while the job is `running` under the lease number of that claim;
//! every claim and every reclaim of a lost job raises the number. If the lease was lost, nothing is written, the write
//! is counted in `fretwear_stale_writes_refused_total`, and the answer says so.
//!
//! | operation | atomic | fenced; answer if the lease was lost |
//! | --- | --- | --- |
//! | `submit` | job, labels, first event, request key; several submissions may share a transaction | no |
//! | `submit_batch` | all jobs of the batch, or none; with an expansion, the first of them | no |
//! | `extend_batch` | the next jobs of a batch; none if others have queued these, or the batch was cancelled | no |
//! | `claim` | status, lease, attempt and its event; later rows deleted; reasons | no; each lease is new; repeated: the same jobs |
//! | `record` | progress, rows, snapshots, files, checkpoint or the name of its object, events, renewed lease | yes; [`LeaseState::Lost`]; repeated: no effect |
//! | `heartbeat` | end of each lease, where it is due | yes; [`LeaseState::Lost`], not counted |
//! | `renew` | end of the lease | yes; [`LeaseState::Lost`], not counted |
//! | `lease_state` | reads only | yes; [`LeaseState::Lost`], not counted |
//! | `checkpoint` | reads only | yes; `None` |
//! | `restart` | rows, snapshots, files and checkpoint deleted, `attempt` event | yes; [`LeaseState::Lost`]; repeated: no effect |
//! | `end` | rows, files, block (instead of rows and snapshots), status, summary, `done` event, checkpoint deleted | yes; `None`; repeated: the same status |
//! | `move_results` | notes the objects; after they are written, their names in place of the results, for several jobs | no; only of succeeded jobs |
//! | `reclaim_expired`, `reclaim_at_start` | all lost jobs: into the queue, or under a new lease | no; they end leases |
//! | `add_worker_token`, `revoke_worker_token` | one token | no |
//! | `note_workers` | contacts with remote workers; those without one for a day are forgotten | no |
//! | `drain_worker` | one worker, which takes no more jobs | no |
//! | `cancel` | a queued job ends with its `done` event; a running one is marked for its worker | no |
//! | `note_cancellation` | none of the jobs of a batch are queued any more, the others are to be cancelled | no |
//! | `note_deletion` | a batch is not shown any more, and is to be deleted | no; only of ended jobs |
//! | `retry`, `retry_all` | each job; by `retry_all` a limited number at once | no; only failed and cancelled jobs |
//! | `expire` | all queued jobs whose deadline has passed end with their `done` events | no |
//! | `delete` | a job with all rows; files afterwards, or at the next start | no; only ended jobs |
//! | `end_jobs_of` | jobs of such a batch as by `cancel` or `delete`, a limited number at once; the batch with the last of those | no |
//! | `delete_older` | each job; a limited number a call; batches without jobs | no; only ended jobs |
//!
//! Event numbers of a job count from 1 without gaps, in the order of the transactions; `done` is the last one. Reads
//! see committed transactions only. A file counts once a manifest names it; [`Store::attempt_folder`] gives every lease
//! a folder of its own, so that a worker that lost its lease cannot touch the files of the next attempt.
//!
//! A *repeated* operation is one whose answer was lost. Claims are numbered by their worker, writes under a lease from 1, and the
//! store recognizes a number that it has seen. After a gap in the numbers the lease is lost, because the database has lost writes
//! (a failover, a restored backup); `restart` alone may follow one, because it deletes what they have left.
//!
//! Times are milliseconds since 1970 and the store's own. Leases are lengths: when one ends is a matter of a monotonic clock of the process
//! that serves a file ([`Store::clock`]), and of the clock of a database that several processes serve.

mod address;
mod batch_counts;
mod batch_rows;
mod batches;
pub mod block;
mod candidates;
mod changes;
mod checkpoint_object;
mod checkpoints;
pub mod checksum;
mod circuit_breaker;
mod compression;
mod database_errors;
mod disk;
mod document;
mod ending;
mod error;
mod events;
mod file_key;
mod file_objects;
mod folder;
mod gauges;
mod integrity;
mod job_ids;
mod jobs;
mod leases;
mod limits;
mod list_order;
mod migrations;
mod named_files;
mod new_row;
mod objects;
mod operations;
mod overview;
mod packed;
mod postgres;
mod process_state;
mod reading;
mod results;
mod results_to_move;
mod rows;
mod sqlite;
mod stored_block;
mod stored_file;
mod update_fault;
mod updates;
mod verify;
mod workers;

pub use address::shown_address;
pub use batches::{
    BatchDetail, BatchEnding, BatchFilter, BatchJob, BatchOverview, BatchPart, Expansion, NewBatch,
    NewBatchJob, NewExpansion, Portion, StoredBatch,
};
pub use changes::{AllChanges, Changes};
pub use checksum::IntegrityError;
pub use disk::DataDisk;
pub use error::StoreError;
pub use integrity::{BackupError, CopySummary};
pub use jobs::{
    Cancelled, Changed, Deleted, Filter, NewJob, RequestKey, Retried, StoredJob, SubmitOptions,
    Submitted,
};
pub use leases::{
    Claim, ClaimRequest, ClaimedCheckpoint, End, EventName, JobUpdate, Lease, LeaseState,
    Reclaimed, RequestNumber, Write, WriteKind,
};
pub use limits::Limits;
pub use list_order::{ListPlace, Listed, Order, OrderKey, OrderValue};
pub use operations::Store;
pub use results::{Chunks, Content, ContentError, NewContent, NewFile, SnapshotPart, StoredEvent};
pub use sqlite::OWNER_HEARTBEAT;
pub use sqlite::backup::{backup, restore};
pub use update_fault::UpdateFault;
pub use verify::verify;
pub use workers::{WorkerContact, WorkerOffer};

#[cfg(test)]
pub(crate) mod tests;
