//! URDF: the collision shapes of the links of a robot. Links that are fixed to each other are one block; a
//! link called `world`, and what is fixed to it, is held. Other roots of the tree are free, and so are links
//! behind a floating joint. Joints with an axis are refused by name.
//!
//! Willow Garage / Open Robotics, *urdf/XML* (wiki.ros.org/urdf/XML).

use super::{
    mesh::beside,
    raw::{Raw, tally},
    rigid::{self, Body, Form, Mesh, Part, Weight},
    text::shorten,
    xml::{Xml, called, child, elements},
};
use base::error::{FindingCode, InputError};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use roxmltree::Node;
use std::{
    collections::{HashMap, HashSet},
    path::Path,
    rc::Rc,
};

/// A joint: its child, its element, whether it lets the child go.
struct Hanging<'a, 'i> {
    child: &'a str,
    node: Node<'a, 'i>,
    is_free: bool,
}

/// The blocks of a robot; `folder` holds its meshes.
pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<Raw, InputError> {
    let xml = Xml::read(bytes)?;
    let robot = xml.document.root_element();
    if !robot.has_tag_name("robot") {
        let text = format!("the root is <{}>, not <robot>", robot.tag_name().name());
        return Err(xml.error(robot, text).hint("check that this is the right file"));
    }
    let mut links = HashMap::new();
    let mut order = Vec::new();
    for node in elements(robot).filter(|n| n.has_tag_name("link")) {
        let name = needed(&xml, node, "name")?;
        if links.insert(name, node).is_some() {
            let text = format!("two links are called {:?}", shorten(name));
            return Err(xml.error(node, text).hint("rename one of them"));
        }
        order.push(name);
    }
    let (mut below, mut hung) = (HashMap::<&str, Vec<Hanging>>::new(), HashSet::new());
    for node in elements(robot).filter(|n| n.has_tag_name("joint")) {
        let [parent, child] = ["parent", "child"].map(|end| {
            let named = child(node, end).and_then(|n| n.attribute("link"));
            named.filter(|name| links.contains_key(name)).ok_or_else(|| {
                xml.error(node, format!("{}: its {end} is no link of the robot", called(node)))
                    .hint(format!("add <{end} link=\"…\"/> with the name of a link"))
            })
        });
        let (parent, child) = (parent?, child?);
        let is_free = match needed(&xml, node, "type")? {
            "fixed" => false,
            "floating" => true,
            kind => {
                let text = format!("{} turns or slides ({})", called(node), shorten(kind));
                return Err(xml.error(node, text).hint("blocks are rigid: make the joint fixed, and its links are one block, or floating"));
            }
        };
        if !hung.insert(child) {
            let text =
                format!("{}: link {:?} has two joints above it", called(node), shorten(child));
            return Err(xml.error(node, text).hint("links are a tree: remove one of the joints"));
        }
        below.entry(parent).or_default().push(Hanging { child, node, is_free });
    }
    let mut reader = Reader {
        xml: &xml,
        folder,
        meshes: HashMap::new(),
        raw: Raw::default(),
        inertias: Vec::new(),
    };
    let (mut bodies, mut open) = (Vec::new(), Vec::new());
    for name in order.iter().filter(|name| !hung.contains(*name)) {
        open.push((*name, Isometry3::identity(), None, *name == "world"));
    }
    let mut seen = 0;
    while let Some((name, pose, above, support)) = open.pop() {
        seen += 1;
        let Some(node) = links.get(name).copied() else { continue };
        let body = above.unwrap_or_else(|| {
            bodies.push(Body {
                // What hangs on the world has names of its own.
                id: if name == "world" { String::new() } else { name.into() },
                line: xml.line(node),
                support,
                is_unweighed: true,
                ..Body::default()
            });
            bodies.len() - 1
        });
        reader.link(node, pose, &mut bodies[body])?;
        for joint in below.remove(name).unwrap_or_default().into_iter().rev() {
            let pose = pose * reader.origin(joint.node)?;
            let above = Some(body).filter(|_| !joint.is_free);
            open.push((joint.child, pose, above, support && !joint.is_free));
        }
    }
    if seen < order.len() {
        let text = format!("{} links hang on each other in a ring", order.len() - seen);
        return Err(xml.error(robot, text).hint("links are a tree: remove one of the joints"));
    }
    reader.finish(bodies)
}

fn needed<'a>(xml: &Xml, node: Node<'a, '_>, name: &str) -> Result<&'a str, InputError> {
    node.attribute(name).ok_or_else(|| {
        let tag = node.tag_name().name();
        xml.error(node, format!("<{tag}> without {name:?}")).hint(format!("add {name}=\"…\""))
    })
}

struct Reader<'x, 'a> {
    xml: &'x Xml<'a>,
    folder: Option<&'x Path>,
    meshes: HashMap<String, Rc<Mesh>>,
    raw: Raw,
    inertias: Vec<String>,
}

impl Reader<'_, '_> {
    /// The pose that a child `origin` says.
    fn origin(&self, node: Node) -> Result<Isometry3<f64>, InputError> {
        let Some(origin) = child(node, "origin") else { return Ok(Isometry3::identity()) };
        let three = |name: &str| match origin.attribute(name) {
            Some(text) => self.xml.exactly(origin, &format!("origin: {name}"), text),
            None => Ok([0.0; 3]),
        };
        let ([x, y, z], [roll, pitch, yaw]) = (three("xyz")?, three("rpy")?);
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Ok(Isometry3::from_parts(Translation3::new(x, y, z), turn))
    }

    fn link(
        &mut self,
        node: Node,
        pose: Isometry3<f64>,
        body: &mut Body,
    ) -> Result<(), InputError> {
        let xml = self.xml;
        let collisions = || elements(node).filter(|n| n.has_tag_name("collision"));
        let several = collisions().count() > 1;
        for collision in collisions() {
            let form = self.form(collision)?;
            let own = collision.attribute("name").filter(|_| several);
            body.parts.push(Part {
                name: own.or(node.attribute("name")).unwrap_or("").into(),
                line: xml.line(collision),
                form,
                pose: pose * self.origin(collision)?,
                weight: Weight::None,
                surface: None,
                is_ghost: false,
            });
        }
        let Some(inertial) = child(node, "inertial") else { return Ok(()) };
        let Some(mass) = child(inertial, "mass") else { return Ok(()) };
        let text = needed(xml, mass, "value")?;
        let [mass] = xml.exactly(inertial, &format!("{}: mass", called(node)), text)?;
        if mass < 0.0 {
            let text = format!("{}: a mass below zero: {mass}", called(node));
            return Err(xml.error(inertial, text).hint("kg"));
        }
        let centre = pose * self.origin(inertial)?;
        body.lumps.push((mass, centre.translation.vector.into()));
        body.is_unweighed = false;
        self.inertias.push(called(node));
        Ok(())
    }

    fn form(&mut self, collision: Node) -> Result<Form, InputError> {
        let xml = self.xml;
        let shape =
            child(collision, "geometry").and_then(|g| elements(g).next()).ok_or_else(|| {
                xml.error(collision, "a collision without geometry").hint("add <geometry>")
            })?;
        let kind = shape.tag_name().name();
        let number = |name: &str| -> Result<f64, InputError> {
            let what = format!("{kind}: {name}");
            let [value] = xml.exactly(shape, &what, needed(xml, shape, name)?)?;
            xml.positive(shape, &what, value)
        };
        match kind {
            "box" => {
                let size: [f64; 3] =
                    xml.exactly(shape, "box: size", needed(xml, shape, "size")?)?;
                size.iter().try_for_each(|s| xml.positive(shape, "box: size", *s).map(drop))?;
                Ok(Form::Cuboid(size.map(|s| 0.5 * s)))
            }
            "sphere" => Ok(Form::Sphere(number("radius")?)),
            "cylinder" => {
                Ok(Form::Cylinder { radius: number("radius")?, half: 0.5 * number("length")? })
            }
            "mesh" => {
                let scale = match shape.attribute("scale") {
                    Some(text) => xml.exactly(shape, "mesh: scale", text)?,
                    None => [1.0; 3],
                };
                let name = needed(xml, shape, "filename")?;
                let mesh =
                    mesh(xml, shape, name, scale, self.folder, &mut self.meshes, &mut self.raw)?;
                Ok(Form::Mesh(mesh))
            }
            _ => {
                let text = format!("a {}, for which scenes have no exact shape", shorten(kind));
                Err(xml.error(shape, text).hint("make it of a box, a cylinder, spheres or a mesh"))
            }
        }
    }

    fn finish(mut self, bodies: Vec<Body>) -> Result<Raw, InputError> {
        let robot = self.xml.document.root_element();
        let count = |what: &str| robot.descendants().filter(|n| n.has_tag_name(what)).count();
        let left: Vec<String> =
            ["visual", "gazebo", "transmission", "contact", "safety_controller"]
                .into_iter()
                .filter_map(|what| {
                    Some(count(what)).filter(|n| *n > 0).map(|n| format!("{what} {n}"))
                })
                .collect();
        if !left.is_empty() {
            let text = format!(
                "elements left out, only collision and inertial are read: {}",
                tally(&left)
            );
            self.raw.say(FindingCode::LeftOut, text);
        }
        if !self.inertias.is_empty() {
            self.raw.say(FindingCode::Converted, format!("inertials, of which mass and centre are read; the spread of the mass is that of the shapes: {}", tally(&self.inertias)));
        }
        let (full, bare): (Vec<_>, Vec<_>) = bodies.into_iter().partition(|b| !b.parts.is_empty());
        if !bare.is_empty() {
            let names: Vec<String> =
                bare.iter().map(|b| format!("{:?} (line {})", b.id, b.line)).collect();
            let text = format!("links without a collision shape, left out: {}", tally(&names));
            self.raw.say(FindingCode::LeftOut, text);
        }
        rigid::gather(full, &mut self.raw)?;
        Ok(self.raw)
    }
}

/// A mesh file that an element names, scaled; each is read once.
pub(super) fn mesh(
    xml: &Xml,
    node: Node,
    name: &str,
    scale: [f64; 3],
    folder: Option<&Path>,
    known: &mut HashMap<String, Rc<Mesh>>,
    raw: &mut Raw,
) -> Result<Rc<Mesh>, InputError> {
    if scale.contains(&0.0) {
        return Err(xml.error(node, "mesh: scale 0").hint("leave it out"));
    }
    let key = format!("{name} {scale:?}");
    if let Some(mesh) = known.get(&key) {
        return Ok(Rc::clone(mesh));
    }
    // Packages and models lie where their programs put them; here, beside the file.
    let of_package = |scheme| name.strip_prefix(scheme)?.split_once('/').map(|(_, path)| path);
    let path = ["package://", "model://"].into_iter().find_map(of_package);
    let path = path.or(name.strip_prefix("file://")).unwrap_or(name);
    let (mut mesh, said) = beside(folder, path)
        .map_err(|e| InputError { position: Some((xml.line(node), 1)), ..e })?;
    raw.findings.extend(said);
    for vertex in &mut mesh.vertices {
        *vertex = std::array::from_fn(|k| scale[k] * vertex[k]);
    }
    if scale.iter().product::<f64>() < 0.0 {
        mesh.faces.iter_mut().for_each(|f| f.reverse());
    }
    let mesh = Rc::new(mesh);
    known.insert(key, Rc::clone(&mesh));
    Ok(mesh)
}
