//! Templates: structures given by a few numbers. The geometry is made in [`crate::generate`].
//!
//! Lengths in m, angles in degrees, z up, the span of arches and walls along x and their depth
//! along y, centred on y = 0. Every template takes four optional fields of its own: `prefix` (put
//! before the ids of its blocks, so that one scene can hold two arches), `at` (where its origin
//! lies), `material` (of all its blocks) and `members` (that join its blocks).

mod arch;
mod barrel;
mod bridge;
mod column;
mod dome;
mod flat_arch;
mod groin;
mod lattice;
mod leaves;
mod nave;
mod stack;
mod tower;
mod wall;

pub use arch::{Arch, Buttresses, JointDirection, Profile, ThicknessAlong};
pub use barrel::Barrel;
pub use bridge::{Backing, Bridge, BridgePier, BridgeSpan, Distribution, Fill};
pub use column::Column;
pub use dome::{Dome, DomeOpening, Lantern};
pub use flat_arch::FlatArch;
pub use groin::Groin;
pub use lattice::{Lattice, Packing};
pub use leaves::Leaves;
pub use nave::{Pier, Portal};
pub use stack::Stack;
pub use tower::Tower;
pub use wall::{Opening, Wall, WallBase, WallEnd};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A structure given by a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Template {
    /// An arch of voussoirs on two springers, or on buttresses.
    Arch(Arch),
    /// A barrel vault: an arch drawn out along y, laid in running bond.
    Barrel(Barrel),
    /// A masonry arch bridge in its plane, with piers and fill.
    Bridge(Bridge),
    /// Blocks on top of each other.
    Column(Column),
    /// A spherical dome of rings.
    Dome(Dome),
    /// A flat arch (platbande) between two abutments.
    FlatArch(FlatArch),
    /// A groin (cross) vault over a square bay.
    Groin(Groin),
    /// A pile of equal spheres on a lattice.
    Lattice(Lattice),
    /// A wall of two leaves, tied by through stones.
    Leaves(Leaves),
    /// An arch on two piers; with buttresses the section of a nave.
    Portal(Portal),
    /// Blocks on top of each other, each shifted against the one below.
    Stack(Stack),
    /// A hollow tower with bonded corners.
    Tower(Tower),
    /// A wall of one leaf in running bond.
    Wall(Wall),
}

impl Template {
    /// The members that it carries: names are those of its blocks without the prefix, points are in
    /// coordinates about its origin.
    pub fn members(&self) -> &[super::Member] {
        match self {
            Template::Arch(t) => &t.members,
            Template::Barrel(t) => &t.members,
            Template::Bridge(t) => &t.members,
            Template::Column(t) => &t.members,
            Template::Dome(t) => &t.members,
            Template::FlatArch(t) => &t.members,
            Template::Groin(t) => &t.members,
            Template::Lattice(t) => &t.members,
            Template::Leaves(t) => &t.members,
            Template::Portal(t) => &t.members,
            Template::Stack(t) => &t.members,
            Template::Tower(t) => &t.members,
            Template::Wall(t) => &t.members,
        }
    }

    /// What is put before the ids of its blocks and members, and where its origin lies.
    pub fn place(&self) -> (&str, [f64; 3]) {
        match self {
            Template::Arch(t) => (&t.prefix, t.at),
            Template::Barrel(t) => (&t.prefix, t.at),
            Template::Bridge(t) => (&t.prefix, t.at),
            Template::Column(t) => (&t.prefix, t.at),
            Template::Dome(t) => (&t.prefix, t.at),
            Template::FlatArch(t) => (&t.prefix, t.at),
            Template::Groin(t) => (&t.prefix, t.at),
            Template::Lattice(t) => (&t.prefix, t.at),
            Template::Leaves(t) => (&t.prefix, t.at),
            Template::Portal(t) => (&t.prefix, t.at),
            Template::Stack(t) => (&t.prefix, t.at),
            Template::Tower(t) => (&t.prefix, t.at),
            Template::Wall(t) => (&t.prefix, t.at),
        }
    }

    /// Whether the supports that it stands on are its own.
    pub fn has_supports(&self) -> bool {
        let own = match self {
            Template::Arch(t) => t.springers,
            Template::Barrel(t) => t.springers,
            Template::Bridge(t) => t.springers,
            Template::Dome(t) => t.springers,
            Template::Groin(t) => t.springers,
            Template::Leaves(t) => t.base,
            Template::Portal(t) => t.base,
            Template::Tower(t) => t.base,
            Template::Column(_)
            | Template::FlatArch(_)
            | Template::Lattice(_)
            | Template::Stack(_)
            | Template::Wall(_) => None,
        };
        own != Some(false)
    }

    /// The action of the fill of a bridge.
    pub(super) fn fill_action(&self) -> Option<&str> {
        match self {
            Template::Bridge(b) => b.fill.as_ref()?.action.as_deref(),
            _ => None,
        }
    }

    /// The key of this template in a scene file.
    pub fn name(&self) -> &'static str {
        match self {
            Template::Arch(_) => "arch",
            Template::Barrel(_) => "barrel",
            Template::Bridge(_) => "bridge",
            Template::Column(_) => "column",
            Template::Dome(_) => "dome",
            Template::FlatArch(_) => "flat_arch",
            Template::Groin(_) => "groin",
            Template::Lattice(_) => "lattice",
            Template::Leaves(_) => "leaves",
            Template::Portal(_) => "portal",
            Template::Stack(_) => "stack",
            Template::Tower(_) => "tower",
            Template::Wall(_) => "wall",
        }
    }
}

/// Is this the origin, the default of `at`?
fn is_origin(at: &[f64; 3]) -> bool {
    *at == [0.0; 3]
}

/// Is this zero, the default of a number?
pub(super) fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

/// Is this the default of its type?
fn is_default<T: Default + PartialEq>(x: &T) -> bool {
    *x == T::default()
}
