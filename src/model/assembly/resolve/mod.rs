//! [`Scene`] → [`Assembly`]: names looked up, defaults applied, shapes closed and moved into the
//! scene, every number checked.
//!
//! Blocks come in scene order, explicit blocks before templates. Errors carry a [`JsonPath`] into
//! the scene; `Source::located` adds the line and column. What lies inside a block made by a
//! template is reported at the template.

mod blocks;
mod check;
mod combinations;
mod given;
mod joints;
mod loads;
mod members;
mod origin;
mod prism;
mod shape;
mod site;
mod stages;
mod train;

#[cfg(test)]
mod tests;

use super::{Assembly, Block, plausible};
use base::error::{Finding, FindingCode, InputError, JsonPath};
use nalgebra::Vector3;
use scene::{Scene, suggest};
use std::collections::HashMap;

pub use stages::{asked_stages, named_blocks, stages, with_loads};

/// Resolves a scene.
///
/// # Errors
/// Anything in the scene that has no meaning: a missing reference, a non-positive density, an open
/// shape, no support, …
pub fn resolve(scene: &Scene) -> Result<Assembly, InputError> {
    resolve_until(scene, &|| false)
}

/// The same, given up as soon as `is_over`.
///
/// # Errors
/// As [`resolve`], and where it was given up.
pub fn resolve_until(scene: &Scene, is_over: &dyn Fn() -> bool) -> Result<Assembly, InputError> {
    let root = JsonPath::root();
    gravity(scene, &root.key("gravity"))?;
    check::contact(&scene.contact, &root.key("contact"))?;
    site::resolve(scene.site.as_ref(), &root.key("site"))?;
    let (list, findings) = blocks::resolve(scene, is_over)?;
    resolve_with(scene, Blocks { list, findings })
}

/// The blocks of an assembly, before anything is said about joints and loads.
#[derive(Clone, Debug)]
pub struct Blocks {
    list: Vec<Block>,
    findings: Vec<Finding>,
}

impl Blocks {
    /// Those of an assembly, each as heavy as it is × what is said of it.
    pub fn of(assembly: &Assembly, times: impl Fn(usize, &Block) -> f64) -> Self {
        let weighed = |(i, block): (usize, &Block)| {
            let by = times(i, block);
            Block { mass: block.mass * by, inertia: block.inertia * by, ..block.clone() }
        };
        let list = assembly.blocks.iter().enumerate().map(weighed).collect();
        Self { list, findings: Vec::new() }
    }
}

/// Resolves the blocks of a scene. They depend on its blocks, templates and materials alone.
///
/// # Errors
/// As [`resolve`], for shapes, materials and masses.
pub fn resolve_blocks(scene: &Scene) -> Result<Blocks, InputError> {
    let (list, findings) = blocks::resolve(scene, &|| false)?;
    Ok(Blocks { list, findings })
}

/// Resolves the rest of a scene whose blocks are those of [`resolve_blocks`] for it.
///
/// # Errors
/// As [`resolve`], for everything else.
pub fn resolve_with(scene: &Scene, blocks: Blocks) -> Result<Assembly, InputError> {
    let root = JsonPath::root();
    let gravity = gravity(scene, &root.key("gravity"))?;
    check::contact(&scene.contact, &root.key("contact"))?;
    site::resolve(scene.site.as_ref(), &root.key("site"))?;
    train::resolve(scene, gravity, &root.key("train"))?;

    let Blocks { list: mut blocks, findings } = blocks;
    let factors = combinations::resolve(scene)?;
    for block in &mut blocks {
        block.factor = factors.weight(scene, block.material.as_deref());
        block.mass *= block.factor;
        block.inertia *= block.factor;
    }
    let names = Names::new(&blocks)?;
    if blocks.is_empty() {
        return Err(InputError::at(root, "the scene has no blocks")
            .hint("give \"blocks\" or \"templates\""));
    }
    if !blocks.iter().any(|b| b.support) {
        return Err(InputError::at(
            root.key("blocks"),
            format!("none of the {} blocks is a support", blocks.len()),
        )
        .hint("set \"support\": true on the blocks that are held in place"));
    }
    if blocks.iter().all(|b| b.support) {
        return Err(InputError::at(
            root.key("blocks"),
            format!("all of the {} blocks are supports", blocks.len()),
        )
        .hint("leave \"support\" out on the blocks that may move"));
    }

    let joints = joints::resolve(scene, &names)?;
    let mut assembly = Assembly {
        name: scene.name.clone(),
        gravity,
        dead: Vec::new(),
        live: Vec::new(),
        dead_forces: Vec::new(),
        live_forces: Vec::new(),
        given: Vec::new(),
        members: Vec::new(),
        contact: scene.contact.clone(),
        said: Vec::new(),
        findings,
        joints,
        blocks,
    };
    let (given, told) = given::resolve(scene, &assembly, &names)?;
    let loads = loads::resolve(scene, &assembly, &names)?;
    assembly.given = given;
    assembly.divide_joints(&factors.materials);
    (assembly.dead, assembly.live) = (loads.dead, loads.live);
    (assembly.dead_forces, assembly.live_forces) = (loads.dead_forces, loads.live_forces);
    assembly.findings.extend(told);
    assembly.findings.extend(loads.findings);
    let (members, told) = members::resolve(scene, &assembly, &names)?;
    assembly.members = members.iter().map(|m| m.divided(factors.materials.members)).collect();
    assembly.findings.extend(told);
    stages(scene, &assembly)?;
    if let Some(name) = &scene.combination {
        let source = match factors.source.as_str() {
            "" => String::new(),
            source => format!(" ({source})"),
        };
        let text = format!("combination {name:?} is in force: {}{source}", factors.words());
        assembly.findings.push(Finding::new(FindingCode::Factored, text));
    }
    let mistakes = plausible::mistakes(scene, &assembly);
    assembly.findings.extend(mistakes);
    Ok(assembly)
}

fn gravity(scene: &Scene, path: &JsonPath) -> Result<Vector3<f64>, InputError> {
    let gravity = check::vector(scene.gravity, path)?;
    // The norm decides, not the components: it is what loads are multiplied by.
    if gravity.norm() == 0.0 {
        return Err(InputError::at(
            path.clone(),
            "gravity is zero: nothing presses the blocks together, so there is nothing to decide",
        )
        .hint("leave the key out for 9.81 m/s² downward"));
    }
    if !gravity.norm().is_finite() {
        return Err(InputError::at(path.clone(), "gravity is too large to compute").hint("m/s²"));
    }
    Ok(gravity)
}

/// The blocks by name.
struct Names(HashMap<String, usize>);

impl Names {
    /// Refuses empty names and names that stand for two blocks.
    fn new(blocks: &[Block]) -> Result<Self, InputError> {
        let mut names = HashMap::with_capacity(blocks.len());
        for (i, block) in blocks.iter().enumerate() {
            let from_template = blocks::from_template(&block.path);
            let path = if from_template { block.path.clone() } else { block.path.key("id") };
            if block.id.trim().is_empty() {
                return Err(InputError::at(path, "the id is empty")
                    .hint("every block needs a name of its own"));
            }
            if let Some(first) = names.insert(block.id.clone(), i) {
                let first = &blocks[first].path;
                let hint = if from_template {
                    "give the template a \"prefix\""
                } else {
                    "every block needs a name of its own"
                };
                return Err(InputError::at(
                    path,
                    format!("the id {:?} is already that of {first}", block.id),
                )
                .hint(hint));
            }
        }
        Ok(Self(names))
    }

    /// The index of the block called `id`.
    fn find(&self, id: &str, path: &JsonPath) -> Result<usize, InputError> {
        self.0.get(id).copied().ok_or_else(|| {
            let hint = suggest(id, self.0.keys().map(String::as_str));
            InputError {
                hint,
                ..InputError::at(path.clone(), format!("no block is called {id:?}"))
            }
        })
    }

    /// The indices of two different blocks.
    fn pair(&self, ids: &[String; 2], path: &JsonPath) -> Result<(usize, usize), InputError> {
        let (a, b) = (self.find(&ids[0], &path.index(0))?, self.find(&ids[1], &path.index(1))?);
        if a == b {
            return Err(InputError::at(
                path.clone(),
                format!("names the block {:?} twice", ids[0]),
            )
            .hint("a joint lies between two blocks"));
        }
        Ok((a, b))
    }
}
