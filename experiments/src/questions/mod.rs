//! The experiments, one module each. [`crate::registry`] has the list of them.

pub mod exactness_cost;
pub mod failures;
pub mod fig8;
pub mod fig9;
pub mod flip_models;
pub mod flip_order;
pub mod growth;
pub mod models;
pub mod rivals;
pub mod scaling;
pub mod steiner;
pub mod table1;
pub mod table2;
pub mod updates;
