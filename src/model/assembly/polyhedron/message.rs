//! What was mended, and what is refused: plain sentences with numbers and the remedy.

use base::{
    error::{Finding, FindingCode},
    tolerance,
};
use std::fmt;

/// Something about a shape that was put right or has to be known, although the shape can be used.
///
/// Faces are named by their index in the list they came in, counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Mend {
    /// Vertices that coincide were made one.
    Welded {
        /// Vertices that went.
        vertices: usize,
        /// The largest distance closed, m.
        farthest: f64,
    },
    /// Faces without extent were left out.
    Dropped {
        /// How many.
        faces: usize,
        /// The first of them.
        first: usize,
    },
    /// Faces listed more than once were taken once.
    Doubled {
        /// How many were left out.
        faces: usize,
        /// The first of them.
        first: usize,
        /// The one that it repeats.
        repeats: usize,
    },
    /// Vertices in the middle of another face's edge: the edge was split there.
    Split {
        /// How many vertices were put into edges.
        vertices: usize,
        /// One of them, m.
        at: [f64; 3],
    },
    /// Some faces pointed inward, against the others, and were turned.
    Turned {
        /// How many.
        faces: usize,
        /// The first of them.
        first: usize,
        /// Out of how many.
        of: usize,
    },
    /// All faces pointed inward and were turned.
    Inverted {
        /// How many faces.
        faces: usize,
    },
    /// The shape has several bodies that do not hang together.
    Bodies {
        /// How many.
        bodies: usize,
    },
    /// Faces that are not plane; contacts see them as plane.
    Warped {
        /// How many.
        faces: usize,
        /// The most warped one.
        face: usize,
        /// Its largest distance from its mean plane, m.
        warp: f64,
    },
    /// The surface of a support was flat or open and got a body behind it.
    Backed {
        /// How thick, m.
        thickness: f64,
    },
}

impl Mend {
    /// The kind of finding this is.
    pub fn code(&self) -> FindingCode {
        match self {
            Mend::Warped { .. } => FindingCode::Warped,
            _ => FindingCode::Mended,
        }
    }

    /// This as a finding about `block`.
    pub fn finding(&self, block: &str) -> Finding {
        Finding::new(self.code(), format!("block \"{block}\": {self}"))
    }
}

impl fmt::Display for Mend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mend::Welded { vertices, farthest } => {
                write!(
                    f,
                    "{} with another and {} welded to it (largest distance {farthest:.3e} m)",
                    coincide(*vertices),
                    were(*vertices)
                )
            }
            Mend::Dropped { faces, first } => {
                write!(
                    f,
                    "{} without extent {} left out (the first is face {first})",
                    count(*faces, "face"),
                    were(*faces)
                )
            }
            Mend::Doubled { faces, first, repeats } => {
                let them = if *faces == 1 {
                    "1 face that is".into()
                } else {
                    format!("{faces} faces that are")
                };
                write!(
                    f,
                    "{them} already listed {} left out (the first is face {first}, the same as face {repeats})",
                    were(*faces)
                )
            }
            Mend::Split { vertices, at } => write!(
                f,
                "{} in the middle of another face's edge {} put into that edge (one is at {})",
                count(*vertices, "vertex"),
                were(*vertices),
                place(at)
            ),
            Mend::Turned { faces, first, of } => {
                write!(
                    f,
                    "{faces} of {} pointed inward and {} turned outward (the first is face {first})",
                    count(*of, "face"),
                    were(*faces)
                )
            }
            Mend::Inverted { faces } => {
                write!(f, "all {faces} faces pointed inward and were turned outward")
            }
            Mend::Bodies { bodies } => {
                write!(f, "it consists of {bodies} separate bodies, which move as one block")
            }
            Mend::Backed { thickness } => write!(
                f,
                "its surface encloses no volume; as a support it was given a thickness of {} m on the side away from the free blocks",
                short(*thickness)
            ),
            Mend::Warped { faces, face, warp } => write!(
                f,
                "{} not plane and treated as plane where blocks touch (the worst is face {face}, whose corners lie up to {warp:.3e} m off its mean plane)",
                if *faces == 1 { "1 face is".into() } else { format!("{faces} faces are") },
            ),
        }
    }
}

/// Why a shape cannot be used. Faces and vertices are named by their index in the lists they came
/// in, counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// So large or small that volumes and inertias leave the range of numbers.
    #[error(
        "the shape measures {size:.3e} m across, outside the range {least:e} m to {most:e} m that can be computed"
    )]
    OutOfRange {
        /// Bounding-box diagonal, m.
        size: f64,
        /// Least diagonal, m.
        least: f64,
        /// Greatest diagonal, m.
        most: f64,
    },
    /// There are no faces, or more than one block can have.
    #[error(
        "the shape has {vertices} vertices and {faces} faces; it needs at least one face and at most {most} vertices and corners of faces"
    )]
    Count {
        /// How many vertices.
        vertices: usize,
        /// How many faces.
        faces: usize,
        /// Most vertices, and most corners of all faces together.
        most: usize,
    },
    /// A face refers to a vertex that is not there.
    #[error(
        "face {face} refers to vertex {index}, but there are only {vertices} vertices (counted from 0)"
    )]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// The index it gives.
        index: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A face with fewer than three different vertices.
    #[error("face {face} has {distinct} different vertices, at least 3 are needed")]
    TooFewCorners {
        /// The face.
        face: usize,
        /// Its different vertices.
        distinct: usize,
    },
    /// A face whose boundary crosses itself.
    #[error("face {face} crosses itself near {}", place(at))]
    CrossedFace {
        /// The face.
        face: usize,
        /// Where, m.
        at: [f64; 3],
    },
    /// A face too far from plane.
    #[error("face {face} is folded: its corners lie up to {} m off its mean plane", short(*warp))]
    Folded {
        /// The face.
        face: usize,
        /// The largest distance of a corner from the mean plane, m.
        warp: f64,
    },
    /// Two faces over the same corners in another order.
    #[error("faces {first} and {second} have the same corners in another order")]
    DuplicateFace {
        /// One of them.
        first: usize,
        /// The other.
        second: usize,
    },
    /// Edges with a face on one side only.
    #[error("the surface is open: {} a face on one side only, one of them from {} to {} (face {face})", bordering(*edges), place(from), place(to))]
    Open {
        /// How many edges.
        edges: usize,
        /// The face along the first of them.
        face: usize,
        /// Where it begins, m.
        from: [f64; 3],
        /// Where it ends, m.
        to: [f64; 3],
    },
    /// Edges where more than two faces meet and do not pair up.
    #[error(
        "{faces} faces meet in the edge from {} to {} and do not pair up into inside and outside (two of them are faces {first} and {second})",
        place(from),
        place(to)
    )]
    Branching {
        /// How many faces.
        faces: usize,
        /// One of them.
        first: usize,
        /// Another.
        second: usize,
        /// Where the edge begins, m.
        from: [f64; 3],
        /// Where it ends, m.
        to: [f64; 3],
    },
    /// A surface that has no two sides.
    #[error(
        "the surface has no inside and outside: its faces cannot be wound consistently around face {face}"
    )]
    OneSided {
        /// A face where it shows.
        face: usize,
    },
    /// No volume.
    #[error("the shape is flat: {} m thick and {} m across", short(*thickness), short(*size))]
    Flat {
        /// Thickness (distance between two planes around all corners, or volume / largest facet),
        /// m.
        thickness: f64,
        /// Bounding-box diagonal, m.
        size: f64,
    },
    /// A closed surface inside another that winds the same way.
    #[error(
        "the closed surface with face {inner} lies inside the one with face {outer} and is wound the same way, so that its inside would count twice"
    )]
    Nested {
        /// A face of the inner one.
        inner: usize,
        /// A face of the outer one.
        outer: usize,
    },
    /// Volume, centroid or moments that no body has.
    #[error(
        "the surface winds around itself: it encloses some places more than once, others backwards"
    )]
    Tangled,
    /// Two faces that cut through each other, or lie on each other facing the same way.
    #[error("faces {first} and {second} cut through or cover each other near {}", place(at))]
    Overlap {
        /// One face.
        first: usize,
        /// The other.
        second: usize,
        /// Where, m.
        at: [f64; 3],
    },
}

impl ShapeError {
    /// A face where it shows, counted from 0; none where the shape as a whole is meant.
    pub fn face(&self) -> Option<usize> {
        match *self {
            Self::NoSuchVertex { face, .. }
            | Self::TooFewCorners { face, .. }
            | Self::CrossedFace { face, .. } => Some(face),
            Self::Folded { face, .. } | Self::Open { face, .. } | Self::OneSided { face } => {
                Some(face)
            }
            Self::DuplicateFace { first, .. }
            | Self::Branching { first, .. }
            | Self::Overlap { first, .. } => Some(first),
            Self::Nested { inner, .. } => Some(inner),
            Self::NotFinite { .. }
            | Self::OutOfRange { .. }
            | Self::Count { .. }
            | Self::Flat { .. }
            | Self::Tangled => None,
        }
    }

    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "write coordinates as finite numbers in metres",
            Self::OutOfRange { .. } => {
                "coordinates are metres; check the unit and that the vertices differ"
            }
            Self::Count { .. } => {
                "a block needs at least 4 faces, each a list of vertex indices; simplify scans before use"
            }
            Self::NoSuchVertex { .. } => {
                "vertex indices are counted from 0; files that count from 1 need 1 subtracted"
            }
            Self::TooFewCorners { .. } => {
                "leave the face out or list at least three different vertices"
            }
            Self::CrossedFace { .. } => "list the corners in order around the face",
            Self::Folded { .. } => "cut it into plane faces, or into triangles",
            Self::DuplicateFace { .. } => {
                "list the corners in order around the face, and leave one of the two out"
            }
            Self::Open { .. } => {
                "close the surface: add the missing faces or cap the holes; vertices that should coincide must agree to 1e-7 of the shape's size"
            }
            Self::Branching { .. } => {
                "remove faces inside the solid and split solids that share a wall into separate blocks"
            }
            Self::OneSided { .. } => {
                "the mesh closes on itself with a twist; model the solid again or export it from a solid modeller"
            }
            Self::Flat { .. } => {
                "a block needs a volume: give it thickness, and check that the unit is the same along all axes; a support may be a face (\"support\": true, or --support on import)"
            }
            Self::Nested { .. } => {
                "wind the faces of a cavity so that they face into the cavity, or leave the inner surface out"
            }
            Self::Tangled => {
                "model the solid again, with plane faces that meet at their edges only"
            }
            Self::Overlap { .. } => "make the parts one solid (boolean union) or separate blocks",
        }
    }
}

/// A point for messages: seven digits, enough to find it and few enough to read.
fn place(p: &[f64; 3]) -> String {
    format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]))
}

fn short(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e7).contains(&x.abs()) {
        return format!("{x:.4e}");
    }
    let text = format!("{x:.5}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn count(n: usize, noun: &str) -> String {
    match (n, noun) {
        (1, _) => format!("1 {noun}"),
        (_, "vertex") => format!("{n} vertices"),
        _ => format!("{n} {noun}s"),
    }
}

fn were(n: usize) -> &'static str {
    if n == 1 { "was" } else { "were" }
}

fn coincide(n: usize) -> String {
    if n == 1 { "1 vertex coincided".into() } else { format!("{n} vertices coincided") }
}

fn bordering(n: usize) -> String {
    if n == 1 { "1 edge has".into() } else { format!("{n} edges have") }
}

const _: () = assert!(tolerance::WELD == 1e-7, "the hint of ShapeError::Open quotes the tolerance");
