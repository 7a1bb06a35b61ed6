//! SDF (Gazebo): the collision shapes of the links of models. Links that fixed joints connect are one block;
//! what is static or fixed to the world is held. Other joints, included models and poses relative to named
//! frames are refused by name.
//!
//! Open Robotics, *SDFormat specification* 1.11 (sdformat.org).

use super::{
    raw::{Raw, Rule, Surface, tally},
    rigid::{self, Body, Form, Mesh, Part, Weight},
    text::shorten,
    urdf,
    xml::{Xml, called, child, elements},
};
use base::{
    error::{FindingCode, InputError},
    plane::Sets,
};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;
use std::{
    collections::{BTreeMap, HashMap},
    path::Path,
    rc::Rc,
};

/// The specification's defaults.
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.8];
const FRICTION: f64 = 1.0;
const MASS: f64 = 1.0;
const DENSITY: f64 = 1000.0;

/// A link of any model.
struct Link<'a, 'i> {
    node: Node<'a, 'i>,
    pose: Isometry3<f64>,
    support: bool,
}

struct Reader<'x, 'a, 'i> {
    xml: &'x Xml<'a>,
    folder: Option<&'x Path>,
    meshes: HashMap<String, Rc<Mesh>>,
    links: Vec<Link<'a, 'i>>,
    /// Numbers of links by their names, those of models before them.
    names: HashMap<String, usize>,
    /// Fixed joints: names of both ends, with the names of the models around.
    fixed: Vec<(Node<'a, 'i>, String)>,
    raw: Raw,
    notes: BTreeMap<&'static str, Vec<String>>,
}

/// The blocks of a file; `folder` holds its meshes.
pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<Raw, InputError> {
    let xml = Xml::read(bytes)?;
    let root = xml.document.root_element();
    if !root.has_tag_name("sdf") {
        let text = format!("the root is <{}>, not <sdf>", root.tag_name().name());
        return Err(xml.error(root, text).hint("check that this is the right file"));
    }
    let mut reader = Reader {
        xml: &xml,
        folder,
        meshes: HashMap::new(),
        links: Vec::new(),
        names: HashMap::new(),
        fixed: Vec::new(),
        raw: Raw::default(),
        notes: BTreeMap::new(),
    };
    let mut worlds = elements(root).filter(|n| n.has_tag_name("world"));
    let world = worlds.next();
    if let Some(second) = worlds.next() {
        return Err(xml.error(second, "a second world").hint("split the file: one world each"));
    }
    if let Some(world) = world {
        let gravity = child(world, "gravity").and_then(|g| Some((g, g.text()?)));
        let gravity = gravity.map(|(node, text)| xml.exactly(node, "gravity", text)).transpose()?;
        reader.raw.gravity = Some(gravity.unwrap_or(GRAVITY));
    }
    for node in [Some(root), world].into_iter().flatten() {
        reader.models(node, Isometry3::identity(), "", false)?;
    }
    reader.finish()
}

/// Whether a child says `true` or `1`.
fn is_true(node: Node, name: &str) -> bool {
    child(node, name).and_then(|n| n.text()).is_some_and(|t| matches!(t.trim(), "true" | "1"))
}

impl<'a, 'i> Reader<'_, 'a, 'i> {
    fn refuse<T>(&self, node: Node, text: impl Into<String>, hint: &str) -> Result<T, InputError> {
        Err(self.xml.error(node, text).hint(hint))
    }

    fn note(&mut self, what: &'static str, node: Node) {
        let place = format!("{} (line {})", called(node), self.xml.line(node));
        self.notes.entry(what).or_default().push(place);
    }

    /// The pose that a child says.
    fn pose(&self, node: Node) -> Result<Isometry3<f64>, InputError> {
        let Some(pose) = child(node, "pose") else { return Ok(Isometry3::identity()) };
        let frame = pose.attribute("relative_to").or(pose.attribute("frame")).unwrap_or("");
        if !matches!(frame, "" | "__model__" | "world") {
            let text = format!("{}: a pose relative to {:?}", called(node), shorten(frame));
            return self.refuse(pose, text, "write it in the frame of the element around it");
        }
        let Some(text) = pose.text().filter(|t| !t.trim().is_empty()) else {
            return Ok(Isometry3::identity());
        };
        let what = format!("{}: pose", called(node));
        if pose.attribute("rotation_format") == Some("quat_xyzw") {
            let [x, y, z, i, j, k, w] = self.xml.exactly(pose, &what, text)?;
            return match UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 0.0) {
                Some(turn) => Ok(Isometry3::from_parts(Translation3::new(x, y, z), turn)),
                None => self.refuse(pose, format!("{what}: a quaternion of zeros"), "0 0 0 1"),
            };
        }
        let [x, y, z, angles @ ..]: [f64; 6] = self.xml.exactly(pose, &what, text)?;
        let unit = if pose.attribute("degrees") == Some("true") { 1f64.to_radians() } else { 1.0 };
        let [roll, pitch, yaw] = angles.map(|a| a * unit);
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Ok(Isometry3::from_parts(Translation3::new(x, y, z), turn))
    }

    /// The models in an element.
    fn models(
        &mut self,
        node: Node<'a, 'i>,
        pose: Isometry3<f64>,
        names: &str,
        support: bool,
    ) -> Result<(), InputError> {
        for inner in elements(node) {
            match inner.tag_name().name() {
                "model" => {
                    let pose = pose * self.pose(inner)?;
                    let named = inner.attribute("name").unwrap_or_default();
                    let support = support || is_true(inner, "static");
                    self.model(inner, pose, &format!("{names}{named}::"), support)?;
                }
                "include" | "population" => {
                    let text = format!("<{}> is not read", inner.tag_name().name());
                    return self.refuse(inner, text, "put the model itself into the file");
                }
                "actor" | "road" | "plugin" => self.note("elements left out", inner),
                _ => {}
            }
        }
        Ok(())
    }

    fn model(
        &mut self,
        model: Node<'a, 'i>,
        pose: Isometry3<f64>,
        names: &str,
        support: bool,
    ) -> Result<(), InputError> {
        for inner in elements(model) {
            match inner.tag_name().name() {
                "link" => {
                    let name = format!("{names}{}", inner.attribute("name").unwrap_or_default());
                    let pose = pose * self.pose(inner)?;
                    if child(inner, "gravity").is_some() && !is_true(inner, "gravity") {
                        let text = format!("{} is without gravity", called(inner));
                        return self.refuse(
                            inner,
                            text,
                            "remove <gravity>, or make the model static",
                        );
                    }
                    let support = support || is_true(inner, "kinematic");
                    if self.names.insert(name.clone(), self.links.len()).is_some() {
                        let text = format!("two links are called {:?}", shorten(&name));
                        return self.refuse(inner, text, "rename one of them");
                    }
                    self.links.push(Link { node: inner, pose, support });
                }
                "joint" => match inner.attribute("type") {
                    Some("fixed") => self.fixed.push((inner, names.into())),
                    kind => {
                        let kind = shorten(kind.unwrap_or("without a type"));
                        let text = format!("{} turns or slides ({kind})", called(inner));
                        return self.refuse(inner, text, "blocks are rigid: make the joint fixed, and its links are one block, or remove it");
                    }
                },
                "gripper" => return self.refuse(inner, "<gripper> is not read", "remove it"),
                _ => {}
            }
        }
        self.models(model, pose, names, support)
    }

    fn finish(mut self) -> Result<Raw, InputError> {
        let mut sets = Sets::new(self.links.len());
        for (joint, names) in std::mem::take(&mut self.fixed) {
            let mut ends = Vec::new();
            for end in ["parent", "child"] {
                let name = child(joint, end).and_then(|n| n.text()).unwrap_or("").trim();
                match self.names.get(&format!("{names}{name}")) {
                    Some(number) => ends.push(*number),
                    None if name == "world" => {}
                    None => {
                        let text =
                            format!("{}: its {end} {:?} is no link", called(joint), shorten(name));
                        return self.refuse(joint, text, "name a link of the model, or world");
                    }
                }
            }
            match ends[..] {
                [a, b] => {
                    sets.join(a, b);
                }
                [a] => self.links[a].support = true,
                _ => {}
            }
        }
        let mut numbers = HashMap::new();
        let mut bodies: Vec<Body> = Vec::new();
        let named: HashMap<usize, String> = self.names.drain().map(|(n, k)| (k, n)).collect();
        for (k, link) in std::mem::take(&mut self.links).into_iter().enumerate() {
            let body = *numbers.entry(sets.find(k)).or_insert_with(|| {
                let id = named.get(&k).cloned().unwrap_or_default();
                bodies.push(Body {
                    id: plain(&id),
                    line: self.xml.line(link.node),
                    ..Body::default()
                });
                bodies.len() - 1
            });
            bodies[body].support |= link.support;
            self.link(&link, &mut bodies[body])?;
        }
        let (full, bare): (Vec<_>, Vec<_>) = bodies.into_iter().partition(|b| !b.parts.is_empty());
        for body in bare {
            let place = format!("{:?} (line {})", body.id, body.line);
            self.notes.entry("links without a collision shape, left out").or_default().push(place);
        }
        for (what, list) in std::mem::take(&mut self.notes) {
            self.raw.say(FindingCode::LeftOut, format!("{what}: {}", tally(&list)));
        }
        rigid::gather(full, &mut self.raw)?;
        Ok(self.raw)
    }

    fn link(&mut self, link: &Link<'a, 'i>, body: &mut Body) -> Result<(), InputError> {
        let xml = self.xml;
        let inertial = child(link.node, "inertial");
        let is_auto = inertial.is_some_and(|n| n.attribute("auto") == Some("true"));
        let usual = inertial.filter(|_| is_auto).map(|n| self.number(n, "density")).transpose()?;
        let usual = usual.flatten().unwrap_or(DENSITY);
        for collision in elements(link.node).filter(|n| n.has_tag_name("collision")) {
            let density = self.number(collision, "density")?.unwrap_or(usual);
            let form = self.form(collision)?;
            body.parts.push(Part {
                name: collision.attribute("name").unwrap_or_default().into(),
                line: xml.line(collision),
                form,
                pose: link.pose * self.pose(collision)?,
                weight: if is_auto { Weight::Density(density) } else { Weight::None },
                surface: Some(self.surface(collision)?),
                is_ghost: false,
            });
        }
        if is_auto || link.support {
            return Ok(());
        }
        let (mass, centre) = match inertial {
            Some(n) => (self.number(n, "mass")?, link.pose * self.pose(n)?),
            None => (None, link.pose),
        };
        match mass {
            None => {
                self.note("links without a mass, which have the specification's 1 kg", link.node)
            }
            Some(mass) if mass <= 0.0 => {
                let text = format!("{}: the mass must be > 0, got {mass}", called(link.node));
                return self.refuse(link.node, text, "kg");
            }
            Some(_) => {}
        }
        body.lumps.push((mass.unwrap_or(MASS), centre.translation.vector.into()));
        Ok(())
    }

    /// The number that a child says.
    fn number(&self, node: Node, name: &str) -> Result<Option<f64>, InputError> {
        let Some(inner) = child(node, name) else { return Ok(None) };
        let what = format!("{}: {name}", called(node));
        let [value] = self.xml.exactly(inner, &what, inner.text().unwrap_or(""))?;
        Ok(Some(value))
    }

    fn surface(&mut self, collision: Node) -> Result<Surface, InputError> {
        let surface = child(collision, "surface");
        let friction = surface.and_then(|s| child(s, "friction"));
        if surface
            .and_then(|s| child(s, "contact"))
            .is_some_and(|c| child(c, "collide_bitmask").is_some())
        {
            self.note("masks of what collides with what, not applied", collision);
        }
        if friction.is_some_and(|f| child(f, "torsional").is_some()) {
            self.note("friction about the normal, not applied", collision);
        }
        let ode = friction.and_then(|f| child(f, "ode"));
        let mu = ode.map(|o| self.number(o, "mu")).transpose()?.flatten();
        let across = ode.map(|o| self.number(o, "mu2")).transpose()?.flatten();
        if across.is_some() && across != mu {
            self.note(
                "a second friction across the first, of which the lesser is taken",
                collision,
            );
        }
        let friction = [mu, across].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let friction = if friction.is_finite() { friction } else { FRICTION };
        if friction < 0.0 {
            let text = format!("{}: friction must be >= 0, got {friction}", called(collision));
            return self.refuse(collision, text, "a coefficient of friction");
        }
        Ok(Surface { friction, priority: 0, is_smooth: false, rule: Rule::Lesser })
    }

    fn form(&mut self, collision: Node) -> Result<Form, InputError> {
        let xml = self.xml;
        let Some(shape) = child(collision, "geometry").and_then(|g| elements(g).next()) else {
            return self.refuse(
                collision,
                format!("{} has no geometry", called(collision)),
                "add <geometry>",
            );
        };
        let kind = shape.tag_name().name();
        let length = |name: &str| -> Result<f64, InputError> {
            let what = format!("{}: {kind} {name}", called(collision));
            let value = self.number(shape, name)?.ok_or_else(|| {
                xml.error(shape, format!("{what} is missing")).hint("lengths are in m")
            })?;
            xml.positive(shape, &what, value)
        };
        let three = |name: &str| -> Result<Option<[f64; 3]>, InputError> {
            let Some(inner) = child(shape, name) else { return Ok(None) };
            let what = format!("{}: {kind} {name}", called(collision));
            xml.exactly(inner, &what, inner.text().unwrap_or("")).map(Some)
        };
        match kind {
            "box" => {
                let what = format!("{}: box size", called(collision));
                let size = three("size")?.unwrap_or([0.0; 3]);
                size.iter().try_for_each(|s| xml.positive(shape, &what, *s).map(drop))?;
                Ok(Form::Cuboid(size.map(|s| 0.5 * s)))
            }
            "sphere" => Ok(Form::Sphere(length("radius")?)),
            "cylinder" => {
                Ok(Form::Cylinder { radius: length("radius")?, half: 0.5 * length("length")? })
            }
            "plane" => {
                let normal = Vector3::from(three("normal")?.unwrap_or([0.0, 0.0, 1.0]));
                match normal.try_normalize(0.0) {
                    Some(unit) if unit.z > 0.0 && unit.xy().norm() == 0.0 => Ok(Form::Plane),
                    _ => self.refuse(
                        shape,
                        format!("{}: a plane with a normal off z", called(collision)),
                        "turn it by the pose of the collision",
                    ),
                }
            }
            "mesh" => {
                let Some(name) = child(shape, "uri").and_then(|n| n.text()) else {
                    return self.refuse(shape, "a mesh without <uri>", "add the file");
                };
                if child(shape, "submesh").is_some() {
                    return self.refuse(
                        shape,
                        "<submesh> is not read",
                        "put it into a file of its own",
                    );
                }
                let scale = three("scale")?.unwrap_or([1.0; 3]);
                let (known, raw) = (&mut self.meshes, &mut self.raw);
                urdf::mesh(xml, shape, name.trim(), scale, self.folder, known, raw).map(Form::Mesh)
            }
            _ => {
                let text = format!("a {}, for which scenes have no exact shape", shorten(kind));
                self.refuse(shape, text, "make it of a box, a cylinder, spheres or a mesh")
            }
        }
    }
}

/// `brick` of `brick::link`, where that is all there is to it.
fn plain(name: &str) -> String {
    match name.split_once("::") {
        Some((model, "link" | "body" | "base_link")) => model.into(),
        _ => name.into(),
    }
}
