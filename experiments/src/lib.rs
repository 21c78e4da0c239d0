//! The experiments: what each asks is in its module, what they have in common beside them ([`experiment`] is the frame).

// The texts of experiments name their parts.
#![allow(rustdoc::private_intra_doc_links)]

pub mod exactness_cost;
pub mod expectation;
pub mod experiment;
pub mod failures;
pub mod family;
pub mod fig8;
pub mod fig9;
pub mod flip_order;
pub mod growth;
pub mod ledger;
pub mod method;
pub mod models;
pub mod order;
pub mod outcome;
pub mod paper;
pub mod picture;
pub mod plot;
pub mod record;
pub mod report;
pub mod rivals;
pub mod sample;
pub mod scaling;
pub mod scene;
pub mod schoenhardt;
pub mod steiner;
pub mod suite;
pub mod table1;
pub mod table2;
pub mod threads;
pub mod turns;
pub mod updates;
