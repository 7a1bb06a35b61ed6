//! glTF and OBJ read back: as the specification says, and against the mechanics.

use super::{arch, assessed, ball_on_box, limited};
use data_encoding::BASE64;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::{Value, json};
use voussoir::report::{
    gltf,
    obj::obj,
    view::{View, ViewShape},
};

/// A file with its buffer.
struct Model {
    json: Value,
    bytes: Vec<u8>,
}

impl Model {
    fn read(view: &View) -> Self {
        let json: Value = serde_json::from_str(&gltf::text(view).unwrap()).unwrap();
        let uri = json["buffers"][0]["uri"].as_str().unwrap();
        let data = uri.strip_prefix("data:application/octet-stream;base64,").expect("a data URI");
        let bytes = BASE64.decode(data.as_bytes()).unwrap();
        Self { json, bytes }
    }

    fn list(&self, name: &str) -> &[Value] {
        self.json[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// The four bytes of each number of an accessor; it may not reach beyond its view.
    fn words(&self, accessor: usize) -> (&Value, Vec<[u8; 4]>) {
        let a = &self.list("accessors")[accessor];
        let view = &self.list("bufferViews")[whole(&a["bufferView"])];
        let (start, length) = (whole(&view["byteOffset"]), whole(&view["byteLength"]));
        let size = match a["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            other => panic!("{other}"),
        };
        assert_eq!(whole(&a["count"]) * size * 4, length, "{a}");
        assert!(start.is_multiple_of(4) && start + length <= self.bytes.len(), "{view}");
        let words = self.bytes[start..start + length].chunks_exact(4);
        (a, words.map(|w| w.try_into().unwrap()).collect())
    }

    fn floats(&self, accessor: usize) -> Vec<f64> {
        let (a, words) = self.words(accessor);
        assert_eq!(a["componentType"], 5126);
        let list: Vec<f64> = words.into_iter().map(|w| f64::from(f32::from_le_bytes(w))).collect();
        // Bounds are those of the data.
        let size = a["min"].as_array().unwrap().len();
        for k in 0..size {
            let of = || list.iter().skip(k).step_by(size).copied();
            assert_eq!(a["min"][k].as_f64().unwrap(), of().fold(f64::INFINITY, f64::min));
            assert_eq!(a["max"][k].as_f64().unwrap(), of().fold(f64::NEG_INFINITY, f64::max));
        }
        list
    }

    fn vectors(&self, accessor: usize) -> Vec<Vector3<f64>> {
        self.floats(accessor).chunks_exact(3).map(Vector3::from_column_slice).collect()
    }

    /// Corners of the triangles of a node, in its own frame.
    fn triangles(&self, node: &Value) -> Vec<[Vector3<f64>; 3]> {
        let primitive = &self.list("meshes")[whole(&node["mesh"])]["primitives"][0];
        let points = self.vectors(whole(&primitive["attributes"]["POSITION"]));
        let normals = self.vectors(whole(&primitive["attributes"]["NORMAL"]));
        assert!(
            normals.len() == points.len() && normals.iter().all(|n| (n.norm() - 1.0).abs() < 1e-6)
        );
        let (a, words) = self.words(whole(&primitive["indices"]));
        assert_eq!(a["componentType"], 5125);
        let indices: Vec<usize> =
            words.into_iter().map(|w| u32::from_le_bytes(w) as usize).collect();
        assert!(indices.iter().all(|&i| i < points.len()) && indices.len().is_multiple_of(3));
        indices.chunks_exact(3).map(|t| [points[t[0]], points[t[1]], points[t[2]]]).collect()
    }
}

fn whole(value: &Value) -> usize {
    value.as_u64().unwrap_or_else(|| panic!("{value}")) as usize
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_iterator(value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()))
}

fn turned(q: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[0], q[1], q[2]))
}

fn volume(triangles: &[[Vector3<f64>; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.dot(&b.cross(c)) / 6.0).sum()
}

/// One node a block, by its name, where it stands once the root has turned it, with its volume.
#[test]
fn nodes_are_the_blocks() {
    let (model, view) = limited(&arch(0.2, 3.0, json!({})));
    let file = Model::read(&view);
    let nodes = file.list("nodes");
    assert_eq!(nodes.len(), 1 + view.bodies.len() + 1, "root, blocks, a line of thrust");
    assert_eq!(nodes[0]["name"], "voussoir");
    assert_eq!(nodes[0]["children"], json!((1..nodes.len()).collect::<Vec<_>>()));
    let root = turned(&[0, 1, 2, 3].map(|k| nodes[0]["rotation"][k].as_f64().unwrap()));
    let offset = vector(&nodes[0]["translation"]);
    for ((node, body), block) in nodes[1..].iter().zip(&view.bodies).zip(&model.assembly.blocks) {
        assert_eq!(node["name"], body.id.as_str());
        assert_eq!(node["extras"]["support"], body.support);
        // y is upwards: (x, y, z) of the scene is (x, z, −y).
        let at = offset + root * vector(&node["translation"]);
        let wanted = Vector3::new(body.center.x, body.center.z, -body.center.y);
        assert!((at - wanted).norm() < 1e-12, "{at} {wanted}");
        let share = volume(&file.triangles(node)) / block.solid.volume();
        assert!((share - 1.0).abs() < 1e-5, "{}: {share}", body.id);
    }
    for mesh in file.list("meshes") {
        let material = whole(&mesh["primitives"][0]["material"]);
        assert!(material < file.list("materials").len());
    }
}

/// At its end an animation has every corner where the screw of its block's rates takes it, and on
/// the way no block is deformed; what does not move has no channel.
#[test]
fn an_animation_ends_at_the_displaced_pose() {
    let (_, view) = limited(&arch(0.2, 3.0, json!({})));
    let file = Model::read(&view);
    let (motion, told) = (&view.motions[0], &file.list("nodes")[0]["extras"]["animations"][0]);
    let way = told["fastest_corner_m"].as_f64().unwrap();
    assert!(way > 0.0 && told["name"] == motion.name.as_str());
    let animation = &file.list("animations")[0];
    type End = (Option<Vector3<f64>>, Option<UnitQuaternion<f64>>);
    let mut ends: Vec<End> = vec![(None, None); view.bodies.len()];
    for channel in animation["channels"].as_array().unwrap() {
        let sampler = &animation["samplers"][whole(&channel["sampler"])];
        let (times, values) =
            (file.floats(whole(&sampler["input"])), file.floats(whole(&sampler["output"])));
        assert!(times[0] == 0.0 && times.windows(2).all(|t| t[0] < t[1]), "{times:?}");
        let body = whole(&channel["target"]["node"]) - 1;
        match channel["target"]["path"].as_str().unwrap() {
            "translation" => {
                assert_eq!(values.len(), 3 * times.len());
                ends[body].0 = Some(Vector3::from_column_slice(&values[values.len() - 3..]));
            }
            "rotation" => {
                assert_eq!(values.len(), 4 * times.len());
                assert!(
                    values
                        .chunks(4)
                        .all(|q| (q.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-6)
                );
                ends[body].1 = Some(turned(&values[values.len() - 4..]));
            }
            other => panic!("{other}"),
        }
    }
    let mut farthest: f64 = 0.0;
    for (i, (body, end)) in view.bodies.iter().zip(&ends).enumerate() {
        let rate = &motion.rates[i];
        let moves = rate.velocity.norm() > 0.0 || rate.spin.norm() > 0.0;
        assert_eq!(end.0.is_some(), moves, "{}", body.id);
        let (Some(at), Some(turn)) = end else { continue };
        let ViewShape::Surface(surface) = &body.shape else { panic!() };
        for p in &surface.corners {
            let arm = p - body.center;
            let there = view.middle() + at + turn * arm;
            // About the axis of the screw, which for hinges in a plane is the hinge: the way on its
            // circle is what the rate says, s = way / reach.
            let s = way / motion.reach;
            let axis = rate.spin.cross(&rate.velocity) / rate.spin.norm_squared();
            let pole = body.center + axis;
            let wanted = pole + UnitQuaternion::from_scaled_axis(rate.spin * s) * (p - pole);
            assert!((there - wanted).norm() < 1e-5 * view.size(), "{}: {there} {wanted}", body.id);
            farthest = farthest.max((rate.velocity + rate.spin.cross(&arm)).norm() * s);
        }
    }
    assert!((farthest / way - 1.0).abs() < 1e-9, "{farthest} {way}");
}

/// The container holds the same, cut into words, with its lengths.
#[test]
fn the_container_holds_the_same() {
    let (_, view) = assessed(&ball_on_box());
    let (file, glb) = (Model::read(&view), gltf::binary(&view).unwrap());
    let word = |k: usize| u32::from_le_bytes(glb[k..k + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let (length, kind) = (word(12), &glb[16..20]);
    assert_eq!((kind, length % 4), (&b"JSON"[..], 0));
    let json: Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    assert_eq!(json["buffers"][0].get("uri"), None);
    assert_eq!(json["nodes"], file.json["nodes"]);
    let rest = 20 + length;
    assert_eq!((&glb[rest + 4..rest + 8], word(rest)), (&b"BIN\0"[..], glb.len() - rest - 8));
    assert_eq!(&glb[rest + 8..rest + 8 + file.bytes.len()], &file.bytes[..]);
    // A ball is one of radius 1, scaled.
    let ball = file.list("nodes").iter().find(|n| n["name"] == "ball").unwrap();
    assert_eq!(ball["scale"], json!([0.4, 0.4, 0.4]));
    let share = volume(&file.triangles(ball)) / (4.0 / 3.0 * std::f64::consts::PI);
    assert!(share > 0.95 && share < 1.0, "{share}");
}

/// Names are data: they neither end a string nor a line.
#[test]
fn names_stay_names() {
    let (_, mut view) = assessed(&ball_on_box());
    view.bodies[1].id = "a \"b\"\nv 1 2 3".into();
    let file = Model::read(&view);
    assert_eq!(file.list("nodes")[2]["name"], "a \"b\"\nv 1 2 3");
    let text = obj(&view);
    assert_eq!(text.lines().filter(|l| l.starts_with("v 1 2 3")).count(), 0);
    assert_eq!(text.lines().filter(|l| l.starts_with("o ")).count(), view.bodies.len());
}

/// The number after these words.
fn words(text: &str, before: &str) -> f64 {
    text.split(before).nth(1).unwrap().split(',').next().unwrap().parse().unwrap()
}

/// The objects of an OBJ file have the volumes of the blocks, for blocks move without being
/// deformed; its head says by how much, and supports can be left out.
#[test]
fn objects_are_the_blocks_where_they_go() {
    let (model, mut view) = limited(&arch(0.2, 3.0, json!({})));
    let text = obj(&view);
    assert!(text.lines().nth(1).unwrap().contains("fastest corner goes"), "{text}");
    let mut points: Vec<Vector3<f64>> = Vec::new();
    let mut sums: Vec<(String, f64)> = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[0] {
            "o" => sums.push((words[1].into(), 0.0)),
            "v" => {
                points.push(Vector3::from_iterator(words[1..4].iter().map(|w| w.parse().unwrap())))
            }
            "f" => {
                let loop_: Vec<Vector3<f64>> =
                    words[1..].iter().map(|w| points[w.parse::<usize>().unwrap() - 1]).collect();
                for k in 2..loop_.len() {
                    sums.last_mut().unwrap().1 += volume(&[[loop_[0], loop_[k - 1], loop_[k]]]);
                }
            }
            _ => {}
        }
    }
    for ((name, volume), block) in sums.iter().zip(&model.assembly.blocks) {
        assert_eq!(name, &block.id);
        assert!((volume / block.solid.volume() - 1.0).abs() < 1e-9, "{name}: {volume}");
    }
    let corners = view.bodies.iter().flat_map(|b| match &b.shape {
        ViewShape::Surface(surface) => surface.corners.clone(),
        ViewShape::Sphere(_) => panic!("{}", b.id),
    });
    let farthest = points.iter().zip(corners).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
    // Straight on it would be this; blocks that turn go along an arc, and come a little less far.
    let way = view.motions[0].reach * words(&text, "rates times ");
    assert!(farthest <= way * 1.001 && farthest > 0.9 * way, "{farthest} {way}");
    view.hides_supports = true;
    let free = model.assembly.free().count();
    assert_eq!(obj(&view).lines().filter(|l| l.starts_with("o ")).count(), free);
    assert_eq!(Model::read(&view).list("nodes").len(), 1 + free + 1);
}
