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

/// Near misses are reported up to this × the smaller block's size at most, however coarse `contact.gap` is.
/// Larger: with a coarse gap every face across an open joint is called a near miss and every block is compared with its second neighbours.
/// Smaller: the default reach (100 × [`CONTACT_GAP`] = 0.01) is cut.
pub const NEAR_MISS_LIMIT: f64 = 0.05;

/// In the plane of a contact, points closer than this × the smaller block's size are one point, and a point this close to a line is on it.
/// Larger: contact corners move, and with them the critical thickness of an arch (decided to 1e-6 of the thickness).
/// Smaller: rounding of moved and rotated coordinates makes two corners of one.
pub const CONTACT_WELD: f64 = 1e-9;

/// Lengths below this × the largest coordinate are rounding: a floor under every contact length.
/// Larger: real gaps far from the origin are lost. Smaller: sums of a few products of such coordinates no longer fit.
pub const COORDINATE_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Gaps and overlaps below this × the smaller block's size are rounding: closed without a word.
/// Larger: gaps somebody drew are closed silently. Smaller: every rotated scene reports gaps.
pub const GAP_WORTH_TELLING: f64 = 1e-9;

/// A contact no wider than `contact.gap` is the rim of two faces that only just overlap, not a bearing, where both faces are
/// at least 1 / this times as wide. Larger: the bearing of a thin plate's edge is taken for a rim.
/// Smaller: blocks that meet along an edge, rounded to 4–5 digits, become neighbours.
pub const RIM_SHARE: f64 = 0.1;

/// Directions closer than this (radians) to a face's plane lie in it, when edges and corners are tested against faces.
/// Larger: a corner may dig into the face. Smaller: edges in the plane, rounded, are refused.
pub const CONTACT_ROUNDING_ANGLE: f64 = 1e-6;
