//! The blocks with their masses and frictions as a model of another program: MJCF of MuJoCo, so that it can
//! run what was assessed here, or commands of 3DEC. What such a model has no place for is told.
//!
//! * MuJoCo documentation, *XML reference* and *Modeling* (mujoco.readthedocs.io, 3.3).
//! * Itasca, 3DEC 7.0 documentation, "block create command".

use super::{
    ReportError,
    view::{BlockView, Surface, View, ViewShape},
};
use base::plain::{markup, printable};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use scene::Friction;
use std::{
    collections::BTreeMap,
    fmt::{self, Write},
};

/// A program that reads blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// MuJoCo.
    Mujoco,
    /// 3DEC of Itasca.
    ThreeDec,
}

impl Program {
    /// The program whose files end so, in small letters without the dot.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending {
            "xml" | "mjcf" => Some(Self::Mujoco),
            "3ddat" | "3dec" | "dat" => Some(Self::ThreeDec),
            _ => None,
        }
    }
}

/// A model as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelFile {
    /// Its content.
    pub text: String,
    /// What of the scene is not in it, or not as it is in the scene.
    pub notes: Vec<String>,
}

/// Corners this near, relative to the size of a block, are on a plane, or where a box has them. Nearer:
/// boxes that were turned are none. Farther: what is a little skew is written as a box.
const FLAT: f64 = 1e-9;

/// Steps in the time √(size / gravity) of the smallest block, and steps in the time in which a contact gives
/// way (MuJoCo asks for two at least). Fewer: blocks sink in or jump; more: long runs.
const STEPS: f64 = 200.0;
const STEPS_OF_CONTACT: f64 = 4.0;

/// MuJoCo's contacts are at their stiffest this × the smallest block deep; its own value is 1 mm.
const SOFT: f64 = 1e-3;

/// Least inertia that MuJoCo takes, kg·m² (`mjMINVAL`).
const LIGHTEST: f64 = 1e-15;

/// Friction that stands for one without bounds.
const ROUGH: f64 = 1e3;

/// The model for a program.
///
/// # Errors
/// Spheres, of which 3DEC has none.
pub fn model(view: &View, program: Program) -> Result<ModelFile, ReportError> {
    let frictions = Frictions::of(view);
    let mut notes = frictions.notes.clone();
    notes.extend(left_out(view));
    let bent: Vec<String> = view
        .bodies
        .iter()
        .filter(
            |b| matches!(&b.shape, ViewShape::Surface(s) if s.balls.is_empty() && !is_convex(s)),
        )
        .map(|b| format!("{:?}", b.id))
        .collect();
    if !bent.is_empty() {
        let what = match program {
            Program::Mujoco => "of which MuJoCo takes the convex hull",
            Program::ThreeDec => "which 3DEC wants as several that are joined",
        };
        notes.push(format!("blocks that are not convex, {what}: {}", bent.join(", ")));
    }
    let least = |b: &&BlockView| b.inertia.symmetric_eigenvalues().min() < LIGHTEST;
    let light = view.bodies.iter().filter(|b| !b.support).filter(least).count();
    if light > 0 && program == Program::Mujoco {
        notes.push(format!(
            "blocks whose inertia is below {LIGHTEST:e} kg m², the least that MuJoCo takes: {light}"
        ));
    }
    let text = match program {
        Program::Mujoco => mjcf(view, &frictions, &notes),
        Program::ThreeDec => threedec(view, &frictions, &notes)?,
    };
    Ok(ModelFile { text, notes })
}

/// What neither program is told.
fn left_out(view: &View) -> impl Iterator<Item = String> {
    let laws = view.joints.iter().map(|j| &j.law);
    let strong = laws.filter(|l| {
        l.cohesion > 0.0 || l.tension > 0.0 || l.compression.is_finite() || l.pore_pressure > 0.0
    });
    let said = [
        (view.loads.len(), "loads"),
        (view.members.len(), "ties, struts, soil and other members"),
        (strong.count(), "strengths and water pressures of joints (their friction is written)"),
    ];
    said.into_iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{what}, left out: {n}"))
}

/// The friction of most joints, and those of the pairs that have another.
struct Frictions {
    usual: f64,
    of_pairs: BTreeMap<(usize, usize), f64>,
    notes: Vec<String>,
}

impl Frictions {
    fn of(view: &View) -> Self {
        let mut notes = Vec::new();
        let (mut endless, mut several) = (0, 0);
        let mut of_pairs = BTreeMap::new();
        for joint in &view.joints {
            let mu = match joint.law.friction {
                Friction::Coefficient(mu) => mu,
                Friction::Infinite => {
                    endless += 1;
                    ROUGH
                }
            };
            let known = of_pairs.entry((joint.a.min(joint.b), joint.a.max(joint.b))).or_insert(mu);
            several += usize::from(*known != mu);
            *known = known.min(mu);
        }
        let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
        for mu in of_pairs.values() {
            *counts.entry(mu.to_bits()).or_default() += 1;
        }
        let usual = counts.iter().max_by_key(|(bits, n)| (**n, std::cmp::Reverse(**bits)));
        let usual = usual.map_or(0.0, |(bits, _)| f64::from_bits(*bits));
        of_pairs.retain(|_, mu| *mu != usual);
        if endless > 0 {
            notes.push(format!("joints of unbounded friction, written as {ROUGH}: {endless}"));
        }
        if several > 0 {
            notes.push(format!(
                "pairs of blocks with several frictions, of which the least is written: {several}"
            ));
        }
        Self { usual, of_pairs, notes }
    }
}

/// Whether no corner lies outside a face.
fn is_convex(surface: &Surface) -> bool {
    let corner = |k: &u32| surface.corners[*k as usize];
    let (low, high) = bounds(surface);
    let near = FLAT * (high - low).norm();
    surface.pieces.iter().all(|piece| match piece.as_slice() {
        [a, b, c, ..] => {
            let normal = (corner(b) - corner(a)).cross(&(corner(c) - corner(a))).normalize();
            surface.corners.iter().all(|p| normal.dot(&(p - corner(a))) <= near)
        }
        _ => true,
    })
}

fn bounds(surface: &Surface) -> (Vector3<f64>, Vector3<f64>) {
    let none = Vector3::repeat(f64::INFINITY);
    surface.corners.iter().fold((none, -none), |(l, h), p| (l.inf(p), h.sup(p)))
}

/// Half the sides, the turn and the middle of a box, where the surface is one.
fn as_box(surface: &Surface) -> Option<(Vector3<f64>, UnitQuaternion<f64>, Vector3<f64>)> {
    if surface.corners.len() != 8 || surface.edges.len() != 12 {
        return None;
    }
    let first = surface.corners[0];
    let sides: Vec<Vector3<f64>> = surface
        .edges
        .iter()
        .filter(|e| e.contains(&0))
        .map(|e| surface.corners[(e[0] + e[1]) as usize] - first)
        .collect();
    let [a, b, c] = sides.as_slice().try_into().ok()?;
    let (b, c) = if Vector3::dot(&Vector3::cross(&a, &b), &c) < 0.0 { (c, b) } else { (b, c) };
    let middle = first + (a + b + c) * 0.5;
    let sides = [a, b, c];
    let half = Vector3::from(sides.map(|s| 0.5 * s.norm()));
    let axes = sides.map(|s| s.normalize());
    let near = FLAT * half.norm();
    let is_corner = |p: &Vector3<f64>| {
        (0..3).all(|k| (axes[k].dot(&(p - middle)).abs() - half[k]).abs() <= near)
    };
    let is_square = (0..3).all(|k| axes[k].dot(&axes[(k + 1) % 3]).abs() <= FLAT);
    (is_square && surface.corners.iter().all(is_corner)).then(|| {
        let turn = UnitQuaternion::from_matrix(&Matrix3::from_columns(&axes));
        (half, turn, middle)
    })
}

/// Numbers with spaces between them.
fn row<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> String {
    let words: Vec<String> = numbers.into_iter().map(|x| (x + 0.0).to_string()).collect();
    words.join(" ")
}

/// Lines of text.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn line(&mut self, text: fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.0.write_fmt(text);
        self.0.push('\n');
    }
}

/// The size by which contacts are soft: that of the smallest free block, m.
fn smallest(view: &View) -> f64 {
    let size = |b: &BlockView| {
        let (low, high) = b.extent();
        (high - low).norm()
    };
    let free = view.bodies.iter().filter(|b| !b.support).map(size).fold(f64::INFINITY, f64::min);
    if free.is_finite() { free } else { view.size() }
}

fn mjcf(view: &View, frictions: &Frictions, notes: &[String]) -> String {
    let mut out = Lines::default();
    let size = smallest(view);
    let step = (size / view.gravity).sqrt() / STEPS;
    out.line(format_args!("<mujoco model=\"{}\">", markup(&view.name)));
    out.line(format_args!(
        "  <!-- voussoir {}; lengths in m, masses in kg -->",
        env!("CARGO_PKG_VERSION")
    ));
    for note in notes {
        // Two hyphens would end the comment.
        out.line(format_args!("  <!-- {} -->", markup(note).replace("--", "- -")));
    }
    out.line(format_args!(
        "  <option timestep=\"{step}\" gravity=\"{}\" cone=\"elliptic\" impratio=\"10\" integrator=\"implicitfast\"><flag multiccd=\"enable\"/></option>",
        row((view.ground * -view.gravity).iter())
    ));
    out.line(format_args!(
        "  <default><geom condim=\"3\" friction=\"{} 0 0\" solref=\"{} 1\" solimp=\"0.95 0.99 {}\"/></default>",
        frictions.usual,
        STEPS_OF_CONTACT * step,
        SOFT * size
    ));
    let mut bodies = Lines::default();
    let mut assets = Lines::default();
    for body in &view.bodies {
        let id = markup(&body.id);
        bodies.line(format_args!("    <body name=\"{id}\" pos=\"{}\">", row(body.center.iter())));
        if !body.support {
            let i = body.inertia;
            let full = [i[(0, 0)], i[(1, 1)], i[(2, 2)], i[(0, 1)], i[(0, 2)], i[(1, 2)]];
            bodies.line(format_args!(
                "      <freejoint/><inertial pos=\"0 0 0\" mass=\"{}\" fullinertia=\"{}\"/>",
                body.mass,
                row(&full)
            ));
        }
        for (k, geom) in geoms(body, &id, &mut assets).into_iter().enumerate() {
            bodies.line(format_args!("      <geom name=\"{}\" {geom}/>", geom_name(&id, k)));
        }
        bodies.line(format_args!("    </body>"));
    }
    for (tag, content) in [("asset", assets.0), ("worldbody", bodies.0)] {
        if !content.is_empty() {
            let _ = write!(out.0, "  <{tag}>\n{content}  </{tag}>\n");
        }
    }
    if !frictions.of_pairs.is_empty() {
        out.line(format_args!("  <contact>"));
        for ((a, b), mu) in &frictions.of_pairs {
            let names = |k: usize| {
                let body = &view.bodies[k];
                let id = markup(&body.id);
                (0..count(body)).map(move |k| geom_name(&id, k)).collect::<Vec<_>>()
            };
            let others = names(*b);
            for (one, other) in names(*a).iter().flat_map(|i| others.iter().map(move |j| (i, j))) {
                out.line(format_args!(
                    "    <pair geom1=\"{one}\" geom2=\"{other}\" condim=\"3\" friction=\"{mu} {mu} 0 0 0\" solref=\"{} 1\" solimp=\"0.95 0.99 {}\"/>",
                    STEPS_OF_CONTACT * step,
                    SOFT * size
                ));
            }
        }
        out.line(format_args!("  </contact>"));
    }
    out.line(format_args!("</mujoco>"));
    out.0
}

/// The name of the k-th shape of a block.
fn geom_name(id: &str, k: usize) -> String {
    if k == 0 { id.to_string() } else { format!("{id}/{k}") }
}

/// How many shapes it has.
fn count(body: &BlockView) -> usize {
    match &body.shape {
        ViewShape::Surface(s) if !s.balls.is_empty() => s.balls.len(),
        _ => 1,
    }
}

/// The shapes of a block about its centre of mass; meshes become assets.
fn geoms(body: &BlockView, id: &str, assets: &mut Lines) -> Vec<String> {
    let ball = |at: &Vector3<f64>, radius: f64| {
        format!("type=\"sphere\" size=\"{radius}\" pos=\"{}\"", row((at - body.center).iter()))
    };
    match &body.shape {
        ViewShape::Sphere(radius) => vec![ball(&body.center, *radius)],
        ViewShape::Surface(s) if !s.balls.is_empty() => {
            s.balls.iter().map(|(at, radius)| ball(at, *radius)).collect()
        }
        ViewShape::Surface(s) => {
            if let Some((half, turn, middle)) = as_box(s) {
                let q = turn.quaternion();
                return vec![format!(
                    "type=\"box\" size=\"{}\" pos=\"{}\" quat=\"{}\"",
                    row(half.iter()),
                    row((middle - body.center).iter()),
                    row(&[q.w, q.i, q.j, q.k])
                )];
            }
            let corners: Vec<f64> =
                s.corners.iter().flat_map(|c| <[f64; 3]>::from(c - body.center)).collect();
            let fan = |p: &Vec<u32>| {
                let ends: Vec<[u32; 3]> =
                    p.windows(2).skip(1).map(|w| [p[0], w[0], w[1]]).collect();
                ends
            };
            let faces: Vec<String> =
                s.pieces.iter().flat_map(fan).flatten().map(|k| k.to_string()).collect();
            assets.line(format_args!(
                "    <mesh name=\"{id}\" vertex=\"{}\" face=\"{}\"/>",
                row(&corners),
                faces.join(" ")
            ));
            vec![format!("type=\"mesh\" mesh=\"{id}\"")]
        }
    }
}

fn threedec(view: &View, frictions: &Frictions, notes: &[String]) -> Result<String, ReportError> {
    let mut out = Lines::default();
    out.line(format_args!("; {}: voussoir {}", printable(&view.name), env!("CARGO_PKG_VERSION")));
    out.line(format_args!("; lengths in m, masses in kg; one group a block"));
    for note in notes {
        out.line(format_args!("; {}", printable(note)));
    }
    let degrees = |mu: f64| mu.atan().to_degrees();
    out.line(format_args!("; friction of joints: {}° (yours to assign)", degrees(frictions.usual)));
    let group = |body: &BlockView| printable(&body.id).replace(['"', ';'], "_");
    for ((a, b), mu) in &frictions.of_pairs {
        let [a, b] = [a, b].map(|k| group(&view.bodies[*k]));
        out.line(format_args!("; friction of {a} on {b}: {}°", degrees(*mu)));
    }
    out.line(format_args!("model new\nmodel large-strain on"));
    out.line(format_args!("model gravity {}", row((view.ground * -view.gravity).iter())));
    for body in &view.bodies {
        let surface = match &body.shape {
            ViewShape::Surface(s) if s.balls.is_empty() => s,
            _ => {
                let text = format!(
                    "{:?} is of spheres, which 3DEC does not have; write MJCF (.xml) instead",
                    body.id
                );
                return Err(ReportError::new(text));
            }
        };
        out.line(format_args!("block create group \"{}\" polyhedron ...", group(body)));
        for (k, piece) in surface.pieces.iter().enumerate() {
            // Clockwise, seen from outside.
            let corners = piece.iter().rev().map(|k| {
                let p = surface.corners[*k as usize];
                format!("{},{},{}", p.x + 0.0, p.y + 0.0, p.z + 0.0)
            });
            let more = if k + 1 < surface.pieces.len() { " ..." } else { "" };
            out.line(format_args!("  face {}{more}", corners.collect::<Vec<_>>().join(" ")));
        }
    }
    for body in &view.bodies {
        let group = group(body);
        match body.support {
            true => out.line(format_args!("block fix range group \"{group}\"")),
            false => out.line(format_args!(
                "block property density {} range group \"{group}\"",
                body.mass / body.volume
            )),
        }
    }
    Ok(out.0)
}
