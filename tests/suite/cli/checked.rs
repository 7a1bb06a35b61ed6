//! `check` of scenes, and what it prints for other programs.

use super::*;

#[test]
fn a_scene_is_searched_for_slips() {
    let desk = Desk::new();
    let text = out(&expect(YES, voussoir(&["check", &desk.at("arch.json")])));
    assert!(text.contains("17 blocks (2 supports)"), "{text}");
    let mut scene = desk.read("arch.json");
    scene["blocks"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "id": "kite", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 99] }));
    let file = desk.write("loose.json", &scene);
    let text = out(&expect(NO, voussoir(&["check", &file])));
    assert!(text.contains("kite"), "{text}");
    // It falls freely, and the answer says which.
    let text = out(&expect(NO, voussoir(&["assess", &file])));
    assert!(text.contains("kite"), "{text}");
    let result = desk.saved(NO, &["assess", &file]);
    desk.checked(YES, &result);
}

/// What other programs build their equations from: with the forces of a result it must balance, in
/// the stated frames and signs.
#[test]
fn the_resolved_scene_is_printed_for_other_programs() {
    let desk = Desk::new();
    let result = desk.saved(YES, &["limit", &desk.at("pushed.json"), "--law", "associative"]);
    let printed = out(&expect(YES, voussoir(&["check", &desk.at("pushed.json"), "--json"])));
    let model: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(model["format"], "voussoir-model/1");
    let lambda = result["answer"]["load_factor"]["value"].as_f64().unwrap();
    let vector = |v: &Value| {
        nalgebra::Vector3::from_iterator(v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()))
    };
    let blocks = model["blocks"].as_array().unwrap();
    let load = |b: &Value, part: &str| vector(&b["dead"][part]) + lambda * vector(&b["live"][part]);
    let mut sums: Vec<_> = blocks.iter().map(|b| (load(b, "force"), load(b, "moment"))).collect();
    let forces = result["evidence"]["limit"]["factor"]["bound"]["forces"].as_array().unwrap();
    let faces = model["interfaces"].as_array().unwrap();
    assert_eq!(faces.len(), forces.len());
    for (face, carried) in faces.iter().zip(forces) {
        let (t1, t2, n) = (vector(&face["t1"]), vector(&face["t2"]), vector(&face["n"]));
        assert!((t1.cross(&t2) - n).norm() < 1e-12);
        let mu = face["friction"].as_f64().unwrap();
        for (point, force) in
            face["points"].as_array().unwrap().iter().zip(carried["forces"].as_array().unwrap())
        {
            let (point, force) = (vector(point), vector(force));
            let slack = mu * force.dot(&n) - force.dot(&t1).hypot(force.dot(&t2));
            assert!(slack >= -1e-6 * force.norm(), "{slack}");
            for (side, sign) in [(0, -1.0), (1, 1.0)] {
                let block = face["between"][side].as_u64().unwrap() as usize;
                sums[block].0 += sign * force;
                sums[block].1 += sign * (point - vector(&blocks[block]["centroid"])).cross(&force);
            }
        }
    }
    for (block, (force, moment)) in blocks.iter().zip(&sums).filter(|(b, _)| b["support"] == false)
    {
        let weight = block["mass"].as_f64().unwrap() * 9.81;
        assert!(
            force.norm() < 1e-6 * weight && moment.norm() < 1e-6 * weight,
            "{block}: {force} {moment}"
        );
    }
}

#[test]
fn a_verification_is_printed_for_other_programs() {
    let desk = Desk::new();
    let result = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    let of = |wanted: i32, result: &Value| -> Value {
        serde_json::from_str(&out(&expect(
            wanted,
            voussoir(&["check", &desk.write("r.json", result), "--json"]),
        )))
        .unwrap()
    };
    let good = of(YES, &result);
    assert_eq!((&good["confirmed"], &good["grade"]), (&json!(true), &json!("computed")));
    assert_eq!(good["parts"][0]["grade"], "computed");
    assert_eq!(good["answer"], result["answer"]);
    let mut forged = result;
    forged["evidence"]["assess"]["standing"]["certificate"]["forces"][3]["forces"][0][2] =
        json!(1e6);
    let bad = of(NO, &forged);
    assert_eq!((&bad["confirmed"], &bad["grade"]), (&json!(false), &json!("refuted")));
    assert!(
        bad["parts"].as_array().unwrap().iter().any(|p| !p["fails"].as_array().unwrap().is_empty()),
        "{bad}"
    );
}
