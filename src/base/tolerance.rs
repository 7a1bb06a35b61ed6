//! What decides a verdict, a contact, or whether a result is believed: every such number, its scale,
//! its default, and what breaks on either side. Steps and stops of one method, which change how fast
//! an answer comes and not what it is, stand with the method.

/// Vertices of one block closer than this × the block's size (bounding-box diagonal) are one
/// vertex. Larger: slivers of real thickness collapse (thickness / size 1e-6 is in the test suite).
/// Smaller: coordinates written in single precision (relative 6e-8) leave cracks and a block reads
/// as open.
pub const WELD: f64 = 1e-7;

/// Adjacent faces are one facet when their vertices lie within this × size of a common plane.
/// Larger: shallow polyhedra lose edges. Smaller: a triangulated plane face of a moved, rotated
/// block (coordinates rounded at 1e-12 of the scene) falls apart and interfaces depend on the
/// triangulation.
pub const COPLANAR: f64 = 1e-7;

/// A face is folded when its corners lie further off its mean plane than this × twice the way from
/// its first corner to the farthest. Larger: faces whose volume depends on how they are filled
/// pass, and may enclose more than their box. Smaller: warped beds of real vaults, a quarter of
/// whose twist of 0.2 is the greatest found, are refused.
pub const GREATEST_WARP: f64 = 0.05;

/// Default of `contact.gap`: facing faces closer than this × the smaller block's size touch.
/// Larger: detached blocks are closed silently into one. Smaller: files rounded to 4–5 digits lose
/// contacts.
pub const CONTACT_GAP: f64 = 1e-4;

/// Default of `contact.angle_deg`: faces further from anti-parallel than this, and than their warp
/// explains, do not face each other. Larger: a block tilted onto its edge on purpose lies flat.
/// Smaller: files rounded to 3 digits lose contacts of small faces.
pub const CONTACT_ANGLE_DEG: f64 = 1.0;

/// Default of `contact.min_area`: interfaces smaller than this × (smaller block's size)² are
/// ignored and counted. Larger: real small bearings vanish. Smaller: slivers from rounding along
/// shared edges become contacts.
pub const CONTACT_MIN_AREA: f64 = 1e-9;

/// Near misses are reported up to this many times `contact.gap`.
pub const NEAR_MISS_FACTOR: f64 = 100.0;

/// A scene is its own mirror image when points, centres and directions agree within this × block
/// size. Larger: skew scenes are solved as plane and their certificate fails. Smaller: plane scenes
/// that were turned or moved (coordinates rounded at 1e-12 of the scene) are solved in space, ten
/// times slower.
pub const MIRROR: f64 = 1e-9;

/// A scene is its own image under a turn or a mirror when points, centres, masses and loads agree
/// within this × their size. Larger: the forces of one part leave the others out of balance by as
/// much as arches near their limit do. Smaller: symmetric scenes whose coordinates were rounded at
/// 1e-15 of their extent, a thousand blocks wide, are solved whole.
pub const SYMMETRY: f64 = 1e-11;

/// A block or joint moves in a mechanism if its rate exceeds this × the greatest. Larger: slow
/// parts of a mechanism are left unnamed. Smaller: rounding of the solver names joints that rest.
pub const MECHANISM_REST: f64 = 1e-5;

/// Out-of-balance acceleration, in multiples of gravity, below which a scene counts as balanced and
/// above which as not. Larger: arches 1e-6 below their least thickness (equilibrium error 2e-7) pass as
/// stable. Smaller: the solver's last digits (1e-11) decide.
pub const EQUILIBRIUM_ERROR: f64 = 1e-9;

/// A load factor is found when its bracket is narrower than this × |λ| (plus
/// [`LOAD_FACTOR_FLOOR`]). Larger: answers with fewer digits. Smaller: walls of 10,000 blocks,
/// whose first attempt closes to 2e-7, go down the whole ladder for digits nobody reads.
pub const LOAD_FACTOR_WIDTH: f64 = 1e-6;

/// Absolute part of the width of a found load factor, in multiples of (total dead load / total live
/// load); it decides where λ is zero.
pub const LOAD_FACTOR_FLOOR: f64 = 1e-10;

/// The upper end that is claimed of a load factor lies beyond the proved one by this share of the width
/// above (1e-13 × |λ|): templates are drawn with sines, whose last bits are others on another machine
/// (3e-15 × λ between x86-64 and WebAssembly, an arch of 27 voussoirs), and what it proves there is to hold
/// the claim as well. Larger: wider brackets for nothing. Smaller: honest results of another machine are
/// refused.
pub const LOAD_FACTOR_ELSEWHERE: f64 = 1e-7;

/// Blocks of a mechanism whose speeds differ by less than this × the fastest are equally fast, and come in
/// the order of the scene. Larger: slower blocks before faster ones. Smaller: last bits, which are others on
/// another machine, decide.
pub const SAME_SPEED: f64 = 1e-9;

/// Friction cones are respected when no force lies further outside its own than this × itself: a
/// large force elsewhere makes no room. Larger: forged certificates pass. Smaller: rounding of a
/// correct force (1e-16) written to a file fails.
pub const CONE: f64 = 1e-12;

/// Blocks that touch nothing that is held fall freely when their loads together are more than this
/// × the sum of the sizes of their loads. Larger: what hardly falls is asked about in vain. Smaller:
/// rounding of loads that cancel each other moves it.
pub const FALLS_FREELY: f64 = 1e-6;

/// "Impossible" is proved when no load factor below this × (dead / live load) helps. Larger:
/// rounding of ℓ·q = 0 fails a correct proof. Smaller: a load factor that does help could be
/// missed.
pub const REACH: f64 = 1e6;

/// Forces or directions lie along another one, or across it, within this share of their size.
/// Larger: inclined loads would be turned as if they hung, and skew directions pass for unit ones
/// across gravity. Smaller: rounding of a rotated scene refuses true weights.
pub const ALONG: f64 = 1e-9;

/// A direction outwards, or one that a thrust is asked for along, is none where less than this ×
/// its size lies across gravity. Larger: supports a little beside the middle have no thrust.
/// Smaller: rounding decides where outwards is.
pub const ACROSS: f64 = 1e-6;

/// Vectors of a scene span a plane when their cross product is more than this × their sizes.
/// Larger: scenes that bend by less than 0.06° are no plane ones. Smaller: rounding of two equal
/// normals gives a plane of its own, which the test of the mirror then refuses.
pub const SPANS: f64 = 1e-3;

/// Saved and recomputed numbers of a result agree within this × their size. Larger: edited digits
/// pass. Smaller: rounding of another machine's arithmetic is taken for tampering.
pub const SAVED: f64 = 1e-6;

/// Loads on a block are a mixture of those of two other scenes when they differ by no more than this ×
/// the greatest of the three: worth the check that decides whether their forces hold it. Larger:
/// checks in vain. Smaller: rounding hides a mixture.
pub const MIXED_LOADS: f64 = 1e-9;

/// A mechanism proves instability when only contact forces above this × the total load could make
/// up for its inadmissibility. Larger: correct mechanisms close to the limit are refused (1e-8
/// below the least thickness the solver reaches about 13). Smaller: a mechanism that
/// interpenetrates could pass as a proof.
pub const FORCE_CAP: f64 = 3.0;

/// Forces that leave more than this out of balance on some block, in multiples of gravity, bound no
/// load factor: the first-order correction by the mechanism no longer holds. Larger: brackets that
/// do not contain the answer. Smaller: tall walls, whose forces are hundreds of block weights, lose
/// their brackets.
pub const LOOSE_BALANCE: f64 = 1e-5;
/// Near misses are reported up to this × the smaller block's size at most, however coarse
/// `contact.gap` is. Larger: with a coarse gap every face across an open joint is called a near
/// miss and every block is compared with its second neighbours. Smaller: the default reach (100 ×
/// [`CONTACT_GAP`] = 0.01) is cut.
pub const NEAR_MISS_LIMIT: f64 = 0.05;

/// Faces within the reach of near misses are reported up to this many degrees from parallel (or up
/// to `contact.angle_deg` where that is larger). Larger: the facets of round stones, each leaning
/// from the next, are called near misses. Smaller: joints of roughly cut voussoirs, a few degrees
/// apart, are left open without a word.
pub const NEAR_MISS_ANGLE_DEG: f64 = 5.0;

/// The warp of a face explains at most this lean (radians) of its parts from its mean plane.
/// Larger: a face folded by mistake faces everything around it. Smaller: real warped joints
/// (Armadillo Vault: 0.07) are left open.
pub const GREATEST_TWIST: f64 = 0.2;

/// In the plane of a contact, points closer than this × the smaller block's size are one point, and
/// a point this close to a line is on it. Larger: contact corners move, and with them the critical
/// thickness of an arch (decided to 1e-6 of the thickness). Smaller: rounding of moved and rotated
/// coordinates makes two corners of one.
pub const CONTACT_WELD: f64 = 1e-9;

/// A corner of a contact lies on the face that a strip is bonded to up to this × the smaller block's
/// size. Larger: thin joints lie on both faces. Smaller: faces that detection moved are missed.
pub const ON_FACE: f64 = 1e-4;

/// Lengths below this × the largest coordinate are rounding: a floor under every contact length.
/// Larger: real gaps far from the origin are lost. Smaller: sums of a few products of such
/// coordinates no longer fit.
pub const COORDINATE_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Where contacts form no closed chain, a resultant within this × the size of a contact of its edge,
/// or within this × its own size of the edge of friction, is left to the programs. Larger: piles
/// that are plain cost a program. Smaller: the rounding of long sums decides.
pub const FOREST_EDGE: f64 = 1e-9;

/// Gaps and overlaps below this × the smaller block's size are rounding: closed without a word.
/// Larger: gaps somebody drew are closed silently. Smaller: every rotated scene reports gaps.
pub const GAP_WORTH_TELLING: f64 = 1e-9;

/// A contact no wider than `contact.gap` is the rim of two faces that only just overlap, not a
/// bearing, where both faces are at least 1 / this times as wide. Larger: the bearing of a thin
/// plate's edge is taken for a rim. Smaller: blocks that meet along an edge, rounded to 4–5 digits,
/// become neighbours.
pub const RIM_SHARE: f64 = 0.1;

/// Directions closer than this (radians) to a face's plane lie in it, when edges and corners are
/// tested against faces. Larger: a corner may dig into the face. Smaller: edges in the plane,
/// rounded, are refused.
pub const CONTACT_ROUNDING_ANGLE: f64 = 1e-6;

/// Density of a block for which the scene gives none, kg/m³: common limestone and concrete.
pub const DEFAULT_DENSITY: f64 = 2400.0;

/// Points of an interface given by hand that lie further than this × the block's size outside its
/// bounding box are reported. Larger: a mistake of units passes on small contacts. Smaller: curved
/// blocks discretised coarsely are reported.
pub const GIVEN_APART: f64 = 0.5;

/// A shape thinner than this × its size is flat (thickness = volume / largest facet). Larger: thin
/// slabs and slivers are refused. Smaller: volume, centroid and inertia are rounding noise.
pub const FLAT: f64 = 1e-7;

/// Least bounding-box diagonal of a shape, m. Inertia grows as length⁵, and its square has to stay
/// clear of the smallest numbers. Larger: grains could be refused. Smaller: norms of inertias
/// become zero.
pub const LEAST_SIZE: f64 = 1e-30;

/// Greatest bounding-box diagonal of a shape, m. Larger: norms of inertias become infinite.
/// Smaller: planets are refused.
pub const GREATEST_SIZE: f64 = 1e30;
/// Template coordinates closer than this × the block length are the same line of the grid: a wall's
/// end or the edge of an opening that falls on a joint up to rounding does not cut a sliver off the
/// next block. Larger: openings meant to cut a thin piece lose it. Smaller: edges such as 3 × 0.1
/// miss the joint at 0.3 by rounding and leave slivers.
pub const GRID_SNAP: f64 = 1e-9;
/// Stored contact polygons with an area below this × (their diameter)² have no definite plane and
/// are left out by the importers. Larger: long bed joints between thin blocks vanish. Smaller: the
/// normal of a sliver is rounding noise.
pub const STORED_POLYGON_AREA: f64 = 1e-9;

/// Blocks whose lowest corner lies within this × the height of the scene above its lowest point are
/// proposed as supports. Larger: the first course of a tall structure is proposed with its base.
/// Smaller: springers on ground that is not quite level are missed.
pub const LOWEST_BAND: f64 = 0.01;

/// A fixed point of Coulomb's law counts as settled when the friction limits change by less than
/// this, in the loads that pass there. Larger: states that still wander are read. Smaller: the
/// engine's noise at small ε (1e-4) counts as wandering.
pub const COULOMB_SETTLED: f64 = 1e-3;

/// A state rests when its acceleration falls below this × the one at ten times the ε. Larger: slow
/// motions pass for rest. Smaller: soft, tall structures at rest stay undecided (exact
/// proportionality gives 0.1).
pub const ACCELERATION_FALLS: f64 = 0.2;

/// A state may move only when its acceleration stays above this × the one at ten times the ε.
/// Larger: moving states that ε still slows down stay undecided. Smaller: structures at rest that
/// are soft at large ε could pass for moving.
pub const ACCELERATION_STAYS: f64 = 0.8;

/// A motion obeys Coulomb's law when its natural map is below this. Larger: the sinking of soft
/// contacts passes for motion. Smaller: motions computed at ε = 1e-5 are refused.
pub const MOTION_LAW: f64 = 1e-3;

/// A motion obeys Coulomb's law to less than this × its greatest acceleration, where accelerations
/// in multiples of gravity count as much as each joint's own forces. Larger: forces that are not
/// quite those of the law (friction limits off by 4e-5, a rock wedge 1e-4 below its limit) pass for
/// a motion of 1e-4 g. Smaller: slow motions at the last ε stay undecided.
pub const MOTION_BREACH: f64 = 1e-2;

/// A block that is left with less than this of its load is at rest where its joints' friction has
/// settled no better than to a tenth of it ([`EQUILIBRIUM_ERROR`] where it has). Larger: slow slides at the
/// edge of friction pass for rest. Smaller: the last digits of the friction limits keep scenes of
/// many blocks undecided.
pub const AT_REST: f64 = 1e-6;

/// A load factor with dry friction is one up to which the scene rests when the state rests this
/// share of it below. Larger: a part that comes loose just below is overlooked. Smaller: states
/// that near to their limit neither rest nor move.
pub const REST_BELOW: f64 = 1e-3;

/// Where a state neither rests nor moves on the way to the proved bound, the load factor with dry
/// friction is the one up to which it was seen at rest, if that is no more than this share below
/// the bound. Larger: values that are far too low. Smaller: scenes without a value, though what is
/// open is little.
pub const REST_WITHIN: f64 = 0.1;

/// A state without self-stress moves when some block is left with at least this much of its load,
/// and rests only where no more than this is left of its acceleration beside what falls with ε.
/// Larger: slow slides at the edge of friction are refused (a rock wedge 1e-3 beyond its factor of
/// safety is left with 5e-4), or pass for rest (a flat arch that moves by 6e-4 sinks ten times as
/// much at ε = 1e-4). Smaller: what the regularisation leaves at rest on tall, soft structures could
/// be taken for motion, if it obeyed the law.
pub const LEAST_MOTION: f64 = 1e-4;

/// Where a joint of a mechanism closes by more than this × the speed of its two blocks, that is no
/// rounding of their speeds. Larger: a block squeezed at μ = 1e-5 could be "proved" to fall.
/// Smaller: rounding counts as [`COARSE_FORCE_CAP`] demands.
pub const ADMISSIBLE: f64 = 1e-7;

/// As [`FORCE_CAP`], for the joints that close by more than rounding of the speeds of their own
/// blocks. Larger: correct mechanisms with thousands of resting blocks are refused. Smaller: blocks
/// squeezed at μ = 1e-4 could be "proved" to fall. Contact forces above it, in total loads, are not
/// taken for evidence that something stands either.
pub const COARSE_FORCE_CAP: f64 = 1e4;

/// Given forces may leave this much out of balance on a block, in multiples of its load or of the
/// greatest force on it, where others that balance exactly are proved to exist near them. Larger:
/// forces that were tampered with still lead to a proof (of what is true). Smaller: correct forces
/// of large walls are not taken for evidence.
pub const NEAR_BALANCE: f64 = 1e-7;

/// The inadmissibility of a mechanism may hide at most this share of a load factor if every contact
/// carried the largest force. Larger: a forged mechanism that closes unloaded joints passes.
/// Smaller: walls of 10,000 blocks are refused.
pub const LOAD_FACTOR_BEHIND: f64 = 1e-3;

/// A load factor with dry friction is found when forces and mechanism obey Coulomb's law to this
/// (natural map). Larger: mechanisms that still lift where they slide pass. Smaller: δ must fall to
/// where the engine's noise rules.
pub const DRY_LAW: f64 = 1e-4;

/// What forces of a load factor with dry friction leave out of balance may have this share of the live
/// load's power on the mechanism. Larger: other values pass with the same evidence. Smaller: the
/// engine's noise at small δ.
pub const DRY_WIDTH: f64 = 1e-5;

/// Forces of a load factor with dry friction balance each block up to this, in multiples of its
/// load. Larger: values of iterations that still wander. Smaller: the engine's noise at small δ
/// (1e-5) leaves walls undecided.
pub const DRY_BALANCE: f64 = 1e-4;

/// In the dynamics shapes are smaller by this × the block's size, and the contacts add it again as
/// a skin, so that faces meet where they are but never touch exactly. Larger: edges and corners are
/// visibly round. Smaller: the engine's contact normals are rounding noise.
pub const SKIN: f64 = 2e-5;

/// As [`SKIN`], for hulls that flow: contacts are softer there. Larger: edges are visibly round, and
/// hulls that touch overlap at their corners by as much (6e-4 d). Smaller: contacts sink in deeper
/// than it, where the engine's normals are those of its search for the way out, and fewer heaps
/// have admissible forces (1e-4: 9 of 10).
pub const GRAIN_SKIN: f64 = 5e-4;

/// [`SKIN`] is at most this × the thickness of the thinnest piece of the block. Larger: thin plates
/// turn inside out. Smaller: plates of 1e-4 of their size get a skin of rounding noise.
pub const SKIN_OF_THICKNESS: f64 = 0.01;

/// A block has fallen in the dynamics when it moved by more than this × the least block thickness
/// and still moves. Larger: slow collapses outlast the horizon. Smaller: settling counts as
/// falling.
pub const FALLEN: f64 = 0.05;

/// On ground that moves a block has overturned when it has turned by more than this, rad. Larger:
/// blocks that lean on others after their fall pass for rocking. Smaller: squat blocks rock as far.
pub const OVERTURNED: f64 = std::f64::consts::FRAC_PI_4;

/// On ground that moves a block has fallen when it sank by more than this × its thickness. Larger:
/// voussoirs that drop onto others pass. Smaller: stones that slide down a slope a little are fallen.
pub const SUNK: f64 = 1.0;

/// A block is where it was in the dynamics when it moved by less than this × the least block
/// thickness. Larger: the first degrees of a slow collapse pass for rest. Smaller: tall columns,
/// which settle on soft contacts, are never at rest.
pub const SETTLED: f64 = 1e-3;

/// As [`SETTLED`], with fine steps and where everything came to rest. Larger: a structure that slid
/// and caught itself passes for one that stood. Smaller: a column of 100 blocks (0.2 %), or blocks
/// with gaps and overlaps of 1e-3 that close, stay undecided.
pub const SETTLED_FINE: f64 = 1e-2;

/// A block moves in the dynamics when its kinetic energy exceeds this × m g L. Larger: toppling 1 %
/// past the limit is called slow. Smaller: shaking contacts count as falling.
pub const MOVING_ENERGY: f64 = 1e-6;

/// A scene has come to rest in the dynamics when every block's kinetic energy stays below this × m
/// g L for [`REST_TIME`]. Larger: motion 1e-5 beyond the limit passes for rest. Smaller: columns of
/// 100 blocks, whose contact forces converge slowly, stay awake.
pub const REST_ENERGY: f64 = 1e-10;

/// How long a scene must rest, in multiples of √(L/g), L the median block size. Longer: time is
/// lost. Shorter: turning points pass for rest.
pub const REST_TIME: f64 = 3.0;
/// A compressive strength is respected when the pressures use no more than 1 + this of it. Larger:
/// crushing that counts. Smaller: the engine's last digits, amplified where a small part of a joint
/// carries, refuse correct forces.
pub const CRUSHING: f64 = 1e-7;

/// A critical value is found when it is known to this × its size. Larger: fewer digits than the
/// least equilibrium error holds. Smaller: the engine's last digits (1e-11 g) decide.
pub const CRITICAL_WIDTH: f64 = 1e-9;

/// A value at which a requirement begins to be met is narrowed until the answers on both sides lie
/// within this × its size. Larger: digits are lost. Smaller: load factors with brackets of 1e-8 no
/// longer tell the sides apart.
pub const MEET_WIDTH: f64 = 1e-6;

/// A critical value narrowed by its margin or by halving is claimed where the verdicts on both
/// sides are proved within this × its size; otherwise only the bracket is. Larger: a value far from
/// the flip passes for it. Smaller: flips with a flat margin, or next to values that stay
/// undecided, are brackets only.
pub const CRITICAL_BRACKET: f64 = 1e-4;

/// As [`CRITICAL_WIDTH`], for flips between verdicts with dry friction, which have no margin and
/// are found by halving. Larger: fewer digits. Smaller: states near the flip neither rest nor move,
/// and stay undecided.
pub const DRY_CRITICAL_WIDTH: f64 = 1e-6;

/// A least or greatest thrust is found when its bracket is narrower than this × its size (plus
/// [`THRUST_FLOOR`]). Larger: fewer digits. Smaller: walls go down the whole ladder for digits
/// nobody reads.
pub const THRUST_WIDTH: f64 = 1e-7;

/// Absolute part of the width of a found thrust, in multiples of the total load; it decides where a
/// thrust is zero.
pub const THRUST_FLOOR: f64 = 1e-9;

/// A line of thrust touches the edge of a section when it lies further out than 1 − this of the way
/// from the centroid. Larger: points that only come near are called hinges. Smaller: the engine's
/// last digits hide hinges.
pub const AT_EDGE: f64 = 1e-4;

/// Geometric safety factors are sought up to 1 / this. Larger: slender but centred structures have
/// none. Smaller: sections shrunk so far are rounding of the coordinates.
pub const LEAST_SHRINK: f64 = 1e-3;
/// Natural map of a load factor with dry friction with rates as the program has them
/// (`natural_map_in_loads`); a state that moves is
/// refined until it is below this. Larger: values with fewer digits than are shown. Smaller: δ and
/// ε must fall to where the engine's noise rules.
pub const NATURAL_MAP: f64 = 1e-6;

/// A contact carries nothing when its normal force is below this × the mean one. Larger: grains at
/// the top of a heap count as loose. Smaller: the engine's noise in forces that are zero counts as
/// contacts.
pub const UNLOADED: f64 = 1e-6;

/// A contact is about to slide when it uses all but this of its friction. Larger: contacts count
/// that have something left. Smaller: the engine's last digits decide.
pub const ABOUT_TO_SLIDE: f64 = 1e-4;

/// Grains rest when their mean kinetic energy is below this × m g d for [`GRAIN_REST_TIME`].
/// Larger: slow creep of the surface passes for rest. Smaller: the shaking of soft contacts counts
/// as flow.
pub const GRAIN_REST_ENERGY: f64 = 1e-6;

/// How long grains must rest, √(d/g). Longer: time is lost. Shorter: a pause between two avalanches
/// passes for rest.
pub const GRAIN_REST_TIME: f64 = 10.0;

/// Grains of a heap at rest touch when they are at most this × their size apart: what the soft
/// contacts of the dynamics leave open or press in. Larger: near neighbours that do not touch hold
/// each other. Smaller: contacts that carry are missed and the heap falls.
pub const GRAIN_GAP: f64 = 1e-3;
/// Answers of a sweep closer than this × themselves are the same. Larger: neighbours on a fine grid
/// are one. Smaller: the engine's last digits (1e-10) say which row is the least, or that a number
/// matters on which nothing depends.
pub const SAME_ANSWER: f64 = 1e-8;

/// A truncated distribution keeps at least this probability. Larger: tails that somebody asks for
/// are refused. Smaller: quantiles are rounding of the distribution function.
pub const TRUNCATION_KEEPS: f64 = 1e-9;

/// Radii of gyration count as at least this × the block's greatest. Larger: turning a long beam
/// about its axis is measured too coarsely. Smaller: rounding of the inertia of the thinnest
/// needles (its square root is exact to 1e-8 of the greatest) measures their moments.
pub const LEAST_GYRATION: f64 = 1e-7;

/// What it takes to start a task on a cluster, in seconds: scheduling, the process, reading what is
/// done. Larger: few large tasks, and processors wait for the last one. Smaller: clusters that take
/// this long spend their time on starting (0.3 to 1.5 s on an idle one).
pub const TASK_START: f64 = 1.0;

/// The share of a task's work that starting it may cost. Larger: time is lost. Smaller: sweeps of
/// minutes are not spread at all.
pub const SCHEDULING_SHARE: f64 = 0.05;
/// An answer with contacts closed that were left out is the same as that without them when they
/// differ by no more than this × the greater. Larger: a contact that matters is not told. Smaller:
/// the shift of a contact to the middle of its gap is taken for a difference.
pub const CLOSED_CONTACTS: f64 = 1e-3;
/// An undecided scene lies on the line between standing and falling when its least equilibrium error is
/// below this. Larger: solvers that lost their way are excused. Smaller: their last digits hide it.
pub const ON_THE_LINE: f64 = 1e-6;
/// Loads or sizes spread by more than this ratio are a cause why nothing came out. Larger: stiff
/// scenes are blamed on the solver. Smaller: scenes that are solved every day are blamed.
pub const WIDE_NUMBERS: f64 = 1e6;
/// Coefficients of friction above this are a cause why nothing came out. Larger or smaller: as
/// [`WIDE_NUMBERS`].
pub const STEEPEST_FRICTION: f64 = 100.0;

/// Copies of a corner of a carried joint that are closer than this × the smaller block's size touch,
/// and blocks that overlap by more are no pose. Larger: a hinge that has hardly opened presses all
/// over. Smaller: rounding of the poses opens what is closed.
pub const JOINT_CLOSED: f64 = 1e-9;

/// Supports and control points are where a parameter puts them up to this × the size of their block.
/// Larger: a point of another value passes. Smaller: rounding of saved poses is refused.
pub const ON_THE_WAY: f64 = 1e-9;

/// A support whose centre of mass lies nearer to the middle of several than this × their reach has no
/// outwards. Larger: supports near the middle of a ring are refused. Smaller: its direction is
/// rounding.
pub const AT_MIDDLE: f64 = 1e-6;

/// Two points of a path are linked where no block turns by more than this between them, rad: beyond,
/// the same points lie together in more than one way. Larger: a motion and one that passes elsewhere
/// are taken for each other. Smaller: more points than a curve needs.
pub const LONGEST_TURN: f64 = 0.5;

/// A load factor smaller than this × the natural one (dead load over live load) has vanished. Larger: a curve ends
/// early. Smaller: rounding of the last point is refused.
pub const VANISHES: f64 = 1e-6;
