//! Member specs → [`MemberPlan`]s: names looked up, ends placed, faces found, bounds in newtons.

use super::{Names, check};
use crate::assembly::{
    Action, Anchor, Assembly, Block, BlockFace, DowelPlan, Member, MemberKind, MemberPlan,
    StripPlan, plausible,
};
use base::error::{Finding, FindingCode, InputError, JsonPath, Step};
use nalgebra::Vector3;
use scene::{
    Member as Spec, Scene, Shape, Template, generate,
    member::{
        Bar, Dowel, End, Face, Grip, Line, NamedFace, Soil, Strength, Strip, Tendon, Toothing,
    },
};
use std::collections::HashSet;

/// Resolves all members, those of the scene before those of templates; says what was worked out.
pub(super) fn resolve(
    scene: &Scene,
    assembly: &Assembly,
    names: &Names,
) -> Result<(Vec<MemberPlan>, Vec<Finding>), InputError> {
    let root = JsonPath::root();
    let own = scene.members.iter().enumerate();
    let mut specs: Vec<(Spec, JsonPath)> =
        own.map(|(i, m)| (m.clone(), root.key("members").index(i))).collect();
    for (k, template) in scene.templates.iter().enumerate() {
        let path = root.key("templates").index(k).key(template.name()).key("members");
        let placed = generate::members(template).into_iter().enumerate();
        specs.extend(placed.map(|(i, m)| (m, path.index(i))));
    }
    let place = Resolver { scene, assembly, names };
    let (mut plans, mut findings, mut seen) = (Vec::new(), Vec::new(), HashSet::new());
    for (spec, path) in &specs {
        if spec.id.trim().is_empty() {
            return Err(InputError::at(path.key("id"), "the id is empty")
                .hint("every member needs a name of its own"));
        }
        if !seen.insert(spec.id.as_str()) {
            let text = format!("the id {:?} is already that of another member", spec.id);
            return Err(InputError::at(path.key("id"), text).hint(
                "every member needs a name of its own; a template's \"prefix\" is put before",
            ));
        }
        plans.extend(place.member(spec, path, &mut findings)?);
    }
    findings.extend(plausible::members(&plans, &specs, assembly));
    Ok((plans, findings))
}

struct Resolver<'a> {
    scene: &'a Scene,
    assembly: &'a Assembly,
    names: &'a Names,
}

impl Resolver<'_> {
    fn member(
        &self,
        spec: &Spec,
        path: &JsonPath,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<MemberPlan>, InputError> {
        // Everything taken apart, so that a further kind cannot be forgotten here.
        let Spec { id, tie, strut, bar, tendon, strip, dowel, soil, grip, toothing } = spec;
        let given = [
            tie.is_some(),
            strut.is_some(),
            bar.is_some(),
            tendon.is_some(),
            strip.is_some(),
            dowel.is_some(),
            soil.is_some(),
            grip.is_some(),
            toothing.is_some(),
        ];
        const KINDS: &str = "\"tie\", \"strut\", \"bar\", \"tendon\", \"strip\", \"dowel\", \"soil\", \"grip\" or \"toothing\"";
        match given.iter().filter(|g| **g).count() {
            1 => {}
            0 => {
                return Err(InputError::at(path.clone(), "the member has no kind")
                    .hint(format!("add {KINDS}")));
            }
            n => {
                return Err(InputError::at(path.clone(), format!("the member has {n} kinds"))
                    .hint(format!("make a member of each: one of {KINDS}")));
            }
        }
        let whole = |key: &str, member: Result<Member, InputError>| {
            let named = |m| MemberPlan::Whole(Member { id: id.clone(), path: path.key(key), ..m });
            member.map(|m| vec![named(m)])
        };
        if let Some(line) = tie {
            return whole("tie", self.line(line, MemberKind::Tie, &path.key("tie")));
        }
        if let Some(line) = strut {
            return whole("strut", self.line(line, MemberKind::Strut, &path.key("strut")));
        }
        if let Some(b) = bar {
            return whole("bar", self.bar(b, &path.key("bar")));
        }
        if let Some(t) = tendon {
            return whole("tendon", self.tendon(t, &path.key("tendon")));
        }
        if let Some(s) = strip {
            return Ok(vec![self.strip(s, id, &path.key("strip"))?]);
        }
        if let Some(d) = dowel {
            return Ok(vec![self.dowel(d, id, &path.key("dowel"))?]);
        }
        if let Some(s) = soil {
            let soil = self.soil(s, &path.key("soil"))?;
            if soil.greatest == 0.0 {
                let text = format!(
                    "{}: the soil's surface lies below the middle of the face: it exerts no pressure",
                    path.key("soil").key("surface")
                );
                findings.push(Finding::new(FindingCode::WithoutEffect, text));
            }
            return whole("soil", Ok(soil));
        }
        if let Some(g) = grip {
            return self.grip(g, id, &path.key("grip"), findings);
        }
        let Some(t) = toothing else {
            return Err(InputError::at(path.clone(), "the member has no kind"));
        };
        let toothing = self.toothing(t, &path.key("toothing"))?;
        let text = format!(
            "toothed corner {id:?}: strength {} N, from the friction of {} courses",
            base::number::short(toothing.greatest),
            t.courses
        );
        findings.push(Finding::new(FindingCode::Assumed, text));
        whole("toothing", Ok(toothing))
    }

    fn line(&self, l: &Line, kind: MemberKind, path: &JsonPath) -> Result<Member, InputError> {
        let anchors = self.anchors(&l.between, &path.key("between"))?;
        let strength = strength(l.strength, &path.key("strength"))?;
        let prestress = within(l.prestress, 0.0, strength, &path.key("prestress"))?;
        let pulls = kind == MemberKind::Tie;
        let [least, greatest] = if pulls { [0.0, strength] } else { [-strength, 0.0] };
        Ok(Member {
            prestress: if pulls || prestress == 0.0 { prestress } else { -prestress },
            ..member(
                kind,
                Action::Line(anchors),
                [least + 0.0, greatest],
                stiffness(l.stiffness, path)?,
            )
        })
    }

    fn bar(&self, b: &Bar, path: &JsonPath) -> Result<Member, InputError> {
        let anchors = self.anchors(&b.between, &path.key("between"))?;
        let tension = strength(b.tension, &path.key("tension"))?;
        let compression = strength(b.compression, &path.key("compression"))?;
        let prestress = within(b.prestress, -compression, tension, &path.key("prestress"))?;
        Ok(Member {
            prestress,
            ..member(
                MemberKind::Bar,
                Action::Line(anchors),
                [0.0 - compression, tension],
                stiffness(b.stiffness, path)?,
            )
        })
    }

    fn tendon(&self, t: &Tendon, path: &JsonPath) -> Result<Member, InputError> {
        if t.through.len() < 2 {
            return Err(InputError::at(
                path.key("through"),
                "a tendon needs at least its two ends",
            )
            .hint("list the points that it passes, in order"));
        }
        let anchors = self.anchors(&t.through, &path.key("through"))?;
        let strength = strength(t.strength, &path.key("strength"))?;
        let prestress = within(t.prestress, 0.0, strength, &path.key("prestress"))?;
        Ok(Member {
            prestress,
            ..member(
                MemberKind::Tendon,
                Action::Line(anchors),
                [0.0, strength],
                stiffness(t.stiffness, path)?,
            )
        })
    }

    /// The points of a line. Its pieces have a length, and it joins something that moves.
    fn anchors(&self, ends: &[End], path: &JsonPath) -> Result<Vec<Anchor>, InputError> {
        let mut anchors = Vec::with_capacity(ends.len());
        for (k, end) in ends.iter().enumerate() {
            anchors.push(self.anchor(end, &path.index(k))?);
        }
        let blocks = &self.assembly.blocks;
        for (k, pair) in anchors.windows(2).enumerate() {
            let reach = pair[0].at.amax().max(pair[1].at.amax());
            let length = (pair[1].at - pair[0].at).norm();
            if length.is_nan() || length <= base::tolerance::COORDINATE_ROUNDING * reach {
                let text = "two points of the line lie in the same place: it has no direction";
                return Err(InputError::at(path.index(k + 1), text)
                    .hint("ends are points of the scene, in m"));
            }
            if !length.is_finite() {
                return Err(InputError::at(path.index(k + 1), "too far to compute").hint("in m"));
            }
        }
        let moves = |a: &&Anchor| a.block.is_some_and(|b| !blocks[b].support);
        if !anchors.iter().any(|a| moves(&a)) {
            let text = "no end is on a block that may move: the member has no effect";
            return Err(InputError::at(path.clone(), text).hint("name a free block at one end"));
        }
        let first = anchors[0].block;
        if anchors.iter().all(|a| a.block == first) {
            let text = "all ends are on the same block: the member has no effect";
            return Err(InputError::at(path.clone(), text)
                .hint("name another block, or the ground, at one end"));
        }
        Ok(anchors)
    }

    fn anchor(&self, end: &End, path: &JsonPath) -> Result<Anchor, InputError> {
        match end {
            End { block: Some(id), at: Some(at), arm, ground: None } => {
                let block = self.names.find(id, &path.key("block"))?;
                let at = check::vector(*at, &path.key("at"))?;
                self.on_block(block, at, *arm, &path.key("at"))?;
                Ok(Anchor { block: Some(block), at })
            }
            End { block: None, at: None, arm: false, ground: Some(at) } => {
                Ok(Anchor { block: None, at: check::vector(*at, &path.key("ground"))? })
            }
            _ => Err(InputError::at(path.clone(), "the place of this end is missing")
                .hint("write { \"block\": id, \"at\": [x, y, z] }, or { \"ground\": [x, y, z] }")),
        }
    }

    /// Refuses a point that lies far off its block, where no arm is said to carry the force.
    fn on_block(
        &self,
        block: usize,
        at: Vector3<f64>,
        arm: bool,
        path: &JsonPath,
    ) -> Result<(), InputError> {
        plausible::point(&self.assembly.blocks[block], at, arm, self.assembly, path)
    }

    fn strip(&self, s: &Strip, id: &str, path: &JsonPath) -> Result<MemberPlan, InputError> {
        if s.blocks.len() < 2 {
            return Err(InputError::at(path.key("blocks"), "a strip needs at least two blocks")
                .hint("list the blocks that it is bonded to, in order"));
        }
        let width = check::positive(s.width, &path.key("width"), "m")?;
        let fibres = strength(s.strength, &path.key("strength"))?;
        let debonding = match s.debonding {
            Some(d) => at_least_zero(d, &path.key("debonding"), "N/m")?,
            None => f64::INFINITY,
        };
        let development = at_least_zero(s.development, &path.key("development"), "m")?;
        let mut run: Vec<(usize, Option<BlockFace>)> = Vec::with_capacity(s.blocks.len());
        for (k, name) in s.blocks.iter().enumerate() {
            let place = path.key("blocks").index(k);
            let block = self.names.find(name, &place)?;
            if run.last().is_some_and(|(before, _)| *before == block) {
                return Err(InputError::at(place, format!("names the block {name:?} twice"))
                    .hint("list the blocks in order, each once"));
            }
            let face = match self.face(block, &s.face, &path.key("face")) {
                Ok(face) => Some(face),
                // What stands under an arch has no extrados.
                Err(_) if self.assembly.blocks[block].support => None,
                Err(e) => return Err(e),
            };
            run.push((block, face));
        }
        let strength = width * fibres.min(debonding);
        Ok(MemberPlan::Strip(StripPlan {
            id: id.into(),
            path: path.clone(),
            run,
            strength,
            development,
        }))
    }

    fn dowel(&self, d: &Dowel, id: &str, path: &JsonPath) -> Result<MemberPlan, InputError> {
        let (a, b) = self.names.pair(&d.blocks, &path.key("blocks"))?;
        let at = check::vector(d.at, &path.key("at"))?;
        for block in [a, b] {
            self.on_block(block, at, false, &path.key("at"))?;
        }
        if self.assembly.blocks[a].support && self.assembly.blocks[b].support {
            return Err(InputError::at(path.key("blocks"), "both blocks are supports")
                .hint("a dowel holds a free block"));
        }
        let strength = strength(d.strength, &path.key("strength"))?;
        Ok(match d.normal {
            None => MemberPlan::Dowel(DowelPlan {
                id: id.into(),
                path: path.clone(),
                blocks: [a, b],
                at,
                strength,
            }),
            Some(normal) => {
                let normal = check::direction(normal, &path.key("normal"))?;
                let action = Action::Shear { blocks: [a, b], at, normal };
                MemberPlan::Whole(Member {
                    id: id.into(),
                    path: path.clone(),
                    ..member(MemberKind::Dowel, action, [0.0, strength], None)
                })
            }
        })
    }

    fn soil(&self, s: &Soil, path: &JsonPath) -> Result<Member, InputError> {
        let on = self.free(&s.block, &path.key("block"))?;
        let face = self.face(on, &s.face, &path.key("face"))?;
        let direction = check::direction(s.direction, &path.key("direction"))?;
        let unit_weight = check::positive(s.unit_weight, &path.key("unit_weight"), "N/m³")?;
        let k = check::positive(s.k, &path.key("k"), "a coefficient of passive pressure")?;
        let surface = check::finite(s.surface, &path.key("surface"))?;
        let area: f64 =
            face.facets.iter().map(|(n, area)| area * (-n.dot(&direction)).max(0.0)).sum();
        if area <= 1e-9 * face.facets.iter().map(|f| f.1).sum::<f64>() {
            let text = "the soil would pull on this face or act along it, not press on it";
            return Err(InputError::at(path.key("direction"), text)
                .hint("give the direction in which the soil presses, into the face"));
        }
        let depth = (surface - face.centroid.z).max(0.0);
        let action = Action::Push { on, from: None, at: face.centroid, direction };
        Ok(member(MemberKind::Soil, action, [0.0, k * unit_weight * depth * area], None))
    }

    fn grip(
        &self,
        g: &Grip,
        id: &str,
        path: &JsonPath,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<MemberPlan>, InputError> {
        let on = self.free(&g.block, &path.key("block"))?;
        let friction = at_least_zero(g.friction, &path.key("friction"), "a coefficient")?;
        let strength = strength(g.strength, &path.key("strength"))?;
        if strength.is_infinite() {
            let text = "must be a number: a finger applies its force";
            return Err(InputError::at(path.key("strength"), text)
                .hint("in N; use a strut or a block for something that only resists"));
        }
        let places = match (g.at.is_some(), g.normal.is_some(), g.fingers.is_empty()) {
            (true, true, true) => vec![path.clone()],
            (false, false, false) => {
                (0..g.fingers.len()).map(|k| path.key("fingers").index(k)).collect()
            }
            _ => {
                let text = "the place of the fingers is missing";
                return Err(InputError::at(path.clone(), text).hint(
                    "give \"at\" and \"normal\", or \"fingers\": [ { \"at\": …, \"normal\": … } ]",
                ));
            }
        };
        let one = places.len() == 1;
        let mut list = Vec::with_capacity(places.len());
        for (k, (finger, path)) in g.all().into_iter().zip(&places).enumerate() {
            let at = check::vector(finger.at, &path.key("at"))?;
            self.on_block(on, at, g.arm, &path.key("at"))?;
            let normal = check::direction(finger.normal, &path.key("normal"))?;
            if normal.dot(&(self.assembly.blocks[on].centroid - at)) < 0.0 {
                let text = format!(
                    "{}: the finger presses away from the middle of block {:?}. Should the direction point into the block?",
                    path.key("normal"),
                    g.block
                );
                findings.push(Finding::new(FindingCode::Orientation, text));
            }
            let action = Action::Press { on, at, normal, friction };
            list.push(MemberPlan::Whole(Member {
                id: if one { id.to_string() } else { format!("{id}/{}", k + 1) },
                path: path.clone(),
                ..member(MemberKind::Grip, action, [0.0, strength], None)
            }));
        }
        Ok(list)
    }

    fn toothing(&self, t: &Toothing, path: &JsonPath) -> Result<Member, InputError> {
        let on = self.free(&t.block, &path.key("block"))?;
        let length = |key: &str, value: f64| check::positive(value, &path.key(key), "m");
        let (h, l) = (length("block_height", t.block_height)?, length("overlap", t.overlap)?);
        let thickness = length("thickness", t.thickness)?;
        let friction = at_least_zero(t.friction, &path.key("friction"), "a coefficient")?;
        let weight = check::positive(t.unit_weight, &path.key("unit_weight"), "N/m³")?;
        let height = check::finite(t.height, &path.key("height"))?;
        let direction = check::direction(t.direction, &path.key("direction"))?;
        if t.courses == 0 {
            return Err(InputError::at(path.key("courses"), "no course is toothed").hint("≥ 1"));
        }
        let n = t.courses as f64;
        let strength = 0.4 * n * (n + 1.0) * (h / l) * friction * l * l * thickness * weight;
        let centroid = self.assembly.blocks[on].centroid;
        let at = Vector3::new(centroid.x, centroid.y, height);
        self.on_block(on, at, false, &path.key("height"))?;
        let action = Action::Push { on, from: None, at, direction };
        Ok(member(MemberKind::Toothing, action, [0.0, strength], None))
    }

    /// A block that may move.
    fn free(&self, id: &str, path: &JsonPath) -> Result<usize, InputError> {
        let block = self.names.find(id, path)?;
        if self.assembly.blocks[block].support {
            return Err(InputError::at(
                path.clone(),
                format!("{id:?} is a support: a force on it changes nothing"),
            )
            .hint("remove the member"));
        }
        Ok(block)
    }

    /// A face of a block.
    fn face(&self, block: usize, face: &Face, path: &JsonPath) -> Result<BlockFace, InputError> {
        let own: &Block = &self.assembly.blocks[block];
        let along = |d: Vector3<f64>| own.face_towards(&d);
        let found = match face {
            Face::Near(near) => own.face_near(&check::vector(near.near, &path.key("near"))?),
            Face::Index(index) => {
                let point = self.middle_of_face(own, *index, path)?;
                own.face_near(&point)
            }
            Face::Named(NamedFace::Extrados) => along(self.outwards(own, path)?),
            Face::Named(NamedFace::Intrados) => along(-self.outwards(own, path)?),
            Face::Named(NamedFace::PlusX) => along(Vector3::x()),
            Face::Named(NamedFace::MinusX) => along(-Vector3::x()),
            Face::Named(NamedFace::PlusY) => along(Vector3::y()),
            Face::Named(NamedFace::MinusY) => along(-Vector3::y()),
            Face::Named(NamedFace::PlusZ) => along(Vector3::z()),
            Face::Named(NamedFace::MinusZ) => along(-Vector3::z()),
        };
        found.ok_or_else(|| {
            InputError::at(path.clone(), format!("block {:?} has no plane face there", own.id))
                .hint("a sphere has none")
        })
    }

    /// From the middle of the arch or barrel that a voussoir belongs to, across its depth.
    fn outwards(&self, block: &Block, path: &JsonPath) -> Result<Vector3<f64>, InputError> {
        let origin = match block.path.0.as_slice() {
            [Step::Key(key), Step::Index(k), ..] if key == "templates" => {
                match self.scene.templates.get(*k) {
                    Some(Template::Arch(a)) if !block.support => Some(a.at),
                    Some(Template::Barrel(b)) if !block.support => Some(b.at),
                    _ => None,
                }
            }
            _ => None,
        };
        let Some(origin) = origin else {
            let text =
                format!("block {:?} is not a voussoir of an arch or barrel template", block.id);
            return Err(InputError::at(path.clone(), text).hint(
                "name the face by \"+z\" and the like, or by a point: { \"near\": [x, y, z] }",
            ));
        };
        let mut out = block.centroid - Vector3::from(origin);
        out.y = 0.0;
        Ok(out.try_normalize(0.0).unwrap_or_else(Vector3::z))
    }

    /// The mean corner of a face of a block's list.
    fn middle_of_face(
        &self,
        block: &Block,
        index: usize,
        path: &JsonPath,
    ) -> Result<Vector3<f64>, InputError> {
        let spec = match block.path.0.as_slice() {
            [Step::Key(key), Step::Index(k)] if key == "blocks" => self.scene.blocks.get(*k),
            _ => None,
        };
        let Some((spec, Shape::Polyhedron { vertices, faces })) = spec.map(|s| (s, &s.shape))
        else {
            return Err(InputError::at(
                path.clone(),
                format!("block {:?} has no list of faces", block.id),
            )
            .hint("name the face by \"+z\" and the like, or by a point: { \"near\": [x, y, z] }"));
        };
        let Some(loop_) = faces.get(index) else {
            return Err(InputError::at(
                path.clone(),
                format!("block {:?} has {} faces, counted from 0", block.id, faces.len()),
            ));
        };
        let corners = loop_.iter().filter_map(|&v| vertices.get(v)).map(|&v| Vector3::from(v));
        let mean = corners.sum::<Vector3<f64>>() / loop_.len().max(1) as f64;
        super::blocks::in_scene(spec, mean)
    }
}

fn member(
    kind: MemberKind,
    action: Action,
    [least, greatest]: [f64; 2],
    stiffness: Option<f64>,
) -> Member {
    Member {
        id: String::new(),
        path: JsonPath::root(),
        kind,
        action,
        least,
        greatest,
        prestress: 0.0,
        stiffness,
    }
}

fn strength(strength: Strength, path: &JsonPath) -> Result<f64, InputError> {
    match strength {
        Strength::Infinite => Ok(f64::INFINITY),
        Strength::Finite(value) => at_least_zero(value, path, "N, or \"infinite\""),
    }
}

fn stiffness(stiffness: Option<f64>, path: &JsonPath) -> Result<Option<f64>, InputError> {
    stiffness.map(|k| check::positive(k, &path.key("stiffness"), "EA / l, N/m")).transpose()
}

fn at_least_zero(value: f64, path: &JsonPath, unit: &str) -> Result<f64, InputError> {
    check::finite(value, path)?;
    if value >= 0.0 {
        return Ok(value + 0.0);
    }
    Err(InputError::at(path.clone(), format!("must be >= 0, got {value}")).hint(unit))
}

fn within(value: f64, least: f64, greatest: f64, path: &JsonPath) -> Result<f64, InputError> {
    check::finite(value, path)?;
    if least <= value && value <= greatest {
        return Ok(value + 0.0);
    }
    let text = format!("must be from {least} to the strength {greatest}, got {value}");
    Err(InputError::at(path.clone(), text).hint("N"))
}
