//! Contact forces of a packing as CSV, a row for each contact that carries.

use super::cells::{Cell, Table};
use analysis::fabric;
use check::verdict::Forces;
use model::interface::Model;

/// The columns: blocks, centre of pressure (m), unit normal from `a` into `b`, normal and
/// tangential force (N), share of friction used.
const HEAD: [&str; 11] =
    ["a", "b", "x", "y", "z", "nx", "ny", "nz", "normal_force", "tangential_force", "mobilised"];

/// The table of contact forces.
///
/// # Errors
/// The table cannot be written.
pub fn csv(
    model: &Model,
    forces: &Forces,
) -> Result<String, Box<dyn std::error::Error + Send + Sync>> {
    let Model { assembly, interfaces, .. } = model;
    let mut writer = Table::with_head(HEAD)?;
    for contact in fabric::contacts(interfaces, forces) {
        let face = &interfaces.list[contact.interface];
        let mut row: Vec<Cell> =
            [face.a, face.b].map(|i| assembly.blocks[i].id.as_str().into()).into();
        let numbers = contact
            .at
            .iter()
            .chain(face.frame.n.iter())
            .chain([&contact.normal_force, &contact.tangential_force]);
        row.extend(numbers.map(|&v| v.into()));
        row.push(contact.mobilised.into());
        writer.write_record(row)?;
    }
    Ok(writer.end()?)
}
