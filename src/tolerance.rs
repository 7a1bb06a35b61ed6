//! Every tolerance in one place: its scale, its default, and what breaks on either side.

/// Vertices of one block closer than this × the block's size (bounding-box diagonal) are one vertex.
/// Larger: slivers of real thickness collapse (thickness / size 1e-6 is in the test suite).
/// Smaller: coordinates written in single precision (relative 6e-8) leave cracks and a block reads as open.
pub const WELD: f64 = 1e-7;

/// Adjacent faces are one facet when their vertices lie within this × size of a common plane.
/// Larger: shallow polyhedra lose edges. Smaller: a triangulated plane face of a moved, rotated block
/// (coordinates rounded at 1e-12 of the scene) falls apart and interfaces depend on the triangulation.
pub const COPLANAR: f64 = 1e-7;

/// Default of `contact.gap`: facing faces closer than this × the smaller block's size touch.
/// Larger: detached blocks are closed silently into one. Smaller: files rounded to 4–5 digits lose contacts.
pub const CONTACT_GAP: f64 = 1e-4;

/// Default of `contact.angle_deg`: faces further from anti-parallel than this do not face each other.
pub const CONTACT_ANGLE_DEG: f64 = 1.0;

/// Default of `contact.min_area`: interfaces smaller than this × (smaller block's size)² are ignored and counted.
/// Larger: real small bearings vanish. Smaller: slivers from rounding along shared edges become contacts.
pub const CONTACT_MIN_AREA: f64 = 1e-9;

/// Near misses are reported up to this many times `contact.gap`.
pub const NEAR_MISS_FACTOR: f64 = 100.0;

/// A shape thinner than this × its size is flat (thickness = volume / largest facet).
/// Larger: thin slabs and slivers are refused. Smaller: volume, centroid and inertia are rounding noise.
pub const FLAT: f64 = 1e-7;

/// Least bounding-box diagonal of a shape, m. Inertia grows as length⁵, and its square has to stay clear of the smallest numbers.
/// Larger: grains could be refused. Smaller: norms of inertias become zero.
pub const LEAST_SIZE: f64 = 1e-30;

/// Greatest bounding-box diagonal of a shape, m. Larger: norms of inertias become infinite. Smaller: planets are refused.
pub const GREATEST_SIZE: f64 = 1e30;
