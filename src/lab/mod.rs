//! What surveys and experiments share: not for users, and without promises.

pub mod process;
mod shard;
pub mod tetgen;

pub use shard::{Shard, fnv1a};
