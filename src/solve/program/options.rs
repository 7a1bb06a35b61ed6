//! What a program leaves out, and how it writes friction.

/// What to leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StaticsOptions {
    /// Keep everything, for comparison: three dimensions, every tangential force.
    pub keep_all: bool,
    /// Whether the live load takes part (it must then lie in the plane of a plane scene).
    pub live: bool,
    /// Whether a scene that is its own image is reduced to one part. Not where what is asked for is
    /// not symmetric itself.
    pub symmetry: bool,
    /// Whether columns are the normal and tangential forces themselves, friction left to the caller
    /// ([`coulomb`](super::coulomb)), instead of coordinates of the friction cone.
    pub split: bool,
    /// For studies: friction cones in space replaced by pyramids.
    pub pyramid: Option<Pyramid>,
    /// For studies: newtons and metres as they are, no scaling.
    pub unscaled: bool,
}

/// A friction cone made of flat facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pyramid {
    /// Number of facets, at least 3.
    pub facets: usize,
    /// Around the cone (edges outside) instead of inside it.
    pub around: bool,
}
