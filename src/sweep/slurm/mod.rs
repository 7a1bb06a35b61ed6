//! A sweep on a Slurm cluster (Yoo, Jette & Grondona 2003), through Slurm's own commands: an array
//! of tasks, each of which does one shard into the shared [`Folder`](super::Folder) of the sweep.
//! Slurm schedules, restarts and cancels; nothing here does.
//!
//! The batch script is written beside the rows and can be read and submitted by hand.

mod chunks;
mod job;
mod queue;
mod script;
mod shared;

pub use chunks::tasks;
pub use job::Job;
pub use queue::{
    Partition, Task, TaskState, hosts, partition, partitions, require_commands, states, submit,
};
pub use script::Script;
pub use shared::{Mount, is_shared, mount_of, require_shared};
