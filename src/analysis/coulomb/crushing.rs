//! Joints that crush: what bounds the fixed points of programs C and D follows from the forces that
//! they end with.

use check::verdict::certificate;
use model::interface::Interfaces;
use solve::{coulomb::FixedPoint, program::coulomb::Contacts};

/// Fixed points tried with ever more bounds on crushing. Fewer: states near the strength stay
/// undecided. More: time lost.
const MOST_ROUNDS: usize = 20;

/// Fixed points again and again, with the bounds on crushing that the last one broke added to the
/// contacts.
pub(super) fn within_strength(
    contacts: &mut Contacts,
    interfaces: &Interfaces,
    mut solve: impl FnMut(&Contacts) -> Option<FixedPoint>,
) -> Option<FixedPoint> {
    let mut solves = 0;
    for _ in 0..MOST_ROUNDS {
        let point = solve(contacts)?;
        solves += point.solves;
        let broken =
            certificate::crushed(interfaces, &contacts.statics.forces(interfaces, &point.forces));
        if broken.is_empty() {
            return Some(FixedPoint { solves, ..point });
        }
        contacts.statics.bound(&broken);
    }
    None
}
