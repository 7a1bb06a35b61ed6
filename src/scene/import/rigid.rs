//! Bodies of several shapes, as programs for robots have them, → blocks.
//!
//! A free body is one block: of spheres a clump, of anything else a polyhedron with a shell a shape. Of what
//! is held, every shape is a block of its own.

use super::{
    raw::{Grain, Ground, Heft, Raw, Solid, Surface, tally},
    text,
};
use crate::Material;
use base::{
    error::{FindingCode, InputError},
    limits,
    tolerance::{CONTACT_GAP, DEFAULT_DENSITY},
};
use nalgebra::{Isometry3, Point3, Vector3};
use std::{
    collections::{BTreeMap, HashMap, HashSet},
    f64::consts::PI,
    rc::Rc,
};

/// How far a side of the prism may lie from the cylinder that it stands for, relative to the cylinder's
/// size (bounding-box diagonal). Larger: two cylinders that touch part by more than the gap that contacts
/// may have ([`CONTACT_GAP`]); with a quarter of it their sizes may differ three times. Smaller: corners for
/// nothing.
const SAGITTA: f64 = 0.25 * CONTACT_GAP;

/// Parts of one block are smaller by this share of their size. Larger: what touches another block no longer
/// does ([`CONTACT_GAP`]). Smaller: shells touch, to rounding of files in single precision.
const APART: f64 = 1e-6;

/// Fewest sides of such a prism: of needles, whose width is next to nothing of their size.
const FEWEST_SIDES: usize = 16;

/// The shape of a part, about its own origin, m.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// Half lengths along x, y, z.
    Cuboid([f64; 3]),
    Sphere(f64),
    /// Along z.
    Cylinder {
        radius: f64,
        half: f64,
    },
    /// Solid below z = 0, without bounds.
    Plane,
    Mesh(Rc<Mesh>),
}

/// Corners and faces of a mesh.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    pub vertices: Vec<[f64; 3]>,
    pub faces: Vec<Vec<usize>>,
}

/// What a part adds to the mass of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Weight {
    /// kg/m³.
    Density(f64),
    /// kg.
    Mass(f64),
    /// Nothing: the body has its mass by itself.
    None,
}

/// One shape of a body.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// For the name of a block of its own; may be empty.
    pub name: String,
    pub line: usize,
    pub form: Form,
    pub pose: Isometry3<f64>,
    pub weight: Weight,
    pub surface: Option<Surface>,
    /// Weighs, but touches nothing.
    pub is_ghost: bool,
}

/// What moves as one, or is held.
#[derive(Debug, Default)]
pub(super) struct Body {
    /// May be empty.
    pub id: String,
    pub line: usize,
    pub support: bool,
    pub parts: Vec<Part>,
    /// Masses, kg, with their centres, that come beside those of the parts.
    pub lumps: Vec<(f64, Point3<f64>)>,
    /// Nothing is said of its mass: it is for the scene to assume.
    pub is_unweighed: bool,
}

/// The blocks of all bodies.
///
/// # Errors
/// A free body without mass, or of shapes that no one block can have; too many copies of a mesh.
pub(super) fn gather(bodies: Vec<Body>, raw: &mut Raw) -> Result<(), InputError> {
    let mut made = Made::default();
    let mut copied = 0_usize;
    for body in bodies {
        for part in &body.parts {
            if let Form::Mesh(mesh) = &part.form {
                copied += 24 * mesh.vertices.len() + 48 * mesh.faces.len();
            }
        }
        limits::afford("the meshes up to this one", copied as u64, 4)
            .map_err(|e| InputError { position: Some((body.line, 1)), ..e })?;
        if body.support { made.hold(body, raw) } else { made.free(body, raw)? }
    }
    made.tell(raw);
    Ok(())
}

/// What there is to know of all bodies.
#[derive(Default)]
struct Made {
    taken: HashSet<String>,
    next: HashMap<String, usize>,
    renamed: Vec<String>,
    held: Vec<String>,
    ghosts: Vec<String>,
    joined: Vec<String>,
    mixed: Vec<String>,
    cylinders: Vec<String>,
    planes: Vec<String>,
    unweighed: Vec<String>,
}

impl Made {
    /// A name that no block has yet.
    fn name(&mut self, wanted: String, fallback: &str) -> String {
        if !wanted.is_empty() && self.taken.insert(wanted.clone()) {
            return wanted;
        }
        let is_named = !wanted.is_empty();
        let base = if is_named { wanted } else { fallback.to_string() };
        let next = self.next.entry(base.clone()).or_insert(if is_named { 2 } else { 1 });
        let id = loop {
            let id = format!("{base}-{next}");
            *next += 1;
            if self.taken.insert(id.clone()) {
                break id;
            }
        };
        if is_named {
            self.renamed.push(format!("{base:?} → {id:?}"));
        }
        id
    }

    /// Each shape of a body that is held is a block.
    fn hold(&mut self, body: Body, raw: &mut Raw) {
        let alone = body.parts.iter().filter(|p| !p.is_ghost).count() == 1;
        for part in body.parts {
            let wanted = match (body.id.is_empty(), part.name.is_empty()) {
                (true, _) => part.name.clone(),
                (false, _) if alone => body.id.clone(),
                (false, true) => String::new(),
                (false, false) => format!("{}-{}", body.id, part.name),
            };
            if part.is_ghost {
                self.ghosts.push(place(&part.name, part.line));
                continue;
            }
            let fallback = if body.id.is_empty() { "support" } else { &body.id };
            let id = self.name(wanted, fallback);
            self.held.push(format!("{id:?}"));
            self.add(id, body.line.max(part.line), true, vec![part], Heft::default(), raw);
        }
    }

    /// A free body is one block.
    fn free(&mut self, body: Body, raw: &mut Raw) -> Result<(), InputError> {
        let fault = |text: String, hint: &str| Err(text::error(body.line, text).hint(hint));
        let named = place(&body.id, body.line);
        if let Some(plane) = body.parts.iter().find(|p| matches!(p.form, Form::Plane)) {
            return Err(text::error(
                plane.line,
                format!("body {named}: a plane on a body that moves"),
            )
            .hint("planes are for what is held: give the body a box"));
        }
        let heft = if body.is_unweighed { None } else { Some(heft(&body)) };
        if heft.is_some_and(|h| h.mass.or(h.density).is_none_or(|m| m <= 0.0)) {
            return fault(
                format!("body {named} has no mass"),
                "give its shapes a density or a mass above zero, or hold it",
            );
        }
        let (ghosts, parts): (Vec<Part>, Vec<Part>) =
            body.parts.into_iter().partition(|p| p.is_ghost);
        self.ghosts.extend(ghosts.iter().map(|p| place(&p.name, p.line)));
        if parts.is_empty() {
            self.ghosts.push(format!("all of body {named}"));
            return Ok(());
        }
        let balls = parts.iter().filter(|p| matches!(p.form, Form::Sphere(_))).count();
        if balls > 0 && balls < parts.len() {
            return fault(
                format!(
                    "body {named} has spheres beside other shapes, which no one block can have"
                ),
                "make it of spheres alone, or of none",
            );
        }
        let id = self.name(body.id, "body");
        if parts.len() > 1 {
            self.joined.push(format!("{id:?} ({} shapes)", parts.len()));
        }
        if heft.is_none() {
            self.unweighed.push(format!("{id:?}"));
        }
        self.add(id, body.line, false, parts, heft.unwrap_or_default(), raw);
        Ok(())
    }

    fn add(
        &mut self,
        id: String,
        line: usize,
        support: bool,
        parts: Vec<Part>,
        heft: Heft,
        raw: &mut Raw,
    ) {
        let material = self.material(&id, &parts, raw);
        if let [Part { form: Form::Plane, pose, .. }] = &parts[..] {
            self.planes.push(format!("{id:?}"));
            let normal = (pose.rotation * Vector3::z()).into();
            let at = pose.translation.vector.into();
            raw.planes.push(Ground { id, at, normal, material, line });
            return;
        }
        let ball = |p: &Part| match p.form {
            Form::Sphere(radius) => Some((p.pose.translation.vector.into(), radius)),
            _ => None,
        };
        if let Some(spheres) = parts.iter().map(ball).collect() {
            raw.grains.push(Grain { id, spheres, support, material, heft, line });
            return;
        }
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        let is_joined = parts.len() > 1;
        for part in &parts {
            let mesh = match part.form {
                Form::Cylinder { radius, half } => {
                    self.cylinders.push(format!("{id:?} ({} sides)", sides(radius, half)));
                    Rc::new(prism(radius, half))
                }
                Form::Cuboid(half) => Rc::new(cuboid(half)),
                Form::Mesh(ref mesh) => Rc::clone(mesh),
                Form::Sphere(_) | Form::Plane => continue,
            };
            let first = vertices.len();
            let point = |v: &[f64; 3]| -> [f64; 3] { (part.pose * Point3::from(*v)).coords.into() };
            vertices.extend(mesh.vertices.iter().map(point));
            if is_joined {
                set_apart(&mut vertices[first..]);
            }
            faces
                .extend(mesh.faces.iter().map(|f| f.iter().map(|v| first + v).collect::<Vec<_>>()));
        }
        let line = Some(line);
        raw.blocks.push(Solid {
            id,
            vertices,
            faces,
            support,
            material,
            heft,
            line,
            ..Solid::default()
        });
    }

    /// The material of a block: one for each surface of the file.
    fn material(&mut self, id: &str, parts: &[Part], raw: &mut Raw) -> Option<String> {
        let known = parts.iter().filter_map(|p| p.surface);
        let surface = known.reduce(|a, b| if b.friction < a.friction { b } else { a })?;
        if parts.iter().any(|p| p.surface != Some(surface)) {
            let all: Vec<String> =
                parts.iter().filter_map(|p| p.surface).map(|s| s.friction.to_string()).collect();
            self.mixed.push(format!("{id:?} ({})", all.join(", ")));
        }
        if let Some((name, _)) = raw.surfaces.iter().find(|(_, s)| **s == surface) {
            return Some(name.clone());
        }
        let base = format!("friction {}", surface.friction);
        let mut name = base.clone();
        let mut number = 2;
        while raw.surfaces.contains_key(&name) {
            name = format!("{base}, {number}");
            number += 1;
        }
        raw.surfaces.insert(name.clone(), surface);
        Some(name)
    }

    fn tell(self, raw: &mut Raw) {
        use FindingCode::{Converted, LeftOut, Missing};
        usual_densities(raw);
        let said = [
            (Converted, self.renamed, "blocks of the same name, renamed", ""),
            (Converted, self.held, "shapes that cannot move, each a support", ""),
            (Converted, self.planes, "planes, unbounded supports whatever their size", ""),
            (
                Converted,
                self.joined,
                "bodies of several shapes, one rigid block each",
                "; the shapes are smaller by a millionth, so as not to touch each other",
            ),
            (
                Converted,
                self.cylinders,
                "cylinders, read as prisms with their corners on the cylinder and its mass",
                "; on its side such a prism rests on a flat where a cylinder may roll",
            ),
            (
                Converted,
                self.mixed,
                "blocks of shapes with several frictions",
                "; the least is taken for all of the block",
            ),
            (LeftOut, self.ghosts, "shapes that touch nothing, left out (their mass counts)", ""),
            (
                Missing,
                self.unweighed,
                "bodies without a mass",
                "; the density of the scene's default is assumed: import with `--density`",
            ),
        ];
        for (code, list, what, rest) in said {
            if !list.is_empty() {
                raw.say(code, format!("{what}: {}{rest}", tally(&list)));
            }
        }
    }
}

/// Gives each surface's material the density that most of its blocks have, which they then need not say.
fn usual_densities(raw: &mut Raw) {
    let mut counts: BTreeMap<String, BTreeMap<u64, usize>> = BTreeMap::new();
    let solids = raw.blocks.iter().map(|b| (&b.material, &b.heft));
    for (material, heft) in solids.chain(raw.grains.iter().map(|g| (&g.material, &g.heft))) {
        if let (Some(name), Some(density)) = (material, heft.density) {
            *counts.entry(name.clone()).or_default().entry(density.to_bits()).or_default() += 1;
        }
    }
    let usual = |of: &BTreeMap<u64, usize>| {
        let most = of.values().copied().max()?;
        of.iter().find(|(_, n)| **n == most).map(|(bits, _)| f64::from_bits(*bits))
    };
    for name in raw.surfaces.keys() {
        let density = counts.get(name).and_then(usual).unwrap_or(DEFAULT_DENSITY);
        raw.materials.insert(name.clone(), Material::of_density(density));
    }
    let materials = &raw.materials;
    let drop = |material: &Option<String>, heft: &mut Heft| {
        let own = material.as_ref().and_then(|name| materials.get(name)).map(|m| m.density);
        if own.is_some() && own == heft.density {
            heft.density = None;
        }
    };
    raw.blocks.iter_mut().for_each(|b| drop(&b.material, &mut b.heft));
    raw.grains.iter_mut().for_each(|g| drop(&g.material, &mut g.heft));
}

fn place(name: &str, line: usize) -> String {
    if name.is_empty() { format!("line {line}") } else { format!("{name:?} (line {line})") }
}

/// Mass and centre of mass of a body; its density where that says the same.
fn heft(body: &Body) -> Heft {
    let exact = |p: &Part| !p.is_ghost && !matches!(p.form, Form::Cylinder { .. });
    if let Some(Weight::Density(density)) = body.parts.first().map(|p| p.weight)
        && body.lumps.is_empty()
        && (body.parts.len() == 1 || matches!(body.parts[0].form, Form::Sphere(_)))
        && body.parts.iter().all(|p| exact(p) && p.weight == Weight::Density(density))
    {
        return Heft { density: Some(density), ..Heft::default() };
    }
    let mut sum = (0.0, Vector3::zeros());
    let own = body.parts.iter().map(|p| {
        let (volume, centre) = volume(&p.form);
        let mass = match p.weight {
            Weight::Density(density) => density * volume,
            Weight::Mass(mass) => mass,
            Weight::None => 0.0,
        };
        (mass, p.pose * centre)
    });
    for (mass, centre) in own.chain(body.lumps.iter().copied()) {
        sum = (sum.0 + mass, sum.1 + centre.coords * mass);
    }
    let centroid = (sum.1 / sum.0).into();
    // Of one shape that has its mass in its middle, the shape says where.
    let is_plain = body.lumps.is_empty() && body.parts.len() == 1;
    Heft { density: None, mass: Some(sum.0), centroid: (!is_plain).then_some(centroid) }
}

/// Volume, m³, and centroid.
fn volume(form: &Form) -> (f64, Point3<f64>) {
    match form {
        Form::Cuboid([x, y, z]) => (8.0 * x * y * z, Point3::origin()),
        Form::Sphere(r) => (4.0 / 3.0 * PI * r.powi(3), Point3::origin()),
        Form::Cylinder { radius, half } => (2.0 * half * PI * radius * radius, Point3::origin()),
        Form::Plane => (0.0, Point3::origin()),
        Form::Mesh(mesh) => of_mesh(&mesh.vertices, &mesh.faces),
    }
}

/// Volume, m³, and centroid by the divergence theorem, about the first corner.
pub(super) fn of_mesh(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> (f64, Point3<f64>) {
    let Some(origin) = vertices.first().map(|v| Vector3::from(*v)) else {
        return (0.0, Point3::origin());
    };
    let corner = |i: usize| Vector3::from(vertices[i]) - origin;
    let (mut six, mut first) = (0.0, Vector3::zeros());
    for face in faces {
        for pair in face.windows(2).skip(1) {
            let (a, b, c) = (corner(face[0]), corner(pair[0]), corner(pair[1]));
            let part = a.dot(&b.cross(&c));
            six += part;
            first += (a + b + c) * (0.25 * part);
        }
    }
    let middle = if six == 0.0 { Vector3::zeros() } else { first / six };
    (six.abs() / 6.0, Point3::from(origin + middle))
}

/// Draws a part of a block towards its middle, by so little that contacts do not notice: shells of one
/// polyhedron may not touch each other.
pub(super) fn set_apart(part: &mut [[f64; 3]]) {
    let n = part.len().max(1) as f64;
    let middle: Vector3<f64> = part.iter().map(|v| Vector3::from(*v)).sum::<Vector3<f64>>() / n;
    for v in part {
        *v = (middle + (Vector3::from(*v) - middle) * (1.0 - APART)).into();
    }
}

/// A box by half its sides, about the origin.
pub(super) fn cuboid([x, y, z]: [f64; 3]) -> Mesh {
    let corner = |k: usize| {
        let side = |bit: usize, half: f64| if k >> bit & 1 == 1 { half } else { -half };
        [side(0, x), side(1, y), side(2, z)]
    };
    let faces: [[usize; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        vertices: (0..8).map(corner).collect(),
        faces: faces.iter().map(|f| f.to_vec()).collect(),
    }
}

/// So many that chords lie within [`SAGITTA`] of their arcs, and a corner on every half axis.
fn sides(radius: f64, half: f64) -> usize {
    let size = (8.0 * radius * radius + 4.0 * half * half).sqrt();
    // A chord of the angle 2 φ lies r (1 − cos φ) = 2 r sin² φ/2 from its arc.
    let step = 2.0 * (0.5 * SAGITTA * size / radius).min(1.0).sqrt().asin();
    ((PI / step).ceil() as usize).max(FEWEST_SIDES).next_multiple_of(4)
}

fn prism(radius: f64, half: f64) -> Mesh {
    let n = sides(radius, half);
    let ring = |z: f64| {
        (0..n).map(move |k| {
            // From the nearest half axis, so that opposite corners are opposite to the last digit.
            let (quarter, rest) = (4 * k / n, 4 * k % n);
            let (s, c) = (PI / 2.0 * rest as f64 / n as f64).sin_cos();
            let [x, y] = [[c, s], [-s, c], [-c, -s], [s, -c]][quarter];
            [radius * x, radius * y, z]
        })
    };
    let mut faces: Vec<Vec<usize>> = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| (i, (i + 1) % n)).map(|(i, j)| vec![i, j, j + n, i + n]));
    Mesh { vertices: ring(-half).chain(ring(half)).collect(), faces }
}
