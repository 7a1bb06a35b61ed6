//! Meshes of a model.

use super::{attributes::Classes, place};
use crate::{
    generate::hull,
    import::{
        mesh::beside,
        rigid::Mesh,
        text::shorten,
        xml::{Xml, called, elements},
    },
};
use base::error::{Finding, InputError};
use nalgebra::{UnitQuaternion, Vector3};
use roxmltree::Node;
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    rc::Rc,
};

/// The meshes by their names, and those that were wanted already.
pub(super) struct Meshes<'x, 'a, 'i> {
    xml: &'x Xml<'a>,
    classes: &'x Classes<'a, 'i>,
    /// That of the model, and the one below it where its meshes are.
    folder: Option<&'x Path>,
    pub below: PathBuf,
    /// Whether only the names of files count, not their folders.
    pub strips_path: bool,
    /// What their files said.
    pub findings: Vec<Finding>,
    nodes: HashMap<String, Node<'a, 'i>>,
    known: HashMap<String, Rc<Mesh>>,
}

impl<'x, 'a, 'i> Meshes<'x, 'a, 'i> {
    /// Those of a model; none is read yet.
    pub fn of(
        model: Node<'a, 'i>,
        xml: &'x Xml<'a>,
        classes: &'x Classes<'a, 'i>,
        folder: Option<&'x Path>,
    ) -> Self {
        let assets = elements(model).filter(|n| n.has_tag_name("asset")).flat_map(elements);
        let named = assets.filter(|n| n.has_tag_name("mesh")).filter_map(|n| {
            let of_file =
                || Some(Path::new(n.attribute("file")?).file_stem()?.to_str()?.to_string());
            Some((n.attribute("name").map(str::to_string).or_else(of_file)?, n))
        });
        Self {
            xml,
            classes,
            folder,
            below: PathBuf::new(),
            strips_path: false,
            findings: Vec::new(),
            nodes: named.collect(),
            known: HashMap::new(),
        }
    }

    /// The mesh that an element names.
    pub fn mesh(&mut self, user: Node, name: &str) -> Result<Rc<Mesh>, InputError> {
        if let Some(mesh) = self.known.get(name) {
            return Ok(Rc::clone(mesh));
        }
        let Some(node) = self.nodes.get(name).copied() else {
            let text = format!("{}: no mesh is called {:?}", called(user), shorten(name));
            return Err(self.xml.error(user, text).hint("meshes stand in the section <asset>"));
        };
        let mesh = Rc::new(self.made(node)?);
        self.known.insert(name.into(), Rc::clone(&mesh));
        Ok(mesh)
    }

    fn made(&mut self, node: Node<'a, 'i>) -> Result<Mesh, InputError> {
        let xml = self.xml;
        let of = self.classes.of(xml, node, 0)?;
        if let Some(name) = ["builtin", "plugin"].iter().find(|n| node.has_attribute(**n)) {
            let text = format!("{}: meshes by {name:?} are not read", called(node));
            return Err(xml.error(node, text).hint("write the mesh to an OBJ or STL file"));
        }
        let three = |name| -> Result<Option<Vector3<f64>>, InputError> {
            Ok(of.numbers(xml, name, 3..=3)?.map(|v| Vector3::new(v[0], v[1], v[2])))
        };
        let scale = three("scale")?.unwrap_or_else(|| Vector3::repeat(1.0));
        if scale.iter().any(|s| *s == 0.0) {
            return Err(xml.error(node, format!("{}: scale 0", called(node))).hint("leave it out"));
        }
        let from = three("refpos")?.unwrap_or_default();
        let turn = match of.numbers(xml, "refquat", 4..=4)? {
            None => UnitQuaternion::identity(),
            Some(q) => place::quaternion(q[0], q[1], q[2], q[3]).ok_or_else(|| {
                xml.error(node, format!("{}: refquat is zero", called(node))).hint("leave it out")
            })?,
        };
        let mut mesh = match node.attribute("file") {
            Some(file) => self.file(node, file)?,
            None => self.inline(node)?,
        };
        for vertex in &mut mesh.vertices {
            let moved = turn.inverse() * (Vector3::from(*vertex) - from);
            *vertex = moved.component_mul(&scale).into();
        }
        if scale.product() < 0.0 {
            mesh.faces.iter_mut().for_each(|f| f.reverse());
        }
        Ok(mesh)
    }

    fn file(&mut self, node: Node, file: &str) -> Result<Mesh, InputError> {
        let xml = self.xml;
        let base = match self.strips_path {
            true => Path::new(file).file_name().map_or_else(|| Path::new(file), Path::new),
            false => Path::new(file),
        };
        let path = self.below.join(base);
        let (mesh, said) = beside(self.folder, &path.to_string_lossy())
            .map_err(|e| InputError { position: Some((xml.line(node), 1)), ..e })?;
        self.findings.extend(said);
        Ok(mesh)
    }

    /// Corners, and triangles or their hull.
    fn inline(&self, node: Node) -> Result<Mesh, InputError> {
        let (xml, named) = (self.xml, called(node));
        let Some(text) = node.attribute("vertex") else {
            let text = format!("{named}: neither a file nor corners");
            return Err(xml.error(node, text).hint("add file= or vertex="));
        };
        let triples = |list: Vec<f64>, what: &str| match list.len() % 3 {
            0 => Ok(list.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect::<Vec<_>>()),
            _ => Err(xml
                .error(node, format!("{named}: {what}: {} numbers, not three each", list.len()))
                .hint("the file may be damaged here")),
        };
        let what = format!("{named}: vertex");
        let vertices = triples(xml.numbers(node, &what, text, 0..=usize::MAX)?, "vertex")?;
        let faces = match node.attribute("face") {
            None => {
                let hull = hull::corners(&vertices).ok_or_else(|| {
                    xml.error(node, format!("{named}: its corners enclose no volume"))
                        .hint("give four or more corners that lie in no plane, or faces")
                })?;
                return Ok(Mesh { vertices: hull.0, faces: hull.1 });
            }
            Some(text) => {
                let what = format!("{named}: face");
                triples(xml.numbers(node, &what, text, 0..=usize::MAX)?, "face")?
            }
        };
        let corner = |v: f64| match v >= 0.0 && v < vertices.len() as f64 && v.fract() == 0.0 {
            true => Ok(v as usize),
            false => Err(xml
                .error(node, format!("{named}: face: corner {v} of {} corners", vertices.len()))
                .hint("corners count from 0")),
        };
        let face = |f: [f64; 3]| f.into_iter().map(corner).collect::<Result<Vec<_>, _>>();
        Ok(Mesh { faces: faces.into_iter().map(face).collect::<Result<_, _>>()?, vertices })
    }
}
