//! Files → one scene: scale and rotation, supports, friction, density, and what is still missing.

use super::{
    ImportOptions, Imported, Origin, Up,
    raw::{Grain, Ground, Raw, Solid, Surface, list, tally},
    surface,
};
use crate::{At, Ball, BlockSpec, Material, Scene, Shape};
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    number::roundest,
    tolerance,
};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Name of the material that carries [`ImportOptions::density`].
const MATERIAL: &str = "block";

/// The scene of all files.
pub(super) fn scene(mut files: Vec<Raw>, options: &ImportOptions) -> Result<Imported, InputError> {
    let mut findings = name_files_apart(&mut files)?;
    name_materials_apart(&mut files);
    let mut scene = Scene { source: source(&files, options), ..Scene::default() };
    scene.name = files.first().map(|f| f.stem.clone()).unwrap_or_default();
    scene.joints.default.friction = options.friction;
    if let Some(gap) = options.gap {
        scene.contact.gap = gap;
    }
    if let Some(angle) = options.angle_deg {
        scene.contact.angle_deg = angle;
    }
    let (mut unwanted, mut with_forces) = (0, 0);
    let mut origins = Vec::new();
    let (mut surfaces, mut gravity) = (BTreeMap::new(), None);
    findings.extend(told(&mut files));
    for file in files {
        let (scale, up) = (file.scale(options), file.up(options));
        let place = |points: &mut [[f64; 3]], what: &str| {
            place(points, scale, up).map_err(|v| beyond(&file.origin, what, v, scale))
        };
        scene.materials.extend(file.materials);
        surfaces.extend(file.surfaces);
        pull(&mut gravity, file.gravity.map(|g| up.rotate(g)), &file.origin, &mut findings);
        let mut add = |block, line, lines| {
            origins.push(Origin { file: file.name.clone(), line, lines });
            scene.blocks.push(block);
        };
        for mut block in file.blocks {
            place(&mut block.vertices, &block.id)?;
            place(block.heft.centroid.as_mut_slice(), &block.id)?;
            let (line, lines) = (block.line, std::mem::take(&mut block.lines));
            add(polyhedron(block), line, lines);
        }
        for mut grain in file.grains {
            let mut centers: Vec<[f64; 3]> = grain.spheres.iter().map(|s| s.0).collect();
            place(&mut centers, &grain.id)?;
            place(grain.heft.centroid.as_mut_slice(), &grain.id)?;
            let radii = grain.spheres.iter().map(|s| s.1 * scale);
            let list = centers.into_iter().zip(radii).collect();
            add(spheres(&grain, list), Some(grain.line), Vec::new());
        }
        for mut ground in file.planes {
            place(std::slice::from_mut(&mut ground.at), &ground.id)?;
            ground.normal = up.rotate(ground.normal);
            let line = ground.line;
            add(plane(ground), Some(line), Vec::new());
        }
        for mut member in file.members {
            for end in member.tie.iter_mut().flat_map(|t| &mut t.between) {
                place(end.at.as_mut_slice(), &member.id)?;
            }
            scene.members.push(member);
        }
        for mut load in file.dead {
            load.force = load.force.map(|f| up.rotate(f));
            scene.loads.dead.push(load);
        }
        for mut load in file.loads {
            if let Some(At::Point(at)) = &mut load.at {
                place(std::slice::from_mut(at), load.block.as_deref().unwrap_or("load"))?;
            }
            load.force = load.force.map(|f| up.rotate(f));
            scene.loads.live.push(load);
        }
        scene.stages.extend(file.stages);
        if !options.stored_interfaces {
            unwanted += file.interfaces.len();
            continue;
        }
        with_forces += file.with_forces;
        for mut interface in file.interfaces {
            place(&mut interface.points, &interface.between.join("–"))?;
            interface.normal = interface.normal.map(|n| up.rotate(n));
            scene.interfaces.push(interface);
        }
    }
    scene.gravity = gravity.unwrap_or(scene.gravity);
    surface::joints(&mut scene, &surfaces, options.friction, &mut findings)?;
    if let Some(density) = options.density {
        weigh(&mut scene, density);
    }
    supports(&mut scene, options, &mut findings)?;
    interfaces(&mut scene, unwanted, with_forces, &mut findings);
    if scene.joints.default.friction.is_none() {
        findings.push(Finding::new(
            FindingCode::Missing,
            "the scene has no friction for its joints and cannot be assessed: import with `--friction MU` or set joints.default.friction",
        ));
    }
    Ok(Imported { scene, findings, origins, unread: Vec::new() })
}

/// What files say: of several each with the files that say it.
fn told(files: &mut [Raw]) -> Vec<Finding> {
    let several = files.len() > 1;
    let mut all: Vec<(Finding, Vec<String>)> = Vec::new();
    for file in files {
        for finding in std::mem::take(&mut file.findings) {
            match all.iter_mut().find(|(known, _)| *known == finding) {
                Some((_, names)) => names.push(file.origin.clone()),
                None => all.push((finding, vec![file.origin.clone()])),
            }
        }
    }
    let named = |(finding, names): (Finding, Vec<String>)| match several {
        true => Finding { text: format!("{}: {}", list(&names), finding.text), ..finding },
        false => finding,
    };
    all.into_iter().map(named).collect()
}

/// The gravity of the first file that has one; another one of a later file is told.
fn pull(
    gravity: &mut Option<[f64; 3]>,
    own: Option<[f64; 3]>,
    origin: &str,
    findings: &mut Vec<Finding>,
) {
    match (&gravity, own) {
        (None, _) => *gravity = own,
        (Some(first), Some(own)) if *first != own => findings.push(Finding::new(
            FindingCode::LeftOut,
            format!("{origin}: gravity {own:?}, left out: a file before has {first:?}"),
        )),
        _ => {}
    }
}

/// One density for all blocks. Materials that exceptions of the joints name are kept.
fn weigh(scene: &mut Scene, density: f64) {
    let of_pairs: HashSet<String> =
        scene.joints.overrides.iter().flat_map(|o| o.between.clone()).flatten().collect();
    scene.materials.retain(|name, _| of_pairs.contains(name));
    scene.materials.values_mut().for_each(|m| m.density = density);
    for block in &mut scene.blocks {
        (block.density, block.mass, block.centroid) = (None, None, None);
        if block.material.as_ref().is_none_or(|name| !of_pairs.contains(name)) {
            block.material = Some(MATERIAL.into());
        }
    }
    if scene.blocks.iter().any(|b| b.material.as_deref() == Some(MATERIAL)) {
        scene.materials.insert(MATERIAL.into(), Material::of_density(density));
    }
}

fn polyhedron(block: Solid) -> BlockSpec {
    BlockSpec {
        support: block.support,
        material: block.material,
        density: block.heft.density,
        mass: block.heft.mass,
        centroid: block.heft.centroid,
        ..BlockSpec::new(
            block.id,
            Shape::Polyhedron { vertices: block.vertices, faces: block.faces },
        )
    }
}

fn plane(ground: Ground) -> BlockSpec {
    BlockSpec {
        at: ground.at,
        support: true,
        material: ground.material,
        ..BlockSpec::new(ground.id, Shape::Plane { normal: ground.normal })
    }
}

/// A sphere, or a clump about its first sphere's centre.
fn spheres(grain: &Grain, list: Vec<([f64; 3], f64)>) -> BlockSpec {
    let at = list.first().map_or([0.0; 3], |s| s.0);
    let shape = match list[..] {
        [(_, radius)] => Shape::Sphere { radius },
        _ => {
            let ball = |(c, radius): &([f64; 3], f64)| Ball {
                at: std::array::from_fn(|k| c[k] - at[k]),
                radius: *radius,
            };
            Shape::Clump { spheres: list.iter().map(ball).collect() }
        }
    };
    BlockSpec {
        at,
        support: grain.support,
        material: grain.material.clone(),
        density: grain.heft.density,
        mass: grain.heft.mass,
        centroid: grain.heft.centroid.map(|c| std::array::from_fn(|k| c[k] - at[k])),
        ..BlockSpec::new(grain.id.clone(), shape)
    }
}

/// Puts the file's name before its ids where two files use the same one.
fn name_files_apart(files: &mut [Raw]) -> Result<Vec<Finding>, InputError> {
    let Some(clash) = clash(files) else { return Ok(Vec::new()) };
    let mut prefixes: Vec<String> = Vec::new();
    for file in files.iter_mut() {
        let mut prefix = file.stem.clone();
        let mut number = 2;
        while prefixes.contains(&prefix) {
            prefix = format!("{}{number}", file.stem);
            number += 1;
        }
        // Where the only block of a file bears the file's name, that name is enough.
        let rename =
            |id: &str| if id == file.stem { prefix.clone() } else { format!("{prefix}-{id}") };
        file.blocks.iter_mut().for_each(|b| b.id = rename(&b.id));
        file.grains.iter_mut().for_each(|g| g.id = rename(&g.id));
        file.planes.iter_mut().for_each(|p| p.id = rename(&p.id));
        for end in file.interfaces.iter_mut().flat_map(|i| &mut i.between) {
            *end = rename(end);
        }
        for member in &mut file.members {
            member.id = rename(&member.id);
            let ends = member.tie.iter_mut().flat_map(|t| &mut t.between);
            ends.flat_map(|e| &mut e.block).for_each(|b| *b = rename(b));
        }
        file.stages.iter_mut().flat_map(|s| &mut s.add).for_each(|b| *b = rename(b));
        let loads = file.loads.iter_mut().chain(&mut file.dead);
        loads.flat_map(|l| &mut l.block).for_each(|b| *b = rename(b));
        prefixes.push(prefix);
    }
    if let Some(still) = self::clash(files) {
        return Err(InputError::at(
            JsonPath::root(),
            format!("two files lead to the same block id {still:?}"),
        )
        .hint("rename one of the files"));
    }
    let text = format!(
        "two files have a block {clash:?}: all ids now begin with the name of their file ({})",
        list(&prefixes)
    );
    Ok(vec![Finding::new(FindingCode::Converted, text)])
}

/// An id that is used twice.
fn clash(files: &[Raw]) -> Option<String> {
    let mut ids = HashSet::new();
    let of = |f: &'_ Raw| -> Vec<String> {
        let (blocks, grains) = (f.blocks.iter().map(|b| &b.id), f.grains.iter().map(|g| &g.id));
        blocks.chain(grains).chain(f.planes.iter().map(|p| &p.id)).cloned().collect()
    };
    files.iter().flat_map(of).find(|id| !ids.insert(id.clone()))
}

/// Renames materials that have the same name but another density or surface than in a file before.
fn name_materials_apart(files: &mut [Raw]) {
    let mut all: BTreeMap<String, (Material, Option<Surface>)> = BTreeMap::new();
    for file in files {
        let mut renamed: HashMap<String, String> = HashMap::new();
        let mut surfaces = std::mem::take(&mut file.surfaces);
        for (name, material) in std::mem::take(&mut file.materials) {
            let surface = surfaces.remove(&name);
            let here = (material.clone(), surface);
            let mut unique = name.clone();
            let mut number = 2;
            while all.get(&unique).is_some_and(|m| *m != here) {
                unique = format!("{name}-{number}");
                number += 1;
            }
            all.insert(unique.clone(), here);
            file.materials.insert(unique.clone(), material);
            file.surfaces.extend(surface.map(|s| (unique.clone(), s)));
            if unique != name {
                renamed.insert(name, unique);
            }
        }
        let blocks = file.blocks.iter_mut().map(|b| &mut b.material);
        let grains = file.grains.iter_mut().map(|g| &mut g.material);
        let planes = file.planes.iter_mut().map(|p| &mut p.material);
        for name in blocks.chain(grains).chain(planes).flatten() {
            if let Some(unique) = renamed.get(name) {
                name.clone_from(unique);
            }
        }
    }
}

/// Where the scene comes from, in words.
fn source(files: &[Raw], options: &ImportOptions) -> String {
    let mut text = format!(
        "imported from {}",
        files.iter().map(|f| f.origin.as_str()).collect::<Vec<_>>().join(", ")
    );
    if let Some(scale) = options.scale.filter(|&s| s != 1.0) {
        text.push_str(&format!("; coordinates × {scale}"));
    }
    match files.iter().map(|f| f.up(options)).find(|up| *up != Up::Z).unwrap_or_default() {
        Up::Z => {}
        Up::X => text.push_str("; x up rotated to z"),
        Up::Y => text.push_str("; y up rotated to z"),
        Up::MinusX => text.push_str("; −x up rotated to z"),
        Up::MinusY => text.push_str("; −y up rotated to z"),
        Up::MinusZ => text.push_str("; −z up rotated to z"),
    }
    text
}

/// Scale and rotation; a coordinate that is no longer finite comes back.
fn place(points: &mut [[f64; 3]], scale: f64, up: Up) -> Result<(), f64> {
    for point in points {
        *point = up.rotate(point.map(|c| c * scale));
        if let Some(&bad) = point.iter().find(|c| !c.is_finite()) {
            return Err(bad);
        }
    }
    Ok(())
}

fn beyond(origin: &str, what: &str, value: f64, scale: f64) -> InputError {
    let message =
        format!("{origin}: {what:?} has the coordinate {value} after multiplication by {scale}");
    InputError::at(JsonPath::root(), message)
        .hint("look for damaged coordinates, or choose a smaller scale")
}

/// Supports by name and by height, and a word where there is none.
fn supports(
    scene: &mut Scene,
    options: &ImportOptions,
    findings: &mut Vec<Finding>,
) -> Result<(), InputError> {
    for id in &options.supports {
        let Some(block) = scene.blocks.iter_mut().find(|b| b.id == *id) else {
            let known: Vec<String> = scene.blocks.iter().map(|b| format!("{:?}", b.id)).collect();
            return Err(InputError::at(JsonPath::root(), format!("support {id:?}: no such block"))
                .hint(format!("the blocks are {}", list(&known))));
        };
        block.support = true;
    }
    let lows: Vec<f64> = scene
        .blocks
        .iter()
        .map(|b| corners(b).into_iter().map(|p| p[2]).fold(f64::INFINITY, f64::min))
        .collect();
    if let Some(height) = options.support_below {
        let mut count = 0;
        for (block, _) in scene.blocks.iter_mut().zip(&lows).filter(|(_, low)| **low < height) {
            block.support = true;
            count += 1;
        }
        let lowest = lows.iter().copied().fold(f64::INFINITY, f64::min);
        let text = match count {
            0 => format!(
                "no block lies below {height} m, where supports were asked for; the lowest corner is at {lowest} m"
            ),
            n => format!("blocks with their lowest corner below {height} m, now supports: {n}"),
        };
        findings.push(Finding::new(
            if count == 0 { FindingCode::Missing } else { FindingCode::Converted },
            text,
        ));
    }
    if scene.blocks.iter().all(|b| !b.support) {
        findings.push(Finding::new(FindingCode::Missing, propose(scene, &lows)));
    } else if scene.blocks.iter().all(|b| b.support) {
        findings
            .push(Finding::new(FindingCode::Missing, "every block is a support: nothing can move"));
    }
    Ok(())
}

/// Leaves out stored interfaces between supports, where nothing can move and which a scene may not
/// have, and says what became of the others.
fn interfaces(scene: &mut Scene, unwanted: usize, with_forces: usize, findings: &mut Vec<Finding>) {
    let held: HashSet<&str> =
        scene.blocks.iter().filter(|b| b.support).map(|b| b.id.as_str()).collect();
    let (idle, kept): (Vec<_>, Vec<_>) = std::mem::take(&mut scene.interfaces)
        .into_iter()
        .partition(|i| i.between.iter().all(|id| held.contains(id.as_str())));
    scene.interfaces = kept;
    let mut say = |code, count: usize, text: String| {
        if count > 0 {
            findings.push(Finding::new(code, text));
        }
    };
    say(
        FindingCode::LeftOut,
        unwanted,
        format!("stored interfaces, left out as asked (contacts are detected instead): {unwanted}"),
    );
    let names: Vec<String> =
        idle.iter().map(|i| format!("{:?}–{:?}", i.between[0], i.between[1])).collect();
    say(
        FindingCode::LeftOut,
        idle.len(),
        format!("stored interfaces between two supports, left out: {}", tally(&names)),
    );
    let forces = if with_forces > 0 {
        format!("; with solved forces, which were left out: {with_forces}")
    } else {
        String::new()
    };
    let kept = scene.interfaces.len();
    say(
        FindingCode::Converted,
        kept,
        format!("stored interfaces, kept in place of detected contacts: {kept}{forces}"),
    );
}

/// The lowest blocks, as candidates for supports.
fn propose(scene: &Scene, lows: &[f64]) -> String {
    let lowest = lows.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = scene
        .blocks
        .iter()
        .flat_map(|b| corners(b).into_iter().map(|p| p[2]))
        .fold(f64::NEG_INFINITY, f64::max);
    let band = lowest + tolerance::LOWEST_BAND * (highest - lowest);
    // As few digits to type as select the same blocks.
    let above = lows.iter().copied().filter(|low| *low >= band).fold(highest, f64::min);
    let below = lows.iter().copied().filter(|low| *low < band).fold(lowest, f64::max);
    let height = roundest(band, (above - band).min(band - below) / 2.0);
    let candidates: Vec<String> = scene
        .blocks
        .iter()
        .zip(lows)
        .filter(|(_, low)| **low < height)
        .map(|(b, _)| b.id.clone())
        .collect();
    match candidates.len() {
        0 => "no block is a support: import with `--support ID`".into(),
        _ => format!(
            "no block is a support; the lowest blocks are {}: import with `--support ID` for each support, \
             or with `--support-below {height}` for all of these",
            tally(&candidates.iter().map(|id| format!("{id:?}")).collect::<Vec<_>>())
        ),
    }
}

/// Corners of a block in the scene; of spheres their lowest and highest points.
fn corners(block: &BlockSpec) -> Vec<[f64; 3]> {
    let poles = |at: [f64; 3], r: f64| {
        [-r, r].map(|z| [block.at[0] + at[0], block.at[1] + at[1], block.at[2] + at[2] + z])
    };
    match &block.shape {
        Shape::Polyhedron { vertices, .. } => vertices.clone(),
        Shape::Sphere { radius } => poles([0.0; 3], *radius).to_vec(),
        Shape::Clump { spheres } => spheres.iter().flat_map(|s| poles(s.at, s.radius)).collect(),
        // Importers make no others.
        _ => Vec::new(),
    }
}
