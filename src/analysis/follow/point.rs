//! Points, events and ends of a path.

#[cfg(doc)]
use check::path::Carried;
use check::verdict::{Forces, Rate};
use model::assembly::Pose;
use nalgebra::Vector3;

/// A point of a path.
#[derive(Clone, Debug)]
pub struct Point {
    /// The parameter.
    pub value: f64,
    /// The pose of every block.
    pub poses: Vec<Pose>,
    /// The corners that are closed and stay so, joint by joint at the start.
    pub closed: Vec<Vec<usize>>,
    /// The load factor; 0 where none is asked for.
    pub load_factor: f64,
    /// Contact forces at the closed corners ([`Carried::touching`]).
    pub forces: Forces,
    /// Others at the same places that prove that it stands, where these leave no room for a proof.
    pub proving: Option<Forces>,
    /// The room that they have.
    pub room: f64,
    /// The mechanism that lets it fall, or that the live load drives; none where it stands.
    pub rates: Vec<Rate>,
    /// After sliding: the joint at the start of every contact, and where it touches; the forces are
    /// those of these contacts ([`Carried::displaced`]).
    pub touch: Option<Vec<(usize, Vec<Vector3<f64>>)>>,
}

/// Where something happens on the way; what it is the poses on either side show.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// The parameter: the last at which the linkage before was seen to hold.
    pub value: f64,
    /// The first at which it was seen not to hold.
    pub beyond: f64,
}

/// How a path ends.
#[derive(Clone, Debug)]
pub enum End {
    /// All of it was followed.
    Reached,
    /// It falls: the last value at which it stands and the first at which it falls, with both
    /// poses.
    Falls(Box<[Point; 2]>),
    /// The load factor vanishes here.
    Vanishes,
    /// A joint slides from here on.
    Slides(usize),
    /// It could not be followed any further, and why.
    Stuck(String),
}

/// A path.
#[derive(Clone, Debug)]
pub struct Path {
    /// The points.
    pub points: Vec<Point>,
    /// The events.
    pub events: Vec<Event>,
    /// How it ends.
    pub end: End,
    /// At the start: the forces and rates of the first mechanism, supports among them.
    pub first: Option<(Forces, Vec<Rate>)>,
    /// How many poses were looked at beside the points: whether joints that are to be closed are,
    /// whether blocks overlap, whether forces inside the cones balance the loads.
    pub between: usize,
}

impl Path {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        Self { points: Vec::new(), events: Vec::new(), end: End::Reached, first: None, between: 0 }
    }

    /// This one, and what follows.
    pub(super) fn and(mut self, next: Self) -> Self {
        self.points.extend(next.points);
        self.events.extend(next.events);
        self.between += next.between;
        Self { end: next.end, ..self }
    }
}
