//! What a cell of a mesh stands for.

/// What a cell is: the numbers of the array `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VtkPart {
    /// A face of a free block.
    Block = 0,
    /// A face of a support.
    Support = 1,
    /// A joint.
    Joint = 2,
    /// A contact point, with the force on the second block.
    Force = 3,
    /// A piece of a line of thrust.
    Thrust = 4,
    /// The place of a dead load beside the weight.
    Load = 5,
    /// The place of a live load.
    LiveLoad = 6,
    /// A tie, strut or other member.
    Member = 7,
}
