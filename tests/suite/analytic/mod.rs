//! Closed forms with exact answers. Case numbers are those of the project's collection of reference
//! cases.
//!
//! | file | cases |
//! |---|---|
//! | `blocks` | A01, A02, A08, A09, A10, A12, A14, A31, E01, E03, E04, R01, R15, G09, G10: sliding and toppling of blocks and columns |
//! | `interfaces` | E11, E13, A22, A23, A25, A26: torsion, a table on three points, blocks held by walls |
//! | `points` | A18, A19, A20, A15: ladders, the A-frame, three discs on given contact points |
//! | `wedges` | A16, E05, E06, E08, E09, R16, R17: wedges, grooves and the rock wedge |
//! | `spheres` | R02–R09, R12–R14: discs and spheres |
//! | `loads` | load factors that are negative, without limit or impossible; hanging loads; masses and centroids given by hand |
//!
//! R10, R11 and A31 with cohesion are in `strength`, more of dry friction in `coulomb`.

mod blocks;
mod interfaces;
mod loads;
mod points;
mod spheres;
mod wedges;
