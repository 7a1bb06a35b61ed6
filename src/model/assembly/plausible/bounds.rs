//! What stone, masonry, rock and grains are, as ranges outside which a number is more likely a
//! mistake than a structure.
//!
//! Sources of the ranges: densities and unit weights from EN 1991-1-1, annex A (natural stone 20 to
//! 31 kN/m³, brick and mortar 12 to 23); strengths of stone and masonry from EN 1996-1-1 and of
//! rock from Hoek & Brown, Underground Excavations in Rock (1980): 0.3 MPa (earth) to 400 MPa
//! (basalt) in compression, joints 0.01 to 3 MPa in shear and tension; friction of joints from
//! Barton & Choubey, Rock Mechanics 10 (1977), and EN 1996-1-1: angles of 10° to 70°. A window is
//! narrow on purpose: it holds what a mistake by that unit makes of a real number, so that a number
//! that was chosen lies outside.

use std::ops::RangeInclusive;

/// Gravity on Earth, m/s², as people write it (9.8, 9.81, 10). Only there are weights and strengths
/// compared with real ones. Wider: scenes of the Moon and problems with unit gravity, whose units
/// are their own, are reported. Narrower: 9.8 or 10 switches the checks off.
pub const EARTH: RangeInclusive<f64> = 9.5..=10.1;

/// Strengths of gravity outside this range, m/s², are mistakes (9810 is mm/s², 0.00981 is km/s²).
/// Narrower: unit gravity, the Moon (1.6) or a centrifuge (1000) are reported. Wider: mm/s² pass.
pub const GRAVITY: RangeInclusive<f64> = 0.05..=5e3;

/// Strengths of gravity, m/s², that are feet per second squared (32.17).
/// Wider: centrifuges at three times gravity are reported. Narrower: 32.2 passes.
pub const GRAVITY_IN_FEET: RangeInclusive<f64> = 32.1..=32.25;

/// Densities outside this range, kg/m³, are mistakes of one unit or another (aerogel, the lightest
/// solid, has about 1; osmium 22,600). Wider: a mistake by a thousand passes. Narrower: cork, lead
/// or scaled test problems are reported.
pub const DENSITY: RangeInclusive<f64> = 0.999_999..=3e4;

/// Densities of what is built or piled, kg/m³, from wood to steel: strengths are compared with
/// weights of such things only. Wider: problems with densities of their own are reported. Narrower:
/// timber or slag switch the checks off.
pub const SOLID: RangeInclusive<f64> = 300.0..=9000.0;

/// A unit in which the density of masonry or rock falls into a window of its own.
pub struct DensityUnit {
    /// As it is written.
    pub name: &'static str,
    /// The window, in that unit. Wider: foam, cork, gold or a chosen 2 are taken for stone in
    /// another unit. Narrower: tuff or basalt pass.
    pub window: RangeInclusive<f64>,
    /// How many kg/m³ one of it is.
    pub kilograms: f64,
}

/// kg.
pub const TONNE: f64 = 1e3;

/// 9.81 m/s², for weights.
const G: f64 = 9.81;

/// The units that people write densities in. The 1 of unit problems, water's 1.0 among it, is in
/// none of the windows; 99 kg/m³ and less (cork, foam) are not taken for pounds.
pub const DENSITY_UNITS: [DensityUnit; 8] = [
    DensityUnit { name: "kN/m³", window: 11.0..=32.0, kilograms: 1e3 / G },
    DensityUnit { name: "t/m³ (g/cm³)", window: 1.2..=3.4, kilograms: TONNE },
    DensityUnit { name: "N/m³", window: 12e3..=32e3, kilograms: 1.0 / G },
    DensityUnit { name: "lb/ft³", window: 120.0..=195.0, kilograms: 16.018_463 },
    DensityUnit { name: "g/m³", window: 1.2e6..=3.4e6, kilograms: 1e-3 },
    DensityUnit { name: "kg/cm³ (g/mm³)", window: 1.2e-3..=3.4e-3, kilograms: 1e6 },
    DensityUnit { name: "kg/mm³", window: 1.2e-6..=3.4e-6, kilograms: 1e9 },
    DensityUnit { name: "t/mm³", window: 1.2e-9..=3.4e-9, kilograms: 1e12 },
];

/// A joint that closes under the weight of a block of stone standing on it by more than this share of
/// the block's size is no joint of stone. More: stiffnesses in MPa/m pass. Less: joints of rubber or
/// of soft mortar are reported.
pub const GREATEST_CLOSING: f64 = 0.05;

/// Stiffnesses of joints of masonry and rock in N/mm³ (MPa/mm): 0.1 to 1000 N/mm³ is 1e8 to 1e12
/// Pa/m. Wider: numbers that were chosen are taken for a mistake. Narrower: a mistake passes.
pub const STIFFNESS_IN_NEWTONS_PER_MM3: RangeInclusive<f64> = 0.1..=1e3;

/// The same in MPa/m and in kPa/m. As above.
pub const STIFFNESS_IN_MEGAPASCALS_PER_M: RangeInclusive<f64> = 1e3..=1e6;

/// Young's moduli in GPa: stone, glass and steel have 1 to 400. Wider: soft grains that were chosen
/// are reported. Narrower: a mistake passes.
pub const YOUNG_IN_GIGAPASCALS: RangeInclusive<f64> = 0.5..=500.0;

/// The same in MPa. As above.
pub const YOUNG_IN_MEGAPASCALS: RangeInclusive<f64> = 1e3..=5e5;

/// Block sizes outside this range, m, are mistakes. Narrower: clay grains or mountains are
/// reported. Wider: micrometres pass.
pub const SIZE: RangeInclusive<f64> = 1e-6..=1e4;

/// Free blocks larger than this, m, are in millimetres, where the median is meant. Larger: bricks
/// of 250 mm pass. Smaller: a wedge of rock of 100 m is reported (the Hoek & Bray wedge of
/// `structures/` measures 79 m).
pub const LARGE: f64 = 200.0;

/// The same where there are [`MANY`] blocks or more: nobody models a slope by so many blocks as
/// large as towers, but hewn stones of 100 mm in millimetres are. Larger: small bricks in
/// millimetres pass. Smaller: jointed slopes are reported.
pub const LARGE_OF_MANY: f64 = 50.0;

/// The median free block of [`MANY`] or more measures this, m, where lengths are in centimetres or
/// inches: stones of 0.12 to 0.5 m in the one, of 0.3 to 1.3 m in the other. Lower: megaliths and
/// rockfill are reported. Higher: what may as well be in millimetres is told to be in centimetres.
pub const CENTIMETRES: RangeInclusive<f64> = 12.0..=50.0;

/// What is too large to be in metres may be in centimetres up to this, m. Larger: stones of more
/// than 3 m. Smaller: large stones in centimetres are taken for small bricks in millimetres.
pub const LARGE_IN_CENTIMETRES: f64 = 300.0;

/// Rotations of at most one turn in radians, each of which is a multiple of so many degrees, to
/// within [`ROUND_WITHIN`]. Larger: 25° in radians passes. Smaller: slight rotations that were meant
/// are reported.
pub const ROUND_DEGREES: f64 = 5.0;

/// In degrees: three digits of radians. Larger: slight rotations that were meant are reported.
/// Smaller: 0.349 for 20° passes.
pub const ROUND_WITHIN: f64 = 0.05;

/// So many free blocks are many. Fewer: a few huge rocks are reported. More: small arches pass.
pub const MANY: usize = 8;

/// A free block this many times as large as the median of at least [`SEVERAL`] is in millimetres
/// where the others are in metres. Wider: boulders among gravel are reported. Narrower: an odd
/// large block in millimetres passes.
pub const IN_MILLIMETRES_AMONG_METRES: RangeInclusive<f64> = 300.0..=5e3;

/// So many free blocks have a median that tells an odd one. Fewer: neither of two is the odd one.
pub const SEVERAL: usize = 3;

/// A block this many times larger or smaller than the median block is a mistake. Larger: a mistake
/// by a million on one block passes where the block was small. Smaller: the ground slab under a
/// heap of sand is reported.
pub const SIZE_RATIO: f64 = 1e5;

/// Coefficients of friction that are angles in degrees. Lower: rough joints with a coefficient of 3
/// are reported. Higher on the left: smooth joints of 10° pass. Higher on the right: coefficients
/// of 100 and more, which mean "no sliding", are reported.
pub const FRICTION_IN_DEGREES: RangeInclusive<f64> = 8.0..=89.0;

/// Friction angles in degrees that are radians, or coefficients (0.6 rad = 34°). Lower: a table
/// made as smooth as glass on purpose is reported. Higher: ice at 1.5° is. Narrower: 0.2 rad
/// passes.
pub const ANGLE_IN_RADIANS: RangeInclusive<f64> = 0.1..=1.45;

/// Compressive strengths, Pa, that are MPa. Outside: neither earth nor basalt.
pub const COMPRESSION_IN_MEGAPASCALS: RangeInclusive<f64> = 0.1..=400.0;

/// Compressive strengths, Pa, that are kPa.
pub const COMPRESSION_IN_KILOPASCALS: RangeInclusive<f64> = 400.0..=4e5;

/// A compressive strength is believed that carries a column of the same stone this high, m: earth
/// carries 20. Larger: weak fills are reported. Smaller: 50 MPa written in kPa pass.
pub const LEAST_COLUMN: f64 = 2.0;

/// Cohesions and tensile strengths, Pa, that are MPa.
pub const BOND_IN_MEGAPASCALS: RangeInclusive<f64> = 0.005..=5.0;

/// Cohesions and tensile strengths, Pa, that are kPa.
pub const BOND_IN_KILOPASCALS: RangeInclusive<f64> = 5.0..=2e3;

/// A cohesion, a tensile strength or a pressure of water is believed that holds this share of the
/// median block's weight per area of its size. Larger: damp sand (500 Pa on grains of a millimetre
/// holds 20 times the weight) stays far off, but weak joints of rubble are reported. Smaller: 200
/// kPa between stones of half a metre, written 200, pass.
pub const LEAST_BOND: f64 = 0.05;

/// Pressures of water, Pa, that are kPa: one metre of water is 9.81 kPa, two centimetres are 200
/// Pa.
pub const PORE_IN_KILOPASCALS: RangeInclusive<f64> = 0.5..=200.0;

/// A dead force below this share of its block's weight does nothing. Larger: small forces that
/// matter are reported. Smaller: 10 kN on a stone of a tonne, written 10, pass.
pub const LEAST_DEAD_FORCE: f64 = 2e-3;

/// Forces, N, that are kN. Higher: real small loads on large blocks are reported. Lower: 500 kN on
/// a pier pass.
pub const FORCE_IN_KILONEWTONS: RangeInclusive<f64> = 0.1..=1e3;

/// Weights of soil and masonry per volume, N/m³, that are kN/m³. Higher: snow is reported. Lower:
/// granite passes.
pub const UNIT_WEIGHT_IN_KILONEWTONS: RangeInclusive<f64> = 1.0..=100.0;

/// Two vectors are one when they differ by less than this share: own weight typed again as a load.
/// Larger: 1.01 times the weight, which somebody chose, is reported. Smaller: 9.80665 beside 9.81
/// passes.
pub const SAME: f64 = 1e-3;

/// Loads in multiples of the weight, that are accelerations in m/s²: 9.81. Wider: a chosen 9 or 10
/// is reported.
pub const WEIGHT_IN_ACCELERATION: RangeInclusive<f64> = 9.78..=9.84;

/// A force is on its block up to this × the block's size off it. Larger: a load on the next stone
/// passes. Smaller: loads on the true curve of an extrados whose stones are drawn with straight
/// chords are reported (twelve stones to a semicircle leave 0.03).
pub const ON_THE_BLOCK: f64 = 0.05;

/// A force further than this × the block's size off its block is refused, unless an arm is said to
/// carry it. Larger: loads in millimetres are answered. Smaller: a lever that somebody drew without
/// saying so is refused.
pub const FAR_OFF: f64 = 10.0;
