//! The experiments. The rooms, lowest first: [`frame`], what all of them are made of; [`measure`], how runs are made
//! and timed; [`inputs`] and [`families`], what is measured; [`flips`], what traces of flips tell; [`rivals`], other
//! programs; [`pictures`]; [`questions`], the experiments, each saying in its module what it asks; [`registry`], their
//! list; and what is made of their results: [`page`] and [`paper`].

// The texts of experiments name their parts.
#![allow(rustdoc::private_intra_doc_links)]

pub mod families;
pub mod flips;
pub mod frame;
pub mod inputs;
pub mod measure;
pub mod page;
pub mod paper;
pub mod pictures;
pub mod questions;
pub mod registry;
pub mod rivals;
