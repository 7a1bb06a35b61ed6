//! Geometry against known coordinates, and refusals.
