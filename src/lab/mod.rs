//! What surveys and experiments share: not for users, and without promises.

mod shard;

pub use shard::{Shard, fnv1a};
