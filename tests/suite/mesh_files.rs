//! Meshes in files of their own: `{ "mesh": { "path": "stone.obj" } }`. They are blocks like
//! others, results need no file, and a path leads nowhere but to a mesh in the folder of the scene.

use serde_json::{Value, json};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

const FRUSTUM: &str = include_str!("../../structures/meshes/frustum.obj");

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.current_dir(folder).args(args).stdin(Stdio::null());
    command
}

/// Exit code, standard output, standard error; nothing may take long.
fn run(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let start = Instant::now();
    let output = command(folder, args).output().unwrap();
    assert!(start.elapsed() < Duration::from_secs(20), "{args:?} took {:?}", start.elapsed());
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn scene(shape: Value) -> Value {
    json!({
        "format": "voussoir-scene/1", "joints": { "default": { "friction": 2 } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "stone", "shape": shape, "rotation_deg": { "axis": [0, 0, 1], "angle": 45 }, "density": 2400 }
        ],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    })
}

fn mesh(path: &str) -> Value {
    scene(json!({ "mesh": { "path": path, "scale": 0.001 } }))
}

/// A folder with a scene in a folder of its own, and a file beside that folder.
struct Desk {
    root: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir_all(root.path().join("work/stones")).unwrap();
        fs::write(root.path().join("outside.obj"), FRUSTUM).unwrap();
        fs::write(root.path().join("work/stones/frustum.obj"), FRUSTUM).unwrap();
        Self { root }
    }

    fn work(&self) -> PathBuf {
        self.root.path().join("work")
    }

    fn put(&self, name: &str, value: &Value) {
        fs::write(self.work().join(name), value.to_string()).unwrap();
    }
}

fn load_factor(result: &str) -> f64 {
    serde_json::from_str::<Value>(result).unwrap()["answer"]["load_factor"]["value"]
        .as_f64()
        .unwrap()
}

#[test]
fn a_mesh_in_a_file_is_the_block_it_would_be_in_the_scene() {
    let desk = Desk::new();
    let corners: Vec<[f64; 3]> =
        FRUSTUM.lines().filter_map(|l| l.strip_prefix("v ")).map(numbers).collect();
    let faces: Vec<Vec<usize>> = FRUSTUM
        .lines()
        .filter_map(|l| l.strip_prefix("f "))
        .map(|l| l.split(' ').map(|w| w.parse::<usize>().unwrap() - 1).collect())
        .collect();
    let metres: Vec<[f64; 3]> = corners.iter().map(|c| c.map(|x| x * 0.001)).collect();
    desk.put("given.json", &scene(json!({ "polyhedron": { "vertices": metres, "faces": faces } })));
    desk.put("obj.json", &mesh("stones/frustum.obj"));
    // The same as PLY and STL.
    let list = |v: &[f64; 3]| format!("{} {} {}", v[0], v[1], v[2]);
    let mut ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        corners.len(),
        faces.len()
    );
    corners.iter().for_each(|c| ply.push_str(&format!("{}\n", list(c))));
    faces.iter().for_each(|f| ply.push_str(&format!("4 {} {} {} {}\n", f[0], f[1], f[2], f[3])));
    fs::write(desk.work().join("stones/frustum.ply"), ply).unwrap();
    let mut stl = "solid stone\n".to_string();
    for face in faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]) {
        let points: Vec<String> =
            face.iter().map(|&i| format!("vertex {}", list(&corners[i]))).collect();
        stl.push_str(
            &format!("facet normal 0 0 0 outer loop\n{}\nendloop\nendfacet\n", points.join("\n"))
                .replace("outer", "\nouter"),
        );
    }
    fs::write(desk.work().join("stones/frustum.stl"), stl + "endsolid\n").unwrap();
    desk.put("ply.json", &mesh("./stones/../stones/frustum.ply"));
    desk.put("stl.json", &mesh("stones/frustum.stl"));
    let exact = 0.5 * 2f64.sqrt() / (33.0 / 70.0);
    for name in ["given", "obj", "ply", "stl"] {
        let (code, out, err) = run(&desk.work(), &["limit", &format!("{name}.json"), "--json"]);
        assert_eq!((code, err.as_str()), (Some(0), ""), "{name}");
        assert!((load_factor(&out) / exact - 1.0).abs() < 1e-7, "{name}: {}", load_factor(&out));
        // From elsewhere the path still starts at the scene.
        let (code, again, _) =
            run(desk.root.path(), &["limit", &format!("work/{name}.json"), "--json"]);
        assert_eq!((code, load_factor(&again)), (Some(0), load_factor(&out)), "{name}");
    }
    // From standard input it starts where the program runs.
    let mut child = command(&desk.work(), &["limit", "-", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(mesh("stones/frustum.obj").to_string().as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    assert!((load_factor(&String::from_utf8(output.stdout).unwrap()) / exact - 1.0).abs() < 1e-7);
}

fn numbers(text: &str) -> [f64; 3] {
    let all: Vec<f64> = text.split(' ').map(|w| w.parse().unwrap()).collect();
    all.try_into().unwrap()
}

#[test]
fn a_result_with_a_mesh_needs_no_file() {
    let desk = Desk::new();
    desk.put("scene.json", &mesh("stones/frustum.obj"));
    let at = desk.work();
    assert_eq!(run(&at, &["limit", "scene.json", "--save", "result.json"]).0, Some(0));
    assert_eq!(run(&at, &["check", "result.json", "--scene", "scene.json"]).0, Some(0));
    fs::remove_dir_all(at.join("stones")).unwrap();
    let (code, out, err) = run(&at, &["check", "result.json"]);
    assert_eq!(code, Some(0), "{out}{err}");
    // The scene inside it is a scene, file or no file.
    let result: Value =
        serde_json::from_str(&fs::read_to_string(at.join("result.json")).unwrap()).unwrap();
    let inside = &result["scene"];
    assert_eq!(inside["blocks"][1]["shape"]["mesh"]["path"], "stones/frustum.obj");
    desk.put("inside.json", inside);
    let (code, out, _) = run(&at, &["limit", "inside.json", "--json"]);
    assert_eq!(
        (code, load_factor(&out)),
        (Some(0), result["answer"]["load_factor"]["value"].as_f64().unwrap())
    );
    // And a stone that was made larger by hand refutes the proof.
    let mut forged = result.clone();
    forged["scene"]["blocks"][1]["shape"]["mesh"]["scale"] = json!(0.002);
    desk.put("forged.json", &forged);
    assert_eq!(run(&at, &["check", "forged.json"]).0, Some(1));
}

#[test]
fn a_sweep_takes_its_meshes_along() {
    let desk = Desk::new();
    let at = desk.work();
    desk.put("scene.json", &mesh("stones/frustum.obj"));
    let plan = json!({ "format": "voussoir-sweep/1", "scene": "scene.json", "question": { "limit": { "law": "associative" } }, "seed": 1,
        "vary": [{ "pointer": "/blocks/1/shape/mesh/scale", "values": [0.001, 0.002, 0.003] }, { "pointer": "/joints/default/friction", "values": [0.5, 2] }],
        "sampling": { "grid": {} } });
    desk.put("plan.json", &plan);
    let sweep = ["sweep", "plan.json", "-o", "rows.jsonl", "--shard"];
    assert_eq!(run(&at, &[&sweep[..], &["1/2"]].concat()).0, Some(0));
    let rows = fs::read_to_string(at.join("rows.jsonl")).unwrap();
    assert_eq!(rows.lines().count(), 4, "{rows}");
    for line in rows.lines().skip(1) {
        let row: Value = serde_json::from_str(line).unwrap();
        assert!(row.get("error").is_none_or(Value::is_null), "{line}");
    }
    // The mesh is part of what was asked: another one is another sweep.
    fs::write(at.join("stones/frustum.obj"), FRUSTUM.replace("250", "260")).unwrap();
    let (code, _, err) = run(&at, &[&sweep[..], &["1/2"]].concat());
    assert_eq!(code, Some(2), "{err}");
}

#[test]
fn what_the_reader_says_of_a_mesh_is_said_and_what_it_refuses_is_refused() {
    let desk = Desk::new();
    let at = desk.work();
    fs::write(at.join("note.obj"), format!("{FRUSTUM}curv 0 1\n")).unwrap();
    desk.put("note.json", &mesh("note.obj"));
    for verb in ["assess", "check"] {
        let (_, out, err) = run(&at, &[verb, "note.json"]);
        assert!(out.contains("note.obj: lines that do not describe polyhedra"), "{out}{err}");
    }
    // Inside out: mended with the word that is said of every shape.
    let turned: Vec<String> = FRUSTUM
        .lines()
        .map(|l| {
            l.strip_prefix("f ").map_or(l.into(), |f| {
                format!("f {}", f.split(' ').rev().collect::<Vec<_>>().join(" "))
            })
        })
        .collect();
    fs::write(at.join("turned.obj"), turned.join("\n")).unwrap();
    desk.put("turned.json", &mesh("turned.obj"));
    let (code, out, _) = run(&at, &["limit", "turned.json"]);
    assert!(code == Some(0) && out.contains("turned"), "{out}");
    let two = format!("{FRUSTUM}o other\nf 1 2 3 4\n");
    let cut = FRUSTUM.rsplit_once("v ").unwrap().0;
    let open = FRUSTUM.replace("f 5 6 7 8\n", "");
    for (name, content, says) in [
        ("two.obj", two.as_str(), "the file has 2 meshes (\"stone\", \"other\")"),
        ("cut.obj", cut, "faces"),
        ("open.obj", open.as_str(), "open.obj: "),
        ("broken.obj", "v 0 0 zero\n", "broken.obj: line 1: coordinate z"),
        ("words.txt", "nothing of the kind", "unknown from both the extension and the content"),
        ("scene.json", "{}", "this is JSON, not a mesh"),
        ("wall.dxf", "0\nSECTION\n", "this is DXF, not a mesh"),
        ("heap.csv", "x,y,z,radius\n", "this is grains, not a mesh"),
        ("empty.stl", "", "no triangles"),
    ] {
        fs::write(at.join(name), content).unwrap();
        desk.put("question.json", &mesh(name));
        let (code, out, err) = run(&at, &["assess", "question.json"]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{name}: {err}");
        assert!(
            err.contains(says) && err.contains("blocks[1].shape.mesh") && err.contains("hint: "),
            "{name}: {err}"
        );
    }
}

#[test]
fn a_path_leads_nowhere_but_to_a_mesh_in_the_folder() {
    let desk = Desk::new();
    let at = desk.work();
    let outside = desk.root.path().join("outside.obj").display().to_string();
    let leaves = "leaves the folder of the scene";
    let mut cases = vec![
        ("../../etc/passwd".to_string(), leaves),
        ("../outside.obj".into(), leaves),
        ("stones/../../outside.obj".into(), leaves),
        ("/etc/passwd".into(), leaves),
        (outside.clone(), leaves),
        ("/dev/zero".into(), leaves),
        ("nothing.obj".into(), "cannot be read"),
        ("stones".into(), "this is a folder"),
        (String::new(), "this is a folder"),
        ("stones/frustum.obj/more".into(), "cannot be read"),
        ("stones/frustum.obj\0".into(), "cannot be read"),
        ("a".repeat(100_000), "cannot be read"),
    ];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(desk.root.path().join("outside.obj"), at.join("link.obj"))
            .unwrap();
        std::os::unix::fs::symlink(desk.root.path(), at.join("up")).unwrap();
        std::os::unix::fs::symlink("loop.obj", at.join("loop.obj")).unwrap();
        std::os::unix::fs::symlink("/dev/zero", at.join("zero.obj")).unwrap();
        let link = "a link leads out of the folder";
        cases.extend([
            ("link.obj".into(), link),
            ("up/outside.obj".into(), link),
            ("zero.obj".into(), link),
            ("loop.obj".into(), "cannot be read"),
        ]);
        let made =
            Command::new("mkfifo").arg(at.join("pipe.obj")).status().is_ok_and(|s| s.success());
        if made {
            cases.push(("pipe.obj".into(), "this is not a regular file"));
        } else {
            crate::skipped("no mkfifo");
        }
    }
    let before = fs::read_dir(&at).unwrap().count();
    for (path, says) in &cases {
        desk.put("scene.json", &mesh(path));
        for args in [&["assess", "scene.json"][..], &["check", "scene.json"]] {
            let (code, out, err) = run(&at, args);
            assert_eq!((code, out.as_str()), (Some(2), ""), "{path:?}: {err}");
            let placed = err.contains("blocks[1].shape.mesh.path: block \"stone\": ");
            assert!(
                err.contains(says) && placed && err.contains("hint: ") && !err.contains("root:"),
                "{path:?}: {err}"
            );
        }
    }
    assert_eq!(fs::read_dir(&at).unwrap().count(), before + 1, "nothing else is written");
    // A plan's scene is held to the same.
    desk.put("scene.json", &mesh("../outside.obj"));
    let plan = json!({ "format": "voussoir-sweep/1", "scene": "scene.json", "question": { "assess": {} }, "seed": 1,
        "vary": [{ "pointer": "/joints/default/friction", "values": [0.4] }], "sampling": { "grid": {} } });
    desk.put("plan.json", &plan);
    let (code, _, err) = run(&at, &["sweep", "plan.json"]);
    assert!(code == Some(2) && err.contains(leaves), "{err}");
    // With leave to do so, every verb follows it.
    for path in ["../outside.obj", &outside] {
        desk.put("scene.json", &mesh(path));
        for args in [
            &["assess", "scene.json"][..],
            &["limit", "scene.json", "--save", "result.json"],
            &["check", "scene.json"],
            &["check", "result.json", "--scene", "scene.json"],
            &["sweep", "plan.json", "--restart"],
        ] {
            let (code, _, err) = run(&at, &[args, &["--allow-outside"]].concat());
            assert_eq!(code, Some(0), "{args:?}: {err}");
        }
    }
    // Leave to look elsewhere is no leave to hang.
    desk.put("scene.json", &mesh("/dev/zero"));
    let (code, _, err) = run(&at, &["assess", "scene.json", "--allow-outside"]);
    assert!(
        code == Some(2) && (cfg!(not(unix)) || err.contains("this is not a regular file")),
        "{err}"
    );
}

#[test]
fn meshes_that_are_too_long_are_refused_before_they_are_read() {
    let desk = Desk::new();
    let at = desk.work();
    let sparse = fs::File::create(at.join("long.obj")).unwrap();
    if sparse.set_len(10 << 30).is_err() {
        crate::skipped("no sparse files here");
        return;
    }
    drop(sparse);
    desk.put("scene.json", &mesh("long.obj"));
    let (code, _, err) = run(&at, &["assess", "scene.json"]);
    assert!(
        code == Some(2) && err.contains("the file has 10.0 GiB, at most 2.0 GiB are read"),
        "{err}"
    );
    // One file of modest length, named often.
    fs::write(at.join("long.obj"), format!("{FRUSTUM}#{}\n", " ".repeat(1 << 20))).unwrap();
    let mut many = mesh("long.obj");
    let stone = many["blocks"][1].clone();
    for k in 0..200 {
        let mut copy = stone.clone();
        (copy["id"], copy["at"]) = (json!(format!("copy-{k}")), json!([10 * k, 0, 0]));
        many["blocks"].as_array_mut().unwrap().push(copy);
    }
    desk.put("scene.json", &many);
    let (code, _, err) = run(&at, &["assess", "scene.json", "--max-memory", "400M"]);
    assert!(code == Some(2) && err.contains("the meshes up to this one would take about"), "{err}");
}
