//! Trajectories as CSV, a row for each block and time, written as they come.

use super::cells::{Cell, Table};
use dynamics::Frame;
use model::assembly::Assembly;
use std::io::Write;

/// The columns.
const HEAD: [&str; 16] = [
    "run", "time", "block", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy",
    "wz",
];

/// Writes frames.
pub struct TrajectoryWriter<W: Write>(W);

impl<W: Write> TrajectoryWriter<W> {
    /// Writes the head: `run` is `fast` or `fine`, time in s, `x, y, z` the centre of mass (m),
    /// `q…` the rotation from the start (quaternion), `v…` its velocity (m/s), `w…` the spin
    /// (rad/s).
    ///
    /// # Errors
    /// The output cannot be written.
    pub fn new(out: W) -> std::io::Result<Self> {
        let mut writer = Self(out);
        writer.write(Table::with_head(HEAD)?)?;
        Ok(writer)
    }

    /// Writes one frame, in one piece: what a killed run leaves ends with a whole frame.
    ///
    /// # Errors
    /// The output cannot be written.
    pub fn frame(&mut self, assembly: &Assembly, frame: &Frame) -> std::io::Result<()> {
        let mut rows = Table::new();
        let run = format!("{:?}", frame.fidelity).to_lowercase();
        for (block, pose) in assembly.blocks.iter().zip(&frame.blocks) {
            let q = pose.turn;
            let mut row: Vec<Cell> =
                vec![run.as_str().into(), frame.time.into(), block.id.as_str().into()];
            let numbers = pose
                .center
                .iter()
                .chain([&q.w, &q.i, &q.j, &q.k])
                .chain(pose.velocity.iter())
                .chain(pose.spin.iter());
            row.extend(numbers.map(|&v| v.into()));
            rows.write_record(row)?;
        }
        self.write(rows)
    }

    fn write(&mut self, rows: Table) -> std::io::Result<()> {
        self.0.write_all(rows.end().map_err(std::io::Error::other)?.as_bytes())?;
        self.0.flush()
    }
}
