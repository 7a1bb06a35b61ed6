//! What an import says beside the scene: how large the thing is that was read, which of its objects
//! are no solids and where in their file they stand, and what looks like a mistake. All of it is
//! looked at as a question would, with stand-ins for what the file does not have (supports,
//! friction).

use base::{
    error::{Finding, FindingCode},
    number::count,
};
use model::{
    assembly::{Mend, Polyhedron, ShapeError},
    interface::{Model, on_its_side, prepare_until},
};
use nalgebra::Vector3;
use scene::{
    BlockSpec, Friction, Scene, Shape,
    import::{ImportOptions, Imported, Origin},
};

/// Structures whose blocks measure less than this after a scale below 1, m, were in metres before.
/// Larger: models of 1 : 100 in millimetres are reported. Smaller: voussoirs of a metre, scaled by
/// 0.001 for nothing, pass at 2 mm across.
const SCALED_FOR_NOTHING: f64 = 0.005;

/// What an import says.
#[derive(Clone, Debug, Default)]
pub struct Examined {
    /// Size, bounding box, volume and number of blocks on one line; empty where there are none.
    pub summary: String,
    /// The objects that are no solids, each with its place and the remedy. A scene with one of them
    /// has no answer.
    pub broken: Vec<String>,
    /// What looks like a mistake.
    pub findings: Vec<Finding>,
    /// Why not all mistakes were looked for: the time was over.
    pub unfinished: Option<String>,
}

/// Looks at what was imported; not at where its blocks touch once the time `is_over`, which is said.
pub fn examine(
    imported: &Imported,
    options: &ImportOptions,
    is_over: &dyn Fn() -> bool,
) -> Examined {
    let scene = &imported.scene;
    let solids: Vec<_> = scene.blocks.iter().map(solid).collect();
    let told = |(block, (solid, origin)): (&BlockSpec, (&Result<f64, ShapeError>, &Origin))| {
        let e = solid.as_ref().err()?;
        Some(format!("{}: object {:?}: {e}; hint: {}", origin.place(e.face()), block.id, e.hint()))
    };
    let mut broken: Vec<String> =
        scene.blocks.iter().zip(solids.iter().zip(&imported.origins)).filter_map(told).collect();
    let volume: f64 = solids.iter().flatten().sum();
    let (mut findings, mut unfinished) = (Vec::new(), None);
    if broken.is_empty() {
        match mistakes(scene, options, is_over) {
            Ok(found) => findings = found,
            Err(why) if is_over() => unfinished = Some(why),
            Err(why) => broken.push(why),
        }
    }
    Examined { summary: summary(scene, volume), broken, findings, unfinished }
}

/// The volume of a block, m³.
fn solid(block: &BlockSpec) -> Result<f64, ShapeError> {
    let ball = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
    let (vertices, faces) = match &block.shape {
        Shape::Polyhedron { vertices, faces } => (vertices, faces),
        Shape::Sphere { radius } => return Ok(ball(*radius)),
        // With what they overlap: a figure for people.
        Shape::Clump { spheres } => return Ok(spheres.iter().map(|s| ball(s.radius)).sum()),
        _ => return Ok(0.0),
    };
    let corners = vertices.iter().map(|&v| v.into()).collect();
    let (solid, mends) = match block.support {
        // Which side the body lies on is no matter here.
        true => Polyhedron::of_support(corners, faces, Vector3::zeros())?,
        false => Polyhedron::from_faces(corners, faces)?,
    };
    // A sheet has none.
    if mends.iter().any(|m| matches!(m, Mend::Backed { .. })) {
        return Ok(0.0);
    }
    Ok(solid.mass_properties().volume)
}

fn corners(block: &BlockSpec) -> Vec<[f64; 3]> {
    let ends =
        |at: [f64; 3], r: f64| [-r, r].map(|r| std::array::from_fn(|k| block.at[k] + at[k] + r));
    match &block.shape {
        Shape::Polyhedron { vertices, .. } => vertices.clone(),
        Shape::Sphere { radius } => ends([0.0; 3], *radius).to_vec(),
        Shape::Clump { spheres } => spheres.iter().flat_map(|s| ends(s.at, s.radius)).collect(),
        _ => Vec::new(),
    }
}

fn summary(scene: &Scene, volume: f64) -> String {
    let mut all = scene.blocks.iter().flat_map(corners).map(Vector3::from);
    let Some(first) = all.next() else { return String::new() };
    let (low, high) = all.fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let list = |v: Vector3<f64>| v.iter().map(|c| short(*c)).collect::<Vec<_>>();
    let supports = scene.blocks.iter().filter(|b| b.support).count();
    format!(
        "{}, {}; {} m along x, y, z, from ({}) to ({}); volume {} m³",
        count(scene.blocks.len(), "block"),
        count(supports, "support"),
        list(high - low).join(" × "),
        list(low).join(", "),
        list(high).join(", "),
        short(volume)
    )
}

/// Four digits, as one writes them.
fn short(x: f64) -> String {
    let x: f64 = format!("{x:.3e}").parse().unwrap_or(x) + 0.0;
    if x != 0.0 && !(1e-4..1e7).contains(&x.abs()) { format!("{x:e}") } else { format!("{x}") }
}

/// What looks like a mistake, with stand-ins for what is not known yet. What is known to be missing
/// has been said.
fn mistakes(
    scene: &Scene,
    options: &ImportOptions,
    is_over: &dyn Fn() -> bool,
) -> Result<Vec<Finding>, String> {
    let mut trial = scene.clone();
    trial.joints.default.friction.get_or_insert(Friction::Coefficient(0.6));
    let supports = scene.blocks.iter().filter(|b| b.support).count();
    let decided = supports > 0 && supports < scene.blocks.len();
    if !decided {
        // Only pairs of supports are left out: one support, and all the others are compared.
        trial.blocks.iter_mut().enumerate().for_each(|(i, b)| b.support = i == 0);
    }
    if trial.blocks.len() < 2 {
        return Ok(Vec::new());
    }
    let model = prepare_until(&trial, is_over).map_err(|e| e.to_string())?;
    let mut found: Vec<Finding> = model
        .findings()
        .filter(|f| f.code.is_mistake() && (decided || !by_supports(f.code)))
        .cloned()
        .collect();
    if !decided {
        found.extend(on_its_side(&model));
    }
    found.extend(scaled(&model, options));
    Ok(found)
}

/// Whether a finding follows from what the supports are.
fn by_supports(code: FindingCode) -> bool {
    matches!(code, FindingCode::Axes | FindingCode::Floating)
}

fn scaled(model: &Model, options: &ImportOptions) -> Option<Finding> {
    let mut sizes: Vec<f64> = model.assembly.blocks.iter().map(|b| b.size).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2)?;
    let scale = options.scale.filter(|&s| s < 1.0 && *median < SCALED_FOR_NOTHING)?;
    let text = format!(
        "The blocks measure {} m across after multiplication by {scale}. It looks like a file that was in metres already: leave --scale out",
        short(*median)
    );
    Some(Finding::new(FindingCode::Units, text))
}
