//! Files → one scene: scale and rotation, supports, friction, density, and what is still missing.

use super::{
    ImportOptions, Imported, Origin, Up,
    raw::{Raw, list, tally},
};
use crate::{At, Ball, BlockSpec, Material, Scene, Shape};
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    number::roundest,
    tolerance,
};
use std::collections::{BTreeMap, HashSet};

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
    findings.extend(told(&mut files));
    for file in files {
        let scale = file.scale(options);
        let place = |points: &mut [[f64; 3]], what: &str| {
            place(points, scale, options.up).map_err(|v| beyond(&file.origin, what, v, scale))
        };
        scene.materials.extend(file.materials);
        for mut block in file.blocks {
            place(&mut block.vertices, &block.id)?;
            origins.push(Origin { file: file.name.clone(), line: block.line, lines: block.lines });
            let shape = Shape::Polyhedron { vertices: block.vertices, faces: block.faces };
            scene.blocks.push(BlockSpec {
                support: block.support,
                material: block.material,
                ..BlockSpec::new(block.id, shape)
            });
        }
        for grain in file.grains {
            let mut centers: Vec<[f64; 3]> = grain.spheres.iter().map(|s| s.0).collect();
            place(&mut centers, &grain.id)?;
            let radii = grain.spheres.iter().map(|s| s.1 * scale);
            origins.push(Origin {
                file: file.name.clone(),
                line: Some(grain.line),
                lines: Vec::new(),
            });
            scene.blocks.push(spheres(grain.id, grain.support, centers.into_iter().zip(radii)));
        }
        for mut member in file.members {
            for end in member.tie.iter_mut().flat_map(|t| &mut t.between) {
                place(end.at.as_mut_slice(), &member.id)?;
            }
            scene.members.push(member);
        }
        for mut load in file.loads {
            if let Some(At::Point(at)) = &mut load.at {
                place(std::slice::from_mut(at), load.block.as_deref().unwrap_or("load"))?;
            }
            load.force = load.force.map(|f| options.up.rotate(f));
            scene.loads.live.push(load);
        }
        if !options.stored_interfaces {
            unwanted += file.interfaces.len();
            continue;
        }
        with_forces += file.with_forces;
        for mut interface in file.interfaces {
            place(&mut interface.points, &interface.between.join("–"))?;
            interface.normal = interface.normal.map(|n| options.up.rotate(n));
            scene.interfaces.push(interface);
        }
    }
    if let Some(density) = options.density {
        scene.materials = [(MATERIAL.to_string(), Material::of_density(density))].into();
        scene.blocks.iter_mut().for_each(|b| b.material = Some(MATERIAL.into()));
    }
    supports(&mut scene, options, &mut findings)?;
    interfaces(&mut scene, unwanted, with_forces, &mut findings);
    if options.friction.is_none() {
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

/// A sphere, or a clump about its first sphere's centre.
fn spheres(id: String, support: bool, list: impl Iterator<Item = ([f64; 3], f64)>) -> BlockSpec {
    let list: Vec<_> = list.collect();
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
    BlockSpec { at, support, ..BlockSpec::new(id, shape) }
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
        for end in file.interfaces.iter_mut().flat_map(|i| &mut i.between) {
            *end = rename(end);
        }
        for member in &mut file.members {
            member.id = rename(&member.id);
            let ends = member.tie.iter_mut().flat_map(|t| &mut t.between);
            ends.flat_map(|e| &mut e.block).for_each(|b| *b = rename(b));
        }
        file.loads.iter_mut().flat_map(|l| &mut l.block).for_each(|b| *b = rename(b));
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
        f.blocks.iter().map(|b| &b.id).chain(f.grains.iter().map(|g| &g.id)).cloned().collect()
    };
    files.iter().flat_map(of).find(|id| !ids.insert(id.clone()))
}

/// Renames materials that have the same name but another density than in a file before.
fn name_materials_apart(files: &mut [Raw]) {
    let mut all: BTreeMap<String, Material> = BTreeMap::new();
    for file in files {
        for (name, material) in std::mem::take(&mut file.materials) {
            let mut unique = name.clone();
            let mut number = 2;
            while all.get(&unique).is_some_and(|m| *m != material) {
                unique = format!("{name}-{number}");
                number += 1;
            }
            for block in file.blocks.iter_mut().filter(|b| b.material.as_ref() == Some(&name)) {
                block.material = Some(unique.clone());
            }
            all.insert(unique.clone(), material.clone());
            file.materials.insert(unique, material);
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
    match options.up {
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
