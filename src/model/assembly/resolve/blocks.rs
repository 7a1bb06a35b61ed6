//! Block specs → [`Block`]s with mass, centre of mass and inertia.

use super::{
    check,
    origin::Origin,
    shape::{self, Around, Frame},
};
use crate::assembly::{Block, Elastic, Gyration, Mend};
use base::{
    error::{Finding, FindingCode, InputError, JsonPath, Step},
    limits,
    tolerance::DEFAULT_DENSITY,
};
use nalgebra::Vector3;
use scene::{BlockSpec, Material, Scene, Shape, generate, suggest};
use std::collections::HashMap;

/// Whether a block with this path was made by a template.
pub(super) fn from_template(path: &JsonPath) -> bool {
    path.0.first() == Some(&Step::Key("templates".into()))
}

/// All blocks, explicit ones first, and what was mended or assumed.
pub(super) fn resolve(
    scene: &Scene,
    is_over: &dyn Fn() -> bool,
) -> Result<(Vec<Block>, Vec<Finding>), InputError> {
    let root = JsonPath::root();
    for (name, material) in &scene.materials {
        check::positive(
            material.density,
            &root.key("materials").key(name.as_str()).key("density"),
            "kg/m³",
        )?;
        elastic_moduli(material, &root.key("materials").key(name.as_str()))?;
    }
    // With each block its density, where somebody chose one.
    let mut blocks = Vec::with_capacity(scene.blocks.len());
    let mut mended = Mended::default();
    let mut around = Around { free: middle_of_free(scene), bounds: None };
    let mut add = |spec: &BlockSpec, place: &Origin| -> Result<(), InputError> {
        if is_over() {
            let text =
                format!("time limit reached after {} blocks had been resolved", blocks.len());
            return Err(InputError::at(JsonPath::root(), text).hint("allow more time"));
        }
        blocks.push(block(scene, spec, place, around, &mut mended)?);
        Ok(())
    };
    let mut count = scene.blocks.len();
    few(count, &root.key("blocks"))?;
    // Planes are as large as the others need, so they come last and are put back in their places.
    let is_plane = |spec: &BlockSpec| matches!(spec.shape, Shape::Plane { .. });
    let origin = |i| Origin { path: root.key("blocks").index(i), generated: None };
    for (i, spec) in scene.blocks.iter().enumerate().filter(|(_, spec)| !is_plane(spec)) {
        add(spec, &origin(i))?;
    }
    for (i, template) in scene.templates.iter().enumerate() {
        let path = root.key("templates").index(i);
        let specs = generate::expand(template).map_err(|e| e.under(&path))?;
        count += specs.len();
        few(count, &path)?;
        for spec in specs {
            add(&spec, &Origin { path: path.clone(), generated: Some(spec.id.clone()) })?;
        }
    }
    let bounds = blocks.iter().map(|(b, _)| b.solid.extent());
    around.bounds = bounds.reduce(|(l, h), (low, high)| (l.inf(&low), h.sup(&high)));
    for (i, spec) in scene.blocks.iter().enumerate().filter(|(_, spec)| is_plane(spec)) {
        let plane = block(scene, spec, &origin(i), around, &mut mended)?;
        blocks.insert(i, plane);
    }
    let (blocks, chosen): (Vec<_>, Vec<_>) = blocks.into_iter().unzip();
    let mut findings = mended.findings();
    findings.extend(assumed_density(scene, &blocks, &chosen));
    Ok((blocks, findings))
}

/// Where the free blocks are, more or less; above everything where none is given by itself.
fn middle_of_free(scene: &Scene) -> Vector3<f64> {
    let middle = |spec: &BlockSpec| {
        let corners: &[[f64; 3]] = match &spec.shape {
            Shape::Polyhedron { vertices, .. } | Shape::Mesh { vertices, .. } => vertices,
            _ => &[],
        };
        let sum = corners.iter().map(|&v| Vector3::from(v)).sum::<Vector3<f64>>();
        let frame = Frame::new(spec, &Origin { path: JsonPath::root(), generated: None }).ok()?;
        Some(frame.apply(sum / corners.len().max(1) as f64))
    };
    let free = scene.blocks.iter().filter(|b| !b.support).filter_map(middle);
    let (count, sum) = free.fold((0, Vector3::zeros()), |(n, sum), v| (n + 1, sum + v));
    match count {
        0 => -Vector3::from(scene.gravity) * 1e6,
        n => sum / f64::from(n),
    }
}

/// A point of a block's own frame, in scene coordinates.
pub(super) fn in_scene(spec: &BlockSpec, point: Vector3<f64>) -> Result<Vector3<f64>, InputError> {
    let place = Origin { path: JsonPath::root(), generated: Some(spec.id.clone()) };
    Ok(Frame::new(spec, &place)?.apply(point))
}

/// Refuses more blocks than a scene may have, or than fit into the memory.
fn few(count: usize, path: &JsonPath) -> Result<(), InputError> {
    if count > limits::BLOCKS {
        let message = format!(
            "the scene has {count} blocks with these, more than the limit of {}",
            limits::BLOCKS
        );
        return Err(InputError::at(path.clone(), message)
            .hint("give fewer blocks, or ask about a part of the structure"));
    }
    let each = limits::PER_BLOCK;
    limits::afford(&format!("a scene of {count} blocks"), count as u64, each)
        .map_err(|e| InputError { path: path.clone(), ..e })
}

/// One block, and its density where the scene gives it (as such, by a material, or as a mass).
fn block(
    scene: &Scene,
    spec: &BlockSpec,
    place: &Origin,
    around: Around,
    mended: &mut Mended,
) -> Result<(Block, Option<f64>), InputError> {
    let root = JsonPath::root();
    let frame = Frame::new(spec, place)?;
    let body = shape::body(spec, &frame, place, around)?;
    for mend in &body.mended {
        mended.add(mend, &spec.id);
    }

    let mass =
        spec.mass.map(|m| place.check(check::positive(m, &root.key("mass"), "kg"))).transpose()?;
    let own = spec
        .density
        .map(|d| place.check(check::positive(d, &root.key("density"), "kg/m³")))
        .transpose()?;
    if mass.is_some() && own.is_some() {
        return place.check(Err(InputError::at(
            root.key("mass"),
            "density and mass are both given",
        )
        .hint("keep one of them")));
    }
    let material = match &spec.material {
        None => None,
        Some(name) => match scene.materials.get(name) {
            Some(material) => Some(material),
            None => return place.check(Err(no_material(scene, name, &root.key("material")))),
        },
    };
    let density = own.or(material.map(|m| m.density));
    let elastic = material.and_then(|m| Some(Elastic { young: m.young?, poisson: m.poisson? }));

    let volume = body.properties.volume;
    let mass = mass.unwrap_or(density.unwrap_or(DEFAULT_DENSITY) * volume);
    // A centre of mass given by hand says nothing about the spread of the mass: the shape's
    // inertia, scaled by the mass, is kept.
    let inertia = body.properties.inertia * (mass / volume);
    let own_centroid =
        spec.centroid.map(|c| place.check(check::vector(c, &root.key("centroid")))).transpose()?;
    let centroid = own_centroid.map_or(body.properties.centroid, |c| frame.apply(c));
    let computable = volume > 0.0
        && mass > 0.0
        && [volume, mass, body.size].iter().chain(&centroid).chain(&inertia).all(|x| x.is_finite());
    if !computable {
        let message = format!(
            "the block is too small or too large to compute: volume {volume:e} m³, mass {mass:e} kg"
        );
        return place
            .check(Err(InputError::at(root.key("shape"), message).hint("lengths are in m")));
    }
    let block = Block {
        id: spec.id.clone(),
        path: place.path.clone(),
        support: spec.support,
        material: spec.material.clone(),
        elastic,
        mass,
        factor: 1.0,
        centroid,
        gyration: Gyration::new(&inertia, mass),
        inertia,
        solid: body.solid,
        size: body.size,
    };
    let chosen = if spec.mass.is_some() { Some(mass / volume) } else { density };
    Ok((block, chosen))
}

/// Refuses moduli that no material has, and one without the other.
fn elastic_moduli(material: &Material, path: &JsonPath) -> Result<(), InputError> {
    if let Some(young) = material.young {
        check::positive(young, &path.key("young"), "Young's modulus in Pa: 70 GPa is 70e9")?;
    }
    if let Some(poisson) = material.poisson
        && !(poisson > -1.0 && poisson <= 0.5)
    {
        let text = format!("must be above -1 and at most 0.5, got {poisson}");
        return Err(InputError::at(path.key("poisson"), text).hint("stone has 0.15 to 0.3"));
    }
    match (material.young, material.poisson) {
        (Some(_), None) => Err(InputError::at(path.clone(), "young is given without poisson")
            .hint("add \"poisson\", 0.2 for stone and glass")),
        (None, Some(_)) => Err(InputError::at(path.clone(), "poisson is given without young")
            .hint("add \"young\", in Pa")),
        _ => Ok(()),
    }
}

/// The error about a material that is not in the list.
pub(super) fn no_material(scene: &Scene, name: &str, path: &JsonPath) -> InputError {
    let hint = suggest(name, scene.materials.keys().map(String::as_str))
        .unwrap_or_else(|| format!("add \"materials\": {{ {name:?}: {{ \"density\": … }} }}"));
    InputError::at(path.clone(), format!("no material is called {name:?}")).hint(hint)
}

/// Says that a density was assumed, if that can change an answer: with one density for all and no
/// load but the weight, forces grow with it and nothing else does.
fn assumed_density(scene: &Scene, blocks: &[Block], chosen: &[Option<f64>]) -> Option<Finding> {
    let free = || blocks.iter().zip(chosen).filter(|(b, _)| !b.support);
    let mut assumed = free().filter(|(_, density)| density.is_none());
    let (first, _) = assumed.next()?;
    let count = 1 + assumed.count();
    // Mass over volume gives a density back up to rounding.
    let mixed = free()
        .filter_map(|(_, density)| *density)
        .any(|d| (d / DEFAULT_DENSITY - 1.0).abs() > 1e-12);
    let loaded = scene
        .loads
        .dead
        .iter()
        .chain(&scene.loads.live)
        .any(|l| l.force.is_some() || l.moment.is_some());
    let why = match (mixed, loaded) {
        (false, false) => return None,
        (true, _) => "other blocks have another density",
        (false, true) => "there are loads besides the weight",
    };
    let who = if count == 1 {
        format!("Block {:?} has", first.id)
    } else {
        format!("{count} blocks have (the first is {:?})", first.id)
    };
    let text = format!(
        "{who} no density, mass or material: {DEFAULT_DENSITY} kg/m³ was assumed; this matters because {why}."
    );
    Some(Finding::new(FindingCode::Assumed, text))
}

/// What was mended, one entry per sentence: ten thousand blocks turned inside out are one finding.
#[derive(Default)]
struct Mended {
    order: Vec<String>,
    blocks: HashMap<String, (FindingCode, String, usize)>,
    /// Blocks with faces that are not plane: how many, with how many such faces; the worst face, its
    /// warp and its block.
    warped: Option<(usize, usize, (usize, f64, String))>,
}

impl Mended {
    fn add(&mut self, mend: &Mend, id: &str) {
        if let Mend::Warped { faces, face, warp } = *mend {
            let here = (face, warp, id.to_owned());
            self.warped = Some(match self.warped.take() {
                None => (1, faces, here),
                Some((blocks, all, worst)) => {
                    (blocks + 1, all + faces, if warp > worst.1 { here } else { worst })
                }
            });
            return;
        }
        let text = mend.to_string();
        if let Some((.., count)) = self.blocks.get_mut(&text) {
            *count += 1;
        } else {
            self.order.push(text.clone());
            self.blocks.insert(text, (mend.code(), id.to_owned(), 1));
        }
    }

    fn findings(self) -> Vec<Finding> {
        let tell = |text: &String| {
            let (code, id, count) = &self.blocks[text];
            let others =
                if *count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            Finding::new(*code, format!("Block {id:?}{others}: {text}."))
        };
        let warped = self.warped.as_ref().map(|(blocks, faces, (face, warp, id))| {
            let text = match blocks {
                1 => format!("Block {id:?}: {}.", Mend::Warped { faces: *faces, face: *face, warp: *warp }),
                n => format!("{faces} faces of {n} blocks are not plane and treated as plane where blocks touch (the worst is face {face} of block {id:?}, whose corners lie up to {warp:.3e} m off its mean plane)."),
            };
            Finding::new(FindingCode::Warped, text)
        });
        self.order.iter().map(tell).chain(warped).collect()
    }
}
