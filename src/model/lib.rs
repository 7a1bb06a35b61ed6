//! The scene as mechanics sees it: blocks in SI with every default applied, where they touch, what
//! joints carry beside friction, where the axles of a train may stand.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod assembly;
pub mod interface;
pub mod strength;
pub mod train;
