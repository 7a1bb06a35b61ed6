//! The only file that names rapier: bodies in, poses and contact forces out, all in the engine's
//! units.
//!
//! Settings, each measured on masonry and against the engine's defaults:
//! * hulls smaller by a skin that the contacts add again: hulls that touch exactly get wrong
//!   normals (a column of ten blocks was thrown 1.7 m into the air);
//! * contacts of natural frequency 0.1 / substep and damping ratio 2 (with 5, stacks of six drums
//!   with many contact points shake), no recycled contacts, no clusters, no sleep, no limit of
//!   speed;
//! * friction of a contact patch as a whole (`FrictionModel::Simplified`: 0.06 % on static
//!   friction; friction point by point underestimates it by up to 14 %), its coefficient set pair
//!   by pair through a hook; loose spheres of one kind need none ([`Frictions::combined`]), and
//!   alone may take contacts over from step to step while they hardly move
//!   ([`World::recycle`]; pairs with a hook are always found anew).

use super::{
    bodies::{Body, Combined, Form, Frictions, Role},
    refused::Refused,
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rapier3d::{
    math::{Pose, Rotation, Vector},
    prelude::*,
};
use std::collections::BTreeMap;

/// Natural frequency of a contact × substep. Lower: contacts sink in, by its square. Higher: stacks
/// shake.
const FREQUENCY: f64 = 0.1;
/// Damping ratio of a contact.
const DAMPING: f64 = 2.0;

/// Contacts of masonry are prepared up to this distance, in median block sizes. Larger: neighbours
/// round a corner are seen at wrong normals. Smaller: fast blocks sink in before they are seen.
pub(super) const PREDICTION: f64 = 0.005;

/// A contact whose normal points more into another piece of the same block than out of it, by this
/// in the cosine, is none.
const SEAM: f64 = 1e-3;

/// Points of one contact that the engine solves for.
const CORNERS: usize = 4;
/// Two four-cornered faces meet in eight corners at most.
const MOST_POINTS: usize = 8;
/// Quarters of a contact whose areas differ by less than this part are alike.
const ALIKE: f64 = 1e-3;
/// Marks a contact point that bore no load before.
const NEW_CONTACT: u64 = 1 << 31;

/// Contacts as stiff as a step allows.
fn softness(step: Step) -> SpringCoefficients<f64> {
    SpringCoefficients {
        natural_frequency: FREQUENCY * step.iterations as f64 / step.dt,
        damping_ratio: DAMPING,
    }
}

/// How finely time is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// In the engine's unit of time.
    pub dt: f64,
    /// Substeps.
    pub iterations: usize,
    /// Threads of the engine.
    pub threads: usize,
    /// Contacts are prepared up to this distance, in the engine's unit of length.
    pub prediction: f64,
    /// Coefficient of restitution of every contact.
    pub restitution: f64,
    /// Whether bodies with faces rest on edges and corners: of more points of a contact than the
    /// engine takes, the deepest is then one. Points that span most let grains sink in beside them,
    /// by up to 4 % of their size.
    pub pointed: bool,
}

/// A force of one contact patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub a: usize,
    pub b: usize,
    /// On `b`, mean over the last step.
    pub force: Vector3<f64>,
    /// Normal part of it, > 0.
    pub normal_force: f64,
    /// From `a` into `b`.
    pub normal: Vector3<f64>,
}

/// A scene in motion.
pub(super) struct World<'a> {
    hooks: Hooks<'a>,
    parameters: IntegrationParameters,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
    handles: Vec<RigidBodyHandle>,
    /// By body: its centre of mass ([`Body::com`]).
    coms: Vec<Vector3<f64>>,
    /// Last poses of bodies that were taken away.
    gone: BTreeMap<usize, Pose>,
    healthy: bool,
}

struct Hooks<'a> {
    frictions: &'a Frictions<'a>,
    /// By collider.
    shapes: Vec<Seam>,
    /// [`Step::pointed`].
    pointed: bool,
}

struct Seam {
    body: usize,
    role: Role,
    inner: Vec<Vector>,
    outer: Vec<Vector>,
}

impl<'a> World<'a> {
    /// A world; the error says what the engine does not take.
    pub fn new(list: &[Body], frictions: &'a Frictions<'a>, step: Step) -> Result<Self, Refused> {
        let softness = softness(step);
        let combined = frictions.combined(list);
        let parameters = IntegrationParameters {
            dt: step.dt,
            num_solver_iterations: step.iterations,
            contact_softness: softness,
            static_contact_softness: softness,
            contact_recycling: false,
            contact_clustering: false,
            friction_model: FrictionModel::Simplified,
            normalized_prediction_distance: step.prediction,
            normalized_max_linear_velocity: f64::MAX,
            max_ccd_substeps: 0,
            ..IntegrationParameters::default()
        };
        let mut pipeline = PhysicsPipeline::new();
        pipeline
            .configure_thread_pool(step.threads)
            .map_err(|e| Refused::Threads(e.to_string()))?;
        let mut world = Self {
            hooks: Hooks { frictions, shapes: Vec::new(), pointed: step.pointed },
            parameters,
            pipeline,
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            impulse_joints: ImpulseJointSet::new(),
            multibody_joints: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
            handles: Vec::with_capacity(list.len()),
            coms: list.iter().map(|body| body.com).collect(),
            gone: BTreeMap::new(),
            healthy: true,
        };
        for (index, body) in list.iter().enumerate() {
            let combined = combined.as_ref().map(|list| list[index]);
            world.insert(index, body, step.restitution, combined)?;
        }
        Ok(world)
    }

    fn insert(
        &mut self,
        index: usize,
        body: &Body,
        restitution: f64,
        combined: Option<Combined>,
    ) -> Result<(), Refused> {
        let pose = Pose::from_parts(vector(body.center), Rotation::IDENTITY);
        let builder =
            if body.support { RigidBodyBuilder::fixed() } else { RigidBodyBuilder::dynamic() };
        let inertia = rapier3d::math::Matrix::from_cols_array_2d(&body.inertia.data.0);
        let mass = MassProperties::with_inertia_matrix(vector(body.com), body.mass, inertia);
        let handle = self
            .bodies
            .insert(builder.pose(pose).can_sleep(false).additional_mass_properties(mass));
        self.handles.push(handle);
        for shape in &body.shapes {
            let refused = || Refused::Piece(index);
            let collider = match &shape.form {
                Form::Ball { at, radius } => {
                    ColliderBuilder::ball(*radius).translation(vector(*at))
                }
                Form::Cuboid { at, turn, half } => ColliderBuilder::cuboid(half.x, half.y, half.z)
                    .position(Pose::from_parts(
                        vector(*at),
                        Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w),
                    )),
                Form::Hull { points, triangles } => {
                    let points: Vec<_> = points.iter().map(|p| vector(*p)).collect();
                    // A piece whose faces are turned inside out by the skin is its hull.
                    ColliderBuilder::convex_mesh(points.clone(), triangles)
                        .or_else(|| ColliderBuilder::convex_hull(&points))
                        .ok_or_else(refused)?
                }
            };
            let asked = ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS;
            let hooks = if combined.is_some() { ActiveHooks::empty() } else { asked };
            // Of two rules the engine follows the one that stands later here: average, least,
            // greatest.
            let (friction, rule) = match combined {
                None => (0.0, CoefficientCombineRule::Average),
                Some(Combined::Own(friction)) => (friction, CoefficientCombineRule::Average),
                Some(Combined::AtMost(friction)) => (friction, CoefficientCombineRule::Min),
                Some(Combined::AtLeast(friction)) => (friction, CoefficientCombineRule::Max),
            };
            let collider = collider
                .density(0.0)
                .restitution(restitution)
                .friction(friction)
                .friction_combine_rule(rule)
                .contact_skin(shape.skin)
                .active_hooks(hooks)
                .user_data(self.hooks.shapes.len() as u128);
            let directions = |list: &[Vector3<f64>]| list.iter().map(|n| vector(*n)).collect();
            let (inner, outer) = (directions(&shape.inner), directions(&shape.outer));
            self.hooks.shapes.push(Seam { body: index, role: shape.role, inner, outer });
            self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        }
        Ok(())
    }

    /// Sets force and torque about the centre of a body until they are set again.
    pub fn load(&mut self, body: usize, force: Vector3<f64>, torque: Vector3<f64>) {
        let torque = torque - self.arm(body).cross(&force);
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            body.reset_forces(false);
            body.reset_torques(false);
            body.add_force(vector(force), true);
            body.add_torque(vector(torque), true);
        }
    }

    /// From the centre of a body to its centre of mass, which is another one where it carries
    /// something.
    fn arm(&self, body: usize) -> Vector3<f64> {
        match self.coms[body] {
            com if com == Vector3::zeros() => com,
            com => self.pose(body).1 * com,
        }
    }

    /// Goes on with other steps; contacts become as stiff as these allow.
    ///
    /// Where grains have faces, friction is that of each point from here on. That of a patch acts
    /// in the middle of all its points, those that are about to touch among them: a grain on one
    /// corner came to rest where nothing holds it, held by friction beside the corner.
    pub fn refine(&mut self, step: Step) {
        if self.hooks.pointed {
            self.parameters.friction_model = FrictionModel::Coulomb;
        }
        self.parameters.dt = step.dt;
        self.parameters.num_solver_iterations = step.iterations;
        self.parameters.contact_softness = softness(step);
        self.parameters.static_contact_softness = softness(step);
    }

    /// From now on contacts of loose spheres of one kind are not found anew while the two have
    /// moved by less than this against each other, in the engine's unit of length; 0: always anew.
    pub fn recycle(&mut self, distance: f64) {
        self.parameters.contact_recycling = distance > 0.0;
        self.parameters.normalized_contact_recycle_distance = distance;
    }

    /// Takes a body away; nothing may be asked of it but its last pose.
    pub fn remove(&mut self, body: usize) {
        let last = self.bodies.get(self.handles[body]).map(|b| *b.position());
        self.bodies.remove(
            self.handles[body],
            &mut self.islands,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            true,
        );
        self.gone.extend(last.map(|pose| (body, pose)));
    }

    /// Puts the centre of a body somewhere else.
    pub fn place(&mut self, body: usize, center: Vector3<f64>) {
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            body.set_translation(vector(center), true);
        }
    }

    /// Lets a body move along z alone, and along the others with the velocity that it is given.
    pub fn guide(&mut self, body: usize) {
        let held = LockedAxes::ROTATION_LOCKED
            | LockedAxes::TRANSLATION_LOCKED_X
            | LockedAxes::TRANSLATION_LOCKED_Y;
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            body.set_locked_axes(held, true);
        }
    }

    /// Moves a support at this velocity from now on, or a guided body along x and y.
    pub fn push(&mut self, body: usize, velocity: Vector3<f64>) {
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            let mut velocity = vector(velocity);
            if body.is_dynamic() {
                velocity.z = body.linvel().z;
            } else {
                body.set_body_type(RigidBodyType::KinematicVelocityBased, true);
            }
            body.set_linvel(velocity, true);
        }
    }

    /// Has a support there, and so turned since the start, at the end of the next step.
    pub fn carry(&mut self, body: usize, center: Vector3<f64>, turn: UnitQuaternion<f64>) {
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            body.set_body_type(RigidBodyType::KinematicPositionBased, true);
            let turn = Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w);
            body.set_next_kinematic_position(Pose::from_parts(vector(center), turn));
        }
    }

    /// Takes the speed out of a body.
    pub fn stop(&mut self, body: usize) {
        if let Some(body) = self.bodies.get_mut(self.handles[body]) {
            body.set_linvel(Vector::ZERO, true);
            body.set_angvel(Vector::ZERO, true);
        }
    }

    /// One step in time.
    pub fn step(&mut self) {
        // A worker of a work-stealing pool that waited for the engine's threads would begin other
        // work meanwhile, on the same stack, and with simulations in that work without end. A plain
        // thread waits.
        if rayon::current_thread_index().is_some() {
            let ended = std::thread::scope(|scope| scope.spawn(|| self.advance()).join());
            ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        } else {
            self.advance();
        }
    }

    fn advance(&mut self) {
        self.pipeline.step(
            Vector::ZERO,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &self.hooks,
            &(),
        );
        self.healthy &= self.pipeline.quarantine().is_empty();
    }

    /// Whether every number stayed finite.
    pub fn is_healthy(&self) -> bool {
        self.healthy
    }

    /// Centre and orientation of a body.
    pub fn pose(&self, body: usize) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let there = self.bodies.get(self.handles[body]).map(|b| *b.position());
        let pose = there.or_else(|| self.gone.get(&body).copied()).unwrap_or(Pose::IDENTITY);
        let r = pose.rotation;
        (back(pose.translation), UnitQuaternion::new_normalize(Quaternion::new(r.w, r.x, r.y, r.z)))
    }

    /// Velocity of the centre and spin of a body.
    pub fn velocity(&self, body: usize) -> (Vector3<f64>, Vector3<f64>) {
        let there = &self.bodies[self.handles[body]];
        let (velocity, spin) = (back(there.linvel()), back(there.angvel()));
        (velocity - spin.cross(&self.arm(body)), spin)
    }

    /// Forces of all contact patches that carry any, in the order of the colliders.
    ///
    /// A normal impulse is the sum over the substeps of the last step; of friction the engine keeps
    /// the last substep's impulse, that of a patch on every point of it. At rest all substeps are
    /// alike.
    pub fn patches(&self) -> Vec<Patch> {
        let (dt, substeps) = (self.parameters.dt, self.parameters.num_solver_iterations as f64);
        let shared = self.parameters.friction_model == FrictionModel::Simplified;
        let mut list = Vec::new();
        for pair in self.narrow_phase.contact_pairs() {
            let PairContacts::Rigid(contacts) = &pair.contacts else { continue };
            let shape = |handle| self.colliders.get(handle).and_then(|c| self.hooks.shape(c));
            let (Some(a), Some(b)) = (shape(pair.collider1), shape(pair.collider2)) else {
                continue;
            };
            for manifold in contacts.solver_manifolds() {
                let active = || {
                    manifold
                        .data
                        .solver_contacts
                        .iter()
                        .filter_map(|c| manifold.points.get(c.contact_indices()[0] as usize))
                };
                let normal_force = active().map(|p| p.data.impulse).sum::<f64>() / dt;
                if normal_force <= 0.0 {
                    continue;
                }
                let own = active().take(if shared { 1 } else { usize::MAX });
                let friction = own
                    .fold(Vector::ZERO, |sum, p| sum + p.data.warmstart_tangent_world)
                    * (substeps / dt);
                let normal = back(manifold.data.normal);
                let force = normal * normal_force - back(friction);
                list.push((
                    pair.collider1.into_raw_parts(),
                    pair.collider2.into_raw_parts(),
                    Patch { a: a.body, b: b.body, force, normal_force, normal },
                ));
            }
        }
        list.sort_by_key(|(one, other, _)| (*one, *other));
        list.into_iter().map(|(_, _, patch)| patch).collect()
    }
}

impl Hooks<'_> {
    fn shape(&self, collider: &Collider) -> Option<&Seam> {
        self.shapes.get(collider.user_data as usize)
    }
}

impl PhysicsHooks for Hooks<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let shape = |handle| context.colliders.get(handle).and_then(|c| self.shape(c));
        let (a, b) = (shape(context.collider1)?, shape(context.collider2)?);
        let touch = match (a.role, b.role) {
            (Role::Part, Role::Part) => !self.frictions.is_given(a.body, b.body),
            (one, other) => one == other,
        };
        touch.then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let collider = |handle| context.colliders.get(handle);
        let (Some(one), Some(other)) = (collider(context.collider1), collider(context.collider2))
        else {
            return;
        };
        let (Some(a), Some(b)) = (self.shape(one), self.shape(other)) else { return };
        let (turn1, turn2) = (one.position().rotation, other.position().rotation);
        let skins = one.contact_skin() + other.contact_skin();
        let place = *one.position();
        let ModifiableContacts::Rigid(manifold) = &mut context.contacts else { return };
        let (friction, closed) = match a.role {
            Role::Part => {
                let known = self.frictions.between(a.body, b.body);
                (known.friction, known.closed)
            }
            Role::Given(interface) => (self.frictions.given(interface), 0.0),
        };
        *manifold.friction = friction;
        let normal = *manifold.normal;
        if a.at_seam(turn1.inverse() * normal) || b.at_seam(turn2.inverse() * -normal) {
            return manifold.solver_contacts.clear();
        }
        if closed != 0.0 {
            return manifold.solver_contacts.iter_mut().for_each(|c| c.dist -= closed);
        }
        if self.pointed {
            return;
        }
        // The engine adds the point where its search for the normal ended, which wanders: corners
        // do without.
        let corners =
            manifold.manifold.points.iter().filter(|p| p.fid1 != PackedFeatureId::UNKNOWN).count();
        if corners > CORNERS {
            spread(manifold, place, *other.position(), skins);
        } else if corners >= CORNERS - 1 {
            let points = &manifold.manifold.points;
            let known = |c: &SolverContact| {
                points
                    .get(c.contact_indices()[0] as usize)
                    .is_some_and(|p| p.fid1 != PackedFeatureId::UNKNOWN)
            };
            if manifold.solver_contacts.iter().filter(|c| known(c)).count() == corners {
                manifold.solver_contacts.retain(known);
            } else {
                spread(manifold, place, *other.position(), skins);
            }
        }
    }
}

/// Of a contact with more points than the engine takes, the four that span the largest area.
///
/// The engine's own choice starts from the deepest point, which is another one at every step, and
/// shakes drums off each other.
fn spread(manifold: &mut ModifiableManifold, place1: Pose, place2: Pose, skins: f64) {
    let Some(pattern) = manifold.solver_contacts.first().copied() else { return };
    let points = &manifold.manifold.points;
    let own: Vec<usize> = (0..points.len())
        .filter(|&i| points[i].fid1 != PackedFeatureId::UNKNOWN)
        .take(MOST_POINTS)
        .collect();
    let local: Vec<Vector3<f64>> = own.iter().map(|&i| back(points[i].local_p1)).collect();
    let normal = back(manifold.manifold.local_n1);
    let middle = super::cell::mean(&local);
    let axis = Vector3::ith(normal.iamin(), 1.0).cross(&normal);
    let side = normal.cross(&axis);
    let angle = |p: &Vector3<f64>| side.dot(&(p - middle)).atan2(axis.dot(&(p - middle)));
    let mut order: Vec<usize> = (0..local.len()).collect();
    order.sort_by(|&i, &j| angle(&local[i]).total_cmp(&angle(&local[j])));
    let area =
        |[i, j, k, l]: [usize; 4]| (local[k] - local[i]).cross(&(local[l] - local[j])).dot(&normal);
    let (mut best, mut chosen) = (0.0, [0; 4]);
    let n = order.len();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                for l in k + 1..n {
                    let four = [order[i], order[j], order[k], order[l]];
                    // Equal quarters of a regular outline differ by rounding only: the first one
                    // stays.
                    if area(four) > (1.0 + ALIKE) * best {
                        (best, chosen) = (area(four), four);
                    }
                }
            }
        }
    }
    if best == 0.0 && own.len() > CORNERS {
        return;
    }
    let mut chosen = if own.len() > CORNERS { chosen.map(|i| own[i]).to_vec() } else { own };
    chosen.sort_unstable();
    manifold.solver_contacts.clear();
    for index in chosen {
        let point = &points[index];
        let dist = point.dist - skins;
        if dist < PREDICTION {
            let id = index as u64 | if point.data.impulse == 0.0 { NEW_CONTACT } else { 0 };
            let (anchor1, anchor2) = (place1 * point.local_p1, place2 * point.local_p2);
            let mut contact = pattern;
            (contact.contact_id, contact.anchor1, contact.anchor2, contact.dist) =
                ([id], anchor1, anchor2, dist);
            manifold.solver_contacts.push(contact);
        }
    }
}

impl Seam {
    /// Whether a contact with this outward normal belongs to the neighbouring piece of the same
    /// block.
    fn at_seam(&self, normal: Vector) -> bool {
        let best = |list: &[Vector]| list.iter().map(|n| n.dot(normal)).fold(-1.0, f64::max);
        !self.inner.is_empty() && best(&self.inner) > best(&self.outer) - SEAM
    }
}

fn vector(v: Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn back(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}
