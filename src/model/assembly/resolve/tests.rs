//! What a scene resolves to, what is refused with which words and where, and what is said without
//! being refused.

use crate::assembly::{Assembly, Solid, Wrench, resolve};
use base::error::FindingCode;
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use scene::{BlockSpec, Friction, Rotation, Scene, Shape, read_str};

/// Two stacked unit boxes `base` (support) and `top`, with `rest` as further lines. Line 4 holds
/// `top`.
fn text(top: &str, rest: &str) -> String {
    let rest = if rest.contains("\"joints\"") {
        rest.to_owned()
    } else {
        format!("{rest}\"joints\": {{ \"default\": {{ \"friction\": 0.5 }} }}")
    };
    format!(
        "{{ \"format\": \"voussoir-scene/1\",\n\"blocks\": [\n{{ \"id\": \"base\", \"shape\": {{ \"box\": {{ \"size\": [1, 1, 1] }} }}, \"support\": true }},\n{top}\n],\n{rest}\n}}"
    )
}

const TOP: &str = r#"{ "id": "top", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 1] }"#;

fn assembly(text: &str) -> Assembly {
    let (scene, source) = read_str("s.json", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    resolve(&scene).unwrap_or_else(|e| panic!("{}\n{text}", source.located(e)))
}

fn error(text: &str) -> String {
    let (scene, source) = read_str("s.json", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match resolve(&scene) {
        Ok(_) => "accepted".into(),
        Err(e) => source.located(e).to_string(),
    }
}

fn codes(assembly: &Assembly) -> Vec<FindingCode> {
    assembly.findings.iter().map(|f| f.code).collect()
}

#[test]
fn a_plane_lies_where_it_is_said_and_reaches_beyond_every_block() {
    for (normal, turn) in
        [([0.0, 0.0, 2.0], 0.0), ([0.0, 1.0, 0.0], 90.0), ([0.0, 0.0, -1.0], 180.0)]
    {
        let ground = format!(
            r#"{{ "id": "ground", "shape": {{ "plane": {{ "normal": {normal:?} }} }}, "at": [1, 2, 3], "rotation_deg": {{ "axis": [1, 0, 0], "angle": {turn} }}, "support": true }},"#
        );
        let far = r#"{ "id": "far", "shape": { "sphere": { "radius": 1 } }, "at": [500, -40, 4] }"#;
        let text = text(&format!("{ground}{TOP},{far}"), "");
        let assembly = assembly(&text);
        assert_eq!(assembly.blocks[1].id, "ground", "in its place among the blocks");
        let (low, high) = assembly.blocks[1].solid.extent();
        assert!((high.z - 3.0).abs() < 1e-9 && low.z < 2.0, "normal {normal:?}: {low} {high}");
        assert!(low.x < -500.0 && high.x > 1000.0 && low.y < -500.0 && high.y > 500.0);
    }
}

#[test]
fn blocks_that_mean_nothing_are_refused_with_place_and_remedy() {
    let cases = [
        (
            r#"{ "id": "top", "shape": { "box": { "size": [1, 0, 1] } } }"#,
            "s.json:4:48: blocks[1].shape.box.size[1]: must be > 0, got 0; hint: full lengths along x, y, z in m",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": -1 } } }"#,
            "s.json:4:49: blocks[1].shape.sphere.radius: must be > 0, got -1; hint: m",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "density": -2400 }"#,
            "s.json:4:67: blocks[1].density: must be > 0, got -2400; hint: kg/m³",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "density": 0 }"#,
            "s.json:4:67: blocks[1].density: must be > 0, got 0; hint: kg/m³",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "mass": 0 }"#,
            "s.json:4:64: blocks[1].mass: must be > 0, got 0; hint: kg",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "mass": 1, "density": 1 }"#,
            "s.json:4:64: blocks[1].mass: density and mass are both given; hint: keep one of them",
        ),
        (
            r#"{ "id": "base", "shape": { "sphere": { "radius": 1 } } }"#,
            "s.json:4:9: blocks[1].id: the id \"base\" is already that of blocks[0]; hint: every block needs a name of its own",
        ),
        (
            r#"{ "id": " ", "shape": { "sphere": { "radius": 1 } } }"#,
            "s.json:4:9: blocks[1].id: the id is empty; hint: every block needs a name of its own",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "material": "stone" }"#,
            "s.json:4:68: blocks[1].material: no material is called \"stone\"; hint: add \"materials\": { \"stone\": { \"density\": … } }",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "rotation_deg": { "axis": [0, 0, 0], "angle": 3 } }"#,
            "s.json:4:82: blocks[1].rotation_deg.axis: must not be zero; hint: a direction, of any length",
        ),
        (
            r#"{ "id": "top", "shape": { "sphere": { "radius": 1e200 } } }"#,
            "s.json:4:25: blocks[1].shape: the block is too small or too large to compute: volume inf m³, mass inf kg; hint: lengths are in m",
        ),
        (
            r#"{ "id": "top", "shape": { "polyhedron": { "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[1,2,3],[2,0,4]] } } }"#,
            "s.json:4:129: blocks[1].shape.polyhedron.faces[3][2]: vertex 4 does not exist: the shape has 4 vertices; hint: vertices are counted from 0",
        ),
        (
            r#"{ "id": "top", "shape": { "polyhedron": { "vertices": [[0,0,0],[1,0,0]], "faces": [[0,1]] } } }"#,
            "s.json:4:84: blocks[1].shape.polyhedron.faces[0]: a face needs at least 3 vertices, got 2",
        ),
        (
            r#"{ "id": "top", "shape": { "plane": {} } }"#,
            "s.json:4:36: blocks[1].shape.plane: a plane cannot be a free block; hint: add \"support\": true, or give the block a \"box\"",
        ),
        (
            r#"{ "id": "top", "shape": { "plane": { "normal": [0, 0, 0] } }, "support": true }"#,
            "s.json:4:48: blocks[1].shape.plane.normal: must not be zero; hint: a direction, of any length",
        ),
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[1,0]], "depth": 1 } } }"#,
            "s.json:4:49: blocks[1].shape.prism.polygon: a polygon needs at least 3 corners, got 2",
        ),
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[1,0],[1,1]], "depth": 0 } } }"#,
            "s.json:4:79: blocks[1].shape.prism.depth: must be > 0, got 0; hint: length along y in m",
        ),
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[1,0],[1,1],[0,0]], "depth": 1 } } }"#,
            "s.json:4:68: blocks[1].shape.prism.polygon[3]: the corner repeats corner 0; hint: leave the last corner out: the polygon closes by itself",
        ),
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[1,1],[1,0],[0,1]], "depth": 1 } } }"#,
            "s.json:4:49: blocks[1].shape.prism.polygon: the polygon meets itself: edge 0 and edge 2 touch or cross; hint: give the corners in order around the outline; edge i runs from corner i to the next",
        ),
        // A spike that folds back, and a corner that touches an edge from inside.
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[2,0],[1,0],[0,1]], "depth": 1 } } }"#,
            "s.json:4:49: blocks[1].shape.prism.polygon: the polygon meets itself: edge 0 and edge 2 touch or cross; hint: give the corners in order around the outline; edge i runs from corner i to the next",
        ),
        (
            r#"{ "id": "top", "shape": { "prism": { "polygon": [[0,0],[2,0],[2,2],[1,0],[0,2]], "depth": 1 } } }"#,
            "s.json:4:49: blocks[1].shape.prism.polygon: the polygon meets itself: edge 0 and edge 3 touch or cross; hint: give the corners in order around the outline; edge i runs from corner i to the next",
        ),
        (
            r#"{ "id": "top", "shape": { "box": { "size": [1, 1, 1] } }, "support": true }"#,
            "s.json:2:11: blocks: all of the 2 blocks are supports; hint: leave \"support\" out on the blocks that may move",
        ),
    ];
    for (top, expected) in cases {
        assert_eq!(error(&text(top, "")), expected, "for {top}");
    }
    let open = error(&text(
        r#"{ "id": "top", "shape": { "polyhedron": { "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[1,2,3],[0,1,2]] } } }"#,
        "",
    ));
    assert!(
        open.starts_with("s.json:4:41: blocks[1].shape.polyhedron: ") && open.contains("hint: "),
        "{open}"
    );
}

#[test]
fn scenes_that_mean_nothing_are_refused_with_place_and_remedy() {
    let cases = [
        (
            r#""gravity": [0, 0, 0],"#,
            "s.json:6:12: gravity: gravity is zero: nothing presses the blocks together, so there is nothing to decide; hint: leave the key out for 9.81 m/s² downward",
        ),
        (
            r#""gravity": [1e300, 1e300, 0],"#,
            "s.json:6:12: gravity: gravity is too large to compute; hint: m/s²",
        ),
        (
            r#""materials": { "stone": { "density": 0 } },"#,
            "s.json:6:38: materials.stone.density: must be > 0, got 0; hint: kg/m³",
        ),
        (
            r#""joints": { "default": {} }"#,
            "s.json:6:24: joints.default: no friction is given; hint: add \"joints\": { \"default\": { \"friction\": 0.7 } }, with the coefficient of your joints or \"infinite\"",
        ),
        (
            r#""joints": { "default": { "friction": -0.5 } }"#,
            "s.json:6:38: joints.default.friction: must be a finite number >= 0, got -0.5; hint: write \"infinite\" for no sliding",
        ),
        (
            r#""joints": { "default": { "friction_angle_deg": 90 } }"#,
            "s.json:6:48: joints.default.friction_angle_deg: must be >= 0 and < 90 degrees, got 90; hint: write \"friction\": \"infinite\" for no sliding",
        ),
        (
            r#""joints": { "default": { "friction": 0.5, "friction_angle_deg": 30 } }"#,
            "s.json:6:65: joints.default.friction_angle_deg: friction and friction_angle_deg are both given; hint: keep one of them",
        ),
        (
            r#""joints": { "default": { "friction": 1 }, "overrides": [{ "friction": 0.5 }] }"#,
            "s.json:6:57: joints.overrides[0]: the override names no joints; hint: add \"between\": [material, material] or \"blocks\": [id, id]",
        ),
        (
            r#""joints": { "default": { "friction": 1 }, "overrides": [{ "blocks": ["base", "top"] }] }"#,
            "s.json:6:57: joints.overrides[0]: the override sets no property; hint: add \"friction\"",
        ),
        (
            r#""joints": { "default": { "friction": 1 }, "overrides": [{ "blocks": ["base", "topp"], "friction": 1 }] }"#,
            "s.json:6:78: joints.overrides[0].blocks[1]: no block is called \"topp\"; hint: did you mean \"top\"?",
        ),
        (
            r#""joints": { "default": { "friction": 1 }, "overrides": [{ "blocks": ["top", "top"], "friction": 1 }] }"#,
            "s.json:6:69: joints.overrides[0].blocks: names the block \"top\" twice; hint: a joint lies between two blocks",
        ),
        (
            r#""materials": { "stone": { "density": 1 } }, "joints": { "default": { "friction": 1 }, "overrides": [{ "between": ["stone", "stoen"], "friction": 1 }] }"#,
            "s.json:6:124: joints.overrides[0].between[1]: no material is called \"stoen\"; hint: did you mean \"stone\"?",
        ),
        (
            r#""joints": { "default": { "friction": 1 }, "overrides": [{ "between": ["a", "a"], "blocks": ["top", "base"], "friction": 1 }] }"#,
            "s.json:6:57: joints.overrides[0]: both \"between\" and \"blocks\" are given; hint: make two overrides: \"between\" names materials, \"blocks\" names blocks",
        ),
        (
            r#""contact": { "gap": 0.5 },"#,
            "s.json:6:21: contact.gap: must be > 0 and < 0.5, got 0.5; hint: a fraction of the size of the smaller block; the default is 1e-4",
        ),
        (
            r#""contact": { "angle_deg": 0 },"#,
            "s.json:6:27: contact.angle_deg: must be > 0 and < 45, got 0; hint: degrees; the default is 1",
        ),
        (
            r#""contact": { "min_area": -1 },"#,
            "s.json:6:26: contact.min_area: must be >= 0 and < 1, got -1; hint: a fraction of the smaller block's size squared; the default is 1e-9",
        ),
        // loads
        (
            r#""loads": { "live": [{ "force": [1, 0, 0] }] },"#,
            "s.json:6:21: loads.live[0]: the force or moment has no block to act on; hint: add \"block\": id",
        ),
        (
            r#""loads": { "live": [{ "block": "tip", "force": [1, 0, 0] }] },"#,
            "s.json:6:32: loads.live[0].block: no block is called \"tip\"; hint: did you mean \"top\"?",
        ),
        (
            r#""loads": { "dead": [{ "block": "base", "force": [1, 0, 0] }] },"#,
            "s.json:6:32: loads.dead[0].block: \"base\" is a support: a load on it changes nothing; hint: remove the load",
        ),
        (
            r#""loads": { "live": [{ "block": "top" }] },"#,
            "s.json:6:21: loads.live[0]: the load has no value; hint: add \"force\", \"moment\", \"acceleration\" or \"weight\"",
        ),
        (
            r#""loads": { "live": [{ "weight": [0, 0, 0] }] },"#,
            "s.json:6:21: loads.live[0]: the load is zero: it has no effect; hint: remove it",
        ),
        (
            r#""loads": { "live": [{ "weight": [1, 0, 0], "acceleration": [1, 0, 0] }] },"#,
            "s.json:6:21: loads.live[0]: one load mixes force or moment, acceleration, and weight; hint: make a load of each",
        ),
        (
            r#""loads": { "live": [{ "block": "top", "moment": [1, 0, 0], "at": [0, 0, 0] }] },"#,
            "s.json:6:66: loads.live[0].at: only a force can act at a point; hint: remove \"at\"",
        ),
        (
            r#""loads": { "live": [{ "block": "top", "force": [1e308, 0, 0], "at": [0, 0, 1e9], "arm": true }] },"#,
            "s.json:6:10: loads: the load on block \"top\" is too large to compute; hint: forces are in N, lengths in m, masses in kg",
        ),
        // given interfaces
        (
            r#""interfaces": [{ "between": ["base", "tap"], "points": [[0,0,0.5]] }],"#,
            "s.json:6:38: interfaces[0].between[1]: no block is called \"tap\"; hint: did you mean \"top\"?",
        ),
        (
            r#""interfaces": [{ "between": ["base", "base"], "points": [[0,0,0.5]] }],"#,
            "s.json:6:29: interfaces[0].between: names the block \"base\" twice; hint: a joint lies between two blocks",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [] }],"#,
            "s.json:6:16: interfaces[0]: an interface needs at least one point, or a normal; hint: \"normal\" alone names the direction across which edges or corners of the two meet",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5]] }],"#,
            "s.json:6:16: interfaces[0]: the normal is missing: one point does not define a normal; hint: add \"normal\": [x, y, z], from the first block into the second",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5],[0.5,0,0.5]] }],"#,
            "s.json:6:16: interfaces[0]: the normal is missing: points on one line do not define a normal; hint: add \"normal\": [x, y, z], from the first block into the second",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5]], "normal": [0,0,0] }],"#,
            "s.json:6:79: interfaces[0].normal: must not be zero; hint: a direction, of any length",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5],[0,1,0.5]], "normal": [0,1,1] }],"#,
            "s.json:6:99: interfaces[0].normal: the normal is not at right angles to the plane of the points: 45.000° off; hint: correct it; where three or more points span a plane it may be left out",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5]], "normal": [1,0,0] }],"#,
            "s.json:6:89: interfaces[0].normal: the normal is not at right angles to the edge: 90.000° off; hint: correct it; where three or more points span a plane it may be left out",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5],[0,0,0.8]] }],"#,
            "s.json:6:16: interfaces[0]: the normal is missing: the centres of the two blocks do not show which side is which; hint: add \"normal\": [x, y, z], from the first block into the second",
        ),
        (
            r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5]], "normal": [0,0,1], "friction": -1 }],"#,
            "s.json:6:110: interfaces[0].friction: must be a finite number >= 0, got -1; hint: write \"infinite\" for no sliding",
        ),
        // templates
        (
            r#""templates": [{ "column": { "blocks": 0, "size": [1, 1, 1] } }], "loads": { "live": [{ "block": "nobody", "force": [1, 0, 0] }] },"#,
            "",
        ),
    ];
    for (rest, expected) in cases {
        let error = error(&text(TOP, rest));
        if expected.is_empty() {
            assert!(error.starts_with("s.json:6:"), "for {rest}: {error}");
        } else {
            assert_eq!(error, expected, "for {rest}");
        }
    }
    let warped = error(&text(
        TOP,
        r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,0.5],[1,0,0.5],[1,1,0.6],[0,1,0.5]] }],"#,
    ));
    assert!(
        warped.starts_with("s.json:6:56: interfaces[0].points: the points are not in one plane: they lie up to 2.494e-2 m off it"),
        "{warped}"
    );
}

#[test]
fn scenes_without_blocks_or_supports_are_refused() {
    let head = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 1 } }"#;
    assert_eq!(
        error(&format!("{head} }}")),
        "s.json:1:1: the scene has no blocks; hint: give \"blocks\" or \"templates\""
    );
    let free = error(&format!("{head}, \"blocks\": [{TOP}] }}"));
    assert!(
        free.contains("blocks: none of the 1 blocks is a support; hint: set \"support\": true"),
        "{free}"
    );
    let supports = r#"{ "id": "top", "shape": { "sphere": { "radius": 1 } }, "support": true }, { "id": "free", "shape": { "sphere": { "radius": 1 } } }"#;
    let both = error(&text(
        supports,
        r#""interfaces": [{ "between": ["base", "top"], "points": [[0,0,1]], "normal": [0,0,1] }],"#,
    ));
    assert!(both.contains("interfaces[0].between: \"base\" and \"top\" are both supports: nothing moves between them"), "{both}");
}

#[test]
fn numbers_that_no_file_can_hold_are_refused() {
    let good = || {
        let mut scene =
            read_str("s", text(TOP, r#""loads": { "live": [{ "block": "top", "force": [1, 0, 0], "at": [0, 0, 1] }] },"#)).unwrap().0;
        scene.blocks[1].rotation_deg = Some(Rotation { axis: [0.0, 0.0, 1.0], angle: 30.0 });
        scene
    };
    assert!(resolve(&good()).is_ok());
    type Spoil = fn(&mut Scene, f64);
    let spoil: [(&str, Spoil); 10] = [
        ("gravity[2]", |s, x| s.gravity[2] = x),
        ("blocks[1].at[0]", |s, x| s.blocks[1].at[0] = x),
        ("blocks[1].rotation_deg.axis[1]", |s, x| {
            s.blocks[1].rotation_deg.as_mut().unwrap().axis[1] = x
        }),
        ("blocks[1].rotation_deg.angle", |s, x| {
            s.blocks[1].rotation_deg.as_mut().unwrap().angle = x
        }),
        ("blocks[1].shape.box.size[2]", |s, x| {
            s.blocks[1].shape = Shape::Cuboid { size: [1.0, 1.0, x] }
        }),
        ("blocks[1].shape.prism.polygon[1][0]", |s, x| {
            s.blocks[1].shape =
                Shape::Prism { polygon: vec![[0.0, 0.0], [x, 0.0], [1.0, 1.0]], depth: 1.0 }
        }),
        ("blocks[1].mass", |s, x| s.blocks[1].mass = Some(x)),
        ("blocks[1].centroid[0]", |s, x| s.blocks[1].centroid = Some([x, 0.0, 0.0])),
        ("joints.default.friction", |s, x| {
            s.joints.default.friction = Some(Friction::Coefficient(x))
        }),
        ("loads.live[0].force[1]", |s, x| s.loads.live[0].force = Some([0.0, x, 0.0])),
    ];
    for (path, spoil) in spoil {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut scene = good();
            spoil(&mut scene, x);
            assert_eq!(resolve(&scene).unwrap_err().path.to_string(), path);
        }
    }
}

#[test]
fn a_block_has_the_mass_of_its_density_material_or_own_word() {
    let materials = r#""materials": { "stone": { "density": 2000 } },"#;
    let mass = |keys: &str| {
        assembly(&text(&format!(r#"{{ "id": "top", "shape": {{ "box": {{ "size": [1, 2, 3] }} }}, "at": [1, 1, 1]{keys} }}"#), materials))
            .blocks[1]
            .clone()
    };
    assert!((mass("").mass - 6.0 * 2400.0).abs() < 1e-9);
    assert!((mass(r#", "material": "stone""#).mass - 12000.0).abs() < 1e-9);
    assert!((mass(r#", "material": "stone", "density": 10"#).mass - 60.0).abs() < 1e-12);
    let heavy = mass(
        r#", "material": "stone", "mass": 12, "centroid": [0.1, 0, 0], "rotation_deg": { "axis": [0, 0, 2], "angle": 90 }"#,
    );
    assert_eq!(heavy.mass, 12.0);
    assert!((heavy.centroid - Vector3::new(1.0, 1.1, 1.0)).norm() < 1e-14);
    // m/12 (b² + c²) for sides 1, 2, 3, turned by 90° about z.
    let expected = Matrix3::from_diagonal(&Vector3::new(10.0, 13.0, 5.0));
    assert!((heavy.inertia - expected).norm() < 1e-13, "{}", heavy.inertia);
    assert!((heavy.size - 14f64.sqrt()).abs() < 1e-14);
}

#[test]
fn spheres_and_prisms_have_their_exact_mass_properties() {
    let sphere = assembly(&text(
        r#"{ "id": "top", "shape": { "sphere": { "radius": 2 } }, "at": [0, 0, 3], "mass": 5 }"#,
        "",
    ))
    .blocks[1]
        .clone();
    assert!((sphere.inertia - Matrix3::identity() * 8.0).norm() < 1e-14);
    assert!(
        matches!(sphere.solid, Solid::Sphere { center, radius: 2.0 } if center == Vector3::new(0.0, 0.0, 3.0))
    );

    // An L, either way round: area 3, centroid (5/6, 5/6).
    for polygon in
        ["[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2]]", "[[0,2],[1,2],[1,1],[2,1],[2,0],[0,0]]"]
    {
        let prism = format!(
            r#"{{ "id": "top", "shape": {{ "prism": {{ "polygon": {polygon}, "depth": 4 }} }}, "density": 1 }}"#
        );
        let assembly = assembly(&text(&prism, ""));
        assert!((assembly.blocks[1].mass - 12.0).abs() < 1e-13);
        assert!(
            (assembly.blocks[1].centroid - Vector3::new(5.0 / 6.0, 0.0, 5.0 / 6.0)).norm() < 1e-14
        );
        assert!(
            !codes(&assembly).contains(&FindingCode::Mended),
            "the faces of a prism face outward: {:?}",
            assembly.findings
        );
        let Solid::Polyhedron(p) = &assembly.blocks[1].solid else {
            panic!("a prism is a polyhedron")
        };
        assert!(!p.convex && p.facets.len() == 8);
    }
    assert!(codes(&assembly(&text(TOP, ""))).is_empty(), "the faces of a box face outward");
}

#[test]
fn what_was_mended_is_said_once() {
    let inverted = |id: &str| {
        format!(
            r#"{{ "id": "{id}", "shape": {{ "polyhedron": {{ "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,1,2],[0,3,1],[1,3,2],[2,3,0]] }} }} }}"#
        )
    };
    let all = [inverted("a"), inverted("b"), inverted("c")].join(",");
    let assembly = assembly(&text(&all, ""));
    assert_eq!(codes(&assembly), [FindingCode::Mended]);
    assert!(
        assembly.findings[0]
            .text
            .starts_with("Block \"a\" (and 2 more): all 4 faces pointed inward"),
        "{}",
        assembly.findings[0].text
    );
    assert!((assembly.blocks[1].mass - 400.0).abs() < 1e-10);
}

#[test]
fn loads_add_up_about_the_centre_of_mass() {
    let loads = r#""gravity": [0, 0, -10], "loads": {
        "dead": [{ "block": "top", "force": [0, 0, -7], "at": [0.5, 0, 2] }, { "block": "top", "moment": [0, 0, 3] }],
        "live": [{ "weight": [1, 0, 0] }, { "acceleration": [0, 2, 0] }, { "block": "top", "weight": [0, 0, 0.5] }, { "block": "top", "force": [1, 0, 0], "at": "centroid" }] },"#;
    let top =
        r#"{ "id": "top", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 1], "mass": 3 }"#;
    let assembly = assembly(&text(top, loads));
    assert_eq!(assembly.weight(1), 30.0);
    assert_eq!(
        assembly.self_weight(1),
        Wrench { force: Vector3::new(0.0, 0.0, -30.0), moment: Vector3::zeros() }
    );
    let close = |w: Wrench, force: [f64; 3], moment: [f64; 3]| {
        (w.force - Vector3::from(force)).norm() + (w.moment - Vector3::from(moment)).norm() < 1e-12
    };
    // r × F = (0.5, 0, 1) × (0, 0, -7) = (0, 3.5, 0)
    assert!(close(assembly.dead[1], [0.0, 0.0, -37.0], [0.0, 3.5, 3.0]), "{:?}", assembly.dead[1]);
    assert!(close(assembly.live[1], [31.0, 6.0, 15.0], [0.0; 3]), "{:?}", assembly.live[1]);
    assert_eq!((assembly.dead[0], assembly.live[0]), (Wrench::zero(), Wrench::zero()));
}

#[test]
fn of_the_joint_rules_the_most_special_one_holds() {
    let top = r#"{ "id": "x", "shape": { "box": { "size": [1, 1, 1] } }, "material": "steel" }, { "id": "y", "shape": { "box": { "size": [1, 1, 1] } }, "material": "stone" }"#;
    let rules = r#""materials": { "stone": { "density": 2400 }, "steel": { "density": 7850 } }, "joints": { "default": { "friction_angle_deg": 45 }, "overrides": [
        { "blocks": ["y", "x"], "friction": "infinite" }, { "between": ["steel", "stone"], "friction": 0.1 }, { "between": ["steel", "stone"], "friction": 0.2 }, { "between": ["steel", "steel"], "friction": 0.3 }] }"#;
    let a = assembly(&text(top, rules));
    let mu = |a: &Assembly, i, j| a.joints.law(i, j, &a.blocks).map(|l| l.friction.mu());
    assert!((mu(&a, 0, 1).unwrap() - 1.0).abs() < 1e-15, "no material: the default");
    assert_eq!((mu(&a, 1, 2), mu(&a, 2, 1)), (Some(f64::INFINITY), Some(f64::INFINITY)));
    let by_material = assembly(&text(
        top,
        &rules.replace(r#"{ "blocks": ["y", "x"], "friction": "infinite" }, "#, ""),
    ));
    assert_eq!(
        (mu(&by_material, 1, 2), mu(&by_material, 2, 1)),
        (Some(0.2), Some(0.2)),
        "the last rule for the materials"
    );
}

fn interface(rest: &str) -> Assembly {
    assembly(&text(TOP, &format!(r#""interfaces": [{{ "between": ["base", "top"], {rest} }}],"#)))
}

#[test]
fn given_interfaces_come_out_in_order_around_their_normal() {
    let turns = |a: &Assembly| {
        let g = &a.given[0];
        let area: Vector3<f64> =
            g.points.windows(2).map(|w| (w[0] - g.points[0]).cross(&(w[1] - g.points[0]))).sum();
        area.dot(&g.normal) / 2.0
    };
    for (points, said) in [
        ("[[0,0,0.5],[0.4,0,0.5],[0.4,0.4,0.5],[0,0.4,0.5]]", vec![]),
        ("[[0,0.4,0.5],[0.4,0.4,0.5],[0.4,0,0.5],[0,0,0.5]]", vec![]),
        ("[[0,0,0.5],[0.4,0.4,0.5],[0.4,0,0.5],[0,0.4,0.5]]", vec![FindingCode::Mended]),
        (
            "[[0,0,0.5],[0.4,0,0.5],[0.4,0.4,0.5],[0.1,0.1,0.5],[0,0.4,0.5],[0,0,0.5]]",
            vec![FindingCode::Mended, FindingCode::Mended],
        ),
        ("[[0,0,0.5],[0.4,0,0.50004],[0.4,0.4,0.5],[0,0.4,0.50004]]", vec![FindingCode::Warped]),
        ("[[0,0,500],[400,0,500],[400,400,500],[0,400,500]]", vec![FindingCode::Units]),
    ] {
        for normal in ["", r#", "normal": [0, 0, 3]"#] {
            let a = interface(&format!(r#""points": {points}{normal}"#));
            assert_eq!(codes(&a), said, "{points}: {:?}", a.findings);
            assert!((a.given[0].normal - Vector3::z()).norm() < 1e-12);
            assert_eq!(a.given[0].points.len(), 4);
            assert!(turns(&a) > 0.159, "{points}");
            assert_eq!(a.given[0].law.friction, Friction::Coefficient(0.5));
        }
        let against = interface(&format!(
            r#""points": {points}, "normal": [0, 0, -1], "friction": "infinite""#
        ));
        assert!(codes(&against).contains(&FindingCode::Orientation));
        assert!((against.given[0].normal + Vector3::z()).norm() < 1e-12 && turns(&against) > 0.159);
        assert_eq!(against.given[0].law.friction, Friction::Infinite);
    }
}

#[test]
fn edges_and_points_may_be_given() {
    let edge = interface(r#""points": [[0,0,0.5],[0.2,0,0.5],[0.4,0,0.5]], "normal": [0.001,0,1]"#);
    assert_eq!(edge.given[0].points, [Vector3::new(0.4, 0.0, 0.5), Vector3::new(0.0, 0.0, 0.5)]);
    assert!(
        (edge.given[0].normal - Vector3::z()).norm() < 1e-12,
        "turned at right angles to the edge"
    );
    let point = interface(r#""points": [[0,0,0.5]], "normal": [0,3,4]"#);
    assert!((point.given[0].normal - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
}

#[test]
fn friction_may_come_from_the_interfaces_alone() {
    let rest = |friction| {
        format!(
            r#""joints": {{}}, "interfaces": [{{ "between": ["base", "top"], "points": [[0,0,0.5]], "normal": [0,0,1]{friction} }}]"#
        )
    };
    let a = assembly(&text(TOP, &rest(r#", "friction": 0.3"#)));
    assert_eq!(
        (a.given[0].law.friction, a.joints.law(0, 1, &a.blocks)),
        (Friction::Coefficient(0.3), None)
    );
    assert!(error(&text(TOP, &rest(""))).contains("joints.default: no friction is given"));
}

#[test]
fn an_assumed_density_is_said_only_where_it_matters() {
    let second = |keys: &str| {
        format!(r#"{TOP}, {{ "id": "more", "shape": {{ "box": {{ "size": [1, 1, 1] }} }}{keys} }}"#)
    };
    assert_eq!(codes(&assembly(&text(&second(""), ""))), []);
    assert_eq!(
        codes(&assembly(&text(&second(""), r#""loads": { "live": [{ "weight": [1, 0, 0] }] },"#))),
        []
    );
    assert_eq!(codes(&assembly(&text(&second(", \"density\": 1000"), ""))), [FindingCode::Assumed]);
    assert_eq!(codes(&assembly(&text(&second(", \"density\": 2400"), ""))), [], "the same density");
    let loaded =
        assembly(&text(TOP, r#""loads": { "live": [{ "block": "top", "force": [1, 0, 0] }] },"#));
    assert_eq!(
        loaded.findings[0].text,
        "Block \"top\" has no density, mass or material: 2400 kg/m³ was assumed; this matters because there are loads besides the weight."
    );
}

#[test]
fn slips_of_units_are_findings_with_numbers() {
    let units = |top: &str, rest: &str| {
        let findings = assembly(&text(top, rest)).findings;
        findings
            .into_iter()
            .filter(|f| f.code == FindingCode::Units)
            .map(|f| f.text)
            .collect::<Vec<_>>()
    };
    let top = |keys: &str| {
        format!(r#"{{ "id": "top", "shape": {{ "box": {{ "size": [1, 1, 1] }} }}{keys} }}"#)
    };
    assert!(
        units(&top(", \"density\": 1"), "\"gravity\": [0, 0, -1],").is_empty(),
        "unit problems are no mistakes"
    );
    assert!(units(&top(", \"density\": 11340"), "").is_empty(), "lead");
    assert!(
        units(&top(", \"density\": 22600"), "")[0].contains("N/m³"),
        "the weight of concrete, not osmium"
    );
    let grams = &units(&top(", \"density\": 0.0024"), "")[0];
    assert!(
        grams.contains("has a density of 0.0024 kg/m³") && grams.ends_with("write 2400"),
        "{grams}"
    );
    assert!(units(&top(", \"density\": 2.4e6"), "")[0].contains("2.4e6"));
    assert!(
        units(&top(", \"density\": 0.2"), "")[0]
            .contains("has a density of 2.000e-1 kg/m³; stone has about 2400")
    );
    assert!(
        units(&top(", \"density\": 24"), "\"gravity\": [0, 0, -1],").is_empty(),
        "weights per volume where gravity is 1"
    );
    // One unit for all, or the others real: a lot that was drawn has neither.
    let two = |a: f64, b: f64| {
        let block = |id: &str, d: f64| {
            format!(
                r#"{{ "id": "{id}", "shape": {{ "box": {{ "size": [1, 1, 1] }} }}, "density": {d} }}"#
            )
        };
        units(&format!("{}, {}", block("one", a), block("two", b)), "")
    };
    assert!(two(24.0, 2400.0)[0].contains("kN/m³") && two(24.0, 19.0)[0].contains("(and 1 more)"));
    assert!(two(24.0, 70.0).is_empty() && two(1.0, 24.0).is_empty());
    assert!(units(TOP, "\"gravity\": [0, 0, -9810],")[0].contains("Gravity is 9.810e3 m/s²"));
    let box_of = |size: f64| {
        format!(
            r#"{{ "id": "top", "shape": {{ "box": {{ "size": [{size}, {size}, {size}] }} }} }}, {}"#,
            TOP.replace("top", "other")
        )
    };
    assert!(units(&box_of(100.0), "").is_empty() && units(&box_of(1e-3), "").is_empty());
    assert!(
        units(&box_of(1e6), "").iter().any(|t| t.contains("the median of all blocks 1.732e0 m")),
        "{:?}",
        units(&box_of(1e6), "")
    );
    assert!(
        units(&box_of(1e-6), "")
            .iter()
            .any(|t| t.starts_with("Block \"top\" measures 1.732e-6 m across, the median"))
    );
}

#[test]
fn templates_follow_the_blocks_and_their_errors_name_them() {
    let column = r#""templates": [{ "column": { "blocks": 3, "size": [1, 1, 0.5] } }],"#;
    // Templates may have a "base" of their own.
    let text = |rest: &str| text(TOP, rest).replace("\"base\"", "\"ground\"");
    let a = assembly(&text(column));
    assert!(a.blocks.len() >= 5 && a.blocks[0].path.to_string() == "blocks[0]");
    assert!(a.blocks[2..].iter().all(|b| b.path.to_string() == "templates[0]"));
    let twice = error(&text(
        &column.replace("}],", "}, { \"column\": { \"blocks\": 1, \"size\": [1, 1, 0.5] } }],"),
    ));
    assert!(
        twice.starts_with("s.json:6:67: templates[1]: the id ")
            && twice
                .ends_with("is already that of templates[0]; hint: give the template a \"prefix\""),
        "{twice}"
    );
}

proptest! {
    /// Turning and moving a block moves its centre of mass and turns its inertia: R I Rᵀ.
    #[test]
    fn mass_properties_move_with_the_block(
        size in [0.1f64..10.0, 0.1f64..10.0, 0.1f64..10.0],
        axis in [-1.0f64..1.0, -1.0f64..1.0, 0.1f64..1.0],
        angle in -720.0f64..720.0,
        at in [-100.0f64..100.0, -100.0f64..100.0, -100.0f64..100.0],
        centroid in prop::option::of([-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0]),
    ) {
        let mut scene: Scene = read_str("s", text(TOP, "")).unwrap().0;
        scene.blocks[1] = BlockSpec { centroid, density: Some(3.0), ..BlockSpec::new("top", Shape::Cuboid { size }) };
        let still = resolve(&scene).unwrap().blocks[1].clone();
        scene.blocks[1].at = at;
        scene.blocks[1].rotation_deg = Some(Rotation { axis, angle });
        let moved = resolve(&scene).unwrap().blocks[1].clone();
        let turn = Rotation3::new(Vector3::from(axis).normalize() * angle.to_radians());
        let scale = still.inertia.norm();
        prop_assert!((moved.mass - still.mass).abs() <= 1e-11 * still.mass);
        prop_assert!((moved.centroid - (turn * still.centroid + Vector3::from(at))).norm() <= 1e-11 * (1.0 + still.size));
        prop_assert!((moved.inertia - turn * still.inertia * turn.inverse()).norm() <= 1e-10 * scale);
        prop_assert!((moved.inertia - moved.inertia.transpose()).norm() <= 1e-15 * scale);
    }
}
