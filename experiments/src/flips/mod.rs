//! What happens when polygons are inserted by flips: traces, their disorder, and what stuck flips leave.

pub mod order;
pub mod schoenhardt;
