//! Soft spheres in time: the discrete element method for grains.
//!
//! Contacts follow Hertz and Mindlin with a tangential spring that remembers ([`law`]); Newton's
//! equations are integrated by velocity Verlet ([`world`]), in the open between walls or in a cell
//! that repeats itself and deforms ([`cell`]). All is in SI units. The same bytes come out on any
//! number of threads: every sum has one order.
//!
//! * P. A. Cundall, O. D. L. Strack, *A discrete numerical model for granular assemblies*,
//!   Géotechnique 29 (1979) 47.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod cell;
pub mod law;
mod neighbours;
pub mod wall;
pub mod world;

pub use cell::{Cell, Drive};
pub use law::{Law, Material};
pub use wall::Wall;
pub use world::{Contact, Grain, World};

#[cfg(test)]
mod tests;
