//! Packing lists: boxes with their places.

use super::*;

const LIST: &str = "id,Length [m],Width [m],Height [m],x,y,z,mass,colour\na,1,0.8,0.5,0,0,0.1,20,red\nb,1,0.8,0.5,0,0,0.6,5,blue\n";

#[test]
fn boxes_stand_on_a_floor_and_come_one_by_one() {
    let imported = import("pallet.csv", LIST).expect("a scene");
    let scene = &imported.scene;
    assert_eq!(ids(&imported), ["a", "b", "floor"]);
    assert!(matches!(scene.blocks[2].shape, Shape::Plane { normal: [0.0, 0.0, 1.0] }));
    assert_eq!((scene.blocks[2].at[2], scene.blocks[2].support), (0.1, true));
    let (vertices, faces) = mesh(&scene.blocks[1]);
    let low = |k: usize| vertices.iter().map(|v| v[k]).fold(f64::INFINITY, f64::min);
    assert_eq!(([low(0), low(1), low(2)], faces.len()), ([0.0, 0.0, 0.6], 6));
    assert_eq!(scene.blocks[1].mass, Some(5.0));
    let stages: Vec<_> = scene.stages.iter().map(|s| (s.name.as_str(), s.add.clone())).collect();
    assert_eq!(stages, [("a", vec!["a".to_string()]), ("b", vec!["b".to_string()])]);
    let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
    let said = said.join("\n");
    for part in ["colour", "lowest corner", "plane at the height 0.1"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// Separators, other names of columns, steps, supports and turned boxes.
#[test]
fn lists_are_written_in_several_ways() {
    let list = "name;dx;dy;dz;center_x;center_y;center_z;yaw_deg;step;support;density\nbed;2;2;0.2;0;0;-0.1;0;;yes;\nlate;1;0.5;0.5;0;0;0.75;90;2;;400\nfirst;1;1;0.5;0;0;0.25;0;1;;400\nbeside;0.2;0.2;0.2;0.8;0;0.1;0;1;0;400\n";
    let imported = good("p.csv", list);
    let scene = &imported.scene;
    assert_eq!(ids(&imported), ["bed", "late", "first", "beside"]);
    assert_eq!(scene.blocks.iter().filter(|b| b.support).count(), 1);
    let stages: Vec<_> = scene.stages.iter().map(|s| (s.name.as_str(), s.add.join("+"))).collect();
    assert_eq!(stages, [("step 1", "first+beside".to_string()), ("step 2", "late".to_string())]);
    let widest = mesh(&scene.blocks[1]).0.iter().map(|v| v[0].abs()).fold(0.0, f64::max);
    assert!((widest - 0.25).abs() < 1e-15, "{widest}");
}

/// Tables of spheres stay grains, also where they have a column `d`.
#[test]
fn grains_are_no_boxes() {
    let imported = import("g.csv", "x,y,z,d\n0,0,0,1\n").expect("a scene");
    assert!(matches!(imported.scene.blocks[0].shape, Shape::Sphere { .. }));
}

/// The floor is below, whichever way is up in the file.
#[test]
fn the_floor_follows_the_axis_that_points_up() {
    let options = ImportOptions { up: Some(Up::Y), scale: Some(0.01), ..ImportOptions::default() };
    let list = "l,w,h,x,y,z\n100,50,20,0,30,0\n100,50,20,0,80,0\n";
    let imported = import_bytes("p.csv", list.as_bytes(), &options).expect("a scene");
    let floor = &imported.scene.blocks[2];
    assert!((floor.at[2] - 0.3).abs() < 1e-15, "{:?}", floor.at);
    assert!(matches!(floor.shape, Shape::Plane { normal } if (normal[2] - 1.0).abs() < 1e-15));
}

#[test]
fn faults_are_refused_with_their_line() {
    for (list, why) in [
        ("l,w,h,x,y\n1,1,1,0,0\n", "no columns x, y, z"),
        ("l,w,h,x,y,z\n1,1,1,0,0,0\n1,0,1,0,0,0\n", "must be > 0"),
        ("l,w,h,x,y,z\n1,1,1,0,0,0\n1,1,1,0,0,high\n", "got \"high\""),
        ("l,w,h,x,y,z,yaw_deg\n1,1,1,0,0,0,0\n1,1,1,0,0,0,45\n", "center_x"),
        ("l,w,h,x,y,z,mass\n1,1,1,0,0,0,1\n1,1,1,0,0,0,-2\n", "must be > 0"),
    ] {
        let error = import("p.csv", list).expect_err(list);
        let text = format!("{error} {}", error.hint.clone().unwrap_or_default());
        let line = error.position.map(|p| p.0);
        assert!(
            text.contains(why) && line == Some(if why.starts_with("no") { 1 } else { 3 }),
            "{list}: {text}"
        );
    }
}
