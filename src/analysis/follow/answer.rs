//! The answers of `settle` and `push`: a path whose every point is proved by itself.

use super::{
    End, Follow, Path, Point,
    branch::follow,
    moved::Moved,
    tracker::{meets, size},
};
use crate::{
    Claims, Control, LoadFactor, Proved, SettleOptions, assess, coulomb, limit,
    question::PushOptions, repair,
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use check::{
    path::{
        Carried, Displaced, Drive, Move, Moves, member, reaction,
        saved::{SavedPose, read_poses, write_poses},
    },
    terms::Law,
    verdict::{
        Evidence, Forces, Rate, Verdict, certificate,
        claim::{self, Claim, Findings},
        exact::{existence, motion},
    },
};
use model::{
    assembly::{Member, Pose, Solid, Wrench},
    interface::Model,
};
use nalgebra::Vector3;
use std::{
    cell::{Cell, RefCell},
    collections::{HashMap, HashSet},
};

/// A path with its proofs.
#[derive(Clone, Debug)]
pub struct Followed {
    /// What moves it.
    pub drive: Drive,
    /// Where it goes.
    pub path: Path,
    /// What proves each point, in order.
    pub proofs: Vec<PointProof>,
    /// It falls: what proves the last pose that stands and the first that falls.
    pub ends: Vec<PointProof>,
    /// At the start: least power of the supports that move, with forces and rates.
    pub least: Option<(reaction::Least, Forces, Vec<Rate>)>,
}

/// What proves a point.
#[derive(Clone, Debug)]
pub struct PointProof {
    /// The displaced scene.
    pub model: Model,
    /// What is proved of it; nothing where the check refused it.
    pub claim: Option<Claim>,
    /// Forces.
    pub forces: Forces,
    /// Rates.
    pub rates: Vec<Rate>,
    /// What the check found.
    pub findings: Findings,
    /// Of a load factor with dry friction: what bounds it from above.
    pub bound: Option<Box<PointProof>>,
    /// The forces that the motion has there, where those that prove it are others.
    pub motion: Option<Forces>,
}

/// A path that was followed before, and who hears of what comes.
pub struct GoesOn<'a> {
    /// The last pose that is known; none: the start.
    pub from: &'a [SavedPose],
    /// Hears of points with their proofs as they are found, of each once. What it has heard of last is a pose from which the path goes on as it would have.
    pub hears: &'a mut dyn FnMut(&Followed),
}

/// Steps of the curve, over the size of the scene.
const STEP: f64 = 2e-3;

/// How far a control point is followed, × the diagonal of the box around the free blocks that move.
/// What turns over goes no farther than twice as far; what slides would never end.
const FAR: f64 = 2.0;

/// Follows a scene whose supports move.
///
/// # Errors
/// A name that fits no support, a support that is told to move twice or not at all, a way outwards
/// where there is no outwards; a scene that cannot be followed.
pub fn settle(
    model: &Model,
    options: &SettleOptions,
    control: &Control,
    goes_on: Option<GoesOn>,
) -> Result<Followed, InputError> {
    let error = |text: String| InputError::at(JsonPath::root(), text);
    followable(model)?;
    let blocks = &model.assembly.blocks;
    let drive = Drive::settle(&model.assembly, options)?;
    let Drive::Settle(Moves(moves)) = &drive else { return Err(error("no support moves".into())) };
    let speed = moves.iter().map(|m| speed(model, m)).fold(0.0, f64::max);
    let goes =
        |i: usize| moves.iter().any(|m| i == m.support && (m.way, m.turn) != Default::default());
    let held = |m: &Member| {
        let ends = m.action.ends();
        ends.iter().flatten().any(|&i| goes(i))
            && ends.iter().flatten().any(|&i| !blocks[i].support)
    };
    let touches = model.interfaces.list.iter().any(|f| goes(f.a) || goes(f.b))
        || model.interfaces.members.iter().any(held);
    if !touches {
        return Err(error("no support that moves touches a free block".into()));
    }
    let begun = begin(model, &drive, &options.from)?;
    let from = later(model, &drive, goes_on.as_ref(), begun.clone())?;
    let how = |own: &Model| Follow {
        drive: drive.clone(),
        until: 1.0,
        at: options.at.clone(),
        step: STEP * size(own) / speed,
        from: from.clone(),
        dry: false,
    };
    Ok(answer(model, &how, control, goes_on))
}

/// Follows a scene under its live load, a point of it pushed along.
///
/// # Errors
/// No such block, no live load; a scene that cannot be followed.
pub fn push(
    model: &Model,
    options: &PushOptions,
    control: &Control,
    goes_on: Option<GoesOn>,
) -> Result<Followed, InputError> {
    followable(model)?;
    if model.assembly.live.iter().all(|w| *w == Wrench::zero()) {
        let path = JsonPath::root().key("loads").key("live");
        return Err(InputError::at(path, "the scene has no live load on a free block")
            .hint("add \"loads\": { \"live\": [ { \"weight\": [1, 0, 0] } ] } to the scene"));
    }
    let drive = Drive::push(&model.assembly, options)?;
    let begun = begin(model, &drive, &options.from)?;
    let from = later(model, &drive, goes_on.as_ref(), begun.clone())?;
    let how = |own: &Model| Follow {
        drive: drive.clone(),
        until: FAR * bodies(own) + begun.as_ref().map_or(0.0, |f| f.0),
        at: options.at.clone(),
        step: STEP * size(own),
        from: from.clone(),
        dry: control.law == Law::Coulomb,
    };
    Ok(answer(model, &how, control, goes_on))
}

/// The parameter at saved poses, and they; nothing where there are none.
fn begin(
    model: &Model,
    drive: &Drive,
    saved: &[SavedPose],
) -> Result<Option<(f64, Vec<Pose>)>, InputError> {
    if saved.is_empty() {
        return Ok(None);
    }
    let error = |text: &str| {
        let hint = "give a result of `settle` or `push` for this scene and this motion";
        InputError::at(JsonPath::root(), format!("the poses to begin at {text}")).hint(hint)
    };
    let assembly = &model.assembly;
    let poses = read_poses(assembly, saved)
        .map_err(|e| error(&format!("are not poses of this scene: {e}")))?;
    let blocks = &assembly.blocks;
    let value = match drive {
        Drive::Push { block, point, toward } => {
            poses[*block].way(&blocks[*block].centroid, point).dot(toward)
        }
        Drive::Settle(Moves(moves)) => {
            // By the support that goes farthest, beside its size.
            let far = |m: &Move| m.way.norm() / blocks[m.support].size + m.turn.norm();
            let most = moves.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
            most.map_or(0.0, |m| {
                let (pose, length) = (&poses[m.support], blocks[m.support].size);
                let turn = pose.turn.scaled_axis();
                (m.way.dot(&pose.shift) / length.powi(2) + m.turn.dot(&turn))
                    / (m.way.norm_squared() / length.powi(2) + m.turn.norm_squared())
            })
        }
    };
    let off = (0..blocks.len())
        .filter(|&i| blocks[i].support)
        .map(|i| {
            let there = drive.pose(i, value);
            (poses[i].shift - there.shift).norm() / blocks[i].size
                + poses[i].turn.angle_to(&there.turn)
        })
        .fold(0.0, f64::max);
    if !(off <= tolerance::ON_THE_WAY && value >= 0.0) {
        return Err(error("have supports where this motion does not put them"));
    }
    let deepest = Carried::new(model).displaced(&poses).deepest;
    if deepest.is_some_and(|c| c.gap < -tolerance::JOINT_CLOSED) {
        return Err(error("have blocks that overlap"));
    }
    Ok(Some((value, poses)))
}

/// Where it was followed to before; else where it was to begin.
fn later(
    model: &Model,
    drive: &Drive,
    goes_on: Option<&GoesOn>,
    begun: Option<(f64, Vec<Pose>)>,
) -> Result<Option<(f64, Vec<Pose>)>, InputError> {
    match goes_on {
        Some(known) if !known.from.is_empty() => begin(model, drive, known.from),
        _ => Ok(begun),
    }
}

/// What cannot be followed.
pub(super) fn followable(model: &Model) -> Result<(), InputError> {
    let refuse = |text: String, hint: &str| {
        Err(InputError::at(JsonPath::root(), text).hint(hint.to_string()))
    };
    let blocks = &model.assembly.blocks;
    if let Some(f) = model.interfaces.list.iter().find(|f| !f.law.is_dry()) {
        return refuse(
            format!(
                "the joint between {} and {} has a strength, water or a rolling arm: motions are followed with dry joints only",
                blocks[f.a].id, blocks[f.b].id
            ),
            "use `assess` or `limit` for the first instant",
        );
    }
    let members = &model.interfaces.members;
    if let Some(m) = members.iter().find(|m| !m.is_idle() && !member::is_followed(m)) {
        return refuse(
            format!(
                "member {:?}: motions are followed with ties, struts, bars, tendons, soil and toothed corners, not with a {}",
                m.id,
                m.kind.word()
            ),
            "use `assess` or `limit` for the first instant",
        );
    }
    let round = |i: usize| !matches!(blocks[i].solid, Solid::Polyhedron(_));
    if let Some(f) = model.interfaces.list.iter().find(|f| round(f.a) || round(f.b)) {
        let id = &blocks[if round(f.a) { f.a } else { f.b }].id;
        return refuse(
            format!("{id} is round: contacts that roll to other points of a body are not followed"),
            "`voussoir simulate` runs it in time",
        );
    }
    Ok(())
}

/// How far a support carries what lies on it at most while the parameter goes from 0 to 1, m: where
/// it touches, and as far as that turns the blocks there.
fn speed(model: &Model, m: &Move) -> f64 {
    let blocks = &model.assembly.blocks;
    let at = |p: &Vector3<f64>| (m.way + m.turn.cross(&(p - blocks[m.support].centroid))).norm();
    let list = model.interfaces.list.iter().filter(|f| f.a == m.support || f.b == m.support);
    let touches = list.map(|f| {
        let other = if f.a == m.support { f.b } else { f.a };
        f.points.iter().map(at).fold(0.0, f64::max) + m.turn.norm() * blocks[other].size
    });
    let most = touches.reduce(f64::max);
    most.unwrap_or_else(|| m.way.norm() + m.turn.norm() * blocks[m.support].size)
}

/// Diagonal of the box around the free blocks, m.
fn bodies(model: &Model) -> f64 {
    let extents = model.assembly.free().map(|i| model.assembly.blocks[i].solid.extent());
    let all = extents.reduce(|(l, h), (low, high)| (l.inf(&low), h.sup(&high)));
    all.map_or(0.0, |(low, high)| (high - low).norm())
}

/// `how` to follow what moves.
fn answer(
    model: &Model,
    how: &dyn Fn(&Model) -> Follow,
    control: &Control,
    goes_on: Option<GoesOn>,
) -> Followed {
    let moved = Moved::of(model, &how(model).drive, control);
    let how = &how(moved.as_ref().map_or(model, |m| &m.own));
    let carried = Carried::new(model);
    let prove = |point: &Point| proof(&carried, how, point, control);
    // What supports carry as they begin to move is said of the start.
    let asked = !how.drive.is_push() && how.from.is_none();
    let least = |path: &Path| {
        path.first.as_ref().filter(|_| asked).map(|(forces, rates)| {
            (reaction::least(model, forces, rates), forces.clone(), rates.clone())
        })
    };
    let (heard, steps) = (RefCell::new((Heard::default(), goes_on)), Cell::new(1));
    let hears = |path: &dyn Fn() -> Path| {
        control.doing(|| format!("step {} of the path", steps.replace(steps.get() + 1)));
        let (heard, goes_on) = &mut *heard.borrow_mut();
        let Some(goes_on) = goes_on else { return };
        let mut new = path();
        let between = new.between.saturating_sub(heard.between);
        let points = new.points.split_off(heard.proofs.len().min(new.points.len()));
        let proofs: Vec<PointProof> = points.iter().map(prove).collect();
        heard.between += between;
        heard.proofs.extend(points.iter().map(|p| p.value).zip(proofs.clone()));
        let least = least(&new).filter(|_| heard.proofs.len() == proofs.len());
        let path = Path { points, between, ..new };
        let drive = how.drive.clone();
        (goes_on.hears)(&Followed { drive, path, proofs, ends: Vec::new(), least });
    };
    let none = HashSet::new();
    let path = match &moved {
        None => {
            let joints = Carried::new(model).joints;
            let joined = joints.iter().map(|f| (f.a.min(f.b), f.a.max(f.b))).collect();
            let meets = |poses: &[Pose], known: bool| {
                meets(model, if known { &joined } else { &none }, poses)
            };
            follow(model, how, control.deadline, (&meets, &hears))
        }
        Some(moved) => {
            let from = how.from.as_ref().map(|(value, poses)| (*value, moved.own_poses(poses)));
            let own = Follow { drive: moved.drive(&how.drive), from, ..how.clone() };
            // What moves may still run into what rests.
            let joined = moved.joined();
            let meets = |poses: &[Pose], known: bool| {
                meets(model, if known { &joined } else { &none }, &moved.poses(poses))
            };
            let hears = |path: &dyn Fn() -> Path| hears(&|| moved.path(path()));
            moved.path(follow(&moved.own, &own, control.deadline, (&meets, &hears)))
        }
    };
    let mut known = heard.into_inner().0.proofs.into_iter().peekable();
    let mut known =
        |point: &Point| known.next_if(|(value, _)| *value == point.value).map(|(_, proof)| proof);
    let proofs = path.points.iter().map(|p| known(p).unwrap_or_else(|| prove(p))).collect();
    let ends = match &path.end {
        End::Falls(ends) => ends.iter().map(prove).collect(),
        _ => Vec::new(),
    };
    let least = least(&path);
    Followed { drive: how.drive.clone(), path, proofs, ends, least }
}

/// What of a path somebody has heard of.
#[derive(Default)]
struct Heard {
    /// Of each point its parameter and what proves it.
    proofs: Vec<(f64, PointProof)>,
    between: usize,
}

/// Proves a point from its poses, as anybody who reads them can.
fn proof(carried: &Carried, how: &Follow, point: &Point, control: &Control) -> PointProof {
    // From the poses as they are saved: to the last digit what a reader of them proves.
    let assembly = &carried.start.assembly;
    let saved = write_poses(assembly, &point.poses);
    let poses = read_poses(assembly, &saved).unwrap_or_else(|_| point.poses.clone());
    let found = carried.displaced(&poses);
    let model = &found.model;
    if how.drive.is_push() {
        if let Some(own) = linkage_proof(carried, &found, point, &poses) {
            return own;
        }
        let l = limit(model, &Control { law: Law::Associative, ..*control });
        return match &point.touch {
            None => {
                let forces = carried_forces(carried, &found, point, &poses);
                PointProof::of(model, &l).moving(forces)
            }
            Some(touch) => dry_proof(carried, &found, (point, touch), &l, control),
        };
    }
    if let Some(touch) = &point.touch {
        let at = |forces: &Forces| slid_forces(carried, &found, forces, touch);
        let motion = point.proving.as_ref().and_then(|_| balanced(model, at(&point.forces), 0.0));
        let proving = at(point.proving.as_ref().unwrap_or(&point.forces));
        let proof = stands_or_falls(model, proving, &point.rates, control);
        return PointProof { motion: motion.or(proof.motion), ..proof };
    }
    let forces = carried_forces(carried, &found, point, &poses);
    stands_or_falls(model, forces, &point.rates, control)
}

/// The forces of a point at the contacts that its poses have; corners that touch again without
/// having to are among the contacts, and carry nothing.
fn carried_forces(carried: &Carried, found: &Displaced, point: &Point, poses: &[Pose]) -> Forces {
    let model = &found.model;
    let touching = carried.touching(poses, &point.closed);
    let mut forces = check::verdict::no_forces(&model.interfaces);
    let joints = touching.model.interfaces.list.len();
    for (own, given) in forces[model.interfaces.list.len()..]
        .iter_mut()
        .zip(&point.forces[joints.min(point.forces.len())..])
    {
        own.clone_from(given);
    }
    // Of several contacts of a joint the first.
    let places = found.from.iter().enumerate().rev();
    let first: HashMap<usize, usize> = places.map(|(c, &k)| (k, c)).collect();
    for (c, given) in point.forces.iter().take(joints).enumerate() {
        let (k, from) = (touching.from[c], &touching.model.interfaces.list[c]);
        let Some(&to) = first.get(&k) else { continue };
        for (p, w) in from.points.iter().zip(given) {
            let near = |q: &&Vector3<f64>| (**q - p).norm() <= 1e-7 * carried.size(k);
            if let Some(at) = model.interfaces.list[to].points.iter().position(|q| near(&q)) {
                forces[to][at] += *w;
            }
        }
    }
    forces
}

/// Proves a load factor by what the linkage has: the forces that balance it, and its motion, which
/// closes no joint. Nothing where that is refused, and at the start, where all joints are closed: a
/// program finds forces with room there, which prove it exactly.
fn linkage_proof(
    carried: &Carried,
    found: &Displaced,
    point: &Point,
    poses: &[Pose],
) -> Option<PointProof> {
    let start = poses.iter().all(|p| *p == Pose::start());
    if start || point.touch.is_some() || point.rates.is_empty() {
        return None;
    }
    let model = &found.model;
    let mut forces = carried_forces(carried, found, point, poses);
    repair::cut(&model.interfaces, &mut forces);
    let rates = point.rates.clone();
    let upper = claim::upper_bound(motion::motion(model, &rates), || {
        certificate::kinematics(model, &rates, &forces).upper()
    });
    let lower = point.load_factor.min(upper);
    let width = claim::width(lower, claim::natural_factor(&model.assembly));
    let upper = upper + tolerance::LOAD_FACTOR_ELSEWHERE * width;
    let claim = Some(Claim::LoadFactor { value: lower, lower, upper });
    let proof = PointProof::of(model, &Proved::new(model, Side { claim, forces, rates }));
    proof.claim.is_some().then_some(proof)
}

/// Forces of a motion, where they are ones: without members, and balanced as dry friction leaves it.
fn balanced(model: &Model, forces: Forces, load_factor: f64) -> Option<Forces> {
    let left = || certificate::statics(model, &forces, load_factor).equilibrium_error;
    let are = model.interfaces.members.is_empty() && left() <= tolerance::DRY_BALANCE;
    are.then_some(forces)
}

/// Proves that a displaced scene stands with these forces, or falls by these rates.
fn stands_or_falls(model: &Model, forces: Forces, rates: &[Rate], control: &Control) -> PointProof {
    let rest = || vec![Rate::zero(); model.assembly.blocks.len()];
    let proved = |claim: Claim, forces: Forces, rates: Vec<Rate>| {
        PointProof::of(model, &Proved::new(model, Side { claim: Some(claim), forces, rates }))
    };
    let stands = |forces: Forces| {
        let stands = proved(Claim::Stable, forces.clone(), rest());
        // What a program leaves is more than what counts as balance in large scenes.
        if stands.claim.is_some() {
            return stands;
        }
        let motion = balanced(model, forces.clone(), 0.0);
        if let Some(better) = existence::improved(model, &forces, 0.0) {
            return PointProof { motion, ..proved(Claim::Stable, better, rest()) };
        }
        // The least forces leave no room to improve them; others do.
        let any = assess(model, &Control { law: Law::Associative, ..*control });
        if any.verdict == Verdict::Stable {
            return PointProof { motion, ..proved(Claim::Stable, any.forces.clone(), rest()) };
        }
        stands
    };
    if rates.iter().all(|r| *r == Rate::zero()) {
        return stands(forces);
    }
    let falls = proved(Claim::Unstable, forces.clone(), rates.to_vec());
    if falls.claim.is_some() {
        return falls;
    }
    // What all but touches may do so in the poses as they are written.
    let any = assess(model, &Control { law: Law::Associative, ..*control });
    match any.verdict {
        Verdict::Unstable => proved(Claim::Unstable, any.forces.clone(), any.rates.clone()),
        _ => stands(forces),
    }
}

/// Proves a load factor after sliding: forces and a mechanism that obey Coulomb's law together, and
/// the bound of forces inside the friction cones, which no value passes. Where the two are one
/// number the bound says it, from both sides.
fn dry_proof(
    carried: &Carried,
    found: &Displaced,
    (point, touch): (&Point, &Touch),
    bound: &Proved<LoadFactor>,
    control: &Control,
) -> PointProof {
    let (model, value) = (&found.model, point.load_factor);
    let width = claim::width(value, claim::natural_factor(&model.assembly));
    let forces = slid_forces(carried, found, &point.forces, touch);
    if bound.claim().is_some() && bound.value.is_some_and(|b| (b - value).abs() <= width) {
        return PointProof::of(model, bound).moving(forces);
    }
    let own =
        Side { claim: Some(Claim::DryLoadFactor { value }), forces, rates: point.rates.clone() };
    let proved = Proved::new(model, own);
    let mut proof = PointProof::of(model, &proved);
    if proof.claim.is_none() {
        let dry = coulomb::complementary(model, bound, control);
        let other = PointProof::of(model, &Proved::new(model, dry));
        if other.claim.is_some() {
            proof = other;
        }
    }
    proof.bound = bound.claim().is_some().then(|| Box::new(PointProof::of(model, bound)));
    proof
}

/// The joint at the start of every contact, and where it touches.
type Touch = [(usize, Vec<Vector3<f64>>)];

/// The forces of a point after sliding at the contacts that its poses have.
fn slid_forces(carried: &Carried, found: &Displaced, own: &Forces, touch: &Touch) -> Forces {
    let list = &found.model.interfaces.list;
    let mut forces = check::verdict::no_forces(&found.model.interfaces);
    for ((k, places), given) in touch.iter().zip(own) {
        for (at, w) in places.iter().zip(given) {
            let near = (0..list.len())
                .filter(|&c| found.from[c] == *k)
                .flat_map(|c| (0..list[c].points.len()).map(move |p| (c, p)))
                .find(|&(c, p)| (list[c].points[p] - at).norm() <= 1e-6 * carried.size(*k));
            if let Some((c, p)) = near {
                forces[c][p] += *w;
            }
        }
    }
    repair::cut(&found.model.interfaces, &mut forces);
    forces
}

impl PointProof {
    /// A load factor, with the forces of the motion beside those that prove it, where these balance
    /// the same loads.
    fn moving(self, mut forces: Forces) -> Self {
        let Some(Claim::LoadFactor { value, .. }) = self.claim else { return self };
        repair::cut(&self.model.interfaces, &mut forces);
        let motion = balanced(&self.model, forces, value);
        Self { motion, ..self }
    }

    fn of<T: Claims>(model: &Model, proved: &Proved<T>) -> Self {
        let Evidence { forces, rates, .. } = proved.evidence();
        Self {
            model: model.clone(),
            claim: proved.claim(),
            forces: forces.clone(),
            rates: rates.to_vec(),
            findings: proved.findings().clone(),
            bound: None,
            motion: None,
        }
    }
}

/// What is claimed of a pose at one side of the place where it falls, or on the way there.
struct Side {
    claim: Option<Claim>,
    forces: Forces,
    rates: Vec<Rate>,
}

impl Claims for Side {
    fn claim(&self) -> Option<Claim> {
        self.claim
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence::new(&self.forces, &self.rates)
    }

    fn withdraw(&mut self) {
        self.claim = None;
    }
}

impl Followed {
    /// The forces on the supports that move, N, at a point.
    pub fn reactions(&self, proof: &PointProof) -> Vec<(usize, Wrench)> {
        let Drive::Settle(moves) = &self.drive else { return Vec::new() };
        moves
            .0
            .iter()
            .map(|m| (m.support, reaction::on_support(&proof.model, &proof.forces, m.support)))
            .collect()
    }
}
