//! MJCF: models of MuJoCo. A body with a free joint and all that is welded to it is a block; what has no
//! joint on its way to the world is held. Meshes are read as they are, though MuJoCo lets their convex hulls
//! collide.
//!
//! What would change how things stand and has no counterpart here is refused by name (joints with an axis,
//! equality constraints, tendons, shapes without an exact body); what would change it a little or later is
//! told. Softness of contacts (`solref`, `solimp`), looks and sensors are passed over.
//!
//! MuJoCo documentation, *XML reference* (mujoco.readthedocs.io, 3.3).

mod attributes;
mod mesh;
mod place;

use super::{
    raw::{Raw, Rule, Surface, tally},
    rigid::{self, Body, Form, Part, Weight},
    xml::{Xml, called, child, elements},
};
use attributes::{Attributes, Classes};
use base::error::{FindingCode, InputError};
use mesh::Meshes;
use nalgebra::{Isometry3, Point3, Vector3};
use place::Angles;
use roxmltree::Node;
use std::{collections::BTreeMap, path::Path};

/// MuJoCo's defaults.
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];
const DENSITY: f64 = 1000.0;
const FRICTION: f64 = 1.0;

/// Elements that make others, which only MuJoCo can do.
const MADE: [&str; 6] = ["include", "replicate", "composite", "flexcomp", "attach", "plugin"];

/// The remedy for what MuJoCo makes of a model when it compiles it.
const COMPILE: &str = "compile the model and save what came out: mujoco.mj_saveLastXML";

/// Reads one model.
struct Reader<'x, 'a, 'i> {
    xml: &'x Xml<'a>,
    classes: &'x Classes<'a, 'i>,
    meshes: Meshes<'x, 'a, 'i>,
    angles: Angles,
    /// `inertiafromgeom`: whether inertias given are used, where they are not the last word anyway.
    uses_inertial: bool,
    bodies: Vec<Body>,
    raw: Raw,
    /// What is told, with the places.
    notes: BTreeMap<Note, Vec<String>>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Note {
    Filters,
    Pairs,
    Inertia,
    Meshes,
    Sections,
    Options,
    Condim,
}

/// What an element hangs on.
#[derive(Clone, Copy)]
enum Owner {
    /// The world, or what is welded to it.
    Held,
    /// The number of a free body.
    Free(usize),
}

/// Where an element hangs.
#[derive(Clone, Copy)]
struct Place {
    owner: Owner,
    pose: Isometry3<f64>,
    class: usize,
    /// The number of the body that its shapes are added to.
    body: usize,
    /// Whether the body has its mass by itself.
    is_weighed: bool,
    /// Whether the world is the next body above.
    is_top: bool,
}

/// The blocks of a model; `folder` holds its meshes.
pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<Raw, InputError> {
    let xml = Xml::read(bytes)?;
    let model = xml.document.root_element();
    if !model.has_tag_name("mujoco") {
        let text = format!("the root is <{}>, not <mujoco>", model.tag_name().name());
        return Err(xml.error(model, text).hint("check that this is the right file"));
    }
    let classes = Classes::read(&xml, model)?;
    let mut reader = Reader {
        xml: &xml,
        classes: &classes,
        meshes: Meshes::of(model, &xml, &classes, folder),
        angles: Angles::default(),
        uses_inertial: true,
        bodies: Vec::new(),
        raw: Raw::default(),
        notes: BTreeMap::new(),
    };
    reader.settings(model)?;
    for section in elements(model) {
        reader.section(section)?;
    }
    reader.finish()
}

impl<'a, 'i> Reader<'_, 'a, 'i> {
    fn note(&mut self, note: Note, what: impl Into<String>) {
        self.notes.entry(note).or_default().push(what.into());
    }

    /// Gravity and how the file is to be read.
    fn settings(&mut self, model: Node<'a, 'i>) -> Result<(), InputError> {
        let xml = self.xml;
        for node in elements(model).filter(|n| n.has_tag_name("compiler")) {
            match node.attribute("angle") {
                Some("radian") => self.angles.unit = 1.0,
                Some("degree") => self.angles.unit = Angles::default().unit,
                _ => {}
            }
            if let Some(text) = node.attribute("eulerseq") {
                self.angles.sequence = place::sequence(xml, node, text)?;
            }
            let assets = || node.attribute("assetdir");
            if let Some(folder) = node.attribute("meshdir").or_else(assets) {
                self.meshes.below = folder.into();
            }
            if let Some(word) = node.attribute("strippath") {
                self.meshes.strips_path = word == "true";
            }
            if let Some(word) = node.attribute("inertiafromgeom") {
                self.uses_inertial = word != "true";
            }
            if node.attribute("coordinate") == Some("global") {
                return Err(xml.error(node, "global coordinates are not read").hint(COMPILE));
            }
            let changed = ["settotalmass", "boundmass", "boundinertia", "inertiagrouprange"];
            for name in changed.into_iter().filter(|n| node.has_attribute(*n)) {
                self.note(Note::Options, format!("compiler {name}"));
            }
        }
        let mut gravity = GRAVITY;
        for node in elements(model).filter(|n| n.has_tag_name("option")) {
            if let Some(text) = node.attribute("gravity") {
                gravity = xml.exactly(node, "option: gravity", text)?;
            }
            if ["wind", "o_friction"].iter().any(|n| node.has_attribute(*n)) {
                self.note(Note::Options, "option wind or o_friction");
            }
            let flags = elements(node).filter(|n| n.has_tag_name("flag"));
            for flag in flags.collect::<Vec<_>>() {
                if flag.attribute("gravity") == Some("disable") {
                    gravity = [0.0; 3];
                }
                for name in ["contact", "constraint", "override"] {
                    if flag.attribute(name)
                        == Some(if name == "override" { "enable" } else { "disable" })
                    {
                        self.note(Note::Options, format!("flag {name}"));
                    }
                }
            }
        }
        self.raw.gravity = Some(gravity);
        Ok(())
    }

    fn section(&mut self, section: Node<'a, 'i>) -> Result<(), InputError> {
        let xml = self.xml;
        let tag = section.tag_name().name();
        match tag {
            "worldbody" => {
                let class = match section.attribute("childclass") {
                    Some(name) => self.classes.number(xml, section, name)?,
                    None => 0,
                };
                self.bodies.push(Body { support: true, ..Body::default() });
                self.children(
                    section,
                    Place {
                        owner: Owner::Held,
                        pose: Isometry3::identity(),
                        class,
                        body: self.bodies.len() - 1,
                        is_weighed: false,
                        is_top: true,
                    },
                )
            }
            "equality" => {
                match elements(section).find(|n| n.attribute("active") != Some("false")) {
                    Some(node) => Err(xml
                        .error(node, format!("equality constraints are not read: {}", called(node)))
                        .hint("remove it; what is welded is a body without a joint in its parent")),
                    None => Ok(()),
                }
            }
            "tendon" | "deformable" => match elements(section).next() {
                Some(node) => Err(xml
                    .error(node, format!("section {tag} is not read: {}", called(node)))
                    .hint("remove it, or give it as a member of the scene")),
                None => Ok(()),
            },
            "contact" => {
                for node in elements(section) {
                    let ends = ["body1", "body2", "geom1", "geom2"];
                    let ends: Vec<&str> = ends.iter().filter_map(|n| node.attribute(*n)).collect();
                    let tag = node.tag_name().name();
                    self.note(Note::Pairs, format!("{tag} {}", ends.join("–")));
                }
                Ok(())
            }
            "actuator" | "keyframe" | "sensor" => {
                let count = elements(section).count();
                if count > 0 {
                    self.note(Note::Sections, format!("{tag} {count}"));
                }
                Ok(())
            }
            _ if MADE.contains(&tag) => {
                Err(xml.error(section, format!("<{tag}> is not read")).hint(COMPILE))
            }
            _ => Ok(()),
        }
    }

    /// What hangs on a body, the world or a frame.
    fn children(&mut self, node: Node<'a, 'i>, place: Place) -> Result<(), InputError> {
        for inner in elements(node) {
            match inner.tag_name().name() {
                "geom" => self.geom(inner, place)?,
                "body" => self.body(inner, place)?,
                "frame" => {
                    let own = self.classes.of(self.xml, inner, place.class)?;
                    let pose = place.pose * place::frame(self.xml, &own, &self.angles)?;
                    let class = self.class(inner, place.class)?;
                    self.children(inner, Place { pose, class, ..place })?;
                }
                tag if MADE.contains(&tag) => {
                    return Err(self
                        .xml
                        .error(inner, format!("<{tag}> is not read"))
                        .hint(COMPILE));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn class(&self, node: Node, inherited: usize) -> Result<usize, InputError> {
        let named = node.attribute("childclass");
        named.map_or(Ok(inherited), |name| self.classes.number(self.xml, node, name))
    }

    fn body(&mut self, node: Node<'a, 'i>, above: Place) -> Result<(), InputError> {
        let xml = self.xml;
        let class = self.class(node, above.class)?;
        let own = self.classes.of(xml, node, class)?;
        let pose = above.pose * place::frame(xml, &own, &self.angles)?;
        let is_free = self.joints(node, class, &above)?;
        if own.number(xml, "gravcomp")?.is_some_and(|g| g != 0.0) {
            return Err(xml
                .error(node, format!("{}: gravity compensation is not read", called(node)))
                .hint("remove gravcomp, or give the body a load in the scene"));
        }
        let owner = if is_free { Owner::Free(self.bodies.len()) } else { above.owner };
        let body = match owner {
            Owner::Free(number) if !is_free => number,
            _ => {
                self.bodies.push(Body {
                    id: node.attribute("name").unwrap_or_default().into(),
                    line: xml.line(node),
                    support: !is_free,
                    ..Body::default()
                });
                self.bodies.len() - 1
            }
        };
        let inertial = child(node, "inertial").filter(|_| self.uses_inertial);
        if let Some(inertial) = inertial {
            self.inertial(inertial, pose, body)?;
        }
        let is_weighed = inertial.is_some();
        self.children(node, Place { owner, pose, class, body, is_weighed, is_top: false })
    }

    /// Whether a body has a free joint.
    fn joints(
        &mut self,
        node: Node<'a, 'i>,
        class: usize,
        above: &Place,
    ) -> Result<bool, InputError> {
        let xml = self.xml;
        let mut is_free = false;
        let mut open: Vec<Node> = vec![node];
        while let Some(next) = open.pop() {
            for joint in elements(next) {
                match joint.tag_name().name() {
                    "frame" => open.push(joint),
                    "freejoint" => is_free = true,
                    "joint" => {
                        let kind =
                            self.classes.of(xml, joint, class)?.get("type").unwrap_or("hinge");
                        if kind != "free" {
                            let text = format!(
                                "{} of {} is a joint that turns or slides ({kind})",
                                called(joint),
                                called(node)
                            );
                            return Err(xml.error(joint, text).hint("blocks are rigid: remove the joint, and the body is welded to its parent, or make it a free joint"));
                        }
                        is_free = true;
                    }
                    _ => {}
                }
            }
        }
        if is_free && !above.is_top {
            let text = format!("{} has a free joint, and is not in the world itself", called(node));
            return Err(xml.error(node, text).hint("move it to the world body"));
        }
        Ok(is_free)
    }

    fn inertial(
        &mut self,
        node: Node<'a, 'i>,
        pose: Isometry3<f64>,
        body: usize,
    ) -> Result<(), InputError> {
        let xml = self.xml;
        let own = self.classes.of(xml, node, 0)?;
        let mass = own.number(xml, "mass")?.ok_or_else(|| {
            xml.error(node, "an inertial without a mass").hint("add mass=\"…\" in kg")
        })?;
        let at = own.numbers(xml, "pos", 3..=3)?.unwrap_or_else(|| vec![0.0; 3]);
        if self.bodies[body].support {
            return Ok(());
        }
        let mass = xml.positive(node, "inertial: mass", mass)?;
        self.bodies[body].lumps.push((mass, pose * Point3::new(at[0], at[1], at[2])));
        self.note(Note::Inertia, format!("line {}", xml.line(node)));
        Ok(())
    }

    fn geom(&mut self, node: Node<'a, 'i>, place: Place) -> Result<(), InputError> {
        let xml = self.xml;
        let own = self.classes.of(xml, node, place.class)?;
        let (form, pose) = self.form(&own)?;
        let masks = [own.whole(xml, "contype")?, own.whole(xml, "conaffinity")?];
        let masks = masks.map(|m| m.unwrap_or(1));
        let is_ghost = masks == [0, 0];
        if !is_ghost && masks != [1, 1] {
            self.note(Note::Filters, format!("{} (line {})", called(node), xml.line(node)));
        }
        let condim = own.whole(xml, "condim")?.unwrap_or(3);
        if condim > 3 {
            self.note(Note::Condim, format!("{} (line {})", called(node), xml.line(node)));
        }
        let friction = own.numbers(xml, "friction", 1..=3)?.map_or(FRICTION, |f| f[0]);
        if friction < 0.0 {
            let text = format!("{}: friction must be >= 0, got {friction}", called(node));
            return Err(xml.error(node, text).hint("a coefficient of friction"));
        }
        let surface = Surface {
            friction,
            priority: own.whole(xml, "priority")?.unwrap_or(0),
            is_smooth: condim == 1,
            rule: Rule::Greater,
        };
        let held = self.bodies[place.body].support;
        let weight = match place.is_weighed || held {
            true => Weight::None,
            false => self.weight(&own)?,
        };
        let part = Part {
            name: node.attribute("name").unwrap_or_default().into(),
            line: xml.line(node),
            form,
            pose: place.pose * pose,
            weight,
            surface: Some(surface),
            is_ghost,
        };
        self.bodies[place.body].parts.push(part);
        Ok(())
    }

    fn weight(&self, own: &Attributes) -> Result<Weight, InputError> {
        let xml = self.xml;
        let (node, mass) = (own.node, own.number(xml, "mass")?);
        let density = own.number(xml, "density")?.unwrap_or(DENSITY);
        if let Some(value) = [mass, Some(density)].into_iter().flatten().find(|v| *v < 0.0) {
            let text = format!("{}: a mass or density below zero: {value}", called(node));
            return Err(xml.error(node, text).hint("kg, kg/m³"));
        }
        if mass.is_none() && own.get("shellinertia") == Some("true") {
            let text = format!("{}: the mass of a shell is not read", called(node));
            return Err(xml.error(node, text).hint("give its mass, or remove shellinertia"));
        }
        Ok(mass.map_or(Weight::Density(density), Weight::Mass))
    }

    /// The shape of a geom and its frame in that of the body.
    fn form(&mut self, own: &Attributes<'_, 'a, 'i>) -> Result<(Form, Isometry3<f64>), InputError> {
        let (xml, node) = (self.xml, own.node);
        let kind = own.get("type").unwrap_or("sphere");
        let refuse = |what: &str, hint: &str| {
            Err(xml.error(node, format!("{} is {what}", called(node))).hint(hint))
        };
        let fit = own.get("mesh").filter(|_| kind != "mesh");
        if fit.is_some() {
            return refuse(&format!("a {kind} fitted to a mesh"), COMPILE);
        }
        let mut pose = place::frame(xml, own, &self.angles)?;
        let mut size = own.numbers(xml, "size", 1..=3)?.unwrap_or_default();
        if let Some(ends) = own.numbers(xml, "fromto", 6..=6)?
            && matches!(kind, "box" | "cylinder")
        {
            let (from, to) =
                (Vector3::new(ends[0], ends[1], ends[2]), Vector3::new(ends[3], ends[4], ends[5]));
            let Some(turn) = place::along(from - to) else {
                return refuse("of no length: both ends of fromto are the same", "set them apart");
            };
            let half = 0.5 * (from - to).norm();
            pose = Isometry3::from_parts((0.5 * (from + to)).into(), turn);
            size.truncate(1);
            if kind == "box" {
                size.extend(size.first().copied());
            }
            size.push(half);
        }
        let needed = |k: usize| -> Result<f64, InputError> {
            let value = size.get(k).copied().ok_or_else(|| {
                xml.error(node, format!("{} has a size of {} numbers", called(node), size.len()))
                    .hint("a box has three half lengths, a cylinder a radius and half a length, a sphere a radius")
            })?;
            xml.positive(node, &format!("{}: size", called(node)), value)
        };
        let form = match kind {
            "sphere" => Form::Sphere(needed(0)?),
            "box" => Form::Cuboid([needed(0)?, needed(1)?, needed(2)?]),
            "cylinder" => Form::Cylinder { radius: needed(0)?, half: needed(1)? },
            "plane" => Form::Plane,
            "mesh" => {
                let Some(name) = own.get("mesh") else {
                    return refuse("a mesh without its name", "add mesh=\"NAME\"");
                };
                let mesh = self.meshes.mesh(node, name)?;
                self.note(Note::Meshes, format!("{} (line {})", called(node), xml.line(node)));
                Form::Mesh(mesh)
            }
            "capsule" | "ellipsoid" | "hfield" | "sdf" => {
                return refuse(
                    &format!("a {kind}, for which scenes have no exact shape"),
                    "make it of a box, a cylinder, spheres or a mesh",
                );
            }
            _ => return refuse("of a type that is not known", "see MuJoCo's XML reference"),
        };
        Ok((form, pose))
    }

    fn finish(mut self) -> Result<Raw, InputError> {
        use FindingCode::{Converted, LeftOut};
        for (note, list) in std::mem::take(&mut self.notes) {
            let (code, what) = match note {
                Note::Filters => (
                    LeftOut,
                    "contype and conaffinity, not applied: all shapes may touch each other",
                ),
                Note::Pairs => (LeftOut, "pairs of the section contact, not applied"),
                Note::Inertia => (
                    Converted,
                    "inertials, of which mass and centre are read; the spread of the mass is that of the shapes",
                ),
                Note::Meshes => {
                    (Converted, "meshes, read as they are; MuJoCo lets their convex hulls collide")
                }
                Note::Sections => (LeftOut, "sections left out"),
                Note::Options => (LeftOut, "settings, not applied"),
                Note::Condim => {
                    (LeftOut, "friction about the normal and in rolling (condim), not applied")
                }
            };
            self.raw.say(code, format!("{what}: {}", tally(&list)));
        }
        rigid::gather(self.bodies, &mut self.raw)?;
        Ok(self.raw)
    }
}
