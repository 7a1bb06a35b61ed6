//! Detection: every contact of an assembly, and a word on everything that nearly is one.
//!
//! 1. Candidate pairs, from a bounding-volume tree.
//! 2. [Face against face](super::faces); where a pair has no face contact, or a block is not
//!    convex, [edges and corners](super::features) as well; [spheres](super::spheres) exactly.
//! 3. A gap that is within tolerance only because a thin block fills it is no contact.
//! 4. What was closed, left apart or ignored becomes a [`Finding`](base::error::Finding) with its
//!    numbers.
//!
//! All tolerances are relative to the smaller block of a pair. Nothing depends on the order of
//! blocks, on how faces were triangulated, or on where and how the scene stands.

use super::{
    ContactKind, Interface, Interfaces,
    body::{BoundedBlock, Bounds, Form, Solidity},
    detect_candidates::candidates,
    detect_rims,
    detect_twice::Heaps,
    faces::{self, Closing},
    features, given,
    limits::Limits,
    meeting::{Meeting, Near, Overlap, Pair, of_face, of_touch},
    overlap,
    plane::Plane,
    spheres,
    tally::Tally,
    weightless,
};
use crate::assembly::{Assembly, JointLaw};
use base::{
    error::{InputError, JsonPath},
    limits::CONTACT_POINTS,
};
use nalgebra::Vector3;
use std::collections::{HashMap, HashSet};

/// Finds every contact of an assembly.
///
/// Interfaces given by hand are taken over, and their pairs are not looked at. Pairs of two
/// supports are looked at, counted if they touch, and left out.
///
/// # Errors
/// Two blocks touch and no rule says what friction acts between them.
pub fn detect(assembly: &Assembly) -> Result<Interfaces, InputError> {
    detect_until(assembly, &|| false)
}

/// The same, given up as soon as `is_over`.
///
/// # Errors
/// As [`detect`], and where it was given up.
pub fn detect_until(
    assembly: &Assembly,
    is_over: &dyn Fn() -> bool,
) -> Result<Interfaces, InputError> {
    let bodies: Vec<BoundedBlock> = assembly.blocks.iter().map(BoundedBlock::new).collect();
    let (whole, normals): (Vec<_>, Vec<_>) =
        assembly.given.iter().partition(|g| !g.points.is_empty());
    let by_hand: HashSet<(usize, usize)> =
        whole.iter().map(|g| (g.a.min(g.b), g.a.max(g.b))).collect();
    let mut interfaces = Interfaces::default();
    for g in whole {
        interfaces
            .list
            .push(given::interface(g, &Limits::of(&bodies[g.a], &bodies[g.b], &assembly.contact)));
    }

    // Of blocks in one place the first alone is looked at.
    let named = assembly.given.iter().flat_map(|g| [g.a, g.b]).collect();
    let heaps = Heaps::find(&bodies, &named);
    let looked = |i: usize| !heaps.is_again(i);
    let mut tally = Tally::default();
    let mut pairs = Vec::new();
    for (looked_at, (a, b, limits)) in
        candidates(&bodies, &looked, &assembly.contact)?.into_iter().enumerate()
    {
        if is_over() {
            let text = format!(
                "time limit reached after {looked_at} pairs of blocks had been checked for contacts"
            );
            return Err(InputError::at(JsonPath::root(), text).hint("allow more time"));
        }
        if !by_hand.contains(&(a, b)) {
            let meeting = meet(&bodies[a], &bodies[b], &limits);
            if !meeting.is_nothing() {
                pairs.push(Pair { a, b, limits, meeting });
            }
        }
    }
    take_apart(&mut pairs, &mut tally, assembly);

    detect_rims::meet(&mut pairs, &bodies);
    heaps.spread(&mut pairs, &assembly.blocks)?;
    for heap in heaps.all() {
        // Supports upon supports weigh nothing, and are counted as such.
        let (held, free): (Vec<usize>, Vec<usize>) =
            heap.iter().partition(|&&i| assembly.blocks[i].support);
        let told: Vec<usize> = held.first().into_iter().chain(&free).copied().collect();
        tally.in_one_place(&told);
    }
    detect_rims::name_normals(&mut pairs, &normals, assembly)?;

    let (mut points, mut apart) = (0, Vec::new());
    for Pair { a, b, limits, meeting } in pairs {
        if assembly.blocks[a].support && assembly.blocks[b].support {
            interfaces.support_pairs += usize::from(!meeting.contacts.is_empty());
            continue;
        }
        if let Some(near) = meeting.near {
            apart.push((near.closing, limits, a, b));
        }
        if meeting.twice {
            tally.twice(a, b);
        } else if let Some(overlap) = meeting.overlap {
            tally.overlap(overlap.depth, overlap.closing, &limits, a, b);
        }
        if meeting.idle {
            tally.without_normal(a, b);
        }
        meeting.small.iter().for_each(|&area| tally.small(area));
        if meeting.contacts.is_empty() {
            continue;
        }
        let law = law(assembly, a, b)?;
        points += meeting.contacts.iter().map(|c| c.points.len()).sum::<usize>();
        if points > CONTACT_POINTS {
            return Err(InputError::at(
                JsonPath::root(),
                format!("the blocks touch in more than {CONTACT_POINTS} points"),
            )
            .hint("ask about a part of the structure, or simplify its blocks"));
        }
        for contact in meeting.contacts {
            tally.contact(contact.gap, &limits);
            if !contact.ways.is_empty() {
                tally.flattened(a, b);
            }
            interfaces.list.push(Interface {
                a,
                b,
                kind: contact.kind,
                frame: contact.frame,
                points: contact.points,
                area: contact.area,
                patches: contact.patches,
                pieces: contact.pieces,
                ways: contact.ways,
                gap: contact.gap.mean,
                law,
            });
        }
    }
    let mut touches = vec![0_usize; assembly.blocks.len()];
    interfaces.list.iter().for_each(|f| [f.a, f.b].into_iter().for_each(|i| touches[i] += 1));
    // Neighbours in a packing and no joint that was missed: round blocks, or one that rests on
    // others beside a wall.
    let round = |i: usize| assembly.blocks[i].solid.is_round();
    let rests = |i: usize| round(i) && !assembly.blocks[i].support && touches[i] >= 2;
    for (closing, limits, a, b) in apart {
        match round(a) && round(b) || rests(a) || rests(b) {
            true => tally.neighbours(closing, a, b),
            false => tally.near(closing, &limits, a, b),
        }
    }
    interfaces.list.sort_by(|x, y| {
        let center =
            |i: &Interface| i.points.iter().sum::<Vector3<f64>>() / i.points.len().max(1) as f64;
        let (p, q) = (center(x), center(y));
        (x.a, x.b)
            .cmp(&(y.a, y.b))
            .then(p.x.total_cmp(&q.x))
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
    });
    interfaces.left_out = tally.left_out(assembly);
    interfaces.apart = tally.apart();
    interfaces.findings = tally.findings(assembly);
    let told = interfaces.join(assembly)?;
    interfaces.findings.extend(told);
    interfaces.findings.extend(weightless::finding(assembly, &interfaces));
    Ok(interfaces)
}

/// How the joint between two blocks that touch resists.
fn law(assembly: &Assembly, a: usize, b: usize) -> Result<JointLaw, InputError> {
    assembly.joints.law(a, b, &assembly.blocks).ok_or_else(|| {
        let (one, other) = (&assembly.blocks[a].id, &assembly.blocks[b].id);
        InputError::at(
            JsonPath::root(),
            format!("blocks {one:?} and {other:?} touch, but no friction is given between them"),
        )
        .hint(
            "give joints.default.friction, or a joint override for these blocks or their materials",
        )
    })
}

impl Interfaces {
    /// The interfaces of an assembly that differs from the one they were [detected](detect) in by
    /// its joints, loads, masses and gravity alone: where blocks touch is kept, how they resist is
    /// that of `assembly`.
    ///
    /// # Errors
    /// As [`detect`].
    pub fn with_joints_of(&self, assembly: &Assembly) -> Result<Self, InputError> {
        let mut interfaces = self.clone();
        // Those given by hand stand in the order of the scene.
        let mut given = assembly.given.iter();
        for interface in &mut interfaces.list {
            let [a, b] = [interface.a, interface.b];
            interface.law = match interface.kind {
                ContactKind::Given => match given.find(|g| [g.a, g.b] == [a, b]) {
                    Some(own) => own.law,
                    None => interface.law,
                },
                _ => law(assembly, a, b)?,
            };
        }
        // What the joints of strips have to say was said where they were detected.
        interfaces.join(assembly)?;
        Ok(interfaces)
    }
}

fn meet(a: &BoundedBlock, b: &BoundedBlock, limits: &Limits) -> Meeting {
    match (&a.shape, &b.shape) {
        (Form::Polyhedron(p), Form::Polyhedron(q)) => polyhedra(a, p, b, q, limits),
        (Form::Balls(one), Form::Balls(other)) => {
            let twice = spheres::is_twice(one, other, limits);
            let meeting = round(spheres::balls_balls(one, other, limits), 1.0, limits);
            Meeting { twice: twice && meeting.overlap.is_some(), ..meeting }
        }
        (Form::Balls(balls), Form::Polyhedron(q)) => {
            round(spheres::balls_polyhedron(balls, q, limits), 1.0, limits)
        }
        (Form::Polyhedron(p), Form::Balls(balls)) => {
            round(spheres::balls_polyhedron(balls, p, limits), -1.0, limits)
        }
    }
}

/// What spheres met; `sign` turns the normals to point from `a` into `b`.
fn round(meeting: spheres::Meeting, sign: f64, limits: &Limits) -> Meeting {
    let closing = |gap: f64| Closing { gap, lean: 0.0 };
    Meeting {
        contacts: meeting.touches.into_iter().map(|t| of_touch(t, sign)).collect(),
        near: meeting.near.map(|gap| Near { gap, closing: closing(gap), plane: None }),
        overlap: meeting.overlap.map(|depth| Overlap {
            depth,
            closing: Some(closing(depth)).filter(|c| c.gap <= limits.near),
        }),
        ..Meeting::default()
    }
}

fn polyhedra(
    a: &BoundedBlock,
    p: &Solidity,
    b: &BoundedBlock,
    q: &Solidity,
    limits: &Limits,
) -> Meeting {
    if p.polyhedron.is_apart_from(q.polyhedron, limits.near)
        || q.polyhedron.is_apart_from(p.polyhedron, limits.near)
    {
        return Meeting::default();
    }
    let window = |slack: f64| a.bounds.loosened(slack).common(&b.bounds.loosened(slack));
    let facing = faces::facing(p, q, &window(limits.near), limits);
    let convex = p.polyhedron.convex && q.polyhedron.convex;
    let on_faces = !facing.contacts.is_empty();
    let mut meeting =
        Meeting { small: facing.small.iter().map(|f| f.area).collect(), ..Meeting::default() };

    // Two convex blocks that meet face to face meet nowhere else.
    let close = a.bounds.distance(&b.bounds) <= limits.gap;
    if close && !(convex && on_faces) {
        let known = facing.contacts.iter().chain(&facing.small);
        let touches = features::touches(p, q, &window(limits.gap), limits, &|p, n| {
            known.clone().any(|f| f.covers(p, n, limits))
        });
        meeting.contacts.extend(touches.into_iter().map(|t| of_touch(t, 1.0)));
        let common = a.bounds.common(&b.bounds);
        if (!convex || meeting.contacts.is_empty())
            && (0..3).all(|k| common.hi[k] - common.lo[k] > limits.gap)
        {
            let near = facing.near.map(|n| n.closing);
            meeting.overlap = overlap::depth(p, q, &common, limits).map(|depth| {
                let closing = near.or_else(|| closed_by(p, q, depth, &window(limits.near), limits));
                Overlap { depth, closing }
            });
        }
    }
    meeting.rims = meeting.overlap.is_none() && facing.near.is_none() && !(convex && on_faces);
    meeting.twice = meeting.overlap.is_some() && overlap::is_twice(p, q, limits);
    if meeting.overlap.is_none() {
        meeting.near = facing.near.map(|n| Near {
            gap: n.gap,
            closing: n.closing,
            plane: Some(Plane::new(n.at, n.n)),
        });
    }
    meeting.contacts.extend(facing.contacts.iter().map(|f| of_face(f, limits)));
    meeting
}

/// The tolerance with which two overlapping blocks meet face to face; none where no such one is near.
fn closed_by(
    a: &Solidity,
    b: &Solidity,
    depth: f64,
    window: &Bounds,
    limits: &Limits,
) -> Option<Closing> {
    if depth > limits.near {
        return None;
    }
    let wider = Limits { gap: depth * (1.0 + 1e-9), ..*limits };
    let closing = Closing { gap: depth, lean: 0.0 };
    (!faces::facing(a, b, window, &wider).contacts.is_empty()).then_some(closing)
}

/// Two blocks facing each other across a gap: a contact or a near miss.
#[derive(Clone, Copy)]
struct Link {
    pair: usize,
    plane: Plane,
    gap: f64,
}

/// Drops contacts and near misses across a gap that a third block fills (a thin plate, a mortar
/// bed): closing it would push the plate aside.
fn take_apart(pairs: &mut [Pair], tally: &mut Tally, assembly: &Assembly) {
    let mut links = Vec::new();
    let mut of_block: HashMap<usize, Vec<usize>> = HashMap::new();
    for (k, pair) in pairs.iter().enumerate() {
        let faces = pair.meeting.contacts.iter().filter(|c| c.kind == ContactKind::Face);
        let planes = faces.map(|c| (Plane { origin: c.points[0], frame: c.frame }, c.gap.greatest));
        let near = pair.meeting.near.iter().filter_map(|n| n.plane.map(|plane| (plane, n.gap)));
        for (plane, gap) in planes.chain(near) {
            of_block.entry(pair.a).or_default().push(links.len());
            of_block.entry(pair.b).or_default().push(links.len());
            links.push(Link { pair: k, plane, gap });
        }
    }
    // Links of `block` that lie within the open gap `link`, with the neighbour and whether the
    // block lies below.
    let filling = |block: usize, link: &Link, sign: f64| -> Vec<usize> {
        let noise = pairs[link.pair].limits.noise;
        of_block
            .get(&block)
            .into_iter()
            .flatten()
            .map(|&l| &links[l])
            .filter(|other| {
                let out = if pairs[other.pair].a == block { sign } else { -sign };
                other.pair != link.pair
                    && other.plane.frame.n.dot(&link.plane.frame.n) * out > 0.9
                    && link.plane.height(other.plane.origin).abs() <= 0.75 * link.gap + noise
            })
            .map(|other| {
                if pairs[other.pair].a == block { pairs[other.pair].b } else { pairs[other.pair].a }
            })
            .collect()
    };
    let held: Vec<(usize, f64)> = links
        .iter()
        .filter(|link| link.gap > pairs[link.pair].limits.noise)
        .filter(|link| {
            let pair = &pairs[link.pair];
            let above_a = filling(pair.a, link, 1.0);
            !above_a.is_empty() && filling(pair.b, link, -1.0).iter().any(|c| above_a.contains(c))
        })
        .map(|link| (link.pair, link.gap))
        .collect();
    for (k, gap) in held {
        let Pair { a, b, meeting, .. } = &mut pairs[k];
        let before = meeting.contacts.len();
        meeting.contacts.retain(|c| c.kind != ContactKind::Face || c.gap.greatest != gap);
        if meeting.near.as_ref().is_some_and(|n| n.gap == gap) {
            meeting.near = None;
        }
        if meeting.contacts.len() < before
            && !(assembly.blocks[*a].support && assembly.blocks[*b].support)
        {
            tally.held_apart(*a, *b);
        }
    }
}
