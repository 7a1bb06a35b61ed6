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

/// Stored contact polygons with an area below this × (their diameter)² have no definite plane and are left out by the importers.
/// Larger: long bed joints between thin blocks vanish. Smaller: the normal of a sliver is rounding noise.
pub const STORED_POLYGON_AREA: f64 = 1e-9;

/// Blocks whose lowest corner lies within this × the height of the scene above its lowest point are proposed as supports.
/// Larger: the first course of a tall structure is proposed with its base. Smaller: springers on ground that is not quite level are missed.
pub const LOWEST_BAND: f64 = 0.01;
